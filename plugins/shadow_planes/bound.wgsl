// No ray is brighter than without shadows. Nodes err, by up to 4e-4 of what they sum: so the sum over the lit parts of a ray
// may come to more than the sum over all of it, as `airlight.homogeneous` gives it, where the shadow takes less than that.
//
// Where it may, the ray is summed as if it had no shadow as well, and is no brighter. Few rays need that: first four nodes
// say what the longest dark part takes, and mostly it is more than any error. (Summed anew were all rays with a shadow, the
// pass would take 1.4 to 1.7 times as long in a scene of a box.)
#import "shadows.wgsl"

// What is summed of a light: its lit parts, then the longest dark part, then the ray as if it had no shadow.
const LIT: u32 = 0u;
const DARK: u32 = 1u;
const WHOLE: u32 = 2u;

// Of the lit parts: a dark part that takes so much takes more than errors do, those of the four nodes included,
const CERTAIN_SHARE: f32 = 0.02;
// of so many nodes for the others.
const CERTAIN_NODES: u32 = 8u;

struct Bound {
    stage: u32,
    sum: vec3<f32>,             // W/(sr m^2); of the dark part, or of the ray with the lights before
    before: vec3<f32>,          // of the lights before, with shadows
    dark: vec2<f32>,            // m; the longest dark part so far
    lit_until: f32,             // m; the end of the last lit part
}

// For the next light, after those that come to this sum.
fn unbounded(before: vec3<f32>) -> Bound {
    return Bound(LIT, before, before, vec2<f32>(0.0), 0.0);
}

fn with_dark_before(bound: Bound, lit: vec2<f32>) -> Bound {
    var next = bound;
    let is_longest = lit.x - bound.lit_until > bound.dark.y - bound.dark.x;
    next.dark = select(bound.dark, vec2<f32>(bound.lit_until, lit.x), is_longest);
    next.lit_until = lit.y;
    return next;
}

fn part_of_stage(bound: Bound, lit: vec2<f32>, way: f32) -> vec2<f32> {
    return select(select(lit, bound.dark, bound.stage == DARK), vec2<f32>(0.0, way), bound.stage == WHOLE);
}

// What is summed next, where `sum` is of all lights so far: LIT again where nothing is left to be known.
fn next_stage(bound: Bound, sum: vec3<f32>, at_end: bool, nodes: u32) -> Bound {
    let lit = sum - bound.before;
    let is_partly_dark = bound.dark.y > bound.dark.x && any(lit > vec3<f32>(0.0));
    let is_certain = nodes >= CERTAIN_NODES && all(bound.sum >= CERTAIN_SHARE * lit);
    var next = bound;
    next.stage = select(LIT, DARK, at_end && bound.stage == LIT && is_partly_dark);
    next.stage = select(next.stage, WHOLE, bound.stage == DARK && !is_certain);
    next.sum = select(vec3<f32>(0.0), bound.before, next.stage == WHOLE);
    return next;
}
