//! The order in which passes run is free where the graph leaves it free: a shipped graph draws the same in each.

use std::collections::BTreeSet;

use tyndall_document::Diagnostics;
use tyndall_graph::{Order, PortRef, Roots};
use tyndall_render::load;
use tyndall_testing::{Session, Variation, file};
use tyndall_tests::{root, sessions};

const ORDERS: usize = 12;

#[test]
fn distinct_orders_of_a_shipped_graph_draw_the_same_bits() {
    sessions().with(draw_in_distinct_orders).unwrap_or_else(|error| panic!("{error}"));
}

fn draw_in_distinct_orders(session: &mut Session) {
    let path = root().join("graphs/aerial-perspective.test.ron");
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
    let (as_written, expected) = render(session, Order::File);
    let mut orders = BTreeSet::from([as_written]);
    for seed in 0..200 {
        let (order, found) = render(session, Order::Shuffled(seed));
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
