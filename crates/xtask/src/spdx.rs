//! Licence expressions (SPDX), as far as `Cargo.toml` files use them.
//!
//! `expression = all { "OR" all }`, `all = one { "AND" one }`, `one = "(" expression ")" | id [ "WITH" exception
//! ]`; a slash between two names is the old way to write OR.

/// Whether the expression can be met by licences that `allowed` accepts (an id, with ` WITH exception` if it has
/// one).
///
/// # Errors
/// If the expression is malformed.
pub fn satisfied(expression: &str, allowed: &dyn Fn(&str) -> bool) -> Result<bool, String> {
    let spaced = expression.replace('(', " ( ").replace(')', " ) ").replace('/', " OR ");
    let mut reader = Reader { words: spaced.split_whitespace().collect(), at: 0, allowed };
    let result = reader.any().filter(|_| reader.at == reader.words.len());
    result.ok_or_else(|| format!("`{expression}` is not a licence expression"))
}

struct Reader<'a> {
    words: Vec<&'a str>,
    at: usize,
    allowed: &'a dyn Fn(&str) -> bool,
}

impl<'a> Reader<'a> {
    fn any(&mut self) -> Option<bool> {
        let mut result = self.all()?;
        while self.take("OR") {
            result |= self.all()?;
        }
        Some(result)
    }

    fn all(&mut self) -> Option<bool> {
        let mut result = self.one()?;
        while self.take("AND") {
            result &= self.one()?;
        }
        Some(result)
    }

    fn one(&mut self) -> Option<bool> {
        if self.take("(") {
            let result = self.any()?;
            return self.take(")").then_some(result);
        }
        let id = self.name()?;
        if self.take("WITH") {
            let exception = self.name()?;
            return Some((self.allowed)(&format!("{id} WITH {exception}")));
        }
        Some((self.allowed)(id))
    }

    fn take(&mut self, word: &str) -> bool {
        let found = self.words.get(self.at).is_some_and(|next| *next == word);
        self.at += usize::from(found);
        found
    }

    fn name(&mut self) -> Option<&'a str> {
        let name = *self.words.get(self.at)?;
        let keyword = ["OR", "AND", "WITH", "(", ")"].contains(&name);
        self.at += 1;
        (!keyword).then_some(name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mit_or_apache(expression: &str) -> Result<bool, String> {
        satisfied(expression, &|id| ["MIT", "Apache-2.0", "Apache-2.0 WITH LLVM-exception"].contains(&id))
    }

    #[test]
    fn choices_and_sums() {
        assert_eq!(mit_or_apache("MIT"), Ok(true));
        assert_eq!(mit_or_apache("MIT/Apache-2.0"), Ok(true));
        assert_eq!(mit_or_apache("GPL-3.0 OR MIT"), Ok(true));
        assert_eq!(mit_or_apache("GPL-3.0 AND MIT"), Ok(false));
        assert_eq!(mit_or_apache("(MIT OR GPL-2.0) AND Apache-2.0"), Ok(true));
        assert_eq!(mit_or_apache("MIT OR GPL-2.0 AND Zlib"), Ok(true));
        assert_eq!(mit_or_apache("(MIT OR GPL-2.0) AND Zlib"), Ok(false));
        assert_eq!(mit_or_apache("Apache-2.0 WITH LLVM-exception"), Ok(true));
        assert_eq!(mit_or_apache("Apache-2.0 WITH Classpath-exception-2.0"), Ok(false));
    }

    #[test]
    fn malformed_expressions_are_errors() {
        for wrong in ["", "MIT OR", "MIT Apache-2.0", "(MIT", "MIT)", "AND MIT", "MIT WITH", "OR"] {
            assert!(mit_or_apache(wrong).is_err(), "{wrong}");
        }
    }
}
