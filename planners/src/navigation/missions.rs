//! Missions drawn by chance, the same ones from the same seed.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::mission::{Mission, ROOM_M};
use crate::floor_plan::clear::wall_distance;
use crate::floor_plan::{FloorPlan, Network, Rule};
use crate::geometry::{Point, Rect};
use crate::pose::Pose;
use crate::simulator::{Course, Obstacle};

/// So many tries for a start, a goal, or an obstacle.
const TRIES: usize = 200;

/// Start and goal are at least so far apart, metres.
const APART_M: f64 = 4.0;

/// Up to so many obstacles.
const MOST_OBSTACLES: usize = 5;

/// Share of the missions in which no obstacle stands on the goal.
const GOAL_KEPT: f64 = 0.9;

struct Dice(Pcg64);

impl Dice {
    fn share(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * 2.0_f64.powi(-53)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.share() * (high - low)
    }

    fn below(&mut self, count: usize) -> usize {
        ((self.share() * count as f64) as usize).min(count.saturating_sub(1))
    }
}

/// Draws a mission in a floor plan with 0 to 5 boxes, some of which move before they come to rest. Most stand on or
/// beside the shortest path, some in its doorways, some anywhere; start and goal have room around them without the boxes.
///
/// # Returns
/// `None` where the plan has no room for it.
pub fn draw(plan: &FloorPlan, network: &Network, radius_m: f64, seed: u64) -> Option<Mission> {
    let mut dice = Dice(Pcg64::seed_from_u64(seed));
    let barriers = plan.barriers();
    let bounds = extent(&barriers);
    let room = radius_m + ROOM_M + 0.05;
    let spot = |dice: &mut Dice| spot(plan, &barriers, room, dice);
    let (start, goal, path) = (0..TRIES).find_map(|_| {
        let (start, goal) = (spot(&mut dice)?, spot(&mut dice)?);
        let path = network.path(start, goal, Rule::Tight, |way| Some(way.length)).ok()?;
        (path.length >= APART_M).then_some((start, goal, path.points))
    })?;
    let heading = dice.between(-3.0, 3.0);
    let is_goal_kept = dice.share() < GOAL_KEPT;
    let count = dice.below(MOST_OBSTACLES + 1);
    let mut obstacles = Vec::new();
    for _ in 0..count {
        let found = (0..TRIES).map(|_| obstacle(network, &path, &barriers, bounds, &mut dice));
        let stands_off = |obstacle: &Obstacle| {
            let rest = obstacle.course.as_ref().and_then(|course| course.through.last().copied());
            let is_off = |step: Point| {
                let at: Vec<Point> =
                    obstacle.corners.iter().map(|p| Point::new(p.x + step.x, p.y + step.y)).collect();
                distance_to(&at, start) >= room && (!is_goal_kept || distance_to(&at, goal) >= room)
            };
            is_off(Point::default()) && rest.is_none_or(is_off)
        };
        obstacles.extend(found.into_iter().find(stands_off));
    }
    Some(Mission { start: Pose { at: start, heading }, goal, obstacles, seed: dice.0.next_u64() })
}

/// Draws points with room around them, each with a way from the one before.
///
/// # Returns
/// Fewer than `count` where the plan has no room for them.
pub fn stops(plan: &FloorPlan, network: &Network, radius_m: f64, count: usize, seed: u64) -> Vec<Point> {
    let mut dice = Dice(Pcg64::seed_from_u64(seed));
    let barriers = plan.barriers();
    let room = radius_m + ROOM_M + 0.05;
    let mut found: Vec<Point> = Vec::new();
    for _ in 0..TRIES * count {
        let Some(next) = spot(plan, &barriers, room, &mut dice) else { break };
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
fn spot(plan: &FloorPlan, barriers: &[[Point; 2]], room: f64, dice: &mut Dice) -> Option<Point> {
    let bounds = extent(barriers);
    let found = (0..TRIES).map(|_| any(bounds, dice));
    let mut free = found.filter(|p| plan.is_free(*p) && wall_distance(&[*p, *p], barriers) >= room);
    free.next()
}

fn obstacle(
    network: &Network,
    path: &[Point],
    barriers: &[[Point; 2]],
    bounds: Rect,
    dice: &mut Dice,
) -> Obstacle {
    let kind = dice.share();
    let mut middle = any(bounds, dice);
    if kind < 0.2 {
        let doors = &network.regions.doorways;
        if let Some(door) = doors.get(dice.below(doors.len())) {
            middle = along([door.from, door.to], dice.share());
        }
    } else if kind < 0.8 {
        let leg = dice.below(path.len() - 1);
        let on = along([path[leg], path[leg + 1]], dice.share());
        middle = Point::new(on.x + dice.between(-0.6, 0.6), on.y + dice.between(-0.6, 0.6));
    }
    let long = if dice.share() < 0.2 { 2.0 } else { 0.9 };
    let (dx, dy) = (dice.between(0.25, long), dice.between(0.25, 0.8));
    let standing = Obstacle::boxed(middle, dx, dy, dice.between(-1.6, 1.6));
    if dice.share() >= 0.3 {
        return standing;
    }
    let half = dx.hypot(dy) / 2.0;
    let (mut through, mut at) = (Vec::new(), middle);
    for _ in 0..=dice.below(3) {
        let next = Point::new(at.x + dice.between(-3.0, 3.0), at.y + dice.between(-3.0, 3.0));
        if wall_distance(&[at, next], barriers) > half {
            through.push(Point::new(next.x - middle.x, next.y - middle.y));
            at = next;
        }
    }
    if through.is_empty() {
        return standing;
    }
    let (speed_m_s, starts_s) = (dice.between(0.1, 0.4), dice.between(0.0, 60.0));
    standing.on(Course { through, speed_m_s, starts_s, goes_round: false })
}

fn along([a, b]: [Point; 2], share: f64) -> Point {
    Point::new(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y))
}

fn any(bounds: Rect, dice: &mut Dice) -> Point {
    Point::new(dice.between(bounds.x0, bounds.x1), dice.between(bounds.y0, bounds.y1))
}

fn extent(barriers: &[[Point; 2]]) -> Rect {
    super::field::window(barriers.iter().flatten().copied(), 0.0)
}

/// Metres from an outline to a point outside; 0 for one inside.
fn distance_to(corners: &[Point], p: Point) -> f64 {
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let side = |a: &Point, b: &Point| (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    if sides.clone().all(|(a, b)| side(a, b) >= 0.0) {
        return 0.0;
    }
    sides.map(|(a, b)| p.distance(p.nearest_on(*a, *b))).fold(f64::INFINITY, f64::min)
}
