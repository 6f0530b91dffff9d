//! A cell: objects, the robot, its path, and its experience; beside it the configuration space, where that is a plane.

use adit_planners::geometry::{Point, Rect};

use super::frame::Frame;
use super::palette::{GREY, INK, ROUTE};
use super::sheet::outline;
use super::svg::{self, Svg};
use super::{MARGIN, page, text};

/// What is drawn of a cell, in metres; what is drawn of its configuration space, in radians or metres.
#[derive(Clone, Debug, Default)]
pub struct CellPicture {
    pub title: String,
    /// Objects by name.
    pub objects: Vec<(String, Vec<Point>)>,
    /// The robot where it begins and at each goal: base and joints.
    pub robots: Vec<Vec<Point>>,
    /// Half the width of its links.
    pub radius_m: f64,
    /// Names of the goals, where the tool is there.
    pub goals: Vec<(String, Point)>,
    /// The tool's way along each path.
    pub paths: Vec<Vec<Point>>,
    /// The tool at each subgoal.
    pub subgoals: Vec<Point>,
    /// The tool's way along each edge.
    pub edges: Vec<Vec<Point>>,
    pub space: Option<SpacePicture>,
}

#[derive(Clone, Debug)]
pub struct SpacePicture {
    pub limits: Rect,
    /// Boxes in which the robot touches something.
    pub taken: Vec<Rect>,
    pub goals: Vec<(String, Point)>,
    pub paths: Vec<Vec<Point>>,
    pub subgoals: Vec<Point>,
    pub edges: Vec<Vec<Point>>,
}

const LONGEST: f64 = 620.0;
const TITLE: f64 = 34.0;
const EDGE: &str = "#3f8fd2";
const SOLID: &str = "#c9ced6";
const LEGEND: &str =
    "objects grey; robot at start and goals; path dark; experience blue: subgoals as dots, edges as lines";

/// The picture as a standalone SVG text. The same picture gives the same text.
pub fn render_cell(picture: &CellPicture) -> String {
    let top = MARGIN + TITLE + 20.0;
    let frame = Frame::new(bounds(picture), LONGEST, MARGIN, top);
    let mut right = frame.map.x + frame.map.w + MARGIN;
    let mut below = frame.map.y + frame.map.h;
    let beside = picture.space.as_ref().map(|space| {
        let frame = Frame::new(space.limits, LONGEST, right + MARGIN, top);
        right = frame.map.x + frame.map.w + MARGIN;
        below = below.max(frame.map.y + frame.map.h);
        (space, frame)
    });
    // A narrow cell leaves room for what is written below it.
    let right = right.max(2.0 * MARGIN + text::width(LEGEND, 12.0));
    page(&picture.title, (right, below + 2.0 * MARGIN), |svg| {
        svg.words((MARGIN, MARGIN + 14.0), 18.0, INK, &text::fit(&picture.title, 18.0, right - 2.0 * MARGIN));
        svg.words((frame.map.x, top - 8.0), 13.0, GREY, "workspace, metres");
        svg.group("workspace", |svg| workspace(svg, picture, &frame));
        if let Some((space, frame)) = beside {
            svg.words((frame.map.x, top - 8.0), 13.0, GREY, "configuration space");
            svg.group("configurations", |svg| configurations(svg, space, &frame));
        }
        svg.words((MARGIN, below + MARGIN), 12.0, GREY, LEGEND);
    })
}

/// All that is drawn, with a little room.
fn bounds(picture: &CellPicture) -> Rect {
    let corners = picture.objects.iter().flat_map(|(_, corners)| corners);
    let lines = picture.robots.iter().chain(&picture.paths).chain(&picture.edges).flatten();
    let points = corners.chain(lines).chain(&picture.subgoals);
    let all = Rect::around(points.copied());
    if all.x0 > all.x1 {
        return Rect::new(-1.0, -1.0, 1.0, 1.0);
    }
    let room = 0.05 * all.dx().max(all.dy()).max(0.1) + picture.radius_m;
    all.grown(room)
}

fn workspace(svg: &mut Svg, picture: &CellPicture, frame: &Frame) {
    border(svg, frame);
    for (_, corners) in &picture.objects {
        let mut path = String::new();
        svg::round(&mut path, corners.iter().map(|at| frame.at(*at)));
        svg.element("path")
            .attr("d", &path)
            .attr("fill", SOLID)
            .attr("stroke", INK)
            .num("stroke-width", 1.2)
            .end();
    }
    experience(svg, &picture.edges, &picture.subgoals, frame);
    let wide = (2.0 * picture.radius_m * frame.scale).max(3.0);
    for (number, joints) in picture.robots.iter().enumerate() {
        let opacity = if number == 0 { "0.3" } else { "0.55" };
        svg.element("path")
            .attr("d", &commands(joints, frame))
            .attr("fill", "none")
            .attr("stroke", "#e8772e")
            .attr("stroke-opacity", opacity)
            .attr("stroke-linecap", "round")
            .attr("stroke-linejoin", "round")
            .num("stroke-width", wide)
            .end();
        for joint in joints {
            dot(svg, *joint, frame, 2.5, INK);
        }
    }
    ways(svg, &picture.paths, frame);
    for (name, corners) in &picture.objects {
        let middle = corners.iter().fold((0.0, 0.0), |sum, p| (sum.0 + p.x, sum.1 + p.y));
        let count = corners.len().max(1) as f64;
        label(svg, Point::new(middle.0 / count, middle.1 / count), frame, name, GREY);
    }
    goals(svg, &picture.goals, frame);
}

fn configurations(svg: &mut Svg, space: &SpacePicture, frame: &Frame) {
    border(svg, frame);
    let mut path = String::new();
    for taken in &space.taken {
        outline(&mut path, &frame.block(taken));
    }
    svg.element("path").attr("d", &path).attr("fill", SOLID).end();
    experience(svg, &space.edges, &space.subgoals, frame);
    ways(svg, &space.paths, frame);
    goals(svg, &space.goals, frame);
}

fn experience(svg: &mut Svg, edges: &[Vec<Point>], subgoals: &[Point], frame: &Frame) {
    for edge in edges {
        line(svg, edge, frame, EDGE, 0.9);
    }
    for subgoal in subgoals {
        dot(svg, *subgoal, frame, 3.0, EDGE);
    }
}

fn ways(svg: &mut Svg, paths: &[Vec<Point>], frame: &Frame) {
    for path in paths {
        line(svg, path, frame, ROUTE, 2.6);
    }
}

fn goals(svg: &mut Svg, goals: &[(String, Point)], frame: &Frame) {
    for (name, at) in goals {
        let (x, y) = frame.at(*at);
        svg.disc((x, y), 5.0, "#ffffff", (ROUTE, 1.8));
        // A name that would leave the frame stands on the other side.
        let wide = text::width(name, 13.0);
        let is_within = x + 8.0 + wide <= frame.map.x + frame.map.w;
        let left = if is_within { x + 8.0 } else { x - 8.0 - wide };
        svg.words((left, y - 6.0), 13.0, ROUTE, name);
    }
}

fn border(svg: &mut Svg, frame: &Frame) {
    svg.element("rect")
        .block(&frame.map)
        .num("stroke-width", 1.0)
        .attr("fill", "#fbfcfd")
        .attr("stroke", GREY)
        .end();
}

fn commands(points: &[Point], frame: &Frame) -> String {
    let mut path = String::new();
    svg::through(&mut path, points.iter().map(|at| frame.at(*at)));
    path
}

fn line(svg: &mut Svg, points: &[Point], frame: &Frame, colour: &str, width: f64) {
    svg.element("path")
        .attr("d", &commands(points, frame))
        .attr("fill", "none")
        .attr("stroke", colour)
        .attr("stroke-linejoin", "round")
        .num("stroke-width", width)
        .end();
}

fn dot(svg: &mut Svg, at: Point, frame: &Frame, radius: f64, colour: &str) {
    let (x, y) = frame.at(at);
    svg.element("circle").nums([("cx", x), ("cy", y), ("r", radius)]).attr("fill", colour).end();
}

fn label(svg: &mut Svg, at: Point, frame: &Frame, words: &str, colour: &str) {
    let (x, y) = frame.at(at);
    let size = 12.0;
    svg.words((x - text::width(words, size) / 2.0, y + 4.0), size, colour, words);
}
