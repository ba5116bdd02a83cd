//! The program `tyndall`: its verbs, over the layers below.
//!
//! `App::new().plugin(my_plugin::plugin).run()` is a `tyndall` with one more plugin.

mod cli;
mod commands;
mod failure;
mod loading;
mod pictures;
mod plugins;
mod terminal;
mod warnings;

use std::process::ExitCode;
use std::time::Instant;

use tyndall_plugin::Plugin;

use crate::cli::Arguments;
use crate::failure::Failure;

/// The plugins that the program ships.
pub fn shipped() -> Vec<fn() -> Plugin> {
    vec![
        tyndall_core::plugin as fn() -> Plugin,
        tyndall_aerial::plugin,
        tyndall_airlight::plugin,
        tyndall_surface_radiance::plugin,
        tyndall_froxel::plugin,
        tyndall_march::plugin,
        tyndall_shadow_planes::plugin,
    ]
}

/// The program, and the plugins that are compiled into it.
pub struct App {
    plugins: Vec<fn() -> Plugin>,
    started: Instant,
}

impl App {
    /// The program with the plugins that it ships.
    pub fn new() -> Self {
        Self { plugins: shipped(), started: Instant::now() }
    }

    /// Adds a plugin.
    #[must_use]
    pub fn plugin(mut self, plugin: fn() -> Plugin) -> Self {
        self.plugins.push(plugin);
        self
    }

    /// Reads the command line and runs its verb.
    pub fn run(self) -> ExitCode {
        terminal::quieten_device_select();
        let arguments = match cli::parse() {
            Ok(arguments) => arguments,
            Err(code) => return code,
        };
        let result = commands::run(&self, &arguments);
        if terminal::output_lost() {
            terminal::error("error: standard output cannot be written: is its disk full?");
            return ExitCode::from(3);
        }
        match result {
            Ok(()) => ExitCode::SUCCESS,
            Err(failure) => {
                failure.print();
                ExitCode::from(failure.exit_code().max(exit_code_of_adapter(&arguments, &failure)))
            }
        }
    }
}

/// Of several causes the highest code counts: whatever else is wrong, a missing adapter is the machine's fault.
fn exit_code_of_adapter(arguments: &Arguments, failure: &Failure) -> u8 {
    let Some(name) = arguments.verb.adapter().filter(|_| failure.exit_code() == 2) else { return 0 };
    let Err(error) = tyndall_gpu::Gpu::open(Some(name)) else { return 0 };
    let failure = Failure::from(error);
    failure.print();
    failure.exit_code()
}

impl Default for App {
    fn default() -> Self {
        Self::new()
    }
}
