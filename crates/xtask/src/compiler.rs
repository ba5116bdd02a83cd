//! A C++ compiler, for FLIP: the metric with which image tests compare what a person sees is NVIDIA's own C++.

use std::process::Command;

use crate::command::{Failure, works};
use crate::system::System;

/// Debian's and Ubuntu's package.
const PACKAGES: [&str; 1] = ["g++"];

/// Makes sure that there is a C++ compiler; installs one if it may. On Windows it comes with the tools that Rust needs
/// anyway.
///
/// # Errors
/// If there is none and it cannot be installed; the message says what to install.
pub fn ensure() -> Result<(), Failure> {
    if cfg!(windows) || is_there() {
        return Ok(());
    }
    println!("No C++ compiler was found.");
    let system = System::here();
    system.install(&PACKAGES, &format!("no C++ compiler was found. {}", advice(system)))?;
    if is_there() { Ok(()) } else { Err(Failure::machine("the installed C++ compiler does not start")) }
}

/// As the build looks for one: `CXX`, else `c++`.
fn is_there() -> bool {
    let chosen = std::env::var_os("CXX").filter(|name| !name.is_empty());
    works(Command::new(chosen.unwrap_or_else(|| "c++".into())).arg("--version"))
}

/// What to install by hand.
fn advice(system: System) -> &'static str {
    match system {
        System::Debian => "Install one: sudo apt-get install g++",
        System::Fedora => "Install one: sudo dnf install gcc-c++",
        System::Arch => "Install one: sudo pacman -S gcc",
        System::Suse => "Install one: sudo zypper install gcc-c++",
        System::Alpine => "Install one: sudo apk add g++",
        System::MacOs => "Install the command-line tools: xcode-select --install",
        System::OtherLinux | System::Windows | System::Other => "Install one that is called c++, or name it in CXX.",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_advice_names_what_is_installed_by_itself() {
        assert!(PACKAGES.iter().all(|package| advice(System::Debian).contains(package)));
    }
}
