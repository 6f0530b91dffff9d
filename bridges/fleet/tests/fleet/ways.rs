//! Routes as stops that a vehicle can drive to.

use adit_fleet::site::{Route, Waypoint};
use adit_fleet::way::{Body, Floor, Margins, Stop, distance, stops};

/// The stops of a way along these points, with so much room beside it.
fn along(points: &[[f64; 2]], room: f64) -> Vec<Stop> {
    let waypoint = |at: &[f64; 2]| Waypoint {
        x: at[0],
        y: at[1],
        state: Some("LOW".to_owned()),
        clearance: Some(room),
        ..Waypoint::default()
    };
    let route = Route {
        status: "ok".to_owned(),
        start: format!("{},{}", points[0][0], points[0][1]),
        goal: "gate".to_owned(),
        waypoints: points.iter().map(waypoint).collect(),
        ..Route::default()
    };
    let margins = Margins { before: 0.3, ahead: 3.0 };
    stops(&route, |_| Body { half: 0.3, speed: None }, &margins, Floor { bridges: &[], areas: &[] })
}

fn places(stops: &[Stop]) -> Vec<[f64; 2]> {
    stops.iter().map(|stop| stop.at).collect()
}

#[test]
fn there_are_no_edges_without_a_length() {
    for room in [0.0, 0.1] {
        let stops = along(&[[6.4, 1.0], [6.400_001, 1.0], [9.0, 4.0], [9.000_001, 4.0]], room);
        assert!(stops.windows(2).all(|pair| distance(pair[0].at, pair[1].at) > 0.01), "{stops:?}");
        assert_eq!(places(&stops), [[6.4, 1.0], [9.000_001, 4.0]]);
        assert_eq!(stops[1].id, "gate");
    }
}

#[test]
fn a_way_does_not_begin_with_a_step_to_and_fro() {
    let way = [[8.43, 6.35], [8.438, 6.366], [8.346, 6.317], [6.38, 3.79]];
    let stops = along(&way, 0.05);
    assert_eq!(places(&stops), [way[0], way[2], way[3]]);
    let room = stops[1].clearance.unwrap();
    assert!((room - (0.05 - distance(way[0], way[1]))).abs() < 1e-9, "{room}: the way is moved by the step");
    // there is no room to go straight by
    assert_eq!(places(&along(&way, 0.01)), way);
}

#[test]
fn a_way_of_a_centimetre_still_leads_to_its_goal() {
    let stops = along(&[[1.0, 1.0], [1.01, 1.0]], 0.5);
    assert_eq!((stops.len(), stops[1].id.as_str()), (2, "gate"));
}
