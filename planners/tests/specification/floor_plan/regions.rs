//! Regions are convex, disjoint and covering; no more of them than merged triangles give, and the largest is larger.

use std::path::Path;

use adit_planners::floor_plan::{Drawn, FloorPlan, Region, Regions, read_floor_plan};
use adit_planners::geometry::Point;
use serde_json::Value;

use super::dice::Dice;
use super::hertel_mehlhorn::Triangles;
use super::random_plan::{random_drawing, random_plan};

pub const GOLDEN: [&str; 3] = ["house-7.json", "office-14.json", "plant-25.json"];

pub fn golden(name: &str) -> FloorPlan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/floorplans").join(name);
    read_floor_plan(&path).unwrap()
}

fn cross(a: Point, b: Point, c: Point) -> f64 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

fn edges(outline: &[Point]) -> impl Iterator<Item = (Point, Point)> + '_ {
    (0..outline.len()).map(|i| (outline[i], outline[(i + 1) % outline.len()]))
}

fn shoelace(outline: &[Point]) -> f64 {
    let origin = outline[0];
    edges(outline).map(|(a, b)| cross(origin, a, b)).sum::<f64>() / 2.0
}

/// Every corner lies left of every side.
fn is_convex(region: &Region) -> bool {
    edges(&region.outline)
        .all(|(a, b)| region.outline.iter().all(|&corner| cross(a, b, corner) >= -1e-7 * a.distance(b)))
}

/// A side of one of them has all of the other one to its right.
fn are_apart(one: &Region, other: &Region) -> bool {
    let parts = |one: &Region, other: &Region| {
        edges(&one.outline)
            .any(|(a, b)| other.outline.iter().all(|&corner| cross(a, b, corner) <= 1e-7 * a.distance(b)))
    };
    parts(one, other) || parts(other, one)
}

/// Whether a wall has a part inside that is more than a touch.
fn is_crossed(region: &Region, [a, b]: [Point; 2]) -> bool {
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for (p, q) in edges(&region.outline) {
        let inset = 1e-6 * p.distance(q);
        let (from, to) = (cross(p, q, a) - inset, cross(p, q, b) - inset);
        if from < 0.0 && to < 0.0 {
            return false;
        }
        if from < 0.0 {
            enters = enters.max(from / (from - to));
        } else if to < 0.0 {
            leaves = leaves.min(from / (from - to));
        }
    }
    (leaves - enters) * a.distance(b) > 1e-6
}

fn check(plan: &FloorPlan, free_area: f64) {
    let regions = Regions::of(plan).regions;
    for (index, region) in regions.iter().enumerate() {
        assert!(is_convex(region), "{}: {region:?}", plan.name);
        assert!((shoelace(&region.outline) - region.area).abs() < 1e-9 * free_area);
        assert!(plan.barriers().iter().all(|&wall| !is_crossed(region, wall)), "{}: {region:?}", plan.name);
        assert!(regions[..index].iter().all(|other| are_apart(region, other)), "{}: {region:?}", plan.name);
    }
    let covered: f64 = regions.iter().map(|region| region.area).sum();
    assert!((covered / free_area - 1.0).abs() < 1e-9, "{}: {covered} of {free_area}", plan.name);
}

#[test]
fn regions_of_random_plans_are_convex_disjoint_free_of_walls_and_cover() {
    for seed in 0..60 {
        let drawing = random_drawing(seed, 1 + seed as usize % 12);
        // the outer walls are drawn first
        let outer: Vec<Point> = drawing.walls[..4].iter().map(|wall| wall[0]).collect();
        let solid: f64 = drawing.solids.iter().map(|solid| shoelace(solid)).sum();
        check(&FloorPlan::new(drawing).unwrap(), shoelace(&outer) - solid);
    }
}

/// So many corners that not each is looked at from each.
#[test]
fn regions_of_a_hall_of_many_pillars_are_so_too_and_no_more_than_merged_triangles() {
    let (mut dice, side) = (Dice::new(3), 20.0);
    let rect = |x0: f64, y0: f64, x1: f64, y1: f64| {
        vec![Point::new(x0, y0), Point::new(x1, y0), Point::new(x1, y1), Point::new(x0, y1)]
    };
    let pillars = (0..400).map(|pillar| {
        let (x, y) = (f64::from(pillar % 20) + 0.1, f64::from(pillar / 20) + 0.1);
        let mut part = || (10.0 * dice.between(0.0, 0.4)).round() / 20.0;
        rect(x + part(), y + part(), x + 0.3 + part(), y + 0.3 + part())
    });
    let solids: Vec<Vec<Point>> = pillars.collect();
    let outer = rect(0.0, 0.0, side, side);
    let walls = edges(&outer).map(|(a, b)| [a, b]).collect();
    let solid: f64 = solids.iter().map(|solid| shoelace(solid)).sum();
    let plan = FloorPlan::new(Drawn { walls, solids, ..Drawn::default() }).unwrap();
    check(&plan, side * side - solid);
    let triangles = Triangles::new(&plan);
    let merged = (0..20).map(|_| triangles.merged(&mut dice).len()).min().unwrap();
    let own = Regions::of(&plan).regions.len();
    assert!(own <= merged, "{own} regions, merged {merged}");
}

#[test]
fn regions_of_the_golden_plans_are_the_rooms_and_their_doorways_the_doors() {
    for name in GOLDEN {
        let plan = golden(name);
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/floorplans").join(name);
        let file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        let point = |value: &Value| Point::new(value[0].as_f64().unwrap(), value[1].as_f64().unwrap());
        let points = |value: &Value| value.as_array().unwrap().iter().map(point).collect::<Vec<_>>();
        let rooms: Vec<Vec<Point>> = file["rooms"].as_array().unwrap().iter().map(points).collect();
        check(&plan, rooms.iter().map(|room| shoelace(room)).sum());
        let found = Regions::of(&plan);
        assert_eq!(found.regions.len(), rooms.len());
        for room in &rooms {
            let is_room = |region: &&Region| room.iter().all(|&corner| region.contains(corner));
            let region = found.regions.iter().find(is_room).unwrap();
            assert!((region.area - shoelace(room)).abs() < 1e-9, "{name}");
        }
        let doors = file["doors"].as_array().unwrap();
        assert_eq!(found.doorways.len(), doors.len());
        for door in doors {
            let ends = points(&door["segment"]);
            let is_door = |from: Point, to: Point| {
                from.distance(ends[0]) + to.distance(ends[1]) < 1e-9
                    || from.distance(ends[1]) + to.distance(ends[0]) < 1e-9
            };
            assert!(
                found.doorways.iter().any(|doorway| is_door(doorway.from, doorway.to)),
                "{name}: {ends:?}"
            );
        }
    }
}

#[test]
fn no_more_regions_than_merged_triangles_and_on_most_random_plans_a_larger_one() {
    let (count, mut larger, mut smaller, mut own_regions, mut least_regions) = (100, 0, 0, 0, 0);
    for seed in 0..count {
        let plan = random_plan(seed, 1 + seed as usize % 25);
        let own = Regions::of(&plan).regions;
        let triangles = Triangles::new(&plan);
        let mut dice = Dice::new(seed);
        let merged: Vec<Vec<f64>> = (0..20).map(|_| triangles.merged(&mut dice)).collect();
        let best = merged.iter().min_by(|a, b| a.len().cmp(&b.len()).then(b[0].total_cmp(&a[0]))).unwrap();
        assert!(own.len() <= best.len(), "seed {seed}: {} regions, merged {}", own.len(), best.len());
        own_regions += own.len();
        least_regions += best.len();
        larger += usize::from(own[0].area > best[0] * (1.0 + 1e-9));
        smaller += usize::from(own[0].area < best[0] * (1.0 - 1e-9));
    }
    println!("{own_regions} regions, merged triangles {least_regions}");
    println!("the largest region of {count} plans: larger {larger} times, smaller {smaller} times");
    assert!(larger * 2 >= count as usize);
}

#[test]
fn the_same_plan_gives_the_same_regions_to_the_bit() {
    let plan = random_plan(7, 12);
    assert_eq!(Regions::of(&plan), Regions::of(&plan));
}
