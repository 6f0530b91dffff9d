//! Where a body fits is what closed forms say, and the nearest such point is the nearest.

use adit_planners::clearance::{Footprint, Solids};
use adit_planners::geometry::{Point, Rect, Segment, polygon};
use adit_planners::world::{Bridge, Obstacle, Occupancy, Shape, World};
use proptest::prelude::*;

/// How wide the oracle leaves it open whether something fits, metres.
const HAIR: f64 = 1e-7;

fn world(rects: &[Rect], polygons: &[Vec<Point>], cells: Option<Occupancy>) -> World {
    let mut world = World::empty(Rect::new(0.0, 0.0, 6.0, 4.0));
    let rects = rects.iter().map(|rect| Shape::Rect(*rect));
    let shapes = rects.chain(polygons.iter().cloned().map(Shape::Polygon));
    world.obstacles = shapes.map(|shape| Obstacle { shape }).collect();
    world.occupancy = cells;
    world
}

/// Metres from everything solid, from its outlines one by one; negative inside.
fn apart(world: &World, p: Point, height: f64) -> f64 {
    let b = world.bounds;
    let edge = (p.x - b.x0).min(b.x1 - p.x).min(p.y - b.y0).min(b.y1 - p.y);
    let low =
        world.bridges.iter().filter(|bridge| bridge.height <= height).map(|bridge| Shape::Rect(bridge.rect));
    let pictured = world.occupancy.iter().flat_map(|cells| {
        let all = (0..cells.rows).flat_map(|row| (0..cells.columns).map(move |column| (column, row)));
        all.filter(|&(column, row)| cells.is_blocked(column, row)).map(|(c, r)| Shape::Rect(cells.cell(c, r)))
    });
    let drawn = world.obstacles.iter().map(|obstacle| obstacle.shape.clone());
    let from = |shape: Shape| {
        let corners: Vec<Point> = match &shape {
            Shape::Rect(rect) => rect.corners().into(),
            Shape::Polygon(corners) => corners.clone(),
        };
        let outline = polygon::sides(&corners).map(|side| side.distance(p)).fold(f64::INFINITY, f64::min);
        if polygon::encloses(polygon::sides(&corners), p) { -outline } else { outline }
    };
    drawn.chain(low).chain(pictured).map(from).fold(edge, f64::min)
}

fn rects() -> impl Strategy<Value = Vec<Rect>> {
    let rect = (0.0..5.5_f64, 0.0..3.5_f64, 0.02..1.5_f64, 0.02..1.5_f64);
    prop::collection::vec(
        rect.prop_map(|(x, y, w, h)| Rect::new(x, y, (x + w).min(6.0), (y + h).min(4.0))),
        0..4,
    )
}

/// Turned rectangles, and an L that is not convex.
fn polygons() -> impl Strategy<Value = Vec<Vec<Point>>> {
    let polygon = (0.5..5.5_f64, 0.5..3.5_f64, 0.0..6.3_f64, 0.05..0.6_f64, any::<bool>());
    let polygon = polygon.prop_map(|(x, y, angle, size, is_l)| {
        let corners: &[(f64, f64)] = if is_l {
            &[(0.0, 0.0), (2.0, 0.0), (2.0, 0.5), (0.5, 0.5), (0.5, 2.0), (0.0, 2.0)]
        } else {
            &[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]
        };
        let by = Point::towards(angle);
        corners.iter().map(|&(u, v)| Point::new(x, y) + (Point::new(u, v) * size).rotated(by)).collect()
    });
    prop::collection::vec(polygon, 0..3)
}

fn cells() -> impl Strategy<Value = Option<Occupancy>> {
    let blocked = prop::collection::vec(prop::bool::weighted(0.02), 60 * 40);
    prop::option::of(blocked.prop_map(|blocked| Occupancy {
        origin: Point::default(),
        resolution: 0.1,
        columns: 60,
        rows: 40,
        blocked,
    }))
}

fn worlds() -> impl Strategy<Value = World> {
    let bridge = (0.5..5.0_f64, 0.5..3.0_f64, 0.9..1.4_f64);
    (rects(), polygons(), cells(), prop::option::of(bridge)).prop_map(|(rects, polygons, cells, bridge)| {
        let mut world = world(&rects, &polygons, cells);
        let of = |(x, y, height): (f64, f64, f64)| Bridge { rect: Rect::new(x, y, x + 0.4, y + 0.8), height };
        world.bridges = bridge.map(of).into_iter().collect();
        world
    })
}

/// Points of a world within 20 cm of what a disc keeps from the walls.
fn points(world: &World, radius: f64, shares: &[(f64, f64)]) -> Vec<Point> {
    let at = |&(x, y): &(f64, f64)| Point::new(x * 6.0, y * 4.0);
    let near = |p: &Point| (apart(world, *p, 1.2) - radius).abs() <= 0.2;
    shares.iter().map(at).filter(near).collect()
}

proptest! {
    // a hundred thousand points and more
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn a_disc_fits_exactly_where_its_radius_says_so(
        world in worlds(),
        radius in 0.1..0.5_f64,
        shares in prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64), 500),
    ) {
        let solids = Solids::new(&world);
        let disc = Footprint::new((radius * 2.0, 1.2), 0.0, None);
        for p in points(&world, radius, &shares) {
            let room = apart(&world, p, 1.2) - radius;
            if room.abs() > HAIR {
                prop_assert_eq!(solids.fits(&disc, p, p), room > 0.0, "{:?}: {} m of room", p, room);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_straight_way_fits_if_the_disc_does_all_along(
        world in worlds(),
        radius in 0.1..0.4_f64,
        ways in prop::collection::vec((0.0..6.0_f64, 0.0..4.0_f64, -0.4..0.4_f64, -0.4..0.4_f64), 40),
    ) {
        let solids = Solids::new(&world);
        let disc = Footprint::new((radius * 2.0, 1.2), 0.0, None);
        for (x, y, dx, dy) in ways {
            let way = Segment::new(Point::new(x, y), Point::new(x + dx, y + dy));
            let all = (0..=200).map(|step| apart(&world, way.at(f64::from(step) / 200.0), 1.2));
            let room = all.fold(f64::INFINITY, f64::min) - radius;
            // between two samples a distance changes by less than half their distance
            if !(-HAIR..=0.002).contains(&room) {
                prop_assert_eq!(solids.fits(&disc, way.a, way.b), room > 0.0, "{:?}: {} m of room", way, room);
            }
        }
    }

    #[test]
    fn a_body_fits_exactly_where_no_point_of_it_is_solid(
        world in worlds(),
        (length, width) in (0.2..0.9_f64, 0.1..0.5_f64),
        facing in 0_u8..8,
        at in prop::collection::vec((0.0..6.0_f64, 0.0..4.0_f64), 25),
    ) {
        let solids = Solids::new(&world);
        let degrees = f64::from(facing) * 22.5;
        let body = Footprint::new((width, 1.2), 0.0, Some((length, degrees)));
        let turn = Point::towards(degrees.to_radians());
        for (x, y) in at {
            let middle = Point::new(x, y);
            let local = |u: f64, v: f64| middle + Point::new(u * length / 2.0, v * width / 2.0).rotated(turn);
            let corners = [local(-1.0, -1.0), local(1.0, -1.0), local(1.0, 1.0), local(-1.0, 1.0)];
            // how deep solids reach into the body: from samples of it, and from corners of solids in it
            let grid = || (0..=24).map(|step| f64::from(step) / 12.0 - 1.0);
            let deepest = grid().flat_map(|u| grid().map(move |v| (u, v)));
            let deepest = deepest.map(|(u, v)| -apart(&world, local(u, v), 1.2)).fold(f64::NEG_INFINITY, f64::max);
            let fits = solids.fits(&body, middle, middle);
            if deepest > HAIR {
                prop_assert!(!fits, "{:?} is {} m deep in something", corners, deepest);
            } else if deepest < -(length.max(width) / 24.0 * 1.5) {
                prop_assert!(fits, "{:?} is {} m off everything", corners, -deepest);
            }
        }
    }

    #[test]
    fn no_point_that_fits_is_nearer_than_the_nearest(
        world in worlds(),
        radius in 0.1..0.5_f64,
        lies in prop::option::of((0.2..0.8_f64, 0_u8..8)),
        shares in prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64), 6),
    ) {
        let solids = Solids::new(&world);
        let lies = lies.map(|(length, facing)| (length, f64::from(facing) * 22.5));
        let size = Footprint::new((radius * 2.0, 1.2), 0.0, lies);
        for (x, y) in shares {
            let at = Point::new(x * 6.0, y * 4.0);
            let found = solids.nearest_fit(&size, at, 0.6, |_| true);
            let metres = found.map_or(0.6, |found| found.distance(at));
            if let Some(found) = found {
                prop_assert!(solids.fits(&size, found, found));
            }
            for ring in 1..=20 {
                for turn in 0..48 {
                    let (share, angle) = (f64::from(ring) / 20.0, f64::from(turn) * std::f64::consts::TAU / 48.0);
                    let p = at + Point::towards(angle) * (metres * share - HAIR).max(0.0);
                    prop_assert!(!solids.fits(&size, p, p) || found == Some(at), "{p:?} is nearer to {at:?} than {found:?}");
                }
            }
        }
    }
}
