//! Checks that crates whose types cross the project's interfaces exist in one version each.

use std::collections::BTreeMap;

/// The crates, and whether each must be there.
const ONCE: [(&str, bool); 5] = [("egui", false), ("glam", true), ("naga", true), ("petgraph", true), ("wgpu", true)];

/// Checks the text of a `Cargo.lock`.
///
/// # Errors
/// One line for each crate that is missing or that exists in several versions.
pub fn check(lock: &str) -> Result<(), Vec<String>> {
    let mut versions: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for package in lock.split("[[package]]").skip(1) {
        let field = |name: &str| {
            let mut values = package.lines().filter_map(|line| line.strip_prefix(name)?.strip_prefix(" = "));
            values.next().map(|value| value.trim_matches('"'))
        };
        if let (Some(name), Some(version)) = (field("name"), field("version")) {
            versions.entry(name).or_default().push(version);
        }
    }
    let mistake = |(name, needed): (&str, bool)| match versions.get(name).map(Vec::as_slice) {
        Some([_]) => None,
        Some(several) => Some(format!("{name} exists in the versions {}", several.join(", "))),
        None => needed.then(|| format!("{name} is missing")),
    };
    let mistakes: Vec<String> = ONCE.into_iter().filter_map(mistake).collect();
    if mistakes.is_empty() { Ok(()) } else { Err(mistakes) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lock(packages: &[(&str, &str)]) -> String {
        let one =
            |(name, version): &(&str, &str)| format!("[[package]]\nname = \"{name}\"\nversion = \"{version}\"\n\n");
        format!("version = 4\n\n{}", packages.iter().map(one).collect::<String>())
    }

    #[test]
    fn one_of_each_passes() {
        let packages = [("glam", "0.30.1"), ("naga", "30.0.0"), ("petgraph", "0.8.0"), ("wgpu", "30.0.0")];
        assert_eq!(check(&lock(&packages)), Ok(()));
    }

    #[test]
    fn two_or_none_fail() {
        let packages = [("glam", "0.29.0"), ("glam", "0.30.1"), ("naga", "30.0.0"), ("wgpu", "30.0.0")];
        let expected = ["glam exists in the versions 0.29.0, 0.30.1", "petgraph is missing"];
        assert_eq!(check(&lock(&packages)).unwrap_err(), expected);
        assert_eq!(check("").unwrap_err().len(), 4);
    }
}
