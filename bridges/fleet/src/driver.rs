//! One vehicle: what is known of it, and what follows. Nothing here waits or sends: what is to be done is said as effects.

mod effect;
mod held;
mod words;

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

pub use effect::{Clock, Effect};

use crate::given::Given;
use crate::site::{Fleet, Route, Vehicle};
use crate::way::{Bridge, Margins, SAME, distance, stops};
use crate::wire::{Action, Addressee, Blocking, Factsheet, Instant, Link, Report, Version};

/// Seconds after which what was not acknowledged is said again.
const AGAIN: f64 = 3.0;

/// Seconds after which an order that was refused is tried once more.
const ANEW: f64 = 10.0;

/// Metres that a vehicle may have been moved before its way is asked for anew.
const MOVED: f64 = 0.3;

/// How orders of ours begin.
const OURS: &str = "adit ";

/// A vehicle, the order that it has, and the way that it is to go.
pub struct Driver {
    pub row: Vehicle,
    link: Option<Link>,
    version: Option<Version>,
    report: Option<Report>,
    factsheet: Option<Factsheet>,
    given: Option<Sent>,
    follows: Option<Follows>,
    /// The newest route that is not in the order.
    route: Option<Route>,
    cancels: Option<Cancel>,
    /// Until when no order is tried.
    waits: f64,
    /// The goal that was reached, until the table is without it.
    reached: Option<String>,
    /// The goal at which it is.
    at: Option<String>,
    /// Whether what is released is no way any more.
    is_broken: bool,
    checks: bool,
    /// Errors on which something was done.
    acted: BTreeSet<String>,
    written: BTreeMap<String, Value>,
    /// What was wrong with its last states.
    said: Option<String>,
    heads: [u32; 2],
    epoch: u64,
    orders: u32,
}

/// An order on its way, or acknowledged.
struct Sent {
    order: Given,
    /// The stop that the vehicle has reached.
    reached: usize,
    at: f64,
    is_known: bool,
}

/// What is asked of the site.
struct Follows {
    goal: String,
    start: [f64; 2],
}

/// A cancelling on its way.
struct Cancel {
    action: String,
    at: f64,
    why: String,
    reports: u32,
}

impl Driver {
    pub fn new(row: Vehicle) -> Self {
        Self {
            written: row.written.clone(),
            row,
            link: None,
            version: None,
            report: None,
            factsheet: None,
            given: None,
            follows: None,
            route: None,
            cancels: None,
            waits: 0.0,
            reached: None,
            at: None,
            is_broken: false,
            checks: false,
            acted: BTreeSet::new(),
            said: None,
            heads: [0; 2],
            epoch: 0,
            orders: 0,
        }
    }

    /// Its row of the table is another one.
    pub fn read(&mut self, row: Vehicle) {
        if self.reached.is_some() && self.reached != row.goal {
            self.reached = None;
        }
        self.written.clone_from(&row.written);
        if row.robot != self.row.robot {
            self.follows = None;
        }
        self.row = row;
    }

    /// The table is without the goal that was reached.
    pub fn is_written(&mut self) {
        self.reached = None;
        self.row.goal = None;
    }

    pub fn linked(&mut self, link: Link, version: &str) {
        self.link = Some(link);
        self.spoken(version);
    }

    pub fn reported(&mut self, report: Report) {
        self.spoken(&report.version);
        if let Some(cancel) = &mut self.cancels {
            cancel.reports += 1;
        }
        // who speaks is there again, also where it does not say so
        self.link = self.link.map(|link| if link == Link::ConnectionBroken { Link::Online } else { link });
        self.report = Some(report);
    }

    pub fn described(&mut self, factsheet: Factsheet) {
        self.factsheet = Some(factsheet);
    }

    fn spoken(&mut self, version: &str) {
        self.version = self.row.version.as_deref().and_then(Version::read).or_else(|| Version::read(version));
    }

    /// Another route is the best from where it was asked for.
    pub fn routed(&mut self, epoch: u64, route: Route) {
        if epoch == self.epoch && self.follows.is_some() {
            self.route = Some(route);
        }
    }

    /// Something about the floor is another one: what is released is looked at again.
    pub fn doubted(&mut self) {
        self.checks = true;
    }

    /// What was released of this order is still a way, or is none any more.
    pub fn checked(&mut self, order: &str, update: u32, holds: bool) {
        let is_it =
            self.given.as_ref().is_some_and(|sent| sent.order.id == order && sent.order.update == update);
        if is_it && !holds {
            self.is_broken = true;
        }
    }

    /// The broker was away: what was not acknowledged is said again at once.
    pub fn connected(&mut self) {
        for at in
            self.given.iter_mut().map(|sent| &mut sent.at).chain(self.cancels.iter_mut().map(|c| &mut c.at))
        {
            *at = f64::NEG_INFINITY;
        }
    }

    /// What now follows.
    pub fn think(&mut self, world: &World<'_>) -> Vec<Effect> {
        let mut effects = Vec::new();
        let words = self.decide(world, &mut effects);
        self.tell(words, &mut effects);
        effects
    }

    /// What the vehicle does, in words; effects beside.
    fn decide(&mut self, world: &World<'_>, effects: &mut Vec<Effect>) -> String {
        if self.link.is_some_and(|link| link != Link::Online) {
            return self.link.map(Link::word).unwrap_or_default().to_owned();
        }
        let (Some(report), Some(version)) = (self.report.clone(), self.version) else {
            return "not heard of".to_owned();
        };
        let to = Addressee {
            version,
            manufacturer: self.row.manufacturer.clone(),
            serial: self.row.serial.clone(),
        };
        let held = held::why(&report, self.factsheet.as_ref(), &self.robot(world), world.fleet);
        self.act_on_errors(&report, world, effects);
        if self.is_cancelling(&report, &to, world, effects) {
            let why = self.cancels.as_ref().map(|cancel| cancel.why.clone());
            return format!("stops: {}", why.unwrap_or_default());
        }
        let goal = self.row.goal.clone().filter(|goal| self.reached.as_ref() != Some(goal));
        let Some(goal) = goal else {
            self.unfollow(effects);
            let is_done = self.given.as_ref().is_none_or(|sent| sent.is_known && !report.is_busy());
            if is_done {
                self.given = None;
                return self.at.as_ref().map(|goal| format!("at {goal}")).unwrap_or_default();
            }
            return self.cancel("it has no goal any more", &to, world, effects);
        };
        self.at = None;
        match self.given.take() {
            Some(sent) => self.drive(sent, &goal, &report, held, &to, world, effects),
            None => self.begin(&goal, &report, held, &to, world, effects),
        }
    }

    /// With an order.
    #[allow(clippy::too_many_arguments)] // what is known at this moment
    fn drive(
        &mut self,
        mut sent: Sent,
        goal: &str,
        report: &Report,
        held: Option<String>,
        to: &Addressee,
        world: &World<'_>,
        effects: &mut Vec<Effect>,
    ) -> String {
        let order = &sent.order;
        let is_of_order = report.order_id == order.id;
        // switched off and on, or sent elsewhere by somebody else
        if !is_of_order && (sent.is_known || order.update > 0) {
            self.unfollow(effects);
            effects.push(Effect::Say(format!("{} has its order no more", self.row.name)));
            return self.begin(goal, report, held, to, world, effects);
        }
        sent.is_known |= is_of_order && report.order_update_id == order.update;
        if !sent.is_known {
            if let Some(refusal) = words::refusal(report, &order.id, order.update) {
                let is_new = order.update == 0;
                self.waits = world.clock.seconds + ANEW;
                effects.push(Effect::Say(format!("{} refuses its order: {refusal}", self.row.name)));
                if is_new {
                    self.unfollow(effects);
                    return format!("refused: {refusal}");
                }
                self.given = Some(sent);
                return self.cancel(&format!("refused: {refusal}"), to, world, effects);
            }
            if world.clock.seconds - sent.at >= AGAIN {
                sent.at = world.clock.seconds;
                self.send_order(&sent.order, to, world, effects);
            }
            let words = format!("is sent to {goal}");
            self.given = Some(sent);
            return words;
        }
        let said = (report.last_node_sequence_id, report.last_node_id.as_str());
        match sent.order.reached(said.0, said.1) {
            Some(reached) => sent.reached = reached,
            // at the start of an order it may still name the node of before
            None if said.0 == 0 => {}
            None => {
                let words =
                    format!("is at node `{}`, sequence {}, which was not released to it", said.1, said.0);
                self.says_once(words, effects);
            }
        }
        let reached = sent.reached;
        let last = sent.order.stops.len() - 1;
        if sent.order.goal == goal
            && is_of_order
            && reached == last
            && sent.order.is_whole()
            && !report.is_busy()
            && report.has_acted()
        {
            self.unfollow(effects);
            self.reached = Some(goal.to_owned());
            self.at = Some(goal.to_owned());
            effects.push(Effect::Arrived { goal: goal.to_owned() });
            return format!("at {goal}");
        }
        if std::mem::take(&mut self.is_broken) {
            self.given = Some(sent);
            return self.cancel("the way ahead is closed", to, world, effects);
        }
        self.follow(goal, sent.order.base_end().at, effects);
        let route = self.route.take_if(|route| starts_at(route, sent.order.base_end().at));
        if let Some(route) = route.as_ref().filter(|route| !route.leads()) {
            let reason = route.reason.clone().unwrap_or_else(|| format!("no way to {goal}"));
            if report.is_busy() {
                self.given = Some(sent);
                return self.cancel(&reason, to, world, effects);
            }
            self.route = Some(route.clone());
            return format!("no way to {goal}: {reason}");
        }
        let at = report.position.map_or(sent.order.base_end().at, |at| [at.x, at.y]);
        let left = sent.order.left(reached, at);
        if std::mem::take(&mut self.checks) && left > MOVED {
            effects.push(Effect::Check {
                order: sent.order.id.clone(),
                update: sent.order.update,
                from: at,
                to: sent.order.base_end().at,
                metres: left,
                doorways: sent.order.doorways_ahead(reached),
                robot: self.row.robot.clone(),
            });
        }
        let way = route.map(|route| self.stops(&route, world));
        let asks = left <= world.margins.ahead + SAME || report.new_base_request;
        let is_heard = self.follows.as_ref().is_some_and(|follows| follows.goal == sent.order.goal);
        let more = asks && held.is_none() && (way.is_some() || is_heard);
        if way.is_some() || more {
            let released = sent.order.released;
            if sent.order.updated(way, goal, more) {
                sent.at = world.clock.seconds;
                sent.is_known = false;
                self.send_order(&sent.order, to, world, effects);
                if sent.order.released != released {
                    let end = sent.order.base_end().at;
                    self.follows = self.follows.take().map(|follows| Follows { start: end, ..follows });
                    effects.push(Effect::Moved { at: end });
                }
            }
        }
        self.given = Some(sent);
        held.map_or_else(|| format!("drives to {goal}"), |held| format!("waits: {held}"))
    }

    /// Without an order.
    fn begin(
        &mut self,
        goal: &str,
        report: &Report,
        held: Option<String>,
        to: &Addressee,
        world: &World<'_>,
        effects: &mut Vec<Effect>,
    ) -> String {
        if report.is_busy() {
            // of a bridge that was ended meanwhile
            if report.order_id.starts_with(OURS) {
                return self.cancel("its order is of before", to, world, effects);
            }
            return format!("drives order `{}`, which is not of this site", report.order_id);
        }
        if let Some(held) = held {
            return format!("waits: {held}");
        }
        let Some(position) = report.position else { return "waits: it does not say where it is".to_owned() };
        if world.clock.seconds < self.waits {
            return "waits: its last order was refused".to_owned();
        }
        let at = [position.x, position.y];
        if self.follows.as_ref().is_some_and(|follows| distance(follows.start, at) > MOVED) {
            self.follows = None;
        }
        if self.follows.as_ref().is_none_or(|follows| follows.goal != goal) {
            self.follow(goal, at, effects);
        }
        let Some(route) = self.route.take() else { return format!("asks for the way to {goal}") };
        if !route.leads() {
            let reason = route.reason.clone().unwrap_or_default();
            self.route = Some(route);
            return format!("no way to {goal}: {reason}");
        }
        let stops = self.stops(&route, world);
        if stops.is_empty() {
            return format!("no way to {goal}: its route has no points");
        }
        self.orders += 1;
        let id = format!("{OURS}{} {} {}", self.row.name, world.clock.words, self.orders);
        let map = self.row.map.clone().unwrap_or_else(|| world.map.to_owned());
        let robot = self.robot(world);
        let order = Given::new(id, goal.to_owned(), (map, robot), stops);
        self.is_broken = false;
        let end = order.base_end().at;
        self.follows = self.follows.take().map(|follows| Follows { start: end, ..follows });
        effects.push(Effect::Moved { at: end });
        self.send_order(&order, to, world, effects);
        self.given = Some(Sent { order, reached: 0, at: world.clock.seconds, is_known: false });
        format!("is sent to {goal}")
    }

    fn says_once(&mut self, words: String, effects: &mut Vec<Effect>) {
        if self.said.as_ref() != Some(&words) {
            effects.push(Effect::Say(format!("{} {words}", self.row.name)));
            self.said = Some(words);
        }
    }

    /// Whose routes it drives.
    fn robot(&self, world: &World<'_>) -> String {
        self.row.robot.clone().unwrap_or_else(|| world.fleet.only_robot())
    }

    fn stops(&self, route: &Route, world: &World<'_>) -> Vec<crate::way::Stop> {
        let robot = self.robot(world);
        let half = |state: &str| {
            world
                .fleet
                .state(&robot, state)
                .map_or(0.0, |state| state.width.max(state.length.unwrap_or(0.0)) / 2.0)
        };
        stops(route, half, world.margins, world.bridges)
    }

    fn follow(&mut self, goal: &str, start: [f64; 2], effects: &mut Vec<Effect>) {
        if self.follows.as_ref().is_some_and(|follows| follows.goal == goal) {
            return;
        }
        self.epoch += 1;
        self.route = None;
        self.follows = Some(Follows { goal: goal.to_owned(), start });
        let (goal, robot) = (goal.to_owned(), self.row.robot.clone());
        effects.push(Effect::Follow { epoch: self.epoch, start, goal, robot });
    }

    fn unfollow(&mut self, effects: &mut Vec<Effect>) {
        self.route = None;
        if self.follows.take().is_some() {
            self.epoch += 1;
            effects.push(Effect::Unfollow);
        }
    }

    fn send_order(&mut self, order: &Given, to: &Addressee, world: &World<'_>, effects: &mut Vec<Effect>) {
        self.heads[0] = self.heads[0].wrapping_add(1);
        let message = to.order(&order.order(world.fleet), self.heads[0], &world.clock.words);
        effects.push(Effect::Send { to: to.clone(), topic: "order", message });
    }

    fn cancel(&mut self, why: &str, to: &Addressee, world: &World<'_>, effects: &mut Vec<Effect>) -> String {
        self.unfollow(effects);
        self.orders += 1;
        let action = format!("cancel {} {}", world.clock.words, self.orders);
        let cancel = Cancel { action, at: world.clock.seconds, why: why.to_owned(), reports: 0 };
        effects.push(Effect::Say(format!("{} stops: {why}", self.row.name)));
        self.send_cancel(&cancel, to, world, effects);
        self.cancels = Some(cancel);
        format!("stops: {why}")
    }

    fn send_cancel(&mut self, cancel: &Cancel, to: &Addressee, world: &World<'_>, effects: &mut Vec<Effect>) {
        self.heads[1] = self.heads[1].wrapping_add(1);
        let action = Action {
            id: cancel.action.clone(),
            kind: "cancelOrder".to_owned(),
            words: cancel.why.clone(),
            blocking: Blocking::Hard,
            parameters: Vec::new(),
        };
        let message = to.instant(&Instant { actions: vec![action] }, self.heads[1], &world.clock.words);
        effects.push(Effect::Send { to: to.clone(), topic: "instantActions", message });
    }

    /// Whether a cancelling has yet to be done with.
    fn is_cancelling(
        &mut self,
        report: &Report,
        to: &Addressee,
        world: &World<'_>,
        effects: &mut Vec<Effect>,
    ) -> bool {
        let Some(mut cancel) = self.cancels.take() else { return false };
        let ended = matches!(report.became_of(&cancel.action), Some("FINISHED" | "FAILED"));
        if (ended || cancel.reports > 0) && !report.is_busy() {
            self.given = None;
            self.is_broken = false;
            return false;
        }
        if world.clock.seconds - cancel.at >= AGAIN {
            cancel.at = world.clock.seconds;
            self.send_cancel(&cancel, to, world, effects);
        }
        self.cancels = Some(cancel);
        true
    }

    /// What errors mean is done once each time that they come.
    fn act_on_errors(&mut self, report: &Report, world: &World<'_>, effects: &mut Vec<Effect>) {
        let present: BTreeSet<String> = report.errors.iter().map(|error| error.error_type.clone()).collect();
        self.acted.retain(|known| present.contains(known));
        for error in &report.errors {
            let meaning = world.fleet.meaning(&error.error_type, &error.error_level);
            let (Some(seconds), Some(at)) = (meaning.closes_for, report.position) else {
                if self.acted.insert(error.error_type.clone()) {
                    effects.push(Effect::Say(format!("{} reports {}", self.row.name, words::error(error))));
                }
                continue;
            };
            // who drives on is not blocked
            if report.driving || !self.acted.insert(error.error_type.clone()) {
                continue;
            }
            let ahead = self.given.as_ref().and_then(|sent| {
                let next = sent.order.stops.get(sent.reached + 1)?;
                Some((next.at[1] - at.y).atan2(next.at[0] - at.x))
            });
            let only = (!meaning.for_all).then(|| self.row.robot.clone()).flatten();
            effects.push(Effect::Block {
                at: [at.x, at.y],
                heading: ahead.unwrap_or(at.theta).to_degrees().rem_euclid(360.0),
                seconds,
                only,
                why: format!("{} reports {}", self.row.name, words::error(error)),
            });
        }
    }

    /// Writes into the table what it has columns for, where it is another value than before.
    fn tell(&mut self, doing: String, effects: &mut Vec<Effect>) {
        let mut values = vec![("doing", Value::from(doing))];
        if let Some(link) = self.link {
            values.push(("connection", Value::from(link.word())));
        }
        if let Some(report) = &self.report {
            values.push(("localized", Value::from(report.position.is_some_and(|at| at.localized))));
            if let Some(battery) = report.battery {
                values.push(("battery", Value::from(battery.charge.round())));
            }
            let errors: BTreeSet<&str> =
                report.errors.iter().map(|error| error.error_type.as_str()).collect();
            values.push(("errors", Value::from(errors.into_iter().collect::<Vec<_>>().join(", "))));
            let here = self.given.as_ref().filter(|sent| sent.order.id == report.order_id);
            if let Some(sent) = here {
                let stop = &sent.order.stops[sent.reached];
                values.push(("space", Value::from(stop.space.clone())));
            }
        }
        for (column, value) in values {
            let Some(known) = self.written.get_mut(column) else { continue };
            if words::is_same(known, &value) {
                continue;
            }
            known.clone_from(&value);
            effects.push(Effect::Write { column, value });
        }
    }
}

/// What is known beside the vehicle.
pub struct World<'a> {
    pub fleet: &'a Fleet,
    pub margins: &'a Margins,
    pub bridges: &'a [Bridge],
    /// How vehicles call the map, unless their rows say otherwise.
    pub map: &'a str,
    pub clock: &'a Clock,
}

fn starts_at(route: &Route, at: [f64; 2]) -> bool {
    route.waypoints.first().is_none_or(|first| distance([first.x, first.y], at) < SAME)
}
