//! The system that this runs on, as far as its packages are concerned.

use std::process::Command;

use crate::command::{Failure, succeed, works};

/// Which system this is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "they say it all")]
pub enum System {
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
    /// The system that this runs on.
    pub fn here() -> Self {
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

    /// Installs packages on Debian and Ubuntu, if that is allowed.
    ///
    /// # Errors
    /// If it is not allowed, or fails; the message ends with the advice.
    pub fn install(self, packages: &[&str], advice: &str) -> Result<(), Failure> {
        let Some(mut apt) = self.apt() else { return Err(Failure::machine(advice)) };
        let environment = ("DEBIAN_FRONTEND", "noninteractive");
        succeed(apt().arg("update").env(environment.0, environment.1))
            .and_then(|()| succeed(apt().args(["install", "-y"]).args(packages).env(environment.0, environment.1)))
            .map_err(|failure| Failure::machine(format!("{}\n{advice}", failure.message)))
    }

    /// The command that starts `apt-get` with the right to install, if there is one.
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
    fn where_nothing_may_be_installed_the_advice_is_the_error() {
        assert!(System::Fedora.apt().is_none());
        assert_eq!(System::Fedora.install(&["g++"], "Install it").unwrap_err().message, "Install it");
    }
}
