//! Another run of a relation, held against the test's own.

use std::fmt::Write as _;

use tyndall_document::{Diagnostic, Diagnostics};
use tyndall_graph::{Digest, Graph, Plan};
use tyndall_render::Loaded;
use tyndall_scene::Scene;

use super::{Change, Expectation, TestFile};
use crate::codes;

/// What a relation asks of ports of another run must be such as can be asked: the mistakes go to `out`.
pub fn check_run(
    file: &TestFile,
    expect: &[&Expectation],
    own: (&Loaded, &Plan),
    other: (&Loaded, &Plan),
    out: &mut Diagnostics,
) {
    says_something(file, expect, own.0, other.0, out);
    for expected in expect {
        let place = file.place(expected.span);
        let Ok(port) = own.0.graph.find(&expected.port, place.clone()) else { continue };
        let (pass, name) = (other.0.graph.pass(port.pass), &expected.port);
        if !pass.enabled {
            let message = format!("a run switches pass `{}` off, and `{name}` with it", pass.name);
            out.push(
                Diagnostic::error(codes::TAP_OFF, place, message).suggest("ask it of a port that is still written"),
            );
            continue;
        }
        let size = |plan: &Plan| plan.planned(port).map(|port| *plan.resource(port));
        // The reference on the CPU says what is right at any size.
        if size(own.1) != size(other.1) && !matches!(expected.change, Change::CpuReference(_)) {
            let message =
                format!("`{name}` has another size or format in a run, and cannot be compared with the test's own");
            out.push(Diagnostic::error(codes::WRONG_CHECK, place, message).suggest("ask for its CpuReference"));
        }
    }
}

/// A relation between a run and the same run once more holds whatever a pass does: then its settings say what is the case
/// anyway.
fn says_something(file: &TestFile, expect: &[&Expectation], own: &Loaded, other: &Loaded, out: &mut Diagnostics) {
    let Some(expected) = expect.iter().find(|expected| expected.change.holds_of_the_same_run()) else { return };
    if changes(&own.graph, &other.graph) || digest(own.scene.as_ref()) != digest(other.scene.as_ref()) {
        return;
    }
    let message = format!("a run sets what is set anyway, and so this of `{}` holds whatever comes out", expected.port);
    let problem = Diagnostic::error(codes::VACUOUS_CHECK, file.place(expected.span), message);
    out.push(problem.suggest("set something else in each of `runs`"));
}

fn changes(own: &Graph, other: &Graph) -> bool {
    let pass = |pass: &tyndall_graph::Pass, other: &tyndall_graph::Pass| {
        pass.enabled == other.enabled && pass.params == other.params
    };
    let mut passes = own.passes.iter().zip(&other.passes);
    own.size != other.size || !passes.all(|(own, other)| pass(own, other))
}

/// All that a scene says.
fn digest(scene: Option<&Scene>) -> u64 {
    struct DebugDigest(Digest);
    impl std::fmt::Write for DebugDigest {
        fn write_str(&mut self, text: &str) -> std::fmt::Result {
            self.0.bytes(text.as_bytes());
            Ok(())
        }
    }
    let mut written = DebugDigest(Digest::default());
    // Writing into it cannot fail.
    let _ = write!(written, "{scene:?}");
    written.0.finish()
}
