//! The way of the part, and how near it comes to the walls.

use super::sweep::Sweep;
use super::{Assembly, Cuboid, Decision, StepFacts};

/// A way of the part, out of the assembly or into it.
#[derive(Clone, Debug, PartialEq)]
pub struct PartPath<const D: usize> {
    /// Where the part's corner with the smallest coordinates is, from start to end.
    pub waypoints: Vec<[f64; D]>,
    /// From each waypoint to the next.
    pub legs: Vec<Leg<D>>,
    /// The distance from the nearest wall at each waypoint, in metres.
    pub clearances: Vec<f64>,
    /// In metres.
    pub length: f64,
    /// The least distance from a wall on the whole way, in metres.
    pub min_clearance: f64,
}

/// A straight part of the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg<const D: usize> {
    /// The junction in which it ends (when the part is taken out); 0 for what comes after junction 1.
    pub junction: usize,
    pub rule: Option<f64>,
    pub displacement: [f64; D],
    /// The least distance from a wall, in metres.
    pub min_clearance: f64,
}

impl<const D: usize> PartPath<D> {
    /// The same way in the other sense: how the part is put in. Exact: what is reversed twice is as before.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let mut back = self.clone();
        back.waypoints.reverse();
        back.clearances.reverse();
        back.legs.reverse();
        for leg in &mut back.legs {
            leg.displacement = leg.displacement.map(|by| 0.0 - by);
        }
        back
    }
}

/// Why there is no way.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PathError<const D: usize, E> {
    #[error("at junction {junction}: {reason}")]
    Undecided { junction: usize, reason: E },
    #[error("at junction {junction} the gap along axis {axis} is {gap}; expected a finite number of metres")]
    BadGap {
        junction: usize,
        /// The axis, from 0.
        axis: usize,
        gap: f64,
    },
    /// The part would hit a wall: it was sent out of the channel.
    #[error("on its way to {} the part hits the wall {wall}, when it is at {part}", goal(*junction))]
    Collides {
        /// The junction of the leg; 0 for the way out.
        junction: usize,
        part: Cuboid<D>,
        wall: Cuboid<D>,
    },
    #[error(
        "the displacement leaves the part at z = {height}; expected a finite one, and z of at least {top}, the top"
    )]
    NotOut { height: f64, top: f64 },
}

fn goal(junction: usize) -> String {
    if junction == 0 { "the outside".to_owned() } else { format!("junction {junction}") }
}

impl<const D: usize> Assembly<D> {
    /// Takes the part out: through all junctions from the last to the first, to the place in each that `decide` says,
    /// then along +z until it is disassembled (definition 3.2: its lower side as high as the free
    /// space).
    ///
    /// A `displacement`, from the assembled state to the final one, adds what follows outside: first up to the
    /// final height and then across. So nothing outside is nearer to a wall than the nearer of the two places
    /// that it leads from and to; lower than the top it is refused.
    ///
    /// Complexity: O(n w) for n channels and w walls.
    pub fn disassemble<E>(
        &self,
        displacement: Option<[f64; D]>,
        mut decide: impl FnMut(&StepFacts<D>) -> Result<Decision<D>, E>,
    ) -> Result<PartPath<D>, PathError<D, E>> {
        let mut way = Way::new(self);
        for index in (0..self.junctions().len()).rev() {
            let facts = self.facts(index, &way.part);
            let number = facts.number;
            let decision =
                decide(&facts).map_err(|reason| PathError::Undecided { junction: number, reason })?;
            if let Some(axis) = decision.gap.iter().position(|gap| !gap.is_finite()) {
                return Err(PathError::BadGap { junction: number, axis, gap: decision.gap[axis] });
            }
            way.go(number, decision.rule, decision.target(&facts.junction, &way.part))?;
        }
        for target in self.outside(way.part.min, displacement)? {
            if (0..D).any(|axis| (target[axis] - way.part.min[axis]).abs() > 0.0) {
                way.go(0, None, target)?;
            }
        }
        Ok(way.path)
    }

    /// What a rule is told when the part is about to enter the junction with this index.
    fn facts(&self, index: usize, part: &Cuboid<D>) -> StepFacts<D> {
        let junction = self.junctions()[index];
        let next = index.checked_sub(1).map(|next| self.junctions()[next]);
        StepFacts {
            number: index + 1,
            junction,
            next,
            part: *part,
            entering: self.axes()[index + 1],
            leaving: self.axes()[index],
            bound: std::array::from_fn(|axis| (junction.size(axis) - part.size(axis)) / 2.0),
            next_is_not_lower: next.is_none_or(|next| next.max[D - 1] >= junction.max[D - 1]),
        }
    }

    /// Where the part goes from junction 1: out, up, across.
    fn outside<E>(
        &self,
        from: [f64; D],
        displacement: Option<[f64; D]>,
    ) -> Result<[[f64; D]; 3], PathError<D, E>> {
        let top = self.top();
        let at = |height: f64| {
            let mut place = from;
            place[D - 1] = height;
            place
        };
        let Some(displacement) = displacement else { return Ok([at(top); 3]) };
        let end = self.part().moved(&displacement).min;
        let height = end[D - 1];
        let is_out = height >= top - self.tolerance() && end.iter().all(|value| value.is_finite());
        if is_out { Ok([at(top), at(height), end]) } else { Err(PathError::NotOut { height, top }) }
    }
}

struct Way<'a, const D: usize> {
    assembly: &'a Assembly<D>,
    part: Cuboid<D>,
    path: PartPath<D>,
}

impl<'a, const D: usize> Way<'a, D> {
    fn new(assembly: &'a Assembly<D>) -> Self {
        let part = assembly.part();
        let legs = assembly.junctions().len() + 3;
        let clearance = assembly.clearance(&part);
        let mut path = PartPath {
            waypoints: Vec::with_capacity(legs + 1),
            legs: Vec::with_capacity(legs),
            clearances: Vec::with_capacity(legs + 1),
            length: 0.0,
            min_clearance: clearance,
        };
        path.waypoints.push(part.min);
        path.clearances.push(clearance);
        Self { assembly, part, path }
    }

    /// Moves the part along a line, unless it would hit a wall.
    ///
    /// Two boxes within one channel hold all between them within it, since it is convex: a part that goes from
    /// junction to junction with gaps of 0 and more, up to the bound, never hits. What is looked for here is the
    /// part that was sent out of a junction, by a gap beyond the bound or below 0.
    fn go<E>(&mut self, junction: usize, rule: Option<f64>, target: [f64; D]) -> Result<(), PathError<D, E>> {
        let displacement: [f64; D] = std::array::from_fn(|axis| target[axis] - self.part.min[axis]);
        let walls = self.assembly.unbounded_walls();
        let sweep = Sweep::new(&self.part, &displacement);
        let squared = sweep.squared_clearance(walls);
        if squared <= 0.0
            && let Some((share, wall)) = sweep.collision(walls, self.assembly.tolerance())
        {
            let part = self.part.moved(&displacement.map(|by| by * share));
            return Err(PathError::Collides { junction, part, wall });
        }
        let min_clearance = squared.sqrt();
        let size: [f64; D] = std::array::from_fn(|axis| self.assembly.part().size(axis));
        self.part = Cuboid::new(target, std::array::from_fn(|axis| target[axis] + size[axis]));
        self.path.waypoints.push(target);
        self.path.clearances.push(self.assembly.clearance(&self.part));
        self.path.legs.push(Leg { junction, rule, displacement, min_clearance });
        self.path.length += displacement.iter().map(|by| by * by).sum::<f64>().sqrt();
        self.path.min_clearance = self.path.min_clearance.min(min_clearance);
        Ok(())
    }
}
