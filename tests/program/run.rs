//! Starts the program in a folder.

use std::process::{Command, Output};

use tyndall_tests::Desk;

/// How a run ended.
pub struct Ended {
    /// Exit code; -1 after a signal.
    pub code: i32,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

impl Ended {
    /// A panic is never the right end.
    pub fn of(arguments: &[&str], output: &Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let ended =
            Self { code: output.status.code().unwrap_or(-1), out: text(&output.stdout), err: text(&output.stderr) };
        assert!(!ended.err.contains("panicked"), "{arguments:?}: {}", ended.err);
        ended
    }
}

/// The program, started in a folder.
pub trait Program {
    /// To be started.
    fn command(&self, arguments: &[&str]) -> Command;

    /// Runs it with its output in pipes.
    fn run(&self, arguments: &[&str]) -> Ended {
        Ended::of(arguments, &self.command(arguments).output().unwrap())
    }

    /// Runs it; it must end with this code.
    fn ends(&self, code: i32, arguments: &[&str]) -> Ended {
        let ended = self.run(arguments);
        assert_eq!(ended.code, code, "{arguments:?}\n{}{}", ended.out, ended.err);
        ended
    }
}

impl Program for Desk {
    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_tyndall"));
        command.args(arguments).current_dir(self.path("")).env_remove("TYNDALL_PLUGIN_PATH");
        command
    }
}
