//! What rules say of rooms and doors after an inference, and in what it differs from what they said.

use std::sync::Arc;

use adit_db::Derived;
use adit_db::door::Door;
use adit_db::measure::Measures;
use adit_db::room::Room;
use adit_db::schema::{Part, Row};
use adit_db::space::Doorway;
use adit_db::weight::Weight;
use adit_engine::{Changes, KnowledgeBase as Inference, RuleBase, Value};
use adit_planners::routes::{DoorIndex, RoomIndex};
use adit_planners::world::World;
use rayon::prelude::*;

use crate::graph::Building;
use crate::knowledge::told::{Closable, Line};
use crate::state::grounds::{Facts, Reason, Reasons};
use crate::state::spaces;

/// Where it stands which measures there are.
const MEASURES: (&str, &str) = ("MEASURES", "measure");

/// Rooms and doors with what rules now say of them: those that differ from what they said, ascending.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Weighed {
    pub rooms: Vec<(RoomIndex, Weight)>,
    pub doors: Vec<(DoorIndex, Weight)>,
    /// Spaces and doorways, where rules say something else of any.
    pub building: Option<Arc<Building>>,
}

impl Weighed {
    /// Whether rules say of everything what they said.
    pub fn is_empty(&self) -> bool {
        self.rooms.is_empty() && self.doors.is_empty() && self.building.is_none()
    }

    /// In what rooms and doors differ, row by row.
    pub fn between(before: (&[Room], &[Door]), after: (&[Room], &[Door])) -> Self {
        fn differing<R: Row, I: From<u32>>(before: &[R], after: &[R]) -> Vec<(I, Weight)> {
            let rows = (0..before.len().min(after.len()))
                .filter(|&row| !is_alike(&before[row], &after[row], Part::Weight));
            rows.map(|row| (I::from(row as u32), after[row].weight())).collect()
        }
        Self { rooms: differing(before.0, after.0), doors: differing(before.1, after.1), building: None }
    }
}

/// Whether two rows hold the same in a part of their columns.
fn is_alike<R: Row>(one: &R, other: &R, part: Part) -> bool {
    R::columns_of(part).all(|column| (column.get)(one) == (column.get)(other))
}

/// Whether rooms and doors are cut as they were: what rules say of them may differ.
pub fn is_same_cut(before: (&[Room], &[Door]), after: (&[Room], &[Door])) -> bool {
    fn is_same<R: Row>(before: &[R], after: &[R]) -> bool {
        before.len() == after.len()
            && before.iter().zip(after).all(|(old, new)| is_alike(old, new, Part::Cut))
    }
    is_same(before.0, after.0) && is_same(before.1, after.1)
}

/// Whether rules say which rooms are entered. A rule base without a rule about it lets all of them be.
pub fn decides_rooms(rules: &RuleBase) -> bool {
    rules
        .concluded()
        .iter()
        .any(|name| name.class.as_str() == "ROOMS" && name.property.as_str() == "passable")
}

/// Which objects are looked at.
#[derive(Clone, Copy)]
pub enum Which<'a> {
    /// All there are.
    All,
    /// Those of which something may have changed.
    Touched(&'a Changes),
}

/// What rules say of one property of some objects.
struct Said {
    values: Vec<Option<Value>>,
    reasons: Vec<Reason>,
    facts: Facts,
}

/// Looks at what an inference concluded.
pub struct Look<'a, 'r> {
    /// What was concluded.
    pub knowledge: &'a Inference,
    /// By which rules.
    pub rules: &'a RuleBase,
    /// Of which objects.
    pub which: Which<'a>,
    /// Why; `None` where nobody asks.
    pub reasons: Option<&'r mut Reasons<'a>>,
}

impl Look<'_, '_> {
    /// What rules say of rooms: of those that are looked at.
    pub fn rooms(&mut self) -> impl IndexedParallelIterator<Item = (RoomIndex, Weight)> + use<> {
        let otherwise = (!decides_rooms(self.rules)).then_some(true);
        self.weights("ROOMS").map(move |(room, mut weight)| {
            weight.passable.value = weight.passable.value.or(otherwise);
            (room, weight)
        })
    }

    /// What rules say of doors: of those that are looked at.
    pub fn doors(&mut self) -> impl IndexedParallelIterator<Item = (DoorIndex, Weight)> + use<> {
        self.weights("DOORS")
    }

    /// In what rules say something else of these rooms and doors than they did.
    pub fn weighed(&mut self, rooms: &[Room], doors: &[Door]) -> Weighed {
        Weighed {
            rooms: self.rooms().filter(|(room, weight)| !rooms[room.index()].weighs(weight)).collect(),
            doors: self.doors().filter(|(door, weight)| !doors[door.index()].weighs(weight)).collect(),
            building: None,
        }
    }

    /// Spaces and doorways with what rules say of them, where that may differ.
    ///
    /// # Arguments
    /// `lines` are what facts close, where doorways are known; `before` is what was said.
    pub fn building(
        &self,
        lines: impl Fn(Closable<'_>) -> Vec<Line>,
        world: &World,
        before: &Building,
    ) -> Option<Building> {
        let said = [
            ("SPACES", "name"),
            ("SPACES", "kind"),
            ("SPACES", "closed"),
            ("DOORWAYS", "name"),
            ("DOORWAYS", "closed"),
            ("DOORWAYS", "closed_from"),
        ];
        let may_differ = said.iter().any(|(class, property)| self.may_differ(class, property));
        let one_ways = spaces::one_ways(self.knowledge, world);
        let areas =
            |name: &str| world.areas.iter().find(|area| area.name == name).map(|area| area.shape.corners());
        let lines = |doorways: &[Doorway]| lines(Closable { doorways, areas: &areas });
        let now = if may_differ {
            let known = spaces::known(self.knowledge);
            Building { lines: lines(&known.doorways), one_ways, ..known }
        } else {
            let lines = lines(&before.doorways);
            if lines == before.lines && one_ways == before.one_ways {
                return None;
            }
            Building { lines, one_ways, ..before.clone() }
        };
        (now != *before).then_some(now)
    }

    fn weights<I: From<u32> + Send>(
        &mut self,
        class: &str,
    ) -> impl IndexedParallelIterator<Item = (I, Weight)> + use<I> {
        let measures = measures(self.knowledge, class);
        let others = measures.iter().map(String::as_str);
        let mut rows: Vec<u32> = ["hardness", "action", "passable"]
            .into_iter()
            .chain(others)
            .flat_map(|property| self.rows(class, property))
            .collect();
        if self.may_differ(MEASURES.0, MEASURES.1) {
            rows = (0..self.knowledge.len(class).unwrap_or(0) as u32).collect();
        }
        rows.sort_unstable();
        rows.dedup();
        let said = |property: &str| self.said((class, property), &rows);
        let (hardness, (action, passable)) =
            rayon::join(|| said("hardness"), || rayon::join(|| said("action"), || said("passable")));
        // made one by one: what rules say of all doors at once is more than the doors
        let hardness = self.derived(hardness, number);
        let action = self.derived(action, text);
        let passable = self.derived(passable, truth);
        let measures = texts(self.knowledge, class, &rows, &measures);
        let weights = hardness.zip(action).zip(passable).zip(measures);
        let weights = weights.map(|(((hardness, action), passable), measures)| Weight {
            hardness,
            action,
            passable,
            measures,
        });
        rows.into_par_iter().map(I::from).zip(weights)
    }

    /// One property of the objects that are looked at, by row.
    pub fn each<T: Send>(
        &mut self,
        (class, property): (&str, &str),
        value: fn(&Value) -> Option<T>,
    ) -> Vec<(usize, Derived<T>)> {
        let rows = self.rows(class, property);
        let said = self.said((class, property), &rows);
        let values = self.derived(said, value);
        rows.into_par_iter().map(|row| row as usize).zip(values).collect()
    }

    /// What is said of a property of the objects in these rows, and why.
    fn said(&self, (class, property): (&str, &str), rows: &[u32]) -> Said {
        let (reasons, facts) = match &self.reasons {
            Some(reasons) => reasons.of_rows(class, property, rows),
            None => (vec![(None, None); rows.len()], Facts::default()),
        };
        Said { values: self.knowledge.values_at(class, rows, property), reasons, facts }
    }

    /// The same as columns have it; the facts behind it are kept.
    fn derived<T: Send>(
        &mut self,
        Said { values, reasons, facts }: Said,
        value: fn(&Value) -> Option<T>,
    ) -> impl IndexedParallelIterator<Item = Derived<T>> + use<T> {
        if let Some(of) = &mut self.reasons {
            of.keep(facts);
        }
        let derived = move |(given, (rule, witness)): (Option<Value>, Reason)| Derived {
            value: given.as_ref().and_then(value),
            rule,
            witness,
        };
        values.into_par_iter().zip(reasons).map(derived)
    }

    /// The rows of a property whose value or reason may differ, ascending.
    fn rows(&self, class: &str, property: &str) -> Vec<u32> {
        match self.which {
            Which::All => (0..self.knowledge.len(class).unwrap_or(0) as u32).collect(),
            Which::Touched(changes) => {
                let mut rows = changes.rows(class, property).to_vec();
                rows.extend(changes.reasons(class, property));
                rows.sort_unstable();
                rows.dedup();
                rows
            }
        }
    }

    /// Whether any value of a property may differ.
    pub fn may_differ(&self, class: &str, property: &str) -> bool {
        let Which::Touched(changes) = self.which else { return true };
        let moved = |class: &adit_engine::ClassChanges| class.moved.is_some() || !class.added.is_empty();
        !changes.rows(class, property).is_empty()
            || !changes.reasons(class, property).is_empty()
            || changes.classes.get(class).is_some_and(moved)
    }
}

/// The names of the measures that rules say of a class, or that are told of it.
pub fn measures(knowledge: &Inference, class: &str) -> Vec<String> {
    let known = knowledge.texts(MEASURES.0, MEASURES.1).unwrap_or_default();
    let known = known.into_iter().flatten().map(|name| name.to_string());
    known.filter(|name| knowledge.kind_of(class, name).is_some()).collect()
}

/// What is said of measures, row by row, as the database has it.
fn texts(
    knowledge: &Inference,
    class: &str,
    rows: &[u32],
    names: &[String],
) -> impl IndexedParallelIterator<Item = Option<String>> + use<> {
    let columns: Vec<Vec<Option<Value>>> =
        names.iter().map(|name| knowledge.values_at(class, rows, name)).collect();
    let names = names.to_vec();
    (0..rows.len()).into_par_iter().map(move |row| {
        let amounts = columns.iter().map(|column| column[row].as_ref().and_then(number));
        let known = names.iter().zip(amounts).filter_map(|(name, amount)| Some((name.clone(), amount?)));
        Measures(known.collect()).text()
    })
}

fn number(value: &Value) -> Option<f64> {
    if let Value::Number(number) = value { Some(*number) } else { None }
}

fn text(value: &Value) -> Option<String> {
    if let Value::Text(text) = value { Some(text.to_string()) } else { None }
}

/// The truth value that a value is.
pub fn truth(value: &Value) -> Option<bool> {
    if let Value::Truth(truth) = value { Some(*truth) } else { None }
}
