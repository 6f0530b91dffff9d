//! The paper's example, figure by figure.

use super::example::scene;
use super::{ALL, picture};
use crate::draw::png::parse;
use crate::draw::{Layers, Style, render_png, render_svg};

/// What a text element of the picture says.
fn says(svg: &str, words: &str) -> bool {
    svg.contains(&format!(">{words}</text>"))
}

#[test]
fn figure_4_names_the_strips() {
    let svg = picture("figure-4", &scene(), "strips");
    assert!(["a", "b", "c", "d", "e", "1", "2", "3", "4", "5"].iter().all(|name| says(&svg, name)));
}

#[test]
fn figure_5_names_the_prime_areas() {
    let svg = picture("figure-5", &scene(), "primes");
    assert!(["A", "B", "C", "D", "E", "F", "G"].iter().all(|name| says(&svg, name)));
}

#[test]
fn figure_6_names_the_rooms() {
    let svg = picture("figure-6", &scene(), "rooms");
    assert!(["a", "b", "c", "d", "e", "f", "g"].iter().all(|name| says(&svg, name)));
    assert!(says(&svg, "under 4 m") && says(&svg, "under 15 m"));
}

#[test]
fn figure_7_is_the_graph_with_the_doors_numbers() {
    let svg = picture("figure-7", &scene(), "graph");
    assert!((1..=8).all(|number| says(&svg, &number.to_string())));
    assert!(!says(&svg, "27"));
}

#[test]
fn figure_9_is_the_graph_with_hardness() {
    let svg = picture("figure-9", &scene(), "weighted");
    assert!(["10000", "37", "28", "39.7", "33", "27", "34"].iter().all(|hardness| says(&svg, hardness)));
}

#[test]
fn the_whole_picture_tells_the_route_in_runs_of_one_action() {
    let svg = picture("example", &scene(), ALL);
    assert!(says(&svg, "f to e"));
    assert!(says(&svg, "room f, door 7, room d"));
    assert!(says(&svg, "door 3, room b, door 4"));
    assert!((1..=8).all(|number| says(&svg, &number.to_string())));
}

#[test]
fn every_layer_alone_and_none_is_an_svg_that_renders() {
    for layers in ["", "map", "rooms", "doors", "route", "legend", "strips", "primes", "graph", "weighted"] {
        let layers: Layers = layers.parse().unwrap();
        let svg = render_svg(&scene(), &layers, &Style::default());
        parse(&svg).unwrap();
    }
    parse(&render_svg(&scene(), &Layers::of(&[]), &Style::default())).unwrap();
}

#[test]
fn the_same_scene_gives_the_same_picture() {
    let svg = |()| render_svg(&scene(), &Layers::default(), &Style::default());
    assert_eq!(svg(()), svg(()));
}

#[test]
fn an_unknown_layer_is_named() {
    let error = "rooms,figures".parse::<Layers>().unwrap_err();
    assert!(error.to_string().contains("`figures`"));
}

#[test]
fn a_png_has_the_width_that_is_asked_for() {
    let svg = render_svg(&scene(), &Layers::default(), &Style::default());
    let png = render_png(&svg, 640).unwrap();
    assert_eq!(&png[1..4], b"PNG");
    let word = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    let size = parse(&svg).unwrap().size();
    assert_eq!(word(16), 640);
    assert_eq!(word(20), (size.height() / size.width() * 640.0).round() as u32);
}

#[test]
fn a_png_of_no_size_or_of_a_senseless_one_is_refused() {
    let svg = render_svg(&scene(), &Layers::default(), &Style::default());
    for width in [0, 20_001, u32::MAX] {
        assert!(render_png(&svg, width).unwrap_err().to_string().contains(&width.to_string()));
    }
    assert!(render_png("<svg", 100).is_err());
}
