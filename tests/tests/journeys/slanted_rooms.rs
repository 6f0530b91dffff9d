//! Rooms that are no rectangles, from a planner's facts to routes, pictures, the service and what is told.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit::edit::Edit;
use adit::{KnowledgeBase, Silent, Tell};
use adit_db::history::Author;
use adit_planners::facts::{Column, Facts};
use adit_planners::geometry::Point;
use adit_planners::planner::{Planner, PlannerError, Signature};
use adit_planners::world::World;
use adit_tests::TestSite;
use adit_tests::service::Service;
use adit_tests::slanted::SlantedRooms;
use serde_json::Value;

const MAP: &str = "width = 12.0\ndepth = 8.0\n\
                   [[bridge]]\nrect = [10.5, 0.0, 12.0, 1.8]\nheight = 1.3\n\
                   [[place]]\nname = \"home\"\nat = [1.0, 1.0]\n[[place]]\nname = \"window\"\nat = [11.0, 7.0]\n\
                   [[place]]\nname = \"corner\"\nat = [11.0, 1.0]\n";

const ROBOTS: &str = "[[robots]]\nstate = \"STAND\"\naction = \"WALK\"\nheight = 1.7\nwidth = 0.6\nhardness = 1.0\n\
                      [[robots]]\nstate = \"SQUAT\"\naction = \"WALK-ON-KNEE\"\nheight = 1.1\nwidth = 0.8\nhardness = 3.0\n\
                      [[changes]]\nfrom_state = \"STAND\"\nto_state = \"SQUAT\"\nhardness = 0.5\n";

fn opened(site: &TestSite) -> KnowledgeBase {
    let mut knowledge = KnowledgeBase::open(site.path()).unwrap();
    knowledge.register(Box::new(SlantedRooms));
    knowledge
}

fn build(site: &TestSite) {
    opened(site).build(&Silent).unwrap();
}

fn site() -> TestSite {
    let site = TestSite::empty()
        .with("map.toml", MAP)
        .with("robots.toml", ROBOTS)
        .with("site.toml", "name = \"slanted\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\n");
    build(&site);
    site
}

/// The rooms that hold a point and are no rectangles, by SQL and by geometry of its own.
fn slanted_at(site: &TestSite, p: Point) -> Vec<String> {
    let rows = site.sqlite3("SELECT name, x0, y0, x1, y1, outline FROM rooms WHERE outline IS NOT NULL");
    assert!(rows.len() >= 4, "{rows:?}");
    let holds = |row: &String| {
        let cells: Vec<&str> = row.split('|').collect();
        let corners: Vec<[f64; 2]> = serde_json::from_str(cells[5]).unwrap();
        let left = |at: usize| {
            let ([ax, ay], [bx, by]) = (corners[at], corners[(at + 1) % corners.len()]);
            (bx - ax) * (p.y - ay) - (by - ay) * (p.x - ax)
        };
        (0..corners.len()).all(|at| left(at) > 0.0).then(|| cells[0].to_owned())
    };
    rows.iter().filter_map(holds).collect()
}

fn steps(site: &TestSite, start: &str, goal: &str) -> (f64, Vec<(String, String, Point)>) {
    let answer = site.adit("route", &[start, goal, "--json"]).expecting(0).json();
    let step = |step: &Value| {
        let at = Point::new(step["x"].as_f64().unwrap(), step["y"].as_f64().unwrap());
        (step["kind"].as_str().unwrap().to_owned(), step["place"].as_str().unwrap().to_owned(), at)
    };
    (answer["cost"].as_f64().unwrap(), answer["steps"].as_array().unwrap().iter().map(step).collect())
}

#[test]
fn sql_says_the_outline_of_a_room_that_is_no_rectangle_and_nothing_of_others() {
    let site = site();
    assert_eq!(site.sqlite3("SELECT state FROM rooms WHERE outline IS NULL"), ["SQUAT"]);
    let edges = "SELECT count(*) FROM rooms, json_each(outline) AS corner
                 WHERE corner.value ->> 0 NOT BETWEEN x0 AND x1 OR corner.value ->> 1 NOT BETWEEN y0 AND y1";
    assert_eq!(site.sqlite3(edges), ["0"]);
    let triangle = "SELECT round(corner.value ->> 0, 6), round(corner.value ->> 1, 6)
                    FROM rooms, json_each(outline) AS corner WHERE x0 = 0 AND y0 = 0 AND state = 'STAND'";
    assert_eq!(site.sqlite3(triangle), ["0.0|0.0", "6.6|0.0", "0.0|6.6"]);
}

#[test]
fn a_straight_route_crosses_slanted_doors_at_their_lines() {
    let site = site();
    let (cost, steps) = steps(&site, "home", "window");
    let straight = Point::new(1.0, 1.0).distance(Point::new(11.0, 7.0));
    assert!((cost - straight).abs() < 1e-9, "{cost} for {straight} m");
    let doors: Vec<_> = steps.iter().filter(|(kind, ..)| kind == "door").collect();
    assert!(doors.len() >= 2, "{steps:?}");
    for (_, number, at) in doors {
        let row = &site.sqlite3(&format!("SELECT x0, y0, x1, y1 FROM doors WHERE door = {number}"))[0];
        let ends: Vec<f64> = row.split('|').map(|cell| cell.parse().unwrap()).collect();
        let (a, b) = (Point::new(ends[0], ends[1]), Point::new(ends[2], ends[3]));
        assert!((a.x - b.x).abs() > 0.1 && (a.y - b.y).abs() > 0.1, "door {number} is slanted: {row}");
        assert!(at.nearest_on(a, b).distance(*at) < 1e-6, "{at:?} lies on door {number}: {row}");
    }
}

#[test]
fn a_shape_is_changed_on_a_slanted_boundary_where_that_costs_least() {
    let site = site();
    let (cost, steps) = steps(&site, "home", "corner");
    assert_eq!(steps.iter().filter(|(kind, ..)| kind == "change").count(), 1, "{steps:?}");
    // in the lower right only SQUAT has a room, at thrice the price: beyond a line up to the bend, or one down from it
    let (home, corner) = (Point::new(1.0, 1.0), Point::new(11.0, 1.0));
    let (low, bend, high) = (Point::new(6.1, 0.5), Point::new(9.8, 4.2), Point::new(12.0, 2.0));
    let by = |share: f64| {
        let (one, two) = (low.lerp(bend, share), bend.lerp(high, share));
        let there = home.distance(one) + 3.0 * one.distance(corner);
        let around = home.distance(bend) + bend.distance(two) + 3.0 * two.distance(corner);
        0.5 + there.min(around)
    };
    let best = (0..=1_000_000).map(|at| by(f64::from(at) / 1e6)).fold(f64::INFINITY, f64::min);
    assert!((cost - best).abs() < 1e-6 * best, "{cost}, and the best is {best}");
}

#[test]
fn a_point_in_the_box_about_a_triangle_and_outside_of_it_is_not_in_the_triangle() {
    let site = site();
    let p = Point::new(5.0, 5.0);
    let about = "SELECT name FROM rooms WHERE x0 = 0 AND y0 = 0 AND outline IS NOT NULL
                 AND 5.0 BETWEEN x0 AND x1 AND 5.0 BETWEEN y0 AND y1";
    let triangle = site.sqlite3(about);
    assert_eq!(triangle.len(), 1);
    let (_, steps) = steps(&site, "5.0,5.0", "window");
    assert_ne!(steps[0].1, triangle[0]);
    assert_eq!(slanted_at(&site, p), [steps[0].1.clone()]);
}

#[test]
fn what_is_told_of_a_point_is_about_the_room_whose_outline_holds_it_whatever_its_number() {
    let site = site();
    let author = Author { who: "test".to_owned(), why: String::new() };
    let told = Tell {
        class: "ROOMS".to_owned(),
        object: "9.5,4".to_owned(),
        property: "hardness".to_owned(),
        value: "7".to_owned(),
        until: None,
        new_property: false,
    };
    opened(&site).edit(&Edit::Tell(told), &author, false, &Silent).unwrap();
    let hard = || site.sqlite3("SELECT name FROM rooms WHERE hardness = 7 AND outline IS NOT NULL");
    let before = hard();
    assert_eq!(before, slanted_at(&site, Point::new(9.5, 4.0)));
    let boxes = "SELECT count(*) FROM rooms WHERE outline IS NOT NULL AND 9.5 BETWEEN x0 AND x1 AND 4 BETWEEN y0 AND y1";
    assert_eq!(site.sqlite3(boxes), ["2"], "boxes alone would not tell");
    site.edit("map.toml", "width = 12.0", "width = 12.5");
    build(&site);
    assert_ne!(hard(), before, "rooms are numbered otherwise");
    assert_eq!(hard(), slanted_at(&site, Point::new(9.5, 4.0)));
    opened(&site).edit(&Edit::Retract(1), &author, false, &Silent).unwrap();
    assert_eq!(hard(), [""; 0]);
}

#[test]
fn a_slanted_door_that_is_told_shut_is_shut_for_all_states_and_found_again() {
    let site = site();
    let before = steps(&site, "home", "window").0;
    let number = "SELECT door FROM doors WHERE kind = 'door' ORDER BY y LIMIT 1";
    site.adit("tell", &["DOORS", "3.3,3.3", "passable", "false"]).expect_status(0);
    let shut = "SELECT count(*), min(x0 + y0), max(x1 + y1) FROM doors WHERE passable = 0 AND kind = 'door'";
    assert_eq!(site.sqlite3(shut), ["1|6.6|6.6"], "{:?}", site.sqlite3(number));
    let after = steps(&site, "home", "window").0;
    assert!(after > before + 0.1, "{before} before, {after} after");
    site.edit("map.toml", "width = 12.0", "width = 12.5");
    build(&site);
    assert_eq!(site.sqlite3(shut), ["1|6.6|6.6"]);
}

#[test]
fn the_stock_program_tunes_and_takes_back_on_the_rooms_that_are_there() {
    let site = site();
    let rows = || site.sqlite3("SELECT * FROM rooms ORDER BY room");
    let (before, cost) = (rows(), steps(&site, "home", "window").0);
    site.adit("tune", &["robots", "STAND", "hardness", "1.5"]).expect_status(0);
    assert!((steps(&site, "home", "window").0 - 1.5 * cost).abs() < 1e-9);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(rows(), before);
}

#[test]
fn a_picture_has_polygons_and_the_map_of_the_service_outlines() {
    let site = site();
    let picture = site.path().join("floor.svg");
    site.adit("draw", &["-o", picture.to_str().unwrap(), "--state", "STAND", "--route", "home", "window"])
        .expect_status(0);
    let text = std::fs::read_to_string(&picture).unwrap();
    let png = site.path().join("floor.png");
    site.adit("draw", &["-o", png.to_str().unwrap(), "--state", "STAND"]).expect_status(0);
    // the triangle's corners, in the order of its outline: right, up to the left, and back
    let service = Service::start(&site);
    let (status, map) = service.ask("GET", "/api/map", None);
    assert_eq!(status, 200);
    let rooms = map["rooms"].as_array().unwrap();
    let rect = rooms.iter().filter(|room| room.get("outline").is_none()).count();
    assert_eq!(rect, 1);
    let bits = |value: &Value| -> Vec<u64> {
        value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap().to_bits()).collect()
    };
    for room in rooms.iter().filter(|room| room.get("outline").is_some()) {
        let row = format!("SELECT outline FROM rooms WHERE room = {}", room["room"]);
        let written: Value = serde_json::from_str(&site.sqlite3(&row)[0]).unwrap();
        let flat: Vec<Value> =
            written.as_array().unwrap().iter().flat_map(|c| c.as_array().unwrap().clone()).collect();
        assert_eq!(bits(&room["outline"]), bits(&Value::Array(flat)));
    }
    assert!(text.contains("<path"), "{text}");
    assert_eq!(rooms_drawn(&text), 4);
}

/// How many polygons there are that have a slanted side, of those that rooms are filled with.
fn rooms_drawn(svg: &str) -> usize {
    let filled = svg.split("<path").filter(|path| path.contains("fill-opacity=\"0.11\""));
    let shapes =
        filled.flat_map(|path| path.split(" d=\"").nth(1).unwrap().split('"').next().unwrap().split('z'));
    shapes.filter(|shape| !shape.is_empty() && !shape.contains(['h', 'v', 'H', 'V'])).count()
}

#[test]
fn an_outline_that_somebody_spoilt_is_made_again_by_the_next_build() {
    let site = site();
    let outlines = || site.sqlite3("SELECT room, outline FROM rooms ORDER BY room");
    let before = outlines();
    site.outside_edit("UPDATE rooms SET outline = '[[0,0],[9,0],[1,1]]' WHERE room = 1");
    opened(&site).route("home", "window", None).unwrap();
    build(&site);
    assert_eq!(outlines(), before);
}

/// The same rooms, and a door into one that there is not.
struct DoorIntoNothing;

impl Planner for DoorIntoNothing {
    fn name(&self) -> &'static str {
        "doors into nothing"
    }

    fn signature(&self) -> Signature {
        SlantedRooms.signature()
    }

    fn facts(&self, world: &World, known: &Facts) -> Result<Facts, PlannerError> {
        let mut facts = SlantedRooms.facts(world, known)?;
        let rooms = facts["ROOMS"].len() as f64;
        let doors = facts.get_mut("DOORS").unwrap();
        for (property, column) in &mut doors.columns {
            if let (Column::Number(numbers), "room2") = (column, property.as_str()) {
                numbers[0] = Some(rooms + 1_000.0);
            }
        }
        Ok(facts)
    }
}

#[test]
fn a_door_into_a_room_that_is_not_there_is_refused_and_nothing_is_kept() {
    let site = site();
    let before = site.sqlite3("SELECT count(*) FROM doors");
    site.write("map.toml", MAP.replace("depth = 8.0", "depth = 8.5"));
    let mut knowledge = KnowledgeBase::open(site.path()).unwrap();
    knowledge.register(Box::new(DoorIntoNothing));
    let refused = knowledge.build(&Silent).unwrap_err().to_string();
    assert!(refused.contains("class DOORS: an object leads to a room that is not there"), "{refused}");
    assert_eq!(site.sqlite3("SELECT count(*) FROM doors"), before);
}
