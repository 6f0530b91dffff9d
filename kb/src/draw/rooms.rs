//! Rooms: tinted by action, outlined, named where the name fits (Figure 6).

use adit_planners::geometry::{Convex, Segment, cross};

use super::frame::{At, Block};
use super::labels::Face;
use super::palette::GREY;
use super::sheet::{Sheet, room_of};
use super::svg::Svg;
use super::text;

/// Names smaller than this are left out.
const LEAST_SIZE: f64 = 6.5;

/// Fills and outlines: one path for each action, since rooms may be thousands.
pub(super) fn areas(svg: &mut Svg, sheet: &Sheet) {
    let mut paths: Vec<(&str, String)> = Vec::new();
    for &i in &sheet.view.rooms {
        let room = &sheet.scene.rooms[i];
        let colour = sheet.palette.colour(room.action.as_deref());
        let at = paths.iter().position(|(c, _)| *c == colour).unwrap_or_else(|| {
            paths.push((colour, String::new()));
            paths.len() - 1
        });
        room_of(&mut paths[at].1, &sheet.frame, &room.outline);
    }
    for (colour, path) in paths {
        svg.element("path")
            .attr("d", &path)
            .attr("fill", colour)
            .attr("fill-opacity", "0.11")
            .attr("stroke", "#a7aeb9")
            .num("stroke-width", 0.9 * sheet.detail)
            .end();
    }
    for &i in &sheet.view.route_rooms {
        let room = &sheet.scene.rooms[i];
        let colour = sheet.palette.colour(room.action.as_deref());
        let mut path = String::new();
        room_of(&mut path, &sheet.frame, &room.outline);
        svg.element("path")
            .attr("d", &path)
            .attr("fill", colour)
            .attr("fill-opacity", "0.22")
            .attr("stroke", colour)
            .attr("stroke-dasharray", "3 2")
            .num("stroke-width", 1.0)
            .end();
    }
}

/// Names, the route's rooms first.
pub(super) fn names(sheet: &mut Sheet) {
    let rooms: Vec<usize> = sheet.view.route_rooms.iter().chain(&sheet.view.rooms).copied().collect();
    for i in rooms {
        let room = &sheet.scene.rooms[i];
        let block = inner(sheet, &room.outline);
        let size = size_for(&room.name, &block).min(15.0 * sheet.unit);
        if size >= LEAST_SIZE {
            let face = Face { size, colour: GREY, strong: false, chip: false };
            sheet.labels.place(&room.name, face, &block, spots(&block));
        }
    }
}

/// The box in which a room's name may stand: about its centre, of the shape of the box about it.
pub(super) fn inner(sheet: &Sheet, outline: &Convex) -> Block {
    let about = sheet.frame.block(&outline.bounds());
    if outline.rect().is_some() {
        return about;
    }
    let (bounds, centre) = (outline.bounds(), outline.centre());
    let share = |side: Segment| {
        let way = side.b - side.a;
        2.0 * cross(side.a, side.b, centre) / (way.y.abs() * bounds.dx() + way.x.abs() * bounds.dy())
    };
    let share = outline.sides().map(share).fold(1.0, f64::min).max(0.0);
    let (x, y) = sheet.frame.at(centre);
    Block::about(x, y, about.w * share, about.h * share)
}

/// The font size at which a text fills its room decently.
pub(super) fn size_for(name: &str, block: &Block) -> f64 {
    (block.h * 0.5).min(block.w * 0.85 / text::width(name, 1.0).max(0.1))
}

/// Where in a room a name may stand: the middle, else beside it.
fn spots(block: &Block) -> Vec<At> {
    let (x, y) = block.centre();
    let mut spots = vec![(x, y)];
    for share in [0.18, 0.3, 0.4] {
        let (dx, dy) = (block.w * share, block.h * share);
        spots.extend([(x, y + dy), (x, y - dy), (x + dx, y), (x - dx, y)]);
        spots.extend([(x + dx, y + dy), (x - dx, y - dy), (x + dx, y - dy), (x - dx, y + dy)]);
    }
    spots
}
