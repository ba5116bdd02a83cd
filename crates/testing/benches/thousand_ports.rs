//! A test that looks at a thousand ports of 64×64: rendering, comparison with goldens and properties, and the report.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark")]

use std::fmt::Write as _;
use std::path::Path;
use std::time::{Duration, Instant};

use tyndall_testing::{Options, Report, Session};

const PORTS: usize = 1000;

/// A pattern, and scaled pictures of it, each of the one before.
fn graph() -> String {
    let pattern = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../plugins/core/tests/pattern.png");
    let mut passes = format!(
        "\"pattern\": (use: \"core.image\", params: {{ \"file\": {:?} }}),
        \"p1\": (use: \"core.resize\", inputs: {{ \"input\": \"pattern.color\" }}, params: {{ \"width\": 64, \"height\": 64 }}),",
        pattern.display().to_string()
    );
    let mut before = "p1.resized".to_owned();
    for number in 2..PORTS {
        let factor = if number % 2 == 0 { "(1.01, 0.99, 1.0)" } else { "(0.99, 1.01, 1.0)" };
        let _ = writeln!(
            passes,
            "\"p{number}\": (use: \"core.scale\", inputs: {{ \"input\": \"{before}\" }}, params: {{ \"factor\": {factor} }}),"
        );
        before = format!("p{number}.scaled");
    }
    format!("(version: 1, size: (64, 64), passes: {{ {passes} }}, outputs: {{ \"end\": \"{before}\" }})")
}

fn main() {
    let desk = tempfile::tempdir().unwrap();
    std::fs::write(desk.path().join("ports.graph.ron"), graph()).unwrap();
    let test = desk.path().join("ports.test.ron");
    let taps = "\"*\": (golden: RelativeRmse(1e-5), properties: [Finite, NonNegative, AlphaOne])";
    std::fs::write(&test, format!("(version: 1, graph: \"ports.graph.ron\", size: (64, 64), taps: {{ {taps} }})"))
        .unwrap();
    let session =
        || Session::new(vec![tyndall_core::plugin], Vec::new(), None).unwrap_or_else(|error| panic!("{error}"));

    let start = Instant::now();
    let blessed = session().run(&test, &Options { bless: true, ..Options::default() });
    assert_eq!(blessed.blessed.len(), PORTS, "{}", blessed.text());
    print_time("blessing them once", start.elapsed());

    let mut plain = session();
    let outcome = plain.run(&test, &Options::default());
    assert!(outcome.passed() && outcome.ports.len() == PORTS, "{}", outcome.text());
    println!("{PORTS} ports of 64x64 on {}", plain.gpu().info.name);
    print_time("rendering, with reading back", plain.saved.rendering);
    print_time("comparing", outcome.took - plain.saved.rendering);
    print_time("the whole test", outcome.took);

    let mut reported = session();
    let mut outcome = reported.run(&test, &Options { for_report: true, ..Options::default() });
    print_time("the same with the time of each pass", outcome.took);
    let start = Instant::now();
    let report = Report::begin(&desk.path().join("report")).unwrap();
    report.add(&mut outcome).unwrap();
    report.finish("an adapter", &[outcome], &[]).unwrap();
    print_time("thumbnails and pages", start.elapsed());
}

fn print_time(what: &str, time: Duration) {
    println!("{what:<40} {:>7.2} s", time.as_secs_f64());
}
