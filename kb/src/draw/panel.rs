//! A column of lines beside the map.

use super::frame::At;
use super::palette::{GREY, INK};
use super::svg::Svg;
use super::text;

/// A column in the making; `y` is the upper edge of the next line.
pub(super) struct Panel {
    pub svg: Svg,
    pub x: f64,
    pub y: f64,
    pub width: f64,
    pub font: f64,
}

impl Panel {
    /// A heading with a figure at its right.
    pub fn heading(&mut self, title: &str, figure: &str) {
        let size = self.font * 1.15;
        self.y += self.font * 0.6;
        self.words(0.0, size, INK, title, figure);
        self.y += self.font * 1.9;
    }

    /// A line after a symbol of width `indent`, drawn by `symbol` about the line's middle.
    pub fn line(&mut self, indent: f64, words: &str, figure: &str, symbol: impl FnOnce(&mut Svg, At)) {
        symbol(&mut self.svg, (self.x, self.y + self.font * 0.65));
        self.words(indent, self.font, INK, words, figure);
        self.y += self.font * 1.65;
    }

    /// A small line under another one.
    pub fn remark(&mut self, indent: f64, words: &str) {
        self.y -= self.font * 0.3;
        self.words(indent, self.font * 0.85, GREY, words, "");
        self.y += self.font * 1.6;
    }

    /// Space between two parts.
    pub fn gap(&mut self) {
        self.y += self.font * 0.9;
    }

    fn words(&mut self, indent: f64, size: f64, colour: &'static str, words: &str, figure: &str) {
        let y = self.y + self.font;
        let figures = if figure.is_empty() { 0.0 } else { text::width(figure, size) + size };
        let words = text::fit(words, size, self.width - indent - figures);
        for (content, x, anchor) in
            [(words.as_str(), self.x + indent, "start"), (figure, self.x + self.width, "end")]
        {
            if !content.is_empty() {
                self.svg
                    .element("text")
                    .nums([("x", x), ("y", y), ("font-size", size), ("stroke-width", size * 0.025)])
                    .attr("text-anchor", anchor)
                    .attr("fill", colour)
                    .attr("stroke", colour)
                    .text(content);
            }
        }
    }
}
