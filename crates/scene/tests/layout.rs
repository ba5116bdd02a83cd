//! The Rust structs against the WGSL structs that shaders read. A plugin's scene data are held against its shaders in the
//! same way whenever one is linked; here all structs of the file are, whether a pass reads them or not.

use naga::common::DiagnosticDisplay;
use naga::{Module, TypeInner};
use tyndall_scene::layout::{
    Ambient, Background, Camera, Header, HeightFog, Light, Lobe, Material, Medium, Member, Object, Phase, PhaseTable,
    Texture, Type, Vertex,
};

fn wgsl() -> (String, Module) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shaders/scene.wgsl");
    let source = std::fs::read_to_string(path).expect("shaders/scene.wgsl");
    let module = naga::front::wgsl::parse_str(&source).expect("scene.wgsl is valid");
    (source, module)
}

/// Name, offset and type of each member of a struct of the file, and its size.
fn of_shader(module: &Module, name: &str) -> (Vec<(String, usize, String)>, usize) {
    let is_it = |kind: &naga::Type| kind.name.as_deref() == Some(name);
    let (_, kind) = module.types.iter().find(|(_, kind)| is_it(kind)).unwrap_or_else(|| panic!("no struct {name}"));
    let TypeInner::Struct { members, span } = &kind.inner else { panic!("{name} is not a struct") };
    let member = |m: &naga::StructMember| {
        let ty = DiagnosticDisplay((m.ty, module.to_ctx())).to_string();
        (m.name.clone().unwrap_or_default(), m.offset as usize, ty)
    };
    (members.iter().map(member).collect(), *span as usize)
}

fn of_rust(members: &[Member]) -> Vec<(String, usize, String)> {
    members.iter().map(|member| (member.name.to_owned(), member.offset, member.ty.to_owned())).collect()
}

#[test]
fn structs_match_the_shader() {
    let (_, module) = wgsl();
    let types = [
        Type::of::<Camera>(),
        Type::of::<Medium>(),
        Type::of::<Lobe>(),
        Type::of::<Phase>(),
        Type::of::<Light>(),
        Type::of::<Vertex>(),
        Type::of::<Object>(),
        Type::of::<Material>(),
        Type::of::<Texture>(),
        Type::of::<HeightFog>(),
    ];
    for ty in types {
        assert_eq!(of_shader(&module, ty.name), (of_rust(ty.members), ty.size), "{}", ty.name);
    }
    // Padded to the 16 bytes that a uniform takes.
    for ty in [Type::of::<Background>(), Type::of::<Ambient>()] {
        let (members, size) = of_shader(&module, ty.name);
        assert_eq!((members, size), (of_rust(&ty.members[..1]), ty.size), "{}", ty.name);
        assert_eq!(ty.members[1].name, "pad", "{}", ty.name);
    }
}

#[test]
fn lists_start_with_the_header() {
    let (_, module) = wgsl();
    for name in ["Lights", "Vertices", "VertexColors", "Triangles", "Objects", "Materials", "Textures"] {
        let (members, _) = of_shader(&module, name);
        assert_eq!(members[..4], of_rust(Type::of::<Header>().members), "{name}");
        assert_eq!((members[4].0.as_str(), members[4].1, members.len()), ("items", size_of::<Header>(), 5), "{name}");
    }
    let (members, _) = of_shader(&module, "PhaseTable");
    assert_eq!(members[..4], of_rust(Type::of::<PhaseTable>().members));
    assert_eq!((members[4].0.as_str(), members[4].1, members.len()), ("items", size_of::<PhaseTable>(), 5));
    let (members, _) = of_shader(&module, "Texels");
    assert_eq!((members[0].0.as_str(), members[0].1, members.len()), ("items", 0, 1));
}

#[test]
fn constants_match_the_shader() {
    let (source, _) = wgsl();
    for constant in [
        "POINT: u32 = 0u",
        "SPOT: u32 = 1u",
        "DIRECTIONAL: u32 = 2u",
        "NO_TEXTURE: u32 = 0xffffffffu",
        "WRAP_REPEAT: u32 = 0u",
        "WRAP_CLAMP: u32 = 1u",
        "WRAP_MIRROR: u32 = 2u",
        "SAMPLE_NEAREST: u32 = 16u",
    ] {
        assert!(source.contains(&format!("const {constant};")), "{constant}");
    }
}
