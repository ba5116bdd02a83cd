//! A steady frame creates no GPU object and allocates no more than a frame of wgpu written by hand.

mod support;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use support::by_hand::ByHand;
use support::{chain, executor, planned};
use tyndall_gpu::{FrameOptions, Gpu};

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

/// The system's allocator, counting.
struct Counting;

#[allow(unsafe_code, reason = "an allocator is an unsafe trait; every call goes on to the system's")]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        unsafe { System.alloc(layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        unsafe { System.realloc(at, layout, size) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const FRAMES: u64 = 1000;

/// Allocations of this many frames, after enough of them that pools have grown.
fn allocations(mut frame: impl FnMut()) -> u64 {
    (0..50).for_each(|_| frame());
    let before = ALLOCATIONS.get();
    (0..FRAMES).for_each(|_| frame());
    ALLOCATIONS.get() - before
}

#[test]
fn a_steady_frame_allocates_no_more_than_one_by_hand() {
    let by_hand = ByHand::noop(5);
    let expected = allocations(|| by_hand.frame());
    assert!(expected > 0, "the counter does not count");

    let gpu = Gpu::noop();
    let mut executor = executor(&gpu, planned(&chain(5))).unwrap();
    executor.frame(FrameOptions::default()).unwrap();
    let objects = gpu.objects_created();
    let everything = FrameOptions { everything: true, ..FrameOptions::default() };
    let ours = allocations(|| assert_eq!(executor.frame(everything).unwrap().passes_run, 5));
    let kept = allocations(|| assert_eq!(executor.frame(FrameOptions::default()).unwrap().passes_run, 0));
    println!("allocations of {FRAMES} frames: {ours}, by hand {expected}, where all is kept {kept}");

    assert_eq!(gpu.objects_created(), objects, "a steady frame creates GPU objects");
    assert!(ours <= expected, "{ours} allocations in {FRAMES} frames, {expected} by hand");
    assert!(kept <= expected, "{kept} allocations in {FRAMES} frames that run nothing");
}

/// The count of objects must be able to fail: another executor does create some.
#[test]
fn objects_are_counted() {
    let gpu = Gpu::noop();
    let before = gpu.objects_created();
    let _executor = executor(&gpu, planned(&chain(5))).unwrap();
    assert!(gpu.objects_created() >= before + 5 * 4);
}
