//! Missions along ways that somebody else finds: shapes are changed where they say so, and closed ways are told.

use std::collections::BTreeMap;

use adit_planners::floor_plan::{Disc, Network};
use adit_planners::geometry::{Point, Rect, Segment, polygon};
use adit_planners::navigation::{Building, Drivable, Ending, Met, Mission, Outcome, Outfit, Router, Stretch};
use adit_planners::rim::Rim;
use adit_planners::simulator::{Shape, Shapes};

use super::scene::{exact, mission, stands};
use super::table::Table;

/// A corridor of 10 x 3 m with a pipe across it from 4 to 5: upright the robot does not fit beneath it, on its knees it does.
struct Corridor {
    walls: Vec<Segment>,
    shapes: Shapes,
    buildings: Vec<Building>,
}

const UPRIGHT: usize = 0;
const KNEELING: usize = 1;

impl Corridor {
    fn new() -> Self {
        let (hall, pipe) = (Rect::new(0.0, 0.0, 10.0, 3.0), Rect::new(4.0, 0.0, 5.0, 3.0));
        let walls = polygon::sides_of_rect(&hall).to_vec();
        let shape =
            |radius, speed, overhead| Shape { rim: Rim::disc(radius), greatest_speed_m_s: speed, overhead };
        let shapes = vec![shape(0.3, 0.8, vec![pipe]), shape(0.4, 0.25, Vec::new())];
        let building = |(number, shape): (usize, &Shape)| {
            let network = Network::none(Disc { radius: shape.rim.radius_m(), margin: 0.0 });
            let overhead = shape.overhead.iter().flat_map(polygon::sides_of_rect).collect();
            Building { overhead, ..Building::of_walls(network, walls.clone()) }
                .in_stance(number, &shape.rim, None)
        };
        let buildings = shapes.iter().enumerate().map(building).collect();
        let seconds = BTreeMap::from([((UPRIGHT, KNEELING), 2.5), ((KNEELING, UPRIGHT), 3.5)]);
        Self { walls, shapes: Shapes { all: shapes, seconds }, buildings }
    }

    fn run(&self, mission: &Mission, router: &mut impl Router) -> Outcome {
        let on = Drivable {
            walls: &self.walls,
            shapes: Some(&self.shapes),
            stance: UPRIGHT,
            buildings: &self.buildings,
        };
        let mut outfit: Outfit = exact();
        outfit.robot.radius_m = self.shapes.all[UPRIGHT].rim.radius_m();
        outfit.navigation.speed_m_s = 0.8;
        mission.run(&on, &outfit, Some(router), &mut Table, |_| {}, None).unwrap()
    }
}

/// Says the same of every question, from where the robot is.
struct Says<F>(F, Vec<Vec<Met>>);

impl<F: FnMut([Point; 2], usize, &[Met]) -> Option<Vec<Stretch>>> Router for Says<F> {
    fn way(&mut self, ends: [Point; 2], stance: usize, met: &[Met]) -> Option<Vec<Stretch>> {
        self.1.push(met.to_vec());
        (self.0)(ends, stance, met)
    }
}

fn stretch(stance: usize, points: &[[f64; 2]]) -> Stretch {
    Stretch { stance, points: points.iter().map(|at| Point::new(at[0], at[1])).collect() }
}

fn beneath(from: Point) -> Vec<Stretch> {
    vec![
        stretch(UPRIGHT, &[[from.x, from.y], [3.65, 1.5]]),
        stretch(KNEELING, &[[3.65, 1.5], [5.35, 1.5]]),
        stretch(UPRIGHT, &[[5.35, 1.5], [9.0, 1.5]]),
    ]
}

#[test]
fn the_robot_goes_on_its_knees_beneath_a_pipe_and_gets_up_behind_it() {
    let corridor = Corridor::new();
    let went = corridor.run(
        &mission([1.0, 1.5], [9.0, 1.5], Vec::new()),
        &mut Says(|[from, _]: [Point; 2], _, _: &[Met]| Some(beneath(from)), Vec::new()),
    );
    assert_eq!(went.trip.ending, Ending::Arrived, "{went:?}");
    assert_eq!(went.trip.changes, [(UPRIGHT, KNEELING), (KNEELING, UPRIGHT)]);
    assert!(went.overlap_m < 0.0 && went.trip.touches == 0, "{went:?}");
    let kneeling = |shape: &(Point, usize)| shape.1 == KNEELING;
    assert!(
        went.trip.track.iter().filter(|at| (3.7..5.3).contains(&at.0.x)).all(kneeling),
        "{:?}",
        went.trip.track
    );
    assert!((1.7..2.2).contains(&went.trip.metres[KNEELING]), "{:?}", went.trip.metres);
    // eight metres, two changes of shape, and looks around
    assert!(went.trip.seconds > 6.0 + 1.7 / 0.25 + 6.3 / 0.8, "{}", went.trip.seconds);
}

/// What judges missions can fail: who stays upright touches the pipe, and who gets up beneath it has it in its head.
#[test]
fn who_stays_upright_does_not_get_through_and_who_gets_up_too_early_is_seen_to() {
    let corridor = Corridor::new();
    let there = mission([1.0, 1.5], [9.0, 1.5], Vec::new());
    let upright =
        |[from, _]: [Point; 2], _, _: &[Met]| Some(vec![stretch(UPRIGHT, &[[from.x, from.y], [9.0, 1.5]])]);
    let went = corridor.run(&there, &mut Says(upright, Vec::new()));
    assert_eq!(went.trip.ending, Ending::NoWay);
    assert!(went.trip.track.iter().all(|at| at.0.x < 3.71) && went.overlap_m < 1e-6, "{went:?}");

    let mut blind = Corridor::new();
    blind.buildings[UPRIGHT].overhead.clear();
    let early = |[from, _]: [Point; 2], shape, _: &[Met]| {
        let here = [from.x, from.y];
        Some(match shape {
            UPRIGHT if from.x < 4.0 => vec![
                stretch(UPRIGHT, &[here, [3.2, 1.5]]),
                stretch(KNEELING, &[[3.2, 1.5], [4.5, 1.5]]),
                stretch(UPRIGHT, &[[4.5, 1.5], [9.0, 1.5]]),
            ],
            _ => vec![stretch(shape, &[here, [9.0, 1.5]])],
        })
    };
    assert!(blind.run(&there, &mut Says(early, Vec::new())).overlap_m > 0.3);
}

#[test]
fn where_a_box_shuts_the_corridor_it_says_what_it_saw_and_once_it_has_begun_anew_nothing_of_it() {
    let corridor = Corridor::new();
    let shut = mission([1.0, 1.5], [3.0, 1.5], vec![stands(2.2, 1.5, 0.3, 2.9)]);
    let mut router = Says(
        |[from, _]: [Point; 2], _, met: &[Met]| {
            met.is_empty().then(|| vec![stretch(UPRIGHT, &[[from.x, from.y], [3.0, 1.5]])])
        },
        Vec::new(),
    );
    let went = corridor.run(&shut, &mut router);
    assert_eq!((went.trip.ending, went.trip.touches), (Ending::NoWay, 0), "{went:?}");
    let met: Vec<&Met> = router.1.iter().flatten().collect();
    assert!(!met.is_empty() && met.iter().all(|met| (met.at.x - 2.05).abs() < 0.1), "{met:?}");
    let saw = |met: &&Met| {
        met.seen.iter().any(|surface| surface.length() > 1.0 && (surface.a.x - 2.05).abs() < 0.1)
    };
    assert!(met.iter().all(saw), "{met:?}");
    assert!(met.iter().all(|met| met.heading.abs() < 0.5), "{met:?}");
    assert!(router.1.iter().filter(|met| met.is_empty()).count() > 1, "it began anew");
    let given = router.1.iter().filter(|met| met.is_empty()).count();
    assert_eq!(went.trip.replans as usize, given, "each way that it was given was shut");
}

/// Nothing stands where nobody may go, and yet detours keep to the other side.
#[test]
fn a_detour_does_not_lead_over_what_is_closed() {
    let there = mission([1.0, 1.5], [3.5, 1.5], vec![stands(2.2, 1.5, 0.3, 0.3)]);
    let straight =
        |[from, _]: [Point; 2], _, _: &[Met]| Some(vec![stretch(UPRIGHT, &[[from.x, from.y], [3.5, 1.5]])]);
    for (from, to, is_below) in [(1.7, 2.9, true), (0.1, 1.3, false)] {
        let mut corridor = Corridor::new();
        let line = Segment::new(Point::new(2.2, from), Point::new(2.2, to));
        corridor.buildings.iter_mut().for_each(|building| building.closed.push(line));
        let went = corridor.run(&there, &mut Says(straight, Vec::new()));
        assert_eq!((went.trip.ending, went.trip.touches), (Ending::Arrived, 0), "{went:?}");
        let beside = went.trip.track.iter().filter(|at| (2.0..2.4).contains(&at.0.x));
        assert!(
            beside.clone().count() > 0 && beside.clone().all(|at| (at.0.y < 1.5) == is_below),
            "{went:?}"
        );
    }
}

/// The way past a box that the robot has met leads it into another shape, for which the box leaves no room.
#[test]
fn it_does_not_change_its_shape_where_something_that_it_met_leaves_no_room() {
    let corridor = Corridor::new();
    let beside = mission([1.0, 1.5], [3.4, 1.5], vec![stands(2.5, 0.95, 0.5, 0.3)]);
    let way = |[from, _]: [Point; 2], shape, met: &[Met]| {
        let here = [from.x, from.y];
        let at = if met.is_empty() { 1.42 } else { 2.0 };
        let kneels = [stretch(UPRIGHT, &[here, [2.5, at]]), stretch(KNEELING, &[[2.5, at], [3.4, 1.5]])];
        Some(if shape == UPRIGHT { kneels.to_vec() } else { vec![stretch(KNEELING, &[here, [3.4, 1.5]])] })
    };
    let mut router = Says(way, Vec::new());
    let went = corridor.run(&beside, &mut router);
    assert_eq!(went.trip.ending, Ending::Arrived, "{went:?}");
    assert!(went.overlap_m < 0.0 && went.trip.changes == [(UPRIGHT, KNEELING)], "{went:?}");
    assert!(router.1.iter().any(|met| !met.is_empty()), "it was closed once");
}
