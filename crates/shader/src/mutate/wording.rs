//! What a mistake is called: the text that stands there, and the text that would.

use naga::{BinaryOperator, Expression, Function, Handle, Literal, MathFunction, Span, Statement};
use tyndall_document::Place;

use super::sites::each_statement;
use super::{Edit, Target};
use crate::link::Linked;

/// Operands whose texts are longer are cut in the middle.
const LONGEST: usize = 40;

/// Words for the mistakes in a function.
pub(super) struct Wording<'a> {
    pub linked: &'a Linked,
    pub function: &'a Function,
}

impl Wording<'_> {
    /// Where a mistake is made, and `from -> to`. `None` where it is in no text of an author.
    pub fn of(&self, target: Target, edit: Edit) -> Option<(Place, String)> {
        let (span, from, to) = match target {
            Target::Expression(handle) => {
                let span = self.function.expressions.get_span(handle);
                self.text(span)?;
                (span, self.written(handle, None)?, self.written(handle, Some(edit))?)
            }
            Target::Call(number) => self.call(number, edit)?,
        };
        Some((self.linked.place(span), format!("{from} -> {to}")))
    }

    fn text(&self, span: Span) -> Option<String> {
        match self.linked.place(span) {
            Place::Text { source, span } if span.start < span.end => {
                let (start, end) = (span.start as usize, span.end as usize);
                let end = end + arguments(&source.text()[start..end], &source.text()[end..]);
                Some(tidy(&source.text()[start..end]))
            }
            _ => None,
        }
    }

    fn operand(&self, handle: Handle<Expression>) -> String {
        // A name stands for what it was given.
        if let Some(name) = self.function.named_expressions.get(&handle) {
            return name.clone();
        }
        let text = self.text(self.function.expressions.get_span(handle));
        cut(&text.or_else(|| self.variable(handle)).unwrap_or_else(|| "…".to_owned()))
    }

    /// The name of a local variable that is read, which has no span of its own.
    fn variable(&self, handle: Handle<Expression>) -> Option<String> {
        match self.function.expressions[handle] {
            Expression::Load { pointer } => self.variable(pointer),
            Expression::LocalVariable(variable) => self.function.local_variables[variable].name.clone(),
            _ => None,
        }
    }

    /// An operand of an operator, in brackets where it has one of its own.
    fn within(&self, handle: Handle<Expression>) -> String {
        let text = self.operand(handle);
        let named = self.function.named_expressions.contains_key(&handle);
        let is_sum = matches!(self.function.expressions[handle], Expression::Binary { .. });
        if is_sum && !named && !text.starts_with('(') { format!("({text})") } else { text }
    }

    /// An expression as it is, or after an edit.
    fn written(&self, handle: Handle<Expression>, edit: Option<Edit>) -> Option<String> {
        let of = |handle: &Handle<Expression>| self.operand(*handle);
        let list = |mut items: Vec<Handle<Expression>>| {
            if let Some(Edit::Swap(a, b)) = edit {
                items.swap(a, b);
            }
            items.iter().map(of).collect::<Vec<_>>().join(", ")
        };
        Some(match (edit, &self.function.expressions[handle]) {
            (Some(Edit::Become(kept)), _) => of(&kept),
            (Some(Edit::Number(literal)), _) => number(literal),
            (_, Expression::Binary { op, left, right }) => {
                let (mut left, mut right) = (self.within(*left), self.within(*right));
                if matches!(edit, Some(Edit::Swap(..))) {
                    std::mem::swap(&mut left, &mut right);
                }
                let opposite = edit == Some(Edit::Opposite);
                let sign = match op {
                    BinaryOperator::Add if opposite => "-",
                    BinaryOperator::Subtract if opposite => "+",
                    BinaryOperator::Add => "+",
                    BinaryOperator::Subtract => "-",
                    BinaryOperator::Multiply => "*",
                    _ => "/",
                };
                format!("{left} {sign} {right}")
            }
            (_, Expression::Select { condition, accept, reject }) => {
                format!("select({}, {})", list(vec![*reject, *accept]), of(condition))
            }
            (_, Expression::Compose { components, .. }) => format!("({})", list(components.clone())),
            (_, Expression::Math { fun, arg, arg1, arg2, .. }) => {
                let fun = match (edit, fun) {
                    (Some(Edit::OtherBound), MathFunction::Min) => MathFunction::Max,
                    (Some(Edit::OtherBound), _) => MathFunction::Min,
                    _ => *fun,
                };
                let arguments = [Some(*arg), *arg1, *arg2].into_iter().flatten().collect();
                format!("{}({})", format!("{fun:?}").to_lowercase(), list(arguments))
            }
            _ => return self.text(self.function.expressions.get_span(handle)),
        })
    }

    fn call(&self, number: usize, edit: Edit) -> Option<(Span, String, String)> {
        let (Edit::Swap(a, b), mut found, mut call) = (edit, None, 0) else { return None };
        each_statement(&self.function.body, &mut |statement| {
            if let Statement::Call { function, arguments, result } = statement {
                if call == number {
                    found = Some((*function, arguments.clone(), *result));
                }
                call += 1;
            }
        });
        let (function, mut arguments, result) = found?;
        let expressions = &self.function.expressions;
        let name = self.linked.module.functions[function].name.as_deref().unwrap_or_default();
        let word = |arguments: &[Handle<Expression>]| {
            format!("{name}({})", arguments.iter().map(|handle| self.operand(*handle)).collect::<Vec<_>>().join(", "))
        };
        let from = word(&arguments);
        // A call that gives nothing is found by its arguments.
        let span = result.or(arguments.first().copied()).map(|handle| expressions.get_span(handle))?;
        arguments.swap(a, b);
        Some((span, from, word(&arguments)))
    }
}

/// naga says of a call where its name stands: how long the arguments are that follow it.
fn arguments(name: &str, rest: &str) -> usize {
    let is_name = name.chars().all(|letter| letter.is_alphanumeric() || "_<>, ".contains(letter));
    if !is_name || !rest.starts_with('(') {
        return 0;
    }
    let mut depth = 0;
    for (at, letter) in rest.char_indices() {
        depth += i32::from(letter == '(') - i32::from(letter == ')');
        if depth == 0 {
            return at + 1;
        }
    }
    0
}

fn number(literal: Literal) -> String {
    match literal {
        Literal::F32(value) => format!("{value:?}"),
        Literal::U32(value) => format!("{value}u"),
        Literal::I32(value) => value.to_string(),
        _ => "another number".to_owned(),
    }
}

/// On one line, without comments.
fn tidy(text: &str) -> String {
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    lines.flat_map(str::split_whitespace).collect::<Vec<_>>().join(" ")
}

fn cut(text: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    if letters.len() <= LONGEST {
        return text.to_owned();
    }
    let part = |letters: &[char]| letters.iter().collect::<String>();
    format!("{} … {}", part(&letters[..LONGEST / 2]), part(&letters[letters.len() - LONGEST / 2..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_call_goes_on_to_the_end_of_its_arguments() {
        assert_eq!(arguments("max", "(f(a), b) + 1"), 9);
        assert_eq!(arguments("vec3<f32>", "(0.0)"), 5);
        assert_eq!(arguments("a + b", "(c)"), 0);
        assert_eq!(arguments("max", " (a"), 0);
        assert_eq!(arguments("max", "(a"), 0);
    }

    #[test]
    fn a_text_is_one_line_of_bounded_length() {
        assert_eq!(tidy("a +  // why\n    b"), "a + b");
        assert_eq!(cut("short"), "short");
        assert_eq!(cut(&"x".repeat(100)).chars().count(), LONGEST + 3);
    }
}
