//! A part on its way out, as in Lee's Figure 5.

use adit_planners::geometry::Rect;

use super::panel::AssemblyPicture;
use super::{ground, marks};
use crate::draw::frame::{At, Frame};
use crate::draw::palette::ROUTE;
use crate::draw::sheet::line;
use crate::draw::svg::Svg;

pub(super) fn draw(svg: &mut Svg, picture: &AssemblyPicture, frame: &Frame) {
    ground::walls(svg, frame, &picture.channels, picture.top);
    ground::channels(svg, frame, &picture.channels, &picture.junctions, &[]);
    let last = picture.parts.len().saturating_sub(1);
    for (place, rect) in picture.parts.iter().enumerate() {
        let dash = if place == last && last > 0 { "7 3" } else { "" };
        part(svg, frame, rect, if place == 0 { "0.28" } else { "0.07" }, dash);
    }
    let middles: Vec<At> = picture.parts.iter().map(|part| frame.at(part.centre())).collect();
    for leg in middles.windows(2) {
        line(svg, leg[0], leg[1], ROUTE, 2.2, "");
    }
    for (place, middle) in middles.iter().enumerate() {
        marks::dot(svg, *middle, place == 0);
    }
    for (place, leg) in middles.windows(2).enumerate() {
        let middle = (f64::midpoint(leg[0].0, leg[1].0), f64::midpoint(leg[0].1, leg[1].1));
        marks::number(svg, middle, place + 1);
    }
}

fn part(svg: &mut Svg, frame: &Frame, rect: &Rect, opacity: &str, dash: &str) {
    svg.element("rect")
        .block(&frame.block(rect))
        .num("stroke-width", 1.3)
        .attr("fill", ROUTE)
        .attr("fill-opacity", opacity)
        .attr("stroke", ROUTE)
        .dash(dash)
        .end();
}
