//! A GPU driver that answers: the machine's own, or Mesa's software Vulkan driver.

use crate::command::{Failure, announce, not_started};
use crate::system::System;
use crate::workspace::Workspace;

/// Debian's and Ubuntu's packages with the software driver and the loader.
const PACKAGES: [&str; 2] = ["mesa-vulkan-drivers", "libvulkan1"];

/// What `tyndall adapters` exits with where there is no adapter.
const NO_ADAPTER: i32 = 3;

/// Makes sure that the built program finds an adapter; installs the software driver where it may.
///
/// # Errors
/// If none is found and none can be installed: the message says what to install.
pub fn ensure(workspace: &Workspace) -> Result<(), Failure> {
    if answers(workspace)? {
        return Ok(());
    }
    println!("No GPU driver answers.");
    let system = System::here();
    system.install(&PACKAGES, &format!("no GPU driver answers. {}", advice(system)))?;
    if answers(workspace)? { Ok(()) } else { Err(Failure::machine("the software driver does not answer either")) }
}

fn answers(workspace: &Workspace) -> Result<bool, Failure> {
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
