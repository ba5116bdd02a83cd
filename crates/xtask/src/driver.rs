//! A GPU driver that works: the machine's own, or Mesa's software Vulkan driver.

use crate::command::{Failure, announce, not_started};
use crate::system::System;
use crate::workspace::Workspace;

/// Debian's and Ubuntu's packages of the software driver and the loader.
const PACKAGES: [&str; 2] = ["mesa-vulkan-drivers", "libvulkan1"];

/// The exit code of `tyndall adapters` if there is no adapter.
const NO_ADAPTER: i32 = 3;

/// Makes sure that the built program finds an adapter; installs the software driver if it may.
///
/// # Errors
/// If none is found and the driver cannot be installed; the message says what to install.
pub fn ensure(workspace: &Workspace) -> Result<(), Failure> {
    if is_there(workspace)? {
        return Ok(());
    }
    println!("No GPU driver was found.");
    let system = System::here();
    system.install(&PACKAGES, &format!("no GPU driver was found. {}", advice(system)))?;
    if is_there(workspace)? { Ok(()) } else { Err(Failure::machine("the installed software driver does not work")) }
}

fn is_there(workspace: &Workspace) -> Result<bool, Failure> {
    let mut adapters = workspace.tyndall();
    adapters.arg("adapters");
    announce(&adapters);
    let status = adapters.status().map_err(|error| not_started(&adapters, &error))?;
    match status.code() {
        Some(0) => Ok(true),
        Some(NO_ADAPTER) => Ok(false),
        _ => Err(Failure::check(format!("`tyndall adapters` failed: {status}"))),
    }
}

/// What to install by hand.
fn advice(system: System) -> &'static str {
    match system {
        System::Debian => "Install one: sudo apt-get install mesa-vulkan-drivers libvulkan1",
        System::Fedora => "Install one: sudo dnf install mesa-vulkan-drivers vulkan-loader",
        System::Arch => "Install one: sudo pacman -S vulkan-swrast vulkan-icd-loader",
        System::Suse => "Install one: sudo zypper install libvulkan_lvp libvulkan1",
        System::Alpine => "Install one: sudo apk add mesa-vulkan-swrast vulkan-loader",
        System::OtherLinux => "Install a Vulkan driver and the Vulkan loader; Mesa's lavapipe needs no graphics card.",
        System::MacOs => "Metal is part of macOS: this machine, or a login without a screen, offers no device.",
        System::Windows => {
            "Install the graphics card's driver; Direct3D 12 (with WARP) is part of Windows 10 and later."
        }
        System::Other => "Install a driver for Vulkan and its loader.",
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
