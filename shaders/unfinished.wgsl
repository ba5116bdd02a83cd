// Told where a driver ends loops before they are done, which else would be a wrong picture without a word: Mesa's llvmpipe
// does, when all loops of a thread have taken 65,535 rounds.

// Threads that did not get to the end. Whoever runs the pass reads it, and says so.
var<storage, read_write> unfinished: atomic<u32>;

fn tell_unfinished() {
    atomicAdd(&unfinished, 1u);
}
