//! Orders: begun, grown, led another way. In a circle with the vehicle's file, of which it is a part.

use super::{AGAIN, About, Driver, Effect, Follows, Now, Sent, words};
use crate::given::Given;
use crate::site::Route;
use crate::way::{Body, Floor, SAME, Stop, distance, stops};

/// Seconds after which an order that was refused is tried once more.
const ANEW: f64 = 10.0;

/// How often an order is said again before it is said that the vehicle does not take it.
const PATIENT: u32 = 3;

/// Metres that a vehicle may have been moved before its way is asked for anew.
const MOVED: f64 = 0.3;

/// How orders of ours begin.
const OURS: &str = "adit ";

impl Driver {
    /// With an order.
    pub(super) fn drive(
        &mut self,
        mut sent: Sent,
        goal: &str,
        now: &Now<'_, '_>,
        effects: &mut Vec<Effect>,
    ) -> String {
        let Now { report, world, .. } = now;
        let is_of_order = report.order_id == sent.order.id;
        // switched off and on, or sent elsewhere by somebody else
        if !is_of_order && (sent.is_known || sent.order.update > 0) {
            self.unfollow(effects);
            effects.push(Effect::Say(format!("{} has its order no more", self.row.name)));
            return self.begin(goal, now, effects);
        }
        if is_of_order {
            self.comes_on(&mut sent, now, effects);
        }
        if std::mem::take(&mut self.is_broken) {
            self.given = Some(sent);
            return self.cancel("the way ahead is closed", now, effects);
        }
        let at = report.position.as_ref().map_or(sent.order.base_end().at, |at| [at.x, at.y]);
        let left = sent.order.left(sent.reached, at);
        if now.is_placed && std::mem::take(&mut self.checks) && left > MOVED {
            effects.push(Effect::Check {
                order: sent.order.id.clone(),
                update: sent.order.update,
                from: at,
                to: sent.order.base_end().at,
                metres: left,
                doorways: sent.order.doorways_ahead(sent.reached),
                robot: self.row.robot.clone(),
            });
        }
        if !sent.is_known {
            return self.wait_for_answer(sent, goal, now, effects);
        }
        let is_at_end = sent.order.is_whole() && sent.reached + 1 == sent.order.stops.len();
        if is_at_end && sent.order.goal == goal && !report.is_busy() && report.has_acted() {
            self.unfollow(effects);
            self.reached = Some(goal.to_owned());
            self.at = Some(goal.to_owned());
            effects.push(Effect::Arrived { goal: goal.to_owned() });
            return format!("at {goal}");
        }
        let end = sent.order.base_end().at;
        self.follow(goal, end, effects);
        // it keeps what it has, and goes on with the newest way
        if let Some(held) = now.held {
            self.given = Some(sent);
            return format!("waits: {held}");
        }
        let heard = self.route.take_if(|route| starts_at(route, end));
        // of what the vehicle is let through nothing is taken that was heard a while ago
        let fresh = self.fresh.take_if(|route| starts_at(route, end));
        let is_fresh = fresh.is_some();
        if is_fresh {
            self.asks = None;
        }
        let route = fresh.or(heard);
        if let Some(route) = route.as_ref().filter(|route| !route.leads()) {
            let reason = route.reason.clone().unwrap_or_else(|| format!("no way to {goal}"));
            if report.is_busy() {
                self.given = Some(sent);
                return self.cancel(&reason, now, effects);
            }
            self.route = Some(route.clone());
            return format!("no way to {goal}: {reason}");
        }
        let way = route.map(|route| self.stops(&route, now));
        let asks = left <= world.margins.ahead + SAME || report.new_base_request;
        let grows = asks && !sent.order.is_whole();
        if grows && !is_fresh && self.asks.is_none_or(|since| world.clock.seconds - since > AGAIN) {
            self.asks = Some(world.clock.seconds);
            let (goal, robot) = (goal.to_owned(), self.row.robot.clone());
            effects.push(Effect::Ask { epoch: self.epoch, start: end, goal, robot });
        }
        let more = grows && is_fresh;
        let released = sent.order.released;
        if (way.is_some() || more) && sent.order.updated(way, goal, more) {
            (sent.at, sent.tries, sent.is_known) = (world.clock.seconds, 0, false);
            self.send_order(&sent.order, now, effects);
            if sent.order.released != released {
                self.goes_on(&sent.order, effects);
            }
        }
        self.given = Some(sent);
        format!("drives to {goal}")
    }

    /// What a state says of how far it is in its order.
    fn comes_on(&mut self, sent: &mut Sent, now: &Now<'_, '_>, effects: &mut Vec<Effect>) {
        let report = now.report;
        sent.is_known |= report.order_update_id == sent.order.update;
        let (sequence, node) = (report.last_node_sequence_id, report.last_node_id.as_str());
        match sent.order.reached(sequence, node) {
            Some(reached) => {
                sent.reached = reached;
                self.remark(About::Node, None, effects);
            }
            // at the start of an order it may still name the node of before
            None if sequence == 0 => {}
            None => {
                let words = format!("is at node `{node}`, sequence {sequence}, which was not released to it");
                self.remark(About::Node, Some(words), effects);
            }
        }
    }

    /// An order that is not acknowledged is refused, or is said again.
    fn wait_for_answer(
        &mut self,
        mut sent: Sent,
        goal: &str,
        now: &Now<'_, '_>,
        effects: &mut Vec<Effect>,
    ) -> String {
        let seconds = now.world.clock.seconds;
        if let Some(refusal) = words::refusal(now.report, &sent.order.id, sent.order.update) {
            self.waits = seconds + ANEW;
            effects.push(Effect::Say(format!("{} refuses its order: {refusal}", self.row.name)));
            let words = format!("refuses its order: {refusal}");
            if sent.order.update == 0 {
                self.unfollow(effects);
                return words;
            }
            self.given = Some(sent);
            return self.cancel(&words, now, effects);
        }
        if let Some(held) = now.held {
            self.given = Some(sent);
            return format!("waits: {held}");
        }
        if seconds - sent.at >= AGAIN {
            sent.at = seconds;
            sent.tries += 1;
            self.send_order(&sent.order, now, effects);
        }
        let is_deaf = sent.tries > PATIENT;
        self.given = Some(sent);
        if is_deaf { "does not take its order".to_owned() } else { format!("drives to {goal}") }
    }

    /// Without an order.
    pub(super) fn begin(&mut self, goal: &str, now: &Now<'_, '_>, effects: &mut Vec<Effect>) -> String {
        let Now { report, world, .. } = now;
        if report.is_busy() {
            // of before this program was started
            if report.order_id.starts_with(OURS) {
                return self.cancel("its order is of before", now, effects);
            }
            return format!("drives order `{}`, which is not of this site", report.order_id);
        }
        if let Some(held) = now.held {
            return format!("waits: {held}");
        }
        let Some(position) = report.position.as_ref() else {
            return "waits: it does not say where it is".to_owned();
        };
        if world.clock.seconds < self.waits {
            return "waits: its last order was refused".to_owned();
        }
        let at = [position.x, position.y];
        if self.follows.as_ref().is_some_and(|follows| distance(follows.start, at) > MOVED) {
            self.follows = None;
        }
        self.follow(goal, at, effects);
        let Some(route) = self.route.take() else { return format!("asks for the way to {goal}") };
        if !route.leads() {
            let reason = route.reason.clone().unwrap_or_default();
            self.route = Some(route);
            return format!("no way to {goal}: {reason}");
        }
        let mut stops = self.stops(&route, now);
        let Some(first) = stops.first_mut() else {
            return format!("no way to {goal}: its route has no points");
        };
        // where it stands no state fits: it begins beside, where that is near enough
        let off = distance(first.at, at);
        if self.is_inside(off, first.state.as_deref(), now) {
            if self.follows.as_ref().is_some_and(|follows| distance(follows.start, at) > SAME) {
                self.follows = None;
            }
            self.route = Some(route);
            return format!(
                "waits: it stands where it does not fit; the nearest point at which it does is {off:.2} m away"
            );
        }
        // rounded up, so that it is within
        first.deviation = Some((off * 100.0).ceil() / 100.0).filter(|off| *off > SAME);
        self.orders += 1;
        let id = format!("{OURS}{} {} {}", self.row.name, world.clock.words, self.orders);
        let order = Given::new(id, goal.to_owned(), (self.map(world), self.robot(world)), stops);
        self.is_broken = false;
        self.goes_on(&order, effects);
        self.send_order(&order, now, effects);
        self.given = Some(Sent { order, reached: 0, at: world.clock.seconds, tries: 0, is_known: false });
        format!("drives to {goal}")
    }

    fn stops(&self, route: &Route, now: &Now<'_, '_>) -> Vec<Stop> {
        let robot = self.robot(now.world);
        let body = |state: &str| {
            let known = now.world.fleet.state(&robot, state);
            known.map_or(Body::default(), |state| Body {
                half: state.width.max(state.length.unwrap_or(0.0)) / 2.0,
                speed: state.speed,
            })
        };
        let floor = Floor { bridges: now.world.bridges, areas: now.world.areas };
        stops(route, body, now.world.margins, floor)
    }

    /// Whether a body whose nearest place is so far off has its middle in what is solid: nearer than half its width to a wall
    /// it may come by how exactly it knows where it is, and by how tightly it is parked.
    fn is_inside(&self, off: f64, state: Option<&str>, now: &Now<'_, '_>) -> bool {
        let fleet = now.world.fleet;
        let body = state.and_then(|state| fleet.state(&self.robot(now.world), state));
        body.is_some_and(|body| off > body.width / 2.0 + SAME)
    }

    /// The way is asked for from where the base ends.
    fn goes_on(&mut self, order: &Given, effects: &mut Vec<Effect>) {
        let at = order.base_end().at;
        (self.asks, self.fresh) = (None, None);
        self.follows = self.follows.take().map(|follows| Follows { start: at, ..follows });
        effects.push(Effect::Moved { at });
    }

    fn follow(&mut self, goal: &str, start: [f64; 2], effects: &mut Vec<Effect>) {
        if self.follows.as_ref().is_some_and(|follows| follows.goal == goal) {
            return;
        }
        self.epoch += 1;
        (self.route, self.asks, self.fresh) = (None, None, None);
        self.follows = Some(Follows { goal: goal.to_owned(), start });
        let (goal, robot) = (goal.to_owned(), self.row.robot.clone());
        effects.push(Effect::Follow { epoch: self.epoch, start, goal, robot });
    }

    pub(super) fn unfollow(&mut self, effects: &mut Vec<Effect>) {
        (self.route, self.asks, self.fresh) = (None, None, None);
        if self.follows.take().is_some() {
            self.epoch += 1;
            effects.push(Effect::Unfollow);
        }
    }

    fn send_order(&mut self, order: &Given, now: &Now<'_, '_>, effects: &mut Vec<Effect>) {
        self.heads[0] = self.heads[0].wrapping_add(1);
        let message = now.to.order(&order.order(now.world.fleet), self.heads[0], &now.world.clock.words);
        effects.push(Effect::Send { to: now.to.clone(), topic: "order", message });
    }
}

/// Whether it was asked for from there.
fn starts_at(route: &Route, at: [f64; 2]) -> bool {
    let Some((x, y)) = route.start.split_once(',') else { return true };
    let asked = (x.trim().parse(), y.trim().parse());
    let (Ok(x), Ok(y)) = asked else { return true };
    distance([x, y], at) < SAME
}
