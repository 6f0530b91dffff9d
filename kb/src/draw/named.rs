//! What people call by a name: areas as tinted outlines, doors as thick lines from post to post.

use std::collections::BTreeSet;

use adit_planners::geometry::Point;

use super::frame::At;
use super::labels::Face;
use super::panel::Panel;
use super::scene::{ClosedTo, Closing, Scene};
use super::sheet::{Sheet, line, shape_of};
use super::svg::Svg;

const AREA: &str = "#0b7285";
const DOOR: &str = "#a61e4d";
const SHUT: &str = "#c1121f";

/// How areas of a kind are filled, by the kind's place in the order of names: its tint, and the angles of its hatching.
const FILLS: [(&str, &[i32]); 4] = [("0.16", &[]), ("0.05", &[45]), ("0.05", &[45, 135]), ("0.05", &[0])];

/// The kinds of the scene's areas, in the order of their names.
fn kinds(scene: &Scene) -> Vec<&str> {
    let kinds: BTreeSet<&str> = scene.areas.iter().filter_map(|area| area.kind.as_deref()).collect();
    kinds.into_iter().collect()
}

/// Named areas, over rooms and under walls: each kind has a filling of its own.
pub(super) fn areas(svg: &mut Svg, sheet: &Sheet) {
    let kinds = kinds(sheet.scene);
    for area in &sheet.scene.areas {
        let mut path = String::new();
        shape_of(&mut path, &sheet.frame, &area.shape);
        let kind = kinds.iter().position(|kind| Some(*kind) == area.kind.as_deref());
        filled(svg, kind.unwrap_or_default(), &path, sheet.unit);
    }
}

/// A path filled as its kind is.
fn filled(svg: &mut Svg, kind: usize, path: &str, unit: f64) {
    let (tint, angles) = FILLS[kind % FILLS.len()];
    svg.element("path")
        .attr("d", path)
        .attr("fill", AREA)
        .attr("fill-opacity", tint)
        .attr("stroke", AREA)
        .attr("stroke-dasharray", "5 3")
        .num("stroke-width", 1.4 * unit)
        .end();
    for angle in angles {
        let hatch = format!("url(#hatch-{angle})");
        svg.element("path").attr("d", path).attr("fill", &hatch).attr("fill-opacity", "0.5").end();
    }
}

/// The hatchings of areas.
pub(super) fn definitions(svg: &mut Svg) {
    for angle in [0, 45, 135] {
        svg.element("pattern")
            .attr("id", &format!("hatch-{angle}"))
            .attr("patternUnits", "userSpaceOnUse")
            .attr("patternTransform", &format!("rotate({angle})"))
            .nums([("width", 8.0), ("height", 8.0)])
            .children(|svg| line(svg, (0.0, 0.0), (0.0, 8.0), AREA, 2.0, ""));
    }
}

/// What the fillings mean, a line a kind.
pub(super) fn legend(panel: &mut Panel, sheet: &Sheet) {
    let indent = 44.0 * panel.font / 13.0;
    for (number, kind) in kinds(sheet.scene).into_iter().enumerate() {
        panel.line(indent, kind, "", |svg, (x, y)| {
            let (x1, y0, y1) = (x + 0.8 * indent, y - 6.0, y + 6.0);
            let path = format!("M{x:.2} {y0:.2}H{x1:.2}V{y1:.2}H{x:.2}Z");
            filled(svg, number, &path, 1.0);
        });
    }
    let closed = [
        (ClosedTo::All, "closed"),
        (ClosedTo::SomeRobots, "closed to some robots"),
        (ClosedTo::OneSide, "open one way"),
    ];
    for (to_whom, words) in closed {
        if sheet.scene.closings.iter().any(|closing| closing.to_whom == to_whom) {
            panel.line(indent, words, "", |svg, (x, y)| {
                barred(svg, ((x, y), (x + 0.8 * indent, y)), to_whom, 1.0);
            });
        }
    }
}

/// What is closed: a line from end to end, and the sign that people know in its middle; an arrow where it is open one way.
pub(super) fn closings(svg: &mut Svg, sheet: &Sheet) {
    for Closing { from, to, to_whom } in &sheet.scene.closings {
        barred(svg, (sheet.frame.at(*from), sheet.frame.at(*to)), *to_whom, sheet.unit);
    }
}

fn barred(svg: &mut Svg, (from, to): (At, At), to_whom: ClosedTo, unit: f64) {
    if to_whom == ClosedTo::OneSide {
        return open_to_left(svg, (from, to), unit);
    }
    let is_for_all = to_whom == ClosedTo::All;
    let dash = if is_for_all { "" } else { "6 4" };
    line(svg, from, to, SHUT, 4.0 * unit, dash);
    let (x, y) = (f64::midpoint(from.0, to.0), f64::midpoint(from.1, to.1));
    let fill = if is_for_all { SHUT } else { "#ffffff" };
    svg.disc((x, y), 7.0 * unit, fill, (SHUT, 1.6 * unit));
    let bar = if is_for_all { "#ffffff" } else { SHUT };
    line(svg, (x - 4.0 * unit, y), (x + 4.0 * unit, y), bar, 2.4 * unit, "");
}

/// A line that is crossed from its right to its left in the map, whose y axis goes up.
fn open_to_left(svg: &mut Svg, (from, to): (At, At), unit: f64) {
    line(svg, from, to, SHUT, 2.0 * unit, "2 3");
    let (x, y) = (f64::midpoint(from.0, to.0), f64::midpoint(from.1, to.1));
    let length = (to.0 - from.0).hypot(to.1 - from.1).max(f64::MIN_POSITIVE);
    let (along, ahead) = (((to.0 - from.0) / length, (to.1 - from.1) / length), 11.0 * unit);
    // on paper y goes down: what lies to the left in the map does so here as well
    let point = |ahead: f64, aside: f64| {
        (x + along.1 * ahead + along.0 * aside, y - along.0 * ahead + along.1 * aside)
    };
    line(svg, point(-ahead, 0.0), point(ahead, 0.0), SHUT, 2.4 * unit, "");
    for aside in [-5.0 * unit, 5.0 * unit] {
        line(svg, point(ahead, 0.0), point(ahead - 6.0 * unit, aside), SHUT, 2.4 * unit, "");
    }
}

pub(super) fn doors(svg: &mut Svg, sheet: &Sheet) {
    for door in &sheet.scene.named_doors {
        let (from, to) = (sheet.frame.at(door.from), sheet.frame.at(door.to));
        line(svg, from, to, DOOR, 4.0 * sheet.unit, "");
    }
}

pub(super) fn names(sheet: &mut Sheet) {
    let size = 11.0 * sheet.unit;
    let middle = |a: Point, b: Point| Point::new(f64::midpoint(a.x, b.x), f64::midpoint(a.y, b.y));
    let areas = sheet.scene.areas.iter().map(|area| (area.name.clone(), area.centre, AREA, true));
    let doors = sheet.scene.named_doors.iter();
    let doors = doors.map(|door| (door.name.clone(), middle(door.from, door.to), DOOR, false));
    let names: Vec<(String, Point, &str, bool)> = areas.chain(doors).collect();
    for (name, at, colour, inside) in names {
        let face = Face { size, colour, strong: true, chip: false };
        let (x, y) = sheet.frame.at(at);
        let (w, _) = super::labels::extent(&name, size);
        let mut centres = if inside { vec![(x, y)] } else { Vec::new() };
        centres.extend(super::route::around((x, y), w / 2.0 + 6.0 * sheet.unit, size));
        sheet.labels.place(&name, face, &sheet.frame.map, centres);
    }
}
