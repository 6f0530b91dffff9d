//! Ways and numbers on them.

use crate::draw::frame::At;
use crate::draw::palette::ROUTE;
use crate::draw::svg::Svg;

/// Where a way starts: full; elsewhere it is a ring.
pub(super) fn dot(svg: &mut Svg, at: At, is_start: bool) {
    svg.disc(at, 3.4, if is_start { ROUTE } else { "#ffffff" }, (ROUTE, 1.4));
}

pub(super) fn number(svg: &mut Svg, (x, y): At, number: usize) {
    svg.disc((x, y), 8.5, "#ffffff", (ROUTE, 1.0));
    svg.element("text")
        .nums([("x", x), ("y", y + 4.2), ("font-size", 12.0)])
        .attr("fill", ROUTE)
        .attr("text-anchor", "middle")
        .text(&number.to_string());
}
