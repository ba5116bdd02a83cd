//! Checks that no file of the repository names a folder of somebody's machine.

use std::path::Path;
use std::process::Command;

/// Folders that hold people's files. Split, so that this file does not name one.
const HOMES: [[&str; 2]; 3] = [["/ho", "me/[a-z]"], ["/Us", "ers/[A-Za-z]"], ["[A-Z]:\\\\Us", "ers\\\\"]];

/// The result of the search.
#[derive(Debug, PartialEq, Eq)]
pub enum Found {
    /// No such path.
    Nothing,
    /// Lines of `git grep`.
    Paths(Vec<String>),
    /// There is no git, or this is no checkout.
    NotSearched,
}

/// Searches the tracked and the new files below `root`, and for `root` itself.
pub fn search(root: &Path) -> Found {
    let mut grep = git(root);
    grep.args(["grep", "--untracked", "--line-number", "-I", "--extended-regexp"]);
    for pattern in HOMES {
        grep.args(["-e", &pattern.concat()]);
    }
    // A checkout right below the root of the file system has too common a name.
    if let Some(own) = root.to_str().filter(|_| root.components().count() > 2) {
        grep.args(["-e", &format!("{}(/|[^a-zA-Z0-9_-]|$)", escaped(own))]);
    }
    match grep.output() {
        Ok(output) if output.status.success() => {
            Found::Paths(String::from_utf8_lossy(&output.stdout).lines().map(str::to_owned).collect())
        }
        Ok(output) if output.status.code() == Some(1) => Found::Nothing,
        _ => Found::NotSearched,
    }
}

/// Git in `folder`, also where a hook of git's runs us and names another checkout.
fn git(folder: &Path) -> Command {
    let mut git = Command::new("git");
    git.current_dir(folder).env_remove("GIT_DIR").env_remove("GIT_WORK_TREE").env_remove("GIT_INDEX_FILE");
    git
}

/// `text` as an extended regular expression that matches only itself.
fn escaped(text: &str) -> String {
    let mut result = String::new();
    for letter in text.chars() {
        if !letter.is_alphanumeric() && letter != '/' {
            result.push('\\');
        }
        result.push(letter);
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    fn repository(text: &str) -> Option<(tempfile::TempDir, Found)> {
        let folder = tempfile::tempdir().unwrap();
        let git = git(folder.path()).args(["init", "--quiet"]).status();
        if !git.is_ok_and(|status| status.success()) {
            return None;
        }
        let text = text.replace("ROOT", &folder.path().canonicalize().unwrap().display().to_string());
        std::fs::write(folder.path().join("a.txt"), text).unwrap();
        let found = search(&folder.path().canonicalize().unwrap());
        Some((folder, found))
    }

    #[test]
    fn paths_of_machines_are_found() {
        let people = format!("one\n{}/ann/x\n", HOMES[0].concat().replace("/[a-z]", ""));
        for text in [people.as_str(), "in ROOT/crates\n", "in ROOT\n"] {
            let (_folder, found) = repository(text).expect("git is needed");
            assert!(matches!(&found, Found::Paths(lines) if lines.len() == 1), "{text}: {found:?}");
        }
    }

    #[test]
    fn other_text_passes_and_other_folders_are_not_searched() {
        let (_folder, found) = repository("/usr/bin/env, ROOTs and ../shared\n").expect("git is needed");
        assert_eq!(found, Found::Nothing);
        let folder = tempfile::tempdir().unwrap();
        assert!(matches!(search(&folder.path().join("missing")), Found::NotSearched));
    }
}
