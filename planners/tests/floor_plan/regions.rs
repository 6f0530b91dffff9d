//! Regions are convex, disjoint and covering; no more of them than merged triangles give, and the largest is larger.

use std::path::Path;

use adit_planners::floor_plan::{FloorPlan, Regions, read_floor_plan};

use super::dice::Dice;
use super::hertel_mehlhorn::Triangles;
use super::random_plan::random_plan;

pub fn golden(name: &str) -> FloorPlan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/floorplans").join(name);
    read_floor_plan(&path).unwrap()
}

#[test]
fn probe() {
    for name in ["house-7.json", "office-14.json", "plant-25.json"] {
        let plan = golden(name);
        let regions = Regions::of(&plan);
        println!("{name} {} {}", regions.regions.len(), regions.doorways.len());
    }
    let (mut more, mut larger, mut smaller, mut fewer) = (0, 0, 0, 0);
    let count = 200;
    let mut spent = std::time::Duration::ZERO;
    for seed in 0..count {
        let plan = random_plan(seed, 1 + seed as usize % 25);
        let start = std::time::Instant::now();
        let regions = Regions::of(&plan);
        spent += start.elapsed();
        let total: f64 = regions.regions.iter().map(|r| r.area).sum();
        assert!((total / plan.free_area() - 1.0).abs() < 1e-9, "{seed} {total} {}", plan.free_area());
        let triangles = Triangles::new(&plan);
        let mut dice = Dice::new(seed);
        let merged: Vec<Vec<f64>> = (0..20).map(|_| triangles.merged(&mut dice)).collect();
        let least = merged.iter().map(Vec::len).min().unwrap();
        let largest = merged.iter().filter(|m| m.len() == least).map(|m| m[0]).fold(0.0, f64::max);
        let own = regions.regions[0].area;
        if regions.regions.len() > least { more += 1; println!("more {seed}: {} {least}", regions.regions.len()); }
        if regions.regions.len() < least { fewer += 1; }
        if own > largest * (1.0 + 1e-9) { larger += 1; }
        if own < largest * (1.0 - 1e-9) { smaller += 1; println!("smaller {seed}: {own} {largest}; {} {least}", regions.regions.len()); }
    }
    println!("more {more} fewer {fewer} larger {larger} smaller {smaller} of {count}; {spent:?}");
}

#[test]
fn dump() {
    for seed in [30_u64, 52, 132] {
        let d = super::random_plan::random_drawing(seed, 1 + seed as usize % 25);
        let p = |p: &adit_planners::geometry::Point| [p.x, p.y];
        let json = serde_json::json!({"walls": d.walls.iter().map(|w| w.iter().map(p).collect::<Vec<_>>()).collect::<Vec<_>>(), "solids": d.solids.iter().map(|w| w.iter().map(p).collect::<Vec<_>>()).collect::<Vec<_>>()});
        std::fs::write(format!("/tmp/rp{seed}.json"), json.to_string()).unwrap();
    }
}
