//! Sharing memory, another order and what was there before change no bit of any port.

use crate::support::{FOG, LIGHTS, bits, content, executor, gpu, planned, registry, run_all, scene, set_scene};
use tyndall_graph::{Order, PlanOptions, Roots};

#[test]
fn every_port_is_the_same_bit_by_bit() {
    let (gpu, registry, scene) = (gpu(), registry(&[]), scene(LIGHTS));
    let all = planned(&registry, FOG, |_, options| {
        options.roots = Roots::All;
        options.share = false;
    });
    let ports: Vec<_> = all.ports.entries().map(|(planned, port)| (all.port_name(planned), port.port)).collect();
    assert!(ports.len() >= 9);
    let mut unshared = executor(&gpu, &registry, all);
    set_scene(&mut unshared, &scene, 0.0);
    run_all(&mut unshared);
    let mut shared_slots = 0;
    for (at, (name, port)) in ports.iter().enumerate() {
        let expected = content(&unshared, name);
        assert!(expected.floats().iter().all(|number| !number.is_nan()), "NaN in `{name}`");
        for order in [Order::File, Order::Shuffled(at as u64), Order::Shuffled(100 + at as u64)] {
            let change = |options: &mut PlanOptions| {
                options.roots = Roots::Ports(vec![*port]);
                options.order = order;
            };
            let plan = planned(&registry, FOG, |_, options| change(options));
            shared_slots += plan.slots.handles().filter(|slot| plan.ports_in(*slot).count() > 1).count();
            let mut shared = executor(&gpu, &registry, plan);
            set_scene(&mut shared, &scene, 0.0);
            shared.poison(f32::NAN).unwrap();
            run_all(&mut shared);
            assert_eq!(bits(&content(&shared, name)), bits(&expected), "`{name}` in {order:?}");
        }
    }
    assert!(shared_slots > 0, "nothing was shared, so nothing was tested");
}

/// The test of the test: a port that was not asked for, whose memory others have used, cannot be read.
#[test]
fn what_others_have_overwritten_cannot_be_read() {
    let (gpu, registry, scene) = (gpu(), registry(&[]), scene(LIGHTS));
    let plan = planned(&registry, FOG, |graph, options| {
        let image = graph.find("image", tyndall_document::Place::Argument(String::new())).unwrap();
        options.roots = Roots::Ports(vec![image]);
    });
    let overwritten = plan.ports.handles().find(|port| {
        let slot = plan.ports[*port].slot;
        plan.ports_in(slot).last() != Some(*port)
    });
    let overwritten = overwritten.expect("something shares memory");
    let mut executor = executor(&gpu, &registry, plan);
    set_scene(&mut executor, &scene, 0.0);
    run_all(&mut executor);
    let error = executor.read(overwritten).unwrap_err().to_string();
    assert!(error.contains("its memory was used again"), "{error}");
}
