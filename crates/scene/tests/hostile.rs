//! Broken files end in diagnostics: bytes of a sound file changed at random, and the file cut off everywhere.

#[allow(dead_code, reason = "the pavilion uses more of it")]
#[path = "../examples/pavilion/build.rs"]
mod build;
#[path = "../examples/pavilion/glb.rs"]
mod glb;
#[allow(dead_code, reason = "the pavilion uses more of it")]
#[path = "../examples/pavilion/pictures.rs"]
mod pictures;

use std::alloc::{GlobalAlloc, Layout, System};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{Quat, Vec3};
use serde_json::json;
use tyndall_document::{Place, Source};
use tyndall_scene::{Overrides, Scene};

/// The largest single allocation so far: a count that is believed before it is checked shows here.
static LARGEST: AtomicUsize = AtomicUsize::new(0);

struct Watched;

#[expect(
    unsafe_code,
    reason = "an allocator that watches sizes can only be written so; it adds nothing to the system's"
)]
// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Watched {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        LARGEST.fetch_max(layout.size(), Ordering::Relaxed);
        // SAFETY: the caller's promises are passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's promises are passed on.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Watched = Watched;

/// xorshift64*: repeatable, so that a failure names its seed.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33) as usize % limit
    }
}

/// A bit of everything that is read: texture, light, camera, hierarchy, animation, sparse accessor.
fn sample() -> Vec<u8> {
    let mut glb = glb::Glb::default();
    let texture = glb.texture("tiles", &pictures::tiles());
    let material = glb.material("tiled", [0.5, 0.6, 0.7], Some(texture));
    let turning = build::Turning { sides: 6, round: true, ring: false, uv_scale: 1.0 };
    let shape = build::turned(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], turning);
    let mesh = glb.mesh("drum", &[(&shape, material), (&build::cuboid(Vec3::ZERO, Vec3::ONE), material)]);
    let light = glb.light(json!({ "type": "spot", "intensity": 5.0, "spot": { "outerConeAngle": 0.5 } }));
    let lamp = glb.node("lamp", Vec3::Y, Quat::IDENTITY, &light, &[]);
    let camera = glb.add("cameras", json!({ "type": "perspective", "perspective": { "yfov": 0.8, "znear": 0.1 } }));
    let eye = glb.node("eye", Vec3::Z, Quat::IDENTITY, &json!({ "camera": camera }), &[]);
    let moves = glb.triples(&[Vec3::ZERO, Vec3::X]);
    let bytes: Vec<u8> = [0f32, 1.0].iter().flat_map(|t| t.to_le_bytes()).collect();
    let view = glb.view(&bytes);
    let times =
        glb.add("accessors", json!({ "bufferView": view, "componentType": 5126, "count": 2, "type": "SCALAR" }));
    let drum = glb.node("drum", Vec3::ZERO, Quat::IDENTITY, &json!({ "mesh": mesh }), &[lamp, eye]);
    let channel = json!({ "sampler": 0, "target": { "node": drum, "path": "translation" } });
    glb.add("animations", json!({ "channels": [channel], "samplers": [{ "input": times, "output": moves }] }));
    let [at, values] = [glb.view(&[0, 1]), glb.view(&[0; 24])];
    let sparse = json!({ "count": 2, "indices": { "bufferView": at, "componentType": 5121 }, "values": { "bufferView": values } });
    let zeroed = glb.add("accessors", json!({ "componentType": 5126, "count": 3, "type": "VEC3", "sparse": sparse }));
    let flat = glb.add("meshes", json!({ "primitives": [{ "attributes": { "POSITION": zeroed } }] }));
    let flat = glb.node("flat", Vec3::ZERO, Quat::IDENTITY, &json!({ "mesh": flat }), &[]);
    glb.finish(&[drum, flat])
}

/// Reads a file; every mistake must name it. Gives whether it could be read.
fn read(folder: &Path, bytes: &[u8]) -> bool {
    std::fs::write(folder.join("model.glb"), bytes).expect("a file");
    let source = Source::new("s.scene.ron", "(objects: [(mesh: File(\"model.glb\"))])");
    match Scene::from_source(&source, folder, &Overrides::new(), &Arc::default()) {
        Ok((scene, _)) => {
            scene.encode(0.5, 1.0);
            true
        }
        Err(mistakes) => {
            let named = |place: &Place| matches!(place, Place::File(name) if name.ends_with("model.glb"));
            let of_scene = ["missing-camera", "scene-too-large"];
            assert!(mistakes.iter().all(|d| named(&d.place) || of_scene.contains(&d.code.0)), "{mistakes:?}");
            false
        }
    }
}

#[test]
fn changed_files_never_panic() {
    let folder = tempfile::tempdir().expect("a folder");
    let sound = sample();
    assert!(read(folder.path(), &sound));
    let json = 20..20 + u32::from_le_bytes([sound[12], sound[13], sound[14], sound[15]]) as usize;
    let mut random = Random(0x5eed);
    let mut sounds = 0;
    for round in 0..4000 {
        let mut bytes = sound.clone();
        for _ in 0..=random.below(2) {
            // Every fourth anywhere; else in the JSON, and there mostly digits, which makes another index, count or
            // offset instead of a syntax error.
            let anywhere = round % 4 == 0;
            let mut at = if anywhere { random.below(bytes.len()) } else { json.start + random.below(json.len()) };
            if !anywhere && random.below(8) > 0 {
                at = (at..json.end).find(|&i| bytes[i].is_ascii_digit()).unwrap_or(at);
            }
            bytes[at] = match bytes[at] {
                digit if digit.is_ascii_digit() && !anywhere => b'0' + random.below(10) as u8,
                other => other ^ 1 << random.below(8),
            };
        }
        sounds += usize::from(read(folder.path(), &bytes));
    }
    assert!(sounds > 400 && sounds < 3600, "{sounds} of 4000 were still readable: the changes test too little");
    assert!(LARGEST.load(Ordering::Relaxed) < 64 << 20, "an allocation of {LARGEST:?} bytes");
}

#[test]
fn digits_that_grow_never_panic() {
    let folder = tempfile::tempdir().expect("a folder");
    let sound = sample();
    let length = u32::from_le_bytes([sound[12], sound[13], sound[14], sound[15]]) as usize;
    let text = std::str::from_utf8(&sound[20..20 + length]).expect("JSON is UTF-8");
    let numbers: Vec<usize> = text
        .char_indices()
        .filter(|(i, c)| c.is_ascii_digit() && !text.as_bytes()[i - 1].is_ascii_digit())
        .map(|(i, _)| i)
        .collect();
    let numbers = numbers.iter().step_by(1 + numbers.len() / 400);
    for (start, huge) in numbers.flat_map(|s| ["4294967295", "18446744073709551615", "1e300", "-1"].map(|h| (*s, h))) {
        let end = start + text[start..].find(|c: char| !c.is_ascii_digit()).unwrap_or(0);
        let mut json = format!("{}{huge}{}", &text[..start], &text[end..]).into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut bytes = b"glTF\x02\0\0\0".to_vec();
        let total = 12 + 8 + json.len() + (sound.len() - 20 - length);
        bytes.extend((total as u32).to_le_bytes());
        bytes.extend((json.len() as u32).to_le_bytes());
        bytes.extend(b"JSON");
        bytes.extend(json);
        bytes.extend(&sound[20 + length..]);
        read(folder.path(), &bytes);
    }
    assert!(LARGEST.load(Ordering::Relaxed) < 64 << 20, "an allocation of {LARGEST:?} bytes");
}

#[test]
fn cut_files_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let sound = sample();
    for length in (0..sound.len()).step_by(97) {
        assert!(!read(folder.path(), &sound[..length]), "{length} of {} bytes were read", sound.len());
    }
}
