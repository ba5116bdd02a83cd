//! `compare`: the same scenes by every method, against light in double precision.

use std::path::Path;

use indicatif::{ProgressBar, ProgressStyle};
use tyndall_compare::{CompareFile, Entry, compare, prepare, read, steps};
use tyndall_document::{Diagnostics, Source, render_text};
use tyndall_gpu::Gpu;
use tyndall_plugin::Registry;

use crate::App;
use crate::cli::{Arguments, Compare};
use crate::failure::Failure;
use crate::{plugins, terminal};

pub(crate) fn run(app: &App, arguments: &Arguments, verb: &Compare) -> Result<(), Failure> {
    let mut out = Diagnostics::default();
    let source = Source::read(&verb.file)?;
    let file = read(&source, &mut out).ok_or_else(|| out.clone())?;
    let file = chosen(file, verb)?;
    let registry = registry(app, arguments, &verb.file, &file)?;
    let scenes = prepare(&file, &registry, &mut out);
    if out.has_errors() {
        return Err(out.into());
    }
    if !out.is_empty() {
        terminal::error(&render_text(&out, terminal::color()));
    }
    if verb.out.exists() && !verb.out.is_dir() {
        return Err(Failure::Usage(format!("--out {} is not a folder", verb.out.display())));
    }
    let gpu = Gpu::open(verb.adapter.as_deref())?;
    let bar = bar(steps(&file, verb.rounds));
    let progress = |doing: Option<&str>, done: u64| {
        if let Some(doing) = doing {
            bar.set_message(doing.to_owned());
        }
        bar.inc(done);
    };
    let comparison = compare(&gpu, &registry, &file, &scenes, verb.rounds, &progress);
    bar.finish_and_clear();
    let comparison = comparison.map_err(|error| {
        terminal::error(&format!("error: {error}"));
        Failure::Reported(Failure::from(error.cause().clone()).exit_code())
    })?;
    let mut written = comparison.write(&verb.out)?;
    if let Some(path) = &verb.json {
        tyndall_image::write_bytes(path, format!("{:#}\n", comparison.json()).as_bytes())?;
        written.push(path.clone());
    }
    terminal::text(&comparison.text());
    terminal::line("");
    written.iter().for_each(|path| terminal::line(&format!("wrote {}", path.display())));
    Ok(())
}

/// The passes that a comparison's graphs can use, those of plugins beside it and beside the graphs included.
pub(crate) fn registry(app: &App, arguments: &Arguments, path: &Path, file: &CompareFile) -> Result<Registry, Failure> {
    let paths: Vec<&Path> = file.methods.iter().map(|method| method.path.as_path()).chain([path]).collect();
    plugins::registry(app, arguments, &paths)
}

/// The file, with only the entries that the command line asks for.
fn chosen(mut file: CompareFile, verb: &Compare) -> Result<CompareFile, Failure> {
    file.scenes = filtered(file.scenes, "--scene", &verb.scene)?;
    file.methods = filtered(file.methods, "--method", &verb.method)?;
    file.size = verb.size.unwrap_or(file.size);
    Ok(file)
}

/// The entries whose names contain one of `wanted`, in any case; all if nothing is wanted.
fn filtered(entries: Vec<Entry>, argument: &str, wanted: &[String]) -> Result<Vec<Entry>, Failure> {
    let holds = |entry: &Entry, part: &String| entry.name.to_lowercase().contains(&part.to_lowercase());
    if let Some(part) = wanted.iter().find(|part| !entries.iter().any(|entry| holds(entry, part))) {
        let names: Vec<String> = entries.iter().map(|entry| format!("`{}`", entry.name)).collect();
        let message = format!("{argument} {part}: no name in the file contains this; available: {}", names.join(", "));
        return Err(Failure::Usage(message));
    }
    Ok(entries.into_iter().filter(|entry| wanted.is_empty() || wanted.iter().any(|part| holds(entry, part))).collect())
}

/// Progress on a terminal.
fn bar(steps: u64) -> ProgressBar {
    let bar = ProgressBar::new(steps);
    let style = ProgressStyle::with_template("{bar:30} {percent} % {msg}");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar
}
