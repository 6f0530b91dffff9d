//! Parts of a way, each gone in one stance: in one shape, at one facing.

use std::f64::consts::TAU;

use super::Settings;
use super::known::Building;
use crate::geometry::tolerance::ROUNDING_M;
use crate::geometry::{Point, Segment};
use crate::rim::Rim;

/// A part of a way that is gone in one stance.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    /// By number.
    pub stance: usize,
    /// From where it begins, which is where the one before it ends.
    pub points: Vec<Point>,
}

/// Where there is room to change shape is looked for so finely, metres, in so many directions.
const FINE_M: f64 = 0.05;
const DIRECTIONS: usize = 16;

/// Times that a point is moved away from what is nearest to it, each by the best of these shares of what it lacks: between
/// walls all of it is too much.
const MOVES: usize = 4;
const SHARES: [f64; 4] = [1.0, 0.5, 0.25, 0.125];

/// The same way for a robot that is not exactly where it thinks that it is: it changes its stance where there is room for that,
/// in both stances, up to `change_reach` before or behind where the way says; and its points keep `room` free where that does
/// not lead nearer to anything else.
///
/// # Arguments
/// `stances` is the building as it is for the robot in each stance, `met` what it met there and did not know of.
pub(super) fn with_room(
    mut way: Vec<Stretch>,
    stances: &[Building],
    met: &[Segment],
    settings: &Settings,
) -> Vec<Stretch> {
    way.retain(|stretch| stances.get(stretch.stance).is_some());
    for next in 1..way.len() {
        let (before, after) = way.split_at_mut(next);
        if let (Some(one), Some(other)) = (before.last_mut(), after.first_mut()) {
            change_with_room(one, other, (stances, met), settings);
        }
    }
    for stretch in &mut way {
        let near = Near::of((&stances[stretch.stance], met), &stretch.points, settings);
        for place in 1..stretch.points.len().saturating_sub(1) {
            near.move_away(&mut stretch.points, place, settings.detour_room_m);
        }
        stretch.points = near.thinned(&stretch.points, settings.detour_clearance_m);
    }
    way
}

/// Moves the point at which one stretch goes over into the other to the nearest one at which there is room for both stances; to the
/// one with most room, where there is not enough anywhere near.
fn change_with_room(
    one: &mut Stretch,
    other: &mut Stretch,
    (stances, met): (&[Building], &[Segment]),
    settings: &Settings,
) {
    let Some(&change) = one.points.last() else { return };
    let before = one.points.iter().rev().nth(1).copied().unwrap_or(change);
    let after = other.points.get(1).copied().unwrap_or(change);
    let [near_one, near_other] = [&one, &other]
        .map(|stretch| Near::of((&stances[stretch.stance], met), &[before, change, after], settings));
    let need = settings.change_room_m;
    let room = |at: Point| near_one.gap(at, at).min(near_other.gap(at, at)).min(need);
    // straight there, or by way of where the route changes; as near to things as the route itself, or as ways may be
    let leads = |near: &Near, end: Point, to: Point| {
        let least = near.gap(end, change).min(settings.detour_clearance_m) - ROUNDING_M;
        let is_straight = near.gap(end, to) >= least;
        (is_straight || near.gap(change, to) >= least).then_some(is_straight)
    };
    let mut best = (room(change), change, [true, true]);
    let rings = (settings.change_reach_m / FINE_M) as usize;
    for (ring, direction) in
        (1..=rings).flat_map(|ring| (0..DIRECTIONS).map(move |direction| (ring, direction)))
    {
        if best.0 >= need {
            break;
        }
        let (sin, cos) = (TAU * direction as f64 / DIRECTIONS as f64).sin_cos();
        let at = change + Point::new(cos, sin) * (ring as f64 * FINE_M);
        let found = room(at);
        if found > best.0 + ROUNDING_M
            && let (Some(come), Some(go)) = (leads(&near_one, before, at), leads(&near_other, after, at))
        {
            best = (found, at, [come, go]);
        }
    }
    let (_, at, [come, go]) = best;
    if at != change {
        if come && one.points.len() > 1 {
            one.points.pop();
        }
        one.points.push(at);
        if go && other.points.len() > 1 {
            other.points.remove(0);
        }
        other.points.insert(0, at);
    }
}

/// What stands and hangs near a path.
struct Near {
    rim: Rim,
    barriers: Vec<Segment>,
}

impl Near {
    fn of((building, met): (&Building, &[Segment]), points: &[Point], settings: &Settings) -> Self {
        let rim = building.rim;
        let room = settings.change_room_m.max(settings.detour_room_m);
        let reach = rim.outer_m() + room + settings.change_reach_m;
        let is_near = |barrier: &&Segment| {
            points.windows(2).any(|leg| Segment::new(leg[0], leg[1]).gap(barrier) <= reach)
                || points.first().is_some_and(|at| barrier.distance(*at) <= reach)
        };
        let all = building.walls.iter().chain(&building.overhead).chain(met);
        Self { rim, barriers: all.filter(is_near).copied().collect() }
    }

    /// Metres that are free beside the robot's rim on a straight way.
    fn gap(&self, from: Point, to: Point) -> f64 {
        let way = Segment::new(from, to);
        self.barriers.iter().map(|barrier| self.room(&way, barrier)).fold(f64::INFINITY, f64::min)
    }

    /// The same beside one of the barriers.
    fn room(&self, way: &Segment, barrier: &Segment) -> f64 {
        self.rim.way_distance(way, barrier) - self.rim.radius_m()
    }

    /// The same path with fewer points, as far as that leads no nearer to anything than the path itself, or than `room`.
    fn thinned(&self, points: &[Point], room: f64) -> Vec<Point> {
        let mut kept: Vec<Point> = points.first().copied().into_iter().collect();
        let mut at = 0;
        while at + 1 < points.len() {
            // of each thing by itself: how near one leads to one of them says nothing of the others
            let mut least = vec![room; self.barriers.len()];
            let mut next = at + 1;
            for far in at + 1..points.len() {
                let leg = Segment::new(points[far - 1], points[far]);
                let straight = Segment::new(points[at], points[far]);
                let mut all = self.barriers.iter().zip(&mut least);
                let leads_nearer = all.any(|(barrier, least)| {
                    *least = least.min(self.room(&leg, barrier));
                    self.room(&straight, barrier) < *least - ROUNDING_M
                });
                if leads_nearer {
                    break;
                }
                next = far;
            }
            kept.push(points[next]);
            at = next;
        }
        kept
    }

    /// Moves a point of a path away from what is nearest to it until `room` is free there, as far as the legs beside it come
    /// no nearer to anything by that.
    fn move_away(&self, points: &mut [Point], place: usize, room: f64) {
        let (before, after) = (points[place - 1], points[place + 1]);
        let along = |at: Point| self.gap(before, at).min(self.gap(at, after));
        for _ in 0..MOVES {
            let at = points[place];
            let Some(away) = self.away(at, room) else { return };
            let moved = SHARES.map(|share| at.lerp(away, share));
            let best = moved.into_iter().max_by(|one, other| along(*one).total_cmp(&along(*other)));
            let Some(best) = best.filter(|best| along(*best) > along(at) + ROUNDING_M) else { return };
            points[place] = best;
        }
    }

    /// A point so far away from what is nearest to a point that `room` would be free if nothing else stood there; `None` where it
    /// is free.
    fn away(&self, at: Point, room: f64) -> Option<Point> {
        let far_from = |barrier: &&Segment| self.rim.distance(at, barrier);
        let nearest = self.barriers.iter().min_by(|one, other| far_from(one).total_cmp(&far_from(other)))?;
        let foot = self.rim.nearest_on(at, nearest);
        let lacks = self.rim.radius_m() + room - far_from(&nearest);
        let far = at.distance(foot);
        (lacks > ROUNDING_M && far > 0.0).then(|| at + (at - foot) * (lacks / far))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::floor_plan::{Disc, Network};

    fn line(x0: f64, y0: f64, x1: f64, y1: f64) -> Segment {
        Segment::new(Point::new(x0, y0), Point::new(x1, y1))
    }

    fn building(radius: f64, overhead: Vec<Segment>) -> Building {
        let walls = vec![line(0.0, 0.0, 10.0, 0.0), line(0.0, 3.0, 10.0, 3.0)];
        Building { overhead, ..Building::of_walls(Network::none(Disc { radius, margin: 0.0 }), walls) }
    }

    /// A corridor with a pipe across it from 4 to 5: on the knees beneath it.
    fn beneath_a_pipe(y: f64) -> Vec<Stretch> {
        let pipe = vec![line(4.0, 0.0, 4.0, 3.0), line(5.0, 0.0, 5.0, 3.0)];
        let shapes = [building(0.3, pipe), building(0.4, Vec::new())];
        let at = |x: f64| Point::new(x, y);
        let stretch = |shape, from: f64, to: f64| Stretch { stance: shape, points: vec![at(from), at(to)] };
        let way = vec![stretch(0, 1.0, 3.7), stretch(1, 3.7, 5.3), stretch(0, 5.3, 9.0)];
        with_room(way, &shapes, &[], &Settings::default())
    }

    #[test]
    fn the_robot_goes_down_before_a_pipe_and_gets_up_behind_it_with_room_and_beside_a_wall_farther_from_that()
    {
        let room = Settings::default().change_room_m;
        for (y, off_wall) in [(1.5, 1.1), (0.4, room)] {
            let way = beneath_a_pipe(y);
            for change in [way[1].points[0], way[1].points[way[1].points.len() - 1]] {
                let off_pipe = (4.0 - change.x).max(change.x - 5.0) - 0.3;
                assert!((room - 1e-9..room + 0.2).contains(&off_pipe), "{change:?}");
                assert!(change.y - 0.4 >= off_wall - 1e-9, "{change:?}");
            }
            let joins = |pair: &[Stretch]| pair[0].points.last() == pair[1].points.first();
            assert!(way.windows(2).all(joins), "{way:?}");
        }
    }

    #[test]
    fn a_bend_about_what_was_met_stays() {
        let met = [line(4.0, 0.6, 5.0, 0.6)];
        let points = vec![Point::new(1.0, 0.6), Point::new(4.5, 1.1), Point::new(8.0, 0.6)];
        let way = vec![Stretch { stance: 0, points }];
        let bends = |met: &[Segment]| {
            let way = with_room(way.clone(), &[building(0.3, Vec::new())], met, &Settings::default());
            way[0].points.len() - 2
        };
        assert_eq!((bends(&[]), bends(&met)), (0, 1));
        // whatever stands in the way elsewhere
        let elsewhere = line(7.0, 0.5, 7.0, 0.9);
        assert_eq!(bends(&[met[0], elsewhere]), 1);
    }

    #[test]
    fn a_bend_keeps_room_about_a_corner() {
        let corner = line(5.0, 0.0, 5.0, 1.0);
        let building = Building { overhead: vec![corner], ..building(0.3, Vec::new()) };
        let points = vec![Point::new(2.0, 0.5), Point::new(5.0, 1.3), Point::new(8.0, 0.5)];
        let way = with_room(vec![Stretch { stance: 0, points }], &[building], &[], &Settings::default());
        assert!(way[0].points[1].distance(Point::new(5.0, 1.4)) < 1e-9, "{way:?}");
    }

    #[test]
    fn a_bend_in_a_narrow_passage_goes_to_its_middle() {
        let walls = vec![line(0.0, 0.0, 10.0, 0.0), line(0.0, 0.64, 10.0, 0.64)];
        let building = Building::of_walls(Network::none(Disc { radius: 0.3, margin: 0.0 }), walls);
        let points = vec![Point::new(2.0, 0.32), Point::new(5.0, 0.302), Point::new(8.0, 0.32)];
        let way = with_room(vec![Stretch { stance: 0, points }], &[building], &[], &Settings::default());
        let off = way[0].points.iter().map(|at| (at.y - 0.32).abs()).fold(0.0, f64::max);
        assert!(off < 0.005, "{way:?}");
    }
}
