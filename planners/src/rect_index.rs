//! Rectangles, found by the points that they hold.

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::geometry::{Point, Rect};

/// Rectangles by number, found by where they are.
#[derive(Clone, Debug)]
pub struct RectIndex {
    tree: RTree<GeomWithData<Rectangle<[f64; 2]>, u32>>,
}

impl RectIndex {
    pub fn new(rects: impl IntoIterator<Item = Rect>) -> Self {
        let item = |(number, r): (u32, Rect)| {
            GeomWithData::new(Rectangle::from_corners([r.x0, r.y0], [r.x1, r.y1]), number)
        };
        Self { tree: RTree::bulk_load((0..).zip(rects).map(item).collect()) }
    }

    /// The rectangles with their metres from a point, the nearest first.
    pub fn nearest(&self, point: Point) -> impl Iterator<Item = (usize, f64)> {
        let all = self.tree.nearest_neighbor_iter_with_distance_2([point.x, point.y]);
        all.map(|(rect, squared)| (rect.data as usize, squared.sqrt()))
    }

    /// The rectangles that meet another one.
    pub fn meeting(&self, rect: Rect) -> impl Iterator<Item = usize> {
        let about = AABB::from_corners([rect.x0, rect.y0], [rect.x1, rect.y1]);
        self.tree.locate_in_envelope_intersecting(about).map(|rect| rect.data as usize)
    }

    /// The rectangles that hold a point, on their outline or inside, in the order of their numbers.
    pub fn at(&self, point: Point) -> Vec<usize> {
        let mut numbers: Vec<usize> = self.meeting(Rect::new(point.x, point.y, point.x, point.y)).collect();
        numbers.sort_unstable();
        numbers
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn the_rectangles_at_a_point_are_those_that_contain_it(
            rects in prop::collection::vec((0_i8..9, 0_i8..9, 1_i8..5, 1_i8..5), 0..30),
            points in prop::collection::vec((0_i8..28, 0_i8..28), 20),
        ) {
            let rect = |(x, y, width, height): (i8, i8, i8, i8)| {
                Rect::new(x.into(), y.into(), (x + width).into(), (y + height).into())
            };
            let rects: Vec<Rect> = rects.into_iter().map(rect).collect();
            let index = RectIndex::new(rects.iter().copied());
            for (x, y) in points {
                let point = Point::new(f64::from(x) / 2.0, f64::from(y) / 2.0);
                let all: Vec<usize> =
                    (0..rects.len()).filter(|&number| rects[number].contains(point)).collect();
                prop_assert_eq!(index.at(point), all);
            }
        }
    }
}
