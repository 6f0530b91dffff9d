//! Lines from circle to circle; a circle that the way passes by is left out.

use super::circle::{Circle, Tangent};
use crate::geometry::tolerance::ROUNDING;

/// Radians below which a way passes a circle by. Less is what rounding leaves of a turn by nothing.
const NOISE: f64 = ROUNDING;

#[derive(Clone, Copy, Debug)]
pub(super) struct Touched {
    /// Which of the circles it is; the first one is the start.
    pub index: usize,
    pub circle: Circle,
    pub angle: f64,
}

impl Touched {
    /// Which of the turns it is.
    pub fn turn(&self) -> usize {
        self.index - 1
    }
}

/// A way about circles: one line more than circles that it touches.
pub(super) struct DrivenLines {
    pub touched: Vec<Touched>,
    pub lines: Vec<Tangent>,
}

/// The way from the first circle to the last one.
///
/// # Returns
/// The way; where two circles are too near each other for it, which two.
pub(super) fn driven_lines(circles: &[Circle]) -> Result<DrivenLines, (usize, usize)> {
    let numbered = circles.iter().enumerate();
    let mut touched: Vec<Touched> =
        numbered.map(|(index, circle)| Touched { index, circle: *circle, angle: 0.0 }).collect();
    let mut lines = Vec::with_capacity(circles.len());
    loop {
        lines.clear();
        for pair in touched.windows(2) {
            let line = pair[0].circle.tangent_to(&pair[1].circle);
            lines.push(line.ok_or((pair[0].index, pair[1].index))?);
        }
        let mut least: Option<(usize, f64)> = None;
        for (at, line) in lines.windows(2).enumerate() {
            let angle = touched[at + 1].circle.angle(&line[0], &line[1]);
            touched[at + 1].angle = angle.max(0.0);
            if angle < -NOISE && least.is_none_or(|(_, known)| angle < known) {
                least = Some((at + 1, angle));
            }
        }
        let Some((passed_by, _)) = least else { break };
        touched.remove(passed_by);
    }
    touched.pop();
    touched.drain(..1.min(touched.len()));
    Ok(DrivenLines { touched, lines })
}
