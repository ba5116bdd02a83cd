//! Metrics, properties and relations, as a test file writes them.

use tyndall_document::{Decoder, Diagnostic, Diagnostics, Fields, Node, Source, Value, parse_value};
use tyndall_render::Setting;

use super::read::settings;
use super::reason::{demand_reason, reason};
use super::{Change, Expectation, Property, Relation, Spanned};
use crate::codes;
use crate::metric::Metric;

/// `Exact`, `Absolute(tolerance: …, failing: …)`, `RelativeRmse(…)`, `Flip(mean: …, p99: …)`.
pub(super) fn metric(decoder: &mut Decoder<'_>, node: &Node) -> Option<Metric> {
    let (name, content) = decoder.variant(node, "a metric", &["Exact", "Absolute", "RelativeRmse", "Flip"])?;
    let metric = match (name, content) {
        ("Exact", _) => Metric::Exact,
        ("RelativeRmse", Some(content)) => {
            // `Name(value)` holds a tuple of one.
            let content = match &content.value {
                Value::Tuple(items) if items.len() == 1 => &items[0],
                _ => content,
            };
            Metric::RelativeRmse { tolerance: decoder.float(content)? }
        }
        ("Absolute", Some(content)) => {
            let fields = decoder.fields(content, "`Absolute`", &["tolerance", "failing"])?;
            Metric::Absolute {
                tolerance: number(decoder, &fields, "tolerance")?,
                failing: optional(decoder, &fields, "failing")?.unwrap_or(0.0),
            }
        }
        ("Flip", Some(content)) => {
            let fields = decoder.fields(content, "`Flip`", &["mean", "p99"])?;
            Metric::Flip { mean: number(decoder, &fields, "mean")?, p99: optional(decoder, &fields, "p99")? }
        }
        _ => {
            decoder.wrong_type(node, "a metric with its tolerance in parentheses, RelativeRmse(1e-4) say");
            return None;
        }
    };
    if let Some(why) = metric.beyond_cap() {
        let place = decoder.place(node.span);
        let problem = Diagnostic::error(codes::BAD_TOLERANCE, place, why);
        decoder.report(problem.suggest("what needs a looser one is not tested by it"));
        return None;
    }
    Some(metric)
}

/// Reads a metric as the command line gives it; mistakes name the argument.
///
/// # Errors
/// What is wrong with it.
pub fn parse_metric(text: &str, argument: &str) -> Result<Metric, Diagnostics> {
    let source = Source::argument(argument, text);
    let mut out = Diagnostics::new();
    let node = parse_value(&source, &mut out);
    let found = node.and_then(|node| metric(&mut Decoder::new(&source, &mut out), &node));
    found.filter(|_| !out.has_errors()).ok_or(out)
}

fn number(decoder: &mut Decoder<'_>, fields: &Fields<'_>, name: &str) -> Option<f64> {
    fields.required(decoder, name).and_then(|node| decoder.float(node))
}

/// `None` if the field exists but is not a number.
fn optional(decoder: &mut Decoder<'_>, fields: &Fields<'_>, name: &str) -> Option<Option<f64>> {
    match fields.get(name) {
        None => Some(None),
        Some(node) => decoder.float(node).map(Some),
    }
}

/// A part of what is compared, that may not be larger than a relative error may be.
fn part(decoder: &mut Decoder<'_>, fields: &Fields<'_>, name: &str) -> Option<f64> {
    let node = fields.required(decoder, name)?;
    let value = decoder.float(node)?;
    if (0.0..=Metric::MOST_RMSE).contains(&value) {
        return Some(value);
    }
    let message = format!("`{name}` is {value}, and may be 0 to {}", Metric::MOST_RMSE);
    let place = decoder.place(node.span);
    decoder.report(Diagnostic::error(codes::BAD_TOLERANCE, place, message));
    None
}

pub(super) fn properties(decoder: &mut Decoder<'_>, node: &Node, reason: bool) -> Vec<Spanned<Property>> {
    let items = decoder.list(node).unwrap_or_default();
    let property = |item: &Node| {
        let value = property(decoder, item)?;
        demand_reason(decoder, item, value.is_strict(), reason);
        Some(Spanned { value, span: item.span })
    };
    items.iter().filter_map(property).collect()
}

const PROPERTIES: &[&str] = &[
    "Finite",
    "NonNegative",
    "Range",
    "AlphaOne",
    "UnitLength",
    "Varies",
    "AtMost",
    "Equal",
    "Sum",
    "Mean",
    "CpuReference",
];

fn property(decoder: &mut Decoder<'_>, node: &Node) -> Option<Property> {
    let (name, content) = decoder.variant(node, "a property", PROPERTIES)?;
    match (name, content) {
        ("Finite", None) => Some(Property::Finite),
        ("NonNegative", None) => Some(Property::NonNegative),
        ("AlphaOne", None) => Some(Property::AlphaOne),
        ("Varies", None) => Some(Property::Varies),
        ("Range", Some(content)) => {
            let [low, high] = decoder.floats::<2>(content)?;
            if low.is_nan() || high.is_nan() || low > high {
                let message = format!("no number lies within {low}..{high}");
                let problem = Diagnostic::error(codes::WRONG_CHECK, decoder.place(content.span), message);
                decoder.report(problem.suggest("write the lower bound first"));
                return None;
            }
            Some(Property::Range(low, high))
        }
        ("UnitLength", Some(content)) => {
            let fields = decoder.fields(content, "`UnitLength`", &["within", "or_zero"])?;
            let or_zero = fields.get("or_zero").map_or(Some(false), |node| decoder.bool(node));
            Some(Property::UnitLength { within: part(decoder, &fields, "within")?, or_zero: or_zero? })
        }
        ("AtMost", Some(content)) => {
            let fields = decoder.fields(content, "`AtMost`", &["port", "within"])?;
            Some(Property::AtMost { port: text(decoder, &fields, "port")?, within: part(decoder, &fields, "within")? })
        }
        ("Equal", Some(content)) => {
            let fields = decoder.fields(content, "`Equal`", &["port", "by"])?;
            Some(Property::Equal { port: text(decoder, &fields, "port")?, by: by(decoder, &fields)? })
        }
        ("Sum", Some(content)) => {
            let fields = decoder.fields(content, "`Sum`", &["ports", "by"])?;
            let node = fields.required(decoder, "ports")?;
            let items = decoder.list(node)?;
            if items.is_empty() {
                let place = decoder.place(node.span);
                decoder.report(Diagnostic::error(codes::WRONG_CHECK, place, "this is the sum of no ports"));
                return None;
            }
            let ports = items.iter().map(|item| decoder.text(item).map(str::to_owned));
            Some(Property::Sum { ports: ports.collect::<Option<_>>()?, by: by(decoder, &fields)? })
        }
        ("Mean", Some(content)) => {
            let fields = decoder.fields(content, "`Mean`", &["value", "within"])?;
            let node = fields.required(decoder, "value")?;
            let value = match &node.value {
                Value::Tuple(items) => items.iter().map(|item| decoder.float(item)).collect::<Option<_>>()?,
                _ => vec![decoder.float(node)?],
            };
            Some(Property::Mean { value, within: part(decoder, &fields, "within")? })
        }
        ("CpuReference", Some(content)) => {
            let fields = decoder.fields(content, "`CpuReference`", &["by"])?;
            Some(Property::CpuReference { by: by(decoder, &fields)? })
        }
        _ => {
            decoder.wrong_type(node, "a property with what it needs, Range(0.0, 1.0) say");
            None
        }
    }
}

fn text(decoder: &mut Decoder<'_>, fields: &Fields<'_>, name: &str) -> Option<String> {
    fields.required(decoder, name).and_then(|node| decoder.text(node)).map(str::to_owned)
}

fn by(decoder: &mut Decoder<'_>, fields: &Fields<'_>) -> Option<Metric> {
    fields.required(decoder, "by").and_then(|node| metric(decoder, node))
}

pub(super) fn relations(decoder: &mut Decoder<'_>, node: &Node) -> Vec<Relation> {
    let items = decoder.list(node).unwrap_or_default();
    items.iter().filter_map(|item| relation(decoder, item)).collect()
}

fn relation(decoder: &mut Decoder<'_>, node: &Node) -> Option<Relation> {
    let fields = decoder.fields(node, "a relation", &["about", "runs", "expect", "reason"])?;
    let about = text(decoder, &fields, "about")?;
    let reason = reason(decoder, &fields);
    let runs = fields.required(decoder, "runs")?;
    let runs: Vec<_> = decoder.list(runs)?.iter().map(|node| run(decoder, node)).collect();
    let expected = fields.required(decoder, "expect")?;
    let entries = decoder.map(expected)?;
    if entries.is_empty() || runs.is_empty() {
        let problem =
            Diagnostic::error(codes::EMPTY_RELATION, decoder.place(node.span), "the relation compares nothing");
        decoder.report(problem.suggest("give it other `runs`, and what to `expect` of a port"));
    }
    let expect = entries.into_iter().filter_map(|(port, span, node)| {
        let change = change(decoder, node)?;
        demand_reason(decoder, node, change.is_strict(), reason);
        Some(Expectation { port: port.to_owned(), span, change })
    });
    Some(Relation { about, span: node.span, runs, expect: expect.collect() })
}

/// What another run sets; one that sets nothing is the test's own.
fn run(decoder: &mut Decoder<'_>, node: &Node) -> Vec<Setting> {
    let settings = settings(decoder, node);
    if matches!(&node.value, Value::Map(entries) if entries.is_empty()) {
        let problem = Diagnostic::error(codes::EMPTY_RELATION, decoder.place(node.span), "this run sets nothing");
        decoder.report(problem.suggest("say what is set in it, or leave it out"));
    }
    settings
}

fn change(decoder: &mut Decoder<'_>, node: &Node) -> Option<Change> {
    let known = ["Same", "Scaled", "Shifted", "SumOfRuns", "NoMore", "NoLess", "Differs", "CpuReference"];
    let (name, content) = decoder.variant(node, "a change", &known)?;
    let Some(content) = content else {
        decoder.wrong_type(node, "a change with what it needs, Same(by: Exact) say");
        return None;
    };
    let what = format!("`{name}`");
    match name {
        "Same" | "SumOfRuns" | "CpuReference" => {
            let fields = decoder.fields(content, &what, &["by"])?;
            let by = by(decoder, &fields)?;
            Some(match name {
                "Same" => Change::Same(by),
                "SumOfRuns" => Change::SumOfRuns(by),
                _ => Change::CpuReference(by),
            })
        }
        "Scaled" => {
            let fields = decoder.fields(content, &what, &["factor", "by"])?;
            Some(Change::Scaled(number(decoder, &fields, "factor")?, by(decoder, &fields)?))
        }
        "Shifted" => {
            let fields = decoder.fields(content, &what, &["x", "y", "by"])?;
            let mut pixels = |name: &str| {
                let node = fields.required(decoder, name)?;
                let pixels = decoder.integer(node)?;
                if pixels.unsigned_abs() > u64::from(u16::MAX) {
                    let message = format!("no picture has {pixels} pixels along a side: nothing would be left of it");
                    let problem = Diagnostic::error(codes::VACUOUS_CHECK, decoder.place(node.span), message);
                    decoder.report(problem.suggest("shift it by fewer pixels"));
                    return None;
                }
                i32::try_from(pixels).ok()
            };
            let (x, y) = (pixels("x")?, pixels("y")?);
            Some(Change::Shifted(x, y, by(decoder, &fields)?))
        }
        "Differs" => {
            let fields = decoder.fields(content, &what, &["by_more_than"])?;
            let least = number(decoder, &fields, "by_more_than")?;
            if least.is_nan() || least <= 0.0 {
                let place = decoder.place(node.span);
                let message = format!("what must differ by more than {least} may differ by rounding alone");
                let problem = Diagnostic::error(codes::VACUOUS_CHECK, place, message);
                decoder.report(problem.suggest("say by how much it must differ, 0.01 say"));
            }
            Some(Change::Differs(least))
        }
        _ => {
            let fields = decoder.fields(content, &what, &["within"])?;
            let within = part(decoder, &fields, "within")?;
            Some(if name == "NoMore" { Change::NoMore(within) } else { Change::NoLess(within) })
        }
    }
}
