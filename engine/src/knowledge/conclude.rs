//! Inference: what changed goes from facts to conclusions, rule by rule in the order of their dependencies.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Instant;

use super::KnowledgeBase;
use super::dirty::Dirty;
use super::evaluate::below;
use super::memory::{Memory, Shape};
use super::pending::Pending;
use crate::changes::{Changes, ClassChanges};
use crate::conclusions::Conclusions;
use crate::order::Step;
use crate::rule::{PropertyName, Rule};
use crate::rule_base::{RuleBase, on_deep_stack};

/// For each rule the objects of its first clause that are asked for.
pub(super) type Asked = BTreeMap<usize, Dirty>;

pub(super) struct Run<'b> {
    pub(super) base: &'b RuleBase,
    pub(super) until: Instant,
    /// What was told since the last inference.
    pub(super) told: BTreeMap<String, Pending>,
    /// For each property the rows that changed, stage by stage; one stage where no rule concludes it.
    pub(super) deltas: BTreeMap<PropertyName, Vec<Dirty>>,
    pub(super) touched: BTreeSet<String>,
    pub(super) evaluated: Vec<(usize, usize)>,
    /// For each concluded property the rows whose reason may have changed.
    pub(super) reasons: BTreeMap<PropertyName, Dirty>,
    /// Whether classes, properties or rules came or went.
    pub(super) recheck: bool,
    /// Of the objects that nobody asked for yet those that are asked for now; `None` is all.
    pub(super) asked: Option<Asked>,
}

impl<'b> Run<'b> {
    pub(super) const fn new(base: &'b RuleBase, until: Instant) -> Self {
        Self {
            base,
            until,
            told: BTreeMap::new(),
            deltas: BTreeMap::new(),
            touched: BTreeSet::new(),
            evaluated: vec![],
            reasons: BTreeMap::new(),
            recheck: false,
            asked: None,
        }
    }

    /// Adds what a run changed that came after this one.
    pub(super) fn follow(&mut self, later: Run) {
        for (name, stages) in later.deltas {
            let own = self.deltas.entry(name).or_default();
            own.resize(own.len().max(stages.len()), Dirty::None);
            own.iter_mut().zip(&stages).for_each(|(own, stage)| own.join(stage));
        }
        self.evaluated.extend(later.evaluated);
        for (name, rows) in later.reasons {
            self.reasons.entry(name).or_default().join(&rows);
        }
    }

    /// The rows of a property that changed, as a rule sees it that revises at this level.
    pub(super) fn delta(&self, name: &PropertyName, stage: usize) -> &Dirty {
        const NONE: &Dirty = &Dirty::None;
        let stages = self.deltas.get(name);
        stages.and_then(|stages| stages.get(stage.min(stages.len() - 1))).unwrap_or(NONE)
    }

    /// Notes what changed in one of so many stages.
    pub(super) fn changed(&mut self, name: &PropertyName, (stage, of): (usize, usize), rows: &Dirty) {
        if rows.is_none() {
            return;
        }
        self.touched.insert(name.class.clone());
        let stages = self.deltas.entry(name.clone()).or_insert_with(|| vec![Dirty::None; of]);
        stages[stage.min(of - 1)].join(rows);
    }
}

impl KnowledgeBase {
    /// Evaluates every rule whose classes are asserted and whose properties are asserted or concluded, as far as
    /// it is new or rests on something new, and reports on all of them. What others concluded before is kept, and
    /// what rests on something that is gone is taken back.
    pub fn conclude(&mut self, rules: &RuleBase) -> Conclusions {
        let run = self.infer(rules);
        let evaluated: Vec<String> =
            run.evaluated.iter().map(|&(rule, _)| rules.rules[rule].name.clone()).collect();
        if self.agenda.is_used() {
            self.noted(&run);
        }
        Conclusions { evaluated, ..self.report(rules) }
    }

    /// As [`conclude`](Self::conclude), without the report on all rules and objects: it costs what depends on the
    /// change, and tells what changed.
    pub fn update(&mut self, rules: &RuleBase) -> Changes {
        self.follow(rules);
        std::mem::take(&mut self.unreported)
    }

    /// Makes everything right, and passes on what changed: to the agenda, and to the host's next question.
    pub(super) fn follow(&mut self, rules: &RuleBase) {
        let run = self.infer(rules);
        let changes = self.noted(&run);
        self.unreported.absorb(changes);
    }

    pub(super) fn noted(&mut self, run: &Run) -> Changes {
        let changes = self.changes(run);
        self.agenda.note(&changes);
        changes
    }

    /// Makes everything right, and tells what changed since the last inference.
    pub(super) fn renew(&mut self, rules: &RuleBase) -> Changes {
        let run = self.infer(rules);
        self.changes(&run)
    }

    fn infer<'b>(&mut self, base: &'b RuleBase) -> Run<'b> {
        let mut run = self.begin(base);
        self.advance_on(&mut run);
        run
    }

    /// Goes on until no type of a property changes any more: those that interpreted parts give are known when they
    /// have run.
    pub(super) fn advance_on(&mut self, run: &mut Run) {
        self.advance_once(run);
        for _ in 0..run.base.rules.len() {
            if !self.network.recheck {
                break;
            }
            let mut next = Run::new(run.base, run.until);
            next.recheck = std::mem::take(&mut self.network.recheck);
            next.asked.clone_from(&run.asked);
            self.advance_once(&mut next);
            run.follow(next);
        }
    }

    fn advance_once(&mut self, run: &mut Run) {
        if run.recheck || self.interprets() {
            on_deep_stack(|| self.advance(run));
        } else {
            self.advance(run);
        }
    }

    /// Whether a rule needs the deep stack that the interpreter asks for.
    fn interprets(&self) -> bool {
        self.network.nodes.iter().any(|node| node.planned.as_ref().is_some_and(|planned| planned.interprets))
    }

    pub(super) fn begin<'b>(&mut self, base: &'b RuleBase) -> Run<'b> {
        let gone = self.take_over(base);
        self.make_askable(base);
        let mut run = Run::new(base, self.limits.end(self.limits.inference));
        run.recheck = std::mem::take(&mut self.network.recheck);
        for name in gone {
            run.changed(&name, (0, 1), &Dirty::All);
        }
        for class in std::mem::take(&mut self.network.retracted) {
            self.forget(base, &class);
            run.touched.insert(class);
        }
        let told: Vec<String> = self
            .held
            .iter()
            .filter(|(_, held)| held.pending.is_something())
            .map(|(class, _)| class.clone())
            .collect();
        for class in told {
            run.touched.insert(class.clone());
            if self.held[&class].pending.anew {
                self.forget(base, &class);
            } else if self.held[&class].pending.reshaped() {
                self.reshape(base, &class);
            }
            let Some(held) = self.held.get_mut(&class) else { continue };
            let pending = std::mem::take(&mut held.pending);
            for (property, rows) in &pending.changed {
                let name = PropertyName::new(&class, property);
                match self.derived.get_mut(&name) {
                    Some(derived) => {
                        derived.pending[0].join(rows);
                        run.reasons.entry(name).or_default().join(rows);
                    }
                    None => run.changed(&name, (0, 1), &rows.clone().settle(usize::MAX)),
                }
            }
            run.told.insert(class, pending);
        }
        run
    }

    fn advance(&mut self, run: &mut Run) {
        for step in &run.base.order {
            match step {
                Step::Rule(index) => self.step(run, *index),
                Step::Merge(name) => self.merge(run, name),
                Step::Level(name, level) => self.revise(run, name, *level),
            }
        }
    }

    fn step(&mut self, run: &mut Run, index: usize) {
        let rule = &run.base.rules[index];
        if run.recheck {
            self.network.nodes[index].needs = self.needs(rule);
            if !self.network.nodes[index].needs.is_empty() {
                self.network.nodes[index].planned = None;
                self.drop_memory(index);
                return;
            }
            self.plan(run.base, index);
        } else if !self.network.nodes[index].needs.is_empty()
            || !rule.classes().any(|class| run.touched.contains(class)) && !self.is_asked(run, index)
        {
            return;
        }
        let Some(planned) = self.network.nodes[index].planned.take() else { return };
        let drivers = self.len(&rule.clauses[0].class).unwrap_or(0);
        let memory = self.network.nodes[index].memory.take().map(Arc::unwrap_or_clone);
        let mut memory = memory.unwrap_or_else(|| Memory::new(rule, &planned.plan, drivers));
        let mut dirty = self.affected(run, rule, &planned, &mut memory);
        match &run.asked {
            Some(asked) => asked.get(&index).into_iter().for_each(|rows| dirty.join(rows)),
            None if memory.unasked > 0 => dirty.extend(memory.waiting()),
            None => {}
        }
        let dirty = match dirty.settle(memory.statuses.len()) {
            // Taking out many costs more than doing all.
            Dirty::Rows(rows) if memory.unasked == 0 && rows.len() * 4 > memory.statuses.len() => Dirty::All,
            dirty => dirty,
        };
        if !dirty.is_none() || memory.statuses.is_empty() {
            let rows = match &dirty {
                Dirty::Rows(rows) => rows.len(),
                _ => memory.statuses.len(),
            };
            run.evaluated.push((index, rows));
            let output = self.evaluate(run.until, rule, &planned.plan, &mut memory, &dirty);
            // Nothing is left of a rule that was stopped, for no object.
            let dirty = if output.stopped { Dirty::All } else { dirty };
            let touched = memory.replace(&dirty, output);
            for (given, touched) in memory.given.iter().zip(touched) {
                self.pend(&given.name, rule.level(), &touched);
                let reasons = run.reasons.entry(given.name.clone()).or_default();
                match memory.shape {
                    // What a firing rests on may change though it sets the same value.
                    Shape::Single if given.variable == 0 => reasons.join(&dirty),
                    Shape::Single => reasons.join(&Dirty::All),
                    Shape::Many | Shape::Whole => reasons.join(&touched),
                }
            }
        }
        let node = &mut self.network.nodes[index];
        (node.planned, node.memory) = (Some(planned), Some(Arc::new(memory)));
    }

    /// Whether a rule has objects that nobody asked for before, and that are asked for now.
    fn is_asked(&self, run: &Run, index: usize) -> bool {
        let memory = self.network.nodes[index].memory.as_ref();
        match &run.asked {
            Some(asked) => memory.is_none() || asked.contains_key(&index),
            None => memory.is_none_or(|memory| memory.unasked > 0),
        }
    }

    pub(super) fn drop_memory(&mut self, index: usize) {
        let Some(memory) = self.network.nodes[index].memory.take() else { return };
        for given in &memory.given {
            if let Some(derived) = self.derived.get_mut(&given.name) {
                derived.pending.fill(Dirty::All);
            }
        }
    }

    /// Notes that a stage of a property has to be brought together anew for some rows.
    fn pend(&mut self, name: &PropertyName, level: Option<i64>, rows: &Dirty) {
        if let Some(derived) = self.derived.get_mut(name) {
            let stage = level.map_or(0, |level| derived.stage(Some(level)) + 1);
            derived.pending[stage].join(rows);
        }
    }

    fn needs(&self, rule: &Rule) -> Vec<String> {
        let mut needs: BTreeSet<String> =
            rule.classes().filter(|class| !self.held.contains_key(*class)).map(str::to_owned).collect();
        let own = rule.level().and(rule.sets.keys().next());
        for name in rule.reads.keys().chain(own) {
            if needs.contains(&name.class) {
                continue;
            }
            let there = match self.derived.get(name) {
                Some(derived) => {
                    derived.complete[derived.stage(below(rule, name))] && !derived.stages.is_empty()
                }
                None => self.told_column(name).is_some(),
            };
            if !there {
                needs.insert(name.to_string());
            }
        }
        needs.into_iter().collect()
    }

    pub(super) fn changes(&self, run: &Run) -> Changes {
        let mut changes = Changes::default();
        for (class, pending) in &run.told {
            let Some(len) = self.len(class) else { continue };
            let class = changes.classes.entry(class.clone()).or_default();
            class.moved.clone_from(&pending.moved);
            class.added = if pending.anew { (0..len as u32).collect() } else { pending.added.clone() };
            class.added.sort_unstable();
        }
        for (name, stages) in &run.deltas {
            let (Some(rows), Some(len)) = (stages.last(), self.len(&name.class)) else { continue };
            let class = changes.classes.entry(name.class.clone()).or_default();
            let mut rows = rows.clone().settle(len).rows(len);
            leave_out(&mut rows, &class.added);
            if !rows.is_empty() {
                class.changed.insert(name.property.clone(), rows);
            }
        }
        for (name, rows) in &run.reasons {
            let Some(len) = self.len(&name.class) else { continue };
            let mut rows = rows.clone().settle(len).rows(len);
            rows.truncate(rows.partition_point(|&row| (row as usize) < len));
            if !rows.is_empty() {
                changes.reasons.entry(name.class.clone()).or_default().insert(name.property.clone(), rows);
            }
        }
        changes.classes.retain(|_, class| *class != ClassChanges::default());
        changes.evaluated = run
            .evaluated
            .iter()
            .map(|&(rule, objects)| (run.base.rules[rule].name.clone(), objects))
            .collect();
        changes
    }
}

/// Takes some rows out of others; both ascend.
fn leave_out(rows: &mut Vec<u32>, others: &[u32]) {
    let mut others = others.iter().peekable();
    rows.retain(|row| {
        while others.next_if(|other| *other < row).is_some() {}
        others.peek() != Some(&row)
    });
}
