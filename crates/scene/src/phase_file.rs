//! Files of measured phase functions: rows of scattering angle in degrees and value in any unit, as Mie codes write them.
//!
//! Two columns, separated by spaces, tabs, a comma or a semicolon; what stands behind `#` is a comment, and so is a first
//! row of words. Further columns are a mistake, as nobody knows which one is meant.

use std::path::Path;
use std::sync::Arc;

use tyndall_document::{Diagnostic, Diagnostics, Place, Source, Span};
use tyndall_shaders::phase::PhaseTable;
use tyndall_shaders::phase_table::TableFault;

use crate::codes::PHASE_TABLE;

/// The phase function of a file; mistakes go to `out`, related to the place that names the file.
pub(crate) fn read(path: &Path, named: &Place, out: &mut Diagnostics) -> Option<&'static PhaseTable> {
    let mistake = match Source::read(path) {
        Ok(source) => match rows(&source).and_then(|rows| table(&source, &rows)) {
            Ok(table) => return Some(table),
            Err(mistake) => *mistake,
        },
        Err(mistake) => mistake,
    };
    out.push(mistake.relate(named.clone(), "named here"));
    None
}

/// A row and where it stands.
struct Row {
    numbers: (f64, f64),
    spans: [Span; 2],
}

type Mistake = Box<Diagnostic>;

fn rows(source: &Arc<Source>) -> Result<Vec<Row>, Mistake> {
    let mut rows = Vec::new();
    let mut titled = false;
    let mut start = 0;
    for line in source.text().split_inclusive('\n') {
        let content = line.split('#').next().unwrap_or_default();
        let words: Vec<Span> = words(content, start);
        start += line.len() as u32;
        if words.is_empty() {
            continue;
        }
        let numbers: Vec<Option<f64>> = words.iter().map(|word| source.slice(*word).parse().ok()).collect();
        if rows.is_empty() && !titled && numbers.iter().all(Option::is_none) {
            titled = true;
            continue;
        }
        rows.push(row(source, &words, &numbers)?);
    }
    Ok(rows)
}

fn words(content: &str, start: u32) -> Vec<Span> {
    let offset = |word: &str| start + (word.as_ptr() as usize - content.as_ptr() as usize) as u32;
    let words = content.split(|c: char| c.is_whitespace() || c == ',' || c == ';').filter(|word| !word.is_empty());
    words.map(|word| Span::new(offset(word), offset(word) + word.len() as u32)).collect()
}

fn row(source: &Arc<Source>, words: &[Span], numbers: &[Option<f64>]) -> Result<Row, Mistake> {
    if let Some(at) = numbers.iter().position(Option::is_none) {
        let message = format!("`{}` is not a number", source.slice(words[at]));
        return Err(mistake(source, words[at], message));
    }
    match (numbers, words) {
        (&[Some(angle), Some(value)], &[first, second]) => Ok(Row { numbers: (angle, value), spans: [first, second] }),
        _ => {
            let message = format!("a row holds an angle and a value, and here are {} numbers", words.len());
            Err(mistake(source, words[0].to(words[words.len() - 1]), message))
        }
    }
}

fn table(source: &Arc<Source>, rows: &[Row]) -> Result<&'static PhaseTable, Mistake> {
    let numbers: Vec<(f64, f64)> = rows.iter().map(|row| row.numbers).collect();
    PhaseTable::new(&numbers).map_err(|fault| mistake_in(source, rows, fault))
}

fn mistake_in(source: &Arc<Source>, rows: &[Row], fault: TableFault) -> Mistake {
    let whole = Span::new(0, source.text().len().min(1) as u32);
    let of = |row: usize, column: usize| (rows[row].spans[column], source.slice(rows[row].spans[column]));
    let (span, message) = match fault {
        TableFault::TooFew => (whole, format!("a phase function takes two rows at least, and here are {}", rows.len())),
        TableFault::NotFinite { row } => {
            let column = usize::from(rows[row].numbers.0.is_finite());
            let (span, text) = of(row, column);
            (span, format!("`{text}` is not a finite number"))
        }
        TableFault::Negative { row } => {
            let (span, text) = of(row, 1);
            (span, format!("the value is {text}; no light is scattered less than not at all"))
        }
        TableFault::NotAscending { row } => {
            let (span, text) = of(row, 0);
            (span, format!("{text}° follows {}°; angles must ascend", of(row - 1, 0).1))
        }
        TableFault::Start => {
            let (span, text) = of(0, 0);
            (span, format!("the first angle is {text}°; a phase function begins at 0°, forward"))
        }
        TableFault::End => {
            let (span, text) = of(rows.len() - 1, 0);
            (span, format!("the last angle is {text}°; a phase function ends at 180°, backward"))
        }
        TableFault::Integral => (whole, "its integral over the sphere is not above 0 and finite".to_owned()),
    };
    mistake(source, span, message)
}

fn mistake(source: &Arc<Source>, span: Span, message: String) -> Mistake {
    let hint = "rows are a scattering angle in degrees, ascending from 0 to 180, and a value of 0 or more";
    Box::new(Diagnostic::error(PHASE_TABLE, source.place(span), message).suggest(hint))
}
