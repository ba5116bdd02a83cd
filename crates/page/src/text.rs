//! Text in markup.

/// Text as it stands in HTML, SVG and XML, attributes too. What XML 1.0 cannot hold at all, most control characters, becomes
/// U+FFFD.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\n' | '\t' => out.push(letter),
            unwritable if unwritable.is_control() || matches!(unwritable, '\u{fffe}' | '\u{ffff}') => {
                out.push('\u{fffd}')
            }
            other => out.push(other),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_leave_its_place() {
        assert_eq!(escaped("a<b> & \"c\"\u{1b}\u{ffff}\n"), "a&lt;b&gt; &amp; &quot;c&quot;\u{fffd}\u{fffd}\n");
    }
}
