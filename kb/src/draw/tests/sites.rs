//! The buildings that come with the program are sound: each place stands free, nothing lies outside.

use adit_planners::geometry::{Point, Rect};
use adit_planners::world::{Bridge, Place, Shape};
use toml::{Table, Value};

use super::picture;
use crate::draw::Scene;

const CLINIC: &str = include_str!("../../../sites/clinic/map.toml");
const PAPER: &str = include_str!("../../../sites/paper/map.toml");

fn number(value: &Value) -> f64 {
    value.as_float().or_else(|| value.as_integer().map(|i| i as f64)).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

fn rect(value: &Value) -> Rect {
    let n = numbers(value);
    Rect::new(n[0], n[1], n[2], n[3])
}

fn point(value: &Value) -> Point {
    let n = numbers(value);
    Point::new(n[0], n[1])
}

fn shape(entry: &Value) -> Shape {
    match entry.get("polygon") {
        Some(corners) => Shape::Polygon(corners.as_array().unwrap().iter().map(point).collect()),
        None => Shape::Rect(rect(&entry["rect"])),
    }
}

fn site(name: &str, map: &str) -> Scene {
    let map: Table = map.parse().unwrap();
    let list = |key: &str| map[key].as_array().unwrap().iter();
    Scene {
        obstacles: list("obstacle").map(shape).collect(),
        bridges: list("bridge")
            .map(|b| Bridge { rect: rect(&b["rect"]), height: number(&b["height"]) })
            .collect(),
        places: list("place")
            .map(|p| Place { name: p["name"].as_str().unwrap().to_owned(), at: point(&p["at"]) })
            .collect(),
        ..Scene::new(name, Rect::new(0.0, 0.0, number(&map["width"]), number(&map["depth"])))
    }
}

#[test]
fn in_the_sites_each_place_stands_free_and_nothing_lies_outside() {
    for (name, map) in [("clinic", CLINIC), ("paper", PAPER)] {
        let scene = site(name, map);
        picture(&format!("site-{name}"), &scene, "map");
        for outline in
            scene.obstacles.iter().map(Shape::enclosing_rect).chain(scene.bridges.iter().map(|b| b.rect))
        {
            assert!(outline.area() > 0.0 && scene.bounds.encloses(&outline), "{name}: {outline:?}");
        }
        for place in &scene.places {
            let inside = |shape: &Shape| shape.enclosing_rect().contains(place.at);
            assert!(scene.bounds.contains(place.at), "{name}: {place:?}");
            assert!(!scene.obstacles.iter().any(inside), "{name}: {place:?}");
        }
    }
}

#[test]
fn the_clinic_has_its_places_by_name_and_no_walls_that_lie_over_each_other() {
    let scene = site("clinic", CLINIC);
    assert!(
        ["dock", "pharmacy", "kitchen", "lab", "store", "plant room", "ward 1", "ward 14"]
            .iter()
            .all(|name| scene.places.iter().any(|place| place.name == *name))
    );
    let rects: Vec<Rect> = scene
        .obstacles
        .iter()
        .filter_map(|shape| if let Shape::Rect(rect) = shape { Some(*rect) } else { None })
        .collect();
    for (i, a) in rects.iter().enumerate() {
        for b in &rects[i + 1..] {
            let common = a.intersection(b).map_or(0.0, |common| common.smaller_side());
            assert!(common < 1e-9, "{a:?} overlaps {b:?}");
        }
    }
}
