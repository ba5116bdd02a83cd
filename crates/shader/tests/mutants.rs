//! Which mistakes are offered, which are not, and that each gives a valid module.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::BTreeSet;

use tyndall_document::Source;
use tyndall_shader::{Library, Linked, MutationKind, link};

const SHADER: &str = "
var source: texture_2d<f32>;
var result: texture_storage_2d<r32float, write>;

const WIDE: f32 = 3.5;

fn mixed(a: f32, b: f32, count: u32) -> f32 {
    return mix(a, b, 0.25) + max(a, a) - f32(count);
}

fn nobody_calls(a: f32) -> f32 {
    return a * 77.0;
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let texel = textureLoad(source, id.xy, 0);
    var sum = -texel.x * WIDE;
    var i = 0u;
    loop {
        sum += mixed(texel.y, texel.z, i);
        i++;
        if i >= 4u { break; }
    }
    textureStore(result, id.xy, vec4<f32>(min(sum, texel.w), 0.0, 0.5, 1.0));
}
";

fn linked(text: &str) -> Linked {
    link(&Source::new("a.wgsl", text), &Library::default()).unwrap()
}

fn changes(text: &str) -> Vec<(MutationKind, String, String)> {
    linked(text).mutations().into_iter().map(|m| (m.kind, m.function, m.change)).collect()
}

#[test]
fn each_kind_is_offered_where_it_can_be_made() {
    let all = changes(SHADER);
    let offered =
        |kind, function: &str, change: &str| all.iter().any(|(k, f, c)| *k == kind && f == function && c == change);
    assert!(offered(MutationKind::FlipSign, "main", "-texel.x -> texel.x"), "{all:#?}");
    assert!(offered(MutationKind::DropFactor, "main", "-texel.x * WIDE -> -texel.x"), "{all:#?}");
    assert!(offered(MutationKind::ChangeConstant, "main", "WIDE -> 7.0"), "{all:#?}");
    assert!(offered(MutationKind::ChangeConstant, "main", "4u -> 5u"), "{all:#?}");
    assert!(offered(MutationKind::SwapMinMax, "main", "min(sum, texel.w) -> max(sum, texel.w)"), "{all:#?}");
    assert!(
        offered(MutationKind::SwapArguments, "main", "mixed(texel.y, texel.z, i) -> mixed(texel.z, texel.y, i)"),
        "{all:#?}"
    );
    assert!(offered(MutationKind::SwapArguments, "mixed", "mix(a, b, 0.25) -> mix(b, a, 0.25)"), "{all:#?}");
    assert!(offered(MutationKind::ChangeConstant, "mixed", "0.25 -> 1.25"), "{all:#?}");
}

/// The greater of a number and itself, a mip level, the turns of a loop, channels that nobody stores, functions that nobody
/// calls.
#[test]
fn what_can_make_no_difference_is_not_offered() {
    let all = changes(SHADER);
    let made = |what: &str| all.iter().any(|(_, _, change)| change.starts_with(what));
    assert!(!made("max(a, a)") && !made("0 ->") && !made("i + 1") && !made("1u ->"), "{all:#?}");
    assert!(!made("0.0 ->") && !made("0.5 ->") && !made("1.0 ->") && !made("77.0"), "{all:#?}");
    let loads = all.iter().filter(|(_, _, change)| change.contains("textureLoad"));
    assert_eq!(loads.count(), 0);
}

#[test]
fn every_mutant_is_valid_and_another_shader() {
    let linked = linked(SHADER);
    let right = linked.mutant(None, 100).unwrap();
    let mut fingerprints = BTreeSet::from([linked.fingerprint, right.fingerprint]);
    let mutations = linked.mutations();
    for mutation in &mutations {
        let mutant = linked.mutant(Some(mutation), 100).unwrap_or_else(|why| panic!("{}: {why}", mutation.change));
        assert!(fingerprints.insert(mutant.fingerprint), "{}", mutation.change);
        assert_eq!(mutant.resources, linked.resources);
        assert!(mutation.place.line_column().is_some_and(|(line, _)| line > 1), "{}", mutation.change);
        if let Some(drastic) = mutation.drastic() {
            assert!(linked.mutant(Some(&drastic), 100).is_ok(), "{}", mutation.change);
        }
    }
    let again = changes(SHADER);
    assert_eq!(again.len(), mutations.len());
    let named: BTreeSet<_> = again.iter().map(|(_, function, change)| (function, change)).collect();
    assert_eq!(named.len(), again.len(), "function and change name a mutant");
}

/// The same change twice in a function is told apart.
#[test]
fn alike_changes_are_numbered() {
    let all = changes(
        "var result: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(1) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let a = f32(id.x);
    textureStore(result, id.xy, vec4<f32>(a + 0.25, a + 0.25, a, a));
}
",
    );
    let count = |change: &str| all.iter().filter(|(_, _, c)| c == change).count();
    assert_eq!((count("a + 0.25 -> a - 0.25"), count("a + 0.25 -> a - 0.25 #2")), (1, 1), "{all:#?}");
}

/// By how much threads count that a driver has left undone: no port shows it.
#[test]
fn what_is_unfinished_is_counted_as_it_is() {
    let all = changes(
        "var<storage, read_write> unfinished: atomic<u32>;
var result: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(1) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    atomicAdd(&unfinished, 3u);
    textureStore(result, id.xy, vec4<f32>(f32(id.x) + 0.25));
}
",
    );
    assert!(!all.is_empty() && all.iter().all(|(_, _, change)| !change.starts_with("3u")), "{all:#?}");
}
