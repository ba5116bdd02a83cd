//! Starting other programs, visibly.

use std::process::{Command, ExitStatus, Stdio};

/// Why a command ends early.
#[derive(Debug)]
pub struct Failure {
    /// 1 a check failed, 2 wrong usage, 3 the machine cannot do it.
    pub exit_code: u8,
    /// What is wrong.
    pub message: String,
}

impl Failure {
    /// A check found something.
    pub fn check(message: impl Into<String>) -> Self {
        Self { exit_code: 1, message: message.into() }
    }

    /// The command line or the environment is wrong.
    pub fn usage(message: impl Into<String>) -> Self {
        Self { exit_code: 2, message: message.into() }
    }

    /// The machine lacks something.
    pub fn machine(message: impl Into<String>) -> Self {
        Self { exit_code: 3, message: message.into() }
    }
}

/// Prints the command as it would be typed.
pub fn announce(command: &Command) {
    println!("$ {}", typed(command));
}

/// Prints and runs a command; its output goes where ours goes.
///
/// # Errors
/// If it cannot be started.
pub fn status(command: &mut Command) -> Result<ExitStatus, Failure> {
    announce(command);
    command.status().map_err(|error| not_started(command, &error))
}

/// Prints and runs a command that must succeed.
///
/// # Errors
/// If it cannot be started or fails.
pub fn succeed(command: &mut Command) -> Result<(), Failure> {
    let status = status(command)?;
    if status.success() { Ok(()) } else { Err(Failure::check(format!("`{}` failed: {status}", typed(command)))) }
}

/// What a command that must succeed writes to its standard output. It is not printed.
///
/// # Errors
/// If it cannot be started or fails.
pub fn output(command: &mut Command) -> Result<String, Failure> {
    let output = command.stderr(Stdio::inherit()).output().map_err(|error| not_started(command, &error))?;
    if !output.status.success() {
        return Err(Failure::check(format!("`{}` failed: {}", typed(command), output.status)));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Whether a command can be started and succeeds; its output is dropped.
pub fn works(command: &mut Command) -> bool {
    command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

pub fn not_started(command: &Command, error: &std::io::Error) -> Failure {
    Failure::machine(format!("cannot start `{}`: {error}", typed(command)))
}

fn typed(command: &Command) -> String {
    let variables = command.get_envs().filter_map(|(name, value)| {
        value.map(|value| format!("{}={} ", name.to_string_lossy(), quoted(&value.to_string_lossy())))
    });
    let program = std::path::Path::new(command.get_program()).file_name().unwrap_or(command.get_program());
    let words = std::iter::once(program).chain(command.get_args()).map(|word| quoted(&word.to_string_lossy()));
    variables.collect::<String>() + &words.collect::<Vec<_>>().join(" ")
}

fn quoted(word: &str) -> String {
    if word.is_empty() || word.contains(char::is_whitespace) { format!("'{word}'") } else { word.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_is_shown_as_typed() {
        let mut command = Command::new("/usr/bin/cargo");
        command.args(["clippy", "--", "-D", "warnings", "two words"]).env("FLAGS", "-D x");
        assert_eq!(typed(&command), "FLAGS='-D x' cargo clippy -- -D warnings 'two words'");
    }

    #[test]
    fn failing_and_missing_programs_are_failures() {
        assert!(!works(&mut Command::new("no-such-program-anywhere")));
        assert_eq!(status(&mut Command::new("no-such-program-anywhere")).unwrap_err().exit_code, 3);
        assert_eq!(succeed(Command::new("cargo").arg("no-such-verb").stderr(Stdio::null())).unwrap_err().exit_code, 1);
    }
}
