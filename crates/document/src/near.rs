//! The name that was probably meant.

/// Names beyond this many candidates are not looked at, so that a file of 10,000 unknown names stays cheap to check.
const MOST_CANDIDATES: usize = 16_384;
/// Candidates whose distance is worked out; the others must fall to the cheap tests before.
const MOST_COMPARED: usize = 96;
/// Longest name, in bytes, for which a neighbour is sought.
const LONGEST: usize = 64;

/// The candidate that `name` was probably meant to be, if one is near enough.
///
/// Near is: equal but for case, a candidate whose part behind the last dot is the name (`tonemap` for
/// `core.tonemap`), or within a third of the name's characters (at least one) by insertions, deletions, changes and
/// swaps of neighbours. The nearest wins, and of equals the first. The work of a call is capped.
pub fn near<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if name.is_empty() || name.len() > LONGEST {
        return None;
    }
    let limit = (name.chars().count() / 3).max(1);
    let letters = letters_of(name);
    let mut compared = 0;
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates.into_iter().take(MOST_CANDIDATES) {
        // Twice the distance, so that the two shortcuts find a place between 0 and 1.
        let distance = if is_last_part(name, candidate) || candidate.eq_ignore_ascii_case(name) {
            1
        } else if compared < MOST_COMPARED && may_be_near(name, letters, candidate, limit) {
            compared += 1;
            2 * strsim::osa_distance(name, candidate)
        } else {
            continue;
        };
        if distance <= 2 * limit && candidate != name && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// The candidate's part behind its last dot is the name.
fn is_last_part(name: &str, candidate: &str) -> bool {
    candidate.len() > name.len() + 1
        && candidate.ends_with(name)
        && candidate.as_bytes()[candidate.len() - name.len() - 1] == b'.'
}

/// False only where the distance is certainly over the limit: lengths or letters differ by too much.
fn may_be_near(name: &str, letters: u64, candidate: &str, limit: usize) -> bool {
    // A character takes up to four bytes.
    let bytes = if name.is_ascii() { limit } else { 4 * limit };
    name.len().abs_diff(candidate.len()) <= bytes
        && (letters ^ letters_of(candidate)).count_ones() as usize <= 2 * bytes
}

/// One bit for each kind of byte that occurs. One edit of an ASCII text changes at most two bits.
fn letters_of(text: &str) -> u64 {
    text.bytes().take(2 * LONGEST).fold(0, |set, byte| set | 1 << (byte & 63))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_what_was_meant() {
        let names = ["core.gbuffer", "core.tonemap", "airlight.homogeneous", "depth", "Directional"];
        assert_eq!(near("core.gbufer", names), Some("core.gbuffer"));
        assert_eq!(near("tonemap", names), Some("core.tonemap"));
        assert_eq!(near("directional", names), Some("Directional"));
        assert_eq!(near("detph", names), Some("depth"));
        assert_eq!(near("radiance", names), None);
        assert_eq!(near("", names), None);
        assert_eq!(near("x", []), None);
        assert_eq!(near("größe", ["grosse", "große"]), Some("große"));
    }

    #[test]
    fn the_nearest_wins_and_of_equals_the_first() {
        assert_eq!(near("abcdef", ["abcdxx", "abcdex", "abcdey"]), Some("abcdex"));
        assert_eq!(near("color", ["colour", "colors"]), Some("colour"));
    }

    #[test]
    fn many_unknown_names_among_many_stay_cheap() {
        let names: Vec<String> = (0..10_000).map(|i| format!("pass_{i:05}")).collect();
        let start = std::time::Instant::now();
        for i in 0..10_000 {
            near(&format!("past_{i:05}x"), names.iter().map(String::as_str));
        }
        assert!(start.elapsed().as_secs_f64() < 10.0, "{:?}", start.elapsed());
    }
}
