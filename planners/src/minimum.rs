//! As few rooms as possible: condition (2) of Abou-Ali et al., "Rooms generation", which their own steps miss.
//!
//! A region of upright walls falls into the fewest rectangles when it is cut along a largest set of chords between
//! concave corners that do not meet, and then once at each concave corner left (Lipski et al. 1979; Ohtsuki 1982;
//! Ferrari, Sankar and Sklansky 1984). Chords across and upright ones that meet form a bipartite graph, of which a
//! largest independent set follows from a largest matching.

mod chords;
mod corners;
mod faces;
mod matching;
mod planner;

use std::cmp::Reverse;

use crate::geometry::Rect;
use crate::rooms::{LowBridge, Room, area_key, cut_low_bridges};
use crate::strips::{Block, Strips};

pub use planner::MinimumRooms;

/// The fewest disjoint rectangles whose union is `bounds` without `blocked`; the largest first, equal ones by
/// (x0, y0). What is blocked may overlap, touch, stick out or be flat.
///
/// Complexity: O((n + k) log n + k sqrt(n)) for n rectangles blocked and k places where chords meet.
///
/// # Example
/// ```
/// use adit_planners::{geometry::Rect, minimum::fewest_rects};
/// let hall = Rect::new(0.0, 0.0, 5.0, 5.0);
/// assert_eq!(fewest_rects(hall, &[Rect::new(2.0, 2.0, 3.0, 3.0)]).len(), 4);
/// ```
pub fn fewest_rects(bounds: Rect, blocked: &[Rect]) -> Vec<Rect> {
    let (strips, blocks) = Strips::with_blocks(bounds, blocked.iter().copied());
    let (columns, rows) = (strips.columns(), strips.rows());
    if columns == 0 || rows == 0 {
        return Vec::new();
    }
    let turned: Vec<_> = blocks.iter().map(Block::transposed).collect();
    let corners = corners::concave_corners(columns, rows, &blocks);
    let across = chords::chords(&corners);
    let upright = chords::chords(&corners::concave_corners(rows, columns, &turned));
    let chosen = chords::largest_choice(&across, &upright);
    let faces = faces::faces(columns, rows, &blocks, &corners, &chosen);
    let mut rects: Vec<_> = faces.into_iter().map(|face| strips.rect(face)).collect();
    rects.sort_by(|a, b| {
        let size = Reverse(area_key(a.area())).cmp(&Reverse(area_key(b.area())));
        size.then(a.x0.total_cmp(&b.x0)).then(a.y0.total_cmp(&b.y0))
    });
    rects
}

/// The rooms under low bridges in the order of the bridges, then the fewest rooms that cover what else is free.
///
/// # Arguments
/// - `solid`: what no state passes; `low`: bridges too low for the tallest state. Metres.
pub fn fewest_rooms(bounds: Rect, solid: &[Rect], low: &[LowBridge]) -> Vec<Room> {
    let mut rooms = cut_low_bridges(bounds, solid, low, fewest_rects);
    let blocked: Vec<_> = solid.iter().copied().chain(low.iter().map(|bridge| bridge.rect)).collect();
    let open = fewest_rects(bounds, &blocked);
    rooms.extend(open.into_iter().map(|rect| Room { rect, height: None }));
    rooms
}
