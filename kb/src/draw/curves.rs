//! Curves over a number that counts, as in Chen's Figure 5: panels side by side, a row for each scenario.

use super::palette::{GREY, INK};
use super::svg::{self, Svg};
use super::{MARGIN, page, text};

/// Curves in one pair of axes.
#[derive(Clone, Debug)]
pub struct CurvePanel {
    /// What stands above it.
    pub title: String,
    /// What is counted to the right.
    pub across: String,
    /// The curves, in the order of their colours.
    pub curves: Vec<Curve>,
    /// Where something happened: a dashed line down, and what it was.
    pub event: Option<(f64, String)>,
    /// A height that matters: a dashed line across.
    pub level: Option<f64>,
}

/// A curve with its name.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Its name.
    pub name: String,
    /// Its points, from left to right.
    pub points: Vec<(f64, f64)>,
}

/// A panel's axes.
const WIDE: f64 = 330.0;
const HIGH: f64 = 240.0;
/// Left of the axes, for the numbers.
const NUMBERS: f64 = 54.0;
/// Right of the axes, for the curves' names.
const NAMES: f64 = 52.0;
const ABOVE: f64 = 34.0;
const BELOW: f64 = 44.0;
const TITLE: f64 = 30.0;

/// Colour and dash of each curve: none is told by colour alone.
const LOOKS: [(&str, &str); 6] = [
    ("#2e9d66", "7 3"),
    ("#3f8fd2", "2 2"),
    ("#d0342c", "9 2 2 2"),
    ("#17365d", ""),
    ("#8a9099", "4 4"),
    ("#8e5ab5", "12 3"),
];

/// The panels in rows under a title, as a standalone SVG text. The same panels give the same text.
pub fn render_curves(title: &str, rows: &[Vec<CurvePanel>]) -> String {
    let mut svg = Svg::default();
    let (mut top, mut right) = (MARGIN + TITLE, MARGIN);
    for row in rows {
        let mut left = MARGIN;
        for panel in row {
            Axes::of(panel, left + NUMBERS, top + ABOVE).draw(&mut svg, panel);
            left += NUMBERS + WIDE + NAMES + MARGIN;
        }
        right = right.max(left);
        top += ABOVE + HIGH + BELOW;
    }
    page(title, (right, top + MARGIN), |page| {
        write(
            page,
            (MARGIN, MARGIN + 14.0),
            18.0,
            INK,
            "start",
            &text::fit(title, 18.0, right - 2.0 * MARGIN),
        );
        page.append(&svg);
    })
}

/// Where a panel's numbers lie in the picture.
struct Axes {
    left: f64,
    top: f64,
    across: (f64, f64),
    most: f64,
}

impl Axes {
    fn of(panel: &CurvePanel, left: f64, top: f64) -> Self {
        let points = || panel.curves.iter().flat_map(|curve| &curve.points);
        let least = points().map(|point| point.0).fold(f64::INFINITY, f64::min);
        let last = points().map(|point| point.0).fold(f64::NEG_INFINITY, f64::max);
        let most = points().map(|point| point.1).chain(panel.level).fold(0.0, f64::max);
        let across = if least < last { (least.min(0.0), last) } else { (0.0, last.max(1.0)) };
        Self { left, top, across, most: if most > 0.0 { most * 1.05 } else { 1.0 } }
    }

    fn x(&self, value: f64) -> f64 {
        self.left + WIDE * (value - self.across.0) / (self.across.1 - self.across.0)
    }

    fn y(&self, value: f64) -> f64 {
        self.top + HIGH * (1.0 - value / self.most)
    }

    fn draw(&self, svg: &mut Svg, panel: &CurvePanel) {
        let bottom = self.top + HIGH;
        write(svg, (self.left, self.top - 14.0), 14.0, INK, "start", &panel.title);
        for value in ticks(0.0, self.most) {
            let y = self.y(value);
            stroke(svg, (self.left, y), (self.left + WIDE, y), "#e4e7eb", 1.0, "");
            write(svg, (self.left - 6.0, y + 4.0), 11.0, GREY, "end", &figure(value));
        }
        for value in ticks(self.across.0, self.across.1) {
            let x = self.x(value);
            stroke(svg, (x, bottom), (x, bottom + 4.0), GREY, 1.0, "");
            write(svg, (x, bottom + 16.0), 11.0, GREY, "middle", &figure(value));
        }
        write(svg, (self.left + WIDE / 2.0, bottom + 32.0), 12.0, GREY, "middle", &panel.across);
        if let Some(level) = panel.level {
            stroke(svg, (self.left, self.y(level)), (self.left + WIDE, self.y(level)), GREY, 1.0, "3 3");
        }
        if let Some((at, what)) = &panel.event {
            let x = self.x(*at);
            stroke(svg, (x, self.top), (x, bottom), GREY, 1.0, "3 3");
            write(svg, (x + 4.0, self.top + 11.0), 11.0, GREY, "start", what);
        }
        stroke(svg, (self.left, self.top), (self.left, bottom), INK, 1.2, "");
        stroke(svg, (self.left, bottom), (self.left + WIDE, bottom), INK, 1.2, "");
        for (number, curve) in panel.curves.iter().enumerate() {
            self.curve(svg, curve, LOOKS[number % LOOKS.len()]);
        }
        self.names(svg, panel);
    }

    fn curve(&self, svg: &mut Svg, curve: &Curve, (colour, dash): (&str, &str)) {
        let mut path = String::new();
        for (index, (x, y)) in curve.points.iter().enumerate() {
            svg::command(&mut path, if index == 0 { 'M' } else { 'L' }, &[self.x(*x), self.y(*y)]);
        }
        let element = svg
            .element("path")
            .attr("d", &path)
            .attr("fill", "none")
            .attr("stroke", colour)
            .num("stroke-width", 1.8);
        if dash.is_empty() { element.end() } else { element.attr("stroke-dasharray", dash).end() }
    }

    /// The name of each curve at its end, moved apart where ends are close.
    fn names(&self, svg: &mut Svg, panel: &CurvePanel) {
        const APART: f64 = 13.0;
        let ends = panel.curves.iter().enumerate().filter_map(|(number, curve)| {
            let (_, y) = curve.points.last()?;
            Some((self.y(*y), number, curve.name.as_str()))
        });
        let mut ends: Vec<_> = ends.collect();
        ends.sort_by(|one, other| one.0.total_cmp(&other.0));
        let mut lowest = f64::NEG_INFINITY;
        for end in &mut ends {
            end.0 = end.0.max(lowest + APART);
            lowest = end.0;
        }
        // Those that were pushed below the axis push the others up again, as far as they have to.
        let mut highest = self.top + HIGH + APART;
        for end in ends.iter_mut().rev() {
            end.0 = end.0.min(highest - APART);
            highest = end.0;
        }
        for (y, number, name) in ends {
            let (colour, dash) = LOOKS[number % LOOKS.len()];
            let x = self.left + WIDE + 4.0;
            stroke(svg, (x, y), (x + 16.0, y), colour, 2.0, dash);
            write(svg, (x + 19.0, y + 4.0), 12.0, INK, "start", name);
        }
    }
}

/// Round numbers between two others, both included where they are round: at most eight.
fn ticks(from: f64, to: f64) -> Vec<f64> {
    let rough = (to - from) / 6.0;
    let power = 10.0_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|factor| factor * power).find(|step| *step >= rough);
    let Some(step) = step.filter(|step| step.is_finite() && *step > 0.0) else { return vec![from] };
    let first = (from / step).ceil() as i64;
    let last = (to / step).floor() as i64;
    (first..=last).map(|number| number as f64 * step).collect()
}

fn figure(value: f64) -> String {
    if value.abs() >= 10_000.0 { format!("{}k", text::figure(value / 1000.0)) } else { text::figure(value) }
}

fn stroke(svg: &mut Svg, from: (f64, f64), to: (f64, f64), colour: &str, width: f64, dash: &str) {
    super::sheet::line(svg, from, to, colour, width, dash);
}

fn write(svg: &mut Svg, (x, y): (f64, f64), size: f64, colour: &str, anchor: &str, words: &str) {
    svg.element("text")
        .nums([("x", x), ("y", y), ("font-size", size)])
        .attr("fill", colour)
        .attr("text-anchor", anchor)
        .text(words);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        assert_eq!(ticks(0.0, 100.0), [0.0, 20.0, 40.0, 60.0, 80.0, 100.0]);
        assert_eq!(ticks(0.0, 1.3).len(), 3);
        assert!(ticks(0.0, 0.0).len() <= 1);
    }
}
