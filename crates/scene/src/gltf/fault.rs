//! Mistakes in glTF files: what is wrong at which element.

use tyndall_document::{Code, Diagnostic, Diagnostics, Place};

/// Faults, and warnings, reported of one file; a broken exporter repeats one mistake for every mesh.
const MOST_FAULTS: usize = 20;

/// A mistake: a code, the element, and what is wrong with it.
#[derive(Debug)]
pub(crate) struct Fault {
    pub code: Code,
    /// `mesh 3 "roof", primitive 0, POSITION`; empty where the file as a whole is meant.
    pub element: String,
    pub message: String,
}

pub(crate) type Checked<T> = Result<T, Fault>;

impl Fault {
    pub fn new(code: Code, message: impl Into<String>) -> Fault {
        Fault { code, element: String::new(), message: message.into() }
    }

    fn text(self) -> String {
        if self.element.is_empty() { self.message } else { format!("{}: {}", self.element, self.message) }
    }
}

/// Names the element at which a fault was found.
pub(crate) trait At<T> {
    /// Puts an element in front of those named already: the outer one comes last.
    fn at(self, element: impl FnOnce() -> String) -> Checked<T>;
}

impl<T> At<T> for Checked<T> {
    fn at(self, element: impl FnOnce() -> String) -> Checked<T> {
        self.map_err(|fault| {
            let outer = element();
            let element = if fault.element.is_empty() { outer } else { format!("{outer}, {}", fault.element) };
            Fault { element, ..fault }
        })
    }
}

/// `mesh 3 "roof"`, or `mesh 3` where it has no name.
pub(crate) fn element(kind: &str, index: usize, name: Option<&str>) -> String {
    match name {
        Some(name) if !name.is_empty() => {
            let short: String = name.chars().take(40).collect();
            format!("{kind} {index} {short:?}")
        }
        _ => format!("{kind} {index}"),
    }
}

/// Collects the faults and warnings of one file.
pub(crate) struct Report {
    /// As the user knows the file.
    pub name: String,
    out: Diagnostics,
    faults: usize,
    warnings: usize,
}

impl Report {
    pub fn new(name: &str) -> Report {
        Report { name: name.to_owned(), out: Diagnostics::default(), faults: 0, warnings: 0 }
    }

    pub fn fault(&mut self, fault: Fault) {
        self.faults += 1;
        if self.faults <= MOST_FAULTS {
            self.out.push(Diagnostic::error(fault.code, Place::File(self.name.clone()), fault.text()));
        }
    }

    pub fn warn(&mut self, fault: Fault) {
        self.warnings += 1;
        if self.warnings > MOST_FAULTS {
            return;
        }
        self.out.push(Diagnostic::warning(fault.code, Place::File(self.name.clone()), fault.text()));
    }

    /// The value, or nothing where it is a fault, which is reported.
    pub fn take<T>(&mut self, checked: Checked<T>) -> Option<T> {
        checked.map_err(|fault| self.fault(fault)).ok()
    }

    pub fn failed(&self) -> bool {
        self.faults > 0
    }

    pub fn finish(self) -> Diagnostics {
        self.out
    }
}
