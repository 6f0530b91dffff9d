//! The straight line through echoes: weighted least squares of the distances from it, with its uncertainty.

use crate::geometry::{Point, Segment};

use super::beam::Beam;

/// No echo is exact, however the beam runs: standard deviation, metres.
const LEAST_M: f64 = 1e-3;

#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    /// The weighted middle of the echoes, on the line.
    pub centre: Point,
    /// Along the line, of length 1.
    pub along: Point,
    /// Standard deviation across the line at its centre, metres.
    pub sigma_m: f64,
    /// Standard deviation of its angle, radians.
    pub sigma_angle: f64,
}

/// An echo and the beam that it came back on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Echo {
    pub at: Point,
    pub beam: usize,
}

impl Fit {
    /// The line that fits echoes best; `None` for fewer than two places.
    pub fn new(echoes: &[Echo], beams: &[Beam]) -> Option<Self> {
        let even = Self::weighted(echoes, |_| 1.0)?;
        // How much a range that is off moves an echo across the line, the first fit tells well enough.
        let deviation = |echo: &Echo| even.deviation(&beams[echo.beam]);
        let mut fit = Self::weighted(echoes, |echo| deviation(echo).powi(-2))?;
        let (mut all, mut spread) = (0.0, 0.0);
        for echo in echoes {
            let weight = deviation(echo).powi(-2);
            all += weight;
            spread += weight * fit.place(echo.at).powi(2);
        }
        fit.sigma_m = all.powf(-0.5);
        fit.sigma_angle = spread.powf(-0.5);
        Some(fit)
    }

    fn weighted(echoes: &[Echo], weight: impl Fn(&Echo) -> f64) -> Option<Self> {
        let (mut all, mut x, mut y) = (0.0, 0.0, 0.0);
        for echo in echoes {
            let w = weight(echo);
            all += w;
            x += w * echo.at.x;
            y += w * echo.at.y;
        }
        let centre = Point::new(x / all, y / all);
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for echo in echoes {
            let (w, dx, dy) = (weight(echo), echo.at.x - centre.x, echo.at.y - centre.y);
            xx += w * dx * dx;
            xy += w * dx * dy;
            yy += w * dy * dy;
        }
        if echoes.len() < 2 || xx + yy <= 0.0 {
            return None;
        }
        let (sin, cos) = (0.5 * (2.0 * xy).atan2(xx - yy)).sin_cos();
        Some(Self { centre, along: Point::new(cos, sin), sigma_m: 0.0, sigma_angle: 0.0 })
    }

    /// Standard deviation of an echo across this line.
    pub fn deviation(&self, beam: &Beam) -> f64 {
        (beam.sigma_m * self.along.cross(beam.towards)).abs().max(LEAST_M)
    }

    /// How far along the line a point lies from its centre.
    pub fn place(&self, p: Point) -> f64 {
        (p - self.centre).dot(self.along)
    }

    /// How far a point lies from the line, to its left above 0.
    pub fn offset(&self, p: Point) -> f64 {
        self.along.cross(p - self.centre)
    }

    /// The point of the line so far from its centre.
    pub fn at(&self, place: f64) -> Point {
        self.centre + self.along * place
    }

    /// The piece of the line beside the echoes, in their order.
    pub fn segment(&self, echoes: &[Echo]) -> Segment {
        let ends = echoes.first().zip(echoes.last());
        let (first, last) = ends.map_or((0.0, 0.0), |(a, b)| (self.place(a.at), self.place(b.at)));
        Segment::new(self.at(first), self.at(last))
    }

    /// Whether all echoes lie on the line, as well as can be told.
    pub fn holds(&self, echoes: &[Echo], beams: &[Beam], sigmas: f64, at_least_m: f64) -> bool {
        let allowed = |echo: &Echo| (sigmas * self.deviation(&beams[echo.beam])).max(at_least_m);
        echoes.iter().all(|echo| self.offset(echo.at).abs() <= allowed(echo))
    }
}
