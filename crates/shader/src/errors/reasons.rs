//! The commoner errors of naga, with names and types in place of its handles and internal notation.

use naga::common::wgsl::TypeContext as _;
use naga::valid::{CallError, EntryPointError, ExpressionError, FunctionError, ValidationError};
use naga::{BinaryOperator, Handle, Module, Type, TypeInner};

use crate::types::type_name;

/// What a mistake is, worded for an author; `None` where naga's own words must do.
pub fn known(module: &Module, error: &ValidationError) -> Option<String> {
    match error {
        ValidationError::Function { source, .. }
        | ValidationError::EntryPoint { source: EntryPointError::Function(source), .. } => function(module, source),
        _ => None,
    }
}

fn function(module: &Module, error: &FunctionError) -> Option<String> {
    Some(match error {
        FunctionError::Expression { source, .. } => return expression(module, source),
        FunctionError::InvalidReturnType { expression, expected_ty } => {
            returned(module, expression.is_some(), *expected_ty)
        }
        FunctionError::InvalidStorePointer(_) => "this cannot be written to".to_owned(),
        FunctionError::InvalidStoreTypes { .. } => {
            "the value does not have the type of the place where it is stored".to_owned()
        }
        FunctionError::InvalidStoreValue { actual_ty, expected_ty, .. } => {
            let (actual, expected) = (inner_name(module, actual_ty), inner_name(module, expected_ty));
            format!("the texture stores `{expected}`, but the value is `{actual}`")
        }
        FunctionError::InvalidCall { function, error: CallError::ArgumentType { index, required, .. } } => {
            let callee = module.functions[*function].name.as_deref().unwrap_or("the function");
            format!("argument {} of `{callee}` must be a `{}`", index + 1, type_name(module, *required))
        }
        _ => return None,
    })
}

fn returned(module: &Module, value: bool, expected: Option<Handle<Type>>) -> String {
    match (value, expected) {
        (true, Some(ty)) => format!("the function returns `{}`, but the value has another type", type_name(module, ty)),
        (false, Some(ty)) => format!("it ends without returning a `{}`", type_name(module, ty)),
        _ => "it returns a value, but declares no return type".to_owned(),
    }
}

fn expression(module: &Module, error: &ExpressionError) -> Option<String> {
    match error {
        ExpressionError::InvalidBinaryOperandTypes { op, lhs_type, rhs_type, .. } => {
            let (left, right) = (inner_name(module, lhs_type), inner_name(module, rhs_type));
            Some(format!("`{}` does not take a `{left}` and a `{right}`", operator(*op)))
        }
        _ => None,
    }
}

fn inner_name(module: &Module, inner: &TypeInner) -> String {
    let mut name = String::new();
    match module.to_ctx().write_type_inner(inner, &mut name) {
        Ok(()) => name,
        Err(_) => format!("{inner:?}"),
    }
}

fn operator(operator: BinaryOperator) -> &'static str {
    match operator {
        BinaryOperator::Add => "+",
        BinaryOperator::Subtract => "-",
        BinaryOperator::Multiply => "*",
        BinaryOperator::Divide => "/",
        BinaryOperator::Modulo => "%",
        BinaryOperator::Equal => "==",
        BinaryOperator::NotEqual => "!=",
        BinaryOperator::Less => "<",
        BinaryOperator::LessEqual => "<=",
        BinaryOperator::Greater => ">",
        BinaryOperator::GreaterEqual => ">=",
        BinaryOperator::And => "&",
        BinaryOperator::ExclusiveOr => "^",
        BinaryOperator::InclusiveOr => "|",
        BinaryOperator::LogicalAnd => "&&",
        BinaryOperator::LogicalOr => "||",
        BinaryOperator::ShiftLeft => "<<",
        BinaryOperator::ShiftRight => ">>",
    }
}
