//! What must not change a route, or may change it in one direction only.

use adit_planners::geometry::{Point, Rect};
use adit_planners::world::Shape;
use adit_tests::oracle::body::Body;
use adit_tests::oracle::buildings;
use adit_tests::oracle::grid::Grid;
use adit_tests::oracle::judge::{Findings, Judge};
use adit_tests::oracle::plan::Plan;
use adit_tests::oracle::random::Chance;
use adit_tests::oracle::site::Built;
use adit_tests::oracle::space::Space;
use adit_tests::oracle::way::Way;

/// Side of the layers' cells, metres.
const GRID: f64 = 0.025;
/// How much a cost may differ.
const SAME: f64 = 0.02;

/// A floor with a robot and points on it between which the answer does not hang on a cell.
struct Case {
    name: String,
    plan: Plan,
    body: Body,
    start: Point,
    goals: Vec<Point>,
}

/// Cases by chance; `level` ones have no bridges.
fn cases(seeds: std::ops::Range<u64>, level: bool) -> Vec<Case> {
    cases_of(buildings::body, seeds, level)
}

fn cases_of(body: fn(&mut Chance) -> Body, seeds: std::ops::Range<u64>, level: bool) -> Vec<Case> {
    let case = |seed: u64| {
        let mut chance = Chance::new(500 + seed);
        let mut plan =
            if seed.is_multiple_of(2) { buildings::hall(&mut chance) } else { buildings::wards(&mut chance) };
        if level {
            plan.bridges.clear();
        }
        let body = body(&mut chance);
        let built = Built::of_plan(&plan, &body, GRID);
        let mut points = Judge::new(&built, GRID).points(&mut chance, 5).into_iter();
        let start = points.next()?;
        let space = |margin: f64| Space::new(&built.world, &body, margin);
        let spaces = [space(0.0), space(3.0 * GRID * 2f64.sqrt())];
        let grids = spaces.each_ref().map(|space| Grid::new(space, 2.0 * GRID));
        let [ways, shy] = grids.each_ref().map(|grid| grid.ways_from(start));
        let cost = |way: Option<Way>| way.map(|way| way.cost(&spaces[0]));
        // Where a passage is so narrow that it may be one or none, both answers are right.
        let plain = |goal: &Point| match (cost(ways.over_the_grid(*goal)), cost(shy.over_the_grid(*goal))) {
            (Some(best), Some(shy)) => shy < 1.03 * best,
            (best, shy) => best.is_none() && shy.is_none(),
        };
        let goals: Vec<Point> = points.filter(plain).collect();
        Some(Case { name: format!("seed {}", 500 + seed), plan, body, start, goals })
    };
    let cases: Vec<Case> = seeds.filter_map(case).collect();
    let goals: usize = cases.iter().map(|case| case.goals.len()).sum();
    assert!(goals >= 2 * cases.len(), "{goals} goals: hardly anything is tested");
    cases
}

impl Case {
    fn costs(&self) -> Vec<Option<f64>> {
        costs(&self.plan, &self.body, self.start, &self.goals)
    }
}

fn costs(plan: &Plan, body: &Body, start: Point, goals: &[Point]) -> Vec<Option<f64>> {
    let built = Built::of_plan(plan, body, GRID);
    goals.iter().map(|&goal| built.route(start, goal).map(|route| route.cost)).collect()
}

/// What is wrong where costs should be the same but for `allowed`, as a part of them.
fn differences(case: &Case, now: &[Option<f64>], allowed: f64) -> Vec<String> {
    let pairs = case.costs().into_iter().zip(now).zip(&case.goals);
    let wrong = pairs.filter(|((was, now), _)| match (was, now) {
        (Some(was), Some(now)) => (now / was - 1.0).abs() > allowed,
        (was, now) => was.is_some() != now.is_some(),
    });
    let Case { name, start, .. } = case;
    wrong
        .map(|((was, now), goal)| {
            format!("{name}: {},{} to {},{}: {was:?}, then {now:?}", start.x, start.y, goal.x, goal.y)
        })
        .collect()
}

#[track_caller]
fn expect_none(wrong: &[String]) {
    assert!(wrong.is_empty(), "{}: {wrong:#?}", wrong.len());
}

#[test]
fn a_map_turned_by_a_quarter_has_the_same_routes() {
    let mut wrong = Vec::new();
    for case in cases(0..6, false) {
        let (plan, turn) = case.plan.quarter_turned();
        let goals: Vec<Point> = case.goals.iter().map(|&goal| turn(goal)).collect();
        wrong.extend(differences(&case, &costs(&plan, &case.body, turn(case.start), &goals), SAME));
    }
    expect_none(&wrong);
}

#[test]
fn a_map_turned_by_any_angle_has_the_same_routes() {
    let mut wrong = Vec::new();
    for (case, degrees) in cases(10..16, true).iter().zip([10.0, 45.0].into_iter().cycle()) {
        let (plan, turn) = case.plan.turned(degrees);
        let goals: Vec<Point> = case.goals.iter().map(|&goal| turn(goal)).collect();
        let now = costs(&plan, &case.body, turn(case.start), &goals);
        let found = differences(case, &now, SAME);
        wrong.extend(found.into_iter().map(|said| format!("by {degrees} degrees: {said}")));
    }
    expect_none(&wrong);
}

#[test]
fn an_obstacle_cut_in_two_is_the_same_obstacle() {
    let mut wrong = Vec::new();
    for case in cases(20..26, false) {
        let mut plan = case.plan.clone();
        plan.obstacles = case.plan.obstacles.iter().flat_map(cut_in_two).collect();
        assert!(plan.obstacles.len() > case.plan.obstacles.len());
        wrong.extend(differences(&case, &costs(&plan, &case.body, case.start, &case.goals), SAME));
    }
    expect_none(&wrong);
}

/// A rectangle as two beside each other; a polygon as it is.
fn cut_in_two(shape: &Shape) -> Vec<Shape> {
    let Shape::Rect(r) = shape else { return vec![shape.clone()] };
    let at = r.x0 + 0.37 * r.dx();
    vec![Shape::Rect(Rect::new(r.x0, r.y0, at, r.y1)), Shape::Rect(Rect::new(at, r.y0, r.x1, r.y1))]
}

#[test]
fn an_obstacle_within_a_wall_changes_nothing() {
    let mut wrong = Vec::new();
    for case in cases(30..36, false) {
        let mut plan = case.plan.clone();
        for shape in &case.plan.obstacles {
            if let Shape::Rect(r) = shape {
                let (dx, dy) = (r.dx() / 4.0, r.dy() / 4.0);
                plan.add(Rect::new(r.x0 + dx, r.y0 + dy, r.x1 - dx, r.y1 - dy));
            }
        }
        wrong.extend(differences(&case, &costs(&plan, &case.body, case.start, &case.goals), SAME));
    }
    expect_none(&wrong);
}

#[test]
fn the_names_of_states_mean_nothing() {
    let mut wrong = Vec::new();
    for case in cases(40..46, false) {
        let mut body = case.body.clone();
        for (state, name) in body.states.iter_mut().zip(["z", "middle", "a b", "Ä"]) {
            name.clone_into(&mut state.name);
        }
        wrong.extend(differences(&case, &costs(&case.plan, &body, case.start, &case.goals), 1e-9));
    }
    expect_none(&wrong);
}

#[test]
fn the_order_of_states_means_nothing() {
    let mut wrong = Vec::new();
    for case in cases(50..56, false) {
        let last = case.body.states.len() - 1;
        let mut body = case.body.clone();
        body.states.reverse();
        body.changes.iter_mut().for_each(|change| *change = (last - change.0, last - change.1, change.2));
        wrong.extend(differences(&case, &costs(&case.plan, &body, case.start, &case.goals), SAME));
    }
    expect_none(&wrong);
}

#[test]
fn a_kept_route_between_places_is_that_between_their_points() {
    let (mut wrong, mut found) = (Vec::new(), Findings::default());
    let uneven = cases_of(buildings::uneven_body, 90..96, false);
    for case in cases(80..86, false).into_iter().chain(uneven) {
        let names = ["one", "two", "three", "four"];
        let goals: Vec<(&str, Point)> = names.into_iter().zip(case.goals.iter().copied()).collect();
        let places: Vec<(&str, Point)> = std::iter::once(("here", case.start)).chain(goals.clone()).collect();
        let built = Built::of_plan_and_places(&case.plan, &case.body, GRID, &places);
        let judge = Judge::new(&built, GRID);
        let mut now = Vec::new();
        for (name, goal) in goals {
            let route = built.route_by_name("here", name, case.start);
            now.push(route.as_ref().map(|route| route.cost));
            if let Some(route) = route {
                judge.look_at(
                    &route,
                    &format!("{}, kept, to {name}", case.name),
                    (case.start, goal),
                    &mut found,
                );
            }
        }
        wrong.extend(differences(&case, &now, 1e-3));
    }
    expect_none(&wrong);
    expect_none(&found.wrong);
    expect_none(&found.silly);
}

#[test]
fn the_way_back_costs_the_same_where_changes_cost_nothing() {
    let mut wrong = Vec::new();
    for case in cases(90..96, false) {
        let case = Case { body: case.body.clone().with_changes(&[]), ..case };
        let built = Built::of_plan(&case.plan, &case.body, GRID);
        let back = |&goal: &Point| built.route(goal, case.start).map(|route| route.cost);
        let now: Vec<Option<f64>> = case.goals.iter().map(back).collect();
        wrong.extend(differences(&case, &now, SAME));
    }
    expect_none(&wrong);
}

#[test]
fn one_more_obstacle_makes_no_route_cheaper() {
    let mut wrong = Vec::new();
    for (seed, case) in (0..).zip(cases(60..68, false)) {
        let mut chance = Chance::new(seed);
        let (x, y) = (chance.metres(0.0, case.plan.width - 1.0), chance.metres(0.0, case.plan.depth - 1.0));
        let plan = case.plan.clone().with_rect(x, y, x + 0.8, y + 0.5);
        // An obstacle upon a point takes the point away.
        let on = |p: &Point| Rect::new(x, y, x + 0.8, y + 0.5).nearest_to(*p).distance(*p) < 0.05;
        if on(&case.start) {
            continue;
        }
        let goals: Vec<Point> = case.goals.iter().copied().filter(|goal| !on(goal)).collect();
        let case = Case { goals, ..case };
        let now = costs(&plan, &case.body, case.start, &case.goals);
        let pairs = case.costs().into_iter().zip(now).zip(&case.goals);
        let cheaper = pairs.filter(|((was, now), _)| match (was, now) {
            (Some(was), Some(now)) => *now < was * (1.0 - SAME),
            (was, now) => was.is_none() && now.is_some(),
        });
        let Case { name, start, .. } = &case;
        wrong.extend(cheaper.map(|((was, now), goal)| {
            format!("{name}: {},{} to {},{}: {was:?}, then {now:?}", start.x, start.y, goal.x, goal.y)
        }));
    }
    expect_none(&wrong);
}

#[test]
fn a_lower_hardness_makes_no_route_dearer() {
    let mut wrong = Vec::new();
    for (seed, case) in (0..).zip(cases(70..78, false)) {
        let mut chance = Chance::new(seed);
        let mut body = case.body.clone();
        let state = chance.below(body.states.len());
        body.states[state].hardness *= chance.between(0.4, 0.95);
        for change in body.changes.iter_mut().filter(|change| change.1 == state) {
            change.2 *= 0.9;
        }
        let now = costs(&case.plan, &body, case.start, &case.goals);
        let pairs = case.costs().into_iter().zip(now).zip(&case.goals);
        let dearer = pairs.filter(|((was, now), _)| match (was, now) {
            (Some(was), Some(now)) => *now > was * (1.0 + 1e-9),
            (was, now) => was.is_some() != now.is_some(),
        });
        let Case { name, start, .. } = &case;
        wrong.extend(dearer.map(|((was, now), goal)| {
            format!("{name}: {},{} to {},{}: {was:?}, then {now:?}", start.x, start.y, goal.x, goal.y)
        }));
    }
    expect_none(&wrong);
}
