//! Figure 4: vertical strips a, b, ... and horizontal strips 1, 2, ...

use super::palette::{GREY, INK};
use super::sheet::{Sheet, line};
use super::svg::Svg;
use super::text;

/// Room for the strips' names beside the map.
pub(super) const MARGIN: f64 = 26.0;

pub(super) fn strips(svg: &mut Svg, sheet: &Sheet) {
    let map = sheet.frame.map;
    let xs: Vec<f64> = sheet.scene.strips_x.iter().map(|&x| sheet.frame.x(x)).collect();
    let ys: Vec<f64> = sheet.scene.strips_y.iter().map(|&y| sheet.frame.y(y)).collect();
    let width = if xs.len() + ys.len() > 80 { 0.5 } else { 1.2 };
    for &x in &xs {
        line(svg, (x, map.y - 9.0), (x, map.y - 1.0), INK, width, "");
        if x > map.x + 0.5 && x < map.x + map.w - 0.5 {
            line(svg, (x, map.y), (x, map.y + map.h), GREY, width, "6 4");
        }
    }
    for &y in &ys {
        line(svg, (map.x - 9.0, y), (map.x - 1.0, y), INK, width, "");
        if y > map.y + 0.5 && y < map.y + map.h - 0.5 {
            line(svg, (map.x, y), (map.x + map.w, y), GREY, width, "6 4");
        }
    }
    let size = 13.0;
    for (i, pair) in xs.windows(2).enumerate() {
        let name = text::letters(i);
        if text::width(&name, size) + 2.0 <= (pair[1] - pair[0]).abs() {
            caption(svg, f64::midpoint(pair[0], pair[1]), map.y - 9.0, size, &name);
        }
    }
    for (i, pair) in ys.windows(2).enumerate() {
        if size <= (pair[1] - pair[0]).abs() {
            let y = f64::midpoint(pair[0], pair[1]) + size * 0.35;
            caption(svg, map.x - 15.0, y, size, &(i + 1).to_string());
        }
    }
}

fn caption(svg: &mut Svg, x: f64, y: f64, size: f64, name: &str) {
    svg.element("text")
        .nums([("x", x), ("y", y), ("font-size", size)])
        .attr("text-anchor", "middle")
        .attr("fill", INK)
        .text(name);
}
