//! The page of the architecture names files that exist.

use tyndall_tests::root;

#[test]
fn every_path_on_the_page_exists() {
    let root = root();
    let page = std::fs::read_to_string(root.join("docs/architecture.md")).unwrap();
    let code: Vec<&str> = page.split('`').skip(1).step_by(2).collect();
    let folders = ["crates/", "plugins/", "shaders/", "graphs/", "tests/", "docs/"];
    let is_path = |text: &&&str| folders.iter().any(|folder| text.starts_with(folder)) && !text.contains(['*', ' ']);
    let paths: Vec<&&str> = code.iter().filter(is_path).filter(|path| !path.contains("NAME")).collect();
    assert!(paths.len() > 30, "{paths:?}");
    for path in paths {
        assert!(root.join(path).exists(), "{path}");
    }
    assert!(page.lines().count() < 120);
}
