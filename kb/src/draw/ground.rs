//! The map itself: ground, obstacles, bridges with their heights, places, the scale bar.

use adit_planners::world::Bridge;

use super::labels::Face;
use super::layers::Layer;
use super::palette::{BRIDGE, GREY, INK};
use super::sheet::{Sheet, line, shape_of};
use super::svg::Svg;
use super::text;

/// Patterns that the map refers to.
pub(super) fn definitions(svg: &mut Svg) {
    svg.element("defs").children(|svg| {
        svg.element("pattern")
            .attr("id", "bridge")
            .attr("patternUnits", "userSpaceOnUse")
            .attr("patternTransform", "rotate(45)")
            .nums([("width", 7.0), ("height", 7.0)])
            .children(|svg| line(svg, (0.0, 0.0), (0.0, 7.0), BRIDGE, 2.2, ""));
        super::named::definitions(svg);
    });
}

/// The ground; rooms lie on it.
pub(super) fn floor(svg: &mut Svg, sheet: &Sheet) {
    svg.element("rect").block(&sheet.frame.map).attr("fill", "#ffffff").end();
}

/// Bridges, obstacles and the edge. All obstacles are one path, however many they are.
pub(super) fn solids(svg: &mut Svg, sheet: &Sheet) {
    for bridge in &sheet.scene.bridges {
        svg.element("rect")
            .block(&sheet.frame.block(&bridge.rect))
            .attr("fill", "url(#bridge)")
            .attr("fill-opacity", "0.55")
            .attr("stroke", BRIDGE)
            .attr("stroke-dasharray", "6 2")
            .num("stroke-width", sheet.unit)
            .end();
    }
    let mut path = String::new();
    for shape in &sheet.scene.obstacles {
        shape_of(&mut path, &sheet.frame, shape);
    }
    // In the figures that show a graph, the map only says where one is.
    let faint = sheet.layers.has(Layer::Graph) || sheet.layers.has(Layer::Weighted);
    let fill = if faint { "#d3d7de" } else { INK };
    if !path.is_empty() {
        // A thin outline closes the seams between cells that touch.
        svg.element("path")
            .attr("d", &path)
            .attr("fill", fill)
            .attr("stroke", fill)
            .num("stroke-width", 0.3)
            .end();
    }
    svg.element("rect")
        .block(&sheet.frame.map)
        .num("stroke-width", 2.0)
        .attr("fill", "none")
        .attr("stroke", INK)
        .end();
}

/// Writes how high a state must not be under each bridge, once for neighbours of the same height.
pub(super) fn bridge_heights(sheet: &mut Sheet) {
    let face = Face { size: 10.5 * sheet.unit, colour: "#7a3d08", strong: true, chip: false };
    for bridge in &sheet.scene.bridges {
        let Bridge { rect, height } = bridge;
        let label = format!("under {} m", text::figure(*height));
        let block = sheet.frame.block(rect);
        let (x, y) = block.centre();
        let (w, h) = super::labels::extent(&label, face.size);
        let (right, below) = (block.w / 2.0 + w / 2.0 + 3.0, block.h / 2.0 + h / 2.0 + 2.0);
        let mut centres = Vec::new();
        if block.w >= w && block.h >= h {
            let (dx, dy) = (block.w / 2.0 - w / 2.0 - 2.0, block.h / 2.0 - h / 2.0 - 2.0);
            centres.extend([(x, y + dy), (x, y - dy), (x, y)]);
            centres.extend([(x + dx, y + dy), (x - dx, y + dy), (x + dx, y - dy), (x - dx, y - dy)]);
        }
        centres.extend([(x, y - below), (x, y + below), (x + right, y), (x - right, y)]);
        sheet.labels.place(&label, face, &sheet.frame.map, centres);
    }
}

/// Named points, but for the ends of the route, which have marks of their own.
pub(super) fn places(svg: &mut Svg, sheet: &mut Sheet) {
    let ends: Vec<&str> = match &sheet.scene.route {
        Some(route) if !sheet.runs.is_empty() => vec![&route.start.name, &route.goal.name],
        _ => Vec::new(),
    };
    let face = Face { size: 11.5 * sheet.unit, colour: INK, strong: true, chip: false };
    for place in sheet.scene.places.iter().filter(|place| !ends.contains(&place.name.as_str())) {
        let (x, y) = sheet.frame.at(place.at);
        let radius = 2.6 * sheet.unit;
        svg.disc((x, y), radius, INK, ("#ffffff", 1.0));
        let (w, _) = super::labels::extent(&place.name, face.size);
        let around = super::route::around((x, y), w / 2.0 + radius + 2.0, face.size * 0.6 + radius + 1.0);
        sheet.labels.place(&place.name, face, &sheet.frame.map, around);
        sheet.labels.take(super::frame::Block::about(x, y, 2.0 * radius, 2.0 * radius));
    }
}

/// A bar of a round number of metres below the map.
pub(super) fn scale_bar(svg: &mut Svg, sheet: &Sheet) {
    let metres = round_length(sheet.frame.map.w / 5.0 / sheet.frame.scale);
    let (left, right) = (sheet.frame.map.x, sheet.frame.map.x + metres * sheet.frame.scale);
    let y = sheet.frame.map.y + sheet.frame.map.h + 20.0 * sheet.unit;
    let tick = 4.0 * sheet.unit;
    line(svg, (left, y), (right, y), INK, 1.6, "");
    for x in [left, f64::midpoint(left, right), right] {
        line(svg, (x, y - tick), (x, y), INK, 1.6, "");
    }
    let metres = format!("{} m", text::figure(metres));
    svg.words((right + 8.0, y + 1.0), 12.0 * sheet.unit, GREY, &metres);
}

/// The greatest of 1, 2, 5 times a power of ten that is not greater.
fn round_length(metres: f64) -> f64 {
    let power = 10f64.powf(metres.max(1e-6).log10().floor());
    [5.0, 2.0].into_iter().map(|digit| digit * power).find(|length| *length <= metres).unwrap_or(power)
}
