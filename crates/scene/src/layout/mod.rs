//! Structs as WGSL lays them out: the [`wgsl_struct!`](crate::wgsl_struct) macro that declares them, and those of
//! `shaders/scene.wgsl`.

mod scene;

use bytemuck::Pod;
use glam::DVec3;

pub use self::scene::*;

/// A type whose bytes are those of a type of WGSL.
pub trait Layout: Pod {
    /// WGSL's name of the type.
    const NAME: &'static str;
    /// Of a struct its members, in order.
    const MEMBERS: &'static [Member] = &[];
}

/// A member of a struct.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Member {
    /// Its name; one that begins with `pad` only fills a gap, and WGSL need not name it.
    pub name: &'static str,
    /// Bytes from the start of the struct.
    pub offset: usize,
    /// WGSL's name of its type.
    pub ty: &'static str,
}

/// How a buffer of scene data is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One value.
    Record(Type),
    /// A [`Header`], and elements from its end on.
    List(Type),
    /// Anything else: shaders are not held against it.
    Bytes,
}

/// A type of WGSL as Rust has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Type {
    /// WGSL's name.
    pub name: &'static str,
    /// Bytes.
    pub size: usize,
    /// Of a struct its members, in order.
    pub members: &'static [Member],
}

impl Shape {
    /// One `T`.
    pub const fn record<T: Layout>() -> Shape {
        Shape::Record(Type::of::<T>())
    }

    /// Elements of type `T`.
    pub const fn list<T: Layout>() -> Shape {
        Shape::List(Type::of::<T>())
    }
}

impl Type {
    /// `T` as WGSL has it.
    pub const fn of<T: Layout>() -> Type {
        Type { name: T::NAME, size: size_of::<T>(), members: T::MEMBERS }
    }
}

macro_rules! plain {
    ($($ty:ty = $name:literal),* $(,)?) => {
        $(impl Layout for $ty { const NAME: &'static str = $name; })*
    };
}

plain! {
    u32 = "u32", i32 = "i32", f32 = "f32",
    [u32; 2] = "vec2<u32>", [i32; 2] = "vec2<i32>", [f32; 2] = "vec2<f32>",
    [u32; 3] = "vec3<u32>", [i32; 3] = "vec3<i32>", [f32; 3] = "vec3<f32>",
    [u32; 4] = "vec4<u32>", [i32; 4] = "vec4<i32>", [f32; 4] = "vec4<f32>",
    [[f32; 4]; 3] = "mat3x4<f32>", [[f32; 4]; 4] = "mat4x4<f32>",
    [Lobe; 2] = "array<Lobe, 2>",
}

/// Declares a struct of a buffer: `#[repr(C)]`, plain bytes, and with the [`Layout`] that shaders are held against.
///
/// WGSL aligns `vec3<f32>` and `vec4<f32>` to 16 bytes: the Rust struct fills what lies between with members whose names
/// begin with `pad`. The crate that uses this depends on `bytemuck` with the feature `derive`.
///
/// ```
/// tyndall_scene::wgsl_struct! {
///     /// `struct Flame { position: vec3<f32>, width: f32 }` of the plugin's WGSL.
///     pub struct Flame {
///         /// m, world.
///         pub position: [f32; 3],
///         /// m.
///         pub width: f32,
///     }
/// }
/// ```
#[macro_export]
macro_rules! wgsl_struct {
    ($(#[$doc:meta])* $visible:vis struct $name:ident { $($(#[$member_doc:meta])* $member_visible:vis $member:ident: $ty:ty,)* }) => {
        $(#[$doc])*
        #[repr(C)]
        #[derive(Clone, Copy, Debug, Default, PartialEq, ::bytemuck::Pod, ::bytemuck::Zeroable)]
        $visible struct $name { $($(#[$member_doc])* $member_visible $member: $ty,)* }

        impl $crate::layout::Layout for $name {
            const NAME: &'static str = stringify!($name);
            const MEMBERS: &'static [$crate::layout::Member] = &[$($crate::layout::Member {
                name: stringify!($member),
                offset: ::std::mem::offset_of!($name, $member),
                ty: <$ty as $crate::layout::Layout>::NAME,
            }),*];
        }
    };
}

/// A vector in single precision.
pub fn floats(v: DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
}
