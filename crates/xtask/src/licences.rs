//! Checks that every package that the workspace is built from has a permissive licence.

use serde_json::Value;

use crate::spdx::satisfied;

/// Licences that let the whole be distributed under MIT or Apache-2.0.
const PERMISSIVE: [&str; 14] = [
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "CDLA-Permissive-2.0",
    "ISC",
    "MIT",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// The packages of `cargo metadata` whose terms are not permissive, one line each.
///
/// # Errors
/// The lines, or one that says that there are no packages at all.
pub fn check(metadata: &Value) -> Result<usize, Vec<String>> {
    let packages = metadata["packages"].as_array().map(Vec::as_slice).unwrap_or_default();
    let mistakes: Vec<String> = packages.iter().filter_map(mistake).collect();
    match (packages.len(), mistakes.is_empty()) {
        (0, _) => Err(vec!["cargo metadata lists no package".to_owned()]),
        (count, true) => Ok(count),
        _ => Err(mistakes),
    }
}

fn mistake(package: &Value) -> Option<String> {
    let text = |field: &str| package[field].as_str().unwrap_or("?");
    let name = format!("{} {}", text("name"), text("version"));
    let Some(expression) = package["license"].as_str() else { return Some(format!("{name}: states no licence")) };
    match satisfied(expression, &|id| PERMISSIVE.contains(&id)) {
        Ok(true) => None,
        Ok(false) => Some(format!("{name}: `{expression}` is not permissive")),
        Err(message) => Some(format!("{name}: {message}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn of(packages: &Value) -> Result<usize, Vec<String>> {
        check(&json!({ "packages": packages }))
    }

    #[test]
    fn permissive_packages_pass() {
        let packages = json!([
            { "name": "a", "version": "1.0.0", "license": "MIT OR Apache-2.0" },
            { "name": "b", "version": "1.0.0", "license": "(MIT OR Apache-2.0) AND Unicode-3.0" },
            { "name": "c", "version": "1.0.0", "license": "Unlicense/MIT" },
        ]);
        assert_eq!(of(&packages), Ok(3));
    }

    #[test]
    fn copyleft_missing_and_broken_licences_fail() {
        let packages = json!([
            { "name": "fine", "version": "1.0.0", "license": "Zlib" },
            { "name": "gnu", "version": "2.1.0", "license": "GPL-3.0-only" },
            { "name": "both", "version": "0.1.0", "license": "MIT AND MPL-2.0" },
            { "name": "none", "version": "0.1.0", "license": null },
            { "name": "odd", "version": "0.1.0", "license": "MIT OR" },
        ]);
        let expected = [
            "gnu 2.1.0: `GPL-3.0-only` is not permissive",
            "both 0.1.0: `MIT AND MPL-2.0` is not permissive",
            "none 0.1.0: states no licence",
            "odd 0.1.0: `MIT OR` is not a licence expression",
        ];
        assert_eq!(of(&packages).unwrap_err(), expected);
    }

    #[test]
    fn no_packages_at_all_fail() {
        assert!(of(&json!([])).is_err());
        assert!(check(&json!({})).is_err());
    }
}
