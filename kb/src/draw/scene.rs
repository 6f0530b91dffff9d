//! What a picture is drawn from: plain records, as the tables of a site hold them. Metres, in the map's frame.

use adit_db::door::DoorKind;
use adit_planners::geometry::{Convex, Point, Rect};
use adit_planners::routes::Crossing;
use adit_planners::world::{Area, Bridge, NamedDoor, Place, Shape};

/// One map with what is known about it. Every list may be empty; what is empty is not drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Written above the picture.
    pub title: String,
    /// The environment; its edge is drawn as a wall.
    pub bounds: Rect,
    /// Walls and furniture.
    pub obstacles: Vec<Shape>,
    /// Passages of limited height.
    pub bridges: Vec<Bridge>,
    /// Rooms of all states.
    pub rooms: Vec<Room>,
    pub doors: Vec<Door>,
    pub places: Vec<Place>,
    /// Parts of the floor with a name.
    pub areas: Vec<Area>,
    pub named_doors: Vec<NamedDoor>,
    /// Where nobody comes through at the moment, or some do not.
    pub closings: Vec<Closing>,
    /// Edges of the vertical strips, ascending: n + 1 edges make n strips (Figure 4).
    pub strips_x: Vec<f64>,
    /// Edges of the horizontal strips, ascending.
    pub strips_y: Vec<f64>,
    /// Prime areas (Figure 5).
    pub prime_areas: Vec<PrimeArea>,
    pub route: Option<Route>,
    /// The actions in the order of the robot table: an action's colour is that of its position. Actions that
    /// are not named here follow in the order of their first use.
    pub actions: Vec<String>,
}

impl Scene {
    /// A scene of bare ground.
    pub fn new(title: &str, bounds: Rect) -> Self {
        Self {
            title: title.to_owned(),
            bounds,
            obstacles: Vec::new(),
            bridges: Vec::new(),
            rooms: Vec::new(),
            doors: Vec::new(),
            places: Vec::new(),
            areas: Vec::new(),
            named_doors: Vec::new(),
            closings: Vec::new(),
            strips_x: Vec::new(),
            strips_y: Vec::new(),
            prime_areas: Vec::new(),
            route: None,
            actions: Vec::new(),
        }
    }
}

/// A line that is closed, from end to end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closing {
    pub from: Point,
    pub to: Point,
    pub to_whom: ClosedTo,
}

/// To whom a line is closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClosedTo {
    All,
    SomeRobots,
    /// Who comes from its left, as one looks from its first end to its second.
    OneSide,
}

/// A row of `rooms`.
#[derive(Clone, Debug, PartialEq)]
pub struct Room {
    pub name: String,
    pub outline: Convex,
    /// The state whose layer it belongs to; `None` in the paper's modes.
    pub state: Option<String>,
    /// Clear height, metres; `None`: unlimited.
    pub height: Option<f64>,
    /// Hardness per metre, where rules gave one.
    pub hardness: Option<f64>,
    /// The action in it, where rules gave one.
    pub action: Option<String>,
}

/// A row of `doors`.
#[derive(Clone, Debug, PartialEq)]
pub struct Door {
    pub number: i64,
    pub kind: DoorKind,
    /// Index of its first room in [`Scene::rooms`].
    pub room1: usize,
    pub room2: usize,
    /// Where it is crossed. `None`: what the two rooms share.
    pub crossing: Option<Crossing>,
    /// Its crossing point, `x` and `y` of the table.
    pub at: Point,
    /// What crossing it adds, where rules gave it.
    pub hardness: Option<f64>,
    /// The action through it, where rules gave one.
    pub action: Option<String>,
    /// Whether some state passes.
    pub passable: bool,
    /// Whether it leads from the first room to the second only.
    pub one_way: bool,
}

/// A row of `prime_areas`.
#[derive(Clone, Debug, PartialEq)]
pub struct PrimeArea {
    /// What is written on it: `A`, or its strings.
    pub label: String,
    pub rect: Rect,
    /// Whether it is on list 2 (open); `None` before the rules have run.
    pub open: Option<bool>,
}

/// A route: rows of `action_sequence`, with its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    pub start: Place,
    pub goal: Place,
    pub steps: Vec<Step>,
    pub cost: f64,
}

/// What a step of a route passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepKind {
    Room,
    Door,
    /// From one shape into another, on the spot.
    Change,
}

/// A row of `action_sequence`.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    pub kind: StepKind,
    /// The room's name or the door's number.
    pub place: String,
    /// The state in which it is done, where one is known.
    pub state: Option<String>,
    /// Its action, where rules gave one.
    pub action: Option<String>,
    /// What it adds to the cost.
    pub hardness: f64,
    pub to: Point,
    /// Heading there, degrees counterclockwise from x; `None` where any will do.
    pub heading: Option<f64>,
}
