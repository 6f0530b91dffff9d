//! The best way through a room or a door.

use adit_db::door::Door;
use adit_planners::geometry::Point;
use adit_planners::routes::{Goal, Leg, Start, Way};

use crate::error::Result;
use crate::fork::Fork;
use crate::graph::{End, SiteGraph};

/// Points of a room or a door over which a way is tried, where ways are measured.
const POINTS: usize = 9;

/// Ways from a start to a goal.
pub(super) struct Question<'g> {
    graph: &'g SiteGraph,
    start: Start,
    goal: Goal,
}

impl<'g> Question<'g> {
    pub(super) fn new(fork: &'g Fork, start: &str, goal: &str, robot: &str) -> Result<Self> {
        let (start, goal) = (fork.end(start)?, fork.end(goal)?);
        let graph = &*fork.graph;
        Ok(Self { graph, start: graph.start(&start, Some(robot)), goal: graph.goal(&goal, Some(robot)) })
    }

    pub(super) fn best(&self) -> Option<Way> {
        self.way(&self.start, &self.goal)
    }

    /// Whether the goal is a point, so that something is walked in the last room.
    pub(super) fn is_to_point(&self) -> bool {
        self.goal.at.is_some()
    }

    fn way(&self, start: &Start, goal: &Goal) -> Option<Way> {
        self.graph.graph().way(start, std::slice::from_ref(goal)).map(|(_, way)| way)
    }

    /// The way to a point in a room.
    fn to(&self, room: usize, at: Point) -> Option<Way> {
        self.way(&self.start, &Goal { rooms: vec![room], at: Some(at) })
    }

    /// The way on from a point in a room.
    fn on(&self, room: usize, at: Point) -> Option<Way> {
        self.way(&Start { rooms: vec![room], at }, &self.goal)
    }

    /// By where it is entered at least cost, by its middle, or by one of its doors.
    pub(super) fn through_room(&self, room: usize) -> Option<Way> {
        let middle = self.graph.point(&End::Room(room));
        let via = |at: Point| Some(joined(self.to(room, at)?, None, self.on(room, at)?));
        if self.graph.graph().is_on_doors() {
            // walking in a room weighs nothing: every point of it is as good
            return via(middle);
        }
        let first = Goal { rooms: vec![room], at: None };
        let entered = self.way(&self.start, &first).and_then(|way| way.legs.last().copied());
        let doors = self.graph.graph().doors().iter();
        let doors = doors.filter(|door| !door.is_change() && (door.room1 == room || door.room2 == room));
        let points = entered.map(|leg| leg.to).into_iter().chain([middle]);
        let points = points.chain(doors.map(|door| door.crossing.centre())).take(POINTS);
        points.filter_map(via).min_by(|one, two| one.cost.total_cmp(&two.cost))
    }

    /// By one of some points of the door; both ways, unless it is passed one way only.
    pub(super) fn through_door(&self, door: &Door) -> Option<Way> {
        let hardness = door.hardness.value.filter(|_| door.passable.value == Some(true))?;
        let index = self.graph.doors.binary_search_by_key(&door.door, |one| one.door).ok()?;
        let (one, two) = (self.graph.room(door.side1.room)?, self.graph.room(door.side2.room)?);
        let ways = [(one, two), (two, one)];
        let ways = if door.one_way { &ways[..1] } else { &ways[..] };
        let [x0, y0, x1, y1] = door.segment;
        let share = |part: usize| part as f64 / (POINTS - 1) as f64;
        let along = |part| Point::new(x0 + (x1 - x0) * share(part), y0 + (y1 - y0) * share(part));
        let points: Vec<Point> = if self.graph.graph().is_on_doors() {
            vec![Point::new(door.at[0], door.at[1])]
        } else {
            (0..POINTS).map(along).collect()
        };
        let via = |(from, to): (usize, usize), at: Point| {
            Some(joined(self.to(from, at)?, Some((index, hardness)), self.on(to, at)?))
        };
        let all = ways.iter().flat_map(|&way| points.iter().filter_map(move |&at| via(way, at)));
        all.min_by(|one, two| one.cost.total_cmp(&two.cost))
    }
}

/// One way, then the other one, by a door between them or on in the same room.
fn joined(first: Way, door: Option<(usize, f64)>, second: Way) -> Way {
    let mut legs = first.legs;
    let mut cost = first.cost;
    if let (Some(last), Some((door, hardness))) = (legs.last_mut(), door) {
        cost += hardness;
        last.door = Some(door);
        last.cost = cost;
    }
    let begun = cost;
    let after = second.legs.into_iter().map(|leg| Leg { cost: begun + leg.cost, ..leg });
    let mut after = after.peekable();
    // a stop that is no bend is none
    let is_on =
        |last: &Leg, next: &Leg| last.door.is_none() && (last.length() < 1e-9 || next.length() < 1e-9);
    if let (Some(last), Some(next)) = (legs.last().copied(), after.peek().copied())
        && is_on(&last, &next)
    {
        legs.pop();
        after.next();
        legs.push(Leg { from: last.from, hardness: last.hardness + next.hardness, ..next });
    }
    legs.extend(after);
    Way { cost: begun + second.cost, legs }
}
