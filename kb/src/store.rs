//! What a derivation made, on its way into the database; and what an earlier one left there.

use std::collections::BTreeMap;

use adit_db::conclusion::{Derivation, Rule, Witness};
use adit_db::door::Door;
use adit_db::place::{Frame, Place};
use adit_db::room::Room;
use adit_db::{Derived as Reasoned, Tx};
use adit_engine::{KnowledgeBase as Inference, RuleBase};
use adit_planners::facts::Facts;
use adit_planners::planner::Planner;
use adit_planners::world::World;

use crate::derive::{Derived, Memory, content};
use crate::error::Result;
use crate::grounds::{Numbering, Reason, Reasons};
use crate::report::Before;
use crate::weights::check_hardness;
use crate::{classes, rows, tables};

/// What planners of rooms make: rooms, doors, and which room lies in which named area or door.
const MADE: [&str; 4] = ["ROOMS", "DOORS", "AREA_ROOMS", "DOOR_ROOMS"];

/// Rooms and doors of the last build, kept while the inputs of their planner stay the same.
pub struct LastBuild<'a, 's> {
    tx: &'a mut Tx<'s>,
    before: &'a Before,
}

impl<'a, 's> LastBuild<'a, 's> {
    /// What was read of the last build in this transaction.
    pub fn new(tx: &'a mut Tx<'s>, before: &'a Before) -> Self {
        Self { tx, before }
    }
}

impl Memory for LastBuild<'_, '_> {
    fn recall(&mut self, planner: &dyn Planner, fingerprint: u64) -> Result<Option<Facts>> {
        let gives = planner.signature().gives;
        let gives = |class: &str| gives.iter().any(|given| classes::split(given).0 == class);
        let others = |given: &String| !MADE.contains(&classes::split(given).0);
        if !(gives("ROOMS") && gives("DOORS")) || planner.signature().gives.iter().any(others) {
            return Ok(None);
        }
        let stored = self.tx.site_value(&fingerprint_key(planner.name()))?;
        let [area_rooms, door_rooms] =
            [tables::kept(self.tx, "area_rooms")?, tables::kept(self.tx, "door_rooms")?];
        let rooms = rows::rooms_table(&self.before.rooms);
        let made = [rooms, rows::doors_table(&self.before.doors), area_rooms, door_rooms];
        // another program may have edited or deleted rows since: then they are made anew
        if stored.as_deref() != Some(&signature(fingerprint, &made)) {
            return Ok(None);
        }
        let made = MADE.into_iter().zip(made).filter(|(class, _)| gives(class));
        Ok(Some(made.map(|(class, table)| (class.to_owned(), table)).collect()))
    }
}

/// What a planner worked from, and what came of it.
fn signature(fingerprint: u64, made: &[adit_planners::facts::Table]) -> String {
    format!("{fingerprint:016x}{:016x}", content(made))
}

fn fingerprint_key(planner: &str) -> String {
    format!("planner.{planner}")
}

/// Values of a property with their reasons, one an object.
fn reasoned<T>(values: Option<Vec<Option<T>>>, reasons: &[Reason], len: usize) -> Vec<Reasoned<T>> {
    let mut values = values.unwrap_or_default().into_iter();
    (0..len)
        .map(|row| {
            let (rule, witness) = reasons.get(row).copied().unwrap_or_default();
            Reasoned { value: values.next().flatten(), rule, witness }
        })
        .collect()
}

/// Whether rooms are entered. A rule base without a rule about it lets all of them be.
fn entered(
    knowledge: &Inference,
    rules: &RuleBase,
    reasons: &mut Reasons<'_>,
    len: usize,
) -> Vec<Reasoned<bool>> {
    let said = knowledge.truths("ROOMS", "passable");
    let mut passable = reasoned(said, &reasons.of("ROOMS", "passable"), len);
    if !decides_rooms(rules) {
        for room in &mut passable {
            room.value = room.value.or(Some(true));
        }
    }
    passable
}

/// Whether rules say which rooms are entered.
pub fn decides_rooms(rules: &RuleBase) -> bool {
    rules
        .concluded()
        .iter()
        .any(|name| name.class.as_str() == "ROOMS" && name.property.as_str() == "passable")
}

/// The tables that a derivation gives.
pub struct Tables {
    /// Rooms with their weights.
    pub rooms: Vec<Room>,
    /// Doors with their weights.
    pub doors: Vec<Door>,
    /// Prime areas.
    pub areas: Vec<adit_db::area::Area>,
    strips: [Vec<f64>; 2],
    rules: Vec<Rule>,
    witnesses: Vec<Witness>,
    /// What rules concluded about anything else.
    pub derivations: Vec<Derivation>,
}

impl Tables {
    /// The tables of what was derived.
    ///
    /// # Arguments
    /// `numbering` has the numbers of witnesses that are taken.
    pub fn new(derived: &Derived, rules: &RuleBase, numbering: &mut Numbering) -> Result<Self> {
        let knowledge = &derived.knowledge;
        let facts = |class: &str| derived.facts.get(class).cloned().unwrap_or_default();
        let mut reasons = Reasons::new(knowledge, rules, numbering);
        let (mut rooms, mut doors) = (rows::rooms(&facts("ROOMS"))?, rows::doors(&facts("DOORS"))?);
        let mut areas = Vec::new();
        let mut strips = [Vec::new(), Vec::new()];
        if derived.facts.contains_key("PRIME_AREAS") {
            areas = rows::areas(&facts("PRIME_AREAS"))?;
            strips = rows::strip_edges(&facts("STRIPS"))?;
        }
        check_hardness(knowledge, "ROOMS", |row| format!("room {}", rooms[row].name))?;
        check_hardness(knowledge, "DOORS", |row| format!("door {}", doors[row].door))?;
        let numbers = |class, property| knowledge.numbers(class, property);
        let texts = |class, property| {
            let owned = |text: Option<std::sync::Arc<str>>| text.map(|text| text.to_string());
            knowledge.texts(class, property).map(|texts| texts.into_iter().map(owned).collect())
        };
        let open = reasoned(
            knowledge.truths("PRIME_AREAS", "open"),
            &reasons.of("PRIME_AREAS", "open"),
            areas.len(),
        );
        for (area, open) in areas.iter_mut().zip(open) {
            area.open = open;
        }
        let hardness = reasoned(numbers("ROOMS", "hardness"), &reasons.of("ROOMS", "hardness"), rooms.len());
        let action = reasoned(texts("ROOMS", "action"), &reasons.of("ROOMS", "action"), rooms.len());
        let passable = entered(knowledge, rules, &mut reasons, rooms.len());
        for (room, ((hardness, action), passable)) in
            rooms.iter_mut().zip(hardness.into_iter().zip(action).zip(passable))
        {
            (room.hardness, room.action, room.passable) = (hardness, action, passable);
        }
        let hardness = reasoned(numbers("DOORS", "hardness"), &reasons.of("DOORS", "hardness"), doors.len());
        let action = reasoned(texts("DOORS", "action"), &reasons.of("DOORS", "action"), doors.len());
        let passable =
            reasoned(knowledge.truths("DOORS", "passable"), &reasons.of("DOORS", "passable"), doors.len());
        for (door, ((hardness, action), passable)) in
            doors.iter_mut().zip(hardness.into_iter().zip(action).zip(passable))
        {
            (door.hardness, door.action, door.passable) = (hardness, action, passable);
        }
        let derivations = derivations(knowledge, rules, &mut reasons);
        let rules = rule_rows(rules);
        let mut made = Self { rooms, doors, areas, strips, rules, witnesses: Vec::new(), derivations };
        let uses = made.uses();
        made.witnesses = numbering.witnesses(|number| uses.contains_key(&number));
        Ok(made)
    }

    /// How many values rest on each witness.
    pub fn uses(&self) -> BTreeMap<i64, usize> {
        let rooms = self
            .rooms
            .iter()
            .flat_map(|room| [room.hardness.witness, room.action.witness, room.passable.witness]);
        let doors = self
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

    /// Writes all of it in place of what was there.
    pub fn write(&self, tx: &mut Tx<'_>, world: &World, derived: &Derived) -> Result<()> {
        tx.replace_areas(&self.strips[0], &self.strips[1], &self.areas)?;
        tx.replace_rooms(&self.rooms)?;
        tx.replace_doors(&self.doors)?;
        tx.replace_places(&places(world))?;
        let frame =
            Frame { frame: "map".to_owned(), x: world.frame.x, y: world.frame.y, yaw: world.frame.yaw };
        tx.replace_frames(&[frame])?;
        tx.replace_rules(&self.rules, &self.witnesses)?;
        tx.replace_derivations(&self.derivations)?;
        let members = |class: &str| derived.facts.get(class).cloned().unwrap_or_default();
        let made = [
            rows::rooms_table(&self.rooms),
            rows::doors_table(&self.doors),
            members("AREA_ROOMS"),
            members("DOOR_ROOMS"),
        ];
        for (planner, fingerprint) in &derived.fingerprints {
            tx.set_site_value(&fingerprint_key(planner), Some(&signature(*fingerprint, &made)))?;
        }
        Ok(())
    }
}

/// The map's places as rows.
pub fn places(world: &World) -> Vec<Place> {
    let mut places: Vec<Place> = world
        .places
        .iter()
        .map(|place| Place { place: place.name.clone(), x: place.at.x, y: place.at.y })
        .collect();
    places.sort_by(|a, b| a.place.cmp(&b.place));
    places
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

/// Columns of these classes have tables of their own.
pub const TABLED: [(&str, &str); 7] = [
    ("PRIME_AREAS", "open"),
    ("ROOMS", "hardness"),
    ("ROOMS", "action"),
    ("ROOMS", "passable"),
    ("DOORS", "hardness"),
    ("DOORS", "action"),
    ("DOORS", "passable"),
];

/// Values that rules concluded about anything else.
fn derivations(knowledge: &Inference, rules: &RuleBase, reasons: &mut Reasons<'_>) -> Vec<Derivation> {
    let mut found = Vec::new();
    for name in rules.concluded() {
        let (class, property) = (name.class.as_str(), name.property.as_str());
        if TABLED.contains(&(class, property)) {
            continue;
        }
        found.extend(derivations_of(knowledge, reasons, (class, property)));
    }
    found
}

/// Values that rules concluded of one property that has no table of ours.
pub fn derivations_of(
    knowledge: &Inference,
    reasons: &mut Reasons<'_>,
    (class, property): (&str, &str),
) -> Vec<Derivation> {
    let mut found = Vec::new();
    if let Some(column) = classes::column(knowledge, class, property) {
        for (row, (rule, witness)) in reasons.of(class, property).into_iter().enumerate() {
            let (Some(rule), Some(key)) = (rule, knowledge.key(class, row)) else { continue };
            found.push(Derivation {
                class: class.to_lowercase(),
                key: key.as_str().into(),
                property: property.to_owned(),
                value: tables::cell(&column, row),
                rule,
                witness,
            });
        }
    }
    found
}
