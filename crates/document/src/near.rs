//! The name that was probably meant, and the names that are available.

use crate::Diagnostic;

/// More candidates than these are not looked at, so that a file of 10,000 unknown names stays cheap to check.
const MOST_CANDIDATES: usize = 16_384;
/// Most candidates whose distance is computed; the cheap tests must rule out the others.
const MOST_COMPARED: usize = 96;
/// Longest name, in bytes, for which a near one is sought.
const LONGEST: usize = 64;
/// Longer lists are not shown: nobody would read them.
const MOST_LISTED: usize = 16;

impl Diagnostic {
    /// Suggests the candidate that the unknown `name` was probably meant to be; where none is near enough, lists the
    /// candidates.
    #[must_use]
    pub fn suggest_near<'a>(self, name: &str, candidates: impl IntoIterator<Item = &'a str> + Clone) -> Self {
        self.suggest_near_as(name, candidates, str::to_owned)
    }

    /// [`Self::suggest_near`] with every candidate written as it belongs in the place of the name: `pass.port` for a
    /// port, say.
    #[must_use]
    pub fn suggest_near_as<'a>(
        self,
        name: &str,
        candidates: impl IntoIterator<Item = &'a str> + Clone,
        written: impl Fn(&str) -> String,
    ) -> Self {
        match near(name, candidates.clone()) {
            Some(near) => self.suggest(did_you_mean(&written(near))),
            None => self.suggest_available(candidates.into_iter().map(written)),
        }
    }

    /// Suggests the candidate that the unknown `name` was probably meant to be, or else `otherwise`.
    #[must_use]
    pub fn suggest_near_or<'a>(
        self,
        name: &str,
        candidates: impl IntoIterator<Item = &'a str>,
        otherwise: impl Into<String>,
    ) -> Self {
        self.suggest(near(name, candidates).map_or_else(|| otherwise.into(), did_you_mean))
    }

    /// Lists the names to choose from, unless they are too many.
    #[must_use]
    pub fn suggest_available(self, names: impl IntoIterator<Item = impl AsRef<str>>) -> Self {
        match available(names) {
            Some(list) => self.suggest(list),
            None => self,
        }
    }
}

/// ``did you mean `name`?``
pub fn did_you_mean(name: &str) -> String {
    format!("did you mean `{name}`?")
}

/// The names to choose from: ``available: `a`, `b` ``. `None` where they are too many to list.
pub fn available(names: impl IntoIterator<Item = impl AsRef<str>>) -> Option<String> {
    let names: Vec<String> =
        names.into_iter().take(MOST_LISTED + 1).map(|name| format!("`{}`", name.as_ref())).collect();
    match names.len() {
        0 => Some("none are available".to_owned()),
        1..=MOST_LISTED => Some(format!("available: {}", names.join(", "))),
        _ => None,
    }
}

/// The candidate that `name` was probably meant to be, if one is near enough.
///
/// Near is: equal but for case, a candidate whose part after the last dot is the name (`tonemap` for
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
        // Twice the distance, so that the two shortcuts lie between 0 and 1.
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

/// Whether the candidate's part after its last dot is the name.
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
    fn an_unknown_name_is_told_what_there_is() {
        let suggestion = |name: &str, names: &[&str]| {
            let problem = Diagnostic::error(crate::UNKNOWN_FIELD, crate::Place::File("a.ron".to_owned()), "unknown");
            problem.suggest_near(name, names.iter().copied()).suggestion
        };
        assert_eq!(suggestion("detph", &["depth", "normal"]).as_deref(), Some("did you mean `depth`?"));
        assert_eq!(suggestion("radiance", &["depth", "normal"]).as_deref(), Some("available: `depth`, `normal`"));
        assert_eq!(suggestion("radiance", &[]).as_deref(), Some("none are available"));
        assert_eq!(suggestion("radiance", &["depth"; MOST_LISTED + 1]), None);
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
