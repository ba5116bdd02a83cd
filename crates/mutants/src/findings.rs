//! What became of mutants, one by one.

use std::time::Duration;

use tyndall_shader::Mutation;

/// What became of the mutants of a pass.
#[derive(Debug)]
pub struct PassFindings {
    /// `plugin.pass`.
    pub pass: String,
    /// Tests that run it.
    pub tests: usize,
    /// Mistakes that can be made in its shaders; 0 where it has none.
    pub sites: usize,
    /// Drawn mistakes that no compiler or driver takes, and which do not count.
    pub invalid: usize,
    /// The mutants.
    pub mutants: Vec<Mutant>,
    /// Time for all of them.
    pub took: Duration,
}

/// One mutant, and what became of it.
#[derive(Debug)]
pub struct Mutant {
    /// The shader's file.
    pub file: String,
    /// What was changed.
    pub mutation: Mutation,
    /// By properties, references and relations alone.
    pub without_goldens: Verdict,
    /// By everything; what they alone found where they killed it, or where goldens are left out.
    pub verdict: Verdict,
    /// Why it survives, as somebody wrote it down.
    pub reason: Option<String>,
}

/// What became of a mutant.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// A test fails, and names the pass.
    Killed {
        /// The test.
        test: String,
    },
    /// A test fails, and names other passes.
    Misnamed {
        /// The test.
        test: String,
        /// The passes that it names, by their kinds.
        named: Vec<String>,
    },
    /// No test runs the pass.
    Untested,
    /// Whatever stands in the place, no port comes out different.
    Unreached,
    /// No port comes out different, though something else in the place would show.
    SameBits,
    /// Ports come out different, within what tests allow; and the check that came nearest, if any asks by how much.
    Tolerated(Option<Nearest>),
}

/// The check that came nearest to a failure.
#[derive(Debug, Clone, PartialEq)]
pub struct Nearest {
    /// The part of its tolerance that was used up.
    pub excess: f64,
    /// What it asks of which port of which test.
    pub check: String,
}

impl Verdict {
    /// It is killed.
    pub fn is_killed(&self) -> bool {
        matches!(self, Verdict::Killed { .. })
    }
}
