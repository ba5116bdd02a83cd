//! Input that nobody means: whatever it is, it is drawn or refused, and nothing panics.
//!
//! In this process, so that there can be many rounds. What ends a process at once is looked for in `program/fuzz.rs`.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use tyndall_document::{Diagnostics, render_json, render_text};
use tyndall_graph::Roots;
use tyndall_plugin::SearchPath;
use tyndall_render::{Error, Loaded, Request, Wanted, load, plan, registry};
use tyndall_tests::broken::{Random, mutate};
use tyndall_tests::tint::{GRAPH, MANIFEST, SHADER};
use tyndall_tests::{Desk, SCENE, sessions, shipped};

/// How often each kind of file is broken.
const ROUNDS: usize = 1_000;
/// How often it is then drawn, where nothing is found wrong.
const DRAWN: usize = 20;

/// What became of input.
#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    Refused,
    Sound,
}

/// Does something with broken input, which must not panic.
fn without_panic<T>(what: &str, bytes: &[u8], work: impl FnOnce() -> T) -> T {
    catch_unwind(AssertUnwindSafe(work))
        .unwrap_or_else(|_| panic!("{what} makes it panic: {}", String::from_utf8_lossy(bytes)))
}

/// As `tyndall check`, in both forms.
fn check(loaded: Option<Loaded>, mut out: Diagnostics) -> End {
    if let Some(loaded) = loaded.filter(|_| !out.has_errors())
        && let Err(Error::Mistakes(mistakes)) = plan(&loaded, Wanted { roots: Roots::Outputs, keep: false, live: &[] })
    {
        out.extend(mistakes);
    }
    out.sort();
    out.dedup();
    let (text, json) = (render_text(&out, true), render_json(&out));
    assert!(out.is_empty() || !text.is_empty() && json.starts_with('['));
    if out.has_errors() { End::Refused } else { End::Sound }
}

/// Breaks files again and again; what is sound nevertheless is drawn, as long as few have been.
fn rounds(desk: &Desk, seed: u64, broken: impl Fn(&mut Random) -> (PathBuf, Vec<u8>)) {
    let request = Request { size: Some((8, 8)), graph: desk.path("fog.graph.ron"), ..Request::default() };
    let mut random = Random(seed);
    let (mut refused, mut drawn) = (0, 0);
    for round in 0..ROUNDS {
        let (path, bytes) = broken(&mut random);
        std::fs::write(&path, &bytes).unwrap();
        let what = format!("{} of round {round}", path.display());
        let end = sessions().with(|session| {
            let registry = session.registry(&request.graph).unwrap();
            let mut out = Diagnostics::default();
            without_panic(&what, &bytes, || check(load(&request, &registry, &mut out), out))
        });
        match end.unwrap() {
            End::Refused => refused += 1,
            End::Sound if drawn < DRAWN => {
                drawn += 1;
                // What a machine cannot do is refused, too.
                let ends = || sessions().with(|session| session.draw(&request, &["radiance"], 0..1).is_ok());
                without_panic(&what, &bytes, ends).unwrap();
            }
            End::Sound => {}
        }
    }
    assert!(refused > ROUNDS / 10 && drawn > 0, "{refused} of {ROUNDS} are refused, {drawn} drawn");
}

#[test]
fn broken_graphs() {
    let desk = Desk::new();
    let (path, sound) = (desk.path("fog.graph.ron"), std::fs::read(desk.path("fog.graph.ron")).unwrap());
    rounds(&desk, 0x9e37_79b9_7f4a_7c15, |random| (path.clone(), mutate(random, &sound)));
}

#[test]
fn broken_scenes() {
    let desk = Desk::new();
    let path = desk.path("test.scene.ron");
    rounds(&desk, 0x2545_f491_4f6c_dd1d, |random| (path.clone(), mutate(random, SCENE.as_bytes())));
}

#[test]
fn broken_models() {
    let desk = Desk::new();
    let sound = std::fs::read(shipped("fog").with_file_name("scenes/models/pavilion.glb")).unwrap();
    let length = u32::from_le_bytes(*sound[12..].first_chunk().unwrap()) as usize;
    let (head, json, rest) = (&sound[..20], &sound[20..20 + length], &sound[20 + length..]);
    desk.put(
        "test.scene.ron",
        "(camera: (position: (0, 2, 9), look_at: (0, 1, 0)), objects: [(mesh: File(\"a.glb\"))])",
    );
    let path = desk.path("a.glb");
    rounds(&desk, 0xd1b5_4a32_d192_ed03, |random| {
        if random.below(3) == 0 {
            return (path.clone(), mutate(random, &sound));
        }
        // Of the same length, so that what is wrong is not only that.
        let mut broken = mutate(random, json);
        broken.resize(length, b' ');
        (path.clone(), [head, &broken, rest].concat())
    });
}

/// A plugin's manifest, or its shader, beside the passes of `core`.
#[test]
fn broken_plugins() {
    let desk = Desk::new();
    desk.put("tint.graph.ron", GRAPH);
    let request = Request { graph: desk.path("tint.graph.ron"), ..Request::default() };
    let search = [SearchPath { path: desk.path("plugins"), required: true }];
    let mut random = Random(0x0bad_5eed_cafe_f00d);
    let mut refused = 0;
    for round in 0..ROUNDS {
        let manifest = round % 2 == 0;
        desk.put("plugins/tint/plugin.ron", MANIFEST);
        desk.put("plugins/tint/invert.wgsl", SHADER);
        let (name, sound) = if manifest { ("plugin.ron", MANIFEST) } else { ("invert.wgsl", SHADER) };
        let bytes = mutate(&mut random, sound.as_bytes());
        desk.put(Path::new("plugins/tint").join(name).to_str().unwrap(), &bytes);
        let end = without_panic(&format!("{name} of round {round}"), &bytes, || {
            match registry(vec![tyndall_core::plugin()], &search) {
                Ok(registry) => {
                    let mut out = Diagnostics::default();
                    check(load(&request, &registry, &mut out), out)
                }
                Err(mistakes) => check(None, mistakes),
            }
        });
        refused += usize::from(end == End::Refused);
    }
    assert!(refused > ROUNDS / 10, "{refused} of {ROUNDS} are refused");
}
