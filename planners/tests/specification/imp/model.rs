//! What the composite local model makes of scans.

use std::f64::consts::FRAC_PI_2;

use adit_planners::body::{Body, Command, Contact, Reading};
use adit_planners::geometry::{Point, Segment};
use adit_planners::local_model::{
    Estimate, LocalModel, ModelSegment, SegmentFacts, Settings, Source, Transition, Update,
};
use adit_planners::pose::Pose;
use adit_planners::simulator::{self, Course, Obstacle, Simulator};

use crate::imp::plans::segment;
use crate::imp::table::{remembering, table};

/// Two rooms of 6 m by 5 m with a door of 1 m between them.
fn walls() -> Vec<Segment> {
    let outline =
        [[0.0, 0.0, 12.0, 0.0], [12.0, 0.0, 12.0, 5.0], [12.0, 5.0, 0.0, 5.0], [0.0, 5.0, 0.0, 0.0]];
    outline.into_iter().chain([[6.0, 0.0, 6.0, 2.0], [6.0, 3.0, 6.0, 5.0]]).map(segment).collect()
}

struct World {
    robot: Simulator,
    model: LocalModel,
}

impl World {
    fn new(
        walls: &[Segment],
        obstacles: Vec<Obstacle>,
        settings: simulator::Settings,
        thought: Estimate,
    ) -> Self {
        let robot = Simulator::new(walls, obstacles, settings, Pose::new(2.0, 2.5, 0.0), 11).unwrap();
        Self { robot, model: LocalModel::new(Settings::default(), thought) }
    }

    fn here() -> Estimate {
        Estimate::new(Pose::new(2.0, 2.5, 0.0), 0.0, 0.0)
    }

    fn turn(&mut self) -> Vec<Reading> {
        let readings = (0..120)
            .map(|_| self.robot.sense().unwrap())
            .inspect(|sensed| self.model.reckon(&sensed.odometry));
        readings.flat_map(|sensed| sensed.readings).collect()
    }

    fn scan(&mut self, table: impl FnMut(&SegmentFacts) -> Transition) -> Update {
        let readings = self.turn();
        self.model.update(&readings, self.robot.time_s(), table)
    }

    fn go(&mut self, command: Command) {
        self.robot.command(command);
        while self.robot.sense().unwrap().is_busy {}
    }

    /// How far the model's surface in the middle of a piece lies from it; `None` where there is none within 0.5 m.
    fn gap(&self, to: [f64; 4]) -> Option<f64> {
        let to = segment(to);
        let near = self.model.segments().iter().map(|known| known.line.distance(to.middle()));
        near.min_by(f64::total_cmp).filter(|gap| *gap < 0.5)
    }
}

#[test]
fn exact_readings_give_the_walls_as_they_are_joined_at_their_corners() {
    let square =
        [[0.0, 0.0, 5.0, 0.0], [5.0, 0.0, 5.0, 5.0], [5.0, 5.0, 0.0, 5.0], [0.0, 5.0, 0.0, 0.0]].map(segment);
    let mut world = World::new(&square, Vec::new(), simulator::Settings::exact(), World::here());
    let update = world.scan(table);
    let model = world.model.segments();
    assert_eq!((model.len(), update.entered.len(), update.matched), (4, 4, 0));
    for known in model {
        let wall = square.iter().find(|wall| wall.distance(known.line.middle()) < 1e-3);
        let wall = wall.unwrap_or_else(|| panic!("{known:?} lies on no wall"));
        assert!((known.line.length() - wall.length()).abs() < 0.01, "{known:?}");
        let joined = known.joins.map(|id| model.iter().find(|other| Some(other.id) == id));
        assert!(
            joined.into_iter().all(|other| other.is_some_and(|other| other.joins.contains(&Some(known.id))))
        );
    }
}

#[test]
fn what_is_seen_again_is_reinforced_and_gets_firmer_and_nothing_is_entered_twice() {
    let mut world = World::new(&walls(), Vec::new(), simulator::Settings::default(), World::here());
    world.scan(table);
    let first: Vec<_> = world.model.segments().to_vec();
    for _ in 0..8 {
        world.scan(table);
    }
    let model = world.model.segments();
    for wall in [[0.0, 0.0, 4.0, 0.0], [0.0, 1.0, 0.0, 4.0], [0.0, 5.0, 4.0, 5.0]] {
        let on = |known: &&ModelSegment| known.line.distance(segment(wall).middle()) < 0.05;
        let found: Vec<_> = model.iter().filter(on).collect();
        assert_eq!(found.len(), 1, "one surface for {wall:?}");
        assert_eq!(found[0].confidence, 5);
        let then = first.iter().find(|known| known.id == found[0].id).unwrap();
        assert!(found[0].sigma_m <= then.sigma_m);
    }
}

#[test]
fn a_door_stays_open_in_the_model() {
    let mut world = World::new(&walls(), Vec::new(), simulator::Settings::default(), World::here());
    for _ in 0..5 {
        world.scan(table);
    }
    let middle = Point::new(6.0, 2.5);
    let gap = world.model.segments().iter().map(|known| known.line.distance(middle)).fold(9.0, f64::min);
    assert!(gap > 0.35, "{gap}");
}

#[test]
fn a_closed_door_in_a_recalled_wall_is_entered_beside_it() {
    let door = Obstacle::boxed(Point::new(6.0, 2.5), 0.04, 1.0, 0.0);
    let mut world = World::new(&walls(), vec![door], simulator::Settings::default(), World::here());
    world.model.recall((0..).zip(walls()), table);
    assert_eq!(world.model.segments().len(), 6);
    world.scan(table);
    let new: Vec<_> = world.model.segments().iter().filter(|known| known.source == Source::SONAR).collect();
    assert_eq!(new.len(), 1, "{new:?}");
    let (length, middle) = (new[0].line.length(), new[0].line.middle());
    assert!((length - 1.0).abs() < 0.3 && middle.distance(Point::new(6.0, 2.5)) < 0.2, "{:?}", new[0]);
}

#[test]
fn recalled_walls_are_entered_once_near_ones_only_and_stay_where_they_are() {
    let mut world = World::new(&walls(), Vec::new(), simulator::Settings::default(), World::here());
    let far = Segment::new(Point::new(90.0, 0.0), Point::new(91.0, 0.0));
    let surfaces: Vec<(u32, Segment)> = (0..).zip(walls().into_iter().chain([far])).collect();
    assert_eq!(world.model.recall(surfaces.iter().copied(), table), 6);
    assert_eq!(world.model.recall(surfaces.iter().copied(), table), 0);
    for _ in 0..5 {
        world.scan(table);
    }
    let (recalled, others): (Vec<&ModelSegment>, Vec<&ModelSegment>) =
        world.model.segments().iter().partition(|known| known.source == Source::RECALLED);
    assert_eq!(recalled.iter().map(|known| known.line).collect::<Vec<_>>(), walls());
    assert!(others.iter().all(|known| known.confidence < 3), "{others:?}");
}

#[test]
fn a_wrong_pose_is_put_right_by_known_walls_and_its_covariance_shrinks() {
    for critical in [false, true] {
        let thought = Estimate::new(Pose::new(2.12, 2.41, 5.0_f64.to_radians()), 0.1, 4.0_f64.to_radians());
        let mut world = World::new(&walls(), Vec::new(), simulator::Settings::default(), thought);
        let settings = Settings { fewest_echoes: if critical { 1000 } else { 4 }, ..Settings::default() };
        world.model = LocalModel::new(settings, thought);
        world.model.recall((0..).zip(walls()), table);
        let first = world.scan(table);
        assert!(first.observations > 4);
        // 1000 echoes are never seen: then all is left to the readings in critical directions
        assert_eq!(first.seen == 0, critical);
        for _ in 0..3 {
            world.scan(table);
        }
        let estimate = world.model.estimate();
        let error = estimate.pose.at.distance(world.robot.pose().at);
        assert!(error < 0.02, "{error} m, only by readings: {critical}");
        assert!(estimate.pose.heading.abs() < 0.5_f64.to_radians(), "{}", estimate.pose.heading.to_degrees());
        assert!(estimate.sigma_m() < 0.02 && estimate.sigma_heading() < 0.5_f64.to_radians());
    }
}

#[test]
fn one_wall_says_nothing_of_the_place_along_it() {
    let wall = [segment([-20.0, 0.0, 20.0, 0.0])];
    let thought = Estimate::new(Pose::new(2.3, 2.4, 0.0), 0.3, 2.0_f64.to_radians());
    let mut world = World::new(&wall, Vec::new(), simulator::Settings::default(), thought);
    world.model.recall((0..).zip(wall), remembering);
    for _ in 0..3 {
        world.scan(remembering);
    }
    let estimate = world.model.estimate();
    assert!((estimate.pose.at.y - 2.5).abs() < 0.02);
    assert!((estimate.pose.at.x - 2.3).abs() < 0.02, "it may not be moved along the wall");
    assert!(estimate.covariance[(0, 0)].sqrt() > 0.25 && estimate.covariance[(1, 1)].sqrt() < 0.02);
}

#[test]
fn a_wall_out_of_sight_stays_and_a_far_one_goes_if_the_table_says_so() {
    let mut world = World::new(&walls(), Vec::new(), simulator::Settings::default(), World::here());
    world.scan(table);
    let count = world.model.segments().len();
    let away = Estimate::new(Pose::new(7.0, -6.0, 0.0), 0.0, 0.0);
    world.model.set_estimate(away);
    world.model.update(&[], 100.0, table);
    assert_eq!(world.model.segments().len(), count, "nobody looked");
    world.model.set_estimate(Estimate::new(Pose::new(99.0, 0.0, 0.0), 0.0, 0.0));
    let turns = Settings::default().hidden_scans;
    let gone = (0..turns).map(|_| world.model.update(&[], 200.0, table).removed.len()).sum::<usize>();
    assert_eq!((gone, world.model.segments().len()), (count, 0), "each has its turn");
}

#[test]
fn of_what_a_scan_does_not_show_the_table_is_asked_in_turn() {
    let mut world = World::new(&walls(), Vec::new(), simulator::Settings::default(), World::here());
    world.scan(table);
    let ids: Vec<_> = world.model.segments().iter().map(|known| known.id).collect();
    let turns = Settings::default().hidden_scans;
    let mut asked = Vec::new();
    for _ in 0..3 * turns {
        world.model.update(&[], 100.0, |facts| {
            asked.push((facts.id, facts.age));
            table(facts)
        });
    }
    for id in ids {
        let ages: Vec<u32> = asked.iter().filter(|(of, _)| *of == id).map(|(_, age)| *age).collect();
        assert_eq!(ages.len(), 3, "{ages:?}");
        assert!(ages.windows(2).all(|pair| pair[1] == pair[0] + turns), "it grows older unasked: {ages:?}");
    }
}

#[test]
fn the_table_is_asked_once_for_each_segment_and_its_word_is_done() {
    let mut world = World::new(&walls(), Vec::new(), simulator::Settings::default(), World::here());
    let mut asked = Vec::new();
    world.scan(|facts| {
        asked.push(*facts);
        Transition { source: Source(9), confidence: 3, ..table(facts) }
    });
    let ids: Vec<_> = world.model.segments().iter().map(|known| known.id).collect();
    assert_eq!(asked.iter().map(|facts| facts.id).collect::<Vec<_>>(), ids);
    assert!(
        asked.iter().all(|facts| facts.confidence == 0 && facts.source == Source::SONAR && facts.age == 0)
    );
    assert!(world.model.segments().iter().all(|known| known.confidence == 3 && known.source == Source(9)));
    let update = world.scan(|facts| Transition { is_kept: facts.age == 0, ..table(facts) });
    assert_eq!(update.removed, ids);
}

#[test]
fn a_false_wall_is_gone_within_5_scans_after_its_place_is_seen_free() {
    // it stands for a while, then goes away behind the wall
    for stays_s in [5.0, 30.0, 120.0] {
        let course = Course {
            through: vec![Point::new(0.0, 20.0)],
            speed_m_s: 2.0,
            starts_s: stays_s,
            goes_round: false,
        };
        let thing = Obstacle::boxed(Point::new(4.2, 2.5), 0.8, 0.8, 0.3).on(course);
        let mut world = World::new(&walls(), vec![thing], simulator::Settings::default(), World::here());
        let front = [3.75, 2.3, 3.75, 2.7];
        while world.robot.time_s() < stays_s + 1.0 {
            world.scan(table);
        }
        assert!(world.gap(front).is_some_and(|gap| gap < 0.15), "it was a wall after {stays_s} s");
        for _ in 0..15 {
            world.robot.sense().unwrap();
        }
        let gone = (1..=5).find(|_| {
            world.scan(table);
            world.gap(front).is_none()
        });
        println!("a wall that stood {stays_s} s is gone {gone:?} scans after its place is seen free");
        assert!(gone.is_some());
    }
}

#[test]
fn a_thing_that_moves_is_followed_and_becomes_no_wall() {
    let course =
        Course { through: vec![Point::new(0.0, 3.6)], speed_m_s: 0.1, starts_s: 0.0, goes_round: true };
    let thing = Obstacle::boxed(Point::new(4.0, 0.7), 0.6, 0.6, 0.0).on(course);
    let mut world = World::new(&walls(), vec![thing], simulator::Settings::default(), World::here());
    world.model.recall((0..).zip(walls()), table);
    let mut followed = 0;
    for _ in 0..10 {
        world.scan(table);
        let at = world.robot.obstacles().next().unwrap()[0].a;
        let moving = world.model.objects().iter().find(|object| object.is_moving);
        followed += u32::from(moving.is_some_and(|object| object.at.distance(at) < 0.8));
        let firm = world
            .model
            .segments()
            .iter()
            .filter(|known| known.source == Source::SONAR && known.confidence > 2);
        assert_eq!(firm.count(), 0, "part of a moving thing is taken for a wall");
    }
    assert!(followed >= 6, "followed in {followed} of 10 scans");
    let error = world.model.estimate().pose.at.distance(world.robot.pose().at);
    assert!(error < 0.03, "{error}");
}

#[test]
fn what_was_seen_free_of_a_wall_is_taken_out_of_it() {
    let course =
        Course { through: vec![Point::new(0.0, 30.0)], speed_m_s: 9.0, starts_s: 25.0, goes_round: false };
    let door = Obstacle::boxed(Point::new(6.0, 2.5), 0.02, 1.0, 0.0).on(course);
    let mut world = World::new(&walls(), vec![door], simulator::Settings::default(), World::here());
    for _ in 0..4 {
        world.scan(table);
    }
    let behind_door = [6.0, 2.3, 6.0, 2.7];
    assert!(world.gap(behind_door).is_some_and(|gap| gap < 0.1));
    for _ in 0..20 {
        world.robot.sense().unwrap();
    }
    for _ in 0..6 {
        world.scan(table);
    }
    assert!(world.gap(behind_door).is_none_or(|gap| gap > 0.25), "{:?}", world.gap(behind_door));
    for left in [[6.0, 0.5, 6.0, 1.5], [6.0, 3.5, 6.0, 4.5]] {
        assert!(world.gap(left).is_some_and(|gap| gap < 0.1), "{left:?} is still there");
    }
}

#[test]
fn a_touch_is_a_short_surface_across_it_or_the_known_wall() {
    let mut world = World::new(&walls(), Vec::new(), simulator::Settings::exact(), World::here());
    let contact = Contact { bearing: FRAC_PI_2 };
    let id = world.model.touched(&contact, 0.25, table);
    let felt = world.model.segments()[0];
    assert_eq!((felt.id, felt.source, felt.confidence), (id, Source::CONTACT, 1));
    assert!(felt.line.middle().distance(Point::new(2.0, 2.75)) < 1e-9);
    assert!((felt.line.a.y - felt.line.b.y).abs() < 1e-9 && (felt.line.length() - 0.2).abs() < 1e-9);
    assert_eq!(world.model.touched(&contact, 0.25, table), id, "the same thing again");
    assert_eq!(world.model.segments()[0].confidence, 2);
    assert_eq!(world.model.segments().len(), 1);
}

#[test]
fn parts_of_a_turn_on_the_way_keep_the_pose() {
    let mut world = World::new(&walls(), Vec::new(), simulator::Settings::default(), World::here());
    world.model.recall((0..).zip(walls()), table);
    world.robot.command(Command::Move { distance_m: 8.0, bearing: 0.0, speed_m_s: 0.5 });
    let mut part = Vec::new();
    loop {
        let sensed = world.robot.sense().unwrap();
        world.model.reckon(&sensed.odometry);
        part.extend(sensed.readings);
        if part.len() == 30 {
            world.model.update(&std::mem::take(&mut part), sensed.time_s, table);
            let error = world.model.estimate().pose.at.distance(world.robot.pose().at);
            assert!(error < 0.1, "{error}");
        }
        if !sensed.is_busy {
            break;
        }
    }
}

#[test]
fn nothing_seen_changes_nothing_and_odd_readings_do_no_harm() {
    let mut world = World::new(&walls(), Vec::new(), simulator::Settings::default(), World::here());
    assert_eq!(world.model.update(&[], 0.0, table), Update::default());
    let odd = |range_m| Reading { bearing: 0.3, range_m, odometry: Pose::default() };
    for range in [Some(0.0), Some(f64::MAX), Some(f64::NAN), Some(f64::INFINITY), Some(-1.0), None] {
        world.model.update(&[odd(range); 20], 1.0, table);
    }
    let estimate = world.model.estimate();
    assert!(estimate.pose.at.x.is_finite() && estimate.pose.at.distance(Point::new(2.0, 2.5)) < 1e-9);
    assert!(world.model.segments().iter().all(|known| known.line.length().is_finite()));
    world.go(Command::Turn { by: 1.0 });
    world.scan(table);
    assert!(!world.model.segments().is_empty());
}

#[test]
fn a_side_between_two_corners_stays_a_side() {
    // of the thin end of a wall both ends are near the corners that it makes with what stands beside it
    let slant = [[4.0, 2.0, 4.16, 2.1], [4.0, 2.0, 4.0, 0.0], [4.16, 2.1, 4.35, 0.0]].map(segment);
    let walls = [&walls()[..], &slant].concat();
    for seed in 0..20 {
        let settings = simulator::Settings { range_noise: 0.01, ..simulator::Settings::default() };
        let robot = Simulator::new(&walls, Vec::new(), settings, Pose::new(2.0, 2.5, 0.0), seed).unwrap();
        let mut world = World { robot, model: LocalModel::new(Settings::default(), World::here()) };
        for _ in 0..6 {
            world.scan(table);
            for known in world.model.segments() {
                let nearest =
                    |p: Point| walls.iter().map(|wall| wall.distance(p)).fold(f64::INFINITY, f64::min);
                assert!(known.line.length() >= 0.1, "seed {seed}: {known:?}");
                let off = [0.25, 0.5, 0.75].map(|share| nearest(known.line.a.lerp(known.line.b, share)));
                assert!(off.iter().all(|off| *off < 0.3), "seed {seed}: {known:?} lies where nothing is");
            }
        }
    }
}
