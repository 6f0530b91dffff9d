//! A robot in corridors, as in Lee's Figure 8.

use adit_planners::channels::corridor::{Primitive, Robot, Turn};
use adit_planners::geometry::Point;

use super::panel::DrivePicture;
use super::{ground, marks};
use crate::draw::frame::Frame;
use crate::draw::palette::{BRIDGE, GREY, INK, ROUTE};
use crate::draw::sheet::line;
use crate::draw::svg::{self, Svg};

/// Where the robot is, and its heading in radians, counter-clockwise from the x axis.
struct Pose {
    at: Point,
    heading: f64,
}

pub(super) fn draw(svg: &mut Svg, picture: &DrivePicture, frame: &Frame) {
    ground::walls(svg, frame, &picture.channels, None);
    for wall in &picture.walls {
        line(svg, frame.at(wall.a), frame.at(wall.b), INK, 1.8, "");
    }
    let drive = picture.drive.as_ref();
    let corners: Vec<Point> =
        drive.iter().flat_map(|(_, drive)| &drive.turns).map(|turn| turn.corner).collect();
    ground::closed(svg, frame, &picture.closed);
    ground::channels(svg, frame, &[], &picture.junctions, &corners);
    for (at, label) in &picture.labels {
        let (x, y) = frame.at(*at);
        svg.words((x + 4.0, y + 4.0), 12.0, GREY, label);
    }
    let Some((robot, drive)) = drive else { return };
    for turn in &drive.turns {
        circle(svg, frame, turn.corner, turn.radius);
    }
    for pose in poses(&drive.primitives, 1.2 * robot.length) {
        body(svg, frame, *robot, &pose);
    }
    svg.element("path")
        .attr("d", &way(&drive.primitives, frame))
        .attr("fill", "none")
        .attr("stroke", ROUTE)
        .num("stroke-width", 2.2)
        .end();
    let ends = drive.primitives.first().zip(drive.primitives.last());
    if let Some((first, last)) = ends {
        marks::dot(svg, frame.at(pose(first, 0.0).at), true);
        marks::dot(svg, frame.at(pose(last, 1.0).at), false);
    }
    for (place, turn) in drive.turns.iter().enumerate() {
        marks::number(svg, frame.at(turn.corner), place + 1);
    }
}

/// The guiding circle.
fn circle(svg: &mut Svg, frame: &Frame, corner: Point, radius: f64) {
    let (x, y) = frame.at(corner);
    svg.element("circle")
        .nums([("cx", x), ("cy", y), ("r", radius * frame.scale), ("stroke-width", 1.2)])
        .attr("fill", "none")
        .attr("stroke", BRIDGE)
        .attr("stroke-dasharray", "4 3")
        .end();
}

/// The robot's outline, with an arrow head at its front.
fn body(svg: &mut Svg, frame: &Frame, robot: Robot, pose: &Pose) {
    let (sin, cos) = pose.heading.sin_cos();
    let at = |forward: f64, left: f64| {
        frame.at(Point::new(pose.at.x + forward * cos - left * sin, pose.at.y + forward * sin + left * cos))
    };
    let (ahead, aside) = (robot.length / 2.0, robot.width / 2.0);
    let corners = [at(ahead, aside), at(ahead, -aside), at(-ahead, -aside), at(-ahead, aside)];
    let mut path = String::new();
    svg::round(&mut path, corners);
    svg.element("path")
        .attr("d", &path)
        .attr("fill", ROUTE)
        .attr("fill-opacity", "0.06")
        .attr("stroke", ROUTE)
        .nums([("stroke-width", 1.0), ("stroke-opacity", 0.75)])
        .end();
    let nose = [at(0.6 * ahead, 0.5 * aside), at(0.95 * ahead, 0.0), at(0.6 * ahead, -0.5 * aside)];
    let mut path = String::new();
    svg::through(&mut path, nose);
    svg.element("path").attr("d", &path).attr("fill", ROUTE).attr("fill-opacity", "0.75").end();
}

/// Where the robot is at start and goal, and at equal steps of about `step` metres between.
fn poses(primitives: &[Primitive], step: f64) -> Vec<Pose> {
    let total: f64 = primitives.iter().map(Primitive::length).sum();
    let count = (total / step).ceil().clamp(1.0, 2_000.0);
    let mut poses = Vec::new();
    let mut before = 0.0;
    for (index, primitive) in primitives.iter().enumerate() {
        let length = primitive.length();
        let is_last = index + 1 == primitives.len();
        while poses.len() as f64 <= count {
            let along = poses.len() as f64 * total / count - before;
            if along > length && !is_last {
                break;
            }
            let share = if length > 0.0 { (along / length).clamp(0.0, 1.0) } else { 1.0 };
            poses.push(pose(primitive, share));
        }
        before += length;
    }
    poses
}

fn pose(primitive: &Primitive, share: f64) -> Pose {
    let between = |from: f64, to: f64| from + share * (to - from);
    match *primitive {
        Primitive::Line { a, b, from_heading, to_heading, .. } => Pose {
            at: Point::new(between(a.x, b.x), between(a.y, b.y)),
            heading: between(from_heading, to_heading),
        },
        Primitive::Arc { centre, a, from_heading, to_heading, .. } => {
            let heading = between(from_heading, to_heading);
            let (sin, cos) = (heading - from_heading).sin_cos();
            let (dx, dy) = (a.x - centre.x, a.y - centre.y);
            Pose { at: Point::new(centre.x + dx * cos - dy * sin, centre.y + dx * sin + dy * cos), heading }
        }
    }
}

/// The path of the robot's middle.
fn way(primitives: &[Primitive], frame: &Frame) -> String {
    let mut path = String::new();
    for primitive in primitives {
        let (Primitive::Line { a, b, .. } | Primitive::Arc { a, b, .. }) = primitive;
        let ((x, y), (to_x, to_y)) = (frame.at(*a), frame.at(*b));
        if path.is_empty() {
            svg::command(&mut path, 'M', &[x, y]);
        }
        match primitive {
            Primitive::Line { .. } => svg::command(&mut path, 'L', &[to_x, to_y]),
            Primitive::Arc { radius, turn, .. } => {
                let radius = radius * frame.scale;
                // Less than half a circle; the sense as it is seen, y down.
                let clockwise = if *turn == Turn::Right { 1.0 } else { 0.0 };
                svg::command(&mut path, 'A', &[radius, radius, 0.0, 0.0, clockwise, to_x, to_y]);
            }
        }
    }
    path
}
