//! The paper's choice of rooms: always the largest area that is left.
//!
//! What the paper does to its lists after each room (subtract it, drop what lies inside another) leaves on a list
//! the maximal ones of all rectangles that lie inside one of the list's first areas and meet no room. So
//! an area need be cut only when it comes to be the largest, by all rooms that it meets by then: its parts are
//! smaller and wait for their turn. Parts inside other parts do no harm, since the outer one comes first.

use crate::geometry::Rect;
use crate::strips::{Block, Strips};

use super::cutter::Cutter;
use super::queue::{Candidate, LargestFirst};
use super::taken::{Seen, Taken};

/// The rooms that the paper's steps 2 to 4 make, in the order in which they are made.
///
/// # Arguments
/// - `first`: disjoint rooms that exist already (the paper's list 1); they are not returned.
/// - `lists`: areas, one list to be used up after the other (the paper's lists 2 and 3). Metres.
///
/// # Returns
/// Disjoint rectangles that, with `first`, cover all areas. Equal areas: the one whose (x0, y0, x1, y1) comes
/// first; areas that differ by rounding only (1e-12 of their size) are equal.
///
/// # Complexity
/// O(c log c) for c parts of areas that come to be the largest; in maps with obstacles in general position c is
/// a small multiple of the number of areas.
///
/// # Example
/// ```
/// use adit_planners::{geometry::Rect, rooms::greedy_rooms};
/// let (flat, tall) = (Rect::new(0.0, 0.0, 5.0, 2.0), Rect::new(0.0, 0.0, 2.0, 4.0));
/// assert_eq!(greedy_rooms(&[], &[&[tall, flat]]), [flat, Rect::new(0.0, 2.0, 2.0, 4.0)]);
/// ```
pub fn greedy_rooms(first: &[Rect], lists: &[&[Rect]]) -> Vec<Rect> {
    let has_area = |rect: &&Rect| rect.intersection(rect).is_some();
    let all = || first.iter().chain(lists.iter().copied().flatten()).filter(has_area).copied();
    let (strips, blocks) = Strips::with_blocks(Rect::around(all().flat_map(|rect| rect.corners())), all());
    let mut greedy = Greedy::new(&strips, blocks.len());
    let mut blocks = blocks.into_iter();
    let with_area = |rects: &[Rect]| rects.iter().filter(has_area).count();
    for block in blocks.by_ref().take(with_area(first)) {
        greedy.taken.take(block);
    }
    for list in lists {
        greedy.use_up(blocks.by_ref().take(with_area(list)));
    }
    greedy.rooms.into_iter().map(|room| strips.rect(room)).collect()
}

struct Greedy<'a> {
    strips: &'a Strips,
    taken: Taken,
    rooms: Vec<Block>,
    waiting: LargestFirst,
    cutter: Cutter,
}

impl<'a> Greedy<'a> {
    fn new(strips: &'a Strips, expected: usize) -> Self {
        Self {
            strips,
            taken: Taken::new(strips.columns(), strips.rows(), expected),
            rooms: Vec::new(),
            waiting: LargestFirst::default(),
            cutter: Cutter::new(),
        }
    }

    fn use_up(&mut self, list: impl Iterator<Item = Block>) {
        let areas = list.map(|block| Candidate::new(self.strips, block, Seen::default())).collect();
        self.waiting.fill(areas);
        let mut met = Vec::new();
        let mut previous = None;
        while let Some(candidate) = self.waiting.pop() {
            let block = candidate.block();
            // Equal areas come one after the other: what could still make this one is larger.
            if previous.replace(block) == Some(block) {
                continue;
            }
            self.taken.overlapping(block, candidate.seen, &mut met);
            if met.is_empty() {
                self.taken.take(block);
                self.rooms.push(block);
            } else {
                let (strips, waiting, seen) = (self.strips, &mut self.waiting, self.taken.seen());
                self.cutter.cut(block, &met, |part| waiting.push(Candidate::new(strips, part, seen)));
            }
        }
    }
}
