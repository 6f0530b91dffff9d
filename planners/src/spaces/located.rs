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
    sides: Vec<Rows>,
    index: RectIndex,
}

/// The sides of an outline by the rows that they cross: a space may have as many as a building has corners.
struct Rows {
    least_y: f64,
    rows: Vec<Vec<Segment>>,
}

/// A row is so high, metres.
const ROW_M: f64 = 1.0;

/// An outline has at most so many rows; what lies above is in the last one.
const MOST_ROWS: usize = 100_000;

impl Rows {
    fn new(sides: impl Iterator<Item = Segment> + Clone) -> Self {
        let least_y = sides.clone().map(|side| side.a.y).fold(f64::INFINITY, f64::min);
        let mut all = Self { least_y, rows: Vec::new() };
        for side in sides {
            let bounds = side.bounds();
            let (first, last) = (all.row(bounds.y0), all.row(bounds.y1));
            if all.rows.len() <= last {
                all.rows.resize(last + 1, Vec::new());
            }
            all.rows[first..=last].iter_mut().for_each(|row| row.push(side));
        }
        all
    }

    fn row(&self, y: f64) -> usize {
        (((y - self.least_y) / ROW_M) as usize).min(MOST_ROWS)
    }

    fn encloses(&self, p: Point) -> bool {
        let row = self.rows.get(self.row(p.y));
        row.is_some_and(|row| polygon::encloses(row.iter().copied(), p))
    }

    /// Metres from a point to the nearest side that is no farther than [`BESIDE_M`]; infinite where none is.
    fn distance(&self, p: Point) -> f64 {
        let (first, last) = (self.row(p.y - BESIDE_M), self.row(p.y + BESIDE_M));
        let near = self.rows.iter().take(last + 1).skip(first).flatten();
        near.map(|side| side.distance(p)).filter(|off| *off <= BESIDE_M).fold(f64::INFINITY, f64::min)
    }
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
        let (mut numbers, mut sides, mut bounds) = (Vec::new(), Vec::new(), Vec::new());
        if let Some(table) = known.get(CLASS) {
            for (number, outline) in table.numbers("space")?.iter().zip(table.texts("outline")?) {
                let (Some(number), Some(outline)) = (number, outline) else { continue };
                let rings: Vec<Vec<[f64; 2]>> = serde_json::from_str(outline)
                    .map_err(|error| format!("the outline of space {number} is no list of rings: {error}"))?;
                let rings = rings.iter().map(|ring| ring.iter().map(|[x, y]| Point::new(*x, *y)).collect());
                let rings: Vec<Vec<Point>> = rings.collect();
                numbers.push(*number);
                bounds.push(Rect::around(rings.iter().flatten().copied()).grown(BESIDE_M));
                sides.push(Rows::new(rings.iter().flat_map(|ring| polygon::sides(ring))));
            }
        }
        Ok(Self { numbers, sides, index: RectIndex::new(bounds) })
    }

    /// The number of the space that a point lies in, or else of the nearest one that it lies beside.
    pub fn at(&self, p: Point) -> Option<f64> {
        let near = self.index.at(p);
        let within = near.iter().find(|&&space| self.sides[space].encloses(p));
        let space = within.copied().or_else(|| {
            let off = |space: &usize| self.sides[*space].distance(p);
            let nearest = near.iter().copied().min_by(|one, two| off(one).total_cmp(&off(two)))?;
            off(&nearest).is_finite().then_some(nearest)
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
