//! Two rooms with two doors between them, and what a robot did there.

use adit_planners::floor_plan::{Disc, Drawn, FloorPlan, Network};
use adit_planners::geometry::Point;
use adit_planners::navigation::{
    Building, Ending, Entry, Happening, Judge, Mission, Outcome, Outfit, ROOM_M, State,
};
use adit_planners::pose::Pose;
use adit_planners::simulator::{self, Obstacle};

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

pub fn building(plan: &FloorPlan) -> Building {
    Building::new(plan, Network::new(plan, Disc { radius: 0.25, margin: ROOM_M }).unwrap())
}

/// A robot without errors of wheels and sonar.
pub fn exact() -> Outfit {
    Outfit { robot: simulator::Settings::exact(), ..Outfit::default() }
}

pub fn mission(start: [f64; 2], goal: [f64; 2], obstacles: Vec<Obstacle>) -> Mission {
    let start = Pose { at: Point::new(start[0], start[1]), heading: 0.0 };
    Mission { start, goal: Point::new(goal[0], goal[1]), obstacles, seed: 1 }
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
    let outcome = mission.run(&building, outfit, judge, |entry| journal.push(entry), None).unwrap();
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
        self.outcome.ending == Ending::Arrived && self.outcome.miss_m < 0.1
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
        self.journal.iter().map(|entry| entry.truth.at)
    }
}
