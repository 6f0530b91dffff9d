//! What why, why-not and how firm claim, computed: what keeps a state out is measured on the map, other ways are driven by
//! making the choice too dear, and each number is set a hair on either side of where it is said to turn the choice.
//!
//! Where ways keep no farther off walls than they must, what a route costs is what it is chosen by; on sites as they are shipped
//! that is so to the share that keeping off walls may cost.
//!
//! `ADIT_QUESTIONS=500 cargo test --test journeys reasons -- --nocapture` asks so many questions of each site, and says how long
//! answers took.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::time::{Duration, Instant};

use adit::edit::Edit;
use adit::preview::Wanted;
use adit::why::firm::{Firm, FirmCell};
use adit::why::hindered::{Hindered, Kind};
use adit::why::way::{Stretch, WhyWay};
use adit::why::why_not::WhyNot;
use adit::{Answer, KnowledgeBase, Live, Status};
use adit_planners::clearance::Solids;
use adit_planners::geometry::Point;
use adit_planners::world::World;
use adit_tests::TestSite;
use adit_tests::oracle::random::Chance;

/// So near to an end, as a share, values are tried: the same way is the best to a millionth of the cost.
const NEAR: f64 = 1e-3;

/// So near where ways cost the same to [`TIE`] at [`NEAR`].
const WIDE: f64 = 2e-2;

/// Ways that differ by no more than this share of what they cost are as good as each other.
const TIE: f64 = 1e-5;

/// Two searches find ways that differ by what turns the choice so much sooner or later, as a share.
const SEARCHED: f64 = 2e-3;

/// Ways are measured to such a share of what they cost.
const ROUNDING: f64 = 2e-6;

/// So hard that nobody does it who need not.
const TOO_HARD: f64 = 5e5;

struct Desk {
    /// The folder, as long as it is asked about.
    _site: TestSite,
    live: Live,
    world: World,
    solids: Solids,
    robots: Vec<String>,
    /// Heights and widths by `robot/state`.
    sizes: Vec<(String, f64, f64)>,
    places: Vec<String>,
    /// Names that a way may lead through.
    things: Vec<String>,
    changes_cost: bool,
    /// Claims that turned out wrong.
    wrong: RefCell<Vec<String>>,
    /// How long answers took, in milliseconds, by question.
    took: RefCell<BTreeMap<&'static str, Vec<f64>>>,
}

impl Desk {
    fn of(site: TestSite) -> Self {
        let knowledge = KnowledgeBase::open(site.path()).unwrap();
        let world = knowledge.site().world().unwrap();
        let number = |text: &str| text.parse().unwrap();
        let sizes = site.sqlite3("SELECT robot || '/' || state, height, width FROM robots");
        let sizes = sizes.iter().map(|row| {
            let cells: Vec<&str> = row.split('|').collect();
            (cells[0].to_owned(), number(cells[1]), number(cells[2]))
        });
        let mut things = site.sqlite3("SELECT coalesce(name, 'space ' || space) FROM spaces");
        things.extend(site.sqlite3("SELECT coalesce(name, 'doorway ' || doorway) FROM doorways"));
        things.extend(site.sqlite3("SELECT 'room ' || name FROM rooms ORDER BY room LIMIT 60"));
        let [robots, places] = [
            "SELECT DISTINCT robot FROM robots ORDER BY robot",
            "SELECT place FROM places UNION SELECT name FROM rooms WHERE state IS NULL",
        ]
        .map(|query| site.sqlite3(query));
        let sizes = sizes.collect();
        let changes_cost = site.sqlite3("SELECT count(*) FROM changes WHERE hardness > 0") != ["0"];
        Self {
            live: Live::open(knowledge).unwrap(),
            solids: Solids::new(&world),
            world,
            robots,
            sizes,
            places,
            things,
            changes_cost,
            wrong: RefCell::default(),
            took: RefCell::default(),
            _site: site,
        }
    }

    /// A claim.
    fn claim(&self, is_so: bool, said: impl FnOnce() -> String) {
        if !is_so {
            self.wrong.borrow_mut().push(said());
        }
    }

    fn timed<T>(&self, question: &'static str, answer: impl FnOnce() -> T) -> T {
        let since = Instant::now();
        let answer = answer();
        self.took.borrow_mut().entry(question).or_default().push(since.elapsed().as_secs_f64() * 1e3);
        answer
    }

    /// A place.
    fn end(&self, chance: &mut Chance) -> String {
        self.places[chance.below(self.places.len())].clone()
    }

    fn through(&self, chance: &mut Chance) -> String {
        if chance.is(0.2) {
            let b = self.world.bounds;
            return format!("{:.2},{:.2}", chance.between(b.x0, b.x1), chance.between(b.y0, b.y1));
        }
        self.things[chance.below(self.things.len())].clone()
    }

    fn route(&self, start: &str, goal: &str, robot: &str) -> Answer {
        self.live.route(start, &[goal.to_owned()], Some(robot)).unwrap()
    }

    /// The route where a cell has another value.
    fn route_with(
        &self,
        cell: (&str, &str, &str),
        value: f64,
        (start, goal, robot): (&str, &str, &str),
    ) -> Answer {
        let edit = Edit::Set(cell.0.to_owned(), cell.1.to_owned(), cell.2.to_owned(), format!("{value}"));
        let wanted = Wanted { start, goal, robot: Some(robot) };
        let fork = self.live.fork().with_patience(Duration::ZERO);
        fork.preview(&[edit], Some(wanted)).unwrap().route.unwrap()
    }
}

/// What is done on a route: its states where it has some, else its actions.
fn manners(route: &Answer) -> BTreeSet<String> {
    let driven = route.waypoints.windows(2).filter(|pair| pair[0].distance != pair[1].distance);
    let states: BTreeSet<String> = driven.filter_map(|pair| pair[1].state.clone()).collect();
    if !states.is_empty() {
        return states;
    }
    route.steps.iter().filter(|step| step.kind == "door").filter_map(|step| step.action.clone()).collect()
}

/// The states of a route one after the other, and the spaces.
fn course(route: &Answer) -> (Vec<String>, Vec<String>) {
    let mut states: Vec<String> =
        route.steps.iter().filter(|step| step.kind == "room").filter_map(|step| step.state.clone()).collect();
    states.dedup();
    let doors = route.steps.iter().filter(|step| step.kind == "door");
    (states, doors.map(|step| step.place.clone()).collect())
}

fn is_near(one: f64, other: f64, share: f64) -> bool {
    (one - other).abs() <= share * one.abs().max(other.abs()).max(1.0)
}

/// Why a route does what it does.
fn check_way(desk: &Desk, why: &WhyWay) -> usize {
    let ask = (why.start.as_str(), why.goal.as_str(), why.robot.as_str());
    let route = desk.route(ask.0, ask.1, ask.2);
    assert_eq!(why.cost.is_some(), matches!(route.status, Status::Ok | Status::SameRoom), "{why:#?}");
    let (Some(cost), Some(driven)) = (why.cost, route.cost) else { return 1 };
    assert!(is_near(cost, driven, 1e-9), "{cost} {driven}");
    for stretch in &why.stretches {
        for hindered in &stretch.hindered {
            check_hindered(desk, &why.robot, hindered, &why.sentences);
        }
        check_without(desk, why, &route, stretch);
    }
    why.sentences.len()
}

/// What keeps a state out, measured on the map.
fn check_hindered(desk: &Desk, robot: &str, of: &Hindered, said: &[String]) {
    let key = format!("{robot}/{}", of.state);
    let (_, height, width) = desk.sizes.iter().find(|(known, ..)| *known == key).unwrap();
    let at = Point::new(of.x, of.y);
    match of.kind {
        Kind::Low => {
            let over = desk.world.bridges.iter().filter(|bridge| bridge.rect.grown(1e-6).contains(at));
            let least = over.map(|bridge| bridge.height).fold(f64::INFINITY, f64::min);
            assert!(is_near(least, of.leaves.unwrap(), 1e-9) && *height >= least, "{of:?}, {said:#?}");
        }
        Kind::Narrow => {
            let (leaves, needs) = (of.leaves.unwrap(), of.needs.unwrap());
            assert!(leaves < needs && is_near(needs, *width, 1e-9), "{of:?}, {said:#?}");
            let gap = desk.solids.gap(at, at, *height);
            assert!(gap <= leaves / 2.0 + 1e-6, "{of:?}: {gap} to what is solid, {said:#?}");
        }
        Kind::NoRoom => assert!(desk.solids.gap(at, at, *height) < width / 2.0, "{of:?}, {said:#?}"),
        Kind::Shut | Kind::Harder | Kind::Change => {}
    }
}

/// The best way without a state is driven where the state is too hard; the number that is named turns it.
fn check_without(desk: &Desk, why: &WhyWay, route: &Answer, stretch: &Stretch) {
    let ask = (why.start.as_str(), why.goal.as_str(), why.robot.as_str());
    let Some(state) = &stretch.state else { return };
    let key = format!("{}/{state}", why.robot);
    let other = desk.route_with(("robots", &key, "hardness"), TOO_HARD, ask);
    let Some(without) = &stretch.without else {
        assert!(manners(&other).contains(state) || other.cost.is_none(), "{why:#?}");
        return;
    };
    let ends = format!("{} to {}", ask.0, ask.1);
    let (least, best) = (other.cost.unwrap(), route.cost.unwrap());
    desk.claim(!manners(&other).contains(state), || format!("{ends}: {state} is done without it"));
    desk.claim(is_near(without.cost, least, ROUNDING), || format!("{ends}: {without:?}, in fact {least}"));
    let more = least - best;
    desk.claim((without.more - more).abs() <= ROUNDING * best, || format!("{ends}: {without:?} over {best}"));
    let spaces: BTreeSet<&String> = other.steps.iter().filter_map(|step| step.space.as_ref()).collect();
    desk.claim(without.by.iter().all(|space| spaces.contains(space)), || {
        format!("{ends}: by {:?}, in fact {spaces:?}", without.by)
    });
    let Some(holds) = &stretch.holds else { return };
    let cell = (holds.table.as_str(), holds.key.as_str(), holds.column.as_str());
    for (end, out) in [(holds.low, -1.0), (holds.high, 1.0)] {
        let Some(end) = end else { continue };
        let hair = end.abs().max(0.1) * NEAR;
        for (side, is_kept) in [(-1.0, true), (1.0, false)] {
            let value = end + side * out * hair;
            let there = desk.route_with(cell, value, ask);
            desk.claim(manners(&there).contains(state) == is_kept, || {
                format!(
                    "{ends}: {state} at {value} is {}kept, {holds:?}, {:?}",
                    if is_kept { "not " } else { "" },
                    there.cost
                )
            });
        }
    }
}

/// Why not through something.
fn check_why_not(desk: &Desk, answer: &WhyNot) {
    let ask = (answer.start.as_str(), answer.goal.as_str(), answer.robot.as_str());
    let route = desk.route(ask.0, ask.1, ask.2);
    let (Some(best), Some(cost)) = (answer.best, answer.cost) else {
        assert!(answer.best.is_none() == route.cost.is_none(), "{}", answer.sentence);
        return;
    };
    assert!(cost >= best * (1.0 - ROUNDING), "{}", answer.sentence);
    let way = answer.route.as_ref().unwrap();
    let ends = format!("{} to {}", ask.0, ask.1);
    if cost > best * (1.0 + ROUNDING) {
        desk.claim(leads_through(way, &answer.through), || {
            format!("{ends}: not through: {}", answer.sentence)
        });
    } else if answer.reason.starts_with("the best route") {
        desk.claim(leads_through(&route, &answer.through), || {
            format!("{ends}: the route does not: {}", answer.sentence)
        });
    }
    // of ways that are as good close to walls the one that is named may cost less than the other as it is driven
    let [driven_best, driven] = answer.driven.unwrap_or([best, cost]);
    let is_as_good = cost <= best * (1.0 + ROUNDING) && way.cost.unwrap() <= driven * (1.0 + ROUNDING);
    desk.claim(
        (is_as_good || is_near(driven, way.cost.unwrap(), ROUNDING))
            && is_near(driven_best, route.cost.unwrap(), ROUNDING),
        || format!("{ends}: {}: {:?}, {:?}", answer.sentence, way.cost, route.cost),
    );
    // nobody goes through it for less: not by a point of the way that is named
    if let (false, Some(at)) = (cost <= best * (1.0 + ROUNDING), answer.through.split_once(',')) {
        let at = format!("{},{}", at.0, at.1);
        let [to, on] =
            [(ask.0, at.as_str()), (at.as_str(), ask.1)].map(|(from, to)| desk.route(from, to, ask.2));
        let least = to.cost.unwrap() + on.cost.unwrap();
        desk.claim(is_near(least, driven, ROUNDING), || format!("{ends}: {}: {least}", answer.sentence));
    }
    let Some(cell) = &answer.would_win else { return };
    let out = (cell.wins_at - cell.value).signum();
    let named = (cell.table.as_str(), cell.key.as_str(), cell.column.as_str());
    let hair = cell.wins_at.abs().max(0.1) * NEAR;
    // it is named where it has won, a hair beyond where both ways cost the same
    let is_at_once = (cell.wins_at - cell.value).abs() <= 2.5 * hair;
    let before = if is_at_once { cell.value } else { cell.wins_at - 2.5 * out * hair };
    let within = desk.route_with(named, before, ask);
    let beyond = desk.route_with(named, cell.wins_at, ask);
    desk.claim(!leads_through(&within, &answer.through), || {
        format!("{ends}: at {before}, before {}: {}", cell.wins_at, answer.sentence)
    });
    // of rooms, which are pieces of spaces, several are as good: one of them is passed
    if answer.through.contains(',') || answer.through.starts_with("room ") {
        return;
    }
    desk.claim(leads_through(&beyond, &answer.through), || {
        format!("{ends}: beyond {}: {}", cell.wins_at, answer.sentence)
    });
}

/// Whether a route leads through what is named.
fn leads_through(route: &Answer, name: &str) -> bool {
    if let Some((x, y)) = name.split_once(',') {
        let at = Point::new(x.parse().unwrap(), y.parse().unwrap());
        let points: Vec<Point> = route.waypoints.iter().map(|point| Point::new(point.x, point.y)).collect();
        return points.windows(2).any(|pair| at.nearest_on(pair[0], pair[1]).distance(at) < 1e-3);
    }
    let is_room = |step: &adit_db::route::Step| step.kind == "room" && format!("room {}", step.place) == name;
    route.steps.iter().any(|step| {
        step.space.as_deref() == Some(name) || step.doorway.as_deref() == Some(name) || is_room(step)
    })
}

/// Between which values a route stays the best.
fn check_firm(desk: &Desk, firm: &Firm) {
    let ask = (firm.start.as_str(), firm.goal.as_str(), firm.robot.as_str());
    let route = desk.route(ask.0, ask.1, ask.2);
    let (Some(cost), Some(driven)) = (firm.cost, route.cost) else { return };
    assert!(is_near(cost, driven, 1e-9), "{cost} {driven} {ask:?}");
    let now = course(&route);
    // where changing shape costs nothing, it is changed here and there for a few centimetres
    for of in firm.cells.iter().filter(|_| desk.changes_cost) {
        let cell = (of.table.as_str(), of.key.as_str(), of.column.as_str());
        for (end, out, beyond) in [(of.low, -1.0, &of.below), (of.high, 1.0, &of.above)] {
            let (Some(end), Some(_)) = (end, beyond) else { continue };
            let route_at = |share: f64| {
                let value = (end + out * end.abs().max(0.1) * share).max(0.0);
                (value, desk.route_with(cell, value, ask))
            };
            let is_same = |there: &Answer| course(there).0 == now.0;
            let as_now = |value: f64| driven + (value - of.value) * amount(&route, of);
            // where what is driven costs the same as now, to five digits, either way is as good
            let is_tie = |(value, there): &(f64, Answer)| is_near(there.cost.unwrap(), as_now(*value), TIE);
            let near = route_at(-NEAR);
            // what is driven instead may be dearer than the way as it is now: then that is still the best one
            let is_dearer = near.1.cost.unwrap() > as_now(near.0) * (1.0 + TIE);
            let is_kept = is_same(&near.1) || is_dearer || is_tie(&near) && is_same(&route_at(-WIDE).1);
            desk.claim(is_kept, || format!("{ask:?}: within {of:?}"));
            let is_gone = |(_, there): &(f64, Answer)| course(there) != now;
            let near = route_at(NEAR);
            let is_taken = is_gone(&near) || is_tie(&near) && is_gone(&route_at(WIDE));
            desk.claim(is_taken, || format!("{ask:?}: beyond {of:?}"));
        }
    }
}

/// How much of what a cell weighs is driven on a route: metres in a state, or how often a shape is changed.
fn amount(route: &Answer, of: &FirmCell) -> f64 {
    let (states, _) = course(route);
    let key: Vec<&str> = of.key.split('/').collect();
    match key.as_slice() {
        [_, from, to] => states.windows(2).filter(|pair| pair[0] == *from && pair[1] == *to).count() as f64,
        [_, state] => {
            let legs = route.waypoints.windows(2).filter(|pair| pair[1].state.as_deref() == Some(*state));
            legs.filter_map(|pair| Some(pair[1].distance? - pair[0].distance?)).sum()
        }
        _ => 0.0,
    }
}

/// Where why, why-not and how firm speak of the same number, they do not contradict each other.
fn check_together(desk: &Desk, why: &WhyWay, firm: &Firm) {
    for holds in why.stretches.iter().filter_map(|stretch| stretch.holds.as_ref()) {
        let same = firm
            .cells
            .iter()
            .find(|cell| (&cell.table, &cell.key, &cell.column) == (&holds.table, &holds.key, &holds.column));
        let Some(same) = same else { continue };
        // as long as nothing changes, the state is still taken
        let up = holds.high.is_none_or(|high| same.high.is_some_and(|firm| firm <= high * (1.0 + SEARCHED)));
        let down = holds.low.is_none_or(|low| same.low.is_some_and(|firm| firm >= low * (1.0 - SEARCHED)));
        desk.claim(up && down, || format!("{} to {}: {holds:?} {same:?}", why.start, why.goal));
    }
}

/// Asks so many questions by chance; how many sentences said something.
fn ask(desk: &Desk, seed: u64, questions: usize) -> usize {
    let mut chance = Chance::new(seed);
    let mut said = 0;
    for question in 0..questions {
        let (start, goal) = (desk.end(&mut chance), desk.end(&mut chance));
        if start == goal {
            continue;
        }
        let robot = desk.robots[chance.below(desk.robots.len())].clone();
        let (fork, robot) = (desk.live.fork(), Some(robot.as_str()));
        match question % 5 {
            0 | 1 => {
                let why = desk.timed("why", || fork.why_way((&start, &goal), None, robot).unwrap());
                said += check_way(desk, &why);
            }
            2 | 3 => {
                let through = desk.through(&mut chance);
                // a point in a wall is none
                if let Ok(answer) = desk.timed("why-not", || fork.why_not(&start, &goal, &through, robot)) {
                    check_why_not(desk, &answer);
                    said += 1;
                }
            }
            _ => {
                let firm = desk.timed("firm", || fork.firm(&start, &goal, robot).unwrap());
                check_firm(desk, &firm);
                check_together(desk, &desk.live.why_way((&start, &goal), None, robot).unwrap(), &firm);
                said += firm.cells.len();
            }
        }
    }
    for (question, took) in desk.took.borrow_mut().iter_mut() {
        took.sort_by(f64::total_cmp);
        let at = |share: f64| took[((took.len() - 1) as f64 * share) as usize];
        eprintln!(
            "{question}: {} answers, median {:.0} ms, 95 % {:.0} ms, most {:.0} ms",
            took.len(),
            at(0.5),
            at(0.95),
            at(1.0)
        );
    }
    let wrong = desk.wrong.borrow();
    assert!(wrong.is_empty(), "{} of {said} sentences are wrong:\n{}", wrong.len(), wrong.join("\n"));
    said
}

fn questions(usual: usize) -> usize {
    std::env::var("ADIT_QUESTIONS").map_or(usual, |text| text.parse().expect("ADIT_QUESTIONS is a number"))
}

#[test]
fn on_the_clinic_no_claim_is_wrong() {
    let desk = Desk::of(TestSite::example("clinic").without_berth().built());
    assert!(ask(&desk, 11, questions(20)) >= 20);
}

#[test]
fn on_sites_as_they_are_shipped_no_claim_is_wrong() {
    for (name, seed) in [("clinic", 4), ("depot", 5), ("hospital", 6)] {
        assert!(ask(&Desk::of(TestSite::example(name).built()), seed, questions(8)) > 0, "{name}");
    }
}

#[test]
fn on_the_other_sites_no_claim_is_wrong() {
    for (name, seed) in [("paper", 1), ("depot", 2), ("hospital", 3)] {
        let site = TestSite::example(name);
        let site = if name == "paper" { site } else { site.without_berth() };
        assert!(ask(&Desk::of(site.built()), seed, questions(8)) > 0, "{name}");
    }
}

#[test]
fn on_the_clinic_reasons_are_in_the_buildings_words() {
    let site = TestSite::example("clinic").built();
    let said = site.adit("why", &["dock", "ward 12"]).expecting(0).stdout;
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!(lines.len(), 2, "{said}");
    assert!(lines[0].starts_with("Walk-on-knee in corridor 15"), "{said}");
    assert!(lines[0].contains("leaves 1.3 m, and STAND and SIDE-STAND are 1.7 m high"), "{said}");
    assert!(
        lines[0].contains(" Without SQUAT the best way costs ") && lines[0].contains(", by workshop"),
        "{said}"
    );
    assert!(
        lines[0].contains("SQUAT stays on the best way while the hardness of SQUAT (robots) is below "),
        "{said}"
    );
    assert!(lines[1].starts_with("Side-walk in corridor 40 and corridor 56"), "{said}");
    assert!(lines[1].contains("is 0.45 m wide, and STAND needs 0.6"), "{said}");
    let there = site.adit("why", &["dock", "ward 12", "--at", "corridor 56"]).expecting(0).stdout;
    assert_eq!(there.lines().collect::<Vec<_>>(), lines[1..]);
    let easy = site.adit("why", &["dock", "ward 12", "--at", "ward 12"]).expecting(0).stdout;
    assert_eq!(
        easy,
        "From dock to ward 12, what the robot does through ward 12 is the easiest there is: walk.\n"
    );
}

#[test]
fn why_not_knows_spaces_doorways_areas_places_and_points() {
    let site = TestSite::example("clinic");
    let text = site.read("site.toml");
    site.write(
        "site.toml",
        format!("{text}[[area]]\nname = \"by the link\"\nkind = \"shiny\"\nrect = [57.5, 13.0, 59.5, 15.0]\n[[door]]\nname = \"link door\"\nfrom = [57.1, 12.0]\nto = [60.0, 12.0]\n"),
    );
    let site = site.built();
    let ask = |through: &str| {
        let args = ["dock", "ward 12", "--through", through, "--json"];
        site.adit("why-not", &args).expecting(0).json()
    };
    let costs: Vec<f64> = ["by the link", "link door", "58.5,14"]
        .map(|through| {
            let answer = ask(through);
            assert_eq!(answer["through"], through);
            answer["cost"].as_f64().unwrap()
        })
        .into();
    assert!(costs.iter().all(|cost| (cost - costs[0]).abs() < 1.0), "{costs:?}");
    for through in ["pharmacy", "corridor 16", "doorway 1", "room a", "door 7"] {
        assert!(ask(through)["sentence"].as_str().unwrap().contains(' '), "{through}");
    }
    let said = site.adit("why-not", &["dock", "ward 12", "--through", "58.5,14"]).expecting(0).stdout;
    assert!(said.contains("By 58.5,14 it would cost "), "{said}");
    site.adit("why-not", &["dock", "ward 12", "--through", "pharmcy"])
        .expecting(2)
        .complains(&["leads through nothing that is called `pharmcy`", "did you mean `pharmacy`?"]);
}
