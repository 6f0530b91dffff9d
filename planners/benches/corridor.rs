//! Lee's corridors at gap 0.2, each turn told as if by rules: choosing the corridors, and driving them with the sweep.
//! `cargo bench -p adit-planners --bench corridor`
#![allow(missing_docs)] // divan's macros

use std::convert::Infallible;

use adit_planners::channels::corridor::{
    Axis, Corridors, Extreme, Offset, Part, Robot, Route, Steer, StepFacts, Turn,
};
use adit_planners::geometry::{Point, Rect};
use divan::{Bencher, black_box};

const ROBOT: Robot = Robot { width: 1.0, length: 1.5 };
const START: Point = Point::new(1.5, 2.0);

fn main() {
    divan::main();
}

/// The corridor shaped like S, and its goal.
fn s_shaped() -> (Corridors, Point) {
    let channels =
        [Rect::new(0.0, 0.0, 3.0, 9.0), Rect::new(0.0, 6.0, 12.0, 9.0), Rect::new(9.0, 6.0, 12.0, 18.0)];
    (Corridors::new(&channels).expect("the channels are orthogonal"), Point::new(10.5, 16.0))
}

/// Up and right, then right and up: rules 1 and 5 of Table 2.
fn steer(facts: &StepFacts) -> Steer {
    let offset = |is_negative, part| Offset { is_negative, part };
    let (cos, sin) = (Part::Cos, Part::Sin);
    let (rule, corner, turn, arriving) = if facts.entering == Axis::Y {
        (1, (Extreme::Max, Extreme::Min), Turn::Right, (offset(true, cos), offset(false, sin)))
    } else {
        (5, (Extreme::Min, Extreme::Max), Turn::Left, (offset(false, sin), offset(true, cos)))
    };
    let measured_along = facts.entering.across();
    Steer { rule: Some(rule), corner, turn, gap: 0.2, arriving, measured_along }
}

fn route(corridors: &Corridors, goal: Point) -> Route<'_> {
    corridors
        .route(START, goal, |passage| Ok::<_, Infallible>(Some(passage.length)))
        .expect("the channels are a chain")
}

#[divan::bench]
fn read(bencher: Bencher) {
    bencher.bench(s_shaped);
}

#[divan::bench]
fn choose(bencher: Bencher) {
    let (corridors, goal) = s_shaped();
    bencher.bench(|| route(black_box(&corridors), black_box(goal)).weight());
}

#[divan::bench]
fn drive(bencher: Bencher) {
    let (corridors, goal) = s_shaped();
    let route = route(&corridors, goal);
    bencher.bench(|| black_box(&route).drive(ROBOT, None, |facts| Ok::<_, Infallible>(steer(facts))));
}

#[divan::bench]
fn drive_from_another_heading(bencher: Bencher) {
    let (corridors, goal) = s_shaped();
    let route = route(&corridors, goal);
    bencher.bench(|| black_box(&route).drive(ROBOT, Some(1.0), |facts| Ok::<_, Infallible>(steer(facts))));
}
