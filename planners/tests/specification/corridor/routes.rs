//! Which corridors are taken, and why none are.

use std::cell::RefCell;

use adit_planners::channels::corridor::{Corridors, End, NoRoute, Passage, RouteError};
use adit_planners::geometry::Point;
use proptest::prelude::*;

use crate::corridor::table2::rect;

/// A ring of four corridors, the two uprights 2 m and 3 m wide, and a stub to the right of it.
fn ring() -> Corridors {
    let channels = [
        [0.0, 0.0, 2.0, 12.0],
        [0.0, 0.0, 20.0, 2.0],
        [17.0, 0.0, 20.0, 12.0],
        [0.0, 10.0, 20.0, 12.0],
        [18.0, 5.0, 30.0, 7.0],
    ];
    Corridors::new(&channels.map(rect)).unwrap()
}

#[expect(clippy::unnecessary_wraps, reason = "it is handed over where weights may fail")]
fn by_length(passage: &Passage) -> Result<Option<f64>, String> {
    Ok(Some(passage.length))
}

const START: Point = Point::new(1.0, 5.0);
const GOAL: Point = Point::new(28.0, 6.0);

#[test]
fn the_way_of_least_weight_is_taken_junction_by_junction() {
    let ring = ring();
    let route = ring.route(START, GOAL, by_length).unwrap();
    assert_eq!((route.channels(), route.junctions()), (&[1, 2, 3, 5][..], &[1, 3, 5][..]));
    // 4 m down, 17.5 m right, 5 m up, 9.5 m right
    assert!((route.weight() - 36.0).abs() < 1e-9, "{}", route.weight());
    let no_low = |passage: &Passage| Ok::<_, ()>((passage.channel != 2).then_some(passage.length));
    let route = ring.route(START, GOAL, no_low).unwrap();
    assert_eq!((route.channels(), route.junctions()), (&[1, 4, 3, 5][..], &[2, 4, 5][..]));
}

#[test]
fn a_passage_is_told_with_its_length_and_the_width_of_its_channel() {
    let ring = ring();
    let told = RefCell::new(Vec::new());
    let weigh = |passage: &Passage| {
        told.borrow_mut().push(*passage);
        by_length(passage)
    };
    ring.route(START, GOAL, weigh).unwrap();
    let told = told.into_inner();
    let first = Passage { channel: 1, from: End::Start, to: End::Junction(1), length: 4.0, width: 2.0 };
    assert_eq!(told[0], first);
    let last = told.iter().find(|passage| passage.to == End::Goal).unwrap();
    assert_eq!((last.channel, last.from, last.length, last.width), (5, End::Junction(5), 9.5, 2.0));
    for (index, passage) in told.iter().enumerate() {
        let same = |other: &&Passage| {
            (other.channel, other.from, other.to) == (passage.channel, passage.from, passage.to)
        };
        assert_eq!(told[..index].iter().find(same), None, "asked twice");
    }
}

#[test]
fn what_the_search_does_not_come_to_is_not_weighed() {
    let ring = ring();
    let told = RefCell::new(0);
    let weigh = |passage: &Passage| {
        *told.borrow_mut() += 1;
        by_length(passage)
    };
    let near = Point::new(1.0, 6.0);
    assert_eq!(ring.route(START, near, weigh).unwrap().channels(), [1]);
    assert_eq!(told.into_inner(), 3, "two junctions and the goal");
}

#[test]
fn whoever_stands_in_a_junction_is_in_both_of_its_channels() {
    let ring = ring();
    let corner = Point::new(1.0, 1.0);
    assert!(ring.route(corner, Point::new(1.0, 6.0), by_length).unwrap().junctions().is_empty());
    assert!(ring.route(Point::new(9.0, 1.0), corner, by_length).unwrap().junctions().is_empty());
    assert!(ring.route(corner, corner, by_length).unwrap().junctions().is_empty());
}

#[test]
fn of_ways_that_weigh_the_same_the_one_with_fewest_junctions_is_taken() {
    let ring = ring();
    let route = ring.route(Point::new(5.0, 1.0), Point::new(5.0, 11.0), |_| Ok::<_, ()>(Some(0.0))).unwrap();
    assert_eq!(route.junctions(), [1, 2]);
}

#[test]
fn a_point_outside_is_named_with_its_coordinates() {
    assert_eq!(says(Point::new(5.0, 5.5), GOAL, by_length), "the start (5, 5.5) lies in no channel");
    assert_eq!(says(START, Point::new(f64::NAN, 0.0), by_length), "the goal (NaN, 0) lies in no channel");
}

fn says(start: Point, goal: Point, weigh: fn(&Passage) -> Result<Option<f64>, String>) -> String {
    ring().route(start, goal, weigh).unwrap_err().to_string()
}

#[test]
fn parts_that_no_junction_joins_are_told_with_the_gap_between_them() {
    let channels =
        [[0.0, 0.0, 3.0, 9.0], [0.0, 6.0, 9.0, 9.0], [9.25, 6.0, 20.0, 9.0], [17.0, 0.0, 20.0, 9.0]];
    let corridors = Corridors::new(&channels.map(rect)).unwrap();
    let error = corridors.route(Point::new(1.0, 1.0), Point::new(18.0, 1.0), by_length).unwrap_err();
    let expected =
        NoRoute::Apart { from_start: vec![1, 2], from_goal: vec![3, 4], nearest: (2, 3), gap: 0.25 };
    assert_eq!(error, RouteError::NoRoute(expected.clone()));
    let says = "the start is in channels 1, 2, the goal in channels 3, 4, and no junction joins the two: channels 2 and \
                3 are nearest, 0.25 m apart";
    assert_eq!(expected.to_string(), says);
}

#[test]
fn passages_that_were_refused_are_named_when_nothing_else_is_left() {
    let expected = "every way from the start to the goal uses a passage that is not allowed: channel 1 from the start to \
                    junction 1, channel 1 from the start to junction 2";
    let wide = |passage: &Passage| Ok((passage.width > 2.5).then_some(passage.length));
    assert_eq!(says(START, GOAL, wide), expected);
}

#[test]
fn weights_that_fail_or_are_no_weights_end_the_search() {
    let ring = ring();
    let failing = ring.route(START, GOAL, |_| Err("rule 3 says two things"));
    assert_eq!(failing.unwrap_err(), RouteError::Weigh("rule 3 says two things"));
    for weight in [-1.0, f64::NAN, f64::INFINITY] {
        let route = ring.route(START, GOAL, |_| Ok::<_, String>(Some(weight)));
        let says = route.unwrap_err().to_string();
        let expected = format!(
            "the weight of channel 1 from the start to junction 1 is {weight}, expected a finite number that is not \
             negative"
        );
        assert_eq!(says, expected);
    }
}

/// The least weight of all ways that use no junction twice.
fn least(corridors: &Corridors, at: (Point, Vec<usize>), goal: Point, used: &mut Vec<usize>) -> f64 {
    let (point, channels) = at;
    let holds = |channel: usize, point: Point| corridors.at(point).any(|other| other == channel);
    let mut least_weight = f64::INFINITY;
    for channel in channels {
        if holds(channel, goal) {
            least_weight = least_weight.min(point.distance(goal));
        }
        for (index, junction) in corridors.junctions().iter().enumerate() {
            if (junction.lying == channel || junction.upright == channel) && !used.contains(&index) {
                used.push(index);
                let centre = junction.rect.centre();
                let on = least(corridors, (centre, vec![junction.other(channel)]), goal, used);
                least_weight = least_weight.min(point.distance(centre) + on);
                used.pop();
            }
        }
    }
    least_weight
}

proptest! {
    #[test]
    fn no_other_way_is_lighter(
        columns in prop::collection::vec((1.5_f64..3.0, 0.0_f64..4.0), 2..4),
        rows in prop::collection::vec((1.5_f64..3.0, 0.0_f64..4.0), 2..4),
        from in (0.0_f64..1.0, 0.0_f64..1.0, any::<prop::sample::Index>()),
        to in (0.0_f64..1.0, 0.0_f64..1.0, any::<prop::sample::Index>()),
    ) {
        let bands = |bands: Vec<(f64, f64)>| {
            let mut at = 0.0;
            bands.into_iter().map(|(width, gap)| { let band = (at, at + width); at += width + gap + 0.1; band }).collect::<Vec<_>>()
        };
        let (columns, rows) = (bands(columns), bands(rows));
        let (width, height) = (columns[columns.len() - 1].1, rows[rows.len() - 1].1);
        let uprights = columns.iter().map(|x| rect([x.0, -1.0, x.1, height + 1.0]));
        let lying = rows.iter().map(|y| rect([-1.0, y.0, width + 1.0, y.1]));
        let channels: Vec<_> = uprights.chain(lying).collect();
        let corridors = Corridors::new(&channels).unwrap();
        let within = |(x, y, index): (f64, f64, prop::sample::Index)| {
            let channel = index.get(&channels);
            Point::new(channel.x0 + x * channel.dx(), channel.y0 + y * channel.dy())
        };
        let (start, goal) = (within(from), within(to));
        let route = corridors.route(start, goal, by_length).unwrap();
        let expected = least(&corridors, (start, corridors.at(start).collect()), goal, &mut Vec::new());
        prop_assert!((route.weight() - expected).abs() < 1e-9, "{} instead of {expected}", route.weight());
    }
}
