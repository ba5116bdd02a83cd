//! `#require`: what a module uses and leaves to the shader that imports it, as a loop does with its body.

use std::sync::Arc;

use tyndall_document::{Diagnostic, Place, Source};

use crate::assemble::Assembly;
use crate::codes;
use crate::scan::lexer::{Lexer, Token};
use crate::scan::{Requirement, Scan};

/// Requirements that no file of a shader meets, each at the import that brought it in. `imports` has the place of the
/// first import of each file, none of the root.
pub fn unmet(files: &[(Arc<Source>, Scan)], imports: &[Option<Place>]) -> Vec<Diagnostic> {
    let mut problems = Vec::new();
    for ((source, scan), import) in files.iter().zip(imports) {
        for required in &scan.requirements {
            let Requirement { name, declaration, span } = required;
            if declared(files, name).is_some() {
                continue;
            }
            let here = source.place(*span);
            let problem = match import {
                Some(import) => {
                    let message = format!("nothing declares `{name}`, which this import requires");
                    Diagnostic::error(codes::IMPORT, import.clone(), message).relate(here, "required here")
                }
                None => {
                    let message = format!("nothing declares `{name}`, which this file requires");
                    Diagnostic::error(codes::IMPORT, here, message)
                }
            };
            problems.push(problem.suggest(format!("declare `{declaration}`")));
        }
    }
    problems
}

/// Lays a mistake that naga finds in a module at the declaration that the module requires, where it is about one: the
/// module is right about what it asks for, and its author did not write the other.
pub fn blame(assembly: &Assembly, mut problem: Diagnostic) -> Diagnostic {
    let Place::Text { source, span } = problem.place.clone() else { return problem };
    let Some((_, scan)) = assembly.scans.iter().find(|(other, _)| Arc::ptr_eq(other, &source)) else { return problem };
    let message = problem.message.clone();
    let mentions = |name: &str| {
        let in_text = || Lexer::new(source.slice(span)).any(|(token, _)| token == Token::Word(name));
        message.contains(&format!("`{name}`")) || in_text()
    };
    let of = |required: &Requirement| declared(&assembly.scans, &required.name);
    let about = scan.requirements.iter().find(|required| mentions(&required.name));
    if let Some((required, place)) = about.and_then(|required| Some((required, of(required)?))) {
        let used = std::mem::replace(&mut problem.place, place);
        problem.message = format!("`{}` is not what `{}` requires: {message}", required.name, source.name());
        return problem.relate(used, "used here").suggest(format!("it must be `{}`", required.declaration));
    }
    let declared = scan.requirements.iter().filter_map(|required| Some((required, of(required)?)));
    declared.fold(problem, |problem, (required, place)| {
        problem.relate(place, format!("declared here, required as `{}`", required.declaration))
    })
}

fn declared(files: &[(Arc<Source>, Scan)], name: &str) -> Option<Place> {
    files.iter().find_map(|(source, scan)| Some(source.place(scan.place_of(name)?)))
}
