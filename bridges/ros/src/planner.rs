//! Questions for plans: what is asked of the site, and what is wrong with a question before it is.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use adit_site::{Route, Site, query};
use tokio::sync::{Semaphore, watch};

use crate::failure::{Failure, Kind};
use crate::frames::{Frames, OnFloor};
use crate::msgs::PoseStamped;

/// So many routes are asked of the site at once; the others wait.
const AT_ONCE: usize = 16;

/// How long a pose of the robot counts that no other followed.
const FRESH: Duration = Duration::from_secs(5);

/// The farthest that the site moves an end, metres.
const FARTHEST: f64 = 100.0;

/// The settings of plans.
pub struct Settings {
    /// What people call the robot.
    pub name: String,
    /// Whose routes; of a site with several robots it must be said.
    pub robot: Option<String>,
    /// The planner of Nav2 that is ours; another one's name is a robot's.
    pub planner: String,
    /// The robot's own frame.
    pub base: String,
    /// Metres by which an end may be moved to where the robot fits.
    pub tolerance: f64,
    /// How long a plan may take.
    pub timeout: Duration,
}

/// What a plan is asked for.
pub struct Question {
    pub start: OnFloor,
    pub goal: OnFloor,
    pub robot: Option<String>,
    pub tolerance: f64,
}

/// Asks for plans.
pub struct Planner {
    pub site: Site,
    pub frames: Arc<Frames>,
    pub settings: Settings,
    turns: Semaphore,
    /// Where the robot said it is.
    pose: Mutex<Option<(OnFloor, Instant)>>,
    /// The way that it is on.
    way: watch::Sender<Option<Arc<Route>>>,
}

impl Planner {
    pub fn new(site: Site, frames: Arc<Frames>, settings: Settings) -> Self {
        let turns = Semaphore::new(AT_ONCE);
        Self { site, frames, settings, turns, pose: Mutex::default(), way: watch::Sender::new(None) }
    }

    /// The question between two poses; without a start, from where the robot is.
    pub fn question(&self, start: Option<&PoseStamped>, goal: &PoseStamped) -> Result<Question, Failure> {
        let start = match start {
            Some(start) => self.frames.on_floor("start", start)?,
            None => self.robot()?,
        };
        let goal = self.frames.on_floor("goal", goal)?;
        let (robot, tolerance) = (self.settings.robot.clone(), self.settings.tolerance);
        Ok(Question { start, goal, robot, tolerance })
    }

    /// Whose routes a planner of this name plans.
    pub fn planner(&self, name: &str) -> Option<String> {
        if name.is_empty() || name == self.settings.planner {
            self.settings.robot.clone()
        } else {
            Some(name.to_owned())
        }
    }

    /// The robot said that it is there.
    pub fn is_at(&self, pose: OnFloor) {
        *self.pose.lock().unwrap_or_else(PoisonError::into_inner) = Some((pose, Instant::now()));
    }

    /// Where the robot is: as it said, or else as TF does.
    pub fn robot(&self) -> Result<OnFloor, Failure> {
        let said = *self.pose.lock().unwrap_or_else(PoisonError::into_inner);
        match said.filter(|(_, when)| when.elapsed() < FRESH) {
            Some((pose, _)) => Ok(pose),
            None => self.frames.origin(&self.settings.base).map_err(|failure| {
                Failure::new(Kind::Tf, format!("where the robot is was not said lately; {}", failure.words))
            }),
        }
    }

    /// The best way.
    pub async fn plan(&self, question: &Question) -> Result<Route, Failure> {
        let asked = async {
            let _turn = self.turns.acquire().await;
            self.site.get(&format!("/api/route?{}", question.query())).await
        };
        let answer = tokio::time::timeout(self.settings.timeout, asked).await.map_err(|_| {
            let seconds = self.settings.timeout.as_secs_f64();
            Failure::new(Kind::Timeout, format!("the site's service has no answer within {seconds} s"))
        })?;
        let answer = answer.map_err(|trouble| Failure::refused(&trouble))?;
        let route: Route = serde_json::from_value(answer).map_err(|error| {
            Failure::new(Kind::Unknown, format!("the site's route cannot be read: {error}"))
        })?;
        if route.leads() { Ok(route) } else { Err(Failure::no_way(&route)) }
    }

    /// The robot is on this way from now on, or on none.
    pub fn goes(&self, route: Option<Arc<Route>>) {
        self.way.send_replace(route);
    }

    /// The way that it is on.
    pub fn way(&self) -> Option<Arc<Route>> {
        self.way.borrow().clone()
    }
}

impl Question {
    /// As the site is asked it.
    pub fn query(&self) -> String {
        let point = |at: &OnFloor| format!("{},{}", at.x, at.y);
        let (start, goal) = (point(&self.start), point(&self.goal));
        let tolerance = self.tolerance.min(FARTHEST).to_string();
        let mut asked = vec![("start", start.as_str()), ("goal", &goal), ("within", &tolerance)];
        asked.extend(self.robot.as_deref().map(|robot| ("robot", robot)));
        query(&asked)
    }
}
