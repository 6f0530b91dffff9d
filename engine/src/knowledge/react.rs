//! Reactions: rules that react are carried out, one activation at a time, until none waits.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::time::Instant;

use super::KnowledgeBase;
use super::evaluate::Known;
use super::facts::FactError;
use super::undo::Undo;
use crate::agenda::{Binding, Halt, Outside, Stopped};
use crate::conclusions::Witness;
use crate::diagnostic::{Code, Diagnostic};
use crate::machine::lane::NO_ROW;
use crate::reactions::{Activation, CarriedOut, Firing, Reactions};
use crate::rule::{Clause, Rule};
use crate::rule_base::{RuleBase, on_deep_stack};
use crate::told::NamesTold;
use crate::value::Value;

/// Firings at the end of a run that is too long, among which the rules of a loop are looked for.
const WINDOW: usize = 1000;

impl KnowledgeBase {
    /// Makes everything right that follows from what was told, and then carries out the rules that react: one
    /// activation at a time, the first of the agenda, with everything made right again after each, until none
    /// waits.
    ///
    /// An action that fails has told nothing. A run that is stopped by a limit is taken back whole.
    pub fn react(&mut self, rules: &RuleBase) -> Reactions {
        on_deep_stack(|| self.run(rules))
    }

    /// What would be carried out next, in order. Everything derived is made right for that; nothing is carried out.
    pub fn agenda(&mut self, rules: &RuleBase) -> Vec<Activation> {
        on_deep_stack(|| {
            self.prepare(rules);
            self.follow(rules);
            let mut run = Run::new(rules, self.limits.end(self.limits.reactions));
            if self.matching(&mut run, true).is_err() {
                return vec![];
            }
            let activation = |(number, binding): (usize, &Binding)| {
                let rule: &Rule = &rules.rules[number];
                Activation {
                    rule: rule.name.clone(),
                    version: rule.version.clone(),
                    priority: rule.priority,
                    witnesses: self.called(rule, &self.rows(number, binding)),
                }
            };
            self.agenda.open().map(activation).collect()
        })
    }

    /// Takes these activations for carried out, which were so in another knowledge base of the same facts.
    pub fn resume(&mut self, rules: &RuleBase, carried_out: &[CarriedOut]) {
        if carried_out.is_empty() {
            return;
        }
        on_deep_stack(|| {
            if !self.match_all(rules) {
                return;
            }
            let mut left: BTreeMap<&CarriedOut, usize> = BTreeMap::new();
            for of in carried_out {
                *left.entry(of).or_default() += 1;
            }
            let done: Vec<(usize, Binding)> = self
                .agenda
                .open()
                .filter(|(number, binding)| {
                    let count = left.get_mut(&self.describe(&rules.rules[*number], *number, binding));
                    count.is_some_and(|count| {
                        let is_left = *count > 0;
                        *count = count.saturating_sub(1);
                        is_left
                    })
                })
                .map(|(number, binding)| (number, Binding::clone(binding)))
                .collect();
            for (number, binding) in done {
                self.agenda.carry_out(number, &binding);
            }
        });
    }

    /// Whether an activation waits to be carried out, or matching would be stopped by a limit, which [`react`](Self::react) then
    /// says.
    pub fn is_waiting(&mut self, rules: &RuleBase) -> bool {
        on_deep_stack(|| !self.match_all(rules) || self.agenda.open().next().is_some())
    }

    /// What was carried out and would not be carried out again now, in order. Everything derived is made right for that.
    pub fn carried_out(&mut self, rules: &RuleBase) -> Vec<CarriedOut> {
        on_deep_stack(|| {
            self.match_all(rules);
            let describe =
                |(number, binding): (usize, &Binding)| self.describe(&rules.rules[number], number, binding);
            let mut all: Vec<CarriedOut> = self.agenda.fired().map(describe).collect();
            all.sort();
            all
        })
    }

    fn match_all(&mut self, rules: &RuleBase) -> bool {
        self.prepare(rules);
        self.follow(rules);
        let mut run = Run::new(rules, self.limits.end(self.limits.reactions));
        self.matching(&mut run, true).is_ok()
    }

    fn describe(&self, rule: &Rule, number: usize, binding: &Binding) -> CarriedOut {
        let because = self.because(rule, &self.rows(number, binding));
        CarriedOut { rule: rule.name.clone(), version: rule.version.clone(), because }
    }

    /// The objects with what a rule reads of them, as in `door 3: closed = true, width = 1; robot cart`.
    fn because(&self, rule: &Rule, rows: &[Option<usize>]) -> String {
        let of = |(variable, (clause, row)): (usize, (&Clause, &Option<usize>))| {
            let row = (*row)?;
            let class = &clause.class;
            let table = self.held.get(class).map(|held| &held.table);
            let parts: Vec<&String> = table
                .map_or_else(Vec::new, |table| table.key.iter().map(|&part| &table.names[part]).collect());
            let key = if parts.is_empty() { String::new() } else { self.key(class, row)? };
            let reads = rule.reaction().into_iter().flat_map(|reaction| &reaction.reads);
            let reads = reads.filter(|(of, property)| *of == variable && !parts.contains(&property));
            let read = reads.map(|(_, property)| {
                let value = self.value_at(class, row, property);
                format!("{property} = {}", value.as_ref().map_or_else(|| "unknown".to_owned(), in_short))
            });
            let read: Vec<String> = read.collect();
            // a cart that is called `cart 1` is not called twice what it is
            let is_said = key.split(' ').next() == Some(&clause.variable);
            let name = if is_said { key } else { format!("{} {key}", clause.variable) };
            let name = name.trim_end();
            Some(if read.is_empty() { name.to_owned() } else { format!("{name}: {}", read.join(", ")) })
        };
        let all: Vec<String> = rule.clauses.iter().zip(rows).enumerate().filter_map(of).collect();
        all.join("; ")
    }

    /// How many reactions led to the present state.
    pub const fn generation(&self) -> u64 {
        self.generation
    }

    fn run(&mut self, rules: &RuleBase) -> Reactions {
        let mut run = Run::new(rules, self.limits.end(self.limits.reactions));
        self.prepare(rules);
        self.follow(rules);
        let mut stopped = self.matching(&mut run, true).err().map(|why| self.too_much(rules, why));
        let checkpoint = self.agenda.checkpoint();
        let generation = self.generation;
        while stopped.is_none() {
            let Some((number, binding)) = self.agenda.next(&run.skipped) else { break };
            if run.firings.len() >= self.limits.firings {
                stopped = Some(endless(rules, &run.fired, self.limits.firings));
                break;
            }
            if Instant::now() > run.until {
                stopped = Some(late(&rules.rules[number]));
                break;
            }
            self.agenda.carry_out(number, &binding);
            if self.carry_out(number, &binding, &mut run) {
                self.follow(rules);
                stopped = self.matching(&mut run, false).err().map(|why| self.too_much(rules, why));
            }
        }
        if stopped.is_some() {
            self.take_back(&mut run.undo);
            self.generation = generation;
            run.firings.clear();
            let changes = self.renew(rules);
            self.unreported.absorb(changes);
            self.agenda.go_back(checkpoint);
        }
        let diagnostics = run.diagnostics().into_iter().chain(stopped).collect();
        Reactions { firings: run.firings, changes: std::mem::take(&mut self.unreported), diagnostics }
    }

    /// Carries out one activation; `false` if it failed, and so told nothing.
    fn carry_out(&mut self, number: usize, binding: &Binding, run: &mut Run) -> bool {
        let rule = &run.rules.rules[number];
        let rows = self.rows(number, binding);
        let edits = match self.body(number, binding, &rows, run) {
            Ok(edits) => edits,
            Err(problem) => {
                if problem.code == Code::Deadline {
                    run.skipped.insert(number);
                }
                run.failed(number, *problem);
                return false;
            }
        };
        let (witnesses, because) = (self.called(rule, &rows), self.because(rule, &rows));
        let told = match self.act(&edits, &mut run.undo) {
            Ok(done) => done,
            Err(wrong) => {
                run.failed(number, refused(rule, &wrong));
                return false;
            }
        };
        self.generation += 1;
        run.fired.push(number);
        run.firings.push(Firing {
            generation: self.generation,
            rule: rule.name.clone(),
            version: rule.version.clone(),
            witnesses,
            because,
            told,
        });
        true
    }

    /// Brings the matches up to what is told and concluded now.
    fn matching(&mut self, run: &mut Run, check: bool) -> Result<(), Stopped> {
        let mut agenda = std::mem::take(&mut self.agenda);
        let (done, troubles) = {
            let outside = self.outside(run);
            (agenda.follow(&outside, check), outside.troubles.take())
        };
        self.agenda = agenda;
        for (rule, problems) in troubles {
            for problem in problems {
                run.failed(rule, problem);
            }
        }
        done
    }

    pub(super) fn outside<'o>(&'o self, run: &'o Run) -> Outside<'o> {
        Outside {
            rules: run.rules,
            facts: self,
            kinds: Box::new(Known { base: self, rule: None, told: Some(&run.told) }),
            symbols: &self.symbols,
            deadline: run.until,
            matches: self.limits.matches,
            troubles: RefCell::default(),
        }
    }

    fn rows(&self, number: usize, binding: &Binding) -> Vec<Option<usize>> {
        let row = |(clause, &id): (usize, &u32)| {
            let class = self.agenda.class_of(number, clause)?;
            (id != NO_ROW).then(|| self.agenda.world.row(class, id))?
        };
        binding.iter().enumerate().map(row).collect()
    }

    fn called(&self, rule: &Rule, rows: &[Option<usize>]) -> Vec<Witness> {
        let witness = |(clause, row): (&Clause, &Option<usize>)| {
            let key = self.key(&clause.class, (*row).filter(|_| clause.link.is_none())?)?;
            Some(Witness { variable: clause.variable.clone(), class: clause.class.clone(), key })
        };
        rule.clauses.iter().zip(rows).filter_map(witness).collect()
    }

    fn too_much(&self, rules: &RuleBase, Stopped { rule, halt }: Stopped) -> Diagnostic {
        let rule = &rules.rules[rule];
        match halt {
            Halt::Late => late(rule),
            Halt::Full => {
                let most = self.limits.matches;
                let message =
                    format!("rule \"{}\" has more matches than the {most} that are kept", rule.name);
                let help = "an `each` more than is meant, or a `where` too few; nothing of this run was kept";
                rule.file.error(Code::Matches, rule.position, message).help(help)
            }
        }
    }
}

pub(super) struct Run<'r> {
    pub(super) rules: &'r RuleBase,
    told: NamesTold<'r>,
    pub(super) until: Instant,
    firings: Vec<Firing>,
    fired: Vec<usize>,
    undo: Undo,
    /// Rules whose bodies were stopped by a limit.
    skipped: BTreeSet<usize>,
    /// By rule what failed first, and how many times it did.
    failures: BTreeMap<usize, (Diagnostic, usize)>,
}

impl<'r> Run<'r> {
    fn new(rules: &'r RuleBase, until: Instant) -> Self {
        Self {
            rules,
            told: NamesTold::of(&rules.rules),
            until,
            firings: vec![],
            fired: vec![],
            undo: Undo::default(),
            skipped: BTreeSet::new(),
            failures: BTreeMap::new(),
        }
    }

    fn failed(&mut self, rule: usize, problem: Diagnostic) {
        self.failures.entry(rule).or_insert((problem, 0)).1 += 1;
    }

    fn diagnostics(&mut self) -> Vec<Diagnostic> {
        let said = |(problem, times): (Diagnostic, usize)| match times {
            0 | 1 => problem,
            more => problem.help(format!("it failed {more} times; this is the first")),
        };
        std::mem::take(&mut self.failures).into_values().map(said).collect()
    }
}

/// A value to read: of a number six digits.
fn in_short(value: &Value) -> String {
    let &Value::Number(number) = value else { return value.to_string() };
    if number.abs() < f64::MIN_POSITIVE || !number.is_finite() {
        return number.to_string();
    }
    let digits = (5.0 - number.abs().log10().floor()).clamp(0.0, 15.0);
    let scale = 10_f64.powf(digits);
    let rounded = (number * scale).round() / scale;
    if rounded.is_finite() { rounded.to_string() } else { number.to_string() }
}

fn late(rule: &Rule) -> Diagnostic {
    let message = format!("the reactions took longer than they may; rule \"{}\" was at work", rule.name);
    rule.file.error(Code::Deadline, rule.position, message).help("nothing of this run was kept")
}

fn refused(rule: &Rule, wrong: &FactError) -> Diagnostic {
    let position = rule.reaction().map_or(rule.position, |reaction| reaction.body.position());
    let message = format!("rule \"{}\" told what cannot be: {wrong}", rule.name);
    rule.file.error(Code::Evaluation, position, message).help("nothing of this action was done")
}

fn endless(rules: &RuleBase, fired: &[usize], most: usize) -> Diagnostic {
    let last = &fired[fired.len() - fired.len().div_ceil(2).min(WINDOW)..];
    let mut names: Vec<usize> = vec![];
    for rule in last {
        if !names.contains(rule) {
            names.push(*rule);
        }
    }
    names.sort_unstable();
    let quoted: Vec<String> = names.iter().map(|&rule| format!("\"{}\"", rules.rules[rule].name)).collect();
    let who = match quoted.as_slice() {
        [one] => format!("rule {one} fires again and again"),
        [first @ .., last] => format!("rules {} and {last} fire in turn", first.join(", ")),
        [] => "a rule fires".to_owned(),
    };
    let rule = &rules.rules[names.first().copied().unwrap_or(0)];
    let message = format!("{who}: no end after {most} firings");
    rule.file
        .error(Code::Loop, rule.position, message)
        .help("a reaction must make its own condition false in the end; nothing of this run was kept")
}

#[cfg(test)]
mod tests;
