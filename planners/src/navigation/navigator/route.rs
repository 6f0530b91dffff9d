//! Ways that somebody else finds: gone stretch by stretch, each in the stance that it asks for.

use super::{Navigator, Spot};
use crate::geometry::{Point, Segment, path_length};
use crate::navigation::Settings;
use crate::navigation::event::Happening;
use crate::navigation::judge::Mode;
use crate::navigation::known::Building;
use crate::navigation::stretch::Stretch;

/// No robot keeps to a way more exactly than for so much room beside it, metres.
const LEAST_ROOM_M: f64 = 0.03;

/// Ways whose points lie so near together are the same, metres.
const SAME_M: f64 = 0.01;

impl Navigator<'_> {
    /// Goes to a goal by ways that are [given](Self::take_way) to it, from now on.
    pub fn go_by_route(&mut self, goal: Point) {
        (self.mode, self.goal, self.retries, self.scans) = (Mode::Route, Some(goal), 0, 0);
        (self.begun_s, self.spot) = (self.time_s(), Spot::default());
        self.whereabouts.begin();
        self.ask_for_way();
    }

    /// Where it waits for a way to be given to it to: at first, and where the one that it had is closed.
    pub fn wants_way(&self) -> Option<Point> {
        self.whereabouts.aside.or(self.goal).filter(|_| self.wants_way)
    }

    /// Takes a way from where it is; `None` where there is none. Where there is none to where it could tell where it is, it goes on to
    /// its goal.
    ///
    /// # Arguments
    /// `is_shut` is whether there is none even if nothing that the robot met is in the way.
    pub fn take_way(&mut self, way: Option<Vec<Stretch>>, is_shut: bool) {
        if way.is_none() && self.whereabouts.aside.take().is_some() {
            return self.ask_for_way();
        }
        (self.wants_way, self.has_way, self.is_shut) = (false, way.is_some(), is_shut && way.is_none());
        let Some(way) = way else { return };
        let points: Vec<Point> = way.iter().flat_map(|stretch| &stretch.points).copied().collect();
        let length_m = path_length(&points);
        self.stretches = way.into();
        self.goes_on();
        self.tell(Happening::Planned { points, length_m, is_off_network: false });
    }

    /// Where it is on its way to, or would be if there were a way, and may take another one.
    pub fn heeds(&self) -> Option<Point> {
        let is_on_way = self.mode == Mode::Route && !self.wants_way && self.whereabouts.aside.is_none();
        self.goal.filter(|_| is_on_way)
    }

    /// Others changed what ways there are, and this one is the best now: it is taken, unless it is the one that the robot is on.
    pub fn heed(&mut self, way: Option<Vec<Stretch>>) {
        let is_other = way.as_ref().map_or(self.has_way, |way| !self.has_way || !self.is_on(way));
        self.tell(Happening::Heard { is_other });
        if is_other {
            self.ask_for_way();
            self.take_way(way, false);
        }
    }

    /// Notes how much of what it met was passed on to everybody, and how much taken back.
    pub(in crate::navigation) fn has_told(&mut self, [laid, lifted]: [usize; 2]) {
        if laid + lifted > 0 {
            self.tell(Happening::Told { laid, lifted });
        }
    }

    /// Whether a way from where it is is what it has before it.
    fn is_on(&self, way: &[Stretch]) -> bool {
        let after_first = |stretch: &Stretch| {
            let stance = stretch.stance;
            stretch.points.iter().skip(1).map(move |at| (stance, *at)).collect::<Vec<_>>()
        };
        let rest = self.legs.iter().map(|at| (self.needed, *at));
        let rest = rest.chain(self.stretches.iter().flat_map(after_first));
        let rest: Vec<(usize, Point)> = rest.collect();
        let way: Vec<(usize, Point)> = way.iter().flat_map(after_first).collect();
        let is_same = |(one, other): (&(usize, Point), &(usize, Point))| {
            one.0 == other.0 && one.1.distance(other.1) <= SAME_M
        };
        rest.len() == way.len() && rest.iter().zip(&way).all(is_same)
    }

    /// Drops the way that it has, and waits for another one.
    pub(super) fn ask_for_way(&mut self) {
        self.legs.clear();
        self.stretches.clear();
        (self.wants_way, self.has_way, self.detours) = (true, false, None);
    }

    /// Takes up the next stretch of the way.
    ///
    /// # Returns
    /// Whether there is one.
    pub(super) fn goes_on(&mut self) -> bool {
        let Some(Stretch { stance, points }) = self.stretches.pop_front() else { return false };
        // it stands at the first one already
        let at_it = usize::from(points.len() > 1);
        self.came_from = points.first().copied().unwrap_or_else(|| self.pose().at);
        (self.needed, self.legs) = (stance, points.into_iter().skip(at_it).collect());
        true
    }

    /// The figures as they hold on the leg that is gone: on ways that somebody else found, where there may be hardly any room
    /// beside the robot, it keeps to them the more exactly the less there is.
    pub(super) fn figures(&self) -> Settings {
        let figures = self.settings;
        let Some(&target) = self.legs.front().filter(|_| self.mode == Mode::Route) else { return figures };
        let leg = Segment::new(self.came_from, target);
        let gaps = self.barriers.iter().map(|barrier| self.rim.way_distance(&leg, barrier));
        let mut room = gaps.fold(f64::INFINITY, f64::min) - self.rim.radius_m();
        let mut at_change = f64::INFINITY;
        if let (1, Some(next)) = (self.legs.len(), self.stretches.front())
            && let Some(building) = self.stances.get(next.stance)
        {
            // it changes its shape there
            let met = &self.barriers[self.obstacles_from..];
            let there = building.walls.iter().chain(&building.overhead).chain(met);
            let gaps = there.map(|barrier| building.rim.distance(target, barrier));
            let nearest = gaps.fold(f64::INFINITY, f64::min);
            at_change = (nearest - building.rim.radius_m()).max(LEAST_ROOM_M);
            room = room.min(at_change);
        }
        let room = room.max(LEAST_ROOM_M);
        // what is over it has no echo: the more of the room there is left to how far it is off without knowing
        let off = (room / 2.0).min(at_change / 4.0);
        Settings {
            goal_tolerance_m: figures.goal_tolerance_m.min(off),
            highway_half_width_m: figures.highway_half_width_m.min(room),
            highway_clearance_m: figures.highway_clearance_m.min((room - LEAST_ROOM_M) / 2.0),
            turning_resolution: figures
                .turning_resolution
                .min((off / self.pose().at.distance(target).max(off)).asin()),
            stride_m: figures.stride_m.min(figures.stride_to_room * room),
            ..figures
        }
    }

    /// Whether the robot has to be in another shape, or to face elsewhere, before it goes on.
    pub(super) fn is_changing(&self) -> bool {
        let is_other = |needed: &Building| {
            self.shape() != needed.shape
                || needed.off_facing(self.pose().heading).abs() > self.settings.off_facing
        };
        let is_known = !self.legs.is_empty() && self.sensed.is_some();
        is_known && self.stances.get(self.needed).is_none_or(is_other)
    }

    /// What leaves no room for the shape in which the robot has to be before it goes on: what was met, with some room, and what is
    /// known to stand or hang there.
    pub(super) fn met_beside_change(&self) -> Option<Segment> {
        let needed = self.stances.get(self.needed).filter(|_| self.is_changing())?;
        let (rim, at) = (&needed.rim, self.pose().at);
        let radius = rim.radius_m();
        let reach = if rim.outer_m() > self.rim.outer_m() {
            radius + self.settings.detour_clearance_m
        } else if needed.facing.is_some() {
            // who only turns needs no more room than the way beside has
            radius
        } else {
            0.0
        };
        let met = self.barriers[self.obstacles_from..].iter().chain(&self.moving);
        let met = met.filter(|met| rim.distance(at, met) < reach);
        let known = needed.walls.iter().chain(&needed.overhead);
        let known = known.filter(|known| rim.distance(at, known) < radius);
        let far = |barrier: &Segment| rim.distance(at, barrier);
        met.chain(known).min_by(|one, other| far(one).total_cmp(&far(other))).copied()
    }

    /// Looks at the building as it is for the robot in a shape, at the facing at which it stands.
    pub(super) fn take_stance(&mut self, shape: usize) {
        let heading = self.pose().heading;
        let own = self.stances.iter().filter(|stance| stance.shape == shape);
        let off = |stance: &Building| stance.off_facing(heading).abs();
        let Some(building) = own.min_by(|one, other| off(one).total_cmp(&off(other))) else { return };
        if !std::ptr::eq(building, self.building) {
            let is_other_shape = building.shape != self.building.shape;
            self.building = building;
            self.barriers = [&building.walls[..], &building.overhead].concat();
            if is_other_shape {
                self.tell(Happening::Shape(shape));
            }
            self.gather();
        }
    }
}
