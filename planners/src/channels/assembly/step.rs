//! What rules are told at a junction, and what they say.

use super::Cuboid;

/// The facts of one step: the part is about to enter junction I, coming from the assembled state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepFacts<const D: usize> {
    /// I; the junction at the mouth is 1.
    pub number: usize,
    /// Junction I: channel I cut with channel I + 1.
    pub junction: Cuboid<D>,
    /// Junction I - 1, for which the part makes next; `None` at junction 1, from which it goes out.
    pub next: Option<Cuboid<D>>,
    pub part: Cuboid<D>,
    /// The axis of channel I + 1, along which the part enters the junction.
    pub entering: usize,
    /// The axis of channel I, along which it will leave the junction.
    pub leaving: usize,
    /// Along each axis the largest gap, (size J(I) - size M) / 2: the safest. Negative where the part is larger
    /// than the junction.
    pub bound: [f64; D],
    /// Whether max J(I-1)z >= max J(I)z (3.2); true at junction 1.
    pub next_is_not_lower: bool,
}

/// To which side of the junction the part keeps its gap along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Margin {
    /// To the side of small coordinates: left, down.
    Low,
    /// To the side of large coordinates: right, up.
    High,
    /// It stays where it is, as far as the gap to both sides allows.
    Keep,
}

/// Where in a junction the part goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decision<const D: usize> {
    /// The number of the rule that said so; handed through to [`Leg::rule`](super::Leg::rule).
    pub rule: Option<f64>,
    /// What is kept between part and junction along each axis, in metres.
    pub gap: [f64; D],
    pub margin: [Margin; D],
}

impl<const D: usize> Decision<D> {
    /// The lower left corner of the part once it has gone there.
    pub fn target(&self, junction: &Cuboid<D>, part: &Cuboid<D>) -> [f64; D] {
        std::array::from_fn(|axis| {
            let low = junction.min[axis] + self.gap[axis];
            let high = junction.max[axis] - self.gap[axis] - part.size(axis);
            match self.margin[axis] {
                Margin::Low => low,
                Margin::High => high,
                Margin::Keep => part.min[axis].min(high).max(low),
            }
        })
    }
}
