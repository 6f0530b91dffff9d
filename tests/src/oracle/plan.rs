//! A floor plan as a test draws it: written as a map, turned, and added to.

use std::fmt::Write;

use adit_planners::geometry::{Point, Rect};
use adit_planners::world::{Bridge, Obstacle, Shape, World};

/// A floor.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Metres along x.
    pub width: f64,
    /// Metres along y.
    pub depth: f64,
    /// What no state passes.
    pub obstacles: Vec<Shape>,
    /// What low states pass: outline and clear height.
    pub bridges: Vec<(Rect, f64)>,
    /// Where a metre weighs so many times as much; they do not overlap.
    pub areas: Vec<(Rect, f64)>,
}

impl Plan {
    /// An empty hall.
    pub fn hall(width: f64, depth: f64) -> Self {
        Self { width, depth, obstacles: Vec::new(), bridges: Vec::new(), areas: Vec::new() }
    }

    /// The same with a rectangle more.
    #[must_use]
    pub fn with_rect(mut self, x0: f64, y0: f64, x1: f64, y1: f64) -> Self {
        self.obstacles.push(Shape::Rect(Rect::new(x0, y0, x1, y1)));
        self
    }

    /// The same with a bridge more.
    #[must_use]
    pub fn with_bridge(mut self, x0: f64, y0: f64, x1: f64, y1: f64, height: f64) -> Self {
        self.bridges.push((Rect::new(x0, y0, x1, y1), height));
        self
    }

    /// The same with an area more in which a metre weighs `factor` times as much.
    #[must_use]
    pub fn with_area(mut self, x0: f64, y0: f64, x1: f64, y1: f64, factor: f64) -> Self {
        self.areas.push((Rect::new(x0, y0, x1, y1), factor));
        self
    }

    /// Adds a rectangle.
    pub fn add(&mut self, rect: Rect) {
        self.obstacles.push(Shape::Rect(rect));
    }

    /// The world as the map's reader gives it.
    pub fn world(&self) -> World {
        let mut world = World::empty(Rect::new(0.0, 0.0, self.width, self.depth));
        world.obstacles = self.obstacles.iter().map(|shape| Obstacle { shape: shape.clone() }).collect();
        world.bridges = self.bridges.iter().map(|&(rect, height)| Bridge { rect, height }).collect();
        world
    }

    /// The file `map.toml`.
    pub fn to_toml(&self) -> String {
        let mut text = format!("width = {:?}\ndepth = {:?}\n", self.width, self.depth);
        let mut add = |line: String| writeln!(text, "{line}").expect("writing to a string cannot fail");
        for shape in &self.obstacles {
            match shape {
                Shape::Rect(Rect { x0, y0, x1, y1 }) => {
                    add(format!("[[obstacle]]\nrect = [{x0:?}, {y0:?}, {x1:?}, {y1:?}]"));
                }
                Shape::Polygon(corners) => {
                    let corners: Vec<String> =
                        corners.iter().map(|p| format!("[{:?}, {:?}]", p.x, p.y)).collect();
                    add(format!("[[obstacle]]\npolygon = [{}]", corners.join(", ")));
                }
            }
        }
        for (Rect { x0, y0, x1, y1 }, height) in &self.bridges {
            add(format!("[[bridge]]\nrect = [{x0:?}, {y0:?}, {x1:?}, {y1:?}]\nheight = {height:?}"));
        }
        for (number, (Rect { x0, y0, x1, y1 }, factor)) in self.areas.iter().enumerate() {
            let rect = format!("rect = [{x0:?}, {y0:?}, {x1:?}, {y1:?}]");
            add(format!("[[area]]\nname = \"area {number}\"\n{rect}\nhardness_factor = {factor:?}"));
        }
        text
    }

    /// Turned by a quarter, counterclockwise, and how a point turns with it.
    pub fn quarter_turned(&self) -> (Self, impl Fn(Point) -> Point + use<>) {
        let depth = self.depth;
        let turn = move |p: Point| Point::new(depth - p.y, p.x);
        let turn_rect = |r: &Rect| {
            let (a, b) = (turn(Point::new(r.x0, r.y0)), turn(Point::new(r.x1, r.y1)));
            Rect::new(a.x.min(b.x), a.y.min(b.y), a.x.max(b.x), a.y.max(b.y))
        };
        let obstacles = self.obstacles.iter().map(|shape| match shape {
            Shape::Rect(rect) => Shape::Rect(turn_rect(rect)),
            Shape::Polygon(corners) => Shape::Polygon(corners.iter().map(|&p| turn(p)).collect()),
        });
        let turned = |rects: &[(Rect, f64)]| rects.iter().map(|(rect, of)| (turn_rect(rect), *of)).collect();
        let turned = Self {
            width: self.depth,
            depth: self.width,
            obstacles: obstacles.collect(),
            bridges: turned(&self.bridges),
            areas: turned(&self.areas),
        };
        (turned, turn)
    }

    /// Turned by an angle inside of a larger hall whose additional floor is solid, and how a point turns with it.
    /// Bridges and areas cannot be turned; there must be none.
    pub fn turned(&self, degrees: f64) -> (Self, impl Fn(Point) -> Point + use<>) {
        assert!(
            self.bridges.is_empty() && self.areas.is_empty(),
            "bridges and areas are rectangles along the axes"
        );
        let (sin, cos) = degrees.to_radians().sin_cos();
        let side = (self.width.hypot(self.depth) + 1.0).ceil();
        let (from, to) = (Point::new(self.width / 2.0, self.depth / 2.0), side / 2.0);
        let turn = move |p: Point| {
            let (x, y) = (p.x - from.x, p.y - from.y);
            Point::new(to + x * cos - y * sin, to + x * sin + y * cos)
        };
        let outline = |shape: &Shape| match shape {
            Shape::Rect(r) => corners(r),
            Shape::Polygon(corners) => corners.clone(),
        };
        // The edge of the map becomes four walls, thick enough to be no sheet that a lattice could miss.
        let (w, d, t) = (self.width, self.depth, 0.4);
        let edges = [(-t, -t, w + t, 0.0), (-t, d, w + t, d + t), (-t, 0.0, 0.0, d), (w, 0.0, w + t, d)];
        let edges = edges.map(|(x0, y0, x1, y1)| Shape::Rect(Rect::new(x0, y0, x1, y1)));
        let all = self.obstacles.iter().chain(&edges);
        let turned = all.map(|shape| Shape::Polygon(outline(shape).into_iter().map(turn).collect()));
        (
            Self {
                width: side,
                depth: side,
                obstacles: turned.collect(),
                bridges: Vec::new(),
                areas: Vec::new(),
            },
            turn,
        )
    }
}

/// The corners of a rectangle, counterclockwise.
pub fn corners(r: &Rect) -> Vec<Point> {
    [(r.x0, r.y0), (r.x1, r.y0), (r.x1, r.y1), (r.x0, r.y1)].map(|(x, y)| Point::new(x, y)).to_vec()
}
