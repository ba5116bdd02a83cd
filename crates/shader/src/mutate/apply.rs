//! A mistake made, and loops that end.

use naga::{
    AddressSpace, Arena, BinaryOperator, Block, Expression, GlobalVariable, Handle, Literal, MathFunction,
    MemoryDecorations, Module, Scalar, Span, Statement, Type, TypeInner,
};

use super::{Edit, Mutation, Target};

/// Makes the mistake.
pub(super) fn apply(module: &mut Module, mutation: &Mutation) {
    match mutation.target {
        Target::Expression(handle) => {
            change(mutation.location.of_mut(module).expressions.get_mut(handle), mutation.edit);
        }
        Target::Call(number) => {
            let mut left = number;
            let body = &mut mutation.location.of_mut(module).body;
            each_call(body, &mut |arguments| {
                if left == 0
                    && let Edit::Swap(a, b) = mutation.edit
                {
                    arguments.swap(a, b);
                }
                left = left.wrapping_sub(1);
            });
        }
    }
}

fn change(expression: &mut Expression, edit: Edit) {
    match (edit, &mut *expression) {
        (Edit::Opposite, Expression::Binary { op, .. }) => {
            *op = match op {
                BinaryOperator::Add => BinaryOperator::Subtract,
                _ => BinaryOperator::Add,
            };
        }
        // The larger of a value and itself: an expression of the same type that may stand where this one does.
        (Edit::Become(kept), _) => {
            *expression =
                Expression::Math { fun: MathFunction::Max, arg: kept, arg1: Some(kept), arg2: None, arg3: None };
        }
        (Edit::Swap(..), Expression::Binary { left, right, .. }) => std::mem::swap(left, right),
        (Edit::Swap(..), Expression::Select { accept, reject, .. }) => std::mem::swap(accept, reject),
        (Edit::Swap(a, b), Expression::Compose { components, .. }) => components.swap(a, b),
        (Edit::Swap(1, 2), Expression::Math { arg1: Some(a), arg2: Some(b), .. }) => std::mem::swap(a, b),
        (Edit::Swap(..), Expression::Math { arg, arg1: Some(second), .. }) => std::mem::swap(arg, second),
        (Edit::Number(literal), _) => *expression = Expression::Literal(literal),
        (Edit::OtherBound, Expression::Math { fun, .. }) => {
            *fun = match fun {
                MathFunction::Min => MathFunction::Max,
                _ => MathFunction::Min,
            };
        }
        (Edit::Unlike(operand), _) => {
            *expression = Expression::Math { fun: MathFunction::Cos, arg: operand, arg1: None, arg2: None, arg3: None };
        }
        _ => {}
    }
}

fn each_call(block: &mut Block, visit: &mut dyn FnMut(&mut Vec<Handle<Expression>>)) {
    for statement in block.iter_mut() {
        match statement {
            Statement::Call { arguments, .. } => visit(arguments),
            Statement::Block(inner) => each_call(inner, visit),
            Statement::If { accept, reject, .. } => {
                each_call(accept, visit);
                each_call(reject, visit);
            }
            Statement::Switch { cases, .. } => cases.iter_mut().for_each(|case| each_call(&mut case.body, visit)),
            Statement::Loop { body, continuing, .. } => {
                each_call(body, visit);
                each_call(continuing, visit);
            }
            _ => {}
        }
    }
}

/// Whether anything is done more than once.
pub(super) fn has_loops(module: &Module) -> bool {
    fn loops(block: &Block) -> bool {
        block.iter().any(|statement| match statement {
            Statement::Block(inner) => loops(inner),
            Statement::If { accept, reject, .. } => loops(accept) || loops(reject),
            Statement::Switch { cases, .. } => cases.iter().any(|case| loops(&case.body)),
            Statement::Loop { .. } => true,
            _ => false,
        })
    }
    let functions = module.functions.iter().map(|(_, function)| function);
    functions.chain(module.entry_points.iter().map(|entry| &entry.function)).any(|function| loops(&function.body))
}

/// Gives all loops of an invocation together this many turns.
pub(super) fn bound_loops(module: &mut Module, iterations: u32) {
    let span = Span::UNDEFINED;
    let ty = module.types.insert(Type { name: None, inner: TypeInner::Scalar(Scalar::U32) }, span);
    let init = module.global_expressions.append(Expression::Literal(Literal::U32(iterations)), span);
    let left = GlobalVariable {
        name: Some("iterations_left".to_owned()),
        space: AddressSpace::Private,
        binding: None,
        ty,
        init: Some(init),
        memory_decorations: MemoryDecorations::empty(),
    };
    let left = module.global_variables.append(left, span);
    let functions = module.functions.iter_mut().map(|(_, function)| function);
    for function in functions.chain(module.entry_points.iter_mut().map(|entry| &mut entry.function)) {
        let mut body = std::mem::take(&mut function.body);
        bound(&mut body, &mut function.expressions, left);
        function.body = body;
    }
}

fn bound(block: &mut Block, expressions: &mut Arena<Expression>, left: Handle<GlobalVariable>) {
    for statement in block.iter_mut() {
        match statement {
            Statement::Block(inner) => bound(inner, expressions, left),
            Statement::If { accept, reject, .. } => {
                bound(accept, expressions, left);
                bound(reject, expressions, left);
            }
            Statement::Switch { cases, .. } => {
                cases.iter_mut().for_each(|case| bound(&mut case.body, expressions, left))
            }
            Statement::Loop { body, continuing, break_if } => {
                bound(body, expressions, left);
                let none_left = count_down(continuing, expressions, left, *break_if);
                *break_if = Some(none_left);
            }
            _ => {}
        }
    }
}

/// Adds to the block behind a loop's body: `none = left == 0; left = max(left, 1) - 1`. Gives what ends the loop.
fn count_down(
    continuing: &mut Block,
    expressions: &mut Arena<Expression>,
    left: Handle<GlobalVariable>,
    or_else: Option<Handle<Expression>>,
) -> Handle<Expression> {
    let span = Span::UNDEFINED;
    let pointer = expressions.append(Expression::GlobalVariable(left), span);
    let [zero, one] = [0, 1].map(|number| expressions.append(Expression::Literal(Literal::U32(number)), span));
    let start = expressions.len();
    let count = expressions.append(Expression::Load { pointer }, span);
    let max = Expression::Math { fun: MathFunction::Max, arg: count, arg1: Some(one), arg2: None, arg3: None };
    let some = expressions.append(max, span);
    let less = expressions.append(Expression::Binary { op: BinaryOperator::Subtract, left: some, right: one }, span);
    let mut none = expressions.append(Expression::Binary { op: BinaryOperator::Equal, left: count, right: zero }, span);
    if let Some(other) = or_else {
        let either = Expression::Binary { op: BinaryOperator::LogicalOr, left: other, right: none };
        none = expressions.append(either, span);
    }
    continuing.push(Statement::Emit(expressions.range_from(start)), span);
    continuing.push(Statement::Store { pointer, value: less }, span);
    none
}
