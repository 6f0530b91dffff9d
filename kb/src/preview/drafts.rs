//! What edits would change that rule files belong to: the rules are others then, and everything is concluded by them.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use adit_db::door::Door;
use adit_db::room::Room;
use adit_db::{Store, Tx};
use adit_engine::{RuleTests, Value};
use serde::Serialize;

use super::{Before, Otherwise, Preview, Wanted};
use crate::edit::Edit;
use crate::edit::react::{Recalled, make_tables};
use crate::edit::rehearse::differences;
use crate::error::Result;
use crate::error::problem::Problem;
use crate::graph::SiteGraph;
use crate::knowledge::KnowledgeBase;
use crate::live::report::Concluded;
use crate::site::rules::Drafts;
use crate::state::{State, keep};
use crate::words::progress::Silent;

/// What would become of rules.
#[derive(Clone, Debug, PartialEq, Serialize, utoipa::ToSchema)]
pub struct RulesTried {
    /// Tests that would hold.
    pub passed: usize,
    /// Tests that would not.
    pub failed: usize,
    /// What would fail in them, each with its place.
    pub failures: Vec<Problem>,
    /// Rules that would decide about other rooms or doors than now, or change what is decided otherwise, and new ones that would
    /// decide about none.
    pub decides: Vec<Decides>,
}

/// About how many rooms and doors a rule decides.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, utoipa::ToSchema)]
pub struct Decides {
    pub rule: String,
    /// Whether it changes what other rules decide.
    pub revises: bool,
    /// Now; null where there is no such rule.
    pub old: Option<usize>,
    /// Then; null where there would be none.
    pub new: Option<usize>,
}

impl State {
    /// The rule files that edits would have others.
    pub(super) fn files_of(&self, edits: &[Edit]) -> Result<Drafts> {
        let has_none = |edit: &Edit| !matches!(edit, Edit::Write(_) | Edit::Undo(_) | Edit::Together(_));
        if edits.iter().all(has_none) {
            return Ok(Drafts::new());
        }
        let edits = Edit::Together(edits.to_vec());
        Store::open_read_only(self.site.database())?.snapshot(|tx| edits.files(tx))
    }

    pub(super) fn preview_of_drafts(
        self,
        edits: &[Edit],
        files: Drafts,
        route: Option<Wanted<'_>>,
    ) -> Result<Preview> {
        let site = self.site.drafting(files);
        let rules = site.load_rules()?;
        let tests = rules.tests.clone();
        let mut inputs = self.inputs.with_rules(
            site.site(),
            rules,
            site.rules.as_deref(),
            (site.planners(), &site.asked()?),
        );
        // tests that fail are said beside what would change
        inputs.tests = RuleTests::default();
        let (site, inputs) = (site.shared(), Arc::new(inputs));
        let author = KnowledgeBase::nobody();
        let of_before = route.map(|wanted| wanted.of(&self.moment())).transpose()?;
        let before = Before { route: of_before, ..Before::of(&self) };
        let rehearsed = Store::open(site.database())?.rehearse(|tx: &mut Tx<'_>| -> Result<_> {
            make_tables(tx, &inputs.rules)?;
            let untouched = site.told(tx, &inputs.rules)?;
            for edit in edits {
                edit.apply(tx, &site, &inputs.rules, &author)?;
            }
            let told = site.told(tx, &inputs.rules)?;
            let outcomes = site.trial(&inputs.rules, &tests, &told)?;
            let cells = differences(&untouched, &told);
            let graph = self.graph();
            let cut = (graph.rooms.clone(), graph.doors.clone(), (*graph.building).clone());
            let mut after = State::new(Arc::clone(&site), Arc::clone(&inputs), cut);
            (after.generation, after.patience, after.within) = (self.generation, self.patience, self.within);
            after.waits.clone_from(&self.waits);
            let step = after.step_and_react(tx, told, Recalled::OfLastBuild, &Silent)?;
            Ok((after, step, cells, outcomes))
        });
        let (after, step, cells, outcomes) = rehearsed?;
        let decides = {
            let now = about(self.graph(), &self);
            let then = about(after.graph_after(&step), &after);
            decides([now, then], step.is_cut_anew)
        };
        let failed = outcomes.iter().filter(|outcome| !outcome.failures.is_empty()).count();
        let passed = outcomes.len() - failed;
        let failures = outcomes.into_iter().flat_map(|outcome| outcome.failures);
        let failures = failures.map(|failure| Problem::of(&failure.diagnostic.into())).collect();
        let conclusions = if self.site.site().has_rooms() {
            Vec::new()
        } else {
            let of = |state: &State| keep::touched(&state.knowledge, &state.inputs.rules, &step.changes);
            Concluded::between(&of(&self), &of(&after))
        };
        let rules = Some(RulesTried { passed, failed, failures, decides });
        before.compared(after, step, route, Otherwise { cells, conclusions, rules })
    }
}

/// What a rule does to rooms and doors.
#[derive(Default)]
struct About {
    revises: bool,
    /// Rooms have even numbers, doors odd ones.
    of: BTreeSet<usize>,
    /// What a revision leads to: of the same objects it may say something else.
    to: BTreeMap<(usize, &'static str), Option<Value>>,
}

/// What each rule does, by its name.
fn about(graph: &SiteGraph, state: &State) -> BTreeMap<String, About> {
    let (rules, names) = (&state.inputs.rules, &state.inputs.rule_names);
    let mut about: BTreeMap<String, About> =
        names.values().map(|name| (name.clone(), About::default())).collect();
    for rule in rules.rules().iter().filter(|rule| rule.level().is_some()) {
        about.entry(rule.name().to_owned()).or_default().revises = true;
    }
    let mut note = |rules: [Option<i64>; 3], number: usize| {
        for name in rules.into_iter().flatten().filter_map(|rule| names.get(&rule)) {
            if let Some(about) = about.get_mut(name).filter(|about| !about.revises) {
                about.of.insert(number);
            }
        }
    };
    let room = |room: &Room| [room.hardness.rule, room.action.rule, room.passable.rule];
    let door = |door: &Door| [door.hardness.rule, door.action.rule, door.passable.rule];
    for (row, of) in graph.rooms.iter().enumerate() {
        note(room(of), 2 * row);
    }
    for (row, of) in graph.doors.iter().enumerate() {
        note(door(of), 2 * row + 1);
    }
    for (place, class) in ["ROOMS", "DOORS"].into_iter().enumerate() {
        for property in ["hardness", "action", "passable"] {
            for (rule, rows) in state.knowledge.revised(rules, class, property) {
                let values = state.knowledge.values_at(class, &rows, property);
                let about = about.entry(rule.name().to_owned()).or_default();
                let numbers = rows.iter().map(|row| 2 * *row as usize + place);
                about.of.extend(numbers.clone());
                about.to.extend(numbers.map(|number| (number, property)).zip(values));
            }
        }
    }
    about
}

fn decides([old, new]: [BTreeMap<String, About>; 2], is_cut_anew: bool) -> Vec<Decides> {
    let names = old.keys().chain(new.keys().filter(|name| !old.contains_key(*name)));
    let objects = |about: &About| about.of.len();
    let of = |rule: &String| {
        let (old, new) = (old.get(rule), new.get(rule));
        let is_same = match (old, new) {
            (Some(old), Some(new)) if is_cut_anew => objects(old) == objects(new),
            (Some(old), Some(new)) => old.of == new.of && old.to == new.to,
            _ => false,
        };
        (!is_same).then(|| Decides {
            rule: rule.clone(),
            revises: new.or(old).is_some_and(|about| about.revises),
            old: old.map(objects),
            new: new.map(objects),
        })
    };
    names.filter_map(of).collect()
}
