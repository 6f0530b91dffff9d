//! The route: a line whose colour and dash are its action's, arrows, numbered changes of action, both ends.

use adit_planners::geometry::Point;

use super::doors::triangle;
use super::frame::{At, Block};
use super::labels::Face;
use super::palette::ROUTE;
use super::scene::Route;
use super::sheet::Sheet;
use super::svg::{self, Svg};

/// A route of more points than this keeps labels off only roughly.
const MOST_SAMPLES: f64 = 3000.0;

pub(super) fn way(svg: &mut Svg, sheet: &Sheet) {
    let unit = sheet.unit;
    let whole = path(sheet, sheet.runs.iter().flat_map(|run| &run.points));
    stroke(svg, &whole, "#ffffff", 8.5 * unit, "");
    stroke(svg, &whole, ROUTE, 5.6 * unit, "");
    for run in &sheet.runs {
        let action = run.action.as_deref();
        let (colour, dash) = (sheet.palette.colour(action), sheet.palette.dash(action));
        stroke(svg, &path(sheet, &run.points), colour, 3.0 * unit, dash);
    }
    for (at, direction) in arrows(sheet) {
        triangle(svg, at, direction, 6.5 * unit, ROUTE);
    }
    for run in sheet.runs.iter().filter(|run| run.changed) {
        if let Some(first) = run.points.first() {
            diamond(svg, sheet.frame.at(*first), 6.5 * unit, sheet.palette.colour(run.action.as_deref()));
        }
    }
}

/// The ends with their names, and the numbers of the runs; and no later label on the line.
pub(super) fn marks(svg: &mut Svg, sheet: &mut Sheet, route: &Route) {
    let unit = sheet.unit;
    let (start, goal) = (sheet.frame.at(route.start.at), sheet.frame.at(route.goal.at));
    for ((x, y), fill) in [(start, "#ffffff"), (goal, ROUTE)] {
        svg.disc((x, y), 7.0 * unit, fill, (ROUTE, 2.6 * unit));
        sheet.labels.take(Block::about(x, y, 15.0 * unit, 15.0 * unit));
    }
    keep_free(sheet);
    let face = Face { size: 13.5 * unit, colour: ROUTE, strong: true, chip: false };
    for (name, at) in [(&route.start.name, start), (&route.goal.name, goal)] {
        let (w, _) = super::labels::extent(name, face.size);
        let centres = around(at, w / 2.0 + 11.0 * unit, 16.0 * unit);
        sheet.labels.place(name, face, &sheet.frame.map, centres);
    }
    for (i, run) in sheet.runs.iter().enumerate() {
        let Some(&first) = run.points.first() else { continue };
        let radius = 8.5 * unit;
        let at = sheet.frame.at(first);
        let spots = [17.0, 24.0, 32.0].into_iter().flat_map(|d| around(at, d * unit, d * unit));
        let block = spots
            .map(|(x, y)| Block::about(x, y, 2.0 * radius, 2.0 * radius))
            .find(|block| sheet.frame.map.encloses(block) && sheet.labels.is_free(block));
        if let Some(block) = block {
            let colour = sheet.palette.colour(run.action.as_deref());
            badge(svg, block.centre(), radius, colour, &(i + 1).to_string());
            sheet.labels.take(block);
        }
    }
}

/// Spots around a point, right first.
pub(super) fn around((x, y): At, dx: f64, dy: f64) -> [At; 8] {
    [(1, 0), (-1, 0), (0, -1), (0, 1), (1, -1), (-1, -1), (1, 1), (-1, 1)]
        .map(|(i, j)| (x + f64::from(i) * dx, y + f64::from(j) * dy))
}

/// A numbered disc, the number of a run.
pub(super) fn badge(svg: &mut Svg, (x, y): At, radius: f64, colour: &str, number: &str) {
    svg.disc((x, y), radius, "#ffffff", (colour, radius * 0.3));
    let size = radius * if number.len() < 3 { 1.3 } else { 0.9 };
    svg.element("text")
        .nums([("x", x), ("y", y + size * 0.35), ("font-size", size), ("stroke-width", size * 0.05)])
        .attr("text-anchor", "middle")
        .attr("fill", "#000000")
        .attr("stroke", "#000000")
        .text(number);
}

/// The mark of a change of shape.
pub(super) fn diamond(svg: &mut Svg, (x, y): At, reach: f64, fill: &str) {
    let mut path = String::new();
    svg::round(&mut path, [(x, y - reach), (x + reach, y), (x, y + reach), (x - reach, y)]);
    svg.element("path")
        .attr("d", &path)
        .attr("fill", fill)
        .attr("stroke", ROUTE)
        .num("stroke-width", reach * 0.28)
        .end();
}

fn path<'p>(sheet: &Sheet, points: impl IntoIterator<Item = &'p Point>) -> String {
    let mut points: Vec<At> = points.into_iter().map(|point| sheet.frame.at(*point)).collect();
    points.dedup();
    let mut path = String::new();
    svg::through(&mut path, points);
    path
}

fn stroke(svg: &mut Svg, path: &str, colour: &str, width: f64, dash: &str) {
    if path.is_empty() {
        return;
    }
    svg.element("path")
        .attr("d", path)
        .attr("fill", "none")
        .attr("stroke", colour)
        .attr("stroke-linejoin", "round")
        .attr("stroke-linecap", if dash.is_empty() { "round" } else { "butt" })
        .num("stroke-width", width)
        .dash(dash)
        .end();
}

/// Pieces of the way in the picture: start, end and length.
fn pieces<'s>(sheet: &'s Sheet) -> impl Iterator<Item = (At, At, f64)> + use<'s> {
    let points = sheet.runs.iter().flat_map(|run| run.points.windows(2));
    points.map(|pair| {
        let (a, b) = (sheet.frame.at(pair[0]), sheet.frame.at(pair[1]));
        (a, b, (b.0 - a.0).hypot(b.1 - a.1))
    })
}

/// Arrows in the middle of long pieces, and not closer to each other than the eye needs.
fn arrows(sheet: &Sheet) -> Vec<(At, At)> {
    let apart = 110.0 * sheet.unit;
    let mut arrows = Vec::new();
    let mut since = apart / 2.0;
    for (a, b, length) in pieces(sheet) {
        let count = (length / apart / 1.5).ceil();
        if length >= 26.0 * sheet.unit && since + length / 2.0 >= apart / 2.0 {
            for i in 0..count as usize {
                let share = (i as f64 + 0.5) / count;
                let at = (a.0 + (b.0 - a.0) * share, a.1 + (b.1 - a.1) * share);
                arrows.push((at, (b.0 - a.0, b.1 - a.1)));
            }
            since = length / count / 2.0;
        } else {
            since += length;
        }
    }
    arrows
}

/// Takes the boxes along the line.
fn keep_free(sheet: &mut Sheet) {
    let side = 8.0 * sheet.unit;
    let total: f64 = pieces(sheet).map(|(_, _, length)| length).sum();
    let step = side.max(total / MOST_SAMPLES);
    let found: Vec<(At, At, f64)> = pieces(sheet).collect();
    for (a, b, _) in found {
        sheet.labels.take_line(a, b, side, step);
    }
}
