//! The judge itself is right: where the best way is known in closed form, it finds it, and so does the program.

use adit_planners::geometry::Point;
use adit_tests::oracle::body::Body;
use adit_tests::oracle::grid::Grid;
use adit_tests::oracle::plan::Plan;
use adit_tests::oracle::site::Built;
use adit_tests::oracle::space::Space;

/// Metres between the points of the judge's grid.
const STEP: f64 = 0.05;

fn disc(width: f64) -> Body {
    Body::new(&[("STAND", 1.7, width, 1.0)])
}

/// Costs of the best way: over the grid, drawn taut, and as the program drives it.
fn costs(plan: &Plan, body: &Body, start: Point, goal: Point) -> [f64; 3] {
    let space = Space::new(&plan.world(), body, 0.0).with_areas(&plan.areas);
    let grid = Grid::new(&space, STEP);
    let ways = grid.ways_from(start);
    // So fine a grid that what its cells cost round a corner is within one per cent.
    let built = Built::of_plan(plan, body, 0.02);
    [
        ways.over_the_grid(goal).unwrap().cost(&space),
        ways.to(goal).unwrap().cost(&space),
        built.route(start, goal).unwrap().cost,
    ]
}

#[track_caller]
fn expect(plan: &Plan, body: &Body, start: (f64, f64), goal: (f64, f64), best: f64) {
    let [grid, taut, driven] = costs(plan, body, Point::new(start.0, start.1), Point::new(goal.0, goal.1));
    let off = |cost: f64| cost / best - 1.0;
    let said = format!("best {best:.4}, grid {grid:.4}, taut {taut:.4}, driven {driven:.4}");
    assert!((-1e-6..0.01).contains(&off(grid)), "{said}");
    assert!((-1e-6..0.002).contains(&off(taut)), "{said}");
    assert!((-1e-6..0.01).contains(&off(driven)), "{said}");
}

#[test]
fn across_an_empty_hall_the_way_is_straight() {
    let hall = Plan::hall(10.0, 8.0);
    for goal in [(9.0, 1.0), (9.0, 2.0), (9.0, 4.37), (8.123, 7.2), (1.0, 7.0)] {
        expect(&hall, &disc(0.6), (1.0, 1.0), goal, (goal.0 - 1.0f64).hypot(goal.1 - 1.0));
    }
}

#[test]
fn round_a_wall_the_way_is_two_tangents_two_arcs_and_the_wall_between() {
    // Tangents to the discs about the wall's two corners, then along its end.
    let (radius, start, goal) = (0.4, (1.0, 2.0), (9.0, 3.0));
    let tangent = |p: (f64, f64), corner: (f64, f64)| {
        let (dx, dy) = ((corner.0 - p.0).abs(), corner.1 - p.1);
        let away = dx.hypot(dy);
        let length = (away * away - radius * radius).sqrt();
        // The way climbs at this angle, and has turned by it where it runs along the wall's end.
        (length, (dy / dx).atan() + (radius / away).asin())
    };
    let (up, turn1) = tangent(start, (4.8, 5.0));
    let (down, turn2) = tangent(goal, (5.2, 5.0));
    let best = up + down + radius * (turn1 + turn2) + 0.4;
    let plan = Plan::hall(10.0, 8.0).with_rect(4.8, 0.0, 5.2, 5.0);
    expect(&plan, &disc(2.0 * radius), start, goal, best);
}

#[test]
fn between_two_weights_the_way_is_refracted() {
    // Under a low roof from x = 4 on only the low state fits; the tall one keeps its radius from it.
    let plan = Plan::hall(10.0, 8.0).with_bridge(4.3, 0.0, 10.0, 8.0, 1.2);
    let body = Body::new(&[("STAND", 1.7, 0.6, 1.0), ("SQUAT", 1.0, 0.6, 2.0)]);
    let (start, goal): ((f64, f64), (f64, f64)) = ((1.0, 1.0), (7.0, 7.0));
    let cost = |y: f64| (4.0 - start.0).hypot(y - start.1) + 2.0 * (goal.0 - 4.0f64).hypot(goal.1 - y);
    // The sine of the angle is twice as large in the lighter half (Snell): where both terms' slopes cancel.
    let (mut low, mut high) = (start.1, goal.1);
    for _ in 0..100 {
        let third = (high - low) / 3.0;
        if cost(low + third) < cost(high - third) { high -= third } else { low += third }
    }
    let sines = [(low - 1.0) / 3.0f64.hypot(low - 1.0), (7.0 - low) / 3.0f64.hypot(7.0 - low)];
    assert!((sines[0] / sines[1] - 2.0).abs() < 1e-6);
    expect(&plan, &body, start, goal, cost(low));
}

#[test]
fn in_a_wet_half_of_a_hall_the_way_is_refracted_too() {
    let plan = Plan::hall(10.0, 8.0).with_area(4.0, 0.0, 10.0, 8.0, 2.0);
    let cost = |y: f64| 3.0f64.hypot(y - 1.0) + 2.0 * 3.0f64.hypot(7.0 - y);
    let best = (0..=60_000).map(|step| cost(1.0 + f64::from(step) / 1e4)).fold(f64::INFINITY, f64::min);
    expect(&plan, &disc(0.6), (1.0, 1.0), (7.0, 7.0), best);
}

#[test]
fn along_the_edge_of_a_wet_floor_the_way_stays_dry_as_long_as_that_pays() {
    // it begins on the line of the edge, and leaves the edge at 60 degrees
    let plan = Plan::hall(10.0, 8.0).with_area(4.0, 3.0, 10.0, 8.0, 2.0);
    let aside = 0.5 / 3.0f64.sqrt();
    expect(&plan, &disc(0.6), (4.0, 1.0), (4.5, 7.0), 6.0 - aside + 2.0 * 0.5f64.hypot(aside));
}

#[test]
fn who_stands_on_a_wet_floor_goes_along_its_dry_edge_and_back_onto_it() {
    let plan = Plan::hall(10.0, 6.0).with_area(0.0, 0.0, 10.0, 2.0, 2.0);
    let dry = 8.0 + 2.0 * 0.1 * (2.0f64.powi(2) - 1.0).sqrt();
    expect(&plan, &disc(0.5), (1.0, 1.9), (9.0, 1.9), dry);
}

#[test]
fn under_a_pipe_the_shape_is_changed_just_before_and_just_behind() {
    let plan = Plan::hall(12.0, 2.0).with_bridge(5.0, 0.0, 5.5, 2.0, 1.2);
    let body = Body::new(&[("STAND", 1.7, 0.6, 1.0), ("SQUAT", 1.0, 0.8, 4.0)])
        .with_changes(&[(0, 1, 0.5), (1, 0, 1.0)]);
    expect(&plan, &body, (1.0, 1.0), (11.0, 1.0), 10.0 + 3.0 * (0.5 + 2.0 * 0.3) + 1.5);
    // To end under the pipe there is nothing to stand up for.
    expect(&plan, &body, (1.0, 1.0), (5.2, 1.0), 3.7 + 4.0 * 0.5 + 0.5);
}

#[test]
fn before_a_gap_that_is_too_narrow_the_shape_is_changed_as_deep_in_it_as_it_fits() {
    let (wall, gap, radius) = (0.1, 0.5f64, 0.3f64);
    let plan = Plan::hall(12.0, 4.0)
        .with_rect(6.0 - wall / 2.0, 0.0, 6.0 + wall / 2.0, 2.0 - gap / 2.0)
        .with_rect(6.0 - wall / 2.0, 2.0 + gap / 2.0, 6.0 + wall / 2.0, 4.0);
    let body = Body::new(&[("STAND", 1.7, 2.0 * radius, 1.0), ("SIDE", 1.7, 0.36, 2.0)]);
    let before = (radius.powi(2) - (gap / 2.0).powi(2)).sqrt();
    expect(&plan, &body, (1.0, 2.0), (11.0, 2.0), 10.0 + wall + 2.0 * before);
}

#[test]
fn two_changes_at_one_point_are_made_where_they_cost_less_than_one() {
    let plan = Plan::hall(12.0, 2.0).with_bridge(5.0, 0.0, 5.5, 2.0, 0.6);
    let states = [("STAND", 1.7, 0.6, 1.0), ("KNEEL", 1.0, 0.6, 3.0), ("LIE", 0.5, 0.6, 4.0)];
    let steps = [(0, 1, 0.5), (1, 2, 0.75), (2, 1, 0.25), (1, 0, 0.5)];
    let way = 10.0 + 3.0 * (0.5 + 2.0 * 0.3);
    let dear = [steps.as_slice(), &[(0, 2, 5.0), (2, 0, 5.0)]].concat();
    expect(&plan, &Body::new(&states).with_changes(&dear), (1.0, 1.0), (11.0, 1.0), way + 2.0);
    let cheap = [steps.as_slice(), &[(0, 2, 1.0), (2, 0, 0.5)]].concat();
    expect(&plan, &Body::new(&states).with_changes(&cheap), (1.0, 1.0), (11.0, 1.0), way + 1.5);
}

#[test]
fn a_dear_change_is_worth_a_detour_and_a_cheap_one_is_not() {
    let plan = Plan::hall(10.0, 6.0).with_bridge(4.8, 0.0, 5.2, 4.0, 1.2);
    let body = Body::new(&[("STAND", 1.7, 0.6, 1.0), ("SQUAT", 1.0, 0.6, 2.0)]);
    let straight = 8.0 + 1.0;
    let (dx, dy) = (4.8 - 1.0f64, 4.0 - 1.0f64);
    let away = dx.hypot(dy);
    let turn = (dy / dx).atan() + (0.3 / away).asin();
    let round = 2.0 * ((away * away - 0.09).sqrt() + 0.3 * turn) + 0.4;
    let cheap = body.clone().with_changes(&[(0, 1, 0.1), (1, 0, 0.1)]);
    expect(&plan, &cheap, (1.0, 1.0), (9.0, 1.0), straight + 0.2);
    let dear = body.with_changes(&[(0, 1, 3.0), (1, 0, 3.0)]);
    expect(&plan, &dear, (1.0, 1.0), (9.0, 1.0), round);
}
