//! No pass and no shipped graph is without an image test.

use std::collections::BTreeSet;
use std::path::PathBuf;

use tyndall_document::Diagnostics;
use tyndall_graph::{Handle, PlanOptions, PlannedPort, Roots, plan};
use tyndall_testing::file::{Tapped, check, read};
use tyndall_testing::{TestFile, discover};
use tyndall_tests::root;

fn tests() -> Vec<TestFile> {
    let mut out = Diagnostics::default();
    let found = discover(&[root().join("plugins"), root().join("graphs")]).unwrap();
    let files: Vec<TestFile> = found.tests.iter().filter_map(|path| read(path, &mut out)).collect();
    assert!(!out.has_errors() && !files.is_empty(), "{}", tyndall_document::render_text(&out, false));
    files
}

/// Every pass has a port with a golden, and one with a property or a relation.
#[test]
fn every_pass_has_an_image_test_and_a_property() {
    let registry = tyndall_render::registry(tyndall::shipped().iter().map(|plugin| plugin()).collect(), &[]).unwrap();
    assert!(registry.mistakes().is_empty());
    let (mut with_golden, mut with_property) = (BTreeSet::new(), BTreeSet::new());
    for file in tests() {
        let mut out = Diagnostics::default();
        let loaded = tyndall_render::load(&file.request, &registry, &mut out).unwrap();
        for tapped in check(&file, &loaded.graph, &|_| true, &mut out) {
            let pass = loaded.graph.pass(tapped.port.pass).descriptor().name.clone();
            let related = file.relations.iter().flat_map(|relation| &relation.expect);
            if !tapped.properties.is_empty() || related.into_iter().any(|expected| expected.port == tapped.name) {
                with_property.insert(pass.clone());
            }
            if tapped.golden.is_some() {
                with_golden.insert(pass);
            }
        }
    }
    let without = |covered: &BTreeSet<String>| {
        let all = registry.passes().map(|pass| pass.descriptor.name.clone());
        all.filter(|name| !covered.contains(name)).collect::<Vec<_>>()
    };
    assert!(without(&with_golden).is_empty(), "without a golden: {:?}", without(&with_golden));
    assert!(without(&with_property).is_empty(), "without a property: {:?}", without(&with_property));
}

#[test]
fn every_shipped_graph_has_an_image_test() {
    let tested: BTreeSet<PathBuf> = tests().iter().filter_map(|file| file.request.graph.canonicalize().ok()).collect();
    let folders = ["graphs", "graphs/modes"].map(|folder| std::fs::read_dir(root().join(folder)).unwrap());
    let graphs = folders.into_iter().flatten().map(|entry| entry.unwrap().path());
    let graphs: Vec<PathBuf> = graphs.filter(|path| path.to_string_lossy().ends_with(".graph.ron")).collect();
    assert!(!graphs.is_empty());
    for graph in graphs {
        assert!(tested.contains(&graph.canonicalize().unwrap()), "{} has no image test", graph.display());
    }
}

/// Whatever a pass of a test reads is held in every number by the same test, so that a mistake is laid at the pass that
/// made it and not at the next one that somebody looks at.
#[test]
fn every_port_that_is_read_is_held() {
    let registry = tyndall_render::registry(tyndall::shipped().iter().map(|plugin| plugin()).collect(), &[]).unwrap();
    let mut unheld = Vec::new();
    for file in tests() {
        let mut out = Diagnostics::default();
        let loaded = tyndall_render::load(&file.request, &registry, &mut out).unwrap();
        let has_reference = |pass: &str| registry.pass(pass).is_some_and(|pass| pass.reference.is_some());
        let tapped = check(&file, &loaded.graph, &has_reference, &mut out);
        let roots = Roots::Ports(tapped.iter().map(|tapped| tapped.port).collect());
        let plan = plan(&loaded.graph, &PlanOptions { roots, ..PlanOptions::new(loaded.graph.size) }).unwrap();
        let is_held = |port| {
            let holds = |tapped: &&Tapped| {
                tapped.golden.is_some() || tapped.properties.iter().any(|property| property.metric().is_some())
            };
            tapped.iter().filter(holds).any(|tapped| plan.planned(tapped.port) == Some(port))
        };
        let read: BTreeSet<Handle<PlannedPort>> =
            plan.passes.handles().flat_map(|pass| plan.sources(pass).iter().flatten().copied()).collect();
        let written = read.into_iter().filter(|port| plan.ports[*port].pass.is_some());
        let names = written.filter(|port| !is_held(*port)).map(|port| plan.port_name(port));
        unheld.extend(names.map(|name| format!("{}: {name}", file.stem())));
    }
    assert!(unheld.is_empty(), "{unheld:#?}");
}
