//! A lane graph: a panel for each level, with its walls, doors, lanes, nodes, and a route.

use std::collections::BTreeMap;

use adit_planners::geometry::{Point, Rect};
use adit_planners::lanes::{LaneGraph, Level, Node};

use super::frame::{At, Block, Frame};
use super::labels::{Face, Labels};
use super::palette::{BRIDGE, CLOSED, GREY, INK, ROUTE};
use super::sheet::{line, metres};
use super::svg::Svg;
use super::{MARGIN, page, text};

const LONGEST: f64 = 900.0;
/// Above the panels, for the title; above each, for its level; and below, for what signs mean.
const TITLE: f64 = 34.0;
const LEVEL: f64 = 22.0;
const BELOW: f64 = 34.0;

const LEGEND: &str = "lines: lanes, an arrow where they lead one way (dashed grey: nobody drives there now); brown: doors; \
                      rings: nodes; squares: lifts; thick line: the route";

/// The graph as a standalone SVG text.
///
/// # Arguments
/// `is_open` says of a lane, by its place, whether it is driven on; `route` are lanes.
pub fn render_lanes(
    title: &str,
    graph: &LaneGraph,
    is_open: impl Fn(usize) -> bool,
    is_closed: impl Fn(&str) -> bool,
    route: &[usize],
) -> String {
    let mut svg = Svg::default();
    let lanes = graph.lanes.iter().enumerate();
    let lanes = lanes.map(|(place, lane)| ((lane.from.as_str(), lane.to.as_str()), place)).collect();
    let (mut left, mut below) = (MARGIN, 0.0_f64);
    let longest = if graph.levels.len() < 2 { LONGEST } else { LONGEST / 1.5 };
    for level in &graph.levels {
        let frame = Frame::new(bounds(graph, level), longest, left, MARGIN + TITLE + LEVEL);
        let mut labels = Labels::default();
        if graph.levels.len() > 1 {
            svg.words((left, MARGIN + TITLE + 12.0), 14.0, INK, &text::fit(&level.level, 14.0, frame.map.w));
        }
        let here = graph.nodes.iter().filter(|node| node.level == level.level);
        let nodes = here.map(|node| (node.node.as_str(), node)).collect();
        let panel = Panel { graph, level, frame, nodes, lanes: &lanes };
        panel.building(&mut svg, &is_closed);
        panel.lanes(&mut svg, &is_open);
        panel.route(&mut svg, route, &mut labels);
        panel.nodes(&mut svg, &mut labels);
        svg.append(&labels.finish());
        // on several levels metres lie at several places
        if graph.levels.len() == 1 {
            metres(&mut svg, &frame);
        }
        left += frame.map.w + 2.0 * MARGIN;
        below = below.max(frame.map.y + frame.map.h);
    }
    let below = below.max(MARGIN + TITLE + LEVEL);
    let right = left.max(text::width(LEGEND, 13.0) + 2.0 * MARGIN);
    page(title, (right, below + BELOW), |page| {
        page.words((MARGIN, MARGIN + 14.0), 18.0, INK, &text::fit(title, 18.0, right - 2.0 * MARGIN));
        page.append(&svg);
        page.words((MARGIN, below + 22.0), 13.0, GREY, LEGEND);
    })
}

/// Of all that is drawn on a level.
fn bounds(graph: &LaneGraph, level: &Level) -> Rect {
    let is_here = |of: &str| of == level.level;
    let nodes = graph.nodes.iter().filter(|node| is_here(&node.level)).map(|node| node.at);
    let walls = graph.walls.iter().filter(|wall| is_here(&wall.level)).flat_map(|wall| wall.ends);
    let doors = graph.doors.iter().filter(|door| is_here(&door.level)).flat_map(|door| door.ends);
    let all: Vec<Point> = nodes.chain(walls).chain(doors).collect();
    if all.is_empty() {
        return Rect::new(0.0, 0.0, 1.0, 1.0);
    }
    // a graph on one line is drawn, too
    let Rect { x0, y0, x1, y1 } = Rect::around(all);
    let room = (x1 - x0).max(y1 - y0).max(1.0) * 0.05;
    Rect { x0: x0 - room, y0: y0 - room, x1: x1 + room, y1: y1 + room }
}

struct Panel<'g> {
    graph: &'g LaneGraph,
    level: &'g Level,
    frame: Frame,
    /// Those of the level, by id.
    nodes: BTreeMap<&'g str, &'g Node>,
    /// The place of a lane by its ends.
    lanes: &'g BTreeMap<(&'g str, &'g str), usize>,
}

impl Panel<'_> {
    fn at(&self, p: Point) -> At {
        self.frame.at(p)
    }

    fn here(&self) -> impl Iterator<Item = &Node> {
        self.nodes.values().copied()
    }

    fn building(&self, svg: &mut Svg, is_closed: &impl Fn(&str) -> bool) {
        for wall in self.graph.walls.iter().filter(|wall| wall.level == self.level.level) {
            line(svg, self.at(wall.ends[0]), self.at(wall.ends[1]), INK, 2.4, "");
        }
        for door in self.graph.doors.iter().filter(|door| door.level == self.level.level) {
            let (colour, width) = if is_closed(&door.door) { (CLOSED, 6.0) } else { (BRIDGE, 4.0) };
            line(svg, self.at(door.ends[0]), self.at(door.ends[1]), colour, width, "");
        }
    }

    /// The ends of a lane in the picture; `None` where it is on another level.
    fn ends(&self, lane: usize) -> Option<[At; 2]> {
        let lane = self.graph.lanes.get(lane)?;
        let end = |id: &str| self.nodes.get(id).map(|node| self.at(node.at));
        Some([end(&lane.from)?, end(&lane.to)?])
    }

    fn lanes(&self, svg: &mut Svg, is_open: &impl Fn(usize) -> bool) {
        for (place, lane) in self.graph.lanes.iter().enumerate() {
            let Some([from, to]) = self.ends(place) else { continue };
            let back = self.lanes.get(&(lane.to.as_str(), lane.from.as_str())).copied();
            let is_driven = is_open(place);
            // of two that lead to and fro one line is enough, unless they differ
            if back.is_some_and(|back| back < place && is_open(back) == is_driven) {
                continue;
            }
            let (colour, width, dash) = if is_driven { (GREY, 1.6, "") } else { (CLOSED, 1.6, "3 4") };
            line(svg, from, to, colour, width, dash);
            if back.is_none() {
                arrow(svg, from, to, colour);
            }
        }
    }

    fn route(&self, svg: &mut Svg, route: &[usize], labels: &mut Labels) {
        for [from, to] in route.iter().filter_map(|lane| self.ends(*lane)) {
            line(svg, from, to, ROUTE, 4.0, "");
            labels.take_line(from, to, 8.0, 8.0);
        }
    }

    fn nodes(&self, svg: &mut Svg, labels: &mut Labels) {
        let face = Face { size: 12.0, colour: INK, strong: true, chip: false };
        let small = Face { size: 10.0, colour: GREY, strong: false, chip: false };
        for node in self.here() {
            let (x, y) = self.at(node.at);
            if node.lift.is_some() {
                let block = Block::about(x, y, 9.0, 9.0);
                svg.element("rect")
                    .block(&block)
                    .attr("fill", "#ffffff")
                    .attr("stroke", BRIDGE)
                    .num("stroke-width", 1.6)
                    .end();
            } else {
                let fill = if node.closed { CLOSED } else { "#ffffff" };
                svg.disc((x, y), 3.4, fill, (INK, 1.4));
            }
            labels.take(Block::about(x, y, 8.0, 8.0));
            let (name, face) = node.name.as_ref().map_or((&node.node, small), |name| (name, face));
            let half = text::width(name, face.size) / 2.0 + 9.0;
            let about = [(x, y - 13.0), (x, y + 13.0), (x + half, y), (x - half, y)];
            labels.place(name, face, &self.frame.map, about);
        }
    }
}

/// A head in the middle of a line.
fn arrow(svg: &mut Svg, from: At, to: At, colour: &str) {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let length = dx.hypot(dy);
    if length < 12.0 {
        return;
    }
    let (ux, uy) = (dx / length, dy / length);
    let tip = (f64::midpoint(from.0, to.0) + 4.0 * ux, f64::midpoint(from.1, to.1) + 4.0 * uy);
    for side in [1.0, -1.0] {
        let end = (tip.0 - 7.0 * ux + side * 4.0 * uy, tip.1 - 7.0 * uy - side * 4.0 * ux);
        line(svg, tip, end, colour, 1.6, "");
    }
}
