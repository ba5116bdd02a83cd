//! CPU time of a frame of 50 passes, ours against wgpu with bind groups made once.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark")]

#[path = "../tests/support/mod.rs"]
mod support;

use std::sync::Arc;
use std::time::Instant;

use support::by_hand::ByHand;
use support::{chain, executor, gpu, planned};
use tyndall_gpu::{FrameOptions, Gpu, wgpu};

const PASSES: usize = 50;
const BLOCKS: usize = 100;
const FRAMES_OF_A_BLOCK: usize = 20;

fn main() {
    compare("noop", &Gpu::noop(), &ByHand::noop(PASSES));
    let gpu = gpu();
    compare(&gpu.info.name.clone(), &gpu, &on_adapter(&gpu.info.name));
}

/// Prints the 10th percentile of both, over interleaved blocks.
fn compare(name: &str, gpu: &Arc<Gpu>, by_hand: &ByHand) {
    let mut executor = executor(gpu, planned(&chain(PASSES))).unwrap();
    let everything = FrameOptions { everything: true, ..FrameOptions::default() };
    let (mut ours, mut hands, mut kept) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..BLOCKS {
        for _ in 0..FRAMES_OF_A_BLOCK {
            ours.push(timed(|| assert_eq!(executor.frame(everything).unwrap().passes_run, PASSES)));
            gpu.wait().unwrap();
        }
        for _ in 0..FRAMES_OF_A_BLOCK {
            hands.push(timed(|| by_hand.frame()));
            by_hand.wait();
        }
        for _ in 0..FRAMES_OF_A_BLOCK {
            kept.push(timed(|| assert!(executor.frame(FrameOptions::default()).is_ok())));
            gpu.wait().unwrap();
        }
    }
    let [ours, hands, kept] = [ours, hands, kept].map(tenth_percentile);
    println!("{name}: {ours:.1} us a frame of {PASSES} passes, {hands:.1} us by hand, ratio {:.3}", ours / hands);
    println!("{name}: {kept:.1} us a frame in which every result is kept");
}

/// Microseconds.
fn timed(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64() * 1e6
}

fn tenth_percentile(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 10]
}

/// The hand-written frame on a device of its own of the same adapter.
fn on_adapter(name: &str) -> ByHand {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    let adapter = adapters.into_iter().find(|adapter| adapter.get_info().name == name).unwrap();
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default())).unwrap();
    ByHand::new(device, queue, PASSES)
}
