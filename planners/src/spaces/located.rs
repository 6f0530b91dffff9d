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
    spaces: Vec<Outlined>,
    /// The least rectangles about the spaces.
    index: RectIndex,
}

struct Outlined {
    number: f64,
    sides: Vec<Segment>,
    index: RectIndex,
    bounds: Rect,
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
        let mut spaces = Vec::new();
        if let Some(table) = known.get(CLASS) {
            for (number, outline) in table.numbers("space")?.iter().zip(table.texts("outline")?) {
                let (Some(number), Some(outline)) = (number, outline) else { continue };
                let rings: Vec<Vec<[f64; 2]>> = serde_json::from_str(outline)
                    .map_err(|error| format!("the outline of space {number} is no list of rings: {error}"))?;
                let mut sides = Vec::new();
                for ring in rings {
                    let ring: Vec<Point> = ring.into_iter().map(|[x, y]| Point::new(x, y)).collect();
                    sides.extend(polygon::sides(&ring));
                }
                if !sides.is_empty() {
                    spaces.push(Outlined::new(*number, sides));
                }
            }
        }
        let index = RectIndex::new(spaces.iter().map(|space| space.bounds));
        Ok(Self { spaces, index })
    }

    /// The number of the space that a point lies in, or else of the nearest one that it lies beside.
    pub fn at(&self, p: Point) -> Option<f64> {
        let within = self.index.at(p).into_iter().find(|&space| self.spaces[space].holds(p));
        let space = within.or_else(|| {
            let about = Rect::around([p]).grown(BESIDE_M);
            let near = self.index.meeting(about).map(|space| (self.spaces[space].metres(p, about), space));
            near.filter(|(off, _)| *off <= BESIDE_M)
                .min_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)))
                .map(|(_, space)| space)
        })?;
        Some(self.spaces[space].number)
    }
}

impl Outlined {
    fn new(number: f64, sides: Vec<Segment>) -> Self {
        let bounds = Rect::around(sides.iter().map(|side| side.a));
        Self { number, index: RectIndex::new(sides.iter().map(Segment::bounds)), bounds, sides }
    }

    fn meeting(&self, rect: Rect) -> impl Iterator<Item = Segment> {
        self.index.meeting(rect).map(|side| self.sides[side])
    }

    /// Whether a point lies inside: then the outline has sides to its right.
    fn holds(&self, p: Point) -> bool {
        polygon::encloses(self.meeting(Rect::new(p.x, p.y, self.bounds.x1.max(p.x), p.y)), p)
    }

    /// Metres from a point to the outline, as far as it lies within a rectangle.
    fn metres(&self, p: Point, within: Rect) -> f64 {
        self.meeting(within).map(|side| side.distance(p)).fold(f64::INFINITY, f64::min)
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
