//! What is kept of a state in the database: all rows after a build, those that differ after an edit.

use std::collections::{BTreeMap, BTreeSet};

use adit_db::Tx;
use adit_db::area::Area;
use adit_db::conclusion::{Derivation, Rule, Witness};
use adit_db::door::Door;
use adit_db::place::Frame;
use adit_db::room::Room;
use adit_db::schema::Row;
use adit_db::weight::Weight;
use adit_engine::{Changes, KnowledgeBase as Inference, RuleBase};
use adit_planners::facts::{Facts, Table};
use adit_planners::planner::Planner;

use crate::error::Result;
use crate::graph::SiteGraph;
use crate::knowledge::classes::{self, ROUTES};
use crate::knowledge::tables::{self, content};
use crate::knowledge::told::{Attached, Told};
use crate::state::grounds::Reasons;
use crate::state::rows;
use crate::state::spaces;
use crate::state::weighed;
use crate::state::{Look, Recall, State, Step, Which, truth};

/// What planners of rooms make, and rows of ours hold.
const CUT: [&str; 2] = ["ROOMS", "DOORS"];

/// What our planners make besides, and is recalled. What somebody's planner makes is made anew: nobody knows whether its
/// code is what it was.
const MADE: [&str; 4] = ["AREA_ROOMS", "DOOR_ROOMS", "SPACES", "DOORWAYS"];

/// Classes that have tables of ours, or are kept with them.
const OURS: [&str; 7] = ["STRIPS", "PRIME_AREAS", "BRIDGES", "ROOMS", "DOORS", "SPACES", "DOORWAYS"];

/// Properties that have a column of ours.
const TABLED: [(&str, &str); 7] = [
    ("PRIME_AREAS", "open"),
    ("ROOMS", "hardness"),
    ("ROOMS", "action"),
    ("ROOMS", "passable"),
    ("DOORS", "hardness"),
    ("DOORS", "action"),
    ("DOORS", "passable"),
];

/// Rooms and doors of the last build hold while the inputs of their planner stay the same.
pub struct LastBuild<'a, 's>(pub &'a mut Tx<'s>);

impl Recall for LastBuild<'_, '_> {
    fn recall(&mut self, planner: &dyn Planner, fingerprint: u64) -> Result<Option<Facts>> {
        let classes = classes_of(planner);
        let [makes_rooms, makes_doors] = CUT.map(|class| classes.contains(class));
        let is_ours = |class: &String| CUT.contains(&class.as_str()) || MADE.contains(&class.as_str());
        if makes_rooms != makes_doors || !classes.iter().all(is_ours) {
            return Ok(None);
        }
        let mut made = Facts::new();
        for class in classes.into_iter().filter(|class| !CUT.contains(&class.as_str())) {
            let table = match spaces::recalled(&class, self.0)? {
                Some(table) => table,
                None => tables::kept(self.0, &class.to_lowercase())?,
            };
            made.insert(class, table);
        }
        let stored = self.0.site_value(&fingerprint_key(planner.name()))?;
        // another program may have edited or deleted rows since: then they are made anew
        let is_edited =
            self.0.stale_marks()?.iter().any(|mark| CUT.contains(&mark.table.to_uppercase().as_str()));
        if stored.as_deref() != Some(&signature(fingerprint, made.values())) || makes_rooms && is_edited {
            return Ok(None);
        }
        Ok(Some(made))
    }
}

fn classes_of(planner: &dyn Planner) -> BTreeSet<String> {
    planner.signature().gives.iter().map(|given| classes::split(given).0.to_owned()).collect()
}

/// What a planner worked from, and what it made besides rooms and doors. An edit of those leaves a mark.
fn signature<'t>(fingerprint: u64, made: impl IntoIterator<Item = &'t Table>) -> String {
    format!("{fingerprint:016x}{:016x}", content(made))
}

fn fingerprint_key(planner: &str) -> String {
    format!("planner.{planner}")
}

/// What is kept besides rooms and doors, and how many values rest on each witness.
pub struct Kept {
    areas: Vec<Area>,
    derivations: Vec<Derivation>,
    uses: BTreeMap<i64, usize>,
}

impl Kept {
    /// What there is to keep of a state once a step is accepted, with the facts that rules chose, by number.
    fn of(state: &State, step: &Step) -> Result<(Self, BTreeMap<i64, String>)> {
        let (knowledge, rules) = (&state.knowledge, &state.inputs.rules);
        let mut reasons = Reasons::new(knowledge, rules);
        let mut look = Look { knowledge, rules, which: Which::All, reasons: Some(&mut reasons) };
        let mut areas = match step.planned.facts.get("PRIME_AREAS") {
            Some(table) => rows::areas(table)?,
            None => Vec::new(),
        };
        for (row, open) in look.each(("PRIME_AREAS", "open"), truth) {
            if let Some(area) = areas.get_mut(row) {
                area.open = open;
            }
        }
        let mut derivations = Vec::new();
        for (class, property) in untabled(knowledge, rules) {
            derivations.extend(derivations_of(&mut look, class, property));
        }
        let mut facts = reasons.into_facts();
        let graph = state.graph_after(step);
        let mut kept = Self { areas, derivations, uses: BTreeMap::new() };
        kept.uses = kept.count(graph);
        // a step that changes nothing has looked at nothing
        facts.extend(step.facts.iter().map(|(number, facts)| (*number, facts.clone())));
        Ok((kept, facts))
    }

    /// What there is in the database of a state that was just opened.
    pub fn of_opened(state: &State, step: &Step) -> Result<Self> {
        Ok(Self::of(state, step)?.0)
    }

    fn count(&self, graph: &SiteGraph) -> BTreeMap<i64, usize> {
        let rooms = graph
            .rooms
            .iter()
            .flat_map(|room| [room.hardness.witness, room.action.witness, room.passable.witness]);
        let doors = graph
            .doors
            .iter()
            .flat_map(|door| [door.hardness.witness, door.action.witness, door.passable.witness]);
        let areas = self.areas.iter().map(|area| area.open.witness);
        let others = self.derivations.iter().map(|derivation| derivation.witness);
        let mut uses = BTreeMap::new();
        for witness in rooms.chain(doors).chain(areas).chain(others).flatten() {
            *uses.entry(witness).or_default() += 1;
        }
        uses
    }

    /// Writes all there is of a state once a step is accepted, in place of what was there.
    pub fn write_all(tx: &mut Tx<'_>, state: &State, step: &Step) -> Result<Self> {
        let (kept, facts) = Self::of(state, step)?;
        let (world, graph) = (&state.inputs.world, state.graph_after(step));
        let planned = &step.planned.facts;
        let strips = match planned.get("STRIPS") {
            Some(table) if planned.contains_key("PRIME_AREAS") => rows::strip_edges(table)?,
            _ => [Vec::new(), Vec::new()],
        };
        tx.replace_areas(&strips[0], &strips[1], &kept.areas)?;
        tx.replace_rooms(&graph.rooms)?;
        tx.replace_doors(&graph.doors)?;
        tx.replace_spaces(&graph.building.spaces, &graph.building.doorways)?;
        if state.site.course().is_none() {
            tx.replace_places(&graph.places)?;
        }
        let frame = Frame {
            frame: "map".to_owned(),
            x: world.frame.at.x,
            y: world.frame.at.y,
            yaw: world.frame.heading,
        };
        tx.replace_frames(&[frame])?;
        tx.replace_area_outlines(&rows::area_outlines(&step.world, &graph.building))?;
        tx.replace_rules(
            &rule_rows(&state.inputs.rules),
            &witnesses(facts, |at| kept.uses.contains_key(&at)),
        )?;
        tx.replace_derivations(&kept.derivations)?;
        for planner in state.site.planners() {
            let Some(fingerprint) = step.planned.fingerprints.get(planner.name()) else { continue };
            let classes = classes_of(planner.as_ref());
            let made = classes.iter().filter_map(|class| planned.get(class));
            tx.set_site_value(&fingerprint_key(planner.name()), Some(&signature(*fingerprint, made)))?;
        }
        keep_planned_classes(tx, planned)?;
        Ok(kept)
    }

    /// What differs once a step is accepted that cuts nothing anew.
    pub fn differences(&self, state: &State, step: &Step) -> Written {
        let (knowledge, rules) = (&state.knowledge, &state.inputs.rules);
        let mut reasons = Reasons::new(knowledge, rules);
        let mut look =
            Look { knowledge, rules, which: Which::Touched(&step.changes), reasons: Some(&mut reasons) };
        let mut written = Written::default();
        let mut uses = Uses { before: &self.uses, now: BTreeMap::new() };
        for (row, open) in look.each(("PRIME_AREAS", "open"), truth) {
            let before = &self.areas[row];
            if before.open != open {
                uses.change(before.open.witness, open.witness);
                written.areas.push((row, Area { open, ..before.clone() }));
            }
        }
        let graph = state.graph();
        for (row, weight) in &step.weighed.rooms {
            uses.change_all(&graph[*row].weight(), weight);
        }
        for (row, weight) in &step.weighed.doors {
            uses.change_all(&graph[*row].weight(), weight);
        }
        if let Some(now) = self.derivations_now(&mut look) {
            (written.gone, written.new) = differing(&self.derivations, &now);
            written.gone.iter().for_each(|old| uses.change(old.witness, None));
            written.new.iter().for_each(|new| uses.change(None, new.witness));
            written.derivations = Some(now);
        }
        let mut facts = reasons.into_facts();
        facts.extend(step.facts.iter().map(|(number, facts)| (*number, facts.clone())));
        let is_new = |number: i64| {
            !self.uses.contains_key(&number) && uses.now.get(&number).is_some_and(|uses| *uses > 0)
        };
        written.witnesses_new = witnesses(facts, is_new);
        let is_gone = |(number, uses): (&i64, &usize)| {
            (*uses == 0 && self.uses.contains_key(number)).then_some(*number)
        };
        written.witnesses_gone = uses.now.iter().filter_map(is_gone).collect();
        written.uses = uses.now;
        written
    }

    /// All derivations as they are now; `None` where none can have changed.
    fn derivations_now(&self, look: &mut Look<'_, '_>) -> Option<Vec<Derivation>> {
        let mut now = None;
        for (class, property) in untabled(look.knowledge, look.rules) {
            if !look.may_differ(class, property) {
                continue;
            }
            let now = now.get_or_insert_with(|| self.derivations.clone());
            let of = class.to_lowercase();
            now.retain(|derivation| derivation.class != of || derivation.property != property);
            let which = std::mem::replace(&mut look.which, Which::All);
            now.extend(derivations_of(look, class, property));
            look.which = which;
        }
        now
    }

    /// What is concluded of classes without a table of ours.
    pub fn derivations(&self) -> &[Derivation] {
        &self.derivations
    }

    /// Makes what was written what is kept.
    pub fn accept(&mut self, written: Written) {
        for (row, area) in written.areas {
            self.areas[row] = area;
        }
        if let Some(derivations) = written.derivations {
            self.derivations = derivations;
        }
        for (number, uses) in written.uses {
            if uses > 0 {
                self.uses.insert(number, uses);
            } else {
                self.uses.remove(&number);
            }
        }
    }
}

/// Rows that a step changes, besides those of rooms and doors.
#[derive(Default)]
pub struct Written {
    areas: Vec<(usize, Area)>,
    derivations: Option<Vec<Derivation>>,
    gone: Vec<Derivation>,
    new: Vec<Derivation>,
    witnesses_gone: Vec<i64>,
    witnesses_new: Vec<Witness>,
    /// How many values now rest on a witness, where that changes.
    uses: BTreeMap<i64, usize>,
}

impl Written {
    /// What is no longer concluded of classes without a table of ours.
    pub fn gone(&self) -> &[Derivation] {
        &self.gone
    }

    /// What is concluded of them now and was not before.
    pub fn added(&self) -> &[Derivation] {
        &self.new
    }

    /// Writes the rows, with those of rooms and doors.
    pub fn write(&self, tx: &mut Tx<'_>, graph: &SiteGraph, step: &Step) -> Result<()> {
        if !self.witnesses_new.is_empty() || !self.witnesses_gone.is_empty() {
            tx.change_witnesses(&self.witnesses_gone, &self.witnesses_new)?;
        }
        tx.put_open_areas(self.areas.iter().map(|(_, area)| area))?;
        let rooms = step.weighed.rooms.iter();
        tx.put_weights::<Room>(rooms.map(|(row, weight)| (graph[*row].room, weight)))?;
        let doors = step.weighed.doors.iter();
        tx.put_weights::<Door>(doors.map(|(row, weight)| (graph[*row].door, weight)))?;
        if let Some(building) = &step.weighed.building {
            tx.replace_spaces(&building.spaces, &building.doorways)?;
            tx.replace_area_outlines(&rows::area_outlines(&step.world, building))?;
        }
        tx.restore_blocks(&graph.rooms)?;
        tx.restore_blocks(&graph.doors)?;
        let gone: Vec<&Derivation> = self.gone.iter().collect();
        tx.change_derivations(&gone, &self.new.iter().collect::<Vec<_>>())?;
        Ok(())
    }
}

/// How many values rest on each witness, where that changes.
struct Uses<'a> {
    before: &'a BTreeMap<i64, usize>,
    now: BTreeMap<i64, usize>,
}

impl Uses<'_> {
    fn change_all(&mut self, from: &Weight, to: &Weight) {
        for (from, to) in from.witnesses().into_iter().zip(to.witnesses()) {
            self.change(from, to);
        }
    }

    fn change(&mut self, from: Option<i64>, to: Option<i64>) {
        if from == to {
            return;
        }
        if let Some(to) = to {
            *self.count(to) += 1;
        }
        if let Some(from) = from {
            let uses = self.count(from);
            *uses = uses.saturating_sub(1);
        }
    }

    fn count(&mut self, witness: i64) -> &mut usize {
        self.now.entry(witness).or_insert_with(|| self.before.get(&witness).copied().unwrap_or(0))
    }
}

/// The facts that are wanted, as rows.
fn witnesses(facts: BTreeMap<i64, String>, is_wanted: impl Fn(i64) -> bool) -> Vec<Witness> {
    let wanted = facts.into_iter().filter(|(number, _)| is_wanted(*number));
    wanted.map(|(witness, facts)| Witness { witness, facts }).collect()
}

/// What rules conclude that has no column of ours. Routes are told once a step is over, so that what is concluded of them is
/// of the moment.
fn untabled<'r>(knowledge: &Inference, rules: &'r RuleBase) -> impl Iterator<Item = (&'r str, &'r str)> {
    let names = rules.concluded().into_iter();
    let names = names.map(|name| (name.class.as_str(), name.property.as_str()));
    let added = CUT.map(|class| (class, weighed::measures(knowledge, class)));
    let adds_up = move |(class, property): (&str, &str)| {
        added.iter().any(|(of, names)| *of == class && names.iter().any(|name| name == property))
    };
    names.filter(move |name| !TABLED.contains(name) && !adds_up(*name) && name.0 != ROUTES)
}

/// What rules conclude of classes without a table of ours, of the properties that a step touched: of all objects, since rows
/// that come and go move the others.
pub fn touched(knowledge: &Inference, rules: &RuleBase, changes: &Changes) -> Vec<Derivation> {
    let mut reasons = Reasons::new(knowledge, rules);
    let mut look = Look { knowledge, rules, which: Which::Touched(changes), reasons: Some(&mut reasons) };
    let names: Vec<_> =
        untabled(knowledge, rules).filter(|(class, property)| look.may_differ(class, property)).collect();
    look.which = Which::All;
    names.into_iter().flat_map(|(class, property)| derivations_of(&mut look, class, property)).collect()
}

/// Values that rules concluded of one property that has no column of ours.
fn derivations_of(look: &mut Look<'_, '_>, class: &str, property: &str) -> Vec<Derivation> {
    let mut found = Vec::new();
    let knowledge = look.knowledge;
    let Some(column) = classes::column(knowledge, class, property) else { return found };
    for (row, reason) in look.each((class, property), |_| Some(())) {
        let (Some(rule), Some(key)) = (reason.rule, knowledge.key(class, row)) else { continue };
        found.push(Derivation {
            class: class.to_lowercase(),
            key: key.as_str().into(),
            property: property.to_owned(),
            value: tables::cell(&column, row),
            rule,
            witness: reason.witness,
        });
    }
    found
}

fn rule_rows(rules: &RuleBase) -> Vec<Rule> {
    let row = |(index, rule): (usize, &adit_engine::Rule)| Rule {
        rule: index as i64 + 1,
        name: rule.name().to_owned(),
        version: rule.version().to_owned(),
        file: Some(rule.file().to_owned()),
        line: Some(rule.line() as i64),
    };
    rules.rules().iter().enumerate().map(row).collect()
}

/// Facts of planners from outside are kept as tables, so that SQL sees them and an edit without the planner
/// goes on from them.
fn keep_planned_classes(tx: &mut Tx<'_>, facts: &Facts) -> Result<()> {
    for (class, table) in facts {
        if !OURS.contains(&class.as_str()) {
            tables::keep(tx, &class.to_lowercase(), table)?;
        }
    }
    Ok(())
}

/// Keeps which objects facts are about, where that differs from what was kept.
pub(crate) fn keep_standings(tx: &mut Tx<'_>, told: &Told, attached: &Attached) -> Result<()> {
    let standings = told.standings(attached);
    if tx.standings()? != standings {
        tx.replace_standings(&standings)?;
    }
    Ok(())
}

/// Those of some derivations that others have not got, and the other way round.
pub fn differing(before: &[Derivation], now: &[Derivation]) -> (Vec<Derivation>, Vec<Derivation>) {
    let named = |all: &[Derivation]| -> BTreeMap<(String, String, String), Vec<usize>> {
        let mut places: BTreeMap<_, Vec<usize>> = BTreeMap::new();
        for (place, of) in all.iter().enumerate() {
            let name = (of.class.clone(), of.property.clone(), of.key.to_string());
            places.entry(name).or_default().push(place);
        }
        places
    };
    let without = |some: &[Derivation], others: &[Derivation]| {
        let places = named(others);
        let has = |of: &Derivation| {
            let name = (of.class.clone(), of.property.clone(), of.key.to_string());
            places.get(&name).is_some_and(|places| places.iter().any(|&place| others[place] == *of))
        };
        some.iter().filter(|of| !has(of)).cloned().collect()
    };
    (without(before, now), without(now, before))
}
