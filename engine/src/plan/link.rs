//! Equations that an index answers; and how a link finds its object by one.

use super::kinds::{Key, Kind};
use super::lower::Lowering;
use super::node::Node;
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{LinkUse, PropertyName};

/// An equation that an index answers: this column of the clause's class equals this value.
#[derive(Clone, Debug)]
pub(crate) struct Join {
    pub(crate) column: usize,
    pub(crate) key: Node,
}

/// The equation that finds the object; `None` where it is not known yet, or is wrong.
pub(crate) fn join(lowering: &mut Lowering, index: usize, link: &LinkUse) -> Option<Join> {
    let class = &lowering.rule.clauses[index].class;
    let from = PropertyName::new(&lowering.rule.clauses[link.clause].class, &link.property);
    let key = match (&link.key, lowering.kinds.key(class)) {
        (Some(key), _) => key.clone(),
        (None, Key::Unsaid) => return None,
        (None, Key::Properties(mut key)) => {
            let Some(only) = key.pop().filter(|_| key.is_empty()) else {
                let message = format!("the objects of {class} are not told apart by one property");
                let help = format!("say which {} names, as in `names {class}.name`", from.property);
                let problem = problem(link, message).help(help);
                lowering.complain(problem);
                return None;
            };
            only
        }
    };
    let key = PropertyName::new(class, &key);
    let variable = lowering.rule.clauses[link.clause].variable.clone();
    let (node, held) = lowering.property(&variable, &link.property, link.position).ok()?;
    match (lowering.kinds.kind(&key), held) {
        (Kind::Missing, _) => None,
        (Kind::Holds(Some(kind)), Some(held)) if kind != held => {
            let message = format!("{from} holds {}, but {key} {}", held.plural(), kind.plural());
            lowering.complain(problem(link, message));
            None
        }
        (Kind::Holds(Some(kind)), None) => {
            Some(Join { column: lowering.column(key), key: Node::Narrow(kind, Box::new(node)) })
        }
        _ => Some(Join { column: lowering.column(key), key: node }),
    }
}

fn problem(link: &LinkUse, message: String) -> Diagnostic {
    let (file, position) = &link.declared;
    file.error(Code::Declaration, *position, message)
}
