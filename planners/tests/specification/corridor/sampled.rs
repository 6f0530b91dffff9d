//! A judge of drives by means of its own: robots drawn at many moments, the solid cells between the channels' edges, and
//! separating axes.

use adit_planners::channels::corridor::{Primitive, Robot};
use adit_planners::geometry::{Point, Rect};

/// What is not in any channel, in rectangles; far enough around that no robot of the tests leaves it.
pub fn solid(channels: &[Rect]) -> Vec<Rect> {
    let edges = |of: fn(&Rect) -> [f64; 2]| {
        let mut edges: Vec<f64> = channels.iter().flat_map(of).collect();
        edges.sort_by(f64::total_cmp);
        edges.dedup();
        edges.insert(0, edges[0] - 100.0);
        edges.push(edges[edges.len() - 1] + 100.0);
        edges
    };
    let (xs, ys) = (edges(|r| [r.x0, r.x1]), edges(|r| [r.y0, r.y1]));
    let cells = xs
        .windows(2)
        .flat_map(|x| ys.windows(2).map(move |y| Rect::new(x[0], y[0], x[1], y[1])).collect::<Vec<_>>());
    cells.filter(|cell| !channels.iter().any(|channel| channel.contains(cell.centre()))).collect()
}

/// The robot's corners, in turn.
pub fn corners(robot: Robot, (at, heading): (Point, f64)) -> [Point; 4] {
    let (sin, cos) = heading.sin_cos();
    [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(|(ahead, aside)| {
        let (x, y) = (ahead * robot.length / 2.0, aside * robot.width / 2.0);
        Point::new(at.x + cos * x - sin * y, at.y + sin * x + cos * y)
    })
}

/// Metres between the robot and what is solid; below 0 where an area is shared.
pub fn clearance(robot: Robot, pose: (Point, f64), solid: &[Rect]) -> f64 {
    let shape = corners(robot, pose);
    let reach = robot.width.hypot(robot.length) / 2.0;
    let mut least = f64::INFINITY;
    for cell in solid {
        if cell.nearest_to(pose.0).distance(pose.0) - reach > least {
            continue;
        }
        let other = [(cell.x0, cell.y0), (cell.x1, cell.y0), (cell.x1, cell.y1), (cell.x0, cell.y1)]
            .map(|(x, y)| Point::new(x, y));
        least = least.min(between(&shape, &other));
    }
    least
}

/// Metres between two convex shapes; below 0, by how much one must be moved, where they share an area.
fn between(one: &[Point; 4], other: &[Point; 4]) -> f64 {
    let mut apart = f64::NEG_INFINITY;
    for shape in [one, other] {
        for side in 0..4 {
            let (a, b) = (shape[side], shape[(side + 1) % 4]);
            let length = a.distance(b);
            let (nx, ny) = ((b.y - a.y) / length, (a.x - b.x) / length);
            let range = |points: &[Point; 4]| {
                points
                    .iter()
                    .map(|p| p.x * nx + p.y * ny)
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |range, at| (range.0.min(at), range.1.max(at)))
            };
            let (here, there) = (range(one), range(other));
            apart = apart.max((there.0 - here.1).max(here.0 - there.1));
        }
    }
    if apart <= 0.0 {
        return apart;
    }
    let mut least = f64::INFINITY;
    for (shape, against) in [(one, other), (other, one)] {
        for corner in shape {
            for side in 0..4 {
                let near = corner.nearest_on(against[side], against[(side + 1) % 4]);
                least = least.min(corner.distance(near));
            }
        }
    }
    least
}

/// Where the robot is at a share of a piece of its drive, and its heading.
pub fn pose(primitive: &Primitive, share: f64) -> (Point, f64) {
    match *primitive {
        Primitive::Line { a, b, from_heading, to_heading, .. } => {
            let at = Point::new(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y));
            (at, from_heading + share * (to_heading - from_heading))
        }
        Primitive::Arc { centre, a, from_heading, to_heading, .. } => {
            let turned = share * (to_heading - from_heading);
            let (sin, cos) = turned.sin_cos();
            let (x, y) = (a.x - centre.x, a.y - centre.y);
            let at = Point::new(centre.x + cos * x - sin * y, centre.y + sin * x + cos * y);
            (at, from_heading + turned)
        }
    }
}

/// The least clearance of a piece of a drive at so many moments.
pub fn sampled(robot: Robot, primitive: &Primitive, solid: &[Rect], moments: u32) -> f64 {
    (0..=moments)
        .map(|moment| clearance(robot, pose(primitive, f64::from(moment) / f64::from(moments)), solid))
        .fold(f64::INFINITY, f64::min)
}

/// The least clearance of a piece of a drive: around each moment that is nearer than those beside it, looked at ever more
/// closely.
pub fn nearest(robot: Robot, primitive: &Primitive, solid: &[Rect]) -> f64 {
    let at = |share: f64| clearance(robot, pose(primitive, share.clamp(0.0, 1.0)), solid);
    let coarse: Vec<f64> = (0..=100).map(|moment| at(f64::from(moment) / 100.0)).collect();
    let mut least = f64::INFINITY;
    for moment in 0..=100_usize {
        let beside = [moment.saturating_sub(1), (moment + 1).min(100)];
        if beside.iter().any(|beside| coarse[*beside] < coarse[moment]) {
            continue;
        }
        let (mut middle, mut step) = (moment as f64 / 100.0, 0.01);
        while step > 1e-10 {
            let shares = (-8..=8).map(|part| middle + step * f64::from(part) / 8.0);
            let found = shares.map(|share| (at(share), share)).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
            least = least.min(found.0);
            (middle, step) = (found.1, step / 7.0);
        }
    }
    least
}
