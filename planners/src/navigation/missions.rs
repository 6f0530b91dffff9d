//! Missions drawn by chance, the same ones from the same seed.

use super::mission::{Kidnapping, Mission, ROOM_M};
use crate::floor_plan::clear::wall_distance;
use crate::floor_plan::{FloorPlan, Network, Rule};
use crate::geometry::polygon::{is_in_convex, sides};
use crate::geometry::{Point, Rect, Segment, path_length};
use crate::pose::Pose;
use crate::random::Random;
use crate::simulator::{Course, Obstacle};

/// So many tries for a start, a goal, or an obstacle.
const TRIES: usize = 200;

/// Start and goal are at least so far apart, metres.
const APART_M: f64 = 4.0;

/// Up to so many obstacles.
const MOST_OBSTACLES: usize = 5;

/// Share of the missions in which no obstacle stands on the goal.
const GOAL_KEPT: f64 = 0.9;

/// Draws a mission in a floor plan with 0 to 5 boxes, some of which move before they come to rest. Most stand on or
/// beside the shortest path, some in its doorways, some anywhere; start and goal have room around them without the boxes.
///
/// # Returns
/// `None` where the plan has no room for it.
pub fn draw(plan: &FloorPlan, network: &Network, radius_m: f64, seed: u64) -> Option<Mission> {
    let doorways = &network.regions.doorways;
    let doorways: Vec<Segment> = doorways.iter().map(|door| Segment::new(door.from, door.to)).collect();
    draw_along(plan, &doorways, radius_m, seed, |start, goal| {
        let path = network.path(start, goal, Rule::Tight, |way| Some(way.length)).ok()?;
        Some(path.points)
    })
}

/// As [`draw`], where somebody else knows ways and doorways.
///
/// # Arguments
/// `way` is a way from a start to a goal, if there is one.
pub fn draw_along(
    plan: &FloorPlan,
    doorways: &[Segment],
    radius_m: f64,
    seed: u64,
    mut way: impl FnMut(Point, Point) -> Option<Vec<Point>>,
) -> Option<Mission> {
    let mut random = Random::new(seed);
    let barriers = plan.barriers();
    let bounds = extent(&barriers);
    let room = radius_m + ROOM_M + 0.05;
    let spot = |random: &mut Random| spot(plan, &barriers, room, random);
    let (start, goal, path) = (0..TRIES).find_map(|_| {
        let (start, goal) = (spot(&mut random)?, spot(&mut random)?);
        let path = way(start, goal)?;
        (path_length(&path) >= APART_M).then_some((start, goal, path))
    })?;
    let heading = random.between(-3.0, 3.0);
    let is_goal_kept = random.share() < GOAL_KEPT;
    let count = random.below(MOST_OBSTACLES + 1);
    let mut obstacles = Vec::new();
    for _ in 0..count {
        let found = (0..TRIES).map(|_| obstacle(doorways, &path, &barriers, bounds, &mut random));
        let stands_off = |obstacle: &Obstacle| {
            let rest = obstacle.course.as_ref().and_then(|course| course.through.last().copied());
            let is_off = |step: Point| {
                let at: Vec<Point> = obstacle.corners.iter().map(|&p| p + step).collect();
                distance_to(&at, start) >= room && (!is_goal_kept || distance_to(&at, goal) >= room)
            };
            is_off(Point::default()) && rest.is_none_or(is_off)
        };
        obstacles.extend(found.into_iter().find(stands_off));
    }
    let mission = Mission::between(Pose { at: start, heading }, goal, random.seed());
    Some(Mission { obstacles, ..mission })
}

/// Draws when and where to a robot is carried off on a mission: somewhere with room around it without the mission's boxes.
///
/// # Returns
/// `None` where the plan has no room for it.
pub fn draw_kidnapping(plan: &FloorPlan, radius_m: f64, mission: &Mission) -> Option<Kidnapping> {
    let mut random = Random::new(mission.seed);
    let barriers = plan.barriers();
    let room = radius_m + ROOM_M + 0.05;
    let is_off =
        |at: &Point| mission.obstacles.iter().all(|obstacle| distance_to(&obstacle.at_rest(), *at) >= room);
    let at = (0..TRIES).find_map(|_| spot(plan, &barriers, room, &mut random).filter(is_off))?;
    let heading = random.between(-3.0, 3.0);
    let after_m = random.share() * mission.start.at.distance(mission.goal);
    Some(Kidnapping { after_m, to: Pose { at, heading } })
}

/// Draws points with room around them, each with a way from the one before.
///
/// # Returns
/// Fewer than `count` where the plan has no room for them.
pub fn stops(plan: &FloorPlan, network: &Network, radius_m: f64, count: usize, seed: u64) -> Vec<Point> {
    let mut random = Random::new(seed);
    let barriers = plan.barriers();
    let room = radius_m + ROOM_M + 0.05;
    let mut found: Vec<Point> = Vec::new();
    for _ in 0..TRIES * count {
        let Some(next) = spot(plan, &barriers, room, &mut random) else { break };
        let is_reached = found.last().is_none_or(|&last| {
            last.distance(next) >= APART_M
                && network.path(last, next, Rule::Tight, |way| Some(way.length)).is_ok()
        });
        if is_reached {
            found.push(next);
        }
        if found.len() == count {
            break;
        }
    }
    found
}

/// A free point so far from all walls.
fn spot(plan: &FloorPlan, barriers: &[[Point; 2]], room: f64, random: &mut Random) -> Option<Point> {
    let bounds = extent(barriers);
    let found = (0..TRIES).map(|_| any(bounds, random));
    let mut free = found.filter(|p| plan.is_free(*p) && wall_distance(&[*p, *p], barriers) >= room);
    free.next()
}

fn obstacle(
    doorways: &[Segment],
    path: &[Point],
    barriers: &[[Point; 2]],
    bounds: Rect,
    random: &mut Random,
) -> Obstacle {
    let kind = random.share();
    let mut middle = any(bounds, random);
    if kind < 0.2 {
        if let Some(door) = doorways.get(random.below(doorways.len())) {
            middle = door.a.lerp(door.b, random.share());
        }
    } else if kind < 0.8 {
        let leg = random.below(path.len() - 1);
        let on = path[leg].lerp(path[leg + 1], random.share());
        middle = Point::new(on.x + random.between(-0.6, 0.6), on.y + random.between(-0.6, 0.6));
    }
    let long = if random.share() < 0.2 { 2.0 } else { 0.9 };
    let (dx, dy) = (random.between(0.25, long), random.between(0.25, 0.8));
    let standing = Obstacle::boxed(middle, dx, dy, random.between(-1.6, 1.6));
    if random.share() >= 0.3 {
        return standing;
    }
    let half = dx.hypot(dy) / 2.0;
    let (mut through, mut at) = (Vec::new(), middle);
    for _ in 0..=random.below(3) {
        let next = Point::new(at.x + random.between(-3.0, 3.0), at.y + random.between(-3.0, 3.0));
        if wall_distance(&[at, next], barriers) > half {
            through.push(next - middle);
            at = next;
        }
    }
    if through.is_empty() {
        return standing;
    }
    let (speed_m_s, starts_s) = (random.between(0.1, 0.4), random.between(0.0, 60.0));
    standing.on(Course { through, speed_m_s, starts_s, goes_round: false })
}

fn any(bounds: Rect, random: &mut Random) -> Point {
    Point::new(random.between(bounds.x0, bounds.x1), random.between(bounds.y0, bounds.y1))
}

fn extent(barriers: &[[Point; 2]]) -> Rect {
    Rect::around(barriers.iter().flatten().copied())
}

/// Metres from an outline to a point outside; 0 for one inside.
fn distance_to(corners: &[Point], p: Point) -> f64 {
    if is_in_convex(corners, p, 0.0) {
        return 0.0;
    }
    sides(corners).map(|side| side.distance(p)).fold(f64::INFINITY, f64::min)
}
