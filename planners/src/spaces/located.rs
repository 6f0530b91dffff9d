//! Which space a point lies in, by the outlines of known spaces.

use crate::facts::Facts;
use crate::geometry::{Point, Rect, Segment, polygon};
use crate::planner::PlannerError;
use crate::rect_index::RectIndex;

/// What is needed of spaces, where there are any.
pub(crate) const NEEDS: [&str; 2] = ["SPACES.space?", "SPACES.outline?"];

const CLASS: &str = "SPACES";

/// Outlines run along cells: what lies so near to one, metres, may be of its space.
const BESIDE_M: f64 = 0.5;

/// The spaces of a building, found by points.
pub(crate) struct Located {
    numbers: Vec<f64>,
    /// The sides of all outlines, each with the place of its space.
    sides: Vec<(usize, Segment)>,
    index: RectIndex,
    /// No outline reaches farther to the right.
    right: f64,
}

impl Located {
    /// Of the known class `SPACES`; of none where that is not known.
    pub fn read(planner: &str, known: &Facts) -> Result<Self, PlannerError> {
        Self::of(known).map_err(|what| {
            let (planner, class) = (planner.to_owned(), CLASS.to_owned());
            PlannerError::Fact { planner, class, what }
        })
    }

    fn of(known: &Facts) -> Result<Self, String> {
        let (mut numbers, mut sides) = (Vec::new(), Vec::new());
        if let Some(table) = known.get(CLASS) {
            for (number, outline) in table.numbers("space")?.iter().zip(table.texts("outline")?) {
                let (Some(number), Some(outline)) = (number, outline) else { continue };
                let rings: Vec<Vec<[f64; 2]>> = serde_json::from_str(outline)
                    .map_err(|error| format!("the outline of space {number} is no list of rings: {error}"))?;
                for ring in rings {
                    let ring: Vec<Point> = ring.into_iter().map(|[x, y]| Point::new(x, y)).collect();
                    sides.extend(polygon::sides(&ring).map(|side| (numbers.len(), side)));
                }
                numbers.push(*number);
            }
        }
        let bounds: Vec<Rect> = sides.iter().map(|(_, side)| side.bounds()).collect();
        let right = bounds.iter().map(|bounds| bounds.x1).fold(f64::NEG_INFINITY, f64::max);
        Ok(Self { numbers, sides, index: RectIndex::new(bounds), right })
    }

    /// The number of the space that a point lies in, or else of the nearest one that it lies beside.
    pub fn at(&self, p: Point) -> Option<f64> {
        let meeting = |rect: Rect| self.index.meeting(rect).map(|side| self.sides[side]);
        // what encloses it has sides to its right
        let mut beyond: Vec<(usize, Segment)> =
            meeting(Rect::new(p.x, p.y, self.right.max(p.x), p.y)).collect();
        beyond.sort_by_key(|(space, _)| *space);
        let mut of_spaces = beyond.chunk_by(|one, other| one.0 == other.0);
        let within = of_spaces
            .find(|sides| polygon::encloses(sides.iter().map(|(_, side)| *side), p))
            .map(|sides| sides[0].0);
        let space = within.or_else(|| {
            let off =
                meeting(Rect::around([p]).grown(BESIDE_M)).map(|(space, side)| (side.distance(p), space));
            let near = off.filter(|(off, _)| *off <= BESIDE_M);
            near.min_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)))
                .map(|(_, space)| space)
        })?;
        Some(self.numbers[space])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::facts::{Column, Table};

    #[test]
    fn a_point_is_of_the_space_about_it_or_of_the_nearest_beside_it() {
        let outlines = [
            "[[[0,0],[4,0],[4,4],[0,4]],[[1,1],[1,3],[3,3],[3,1]]]",
            "[[[1.2,1.2],[2.8,1.2],[2.8,2.8],[1.2,2.8]]]",
        ];
        let table = Table::default()
            .with("space", Column::Number(vec![Some(1.0), Some(2.0)]))
            .with("outline", outlines.map(str::to_owned).into_iter().collect::<Column>());
        let located = Located::of(&Facts::from([(CLASS.to_owned(), table)])).unwrap();
        for (at, space) in [
            ((0.5, 0.5), Some(1.0)),
            ((2.0, 2.0), Some(2.0)),
            ((1.05, 2.0), Some(1.0)),
            ((1.15, 2.0), Some(2.0)),
            ((4.4, 2.0), Some(1.0)),
            ((4.6, 2.0), None),
        ] {
            assert_eq!(located.at(Point::new(at.0, at.1)), space, "at {at:?}");
        }
        assert_eq!(Located::of(&Facts::new()).unwrap().at(Point::new(0.0, 0.0)), None);
    }
}
