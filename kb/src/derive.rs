//! The one path from facts to conclusions: planners and rules run in the order that what they need and give asks for.

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use adit_engine::{Conclusions, Diagnostic, KnowledgeBase as Inference, RuleBase, Severity};
use adit_planners::facts::{Facts, Table};
use adit_planners::planner::Planner;
use adit_planners::world::World;

use crate::classes;
use crate::error::{Error, Result};
use crate::progress::Progress;
use crate::told::{Attached, Told};

/// A stage of the work and how long it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// Its name.
    pub name: String,
    /// Its time.
    pub took: Duration,
    /// Whether its result was kept from before, because nothing that it needs has changed.
    pub kept: bool,
}

/// What a planner made earlier, if it still holds.
pub trait Memory {
    /// The facts that the planner gave, if its inputs had this fingerprint.
    fn recall(&mut self, planner: &dyn Planner, fingerprint: u64) -> Result<Option<Facts>>;
}

/// All that follows from the facts.
pub struct Derived {
    /// The classes, told, planned and concluded.
    pub knowledge: Inference,
    /// What planners gave, by class.
    pub facts: Facts,
    /// Which objects each fact that was told is about.
    pub attached: Attached,
    /// Which planner gave which facts, from inputs with which fingerprint.
    pub fingerprints: Vec<(String, u64)>,
    /// What the rules concluded, and where they could not.
    pub conclusions: Conclusions,
    /// What was done, in order.
    pub stages: Vec<Stage>,
}

/// Runs planners and rules until everything is concluded that can be.
pub fn derive(
    world: &World,
    told: &Told,
    planners: &[Box<dyn Planner>],
    rules: &RuleBase,
    memory: &mut dyn Memory,
    progress: &dyn Progress,
) -> Result<Derived> {
    let mut knowledge = Inference::new();
    let mut attached = Attached::default();
    for (class, table) in &told.classes {
        classes::assert(&mut knowledge, class, table)?;
        told.tell(&mut knowledge, class, &mut attached)?;
    }
    let mut run = Run {
        derived: Derived {
            conclusions: conclude(&mut knowledge, rules)?,
            knowledge,
            attached,
            facts: Facts::new(),
            fingerprints: Vec::new(),
            stages: Vec::new(),
        },
        world,
        told,
        rules,
    };
    let mut waiting: Vec<&dyn Planner> = planners.iter().map(AsRef::as_ref).collect();
    while let Some(ready) = waiting.iter().position(|planner| run.missing(*planner).is_empty()) {
        let planner = waiting.remove(ready);
        progress.stage(planner.name());
        run.plan(planner, memory)?;
        progress.stage("rules");
        run.conclude()?;
    }
    match waiting.first() {
        Some(planner) => Err(stuck(*planner, &run.missing(*planner))),
        None => Ok(run.derived),
    }
}

struct Run<'a> {
    derived: Derived,
    world: &'a World,
    told: &'a Told,
    rules: &'a RuleBase,
}

impl Run<'_> {
    /// What a planner needs and nobody has given yet.
    fn missing(&self, planner: &dyn Planner) -> BTreeSet<String> {
        let known = |need: &String| {
            let (class, property) = classes::split(need);
            classes::column(&self.derived.knowledge, class, property).is_some()
        };
        planner.signature().needs.into_iter().filter(|need| !known(need)).collect()
    }

    fn plan(&mut self, planner: &dyn Planner, memory: &mut dyn Memory) -> Result<()> {
        let began = Instant::now();
        let known = classes::known(&self.derived.knowledge, &planner.signature().needs);
        let fingerprint = fingerprint(self.world, &known);
        let recalled = memory.recall(planner, fingerprint)?;
        let kept = recalled.is_some();
        let facts = match recalled {
            Some(facts) => facts,
            None => planner
                .facts(self.world, &known)
                .map_err(|error| Error::said("planner/failed", error.to_string(), None))?,
        };
        for (class, table) in facts {
            classes::assert(&mut self.derived.knowledge, &class, &table)?;
            self.told.tell(&mut self.derived.knowledge, &class, &mut self.derived.attached)?;
            self.derived.facts.insert(class, table);
        }
        self.derived.fingerprints.push((planner.name().to_owned(), fingerprint));
        self.derived.stages.push(Stage { name: planner.name().to_owned(), took: began.elapsed(), kept });
        Ok(())
    }

    fn conclude(&mut self) -> Result<()> {
        let began = Instant::now();
        self.derived.conclusions = conclude(&mut self.derived.knowledge, self.rules)?;
        let took = began.elapsed();
        match self.derived.stages.iter_mut().find(|stage| stage.name == "rules") {
            Some(stage) => stage.took += took,
            None => self.derived.stages.push(Stage { name: "rules".to_owned(), took, kept: false }),
        }
        Ok(())
    }
}

fn conclude(knowledge: &mut Inference, rules: &RuleBase) -> Result<Conclusions> {
    let conclusions = knowledge.conclude(rules);
    let failed = |problem: &&Diagnostic| problem.severity == Severity::Error;
    if conclusions.diagnostics.iter().any(|problem| failed(&problem)) {
        return Err(Error::all(conclusions.diagnostics.iter().filter(failed).cloned()));
    }
    Ok(conclusions)
}

/// The complaint that a planner lacks what nobody gives.
fn stuck(planner: &dyn Planner, missing: &BTreeSet<String>) -> Error {
    let missing: Vec<&str> = missing.iter().map(String::as_str).collect();
    Error::said(
        "rules/missing",
        format!("{} cannot be made: no rule, table or planner gives {}", planner.name(), missing.join(", ")),
        Some("the shipped rule bases have such rules: copy the missing one from there".to_owned()),
    )
}

/// Two runs of a planner of one version on equal inputs have equal fingerprints.
fn fingerprint(world: &World, known: &Facts) -> u64 {
    use std::hash::{DefaultHasher, Hash, Hasher};
    let mut hasher = DefaultHasher::new();
    (env!("CARGO_PKG_VERSION"), world.fingerprint()).hash(&mut hasher);
    for (class, table) in known {
        class.hash(&mut hasher);
        hash_table(table, &mut hasher);
    }
    hasher.finish()
}

/// A number that stands for the content of tables: equal content, equal number. Negative zero counts as zero, as it
/// does in a database.
pub fn content(tables: &[Table]) -> u64 {
    use std::hash::{DefaultHasher, Hasher};
    let mut hasher = DefaultHasher::new();
    for table in tables {
        hash_table(table, &mut hasher);
    }
    hasher.finish()
}

fn hash_table(table: &Table, hasher: &mut impl std::hash::Hasher) {
    use adit_planners::facts::Column;
    use std::hash::Hash;
    for (property, column) in &table.columns {
        property.hash(hasher);
        match column {
            Column::Number(values) => values.iter().for_each(|v| v.map(|v| (v + 0.0).to_bits()).hash(hasher)),
            Column::Text(values) => values.hash(hasher),
            Column::Truth(values) => values.hash(hasher),
        }
    }
}
