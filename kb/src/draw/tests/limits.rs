//! Scenes at the edge of what there is: nothing in them, nonsense in them, layers of states over each other.

use adit_planners::geometry::{Point, Rect};

use super::example::scene;
use super::floor::floor;
use crate::draw::palette::{Palette, Scale, door_scale};
use crate::draw::png::parse;
use crate::draw::runs::runs;
use crate::draw::view::View;
use crate::draw::{Layer, Layers, Scene, StepKind, Style, render_svg};

#[test]
fn an_empty_scene_is_a_picture() {
    for bounds in
        [Rect::new(0.0, 0.0, 1.0, 1.0), Rect::new(0.0, 0.0, 0.0, 0.0), Rect::new(0.0, 0.0, f64::NAN, 1.0)]
    {
        parse(&render_svg(&Scene::new("", bounds), &Layers::of(&Layer::ALL), &Style::default())).unwrap();
    }
}

#[test]
fn numbers_that_are_none_do_not_break_the_picture() {
    let mut scene = scene();
    scene.rooms[0].outline = Rect::new(f64::NAN, 0.0, 1.0, 1.0).into();
    scene.doors[0].hardness = Some(f64::INFINITY);
    scene.doors[1].room1 = 99;
    scene.doors[2].at = Point::new(f64::NAN, f64::INFINITY);
    scene.doors[2].crossing = Some(Rect::new(f64::NAN, 0.0, 1.0, f64::INFINITY).into());
    scene.strips_x.push(f64::NAN);
    let route = scene.route.as_mut().unwrap();
    route.steps[3].to.x = f64::NAN;
    route.steps[6].heading = Some(f64::NAN);
    route.cost = f64::NAN;
    parse(&render_svg(&scene, &Layers::of(&Layer::ALL), &Style::default())).unwrap();
}

#[test]
fn of_overlapping_layers_one_is_drawn_and_what_the_route_uses_of_others() {
    let mut scene = floor(4);
    let mut low = scene.rooms[5].clone();
    low.state = Some("SQUAT".to_owned());
    for name in ["under the pipe", "elsewhere"] {
        name.clone_into(&mut low.name);
        scene.rooms.push(low.clone());
    }
    let route = scene.route.as_mut().unwrap();
    "under the pipe".clone_into(&mut route.steps[0].place);
    let view = View::of(&scene, &Layers::default());
    assert_eq!(view.state.as_deref(), Some("STAND"));
    assert_eq!((view.rooms.len(), view.route_rooms.as_slice()), (16, [16].as_slice()));

    let squat = Layers { state: Some("SQUAT".to_owned()), ..Layers::default() };
    assert_eq!(View::of(&scene, &squat).rooms, [16, 17]);
}

#[test]
fn a_route_is_told_in_runs_of_one_action_that_begin_with_their_change_of_shape() {
    let route = floor(4).route.unwrap();
    let runs = runs(&route);
    let told: Vec<_> = runs.iter().map(|run| (run.action.as_deref().unwrap(), run.changed)).collect();
    assert_eq!(told, [("WALK", false), ("WALK-ON-KNEE", true), ("WALK", true)]);
    let hardness: f64 = runs.iter().map(|run| run.hardness).sum();
    let steps: f64 = route.steps.iter().map(|step| step.hardness).sum();
    assert!((hardness - steps).abs() < 1e-9, "the runs add up to the route");
    assert!(runs.windows(2).all(|pair| pair[0].points.last() == pair[1].points.first()), "without a gap");
}

#[test]
fn a_step_without_an_action_continues_the_last_one() {
    let mut route = scene().route.unwrap();
    for step in route.steps.iter_mut().filter(|step| step.kind == StepKind::Door) {
        step.action = None;
    }
    let told: Vec<_> = runs(&route).into_iter().map(|run| run.action.unwrap()).collect();
    assert_eq!(told, ["WALK", "WALK-ON-KNEE", "WALK"]);
}

#[test]
fn colours_go_by_the_robot_table_or_by_first_use_and_not_by_name() {
    let mut scene = scene();
    scene.actions.clear();
    let first = Palette::of(&scene);
    assert_eq!(first.actions(), ["WALK", "WALK-ON-KNEE"]);
    assert_eq!(first.closed(), ["NO-ACTION"], "what leads through no passable door has no colour");
    scene.actions = ["WALK", "SIDE-WALK", "WALK-ON-KNEE", "NO-ACTION"].map(str::to_owned).to_vec();
    let listed = Palette::of(&scene);
    assert_eq!(listed.colour(Some("WALK")), first.colour(Some("WALK")));
    assert_eq!(listed.colour(Some("SIDE-WALK")), first.colour(Some("WALK-ON-KNEE")));
    assert_ne!(
        listed.dash(Some("WALK")),
        listed.dash(Some("WALK-ON-KNEE")),
        "in grey, dashes tell them apart"
    );
}

#[test]
fn harder_doors_are_darker_and_wider() {
    let scale = door_scale(&scene()).unwrap();
    assert_eq!(scale.limits.len(), 5);
    assert_eq!((scale.class(27.001_901), scale.class(39.697_794)), (0, 4));
    for class in 1..5 {
        assert!(Scale::width(class) > Scale::width(class - 1));
        assert!(luminance(Scale::colour(class)) < luminance(Scale::colour(class - 1)));
    }
}

fn luminance(colour: &str) -> f64 {
    let channel = |at: usize| f64::from(u8::from_str_radix(&colour[at..at + 2], 16).unwrap());
    0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5)
}

#[test]
fn equal_hardness_is_one_class_and_wide_ranges_are_cut_by_ratio() {
    assert_eq!(Scale::of([4.0, 4.0].into_iter()).unwrap().limits, [4.0]);
    assert_eq!(Scale::of([f64::NAN].into_iter()), None);
    let wide = Scale::of([1.0, 100_000.0].into_iter()).unwrap();
    assert!((wide.limits[0] - 10.0).abs() < 1e-6, "{wide:?}");
}
