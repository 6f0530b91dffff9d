//! Figures 7 and 9: rooms as nodes, doors as edges, with their numbers or their hardness.

use super::frame::{At, Block};
use super::labels::Face;
use super::layers::Layer;
use super::palette::{CLOSED, INK, Scale};
use super::scene::Door;
use super::sheet::{Sheet, cross, line};
use super::svg::Svg;
use super::{rooms, text};

/// Above so many edges only the nodes' names are written.
const MOST_LABELS: usize = 900;

/// Edges, bent at the door so that they never cross a wall, and nodes.
pub(super) fn graph(svg: &mut Svg, sheet: &mut Sheet) {
    edges(svg, sheet);
    nodes(svg, sheet);
    if sheet.view.doors.len() <= MOST_LABELS {
        labels(sheet);
        keep_free(sheet);
    }
}

fn edges(svg: &mut Svg, sheet: &mut Sheet) {
    let weighted = sheet.layers.has(Layer::Weighted);
    let scene = sheet.scene;
    for door in sheet.view.doors.clone().into_iter().map(|i| &scene.doors[i]) {
        let Some((from, middle, to)) = edge(sheet, door) else { continue };
        let class = sheet.class(door);
        let (colour, width, dash) = match (door.passable, weighted) {
            (false, _) => (CLOSED, 1.6, "4 4"),
            (true, true) => (Scale::colour(class), Scale::width(class), ""),
            (true, false) => (INK, 1.8, ""),
        };
        line(svg, from, middle, colour, width * sheet.detail, dash);
        line(svg, middle, to, colour, width * sheet.detail, dash);
        if !door.passable {
            let reach = 5.0 * sheet.unit * sheet.detail;
            cross(svg, middle, reach);
            sheet.labels.take(Block::about(middle.0, middle.1, 2.0 * reach, 2.0 * reach));
        } else if door.one_way {
            let at = (middle.0 + (to.0 - middle.0) * 0.2, middle.1 + (to.1 - middle.1) * 0.2);
            super::doors::triangle(svg, at, (to.0 - middle.0, to.1 - middle.1), 6.0 * sheet.unit, INK);
        }
    }
}

fn nodes(svg: &mut Svg, sheet: &mut Sheet) {
    for &i in &sheet.view.rooms {
        let room = &sheet.scene.rooms[i];
        let block = rooms::inner(sheet, &room.outline);
        let (x, y) = block.centre();
        let radius = (block.w.min(block.h) * 0.42).min(16.0 * sheet.unit).max(2.0);
        svg.disc((x, y), radius, "#ffffff", (INK, (radius / 8.0).min(1.6)));
        let disc = Block::about(x, y, 1.7 * radius, 1.7 * radius);
        let size = rooms::size_for(&room.name, &disc).min(15.0 * sheet.unit);
        if size >= 5.5 {
            let face = Face { size, colour: INK, strong: true, chip: false };
            sheet.labels.place(&room.name, face, &disc, [(x, y)]);
        }
        sheet.labels.take(Block::about(x, y, 2.0 * radius, 2.0 * radius));
    }
}

fn labels(sheet: &mut Sheet) {
    let size = (12.5 * sheet.unit * sheet.detail).max(7.0);
    let face = Face { size, colour: INK, strong: false, chip: true };
    for &i in &sheet.view.doors {
        let door = &sheet.scene.doors[i];
        let Some((from, middle, to)) = edge(sheet, door) else { continue };
        let number = sheet.layers.has(Layer::Graph).then(|| door.number.to_string());
        let weight = door.hardness.filter(|_| sheet.layers.has(Layer::Weighted)).map(text::figure);
        let content: Vec<String> = number.into_iter().chain(weight).collect();
        let content = content.join(" · ");
        if content.is_empty() {
            continue;
        }
        let away = |to: At| (to.0 - middle.0).hypot(to.1 - middle.1);
        let (long, short) = if away(from) >= away(to) { (from, to) } else { (to, from) };
        let spots = along(middle, long).chain(along(middle, short));
        sheet.labels.place(&content, face, &sheet.frame.map, spots);
    }
}

/// Keeps later labels off the edges.
fn keep_free(sheet: &mut Sheet) {
    let scene = sheet.scene;
    for door in sheet.view.doors.clone().into_iter().map(|i| &scene.doors[i]) {
        if let Some((from, middle, to)) = edge(sheet, door) {
            sheet.labels.take_line(from, middle, 5.0, 8.0);
            sheet.labels.take_line(middle, to, 5.0, 8.0);
        }
    }
}

/// Spots on an edge's leg, its middle first.
fn along(a: At, b: At) -> impl Iterator<Item = At> {
    [0.5, 0.35, 0.65, 0.25].into_iter().map(move |t| (a.0 + (b.0 - a.0) * t, a.1 + (b.1 - a.1) * t))
}

/// An edge's three points: first room, door, second room.
fn edge(sheet: &Sheet, door: &Door) -> Option<(At, At, At)> {
    let node = |i: usize| sheet.scene.rooms.get(i).map(|room| sheet.frame.at(room.outline.centre()));
    Some((node(door.room1)?, sheet.across(door).centre, node(door.room2)?))
}
