//! What is wrong with a floor plan is said with its place, what was found and what is expected.

use adit_planners::floor_plan::{Disc, Drawn, FloorPlan, Network, parse_floor_plan};
use adit_planners::geometry::Point;
use adit_planners::read::{Code, MapErrors};
use miette::Diagnostic;

use super::regions::golden;

const ROOM: &str = "[[0,0],[4,0]], [[4,0],[4,3]], [[4,3],[0,3]], [[0,3],[0,0]]";

fn plan(walls: &str, further: &str) -> Result<FloorPlan, MapErrors> {
    parse_floor_plan("plan.json", &format!("{{\n\"walls\": [\n{walls}\n]{further}}}"))
}

/// The only problem: its code, its message, and the text that it points to.
fn only(walls: &str, further: &str) -> (Code, String, String) {
    let text = format!("{{\n\"walls\": [\n{walls}\n]{further}}}");
    let errors = parse_floor_plan("plan.json", &text).unwrap_err();
    let [problem] = &errors.problems[..] else { panic!("{errors:?}") };
    let label = problem.labels().and_then(|mut labels| labels.next());
    let place = label.map_or("", |label| &text[label.offset()..label.offset() + label.len()]);
    (problem.code, problem.message.clone(), place.to_owned())
}

#[test]
fn a_room_with_a_pillar_and_a_place_is_read() {
    let solids = r#", "units": "m", "solids": [[[1,1],[1.5,1],[1.5,1.5]]], "places": [{"name": "desk", "at": [3, 2]}]"#;
    let plan = plan(ROOM, solids).unwrap();
    assert!((plan.free_area() - (12.0 - 0.125)).abs() < 1e-12);
    assert_eq!(plan.places()[0].at, Point::new(3.0, 2.0));
}

#[test]
fn pillars_may_stand_against_walls_in_corners_and_across_walls() {
    for (pillar, area) in [
        ("[1,0],[2,0],[2,1],[1,1]", 11.0),
        ("[0,0],[1,0],[1,1],[0,1]", 11.0),
        ("[3,1],[5,1],[5,2],[3,2]", 11.0),
        ("[-1,-1],[5,-1],[5,1],[-1,1]", 8.0),
    ] {
        let plan = plan(ROOM, &format!(", \"solids\": [[{pillar}]]")).unwrap();
        assert!((plan.free_area() - area).abs() < 1e-9, "{pillar}: {}", plan.free_area());
    }
}

#[test]
fn crossing_walls_are_refused_with_both_and_the_point() {
    let (code, message, place) = only(&format!("{ROOM}, [[1,0],[3,2]], [[1,2],[3,0]]"), "");
    assert_eq!(code, Code::CrossingWalls);
    assert_eq!(message, "the wall from (1, 2) to (3, 0) crosses the wall from (1, 0) to (3, 2) at (2, 1)");
    assert!(place.starts_with('['), "{place}");
}

#[test]
fn a_wall_on_a_wall_is_refused() {
    let (code, message, _) = only(&format!("{ROOM}, [[1,0],[3,0]]"), "");
    assert_eq!(code, Code::CrossingWalls);
    assert_eq!(message, "the wall from (1, 0) to (3, 0) lies on the wall from (0, 0) to (4, 0)");
}

#[test]
fn an_open_outline_is_refused() {
    let (code, message, _) = only("[[0,0],[4,0]], [[4,0],[4,3]], [[4,3],[0,3]], [[0,3],[0,0.5]]", "");
    assert_eq!(code, Code::OpenOutline);
    assert_eq!(message, "none of the 4 walls bound free space: no outline is closed");
    let (code, message, _) = only(&format!("{ROOM}, [[4,3],[8,3]]"), "");
    assert_eq!(code, Code::OpenOutline);
    assert_eq!(
        message,
        "no free space lies beside the wall from (4, 3) to (8, 3): its outline is open; it ends at nothing at (8, 3)"
    );
}

#[test]
fn no_walls_at_all_are_an_open_outline() {
    assert_eq!(plan("", "").unwrap_err().problems[0].code, Code::OpenOutline);
}

#[test]
fn places_in_walls_in_solids_and_outside_are_refused() {
    let at = |x: f64, y: f64| {
        format!(
            r#", "solids": [[[1,1],[2,1],[2,2],[1,2]]], "places": [{{"name": "desk", "at": [{x}, {y}]}}]"#
        )
    };
    let (code, message, _) = only(ROOM, &at(4.0, 1.0));
    assert_eq!(code, Code::PlaceInWall);
    assert_eq!(message, "the place `desk` at (4, 1) lies on the wall from (4, 0) to (4, 3)");
    let (code, message, _) = only(ROOM, &at(1.5, 1.5));
    assert_eq!(code, Code::PlaceInWall);
    assert_eq!(message, "the place `desk` at (1.5, 1.5) lies in something solid");
    let (code, message, _) = only(ROOM, &at(5.0, 1.0));
    assert_eq!(code, Code::PlaceOutside);
    assert_eq!(message, "the place `desk` at (5, 1) lies outside of every closed outline");
}

#[test]
fn what_is_no_number_is_refused_where_it_stands() {
    for wrong in ["NaN", "\"four\"", "null", "[]", "1e400"] {
        let (code, message, place) = only(&format!("[[0,0],[{wrong},0]]"), "");
        assert_eq!(code, Code::Syntax, "{message}");
        assert!(wrong.contains(place.trim_matches('"')) && !place.is_empty(), "{wrong} {place} {message}");
    }
    for (wrong, told) in [(".nan", "NaN"), (".inf", "inf"), ("-2e9", "-2000000000")] {
        let (code, message, _) = only(&format!("{ROOM}, [[1,1],[{wrong},1]]"), "");
        assert_eq!(code, Code::NotFinite);
        assert_eq!(message, format!("a wall has the coordinate {told}; finite numbers up to 1e6 are read"));
    }
}

#[test]
fn walls_without_length_bad_solids_and_names_are_refused() {
    assert_eq!(only(&format!("{ROOM}, [[1,1],[1,1]]"), "").0, Code::Degenerate);
    assert_eq!(only(ROOM, ", \"solids\": [[[1,1],[2,1]]]").0, Code::FewCorners);
    assert_eq!(only(ROOM, ", \"solids\": [[[1,1],[2,2],[2,1],[1,2]]]").0, Code::SelfCrossing);
    let twice = r#", "places": [{"name": "a", "at": [1,1]}, {"name": "a", "at": [2,2]}]"#;
    assert_eq!(only(ROOM, twice).0, Code::DuplicatePlace);
    assert_eq!(only(ROOM, r#", "places": [{"name": " ", "at": [1,1]}]"#).0, Code::EmptyName);
}

#[test]
fn misspelt_and_missing_keys_are_told_and_keys_of_others_left_alone() {
    let (code, message, place) = only(ROOM, r#", "place": []"#);
    assert_eq!((code, place.as_str()), (Code::UnknownKey, "\"place\""));
    assert_eq!(message, "`place` is not a key of a floor plan");
    assert!(plan(ROOM, r#", "pairs": [1, {"a": 2}]"#).is_ok());
    let errors = parse_floor_plan("plan.json", r#"{"places": []}"#).unwrap_err();
    assert_eq!(errors.problems[0].code, Code::MissingKey);
    assert_eq!(errors.problems[0].message, "a floor plan needs `walls` here");
    assert_eq!(only(ROOM, r#", "units": "ft""#).1, "`units` is `ft`, and floor plans are in `m`");
}

#[test]
fn a_robot_wider_than_every_doorway_is_refused_with_the_widest() {
    let plan = golden("house-7.json");
    let errors = Network::new(&plan, Disc { radius: 0.6, margin: 0.05 }).unwrap_err();
    assert_eq!(errors.problems[0].code, Code::RobotTooWide);
    assert_eq!(
        errors.problems[0].message,
        "the robot is too wide for every doorway: it needs more than 1.3 m (1.2 m and a margin of 0.05 m on either \
         side), and the widest has 1.2 m"
    );
    assert!(Network::new(&plan, Disc { radius: 0.55, margin: 0.0 }).is_ok());
}

#[test]
fn a_doorway_that_is_too_narrow_has_no_adits() {
    let plan = golden("house-7.json");
    let network = Network::new(&plan, Disc { radius: 0.46, margin: 0.0 }).unwrap();
    for (index, doorway) in network.regions.doorways.iter().enumerate() {
        let adits = network.adits.iter().filter(|adit| adit.doorway == index).count();
        assert_eq!(adits, if doorway.width() > 0.93 { 2 } else { 0 }, "{doorway:?}");
    }
}

#[test]
fn a_disc_that_is_none_is_refused() {
    let plan = golden("house-7.json");
    for (radius, margin) in [(0.0, 0.1), (-1.0, 0.1), (f64::NAN, 0.1), (0.2, -0.1), (0.2, f64::INFINITY)] {
        let errors = Network::new(&plan, Disc { radius, margin }).unwrap_err();
        assert_eq!(errors.problems[0].code, Code::NotPositive);
    }
}

#[test]
fn a_place_too_near_a_wall_for_the_robot_is_noted() {
    let plan = plan(ROOM, r#", "places": [{"name": "corner", "at": [0.1, 1]}]"#).unwrap();
    let network = Network::new(&plan, Disc { radius: 0.2, margin: 0.0 }).unwrap();
    assert_eq!(
        network.notes[0].message,
        "the place `corner` is 0.100 m from a wall, and the robot needs 0.2 m: it cannot go there"
    );
}

#[test]
fn drawings_are_checked_as_files_are() {
    let p = Point::new;
    let drawn = Drawn { walls: vec![[p(0.0, 0.0), p(1.0, 0.0)]], ..Drawn::default() };
    assert_eq!(FloorPlan::new(drawn).unwrap_err().problems[0].code, Code::OpenOutline);
}
