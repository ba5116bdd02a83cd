//! Another order, other memory, once more: what must not change a bit.

use std::fs;

use tyndall_testing::{Options, Robustness};

use crate::chain::Chain;

fn all() -> Options {
    let robustness = Robustness { shuffle: Some(7), poison: true, no_sharing: true, repeat: 2 };
    Options { robustness, ..Options::default() }
}

#[test]
fn a_sound_chain_comes_out_the_same_in_every_way() {
    let outcome = Chain::new().run(&all());
    assert!(outcome.passed(), "{}", outcome.text());
}

/// The link leaves a column alone, which holds whatever was there before.
#[test]
fn what_is_read_before_it_is_written_is_caught_by_the_poison() {
    let chain = Chain::new();
    chain.set_line("three", "    if id.x == 3u { return; }\n    let value = texel(id.xy);");
    chain.test("\"*\": (properties: [NonNegative])", "");
    let options = |poison| {
        let robustness = Robustness { poison, repeat: 1, ..Robustness::default() };
        Options { robustness, without_goldens: true, ..Options::default() }
    };
    let caught = chain.run(&options(true));
    assert!(!caught.passed());
    assert!(caught.text().contains("`three.result` came out different"), "{}", caught.text());
    assert_eq!(caught.robustness.len(), 1, "what follows from it is not repeated: {:?}", caught.robustness);
}

/// Another size has no goldens, and every other way still holds.
#[test]
fn every_way_goes_with_another_size() {
    let chain = Chain::new();
    let small = Options { size: Some((9, 7)), ..all() };
    let outcome = chain.run(&small);
    assert!(outcome.passed(), "{}", outcome.text());
}

/// The goldens of the repository stay small.
#[test]
fn all_goldens_together_are_below_10_mib() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let (mut bytes, mut files) = (0, 0);
    let mut folders = vec![root];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap()) {
            let (path, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
            let of_goldens = folder.to_string_lossy().ends_with(tyndall_testing::file::GOLDENS);
            if entry.file_type().unwrap().is_dir() {
                if !name.starts_with('.') && name != "target" {
                    folders.push(path);
                }
            } else if of_goldens {
                files += 1;
                bytes += entry.metadata().unwrap().len();
            }
        }
    }
    assert!(files > 0, "no golden was found");
    assert!(bytes < 10 << 20, "{bytes} bytes in {files} files");
}
