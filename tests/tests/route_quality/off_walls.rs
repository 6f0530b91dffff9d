//! By the shipped rules routes keep 5 cm off walls where there is space, at hardly a cost.

use adit_planners::geometry::{Point, Segment};
use adit_tests::oracle::body::Body;
use adit_tests::oracle::driven::Driven;
use adit_tests::oracle::judge::{Findings, Judge};
use adit_tests::oracle::random::Chance;
use adit_tests::oracle::site::Built;
use adit_tests::oracle::space::Space;
use adit_tests::shared;

/// Of how many centimetres of a route 5 cm beside the robot's rim are free, and how many there are.
fn off_walls(driven: &Driven, space: &Space) -> (usize, usize) {
    let free = |piece: &adit_tests::oracle::way::Piece| {
        let line = Segment::new(piece.from, piece.to);
        let steps = (line.length() / 0.01).round() as usize;
        let at = |step: usize| line.at((step as f64 + 0.5) / steps as f64);
        let is_free = |step: &usize| space.spare(piece.state, at(*step), at(*step)) >= 0.05 - 1e-4;
        ((0..steps).filter(is_free).count(), steps)
    };
    driven.way.pieces().map(|piece| free(&piece)).fold((0, 0), |sum, of| (sum.0 + of.0, sum.1 + of.1))
}

#[test]
fn in_a_bookstore_routes_keep_off_walls_are_free_and_cost_at_most_one_in_a_hundred_more() {
    let Some(map) = shared("data/aws-robomaker/bookstore_map.yaml") else { return };
    let body = Body::new(&[("DRIVE", 1.2, 0.35, 1.0), ("TUCKED", 0.5, 0.22, 3.0)])
        .with_changes(&[(0, 1, 0.5), (1, 0, 0.5)]);
    let (tight, wide) = (Built::of_map(&map, &body), Built::of_map_off_walls(&map, &body));
    let judge = Judge::new(&wide, wide.world.occupancy.as_ref().expect("an image").resolution);
    let start = Point::new(-2.5, 6.2);
    let mut found = Findings::default();
    let (mut before, mut now) = ((0, 0), (0, 0));
    for goal in judge.points(&mut Chance::new(3), 24) {
        let (Some(tight), Some(wide)) = (tight.route(start, goal), wide.route(start, goal)) else { continue };
        judge.look_at(&wide, &format!("to {goal:?}"), (start, goal), &mut found);
        assert!(wide.cost <= 1.01 * tight.cost, "{} for {} to {goal:?}", wide.cost, tight.cost);
        for (sum, driven) in [(&mut before, &tight), (&mut now, &wide)] {
            let of = off_walls(driven, judge.space());
            *sum = (sum.0 + of.0, sum.1 + of.1);
        }
    }
    assert!(found.wrong.is_empty() && found.silly.is_empty(), "{found:#?}");
    let share = |(free, all): (usize, usize)| free as f64 / all as f64;
    assert!(
        now.1 > 5_000 && share(now) > 0.9 && share(now) > share(before) + 0.05,
        "{before:?}, then {now:?}"
    );
}
