//! About corners of walls ways follow the arc that the shape keeps from them.

use std::f64::consts::TAU;

use adit_planners::clearance::Solids;
use adit_planners::geometry::{Point, Segment};
use adit_planners::routes::{RouteGraph, RouteRoom};
use adit_planners::world::{Shape, World};
use proptest::prelude::*;

use super::floors::{SIDE, blocks, check_way, graph, hall, holding, shapes, shortest_over, way};

/// How far the first shape keeps from walls.
const RADIUS_M: f64 = 0.3;

/// In so many parts arcs are cut.
const PARTS: u32 = 24;

/// Corners about the arcs around all corners of blocks.
fn about_corners(world: &World) -> Vec<Point> {
    let corners = world.obstacles.iter().flat_map(|obstacle| match &obstacle.shape {
        Shape::Rect(rect) => Vec::from(rect.corners()),
        Shape::Polygon(corners) => corners.clone(),
    });
    let part = TAU / f64::from(PARTS);
    let reach = (RADIUS_M + 1e-6) / (part / 2.0).cos();
    let about = |corner: Point| {
        (0..PARTS).map(move |number| corner + Point::towards(part * (f64::from(number) + 0.5)) * reach)
    };
    corners.flat_map(about).collect()
}

fn with_arcs(graph: &RouteGraph) -> RouteGraph {
    let room = |room: &RouteRoom| RouteRoom { radius: Some(RADIUS_M), ..room.clone() };
    RouteGraph::new(graph.rooms().iter().map(room).collect(), graph.doors().to_vec())
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: std::env::var("CASES").map_or(24, |cases| cases.parse().unwrap()),
        max_global_rejects: 100_000,
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_way_is_as_short_as_over_tangents_and_arcs_and_keeps_its_radius(
        mut blocks in blocks(), x in 0.2..SIDE - 0.2, y in 0.2..SIDE - 0.2, u in 0.2..SIDE - 0.2, v in 0.2..SIDE - 0.2
    ) {
        blocks.truncate(5);
        let world = hall(&blocks, &[]);
        let (from, to) = (Point::new(x, y), Point::new(u, v));
        let (shape, height) = (&shapes()[..1], shapes()[0].0.height);
        let coarse = graph(&world, shape, 0.0);
        prop_assume!(!holding(&coarse, from).is_empty() && !holding(&coarse, to).is_empty());
        let (straight, round) = (way(&coarse, from, to), way(&with_arcs(&coarse), from, to));
        prop_assert_eq!(straight.is_some(), round.is_some());
        let (Some(straight), Some(round)) = (straight, round) else { return Ok(()) };
        check_way(&coarse, &round, from, to)?;
        prop_assert!(round.cost <= straight.cost + 1e-9, "{} for {}", round.cost, straight.cost);
        let solids = Solids::new(&world);
        let is_clear = |a: Point, b: Point| solids.gap(a, b, height) >= RADIUS_M - 1e-9;
        for leg in &round.legs {
            prop_assert!(is_clear(leg.from, leg.to), "{leg:?} comes too near: {}", solids.gap(leg.from, leg.to, height));
        }
        let corners: Vec<Point> = about_corners(&world).into_iter().filter(|p| is_clear(*p, *p)).collect();
        let least = shortest_over(&corners, from, to, |Segment { a, b }| is_clear(a, b)).unwrap();
        // of ways that cost nearly the same, the search may take one that arcs save less of
        let over = round.cost / least - 1.0;
        prop_assert!((-2e-3..1e-2).contains(&over), "{} for {least}", round.cost);
    }
}
