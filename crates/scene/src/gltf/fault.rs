//! Mistakes in glTF files: what is wrong at which element.

use tyndall_document::{Code, Diagnostic, Diagnostics, Place};

use crate::codes::{GLTF_IGNORED, GLTF_MODE};

/// Faults reported of one file; a broken exporter repeats one mistake for every mesh.
const MOST_FAULTS: usize = 20;
/// Elements that a warning names; of others it gives the number.
const MOST_NAMED: usize = 3;

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
    format!("{kind} {}", numbered(index, name))
}

/// `3 "roof"`, or `3` where it has no name.
pub(crate) fn numbered(index: usize, name: Option<&str>) -> String {
    match name {
        Some(name) if !name.is_empty() => {
            let short: String = name.chars().take(40).collect();
            format!("{index} {short:?}")
        }
        _ => index.to_string(),
    }
}

/// Something that a file may have and that is not drawn as the file says.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct Unread {
    code: Code,
    /// Of which kind of element, in the singular.
    kind: &'static str,
    what: &'static str,
}

impl Unread {
    const fn new(kind: &'static str, what: &'static str) -> Self {
        Self { code: GLTF_IGNORED, kind, what }
    }

    pub const SKIN: Self = Self::new("node", "skin");
    pub const ORTHOGRAPHIC: Self = Self::new("camera", "orthographic projection");
    pub const BRIGHT_COLORS: Self = Self::new("primitive", "vertex colours outside 0..1 (clamped)");
    pub const MORPH_TARGETS: Self = Self::new("primitive", "morph targets");
    pub const MORPH_WEIGHTS: Self = Self::new("channel", "weights of morph targets");
    pub const NO_TARGET: Self = Self::new("channel", "no target node");
    pub const UNKNOWN_PATH: Self = Self::new("channel", "a path other than translation, rotation and scale");
    pub const ANIMATED_TWICE: Self = Self::new("channel", "a property that another channel animates");
    pub const ALPHA: Self = Self::new("material", "alpha (drawn opaque)");
    pub const EMISSION: Self = Self::new("material", "emission");
    pub const NORMAL_MAP: Self = Self::new("material", "normal map");
    pub const OCCLUSION: Self = Self::new("material", "occlusion");
    pub const VARIED_ROUGHNESS: Self = Self::new("material", "roughness from texel to texel (its mean is used)");
    pub const METALLIC_COORDINATES: Self =
        Self::new("material", "texture coordinates of the metallic texture (its mean is used)");
    pub const POINTS_AND_LINES: Self = Self { code: GLTF_MODE, ..Self::new("primitive", "points or lines") };

    /// What becomes of it.
    fn outcome(code: Code) -> &'static str {
        if code == GLTF_MODE { "not drawn" } else { "not read" }
    }
}

/// Collects the faults of one file, and what is not read of it.
pub(crate) struct Report {
    /// As the user knows the file.
    pub name: String,
    out: Diagnostics,
    faults: usize,
    /// Each with the elements that have it.
    unread: Vec<(Unread, Vec<String>)>,
    extensions: Vec<String>,
}

impl Report {
    pub fn new(name: &str) -> Report {
        let (unread, extensions) = (Vec::new(), Vec::new());
        Report { name: name.to_owned(), out: Diagnostics::default(), faults: 0, unread, extensions }
    }

    pub fn fault(&mut self, fault: Fault) {
        self.faults += 1;
        if self.faults <= MOST_FAULTS {
            self.out.push(Diagnostic::error(fault.code, Place::File(self.name.clone()), fault.text()));
        }
    }

    /// An element (its number and name) has something that is not read.
    pub fn unread(&mut self, unread: Unread, element: String) {
        match self.unread.iter_mut().find(|(other, _)| *other == unread) {
            Some((_, elements)) => elements.push(element),
            None => self.unread.push((unread, vec![element])),
        }
    }

    /// The file uses extensions that are not read.
    pub fn unread_extensions(&mut self, names: impl IntoIterator<Item = String>) {
        self.extensions.extend(names);
    }

    /// The value, or nothing where it is a fault, which is reported.
    pub fn take<T>(&mut self, checked: Checked<T>) -> Option<T> {
        checked.map_err(|fault| self.fault(fault)).ok()
    }

    pub fn failed(&self) -> bool {
        self.faults > 0
    }

    /// Everything that is wrong, and one warning for all that is not read.
    pub fn finish(mut self) -> Diagnostics {
        for code in [GLTF_IGNORED, GLTF_MODE] {
            let unread = self.unread.iter().filter(|(unread, _)| unread.code == code);
            let mut parts: Vec<String> = unread.map(|(unread, elements)| counted(unread, elements)).collect();
            if code == GLTF_IGNORED && !self.extensions.is_empty() {
                parts.push(format!("extensions: {}", self.extensions.join(", ")));
            }
            if parts.is_empty() {
                continue;
            }
            let message = format!("{}: {}", Unread::outcome(code), parts.join("; "));
            self.out.push(Diagnostic::warning(code, Place::File(self.name.clone()), message));
        }
        self.out
    }
}

/// `material 0 "roof": emission`, or `7 materials (0 "roof", 1 "wall", 2 "door", …): emission`.
fn counted(Unread { kind, what, .. }: &Unread, elements: &[String]) -> String {
    match elements {
        [element] => format!("{kind} {element}: {what}"),
        _ => {
            let named = elements[..elements.len().min(MOST_NAMED)].join(", ");
            let more = if elements.len() > MOST_NAMED { ", …" } else { "" };
            format!("{} {kind}s ({named}{more}): {what}", elements.len())
        }
    }
}
