//! Errors over the distance driven: curves in panels side by side, on a logarithmic scale.

use super::frame::Block;
use super::palette::{BRIDGE, GREY, INK, ROUTE};
use super::sheet::line;
use super::svg::{self, Svg};
use super::{MARGIN, page, text};
use crate::number::number;

/// A panel's inside.
const WIDTH: f64 = 440.0;
const HEIGHT: f64 = 220.0;
/// Left of a panel for figures, above it for its heading.
const LEFT: f64 = 62.0;
const ABOVE: f64 = 30.0;
const BELOW: f64 = 34.0;
const TITLE: f64 = 34.0;

/// Curves over a distance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurvePanel {
    /// What is shown, and of what.
    pub heading: String,
    /// The unit of the errors.
    pub unit: &'static str,
    /// The scale: its least and its greatest value, both powers of ten.
    pub scale: [f64; 2],
    /// A value that is to be kept, drawn across.
    pub limit: f64,
    /// The distance that is the width, metres.
    pub far_m: f64,
    /// What counts: distance and error.
    pub bold: Vec<Vec<(f64, f64)>>,
    /// What it is compared with.
    pub faint: Vec<Vec<(f64, f64)>>,
}

/// Panels in rows of two under a title, and what lines mean below, as a standalone SVG text.
pub fn render_curves(title: &str, legend: [&str; 2], panels: &[CurvePanel]) -> String {
    let (column, row) = (LEFT + WIDTH + MARGIN, ABOVE + HEIGHT + BELOW);
    let mut svg = Svg::default();
    for (place, panel) in panels.iter().enumerate() {
        let (x, y) = (MARGIN + (place % 2) as f64 * column, MARGIN + TITLE + (place / 2) as f64 * row);
        draw(&mut svg, panel, Block { x: x + LEFT, y: y + ABOVE, w: WIDTH, h: HEIGHT });
    }
    let columns = panels.len().clamp(1, 2) as f64;
    let below = MARGIN + TITLE + panels.len().div_ceil(2) as f64 * row;
    let right = MARGIN + columns * column;
    page(title, (right, below + 2.0 * MARGIN), |page| {
        let size = |size: f64| (size, "start");
        write(page, (MARGIN, MARGIN + 14.0), size(18.0), INK, &text::fit(title, 18.0, right - 2.0 * MARGIN));
        page.append(&svg);
        let mut x = MARGIN + LEFT;
        for (words, (colour, width, dash)) in legend.into_iter().zip([BOLD, FAINT]) {
            line(page, (x, below + 9.0), (x + 34.0, below + 9.0), colour, 2.0 * width, dash);
            write(page, (x + 42.0, below + 13.0), size(13.0), GREY, words);
            x += 42.0 + text::width(words, 13.0) + 2.0 * MARGIN;
        }
    })
}

/// Colour, width and dash.
type Pen = (&'static str, f64, &'static str);
const BOLD: Pen = (ROUTE, 1.3, "");
const FAINT: Pen = (BRIDGE, 1.0, "5 3");

fn draw(svg: &mut Svg, panel: &CurvePanel, inside: Block) {
    let [least, most] = panel.scale.map(f64::log10);
    let y = |value: f64| {
        let share = (value.max(1e-12).log10().clamp(least, most) - least) / (most - least);
        inside.y + inside.h * (1.0 - share)
    };
    let x = |metres: f64| inside.x + inside.w * (metres / panel.far_m.max(1e-9)).min(1.0);
    let right = inside.x + inside.w;
    write(svg, (inside.x, inside.y - 10.0), (14.0, "start"), INK, &panel.heading);
    for power in least.round() as i32..=most.round() as i32 {
        let value = 10.0_f64.powi(power);
        line(svg, (inside.x, y(value)), (right, y(value)), "#d8dce2", 1.0, "");
        let figure = format!("{} {}", number(value), panel.unit);
        write(svg, (inside.x - 8.0, y(value) + 4.0), (12.0, "end"), GREY, &figure);
    }
    for fifth in 0..=5 {
        let metres = panel.far_m * f64::from(fifth) / 5.0;
        line(svg, (x(metres), inside.y + inside.h), (x(metres), inside.y + inside.h + 5.0), GREY, 1.0, "");
        let figure = format!("{} m", number(metres));
        write(svg, (x(metres), inside.y + inside.h + 19.0), (12.0, "middle"), GREY, &figure);
    }
    for (curves, pen) in [(&panel.faint, FAINT), (&panel.bold, BOLD)] {
        for curve in curves {
            polyline(svg, curve.iter().map(|&(metres, value)| (x(metres), y(value))), pen);
        }
    }
    line(svg, (inside.x, y(panel.limit)), (right, y(panel.limit)), "#d0342c", 1.2, "2 3");
    let words = format!("{} {}", number(panel.limit), panel.unit);
    write(svg, (right - 4.0, y(panel.limit) - 5.0), (12.0, "end"), "#d0342c", &words);
}

fn polyline(svg: &mut Svg, points: impl Iterator<Item = (f64, f64)>, (colour, width, dash): Pen) {
    let points: Vec<String> = points.map(|(x, y)| format!("{},{}", svg::number(x), svg::number(y))).collect();
    let element = svg
        .element("polyline")
        .attr("points", &points.join(" "))
        .attr("fill", "none")
        .attr("stroke", colour)
        .num("stroke-width", width);
    let element = if dash.is_empty() { element } else { element.attr("stroke-dasharray", dash) };
    element.end();
}

fn write(svg: &mut Svg, (x, y): (f64, f64), (size, anchor): (f64, &str), colour: &str, words: &str) {
    svg.element("text")
        .nums([("x", x), ("y", y), ("font-size", size)])
        .attr("text-anchor", anchor)
        .attr("fill", colour)
        .text(words);
}
