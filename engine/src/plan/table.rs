//! Decision tables made ready: each row is a branch that no later row may follow.

use rhai::Position;

use super::action::{ActionPlan, Step, Target, slot};
use super::lower::{Lowering, Typed};
use super::node::{Arithmetic, Comparison, Node};
use crate::diagnostic::Code;
use crate::rule::PropertyName;
use crate::table::{Fold, Hit, Table, Test};
use crate::value::{Truth, Type, Value};

pub(super) fn action(lowering: &mut Lowering, table: &Table) -> ActionPlan {
    let mut plan = ActionPlan::default();
    let inputs: Vec<Typed> = table.given.iter().map(|(expr, _)| input(lowering, expr, &mut plan)).collect();
    for (clause, property, _) in &table.set {
        let name = PropertyName::new(&lowering.rule.clauses[*clause].class, property);
        let kind = lowering.kinds.declared(&name);
        plan.targets.push(Target { variable: *clause, name, slot: slot(lowering), kind });
    }
    let matches: Vec<Vec<Node>> = table
        .rows
        .iter()
        .map(|row| {
            let cells = row.tests.iter().zip(&inputs).filter(|((test, _), _)| *test != Test::Any);
            cells.map(|((test, at), input)| cell(lowering, test, input, *at)).collect()
        })
        .collect();
    let outputs = outputs(lowering, table, &mut plan);
    match table.hit {
        Hit::Collect(fold) => collect(lowering, fold, table, (matches, outputs), &mut plan),
        _ => one(lowering, table, (matches, outputs), &mut plan),
    }
    plan.slots = lowering.slots;
    plan
}

fn input(lowering: &mut Lowering, expr: &rhai::Expr, plan: &mut ActionPlan) -> Typed {
    let (value, kind) = lowering.lower(expr).unwrap_or((Node::Unknown, None));
    let slot = slot(lowering);
    plan.steps.push(Step::Put { slot, value });
    (Node::Local(slot), kind)
}

/// What each row gives for each output, of the output's type.
fn outputs(lowering: &mut Lowering, table: &Table, plan: &mut ActionPlan) -> Vec<Vec<Node>> {
    let mut rows = vec![];
    for row in &table.rows {
        let mut nodes = vec![];
        for (expr, target) in row.outputs.iter().zip(&mut plan.targets) {
            let value = lowering.lower(expr).unwrap_or((Node::Unknown, None));
            let given = lowering.given("this", &target.name, target.kind, value, expr.start_position());
            let (node, kind) = given.unwrap_or((Node::Unknown, target.kind));
            target.kind = kind;
            nodes.push(node);
        }
        rows.push(nodes);
    }
    rows
}

/// The first row that matches counts; where it is unknown whether a row matches, so is what the table gives.
fn one(
    lowering: &mut Lowering,
    table: &Table,
    (matches, outputs): (Vec<Vec<Node>>, Vec<Vec<Node>>),
    plan: &mut ActionPlan,
) {
    let open = slot(lowering);
    plan.steps.push(Step::Put { slot: open, value: Node::Truth(Truth::True) });
    let targets: Vec<usize> = plan.targets.iter().map(|target| target.slot).collect();
    let changes: Vec<usize> = targets.iter().copied().chain([open]).collect();
    let mut rows: Vec<Option<(Vec<Node>, Vec<Node>)>> = matches.into_iter().zip(outputs).map(Some).collect();
    for row in table.heard() {
        let Some((matches, outputs)) = rows[row].take() else { continue };
        let sets = targets.iter().zip(outputs).map(|(&slot, value)| Step::Put { slot, value });
        let then = sets.chain([Step::Put { slot: open, value: Node::Truth(Truth::False) }]).collect();
        let condition = Node::And(std::iter::once(Node::Local(open)).chain(matches).collect());
        plan.steps.push(Step::If { condition, then, otherwise: vec![], changes: changes.clone() });
    }
}

/// All rows that match count together. Where none does, there is no least or greatest.
fn collect(
    lowering: &mut Lowering,
    fold: Fold,
    table: &Table,
    (matches, outputs): (Vec<Vec<Node>>, Vec<Vec<Node>>),
    plan: &mut ActionPlan,
) {
    let start = match fold {
        Fold::Sum | Fold::Count => 0.0,
        Fold::Min => f64::INFINITY,
        Fold::Max => f64::NEG_INFINITY,
    };
    let operator = match fold {
        Fold::Sum | Fold::Count => Arithmetic::Add,
        Fold::Min => Arithmetic::Min,
        Fold::Max => Arithmetic::Max,
    };
    let flags: Vec<usize> = matches
        .into_iter()
        .map(|value| {
            let slot = slot(lowering);
            plan.steps.push(Step::Put { slot, value: Node::And(value) });
            slot
        })
        .collect();
    let mut sets = vec![];
    for (column, target) in plan.targets.iter_mut().enumerate() {
        if target.kind.get_or_insert(Type::Number) != &Type::Number {
            let message = format!("a table collects numbers; {} holds other things", target.name);
            lowering.problem(Code::Type, table.set[column].2, message);
        }
        sets.push(Step::Put { slot: target.slot, value: Node::Number(start) });
        for (row, &flag) in flags.iter().enumerate() {
            let value = match outputs[row].get(column) {
                Some(value) => Node::Narrow(Type::Number, Box::new(value.clone())),
                None => Node::Number(1.0),
            };
            let counted =
                Node::Choose(Box::new(Node::Local(flag)), Box::new(value), Box::new(Node::Number(start)));
            let value = Node::Arithmetic(operator, Box::new(Node::Local(target.slot)), Box::new(counted));
            sets.push(Step::Put { slot: target.slot, value });
        }
    }
    if matches!(fold, Fold::Sum | Fold::Count) {
        plan.steps.extend(sets);
        return;
    }
    let condition = Node::Or(flags.into_iter().map(Node::Local).collect());
    let changes = plan.targets.iter().map(|target| target.slot).collect();
    plan.steps.push(Step::If { condition, then: sets, otherwise: vec![], changes });
}

fn cell(lowering: &mut Lowering, test: &Test, (input, kind): &Typed, position: Position) -> Node {
    let literals = test.literals();
    if let (Some(kind), Some(literal)) = (kind, literals.first())
        && *kind != literal.kind()
    {
        let message = format!("this cell compares {} with {}", kind.plural(), literal.kind().plural());
        lowering.problem(Code::Type, position, message);
        return Node::Unknown;
    }
    let value = match literals.first() {
        Some(literal) if kind.is_none() => Node::Narrow(literal.kind(), Box::new(input.clone())),
        _ => input.clone(),
    };
    node(lowering, test, &value)
}

fn node(lowering: &mut Lowering, test: &Test, value: &Node) -> Node {
    let compare = |comparison, limit: f64| {
        Node::Compare(comparison, Box::new(value.clone()), Box::new(Node::Number(limit)))
    };
    match test {
        Test::Any => Node::Truth(Truth::True),
        Test::OneOf(literals) => {
            let equal = |literal: &Value| {
                let literal = lowering.literal(literal).0;
                Node::Compare(Comparison::Equal, Box::new(value.clone()), Box::new(literal))
            };
            let mut equal: Vec<Node> = literals.iter().map(equal).collect();
            if equal.len() == 1 { equal.remove(0) } else { Node::Or(equal) }
        }
        Test::Not(test) => Node::Not(Box::new(node(lowering, test, value))),
        Test::Below(limit) => compare(Comparison::Less, *limit),
        Test::AtMost(limit) => compare(Comparison::AtMost, *limit),
        Test::Above(limit) => compare(Comparison::Greater, *limit),
        Test::AtLeast(limit) => compare(Comparison::AtLeast, *limit),
        Test::Between(from, to) => {
            Node::And(vec![compare(Comparison::AtLeast, *from), compare(Comparison::Less, *to)])
        }
    }
}
