//! Every two rooms with a common boundary have one door.

use adit_planners::doors::shared_edges;
use adit_planners::geometry::Rect;
use adit_planners::minimum::fewest_rects;
use proptest::prelude::*;

use crate::rooms::maps::{BOUNDS, any_map};

/// The boundary segment that two disjoint rectangles share, if it has a length.
fn common_boundary(a: &Rect, b: &Rect) -> Option<Rect> {
    let common = Rect::new(a.x0.max(b.x0), a.y0.max(b.y0), a.x1.min(b.x1), a.y1.min(b.y1));
    let is_segment = common.dx() >= 0.0 && common.dy() >= 0.0 && common.dx().max(common.dy()) > 0.0;
    is_segment.then_some(common)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]

    #[test]
    fn every_two_rooms_with_a_common_boundary_have_one(map in any_map()) {
        let rooms = fewest_rects(BOUNDS, &map.obstacles);
        let mut expected = Vec::new();
        for (i, a) in rooms.iter().enumerate() {
            for (j, b) in rooms.iter().enumerate().skip(i + 1) {
                expected.extend(common_boundary(a, b).map(|segment| (i, j, segment)));
            }
        }
        let found: Vec<_> = shared_edges(&rooms).iter().map(|door| (door.first, door.second, door.segment)).collect();
        prop_assert_eq!(found, expected);
    }
}

#[test]
fn rooms_that_touch_at_a_corner_have_none() {
    assert_eq!(shared_edges(&[Rect::new(0.0, 0.0, 1.0, 1.0), Rect::new(1.0, 1.0, 2.0, 2.0)]), []);
}

#[test]
fn zero_has_no_sign() {
    let rooms = [Rect::new(-1.0, 0.0, -0.0, 1.0), Rect::new(0.0, 0.0, 1.0, 1.0)];
    assert_eq!(shared_edges(&rooms).len(), 1);
}
