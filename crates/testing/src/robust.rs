//! The same graph in another order, with other memory, and again: every port must come out the same, bit by bit.

use tyndall_gpu::PortData;
use tyndall_graph::PortRef;
use tyndall_render::Error;

use crate::options::Options;
use crate::outcome::Outcome;
use crate::run::Ready;
use crate::session::{Rendered, Session};

/// Renders in every other way that is asked for.
///
/// A port that is looked at lives to the end of the frame, so nothing shares its memory. Each way is therefore
/// rendered twice: with every tapped port, and with the graph's outputs alone, so that all others share.
pub(crate) fn run(
    session: &mut Session,
    ready: &Ready,
    own: &[Rendered],
    options: &Options,
    outcome: &mut Outcome,
) -> Result<(), Error> {
    let outputs = final_ports(ready, own);
    let tapped: Vec<PortRef> = ready.tapped.iter().map(|tapped| tapped.port).collect();
    for (name, variation) in options.robustness.variations() {
        outcome.variations += 1;
        let mut found: Vec<Option<String>> = vec![None; own.len()];
        for ports in [&tapped, &outputs] {
            let other = session.render(&ready.loaded, &ready.registry, ports, &ready.file.frames, variation)?;
            for ((own, other), found) in own.iter().zip(&other).zip(&mut found) {
                *found = found.take().or_else(|| differing(ready, &name, own, other));
            }
        }
        for line in found.into_iter().flatten() {
            if !outcome.robustness.contains(&line) {
                outcome.robustness.push(line);
            }
        }
    }
    Ok(())
}

/// The tapped ports that no other pass reads: what is left when every other port may share its memory.
fn final_ports(ready: &Ready, own: &[Rendered]) -> Vec<PortRef> {
    let plan = &ready.plan;
    let is_read_by = |pass, port| plan.sources(pass).iter().any(|source| *source == Some(port));
    let is_read = |port| plan.passes.handles().any(|pass| is_read_by(pass, port));
    let rendered = own.iter().flat_map(|rendered| rendered.ports.keys());
    let mut ports: Vec<PortRef> =
        rendered.filter(|port| plan.planned(**port).is_some_and(|planned| !is_read(planned))).copied().collect();
    ports.sort();
    ports.dedup();
    ports
}

/// The first port that differs, in the order in which passes run: what follows from it adds nothing.
fn differing(ready: &Ready, name: &str, own: &Rendered, other: &Rendered) -> Option<String> {
    let mut ports: Vec<&PortRef> = other.ports.keys().collect();
    ports.sort_by_key(|port| ready.plan.planned(**port));
    ports.into_iter().find_map(|port| {
        let (a, b) = (own.ports.get(port)?, other.ports.get(port)?);
        let unordered = ready.loaded.graph.port(*port).unordered;
        let (a, b) = (comparable(a, unordered), comparable(b, unordered));
        let count = a.iter().zip(&b).filter(|(a, b)| a != b).count();
        let port = ready.loaded.graph.port_name(*port);
        let frame = if ready.file.frames.len() > 1 { format!(" in frame {}", own.frame) } else { String::new() };
        (a != b).then(|| format!("`{port}` came out different{frame} {name}: {count} of {} numbers", a.len()))
    })
}

/// The bytes of every number; an unordered list sorted by its elements.
fn comparable(data: &PortData, unordered: bool) -> Vec<&[u8]> {
    let size = data.scalar.bytes();
    if !unordered {
        return data.bytes.chunks(size).collect();
    }
    let mut elements: Vec<&[u8]> = data.bytes.chunks(size * data.channels() as usize).collect();
    elements.sort_unstable();
    elements.into_iter().flat_map(|element| element.chunks(size)).collect()
}
