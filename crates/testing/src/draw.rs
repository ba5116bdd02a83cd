//! Pictures of graphs for tests in Rust.

use std::ops::Range;
use std::sync::Arc;

use tyndall_document::{Diagnostic, Diagnostics, Place};
use tyndall_gpu::FrameOptions;
use tyndall_graph::{PortRef, Roots};
use tyndall_image::Image;
use tyndall_plugin::Registry;
use tyndall_render::{Error, Loaded, Request, Running, Wanted, load, plan};

use crate::picture::Picture;
use crate::session::Session;

/// What a graph draws, and what it is warned of.
#[derive(Debug)]
pub struct Drawn {
    /// Frame by frame, port by port. Channels that mean nothing, and alpha, are left out.
    pub pictures: Vec<Image>,
    /// Those that `tyndall render` prints.
    pub warnings: Diagnostics,
}

impl Session {
    /// Reads and checks a graph and its scene as `tyndall render` does: the passes that it may use, graph and scene, and what
    /// is to be warned of.
    ///
    /// # Errors
    /// Every mistake of the graph and its scene.
    pub fn load(&mut self, request: &Request) -> Result<(Arc<Registry>, Loaded, Diagnostics), Error> {
        let registry = self.registry(&request.graph)?;
        let mut out = Diagnostics::default();
        let Some(loaded) = load(request, &registry, &mut out).filter(|_| !out.has_errors()) else {
            return Err(out.into());
        };
        loaded.warn_of_needs(&registry, &mut out);
        loaded.warn_of_limits(&registry, &mut out);
        Ok((registry, loaded, out))
    }

    /// Draws ports (graph outputs, or `pass.port`) in these frames as `tyndall render` does: nothing that an earlier test has
    /// rendered is used.
    ///
    /// # Errors
    /// Every mistake of the graph and its scene; what the machine cannot do.
    pub fn draw(&mut self, request: &Request, ports: &[&str], frames: Range<u32>) -> Result<Drawn, Error> {
        let (registry, loaded, mut warnings) = self.load(request)?;
        let found = ports.iter().map(|name| loaded.graph.find(name, Place::Argument((*name).to_owned())));
        let found: Vec<PortRef> = found.collect::<Result<_, Diagnostic>>().map_err(Diagnostics::from)?;
        let wanted = Wanted { roots: Roots::Ports(found.clone()), keep: frames.len() > 1, live: &[] };
        let plan = plan(&loaded, wanted)?;
        let mut running = Running::new(&self.gpu, plan, loaded.scene.as_ref(), &registry, &mut self.cache)?;
        let mut pictures = Vec::new();
        for frame in frames {
            running.frame(FrameOptions { frame, ..FrameOptions::default() })?;
            let (executor, plan) = (&running.executor, running.executor.plan());
            for port in found.iter().filter_map(|port| plan.planned(*port)) {
                let picture = Picture::of(&executor.read(port)?, plan.ports[port].class);
                pictures.push(in_single(picture.compared()));
            }
        }
        running.warn_of_unfinished(&mut warnings)?;
        Ok(Drawn { pictures, warnings })
    }
}

fn in_single(Image { width, height, layers, channels, data }: Image<f64>) -> Image {
    Image { width, height, layers, channels, data: data.into_iter().map(|number| number as f32).collect() }
}
