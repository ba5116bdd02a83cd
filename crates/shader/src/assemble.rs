//! Imports resolved, and every file that a shader needs joined to one text.

use std::collections::BTreeMap;
use std::sync::Arc;

use tyndall_document::{Diagnostic, Place, Source, Span};

use crate::codes;
use crate::library::Library;
use crate::map::{Map, SEPARATOR};
use crate::require::unmet;
use crate::scan::{Import, Scan, Target, scan};

/// Imports may nest as deep as this.
const DEEPEST: usize = 64;
/// naga follows declarations by recursion, and runs out of stack at some thousands.
const MOST_DECLARATIONS: usize = 2_000;
/// naga's spans are 32 bits wide; a text near that is not a shader.
const LONGEST: usize = 64 << 20;

/// The linked text, and where it comes from.
pub struct Assembly {
    pub text: String,
    pub map: Map,
    /// One for each file, in the order of the text: the root first.
    pub scans: Vec<(Arc<Source>, Scan)>,
    /// Mistakes that did not prevent the assembly.
    pub problems: Vec<Diagnostic>,
}

impl Assembly {
    /// The root's scan.
    pub fn root(&self) -> &(Arc<Source>, Scan) {
        &self.scans[0]
    }

    /// Where the root declares this name at module scope.
    pub fn root_place(&self, name: &str) -> Option<Place> {
        let (source, scan) = self.root();
        scan.place_of(name).map(|span| source.place(span))
    }
}

/// Joins a root and all that it imports, each file once: the root first, because WGSL wants directives (`enable`,
/// `diagnostic`) in front and does not mind the order of declarations.
///
/// # Errors
/// All mistakes found, where they would mislead naga: missing modules, cycles, requirements that are not met, unclosed brackets.
pub fn assemble(root: &Arc<Source>, library: &Library) -> Result<Assembly, Vec<Diagnostic>> {
    let mut collector = Collector {
        library,
        files: Vec::new(),
        imports: Vec::new(),
        done: BTreeMap::new(),
        chain: Vec::new(),
        broken: false,
    };
    collector.visit(root, Origin::of(root, library));
    let unmet = if collector.broken { Vec::new() } else { unmet(&collector.files, &collector.imports) };
    let broken = collector.broken || !unmet.is_empty();
    let mut assembly = join(collector.files);
    assembly.problems.extend(unmet);
    for (_, scan) in &mut assembly.scans {
        assembly.problems.append(&mut scan.problems);
    }
    let declarations: usize = assembly.scans.iter().map(|(_, scan)| scan.declared.len()).sum();
    if assembly.text.len() > LONGEST || declarations > MOST_DECLARATIONS {
        let message = format!("the shader is longer than {LONGEST} bytes or {MOST_DECLARATIONS} declarations");
        return Err(vec![Diagnostic::error(codes::SYNTAX, Place::File(root.name().to_owned()), message)]);
    }
    if broken { Err(assembly.problems) } else { Ok(assembly) }
}

/// Blanks the directives and joins the files.
fn join(files: Vec<(Arc<Source>, Scan)>) -> Assembly {
    let (mut text, mut map) = (String::new(), Map::default());
    for (source, scan) in &files {
        let start = text.len();
        map.push(start as u32, Arc::clone(source));
        let mut written = 0;
        for span in scan.directives() {
            text.push_str(&source.text()[written..span.start as usize]);
            text.extend(std::iter::repeat_n(' ', (span.end - span.start) as usize));
            written = span.end as usize;
        }
        text.push_str(&source.text()[written..]);
        text.push_str(SEPARATOR);
    }
    Assembly { text, map, scans: files, problems: Vec::new() }
}

/// Where a file comes from: it decides what the file may import.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Origin {
    Root,
    Module(String),
    File(String),
}

impl Origin {
    /// The root may be one of the library's own files: a cycle may then lead back to it.
    fn of(root: &Arc<Source>, library: &Library) -> Self {
        let same = |source: Option<&Arc<Source>>| source.is_some_and(|source| Arc::ptr_eq(source, root));
        if let Some(name) = library.module_names().find(|name| same(library.module(name))) {
            return Self::Module(name.to_owned());
        }
        library
            .file_names()
            .find(|path| same(library.file(path)))
            .map_or(Self::Root, |path| Self::File(path.to_owned()))
    }

    fn shown(&self, root: &str) -> String {
        match self {
            Self::Root => root.to_owned(),
            Self::Module(name) => name.clone(),
            Self::File(path) => path.clone(),
        }
    }
}

struct Collector<'a> {
    library: &'a Library,
    files: Vec<(Arc<Source>, Scan)>,
    /// The first import of each of them; none of the root.
    imports: Vec<Option<Place>>,
    /// Files that were begun, and whether they are finished.
    done: BTreeMap<Origin, bool>,
    /// From the root to the file being visited: which file, and the import that it is followed by.
    chain: Vec<(Origin, Option<Place>)>,
    broken: bool,
}

impl Collector<'_> {
    fn visit(&mut self, source: &Arc<Source>, origin: Origin) {
        let mut scan = scan(source);
        self.broken |= scan.broken;
        if !self.chain.is_empty() {
            refuse_entry_points(source, &mut scan);
        }
        let imports = scan.imports.clone();
        self.files.push((Arc::clone(source), scan));
        self.imports.push(self.chain.last().and_then(|(_, import)| import.clone()));
        let index = self.files.len() - 1;
        self.done.insert(origin.clone(), false);
        self.chain.push((origin.clone(), None));
        for (earlier, import) in imports.iter().enumerate() {
            let place = source.place(import.name_span);
            if let Some(link) = self.chain.last_mut() {
                link.1 = Some(place.clone());
            }
            if imports[..earlier].iter().any(|other| other.target == import.target) {
                let problem = Diagnostic::error(codes::IMPORT, place, "this file imports it twice");
                self.files[index].1.problems.push(problem.suggest("remove this line"));
            } else if let Err(problem) = self.follow(&origin, import, place) {
                self.broken = true;
                self.files[index].1.problems.push(*problem);
            }
        }
        self.chain.pop();
        self.done.insert(origin, true);
    }

    fn follow(&mut self, origin: &Origin, import: &Import, place: Place) -> Result<(), Box<Diagnostic>> {
        let (target, file) = self.resolve(origin, import, &place)?;
        match self.done.get(&target) {
            Some(true) => Ok(()),
            Some(false) => Err(Box::new(self.cycle(&target, place))),
            None if self.chain.len() >= DEEPEST => {
                let message = format!("imports nest deeper than {DEEPEST}");
                Err(Box::new(Diagnostic::error(codes::IMPORT, place, message)))
            }
            None => {
                self.visit(&file, target);
                Ok(())
            }
        }
    }

    /// The file that an import means.
    fn resolve(
        &self,
        origin: &Origin,
        import: &Import,
        place: &Place,
    ) -> Result<(Origin, Arc<Source>), Box<Diagnostic>> {
        let wrong = |message: String| Diagnostic::error(codes::IMPORT, place.clone(), message);
        match &import.target {
            Target::Module(name) => {
                if let Some(source) = self.library.module(name) {
                    return Ok((Origin::Module(name.clone()), Arc::clone(source)));
                }
                let problem = wrong(format!("there is no shared module `{name}`"));
                let file = format!("{name}.wgsl");
                let names = self.library.module_names();
                let of_plugin = self.library.file(&file).is_some() && !matches!(origin, Origin::Module(_));
                Err(Box::new(if of_plugin {
                    let otherwise = format!("the plugin's own file is imported as `#import \"{file}\"`");
                    problem.suggest_near_or(name, names, otherwise)
                } else {
                    problem.suggest_near(name, names)
                }))
            }
            Target::File(path) => {
                if matches!(origin, Origin::Module(_)) {
                    let problem = wrong(format!("a shared module imports the file `{path}`"));
                    return Err(Box::new(problem.suggest("shared modules import each other by name: `#import name`")));
                }
                let Some(inside) = inside(path) else {
                    let problem = wrong(format!("`{path}` is outside the plugin's folder"));
                    return Err(Box::new(
                        problem.suggest("a plugin imports its own files, and shared modules by name"),
                    ));
                };
                if let Some(source) = self.library.file(&inside) {
                    return Ok((Origin::File(inside), Arc::clone(source)));
                }
                let problem = wrong(format!("there is no file `{inside}` in the plugin's folder"));
                Err(Box::new(problem.suggest_near(&inside, self.library.file_names())))
            }
        }
    }

    /// The import that closes a cycle; the others of the cycle are its related places.
    fn cycle(&self, target: &Origin, place: Place) -> Diagnostic {
        let start = self.chain.iter().position(|(origin, _)| origin == target).unwrap_or_default();
        let links = &self.chain[start..];
        let root = self.files.first().map(|(root, _)| root.name()).unwrap_or_default();
        let names: Vec<_> = links.iter().map(|(origin, _)| origin).chain([target]).map(|o| o.shown(root)).collect();
        let chain = names.join(" → ");
        let mut problem = Diagnostic::error(codes::IMPORT_CYCLE, place, format!("imports form a circle: {chain}"));
        for ((_, place), name) in links[..links.len() - 1].iter().zip(&names[1..]) {
            problem =
                problem.relate(place.clone().unwrap_or_else(|| Place::File(name.clone())), format!("imports {name}"));
        }
        problem
    }
}

/// A path that stays in its folder, without `.` parts; none where it leaves it.
fn inside(path: &str) -> Option<String> {
    let parts: Vec<&str> = path.split('/').filter(|part| *part != ".").collect();
    let leaves = |part: &&str| part.is_empty() || *part == ".." || part.contains(['\\', ':']);
    (!parts.is_empty() && !parts.iter().any(leaves)).then(|| parts.join("/"))
}

/// An imported file is a module: entry points belong to the shader that is linked.
fn refuse_entry_points(source: &Arc<Source>, scan: &mut Scan) {
    for Span { start, end } in std::mem::take(&mut scan.stages) {
        let place = source.place(Span { start, end });
        let problem = Diagnostic::error(codes::ENTRY, place, "an imported file has an entry point");
        scan.problems.push(problem.suggest("move what is shared to a file of its own, and import that one"));
    }
}
