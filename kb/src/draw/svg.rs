//! A small writer of SVG: elements, escaped attributes and text, numbers of two decimals.

use std::fmt::Write;

use super::frame::{At, Block};

#[derive(Debug, Default)]
pub(super) struct Svg {
    out: String,
}

impl Svg {
    /// Begins an element; finish it with [`Element::end`], [`Element::text`] or [`Element::children`].
    pub fn element(&mut self, tag: &'static str) -> Element<'_> {
        self.out.push('<');
        self.out.push_str(tag);
        Element { svg: self, tag }
    }

    /// A group of what `draw` writes, with an id that scripts and editors find; left out when that is nothing.
    pub fn group(&mut self, id: &str, draw: impl FnOnce(&mut Self)) {
        let mut inner = Self::default();
        draw(&mut inner);
        if !inner.out.is_empty() {
            self.element("g").attr("id", id).children(|svg| svg.append(&inner));
        }
    }

    /// Words that begin at a point; nothing where there are none.
    pub fn words(&mut self, (x, y): At, size: f64, colour: &str, words: &str) {
        if !words.is_empty() {
            let element = self.element("text").nums([("x", x), ("y", y), ("font-size", size)]);
            element.attr("fill", colour).text(words);
        }
    }

    pub fn disc(&mut self, (x, y): At, radius: f64, fill: &str, (stroke, width): (&str, f64)) {
        self.element("circle")
            .nums([("cx", x), ("cy", y), ("r", radius), ("stroke-width", width)])
            .attr("fill", fill)
            .attr("stroke", stroke)
            .end();
    }

    /// Adds what was written apart.
    pub fn append(&mut self, other: &Self) {
        self.out.push_str(&other.out);
    }

    pub fn finish(self) -> String {
        self.out
    }
}

/// A start tag in the making.
pub(super) struct Element<'a> {
    svg: &'a mut Svg,
    tag: &'static str,
}

impl Element<'_> {
    pub fn attr(self, name: &str, value: &str) -> Self {
        self.svg.out.push(' ');
        self.svg.out.push_str(name);
        self.svg.out.push_str("=\"");
        escape(&mut self.svg.out, value);
        self.svg.out.push('"');
        self
    }

    pub fn num(self, name: &str, value: f64) -> Self {
        self.attr(name, &number(value))
    }

    pub fn nums<const N: usize>(self, values: [(&str, f64); N]) -> Self {
        values.into_iter().fold(self, |element, (name, value)| element.num(name, value))
    }

    pub fn block(self, block: &Block) -> Self {
        self.nums([("x", block.x), ("y", block.y), ("width", block.w), ("height", block.h)])
    }

    /// Dashes of a line; a full line without any.
    pub fn dash(self, dash: &str) -> Self {
        if dash.is_empty() { self } else { self.attr("stroke-dasharray", dash) }
    }

    /// Ends it without content.
    pub fn end(self) {
        self.svg.out.push_str("/>\n");
    }

    pub fn text(self, content: &str) {
        self.svg.out.push('>');
        escape(&mut self.svg.out, content);
        self.close();
    }

    /// Ends it with what `draw` writes.
    pub fn children(self, draw: impl FnOnce(&mut Svg)) {
        self.svg.out.push_str(">\n");
        draw(self.svg);
        self.close();
    }

    fn close(self) {
        self.svg.out.push_str("</");
        self.svg.out.push_str(self.tag);
        self.svg.out.push_str(">\n");
    }
}

/// The number with at most two decimals; what is not finite becomes 0, which every reader of SVG accepts.
pub(super) fn number(value: f64) -> String {
    let rounded = (value * 100.0).round() / 100.0;
    if rounded.is_finite() && rounded != 0.0 { format!("{rounded}") } else { "0".to_owned() }
}

/// Appends path commands: a letter and its numbers.
pub(super) fn command(path: &mut String, letter: char, values: &[f64]) {
    path.push(letter);
    for (i, value) in values.iter().enumerate() {
        if i > 0 {
            path.push(' ');
        }
        // Writing to a String cannot fail.
        let _ = write!(path, "{}", number(*value));
    }
}

/// Appends the commands of a line through points.
pub(super) fn through(path: &mut String, points: impl IntoIterator<Item = At>) {
    for (place, (x, y)) in points.into_iter().enumerate() {
        command(path, if place == 0 { 'M' } else { 'L' }, &[x, y]);
    }
}

pub(super) fn round(path: &mut String, points: impl IntoIterator<Item = At>) {
    through(path, points);
    path.push('z');
}

fn escape(out: &mut String, text: &str) {
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\t' | '\n' | '\r' => out.push(' '),
            // XML 1.0 has no way to write these.
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
}
