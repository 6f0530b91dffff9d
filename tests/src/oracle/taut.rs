//! A way drawn taut: the shortest by cost that leads the same way round, as far as small steps find it.

use adit_planners::geometry::Point;

use super::space::Space;
use super::way::Way;

/// How many points further a shortcut is looked for.
const SIGHT: usize = 40;
/// Rounds of small steps.
const ROUNDS: usize = 40;

/// The way drawn taut. `step` is how far its points may be from their best places, metres. It costs no more than
/// before and stays in the free space.
pub fn taut(space: &Space, way: &Way, step: f64) -> Way {
    let mut way = way.without_idle_points(space.body());
    let mut reach = step;
    for _ in 0..ROUNDS {
        let before = way.cost(space);
        way = shortcut(space, &way).without_idle_points(space.body());
        let mut moved = false;
        for point in 1..way.points.len() - 1 {
            moved |= settle(space, &mut way, point, reach);
        }
        let gained = before - way.cost(space);
        if !moved || gained < 1e-4 * before {
            reach /= 2.0;
        }
        if reach < step / 30.0 {
            break;
        }
    }
    way
}

/// The cheapest way over the same points, in any states, leaving out whatever can be left out.
fn shortcut(space: &Space, way: &Way) -> Way {
    let body = space.body();
    let (count, states) = (way.points.len(), body.states.len());
    let mut cost = vec![vec![f64::INFINITY; states]; count];
    let mut before = vec![vec![(0, 0); states]; count];
    let mut own = 0.0;
    for (number, piece) in way.pieces().enumerate() {
        if number > 0 && way.states[number - 1] != piece.state {
            own += body.change(way.states[number - 1], piece.state);
        }
        own += space.weigh(piece.state, piece.from, piece.to);
        cost[number + 1][piece.state] = own;
        before[number + 1][piece.state] =
            (number, if number > 0 { way.states[number - 1] } else { piece.state });
    }
    for from in 0..count {
        for to in from + 1..count.min(from + SIGHT) {
            let ends = (way.points[from], way.points[to]);
            for state in 0..states {
                let ready =
                    |was: &usize| if from == 0 { 0.0 } else { cost[from][*was] + change(body, *was, state) };
                let Some(was) = (0..states).min_by(|a, b| ready(a).total_cmp(&ready(b))) else { continue };
                let total = ready(&was) + space.weigh(state, ends.0, ends.1);
                if total < cost[to][state] - 1e-12 && space.is_free(state, ends.0, ends.1) {
                    cost[to][state] = total;
                    before[to][state] = (from, was);
                }
            }
        }
    }
    let last = (0..states).min_by(|a, b| cost[count - 1][*a].total_cmp(&cost[count - 1][*b])).unwrap_or(0);
    let (mut points, mut kept) = (vec![way.points[count - 1]], Vec::new());
    let (mut at, mut state) = (count - 1, last);
    while at > 0 {
        kept.push(state);
        (at, state) = before[at][state];
        points.push(way.points[at]);
    }
    points.reverse();
    kept.reverse();
    Way { points, states: kept }
}

fn change(body: &super::body::Body, from: usize, to: usize) -> f64 {
    if from == to { 0.0 } else { body.change(from, to) }
}

/// Moves a point to the best of the places around it, while that makes the way cheaper.
fn settle(space: &Space, way: &mut Way, point: usize, reach: f64) -> bool {
    let (a, b) = (way.points[point - 1], way.points[point + 1]);
    let (into, out) = (way.states[point - 1], way.states[point]);
    let cost = |p: Point| space.weigh(into, a, p) + space.weigh(out, p, b);
    let mut moved = false;
    for _ in 0..8 {
        let here = way.points[point];
        let around = (0..16).map(|direction| {
            let (sin, cos) = (f64::from(direction) * std::f64::consts::TAU / 16.0).sin_cos();
            Point::new(here.x + reach * cos, here.y + reach * sin)
        });
        let cheaper = around.filter(|&p| cost(p) < cost(here) - 1e-9);
        let open = cheaper.filter(|&p| space.is_free(into, a, p) && space.is_free(out, p, b));
        let Some(best) = open.min_by(|&p, &q| cost(p).total_cmp(&cost(q))) else { break };
        way.points[point] = best;
        moved = true;
    }
    moved
}
