//! Actions made ready: a list of steps over slots.

use rhai::{Expr, Position, Stmt, StmtBlock};

use super::call::arithmetic;
use super::fragment::Fragment;
use super::lower::{Local, Lowering, Stop, Typed};
use super::node::Node;
use crate::rule::PropertyName;
use crate::script::names::{Names, Patterns, changes_in_expressions, property_of};
use crate::value::Type;

#[derive(Clone, Debug)]
pub(crate) enum Step {
    /// Writes a slot: a `let`, an assignment, or a property that is set.
    Put {
        slot: usize,
        value: Node,
    },
    /// `changes` are the slots that either branch writes: unknown where the condition is.
    If {
        condition: Node,
        then: Vec<Self>,
        otherwise: Vec<Self>,
        changes: Vec<usize>,
    },
    Interpret(Box<Fragment>),
}

impl Step {
    /// What it writes, where it writes one slot.
    pub(crate) const fn value(&self) -> &Node {
        match self {
            Self::Put { value, .. } => value,
            Self::If { .. } | Self::Interpret(_) => &Node::Unknown,
        }
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Target {
    pub(crate) variable: usize,
    pub(crate) name: PropertyName,
    pub(crate) slot: usize,
    pub(crate) kind: Option<Type>,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct ActionPlan {
    pub(crate) steps: Vec<Step>,
    pub(crate) slots: usize,
    pub(crate) targets: Vec<Target>,
}

impl ActionPlan {
    pub(crate) fn interprets(&self) -> bool {
        fn any(steps: &[Step]) -> bool {
            steps.iter().any(|step| match step {
                Step::Put { value, .. } => value.interprets(),
                Step::If { condition, then, otherwise, .. } => {
                    condition.interprets() || any(then) || any(otherwise)
                }
                Step::Interpret(_) => true,
            })
        }
        any(&self.steps)
    }
}

pub(crate) fn action(lowering: &mut Lowering, block: &StmtBlock) -> ActionPlan {
    let mut plan = ActionPlan::default();
    reset(lowering);
    let changes = changes_in_expressions(block, &Patterns(&lowering.variables()));
    match steps(lowering, block, &mut plan, true) {
        Ok(steps) if !changes => plan.steps = steps,
        Ok(_) | Err(Stop::Interpret) => {
            reset(lowering);
            plan = interpreted(lowering, block).unwrap_or_default();
        }
        Err(Stop::Wrong) => {}
    }
    plan.slots = lowering.slots;
    reset(lowering);
    plan
}

fn reset(lowering: &mut Lowering) {
    lowering.locals.clear();
    lowering.certain.clear();
    lowering.slots = 0;
}

fn steps(
    lowering: &mut Lowering,
    block: &StmtBlock,
    plan: &mut ActionPlan,
    top: bool,
) -> Result<Vec<Step>, Stop> {
    let outer = lowering.locals.len();
    let mut out = vec![];
    let mut wrong = false;
    for stmt in block.statements() {
        match step(lowering, stmt, plan, top, &mut out) {
            Ok(()) => {}
            Err(Stop::Wrong) => wrong = true,
            Err(Stop::Interpret) => return Err(Stop::Interpret),
        }
    }
    lowering.locals.truncate(outer);
    if wrong { Err(Stop::Wrong) } else { Ok(out) }
}

fn step(
    lowering: &mut Lowering,
    stmt: &Stmt,
    plan: &mut ActionPlan,
    top: bool,
    out: &mut Vec<Step>,
) -> Result<(), Stop> {
    match stmt {
        Stmt::Noop(_) => {}
        Stmt::Var(var, ..) => {
            let name = var.0.name.to_string();
            let lowered = held(lowering, &var.1);
            let slot = slot(lowering);
            // Known by name even if its value is wrong: one mistake, one message.
            let kind = lowered.as_ref().ok().and_then(|(_, kind)| *kind);
            let local = Local { name, slot, kind };
            // one declared again in its block takes the place of the first, counted from the end
            match var.2.and_then(|from_end| lowering.locals.len().checked_sub(from_end.get())) {
                Some(place) => lowering.locals[place] = local,
                None => lowering.locals.push(local),
            }
            out.push(Step::Put { slot, value: lowered?.0 });
        }
        Stmt::Assignment(assignment) => {
            let (operator, sides) = (&assignment.0, &assignment.1);
            if let Some((variable, property, position)) = property_of(&sides.lhs) {
                let value = lowering.lower(&sides.rhs)?;
                set(lowering, (variable, property, position), value, plan, top, out)?;
            } else if let Expr::Variable(variable, _, position) = &sides.lhs {
                let sign = operator.get_op_assignment_info().map(|info| info.5);
                assign(lowering, &variable.1, sign, &sides.rhs, *position, out)?;
            } else {
                return Err(Stop::Interpret);
            }
        }
        Stmt::If(flow, _) => {
            let typed = lowering.lower(&flow.expr)?;
            let condition = lowering.narrow(typed, Type::Truth, flow.expr.start_position());
            let then = steps(lowering, &flow.body, plan, false);
            let otherwise = steps(lowering, &flow.branch, plan, false);
            let (then, otherwise) = (then?, otherwise?);
            let mut changes = vec![];
            written(&then, &mut changes);
            written(&otherwise, &mut changes);
            out.push(Step::If { condition: condition?, then, otherwise, changes });
        }
        Stmt::Block(block) => out.extend(steps(lowering, block, plan, top)?),
        // What is compiled has no effect by itself; it is looked through for mistakes.
        Stmt::Expr(expr) if !matches!(**expr, Expr::Stmt(_)) => {
            if lowering.lower(expr)?.0.interprets() {
                return Err(Stop::Interpret);
            }
        }
        _ => return Err(Stop::Interpret),
    }
    Ok(())
}

pub(super) fn slot(lowering: &mut Lowering) -> usize {
    lowering.slots += 1;
    lowering.slots - 1
}

/// The value of a variable. Arrays, maps and functions are values of the interpreter alone.
fn held(lowering: &mut Lowering, value: &Expr) -> Result<Typed, Stop> {
    match value {
        Expr::Array(..) | Expr::Map(..) | Expr::DynamicConstant(..) => Err(Stop::Interpret),
        plain => lowering.lower(plain),
    }
}

fn assign(
    lowering: &mut Lowering,
    name: &str,
    sign: Option<&str>,
    value: &Expr,
    position: Position,
    out: &mut Vec<Step>,
) -> Result<(), Stop> {
    let Some(local) = lowering.locals.iter().rev().find(|local| local.name == name).cloned() else {
        return Err(Stop::Interpret);
    };
    let new = held(lowering, value)?;
    let old = (Node::Local(local.slot), local.kind);
    let (node, kind) = match sign {
        None => new,
        Some("+") => lowering.sum(old, new, position)?,
        Some(sign) => {
            let operator = arithmetic(sign).ok_or(Stop::Interpret)?;
            let a = lowering.narrow(old, Type::Number, position)?;
            let b = lowering.narrow(new, Type::Number, position)?;
            (Node::Arithmetic(operator, Box::new(a), Box::new(b)), Some(Type::Number))
        }
    };
    if kind != local.kind {
        return Err(Stop::Interpret);
    }
    out.push(Step::Put { slot: local.slot, value: node });
    Ok(())
}

fn set(
    lowering: &mut Lowering,
    (variable, property, position): (&str, &str, Position),
    value: Typed,
    plan: &mut ActionPlan,
    top: bool,
    out: &mut Vec<Step>,
) -> Result<(), Stop> {
    let Some(index) = lowering.variable(variable) else { return Err(Stop::Interpret) };
    let name = PropertyName::new(&lowering.rule.clauses[index].class, property);
    let declared = lowering.kinds.declared(&name);
    let earlier = plan.targets.iter().position(|target| target.variable == index && target.name == name);
    let wanted = declared.or_else(|| earlier.and_then(|earlier| plan.targets[earlier].kind));
    let (value, kind) = lowering.given("this", &name, wanted, value, position)?;
    let slot = if let Some(earlier) = earlier {
        let target = &plan.targets[earlier];
        if target.kind != kind {
            return Err(Stop::Interpret);
        }
        target.slot
    } else {
        let slot = slot(lowering);
        plan.targets.push(Target { variable: index, name, slot, kind });
        slot
    };
    out.push(Step::Put { slot, value });
    if top {
        lowering.certain.insert((index, property.to_owned()), (slot, kind));
    }
    Ok(())
}

fn written(steps: &[Step], slots: &mut Vec<usize>) {
    for step in steps {
        match step {
            Step::Put { slot, .. } => slots.push(*slot),
            Step::If { changes, .. } => slots.extend(changes),
            Step::Interpret(_) => {}
        }
    }
}

/// The whole action as a script. It gives types only when it runs.
fn interpreted(lowering: &mut Lowering, block: &StmtBlock) -> Result<ActionPlan, Stop> {
    let rule = lowering.rule;
    let variables = lowering.variables();
    let mut names = Names::default();
    names.block(block, &Patterns(&variables));
    let statements = vec![Stmt::Block(Box::new(block.clone()))];
    let mut fragment = lowering.fragment(statements, &names, block.position())?;
    let mut plan = ActionPlan::default();
    for (variable, property) in names.sets.into_keys() {
        let name = PropertyName::new(&rule.clauses[variable].class, &property);
        let object = fragment.objects.entry(variables[variable].clone()).or_default();
        object.variable = variable;
        plan.targets.push(Target { variable, name, slot: slot(lowering), kind: None });
    }
    plan.steps.push(Step::Interpret(Box::new(fragment)));
    Ok(plan)
}
