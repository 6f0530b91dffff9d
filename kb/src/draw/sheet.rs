//! One picture in the making: what all its parts share.

use adit_planners::geometry::{Convex, Point, Segment};
use adit_planners::routes::Crossing;
use adit_planners::world::Shape;

use super::frame::{At, Block, Frame};
use super::labels::Labels;
use super::layers::{Layer, Layers};
use super::palette::{self, Palette, Scale};
use super::runs::{self, Run};
use super::scene::{Door, Scene};
use super::style::Style;
use super::svg::{self, Svg};
use super::view::View;

/// What the parts of a picture share.
pub(super) struct Sheet<'a> {
    pub scene: &'a Scene,
    pub layers: &'a Layers,
    pub frame: Frame,
    pub view: View,
    pub palette: Palette,
    pub scale: Option<Scale>,
    /// The route's runs; none where it is not drawn.
    pub runs: Vec<Run>,
    pub labels: Labels,
    /// Factor of texts and marks: larger maps get larger ones.
    pub unit: f64,
    /// Factor of lines and numbers, at most 1: small where rooms are small.
    pub detail: f64,
}

impl<'a> Sheet<'a> {
    /// A sheet with its map at (left, top).
    pub fn new(scene: &'a Scene, layers: &'a Layers, style: &Style, left: f64, top: f64) -> Self {
        let view = View::of(scene, layers);
        let longest = style.longest_side(view.rooms.len());
        let frame = Frame::new(scene.bounds, longest, left, top);
        let area: f64 = view.rooms.iter().map(|&i| scene.rooms[i].outline.area()).sum();
        let side = (area / view.rooms.len().max(1) as f64).sqrt() * frame.scale;
        let route = scene.route.as_ref().filter(|_| layers.has(Layer::Route));
        Self {
            scene,
            layers,
            frame,
            palette: Palette::of(scene),
            scale: palette::door_scale(scene),
            runs: route.map(runs::runs).unwrap_or_default(),
            labels: Labels::beside(scene.obstacles.iter().map(|shape| frame.block(&shape.enclosing_rect()))),
            unit: (longest / 1100.0).clamp(0.6, 1.8),
            detail: if view.rooms.is_empty() { 1.0 } else { (side / 45.0).clamp(0.3, 1.0) },
            view,
        }
    }

    /// The line that stands for a door: where it is crossed as told, or what its rooms share, or its point.
    pub fn across(&self, door: &Door) -> Across {
        let outline = |i: usize| self.scene.rooms.get(i).map(|room| &room.outline);
        let shared = || {
            let (one, two) = (outline(door.room1)?, outline(door.room2)?);
            one.common(two).map(Crossing::Within).or_else(|| one.border(two).map(Crossing::Through))
        };
        let segment = match door.crossing.clone().or_else(shared) {
            Some(Crossing::Through(segment)) => segment,
            Some(Crossing::Within(area)) => middle_line(&area),
            None => Segment::new(door.at, door.at),
        };
        Across::new(self.frame.at(segment.a), self.frame.at(segment.b))
    }

    /// The class of a door's hardness; the easiest where it has none.
    pub fn class(&self, door: &Door) -> usize {
        let class = |scale: &Scale| door.hardness.map(|hardness| scale.class(hardness));
        self.scale.as_ref().and_then(class).unwrap_or(0)
    }
}

/// A line across which a door leads, in the picture.
pub(super) struct Across {
    pub centre: At,
    /// Its direction, of length 1: to the right where it is rather level, else down.
    pub along: At,
    pub length: f64,
}

impl Across {
    fn new(a: At, b: At) -> Self {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let length = dx.hypot(dy);
        let forwards = if dx.abs() >= dy.abs() { dx } else { dy }.signum();
        let along = if length > 0.0 { (dx / length * forwards, dy / length * forwards) } else { (1.0, 0.0) };
        Self { centre: (f64::midpoint(a.0, b.0), f64::midpoint(a.1, b.1)), along, length }
    }

    pub fn is_level(&self) -> bool {
        self.along.0.abs() >= self.along.1.abs()
    }

    /// Across it, of length 1: down where it is rather level, else to the right.
    pub fn beside(&self) -> At {
        let (x, y) = self.along;
        if self.is_level() { (-y, x) } else { (y, -x) }
    }

    /// The point so far along it from its centre, and so far beside it.
    pub fn at(&self, along: f64, beside: f64) -> At {
        let ((x, y), (u, v), (p, q)) = (self.centre, self.along, self.beside());
        (x + u * along + p * beside, y + v * along + q * beside)
    }
}

/// The line through the centre of an area on which the box about it is longer.
fn middle_line(area: &Convex) -> Segment {
    let (b, Point { x, y }) = (area.bounds(), area.centre());
    let line = if b.dx() >= b.dy() {
        Segment::new(Point::new(b.x0, y), Point::new(b.x1, y))
    } else {
        Segment::new(Point::new(x, b.y0), Point::new(x, b.y1))
    };
    area.clip(line).unwrap_or(line)
}

/// Path commands of a room.
pub(super) fn room_of(path: &mut String, frame: &Frame, outline: &Convex) {
    match outline.rect() {
        Some(rect) => self::outline(path, &frame.block(&rect)),
        None => svg::round(path, outline.corners().map(|corner| frame.at(corner))),
    }
}

/// Path commands of a box.
pub(super) fn outline(path: &mut String, block: &Block) {
    svg::command(path, 'M', &[block.x, block.y]);
    svg::command(path, 'h', &[block.w]);
    svg::command(path, 'v', &[block.h]);
    svg::command(path, 'h', &[-block.w]);
    path.push('z');
}

/// Path commands of a shape of the map.
pub(super) fn shape_of(path: &mut String, frame: &Frame, shape: &Shape) {
    match shape {
        Shape::Rect(rect) => outline(path, &frame.block(rect)),
        Shape::Polygon(corners) => svg::round(path, corners.iter().map(|corner| frame.at(*corner))),
    }
}

/// A line between two points of the picture.
pub(super) fn line(svg: &mut Svg, from: At, to: At, stroke: &str, width: f64, dash: &str) {
    svg.element("line")
        .nums([("x1", from.0), ("y1", from.1), ("x2", to.0), ("y2", to.1), ("stroke-width", width)])
        .attr("stroke", stroke)
        .dash(dash)
        .end();
}

/// For whoever draws over the picture: an empty group whose transform leads from metres to where they lie in it.
pub(super) fn metres(svg: &mut Svg, frame: &Frame) {
    let (scale, x, y) = (frame.scale, frame.x(0.0), frame.y(0.0));
    let transform = format!("matrix({scale} 0 0 {} {x} {y})", -scale);
    svg.element("g").attr("id", "metres").attr("transform", &transform).end();
}

/// A small cross: nobody passes.
pub(super) fn cross(svg: &mut Svg, (x, y): At, reach: f64) {
    let mut path = String::new();
    for side in [-1.0, 1.0] {
        svg::command(&mut path, 'M', &[x - reach, y - side * reach]);
        svg::command(&mut path, 'L', &[x + reach, y + side * reach]);
    }
    for (stroke, width) in [("#ffffff", reach * 1.1), (super::palette::INK, reach * 0.45)] {
        svg.element("path").attr("d", &path).attr("stroke", stroke).num("stroke-width", width).end();
    }
}
