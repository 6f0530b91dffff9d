//! One picture in the making: what all its parts share.

use adit_planners::geometry::Rect;
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
        let area: f64 = view.rooms.iter().map(|&i| scene.rooms[i].rect.area()).sum();
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

    /// Where a door is crossed, in metres: as told, or what its rooms share, or its point.
    pub fn crossing(&self, door: &Door) -> Rect {
        let rect = |i: usize| self.scene.rooms.get(i).map(|room| room.rect);
        let shared = || {
            let (a, b) = (rect(door.room1)?, rect(door.room2)?);
            let common = Rect::new(a.x0.max(b.x0), a.y0.max(b.y0), a.x1.min(b.x1), a.y1.min(b.y1));
            (common.x0 <= common.x1 && common.y0 <= common.y1).then_some(common)
        };
        let point = Rect::new(door.at.x, door.at.y, door.at.x, door.at.y);
        door.crossing.or_else(shared).unwrap_or(point)
    }

    /// The class of a door's hardness; the easiest where it has none.
    pub fn class(&self, door: &Door) -> usize {
        let class = |scale: &Scale| door.hardness.map(|hardness| scale.class(hardness));
        self.scale.as_ref().and_then(class).unwrap_or(0)
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
