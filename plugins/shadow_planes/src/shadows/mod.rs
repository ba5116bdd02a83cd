//! What passes need to know where along a view ray a light is hidden: `shadow_lights`, `shadow_slices`,
//! `shadow_crossings` and `shadow_edges` of `shadow_data.wgsl`.
//!
//! A point of a ray is in shadow where there is a triangle between it and the light. Along the ray the number of such
//! triangles changes where the ray passes behind an edge that has more triangles on one side than on the other, as the
//! light sees it (or where the ray meets a triangle, and there it ends). So the silhouettes of the casters, sorted by the
//! angle about the axis from light to eye, and the number at the eye are all that is needed, and the count is exact
//! whatever overlaps, nests, intersects or is open. `shadows.wgsl` walks them.

mod eye;
mod layout;
mod silhouette;
mod slices;
mod spans;

use glam::DVec3;
use tyndall_shaders::shadows::{Source, UNSEEN};

use self::eye::{AtEye, EdgesAtEye};
use self::silhouette::{Casters, SilhouetteEdge};
use self::slices::{LightFrame, PlacedEdge};
use tyndall_plugin::scene::layout::Shape;
use tyndall_plugin::scene::model::LightKind;
use tyndall_plugin::scene::{Buffers, Encoder, FrameLight, Moment, Part, Scene, SceneData};

use self::layout::{ShadowCrossing, ShadowEdge, ShadowLight};

/// The scene data that are worked out here.
pub(crate) fn data() -> SceneData {
    let items = vec![
        ("shadow_lights", Shape::list::<ShadowLight>()),
        ("shadow_slices", Shape::list::<u32>()),
        ("shadow_crossings", Shape::list::<ShadowCrossing>()),
        ("shadow_edges", Shape::list::<ShadowEdge>()),
    ];
    SceneData::kept(items, &[Part::Camera, Part::Lights, Part::Geometry], |scene| Box::new(Shadows::new(scene)))
}

/// What is kept from frame to frame.
#[derive(Debug, Default)]
struct Shadows {
    casters: Casters,
    /// World.
    positions: Vec<DVec3>,
    lights: Vec<Lit>,
}

/// A light and the casters as it sees them: that does not change with the eye.
#[derive(Debug)]
struct Lit {
    source: Source,
    facing: Vec<i8>,
    silhouette: Vec<SilhouetteEdge>,
}

impl Shadows {
    fn new(scene: &Scene) -> Shadows {
        Shadows { casters: Casters::of(scene), ..Default::default() }
    }

    fn lists(&mut self, Moment { frame, .. }: &Moment<'_>, positions: Vec<DVec3>) -> Lists {
        if positions != self.positions {
            self.positions = positions;
            self.lights.clear();
        }
        let eye = frame.camera.position.as_vec3().as_dvec3();
        self.lights.truncate(frame.lights.len());
        let edges_at_eye = EdgesAtEye::of(eye, UNSEEN * frame.camera.nearest, &self.positions, &self.casters.triangles);
        let mut lists = Lists::default();
        for (index, light) in frame.lights.iter().enumerate() {
            let source = source(light);
            if self.lights.get(index).is_none_or(|lit| lit.source != source) {
                let facing = self.casters.facing(&self.positions, source);
                let lit = Lit { source, silhouette: self.casters.silhouette(&facing), facing };
                self.lights.truncate(index);
                self.lights.push(lit);
            }
            let share = (slices::CROSSINGS_MAX - lists.crossings.len()) / (frame.lights.len() - index);
            let light = self.append(index, eye, &edges_at_eye, share, &mut lists);
            lists.lights.push(light);
        }
        lists
    }

    /// A light, whose edges, slices and crossings, about so many at most, the lists grow by.
    fn append(
        &self,
        light: usize,
        eye: DVec3,
        edges_at_eye: &EdgesAtEye,
        most: usize,
        lists: &mut Lists,
    ) -> ShadowLight {
        let Lit { source, facing, silhouette } = &self.lights[light];
        let Some(frame) = LightFrame::new(*source, eye) else { return ShadowLight::default() };
        let places: Vec<DVec3> = self.positions.iter().map(|position| frame.place(*position)).collect();
        let at_eye = AtEye::of(&frame, (&self.positions, &places), &self.casters.triangles, facing, edges_at_eye);
        let passes_eye = |edge: &SilhouetteEdge| {
            edges_at_eye.touches(eye, edge.vertices.map(|vertex| self.positions[vertex as usize]))
        };
        let seen = silhouette.iter().filter(|edge| !passes_eye(edge));
        let placed = seen.filter_map(|edge| PlacedEdge::of(edge, &places));
        let placed: Vec<PlacedEdge> = placed.chain(at_eye.touching).collect();
        let (borders, spans) = slices::lay_out(&frame, &placed, lists.edges.len() as u32, most);
        let first_bin = lists.starts.len() as u32;
        slices::sort(&borders, &spans, &mut lists.starts, &mut lists.crossings);
        lists.edges.extend(placed.iter().map(PlacedEdge::encode));
        let bins = borders.bins.len() as u32 - 1;
        ShadowLight { first_bin, bins, ..frame.encode(at_eye.depth) }
    }
}

impl Encoder for Shadows {
    fn encode(&mut self, moment: &Moment<'_>, data: &mut Buffers<'_>) {
        let lists = self.lists(moment, moment.positions().collect());
        data.set_list("shadow_lights", lists.lights);
        data.set_list("shadow_slices", lists.starts);
        data.set_list("shadow_crossings", lists.crossings);
        data.set_list("shadow_edges", lists.edges);
    }
}

/// What becomes the scene data.
#[derive(Default)]
struct Lists {
    lights: Vec<ShadowLight>,
    /// Of bins and slices.
    starts: Vec<u32>,
    crossings: Vec<ShadowCrossing>,
    edges: Vec<ShadowEdge>,
}

/// As single precision has it, so that passes and this module speak of the same light.
fn source(light: &FrameLight) -> Source {
    match light.kind {
        LightKind::Directional => Source::Along(light.direction.as_vec3().as_dvec3().normalize()),
        LightKind::Point | LightKind::Spot { .. } => Source::At(light.position.as_vec3().as_dvec3()),
    }
}
