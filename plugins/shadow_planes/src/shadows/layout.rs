//! The structs of `shadow_data.wgsl`.

use tyndall_plugin::scene::wgsl_struct;

wgsl_struct! {
    /// `ShadowLight`.
    pub(crate) struct ShadowLight {
        /// Unit vector, world.
        pub across: [f32; 3],
        /// 1/distance of the light from the eye, 1/m; of a directional light 0.
        pub nearness: f32,
        /// Unit vector, world.
        pub upward: [f32; 3],
        /// Triangles between the light and the eye, without those that touch it.
        pub depth_at_eye: i32,
        /// Unit vector, world, from the light to the eye.
        pub axis: [f32; 3],
        /// Among the shadow slices.
        pub first_bin: u32,
        /// Equal parts of the turn about the axis.
        pub bins: u32,
        /// 0.
        pub pad0: u32,
        /// 0.
        pub pad1: u32,
        /// 0.
        pub pad2: u32,
    }
}

/// An edge in a slice: the bits of n/r at most, in single precision, and its number among the shadow edges.
pub(crate) type ShadowCrossing = [u32; 2];

wgsl_struct! {
    /// `ShadowEdge`.
    pub(crate) struct ShadowEdge {
        /// m, in the frame of the light; then triangles beyond it less those before it, of a triangle that touches the eye the
        /// other way round.
        pub a: [f32; 4],
        /// m, in the frame of the light; then where the axis meets the plane of a triangle that touches the eye, m from the eye, below 0 before it; else 0.
        pub b: [f32; 4],
    }
}
