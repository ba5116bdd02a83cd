//! No text makes the linker panic, and every place that it reports lies in its file, between characters.
//! `PROPTEST_CASES` sets how many texts are tried (256).

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;
use std::sync::{Arc, LazyLock};

use proptest::prelude::*;
use tyndall_document::{Diagnostic, Place, Source, render_text};
use tyndall_shader::{Library, check, link};

mod descriptor;

/// Shaders to begin with: this crate's fixtures, which are wrong in many ways, and one of everything.
static SEEDS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let shaders = paths.iter().filter(|path| path.extension().is_some_and(|extension| extension == "wgsl"));
    let mut seeds: Vec<String> = shaders.map(|path| std::fs::read_to_string(path).unwrap()).collect();
    // Half of all: it is valid, so that its mutations come far.
    seeds.extend(std::iter::repeat_n(RICH.to_owned(), seeds.len()));
    assert!(seeds.len() > 5, "the fixtures are gone");
    seeds
});

/// One of everything.
const RICH: &str = "#import phase\ndiagnostic(off, derivative_uniformity);\n\
    struct Params { exposure: f32, @size(32) b: vec3<f32> }\nalias V = vec4<f32>;\n\
    var<uniform> params: Params;\noverride nodes: u32 = 2 * 3;\noverride twice = nodes * 2u;\n\
    const_assert 1 < 2;\nvar<private> p: array<i32, 4> = array(1, 2, 3, 4);\nvar<workgroup> w: array<atomic<u32>, 8>;\n\
    var depth: texture_2d<f32>;\nvar linear_clamp: sampler;\nvar volume: texture_storage_3d<rgba16float, write>;\n\
    var<storage, read_write> list: array<u32>;\n\
    fn f(p: ptr<function, f32>, n: u32) -> f32 { switch n { case 1u, 2u: { return 1.0; } default: { *p += 1e3; } } \
    for (var i = 0u; i < n; i++) { if i == 3 { continue; } } loop { break; } return select(0.0, *p, n > 1); }\n\
    @compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) l: u32) {\n\
    var x = phase(params.exposure) + params.b[id.x]; let m = mat3x3<f32>() * params.b; let y = f(&x, nodes + twice);\n\
    let s = textureSampleLevel(depth, linear_clamp, vec2(0.5), 0.0).xyz + m; atomicAdd(&w[l % 8], 1u); workgroupBarrier();\n\
    textureStore(volume, id, V(s, y)); list[arrayLength(&list) - 1] = bitcast<u32>(x); }\n";

/// What mutations put in.
const PIECES: &[&str] = &[
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    "<",
    ">",
    ";",
    ",",
    ":",
    "@",
    "#",
    "/*",
    "*/",
    "//",
    "\"",
    "\n",
    "é",
    "\u{2028}",
    "\0",
    "#import phase\n",
    "#import \"x.wgsl\"\n",
    "@group(0)",
    "@binding(1)",
    "@id(7)",
    "@size(",
    "@align(3)",
    "var<uniform>",
    "var<storage, read_write>",
    "var<workgroup>",
    "ptr<function, f32>",
    "array<",
    "array<u32>",
    "atomic<u32>",
    "sampler",
    "sampler_comparison",
    "texture_cube<f32>",
    "texture_depth_2d",
    "texture_multisampled_2d<f32>",
    "texture_external",
    "texture_storage_2d<r32uint, read_write>",
    "binding_array<texture_external>",
    "enable wgpu_binding_array;",
    "bool",
    "vec3<f32>",
    "mat4x4<f16>",
    "0",
    "1u",
    "-1",
    "4294967295",
    "0x7fffffff",
    "1e308",
    "1e-50",
    "1/0",
    "override",
    "const",
    "let",
    "fn",
    "struct",
    "alias",
    "return",
    "loop",
    "switch",
    "default",
    "case",
    "break",
    "continuing",
    "discard",
    "params",
    "depth",
    "main",
    "f",
    "_",
    "&",
    "*",
    "!",
    "+",
    "%",
    "<<",
    "==",
    "->",
    ".x",
    ".xyzw",
    "workgroupUniformLoad",
    "dpdx",
    "textureSample",
    "textureGather",
    "ray_query",
    "i64",
    "f64",
    "subgroupAdd",
    "pack4x8snorm",
    "frexp",
    "modf",
    "ldexp",
];

#[derive(Debug, Clone)]
enum Mutation {
    Insert(prop::sample::Index, prop::sample::Index),
    Replace(prop::sample::Index, prop::sample::Index),
    Remove(prop::sample::Index, usize),
    Move(prop::sample::Index, prop::sample::Index, usize),
    Repeat(prop::sample::Index, usize),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let index = any::<prop::sample::Index>;
    prop_oneof![
        (index(), index()).prop_map(|(at, piece)| Mutation::Insert(at, piece)),
        (index(), index()).prop_map(|(at, piece)| Mutation::Replace(at, piece)),
        (index(), 1..20_usize).prop_map(|(at, length)| Mutation::Remove(at, length)),
        (index(), index(), 1..20_usize).prop_map(|(from, to, length)| Mutation::Move(from, to, length)),
        (index(), 2..300_usize).prop_map(|(at, times)| Mutation::Repeat(at, times)),
    ]
}

/// Words, and single characters of all else.
fn pieces(text: &str) -> Vec<String> {
    let mut pieces: Vec<String> = Vec::new();
    for c in text.chars() {
        match pieces.last_mut() {
            Some(last) if c.is_alphanumeric() && last.chars().all(char::is_alphanumeric) => last.push(c),
            _ => pieces.push(c.to_string()),
        }
    }
    pieces
}

fn mutate(text: &str, mutations: &[Mutation]) -> String {
    let mut pieces = pieces(text);
    for mutation in mutations {
        if pieces.is_empty() {
            break;
        }
        match mutation {
            Mutation::Insert(at, piece) => pieces.insert(at.index(pieces.len()), (*piece.get(PIECES)).to_owned()),
            Mutation::Replace(at, piece) => *at.get_mut(&mut pieces) = (*piece.get(PIECES)).to_owned(),
            Mutation::Remove(at, length) => {
                let at = at.index(pieces.len());
                pieces.drain(at..(at + length).min(pieces.len()));
            }
            Mutation::Move(from, to, length) => {
                let from = from.index(pieces.len());
                let moved: Vec<_> = pieces.drain(from..(from + length).min(pieces.len())).collect();
                let to = to.index(pieces.len() + 1);
                pieces.splice(to..to, moved);
            }
            Mutation::Repeat(at, times) => {
                let piece = at.get(&pieces).repeat(*times);
                *at.get_mut(&mut pieces) = piece;
            }
        }
    }
    pieces.concat()
}

fn in_its_file(place: &Place) -> bool {
    match place {
        Place::Text { source, span } => source.text().get(span.start as usize..span.end as usize).is_some(),
        _ => true,
    }
}

fn hold(problems: &[Diagnostic], text: &str) {
    for problem in problems {
        assert!(problem.code.0 != "shader-internal", "naga panicked: {problem:?}\n{text}");
        assert!(in_its_file(&problem.place), "{problem:?}\n{text}");
        assert!(problem.related.iter().all(|(place, _)| in_its_file(place)), "{problem:?}\n{text}");
        assert!(!problem.message.is_empty());
    }
    render_text(problems, false);
}

fn library() -> Library {
    let mut library = Library::default();
    library.insert("phase", Source::new("phase.wgsl", "fn phase(g: f32) -> f32 { return g * 0.5; }\n"));
    library.insert_file("x.wgsl", Source::new("x.wgsl", "#import phase\nstruct X { x: f32 }\n"));
    library
}

fn try_link(text: String) {
    let source = Source::new("mutated.wgsl", text);
    match link(&Arc::clone(&source), &library()) {
        Ok(linked) => hold(&check(&linked, &descriptor::descriptor(), descriptor::SCENE), source.text()),
        Err(problems) => {
            assert!(!problems.is_empty());
            hold(&problems, source.text());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_shaders_never_panic(seed in any::<prop::sample::Index>(), mutations in prop::collection::vec(mutation(), 1..8)) {
        try_link(mutate(&SEEDS[seed.index(SEEDS.len())], &mutations));
    }

    #[test]
    fn any_text_never_panics(text in "\\PC{0,200}") {
        try_link(text);
    }
}

#[test]
fn one_of_everything_is_valid() {
    let linked = link(&Source::new("rich.wgsl", RICH), &library());
    assert!(linked.is_ok(), "{}", render_text(&linked.unwrap_err(), false));
}

/// naga recurses; what would be too much for its stack must be refused before.
#[test]
fn deep_nesting_is_an_error() {
    let nests = [
        ("(", ")"),
        ("-", ""),
        ("{", "}"),
        ("array<", ">"),
        ("if true {", "}"),
        ("if true {} else ", ""),
        ("/*", "*/"),
        ("!", ""),
        ("1 - ", ""),
        ("a.x * ", ""),
        ("f(1, ", ")"),
        ("", "[0]"),
        ("", ".x"),
        ("&", ""),
        ("vec2(", ", 1)"),
    ];
    for (open, close) in nests {
        for depth in [100, 10_000] {
            try_link(format!("fn f() {{ let x = {}1{}; }}", open.repeat(depth), close.repeat(depth)));
            try_link(format!("fn f() {{ {}{} }}", open.repeat(depth), close.repeat(depth)));
        }
    }
}

#[test]
fn long_chains_of_declarations_are_an_error() {
    for (link, end) in [
        ("fn fI() { fJ(); }", "fn fI() {}"),
        ("const cI = cJ + 1;", "const cI = 1;"),
        ("alias aI = aJ;", "alias aI = u32;"),
        ("struct SI { a: SJ }", "struct SI { a: u32 }"),
        ("override oI: u32 = oJ;", "override oI: u32 = 1;"),
    ] {
        for count in [1_900, 20_000] {
            let line = |i: u32| link.replace('I', &i.to_string()).replace('J', &(i + 1).to_string());
            try_link((0..count).map(line).chain([end.replace('I', &count.to_string())]).collect());
        }
    }
}
