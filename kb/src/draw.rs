//! The picture of a site: its map, rooms, doors by hardness, a route with its actions, and the paper's Figures
//! 4, 5, 6, 7 and 9 as layers. SVG that stands alone, and PNG from it.
//!
//! What is seen is told by width, dash, number or name as well as by colour, so a print in black and white reads.

mod cell;
mod channels;
mod curves;
mod doors;
mod floor;
mod frame;
mod graph;
mod ground;
mod index;
mod labels;
mod lanes;
mod layers;
mod legend;
mod named;
mod palette;
mod panel;
mod png;
mod primes;
mod rooms;
mod route;
mod runs;
mod scene;
mod sheet;
mod strips;
mod style;
mod svg;
#[cfg(test)]
mod tests;
mod text;
mod view;

pub use cell::{CellPicture, SpacePicture, render_cell};
pub use channels::{ChannelPanel, render_channels};
pub use curves::{Curve, CurvePanel, Scale, render_curves};
pub use floor::render_floor;
pub use lanes::render_lanes;
pub use layers::{Layer, Layers, UnknownLayer};
pub use png::{PngError, render_png};
pub use scene::{ClosedTo, Closing, Door, PrimeArea, Room, Route, Scene, Step, StepKind};
pub use style::Style;

use frame::At;
use panel::Panel;
use sheet::Sheet;
use svg::Svg;

/// Between the parts and around them.
const MARGIN: f64 = 20.0;
/// Width of the side panel at a font of 13.
const PANEL: f64 = 300.0;

/// The scene as a standalone SVG text. The same scene gives the same text.
pub fn render_svg(scene: &Scene, layers: &Layers, style: &Style) -> String {
    let strips = if layers.has(Layer::Strips) { strips::MARGIN } else { 0.0 };
    let title = if scene.title.is_empty() { 0.0 } else { 36.0 };
    let mut sheet = Sheet::new(scene, layers, style, MARGIN + strips, MARGIN + strips + title);
    let map = map(&mut sheet);
    let mut right = sheet.frame.map.x + sheet.frame.map.w + MARGIN;
    let mut below = sheet.frame.map.y + sheet.frame.map.h + MARGIN;
    if layers.has(Layer::Map) {
        below += 14.0 * sheet.unit;
    }
    let mut side = Svg::default();
    if layers.has(Layer::Legend) {
        let font = style.font_px.clamp(4.0, 100.0) * sheet.unit.max(1.0);
        let width = PANEL * font / 13.0;
        let mut panel = Panel { svg: Svg::default(), x: right + 6.0, y: sheet.frame.map.y, width, font };
        legend::legend(&mut panel, &sheet);
        right += width + 6.0 + MARGIN;
        below = below.max(panel.y + MARGIN);
        side = panel.svg;
    }
    page(&scene.title, (right, below), |svg| {
        ground::definitions(svg);
        if title > 0.0 {
            let size = (19.0 * sheet.unit).clamp(15.0, 24.0);
            let words = text::fit(&scene.title, size, right - 2.0 * MARGIN);
            svg.element("text")
                .nums([("x", MARGIN), ("y", MARGIN + 16.0), ("font-size", size), ("stroke-width", 0.5)])
                .attr("fill", palette::INK)
                .attr("stroke", palette::INK)
                .text(&words);
        }
        svg.append(&map);
        svg.group("legend", |svg| svg.append(&side));
    })
}

/// The map with all its layers, labels on top.
fn map(sheet: &mut Sheet) -> Svg {
    let layers = sheet.layers;
    let mut svg = Svg::default();
    let mut top = Svg::default();
    if layers.has(Layer::Map) {
        svg.group("floor", |svg| ground::floor(svg, sheet));
    }
    if layers.has(Layer::Rooms) {
        svg.group("rooms", |svg| rooms::areas(svg, sheet));
    }
    if layers.has(Layer::Map) {
        svg.group("solids", |svg| {
            named::areas(svg, sheet);
            ground::solids(svg, sheet);
            named::doors(svg, sheet);
            named::closings(svg, sheet);
            ground::scale_bar(svg, sheet);
        });
    }
    if layers.has(Layer::Strips) {
        svg.group("strips", |svg| strips::strips(svg, sheet));
    }
    if layers.has(Layer::Primes) {
        svg.group("primes", |svg| primes::outlines(svg, sheet));
    }
    if layers.has(Layer::Doors) {
        svg.group("doors", |svg| doors::crossings(svg, sheet));
    }
    if let Some(route) = sheet.scene.route.as_ref().filter(|_| layers.has(Layer::Route)) {
        svg.group("route", |svg| route::way(svg, sheet));
        top.group("marks", |svg| route::marks(svg, sheet, route));
    }
    // From here on labels take the places that are left, the most needed first.
    if layers.has(Layer::Graph) || layers.has(Layer::Weighted) {
        svg.group("graph", |svg| graph::graph(svg, sheet));
    }
    if layers.has(Layer::Map) {
        svg.group("places", |svg| ground::places(svg, sheet));
        named::names(sheet);
        ground::bridge_heights(sheet);
    }
    if layers.has(Layer::Primes) {
        primes::names(sheet);
    }
    if layers.has(Layer::Rooms) && !layers.has(Layer::Graph) && !layers.has(Layer::Weighted) {
        rooms::names(sheet);
    }
    if layers.has(Layer::Doors) {
        doors::numbers(sheet);
    }
    let labels = std::mem::take(&mut sheet.labels).finish();
    svg.group("labels", |svg| svg.append(&labels));
    svg.append(&top);
    svg
}

/// The document around what `draw` writes.
fn page(title: &str, (width, height): At, draw: impl FnOnce(&mut Svg)) -> String {
    let mut svg = Svg::default();
    svg.element("svg")
        .attr("xmlns", "http://www.w3.org/2000/svg")
        .attr("viewBox", &format!("0 0 {} {}", svg::number(width), svg::number(height)))
        .nums([("width", width), ("height", height)])
        .attr("role", "img")
        .attr("font-family", "Ubuntu, 'Ubuntu Light', 'Segoe UI', 'Helvetica Neue', Arial, sans-serif")
        .children(|svg| {
            svg.element("title").text(title);
            svg.element("rect").nums([("width", width), ("height", height)]).attr("fill", "#ffffff").end();
            draw(svg);
        });
    svg.finish()
}
