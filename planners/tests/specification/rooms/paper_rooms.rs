//! The rooms of the paper part the free space, and are chosen as the paper's steps say.

use adit_planners::geometry::Rect;
use adit_planners::prime_areas::maximal_rects;
use adit_planners::rooms::{LowBridge, Room, greedy_rooms, paper_rooms};
use proptest::prelude::*;

use crate::rooms::maps::{BOUNDS, Map, any_map, crowded_map};
use crate::rooms::oracle::{self, Cells};

/// Each free cell lies in exactly one room, of the height that is clear there; no blocked cell lies in any.
pub fn check_partition(map: &Map, rooms: &[Room]) -> Result<(), TestCaseError> {
    for cell in Cells::of(map).all() {
        let holding: Vec<_> = rooms.iter().filter(|room| room.rect.overlaps(&cell)).collect();
        if oracle::is_blocked(map, &cell) {
            prop_assert!(holding.is_empty(), "{cell:?} is blocked, but in {holding:?}");
            continue;
        }
        prop_assert_eq!(holding.len(), 1, "{:?} is in {:?}", cell, holding);
        prop_assert!(holding[0].rect.encloses(&cell), "{:?} sticks out of {:?}", cell, holding[0]);
        prop_assert_eq!(holding[0].height, oracle::height(map, &cell));
    }
    Ok(())
}

/// Prime areas, the open ones first.
fn lists(map: &Map, open_above: f64) -> (Vec<Rect>, Vec<Rect>) {
    maximal_rects(BOUNDS, &map.obstacles).into_iter().partition(|area| area.smaller_side() > open_above)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]

    #[test]
    fn they_part_the_free_space(map in any_map(), open_above in 0.0..6.0) {
        let (open, hard) = lists(&map, open_above);
        check_partition(&map, &paper_rooms(BOUNDS, &map.obstacles, &map.low, &open, &hard))?;
    }

    #[test]
    fn they_are_those_of_the_papers_steps(map in any_map(), open_above in 0.0..6.0) {
        let (open, hard) = lists(&map, open_above);
        let rooms = paper_rooms(BOUNDS, &map.obstacles, &map.low, &open, &hard);
        let is_low = |room: &&Room| room.height.is_some();
        let first: Vec<_> = rooms.iter().take_while(is_low).map(|room| room.rect).collect();
        let chosen: Vec<_> = rooms.iter().skip_while(is_low).map(|room| room.rect).collect();
        prop_assert_eq!(chosen, oracle::paper_steps(&first, [open, hard]));
    }

    #[test]
    fn the_order_of_obstacles_does_not_count(map in any_map()) {
        let mut turned = map.clone();
        turned.obstacles.reverse();
        let rooms = |map: &Map| {
            let (open, hard) = lists(map, 2.0);
            paper_rooms(BOUNDS, &map.obstacles, &map.low, &open, &hard)
        };
        prop_assert_eq!(rooms(&map), rooms(&turned));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn crowded_maps_are_parted_as_the_papers_steps_say(map in crowded_map(), open_above in 0.0..2.0) {
        let (open, hard) = lists(&map, open_above);
        let rooms = paper_rooms(BOUNDS, &map.obstacles, &map.low, &open, &hard);
        check_partition(&map, &rooms)?;
        let chosen: Vec<_> = rooms.iter().map(|room| room.rect).collect();
        prop_assert_eq!(chosen, oracle::paper_steps(&[], [open, hard]));
    }
}

#[test]
fn rooms_under_bridges_come_in_the_order_of_the_map() {
    let low = [(5.0, 3.0), (1.0, 4.0)]
        .map(|(x, height)| LowBridge { rect: Rect::new(x, 0.0, x + 1.0, 9.0), height });
    let rooms = paper_rooms(BOUNDS, &[], &low, &[BOUNDS], &[]);
    let found: Vec<_> = rooms.iter().map(|room| (room.rect.x0, room.height)).collect();
    assert_eq!(found, [(5.0, Some(3.0)), (1.0, Some(4.0)), (6.0, None), (2.0, None), (0.0, None)]);
}

#[test]
fn where_bridges_overlap_the_lower_one_limits_and_an_obstacle_wins_over_both() {
    let low = [(0.0, 6.0, 4.0), (4.0, 12.0, 2.0)]
        .map(|(x0, x1, height)| LowBridge { rect: Rect::new(x0, 0.0, x1, 9.0), height });
    let wall = Rect::new(8.0, 0.0, 9.0, 9.0);
    let rooms = paper_rooms(BOUNDS, &[wall], &low, &[], &[]);
    let found: Vec<_> = rooms.iter().map(|room| (room.rect.x0, room.rect.x1, room.height)).collect();
    assert_eq!(found, [(0.0, 4.0, Some(4.0)), (4.0, 8.0, Some(2.0)), (9.0, 12.0, Some(2.0))]);
}

#[test]
fn open_areas_are_used_up_before_larger_hard_ones() {
    let (open, hard) = (Rect::new(0.0, 0.0, 2.0, 2.0), Rect::new(0.0, 1.0, 9.0, 2.0));
    assert_eq!(greedy_rooms(&[], &[&[open], &[hard]]), [open, Rect::new(2.0, 1.0, 9.0, 2.0)]);
}

#[test]
fn areas_that_differ_by_rounding_only_are_equal() {
    // 0.3 - 0.1 is a little less than 0.2: the first room by (x0, y0) is the one further left all the same.
    let (left, right) = (Rect::new(0.1, 0.0, 0.3, 1.0), Rect::new(5.0, 0.0, 5.2, 1.0));
    assert!(left.area() < right.area());
    assert_eq!(greedy_rooms(&[], &[&[right, left]]), [left, right]);
}
