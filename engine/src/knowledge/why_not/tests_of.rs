//! The conditions of a rule, taken apart: each part with its text and its two sides.

use std::cell::RefCell;

use rhai::Expr;

use crate::plan::Kinds;
use crate::plan::lower::Lowering;
use crate::plan::node::Node;
use crate::rule::{PropertyName, Rule};
use crate::script::wording::wording;
use crate::symbols::Symbols;
use crate::value::Type;

/// One part of a condition.
pub(super) struct Part {
    pub(super) text: String,
    pub(super) node: Node,
    /// Both sides of a comparison.
    pub(super) sides: Option<(Node, Node)>,
}

/// What a clause asks.
pub(super) struct TestsOf {
    pub(super) condition: Vec<Part>,
    pub(super) have: Vec<Part>,
    pub(super) by: Option<Part>,
}

impl TestsOf {
    /// The tests of all clauses, and the columns that their nodes name; `None` where the rule has no plan.
    pub(super) fn rule(
        rule: &Rule,
        kinds: &dyn Kinds,
        symbols: &RefCell<Symbols>,
    ) -> Option<(Vec<Self>, Vec<PropertyName>)> {
        let mut lowering = Lowering::new(rule, kinds, symbols);
        let mut all = vec![];
        for (index, clause) in rule.clauses.iter().enumerate() {
            lowering.enter(Some(index));
            let by = clause.by.as_ref().map(|by| {
                lowering.own = Some(index);
                let node = lowering.wanted(by, Type::Number);
                lowering.own = None;
                Part { text: wording(by), node, sides: None }
            });
            let mut parts = |expr: &Option<Expr>| {
                let mut parts = vec![];
                if let Some(expr) = expr {
                    take_apart(&mut lowering, expr, &mut parts);
                }
                parts
            };
            all.push(Self { condition: parts(&clause.condition), have: parts(&clause.have), by });
        }
        let (columns, problems) = lowering.finish();
        problems.is_empty().then_some((all, columns))
    }
}

fn take_apart(lowering: &mut Lowering, expr: &Expr, parts: &mut Vec<Part>) {
    if let Expr::And(inner, _) = expr {
        for part in inner.iter() {
            take_apart(lowering, part, parts);
        }
        return;
    }
    let node = lowering.wanted(expr, Type::Truth);
    let sides = match &node {
        Node::Compare(_, a, b) => Some(((**a).clone(), (**b).clone())),
        _ => None,
    };
    parts.push(Part { text: wording(expr), node, sides });
}
