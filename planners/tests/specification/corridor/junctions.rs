//! Which channels make corridors, where their junctions are, and what walls stand around them.

use adit_planners::channels::corridor::{Axis, CorridorError, Corridors, Overlap, Wall};
use adit_planners::geometry::{Point, Rect};
use proptest::prelude::*;

use crate::corridor::table2::rect;

fn corridors(channels: &[[f64; 4]]) -> Result<Corridors, CorridorError> {
    Corridors::new(&channels.iter().copied().map(rect).collect::<Vec<_>>())
}

/// Of each junction: its rectangle, the lying and the upright channel.
fn junctions(channels: &[[f64; 4]]) -> Vec<([f64; 4], usize, usize)> {
    let corridors = corridors(channels).unwrap();
    let told = corridors.junctions().iter().map(|junction| {
        let Rect { x0, y0, x1, y1 } = junction.rect;
        ([x0, y0, x1, y1], junction.lying, junction.upright)
    });
    told.collect()
}

#[test]
fn junctions_of_a_chain_are_numbered_along_it() {
    let chain =
        [[0.0, 0.0, 3.0, 9.0], [0.0, 6.0, 12.0, 9.0], [9.0, 6.0, 12.0, 18.0], [9.0, 15.0, 20.0, 18.0]];
    let expected =
        vec![([0.0, 6.0, 3.0, 9.0], 2, 1), ([9.0, 6.0, 12.0, 9.0], 2, 3), ([9.0, 15.0, 12.0, 18.0], 4, 3)];
    assert_eq!(junctions(&chain), expected);
    let corridors = corridors(&chain).unwrap();
    assert_eq!(
        [1, 2, 3, 4].map(|channel| corridors.axis(channel).unwrap()),
        [Axis::Y, Axis::X, Axis::Y, Axis::X]
    );
    assert_eq!((corridors.axis(0), corridors.axis(5)), (None, None));
}

#[test]
fn channels_that_cross_or_end_in_each_other_are_joined() {
    let bar = [0.0, 6.0, 9.0, 9.0];
    let upright = |y0, y1| [3.0, y0, 5.0, y1];
    let across = ([3.0, 6.0, 5.0, 9.0], 1, 2);
    for (what, other) in [
        ("an X", upright(0.0, 12.0)),
        ("a T, flush", upright(0.0, 9.0)),
        ("a T, not flush", upright(0.0, 7.0)),
        ("a T from above", upright(7.0, 12.0)),
    ] {
        assert_eq!(junctions(&[bar, other]), [across], "{what}");
    }
    assert_eq!(junctions(&[[0.0, 0.0, 3.0, 8.0], bar]), [([0.0, 6.0, 3.0, 9.0], 2, 1)], "an L, not flush");
    assert_eq!(junctions(&[bar, upright(0.0, 6.0)]), [], "they only touch");
}

#[test]
fn rounding_in_written_coordinates_keeps_no_junction_apart() {
    let third = 0.1 + 0.2;
    assert!(third > 0.3);
    assert_eq!(junctions(&[[-4.0, 6.0, 0.3, 9.0], [0.0, 0.0, third, 8.0]]).len(), 1);
}

fn refusal(channels: &[[f64; 4]]) -> (CorridorError, String) {
    let error = corridors(channels).unwrap_err();
    let says = error.to_string();
    (error, says)
}

#[test]
fn overlaps_at_which_nobody_could_say_where_to_turn_are_refused() {
    let upright = [0.0, 0.0, 3.0, 9.0];
    for (other, expected) in [
        ([0.0, 8.0, 3.0, 15.0], Overlap::InLine),
        ([0.5, 8.0, 2.5, 15.0], Overlap::InLine),
        ([2.0, 0.0, 5.0, 9.0], Overlap::InLine),
        ([1.0, 6.0, 9.0, 11.0], Overlap::Corner),
        ([1.0, 6.0, 2.0, 8.0], Overlap::Within),
    ] {
        for pair in [[upright, other], [other, upright]] {
            let (error, says) = refusal(&pair);
            let CorridorError::NotOrthogonal { how, first: 1, second: 2, .. } = error else {
                panic!("{says}")
            };
            assert_eq!(how, expected, "{other:?}");
            assert!(says.starts_with("channels 1 and 2 overlap, but are not orthogonal: "), "{says}");
        }
    }
}

#[test]
fn what_is_no_channel_is_named_with_its_numbers() {
    assert_eq!(refusal(&[]).1, "there are no channels, expected at least one rectangle");
    let (_, says) = refusal(&[[0.0, 0.0, 3.0, 9.0], [4.0, 2.0, 4.0, 9.0]]);
    assert_eq!(says, "channel 2 is [4, 2, 4, 9], expected x0 < x1 and y0 < y1, all finite");
    for edge in 0..4 {
        let mut channel = [0.0, 0.0, 3.0, 9.0];
        channel[edge] = f64::NAN;
        assert!(matches!(refusal(&[channel]).0, CorridorError::NotARectangle { channel: 1, .. }));
        channel[edge] = f64::INFINITY;
        assert!(matches!(refusal(&[channel]).0, CorridorError::NotARectangle { channel: 1, .. }));
    }
}

#[test]
fn a_hall_that_is_upright_for_one_and_lying_for_another_is_refused() {
    let (_, says) = refusal(&[[0.0, 0.0, 6.0, 6.0], [2.0, 3.0, 4.0, 12.0], [3.0, 0.0, 12.0, 2.0]]);
    let expected = "channel 1 lies along x where it meets channel 2, but along y where it meets channel 3; give it as \
                    two channels";
    assert_eq!(says, expected);
}

#[test]
fn the_walls_of_an_l_are_its_outline() {
    let corridors = corridors(&[[0.0, 0.0, 3.0, 9.0], [0.0, 6.0, 9.0, 9.0]]).unwrap();
    let wall = |ax, ay, bx, by| Wall { a: Point::new(ax, ay), b: Point::new(bx, by) };
    let expected = [
        wall(0.0, 0.0, 0.0, 9.0),
        wall(3.0, 0.0, 3.0, 6.0),
        wall(9.0, 6.0, 9.0, 9.0),
        wall(0.0, 0.0, 3.0, 0.0),
        wall(3.0, 6.0, 9.0, 6.0),
        wall(0.0, 9.0, 9.0, 9.0),
    ];
    assert_eq!(corridors.walls(), expected);
}

#[test]
fn no_wall_stands_between_channels_side_by_side() {
    let corridors = corridors(&[[0.0, 0.0, 3.0, 9.0], [3.0, 0.0, 6.0, 9.0]]).unwrap();
    assert!(corridors.junctions().is_empty());
    assert_eq!(corridors.walls().len(), 4);
}

proptest! {
    /// Just beside each wall, one side is free and the other is not; and all of the outline is wall.
    #[test]
    fn walls_part_what_is_free_from_what_is_not(
        bands in prop::collection::vec((0_u8..2, 0_u8..12, 1_u8..3, 0_u8..12, 4_u8..12), 1..6),
    ) {
        let channel = |(axis, at, width, from, length): (u8, u8, u8, u8, u8)| {
            let [at, across, from, to] = [at, at + width, from, from + length].map(f64::from);
            if axis == 0 { Rect::new(at, from, across, to) } else { Rect::new(from, at, to, across) }
        };
        let channels: Vec<Rect> = bands.into_iter().map(channel).collect();
        let Ok(corridors) = Corridors::new(&channels) else { return Err(TestCaseError::reject("no corridors")) };
        let mut length = 0.0;
        let is_free = |x, y| channels.iter().any(|channel| channel.contains(Point::new(x, y)));
        for Wall { a, b } in corridors.walls() {
            length += a.distance(*b);
            let steps = (a.distance(*b) * 2.0).round() as usize;
            for step in 0..steps {
                let share = (step as f64 + 0.5) / steps as f64;
                let (x, y) = (a.x + share * (b.x - a.x), a.y + share * (b.y - a.y));
                let (dx, dy) = if b.x > a.x { (0.0, 1e-3) } else { (1e-3, 0.0) };
                prop_assert!(is_free(x - dx, y - dy) != is_free(x + dx, y + dy), "at {x}, {y}");
            }
        }
        // the outline, counted square by square
        let mut outline = 0.0;
        for x in -1..25 {
            for y in -1..25 {
                let (x, y) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
                outline += f64::from(u8::from(is_free(x, y) != is_free(x + 1.0, y)));
                outline += f64::from(u8::from(is_free(x, y) != is_free(x, y + 1.0)));
            }
        }
        prop_assert!((length - outline).abs() < 1e-9, "walls {length}, outline {outline}");
    }
}
