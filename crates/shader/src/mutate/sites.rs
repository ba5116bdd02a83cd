//! Where which mistake can be made.

use std::collections::{BTreeSet, HashSet};

use naga::valid::FunctionInfo;
use naga::{
    BinaryOperator, Block, Expression, Function, Handle, Literal, MathFunction, Module, ScalarKind, Statement,
    TypeInner, UnaryOperator,
};

use super::wording::Wording;
use super::{Edit, Location, Mutation, MutationKind, Target};
use crate::link::Linked;
use crate::naming::UNFINISHED;
use crate::reflect::storage_format;

/// All mutations of the functions that entry points reach.
pub(super) fn mutations(linked: &Linked) -> Vec<Mutation> {
    let module = &linked.module;
    let mut found = Vec::new();
    let mut reached = BTreeSet::new();
    for (index, entry) in module.entry_points.iter().enumerate() {
        let info = linked.info.get_entry_point(index);
        Sites { linked, info, location: Location::EntryPoint(index), function: &entry.function, name: &entry.name }
            .find(&mut found);
        reach(module, &entry.function.body, &mut reached);
    }
    for handle in reached {
        let function = &module.functions[handle];
        let name = function.name.as_deref().unwrap_or_default();
        Sites { linked, info: &linked.info[handle], location: Location::Function(handle), function, name }
            .find(&mut found);
    }
    found
}

fn reach(module: &Module, block: &Block, reached: &mut BTreeSet<Handle<Function>>) {
    each_statement(block, &mut |statement| {
        if let Statement::Call { function, .. } = statement
            && reached.insert(*function)
        {
            reach(module, &module.functions[*function].body, reached);
        }
    });
}

/// Every statement of a block and of the blocks in it, in the order of the text.
pub(super) fn each_statement(block: &Block, visit: &mut dyn FnMut(&Statement)) {
    for statement in block {
        visit(statement);
        match statement {
            Statement::Block(inner) => each_statement(inner, visit),
            Statement::If { accept, reject, .. } => {
                each_statement(accept, visit);
                each_statement(reject, visit);
            }
            Statement::Switch { cases, .. } => cases.iter().for_each(|case| each_statement(&case.body, visit)),
            Statement::Loop { body, continuing, .. } => {
                each_statement(body, visit);
                each_statement(continuing, visit);
            }
            _ => {}
        }
    }
}

/// The mutations of one function.
struct Sites<'a> {
    linked: &'a Linked,
    info: &'a FunctionInfo,
    location: Location,
    function: &'a Function,
    name: &'a str,
}

impl Sites<'_> {
    fn find(&self, found: &mut Vec<Mutation>) {
        let idle = self.idle();
        let before = found.len();
        for (handle, expression) in self.function.expressions.iter() {
            if self.info[handle].ref_count > 0 && !idle.contains(&handle) {
                self.expression(handle, expression, &idle, found);
            }
        }
        let mut call = 0;
        each_statement(&self.function.body, &mut |statement| {
            if let Statement::Call { function, arguments, .. } = statement {
                self.call(call, *function, arguments, found);
                call += 1;
            }
        });
        found[before..].sort_by_key(|mutation| match &mutation.place {
            tyndall_document::Place::Text { span, .. } => span.start,
            _ => 0,
        });
    }

    /// Expressions in which no mistake matters: mip levels, channels that a texture does not store, what counts the
    /// turns of a loop, where a mistake only takes time, and by how much threads count that were left unfinished.
    fn idle(&self) -> HashSet<Handle<Expression>> {
        let mut idle = HashSet::new();
        for (_, expression) in self.function.expressions.iter() {
            if let Expression::ImageLoad { level: Some(level), .. } = expression {
                idle.insert(*level);
            }
        }
        each_statement(&self.function.body, &mut |statement| match statement {
            Statement::ImageStore { image, value, .. } => {
                if let (Some(stored), Expression::Compose { components, .. }) =
                    (self.channels(*image), &self.function.expressions[*value])
                    && components.len() == 4
                {
                    idle.extend(components.iter().skip(stored));
                }
            }
            Statement::Atomic { pointer, value, .. } if self.is_unfinished(*pointer) => {
                idle.insert(*value);
            }
            Statement::Store { pointer, value } if self.counts(*pointer, *value) => {
                idle.insert(*value);
                if let Expression::Binary { right, .. } = self.function.expressions[*value] {
                    idle.insert(right);
                }
            }
            _ => {}
        });
        idle
    }

    /// Channels that a storage texture keeps.
    fn channels(&self, image: Handle<Expression>) -> Option<usize> {
        match self.info[image].ty.inner_with(&self.linked.module.types) {
            TypeInner::Image { class: naga::ImageClass::Storage { format, .. }, .. } => {
                storage_format(*format).map(|format| format.channels() as usize)
            }
            _ => None,
        }
    }

    /// Whether it is the count of threads whose loops were ended early, which is not a port.
    fn is_unfinished(&self, pointer: Handle<Expression>) -> bool {
        let Expression::GlobalVariable(global) = self.function.expressions[pointer] else { return false };
        self.linked.module.global_variables[global].name.as_deref() == Some(UNFINISHED)
    }

    /// `i += 1` of a whole number.
    fn counts(&self, pointer: Handle<Expression>, value: Handle<Expression>) -> bool {
        let expressions = &self.function.expressions;
        let Expression::Binary { op: BinaryOperator::Add, left, right } = expressions[value] else { return false };
        let one = matches!(expressions[right], Expression::Literal(Literal::U32(1) | Literal::I32(1)));
        let of_itself = matches!(expressions[left], Expression::Load { pointer: from } if self.alike(from, pointer));
        one && of_itself
    }

    fn expression(
        &self,
        handle: Handle<Expression>,
        expression: &Expression,
        idle: &HashSet<Handle<Expression>>,
        found: &mut Vec<Mutation>,
    ) {
        use MutationKind::{ChangeConstant, DropFactor, FlipSign, SwapArguments, SwapMinMax};
        let mut add = |kind, edit| self.add(kind, Target::Expression(handle), edit, found);
        match *expression {
            Expression::Unary { op: UnaryOperator::Negate, expr } => add(FlipSign, Edit::Become(expr)),
            Expression::Binary { op: BinaryOperator::Add | BinaryOperator::Subtract, .. } => {
                add(FlipSign, Edit::Opposite);
            }
            Expression::Binary { op: BinaryOperator::Multiply, left, right } => {
                for kept in [left, right].into_iter().filter(|kept| self.same_type(*kept, handle)) {
                    add(DropFactor, Edit::Become(kept));
                }
            }
            Expression::Binary { op: BinaryOperator::Divide, left, right } => {
                if self.same_type(left, handle) {
                    add(DropFactor, Edit::Become(left));
                }
                if self.swappable(left, right) {
                    add(SwapArguments, Edit::Swap(0, 1));
                }
            }
            Expression::Select { accept, reject, .. } if self.swappable(accept, reject) => {
                add(SwapArguments, Edit::Swap(0, 1));
            }
            Expression::Compose { ref components, .. } => {
                for (a, b) in pairs(components.len()) {
                    let stored = !idle.contains(&components[a]) && !idle.contains(&components[b]);
                    if stored && self.swappable(components[a], components[b]) {
                        add(SwapArguments, Edit::Swap(a, b));
                    }
                }
            }
            Expression::Math { fun: MathFunction::Min | MathFunction::Max, arg, arg1: Some(other), .. }
                if !self.alike(arg, other) =>
            {
                add(SwapMinMax, Edit::OtherBound);
            }
            Expression::Math { fun, arg, arg1: Some(second), arg2, .. } => {
                let pair = match fun {
                    MathFunction::Clamp => arg2.map(|third| ((1, 2), (second, third))),
                    _ if is_ordered(fun) => Some(((0, 1), (arg, second))),
                    _ => None,
                };
                if let Some(((a, b), (first, second))) = pair
                    && self.swappable(first, second)
                {
                    add(SwapArguments, Edit::Swap(a, b));
                }
            }
            Expression::Literal(literal) => {
                others(literal).into_iter().for_each(|other| add(ChangeConstant, Edit::Number(other)));
            }
            Expression::Constant(constant) => {
                let module = &self.linked.module;
                if let Expression::Literal(literal) = module.global_expressions[module.constants[constant].init] {
                    others(literal).into_iter().for_each(|other| add(ChangeConstant, Edit::Number(other)));
                }
            }
            _ => {}
        }
    }

    fn call(
        &self,
        number: usize,
        function: Handle<Function>,
        arguments: &[Handle<Expression>],
        found: &mut Vec<Mutation>,
    ) {
        let expected = self.linked.module.functions[function].arguments.len();
        for (a, b) in pairs(arguments.len().min(expected)) {
            if self.swappable(arguments[a], arguments[b]) {
                self.add(MutationKind::SwapArguments, Target::Call(number), Edit::Swap(a, b), found);
            }
        }
    }

    fn add(&self, kind: MutationKind, target: Target, edit: Edit, found: &mut Vec<Mutation>) {
        let wording = Wording { linked: self.linked, function: self.function };
        let Some((place, change)) = wording.of(target, edit) else { return };
        let (function, location, operand) = (self.name.to_owned(), self.location, self.operand(target));
        found.push(Mutation { kind, function, change, place, location, target, edit, operand });
    }

    /// An operand that has the type of the whole, where that is of floating-point numbers.
    fn operand(&self, target: Target) -> Option<Handle<Expression>> {
        let Target::Expression(whole) = target else { return None };
        let operands = match &self.function.expressions[whole] {
            Expression::Unary { expr, .. } => vec![*expr],
            Expression::Binary { left, right, .. } => vec![*left, *right],
            Expression::Select { accept, reject, .. } => vec![*accept, *reject],
            Expression::Math { arg, arg1, .. } => [Some(*arg), *arg1].into_iter().flatten().collect(),
            _ => Vec::new(),
        };
        let is_float = |inner: &TypeInner| matches!(inner, TypeInner::Scalar(scalar) | TypeInner::Vector { scalar, .. } if scalar.kind == ScalarKind::Float);
        operands.into_iter().find(|operand| self.same_type(*operand, whole) && is_float(self.type_of(whole)))
    }

    fn type_of(&self, handle: Handle<Expression>) -> &TypeInner {
        self.info[handle].ty.inner_with(&self.linked.module.types)
    }

    fn same_type(&self, a: Handle<Expression>, b: Handle<Expression>) -> bool {
        self.type_of(a) == self.type_of(b)
    }

    /// Values of one type that are not the same.
    fn swappable(&self, a: Handle<Expression>, b: Handle<Expression>) -> bool {
        let is_value = self.type_of(a).scalar_kind().is_some_and(|kind| kind != ScalarKind::Bool) || self.is_texture(a);
        self.same_type(a, b) && is_value && !self.alike(a, b)
    }

    fn is_texture(&self, handle: Handle<Expression>) -> bool {
        matches!(self.type_of(handle), TypeInner::Image { .. } | TypeInner::Struct { .. })
    }

    /// The same expression, written twice.
    fn alike(&self, a: Handle<Expression>, b: Handle<Expression>) -> bool {
        use Expression::{AccessIndex, Binary, Load, Splat, Swizzle, Unary};
        let expressions = &self.function.expressions;
        a == b
            || match (&expressions[a], &expressions[b]) {
                (Load { pointer: a }, Load { pointer: b }) => self.alike(*a, *b),
                (AccessIndex { base: a, index: i }, AccessIndex { base: b, index: j }) => i == j && self.alike(*a, *b),
                (Splat { size: m, value: a }, Splat { size: n, value: b }) => m == n && self.alike(*a, *b),
                (Unary { op: o, expr: a }, Unary { op: p, expr: b }) => o == p && self.alike(*a, *b),
                (Swizzle { size: m, vector: a, pattern: p }, Swizzle { size: n, vector: b, pattern: q }) => {
                    m == n && p == q && self.alike(*a, *b)
                }
                (Binary { op: o, left: a, right: x }, Binary { op: p, left: b, right: y }) => {
                    o == p && self.alike(*a, *b) && self.alike(*x, *y)
                }
                (a, b) => is_plain(a) && a == b,
            }
    }
}

/// An expression without others in it.
fn is_plain(expression: &Expression) -> bool {
    matches!(
        expression,
        Expression::Literal(_)
            | Expression::Constant(_)
            | Expression::Override(_)
            | Expression::ZeroValue(_)
            | Expression::FunctionArgument(_)
            | Expression::GlobalVariable(_)
            | Expression::LocalVariable(_)
    )
}

fn pairs(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..count).flat_map(move |a| (a + 1..count).map(move |b| (a, b)))
}

/// Functions whose first two arguments are not interchangeable.
fn is_ordered(fun: MathFunction) -> bool {
    use MathFunction::{Atan2, Cross, FaceForward, Mix, Pow, Reflect, Refract, SmoothStep, Step};
    matches!(fun, Atan2 | Cross | FaceForward | Mix | Pow | Reflect | Refract | SmoothStep | Step)
}

/// What a number may become.
fn others(literal: Literal) -> Vec<Literal> {
    let floats = |value: f32| match value.abs() {
        size if size > 0.0 && !(1e-6..=1e6).contains(&size) => vec![1.0],
        size if size >= 2.0 => vec![2.0 * value, 0.5 * value],
        _ => vec![value + 1.0, value - 1.0],
    };
    match literal {
        Literal::F32(value) => floats(value).into_iter().map(Literal::F32).collect(),
        Literal::U32(value) => {
            let near = [value.checked_add(1), value.checked_sub(1)];
            near.into_iter().flatten().map(Literal::U32).collect()
        }
        Literal::I32(value) => {
            let near = [value.checked_add(1), value.checked_sub(1)];
            near.into_iter().flatten().map(Literal::I32).collect()
        }
        _ => Vec::new(),
    }
}
