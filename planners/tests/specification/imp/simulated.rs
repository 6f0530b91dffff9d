//! What a robot feels, hears and counts in a simulation.

use std::f64::consts::{FRAC_PI_2, PI};

use adit_planners::body::{Body, Command, Sensed};
use adit_planners::geometry::{Point, Segment};
use adit_planners::pose::{Pose, wrapped};
use adit_planners::simulator::{Course, Film, Obstacle, Settings, SimulationError, Simulator};

use crate::imp::plans::segment;

/// A room of 10 m by 6 m.
fn room() -> Vec<Segment> {
    [[0.0, 0.0, 10.0, 0.0], [10.0, 0.0, 10.0, 6.0], [10.0, 6.0, 0.0, 6.0], [0.0, 6.0, 0.0, 0.0]]
        .map(segment)
        .to_vec()
}

fn robot(obstacles: Vec<Obstacle>, settings: Settings, seed: u64) -> Simulator {
    Simulator::new(&room(), obstacles, settings, Pose::new(2.0, 3.0, 0.0), seed).unwrap()
}

fn go(robot: &mut Simulator, distance_m: f64) -> Sensed {
    robot.command(Command::Move { distance_m, bearing: 0.0, speed_m_s: 0.5 });
    finish(robot)
}

fn finish(robot: &mut Simulator) -> Sensed {
    std::iter::repeat_with(|| robot.sense().unwrap()).find(|sensed| !sensed.is_busy).unwrap()
}

fn at_x(x: f64, course: Option<Course>) -> Obstacle {
    Obstacle { course, ..Obstacle::boxed(Point::new(x, 3.0), 1.0, 1.0, 0.0) }
}

fn course(dx: f64) -> Course {
    Course { through: vec![Point::new(dx, 0.0)], speed_m_s: 0.4, starts_s: 0.0, goes_round: false }
}

#[test]
fn it_drives_as_far_as_it_is_told_and_as_fast() {
    let mut robot = robot(Vec::new(), Settings::exact(), 1);
    let sensed = go(&mut robot, 2.0);
    assert!(robot.pose().at.distance(Point::new(4.0, 3.0)) < 1e-9);
    assert!(sensed.odometry.at.distance(Point::new(2.0, 0.0)) < 1e-9);
    assert!((sensed.time_s - 4.0).abs() < 0.051, "{}", sensed.time_s);
    go(&mut robot, -1.0);
    assert!(robot.pose().at.distance(Point::new(3.0, 3.0)) < 1e-9);
    robot.command(Command::Turn { by: -FRAC_PI_2 });
    assert!((finish(&mut robot).odometry.heading + FRAC_PI_2).abs() < 1e-9);
    assert!((robot.pose().heading + FRAC_PI_2).abs() < 1e-9);
}

#[test]
fn it_stops_where_it_touches_and_feels_where_until_it_moves_off() {
    let mut robot = robot(Vec::new(), Settings::exact(), 1);
    robot.command(Command::Turn { by: 30.0_f64.to_radians() });
    finish(&mut robot);
    let sensed = go(&mut robot, 20.0);
    let gap = 6.0 - robot.pose().at.y - 0.25;
    assert!((0.0..1e-8).contains(&gap), "{gap}");
    assert!((sensed.contact.unwrap().bearing - 60.0_f64.to_radians()).abs() < 1e-6);
    let touch = robot.touches()[0];
    assert!(
        touch.by_robot
            && touch.obstacle.is_none()
            && touch.at.distance(Point::new(robot.pose().at.x, 6.0)) < 1e-6
    );
    // on into the wall is no use
    assert!(go(&mut robot, 1.0).contact.is_some());
    assert!(6.0 - robot.pose().at.y - 0.25 >= 0.0);
    assert_eq!(go(&mut robot, -0.1).contact, None);
}

#[test]
fn wheels_count_no_farther_than_a_touch() {
    let mut robot = robot(vec![at_x(5.0, None)], Settings::exact(), 1);
    let sensed = go(&mut robot, 8.0);
    assert!((sensed.odometry.at.x - 2.25).abs() < 1e-6, "{:?}", sensed.odometry);
}

#[test]
fn an_obstacle_on_its_course_stops_at_the_robot_and_goes_on_when_that_is_gone() {
    let mut robot = robot(vec![at_x(6.0, Some(course(-5.5)))], Settings::exact(), 1);
    let hit =
        std::iter::repeat_with(|| robot.sense().unwrap()).find(|sensed| sensed.contact.is_some()).unwrap();
    assert!(hit.contact.unwrap().bearing.abs() < 1e-6);
    assert_eq!(robot.pose().at, Point::new(2.0, 3.0));
    assert!(robot.touches().iter().all(|touch| !touch.by_robot && touch.obstacle == Some(0)));
    for _ in 0..100 {
        robot.sense().unwrap();
    }
    assert_eq!(robot.touches().len(), 1, "one touch that lasts");
    let left =
        |robot: &Simulator| robot.obstacles().next().unwrap().iter().map(|side| side.a.x).fold(9.0, f64::min);
    assert!((left(&robot) - 2.25).abs() < 1e-6);
    robot.command(Command::Turn { by: FRAC_PI_2 });
    finish(&mut robot);
    // it is pushed on the way, which stops it, and is not its collision
    while robot.pose().at.y < 4.8 {
        go(&mut robot, 2.0);
    }
    assert!(robot.touches().iter().all(|touch| !touch.by_robot));
    for _ in 0..200 {
        robot.sense().unwrap();
    }
    assert!((left(&robot) - 0.0).abs() < 1e-6, "{}", left(&robot));
}

#[test]
fn whatever_moves_robot_and_obstacle_never_overlap() {
    for seed in 0..40_u32 {
        let angle = f64::from(seed) * 0.31;
        let way = Point::new(-6.0 * angle.cos(), 3.0 * angle.sin());
        let course = Course { through: vec![way], speed_m_s: 0.9, starts_s: 0.0, goes_round: true };
        let obstacle = Obstacle::boxed(Point::new(5.0, 3.0), 0.8, 0.5, angle).on(course);
        let mut robot = robot(vec![obstacle], Settings::default(), u64::from(seed));
        for step in 0..800 {
            if step % 40 == 0 {
                robot.command(Command::Turn { by: 1.0 });
            } else if step % 40 == 20 {
                robot.command(Command::Move { distance_m: 2.0, bearing: 0.0, speed_m_s: 0.5 });
            }
            robot.sense().unwrap();
            let at = robot.pose().at;
            let sides = robot.obstacles().flatten().chain(robot.walls());
            let gap = sides.map(|side| side.distance(at)).fold(f64::INFINITY, f64::min) - 0.25;
            assert!(gap > -1e-12, "seed {seed}, step {step}: {gap}");
        }
    }
}

#[test]
fn the_sonar_turns_by_3_degrees_and_hears_walls_and_obstacles() {
    let mut robot = robot(vec![at_x(5.0, None)], Settings::exact(), 1);
    let readings: Vec<_> = (0..120).map(|_| robot.sense().unwrap().readings[0]).collect();
    let heard = |place: usize| readings[place].range_m;
    for (place, reading) in (0..).zip(&readings) {
        assert!((wrapped(reading.bearing - f64::from(3 * place).to_radians())).abs() < 1e-9);
    }
    assert!((heard(0).unwrap() - 2.5).abs() < 1e-9);
    assert!((heard(30).unwrap() - 3.0).abs() < 1e-9);
    assert!((heard(60).unwrap() - 2.0).abs() < 1e-9);
    assert!((heard(75).unwrap() - 2.0 * 2.0_f64.sqrt()).abs() < 1e-9);
    let mut far =
        Simulator::new(&room(), Vec::new(), Settings::exact(), Pose::new(1.0, 3.0, 0.0), 1).unwrap();
    assert_eq!(far.sense().unwrap().readings[0].range_m, None, "a wall at 9 m is beyond hearing");
}

#[test]
fn errors_are_as_large_as_the_settings_say() {
    let (mut along, mut turned, mut ranges, mut silent, mut wild) =
        (Vec::new(), Vec::new(), Vec::new(), 0, 0);
    for seed in 0..400 {
        let mut robot = robot(Vec::new(), Settings::default(), seed);
        let sensed = go(&mut robot, 4.0);
        along.push(robot.pose().at.distance(Point::new(2.0, 3.0)) / 4.0 - 1.0);
        turned.push((robot.pose().heading - sensed.odometry.heading).to_degrees());
        for _ in 0..30 {
            let reading = robot.sense().unwrap().readings[0];
            let pose = robot.pose();
            let truth = robot.range(pose.at, pose.direction(reading.bearing)).unwrap();
            match reading.range_m {
                None => silent += 1,
                Some(range) if (range / truth - 1.0).abs() > 0.06 => wild += 1,
                Some(range) => ranges.push(range / truth - 1.0),
            }
        }
    }
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let deviation = |values: &[f64]| {
        let middle = mean(values);
        (values.iter().map(|v| (v - middle).powi(2)).sum::<f64>() / values.len() as f64).sqrt()
    };
    let near = |found: f64, expected: f64, by: f64| {
        assert!((found - expected).abs() < by, "{found} is not {expected}");
    };
    near(deviation(&along), 0.02, 0.002);
    near(deviation(&turned), 2.0, 0.2);
    near(mean(&turned), 0.2, 0.3);
    near(deviation(&ranges), 0.01, 0.0005);
    near(f64::from(silent) / 12_000.0, 0.02, 0.005);
    near(f64::from(wild) / 12_000.0, 0.01, 0.004);
}

#[test]
fn the_same_seed_gives_the_same_readings_to_the_bit_and_another_gives_others() {
    let run = |seed| {
        let mut robot = robot(vec![at_x(7.0, Some(course(-4.0)))], Settings::default(), seed);
        robot.command(Command::Move { distance_m: 3.0, bearing: 0.0, speed_m_s: 0.4 });
        (0..300).map(|_| robot.sense().unwrap()).collect::<Vec<_>>()
    };
    assert_eq!(run(5), run(5));
    assert_ne!(run(5), run(6));
}

#[test]
fn what_cannot_begin_says_why() {
    let begin = |obstacles: Vec<Obstacle>, settings: Settings, x: f64| {
        let start = Pose::new(x, 3.0, 0.0);
        Simulator::new(&room(), obstacles, settings, start, 1).map(|_| ()).map_err(|error| error.to_string())
    };
    let exact = Settings::exact();
    assert_eq!(begin(Vec::new(), exact, 2.0), Ok(()));
    assert_eq!(
        begin(Vec::new(), exact, 0.2).unwrap_err(),
        "the robot begins at 0.2, 3, 0.200 m from wall 4; its radius is 0.25 m"
    );
    assert_eq!(
        begin(vec![Obstacle::boxed(Point::new(2.0, 3.0), 4.0, 4.0, 0.0)], exact, 2.0).unwrap_err(),
        "the robot begins at 2, 3, 0.000 m from obstacle 1; its radius is 0.25 m"
    );
    assert_eq!(
        begin(vec![at_x(5.0, Some(Course { speed_m_s: -1.0, ..course(1.0) }))], exact, 2.0).unwrap_err(),
        "obstacle 1 moves at -1 m/s; expected a speed of 0 or more"
    );
    assert_eq!(
        begin(vec![Obstacle { corners: Vec::new(), course: None }], exact, 2.0).unwrap_err(),
        "obstacle 1 has 0 corners; expected 3 or more"
    );
    assert_eq!(
        begin(Vec::new(), exact, f64::NAN).unwrap_err(),
        "the robot is at NaN, 3; expected two finite numbers"
    );
    let wrong = begin(Vec::new(), Settings { radius_m: -1.0, ..exact }, 2.0).unwrap_err();
    assert!(wrong.starts_with("the robot's radius_m is -1;"), "{wrong}");
    assert!(matches!(
        Simulator::new(&[], Vec::new(), Settings { missed: 2.0, ..exact }, Pose::default(), 1),
        Err(SimulationError::Setting { name: "missed", .. })
    ));
}

#[test]
fn a_film_shows_robot_obstacles_and_captions_and_is_well_formed() {
    let mut robot = robot(vec![at_x(7.0, Some(course(-2.0)))], Settings::default(), 3);
    let mut film = Film::new(&robot);
    robot.command(Command::Move { distance_m: 2.0, bearing: 0.0, speed_m_s: 0.5 });
    for step in 0..60 {
        robot.sense().unwrap();
        let mut frame = robot.frame();
        frame.estimate = Some(Pose { heading: frame.robot.heading + PI, ..frame.robot });
        frame.surfaces = (step % 20 == 0).then(room);
        frame.caption = (step == 30).then(|| "Move <on> & \"on\"".to_owned());
        film.push(frame);
    }
    film.push(robot.frame());
    assert_eq!(film.frames().len(), 60, "a frame that is not later is left out");
    let svg = film.svg(4.0);
    assert!(svg.contains("Move &lt;on&gt; &amp; \"on\""));
    assert_eq!(svg.matches("<polygon").count(), 1);
    assert_eq!(svg.matches("<circle").count(), 2, "the true robot and the estimated one");
    assert_eq!(
        svg.matches("dur=\"0.74s\"").count(),
        9,
        "2.95 s at four times the speed: {}",
        svg.matches("dur=").count()
    );
    for tag in ["g", "svg", "text"] {
        let (opened, closed) = (format!("<{tag}"), format!("</{tag}>"));
        let opened = svg.matches(&format!("{opened} ")).count() + svg.matches(&format!("{opened}>")).count();
        assert_eq!(opened, svg.matches(&closed).count(), "{tag}");
    }
    assert!(Film::new(&robot).svg(1.0).contains("<svg"), "a film without frames is a picture");
}
