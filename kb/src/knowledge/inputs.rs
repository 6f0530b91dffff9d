//! What a derivation starts from, besides the tables: the map and the rules.

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use adit_engine::{RuleBase, RuleTests};
use adit_planners::planner::Planner;
use adit_planners::read::MapReport;
use adit_planners::world::World;

use crate::error::Result;
use crate::graph::Rules;
use crate::site::Site;
use crate::site::lint;
use crate::site::rules;
use crate::words::progress::Stage;

/// The map and the rules, read and compiled.
pub struct Inputs {
    /// The rules.
    pub rules: Arc<RuleBase>,
    /// Their names, by number.
    pub rule_names: Rules,
    /// The tests beside them.
    pub tests: RuleTests,
    /// The map, with what the site lays over it.
    pub world: Arc<World>,
    /// What reading the map cost or gave of free space.
    pub map_report: MapReport,
    /// What the expert should know of both.
    pub notes: Vec<String>,
    /// How long it took.
    pub stage: Stage,
}

impl Inputs {
    /// Reads them.
    ///
    /// # Arguments
    /// `rule_folder` stands instead of the site's own rules; `asked` are the properties that the planner of a map that is not cut
    /// into rooms asks for; `know` is shown the world before planners are asked anything.
    pub fn read(
        site: &Site,
        rule_folder: Option<&Path>,
        planners: &[Arc<dyn Planner>],
        asked: &[String],
        know: impl FnOnce(&World),
    ) -> Result<Self> {
        let began = Instant::now();
        let rules::Rules { base: rules, tests, .. } = rules::load(site, rule_folder)?;
        let (world, map_report, notes) = site.measured_world()?;
        know(&world);
        let stage = Stage { name: "map".to_owned(), took: began.elapsed(), kept: false };
        let ignored = lint::ignored(site, rule_folder, &rules, planners, asked).into_iter();
        let ignored = ignored.map(|problem| problem.to_string()).chain(lint::unheard(&rules, &world));
        let notes = ignored.chain(notes.into_iter().map(|note| note.to_string())).collect();
        let names = (1..).zip(rules.rules().iter().map(|rule| rule.name().to_owned()));
        let rule_names = names.collect();
        let rules = Arc::new(rules);
        Ok(Self { rules, rule_names, tests, world: Arc::new(world), map_report, notes, stage })
    }
}
