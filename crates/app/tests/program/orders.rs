//! The order in which passes run is free where the graph leaves it free: a shipped graph draws the same in each.

use std::collections::BTreeSet;
use std::path::Path;

use tyndall_document::Diagnostics;
use tyndall_graph::{Order, PortRef, Roots};
use tyndall_render::load;
use tyndall_testing::{Session, Variation, file};

const ORDERS: usize = 12;

#[test]
fn distinct_orders_of_a_shipped_graph_draw_the_same_bits() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../graphs/aerial-perspective.test.ron");
    let mut session = Session::new(tyndall::shipped(), Vec::new(), None).unwrap_or_else(|error| panic!("{error}"));
    let mut out = Diagnostics::default();
    let test = file::read(&path, &mut out).unwrap();
    let registry = session.registry(&test.request.graph).unwrap_or_else(|error| panic!("{error}"));
    let loaded = load(&test.request, &registry, &mut out).unwrap();
    let tapped = file::check(&test, &loaded.graph, &|_| true, &mut out);
    let ports: Vec<PortRef> = tapped.iter().map(|tapped| tapped.port).collect();
    assert!(!out.has_errors() && ports.len() > 10);

    let render = |session: &mut Session, order| {
        let variation = Variation { order, share: true, poison: true, reuse: false };
        let plan = Session::plan(&loaded.graph, Roots::Ports(ports.clone()), variation).unwrap();
        let names: Vec<String> = plan.passes.handles().map(|pass| plan.pass_name(pass).to_owned()).collect();
        let frames = session.render(&loaded, &registry, &ports, &[0], variation).unwrap();
        let bytes = |port: &PortRef| frames[0].ports[port].bytes.clone();
        (names, ports.iter().map(bytes).collect::<Vec<Vec<u8>>>())
    };
    let (as_written, expected) = render(&mut session, Order::File);
    let mut orders = BTreeSet::from([as_written]);
    for seed in 0..200 {
        let (order, found) = render(&mut session, Order::Shuffled(seed));
        for (port, (found, expected)) in tapped.iter().zip(found.iter().zip(&expected)) {
            assert!(found == expected, "`{}` differs in the order {order:?}", port.name);
        }
        orders.insert(order);
        if orders.len() == ORDERS {
            return;
        }
    }
    panic!("only {} distinct orders: {orders:#?}", orders.len());
}
