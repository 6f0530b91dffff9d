//! Walls for measurements: how many there are is what is varied.

use adit_planners::geometry::{Point, Segment};

/// Rooms of 5 m by 5 m with a door of 1 m in the middle of each wall, in a spiral about the first until there are so many
/// walls: six of a room are its own.
pub fn building(count: usize) -> Vec<Segment> {
    let mut rooms: Vec<(i32, i32)> = (-20..=20).flat_map(|x| (-20..=20).map(move |y| (x, y))).collect();
    rooms.sort_by_key(|(x, y)| (x.abs().max(y.abs()), *x, *y));
    let mut walls = Vec::new();
    for (x, y) in rooms {
        let (x, y) = (5.0 * f64::from(x), 5.0 * f64::from(y));
        let wall = |x0: f64, y0: f64, x1: f64, y1: f64| {
            Segment::new(Point::new(x + x0, y + y0), Point::new(x + x1, y + y1))
        };
        walls.extend([wall(0.0, 0.0, 2.0, 0.0), wall(3.0, 0.0, 5.0, 0.0)]);
        walls.extend([wall(0.0, 0.0, 0.0, 2.0), wall(0.0, 3.0, 0.0, 5.0)]);
        // a cupboard's front and side
        walls.extend([wall(4.0, 4.0, 4.0, 5.0), wall(4.0, 4.0, 5.0, 4.0)]);
    }
    walls.truncate(count);
    walls
}

/// So many walls about the robot, in rings of fifty, that all of them are within hearing.
pub fn within_hearing(count: usize) -> Vec<Segment> {
    let ring = |i: usize| {
        let (layer, place) = (i / 50, i % 50);
        let radius = 2.0 + 0.08 * layer as f64;
        let angle = |part: f64| (place as f64 + part) / 50.0 * std::f64::consts::TAU;
        let at = |part: f64| Point::new(1.5 + radius * angle(part).cos(), 1.7 + radius * angle(part).sin());
        Segment::new(at(0.1), at(0.9))
    };
    (0..count).map(ring).collect()
}
