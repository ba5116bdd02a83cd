//! Blessing: what was rendered becomes what is expected.

use std::collections::BTreeMap;
use std::path::Path;

use tyndall_graph::MadeFrom;

use crate::adapter::AdapterClass;
use crate::blame::Upstream;
use crate::golden::{self, NotWritten, Record, Records};
use crate::options::Options;
use crate::outcome::{GOLDEN, Outcome, PortOutcome, Problem, State};
use crate::picture::Picture;
use crate::run::Ready;
use crate::session::Rendered;

/// Writes the goldens that are missing or different, and drops those that no tap claims. A golden is written only where
/// everything else that the test says of its port holds. Of one that is stale and still right, what it was made from is
/// recorded anew, and its picture stays as it is.
pub(crate) fn run(
    ready: &Ready,
    rendered: &[Rendered],
    adapter: AdapterClass,
    options: &Options,
    outcome: &mut Outcome,
) {
    let folder = ready.file.goldens();
    let mut records = ready.records.clone();
    let mut blessed = Vec::new();
    let refused = refused(ready, outcome);
    for port in outcome.ports.iter_mut().filter(|port| ready.chosen.contains(&port.name)) {
        let Some(at) = port.checks.iter().position(|check| check.what == GOLDEN) else { continue };
        let judged = &port.checks[at].judgement;
        if judged.passed && port.stale.is_empty() {
            continue;
        }
        if let Some(why) = refused.get(&port.pass) {
            outcome.problems.push(Problem::NotBlessed(format!("{}: {why}", port.name)));
            continue;
        }
        let before = records.get(&port.key);
        if let Some(before) = before.filter(|before| before.adapter != adapter && !options.bless_any_adapter) {
            let (then, now) = (before.adapter.name(), adapter.name());
            let why = format!(
                "{}: its golden was made on a {then} adapter, and this one is {now}: say --any-adapter",
                port.name
            );
            outcome.problems.push(Problem::NotBlessed(why));
            continue;
        }
        let Some(picture) = &port.actual else { continue };
        if let Some(metric) = port.metric.filter(|metric| !metric.judge(picture, picture).passed) {
            let why = format!("{}: it would not pass against itself by {metric}: it contains NaN", port.name);
            outcome.problems.push(Problem::NotBlessed(why));
            continue;
        }
        let frame = rendered.iter().find(|rendered| rendered.frame == port.frame);
        let made_from = frame.and_then(|frame| {
            let tapped = ready.tapped.iter().find(|tapped| tapped.name == port.name)?;
            frame.made_from.get(&tapped.port).copied().flatten()
        });
        let written = match judged.passed {
            true => record_anew(&folder, port, picture, made_from, &mut records),
            false => write_picture(&folder, port, picture, (adapter, made_from), &mut records),
        };
        match written {
            Ok(line) => {
                blessed.push(line);
                port.checks[at].judgement.passed = true;
                port.stale.clear();
                if port.passed() {
                    port.state = State::Passed;
                }
            }
            Err(why) => outcome.problems.push(match why.is_of_machine {
                true => Problem::Machine(format!("{}: {}", port.name, why.what)),
                false => Problem::NotBlessed(format!("{}: {}", port.name, why.what)),
            }),
        }
    }
    // Nothing goes before what takes its place is there.
    let all_blessed =
        !outcome.problems.iter().any(|problem| matches!(problem, Problem::NotBlessed(_) | Problem::Machine(_)));
    if options.tap.is_none() && all_blessed {
        drop_orphans(ready, &mut records, outcome, &mut blessed);
    }
    outcome.blessed = blessed;
}

/// Records what a golden that is still right was made from now; its picture stays.
fn record_anew(
    folder: &Path,
    port: &PortOutcome,
    picture: &Picture,
    made_from: Option<MadeFrom>,
    records: &mut Records,
) -> Result<String, NotWritten> {
    let path = folder.join(golden::file_name(&port.key, picture.class));
    let adapter = records.get(&port.key).map_or(AdapterClass::Other, |before| before.adapter);
    records.set(&port.key, Record::new(&path, adapter, made_from)?);
    records.write(folder)?;
    Ok(format!(
        "recorded anew {}: {} had changed, and the picture is still right",
        path.display(),
        port.stale.join(", ")
    ))
}

/// Writes a picture as the golden of a port.
fn write_picture(
    folder: &Path,
    port: &PortOutcome,
    picture: &Picture,
    (adapter, made_from): (AdapterClass, Option<MadeFrom>),
    records: &mut Records,
) -> Result<String, NotWritten> {
    let after = picture.figures();
    let golden = port.checks.iter().find(|check| check.what == GOLDEN).map(|check| check.judgement.figures.as_str());
    let (figures, content) = match &port.expected {
        Some(before) => (golden.unwrap_or_default(), format!("before: {}\n    after:  {after}", before.figures())),
        None => ("new", after),
    };
    let path = golden::write(folder, &port.key, picture)?;
    records.set(&port.key, Record::new(&path, adapter, made_from)?);
    records.write(folder)?;
    let stale = match port.stale[..] {
        [] => String::new(),
        _ => format!("; {} had changed", port.stale.join(", ")),
    };
    Ok(format!("blessed {}: {figures}{stale}\n    {content}", path.display()))
}

/// Passes whose ports are not to be blessed, each with the reason: what is wrong for another reason than its golden does
/// not become right by it, and neither does what is made from it.
fn refused(ready: &Ready, outcome: &Outcome) -> BTreeMap<String, String> {
    let plan = &ready.plan;
    // A golden that differs and is not to be blessed now is wrong like anything else; one that is missing says nothing.
    let wrong = |port: &&PortOutcome| match ready.chosen.contains(&port.name) {
        true => port.checks.iter().any(|check| check.what != GOLDEN && !check.judgement.passed),
        false => port.divergences().next().is_some(),
    };
    let ports = outcome.ports.iter().filter(wrong).map(|port| port.pass.clone());
    let relations = outcome.relations.iter().filter(|relation| !relation.judgement.passed);
    let mut refused: BTreeMap<String, String> = ports
        .chain(relations.map(|relation| relation.pass.clone()))
        .map(|pass| (pass, "something else does not hold of its pass".to_owned()))
        .collect();
    let upstream = Upstream::of(plan);
    for position in plan.passes.handles() {
        let name = |position| plan.pass_name(position);
        let before = upstream.passes(plan, position).map(name).find(|pass| refused.contains_key(*pass));
        if let Some(before) = before.map(str::to_owned) {
            let why = format!("it is made from what `{before}` writes, of which something else does not hold");
            refused.entry(name(position).to_owned()).or_insert(why);
        }
    }
    if !outcome.robustness.is_empty() {
        let all = plan.passes.handles().map(|position| plan.pass_name(position).to_owned());
        refused
            .extend(all.map(|pass| (pass, "not every port comes out the same when it is rendered again".to_owned())));
    }
    refused
}

fn drop_orphans(ready: &Ready, records: &mut Records, outcome: &mut Outcome, blessed: &mut Vec<String>) {
    let folder = ready.file.goldens();
    let claimed = crate::run::claimed(ready);
    for orphan in golden::orphans(&folder, &claimed).into_iter().filter(|path| golden::may_be_dropped(path)) {
        match std::fs::remove_file(&orphan) {
            Ok(()) => blessed.push(format!("deleted {}: no tap claims it", orphan.display())),
            Err(error) => outcome.problems.push(Problem::NotBlessed(format!("{}: {error}", orphan.display()))),
        }
    }
    let keys: Vec<String> = claimed.iter().filter_map(|name| Some(name.rsplit_once('.')?.0.to_owned())).collect();
    let before = records.clone();
    records.retain(&|key| keys.iter().any(|kept| kept == key));
    if *records != before
        && let Err(why) = records.write(&folder)
    {
        outcome.problems.push(Problem::NotBlessed(why.what));
    }
}
