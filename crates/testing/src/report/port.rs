//! All about one port or one relation on the page of a test.

use std::fmt::Write as _;

use tyndall_page::false_color::STEPS;
use tyndall_page::{Picture, escaped, figure};

use super::PortPictures;
use super::pictures::{Against, MULTIPLES, Shown};
use crate::outcome::{GOLDEN, Outcome, PortOutcome, RelationOutcome, State};

/// The place of a port on its page.
pub(super) fn anchor(port: &PortOutcome) -> String {
    format!("{}.{}", port.name, port.frame)
}

/// What a state is called, on the page and in its style sheet.
pub(super) fn state(state: State) -> &'static str {
    match state {
        State::Passed => "passed",
        State::Guilty => "diverged",
        State::Inherited => "inherited",
        State::Unjudged => "unjudged",
    }
}

/// All about one port; open where it diverged.
pub(super) fn port(
    outcome: &Outcome,
    port: &PortOutcome,
    PortPictures { own, failed }: &PortPictures,
    folder: &str,
) -> String {
    let nothing = port.checks.is_empty();
    let class = if nothing { "unseen" } else { state(port.state) };
    let said = if nothing { "nothing was checked of it" } else { class };
    let open = if matches!(port.state, State::Guilty | State::Unjudged) { " open" } else { "" };
    let frame = if port.frame > 0 { format!(", frame {}", port.frame) } else { String::new() };
    let asked: Vec<&str> = port.checks.iter().map(|check| check.what.as_str()).collect();
    let mut html = format!(
        "<details class=\"port {class}\" id=\"{}\"{open}><summary><b>{}</b>{frame} <small>{}</small> <span class=\"state\">{said}</span> <small>{}</small></summary>\n<ul>",
        escaped(&anchor(port)),
        escaped(&port.name),
        escaped(&port.kind),
        escaped(&asked.join(", "))
    );
    for check in &port.checks {
        let (class, mark) = if check.judgement.passed { ("passed", "✓") } else { ("failed", "✗") };
        let _ = write!(
            html,
            "<li class=\"{class}\"><b>{mark} {}</b> {}{}</li>",
            escaped(&check.what),
            escaped(&check.judgement.figures),
            used(check.judgement.excess)
        );
    }
    html += "</ul>\n";
    if !port.stale.is_empty() {
        let parts = escaped(&port.stale.join(", "));
        let _ = writeln!(html, "<p>The golden is stale: {parts} changed since it was made.</p>");
    }
    // What came out is seen beside what was expected, where something was.
    if let Some(shown) = own.as_ref().filter(|shown| shown.against.is_some() || failed.is_empty()) {
        if !failed.is_empty() {
            let _ = writeln!(html, "<h3>{GOLDEN}</h3>");
        }
        html += &pictures(shown, folder);
    }
    for (index, shown) in failed {
        let _ = writeln!(html, "<h3>{}</h3>", escaped(&port.checks[*index].what));
        html += &pictures(shown, folder);
    }
    if port.checks.iter().any(|check| check.what == GOLDEN) {
        let _ = writeln!(html, "<p>Bless just this: <code>{}</code></p>", escaped(&outcome.bless_command(port)));
    }
    html + "</details>\n"
}

/// A relation in a line; with pictures where it does not hold.
pub(super) fn relation(relation: &RelationOutcome, shown: Option<&Shown>, folder: &str) -> String {
    let (class, mark) = (state(relation.state), if relation.judgement.passed { "✓" } else { "✗" });
    let frame = if relation.frame > 0 { format!(", frame {}", relation.frame) } else { String::new() };
    let line = format!(
        "<b>{mark} {}</b>{frame} {}: {}{}",
        escaped(&relation.port),
        escaped(&relation.about),
        escaped(&relation.judgement.figures),
        used(relation.judgement.excess)
    );
    let Some(shown) = shown else { return format!("<p class=\"relation {class}\">{line}</p>\n") };
    let open = if relation.state == State::Guilty { " open" } else { "" };
    let pictures = pictures(shown, folder);
    format!("<details class=\"port relation {class}\"{open}><summary>{line}</summary>\n{pictures}</details>\n")
}

/// How much of what is allowed was used up, where that can be said.
fn used(excess: f64) -> String {
    match excess {
        _ if excess.is_nan() || excess <= 0.0 || excess.is_infinite() => String::new(),
        _ if excess < 1.0 => format!(" <small>{} % of what is allowed</small>", short(100.0 * excess)),
        _ => format!(" <small>{} times what is allowed</small>", short(excess)),
    }
}

fn pictures(shown: &Shown, folder: &str) -> String {
    let image = |what: &str| {
        let path = format!("{folder}/{}.{what}.png", shown.stem);
        Picture { path: &path, alt: what, ..Picture::default() }.html()
    };
    let range = format!("{} to {}", short(f64::from(shown.range.0)), short(f64::from(shown.range.1)));
    let figures = match &shown.against {
        None => figure(&image("actual"), "what came out") + &figure(&histogram(shown), &range),
        Some(against) => {
            let actual = "<span><i class=\"actual\"></i>what came out</span>";
            let expected = "<span><i class=\"expected\"></i>what was expected</span>";
            let counts = format!("<span class=\"counts\">{actual}{expected}<span>{range}</span></span>");
            let largest = short(against.largest);
            let difference =
                format!("difference: blue within the tolerance, red beyond it, white at {largest} times it");
            figure(&one_over_the_other(&image("actual"), &image("expected")), SIDES)
                + &figure(&image("difference"), &difference)
                + &figure(&image("failing"), &failing(against))
                + &figure(&histogram(shown), &counts)
        }
    };
    format!("<div class=\"pictures\">{figures}</div>\n")
}

/// What is seen on which side of the slider.
const SIDES: &str = "expected to the left, actual to the right";

/// Two pictures in one place, and the slider that parts them.
fn one_over_the_other(actual: &str, expected: &str) -> String {
    format!(
        "<div class=\"compare\">{actual}<div class=\"over\">{expected}</div></div>\
         <input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"{SIDES}\">"
    )
}

/// A number for the eye: three digits.
fn short(number: f64) -> String {
    let size = number.abs();
    if size == 0.0 || (1e-3..1e5).contains(&size) {
        let digits = if size == 0.0 { 0 } else { (2 - size.log10().floor() as i32).max(0) as usize };
        return format!("{number:.digits$}");
    }
    format!("{number:.2e}")
}

/// How many pixels are beyond each multiple of the tolerance, with their colours.
fn failing(against: &Against) -> String {
    let count = |((multiple, count), [r, g, b]): ((&f64, usize), &[u8; 3])| {
        format!("<span><i style=\"background:rgb({r},{g},{b})\"></i>{multiple}×: {count}</span>")
    };
    let counts: String = MULTIPLES.iter().zip(against.failing).zip(&STEPS[1..]).map(count).collect();
    format!("of {} pixels, beyond the tolerance <span class=\"counts\">{counts}</span>", against.pixels)
}

/// Bars of what came out over those of what was expected; the height is the logarithm of the count.
fn histogram(shown: &Shown) -> String {
    let expected = shown.against.as_ref().map_or(&[][..], |against| &against.histogram);
    let most = shown.histogram.iter().chain(expected).max().copied().unwrap_or(1).max(1);
    let height = |count: usize| 80.0 * ((count + 1) as f64).ln() / ((most + 1) as f64).ln();
    let mut bars = String::new();
    for (class, counts) in [("actual", shown.histogram.as_slice()), ("expected", expected)] {
        for (index, count) in counts.iter().enumerate() {
            let height = height(*count);
            let _ = write!(
                bars,
                "<rect class=\"{class}\" x=\"{}\" y=\"{:.1}\" width=\"5\" height=\"{height:.1}\"/>",
                index * 6,
                80.0 - height
            );
        }
    }
    format!("<svg class=\"histogram\" viewBox=\"0 0 192 80\" role=\"img\" aria-label=\"histogram\">{bars}</svg>")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let numbers = [0.0, 1.0, -1.0, 0.752_676_3, 12.3456, 183_921.928, 2.5e-7, 0.00123].map(short);
        assert_eq!(numbers, ["0", "1.00", "-1.00", "0.753", "12.3", "1.84e5", "2.50e-7", "0.00123"]);
    }
}
