//! The world as a planner reads it: one map, whatever file it came from, with what a site lays over it.

mod named;
mod occupancy;

use std::hash::{Hash, Hasher};

use geo::{BooleanOps, Contains, Coord, MultiPolygon, Polygon};
use siphasher::sip::SipHasher13;

pub use named::{Area, NamedDoor, Property};
pub use occupancy::Occupancy;

use crate::geometry::{Point, Rect, Segment, polygon};
use crate::pose::Pose;

/// Everything a geometric planner may look at. Metres, in the map's frame; the edge of `bounds` is a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    pub bounds: Rect,
    /// What no state passes.
    pub obstacles: Vec<Obstacle>,
    /// What only low states pass: rectangles with a clear height under them.
    pub bridges: Vec<Bridge>,
    pub places: Vec<Place>,
    /// Parts of the floor with a name; they may overlap.
    pub areas: Vec<Area>,
    /// Doors with a name.
    pub named_doors: Vec<NamedDoor>,
    /// Walls given as an image; `None` for a vector map.
    pub occupancy: Option<Occupancy>,
    /// Pose of the map in the world.
    pub frame: Pose,
    /// Steps in which the narrowest place of a way is looked for, metres; `None`: chosen.
    pub grid: Option<f64>,
    /// Kept free around every state besides its own width, metres.
    pub clearance: f64,
}

impl World {
    /// A world with nothing in it but its edge.
    pub fn empty(bounds: Rect) -> Self {
        Self {
            bounds,
            obstacles: Vec::new(),
            bridges: Vec::new(),
            places: Vec::new(),
            areas: Vec::new(),
            named_doors: Vec::new(),
            occupancy: None,
            frame: Pose::default(),
            grid: None,
            clearance: 0.0,
        }
    }

    /// What is called so: a `place`, an `area`, or a `door`.
    pub fn kind_of_named(&self, name: &str) -> Option<&'static str> {
        let places = self.places.iter().map(|place| ("place", &place.name));
        let areas = self.areas.iter().map(|area| ("area", &area.name));
        let doors = self.named_doors.iter().map(|door| ("door", &door.name));
        places.chain(areas).chain(doors).find(|(_, known)| *known == name).map(|(kind, _)| kind)
    }

    /// Everything solid as rectangles inside of the environment: what the paper's modes look at. Polygons by
    /// their minimum enclosing rectangle, an image's walls cell by cell in as few runs as merge. The
    /// [`clearance`](Self::clearance) is not added: the paper has none.
    pub fn solid_rects(&self) -> Vec<Rect> {
        let drawn = self.obstacles.iter().map(|obstacle| obstacle.shape.enclosing_rect());
        let pictured = self.occupancy.iter().flat_map(Occupancy::rectangles);
        drawn.chain(pictured).filter_map(|rect| self.bounds.intersection(&rect)).collect()
    }
}

impl World {
    /// Whether the point lies inside of something solid.
    pub fn is_solid(&self, p: Point) -> bool {
        let drawn = self.obstacles.iter().any(|obstacle| obstacle.shape.contains(p));
        drawn || self.occupancy.as_ref().is_some_and(|cells| cells.is_blocked_at(p))
    }

    /// A number that two worlds share in which the same is solid, whatever is named there.
    pub fn fingerprint_of_solid(&self) -> u64 {
        Self { places: Vec::new(), areas: Vec::new(), named_doors: Vec::new(), ..self.clone() }.fingerprint()
    }

    /// A number that two equal worlds share, and two others hardly ever do.
    pub fn fingerprint(&self) -> u64 {
        let mut hasher = SipHasher13::new();
        let mut numbers = |values: &[f64]| values.iter().for_each(|value| value.to_bits().hash(&mut hasher));
        numbers(&[self.bounds.x0, self.bounds.y0, self.bounds.x1, self.bounds.y1]);
        numbers(&[self.clearance, self.grid.unwrap_or(-1.0)]);
        let mut outline = |shape: &Shape| match shape {
            Shape::Rect(r) => numbers(&[4.0, r.x0, r.y0, r.x1, r.y1]),
            Shape::Polygon(corners) => {
                numbers(&[-(corners.len() as f64)]);
                for p in corners {
                    numbers(&[p.x, p.y]);
                }
            }
        };
        self.obstacles.iter().for_each(|obstacle| outline(&obstacle.shape));
        self.areas.iter().for_each(|area| outline(&area.shape));
        for bridge in &self.bridges {
            let r = bridge.rect;
            numbers(&[5.0, r.x0, r.y0, r.x1, r.y1, bridge.height]);
        }
        for place in &self.places {
            numbers(&[place.at.x, place.at.y]);
        }
        for door in &self.named_doors {
            numbers(&[6.0, door.from.x, door.from.y, door.to.x, door.to.y]);
        }
        if let Some(cells) = &self.occupancy {
            numbers(&[cells.origin.x, cells.origin.y, cells.resolution]);
            (cells.columns, cells.rows, &cells.blocked).hash(&mut hasher);
        }
        self.places.iter().for_each(|place| place.name.hash(&mut hasher));
        for area in &self.areas {
            (&area.name, &area.kind, &area.further).hash(&mut hasher);
        }
        for door in &self.named_doors {
            (&door.name, &door.kind, &door.further).hash(&mut hasher);
        }
        hasher.finish()
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    pub shape: Shape,
}

/// The outline of an obstacle.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    Rect(Rect),
    /// A simple polygon, at least three corners, not closed by a repeated one.
    Polygon(Vec<Point>),
}

impl Shape {
    /// The minimum enclosing rectangle: what the paper's mode takes for a polygon.
    pub fn enclosing_rect(&self) -> Rect {
        match self {
            Self::Rect(rect) => *rect,
            Self::Polygon(corners) => Rect::around(corners.iter().copied()),
        }
    }

    /// Whether the point lies inside; not on the outline.
    pub fn contains(&self, p: Point) -> bool {
        match self {
            Self::Rect(r) => r.x0 < p.x && p.x < r.x1 && r.y0 < p.y && p.y < r.y1,
            Self::Polygon(corners) => polygon::to_geo(corners).contains(&Coord::from(p)),
        }
    }

    /// In their order.
    pub fn corners(&self) -> Vec<Point> {
        match self {
            Self::Rect(rect) => rect.corners().to_vec(),
            Self::Polygon(corners) => corners.clone(),
        }
    }

    pub fn sides(&self) -> Vec<Segment> {
        polygon::sides(&self.corners()).collect()
    }

    /// What of it lies in a rectangle; empty where they have no more than an edge in common.
    pub fn part_in(&self, rect: Rect) -> MultiPolygon<f64> {
        self.to_geo().intersection(&Self::Rect(rect).to_geo())
    }

    /// The outline as the `geo` crate has it.
    pub fn to_geo(&self) -> Polygon<f64> {
        match self {
            Self::Rect(rect) => geo::Rect::from(*rect).to_polygon(),
            Self::Polygon(corners) => polygon::to_geo(corners),
        }
    }
}

/// A bridge: the robot may pass under it where its state is lower than `height`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bridge {
    pub rect: Rect,
    /// Clear height under it, metres; positive.
    pub height: f64,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    pub name: String,
    pub at: Point,
}
