//! A headless browser: the report of image tests is tested in a real browser.

use std::process::Command;

use crate::command::{Failure, works};
use crate::system::System;

/// Debian's package. Ubuntu's package of that name is not a browser; there, follow the advice by hand.
const PACKAGES: [&str; 1] = ["chromium"];

/// The environment variable that names a browser.
const BROWSER: &str = "TYNDALL_BROWSER";

/// Names of browsers that speak Chromium's protocol; the test that starts one reads the same list.
const NAMES: &str = include_str!("../../testing/tests/harness/browsers.txt");

/// Makes sure that there is a browser; installs one if it may.
///
/// # Errors
/// If there is none and it cannot be installed; the message says what to install.
pub fn ensure() -> Result<(), Failure> {
    if is_there() {
        return Ok(());
    }
    println!("No browser was found.");
    let system = System::here();
    system.install(&PACKAGES, &format!("no browser was found, and the report is tested in one. {}", advice(system)))?;
    if is_there() { Ok(()) } else { Err(Failure::machine("the installed browser does not start")) }
}

fn is_there() -> bool {
    let named = std::env::var(BROWSER).ok().filter(|name| !name.is_empty());
    let names = named.iter().map(String::as_str).chain(NAMES.lines().filter(|_| named.is_none()));
    names.into_iter().any(|name| works(Command::new(name).arg("--version")))
}

/// What to install by hand.
fn advice(system: System) -> String {
    let how = match system {
        System::Debian => "sudo apt-get install chromium (on Ubuntu: Google's package of Chrome)",
        System::Fedora => "sudo dnf install chromium",
        System::Arch => "sudo pacman -S chromium",
        System::Suse => "sudo zypper install chromium",
        System::Alpine => "sudo apk add chromium",
        System::MacOs | System::Windows | System::OtherLinux | System::Other => "Chromium, Chrome or Edge",
    };
    format!("Install one: {how}; or name one in {BROWSER}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_advice_names_what_is_installed_by_itself() {
        assert!(PACKAGES.iter().all(|package| advice(System::Debian).contains(package)));
        assert!(PACKAGES.iter().all(|package| NAMES.lines().any(|name| name == *package)));
    }
}
