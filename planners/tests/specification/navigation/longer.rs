//! Missions of a body that is longer than wide: it keeps its facing, goes any way in it, and turns where the way says so.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use adit_planners::floor_plan::{Disc, Network};
use adit_planners::geometry::{Point, Rect, Segment, polygon};
use adit_planners::navigation::{
    Building, Drivable, Ending, Entry, Met, Mission, Outcome, Outfit, Router, Stretch,
};
use adit_planners::pose::Pose;
use adit_planners::rim::Rim;
use adit_planners::simulator::{Obstacle, Settings, Shape, Shapes};

use super::table::Table;

/// Degrees from one facing to the next.
const STEP: f64 = 22.5;

/// A hall of 9 x 6 m, parted by a wall at x = 4 with a gap of 0.4 m about y = 1.5, through which the body comes lengthwise.
fn walls() -> Vec<Segment> {
    let wall = |x0: f64, y0: f64, x1: f64, y1: f64| Segment::new(Point::new(x0, y0), Point::new(x1, y1));
    let hall = polygon::sides_of_rect(&Rect::new(0.0, 0.0, 9.0, 6.0));
    hall.into_iter().chain([wall(4.0, 0.0, 4.0, 1.3), wall(4.0, 1.7, 4.0, 6.0)]).collect()
}

/// Says the same way whenever it is asked, from the stretch on that the robot's stance is of.
struct Says(Vec<Stretch>);

impl Router for Says {
    fn way(&mut self, [from, _]: [Point; 2], stance: usize, _: &[Met]) -> Option<Vec<Stretch>> {
        let at = self.0.iter().position(|stretch| stretch.stance == stance)?;
        let mut way = self.0[at..].to_vec();
        way[0].points[0] = from;
        Some(way)
    }
}

/// Of 0.8 x 0.3 m, at eight facings.
fn run(robot: Settings, seed: u64, obstacles: Vec<Obstacle>) -> (Outcome, Vec<Pose>) {
    let (walls, rim) = (walls(), Rim::body(0.8, 0.3));
    let facing = |step: usize| {
        let network = Network::none(Disc { radius: 0.15, margin: 0.0 });
        let facing = (STEP * step as f64).to_radians();
        Building::of_walls(network, walls.clone()).in_stance(0, &rim, Some(facing))
    };
    let buildings: Vec<Building> = (0..8).map(facing).collect();
    let shapes = Shapes {
        all: vec![Shape { rim, greatest_speed_m_s: 0.5, overhead: Vec::new() }],
        seconds: BTreeMap::new(),
    };
    let stretch = |stance, points: &[[f64; 2]]| Stretch {
        stance,
        points: points.iter().map(|at| Point::new(at[0], at[1])).collect(),
    };
    // through the gap, aside along the wall behind it, an eighth of a turn in two steps, and on aslant
    let way = vec![
        stretch(0, &[[1.0, 1.5], [5.2, 1.5], [5.2, 3.2]]),
        stretch(1, &[[5.2, 3.2], [5.2, 3.2]]),
        stretch(2, &[[5.2, 3.2], [7.5, 4.8]]),
    ];
    let mut outfit = Outfit { robot, ..super::scene::exact() };
    outfit.navigation.speed_m_s = 0.5;
    let mission =
        Mission { obstacles, ..Mission::between(Pose::new(1.0, 1.5, PI), Point::new(7.5, 4.8), seed) };
    let on = Drivable { walls: &walls, shapes: Some(&shapes), stance: 0, buildings: &buildings };
    let mut truths = Vec::new();
    let note = |entry: Entry| truths.extend(entry.truth);
    let outcome =
        mission.run(&on, &outfit, Some(&mut Says(way)), &mut Table, note, None).expect("it fits there");
    (outcome, truths)
}

#[test]
fn it_goes_lengthwise_through_a_gap_sideways_along_a_wall_and_turns_where_it_is_told_to() {
    let (outcome, truths) = run(Settings::exact(), 1, Vec::new());
    assert_eq!((outcome.trip.ending, outcome.trip.touches), (Ending::Arrived, 0));
    assert_eq!(outcome.trip.changes, [(0, 0), (0, 0)]);
    assert!(outcome.overlap_m < -0.02 && outcome.miss_m < 0.15, "{outcome:?}");
    // half a turn shows it the same, so that it went backwards through the gap
    let off = |pose: &Pose, degrees: f64| {
        let off = (pose.heading.to_degrees() - degrees).rem_euclid(180.0);
        off.min(180.0 - off)
    };
    assert!(truths.iter().filter(|pose| pose.at.y < 3.0).all(|pose| off(pose, 0.0) < 1.5), "{truths:?}");
    assert!(truths.last().is_some_and(|pose| off(pose, 2.0 * STEP) < 1.5), "{:?}", truths.last());
}

#[test]
fn wheels_and_a_sonar_that_err_take_it_there_without_a_touch_too() {
    let mut touches = 0;
    for seed in 0..20 {
        let (outcome, _) = run(Settings::default(), seed, Vec::new());
        assert_eq!(outcome.trip.ending, Ending::Arrived, "{seed}");
        assert!(outcome.overlap_m < 1e-6 && outcome.miss_m < 0.3, "{seed}: {outcome:?}");
        touches += outcome.trip.touches;
    }
    assert!(touches <= 1, "{touches} touches on 20 ways of 9 m");
}

#[test]
fn a_box_on_its_way_is_gone_around_or_the_way_is_given_up_and_it_never_stands_in_it() {
    let mut arrived = 0;
    for seed in 0..10 {
        let at = Point::new(6.4, 3.6 + 0.1 * seed as f64);
        let (outcome, _) = run(Settings::default(), seed, vec![Obstacle::boxed(at, 0.4, 0.3, 0.5)]);
        assert!(outcome.overlap_m < 1e-6, "{seed}: {outcome:?}");
        let ended = outcome.trip.ending;
        assert!(ended != Ending::Arrived || outcome.miss_m < 0.3, "{seed}: {outcome:?}");
        arrived += usize::from(ended == Ending::Arrived);
    }
    assert!(arrived >= 8, "{arrived} of 10");
}
