//! A start or goal that fits is never refused; one that does not is answered with the nearest point that does.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit::{Answer, Code, KnowledgeBase, Live, Status};
use adit_planners::geometry::Point;
use adit_planners::world::Shape;
use adit_tests::oracle::body::Body;
use adit_tests::oracle::driven::Driven;
use adit_tests::oracle::plan::Plan;
use adit_tests::oracle::random::Chance;
use adit_tests::oracle::site::Built;
use adit_tests::oracle::space::Space;
use adit_tests::service::Service;
use adit_tests::{TestSite, shared};

/// Nearer to its limit than this, metres, nobody says whether a state fits.
const HAIR: f64 = 1e-6;

/// How much of a wall a way may overlap, metres: what fractions lose in binary and in JSON.
const TRESPASS: f64 = 1e-6;

fn body() -> Body {
    Body::new(&[("WALK", 1.7, 0.62, 1.0), ("SIDE", 1.7, 0.34, 3.0), ("SQUAT", 0.9, 0.7, 2.5)])
        .with_changes(&[(0, 1, 0.5), (1, 0, 0.5), (0, 2, 1.0), (2, 0, 1.0)])
}

/// A floor with straight and slanted walls, a corner of 45 degrees, a pillar, and a bridge.
fn floor() -> Plan {
    let mut plan = Plan::hall(9.0, 7.0)
        .with_rect(3.0, 0.0, 3.137, 4.1)
        .with_rect(5.03, 2.9, 5.2, 7.0)
        .with_rect(7.0, 3.0, 7.31, 3.31)
        .with_bridge(3.137, 1.0, 5.5, 1.6, 1.1);
    let corners =
        |points: &[(f64, f64)]| Shape::Polygon(points.iter().map(|&(x, y)| Point::new(x, y)).collect());
    plan.obstacles.push(corners(&[(0.7, 4.9), (2.3, 5.9), (2.2, 6.06), (0.6, 5.06)]));
    plan.obstacles.push(corners(&[(6.4, 0.0), (9.0, 0.0), (9.0, 2.1)]));
    plan.obstacles.push(corners(&[(3.5, 5.5), (4.4, 5.2), (4.2, 6.4)]));
    plan
}

fn live(built: &Built) -> Live {
    Live::open(KnowledgeBase::open(built.folder().path()).unwrap()).unwrap()
}

fn named(p: Point) -> String {
    format!("{:?},{:?}", p.x, p.y)
}

/// Whether a point was answered as one at which a state fits, and what was said of it.
fn ask(live: &Live, start: &str, goal: &str) -> Result<Answer, adit::Error> {
    live.route(start, &[goal.to_owned()], None)
}

/// Points by chance within 20 cm of where a state's limit is.
fn near_walls(space: &Space, chance: &mut Chance, count: usize) -> Vec<Point> {
    let b = space.bounds();
    let tries = (0..200 * count).map(|_| Point::new(chance.between(b.x0, b.x1), chance.between(b.y0, b.y1)));
    tries.filter(|&p| space.spares_at(p).any(|spare| spare.abs() <= 0.2)).take(count).collect()
}

/// Asks for ways to points near walls, and compares what is said with closed forms.
fn is_never_refused(built: &Built, home: Point, count: usize, seed: u64) {
    let space = Space::new(&built.world, built.body(), 0.0);
    let live = live(built);
    let (mut wrong, mut fitting, mut joined) = (Vec::new(), 0, 0);
    for p in near_walls(&space, &mut Chance::new(seed), count) {
        let best = space.spares_at(p).fold(f64::NEG_INFINITY, f64::max);
        if best.abs() <= HAIR {
            continue;
        }
        let mut say =
            |what: String| wrong.push(format!("{}: {what}, where there are {best} m of room", named(p)));
        let (start, goal) = if fitting % 2 == 0 { (home, p) } else { (p, home) };
        match ask(&live, &named(start), &named(goal)) {
            Ok(answer) if matches!(answer.status, Status::Ok | Status::SameRoom) => {
                fitting += 1;
                if best < 0.0 {
                    say("a way".to_owned());
                }
                let json = serde_json::to_value(&answer).unwrap();
                let driven = Driven::read(&json, start, built.body());
                driven.faults(&space).into_iter().for_each(&mut say);
                let pieces = driven
                    .way
                    .pieces()
                    .filter(|piece| space.spare(piece.state, piece.from, piece.to) < -TRESPASS);
                pieces.for_each(|piece| say(format!("{piece:?} leads through something")));
                let ends = [driven.way.points.first(), driven.way.points.last()].map(|end| *end.unwrap());
                if ends[0].distance(start).max(ends[1].distance(goal)) > HAIR {
                    say(format!("a way from {:?} to {:?}", ends[0], ends[1]));
                }
                joined += usize::from(live.route(&named(p), &[named(p)], None).unwrap().cost != Some(0.0));
            }
            Ok(answer) => {
                let reason = answer.reason.unwrap_or_default();
                if best > 0.0 && !reason.contains("shut in there") {
                    say(format!("refused: {reason}"));
                }
            }
            Err(error) if best > 0.0 => say(error.to_string()),
            Err(_) => {}
        }
    }
    assert!(fitting > count / 5, "only {fitting} of {count} points fit");
    assert_eq!(joined, 0, "a way from a point to itself costs something");
    assert!(wrong.is_empty(), "{} of {count}: {:#?}", wrong.len(), &wrong[..wrong.len().min(20)]);
}

#[test]
fn no_point_that_fits_is_refused_beside_straight_slanted_and_round_things() {
    let built = Built::of_plan(&floor(), &body(), 0.1);
    is_never_refused(&built, Point::new(1.5, 1.5), 1500, 1);
}

#[test]
fn no_point_that_fits_is_refused_on_a_scan() {
    on_a_scan(300);
}

#[test]
#[ignore = "minutes: 200,000 points; cargo test --release -p adit-tests --test journeys very_many -- --ignored"]
fn of_very_many_points_none_that_fits_is_refused() {
    let built = Built::of_plan(&floor(), &body(), 0.1);
    is_never_refused(&built, Point::new(1.5, 1.5), 150_000, 3);
    on_a_scan(50_000);
}

fn on_a_scan(count: usize) {
    let Some(map) = shared("data/aws-robomaker/bookstore_map.yaml") else { return };
    let built = Built::of_map(&map, &body());
    let space = Space::new(&built.world, built.body(), 0.4);
    let b = space.bounds();
    let mut chance = Chance::new(5);
    let mut home = || Point::new(chance.between(b.x0, b.x1), chance.between(b.y0, b.y1));
    let home = (0..100_000).map(|_| home()).find(|&p| space.spares_at(p).all(|spare| spare > 0.0)).unwrap();
    is_never_refused(&built, home, count, 2);
}

/// A hall with a wall up to 5.0; the robot's radius is 0.31.
fn hall() -> Built {
    Built::of_plan(
        &Plan::hall(10.0, 6.0).with_rect(5.0, 0.0, 5.4, 3.0),
        &Body::new(&[("WALK", 1.7, 0.62, 2.0)]),
        0.1,
    )
}

#[test]
fn a_start_that_touches_the_wall_is_joined_by_a_leg_that_costs_its_metres() {
    let built = hall();
    let route = built.route(Point::new(4.69, 1.0), Point::new(2.0, 1.0)).unwrap();
    assert!((route.cost - 2.69 * 2.0).abs() < 1e-9, "{}", route.cost);
    let clearance = route.json["waypoints"][1]["clearance"].as_f64().unwrap();
    assert!(clearance.abs() < 1e-9, "it starts at the wall: {clearance}");
    assert!(
        built.route(Point::new(4.690_001, 1.0), Point::new(2.0, 1.0)).is_none(),
        "a micrometre in the wall"
    );
}

#[test]
fn a_point_too_near_to_a_wall_is_answered_with_the_nearest_one_and_taken_if_that_is_near_enough() {
    let built = hall();
    let site = built.folder();
    let ran = site.adit("route", &["4.9,1", "2,1"]).expecting(1);
    ran.complains(&[]);
    let json = site.adit("route", &["4.9,1", "2,1", "--json"]).expecting(1).json();
    let near = |nearest: &serde_json::Value, end: &str, x: f64, metres: f64| {
        let told = |name: &str| nearest[name].as_f64().unwrap();
        let off = [told("x") - x, told("y") - 1.0, told("metres") - metres];
        assert!(off.iter().all(|off| off.abs() < 1e-6), "{nearest}");
        assert_eq!((&nearest["end"], &nearest["state"]), (&end.into(), &"WALK".into()));
    };
    near(&json["nearest"], "start", 4.69, 0.21);
    let reason = json["reason"].as_str().unwrap();
    assert!(
        reason.ends_with("the nearest point at which one fits is (4.69, 1), 0.21 m away (state WALK)"),
        "{reason}"
    );
    // inside of the wall: an error, with the same words
    let solid = site.adit("route", &["5.3,1", "2,1", "--json"]).expecting(2).json();
    assert_eq!(solid["error"][0]["code"], "route/solid");
    near(&solid["error"][0]["nearest"], "start", 5.71, 0.41);
    // too far, then near enough; whichever end it is
    site.adit("route", &["4.9,1", "2,1", "--within", "0.2"]).expect_status(1);
    let taken = site.adit("route", &["4.9,1", "2,1", "--within", "0.22", "--json"]).expecting(0).json();
    near(&taken["taken"][0], "start", 4.69, 0.21);
    assert!((taken["cost"].as_f64().unwrap() - 2.69 * 2.0).abs() < 1e-6, "{}", taken["cost"]);
    let both = site.adit("route", &["5.1,1", "9.99,1", "--within", "0.5", "--json"]).expecting(0).json();
    near(&both["taken"][0], "start", 4.69, 0.41);
    near(&both["taken"][1], "goal", 9.69, 0.3);
    // outside of the map
    let outside = site.adit("route", &["-0.2,1", "2,1", "--within", "1", "--json"]).expecting(0).json();
    near(&outside["taken"][0], "start", 0.31, 0.51);
    // nothing to take where it fits
    let fits = site.adit("route", &["4,1", "2,1", "--within", "0.2", "--json"]).expecting(0).json();
    assert!(fits.get("taken").is_none(), "{fits}");
}

#[test]
fn the_service_and_a_preview_answer_the_same() {
    let built = hall();
    let service = Service::start(built.folder());
    let ask = |query: &str| service.ask("GET", &format!("/api/route?goal=2,1&{query}"), None);
    let (status, refused) = ask("start=4.9,1");
    assert_eq!((status, &refused["status"]), (200, &"no_route".into()));
    assert!((refused["nearest"]["metres"].as_f64().unwrap() - 0.21).abs() < 1e-6, "{refused}");
    let (_, taken) = ask("start=4.9,1&within=0.3");
    assert_eq!((&taken["status"], &taken["taken"][0]), (&"same_room".into(), &refused["nearest"]));
    let (status, solid) = ask("start=5.3,1&within=0.3");
    assert_eq!((status, &solid["error"]["code"]), (400, &"route/solid".into()));
    assert!(
        (solid["error"]["problems"][0]["nearest"]["metres"].as_f64().unwrap() - 0.41).abs() < 1e-6,
        "{solid}"
    );
    for bad in ["-1", "NaN", "far", "1e9"] {
        let (status, answer) = ask(&format!("start=4.9,1&within={bad}"));
        assert_eq!((status, &answer["error"]["code"]), (400, &"route/within".into()), "{bad}");
    }
    let body = serde_json::json!({"edits": [], "start": "4.9,1", "goal": "2,1", "within": 0.3});
    let (_, preview) = service.ask("POST", "/api/preview", Some(&body));
    assert_eq!(preview["route"]["taken"], taken["taken"], "{preview}");
}

#[test]
fn a_tolerance_that_is_none_is_refused() {
    let built = hall();
    for bad in ["-0.1", "NaN", "inf", "1e9"] {
        built
            .folder()
            .adit("route", &["4.9,1", "2,1", "--within", bad])
            .expecting(2)
            .complains(&["0 to 100 metres"]);
    }
    let bad = live(&built).view().within(Some(f64::NAN)).err().unwrap();
    assert_eq!(bad.problems()[0].code(), Some(Code::RouteWithin));
}

#[test]
fn walls_that_shut_a_robot_in_where_it_just_fits_are_the_reason() {
    // a cell of 1 m, closed by walls all around, in which the robot just fits
    let plan = Plan::hall(10.0, 6.0)
        .with_rect(4.0, 2.0, 5.7, 2.3)
        .with_rect(4.0, 2.93, 5.7, 3.2)
        .with_rect(4.0, 2.3, 4.3, 2.93)
        .with_rect(4.94, 2.3, 5.7, 2.93);
    let built = Built::of_plan(&plan, &Body::new(&[("WALK", 1.7, 0.62, 2.0)]), 0.1);
    let answer = ask(&live(&built), "4.62,2.615", "1,1").unwrap();
    let reason = answer.reason.unwrap();
    assert!(reason.starts_with("walls part start and goal"), "{reason}");
}

#[test]
fn no_leg_leads_into_or_through_what_must_not_be_entered() {
    // between the keep-out and the wall is a strip in which the robot fits, and no room
    let site = TestSite::empty()
        .with("map.toml", "width = 8.0\ndepth = 4.0\n[[place]]\nname = \"nook\"\nat = [0.31, 2.0]\n[[place]]\nname = \"far\"\nat = [7.0, 2.0]\n")
        .with("robots.toml", &Body::new(&[("WALK", 1.7, 0.62, 1.0)]).to_toml())
        .with("site.toml", &site_text())
        .built();
    let cost = |site: &TestSite| {
        site.sqlite3("SELECT status, round(cost, 6) FROM route WHERE start = 'nook' AND goal = 'far'")
    };
    assert_eq!(cost(&site), ["same_room|6.69"], "kept routes start where it fits, too");
    let area = "[[area]]\nname = \"shut\"\nkind = \"keep-out\"\nrect = [0.0, 1.0, 2.0, 3.0]\n";
    let site = site.with("site.toml", &(site_text() + area)).built();
    assert_eq!(cost(&site), ["no_route|"]);
    let json = site.adit("route", &["nook", "far", "--json"]).expecting(1).json();
    assert!(json["nearest"]["metres"].as_f64().is_some_and(|metres| metres > 0.9), "{json}");
    let door = "[[door]]\nname = \"gate\"\nfrom = [0.35, 0.0]\nto = [0.35, 4.0]\nclosed = true\n";
    let site = site.with("site.toml", &(site_text() + door)).built();
    assert_eq!(cost(&site), ["no_route|"], "the gate lies between the place and all rooms");
}

fn site_text() -> String {
    "name = \"a test\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\ngrid = 0.1\n".to_owned()
}
