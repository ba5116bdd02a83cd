//! The report as a person meets it: in a browser, from a folder, without a server.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::{Value, json};
use tyndall_plugin::SearchPath;
use tyndall_testing::{Options, Report, Session};

use crate::browser::Browser;
use crate::chain::Chain;

/// A report of two tests, of which one fails: its third link is broken.
fn report(folder: &Path) -> PathBuf {
    let options = Options { for_report: true, ..Options::default() };
    let chain = Chain::new();
    let report = Report::begin(folder).unwrap();
    let mut right = chain.run(&options);
    chain.set_line("three", "    let value = texel(id.xy + vec2(3u, 0u));");
    let mut wrong = chain.run(&options);
    wrong.about = "The third link is shifted by three pixels.".to_owned();
    for outcome in [&mut right, &mut wrong] {
        // As a user has it, and not by the folder of this test.
        outcome.path = "plugins/chain/tests/chain.test.ron".into();
        outcome.graph = "plugins/chain/tests/chain.graph.ron".into();
        report.add(outcome).unwrap();
        assert!(outcome.ports.iter().all(|port| port.actual.is_none()), "pictures are let go");
    }
    assert!(!folder.exists(), "a report that is not whole is not seen");
    report.finish("an adapter", &[right, wrong], &["a note".to_owned()]).unwrap()
}

/// Where people look at the screenshots.
fn out(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../out/report-in-browser").join(name)
}

fn all_images_are_there(browser: &mut Browser) {
    let broken =
        browser.evaluate("[...document.images].filter(i => !(i.complete && i.naturalWidth > 0)).map(i => i.src)");
    assert_eq!(broken, json!([]));
}

#[test]
fn the_report_opens_in_a_browser_and_its_slider_moves() {
    let desk = tempfile::tempdir().unwrap();
    let index = report(&desk.path().join("report"));
    let mut browser = Browser::open();
    browser.width(1280);
    browser.prefer("light");

    // The list of tests: the failed one first, with the pass that went wrong.
    browser.go(&index);
    let cells = browser.evaluate("[...document.querySelector('tbody tr').cells].map(c => c.innerText)");
    assert!(cells[1].as_str().unwrap().contains("shifted by three pixels"), "{cells}");
    assert_eq!((&cells[2], &cells[3]), (&json!("three"), &json!("four, five")));
    all_images_are_there(&mut browser);
    assert_eq!(browser.evaluate("document.querySelectorAll('tbody img').length"), json!(2));
    assert!(browser.evaluate("document.querySelector('footer').innerText").as_str().unwrap().contains("a note"));
    for (scheme, width) in [("light", 1280), ("dark", 1280), ("dark", 420), ("light", 420)] {
        browser.prefer(scheme);
        browser.width(width);
        browser.photograph(&out(&format!("index-{scheme}-{width}.png")));
    }
    browser.width(1280);

    // Through the keyboard to the page of the failed test.
    browser.press("Tab");
    browser.loads(|browser| browser.press("Enter"));
    all_images_are_there(&mut browser);
    let guilty = browser.evaluate("[...document.querySelectorAll('.card.diverged b')].map(b => b.innerText)");
    assert_eq!(guilty, json!(["three"]));
    let red = |browser: &mut Browser| {
        browser.evaluate("getComputedStyle(document.querySelector('.card.diverged')).borderColor")
    };
    assert_eq!(red(&mut browser), json!("rgb(198, 40, 40)"));
    let inherited = browser.evaluate("document.querySelectorAll('.card.inherited').length");
    assert_eq!(inherited, json!(2));

    let thumbnails = browser.evaluate("document.querySelectorAll('.card img').length");
    assert_eq!(thumbnails, json!(7));

    slider(&mut browser);
    keyboard(&mut browser);
    theme(&mut browser);

    for width in [1280, 420] {
        browser.width(width);
        // The guilty pass is in view, however narrow the window.
        browser.loads(|browser| drop(browser.call("Page.reload", &json!({}))));
        let [left, _, card, _] = browser.place(".card.diverged");
        assert!(left >= 0.0 && left + card <= f64::from(width), "{left} {card} in {width}");
        let overflow = browser.evaluate("document.documentElement.scrollWidth - innerWidth");
        assert!(overflow.as_f64().unwrap() <= 0.0, "the page is {overflow} pixels wider than a window of {width}");
        for scheme in ["light", "dark"] {
            browser.prefer(scheme);
            browser.photograph(&out(&format!("test-{scheme}-{width}.png")));
        }
    }
    let complaints = browser.complaints();
    assert!(complaints.is_empty(), "{complaints:#?}");
    let here = format!("file://{}/", index.parent().unwrap().display());
    let elsewhere = |url: &&&str| !url.starts_with(&here) && !url.starts_with("data:") && **url != "about:blank";
    let requests = browser.requests();
    assert!(requests.len() > 10 && requests.iter().find(elsewhere).is_none(), "{requests:#?}");
}

/// A report of a test that looks at one port of six passes in six frames, at another against a picture that somebody else
/// made, and from run to run.
fn wide_report(folder: &Path) -> PathBuf {
    let chain = Chain::new();
    fs::copy(chain.path("chain.goldens/one.result.exr"), chain.path("theirs.exr")).unwrap();
    let graph = fs::read_to_string(chain.path("chain.graph.ron")).unwrap();
    let graph = graph.replace("\"aside\": (use: \"chain.five\"", "\"aside\": (use: \"core.scale\"");
    chain.put("chain.graph.ron", &graph.replace("aside.result", "aside.scaled"));
    let reference = "reference: (file: \"theirs.exr\", by: RelativeRmse(1e-4), provenance: \"another renderer\")";
    let taps = format!("\"five.result\": (properties: [Finite]), \"three.result\": ({reference})");
    let relation = "(about: \"twice the factor, twice the light\", runs: [{ \"aside.factor\": (3.0, 3.0, 3.0) }], expect: { \"aside.scaled\": Scaled(factor: 2.0, by: RelativeRmse(1e-6)) })";
    chain.test(&taps, &format!("frames: [0, 1, 2, 3, 4, 5], relations: [{relation}]"));
    fs::remove_dir_all(chain.path("chain.goldens")).unwrap();
    let mut outcome = chain.run(&Options { for_report: true, ..Options::default() });
    assert_eq!(outcome.guilty(), ["three", "aside"], "{}", outcome.text());
    let report = Report::begin(folder).unwrap();
    report.add(&mut outcome).unwrap();
    report.finish("an adapter", &[outcome], &[]).unwrap()
}

/// What is left out by a filter is shown like what the test does not look at.
#[test]
fn a_filter_leaves_no_pass_without_a_picture() {
    let chain = Chain::new();
    let tap = Some("five.result".to_owned());
    let outcome = chain.run(&Options { for_report: true, tap, ..Options::default() });
    assert!(outcome.passed() && outcome.ports.len() == 1, "{}", outcome.text());
    let names: Vec<&str> = outcome.unchecked.iter().map(|port| port.name.as_str()).collect();
    assert_eq!(names, ["start.result", "one.result", "two.result", "three.result", "four.result", "aside.result"]);
    assert!(chain.plain().unchecked.is_empty(), "they are rendered for a report alone");
}

/// What a pass took when it first ran is what it spares where it need not run again.
#[test]
fn sharing_tells_what_it_saves() {
    let chain = Chain::new();
    let search = vec![SearchPath { path: chain.path("plugins"), required: true }];
    let mut session = Session::new(vec![tyndall_core::plugin], search, None).unwrap();
    let mut run = || {
        assert!(session.run(&chain.path("chain.test.ron"), &Options::default()).passed());
        session.saved
    };
    let (first, second) = (run(), run());
    assert_eq!((first.spared, first.spared_time), (0, Duration::ZERO));
    assert_eq!((second.passes, second.spared), (14, 7));
    assert!(second.spared_time > Duration::ZERO && second.spared_time < second.rendering, "{second:?}");
    assert!(second.comparing > first.comparing && second.references == Duration::ZERO, "{second:?}");
}

/// A thumbnail for each port, whether the test looks at it or not, and none of them is cut off; whatever does not hold
/// against a picture has a slider.
#[test]
fn every_port_is_seen_and_every_comparison_that_failed() {
    let desk = tempfile::tempdir().unwrap();
    let index = wide_report(&desk.path().join("report"));
    let mut browser = Browser::open();
    browser.width(1280);
    browser.prefer("light");
    browser.go(&index);
    browser.photograph(&out("wide-index.png"));
    let page = browser.evaluate("document.querySelector('tbody a').getAttribute('href')");
    browser.go(&index.with_file_name(page.as_str().unwrap()));
    all_images_are_there(&mut browser);
    let seen = "[...document.querySelectorAll('.card')].map(card => [...card.querySelectorAll('img')].filter(i => { const a = i.getBoundingClientRect(), b = card.getBoundingClientRect(); return a.top >= b.top && a.bottom <= b.bottom && a.left >= b.left && a.right <= b.right; }).length)";
    assert_eq!(browser.evaluate(seen), json!([6, 6, 6, 6, 6, 6, 6]));
    let unseen = browser.evaluate("document.querySelectorAll('.card a.unseen').length");
    assert_eq!(unseen, json!(5 * 6), "of those that the test does not look at");
    let compared = "[...document.querySelectorAll('details')].map(d => d.querySelectorAll('.compare').length)";
    assert_eq!(browser.evaluate(compared), json!([1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0]));
    let heading = browser.evaluate("document.querySelector('details:not(.relation) h3').innerText");
    assert_eq!(heading, json!("reference (another renderer)"));
    for scheme in ["light", "dark"] {
        browser.prefer(scheme);
        browser.photograph(&out(&format!("wide-{scheme}.png")));
    }
    let complaints = browser.complaints();
    assert!(complaints.is_empty(), "{complaints:#?}");
}

/// Which picture is seen at a part of the width of the first comparison.
fn seen_at(browser: &mut Browser, part: f64) -> Value {
    let [left, top, width, height] = browser.place(".compare");
    browser.evaluate(&format!("document.elementFromPoint({}, {}).alt", left + part * width, top + height / 2.0))
}

/// By the mouse and by the keys it moves the border between the two pictures.
fn slider(browser: &mut Browser) {
    browser.evaluate("document.querySelector('.compare').scrollIntoView({ block: 'center' })");
    assert_eq!((seen_at(browser, 0.4), seen_at(browser, 0.6)), (json!("expected"), json!("actual")));
    let [left, top, width, height] = browser.place("figure input[type=range]");
    let at = |part: f64| (left + part * width, top + height / 2.0);
    browser.drag(at(0.5), at(0.2));
    assert_eq!((seen_at(browser, 0.1), seen_at(browser, 0.4)), (json!("expected"), json!("actual")));
    browser.drag(at(0.2), at(0.9));
    assert_eq!((seen_at(browser, 0.6), seen_at(browser, 0.8)), (json!("expected"), json!("expected")));
    // On the pictures themselves, too.
    let [left, top, width, height] = browser.place(".compare");
    let on_picture = |part: f64| (left + part * width, top + height / 2.0);
    browser.drag(on_picture(0.9), on_picture(0.3));
    assert_eq!((seen_at(browser, 0.2), seen_at(browser, 0.4)), (json!("expected"), json!("actual")));
    browser.evaluate("document.querySelector('figure input[type=range]').focus()");
    let value = |browser: &mut Browser| {
        browser.evaluate("Number(document.querySelector('figure input[type=range]').value)").as_f64().unwrap()
    };
    let before = value(browser);
    (0..3).for_each(|_| browser.press("ArrowLeft"));
    assert_eq!(value(browser), before - 3.0);
}

/// `j` and `k` walk through the ports and put the focus where the arrow keys move the slider.
fn keyboard(browser: &mut Browser) {
    let focused = |browser: &mut Browser| {
        browser.evaluate("[document.activeElement.closest('details')?.id, document.activeElement.tagName, document.activeElement.closest('details')?.open]")
    };
    browser.press("j");
    assert_eq!(focused(browser), json!(["three.result.0", "INPUT", true]));
    browser.press("j");
    let second = focused(browser);
    assert!(second[0] != "three.result.0" && second[2] == true, "{second}");
    browser.press("k");
    assert_eq!(focused(browser)[0], "three.result.0");
    // A heading is reached by Tab as well, and opened and closed by Enter.
    browser.evaluate("document.querySelector('details.passed summary').focus()");
    let open = |browser: &mut Browser| browser.evaluate("document.activeElement.closest('details').open");
    let before = open(browser);
    browser.press("Enter");
    assert_ne!(open(browser), before);
    browser.press("Enter");
}

/// As the user prefers it, and by `t` the other way round.
fn theme(browser: &mut Browser) {
    let paper = |browser: &mut Browser| browser.evaluate("getComputedStyle(document.body).backgroundColor");
    let light = paper(browser);
    browser.prefer("dark");
    let dark = paper(browser);
    assert_eq!((&light, &dark), (&json!("rgb(255, 255, 255)"), &json!("rgb(21, 23, 28)")));
    browser.press("t");
    assert_eq!(paper(browser), light);
    browser.press("t");
    assert_eq!(paper(browser), dark);
    browser.evaluate("delete document.documentElement.dataset.theme");
    browser.prefer("light");
}

/// A report takes the place of a report, and of nothing else; one that is given up leaves what was there.
#[test]
fn a_report_is_written_whole_or_not_at_all() {
    let desk = tempfile::tempdir().unwrap();
    let folder = desk.path().join("report");
    report(&folder);
    let before = fs::read_to_string(folder.join("index.html")).unwrap();
    fs::write(folder.join("stays"), "until another report takes its place").unwrap();
    drop(Report::begin(&folder).unwrap());
    assert_eq!(fs::read_to_string(folder.join("index.html")).unwrap(), before);
    Report::begin(&folder).unwrap().finish("an adapter", &[], &[]).unwrap();
    assert!(!folder.join("stays").exists());
    assert_eq!(fs::read_dir(desk.path()).unwrap().count(), 1);
    let mine = desk.path().join("mine");
    fs::create_dir(&mine).unwrap();
    fs::write(mine.join("index.html"), "<h1>mine</h1>").unwrap();
    assert!(Report::begin(&mine).unwrap_err().to_string().contains("holds other files"));
}

/// A test that stops before anything runs has a page all the same: of a mistake in its file, say.
#[test]
fn a_test_that_could_not_run_has_a_page() {
    let desk = tempfile::tempdir().unwrap();
    let chain = Chain::new();
    chain.test("\"nobody.*\": (golden: Exact)", "");
    let mut outcome = chain.run(&Options { for_report: true, ..Options::default() });
    assert_eq!(outcome.exit_code(), 2);
    let report = Report::begin(&desk.path().join("report")).unwrap();
    report.add(&mut outcome).unwrap();
    let index = report.finish("an adapter", &[outcome], &[]).unwrap();
    let pages: Vec<PathBuf> =
        fs::read_dir(index.parent().unwrap()).unwrap().map(|entry| entry.unwrap().path()).collect();
    let messages = pages.iter().filter(|page| page.extension().is_some_and(|suffix| suffix == "html"));
    let texts: Vec<String> = messages.map(|page| fs::read_to_string(page).unwrap()).collect();
    assert!(texts.len() == 2 && texts.iter().any(|text| text.contains("matches no port of the graph")), "{pages:?}");
}

/// A page is read from its beginning: the verdict and the graph come first, whatever is open below.
#[test]
fn a_page_opens_at_its_beginning() {
    let desk = tempfile::tempdir().unwrap();
    let chain = Chain::new();
    let graph = fs::read_to_string(chain.path("chain.graph.ron")).unwrap();
    let twice = graph.replace(
        "\"aside\": (use",
        "\"twice\": (use: \"core.scale\", inputs: { \"input\": \"five.result\" }), \"aside\": (use",
    );
    chain.put("chain.graph.ron", &twice.replace("outputs: {", "outputs: { \"twice\": \"twice.scaled\","));
    let relation = "relations: [(about: \"three times\", runs: [{ \"twice.factor\": (2.0, 2.0, 2.0) }], expect: { \"twice.scaled\": Scaled(factor: 3.0, by: RelativeRmse(1e-6)) })]";
    chain.test("\"*\": (properties: [Finite])", relation);
    let mut outcome = chain.run(&Options { for_report: true, without_goldens: true, ..Options::default() });
    assert_eq!(outcome.guilty(), ["twice"], "{}", outcome.text());
    let report = Report::begin(&desk.path().join("report")).unwrap();
    report.add(&mut outcome).unwrap();
    let index = report.finish("an adapter", &[outcome], &[]).unwrap();
    let pages = fs::read_dir(index.parent().unwrap()).unwrap().map(|entry| entry.unwrap().path());
    let page = pages.into_iter().find(|path| path != &index && path.extension().is_some_and(|suffix| suffix == "html"));
    let mut browser = Browser::open();
    browser.width(1280);
    browser.go(&page.unwrap());
    assert_eq!(browser.evaluate("scrollY"), json!(0));
    assert_eq!(
        browser.evaluate("document.querySelectorAll('details.relation[open] input[type=range]').length"),
        json!(1)
    );
}
