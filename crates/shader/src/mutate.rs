//! Mutants: a linked shader with one small mistake in it, to learn whether tests notice.
//!
//! A mistake is made in naga's representation of the module, in place: an expression becomes another one of the same
//! type, so that nothing else has to change. What cannot make a difference whatever the input is not offered: arguments
//! that are the same expression, the order of the arguments of what commutes, channels that the texture does not store,
//! the only mip level.
//!
//! A mutant may loop for ever, and a driver cannot be interrupted. So each is given a number of iterations, of all loops
//! of an invocation together, after which its loops end.

mod apply;
mod sites;
mod wording;

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use naga::valid::{ValidationFlags, Validator};
use naga::{Expression, Function, Handle, Literal, Module};
use tyndall_document::Place;

use crate::guard::guarded;
use crate::link::{CAPABILITIES, Linked};

/// Kinds of mistakes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum MutationKind {
    /// `a + b` becomes `a - b`, `-a` becomes `a`.
    FlipSign,
    /// `a * b` becomes `a` or `b`, `a / b` becomes `a`.
    DropFactor,
    /// Two arguments of one type change places: of a function, a constructor, `select`, a quotient.
    SwapArguments,
    /// A number becomes another: 1 more or less; twice or half of what is 2 or more; 1 for what is tiny or huge.
    ChangeConstant,
    /// `min` becomes `max`, and `max` becomes `min`.
    SwapMinMax,
}

impl MutationKind {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::FlipSign, Self::DropFactor, Self::SwapArguments, Self::ChangeConstant, Self::SwapMinMax];

    /// What it is called in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::FlipSign => "flip a sign",
            Self::DropFactor => "drop a factor",
            Self::SwapArguments => "swap arguments",
            Self::ChangeConstant => "change a constant",
            Self::SwapMinMax => "swap min and max",
        }
    }
}

/// One mistake that can be made in a linked shader.
#[derive(Debug, Clone)]
pub struct Mutation {
    /// Its kind.
    pub kind: MutationKind,
    /// The function of the linked text in which it is made.
    pub function: String,
    /// What stands there and what is put in its place: `a + b -> a - b`. With the function it names the mistake as long
    /// as that line stays as it is: of several alike in one function, all but the first end in ` #2` and so on.
    pub change: String,
    /// Where it is made.
    pub place: Place,
    location: Location,
    target: Target,
    edit: Edit,
    /// An operand of the same type, of floating-point numbers.
    operand: Option<Handle<Expression>>,
}

/// A function of a module.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Location {
    Function(Handle<Function>),
    EntryPoint(usize),
}

impl Location {
    fn of_mut(self, module: &mut Module) -> &mut Function {
        match self {
            Location::Function(handle) => module.functions.get_mut(handle),
            Location::EntryPoint(index) => &mut module.entry_points[index].function,
        }
    }
}

/// What is changed in a function.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Target {
    Expression(Handle<Expression>),
    /// A call of a function, by its number in the order of the text.
    Call(usize),
}

/// How it is changed.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Edit {
    /// Between addition and subtraction.
    Opposite,
    /// It becomes this operand, which has its type.
    Become(Handle<Expression>),
    /// These two operands change places.
    Swap(usize, usize),
    /// It becomes this number.
    Number(Literal),
    /// Between `min` and `max`.
    OtherBound,
    /// It becomes the cosine of this operand, which has its type: no mistake that anybody makes, but a way to learn
    /// whether anything depends on it.
    Unlike(Handle<Expression>),
}

impl Mutation {
    /// The same place with a value that has nothing to do with the right one: where even that changes nothing, nothing
    /// depends on the place. `None` where there is no such value.
    #[must_use]
    pub fn drastic(&self) -> Option<Self> {
        let edit = match (self.edit, self.operand) {
            (Edit::Number(Literal::F32(_)), _) => Edit::Number(Literal::F32(12_345.0)),
            (Edit::Number(Literal::U32(_)), _) => Edit::Number(Literal::U32(12_345)),
            (Edit::Number(Literal::I32(_)), _) => Edit::Number(Literal::I32(12_345)),
            (_, Some(operand)) => Edit::Unlike(operand),
            _ => return None,
        };
        Some(Self { edit, ..self.clone() })
    }
}

impl Linked {
    /// Every mistake that can be made in the functions that entry points reach, in the order of the text.
    pub fn mutations(&self) -> Vec<Mutation> {
        let mut found = sites::mutations(self);
        let mut seen: BTreeMap<(String, String), u32> = BTreeMap::new();
        for mutation in &mut found {
            let count = seen.entry((mutation.function.clone(), mutation.change.clone())).or_default();
            *count += 1;
            if *count > 1 {
                mutation.change += &format!(" #{count}");
            }
        }
        found
    }

    /// Whether it has loops, so that a mutant of it may not end.
    pub fn has_loops(&self) -> bool {
        apply::has_loops(&self.module)
    }

    /// The shader with this mistake in it, or with none; its loops end after so many iterations.
    ///
    /// # Errors
    /// Where it is no longer valid: such a mistake no compiler would let pass.
    pub fn mutant(&self, mutation: Option<&Mutation>, iterations: u32) -> Result<Self, String> {
        let mut module = self.module.clone();
        if let Some(mutation) = mutation {
            apply::apply(&mut module, mutation);
        }
        apply::bound_loops(&mut module, iterations);
        let mut validator = Validator::new(ValidationFlags::all(), CAPABILITIES);
        let info = guarded(|| validator.validate(&module))?.map_err(|error| error.as_inner().to_string())?;
        let mut hasher = DefaultHasher::new();
        let made = mutation.map(|mutation| (&mutation.function, &mutation.change, format!("{:?}", mutation.edit)));
        (self.fingerprint, made, iterations).hash(&mut hasher);
        Ok(Self {
            module,
            info,
            resources: self.resources.clone(),
            entry_points: self.entry_points.clone(),
            params: self.params.clone(),
            unused: self.unused.clone(),
            fingerprint: hasher.finish(),
            map: self.map.clone(),
        })
    }
}
