//! What is not channel.

use super::Cuboid;

/// Everything below the mouth that lies in no channel, as disjoint boxes that reach to infinity where nothing
/// stops them. Above the top of the first channel all is open.
pub(super) fn walls<const D: usize>(channels: &[Cuboid<D>]) -> Vec<Cuboid<D>> {
    let mut ground = Cuboid::new([f64::NEG_INFINITY; D], [f64::INFINITY; D]);
    ground.max[D - 1] = channels.first().map_or(f64::NEG_INFINITY, |first| first.max[D - 1]);
    let mut walls = vec![ground];
    for channel in channels {
        walls = walls.iter().flat_map(|wall| without(wall, channel)).collect();
    }
    for axis in (0..D).rev() {
        merge_along(axis, &mut walls);
    }
    walls
}

/// What is left of a box when a channel is cut out of it.
fn without<const D: usize>(wall: &Cuboid<D>, channel: &Cuboid<D>) -> Vec<Cuboid<D>> {
    let Some(common) = wall.intersection(channel) else { return vec![*wall] };
    let mut rest = *wall;
    let mut pieces = Vec::new();
    for axis in 0..D {
        let (mut below, mut above) = (rest, rest);
        below.max[axis] = common.min[axis];
        above.min[axis] = common.max[axis];
        pieces.extend([below, above].into_iter().filter(Cuboid::is_solid));
        rest.min[axis] = common.min[axis];
        rest.max[axis] = common.max[axis];
    }
    pieces
}

/// Joins boxes that follow each other along an axis and are alike along all others.
fn merge_along<const D: usize>(axis: usize, walls: &mut Vec<Cuboid<D>>) {
    let across = |wall: &Cuboid<D>| -> [(f64, f64); D] {
        std::array::from_fn(|k| if k == axis { (0.0, 0.0) } else { (wall.min[k], wall.max[k]) })
    };
    walls.sort_unstable_by(|a, b| {
        let order = across(a).partial_cmp(&across(b)).expect("channels are finite, so no wall has a NaN");
        order.then(a.min[axis].total_cmp(&b.min[axis]))
    });
    walls.dedup_by(|next, wall| {
        // Disjoint boxes that are alike across abut where the one ends as the other starts: no rounding here.
        let follows = across(next) == across(wall) && next.min[axis] <= wall.max[axis];
        if follows {
            wall.max[axis] = next.max[axis];
        }
        follows
    });
}
