//! One pass alone, with its inputs from goldens: a change of one pass shows as exactly one failure.

use std::collections::BTreeMap;
use std::sync::Arc;

use tyndall_gpu::PortData;
use tyndall_graph::descriptor::Role;
use tyndall_graph::{PortRef, Resource};
use tyndall_render::Error;

use crate::adapter::AdapterClass;
use crate::golden;
use crate::judge::Judge;
use crate::options::Options;
use crate::outcome::{Outcome, Problem, State};
use crate::picture::Picture;
use crate::run::Ready;
use crate::session::Session;

/// Runs each pass that is looked at alone, and judges its ports. What one pass does to another cannot show: every
/// failure is that of its own pass.
pub(crate) fn run(session: &mut Session, ready: &Ready, options: &Options, outcome: &mut Outcome) -> Result<(), Error> {
    let mut passes: Vec<u32> = ready.tapped.iter().map(|tapped| tapped.port.pass).collect();
    passes.dedup();
    for pass in passes {
        for frame in ready.file.frames.iter().filter(|frame| options.looks_at(**frame)) {
            match inputs(ready, pass, *frame) {
                Ok(inputs) => run_pass(session, ready, (pass, *frame), &inputs, options, outcome)?,
                Err(why) => {
                    let name = &ready.loaded.graph.pass(pass).name;
                    outcome.problems.push(Problem::NotIsolated(format!("`{name}`: {why}")));
                }
            }
        }
    }
    Ok(())
}

fn run_pass(
    session: &mut Session,
    ready: &Ready,
    (pass, frame): (u32, u32),
    inputs: &BTreeMap<PortRef, Arc<PortData>>,
    options: &Options,
    outcome: &mut Outcome,
) -> Result<(), Error> {
    let tapped: Vec<_> = ready.tapped.iter().filter(|tapped| tapped.port.pass == pass).collect();
    // What is not given is rendered, and judged with: a reference on the CPU is asked about what the pass was fed.
    let fed = ready.inputs(pass).into_iter().map(|(_, port)| port).filter(|port| !inputs.contains_key(port));
    let ports: Vec<PortRef> = tapped.iter().map(|tapped| tapped.port).chain(fed).collect();
    let mut rendered = session.render_alone(&ready.loaded, &ready.registry, &ports, inputs, frame)?;
    rendered.ports.extend(inputs.iter().map(|(port, data)| (*port, data.clone())));
    let judging = session.judging();
    let judge = Judge { ready, options, adapter: AdapterClass::of(session.gpu()), answers: &session.answers };
    for tapped in tapped {
        let mut port = judge.port(tapped, &rendered);
        // Nothing was rendered upstream, so nothing can be said of when the golden was made; and a property about a
        // port that is no input is for the whole graph.
        port.stale.clear();
        port.checks.retain(|check| check.judgement.passed || check.also_on.is_empty());
        if !port.passed() {
            port.state = State::Guilty;
        }
        outcome.ports.push(port);
    }
    session.judged(judging);
    Ok(())
}

/// The inputs of a pass, from goldens.
fn inputs(ready: &Ready, pass: u32, frame: u32) -> Result<BTreeMap<PortRef, Arc<PortData>>, String> {
    let descriptor = ready.loaded.graph.pass(pass).descriptor();
    if frame > 0 && descriptor.ports.iter().any(|port| matches!(port.role, Role::History(_))) {
        return Err(format!("in frame {frame} it reads the frame before, of which there is no golden"));
    }
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
    let blank = blank(ready.plan.resource(planned));
    let like = Picture::of(&blank, ready.plan.ports[planned as usize].class);
    if !like.fits_golden() {
        return Ok(None);
    }
    let key = ready.key(&name, frame);
    let golden = golden::read(&ready.file.goldens(), &key, &ready.records, &like)
        .map_err(|missing| format!("its input `{name}` has no golden ({missing})"))?;
    if golden.image.data.len() != like.image.data.len() {
        return Err(format!("the golden of its input `{name}` is of another size"));
    }
    Ok(Some(PortData { data: golden.image.data, ..blank }))
}

/// What a port of this resource reads as, all numbers 0.
fn blank(resource: &Resource) -> PortData {
    let (width, height, layers, channels, is_buffer) = match *resource {
        Resource::Texture { format, width, height, depth_or_layers, .. } => {
            (width, height, depth_or_layers, format.channels(), false)
        }
        Resource::Buffer { bytes, stride } => {
            let channels = (stride / 4).max(1);
            ((bytes / 4) as u32 / channels, 1, 1, channels, true)
        }
    };
    let count = width as usize * height as usize * layers as usize * channels as usize;
    let is_image = matches!(resource, Resource::Texture { dimension: tyndall_graph::descriptor::Dimension::D2, .. });
    PortData { width, height, layers, channels, is_buffer, is_image, data: vec![0.0; count] }
}
