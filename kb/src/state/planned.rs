//! What planners gave, and from what.

use std::collections::BTreeMap;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

use adit_db::door::Door;
use adit_db::room::Room;
use adit_db::schema::{Part, Row, Value as Lent};
use adit_engine::{KnowledgeBase as Inference, Value};
use adit_planners::facts::{Column, Facts};
use adit_planners::planner::Planner;
use adit_planners::world::World;
use siphasher::sip::SipHasher13;

use crate::error::{Code, Error, Result};
use crate::graph::SiteGraph;
use crate::knowledge::classes;
use crate::knowledge::tables::hash_table;

/// Facts of planners, by class, and the fingerprint of what each planner worked from.
#[derive(Clone, Default)]
pub struct Planned {
    /// Of classes other than rooms and doors, which the graph has.
    pub facts: Facts,
    /// By the planner's name.
    pub fingerprints: BTreeMap<String, u64>,
}

impl Planned {
    /// Whether planners gave a property.
    pub fn gives(&self, class: &str, property: &str) -> bool {
        fn is_cut<R: Row>(property: &str) -> bool {
            R::columns_of(Part::Cut).any(|column| column.name == property)
        }
        match class {
            "ROOMS" => is_cut::<Room>(property),
            "DOORS" => is_cut::<Door>(property),
            _ => self.facts.get(class).is_some_and(|table| table.column(property).is_some()),
        }
    }

    /// What a planner said of a property of the object in a row.
    pub fn value(&self, graph: &SiteGraph, (class, row, property): (&str, usize, &str)) -> Option<Value> {
        match class {
            "ROOMS" => value_in(graph.rooms.get(row)?, property),
            "DOORS" => value_in(graph.doors.get(row)?, property),
            _ => value_of(self.facts.get(class)?.column(property)?, row),
        }
    }
}

/// A value of a row as it is told.
fn value_in<R: Row>(row: &R, property: &str) -> Option<Value> {
    let column = R::columns_of(Part::Cut).find(|column| column.name == property)?;
    match (column.get)(row) {
        Lent::Null => None,
        Lent::Integer(integer) => Some(Value::Number(integer as f64)),
        Lent::Real(real) => Some(Value::Number(real)),
        Lent::Text(text) => Some(Value::from(text)),
        Lent::Truth(truth) => Some(Value::Truth(truth)),
    }
}

/// A value of a column as it is told.
fn value_of(column: &Column, row: usize) -> Option<Value> {
    match column {
        Column::Number(values) => values[row].map(Value::Number),
        Column::Text(values) => values[row].as_deref().map(Value::from),
        Column::Truth(values) => values[row].map(Value::Truth),
    }
}

/// What planners made earlier, if it still holds.
pub trait Recall {
    /// The facts that a planner of rooms and doors gave besides these, which are those of the state, if what it worked
    /// from had this fingerprint.
    fn recall(&mut self, planner: &dyn Planner, fingerprint: u64) -> Result<Option<Facts>>;
}

/// Nothing was made earlier.
pub struct Nothing;

impl Recall for Nothing {
    fn recall(&mut self, _: &dyn Planner, _: u64) -> Result<Option<Facts>> {
        Ok(None)
    }
}

/// What a planner may know, and its fingerprint: two runs of a planner of one version on equal inputs have equal ones.
pub fn fingerprint(world: &World, known: &Facts) -> u64 {
    let mut hasher = SipHasher13::new();
    (env!("CARGO_PKG_VERSION"), world.fingerprint()).hash(&mut hasher);
    for (class, table) in known {
        class.hash(&mut hasher);
        hash_table(table, &mut hasher);
    }
    hasher.finish()
}

/// Has planners that keep what they made make it, of a site that was opened as it was built.
pub struct Ahead {
    world: Arc<World>,
    of: Vec<(Arc<dyn Planner>, Facts)>,
}

impl Ahead {
    pub fn of(planners: &[Arc<dyn Planner>], world: &Arc<World>, knowledge: &Inference) -> Self {
        let keeping = planners.iter().filter(|planner| planner.keeps());
        let known = |planner: &Arc<dyn Planner>| {
            (Arc::clone(planner), classes::known(knowledge, &planner.signature().needs))
        };
        Self { world: Arc::clone(world), of: keeping.map(known).collect() }
    }

    pub fn planners(&self) -> Vec<Arc<dyn Planner>> {
        self.of.iter().map(|(planner, _)| Arc::clone(planner)).collect()
    }

    pub fn make(&self) {
        for (planner, known) in &self.of {
            // what is wrong is said to whoever asks
            planner.facts(&self.world, known).ok();
        }
    }
}

/// What a planner gives for what it knows.
pub fn facts(planner: &dyn Planner, world: &World, known: &Facts) -> Result<Facts> {
    let given = planner.facts(world, known);
    given.map_err(Error::of(Code::PlannerFailed))
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use adit_planners::geometry::Rect;
    use adit_planners::planner::{PlannerError, Signature};

    use super::*;

    struct Counting {
        keeps: bool,
        asked: AtomicUsize,
    }

    impl Planner for Counting {
        fn name(&self) -> &'static str {
            "counting"
        }

        fn signature(&self) -> Signature {
            Signature::default()
        }

        fn keeps(&self) -> bool {
            self.keeps
        }

        fn facts(&self, _: &World, _: &Facts) -> std::result::Result<Facts, PlannerError> {
            self.asked.fetch_add(1, Ordering::Relaxed);
            Ok(Facts::new())
        }
    }

    #[test]
    fn planners_that_keep_what_they_made_are_asked_ahead_and_no_others() {
        let counting = [true, false].map(|keeps| Arc::new(Counting { keeps, asked: AtomicUsize::new(0) }));
        let planners: Vec<Arc<dyn Planner>> =
            counting.iter().map(|planner| Arc::clone(planner) as Arc<dyn Planner>).collect();
        let world = Arc::new(World::empty(Rect::new(0.0, 0.0, 1.0, 1.0)));
        Ahead::of(&planners, &world, &Inference::new()).make();
        assert_eq!(counting.map(|planner| planner.asked.load(Ordering::Relaxed)), [1, 0]);
    }
}
