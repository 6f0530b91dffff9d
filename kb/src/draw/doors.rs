//! Doors: the line where one crosses, coloured and wide by hardness; numbers; a cross where nobody passes.

use super::frame::At;
use super::labels::Face;
use super::palette::{CLOSED, INK, Scale};
use super::scene::Door;
use super::sheet::{Across, Sheet, cross, line};
use super::svg::{self, Svg};

/// Above so many doors their numbers would be a carpet: only those of the route are written.
const MOST_NUMBERS: usize = 450;

/// The crossings, the hard ones on top.
pub(super) fn crossings(svg: &mut Svg, sheet: &Sheet) {
    let mut doors: Vec<&Door> = sheet.view.doors.iter().map(|&i| &sheet.scene.doors[i]).collect();
    doors.sort_by_key(|door| (door.passable, sheet.class(door)));
    for door in doors {
        let across = sheet.across(door);
        // A point would have no line: give it some extent.
        let reach = (across.length / 2.0).max(1.0);
        let (from, to) = (across.at(-reach, 0.0), across.at(reach, 0.0));
        if door.passable {
            let class = sheet.class(door);
            line(svg, from, to, Scale::colour(class), Scale::width(class) * sheet.detail, "");
            if door.one_way {
                arrow(svg, sheet, door, across.centre);
            }
        } else {
            line(svg, from, to, CLOSED, 2.0 * sheet.detail, "3 3");
            cross(svg, across.centre, 5.0 * sheet.unit * sheet.detail.max(0.6));
        }
    }
}

/// Numbers beside the crossings, those of the route first.
pub(super) fn numbers(sheet: &mut Sheet) {
    let few = sheet.view.doors.len() <= MOST_NUMBERS;
    let used = |sheet: &Sheet, i: usize| sheet.view.route_doors.contains(&i);
    let mut doors: Vec<usize> = sheet.view.doors.iter().copied().filter(|&i| few || used(sheet, i)).collect();
    doors.sort_by_key(|&i| !used(sheet, i));
    let size = (11.0 * sheet.unit * sheet.detail.sqrt()).max(7.0);
    for i in doors {
        let door = &sheet.scene.doors[i];
        let across = sheet.across(door);
        if used(sheet, i) || across.length >= 6.0 {
            let face = Face { size, colour: INK, strong: false, chip: false };
            let content = door.number.to_string();
            let centres = beside(&across, super::labels::extent(&content, size));
            sheet.labels.place(&content, face, &sheet.frame.map, centres);
        }
    }
}

/// Spots beside a crossing for what is so wide and high, near its middle first.
fn beside(across: &Across, (w, h): At) -> Vec<At> {
    let (x, y) = across.beside();
    let away = f64::midpoint(x.abs() * w, y.abs() * h) + 3.0;
    let shifts = [0.0, 0.15, -0.15, 0.3, -0.3, 0.45, -0.45];
    let spot = |shift: f64, side: f64| across.at(shift * across.length, side * away);
    shifts.iter().flat_map(|&shift| [spot(shift, 1.0), spot(shift, -1.0)]).collect()
}

/// A triangle from the first room to the second.
fn arrow(svg: &mut Svg, sheet: &Sheet, door: &Door, (x, y): At) {
    let centre = |i: usize| sheet.scene.rooms.get(i).map(|room| sheet.frame.at(room.outline.centre()));
    if let (Some(from), Some(to)) = (centre(door.room1), centre(door.room2)) {
        triangle(svg, (x, y), (to.0 - from.0, to.1 - from.1), 6.0 * sheet.unit, INK);
    }
}

/// A filled triangle about a point, pointing along a direction; nothing where that has no length.
pub(super) fn triangle(svg: &mut Svg, (x, y): At, (dx, dy): At, size: f64, fill: &str) {
    let length = dx.hypot(dy);
    if !(length.is_finite() && length > 0.0) {
        return;
    }
    let (ux, uy) = (dx / length * size, dy / length * size);
    let mut path = String::new();
    let (back_x, back_y) = (x - 0.7 * ux, y - 0.7 * uy);
    let sides = [(-0.75 * uy, 0.75 * ux), (0.75 * uy, -0.75 * ux)].map(|(dx, dy)| (back_x + dx, back_y + dy));
    svg::round(&mut path, [(x + ux, y + uy), sides[0], sides[1]]);
    svg.element("path")
        .attr("d", &path)
        .attr("fill", fill)
        .attr("stroke", "#ffffff")
        .num("stroke-width", 1.0)
        .end();
}
