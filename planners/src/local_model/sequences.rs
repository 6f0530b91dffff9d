//! Connected sequences: ends of segments that meet.

use super::{ModelSegment, SegmentId, Settings};
use crate::geometry::{Point, Segment};

/// Joins the ends of segments that changed to the nearest ends of others, and lets them meet in a corner where both may
/// be moved. `near` are the places of segments that may be joined to, in ascending order.
pub(super) fn join(segments: &mut [ModelSegment], changed: &[usize], near: &[usize], settings: &Settings) {
    // side by side in memory, since all are looked at for each end that changed
    let mut tips: Vec<[Point; 2]> = near.iter().map(|&place| ends(&segments[place])).collect();
    for &one in changed {
        for end in [0, 1] {
            part(segments, one, end);
            let at = ends(&segments[one])[end];
            let others = near.iter().zip(&tips).filter(|(other, _)| **other != one);
            let far = others
                .flat_map(|(&other, tips)| [0, 1].map(|side| (tips[side].squared_distance(at), other, side)));
            let close = far.filter(|(far, ..)| *far <= settings.join_m.powi(2));
            let best = close.min_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
            if let Some((_, other, side)) = best {
                part(segments, other, side);
                segments[one].joins[end] = Some(segments[other].id);
                segments[other].joins[side] = Some(segments[one].id);
                meet(segments, (one, end), (other, side), settings);
                for moved in [one, other] {
                    if let Ok(index) = near.binary_search(&moved) {
                        tips[index] = ends(&segments[moved]);
                    }
                }
            }
        }
    }
}

/// Takes a joint apart from both sides.
fn part(segments: &mut [ModelSegment], one: usize, end: usize) {
    let id = segments[one].id;
    if let Some(joined) = segments[one].joins[end].take()
        && let Some(other) =
            segments.binary_search_by_key(&joined, |segment| segment.id).ok().map(|at| &mut segments[at])
    {
        for side in other.joins.iter_mut().filter(|side| **side == Some(id)) {
            *side = None;
        }
    }
}

pub(super) fn forget(segments: &mut [ModelSegment], gone: &[SegmentId]) {
    if gone.is_empty() {
        return;
    }
    for side in segments.iter_mut().flat_map(|segment| segment.joins.iter_mut()) {
        if side.is_some_and(|id| gone.contains(&id)) {
            *side = None;
        }
    }
}

fn ends(segment: &ModelSegment) -> [Point; 2] {
    [segment.line.a, segment.line.b]
}

fn meet(
    segments: &mut [ModelSegment],
    (one, end): (usize, usize),
    (other, side): (usize, usize),
    settings: &Settings,
) {
    let (p, q) = (segments[one].line, segments[other].line);
    let (along, across) = (p.direction(), q.direction());
    let cross = along.cross(across);
    // lines that differ by less than 6 degrees meet anywhere
    if cross.abs() < 0.1 {
        return;
    }
    let far = (q.a - p.a).cross(across) / cross;
    let corner = p.a + along * far;
    for (segment, end) in [(one, end), (other, side)] {
        let is_close = ends(&segments[segment])[end].distance(corner) <= settings.join_m;
        if segments[segment].is_anchored || !is_close {
            continue;
        }
        let line = segments[segment].line;
        let met = if end == 0 { Segment::new(corner, line.b) } else { Segment::new(line.a, corner) };
        // both ends of a short one may be near corners: it would be no line any more, and match whatever is seen
        if (met.b - met.a).dot(line.direction()) >= settings.shortest_m.min(line.length()) {
            segments[segment].line = met;
        }
    }
}
