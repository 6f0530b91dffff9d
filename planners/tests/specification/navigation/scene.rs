//! Two rooms with two doors between them, and what a robot did there.

use adit_planners::floor_plan::{Disc, Drawn, FloorPlan, Network};
use adit_planners::geometry::Point;
use adit_planners::navigation::{
    Building, Drivable, Ending, Entry, Happening, Judge, Mission, Outcome, Outfit, ROOM_M, State,
};
use adit_planners::pose::Pose;
use adit_planners::simulator::{self, Obstacle};
use adit_planners::world::Place;

use super::table::Table;

/// Rooms of 5 x 6 m side by side; the doors are 1 m wide, with their middles at (5, 1.5) and (5, 4.5).
pub fn two_rooms() -> FloorPlan {
    let line = |x0: f64, y0: f64, x1: f64, y1: f64| [Point::new(x0, y0), Point::new(x1, y1)];
    let walls = vec![
        line(0.0, 0.0, 10.0, 0.0),
        line(10.0, 0.0, 10.0, 6.0),
        line(10.0, 6.0, 0.0, 6.0),
        line(0.0, 6.0, 0.0, 0.0),
        line(5.0, 0.0, 5.0, 1.0),
        line(5.0, 2.0, 5.0, 4.0),
        line(5.0, 5.0, 5.0, 6.0),
    ];
    FloorPlan::new(Drawn { walls, ..Drawn::default() }).unwrap()
}

/// A way round a core of 3 x 2 m, with a pillar in it, a corner cut off by a slanting wall, and a room with a door 1 m wide.
pub fn round_a_core() -> FloorPlan {
    let line = |x0: f64, y0: f64, x1: f64, y1: f64| [Point::new(x0, y0), Point::new(x1, y1)];
    let solid = |x0: f64, y0: f64, x1: f64, y1: f64| {
        vec![Point::new(x0, y0), Point::new(x1, y0), Point::new(x1, y1), Point::new(x0, y1)]
    };
    let place = |name: &str, x: f64, y: f64| Place { name: name.to_owned(), at: Point::new(x, y) };
    let drawn = Drawn {
        name: "round a core".to_owned(),
        walls: vec![
            line(0.0, 0.0, 11.0, 0.0),
            line(11.0, 0.0, 11.0, 6.0),
            line(11.0, 6.0, 9.0, 8.0),
            line(9.0, 8.0, 0.0, 8.0),
            line(0.0, 8.0, 0.0, 0.0),
            line(8.5, 0.0, 8.5, 1.0),
            line(8.5, 2.0, 8.5, 2.8),
            line(8.5, 2.8, 11.0, 2.8),
        ],
        solids: vec![solid(4.0, 3.0, 7.0, 5.0), solid(1.8, 5.8, 2.2, 6.2)],
        places: vec![
            place("front", 2.0, 1.5),
            place("pillar", 1.0, 7.2),
            place("back", 5.5, 6.5),
            place("slant", 9.0, 6.8),
            place("room", 9.8, 1.4),
        ],
    };
    FloorPlan::new(drawn).unwrap()
}

pub fn building(plan: &FloorPlan) -> Building {
    Building::new(plan, Network::new(plan, Disc { radius: 0.25, margin: ROOM_M }).unwrap())
}

/// A robot without errors of wheels and sonar.
pub fn exact() -> Outfit {
    Outfit { robot: simulator::Settings::exact(), ..Outfit::default() }
}

pub fn mission(start: [f64; 2], goal: [f64; 2], obstacles: Vec<Obstacle>) -> Mission {
    let start = Pose { at: Point::new(start[0], start[1]), heading: 0.0 };
    Mission { obstacles, ..Mission::between(start, Point::new(goal[0], goal[1]), 1) }
}

pub fn stands(x: f64, y: f64, dx: f64, dy: f64) -> Obstacle {
    Obstacle::boxed(Point::new(x, y), dx, dy, 0.0)
}

/// What happened on a mission in the two rooms.
pub struct Run {
    pub outcome: Outcome,
    pub journal: Vec<Entry>,
}

pub fn run(mission: &Mission) -> Run {
    run_with(mission, &exact(), &mut Table)
}

pub fn run_with(mission: &Mission, outfit: &Outfit, judge: &mut impl Judge) -> Run {
    let building = building(&two_rooms());
    let mut journal = Vec::new();
    let outcome = mission
        .run(
            &Drivable::of(&building.walls, &building),
            outfit,
            None,
            judge,
            |entry| journal.push(entry),
            None,
        )
        .unwrap();
    Run { outcome, journal }
}

impl Run {
    /// Changes of state and the like, a line each, for the message of a failed test.
    pub fn told(&self) -> String {
        let line = |entry: &Entry| match &entry.event.what {
            Happening::State { facts: f, decision } => format!(
                "{:.2} {:?} -> {decision:?}: to go {:.2} free {:.2} left {:?} right {:?}",
                entry.event.time_s, f.state, f.distance_m, f.free_m, f.left_m, f.right_m
            ),
            Happening::Segments { .. } | Happening::SetEstimatedPosition(_) => String::new(),
            what => format!("{:.2} {what:?}", entry.event.time_s),
        };
        let lines: Vec<String> = self.journal.iter().map(line).filter(|line| !line.is_empty()).collect();
        let last = lines.len().saturating_sub(40);
        format!("{:?}\n{}", self.outcome, lines[last..].join("\n"))
    }

    pub fn has_arrived(&self) -> bool {
        self.outcome.trip.ending == Ending::Arrived && self.outcome.miss_m < 0.1
    }

    pub fn count(&self, is: impl Fn(&Happening) -> bool) -> usize {
        self.journal.iter().filter(|entry| is(&entry.event.what)).count()
    }

    /// The states in the order in which they were entered.
    pub fn states(&self) -> Vec<State> {
        self.journal.iter().filter_map(|entry| entry.event.what.state()).collect()
    }

    /// Where the robot really was when something was told.
    pub fn track(&self) -> impl Iterator<Item = Point> + '_ {
        self.journal.iter().filter_map(|entry| Some(entry.truth?.at))
    }
}
