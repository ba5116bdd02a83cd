//! Figures as tables: plain text, Markdown and HTML from the same cells.

use tyndall_page::escaped;

use crate::errors::FLOOR;
use crate::figures::{Figures, Method, Row};

const COLUMNS: [&str; 11] =
    ["method", "p50", "p95", "p99", "max", "sum", "GPU time", "once", "CPU time", "memory", "kept"];

/// What the columns mean, in one paragraph; `mean` names the mean that errors of dark pixels are relative to.
pub(crate) fn legend(figures: &Figures) -> String {
    let Figures { adapter, size: (width, height), rounds, .. } = figures;
    let (outlines, moving, kept) = if figures.shadows {
        let outlines = " except those on outlines (another object, light or number of lit parts within 3x3 pixels), which count in the sum";
        (outlines, "the camera moves", "tables and shadow maps")
    } else {
        ("", "camera and lights move", "tables")
    };
    format!(
        "Relative error of {} against double precision, |found - true| / max(true, {:.0} % of the picture's mean), of every \
         channel of every pixel{outlines}; \"sum\": of the sum of all pixels. GPU time of the passes that make this light, without rasterising and tone mapping: \
         median of {rounds} rounds in turns; \"once\": of passes whose result stays while {moving}, as {kept} do. CPU time, on \
         one core, of what passes read of casters, made anew. Memory: what these passes write, and read of casters, in a frame \
         and (kept) once. {width}x{height}, {adapter}.",
        figures.output,
        100.0 * FLOOR
    )
}

/// What the figures over all scenes mean.
pub(crate) const OVER_ALL: &str =
    "All scenes: the median of the scenes' p50, the worst of the other errors, the sum of times, the most memory.";

/// Every table, for a terminal.
pub(crate) fn text(figures: &Figures) -> String {
    let mut text = format!("{}\n", figures.about);
    for scene in &figures.scenes {
        text += &format!("\n{}{}\n", scene.name, described(&scene.about));
        text += &aligned(&figures.methods, &scene.rows);
    }
    if figures.scenes.len() > 1 {
        text += &format!("\n{OVER_ALL}\n{}", aligned(&figures.methods, &figures.over_all()));
    }
    text + &format!("\n{}\n", legend(figures))
}

/// Every table, for a README: all scenes first.
pub(crate) fn markdown(figures: &Figures) -> String {
    let mut text = format!("{}\n", legend(figures));
    if figures.scenes.len() > 1 {
        text += &format!("\n{OVER_ALL}\n\n{}", pipes(&figures.methods, &figures.over_all()));
    }
    for scene in &figures.scenes {
        text += &format!("\n**{}**{}\n\n{}", scene.name, described(&scene.about), pipes(&figures.methods, &scene.rows));
    }
    text
}

/// One table, for the page.
pub(crate) fn html(methods: &[Method], rows: &[Row]) -> String {
    let head: String = COLUMNS.iter().map(|column| format!("<th scope=\"col\">{column}</th>")).collect();
    let mut text = format!("<div class=\"wide\"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n");
    for cells in cells(methods, rows) {
        let [name, figures @ ..] = &cells;
        let figures: String = figures.iter().map(|cell| format!("<td>{}</td>", escaped(cell))).collect();
        text += &format!("<tr><th scope=\"row\">{}</th>{figures}</tr>\n", escaped(name));
    }
    text + "</tbody>\n</table></div>\n"
}

fn described(about: &str) -> String {
    if about.is_empty() { String::new() } else { format!(": {about}") }
}

fn aligned(methods: &[Method], rows: &[Row]) -> String {
    let mut lines = vec![COLUMNS.map(str::to_owned)];
    lines.extend(cells(methods, rows));
    let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or_default();
    let widths: Vec<usize> = (0..COLUMNS.len()).map(width).collect();
    let padded = |line: &[String; 11]| {
        let name = format!("{:<width$}", line[0], width = widths[0]);
        let rest = (1..11).map(|column| format!("  {:>width$}", line[column], width = widths[column]));
        name + &rest.collect::<String>() + "\n"
    };
    lines.iter().map(padded).collect()
}

fn pipes(methods: &[Method], rows: &[Row]) -> String {
    let line = |cells: &[String; 11]| format!("| {} |\n", cells.join(" | "));
    let rule = format!("| --- {}|\n", "| ---: ".repeat(COLUMNS.len() - 1));
    let rows: String = cells(methods, rows).iter().map(line).collect();
    line(&COLUMNS.map(str::to_owned)) + &rule + &rows
}

fn cells(methods: &[Method], rows: &[Row]) -> Vec<[String; 11]> {
    let row = |(method, row): (&Method, &Row)| {
        let bytes = |bytes: u64| if bytes == 0 { "-".to_owned() } else { tyndall_gpu::bytes(bytes) };
        let once = row.cost.set_up_us.filter(|us| *us > 0.0);
        [
            method.name.clone(),
            error(row.p50),
            error(row.p95),
            error(row.p99),
            error(row.max),
            error(row.sum),
            time(row.cost.frame_us),
            time(once),
            time(row.cost.scene_us),
            bytes(row.cost.frame_bytes),
            bytes(row.cost.set_up_bytes),
        ]
    };
    methods.iter().zip(rows).map(row).collect()
}

/// Two digits: percent from 0.01 % on, below that a power of ten; from ten on as a factor.
pub(crate) fn error(error: f64) -> String {
    let percent = 100.0 * error;
    match percent {
        0.0 => "0".to_owned(),
        _ if !percent.is_finite() => "∞".to_owned(),
        _ if percent < 0.01 => format!("{error:.1e}"),
        _ if percent < 0.1 => format!("{percent:.3} %"),
        _ if percent < 1.0 => format!("{percent:.2} %"),
        _ if percent < 10.0 => format!("{percent:.1} %"),
        _ if percent < 999.5 => format!("{percent:.0} %"),
        _ => format!("{error:.0}×"),
    }
}

/// Three digits, of milliseconds or of microseconds.
pub(crate) fn time(us: Option<f64>) -> String {
    match us {
        None => "-".to_owned(),
        Some(us) if us < 99.5 => format!("{us:.1} µs"),
        Some(us) if us < 9_995.0 => format!("{:.2} ms", us / 1e3),
        Some(us) if us < 99_950.0 => format!("{:.1} ms", us / 1e3),
        Some(us) => format!("{:.0} ms", us / 1e3),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_have_two_digits() {
        let texts = [0.0, 1.234e-6, 9.87e-5, 1.5e-4, 0.00234, 0.0456, 0.789, 3.9, 129.47, f64::INFINITY].map(error);
        assert_eq!(texts, ["0", "1.2e-6", "9.9e-5", "0.015 %", "0.23 %", "4.6 %", "79 %", "390 %", "129×", "∞"]);
    }

    #[test]
    fn times_have_three() {
        let texts = [Some(4.26), Some(123.0), Some(4567.0), Some(45_670.0), Some(456_700.0), None].map(time);
        assert_eq!(texts, ["4.3 µs", "0.12 ms", "4.57 ms", "45.7 ms", "457 ms", "-"]);
    }
}
