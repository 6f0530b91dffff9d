//! Ways and numbers on them.

use crate::draw::frame::At;
use crate::draw::palette::ROUTE;
use crate::draw::svg::Svg;

/// Where a way starts: full; elsewhere it is a ring.
pub(super) fn dot(svg: &mut Svg, (x, y): At, is_start: bool) {
    svg.element("circle")
        .nums([("cx", x), ("cy", y), ("r", 3.4), ("stroke-width", 1.4)])
        .attr("fill", if is_start { ROUTE } else { "#ffffff" })
        .attr("stroke", ROUTE)
        .end();
}

/// A number in a white disc.
pub(super) fn number(svg: &mut Svg, (x, y): At, number: usize) {
    svg.element("circle")
        .nums([("cx", x), ("cy", y), ("r", 8.5), ("stroke-width", 1.0)])
        .attr("fill", "#ffffff")
        .attr("stroke", ROUTE)
        .end();
    svg.element("text")
        .nums([("x", x), ("y", y + 4.2), ("font-size", 12.0)])
        .attr("fill", ROUTE)
        .attr("text-anchor", "middle")
        .text(&number.to_string());
}
