//! What a machine cannot do ends in an error that says so, and leaves nothing behind.

mod support;

use support::{chain, executor, gpu, graph, planned};
use tyndall_gpu::{FrameOptions, Gpu, GpuError, memory};
use tyndall_graph::{PlanOptions, plan};

#[test]
fn a_lost_device_is_told_in_every_frame_and_reading() {
    let gpu = gpu();
    let mut executor = executor(&gpu, planned(&chain(3))).unwrap();
    executor.frame(FrameOptions::default()).unwrap();
    let root = executor.plan().roots[0];
    assert!(executor.read(root).is_ok());
    gpu.lose();
    for _ in 0..2 {
        let error = executor.frame(FrameOptions::default()).unwrap_err();
        assert!(matches!(error, GpuError::Lost { .. }), "{error}");
        let error = executor.read(root).unwrap_err();
        assert!(matches!(error, GpuError::Lost { .. }), "{error}");
        let error = executor.poison(0.0).unwrap_err();
        assert!(matches!(error, GpuError::Lost { .. }), "{error}");
    }
    let error = support::executor(&gpu, planned(&chain(3))).err().unwrap();
    assert!(matches!(error, GpuError::Lost { .. }), "{error}");
}

#[test]
fn a_shader_that_the_adapter_refuses_is_named() {
    let text = "(version: 1, passes: { \"p\": (use: \"test.greedy\") }, outputs: { \"color\": \"p.color\" })";
    let gpu = gpu();
    let error = executor(&gpu, planned(text)).err().unwrap();
    assert!(matches!(&error, GpuError::Refused { what, .. } if what.contains("test.greedy")), "{error}");
    // The device is as good as before.
    let mut next = executor(&gpu, planned(&chain(2))).unwrap();
    next.frame(FrameOptions::default()).unwrap();
    assert!(next.read(next.plan().roots[0]).is_ok());
}

#[test]
fn a_picture_over_the_limits_is_refused_before_anything_is_created() {
    for gpu in [gpu(), Gpu::noop()] {
        let graph = graph(&chain(2));
        let wide = plan(&graph, &PlanOptions::new((100_000, 8))).unwrap();
        let high = plan(&graph, &PlanOptions::new((8, 100_000))).unwrap();
        let before = gpu.objects_created();
        for (plan, side) in [(wide, "width"), (high, "height")] {
            let error = memory::check(&gpu, &plan, 0).unwrap_err();
            let messages = error.to_string();
            assert!(matches!(error, GpuError::OverLimit { .. }), "{messages}");
            assert!(messages.starts_with(&format!("the {side} of `p")) && messages.contains("100000"), "{messages}");
        }
        assert_eq!(gpu.objects_created(), before);
        assert!(memory::check(&gpu, &plan(&graph, &PlanOptions::new((64, 64))).unwrap(), 0).is_ok());
    }
}

/// A software adapter does not refuse by itself; of others the driver's budget is asked when resources are made.
#[test]
fn more_memory_than_there_is_is_refused_before_anything_is_created() {
    let gpu = gpu();
    let side = gpu.limits.max_texture_dimension_2d.min(16_384);
    let graph = graph(&chain(200));
    let plan = plan(&graph, &PlanOptions { share: false, ..PlanOptions::new((side, side)) }).unwrap();
    assert!(plan.bytes.allocated > 700 << 30);
    let before = gpu.objects_created();
    if gpu.is_software() {
        let error = memory::check(&gpu, &plan, 0).unwrap_err();
        assert!(matches!(error, GpuError::TooLittleMemory { .. }), "{error}");
        assert_eq!(gpu.objects_created(), before);
        let small = planned(&chain(2));
        assert!(memory::check(&gpu, &small, 0).is_ok());
        let error = memory::check(&gpu, &small, 1 << 50).unwrap_err();
        assert!(matches!(error, GpuError::TooLittleMemory { .. }), "what is read back counts: {error}");
    } else {
        assert!(matches!(executor(&gpu, plan).err(), Some(GpuError::OutOfMemory { .. })));
    }
}

#[test]
fn an_unknown_adapter_lists_those_that_there_are() {
    let Err(error) = Gpu::open(Some("no such adapter")) else { panic!("it opened") };
    let messages = error.to_string();
    assert!(matches!(error, GpuError::UnknownAdapter { .. }), "{messages}");
    assert!(messages.contains(&tyndall_gpu::adapters()[0].name), "{messages}");
}

/// Part of a name is enough, in any case.
#[test]
fn an_adapter_is_found_by_a_part_of_its_name() {
    let name = tyndall_gpu::adapters()[0].name.clone();
    let part: String = name.to_uppercase().chars().take(5).collect();
    assert_eq!(Gpu::open(Some(&part)).unwrap().info.name, name);
}
