//! What the judge decided, done.

use std::f64::consts::PI;

use super::{ASIDE, Course, Line, Navigator, Spot};
use crate::body::{Body, Command};
use crate::geometry::{Point, path_length};
use crate::navigation::detour::Detours;
use crate::navigation::event::{Ending, Happening};
use crate::navigation::highway::free_ahead;
use crate::navigation::judge::{Action, Judge, State, StateDecision, StateFacts};

/// So far at the least the robot withdraws from what it touched, metres: it has to be off it.
const LEAST_BACK_M: f64 = 0.01;

impl Navigator<'_> {
    pub(super) fn follow(
        &mut self,
        facts: &StateFacts,
        decision: StateDecision,
        body: &mut impl Body,
        judge: &mut impl Judge,
    ) -> Option<Ending> {
        match decision.action {
            Action::None => {}
            Action::BackOff => self.back_off(body),
            Action::Left => self.take_detour(|detours| (detours.left, detours.right)),
            Action::Right => self.take_detour(|detours| (detours.right, detours.left)),
            Action::Close => self.close(judge),
            Action::Retry => self.retry(judge),
            Action::Match => self.locate(false, judge),
            Action::Search => self.locate(true, judge),
            Action::Seek => self.seek(judge),
            Action::Resume => self.resume(judge),
            Action::NoWay => return Some(Ending::NoWay),
            Action::Lost => return Some(Ending::Lost),
        }
        let is_entered = decision.state != self.state;
        self.state = decision.state;
        match self.state {
            State::Hold if is_entered => {
                self.stop(body);
                return self.reached(facts);
            }
            State::Hold if facts.is_changing && !facts.is_busy => self.come_to_stance(body),
            State::Turn if is_entered || !facts.is_busy => self.turn(body),
            State::Move if is_entered || !facts.is_busy => self.set_off(body, is_entered),
            State::Wait if is_entered => {
                self.stop(body);
                (self.readings_standing, self.spot.waits) = (0, self.spot.waits + 1);
                (self.contact, self.back_offs) = (None, 0);
                self.part.clear();
            }
            State::Blocked if is_entered => {
                self.stop(body);
                self.come_to_spot();
            }
            _ => {}
        }
        None
    }

    pub(super) fn stop(&mut self, body: &mut impl Body) {
        self.course = None;
        body.command(Command::Stop);
    }

    pub(super) fn turn(&mut self, body: &mut impl Body) {
        if let Some(&target) = self.legs.front() {
            self.turn_by(body, self.heading_off(target));
        }
    }

    fn turn_by(&mut self, body: &mut impl Body, by: f64) {
        body.command(Command::Turn { by });
        (self.course, self.readings_standing) = (None, 0);
    }

    /// Turns, or changes its shape, towards the stance that is needed: a disc turns before it becomes longer than wide.
    fn come_to_stance(&mut self, body: &mut impl Body) {
        let Some(needed) = self.stances.get(self.needed) else { return };
        let (off, is_in_shape) = (needed.off_facing(self.pose().heading), self.shape() == needed.shape);
        let turns = is_in_shape || self.building.facing.is_none();
        if turns && off.abs() > self.settings.off_facing {
            self.turn_by(body, off);
        } else {
            body.command(Command::Change { to: needed.shape });
        }
    }

    pub(super) fn set_off(&mut self, body: &mut impl Body, is_entered: bool) {
        let Some(&target) = self.legs.front() else { return };
        let at = self.pose().at;
        if is_entered {
            self.line = Line { from: at, nearest_m: at.distance(target) };
            self.contact = None;
        }
        let off = self.building.off_facing(self.pose().heading);
        if off.abs() > self.settings.off_facing {
            return self.turn_by(body, off);
        }
        let bearing = if self.building.facing.is_some() { self.pose().bearing(target) } else { 0.0 };
        self.drive_straight(body, at.distance(target).min(self.figures().stride_m), bearing);
    }

    /// Withdraws from a touch: straight, or after a turn towards it where it is aside.
    pub(super) fn back_off(&mut self, body: &mut impl Body) {
        self.back_offs += 1;
        let bearing = self.contact.take().map_or(0.0, |contact| contact.bearing);
        if self.building.facing.is_some() {
            // it came from there, so that it is free
            let back = self.line.from - self.pose().at;
            let back =
                if back.length() > LEAST_BACK_M { self.pose().bearing(self.line.from) } else { bearing + PI };
            self.drive_straight(body, self.back_off_m(self.pose().direction(back)), back);
        } else if bearing.cos().abs() >= ASIDE {
            let sign = -bearing.cos().signum();
            self.drive_straight(body, sign * self.back_off_m(self.pose().direction(0.0) * sign), 0.0);
        } else {
            body.command(Command::Turn { by: bearing });
            let far = self.back_off_m(-self.pose().direction(bearing));
            (self.course, self.readings_standing, self.then_m) = (None, 0, Some(-far));
        }
    }

    /// How far it withdraws in a direction: no farther than is free there.
    fn back_off_m(&self, towards: Point) -> f64 {
        let (at, far) = (self.pose().at, self.settings.back_off_m);
        let free = free_ahead(&self.rim, at, at + towards * far, [self.rim.radius_m(); 2], &self.barriers);
        if free.by.is_some() { (free.metres / 2.0).max(LEAST_BACK_M) } else { far }
    }

    pub(super) fn drive_straight(&mut self, body: &mut impl Body, distance_m: f64, bearing: f64) {
        body.command(Command::Move { distance_m, bearing, speed_m_s: self.settings.speed_m_s });
        self.course =
            self.sensed.as_ref().map(|sensed| Course { from: sensed.odometry, distance_m, bearing });
        self.readings_standing = 0;
    }

    pub(super) fn come_to_spot(&mut self) {
        let at = self.pose().at;
        if at.distance(self.spot.at) > self.settings.same_spot_m {
            self.spot = Spot { at, ..Spot::default() };
        }
    }

    pub(super) fn reached(&mut self, facts: &StateFacts) -> Option<Ending> {
        if facts.has_goal && facts.distance_m <= facts.settings.goal_tolerance_m {
            let reached = self.legs.pop_front()?;
            self.came_from = reached;
            self.tell(Happening::Reached(reached));
            let leads_on = !self.legs.is_empty() || self.goes_on();
            return (!leads_on && self.whereabouts.aside.is_none()).then_some(Ending::Arrived);
        }
        None
    }

    pub(super) fn take_detour(&mut self, pick: impl Fn(Detours) -> (Option<Vec<Point>>, Option<Vec<Point>>)) {
        let (taken, other) = pick(self.detours.take().unwrap_or_default());
        let Some(points) = taken else { return };
        self.spot.detours += 1;
        self.came_from = self.pose().at;
        self.legs.pop_front();
        for &point in points.iter().skip(1).rev() {
            self.legs.push_front(point);
        }
        let other_m = other.map(|points| path_length(&points));
        self.tell(Happening::Detour { length_m: path_length(&points), points, other_m });
    }
}
