//! A route that is followed: it is another one when the site changes, and goes on from where the robot is.

use std::sync::Arc;
use std::time::{Duration, Instant};

use adit_site::{Followed, Route, Trouble, query, say};
use serde_json::json;
use tokio::sync::mpsc::{UnboundedReceiver, unbounded_channel};

use crate::actions::{Ended, Feedback};
use crate::failure::{Failure, Kind};
use crate::msgs::{RouteGoal, TrackFeedback, TrackResult};
use crate::path::{self, along};
use crate::planner::{Planner, Question};
use crate::plans::question;

/// How often it is said how far the robot is.
const TICK: Duration = Duration::from_millis(200);

/// Metres from the goal at which it is reached.
const REACHED: f64 = 0.25;

/// Metres from the way at which another one is asked for, from where the robot is.
const OFF: f64 = 1.0;

/// Feedback of a route that is followed.
type Says = Feedback<RouteGoal, TrackResult, TrackFeedback>;

/// Ends with its handle.
struct Kept(tokio::task::JoinHandle<()>);

impl Drop for Kept {
    fn drop(&mut self) {
        self.0.abort();
    }
}

/// `ComputeAndTrackRoute`.
pub async fn track(planner: Arc<Planner>, goal: RouteGoal, says: Says) -> Ended<TrackResult> {
    let began = Instant::now();
    let tracked = async {
        let question = question(&planner, &goal)?;
        // an end at which no robot can be is refused in the words of a plan
        planner.plan(&question).await?;
        let (say, hears) = unbounded_channel();
        let follower = follow(
            Arc::clone(&planner),
            format!("/api/route/follow?{}&{}", question.query(), query(&[("name", &planner.settings.name)])),
            say,
        );
        let _follower = Kept(tokio::spawn(follower));
        Tracked { planner: &planner, question, says, route: None, at: 0, follower: None }.run(hears).await
    };
    let ended = tracked.await;
    let execution_duration = began.elapsed().into();
    planner.goes(None);
    match ended {
        Ok(()) => Ok(TrackResult { execution_duration, ..TrackResult::default() }),
        Err(failure) => {
            say(&format!("compute_and_track_route: {}", failure.words));
            let (error_code, error_msg) = (failure.kind.of_route(), failure.words);
            Err(TrackResult { execution_duration, error_code, error_msg })
        }
    }
}

type Heard = Result<Followed, Failure>;

/// Hears the site's stream. It ends when the service does, or its tokens change.
async fn follow(planner: Arc<Planner>, path: String, heard: tokio::sync::mpsc::UnboundedSender<Heard>) {
    let ended = planner.site.hear(&path, |event, data| {
        if event == "route" {
            let said = serde_json::from_str(data).map_err(|error| {
                Failure::new(Kind::Unknown, format!("the site's route cannot be read: {error}"))
            });
            let _ = heard.send(said);
        }
    });
    let trouble = ended.await.err().unwrap_or_else(|| Trouble::Away("its stream ended".to_owned()));
    let _ = heard.send(Err(Failure::refused(&trouble)));
}

struct Tracked<'a> {
    planner: &'a Planner,
    question: Question,
    says: Says,
    route: Option<Arc<Route>>,
    /// The waypoint that lies behind.
    at: usize,
    follower: Option<String>,
}

impl Tracked<'_> {
    async fn run(mut self, mut hears: UnboundedReceiver<Heard>) -> Result<(), Failure> {
        let mut ticks = tokio::time::interval(TICK);
        loop {
            tokio::select! {
                heard = hears.recv() => {
                    let said = heard.unwrap_or_else(|| Err(Failure::new(Kind::Unknown, "the site says no more")))?;
                    self.follower = Some(said.follower);
                    self.leads(said.route)?;
                }
                _ = ticks.tick() => {
                    if self.goes_on().await? {
                        return Ok(());
                    }
                }
            }
        }
    }

    /// The best way is this one now.
    fn leads(&mut self, route: Route) -> Result<(), Failure> {
        if !route.leads() {
            return Err(Failure::no_way(&route));
        }
        let rerouted = self.route.is_some();
        let route = Arc::new(route);
        self.planner.goes(Some(Arc::clone(&route)));
        self.route = Some(route);
        self.at = 0;
        self.tell(0, 0, rerouted, Vec::new());
        Ok(())
    }

    fn tell(&self, last: usize, next: usize, rerouted: bool, operations_triggered: Vec<String>) {
        let Some(route) = &self.route else { return };
        let number = |index: usize| u16::try_from(index).unwrap_or(u16::MAX);
        let frame = self.planner.frames.map();
        self.says.say(TrackFeedback {
            last_node_id: number(last),
            next_node_id: number(next),
            current_edge_id: number(last),
            route: path::route(route, frame),
            path: path::path(route, &self.question.goal, frame),
            operations_triggered,
            rerouted,
        });
    }

    /// Looks where the robot is; whether it is at the goal.
    async fn goes_on(&mut self) -> Result<bool, Failure> {
        let Some(route) = self.route.clone() else { return Ok(false) };
        // a robot that nobody hears of stands still; a start that was said needs no pose to begin with
        let Ok(pose) = self.planner.robot() else { return Ok(false) };
        let Some(along) = along(&route.waypoints, [pose.x, pose.y], self.at) else { return Ok(false) };
        if along.to_goal <= REACHED {
            return Ok(true);
        }
        if along.off > OFF {
            self.asks_from([pose.x, pose.y]).await?;
            return Ok(false);
        }
        if along.last != self.at {
            let action = |index: usize| route.waypoints.get(index).and_then(|point| point.action.clone());
            let triggered = action(along.next).filter(|now| action(self.at + 1).as_ref() != Some(now));
            self.at = along.last;
            self.tell(along.last, along.next, false, triggered.into_iter().collect());
        }
        Ok(false)
    }

    /// The robot is elsewhere: the way from there is followed from now on.
    async fn asks_from(&mut self, at: [f64; 2]) -> Result<(), Failure> {
        let Some(follower) = &self.follower else { return Ok(()) };
        let path = format!("/api/route/follow/{follower}");
        match self.planner.site.post(&path, &json!({"x": at[0], "y": at[1]})).await {
            Ok(answer) => match serde_json::from_value(answer) {
                Ok(route) => self.leads(route),
                Err(error) => {
                    let words = format!("the site's route cannot be read: {error}");
                    Err(Failure::new(Kind::Unknown, words))
                }
            },
            Err(trouble) => Err(Failure::refused(&trouble)),
        }
    }
}
