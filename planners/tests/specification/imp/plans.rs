//! Three floor plans, and tours through all of their rooms.

use adit_planners::geometry::{Point, Segment};
use serde::Deserialize;

#[derive(Deserialize)]
pub struct Plan {
    pub name: String,
    walls: Vec<[f64; 4]>,
    rooms: Vec<[f64; 2]>,
    doors: Vec<Door>,
}

#[derive(Deserialize)]
struct Door {
    rooms: [usize; 2],
    at: [f64; 4],
}

pub fn all() -> Vec<Plan> {
    serde_json::from_str(include_str!("../../golden/floor-plans.json")).unwrap()
}

pub fn segment([x0, y0, x1, y1]: [f64; 4]) -> Segment {
    Segment::new(Point::new(x0, y0), Point::new(x1, y1))
}

impl Plan {
    pub fn walls(&self) -> Vec<Segment> {
        self.walls.iter().copied().map(segment).collect()
    }

    /// From the first room through all others and back, through the middles of rooms and doors.
    pub fn tour(&self) -> Vec<Point> {
        let mut seen = vec![false; self.rooms.len()];
        let mut stops = Vec::new();
        self.visit(0, &mut seen, &mut stops);
        stops
    }

    fn visit(&self, room: usize, seen: &mut [bool], stops: &mut Vec<Point>) {
        let middle = |room: usize| Point::new(self.rooms[room][0], self.rooms[room][1]);
        seen[room] = true;
        stops.push(middle(room));
        for door in self.doors.iter().filter(|door| door.rooms.contains(&room)) {
            let next = if door.rooms[0] == room { door.rooms[1] } else { door.rooms[0] };
            if !seen[next] {
                let (here, there) = sides(&segment(door.at), middle(room));
                stops.extend([here, there]);
                self.visit(next, seen, stops);
                stops.extend([there, here, middle(room)]);
            }
        }
    }
}

/// Half a metre before a door and behind it.
fn sides(door: &Segment, before: Point) -> (Point, Point) {
    let (middle, along) = (door.middle(), door.direction());
    let side = |far: f64| Point::new(middle.x - far * along.y, middle.y + far * along.x);
    let (one, other) = (side(0.5), side(-0.5));
    let is_left = along.x * (before.y - middle.y) - along.y * (before.x - middle.x) > 0.0;
    if is_left { (one, other) } else { (other, one) }
}
