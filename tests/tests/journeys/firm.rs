//! How firm a route is, beside brute force: the same question asked at many values of each cell.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::collections::BTreeMap;
use std::fmt::Write;

use adit::edit::Edit;
use adit::preview::{Preview, Wanted};
use adit::why::firm::FirmCell;
use adit::{Answer, KnowledgeBase, Live, Status};
use adit_tests::TestSite;

/// Numbers that look like chance, the same every time (Knuth's linear congruential generator).
struct Chance(u64);

impl Chance {
    fn of(seed: u64) -> Self {
        let mut chance = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        chance.next();
        chance
    }

    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

fn live(site: &TestSite) -> Live {
    Live::open(KnowledgeBase::open(site.path()).unwrap()).unwrap()
}

/// The preview of a cell at a value, with the route.
fn at(live: &Live, cell: &FirmCell, value: f64, (start, goal): (&str, &str)) -> Preview {
    let [table, key, column] = [&cell.table, &cell.key, &cell.column].map(Clone::clone);
    let edit = Edit::Set(table, key, column, format!("{value}"));
    live.preview(&[edit], Some(Wanted { start, goal, robot: None })).unwrap()
}

/// Values to try: spread about the present one, and close to both ends on both sides.
fn values(cell: &FirmCell, near: f64, chance: &mut Chance) -> Vec<f64> {
    let mut values: Vec<f64> = (0..10).map(|_| cell.value * chance.between(0.0, 2.5)).collect();
    values.extend([cell.value * 20.0, cell.value * 400.0, cell.value * 1e-3]);
    for end in [cell.low, cell.high].into_iter().flatten() {
        let hair = end.abs().max(0.1) * near;
        values.extend([end - hair, end + hair]);
    }
    values.retain(|value| *value >= 0.0);
    values
}

/// Whether a value lies in the interval; `None` where it lies on an end.
fn is_within(cell: &FirmCell, near: f64, value: f64) -> Option<bool> {
    let is_on =
        |end: Option<f64>| end.is_some_and(|end| (value - end).abs() < 0.5 * near * end.abs().max(0.1));
    if is_on(cell.high) || is_on(cell.low) && cell.below.is_some() {
        return None;
    }
    Some(cell.low.is_none_or(|low| value >= low) && cell.high.is_none_or(|high| value <= high))
}

/// Whether values that lie beyond an end lie so near to it that the way must have lost.
fn is_just_beyond(cell: &FirmCell, near: f64, value: f64) -> bool {
    let is_near =
        |end: Option<f64>| end.is_some_and(|end| (value - end).abs() <= 2.0 * near * end.abs().max(0.1));
    is_near(cell.low) || is_near(cell.high)
}

/// A floor of the paper's kind: obstacles and low bridges here and there, four states.
fn papers_floor(seed: u64) -> TestSite {
    let mut chance = Chance::of(seed);
    let mut map = "width = 12.0\ndepth = 9.0\nobstacle = [\n".to_owned();
    for column in 0..3 {
        for row in 0..2 {
            let (x, y) = (
                f64::from(column) * 4.0 + chance.between(0.2, 1.7),
                f64::from(row) * 4.5 + chance.between(0.2, 1.7),
            );
            let (dx, dy) = (chance.between(0.6, 2.0), chance.between(0.6, 2.4));
            writeln!(map, "  {{ rect = [{x:.3}, {y:.3}, {:.3}, {:.3}] }},", x + dx, y + dy).unwrap();
        }
    }
    map.push_str("]\nbridge = [\n");
    for column in 0..2 {
        let x = 2.0 + f64::from(column) * 5.0 + chance.between(0.0, 1.5);
        let (y, height) = (chance.between(0.0, 5.0), chance.between(0.7, 1.6));
        writeln!(
            map,
            "  {{ rect = [{x:.3}, {y:.3}, {:.3}, {:.3}], height = {height:.3} }},",
            x + 0.6,
            y + 3.5
        )
        .unwrap();
    }
    map.push_str(
        "]\n[[place]]\nname = \"dock\"\nat = [0.1, 0.1]\n[[place]]\nname = \"gate\"\nat = [11.9, 8.9]\n",
    );
    let mut robots = String::new();
    for (state, height, width, low, high) in [
        ("WALK", 1.7, 0.5, 0.5, 1.5),
        ("SIDE", 1.7, 0.3, 1.0, 3.0),
        ("SQUAT", 1.1, 0.6, 2.0, 6.0),
        ("LIE", 0.6, 0.6, 4.0, 12.0),
    ] {
        let hardness = chance.between(low, high);
        writeln!(robots, "[[robots]]\nstate = \"{state}\"\naction = \"{state}\"\nheight = {height}\nwidth = {width}\nhardness = {hardness:.4}").unwrap();
    }
    robots.push_str("[[robots]]\nstate = \"IMPOSSIBLE\"\naction = \"NO-ACTION\"\nheight = 0.0\nwidth = 0.0\nhardness = 10000.0\n");
    TestSite::example("paper")
        .with("map.toml", &map)
        .with("site.toml", "name = \"chance\"\nrooms = \"paper\"\nstarts = [\"dock\"]\n")
        .with("robots.toml", &robots)
}

/// The doors that a route passes, with their hardness.
fn doors(answer: &Answer) -> BTreeMap<i64, f64> {
    let doors = answer.steps.iter().filter(|step| step.kind == "door");
    doors.map(|step| (step.place.parse().unwrap(), step.hardness.unwrap())).collect()
}

#[test]
fn on_random_floors_of_the_papers_kind_the_same_doors_are_the_best_in_the_interval_and_not_just_beyond_it() {
    /// So near to an end, as a share, values are tried.
    const NEAR: f64 = 1e-5;
    let (mut ends, mut tried) = (0, 0);
    for seed in 1..=14 {
        let mut chance = Chance::of(seed + 1_000);
        let site = papers_floor(seed);
        let live = live(&site);
        let ask = ("dock", "gate");
        let answer = live.route(ask.0, &[ask.1.to_owned()], None).unwrap();
        if answer.status != Status::Ok {
            continue;
        }
        let firm = live.firm(ask.0, ask.1, None).unwrap();
        assert_eq!(firm.cost, answer.cost);
        assert!(!firm.truncated);
        let own = doors(&answer);
        for cell in &firm.cells {
            assert!(cell.exact && cell.column == "hardness", "{cell:?}");
            ends += usize::from(cell.below.is_some()) + usize::from(cell.above.is_some());
            for value in values(cell, NEAR, &mut chance) {
                let Some(within) = is_within(cell, NEAR, value) else { continue };
                if !within && !is_just_beyond(cell, NEAR, value) {
                    continue;
                }
                tried += 1;
                let preview = at(&live, cell, value, ask);
                let mut weights: BTreeMap<i64, Option<f64>> =
                    own.iter().map(|(door, h)| (*door, Some(*h))).collect();
                for door in &preview.doors.list {
                    if let Some(weight) = weights.get_mut(&door.door) {
                        *weight = door.new.hardness.filter(|_| door.new.passable == Some(true));
                    }
                }
                let cost: Option<f64> = weights.values().copied().sum();
                let best = preview.route.unwrap().cost;
                let is_best = !preview.layout_changed
                    && best.is_some_and(|best| cost.is_some_and(|cost| cost <= best * (1.0 + 1e-9)));
                assert_eq!(is_best, within, "seed {seed}, {cell:?} at {value}: {cost:?} against {best:?}");
            }
        }
    }
    assert!(ends >= 20 && tried >= 200, "{ends} ends, {tried} values: too few to say anything");
}

/// Two halls with a wall between them: a gate, a low one and a narrow one, somewhere.
fn halls(seed: u64) -> TestSite {
    let mut chance = Chance::of(seed);
    let low = chance.between(1.0, 3.0);
    let narrow = chance.between(5.0, 7.5);
    let wide = chance.between(9.5, 12.5);
    let mut map = "width = 14.0\ndepth = 14.0\nobstacle = [\n".to_owned();
    for (y0, y1) in [(0.0, low), (low + 1.2, narrow), (narrow + 0.5, wide), (wide + 1.2, 14.0)] {
        writeln!(map, "  {{ rect = [6.9, {y0:.3}, 7.1, {y1:.3}] }},").unwrap();
    }
    writeln!(map, "]\nbridge = [{{ rect = [6.8, {:.3}, 7.2, {:.3}], height = 1.2 }}]", low - 0.2, low + 1.4)
        .unwrap();
    let (y0, y1) = (chance.between(1.0, 6.0), chance.between(1.0, 6.0));
    writeln!(
        map,
        "[[place]]\nname = \"dock\"\nat = [1.0, {y0:.3}]\n[[place]]\nname = \"gate\"\nat = [13.0, {y1:.3}]"
    )
    .unwrap();
    let mut robots = String::new();
    for (state, height, width, low, high) in
        [("WALK", 1.7, 0.6, 0.8, 1.2), ("SIDE", 1.7, 0.35, 1.5, 6.0), ("SQUAT", 1.1, 0.6, 2.0, 8.0)]
    {
        let hardness = chance.between(low, high);
        writeln!(robots, "[[robots]]\nstate = \"{state}\"\naction = \"{state}\"\nheight = {height}\nwidth = {width}\nhardness = {hardness:.4}").unwrap();
    }
    for (from, to) in [("WALK", "SIDE"), ("SIDE", "WALK"), ("WALK", "SQUAT"), ("SQUAT", "WALK")] {
        writeln!(
            robots,
            "[[changes]]\nfrom_state = \"{from}\"\nto_state = \"{to}\"\nhardness = {:.3}",
            chance.between(0.1, 1.0)
        )
        .unwrap();
    }
    // no row means no cost: then a robot squats, turns to its side for a hand's breadth, and stands up for less
    for (from, to) in [("SIDE", "SQUAT"), ("SQUAT", "SIDE")] {
        writeln!(robots, "[[changes]]\nfrom_state = \"{from}\"\nto_state = \"{to}\"\nhardness = 50.0")
            .unwrap();
    }
    TestSite::example("starter")
        .with("map.toml", &map)
        .with("site.toml", "name = \"halls\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\ngrid = 0.05\n")
        .with("robots.toml", &robots)
}

/// The states in which a route is driven, in their order.
fn states(answer: &Answer) -> Vec<String> {
    let mut states: Vec<String> = answer.waypoints.iter().filter_map(|at| at.state.clone()).collect();
    states.dedup();
    states
}

#[test]
fn on_random_floors_by_state_the_robot_does_the_same_in_the_interval_and_something_else_just_beyond_it() {
    /// The same way is the best to a millionth of the cost, and the search tries points half a metre apart: an end lies near.
    const NEAR: f64 = 1e-2;
    let (mut ends, mut tried) = (0, 0);
    for seed in 1..=5 {
        let mut chance = Chance::of(seed + 2_000);
        let site = halls(seed);
        let live = live(&site);
        let ask = ("dock", "gate");
        let answer = live.route(ask.0, &[ask.1.to_owned()], None).unwrap();
        let firm = live.firm(ask.0, ask.1, None).unwrap();
        assert!((firm.cost.unwrap() - answer.cost.unwrap()).abs() < 1e-9);
        for cell in &firm.cells {
            assert!(cell.exact && cell.column == "hardness", "{cell:?}");
            ends += usize::from(cell.below.is_some()) + usize::from(cell.above.is_some());
            for value in values(cell, NEAR, &mut chance) {
                let Some(within) = is_within(cell, NEAR, value) else { continue };
                if !within && !is_just_beyond(cell, NEAR, value) {
                    continue;
                }
                tried += 1;
                let there = at(&live, cell, value, ask).route.unwrap();
                assert_eq!(
                    states(&there) == states(&answer),
                    within,
                    "seed {seed}, {cell:?} at {value}: {:?}",
                    states(&there)
                );
            }
        }
    }
    assert!(ends >= 10 && tried >= 100, "{ends} ends, {tried} values: too few to say anything");
}

#[test]
fn what_takes_over_is_said_with_its_actions() {
    let site = halls(1);
    let live = live(&site);
    let firm = live.firm("dock", "gate", None).unwrap();
    let end = firm.cells.iter().find_map(|cell| cell.above.clone()).unwrap();
    assert!(end.way.contains(" instead of ") && end.way.contains(" m"), "{end:?}");
    assert!(end.cost_at_end.unwrap() >= firm.cost.unwrap(), "{end:?}");
    assert!(end.route_differs_at.unwrap().starts_with("door "));
}

#[test]
fn where_no_way_leads_there_is_nothing_to_be_firm() {
    let site = TestSite::example("starter")
        .with(
            "site.toml",
            "name = \"starter\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\n",
        )
        .with("robots.toml", include_str!("../../../kb/sites/hospital/robots.toml"));
    site.edit("map.toml", "rect = [5.9, 4.0, 6.1, 8.0]", "rect = [5.9, 2.0, 6.1, 8.0]");
    let firm = live(&site).firm("home", "window", None).unwrap();
    assert_eq!((firm.cost, firm.cells.len()), (None, 0));
}

#[test]
fn rules_that_square_a_hardness_are_answered_by_trying_and_that_is_said() {
    let site = papers_floor(3);
    site.copy_rules("paper");
    let rule = site.read("rules/doors.rhai");
    let squared =
        rule.replace("door.distance1 * first.hardness", "door.distance1 * first.hardness * first.hardness");
    assert_ne!(rule, squared);
    site.write("rules/doors.rhai", squared);
    let live = live(&site);
    let firm = live.firm("dock", "gate", None).unwrap();
    assert!(firm.cells.iter().any(|cell| !cell.exact), "{firm:?}");
    let own = doors(&live.route("dock", &["gate".to_owned()], None).unwrap());
    for cell in &firm.cells {
        let there = at(&live, cell, cell.value, ("dock", "gate")).route.unwrap();
        assert_eq!(doors(&there), own);
    }
}

/// A fleet in which each robot has a hardness of its own: rules may switch at each of them, for each.
#[test]
fn of_very_many_numbers_not_all_are_looked_at_and_that_is_said() {
    let site = TestSite::example("starter");
    let row = |robot: usize| {
        let hardness = 1.0 + 0.01 * robot as f64;
        format!(
            "[[robots]]\nrobot = \"r{robot}\"\nstate = \"UP\"\naction = \"WALK\"\nheight = 1.7\nwidth = 0.6\nhardness = {hardness}\n"
        )
    };
    site.write("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n");
    site.write("robots.toml", (0..150).map(row).collect::<String>());
    let site = site.built();
    let firm = site.adit("firm", &["4,4", "window", "--robot", "r7"]).expecting(0).stdout;
    assert!(firm.contains("costs 8.992"), "{firm}");
    assert!(firm.contains("the time was over before all cells were looked at"), "{firm}");
    let not =
        site.adit("why-not", &["4,4", "window", "--robot", "r7", "--through", "10,2"]).expecting(0).stdout;
    assert!(not.contains("not all were looked at to the end"), "{not}");
}
