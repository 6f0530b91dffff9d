//! Rooms and doors as a search sees them, and where it begins and ends.

use petgraph::graph::{EdgeIndex, NodeIndex};

use crate::geometry::{Convex, Point, Rect, Segment};

/// Which of a graph's rooms, from 0.
pub type RoomIndex = NodeIndex;

/// Which of a graph's doors, from 0: not its key.
pub type DoorIndex = EdgeIndex;

/// A room as the search sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct RouteRoom {
    pub outline: Convex,
    /// Of the disc whose middle may be anywhere in it, metres: about corners of walls it may come nearer than to the outline.
    /// `None` for what is no disc.
    pub radius: Option<f64>,
    pub berth: Berth,
    pub walking: Walking,
}

/// How much farther off walls than they must ways keep where that costs little.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Berth {
    /// Beyond the outline, metres.
    pub metres: f64,
    /// What it may cost at most, as a share of what the best way costs.
    pub share: f64,
}

impl RouteRoom {
    pub(super) fn is_measured(&self) -> bool {
        matches!(self.walking, Walking::PerMetre(_))
    }
}

/// What walking in a room weighs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Walking {
    /// Nothing by itself: all hardness lies on the doors (the paper's Table 6).
    OnDoors,
    /// So much a metre.
    PerMetre(f64),
    /// Unknown: no route enters.
    Unknown,
}

/// Where a door is crossed.
#[derive(Clone, Debug, PartialEq)]
pub enum Crossing {
    /// On a segment that both rooms share.
    Through(Segment),
    /// Anywhere in an area, by a change of shape.
    Within(Convex),
}

impl From<Rect> for Crossing {
    /// The area; where it has none, the segment that it is.
    fn from(rect: Rect) -> Self {
        if rect.dx() > 0.0 && rect.dy() > 0.0 {
            return Self::Within(rect.into());
        }
        Self::Through(Segment::new(Point::new(rect.x0, rect.y0), Point::new(rect.x1, rect.y1)))
    }
}

impl Crossing {
    pub fn nearest_to(&self, p: Point) -> Point {
        match self {
            Self::Through(segment) => segment.nearest_to(p),
            Self::Within(area) => area.nearest_to(p),
        }
    }

    /// The middle of the segment, or the centre of the area.
    pub fn middle(&self) -> Point {
        match self {
            Self::Through(segment) => segment.middle(),
            Self::Within(area) => area.centre(),
        }
    }

    /// The least rectangle about it.
    pub fn bounds(&self) -> Rect {
        match self {
            Self::Through(segment) => segment.bounds(),
            Self::Within(area) => area.bounds(),
        }
    }

    /// Where it is passed, of what is no change.
    pub fn segment(&self) -> Option<Segment> {
        match self {
            Self::Through(segment) => Some(*segment),
            Self::Within(_) => None,
        }
    }

    /// Where the shape is changed, of a change.
    pub fn area(&self) -> Option<&Convex> {
        match self {
            Self::Through(_) => None,
            Self::Within(area) => Some(area),
        }
    }
}

/// A door as the search sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct RouteDoor {
    /// Its key, unique.
    pub door: u32,
    pub room1: RoomIndex,
    pub room2: RoomIndex,
    pub crossing: Crossing,
    /// The point that stands for it where no distance in its rooms is weighed.
    pub at: Point,
    /// Hardness of passing it; `None`: unknown, so it is not passed.
    pub hardness: Option<f64>,
    /// Whether rules let a state through.
    pub passable: bool,
    /// Whether it leads from the first room to the second only.
    pub one_way: bool,
}

impl RouteDoor {
    /// Whether it is an area in which the robot changes its shape, not a segment to pass.
    pub fn is_change(&self) -> bool {
        matches!(self.crossing, Crossing::Within(_))
    }

    /// The hardness of passing it, where it can be passed.
    pub fn weight(&self) -> Option<f64> {
        self.hardness.filter(|hardness| self.passable && !hardness.is_nan())
    }
}

/// A room in which a way starts or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    pub room: RoomIndex,
    /// Where a straight leg joins the end with the room; `None`: the room holds the end. The leg weighs what the room does.
    pub joint: Option<Point>,
}

impl From<RoomIndex> for Entry {
    fn from(room: RoomIndex) -> Self {
        Self { room, joint: None }
    }
}

/// Where a search begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Rooms from which ways lead: one in the paper's modes, otherwise some for each state that fits there.
    pub rooms: Vec<Entry>,
    /// The start point, metres.
    pub at: Point,
}

impl Start {
    /// In rooms that hold the point.
    pub fn within(rooms: impl IntoIterator<Item = RoomIndex>, at: Point) -> Self {
        Self { rooms: rooms.into_iter().map(Entry::from).collect(), at }
    }
}

/// Where a search may end.
#[derive(Clone, Debug, PartialEq)]
pub struct Goal {
    /// Rooms into which ways lead.
    pub rooms: Vec<Entry>,
    /// The point; `None`: anywhere in one of the rooms.
    pub at: Option<Point>,
}

impl Goal {
    /// In rooms that hold the point.
    pub fn within(rooms: impl IntoIterator<Item = RoomIndex>, at: Option<Point>) -> Self {
        Self { rooms: rooms.into_iter().map(Entry::from).collect(), at }
    }
}

/// What passing a door changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Passing {
    /// Nothing.
    Free,
    /// What a metre weighs, or it weighs something itself.
    Open,
    /// Nobody passes.
    Shut,
}
