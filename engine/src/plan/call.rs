//! Operators and functions that are compiled.

use rhai::{Expr, Position};

use super::lower::{Lowering, Stop, Typed};
use super::node::{Arithmetic, Comparison, Function, Node};
use crate::diagnostic::Code;
use crate::value::Type;

impl Lowering<'_> {
    pub(crate) fn call(
        &mut self,
        name: &str,
        arguments: &[&Expr],
        position: Position,
    ) -> Result<Typed, Stop> {
        if self.file.function_names.contains(&(name.to_owned(), arguments.len())) {
            return Err(Stop::Interpret);
        }
        match (name, arguments) {
            ("!", [a]) => {
                let node = self.argument(a, Type::Truth)?;
                Ok((Node::Not(Box::new(node)), Some(Type::Truth)))
            }
            ("known", [a]) => {
                let (node, _) = self.lower(a)?;
                Ok((Node::Known(Box::new(node)), Some(Type::Truth)))
            }
            ("unknown", [a]) => {
                let (node, _) = self.lower(a)?;
                Ok((Node::Not(Box::new(Node::Known(Box::new(node)))), Some(Type::Truth)))
            }
            ("contains", [Expr::Array(elements, _), a]) => self.among(elements, a, position),
            ("+", [a, b]) => self.plus(a, b, position),
            ("min" | "max", [first, second, rest @ ..]) => {
                let operator = if name == "min" { Arithmetic::Min } else { Arithmetic::Max };
                let mut node = self.binary(operator, first, second)?;
                for argument in rest {
                    let other = self.argument(argument, Type::Number)?;
                    node = Node::Arithmetic(operator, Box::new(node), Box::new(other));
                }
                Ok((node, Some(Type::Number)))
            }
            (name, [a]) => {
                let function = function(name).ok_or(Stop::Interpret)?;
                let node = self.argument(a, Type::Number)?;
                Ok((Node::Function(function, Box::new(node)), Some(Type::Number)))
            }
            (name, [a, b]) => {
                if let Some(comparison) = comparison(name) {
                    return self.compare(comparison, a, b, position);
                }
                let operator = arithmetic(name).ok_or(Stop::Interpret)?;
                Ok((self.binary(operator, a, b)?, Some(Type::Number)))
            }
            _ => Err(Stop::Interpret),
        }
    }

    fn argument(&mut self, expr: &Expr, wanted: Type) -> Result<Node, Stop> {
        let typed = self.lower(expr)?;
        self.narrow(typed, wanted, expr.start_position())
    }

    fn binary(&mut self, operator: Arithmetic, a: &Expr, b: &Expr) -> Result<Node, Stop> {
        let (a, b) = (self.argument(a, Type::Number)?, self.argument(b, Type::Number)?);
        Ok(Node::Arithmetic(operator, Box::new(a), Box::new(b)))
    }

    /// `+` adds numbers, and joins texts with texts and numbers.
    fn plus(&mut self, a: &Expr, b: &Expr, position: Position) -> Result<Typed, Stop> {
        let (a, b) = (self.lower(a)?, self.lower(b)?);
        self.sum(a, b, position)
    }

    pub(crate) fn sum(&mut self, a: Typed, b: Typed, position: Position) -> Result<Typed, Stop> {
        let textual = |kind| matches!(kind, Some(Type::Text | Type::Number));
        match (a.1, b.1) {
            (Some(Type::Text), other) | (other, Some(Type::Text)) if textual(other) => {
                Ok((Node::Concat(Box::new(a.0), Box::new(b.0)), Some(Type::Text)))
            }
            (Some(Type::Text), None) | (None, Some(Type::Text) | None) => Err(Stop::Interpret),
            (Some(Type::Truth), _) | (_, Some(Type::Truth)) => {
                self.problem(Code::Type, position, "truth values cannot be added");
                Err(Stop::Wrong)
            }
            _ => {
                let a = self.narrow(a, Type::Number, position)?;
                let b = self.narrow(b, Type::Number, position)?;
                Ok((Node::Arithmetic(Arithmetic::Add, Box::new(a), Box::new(b)), Some(Type::Number)))
            }
        }
    }

    /// `x in [a, b]`
    fn among(&mut self, elements: &[Expr], a: &Expr, position: Position) -> Result<Typed, Stop> {
        let mut parts = vec![];
        for element in elements {
            parts.push(self.compare(Comparison::Equal, a, element, position)?.0);
        }
        Ok((Node::Or(parts), Some(Type::Truth)))
    }
}

fn comparison(name: &str) -> Option<Comparison> {
    Some(match name {
        "==" => Comparison::Equal,
        "!=" => Comparison::Unequal,
        "<" => Comparison::Less,
        "<=" => Comparison::AtMost,
        ">" => Comparison::Greater,
        ">=" => Comparison::AtLeast,
        _ => return None,
    })
}

pub(crate) fn arithmetic(name: &str) -> Option<Arithmetic> {
    Some(match name {
        "+" => Arithmetic::Add,
        "-" => Arithmetic::Subtract,
        "*" => Arithmetic::Multiply,
        "/" => Arithmetic::Divide,
        "%" => Arithmetic::Remainder,
        "**" => Arithmetic::Power,
        "hypot" => Arithmetic::Hypot,
        _ => return None,
    })
}

fn function(name: &str) -> Option<Function> {
    Some(match name {
        "-" => Function::Negate,
        "abs" => Function::Abs,
        "sqrt" => Function::Sqrt,
        "floor" => Function::Floor,
        "ceil" | "ceiling" => Function::Ceil,
        "round" => Function::Round,
        _ => return None,
    })
}
