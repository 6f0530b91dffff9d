//! What people call by a name: areas as tinted outlines, doors as thick lines from post to post.

use adit_planners::geometry::Point;

use super::labels::Face;
use super::sheet::{Sheet, line, shape_of};
use super::svg::Svg;

const AREA: &str = "#0b7285";
const DOOR: &str = "#a61e4d";

/// Named areas, over rooms and under walls.
pub(super) fn areas(svg: &mut Svg, sheet: &Sheet) {
    for area in &sheet.scene.areas {
        let mut path = String::new();
        shape_of(&mut path, &sheet.frame, &area.shape);
        svg.element("path")
            .attr("d", &path)
            .attr("fill", AREA)
            .attr("fill-opacity", "0.16")
            .attr("stroke", AREA)
            .attr("stroke-dasharray", "5 3")
            .num("stroke-width", 1.4 * sheet.unit)
            .end();
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
