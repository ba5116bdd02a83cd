//! What a shader does, as a number.
//!
//! Two texts do the same where their entry points reach the same declarations: comments, blanks, the order of declarations
//! and those that nothing uses make no difference. Names do make one, also those of local variables.
//!
//! Declarations are compared word by word, and not as naga's module: its order depends on what stands in the text without
//! being used, and a new version of naga would change every number.

use std::collections::HashMap;

use tyndall_graph::Digest;

use crate::scan::Declaration;
use crate::scan::lexer::{Lexer, Token};

/// A number that changes with what the entry points of a linked text do; with all of it where it has no entry point.
/// The same in every process and with every toolchain.
pub fn fingerprint(text: &str) -> u64 {
    let declared = split(text);
    let mut hashes: Vec<u64> = reached(&declared).into_iter().map(|index| hash(&declared[index].tokens)).collect();
    hashes.sort_unstable();
    let mut digest = Digest::default();
    hashes.into_iter().for_each(|hash| digest.number(hash));
    digest.finish()
}

/// What stands between two ends of declarations at module scope.
#[derive(Default)]
struct Declared<'t> {
    /// None of directives and assertions.
    name: Option<&'t str>,
    is_entry_point: bool,
    tokens: Vec<Token<'t>>,
}

/// Cuts a text, whose brackets close, into its declarations.
fn split(text: &str) -> Vec<Declared<'_>> {
    let mut all = Vec::new();
    let (mut depth, mut names, mut current) = (0_usize, Declaration::default(), Declared::default());
    for (token, _) in Lexer::new(text) {
        current.tokens.push(token);
        match token {
            Token::Word(word) => current.name = current.name.or(names.word(word, depth)),
            Token::Attribute(stage) => current.is_entry_point |= matches!(stage, "compute" | "vertex" | "fragment"),
            Token::Mark(mark) => {
                names.mark(mark);
                match mark {
                    b'(' | b'[' | b'{' => depth += 1,
                    b')' | b']' | b'}' => depth = depth.saturating_sub(1),
                    _ => {}
                }
                if depth == 0 && matches!(mark, b';' | b'}') {
                    all.push(std::mem::take(&mut current));
                }
            }
            Token::Hash | Token::OpenComment => {}
        }
    }
    all.push(current);
    // A `;` that ends nothing says nothing.
    all.retain(|declared| !matches!(declared.tokens[..], [] | [Token::Mark(b';')]));
    all
}

/// Those that entry points name, those that these name, and so on; and what has no name. A local variable may have the name of a
/// declaration: then that counts too.
fn reached(declared: &[Declared<'_>]) -> Vec<usize> {
    let by_name: HashMap<&str, usize> =
        declared.iter().enumerate().filter_map(|(index, declared)| Some((declared.name?, index))).collect();
    let has_entry_point = declared.iter().any(|declared| declared.is_entry_point);
    let is_root = |declared: &Declared<'_>| !has_entry_point || declared.is_entry_point || declared.name.is_none();
    let mut seen: Vec<bool> = declared.iter().map(is_root).collect();
    let mut reached: Vec<usize> = (0..declared.len()).filter(|index| seen[*index]).collect();
    let mut next = 0;
    while let Some(index) = reached.get(next) {
        next += 1;
        let words = declared[*index].tokens.iter().filter_map(|token| match token {
            Token::Word(word) => by_name.get(word),
            _ => None,
        });
        for other in words.filter(|other| !std::mem::replace(&mut seen[**other], true)).collect::<Vec<_>>() {
            reached.push(*other);
        }
    }
    reached
}

fn hash(tokens: &[Token<'_>]) -> u64 {
    let mut digest = Digest::default();
    for token in tokens {
        match token {
            Token::Word(word) => digest.text(word),
            Token::Attribute(name) => {
                digest.text("@");
                digest.text(name);
            }
            Token::Mark(mark) => digest.bytes(&[*mark]),
            Token::Hash | Token::OpenComment => {}
        }
    }
    digest.finish()
}

#[cfg(test)]
mod tests {
    use super::fingerprint;

    const TEXT: &str = "
        const TWO = 2.0;
        const THREE = 3.0;
        struct Ray { origin: vec3<f32>, /* m */ }
        var<private> count: array<u32, 4>;
        fn unused(ray: Ray) -> f32 { return THREE; }
        fn scaled(x: f32) -> f32 { return TWO * x; }
        @compute @workgroup_size(8, 8) fn main() { let y = scaled(1.0); }";

    #[test]
    fn what_does_nothing_changes_nothing() {
        let same = [
            TEXT.replace("/* m */", "// metres\n"),
            TEXT.replace("        ", "\n\t"),
            TEXT.replace("THREE = 3.0", "THREE = 4.0"),
            TEXT.replace("return THREE;", "return 0.0;"),
            TEXT.replace("const TWO = 2.0;", "") + "\nconst TWO = 2.0;",
            TEXT.to_owned() + ";\nfn more() -> f32 { return scaled(THREE); }",
        ];
        for text in same {
            assert_eq!(fingerprint(&text), fingerprint(TEXT), "{text}");
        }
    }

    #[test]
    fn what_is_reached_changes_it() {
        let others = [
            TEXT.replace("TWO = 2.0", "TWO = 2.5"),
            TEXT.replace("TWO * x", "TWO + x"),
            TEXT.replace("scaled(1.0)", "scaled(1.0 + f32(count[0]))"),
            TEXT.replace("(8, 8)", "(8, 4)"),
            TEXT.replace("@compute @workgroup_size(8, 8)", "@fragment"),
            "enable f16;".to_owned() + TEXT,
            TEXT.replace("@compute @workgroup_size(8, 8)", ""),
        ];
        for text in others {
            assert_ne!(fingerprint(&text), fingerprint(TEXT), "{text}");
        }
    }

    #[test]
    fn without_an_entry_point_all_counts() {
        let module = |three: &str| format!("const TWO = 2.0; const THREE = {three};");
        assert_ne!(fingerprint(&module("3.0")), fingerprint(&module("3.5")));
    }

    /// Records of goldens hold what is made of these numbers: whatever changes them makes all goldens stale.
    #[test]
    fn fingerprints_are_the_same_for_ever() {
        assert_eq!(fingerprint("const A = 1; @compute fn main() { let x = A; }"), 15_555_969_094_785_203_729);
    }
}
