//! A browser without a window: the report of image tests is tested in a real one.

use std::process::Command;

use crate::command::{Failure, works};
use crate::system::System;

/// Debian's package. Ubuntu's of that name is none; there the advice is followed by hand.
const PACKAGES: [&str; 1] = ["chromium"];

/// The environment variable that names a browser.
const BROWSER: &str = "TYNDALL_BROWSER";

/// What browsers are called that speak Chromium's protocol; the test that starts one reads the same list.
const NAMES: &str = include_str!("../../testing/tests/harness/browsers.txt");

/// Makes sure that a browser is there; installs one where it may.
///
/// # Errors
/// If there is none and none can be installed: the message says what to install.
pub fn ensure() -> Result<(), Failure> {
    if answers() {
        return Ok(());
    }
    println!("No browser answers.");
    let system = System::here();
    system.install(&PACKAGES, &format!("no browser answers, and the report is tested in one. {}", advice(system)))?;
    if answers() { Ok(()) } else { Err(Failure::machine("the browser does not answer either")) }
}

fn answers() -> bool {
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
    format!("Install one: {how}; or name one by {BROWSER}")
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
