//! Detours, and ways over the whole building.

use super::{Navigator, Spot};
use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, Segment};
use crate::local_model::LocalModel;
use crate::navigation::cuts::{Blocked, forbidden};
use crate::navigation::detour::Detours;
use crate::navigation::event::Happening;
use crate::navigation::field::Ground;
use crate::navigation::highway::{free_ahead, is_clear};
use crate::navigation::judge::{Judge, Mode, State};
use crate::navigation::known::Memory;
use crate::navigation::route::{Route, off_network, over_network};

impl Navigator<'_> {
    pub(super) fn look_for_detours(&mut self) {
        let is_asked = self.state == State::Blocked && self.is_scan_complete() && self.has_way;
        if !is_asked || self.detours.is_some() {
            return;
        }
        let at = self.pose().at;
        let mut found = Detours::default();
        while let Some(&target) = self.legs.front() {
            found = self.detours(at, target);
            // A point on the path may be covered by the obstacle: then the next one is gone to.
            if found != Detours::default() || self.legs.len() == 1 {
                break;
            }
            let next = self.detours(at, self.legs[1]);
            if next == Detours::default() {
                break;
            }
            self.legs.pop_front();
        }
        self.detours = Some(found);
    }

    /// Detours with room on either side, unless they are much longer than those with little.
    pub(super) fn detours(&self, from: Point, to: Point) -> Detours {
        let mut barriers = self.barriers.clone();
        let closed = self.building.closed.iter().copied();
        barriers.splice(self.obstacles_from..self.obstacles_from, closed);
        let obstacles_from = self.obstacles_from + self.building.closed.len();
        let narrow = Ground { obstacles_from, ..self.ground(&barriers) };
        let wide = Ground { reach: self.rim.radius_m() + self.settings.detour_room_m, ..narrow };
        let found = narrow.detours(from, to);
        let Some(shortest) = found.shortest_m() else { return found };
        let with_room = wide.detours(from, to);
        let is_worth = |length: f64| length <= self.settings.room_worth * shortest;
        if with_room.shortest_m().is_some_and(is_worth) { with_room } else { found }
    }

    pub(super) fn ground<'a>(&self, barriers: &'a [Segment]) -> Ground<'a> {
        Ground {
            barriers,
            obstacles_from: self.obstacles_from,
            rim: self.rim,
            reach: self.rim.radius_m() + self.settings.detour_clearance_m,
            least: self.rim.radius_m(),
            aside: self.settings.detour_reach_m,
            grain: self.settings.grain_m,
        }
    }

    pub(super) fn close(&mut self, judge: &mut impl Judge) {
        self.spot.closed += 1;
        let at = self.pose().at;
        let reach = self.rim.radius_m() + self.settings.detour_clearance_m;
        if let Some(&target) = self.legs.front() {
            let free = free_ahead(&self.rim, at, target, [self.rim.radius_m(), reach], &self.barriers);
            let share = free.metres / at.distance(target).max(ROUNDING_M);
            let stop = at.lerp(target, share);
            let met = free.by.map(|by| self.barriers[by]);
            let at = met.map_or(stop, |barrier| self.rim.nearest_on(stop, &barrier));
            let is_known = free.by.is_some_and(|by| by < self.obstacles_from);
            let beside = self.met_beside_change().map(|met| met.nearest_to(self.pose().at));
            let (at, is_known) = (beside.unwrap_or(at), is_known && beside.is_none());
            let (doorway, region) = self.blocked.note(&self.building.network, at, reach);
            let mut seen = self.obstacles(1);
            seen.retain(|surface| surface.distance(at) <= self.settings.detour_reach_m);
            self.tell(Happening::WayClosed { at, doorway, region, is_known, seen });
        }
        self.replans += 1;
        self.ask_for_doorways(judge);
        // What is in the way of another path has to be seen again before that one counts as closed, too.
        self.readings_standing = 0;
        self.part.clear();
        let is_stuck = self.spot.closed > self.settings.most_closed;
        self.plan(judge, is_stuck);
    }

    /// Asks which doorways are closed whatever is seen: whoever was told of what the robot met may say otherwise by now.
    pub(super) fn ask_for_doorways(&mut self, judge: &mut impl Judge) {
        let forbidden = forbidden(&self.building.network, |facts| judge.weigh(facts));
        if forbidden != self.forbidden {
            self.tell(Happening::Forbidden { doorways: forbidden.clone() });
            self.forbidden = forbidden;
            self.gather();
        }
    }

    pub(super) fn retry(&mut self, judge: &mut impl Judge) {
        let estimate = *self.model.estimate();
        self.model = LocalModel::new(*self.model.settings(), estimate);
        if let Some(sensed) = &self.sensed {
            self.model.reckon(&sensed.odometry);
            self.model.set_estimate(estimate);
        }
        (self.memory, self.spot) = (Memory::default(), Spot::default());
        self.blocked = Blocked::new(&self.building.network);
        (self.retries, self.scans) = (self.retries + 1, 0);
        // What is there now has to be seen before it is given up again.
        self.readings_standing = 0;
        self.felt.clear();
        self.part.clear();
        self.ask_for_doorways(judge);
        self.gather();
        self.tell(Happening::Retried);
        self.plan(judge, false);
        self.give_way();
    }

    /// Goes back on its own track first: what moves may be waiting for the robot, as it waits for that.
    fn give_way(&mut self) {
        let at = self.pose().at;
        let reach = self.rim.radius_m() + self.settings.highway_clearance_m;
        let is_near = |back: &&Point| {
            let far = back.distance(at);
            far > self.settings.goal_tolerance_m && far <= self.settings.give_way_m
        };
        let clear = self
            .track
            .iter()
            .filter(is_near)
            .find(|back| is_clear(&self.rim, at, **back, reach, &self.barriers));
        if let Some(&back) = clear.filter(|_| !self.legs.is_empty()) {
            self.legs.push_front(at);
            self.legs.push_front(back);
        }
    }

    /// Looks for a path to the goal over the network; through free space as it is known where that has none.
    pub(super) fn plan(&mut self, judge: &mut impl Judge, is_off_network: bool) {
        let Some(goal) = self.whereabouts.aside.or(self.goal) else { return };
        if self.mode == Mode::Route {
            return self.ask_for_way();
        }
        let ends = [self.pose().at, goal];
        let mut barriers = self.barriers[..self.obstacles_from].to_vec();
        // Where detours found nothing again and again, what they saw in the way counts, too.
        let confidence = if is_off_network { 1 } else { self.settings.least_confidence };
        let met = self.obstacles(confidence);
        let is_unhindered = met.is_empty() && self.blocked.is_none();
        barriers.extend(met);
        let ground = self.ground(&barriers);
        let mut route = None;
        if !is_off_network {
            route = over_network(self.building, ground, &self.blocked, ends, judge);
        }
        let mut route = route.or_else(|| off_network(self.building, ground, ends));
        if route.is_none() && self.squeezes < self.settings.most_squeezes {
            let reach = self.rim.radius_m() + self.settings.squeeze_m;
            route = off_network(self.building, Ground { reach, ..ground }, ends);
            self.squeezes += u32::from(route.is_some());
        }
        self.has_way = route.is_some();
        self.is_shut = route.is_none() && is_unhindered;
        self.legs.clear();
        if let Some(Route { points, length_m, is_off_network }) = route {
            self.legs.extend(points.iter().skip(1));
            // A robot that stands at its goal has a path of one point, and still has to see that it is there.
            if self.legs.is_empty() {
                self.legs.push_back(goal);
            }
            self.tell(Happening::Planned { points, length_m, is_off_network });
        }
        self.detours = None;
    }
}
