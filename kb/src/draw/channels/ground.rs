//! Walls and free space.

use adit_planners::geometry::{Point, Rect};

use crate::draw::frame::{At, Block, Frame};
use crate::draw::palette::{GREY, INK};
use crate::draw::sheet::{line, outline};
use crate::draw::svg::Svg;

/// Patterns that panels refer to.
pub(super) fn definitions(svg: &mut Svg) {
    svg.element("defs").children(|svg| {
        svg.element("pattern")
            .attr("id", "wall")
            .attr("patternUnits", "userSpaceOnUse")
            .attr("patternTransform", "rotate(45)")
            .nums([("width", 6.0), ("height", 6.0)])
            .children(|svg| {
                svg.element("rect").nums([("width", 6.0), ("height", 6.0)]).attr("fill", "#e9ebef").end();
                line(svg, (0.0, 0.0), (0.0, 6.0), "#a9afb9", 1.4, "");
            });
    });
}

/// The panel's box, as what all within it is cut to.
pub(super) fn clip(svg: &mut Svg, id: &str, frame: &Frame) {
    svg.element("clipPath").attr("id", id).children(|svg| filled(svg, &frame.map, "#000000"));
}

/// All that is no channel hatched, up to `top`; the outline of all channels together drawn, open above `top`.
pub(super) fn walls(svg: &mut Svg, frame: &Frame, channels: &[Rect], top: Option<f64>) {
    let mut solid = frame.map;
    if let Some(top) = top {
        solid.h = (solid.y + solid.h - frame.y(top)).max(0.0);
        solid.y = frame.y(top);
    }
    filled(svg, &solid, "url(#wall)");
    let mut path = String::new();
    for channel in channels {
        outline(&mut path, &frame.block(channel));
    }
    // What lies in another channel of an outline is covered by that channel.
    svg.element("path")
        .attr("d", &path)
        .attr("fill", "none")
        .attr("stroke", INK)
        .attr("stroke-linejoin", "miter")
        .num("stroke-width", 3.6)
        .end();
    svg.element("path").attr("d", &path).attr("fill", "#ffffff").end();
    if let Some(top) = top {
        line(svg, (solid.x, solid.y), (solid.x + solid.w, solid.y), INK, 1.8, "");
        for mouth in channels.iter().filter(|channel| channel.y1 >= top) {
            let (left, right) = (frame.x(mouth.x0), frame.x(mouth.x1));
            filled(svg, &Block { x: left, y: solid.y - 3.0, w: right - left, h: 6.0 }, "#ffffff");
        }
    }
}

/// What is closed, in red.
pub(super) fn closed(svg: &mut Svg, frame: &Frame, rects: &[Rect]) {
    for rect in rects {
        filled(svg, &frame.block(rect), "#f6d5d5");
    }
}

/// Channels as thin outlines, junctions dashed, with their numbers in the corner that is farthest from all of `marks`.
pub(super) fn channels(svg: &mut Svg, frame: &Frame, channels: &[Rect], junctions: &[Rect], marks: &[Point]) {
    for channel in channels {
        outlined(svg, &frame.block(channel).inset(0.5), "#c3c8d0", 0.8, "");
    }
    for (number, junction) in (1..).zip(junctions) {
        let block = frame.block(junction).inset(2.0);
        outlined(svg, &block, GREY, 1.0, "5 4");
        let (x, y) = name_place(&block, frame, marks);
        svg.element("text")
            .nums([("x", x), ("y", y), ("font-size", 11.5)])
            .attr("fill", GREY)
            .attr("text-anchor", "middle")
            .text(&format!("J{number}"));
    }
}

/// Where the name of a junction stands: in the upper left corner unless a mark is nearer to it than to another.
fn name_place(block: &Block, frame: &Frame, marks: &[Point]) -> At {
    let (left, right) = (block.x + 12.0, block.x + block.w - 12.0);
    let (upper, lower) = (block.y + 14.0, block.y + block.h - 6.0);
    let room = |(x, y): At| {
        let away = |mark: &Point| (frame.x(mark.x) - x).hypot(frame.y(mark.y) - y);
        marks.iter().map(away).fold(f64::INFINITY, f64::min)
    };
    let places = [(left, upper), (right, upper), (right, lower), (left, lower)];
    places.into_iter().fold(places[0], |best, place| if room(place) > room(best) { place } else { best })
}

fn outlined(svg: &mut Svg, block: &Block, stroke: &str, width: f64, dash: &str) {
    svg.element("rect")
        .block(block)
        .num("stroke-width", width)
        .attr("fill", "none")
        .attr("stroke", stroke)
        .dash(dash)
        .end();
}

fn filled(svg: &mut Svg, block: &Block, fill: &str) {
    svg.element("rect").block(block).attr("fill", fill).end();
}
