//! Curves over a number that counts, in panels side by side: Chen's Figure 5, errors of a pose over the distance.

use plotters::coord::Shift;
use plotters::coord::ranged1d::{AsRangedCoord, Ranged, ValueFormatter};
use plotters::drawing::DrawingAreaErrorKind;
use plotters::element::DashedPathElement;
use plotters::prelude::*;

use super::palette::{GREY, INK};
use super::{svg, text};

#[derive(Clone, Debug)]
pub struct CurvePanel {
    /// What stands above it.
    pub title: String,
    /// What is counted to the right.
    pub across: String,
    /// What is counted upwards.
    pub scale: Scale,
    pub curves: Vec<Curve>,
    /// Where something happened: a dashed line down, and what it was.
    pub event: Option<(f64, String)>,
    /// A height that matters: a dashed line across.
    pub level: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// From 0 to the greatest value.
    Linear,
    /// By powers of ten from a least to a greatest value, with a unit; what is lower or higher is drawn at the border.
    Decades(f64, f64, &'static str),
}

/// A curve with its name. The legend has a name once.
#[derive(Clone, Debug)]
pub struct Curve {
    pub name: String,
    /// Which of the pens draws it; 0 is a full line, for what matters most.
    pub pen: usize,
    /// Its points, from left to right.
    pub points: Vec<(f64, f64)>,
}

/// Size of a panel, pixels.
const PANEL: (u32, u32) = (470, 320);
const TITLE: u32 = 40;
/// Length of a piece of a curve in the legend.
const KEY: u32 = 24;
const FONT: &str = "sans-serif";

/// Colour, length of dashes and of gaps: none is told by colour alone.
const PENS: [(&str, u32, u32); 5] =
    [("#17365d", 0, 0), ("#2e9d66", 7, 3), ("#3f8fd2", 2, 2), ("#d0342c", 9, 3), ("#8a9099", 4, 4)];

type Area<'s> = DrawingArea<SVGBackend<'s>, Shift>;
type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;

/// The panels in rows under a title, as a standalone SVG text. The same panels give the same text.
pub fn render_curves(title: &str, rows: &[Vec<CurvePanel>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0).max(1) as u32;
    let size = (columns * PANEL.0, TITLE + rows.len() as u32 * PANEL.1);
    let mut picture = String::new();
    {
        let sheet = SVGBackend::with_string(&mut picture, size).into_drawing_area();
        draw(&sheet, title, rows, columns as usize)
            .and_then(|()| sheet.present())
            .expect("writing into a text does not fail");
    }
    named(title, &picture)
}

/// Says in words what the picture is, for those who hear it.
fn named(title: &str, picture: &str) -> String {
    let mut name = svg::Svg::default();
    name.element("title").text(title);
    match picture.split_once('>') {
        Some((start, rest)) => format!("{start} role=\"img\">\n{}{rest}", name.finish()),
        None => picture.to_owned(),
    }
}

fn draw(sheet: &Area<'_>, title: &str, rows: &[Vec<CurvePanel>], columns: usize) -> Drawn {
    sheet.fill(&WHITE)?;
    let size = f64::from(columns as u32 * PANEL.0);
    let ink = colour(INK);
    let said = text::fit(title, 18.0, size - 32.0);
    sheet.draw(&Text::new(said, (16, 14), (FONT, 18).into_font().color(&ink)))?;
    let (_, below) = sheet.split_vertically(TITLE);
    let areas = below.split_evenly((rows.len().max(1), columns));
    for (number, row) in rows.iter().enumerate() {
        for (panel, area) in row.iter().zip(&areas[number * columns..]) {
            panel.draw(area)?;
        }
    }
    Ok(())
}

impl CurvePanel {
    fn draw(&self, area: &Area<'_>) -> Drawn {
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let last = points().map(|point| point.0).fold(f64::NEG_INFINITY, f64::max);
        let last = if last > 0.0 { last } else { 1.0 };
        match self.scale {
            Scale::Linear => {
                let most = points().map(|point| point.1).chain(self.level).fold(0.0, f64::max);
                let most = if most > 0.0 { 1.05 * most } else { 1.0 };
                self.within(area, 0.0..last, 0.0..most, (0.0, most), "")
            }
            Scale::Decades(least, most, unit) => {
                self.within(area, 0.0..last, (least..most).log_scale(), (least, most), unit)
            }
        }
    }

    /// On the left where curves end high.
    fn legend_place(&self, last: f64, most: f64) -> SeriesLabelPosition {
        let points = || self.curves.iter().flat_map(|curve| &curve.points);
        let ends_high = points().any(|&(x, y)| x > 0.8 * last && y > 0.7 * most);
        if self.scale == Scale::Linear && ends_high && self.level.is_none() {
            SeriesLabelPosition::UpperLeft
        } else {
            SeriesLabelPosition::UpperRight
        }
    }

    fn within<Y>(
        &self,
        area: &Area<'_>,
        across: std::ops::Range<f64>,
        up: Y,
        (least, most): (f64, f64),
        unit: &str,
    ) -> Drawn
    where
        Y: AsRangedCoord<Value = f64>,
        Y::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        let (ink, grey) = (colour(INK), colour(GREY));
        let last = across.end;
        let mut chart = ChartBuilder::on(area)
            .margin(12)
            .margin_right(24)
            .caption(&self.title, (FONT, 14).into_font().color(&ink))
            .x_label_area_size(38)
            .y_label_area_size(58)
            .build_cartesian_2d(across, up)?;
        chart
            .configure_mesh()
            .disable_x_mesh()
            .bold_line_style(colour("#d8dce2"))
            .light_line_style(TRANSPARENT)
            .axis_style(grey)
            .label_style((FONT, 12).into_font().color(&grey))
            .x_desc(self.across.as_str())
            .x_label_formatter(&|value| figure(*value))
            .y_label_formatter(&|value| format!("{} {unit}", figure(*value)).trim_end().to_owned())
            .draw()?;
        let across = |x: f64, of: f64| [(x, least), (x, of)];
        if let Some((at, what)) = &self.event {
            chart.draw_series(DashedLineSeries::new(across(*at, most), 3, 3, grey.into()))?;
            let label = Text::new(what.clone(), (*at, most), (FONT, 12).into_font().color(&grey));
            chart.draw_series([label])?;
        }
        if let Some(level) = self.level {
            let red = colour("#d0342c");
            chart.draw_series(DashedLineSeries::new([(0.0, level), (last, level)], 2, 3, red.into()))?;
        }
        let mut names: Vec<&str> = Vec::new();
        for curve in &self.curves {
            let (hue, dash, gap) = PENS[curve.pen % PENS.len()];
            let style = colour(hue).stroke_width(2);
            let points = curve.points.iter().map(|&(x, y)| (x, y.clamp(least, most)));
            let drawn = if dash == 0 {
                chart.draw_series(LineSeries::new(points, style))?
            } else {
                chart.draw_series(DashedLineSeries::new(points, dash, gap, style))?
            };
            if !names.contains(&curve.name.as_str()) {
                names.push(&curve.name);
                let (dash, gap) = if dash == 0 { (KEY, 0) } else { (dash, gap) };
                drawn.label(&curve.name).legend(move |(x, y)| {
                    DashedPathElement::new([(x, y), (x + KEY as i32, y)], dash, gap, style)
                });
            }
        }
        chart
            .configure_series_labels()
            .position(self.legend_place(last, most))
            .background_style(WHITE.mix(0.85))
            .border_style(colour("#d8dce2"))
            .legend_area_size(KEY + 6)
            .label_font((FONT, 12).into_font().color(&ink))
            .draw()
    }
}

fn colour(hex: &str) -> RGBColor {
    let part =
        |at: usize| hex.get(at..at + 2).and_then(|part| u8::from_str_radix(part, 16).ok()).unwrap_or(0);
    RGBColor(part(1), part(3), part(5))
}

fn figure(value: f64) -> String {
    if value.abs() >= 10_000.0 { format!("{}k", text::figure(value / 1000.0)) } else { text::figure(value) }
}
