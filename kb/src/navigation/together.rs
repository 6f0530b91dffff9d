//! Several robots on one site at once: each drives from errand to errand, and hears what the others tell the site.

use std::collections::VecDeque;
use std::time::Instant;

use adit_planners::geometry::{Point, Segment};
use adit_planners::navigation::{Door, Ending, Entry, Mission, Underway, things_about};
use adit_planners::random::Random;

use super::ground::Ground;
use super::judge::{Noting, RuleJudge};
use super::missions::{Journal, Row, Truth, refuse};
use super::routed::{Missions, OnMission, Site};
use crate::error::{Code, Error, Result};

/// What a simulation of several robots is to be.
#[derive(Clone, Copy, Debug)]
pub struct Together {
    pub robots: usize,
    /// Nobody sets out any more after so many seconds.
    pub seconds: f64,
    /// So many doorways have doors that people open and shut.
    pub doors: usize,
    pub seed: u64,
    /// The number of the last mission before these.
    pub before: usize,
}

/// Goals and starts are at least so far from other robots and their goals, metres.
const APART_M: f64 = 1.5;

/// So many errands are drawn for one that is.
const TRIES: usize = 200;

/// A door stays as it is for so long, seconds.
const STAYS_S: [f64; 2] = [60.0, 300.0];

/// One of the robots.
struct Hand {
    who: String,
    /// What it has laid over the map.
    told: Vec<(String, Vec<Point>)>,
    /// Before then it sets out for nowhere, seconds.
    rests_until: f64,
    errand: Option<Errand>,
}

/// An errand of a robot.
struct Errand {
    mission: Mission,
    entries: Vec<Entry>,
    on: OnMission,
    since: Instant,
}

impl<'l> Missions<'l> {
    /// Has robots drive from errand to errand, together, by a clock of their own.
    ///
    /// # Arguments
    /// `done` is told of each errand that ends, and what the site was told on it; `minute` of each minute that passed.
    pub fn together(
        &mut self,
        what: &Together,
        done: impl FnMut(&mut Self, Journal, Vec<String>) -> Result<()>,
        minute: impl FnMut(),
    ) -> Result<()> {
        let dial = self.live.site().dial.clone();
        let driven = self.drive_together(what, done, minute);
        dial.stop();
        driven
    }

    fn drive_together(
        &mut self,
        what: &Together,
        mut done: impl FnMut(&mut Self, Journal, Vec<String>) -> Result<()>,
        mut minute: impl FnMut(),
    ) -> Result<()> {
        let ground: &'l Ground = self.ground;
        let mut drawn = Drawn { seed: what.seed, next: 0 };
        let mut numbers = what.before + 1..;
        let judges: Result<Vec<RuleJudge>> =
            (0..what.robots).map(|_| RuleJudge::of_rules(self.rules)).collect();
        let mut judges = judges?;
        let mut notings: Vec<Noting<'_, RuleJudge>> = judges.iter_mut().map(Noting::new).collect();
        let mut robots: Vec<Underway<'_>> = Vec::new();
        let mut hands: Vec<Hand> = Vec::new();
        for (index, noting) in notings.iter_mut().enumerate() {
            let mission = drawn.apart(self, &robots, None)?;
            let stance = self.stance_of(&mission)?;
            let mission = self.placed(&mission, stance);
            let (on, outfit) = ground.stage(stance);
            robots.push(
                mission.begin(&on, &outfit, true, noting).map_err(Error::of(Code::SimulateImpossible))?,
            );
            let who = format!("{} {}", ground.robot, index + 1);
            let errand = Some(self.errand(mission, (who.clone(), numbers.next()), Vec::new())?);
            hands.push(Hand { who, told: Vec::new(), rests_until: 0.0, errand });
        }
        let mut doors = doors(&ground.doorways, what);
        let mut trails = Trails(vec![VecDeque::new(); robots.len()]);
        let began = self.live.site().clock().now();
        let mut passed_s = 0.0;
        loop {
            let time_s = robots[0].body().time_s();
            self.live.site().dial.set(began, time_s);
            if time_s >= passed_s + 60.0 && time_s <= what.seconds {
                passed_s += 60.0;
                minute();
            }
            trails.note(&robots);
            for door in &mut doors {
                door.follow(time_s, &robots);
            }
            for index in 0..robots.len() {
                let things = things_about(index, &robots, &doors);
                robots[index].place(things);
                let hand = &mut hands[index];
                if hand.errand.is_none() && time_s >= hand.rests_until && time_s < what.seconds {
                    let mission = drawn.apart(self, &robots, Some(index))?;
                    robots[index].go_on(mission.goal, &mut notings[index]);
                    let told = std::mem::take(&mut hand.told);
                    hand.errand = Some(self.errand(mission, (hand.who.clone(), numbers.next()), told)?);
                }
                let Some(errand) = &mut hand.errand else {
                    robots[index].rest();
                    continue;
                };
                let others = trails.besides(index);
                let mut site = Site {
                    live: self.live,
                    ground: self.ground,
                    wide: &mut self.wide,
                    tells: self.tells,
                    others: &others,
                    on: &mut errand.on,
                };
                let (ending, entries) = robots[index].step(Some(&mut site), &mut notings[index]);
                errand.entries.extend(entries);
                if let Some(trouble) = errand.on.trouble.take() {
                    return Err(trouble);
                }
                let Some((ending, errand)) = ending.and_then(|ending| Some((ending, hand.errand.take()?)))
                else {
                    continue;
                };
                let decided = std::mem::take(&mut notings[index].decided);
                let row = self.row(&errand, (&robots[index], ending));
                let pause_s = ground.driving.navigation.pause_s;
                hand.rests_until = if ending == Ending::Arrived { time_s } else { time_s + pause_s };
                hand.told = errand.on.told;
                done(self, (row, errand.entries, decided), errand.on.said)?;
            }
            if time_s >= what.seconds && hands.iter().all(|hand| hand.errand.is_none()) {
                break;
            }
        }
        drop(notings);
        judges.iter().try_for_each(|judge| refuse(judge.trouble()))
    }

    fn errand(
        &self,
        mission: Mission,
        (who, number): (String, Option<usize>),
        told: Vec<(String, Vec<Point>)>,
    ) -> Result<Errand> {
        let on = OnMission::begun(self.live, who, number.unwrap_or_default(), told)?;
        Ok(Errand { mission, entries: Vec::new(), on, since: Instant::now() })
    }

    /// How an errand ended. That there is no way is not judged, since doors and robots come and go.
    fn row(&self, errand: &Errand, (robot, ending): (&Underway<'_>, Ending)) -> Row {
        let outcome = robot.outcome(ending);
        let radius = self.ground.shapes.all[outcome.trip.shape].rim.inner_m();
        let row = Row::new((errand.on.mission(), &errand.mission), &outcome, None, radius);
        let is_right = (ending == Ending::Arrived).then_some(outcome.miss_m <= radius);
        let truth = row.truth.map(|truth| Truth { right: is_right, obstacles: 0, ..truth });
        let start = outcome.trip.track.first().map_or(row.start, |(at, _)| [at.x, at.y]);
        let row = Row { truth, start, robot: Some(errand.on.who.clone()), ..row };
        self.weighed(row, &outcome.trip, errand.since)
    }
}

/// Where robots thought that they were lately, and how wide they were: what was seen of them is a little old.
struct Trails(Vec<VecDeque<(Point, f64)>>);

/// A robot is seen where it was so many readings ago at the most, and looked at now and then.
const TRAIL: usize = 100;
const STEP: usize = 5;

impl Trails {
    fn note(&mut self, robots: &[Underway<'_>]) {
        for (trail, robot) in self.0.iter_mut().zip(robots) {
            trail.push_back((robot.navigator().estimate().pose.at, robot.body().widest().outer_m()));
            if trail.len() > TRAIL {
                trail.pop_front();
            }
        }
    }

    fn besides(&self, which: usize) -> Vec<(Point, f64)> {
        let others = self.0.iter().enumerate().filter(|(index, _)| *index != which);
        others.flat_map(|(_, trail)| trail.iter().rev().step_by(STEP)).copied().collect()
    }
}

/// Errands by chance.
struct Drawn {
    seed: u64,
    next: usize,
}

impl Drawn {
    /// The next errand that is apart from where other robots are, and are going to.
    fn apart(&mut self, on: &Missions<'_>, robots: &[Underway<'_>], own: Option<usize>) -> Result<Mission> {
        let others = robots.iter().enumerate().filter(|(index, _)| Some(*index) != own);
        let taken: Vec<Point> =
            others.flat_map(|(_, robot)| [robot.body().pose().at, robot.goal()]).collect();
        let is_apart = |at: Point| taken.iter().all(|taken| taken.distance(at) >= APART_M);
        for _ in 0..TRIES {
            let mission = Mission { obstacles: Vec::new(), ..on.drawn_one(self.next, self.seed)? };
            self.next += 1;
            if is_apart(mission.goal) && (own.is_some() || is_apart(mission.start.at)) {
                return Ok(mission);
            }
        }
        let message = format!("the site has no room for so many robots: they are to be {APART_M} m apart");
        Err(Error::said(Code::SimulateNoRoom, message, None))
    }
}

/// Doors in some of the doorways, opened and shut by chance.
fn doors(doorways: &[Segment], what: &Together) -> Vec<Door> {
    let mut random = Random::new(what.seed);
    let mut left: Vec<&Segment> = doorways.iter().collect();
    let count = what.doors.min(left.len());
    let mut doors = Vec::new();
    for _ in 0..count {
        let doorway = left.swap_remove(random.below(left.len()));
        let mut times = Vec::new();
        let mut at = 0.0;
        let [least, most] = STAYS_S;
        while at < what.seconds {
            let from = at + random.between(least, most);
            at = from + random.between(least, most);
            times.push([from, at]);
        }
        doors.push(Door::new(doorway, times));
    }
    doors
}
