//! Channels found from the outlines of female parts.

#[allow(dead_code, reason = "which gaps are kept matters to ways, not to channels")]
use adit_planners::channels::assembly::{Assembly, Cuboid, FemaleError, channels_of};
use geo::{BooleanOps, Coord, Rect, unary_union};
use proptest::prelude::*;

use super::chains::chains;

fn cuboid([x0, z0, x1, z1]: [f64; 4]) -> Cuboid<2> {
    Cuboid::new([x0, z0], [x1, z1])
}

/// A cup: walls 1 m thick, 6 m deep, its mouth from x = 1 to 5.
const CUP: [[f64; 2]; 8] =
    [[0.0, 0.0], [6.0, 0.0], [6.0, 7.0], [5.0, 7.0], [5.0, 1.0], [1.0, 1.0], [1.0, 7.0], [0.0, 7.0]];

fn refused(female: &[[f64; 2]], part: [f64; 4]) -> String {
    channels_of(female, &cuboid(part)).unwrap_err().to_string()
}

#[test]
fn a_cup_is_one_channel() {
    let found = channels_of(&CUP, &cuboid([2.0, 1.0, 3.0, 2.0])).unwrap();
    assert_eq!(found, [cuboid([1.0, 1.0, 5.0, 7.0])]);
    // A peg with a head above the rim: the free space reaches up to its top.
    let found = channels_of(&CUP, &cuboid([2.0, 1.0, 3.0, 9.0])).unwrap();
    assert_eq!(found, [cuboid([1.0, 1.0, 5.0, 9.0])]);
}

#[test]
fn coordinates_that_rounding_moved_slope_nothing() {
    let turned = CUP.map(|[x, z]| [x + 1e-13 * z, z - 1e-13 * x]);
    let found = channels_of(&turned, &cuboid([2.0, 1.1, 3.0, 2.0])).unwrap();
    assert_eq!(found.len(), 1);
}

#[test]
fn a_chamfer_costs_only_the_box_around_it() {
    let mut chamfered = CUP.to_vec();
    chamfered.splice(3..4, [[5.5, 7.0], [5.0, 6.0]]);
    let found = channels_of(&chamfered, &cuboid([2.0, 1.1, 3.0, 2.0])).unwrap();
    assert_eq!(found, [cuboid([1.0, 1.0, 5.0, 7.0])]);
}

#[test]
fn a_slope_across_the_way_is_named() {
    let slanted =
        [[0.0, 0.0], [6.0, 0.0], [6.0, 7.0], [5.0, 7.0], [2.0, 1.0], [1.0, 1.0], [1.0, 7.0], [0.0, 7.0]];
    assert_eq!(
        refused(&slanted, [1.5, 3.0, 2.5, 4.0]),
        "the free space cannot be modelled by channels, which are rectangles along the axes: the edge from corner 4 \
         (5, 7) to corner 5 (2, 1) is sloped, and what lies in the box around it is taken for wall; without it the \
         part [1.5, 3, 2.5, 4] has no place"
    );
    // A bulge of the cavity, shut off by two slopes that leave nothing beside their boxes.
    let bottle = [
        [0.0, 0.0],
        [9.0, 0.0],
        [9.0, 9.0],
        [6.0, 9.0],
        [3.0, 6.0],
        [8.0, 5.0],
        [8.0, 1.0],
        [1.0, 1.0],
        [1.0, 5.0],
        [2.0, 6.5],
        [5.0, 9.0],
        [0.0, 9.0],
    ];
    let text = refused(&bottle, [4.0, 2.0, 5.0, 3.0]);
    assert!(text.contains("is sloped") && text.ends_with("gets up to z = 6.5 only"), "{text}");
}

#[test]
fn a_part_that_is_not_in_the_cavity_is_refused() {
    assert_eq!(
        refused(&CUP, [4.5, 2.0, 5.5, 3.0]),
        "the part [4.5, 2, 5.5, 3] and the female part overlap: [5, 1, 6, 7] is solid"
    );
    assert_eq!(
        refused(&CUP, [-1.0, 2.0, 0.5, 3.0]),
        "the part [-1, 2, 0.5, 3] sticks out of the box [0, 0, 6, 7] around the female part, to a side or below"
    );
    assert_eq!(
        refused(&CUP, [2.0, 7.0, 3.0, 8.0]),
        "the part [2, 7, 3, 8] is above the female part, which ends at z = 7: it is disassembled"
    );
    assert!(refused(&CUP, [2.0, 3.0, 2.0, 4.0]).starts_with("the part is [2, 3, 2, 4]; expected"));
}

#[test]
fn a_cavity_that_does_not_open_upwards_is_refused() {
    let cave =
        [[0.0, 0.0], [6.0, 0.0], [6.0, 2.0], [2.0, 2.0], [2.0, 4.0], [6.0, 4.0], [6.0, 7.0], [0.0, 7.0]];
    assert_eq!(
        refused(&cave, [3.0, 2.5, 4.0, 3.5]),
        "the free space around the part [3, 2.5, 4, 3.5] is closed: it reaches up to z = 4, the female part to 7, and \
         a way out leads along +z"
    );
}

/// Section 4 with a tunnel off the bottom of the pit: straight down past the step it is 1 m wide.
#[test]
fn of_two_ways_the_one_that_the_part_fits_through_is_taken_and_else_the_one_with_fewer_channels() {
    let female = [
        [0.0, 0.0],
        [0.0, 7.0],
        [1.0, 7.0],
        [1.0, 2.0],
        [4.0, 2.0],
        [4.0, 1.0],
        [9.0, 1.0],
        [9.0, 2.0],
        [7.0, 2.0],
        [7.0, 6.0],
        [5.0, 6.0],
        [5.0, 7.0],
        [10.0, 7.0],
        [10.0, 0.0],
    ];
    let tunnel = cuboid([4.0, 1.0, 9.0, 2.0]);
    let slim = channels_of(&female, &cuboid([7.6, 1.1, 8.4, 1.9])).unwrap();
    assert_eq!(slim, [cuboid([4.0, 1.0, 5.0, 7.0]), tunnel]);
    let wide = channels_of(&female, &cuboid([7.1, 1.1, 8.9, 1.9])).unwrap();
    let around = [[1.0, 2.0, 5.0, 7.0], [1.0, 2.0, 7.0, 6.0], [4.0, 1.0, 7.0, 6.0]].map(cuboid);
    assert_eq!(wide, [around.as_slice(), &[tunnel]].concat());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// A block with a random chain cut out of it has a way out that the part fits through, whatever the
    /// rectangles that are found.
    #[test]
    fn where_a_chain_was_cut_out_a_chain_is_found(chain in chains::<2>(1..7)) {
        let hull = chain.channels.iter().fold(chain.part, |hull, channel| hull.joined(channel));
        let polygon = |cuboid: &Cuboid<2>| Rect::new(Coord::from(cuboid.min), Coord::from(cuboid.max)).to_polygon();
        let mut block = hull;
        block.min = block.min.map(|low| low - 1.0);
        block.max[0] += 1.0;
        let cavity = unary_union(&chain.channels.iter().map(polygon).collect::<Vec<_>>());
        let rest = polygon(&block).difference(&cavity);
        // Where channels cross, the rest may come in pieces: that is no outline.
        prop_assume!(rest.0.len() == 1 && rest.0[0].interiors().is_empty());
        let outline: Vec<[f64; 2]> = rest.0[0].exterior().coords().map(|corner| [corner.x, corner.y]).collect();
        let found = match channels_of(&outline, &chain.part) {
            // Pieces that touch at a corner.
            Err(FemaleError::Outline(_)) => return Err(TestCaseError::reject("no outline")),
            found => found.unwrap(),
        };
        prop_assert!(found.len() <= chain.channels.len());
        let assembly = Assembly::new(found, chain.part).unwrap();
        for junction in assembly.junctions() {
            prop_assert!((0..2).all(|axis| junction.size(axis) > chain.part.size(axis)));
        }
    }

    /// Corners on a coarse grid, so that edges cross, touch, double back and slope; now and then one far away.
    #[test]
    fn whatever_the_outline_an_answer_is_a_chain_and_a_refusal_says_why(
        corners in prop::collection::vec((0_i8..8, 0_i8..8), 0..9),
        huge in prop::option::weighted(0.1, 0_usize..9),
        straight in any::<bool>(),
        (x, z, dx, dz) in (0_i8..16, 0_i8..16, 0_i8..4, 0_i8..4),
    ) {
        let mut outline: Vec<[f64; 2]> = corners.iter().map(|&(x, z)| [x.into(), z.into()]).collect();
        if let Some(corner) = huge.and_then(|index| outline.get_mut(index)) {
            corner[0] = f64::MAX;
        }
        if straight {
            // Each slope becomes a step.
            outline = outline.iter().zip(outline.iter().cycle().skip(1)).flat_map(|(a, b)| [*a, [b[0], a[1]]]).collect();
        }
        let (x, z) = (f64::from(x) / 2.0, f64::from(z) / 2.0);
        let part = Cuboid::new([x, z], [x + f64::from(dx) / 4.0, z + f64::from(dz) / 4.0]);
        match channels_of(&outline, &part) {
            Ok(channels) => prop_assert!(Assembly::new(channels, part).is_ok()),
            Err(error) => prop_assert!(error.to_string().len() > 20),
        }
    }
}
