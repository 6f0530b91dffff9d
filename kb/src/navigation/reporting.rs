//! Missions that tell the site what they meet: a doorway that something stands in is reported, rules decide what follows, and
//! the robot goes on by what holds then.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::mem;

use adit_db::history::Author;
use adit_engine::Considered;
use adit_planners::local_model::{SegmentFacts, Transition};
use adit_planners::navigation::{Entry, Happening, Judge, StateDecision, StateFacts, WayFacts};

use super::floor::Floor;
use super::judge::{Considers, RuleJudge};
use crate::edit::Tell;
use crate::error::Result;
use crate::live::Live;

/// What is told of a doorway in which something stands.
const BLOCKED: &str = "blocked";

/// Doorways that the robot found blocked, and nobody was told of yet.
#[derive(Debug, Default)]
pub struct Reports(RefCell<Vec<usize>>);

impl Reports {
    /// Hears what happened.
    pub fn hear(&self, entry: &Entry) {
        if let Happening::WayClosed { doorway: Some(doorway), .. } = entry.event.what {
            self.0.borrow_mut().push(doorway);
        }
    }
}

/// The site's rules as judge of a mission, told of its reports as they come.
pub struct Reporting<'l> {
    live: &'l mut Live,
    reports: &'l Reports,
    judge: RuleJudge,
    /// The plan of the robot as the site has it now.
    floor: fn(&Live, &str) -> Result<Floor>,
    robot: String,
    /// What was met, for the history.
    why: String,
    /// The doorways that were told of: once is enough.
    told: BTreeSet<usize>,
    /// What rules did of it, in sentences.
    pub said: Vec<String>,
    trouble: Option<String>,
}

impl<'l> Reporting<'l> {
    pub fn new(
        live: &'l mut Live,
        reports: &'l Reports,
        floor: fn(&Live, &str) -> Result<Floor>,
        (robot, mission): (&str, usize),
    ) -> Result<Self> {
        let judge = RuleJudge::of_mission(&live.asked(), &floor(live, robot)?.told)?;
        Ok(Self {
            live,
            reports,
            judge,
            floor,
            robot: robot.to_owned(),
            why: format!("something stands there (mission {mission})"),
            told: BTreeSet::new(),
            said: Vec::new(),
            trouble: None,
        })
    }

    /// The first thing that failed.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref().or(self.judge.trouble())
    }

    /// Tells what was met since, and takes the rules as they are then.
    fn tell(&mut self) {
        let mut reports = mem::take(&mut *self.reports.0.borrow_mut());
        reports.retain(|doorway| self.told.insert(*doorway));
        if reports.is_empty() || self.trouble.is_some() {
            return;
        }
        if let Err(error) = self.told(&reports) {
            self.trouble = Some(error.to_string());
        }
    }

    fn told(&mut self, reports: &[usize]) -> Result<()> {
        let author = Author { who: self.robot.clone(), why: self.why.clone() };
        for doorway in reports {
            let fact = Tell {
                class: "DOORWAYS".to_owned(),
                object: doorway.to_string(),
                property: BLOCKED.to_owned(),
                value: "true".to_owned(),
                until: None,
                new_property: true,
            };
            self.said.extend(self.live.tell(fact, &author)?.reacted);
        }
        let floor = (self.floor)(self.live, &self.robot)?;
        self.judge = RuleJudge::of_mission(&self.live.asked(), &floor.told)?;
        Ok(())
    }
}

impl Considers for Reporting<'_> {
    fn considered(&mut self) -> Vec<Considered> {
        self.judge.considered()
    }
}

impl Judge for Reporting<'_> {
    fn next_state(&mut self, facts: &StateFacts) -> StateDecision {
        self.tell();
        self.judge.next_state(facts)
    }

    fn segment(&mut self, facts: &SegmentFacts) -> Transition {
        self.judge.segment(facts)
    }

    fn weigh(&mut self, facts: &WayFacts) -> Option<f64> {
        self.tell();
        self.judge.weigh(facts)
    }
}
