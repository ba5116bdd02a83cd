//! Which warnings are told.

use clap::Args;
use tyndall_document::{Code, Diagnostic, Diagnostics, Severity, near};
use tyndall_scene::codes::{GLTF_IGNORED, GLTF_MODE};

use crate::failure::Failure;

/// What the verbs that tell all warnings take.
#[derive(Debug, Clone, Args)]
pub(crate) struct WarningArguments {
    /// Tell mistakes alone, and no warnings
    #[arg(long)]
    pub quiet: bool,
    /// Do not tell warnings of this class, such as gltf-ignored; may be given more than once
    #[arg(long, value_name = "CODE")]
    pub allow: Vec<String>,
}

/// The warnings that are not told.
pub(crate) enum Untold {
    /// None of them.
    All,
    /// Of these classes.
    Of(Vec<Code>),
}

impl Untold {
    /// What the command line asks for.
    ///
    /// # Errors
    /// A class that does not exist.
    pub fn of(arguments: &WarningArguments) -> Result<Untold, Failure> {
        let codes = arguments.allow.iter().map(|name| code(name)).collect::<Result<Vec<Code>, Failure>>()?;
        Ok(if arguments.quiet { Untold::All } else { Untold::Of(codes) })
    }

    /// Of verbs that look at something else than at the picture as a whole: what of a model is not drawn is told by
    /// `check` and `render`.
    pub fn of_models() -> Untold {
        Untold::Of(vec![GLTF_IGNORED, GLTF_MODE])
    }

    /// The mistakes, and the warnings that are told.
    pub fn without(&self, found: Diagnostics) -> Diagnostics {
        found
            .into_iter()
            .filter(|diagnostic| diagnostic.severity == Severity::Error || self.tells(diagnostic))
            .collect()
    }

    fn tells(&self, warning: &Diagnostic) -> bool {
        match self {
            Untold::All => false,
            Untold::Of(codes) => !codes.contains(&warning.code),
        }
    }
}

/// The class of this name.
fn code(name: &str) -> Result<Code, Failure> {
    let all = || {
        let lists = [
            tyndall_compare::CODES,
            tyndall_document::CODES,
            tyndall_document::SHARED_CODES,
            tyndall_graph::CODES,
            tyndall_mutants::CODES,
            tyndall_plugin::CODES,
            tyndall_render::CODES,
            tyndall_scene::CODES,
            tyndall_shader::CODES,
            tyndall_testing::CODES,
        ];
        lists.into_iter().flatten()
    };
    let found = all().find(|code| code.0 == name).copied();
    found.ok_or_else(|| {
        let meant = near(name, all().map(|code| code.0)).map_or_else(
            || "a warning begins with its class: `warning[gltf-ignored]`".to_owned(),
            |near| format!("did you mean `{near}`?"),
        );
        Failure::Usage(format!("--allow {name}: there is no such class of warnings; {meant}"))
    })
}
