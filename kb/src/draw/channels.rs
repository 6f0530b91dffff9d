//! Ways through channels, as in Lee's Figures 5 and 8: panels side by side, one for each gap.

mod assembly;
mod drive;
mod ground;
mod marks;
mod panel;

pub use panel::ChannelPanel;

use super::frame::Frame;
use super::palette::{GREY, INK};
use super::svg::Svg;
use super::{MARGIN, page, text};
use panel::Picture;

/// The longest side of the largest panel.
const LONGEST: f64 = 420.0;
const IN_A_ROW: usize = 3;
/// Below each panel, for what is written there.
const CAPTION: f64 = 74.0;
/// Above all panels.
const TITLE: f64 = 34.0;

/// The panels side by side under a title, all to the same scale, as a standalone SVG text. The same panels give the
/// same text.
pub fn render_channels(title: &str, panels: &[ChannelPanel]) -> String {
    let longest = |panel: &ChannelPanel| panel.bounds.dx().max(panel.bounds.dy());
    let scale = LONGEST / panels.iter().map(longest).fold(1e-9, f64::max);
    let widths: Vec<f64> =
        panels.iter().map(|panel| panel.caption_width().max(panel.bounds.dx() * scale)).collect();
    let mut svg = Svg::default();
    let (mut top, mut right) = (MARGIN + if title.is_empty() { 0.0 } else { TITLE }, MARGIN);
    for (row, panels) in panels.chunks(IN_A_ROW).enumerate() {
        let mut left = MARGIN;
        let height = panels.iter().map(|panel| panel.bounds.dy() * scale).fold(0.0, f64::max);
        for (place, panel) in panels.iter().enumerate() {
            let side = longest(panel) * scale;
            // The lower sides of a row are level.
            let above = height - panel.bounds.dy() * scale;
            let frame = Frame::new(panel.bounds, side, left, top + above);
            draw(&mut svg, panel, &frame, row * IN_A_ROW + place);
            // Columns are as wide as the widest panel in them.
            left += widths.iter().skip(place).step_by(IN_A_ROW).copied().fold(0.0, f64::max) + MARGIN;
        }
        right = right.max(left);
        top += height + CAPTION;
    }
    page(title, (right, top), |page| {
        ground::definitions(page);
        page.words((MARGIN, MARGIN + 14.0), 18.0, INK, &text::fit(title, 18.0, right - 2.0 * MARGIN));
        page.append(&svg);
    })
}

fn draw(svg: &mut Svg, panel: &ChannelPanel, frame: &Frame, place: usize) {
    svg.group(&format!("panel-{}", text::letters(place)), |svg| {
        // What sticks out of the panel is cut off: a part on its way to far outside.
        let clip = format!("within-{}", text::letters(place));
        ground::clip(svg, &clip, frame);
        svg.element("g").attr("clip-path", &format!("url(#{clip})")).children(|svg| match &panel.picture {
            Picture::Assembly(assembly) => assembly::draw(svg, assembly, frame),
            Picture::Drive(drive) => drive::draw(svg, drive, frame),
        });
        let below = frame.map.y + frame.map.h;
        svg.words((frame.map.x, below + 20.0), 14.0, INK, &panel.heading(place));
        for (line, figures) in panel.figures.iter().enumerate() {
            svg.words((frame.map.x, below + 38.0 + 17.0 * line as f64), 13.0, GREY, figures);
        }
    });
}
