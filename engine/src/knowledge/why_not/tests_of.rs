//! The conditions of a rule, taken apart: each part with its text and its two sides.

use std::cell::RefCell;

use rhai::Expr;

use crate::plan::Kinds;
use crate::plan::clause::of_class;
use crate::plan::link::{Join, join};
use crate::plan::lower::Lowering;
use crate::plan::node::{Comparison, Node};
use crate::rule::{Action, PropertyName, Rule};
use crate::script::wording::wording;
use crate::symbols::Symbols;
use crate::value::Type;

/// One part of a condition.
pub(super) struct Part {
    pub(super) text: String,
    pub(super) node: Node,
    /// Both sides of a comparison.
    pub(super) sides: Option<(Node, Node)>,
    /// Whether it is an equation between the clause's object and what was bound before.
    pub(super) joins: bool,
}

/// What a clause asks.
pub(super) struct TestsOf {
    /// How a hidden clause finds the object that a property names.
    pub(super) link: Option<Part>,
    pub(super) condition: Vec<Part>,
    pub(super) have: Vec<Part>,
    pub(super) by: Option<Part>,
}

/// What a whole rule asks.
pub(super) struct TestsOfRule {
    pub(super) clauses: Vec<TestsOf>,
    /// The inputs of a decision table.
    pub(super) inputs: Vec<Node>,
}

impl TestsOfRule {
    /// The tests, and the columns that their nodes name; `None` where the rule has no plan.
    pub(super) fn new(
        rule: &Rule,
        kinds: &dyn Kinds,
        symbols: &RefCell<Symbols>,
    ) -> Option<(Self, Vec<PropertyName>)> {
        let mut lowering = Lowering::new(rule, kinds, symbols);
        let clauses = (0..rule.clauses.len()).map(|index| clause(&mut lowering, index)).collect();
        lowering.enter(None);
        let inputs = match &rule.action {
            Action::Table(table) => table
                .given
                .iter()
                .map(|(expr, _)| lowering.lower(expr).map_or(Node::Unknown, |(node, _)| node))
                .collect(),
            _ => vec![],
        };
        let (columns, problems) = lowering.finish();
        problems.is_empty().then_some((Self { clauses, inputs }, columns))
    }
}

fn clause(lowering: &mut Lowering, index: usize) -> TestsOf {
    let clause = &lowering.rule.clauses[index];
    lowering.enter(Some(index));
    let (mut link_part, mut condition) = (None, vec![]);
    if let Some(link) = &clause.link
        && let Some(Join { column, key }) = join(lowering, index, link)
    {
        let node = Node::Compare(
            Comparison::Equal,
            Box::new(Node::Property { variable: index, column }),
            Box::new(key),
        );
        let from = &lowering.rule.clauses[link.clause].variable;
        link_part = Some(part(format!("{from}.{}", link.property), node));
    }
    for (of, node) in clause.conditions.iter().zip(of_class(lowering, index)) {
        condition.push(part(wording(&of.expr), node));
    }
    let by = clause.by.as_ref().map(|by| {
        lowering.own = Some(index);
        let node = lowering.wanted(by, Type::Number);
        lowering.own = None;
        part(wording(by), node)
    });
    if let Some(expr) = &clause.condition {
        take_apart(lowering, expr, &mut condition);
    }
    let mut have = vec![];
    if let Some(expr) = &clause.have {
        take_apart(lowering, expr, &mut have);
    }
    TestsOf { link: link_part, condition, have, by }
}

fn take_apart(lowering: &mut Lowering, expr: &Expr, parts: &mut Vec<Part>) {
    if let Expr::And(inner, _) = expr {
        for part in inner.iter() {
            take_apart(lowering, part, parts);
        }
        return;
    }
    let node = lowering.wanted(expr, Type::Truth);
    parts.push(part(wording(expr), node));
}

fn part(text: String, node: Node) -> Part {
    let sides = match &node {
        Node::Compare(_, a, b) => Some(((**a).clone(), (**b).clone())),
        _ => None,
    };
    let joins = match &node {
        Node::Compare(Comparison::Equal, a, b) => {
            let (a, b) = (a.variables(), b.variables());
            a & b == 0 && a != 0 && b != 0
        }
        _ => false,
    };
    Part { text, node, sides, joins }
}
