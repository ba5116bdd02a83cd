//! A GPU driver that answers: the machine's own, or Mesa's software Vulkan driver.

use std::process::Command;

use crate::command::{Failure, announce, not_started, succeed, works};
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
    match system.apt() {
        Some(mut apt) => {
            let environment = ("DEBIAN_FRONTEND", "noninteractive");
            succeed(apt().arg("update").env(environment.0, environment.1))
                .and_then(|()| succeed(apt().args(["install", "-y"]).args(PACKAGES).env(environment.0, environment.1)))
                .map_err(|failure| Failure::machine(format!("{}\n{}", failure.message, system.advice())))?;
            if answers(workspace)? {
                Ok(())
            } else {
                Err(Failure::machine("the software driver does not answer either"))
            }
        }
        None => Err(Failure::machine(format!("no GPU driver answers. {}", system.advice()))),
    }
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

/// Which system this is, as far as its packages are concerned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum System {
    Debian,
    Fedora,
    Arch,
    Suse,
    Alpine,
    OtherLinux,
    MacOs,
    Windows,
    Other,
}

impl System {
    fn here() -> Self {
        match std::env::consts::OS {
            "linux" => Self::of_os_release(&std::fs::read_to_string("/etc/os-release").unwrap_or_default()),
            "macos" => Self::MacOs,
            "windows" => Self::Windows,
            _ => Self::Other,
        }
    }

    /// The family that `ID` or `ID_LIKE` of an os-release file names.
    fn of_os_release(text: &str) -> Self {
        let fields = text.lines().filter_map(|line| line.strip_prefix("ID=").or(line.strip_prefix("ID_LIKE=")));
        let names: Vec<&str> = fields.flat_map(|value| value.trim_matches('"').split_whitespace()).collect();
        let families = [
            (Self::Debian, &["debian", "ubuntu"][..]),
            (Self::Fedora, &["fedora", "rhel"]),
            (Self::Arch, &["arch"]),
            (Self::Suse, &["suse", "opensuse"]),
            (Self::Alpine, &["alpine"]),
        ];
        let found = families.into_iter().find(|(_, ids)| ids.iter().any(|id| names.contains(id)));
        found.map_or(Self::OtherLinux, |(family, _)| family)
    }

    /// What starts `apt-get` with the right to install, if there is such a right.
    fn apt(self) -> Option<impl FnMut() -> Command> {
        let usable = self == Self::Debian && works(Command::new("apt-get").arg("--version"));
        let root = works(Command::new("sh").args(["-c", "test \"$(id -u)\" = 0"]));
        let sudo = !root && usable && works(Command::new("sudo").args(["-n", "true"]));
        (usable && (root || sudo)).then_some(move || match root {
            true => Command::new("apt-get"),
            false => {
                let mut command = Command::new("sudo");
                command.args(["-n", "apt-get"]);
                command
            }
        })
    }

    /// What to install by hand.
    fn advice(self) -> &'static str {
        match self {
            Self::Debian => "Install one: sudo apt-get install mesa-vulkan-drivers libvulkan1",
            Self::Fedora => "Install one: sudo dnf install mesa-vulkan-drivers vulkan-loader",
            Self::Arch => "Install one: sudo pacman -S vulkan-swrast vulkan-icd-loader",
            Self::Suse => "Install one: sudo zypper install libvulkan_lvp libvulkan1",
            Self::Alpine => "Install one: sudo apk add mesa-vulkan-swrast vulkan-loader",
            Self::OtherLinux => {
                "Install a Vulkan driver and the Vulkan loader; Mesa's lavapipe needs no graphics card."
            }
            Self::MacOs => "Metal is part of macOS: this machine, or a login without a screen, offers no device.",
            Self::Windows => {
                "Install the graphics card's driver; Direct3D 12 (with WARP) is part of Windows 10 and later."
            }
            Self::Other => "Install a driver for Vulkan and its loader.",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn families_are_told_by_os_release() {
        let of = System::of_os_release;
        assert_eq!(of("PRETTY_NAME=\"Debian GNU/Linux 12\"\nID=debian\n"), System::Debian);
        assert_eq!(of("ID=pop\nID_LIKE=\"ubuntu debian\"\n"), System::Debian);
        assert_eq!(of("ID=\"opensuse-tumbleweed\"\nID_LIKE=\"opensuse suse\"\n"), System::Suse);
        assert_eq!(of("ID=rocky\nID_LIKE=\"rhel centos fedora\"\n"), System::Fedora);
        assert_eq!(of("ID=void\n"), System::OtherLinux);
    }

    #[test]
    fn the_advice_names_what_is_installed_by_itself() {
        assert!(PACKAGES.iter().all(|package| System::Debian.advice().contains(package)));
        assert!(System::Fedora.apt().is_none());
    }
}
