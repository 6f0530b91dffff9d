//! What a derivation starts from, besides the tables: the map and the rules.

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use adit_engine::{RuleBase, RuleTests};
use adit_planners::planner::Planner;
use adit_planners::read::MapReport;
use adit_planners::world::World;

use crate::error::{Finding, Problem, Result};
use crate::graph::Rules as RuleNames;
use crate::site::Site;
use crate::site::lint;
use crate::site::rules::Rules;
use crate::words::progress::Stage;

/// The map and the rules, read and compiled.
pub struct Inputs {
    /// The rules.
    pub rules: Arc<RuleBase>,
    /// Their names, by number.
    pub rule_names: RuleNames,
    /// The tests beside them.
    pub tests: RuleTests,
    /// The map, with what the site lays over it.
    pub world: Arc<World>,
    /// What reading the map cost or gave of free space.
    pub map_report: MapReport,
    /// What the expert should know of the map.
    of_map: Vec<String>,
    /// What the expert should know of both.
    pub notes: Vec<String>,
    /// How long it took.
    pub stage: Stage,
}

impl Inputs {
    /// Reads the map, for rules that were read before.
    ///
    /// # Arguments
    /// `rule_folder` stands instead of the site's own rules; `asked` are the properties that the planner of a map that is not cut
    /// into rooms asks for; `know` is shown the world before planners are asked anything.
    pub fn read(
        site: &Site,
        rules: Rules,
        rule_folder: Option<&Path>,
        (planners, asked): (&[Arc<dyn Planner>], &[String]),
        know: impl FnOnce(&World),
    ) -> Result<Self> {
        let began = Instant::now();
        let (world, map_report, of_map) = site.measured_world()?;
        know(&world);
        let placed = |note| Problem::of(&Finding::from(note)).to_string();
        let of_map = of_map.into_iter().map(placed).collect();
        let stage = Stage { name: "map".to_owned(), took: began.elapsed(), kept: false };
        let read = Self {
            rules: Arc::default(),
            rule_names: RuleNames::default(),
            tests: RuleTests::default(),
            world: Arc::new(world),
            map_report,
            of_map,
            notes: Vec::new(),
            stage,
        };
        Ok(read.with_rules(site, rules, rule_folder, (planners, asked)))
    }

    /// The same map with other rules.
    pub fn with_rules(
        &self,
        site: &Site,
        Rules { base, tests, .. }: Rules,
        rule_folder: Option<&Path>,
        (planners, asked): (&[Arc<dyn Planner>], &[String]),
    ) -> Self {
        let ignored = lint::ignored(site, rule_folder, &base, planners, asked).into_iter();
        let ignored = ignored
            .map(|problem| problem.to_string())
            .chain(lint::unheard(&base, &self.world))
            .chain(lint::unread_of_named(&base, &self.world))
            .chain(lint::unknown_kinds(&base, &self.world));
        let notes = ignored.chain(self.of_map.iter().cloned()).collect();
        let rule_names = (1..).zip(base.rules().iter().map(|rule| rule.name().to_owned())).collect();
        Self {
            rules: Arc::new(base),
            rule_names,
            tests,
            world: Arc::clone(&self.world),
            map_report: self.map_report.clone(),
            of_map: self.of_map.clone(),
            notes,
            stage: self.stage.clone(),
        }
    }
}
