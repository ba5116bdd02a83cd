//! A small sample of what `tyndall mutants` does, so that it cannot rot: a few mutants of shipped passes are made, noticed,
//! and laid at the right pass.

use std::path::PathBuf;

use tyndall_mutants::{Figures, Hunt, hunt, missed};
use tyndall_plugin::SearchPath;
use tyndall_testing::Session;
use tyndall_tests::root;

#[test]
fn a_sample_of_mutants_is_killed() {
    let root = root();
    let search = vec![SearchPath { path: root.join("plugins"), required: true }];
    let mut session = Session::new(tyndall::shipped(), search, None).unwrap_or_else(|error| panic!("{error}"));
    let tests = ["march/tests/march", "surface_radiance/tests/fog"];
    let request = Hunt {
        tests: tests.iter().map(|test| root.join(format!("plugins/{test}.test.ron"))).collect::<Vec<PathBuf>>(),
        filter: "r".to_owned(),
        per_pass: 2,
        seed: 1,
        goldens: false,
        every_test: true,
        untested: false,
    };
    let findings = hunt(&mut session, &request, &mut |_| {}).unwrap_or_else(|trouble| panic!("{trouble:?}"));
    let figures = Figures::of(&findings);
    let messages = findings.iter().flat_map(missed).collect::<Vec<_>>().join("\n");
    assert_eq!(figures.misnamed, 0, "{messages}");
    assert!(figures.made >= 6 && 2 * figures.without_goldens >= figures.made, "{messages}");
}
