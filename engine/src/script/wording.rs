//! Expressions as rules write them, from the tree that was read.

use rhai::Expr;

use super::names::property_of;

/// The text of an expression; parts that are scripts of their own are left out (`…`).
pub(crate) fn wording(expr: &Expr) -> String {
    match expr {
        Expr::IntegerConstant(number, _) => number.to_string(),
        Expr::FloatConstant(number, _) => number.to_string(),
        Expr::BoolConstant(truth, _) => truth.to_string(),
        Expr::StringConstant(text, _) => format!("\"{text}\""),
        Expr::CharConstant(letter, _) => format!("'{letter}'"),
        Expr::DynamicConstant(value, _) => value.to_string(),
        Expr::Unit(_) => "()".to_owned(),
        Expr::Variable(variable, ..) => variable.1.to_string(),
        Expr::Property(property, _) => property.2.to_string(),
        Expr::Array(elements, _) => format!("[{}]", list(elements)),
        Expr::Dot(dot, ..) => match (property_of(expr), &dot.rhs) {
            (Some((variable, property, _)), _) => format!("{variable}.{property}"),
            (None, rhs) => format!("{}.{}", wording(&dot.lhs), wording(rhs)),
        },
        Expr::MethodCall(call, _) => format!("{}({})", call.name, list(&call.args)),
        Expr::And(parts, _) => joined(parts, "&&"),
        Expr::Or(parts, _) => joined(parts, "||"),
        Expr::Coalesce(parts, _) => joined(parts, "??"),
        Expr::FnCall(call, _) => match (call.name.as_str(), call.args.as_slice()) {
            ("contains", [all, one]) => format!("{} in {}", operand(one), operand(all)),
            (name, [a, b]) if is_sign(name) => format!("{} {name} {}", operand(a), operand(b)),
            (name, [a]) if is_sign(name) => format!("{name}{}", operand(a)),
            (name, arguments) => format!("{name}({})", list(arguments)),
        },
        _ => "…".to_owned(),
    }
}

fn list(parts: &[Expr]) -> String {
    parts.iter().map(wording).collect::<Vec<_>>().join(", ")
}

fn joined(parts: &[Expr], sign: &str) -> String {
    parts.iter().map(operand).collect::<Vec<_>>().join(&format!(" {sign} "))
}

/// In brackets where it has an operator of its own.
fn operand(expr: &Expr) -> String {
    let compound = match expr {
        Expr::And(..) | Expr::Or(..) | Expr::Coalesce(..) => true,
        Expr::FnCall(call, _) => is_sign(&call.name) && call.args.len() > 1,
        _ => false,
    };
    if compound { format!("({})", wording(expr)) } else { wording(expr) }
}

fn is_sign(name: &str) -> bool {
    !name.starts_with(|first: char| first.is_alphanumeric() || first == '_')
}
