//! `render --watch`: renders again whenever a file that the pictures depend on changes.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use notify::{Event, RecursiveMode, Watcher};

use crate::App;
use crate::cli::{Arguments, Render};
use crate::commands::render;
use crate::failure::Failure;
use crate::{plugins, terminal};

/// Editors write a file in several steps; changes within this time belong together.
const SETTLE: Duration = Duration::from_millis(120);

/// Ends only on a signal, or if nothing can be watched.
pub(crate) fn run(app: &App, arguments: &Arguments, verb: &Render) -> Result<(), Failure> {
    let (sender, changes) = channel();
    let mut watcher = notify::recommended_watcher(move |event| {
        // The receiver lives as long as the program.
        let _ = sender.send(event);
    })
    .map_err(unwatchable)?;
    let mut watched: Vec<PathBuf> = Vec::new();
    let mut files = vec![verb.graph.graph.clone()];
    loop {
        let app = App { plugins: app.plugins.clone(), started: Instant::now() };
        match render::run(&app, arguments, verb) {
            Ok(depends_on) => files = depends_on,
            Err(failure) => failure.print(),
        }
        let sources = plugins::search_paths(arguments, &[&verb.graph.graph]);
        let folders = files.iter().map(|file| folder_of(file)).chain(sources.iter().map(|search| search.path.clone()));
        for folder in folders.filter(|folder| folder.is_dir()) {
            let shaders = folder_of(&folder).join("shaders");
            for folder in [folder, shaders].into_iter().filter(|folder| folder.is_dir()) {
                if !watched.contains(&folder) {
                    watcher.watch(&folder, RecursiveMode::Recursive).map_err(unwatchable)?;
                    watched.push(folder);
                }
            }
        }
        terminal::line("watching; press Ctrl-C to end");
        wait(&changes, &files)?;
    }
}

fn folder_of(file: &Path) -> PathBuf {
    match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// Returns after the next change of a relevant file, and the changes that follow closely.
fn wait(changes: &Receiver<notify::Result<Event>>, files: &[PathBuf]) -> Result<(), Failure> {
    loop {
        let event = changes.recv().map_err(|_| Failure::Usage("the watcher has ended".to_owned()))?;
        if event.is_ok_and(|event| matters(&event, files)) {
            while changes.recv_timeout(SETTLE).is_ok() {}
            return Ok(());
        }
    }
}

fn matters(event: &Event, files: &[PathBuf]) -> bool {
    let changes = event.kind.is_create() || event.kind.is_modify() || event.kind.is_remove();
    let same = |path: &Path, file: &Path| path.file_name() == file.file_name();
    let is_source = |path: &Path| path.extension().is_some_and(|suffix| suffix == "wgsl" || suffix == "ron");
    changes && event.paths.iter().any(|path| is_source(path) || files.iter().any(|file| same(path, file)))
}

#[allow(clippy::needless_pass_by_value, reason = "`map_err` hands it over")]
fn unwatchable(error: notify::Error) -> Failure {
    Failure::Usage(format!("the files cannot be watched: {error}"))
}
