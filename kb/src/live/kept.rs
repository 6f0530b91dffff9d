//! What is kept of rooms, doors and other conclusions, and what differs from it after an edit.

use std::collections::BTreeMap;

use adit_db::area::Area;
use adit_db::conclusion::Derivation;
use adit_db::door::DoorWeight;
use adit_db::room::RoomWeight;
use adit_db::{Derived as Reasoned, Tx};
use adit_engine::{Changes, KnowledgeBase as Inference, RuleBase, Value};

use super::routes::KeptRoutes;
use crate::error::Result;
use crate::grounds::{Numbering, Reason, Reasons};
use crate::look::{self, number, text, truth};
use crate::store::{TABLED, decides_rooms, derivations_of};

/// Conclusions beside those of rooms and doors, and how many values rest on each witness.
pub struct Kept {
    areas: Vec<Area>,
    derivations: Vec<Derivation>,
    uses: BTreeMap<i64, usize>,
}

/// Rows that an edit changes.
#[derive(Default)]
pub struct Written {
    /// Rooms by index, with what rules now say.
    pub rooms: Vec<(usize, RoomWeight)>,
    /// Doors by index, with what rules now say.
    pub doors: Vec<(usize, DoorWeight)>,
    areas: Vec<(usize, Area)>,
    derivations: Option<Vec<Derivation>>,
    gone: Vec<Derivation>,
    new: Vec<Derivation>,
    witnesses_gone: Vec<i64>,
    witnesses_new: Vec<i64>,
    /// How many values now rest on a witness, where that changes.
    uses: BTreeMap<i64, usize>,
}

impl Kept {
    /// What a build left.
    pub fn new(areas: Vec<Area>, derivations: Vec<Derivation>, uses: BTreeMap<i64, usize>) -> Self {
        Self { areas, derivations, uses }
    }

    /// What differs after an update. Reasons are numbered in the order in which a build numbers them.
    pub fn differences(
        &self,
        knowledge: &Inference,
        rules: &RuleBase,
        changes: &Changes,
        numbering: &mut Numbering,
        routes: &KeptRoutes,
    ) -> Written {
        let graph = routes.graph();
        let mut look = Look { knowledge, changes, reasons: Reasons::new(knowledge, rules, numbering) };
        let mut uses = Uses { before: &self.uses, now: BTreeMap::new() };
        let mut areas: BTreeMap<usize, Area> = BTreeMap::new();
        look.at(("PRIME_AREAS", "open"), truth, |row, open| {
            areas.insert(row, Area { open, ..self.areas[row].clone() });
        });
        areas.retain(|row, area| self.areas[*row] != *area);
        for (row, area) in &areas {
            uses.change(self.areas[*row].open.witness, area.open.witness);
        }
        let mut rooms: BTreeMap<usize, RoomWeight> = BTreeMap::new();
        let room = |row: usize| graph.rooms[row].weight();
        look.at(("ROOMS", "hardness"), number, |row, to| {
            rooms.entry(row).or_insert_with(|| room(row)).hardness = to;
        });
        look.at(("ROOMS", "action"), text, |row, to| {
            rooms.entry(row).or_insert_with(|| room(row)).action = to;
        });
        let decided = decides_rooms(rules);
        look.at(("ROOMS", "passable"), truth, |row, mut to| {
            to.value = to.value.or(if decided { None } else { Some(true) });
            rooms.entry(row).or_insert_with(|| room(row)).passable = to;
        });
        rooms.retain(|row, weight| *weight != room(*row));
        for (row, weight) in &rooms {
            uses.change(graph.rooms[*row].hardness.witness, weight.hardness.witness);
            uses.change(graph.rooms[*row].action.witness, weight.action.witness);
            uses.change(graph.rooms[*row].passable.witness, weight.passable.witness);
        }
        let mut doors: BTreeMap<usize, DoorWeight> = BTreeMap::new();
        let door = |row: usize| {
            let door = &graph.doors[row];
            let (hardness, action) = (door.hardness.clone(), door.action.clone());
            DoorWeight { door: door.door, hardness, action, passable: door.passable.clone() }
        };
        look.at(("DOORS", "hardness"), number, |row, to| {
            doors.entry(row).or_insert_with(|| door(row)).hardness = to;
        });
        look.at(("DOORS", "action"), text, |row, to| {
            doors.entry(row).or_insert_with(|| door(row)).action = to;
        });
        look.at(("DOORS", "passable"), truth, |row, to| {
            doors.entry(row).or_insert_with(|| door(row)).passable = to;
        });
        doors.retain(|row, weight| *weight != door(*row));
        for (row, weight) in &doors {
            let before = &graph.doors[*row];
            uses.change(before.hardness.witness, weight.hardness.witness);
            uses.change(before.action.witness, weight.action.witness);
            uses.change(before.passable.witness, weight.passable.witness);
        }
        let derivations = self.derivations(rules, &mut look);
        let mut written = Written {
            rooms: rooms.into_iter().collect(),
            doors: doors.into_iter().collect(),
            areas: areas.into_iter().collect(),
            ..Written::default()
        };
        if let Some(now) = derivations {
            written.gone = self.derivations.iter().filter(|old| !now.contains(old)).cloned().collect();
            written.new = now.iter().filter(|new| !self.derivations.contains(new)).cloned().collect();
            written.gone.iter().for_each(|old| uses.change(old.witness, None));
            written.new.iter().for_each(|new| uses.change(None, new.witness));
            written.derivations = Some(now);
        }
        for (number, uses) in uses.now {
            match (self.uses.contains_key(&number), uses > 0) {
                (false, true) => written.witnesses_new.push(number),
                (true, false) => written.witnesses_gone.push(number),
                _ => {}
            }
            written.uses.insert(number, uses);
        }
        written
    }

    /// All derivations as they are now; `None` where none can have changed.
    fn derivations(&self, rules: &RuleBase, look: &mut Look<'_>) -> Option<Vec<Derivation>> {
        let mut now = None;
        for name in rules.concluded() {
            let (class, property) = (name.class.as_str(), name.property.as_str());
            if TABLED.contains(&(class, property)) || !look.may_differ(class, property) {
                continue;
            }
            let now = now.get_or_insert_with(|| self.derivations.clone());
            let of = class.to_lowercase();
            now.retain(|derivation| derivation.class != of || derivation.property != property);
            now.extend(derivations_of(look.knowledge, &mut look.reasons, (class, property)));
        }
        now
    }

    /// Makes what was written what is kept.
    pub fn accept(&mut self, written: Written, numbering: &mut Numbering) {
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
        if written.witnesses_gone.is_empty() && !numbering.has_new() {
            return;
        }
        let witnesses = numbering.witnesses(|number| self.uses.contains_key(&number));
        *numbering = Numbering::new(&witnesses);
    }
}

impl Written {
    /// Whether no room and no door is among it.
    pub fn is_empty(&self) -> bool {
        self.rooms.is_empty() && self.doors.is_empty()
    }

    /// Writes the rows.
    pub fn write(&self, tx: &mut Tx<'_>, numbering: &Numbering) -> Result<()> {
        if !self.witnesses_new.is_empty() || !self.witnesses_gone.is_empty() {
            // in their order, as the numbers of the map were
            let is_new = |number| self.witnesses_new.binary_search(&number).is_ok();
            tx.change_witnesses(&self.witnesses_gone, &numbering.witnesses(is_new))?;
        }
        tx.put_open_areas(self.areas.iter().map(|(_, area)| area))?;
        if !self.rooms.is_empty() {
            tx.put_room_weights(self.rooms.iter().map(|(_, weight)| weight))?;
        }
        if !self.doors.is_empty() {
            tx.put_door_weights(self.doors.iter().map(|(_, weight)| weight))?;
        }
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

/// Looks at values that may differ.
struct Look<'a> {
    knowledge: &'a Inference,
    changes: &'a Changes,
    reasons: Reasons<'a>,
}

impl Look<'_> {
    fn at<T>(
        &mut self,
        (class, property): (&str, &str),
        value: fn(&Value) -> Option<T>,
        mut found: impl FnMut(usize, Reasoned<T>),
    ) {
        let rows = look::rows(self.changes, class, property);
        let reasons: Vec<Reason> = self.reasons.of_rows(class, property, &rows);
        for (row, (rule, witness)) in rows.into_iter().zip(reasons) {
            let row = row as usize;
            let value = self.knowledge.value_at(class, row, property).as_ref().and_then(value);
            found(row, Reasoned { value, rule, witness });
        }
    }

    fn may_differ(&self, class: &str, property: &str) -> bool {
        let moved = |class: &adit_engine::ClassChanges| class.moved.is_some() || !class.added.is_empty();
        !self.changes.rows(class, property).is_empty()
            || !self.changes.reasons(class, property).is_empty()
            || self.changes.classes.get(class).is_some_and(moved)
    }
}
