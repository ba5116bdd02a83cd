//! One pass alone, with its inputs from goldens: a change of one pass shows as exactly one failure.

use std::collections::BTreeMap;
use std::sync::Arc;

use tyndall_gpu::PortData;
use tyndall_graph::{Handle, Pass, PlannedPort, PortRef};
use tyndall_render::Error;

use crate::adapter::AdapterClass;
use crate::blame::{Upstream, attribute};
use crate::file::{Property, Tapped};
use crate::golden;
use crate::judge::Judge;
use crate::options::Options;
use crate::outcome::{Outcome, Problem};
use crate::picture::Picture;
use crate::property;
use crate::run::{Ready, find};
use crate::session::Session;

/// Runs each pass that is looked at alone, and judges its ports. What one pass does to another cannot show, as far as
/// there are goldens to feed it: where an input has none, the passes before run along, and what they do wrong is theirs.
pub(crate) fn run(session: &mut Session, ready: &Ready, options: &Options, outcome: &mut Outcome) -> Result<(), Error> {
    let chosen = ready.tapped.iter().filter(|tapped| ready.chosen.contains(&tapped.name));
    let mut passes: Vec<Handle<Pass>> = chosen.map(|tapped| tapped.port.pass).collect();
    passes.dedup();
    let (all, mut upstream) = (Upstream::of(&ready.plan), Upstream::nothing(&ready.plan));
    for pass in passes {
        for frame in ready.file.frames.iter().filter(|frame| options.looks_at(**frame)) {
            let graph_pass = ready.loaded.graph.pass(pass);
            if *frame > 0 && graph_pass.descriptor().remembers() {
                let name = &graph_pass.name;
                outcome.left_out.push(format!("`{name}` in frame {frame}: it reads what was in the frame before"));
                continue;
            }
            match inputs(ready, pass, *frame) {
                Ok(inputs) => {
                    if let Some(position) = ready.plan.position(pass) {
                        let fed = ready.inputs(pass).into_iter().map(|(_, port)| port);
                        let rendered = fed.filter(|port| !inputs.contains_key(port));
                        let rendered: Vec<Handle<PlannedPort>> =
                            rendered.filter_map(|port| ready.plan.planned(port)).collect();
                        upstream.ran_with(&ready.plan, &all, position, &rendered);
                    }
                    run_pass(session, ready, (pass, *frame), &inputs, options, outcome)?;
                }
                Err(why) => {
                    let name = &ready.loaded.graph.pass(pass).name;
                    outcome.problems.push(Problem::NotIsolated(format!("`{name}`: {why}")));
                }
            }
        }
    }
    if !ready.file.relations.is_empty() {
        outcome.left_out.push("relations compare runs of the whole graph: --isolate does not ask them".to_owned());
    }
    attribute(&ready.plan, &upstream, outcome);
    Ok(())
}

fn run_pass(
    session: &mut Session,
    ready: &Ready,
    (pass, frame): (Handle<Pass>, u32),
    inputs: &BTreeMap<PortRef, Arc<PortData>>,
    options: &Options,
    outcome: &mut Outcome,
) -> Result<(), Error> {
    let of_pass = |tapped: &&Tapped| tapped.port.pass == pass && ready.chosen.contains(&tapped.name);
    let tapped: Vec<_> = ready.tapped.iter().filter(of_pass).collect();
    // What is not given is rendered, and judged with: a reference on the CPU is asked about what the pass was fed.
    let fed = ready.inputs(pass).into_iter().map(|(_, port)| port).filter(|port| !inputs.contains_key(port));
    let ports: Vec<PortRef> = tapped.iter().map(|tapped| tapped.port).chain(fed).collect();
    let mut rendered = session.render_alone(&ready.loaded, &ready.registry, &ports, inputs, frame)?;
    rendered.ports.extend(inputs.iter().map(|(port, data)| (*port, data.clone())));
    let judging = session.judging();
    let judge = Judge { ready, options, adapter: AdapterClass::of(session.gpu()), answers: &session.answers };
    for tapped in tapped {
        // A property about a port that is neither the pass's own nor fed to it is for the whole graph.
        let (asked, left_out): (Vec<Property>, Vec<Property>) =
            tapped.properties.iter().cloned().partition(|property| {
                let mut named = property.ports().iter().map(|name| find(&ready.loaded.graph, name));
                named.all(|port| port.is_some_and(|port| rendered.ports.contains_key(&port)))
            });
        outcome.left_out.extend(left_out.iter().map(|property| {
            format!("{} {} is about a port that its pass does not read", tapped.name, property::name(property))
        }));
        let mut port = judge.port(&Tapped { properties: asked, ..tapped.clone() }, &rendered);
        // Nothing was rendered upstream, so nothing can be said of when the golden was made.
        port.stale.clear();
        for check in &mut port.checks {
            check.also_on.retain(|other| *other != port.name && !given(ready, inputs, other));
        }
        outcome.ports.push(port);
    }
    session.judged(judging);
    Ok(())
}

/// The port of this name was given.
fn given(ready: &Ready, inputs: &BTreeMap<PortRef, Arc<PortData>>, name: &str) -> bool {
    inputs.keys().any(|port| ready.loaded.graph.port_name(*port) == name)
}

/// The inputs of a pass, from goldens.
fn inputs(ready: &Ready, pass: Handle<Pass>, frame: u32) -> Result<BTreeMap<PortRef, Arc<PortData>>, String> {
    let mut inputs = BTreeMap::new();
    for (_, port) in ready.inputs(pass) {
        if let Some(data) = from_golden(ready, port, frame)? {
            inputs.insert(port, Arc::new(data));
        }
    }
    Ok(inputs)
}

/// A port as its golden has it. `None` where the test asks for no golden of it, or where it is so large that its golden
/// holds only a part of it: then what writes it runs too.
fn from_golden(ready: &Ready, port: PortRef, frame: u32) -> Result<Option<PortData>, String> {
    let name = ready.loaded.graph.port_name(port);
    if !ready.tapped.iter().any(|tapped| tapped.port == port && tapped.golden.is_some()) {
        return Ok(None);
    }
    let planned = ready.plan.planned(port).ok_or_else(|| format!("its input `{name}` is not planned"))?;
    let resource = *ready.plan.resource(planned);
    let scalar = resource.scalar(ready.plan.port_descriptor(planned));
    let blank = PortData { resource, scalar, bytes: vec![0; resource.bytes() as usize] };
    let like = Picture::of(&blank, ready.plan.ports[planned].class);
    if !like.fits_golden() {
        return Ok(None);
    }
    let key = ready.key(&name, frame);
    let golden = golden::read(&ready.file.goldens(), &key, &ready.records, &like)
        .map_err(|missing| format!("its input `{name}` has no golden ({missing})"))?;
    if golden.image.data.len() != like.image.data.len() {
        return Err(format!("the golden of its input `{name}` is of another size"));
    }
    Ok(Some(PortData::from_numbers(blank.resource, blank.scalar, golden.image.data)))
}
