// The loop over the lights of the scene, for every pass that sums over them. It is written once because its shape matters:
// software Vulkan (llvmpipe) runs threads in lockstep and without jumps, and there
//
//   - a loop's body runs once more where the test stands anywhere but at its end. So it runs at least once, and a list
//     without lights holds one of intensity 0;
//   - a loop inside of another is run in each round for as long as the slowest thread needs. So a pass that takes a light in
//     several steps (pieces of a ray, lobes) does not loop over these: it keeps in `Gathered` how far it is, and goes on to
//     the next light behind the last step;
//   - outside of branches what is the same for all threads, as the scene is, is read once for all of them. So no thread returns
//     early or leaves the loop out: pixels outside of the picture are worked out like all others, and only what is
//     stored stands in `if all(id.xy < size)`;
//   - what a loop reads from the scene and does not change is read again in each round. So it is read before, and kept.
//
// The shader says what is gathered: `light`, a member of `Gathered`, is the light that comes next. Most passes sum over the
// lights and need no more than light_sum.wgsl.

#import scene

#require struct Gathered
#require fn gather(before: Gathered, light: Light) -> Gathered

var<storage, read> lights: Lights;

// Whether the driver ended the loop before its end, see unfinished.wgsl.
var<private> lights_missed: bool = false;

fn gather_lights(start: Gathered) -> Gathered {
    let count = lights.count;
    var gathered = start;
    loop {
        gathered = gather(gathered, lights.items[gathered.light]);
        if gathered.light >= count { break; }
    }
    lights_missed = gathered.light < count;
    return gathered;
}
