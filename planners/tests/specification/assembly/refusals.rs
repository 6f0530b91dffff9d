//! What is wrong with channels, parts and outlines is said with numbers and coordinates.

use adit_planners::channels::assembly::{Assembly, Cuboid, bounding_box};

fn cuboid([x0, z0, x1, z1]: [f64; 4]) -> Cuboid<2> {
    Cuboid::new([x0, z0], [x1, z1])
}

fn chain(channels: &[[f64; 4]], part: [f64; 4]) -> Result<Vec<usize>, String> {
    let channels = channels.iter().copied().map(cuboid).collect();
    Assembly::new(channels, cuboid(part)).map(|it| it.axes().to_vec()).map_err(|error| error.to_string())
}

const SHAFT: [f64; 4] = [1.0, 2.0, 5.0, 7.0];
const PART: [f64; 4] = [2.0, 3.0, 3.0, 4.0];

#[test]
fn channels_that_make_no_chain_are_refused() {
    let refused = |channels: &[[f64; 4]], part| chain(channels, part).unwrap_err();
    assert_eq!(refused(&[], PART), "no channel is given; the first one leads out along +z");
    assert_eq!(
        refused(&[SHAFT, [1.0, 6.0, 7.0, 2.0]], PART),
        "channel 2 is [1, 6, 7, 2]; expected finite numbers, each minimum below its maximum"
    );
    assert!(refused(&[[f64::NAN, 2.0, 5.0, 7.0]], PART).starts_with("channel 1 is [NaN, 2, 5, 7]"));
    assert_eq!(
        refused(&[SHAFT], [2.0, 3.0, 2.0, 4.0]),
        "the part is [2, 3, 2, 4]; expected finite numbers, each minimum below its maximum"
    );
    assert_eq!(
        refused(&[SHAFT, [1.0, 2.0, 9.0, 7.5]], PART),
        "channel 2 reaches up to z = 7.5, above channel 1, which leads out and ends at 7"
    );
    assert_eq!(
        refused(&[SHAFT, [5.0, 2.0, 9.0, 6.0]], PART),
        "channel 1 [1, 2, 5, 7] and channel 2 [5, 2, 9, 6] do not overlap, so there is no junction"
    );
}

#[test]
fn numbers_beyond_all_measure_are_refused_without_a_panic() {
    let most = f64::MAX;
    assert!(chain(&[[-most, -most, most, most], [1.0, 2.0, 9.0, 6.0]], PART).is_err());
    assert!(chain(&[SHAFT, [-most, 2.0, most, 6.0]], [7.0, 3.0, 8.0, 4.0]).is_err());
    assert!(chain(&[SHAFT], [f64::NEG_INFINITY, 3.0, 3.0, 4.0]).is_err());
}

#[test]
fn neighbours_are_orthogonal() {
    let in_line = [1.0, 0.0, 5.0, 3.0];
    let text = chain(&[SHAFT, in_line], PART).unwrap_err();
    assert_eq!(
        text,
        "channel 1 [1, 2, 5, 7] and channel 2 [1, 0, 5, 3] share [1, 2, 5, 3], which is neither an L nor a T: each \
         must go on from there along an axis of its own, and one must span the other"
    );
    for (channel, what) in [
        ([4.0, 0.0, 9.0, 3.0], "a common corner only"),
        ([2.0, 3.0, 4.0, 6.0], "one within the other"),
        ([0.5, -9.0, 5.5, 3.0], "in line, if a little wider"),
    ] {
        let text = chain(&[SHAFT, channel], PART).unwrap_err();
        assert!(text.contains("neither an L nor a T"), "{what}: {text}");
    }
}

#[test]
fn whoever_sees_an_l_or_a_t_gets_one() {
    for (channel, part, what) in [
        ([1.0, 2.0, 9.0, 6.0], [7.0, 3.0, 8.0, 4.0], "an L"),
        ([-4.0, 2.0, 9.0, 6.0], [7.0, 3.0, 8.0, 4.0], "a T, its bar below"),
        ([-4.0, 0.0, 9.0, 4.0], [7.0, 1.0, 8.0, 2.0], "a T whose stem ends halfway through the bar"),
        ([1.1, 1.9, 9.0, 6.0], [7.0, 3.0, 8.0, 4.0], "an L with corners that do not quite meet"),
        ([-4.0, 3.0, 9.0, 6.0], [7.0, 3.5, 8.0, 4.0], "a cross"),
    ] {
        assert_eq!(chain(&[SHAFT, channel], part), Ok(vec![1, 0]), "{what}");
    }
}

#[test]
fn the_part_is_in_the_last_channel_and_may_touch_it() {
    let channels = [SHAFT, [1.0, 2.0, 9.0, 6.0]];
    assert_eq!(
        chain(&channels, [2.0, 5.0, 3.0, 6.5]).unwrap_err(),
        "the part [2, 5, 3, 6.5] sticks out of channel 2 [1, 2, 9, 6], the last one, by 0.5; it lies in channel 1"
    );
    let text = chain(&channels, [7.0, 5.0, 8.0, 6.5]).unwrap_err();
    assert!(text.ends_with("by 0.5; it lies in none"), "{text}");
    assert_eq!(chain(&channels, [7.0, 2.0, 9.0, 6.0]), Ok(vec![1, 0]));
}

#[test]
fn outlines_that_cross_or_touch_themselves_are_refused() {
    let bow_tie = [[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]];
    assert_eq!(
        bounding_box(&bow_tie).unwrap_err().to_string(),
        "the outline crosses or touches itself at (2, 2): the edge from corner 1 (0, 0) to corner 2 (4, 4) and the \
         edge from corner 3 (4, 0) to corner 4 (0, 4)"
    );
    let spike = [[0.0, 0.0], [4.0, 0.0], [2.0, 0.0], [2.0, 3.0]];
    assert!(
        bounding_box(&spike).unwrap_err().to_string().contains("from corner 1 (0, 0) to corner 2 (4, 0)")
    );
    let pinched = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]];
    assert!(bounding_box(&pinched).unwrap_err().to_string().contains("touches itself at (2, 0)"));
    assert_eq!(
        bounding_box(&[[0.0, 0.0], [1.0, 1.0], [0.0, 0.0]]).unwrap_err().to_string(),
        "the outline has 2 distinct corners; expected at least 3"
    );
    assert_eq!(
        bounding_box(&[[0.0, 0.0], [1.0, f64::INFINITY], [0.0, 1.0]]).unwrap_err().to_string(),
        "corner 2 is (1, inf); expected finite numbers"
    );
    let closed = [[0.0, 0.0], [4.0, 1.0], [4.0, 1.0], [2.0, 5.0], [0.0, 0.0]];
    assert_eq!(bounding_box(&closed), Ok(cuboid([0.0, 0.0, 4.0, 5.0])));
}
