//! A door that is told to let nobody through is shut at its place: for every state, and for changes of shape there. So is
//! what people close by its name.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

mod by_name;

use adit::edit::Edit;
use adit::preview::Wanted;
use adit::{Answer, KnowledgeBase, Live, Status, Tell};
use adit_db::Store;
use adit_db::history::Author;
use adit_planners::geometry::Point;
use adit_tests::TestSite;
use adit_tests::oracle::random::Chance;

/// What is nearer than this to an end of a door goes past the door, metres.
const HAIR: f64 = 1e-6;

fn live(site: &TestSite) -> Live {
    Live::open(KnowledgeBase::open(site.path()).unwrap()).unwrap()
}

fn closing(door: &str) -> Tell {
    let [class, property, value] = ["DOORS", "passable", "false"].map(str::to_owned);
    Tell { class, object: format!("door {door}"), property, value, ..Tell::default() }
}

fn author() -> Author {
    Author { who: "test".to_owned(), why: String::new() }
}

/// The segment of a door.
fn segment(site: &TestSite, door: &str) -> [Point; 2] {
    let mut store = Store::open_read_only(site.path().join("site.db")).unwrap();
    let [x0, y0, x1, y1] = store.snapshot(|tx| tx.door(door.parse().unwrap())).unwrap().unwrap().segment;
    [Point::new(x0, y0), Point::new(x1, y1)]
}

/// Whether the straight way from one point to another crosses a segment, or lies on it with some of its length on either
/// side of it.
fn crosses([a, b]: [Point; 2], from: Point, to: Point) -> bool {
    let side = |one: Point, two: Point, p: Point| {
        ((two.x - one.x) * (p.y - one.y) - (two.y - one.y) * (p.x - one.x)) / one.distance(two)
    };
    if from.distance(to) < HAIR {
        return false;
    }
    let (before, behind) = (side(a, b, from), side(a, b, to));
    if before.abs() < HAIR && behind.abs() < HAIR || before * behind > 0.0 {
        return false;
    }
    let share = before.abs() / (before.abs() + behind.abs());
    let at = Point::new(from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share);
    let is_touched_only = before.abs() < HAIR || behind.abs() < HAIR;
    let along = at.nearest_on(a, b);
    !is_touched_only && along.distance(at) < HAIR && along.distance(a).min(along.distance(b)) > HAIR
}

/// What is wrong with a route where a door is closed.
fn faults(route: &Answer, door: [Point; 2]) -> Vec<String> {
    let points: Vec<Point> = route.waypoints.iter().map(|point| Point::new(point.x, point.y)).collect();
    // what comes to the closed line at one waypoint, and leaves it on the other side at a later one, crosses it, too
    let off = |p: &Point| p.nearest_on(door[0], door[1]).distance(*p) > HAIR;
    let side =
        |p: Point| (door[1].x - door[0].x) * (p.y - door[0].y) - (door[1].y - door[0].y) * (p.x - door[0].x);
    let mut faults = Vec::new();
    for pair in points.windows(2).filter(|pair| crosses(door, pair[0], pair[1])) {
        faults.push(format!("a leg crosses the door from {:?} to {:?}", pair[0], pair[1]));
    }
    for (index, at) in points.iter().enumerate() {
        let is_end = at.distance(door[0]).min(at.distance(door[1])) < HAIR;
        if off(at) || is_end {
            continue;
        }
        let before = points[..index].iter().rev().find(|p| off(p));
        let after = points[index + 1..].iter().find(|p| off(p));
        if let (Some(before), Some(after)) = (before, after)
            && side(*before) * side(*after) < 0.0
        {
            faults.push(format!("it comes to the door at {at:?}, and leaves on the other side"));
        }
    }
    for step in route.steps.iter().filter(|step| step.kind == "change") {
        let at = Point::new(step.x.unwrap(), step.y.unwrap());
        if !off(&at) {
            faults.push(format!("a shape is changed on the door, at {at:?}"));
        }
    }
    faults
}

/// Closes doors of random routes one by one: how many there were, and how many left a way.
fn close_random_doors(site: &TestSite, robots: &[Option<&str>], count: usize) -> (usize, usize) {
    let live = live(site);
    let places = site.sqlite3("SELECT place FROM places ORDER BY place");
    let mut chance = Chance::new(7);
    let (mut closed, mut left) = (0, 0);
    for _ in 0..20 * count {
        if closed == count {
            break;
        }
        let one = |chance: &mut Chance| places[chance.below(places.len())].clone();
        let (start, goal) = (one(&mut chance), one(&mut chance));
        let robot = robots[chance.below(robots.len())];
        let before = live.route(&start, std::slice::from_ref(&goal), robot).unwrap();
        let doors: Vec<&str> =
            before.steps.iter().filter(|step| step.kind == "door").map(|step| step.place.as_str()).collect();
        if start == goal || doors.is_empty() {
            continue;
        }
        let door = doors[chance.below(doors.len())];
        let wanted = Wanted { start: &start, goal: &goal, robot };
        let after = live.preview(&[Edit::Tell(closing(door))], Some(wanted)).unwrap().route.unwrap();
        let found = faults(&after, segment(site, door));
        assert!(found.is_empty(), "{start} to {goal}, {robot:?}, door {door} closed: {found:#?}");
        if after.status == Status::NoRoute {
            assert!(after.reason.as_ref().is_some_and(|reason| !reason.is_empty()), "{after:?}");
        } else {
            // keeping off walls costs up to one in a hundred, now here, now there
            let least = before.cost.unwrap() / 1.01;
            assert!(after.cost.unwrap() > least - 1e-6, "{start} to {goal}, door {door}");
            left += 1;
        }
        closed += 1;
    }
    assert_eq!(closed, count);
    (closed, left)
}

#[test]
fn on_the_clinic_no_route_crosses_a_closed_door_in_any_state() {
    let (_, left) = close_random_doors(&TestSite::example("clinic").built(), &[None], 40);
    assert!(left > 10, "{left}");
}

#[test]
fn on_the_depot_no_robot_crosses_a_closed_door_in_any_state() {
    let site = TestSite::example("depot").built();
    let robots = site.sqlite3("SELECT DISTINCT robot FROM robots ORDER BY robot");
    let robots: Vec<Option<&str>> = robots.iter().map(|robot| Some(robot.as_str())).collect();
    let (_, left) = close_random_doors(&site, &robots, 40);
    assert!(left > 10, "{left}");
}

#[test]
fn on_the_hospital_floor_no_route_crosses_a_closed_door_in_any_state() {
    let (_, left) = close_random_doors(&TestSite::example("hospital").built(), &[None], 20);
    assert!(left > 5, "{left}");
}

#[test]
fn the_only_doorway_closed_leaves_no_way_and_that_is_the_reason() {
    // once, the robot changed its shape on the closed line: on its knees into it, sideways out of it
    let text = "name = \"starter\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\n";
    let site = TestSite::example("starter").with("site.toml", text).built();
    let before = site.adit("route", &["home", "window", "--json"]).expecting(0).json();
    let back = site.adit("route", &["window", "home", "--json"]).expecting(0).json();
    let mut doors = before["steps"].as_array().unwrap().iter().filter(|step| step["kind"] == "door");
    let in_wall = |step: &&serde_json::Value| (5.5..6.6).contains(&step["x"].as_f64().unwrap());
    let door = doors.find(in_wall).unwrap()["place"].as_str().unwrap().to_owned();
    site.adit("tell", &["DOORS", &format!("door {door}"), "passable", "false"]).expect_status(0);
    for [start, goal] in [["home", "window"], ["window", "home"]] {
        let none = site.adit("route", &[start, goal]).expecting(1).stdout;
        assert!(none.contains("is told to let nobody through"), "{none}");
        let kept = format!("SELECT status FROM route WHERE start = '{start}' AND goal = '{goal}'");
        assert_eq!(site.sqlite3(&kept), ["no_route"]);
    }
    site.adit("tell", &["--retract", "1"]).expect_status(0);
    let steps = |answer: &serde_json::Value| (answer["steps"].clone(), answer["waypoints"].clone());
    let again = site.adit("route", &["home", "window", "--json"]).expecting(0).json();
    assert_eq!(steps(&again), steps(&before), "the old route, to the bit");
    let again = site.adit("route", &["window", "home", "--json"]).expecting(0).json();
    assert_eq!(steps(&again), steps(&back));
}

#[test]
fn kept_routes_questions_previews_and_sql_agree_on_what_is_closed() {
    let site = TestSite::example("clinic").built();
    let mut live = live(&site);
    let goal = ["ward 12".to_owned()];
    let before = live.route("dock", &goal, None).unwrap();
    let doors: Vec<String> =
        before.steps.iter().filter(|step| step.kind == "door").map(|step| step.place.clone()).collect();
    for door in [&doors[1], &doors[doors.len() / 2]] {
        let wanted = Wanted { start: "dock", goal: "ward 12", robot: None };
        let tell = Edit::Tell(closing(door));
        let preview = live.preview(std::slice::from_ref(&tell), Some(wanted)).unwrap().route.unwrap();
        live.edit(&tell, &author()).unwrap();
        live.renew_routes().unwrap();
        let asked = live.route("dock", &goal, None).unwrap();
        assert!(faults(&asked, segment(&site, door)).is_empty());
        assert_eq!((&asked.steps, &asked.waypoints), (&preview.steps, &preview.waypoints));
        // what is kept is what a question finds; numbers are rounded in the tables as they are in answers
        let steps = "SELECT kind || ' ' || place || ' ' || action FROM action_sequence
                     WHERE start = 'dock' AND goal = 'ward 12' ORDER BY step";
        let said = asked.steps.iter().map(|step| {
            format!("{} {} {}", step.kind, step.place, step.action.as_deref().unwrap_or_default())
        });
        assert_eq!(site.sqlite3(steps), said.collect::<Vec<_>>());
        let points = "SELECT printf('%.6f,%.6f', x, y) FROM waypoints
                      WHERE start = 'dock' AND goal = 'ward 12' ORDER BY waypoint";
        let said = asked.waypoints.iter().map(|point| format!("{:.6},{:.6}", point.x, point.y));
        assert_eq!(site.sqlite3(points), said.collect::<Vec<_>>());
        let fact: i64 = site.sqlite3("SELECT max(id) FROM told")[0].parse().unwrap();
        live.retract(fact, &author()).unwrap();
        live.renew_routes().unwrap();
        let again = live.route("dock", &goal, None).unwrap();
        assert_eq!((&again.steps, &again.waypoints), (&before.steps, &before.waypoints), "to the bit");
    }
}

#[test]
fn a_named_door_is_closed_and_opened_by_its_own_name_and_by_that_of_the_doorway_in_which_it_stands() {
    let site = TestSite::example("starter");
    let door = "[[door]]\nname = \"ward door\"\nfrom = [5.9, 3.0]\nto = [5.9, 4.0]\n";
    site.write(
        "site.toml",
        format!(
            "name = \"ward\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\n{door}"
        ),
    );
    let site = site.built();
    let is_open = || {
        let status = site.sqlite3("SELECT status FROM route WHERE start = 'home' AND goal = 'window'");
        status == ["ok"]
    };
    for (close, open) in [("ward door", "doorway 1"), ("doorway 1", "ward door")] {
        site.adit("close", &[close]).expect_status(0);
        assert!(!is_open(), "closed as {close}");
        site.adit("open", &[open]).expect_status(0);
        assert!(is_open(), "closed as {close}, opened as {open}");
        assert_eq!(site.sqlite3("SELECT count(*) FROM told"), ["0"], "no fact stays behind");
    }
    // whoever tells it of the doorway itself, too
    site.adit("tell", &["DOORWAYS", "doorway 1", "closed", "true"]).expect_status(0);
    site.adit("close", &["ward door"]).expect_status(0);
    site.adit("open", &["ward door"]).expect_status(0);
    assert!(is_open());
}
