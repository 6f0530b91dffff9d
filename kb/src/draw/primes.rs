//! Figure 5: prime areas, which overlap: outlines set in by different amounts, each named where few others lie.

use super::frame::{At, Block};
use super::labels::Face;
use super::scene::PrimeArea;
use super::sheet::{Sheet, outline};
use super::svg::Svg;

/// Above so many areas only outlines can be told apart.
const MOST_NAMES: usize = 150;

/// Dark, and distinct to most eyes (after Okabe and Ito).
const COLOURS: [&str; 7] = ["#0072b2", "#b8560a", "#00795a", "#a34a81", "#4b4f58", "#8a6d00", "#2f6fa0"];

/// Outlines; those of hard areas are dashed.
pub(super) fn outlines(svg: &mut Svg, sheet: &Sheet) {
    for (i, area) in sheet.scene.prime_areas.iter().enumerate() {
        let colour = COLOURS[i % COLOURS.len()];
        let mut path = String::new();
        outline(&mut path, &inset(sheet, i, area));
        svg.element("path")
            .attr("d", &path)
            .attr("fill", colour)
            .attr("fill-opacity", if sheet.scene.prime_areas.len() > 40 { "0" } else { "0.06" })
            .attr("stroke", colour)
            .num("stroke-width", if sheet.scene.prime_areas.len() > 40 { 0.8 } else { 2.0 })
            .dash(if area.open == Some(false) { "8 4" } else { "" })
            .end();
    }
}

pub(super) fn names(sheet: &mut Sheet) {
    let areas = &sheet.scene.prime_areas;
    if areas.len() > MOST_NAMES {
        return;
    }
    let blocks: Vec<Block> = areas.iter().enumerate().map(|(i, area)| inset(sheet, i, area)).collect();
    for (i, area) in areas.iter().enumerate() {
        let face =
            Face { size: 15.0 * sheet.unit, colour: COLOURS[i % COLOURS.len()], strong: true, chip: false };
        sheet.labels.place(&area.label, face, &blocks[i].inset(2.0), quiet_spots(&blocks, i));
    }
}

fn inset(sheet: &Sheet, i: usize, area: &PrimeArea) -> Block {
    let block = sheet.frame.block(&area.rect);
    let by = if sheet.scene.prime_areas.len() > 40 { 0.0 } else { 2.0 + 2.6 * (i % 7) as f64 };
    block.inset(by.min(block.w.min(block.h) / 5.0))
}

/// Spots of an area: those that the fewest other areas cover first, then those near its centre.
fn quiet_spots(blocks: &[Block], i: usize) -> Vec<At> {
    const SIDE: usize = 15;
    let own = blocks[i];
    let (cx, cy) = own.centre();
    let mut spots: Vec<(usize, f64, At)> = Vec::new();
    for k in 0..SIDE * SIDE {
        let share = |n: usize| (n as f64 + 0.5) / SIDE as f64;
        let (x, y) = (own.x + own.w * share(k % SIDE), own.y + own.h * share(k / SIDE));
        let text = Block::about(x, y, 24.0, 20.0);
        let covered = blocks.iter().filter(|block| block.overlaps(&text)).count();
        spots.push((covered, (x - cx).hypot(y - cy), (x, y)));
    }
    spots.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    spots.into_iter().map(|(_, _, at)| at).collect()
}
