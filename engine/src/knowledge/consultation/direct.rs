//! The rules of one class, run for one object without the bookkeeping of an inference.

use super::grain::{Grain, Looks};
use crate::knowledge::KnowledgeBase;
use crate::knowledge::derived::{Heard, heard};
use crate::machine::scalar::{Object, Scalar, Written};
use crate::order::Step;
use crate::plan::clause::ClausePlan;
use crate::plan::{Effect, Plan};
use crate::rule::{Action, Operator, PropertyName};
use crate::rule_base::RuleBase;
use crate::script::syntax::Quantifier;
use crate::value::{Cell, Truth, Type};

/// What has to be done for an object, in the order of the rules' dependencies.
#[derive(Debug)]
pub(super) struct Direct {
    steps: Vec<Do>,
    /// The rules that run, by the number that steps give them.
    rules: Vec<Running>,
    /// The types of the inputs, which are the first of the properties.
    inputs: Vec<Type>,
    /// How closely the rules look at each of them.
    pub(super) grains: Vec<Grain>,
    /// Where each output stands; `None` is never known.
    outputs: Vec<Option<usize>>,
    /// The properties of the object, as far as they are known yet.
    cells: Vec<Cell>,
    slots: Written,
}

#[derive(Debug)]
enum Do {
    Run(usize),
    Merge(Merge),
    Level { property: usize, by: Vec<(usize, Operator)> },
}

/// Brings together what rules conclude of a property: each with its priority and which of its claims it is.
#[derive(Debug)]
struct Merge {
    property: usize,
    kind: Type,
    rules_first: bool,
    writers: Vec<(i64, usize, usize)>,
}

#[derive(Debug)]
struct Running {
    rule: usize,
    /// For each column of its plan the property.
    columns: Vec<usize>,
    /// For each property that it sets, where its action holds the value.
    sets: Vec<usize>,
    /// What it claims of each, for the present object; `None`: it says nothing.
    claims: Vec<Option<Cell>>,
}

impl Direct {
    /// The direct way from inputs to outputs, if every rule that sets a property of the class looks at one object alone.
    pub(super) fn of(
        base: &KnowledgeBase,
        rules: &RuleBase,
        class: &str,
        inputs: &[String],
        outputs: &[PropertyName],
    ) -> Option<Self> {
        let mut properties: Vec<String> = inputs.to_vec();
        let mut at = |name: &PropertyName| {
            properties.iter().position(|known| *known == name.property).unwrap_or_else(|| {
                properties.push(name.property.clone());
                properties.len() - 1
            })
        };
        let (mut running, mut steps) = (Vec::<Running>::new(), vec![]);
        let place =
            |running: &[Running], rule: usize| running.iter().position(|running| running.rule == rule);
        for step in &rules.order {
            match step {
                Step::Rule(number) => {
                    let rule = &rules.rules[*number];
                    if !rule.sets.keys().any(|name| name.class == class) {
                        continue;
                    }
                    let planned = base.network.nodes[*number].planned.as_ref()?;
                    if !looks_at_one(&planned.plan) || planned.interprets || rule.hypothesis.is_some() {
                        return None;
                    }
                    let columns = planned.plan.columns.iter().map(&mut at).collect();
                    let sets = match &planned.plan.effect {
                        Effect::Conclude { then, .. } => then.targets.iter().map(|set| set.slot).collect(),
                        Effect::Revise { .. } | Effect::Default { .. } => vec![0],
                        Effect::React(_) => vec![],
                    };
                    let claims = vec![None; sets.len()];
                    steps.push(Do::Run(running.len()));
                    running.push(Running { rule: *number, columns, sets, claims });
                }
                Step::Merge(name) if name.class == class => {
                    let Some(derived) = base.derived.get(name) else { continue };
                    if derived.hypothesis {
                        return None;
                    }
                    let mut writers = vec![];
                    for writer in &derived.writers {
                        let of = place(&running, writer.rule)?;
                        writers.push((writer.priority, of, claim(base, writer.rule, name)?));
                    }
                    let (kind, rules_first) = (derived.stages.first()?.kind(), derived.rules_first);
                    steps.push(Do::Merge(Merge { property: at(name), kind, rules_first, writers }));
                }
                Step::Level(name, level) if name.class == class => {
                    let derived = base.derived.get(name)?;
                    let (_, revising) = derived.levels.iter().find(|(known, _)| known == level)?;
                    let mut by = vec![];
                    for &rule in revising {
                        let Action::Revise { operator, .. } = rules.rules[rule].action else {
                            return None;
                        };
                        by.push((place(&running, rule)?, operator));
                    }
                    steps.push(Do::Level { property: at(name), by });
                }
                Step::Merge(_) | Step::Level(..) => {}
            }
        }
        let told = &base.held.get(class)?.table;
        let inputs: Vec<Type> =
            inputs.iter().map(|name| Some(told.column(name)?.kind())).collect::<Option<_>>()?;
        let outputs: Vec<Option<usize>> =
            outputs.iter().map(|name| properties.iter().position(|known| *known == name.property)).collect();
        let mut looks = Looks::default();
        for running in &running {
            looks.note(&base.network.nodes[running.rule].planned.as_ref()?.plan, &running.columns);
        }
        // what is told of a property that rules set, or that is asked for, may be what they say of it
        let set = steps.iter().filter_map(|step| match step {
            Do::Merge(Merge { property, .. }) | Do::Level { property, .. } => Some(*property),
            Do::Run(_) => None,
        });
        set.chain(outputs.iter().flatten().copied()).for_each(|property| looks.whole(property));
        Some(Self {
            grains: looks.grains(inputs.len()),
            outputs,
            steps,
            rules: running,
            inputs,
            cells: vec![Cell::Unknown; properties.len()],
            slots: Written::default(),
        })
    }
}

fn claim(base: &KnowledgeBase, rule: usize, name: &PropertyName) -> Option<usize> {
    match &base.network.nodes[rule].planned.as_ref()?.plan.effect {
        Effect::Conclude { then, .. } => then.targets.iter().position(|target| target.name == *name),
        Effect::Revise { .. } | Effect::Default { .. } => Some(0),
        Effect::React(_) => None,
    }
}

/// Whether a rule has one clause, with a condition on its object alone, and no `else`.
fn looks_at_one(plan: &Plan) -> bool {
    let [ClausePlan { quantifier: Quantifier::Each, joins, test: None, .. }] = plan.clauses.as_slice() else {
        return false;
    };
    joins.is_empty() && !matches!(&plan.effect, Effect::Conclude { otherwise: Some(_), .. })
}

impl Direct {
    /// Runs the rules for an object with these inputs, and puts down what is asked for.
    pub(super) fn run(&mut self, knowledge: &KnowledgeBase, inputs: &[Cell], answers: &mut [Cell]) {
        self.cells.fill(Cell::Unknown);
        for ((place, &kind), &cell) in self.cells.iter_mut().zip(&self.inputs).zip(inputs) {
            if cell.kind() == Some(kind) {
                *place = cell;
            }
        }
        for step in &self.steps {
            match step {
                Do::Run(number) => {
                    let running = &mut self.rules[*number];
                    let planned = knowledge.network.nodes[running.rule].planned.as_ref();
                    let object =
                        Object { columns: &running.columns, cells: &self.cells, symbols: &knowledge.symbols };
                    running.claims.fill(None);
                    if let Some(planned) = planned {
                        claims(&planned.plan, &object, &running.sets, &mut self.slots, &mut running.claims);
                    }
                }
                Do::Merge(merge) => {
                    let told = self.cells[merge.property];
                    self.cells[merge.property] = merge.bring(told, &self.rules);
                }
                Do::Level { property, by } => {
                    let mut value = number(self.cells[*property]);
                    for &(rule, operator) in by {
                        if let Some(amount) = self.rules[rule].claims[0] {
                            value = operator.apply(value, number(amount));
                        }
                    }
                    self.cells[*property] = Cell::number(value);
                }
            }
        }
        for (answer, place) in answers.iter_mut().zip(&self.outputs) {
            *answer = place.map_or(Cell::Unknown, |place| self.cells[place]);
        }
    }
}

fn claims(plan: &Plan, object: &Object, sets: &[usize], slots: &mut Written, claims: &mut [Option<Cell>]) {
    let scalar = Scalar { object, slots: &[] };
    if plan.clauses[0].own.as_ref().is_some_and(|own| scalar.truth(own) != Truth::True) {
        return;
    }
    match &plan.effect {
        Effect::Conclude { then, .. } => {
            slots.clear(then.slots);
            slots.act(&then.steps, object);
            for (claim, &slot) in claims.iter_mut().zip(sets) {
                *claim = slots.written[slot].then_some(slots.cells[slot]);
            }
        }
        Effect::Revise { amount: node, .. } | Effect::Default { value: node, .. } => {
            claims[0] = Some(scalar.cell(node));
        }
        Effect::React(_) => {}
    }
}

impl Merge {
    /// A told value stands before a concluded one, unless declared otherwise; the greatest priority with a known value
    /// is heard, and where its rules disagree nothing is known.
    fn bring(&self, told: Cell, rules: &[Running]) -> Cell {
        if told != Cell::Unknown && !self.rules_first {
            return told;
        }
        let said = |&(priority, rule, claim): &(i64, usize, usize)| {
            (priority, rules[rule].claims[claim].filter(|cell| cell.kind() == Some(self.kind)))
        };
        match heard(self.writers.iter().map(said)) {
            Heard::Value(cell) => cell,
            Heard::Nothing => told,
            Heard::Dispute => Cell::Unknown,
        }
    }
}

fn number(cell: Cell) -> f64 {
    if let Cell::Number(number) = cell { number } else { f64::NAN }
}
