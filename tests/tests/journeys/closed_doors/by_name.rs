//! Whatever people close by the name that they have for it stays shut: doorways, spaces, areas, and the place where a robot
//! was blocked.

use std::path::{Path, PathBuf};

use adit::edit::{Close, Edit};
use adit::{Answer, Live};
use adit_db::history::Author;
use adit_planners::geometry::{Point, Segment, polygon};
use adit_tests::oracle::random::Chance;
use adit_tests::{TestSite, shared};
use serde_json::Value;

use super::{author, crosses, faults, live};

fn close(what: &str) -> Edit {
    Edit::Close(Close { what: what.to_owned(), ..Close::default() })
}

/// What is closed by random routes.
#[derive(Clone, Copy, PartialEq)]
enum What {
    /// A doorway on the way.
    Doorway,
    /// A doorway on the way, for the robot that goes there and no other one.
    DoorwayForOne,
    /// A doorway on the way, from the space from which the way comes.
    OneWay,
    /// Whatever is ahead of a robot that stands somewhere on the way.
    Ahead,
}

/// The segment of the newest fact.
fn told(site: &TestSite) -> [Point; 2] {
    let row = site.sqlite3("SELECT x0, y0, x1, y1 FROM told ORDER BY id DESC LIMIT 1").concat();
    let ends: Vec<f64> = row.split('|').map(|number| number.parse().unwrap()).collect();
    [Point::new(ends[0], ends[1]), Point::new(ends[2], ends[3])]
}

/// Doorways by number, with their segments.
fn doorways(site: &TestSite) -> Vec<(String, [Point; 2])> {
    let rows = site.sqlite3("SELECT doorway, x0, y0, x1, y1 FROM doorways ORDER BY doorway");
    let read = |row: &String| {
        let mut parts = row.split('|');
        let number = parts.next().unwrap().to_owned();
        let ends: Vec<f64> = parts.map(|part| part.parse().unwrap()).collect();
        (number, [Point::new(ends[0], ends[1]), Point::new(ends[2], ends[3])])
    };
    rows.iter().map(read).collect()
}

/// The names of the spaces that a doorway is between, the one first that lies to the left of its segment.
fn beside(site: &TestSite, number: &str, [a, b]: [Point; 2]) -> [String; 2] {
    let middle = a.lerp(b, 0.5);
    let along = (b - a) * (1.0 / a.distance(b));
    let names = site.sqlite3(&format!(
        "SELECT coalesce(s.name, 'space ' || s.space) || '|' || s.outline FROM spaces s
         JOIN doorways d ON s.space IN (d.space1, d.space2) WHERE d.doorway = {number}"
    ));
    let left_of = |row: &String| {
        let (name, outline) = row.split_once('|').unwrap();
        let rings: Vec<Vec<[f64; 2]>> = serde_json::from_str(outline).unwrap();
        let sides = rings.iter().flat_map(|ring| {
            let corner = |at: usize| Point::new(ring[at % ring.len()][0], ring[at % ring.len()][1]);
            (0..ring.len()).map(move |at| Segment::new(corner(at), corner(at + 1))).collect::<Vec<_>>()
        });
        let sides: Vec<Segment> = sides.collect();
        let near = [0.3, 0.5, 0.8].into_iter().find_map(|off| {
            let left = middle + along.perpendicular() * off;
            let right = middle + along.perpendicular() * -off;
            let [left, right] = [left, right].map(|p| polygon::encloses(sides.iter().copied(), p));
            (left != right).then_some(left)
        });
        (near, name.to_owned())
    };
    match &names.iter().map(left_of).collect::<Vec<_>>()[..] {
        [(Some(true), one), (_, other)] | [(_, other), (Some(true), one)] => [one.clone(), other.clone()],
        found => panic!("doorway {number} is not between two spaces: {found:?}"),
    }
}

/// Closes something on random routes, one by one: how many left a way.
fn close_on_random_routes(site: &TestSite, (what, count, seed): (What, usize, u64)) -> usize {
    let mut live: Live = live(site);
    let doorways = doorways(site);
    let mut places = site.sqlite3("SELECT place FROM places ORDER BY place");
    if places.is_empty() {
        // where the map names none, from the middle of a space to that of another
        places = site.sqlite3("SELECT x || ',' || y FROM spaces WHERE area > 1.0 ORDER BY space");
    }
    let robots = site.sqlite3("SELECT DISTINCT robot FROM robots ORDER BY robot");
    let mut chance = Chance::new(seed);
    let (mut closed, mut left) = (0, 0);
    for _ in 0..60 * count {
        if closed == count {
            break;
        }
        let one = |chance: &mut Chance, of: &[String]| of[chance.below(of.len())].clone();
        let (start, goal) = (one(&mut chance, &places), [one(&mut chance, &places)]);
        let robot = one(&mut chance, &robots);
        let before = live.route(&start, &goal, Some(&robot)).unwrap();
        let points: Vec<Point> = before.waypoints.iter().map(|point| Point::new(point.x, point.y)).collect();
        let others = |live: &Live| {
            let others = robots.iter().filter(|other| **other != robot);
            let found = others.map(|other| live.route(&start, &goal, Some(other)).unwrap());
            found.map(|route| (route.cost, route.steps, route.waypoints)).collect::<Vec<_>>()
        };
        let untouched = others(&live);
        let (edit, at) = match what {
            What::Doorway | What::DoorwayForOne | What::OneWay => {
                let is_passed =
                    |segment: [Point; 2]| points.windows(2).any(|leg| crosses(segment, leg[0], leg[1]));
                let passed: Vec<&(String, [Point; 2])> =
                    doorways.iter().filter(|(_, segment)| is_passed(*segment)).collect();
                if passed.is_empty() {
                    continue;
                }
                let (number, segment) = passed[chance.below(passed.len())];
                if what == What::OneWay {
                    one_way(site, (&mut live, &author()), (number, *segment), (&start, &goal[0], &robot));
                    closed += 1;
                    continue;
                }
                let only = if what == What::DoorwayForOne { vec![robot.clone()] } else { Vec::new() };
                let what = format!("doorway {number}");
                (Edit::Close(Close { what, only, ..Close::default() }), None)
            }
            What::Ahead => {
                let legs: Vec<&[Point]> =
                    points.windows(2).filter(|leg| leg[0].distance(leg[1]) > 0.5).collect();
                if legs.is_empty() {
                    continue;
                }
                let leg = legs[chance.below(legs.len())];
                let at = leg[0].lerp(leg[1], chance.below(1000) as f64 / 1000.0);
                let heading = (leg[1] - leg[0]).angle().to_degrees();
                (close(&format!("{},{}@{heading}", at.x, at.y)), Some(at))
            }
        };
        live.edit(&edit, &author()).unwrap();
        let shut = told(site);
        let from = at.map_or(start.clone(), |at| format!("{},{}", at.x, at.y));
        let after = live.route(&start, &goal, Some(&robot)).unwrap();
        let onward = live.route(&from, &goal, Some(&robot)).unwrap();
        for route in [&after, &onward] {
            let found = faults(route, shut);
            assert!(found.is_empty(), "{start} to {goal:?}, {robot}, {edit:?}: {found:#?}");
        }
        if what == What::DoorwayForOne {
            assert!(others(&live) == untouched, "another robot's route is another one: {edit:?}");
        }
        match after.cost {
            None => assert!(after.reason.is_some_and(|reason| reason.contains("closed")), "{edit:?}"),
            Some(cost) => {
                // keeping off walls costs up to one in a hundred, now here, now there
                assert!(cost > before.cost.unwrap() / 1.01 - 1e-6, "{start} to {goal:?}, {edit:?}");
                left += 1;
            }
        }
        live.edit(&Edit::Undo(None), &author()).unwrap();
        let again = live.route(&start, &goal, Some(&robot)).unwrap();
        assert_eq!((&again.steps, &again.waypoints), (&before.steps, &before.waypoints), "to the bit");
        closed += 1;
    }
    assert_eq!(closed, count);
    left
}

/// Closes a doorway that a way passes from the side from which it comes: it goes there no more. From the other side, it stays.
fn one_way(
    site: &TestSite,
    (live, author): (&mut Live, &Author),
    (number, [a, b]): (&str, [Point; 2]),
    (start, goal, robot): (&str, &str, &str),
) {
    let goals = [goal.to_owned()];
    let route = |live: &Live| live.route(start, &goals, Some(robot)).unwrap();
    let before = route(live);
    let is_left = |p: Point| (b - a).cross(p - a) > 0.0;
    // whether ways lead from the left to the right, and back, where they pass it
    let passes = |route: &Answer| {
        let points: Vec<Point> = route.waypoints.iter().map(|point| Point::new(point.x, point.y)).collect();
        let passed = points.windows(2).filter(|leg| crosses([a, b], leg[0], leg[1]));
        let from_left: Vec<bool> = passed.map(|leg| is_left(leg[0])).collect();
        [from_left.contains(&true), from_left.contains(&false)]
    };
    let spaces = beside(site, number, [a, b]);
    for (side, from) in spaces.into_iter().enumerate() {
        let what = format!("doorway {number}");
        let edit = Edit::Close(Close { what, from: Some(from.clone()), ..Close::default() });
        live.edit(&edit, author).unwrap();
        let after = route(live);
        let told = format!("{start} to {goal}, {robot}, doorway {number} from {from}");
        assert!(!passes(&after)[side], "{told}: passed from there");
        if !passes(&before)[side] {
            let (was, is) = (before.cost.unwrap(), after.cost.expect(&told));
            assert!(
                (is / was - 1.0).abs() < 1e-6,
                "{told}: {was} and {is}, though it comes from the other side"
            );
        }
        if after.cost.is_none() {
            let reason = after.reason.expect(&told);
            assert!(reason.contains(&format!("closed from {from}")), "{told}: {reason}");
        }
        live.edit(&Edit::Undo(None), author).unwrap();
        let again = route(live);
        assert_eq!((&again.steps, &again.waypoints), (&before.steps, &before.waypoints), "to the bit");
    }
}

#[test]
fn on_the_clinic_a_doorway_is_closed_from_one_side() {
    close_on_random_routes(&TestSite::example("clinic").built(), (What::OneWay, 8, 6));
}

#[test]
fn what_is_closed_from_one_side_is_said_shown_and_refused_in_words() {
    let site = TestSite::example("clinic").built();
    let row = site.sqlite3(
        "SELECT d.name || '|' || one.name || '|' || other.name FROM doorways d JOIN spaces one ON one.space = d.space1
         JOIN spaces other ON other.space = d.space2 WHERE d.space1 <> d.space2 AND other.name = 'ward 12'",
    );
    let parts: Vec<&str> = row[0].split('|').collect();
    let (name, outside) = (parts[0], parts[1]);
    let said = site.adit("close", &[name, "--from", outside, "--why", "wet floor"]).expecting(0).stdout;
    assert!(
        said.contains(&format!("between {outside} and ward 12, is closed from {outside} (fact 1)")),
        "{said}"
    );
    assert_eq!(
        site.sqlite3("SELECT name, closed_from FROM doorways WHERE closed_from IS NOT NULL"),
        [format!("{name}|{outside}")]
    );
    let none = site.adit("route", &["dock", "ward 12"]).expecting(1).stdout;
    assert!(none.contains(&format!("is closed from {outside}")), "{none}");
    site.adit("route", &["ward 12", "dock"]).expect_status(0);
    let picture = site.path().join("one-way.svg");
    site.adit("draw", &["-o", picture.to_str().unwrap()]).expect_status(0);
    assert!(std::fs::read_to_string(&picture).unwrap().contains("open one way"));
    let opened = site.adit("open", &[name]).expecting(0).stdout;
    assert!(opened.contains("is open"), "{opened}");
    site.adit("route", &["dock", "ward 12"]).expect_status(0);
    for (arguments, said) in [
        (&[name, "--from", "ward 11"][..], "does not lead out of `ward 11`"),
        (&[name, "--from", "wrad 12"], "did you mean `ward 12`?"),
        (&["ward 12", "--from", outside], "is no doorway between rooms"),
        (&[name, "--from", outside, "--only", "robot"], "cannot be used with"),
    ] {
        site.adit("close", arguments).expecting(2).complains(&[said]);
    }
}

#[test]
fn one_goes_through_an_area_with_a_heading_in_that_direction() {
    let site = TestSite::empty();
    site.write(
        "map.toml",
        "width = 20.0\ndepth = 8.0\n[[obstacle]]\nrect = [4.0, 3.5, 16.0, 4.5]\n\
         [[place]]\nname = \"west\"\nat = [1.0, 4.0]\n[[place]]\nname = \"east\"\nat = [19.0, 4.0]\n",
    );
    site.write("robots.toml", TWO_ROBOTS);
    site.write("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n");
    let site = site.built();
    let ys = |from: &str, to: &str| -> Vec<f64> {
        let route = site.adit("route", &[from, to, "--robot", "cart", "--json"]).json();
        let points =
            route["waypoints"].as_array().unwrap_or_else(|| panic!("{from} to {to}: {route}")).clone();
        let inside = points.iter().filter(|point| (4.0..16.0).contains(&point["x"].as_f64().unwrap()));
        inside.map(|point| point["y"].as_f64().unwrap()).collect()
    };
    // two aisles: south eastwards, north westwards
    site.adit("lay", &["area", "south", "4,0 16,3.5", "--with", "heading=0"]).expect_status(0);
    site.adit("lay", &["area", "north", "4,4.5 16,8", "--with", "heading=180"]).expect_status(0);
    assert!(ys("west", "east").iter().all(|y| *y < 4.0), "{:?}", ys("west", "east"));
    assert!(ys("east", "west").iter().all(|y| *y > 4.0), "{:?}", ys("east", "west"));
    // nobody turns round in the middle of an aisle: back over one metre is forward around the block
    let metres = |from: &str, to: &str| {
        site.adit("route", &[from, to, "--robot", "cart", "--json"]).json()["cost"].as_f64().unwrap()
    };
    assert!(metres("8,2", "12,2") < 4.1 && metres("12,2", "8,2") > 20.0);
    let undone = site.adit("undo", &[]).expecting(0).stdout;
    assert!(undone.contains("`north` is passed in any direction") || undone.contains("north"), "{undone}");
    site.adit("lift", &["south"]).expect_status(0);
    assert!(metres("12,2", "8,2") < 4.1);
    site.adit("lay", &["area", "south", "4,0 16,3.5", "--with", "heading=north"])
        .expecting(2)
        .complains(&["heading"]);
}

#[test]
fn on_the_clinic_no_route_passes_a_closed_doorway() {
    let left = close_on_random_routes(&TestSite::example("clinic").built(), (What::Doorway, 12, 1));
    assert!(left > 1, "{left}");
}

#[test]
fn on_the_depot_no_robot_passes_a_closed_doorway() {
    close_on_random_routes(&TestSite::example("depot").built(), (What::Doorway, 12, 2));
}

#[test]
fn on_the_depot_no_robot_but_the_one_that_is_kept_out_minds_a_closed_doorway() {
    close_on_random_routes(&TestSite::example("depot").built(), (What::DoorwayForOne, 12, 5));
}

#[test]
fn on_the_hospital_floor_no_route_passes_what_a_robot_reported_to_be_blocked() {
    close_on_random_routes(&TestSite::example("hospital").built(), (What::Ahead, 12, 3));
}

#[test]
fn on_the_clinic_no_route_passes_what_a_robot_reported_to_be_blocked() {
    let left = close_on_random_routes(&TestSite::example("clinic").built(), (What::Ahead, 12, 4));
    assert!(left > 1, "{left}");
}

#[test]
#[ignore = "takes minutes: 200 doorways and 200 robots that are blocked on each shipped floor"]
fn on_every_floor_two_hundred_closings_hold() {
    for (number, name) in ["clinic", "depot", "hospital"].into_iter().enumerate() {
        for what in [What::Doorway, What::DoorwayForOne, What::OneWay, What::Ahead] {
            let site = TestSite::example(name).built();
            let left = close_on_random_routes(&site, (what, 200, 10 + number as u64));
            println!("{name}: 200 closed, {left} left a way");
        }
    }
}

const TWO_ROBOTS: &str = r#"
[[robots]]
robot = "walker"
state = "STAND"
action = "WALK"
height = 1.7
width = 0.45
hardness = 1.0

[[robots]]
robot = "walker"
state = "SIDE"
action = "SIDE-WALK"
height = 1.7
width = 0.25
hardness = 2.0

[[robots]]
robot = "cart"
state = "DRIVE"
action = "DRIVE"
height = 1.2
width = 0.5
hardness = 1.0
"#;

/// So many closings of each kind on a map of others, and how many of all left a way.
fn close_on(map: &Path, count: usize) -> usize {
    let text = format!("map = \"{}\"\nstarts = []\n", map.display());
    let site = TestSite::empty().with("robots.toml", TWO_ROBOTS).with("site.toml", &text).built();
    let has_doorways = doorways(&site).len() > 3;
    let kinds = [What::Doorway, What::DoorwayForOne, What::Ahead].into_iter();
    let kinds = kinds.filter(|what| has_doorways || *what == What::Ahead);
    kinds.map(|what| close_on_random_routes(&site, (what, count, 100))).sum()
}

#[test]
fn on_maps_of_others_closings_hold() {
    for name in [
        "room-segmentation/office_a_furnitures.yaml",
        "room-segmentation/lab_d_scan.yaml",
        "mir_robot/maze.yaml",
    ] {
        if let Some(map) = shared(&format!("data/{name}")) {
            close_on(&map, 2);
        }
    }
}

#[test]
#[ignore = "takes long: 200 closings of each kind on every map of others"]
fn on_every_map_of_others_two_hundred_closings_hold() {
    for folder in ["aws-robomaker", "mir_robot", "nav2", "room-segmentation", "stage", "turtlebot3"] {
        let Some(folder) = shared(&format!("data/{folder}")) else { continue };
        let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path());
        let is_map = |path: &PathBuf| {
            let name = path.to_string_lossy();
            // the others lay rules over a map, and are none
            path.extension().is_some_and(|end| end == "yaml")
                && !["keepout", "speed", "virtual_walls"].iter().any(|no| name.contains(no))
        };
        let mut maps: Vec<PathBuf> = files.filter(is_map).collect();
        maps.sort();
        for map in maps {
            println!("{}: {} left a way", map.display(), close_on(&map, 200));
        }
    }
}

#[test]
fn a_closed_space_is_not_come_into_and_says_so() {
    let site = TestSite::example("clinic").built();
    let way = || site.adit("route", &["dock", "ward 12", "--json"]).json();
    let before = way();
    site.adit("close", &["ward 12", "--why", "cleaning"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT closed FROM spaces WHERE name = 'ward 12'"), ["1"]);
    let none = site.adit("route", &["dock", "ward 12"]).expecting(1).stdout;
    assert!(none.contains("and ward 12, is closed"), "{none}");
    site.adit("open", &["ward 12"]).expect_status(0);
    assert_eq!(way()["waypoints"], before["waypoints"], "to the bit");
    assert_eq!(site.sqlite3("SELECT count(*) FROM doorways WHERE closed"), ["0"]);
}

#[test]
fn who_is_kept_out_is_said_for_as_long_as_each_says() {
    let site = TestSite::example("depot").built();
    let robots = site.sqlite3("SELECT DISTINCT robot FROM robots ORDER BY robot");
    let places = site.sqlite3("SELECT place FROM places ORDER BY place");
    let reached = |robot: &str, at: &str| {
        let ways = places[1..].iter().map(|goal| {
            let robot = format!("--robot={robot}");
            site.adit("route", &[&places[0], goal, &robot, "--at", at, "--json"]).json()["cost"].clone()
        });
        ways.collect::<Vec<_>>()
    };
    let open = robots.iter().map(|robot| reached(robot, "1h")).collect::<Vec<_>>();
    let space = site.sqlite3(&format!(
        "SELECT coalesce(s.name, 'space ' || s.space) FROM spaces s JOIN rooms r ON r.space = s.space
         JOIN places p ON p.x BETWEEN r.x0 AND r.x1 AND p.y BETWEEN r.y0 AND r.y1 AND p.place = '{}'",
        places[0]
    ));
    let (one, other) = (&robots[0], &robots[1]);
    site.adit("close", &[&space[0], "--only", one, "--until", "2h"]).expect_status(0);
    site.adit("close", &[&space[0], "--except", one, "--until", "4h"]).expect_status(0);
    let list = site.adit("tell", &["--list"]).expecting(0).stdout;
    assert!(list.contains("closed_to") && list.contains("open_to"), "{list}");
    assert_ne!(reached(one, "1h"), open[0]);
    assert_ne!(reached(other, "1h"), open[1]);
    assert_eq!(reached(one, "3h"), open[0]);
    assert_ne!(reached(other, "3h"), open[1]);
    site.adit("open", &[&space[0]]).expect_status(0);
    assert_eq!(robots.iter().map(|robot| reached(robot, "1h")).collect::<Vec<_>>(), open);
}

#[test]
fn who_closes_for_less_time_than_it_is_closed_already_is_told() {
    let site = starter();
    let close = |end: &[&str]| site.adit("close", &[&["doorway 1"], end].concat()).expecting(0);
    assert_eq!(close(&["--for", "2h"]).stderr, "");
    let shorter = close(&["--until", "1h"]).stderr;
    assert!(
        shorter.contains("doorway 1 stays closed after that: fact 1 keeps it closed until 2"),
        "{shorter}"
    );
    assert_eq!(close(&["--for", "3h"]).stderr, "");
    assert_eq!(close(&[]).stderr, "");
    let shorter = close(&["--for", "5h"]).stderr;
    assert!(
        shorter.contains("doorway 1 stays closed after that: fact 4 keeps it closed indefinitely"),
        "{shorter}"
    );
}

fn starter() -> TestSite {
    TestSite::example("starter").with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n").built()
}

#[test]
fn what_stands_against_a_closing_or_an_opening_is_said() {
    let site = starter();
    let is_open = || site.adit("route", &["home", "window"]).status == 0;
    site.adit("close", &["window"]).expect_status(0);
    site.adit("open", &["doorway 1"]).expect_status(0);
    site.adit("open", &["window"]).expect_status(0);
    let said = site.adit("close", &["window"]).expecting(0).stderr;
    assert!(is_open() && said.contains("doorway 1 was declared open and stays open"), "{said}");
    assert_eq!(site.adit("close", &["doorway 1"]).expecting(0).stderr, "");
    assert!(!is_open());
    assert_eq!(site.adit("open", &["doorway 1 "]).expecting(0).stderr, "");
    assert!(is_open());
    let only = site.adit("close", &["window", "--only", "robot"]).expecting(0).stderr;
    assert!(!is_open() && only.is_empty(), "{only}");
    site.adit("open", &["window"]).expect_status(0);
    site.adit("lay", &["area", "stairs", "5,2 7,6", "--kind", "keep-out"]).expect_status(0);
    let said = site.adit("open", &["stairs"]).expecting(0).stderr;
    assert!(said.contains("stairs stays shut all the same: ask why about \"room "), "{said}");
}

#[test]
fn a_one_way_area_that_is_closed_is_why_there_is_no_route() {
    for heading in ["heading=0", "heading=180"] {
        let site = starter();
        site.adit("lay", &["area", "ramp", "5,2 7,6", "--with", heading]).expect_status(0);
        site.adit("close", &["ramp"]).expect_status(0);
        for ends in [["home", "window"], ["window", "home"]] {
            let none = site.adit("route", &ends).expecting(1).stdout;
            let why = site.adit("why", &ends).expecting(0).stdout;
            for said in [none, why] {
                assert!(said.contains("is not entered (rule \"a closed area is not entered\")"), "{said}");
            }
        }
    }
}

#[test]
fn a_closed_area_is_not_entered() {
    let site = TestSite::example("starter");
    let text = "map = \"map.toml\"\nrobots = \"robots.toml\"\n[[area]]\nname = \"east\"\nrect = [6.5, 0.0, 12.0, 8.0]\n";
    site.write("site.toml", text);
    let site = site.built();
    site.adit("close", &["east", "--until", "2h"]).expect_status(0);
    site.adit("route", &["home", "11,2"]).expect_status(1);
    site.adit("route", &["home", "11,2", "--at", "3h"]).expect_status(0);
    site.adit("open", &["east"]).expect_status(0);
    site.adit("route", &["home", "11,2"]).expect_status(0);
}

#[test]
fn an_area_is_closed_to_one_robot_and_who_is_in_it_comes_out() {
    let site = TestSite::empty();
    site.write("map.toml", "width = 12.0\ndepth = 8.0\n[[place]]\nname = \"home\"\nat = [1.0, 4.0]\n");
    site.write("robots.toml", TWO_ROBOTS);
    let area = "[[area]]\nname = \"east\"\nrect = [6.5, 0.0, 12.0, 8.0]\n";
    site.write("site.toml", format!("map = \"map.toml\"\nrobots = \"robots.toml\"\n{area}"));
    let site = site.built();
    let said = site.adit("close", &["east", "--only", "cart"]).expecting(0).stdout;
    assert!(
        said.contains("the area `east` is closed to cart") && said.matches("`east`").count() == 1,
        "{said}"
    );
    let none = site.adit("route", &["home", "11,2", "--robot", "cart"]).expecting(1).stdout;
    assert!(none.contains("the area `east` is told to be closed to cart"), "{none}");
    site.adit("route", &["home", "11,2", "--robot", "walker"]).expect_status(0);
    site.adit("route", &["11,2", "home", "--robot", "cart"]).expect_status(0);
    site.adit("open", &["east"]).expect_status(0);
    site.adit("route", &["home", "11,2", "--robot", "cart"]).expect_status(0);
}

#[test]
fn what_is_closed_stays_closed_when_the_map_changes() {
    let site = starter();
    assert_eq!(site.sqlite3("SELECT count(*) FROM doorways"), ["1"]);
    site.adit("close", &["doorway 1"]).expect_status(0);
    site.edit("map.toml", "rect = [5.9, 0.0, 6.1, 3.0]", "rect = [5.8, 0.0, 6.2, 2.9]");
    site.adit("build", &[]).expect_status(0);
    site.adit("route", &["home", "window"]).expect_status(1);
    // where there is no doorway any more, its line is closed all the same
    site.edit("map.toml", "rect = [5.8, 0.0, 6.2, 2.9]", "rect = [5.8, 0.0, 6.2, 0.1]");
    site.adit("build", &[]).expect_status(0);
    let route = site.adit("route", &["home", "window", "--json"]).expecting(0).json();
    let points: Vec<Point> = route["waypoints"]
        .as_array()
        .unwrap()
        .iter()
        .map(|point| Point::new(point["x"].as_f64().unwrap(), point["y"].as_f64().unwrap()))
        .collect();
    let shut = told(&site);
    assert!(!points.windows(2).any(|leg| crosses(shut, leg[0], leg[1])), "{points:?} {shut:?}");
}

#[test]
fn what_cannot_be_closed_is_refused_with_what_was_meant() {
    let site = TestSite::example("clinic").built();
    for (what, said) in [
        ("triagge", "did you mean `triage`?"),
        ("doorway 9999", "nothing called `doorway 9999`"),
        ("-50,3@90", "is not on the floor"),
        ("10,8.5@north", "nothing called `10,8.5@north`"),
        ("31,20", "m away"),
    ] {
        site.adit("close", &[what]).expecting(2).complains(&[said]);
    }
    site.adit("close", &["ward 12", "--only", "porter"]).expecting(2).complains(&["no robot `porter`"]);
    site.adit("close", &["ward 12", "--only", "a", "--except", "b"])
        .expecting(2)
        .complains(&["cannot be used"]);
    site.adit("tell", &["SPACES", "ward 12", "open_to", " , "])
        .expecting(2)
        .complains(&["no robot is named"]);
    site.adit("close", &["ward 12", "--until", "2020-01-01"]).expecting(2).complains(&["that is over"]);
    site.adit("open", &["triagge"]).expecting(2).complains(&["did you mean `triage`?"]);
    assert!(site.sqlite3("SELECT * FROM told").is_empty());
}

/// Neither a metre of their ways nor the last digit of a number, from places or from anywhere.
#[test]
fn what_is_closed_to_one_robot_is_as_if_it_were_open_to_the_others() {
    let site = TestSite::example("depot").built();
    let routes = |robot: &str| {
        let ends = [["dock", "gate"], ["2.3,3.1", "gate"], ["shelf", "3.7,2.9"], ["charger", "dock"]];
        ends.map(|[start, goal]| {
            let asked = [start, goal, "--robot", robot, "--within", "0.8", "--json"];
            let mut answer: Value = serde_json::from_str(&site.adit("route", &asked).stdout).unwrap();
            answer["generation"] = Value::Null;
            answer
        })
    };
    let before = ["cart", "dog", "crawler"].map(routes);
    assert!(before.iter().flatten().filter(|answer| answer["status"] == "ok").count() > 8, "{before:#?}");
    for doorway in ["doorway 1", "doorway 2", "doorway 3"] {
        site.adit("close", &[doorway, "--only", "cart"]).expect_status(0);
        assert_eq!([routes("dog"), routes("crawler")], [before[1].clone(), before[2].clone()], "{doorway}");
    }
    assert_ne!(routes("cart"), before[0], "and the cart goes elsewhere, or nowhere");
}

#[test]
fn a_closing_for_another_robot_leaves_the_way_through_a_scanned_shop_as_it_is() {
    let Some(map) = shared("data/aws-robomaker/bookstore_map.yaml") else { return };
    let site = TestSite::empty();
    site.adit("new", &["--map", map.to_str().unwrap(), "--robot", "cart"]).expect_status(0);
    let site = site.built();
    let large = ["robots", "big/DRIVE", "--add", "action=DRIVE", "height=1", "width=1.2", "hardness=1"];
    site.adit("tune", &large).expect_status(0);
    let way = || {
        let asked = ["4.925,-2.825", "-5.525,5.225", "--robot", "robot", "--within", "0.8", "--json"];
        let mut answer: Value = serde_json::from_str(&site.adit("route", &asked).stdout).unwrap();
        answer["generation"] = Value::Null;
        answer
    };
    let before = way();
    site.adit("close", &["doorway 10", "--only", "big"]).expect_status(0);
    assert_eq!(way(), before);
    site.adit("close", &["doorway 10"]).expect_status(0);
    assert_ne!(way(), before, "the way led through it");
}
