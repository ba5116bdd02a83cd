//! The Rust structs against the WGSL structs that shaders read.

use std::collections::BTreeMap;
use std::mem::{offset_of, size_of};

use naga::{Module, TypeInner};
use tyndall_scene::layout::{
    Ambient, Background, Camera, CosineLobe, Header, HeightFog, Light, Lobe, Material, Medium, Object, OccluderNode,
    Phase, PhaseTable, ShadowCrossing, ShadowEdge, ShadowLight, Texture, Vertex,
};

/// Offset of each member, and size, of each struct of the file.
fn wgsl() -> BTreeMap<String, (Vec<(String, usize)>, usize)> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shaders/scene.wgsl");
    let source = std::fs::read_to_string(path).expect("shaders/scene.wgsl");
    let module: Module = naga::front::wgsl::parse_str(&source).expect("scene.wgsl is valid");
    let mut structs = BTreeMap::new();
    for (_, kind) in module.types.iter() {
        if let (Some(name), TypeInner::Struct { members, span }) = (&kind.name, &kind.inner) {
            let member = |m: &naga::StructMember| (m.name.clone().unwrap_or_default(), m.offset as usize);
            structs.insert(name.clone(), (members.iter().map(member).collect(), *span as usize));
        }
    }
    structs
}

macro_rules! same {
    ($structs:expr, $kind:ident { $($field:ident),* }) => {
        let expected: Vec<(String, usize)> =
            vec![$((stringify!($field).to_owned(), offset_of!($kind, $field))),*];
        let (members, size) = &$structs[stringify!($kind)];
        assert_eq!(*members, expected, stringify!($kind));
        assert_eq!(*size, size_of::<$kind>(), stringify!($kind));
    };
}

#[test]
fn structs_match_the_shader() {
    let structs = wgsl();
    same!(structs, Camera { position, padding, right, pad0, up, pad1, forward, pad2 });
    same!(structs, Medium { extinction, pad0, scattering, pad1 });
    same!(structs, Lobe { rho, scale, squared, mu_squared });
    same!(structs, Phase { legendre, lobe_count, pad0, pad1, pad2, lobes });
    same!(
        structs,
        Light { position, kind, intensity, radius, direction, exponent, cos_cutoff, sin_cutoff, lobe, pad0 }
    );
    same!(structs, CosineLobe { exponent, cos_cutoff, is_spot, pad0 });
    same!(structs, Vertex { position, u, normal, v });
    same!(structs, Object { material, casts_shadow, pad0, pad1 });
    same!(structs, Material { diffuse, texture, specular, shininess, lobe, pad0, pad1, pad2 });
    same!(structs, Texture { offset, width, height, wrap });
    same!(structs, ShadowLight { across, nearness, upward, depth_at_eye, axis, first_bin, bins, pad0, pad1, pad2 });
    same!(structs, OccluderNode { low, first, high, triangles, skip, pad0, pad1, pad2 });
    same!(structs, ShadowCrossing { nearest, edge });
    same!(structs, ShadowEdge { a, step, b, away });
    same!(structs, HeightFog { base_height, falloff, pad0, pad1 });
    for (name, expected) in [("Background", size_of::<Background>()), ("Ambient", size_of::<Ambient>())] {
        let (members, size) = &structs[name];
        assert_eq!((members.as_slice(), *size), ([("radiance".to_owned(), 0)].as_slice(), expected), "{name}");
    }
    let (members, _) = &structs["PhaseTable"];
    let expected = [
        ("count", offset_of!(PhaseTable, count)),
        ("total", offset_of!(PhaseTable, total)),
        ("pad0", offset_of!(PhaseTable, pad0)),
        ("pad1", offset_of!(PhaseTable, pad1)),
        ("items", size_of::<PhaseTable>()),
    ];
    assert_eq!(*members, expected.map(|(name, offset)| (name.to_owned(), offset)));
}

#[test]
fn lists_start_with_the_header() {
    let structs = wgsl();
    for name in ["Lights", "Vertices", "Triangles", "Objects", "Materials", "Textures", "CosineLobes"] {
        let (members, _) = &structs[name];
        let expected = [("count", 0), ("pad0", 4), ("pad1", 8), ("pad2", 12), ("items", size_of::<Header>())];
        let expected: Vec<(String, usize)> = expected.map(|(n, o)| (n.to_owned(), o)).to_vec();
        assert_eq!(*members, expected, "{name}");
    }
    assert_eq!(structs["Texels"].0, [("items".to_owned(), 0)]);
}

#[test]
fn constants_match_the_shader() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shaders/scene.wgsl");
    let source = std::fs::read_to_string(path).expect("shaders/scene.wgsl");
    for constant in [
        "POINT: u32 = 0u",
        "SPOT: u32 = 1u",
        "DIRECTIONAL: u32 = 2u",
        "NO_TEXTURE: u32 = 0xffffffffu",
        "WRAP_REPEAT: u32 = 0u",
        "WRAP_CLAMP: u32 = 1u",
        "WRAP_MIRROR: u32 = 2u",
    ] {
        assert!(source.contains(&format!("const {constant};")), "{constant}");
    }
}
