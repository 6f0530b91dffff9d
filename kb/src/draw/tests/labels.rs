//! Texts: whatever they say, they are texts; and a room's name stays in its room.

use resvg::usvg::{Group, Node, Text};

use super::example::scene;
use super::floor::floor;
use crate::draw::frame::{Block, Frame};
use crate::draw::png::parse;
use crate::draw::{Layer, Layers, Scene, Style, render_svg, text};

const HOSTILE: [&str; 5] = [
    "<script>alert(1)</script>",
    "\"/><image href='file:///etc/passwd'/>",
    "a & b",
    "\u{0}\u{b}\u{ffff}",
    "'",
];

#[test]
fn hostile_names_are_only_text() {
    for name in HOSTILE {
        let mut scene = scene();
        name.clone_into(&mut scene.title);
        scene.actions = vec![name.to_owned()];
        for room in &mut scene.rooms {
            name.clone_into(&mut room.name);
            room.action = Some(name.to_owned());
        }
        name.clone_into(&mut scene.places[0].name);
        for area in &mut scene.prime_areas {
            name.clone_into(&mut area.label);
        }
        let route = scene.route.as_mut().unwrap();
        name.clone_into(&mut route.goal.name);
        route.steps[2].place = name.to_owned();
        let svg = render_svg(&scene, &Layers::of(&Layer::ALL), &Style::default());
        parse(&svg).unwrap();
        assert!(!svg.contains("<script") && !svg.contains("<image"));
    }
}

/// Every text of a picture, with where it lies.
fn texts(group: &Group, found: &mut Vec<(String, Block)>) {
    for node in group.children() {
        match node {
            Node::Group(inner) => texts(inner, found),
            Node::Text(text) => found.push((content(text), extent(text))),
            _ => {}
        }
    }
}

fn content(text: &Text) -> String {
    text.chunks().iter().map(|chunk| chunk.text().to_owned()).collect()
}

fn extent(text: &Text) -> Block {
    let r = text.abs_bounding_box();
    Block { x: r.x().into(), y: r.y().into(), w: r.width().into(), h: r.height().into() }
}

fn texts_of(scene: &Scene, layers: &str) -> Vec<(String, Block)> {
    let layers: Layers = layers.parse().unwrap();
    let tree =
        parse(&render_svg(scene, &layers, &Style { map_px: Some(1000.0), ..Style::default() })).unwrap();
    let mut found = Vec::new();
    texts(tree.root(), &mut found);
    found
}

#[test]
fn the_name_of_a_room_lies_inside_it() {
    for scene in [scene(), floor(8), floor(25)] {
        let frame = Frame::new(scene.bounds, 1000.0, 20.0, 56.0);
        let found = texts_of(&scene, "rooms");
        let mut named = 0;
        for room in &scene.rooms {
            let block = frame.block(&room.outline.bounds()).inset(-0.5);
            for (_, extent) in found.iter().filter(|(name, _)| *name == room.name) {
                assert!(block.encloses(extent), "{}: {extent:?} leaves {block:?}", room.name);
                named += 1;
            }
        }
        assert!(named > scene.rooms.len(), "a halo and a text for most of {} rooms", scene.rooms.len());
    }
}

#[test]
fn labels_on_the_map_do_not_overlap() {
    for scene in [scene(), floor(8), floor(25)] {
        let mut found = texts_of(&scene, "rooms,doors,route");
        // A label is a halo and a text in the same place; the title is above the map.
        found.retain(|(name, _)| *name != scene.title);
        found.dedup_by(|a, b| a.0 == b.0 && a.1.inset(2.0).overlaps(&b.1));
        for (i, (a, first)) in found.iter().enumerate() {
            for (b, second) in &found[i + 1..] {
                assert!(!first.inset(1.5).overlaps(&second.inset(1.5)), "{a} lies on {b}");
            }
        }
    }
}

#[test]
fn a_width_is_rather_too_long_than_too_short() {
    for words in ["WALK-ON-KNEE", "room f, door 7", "Minimum", "(0.45)"] {
        let svg = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='999' height='50'>\
             <text y='20' font-size='10'>{words}</text></svg>"
        );
        let mut found = Vec::new();
        texts(parse(&svg).unwrap().root(), &mut found);
        let real = found[0].1.w;
        let ours = text::width(words, 10.0);
        assert!(real <= ours && ours <= real * 1.3, "{words}: {ours} for {real}");
    }
}

#[test]
fn what_is_too_long_ends_in_an_ellipsis() {
    assert_eq!(text::fit("dock", 10.0, 100.0), "dock");
    let short = text::fit("a very long name of a place", 10.0, 60.0);
    assert!(short.ends_with('…') && text::width(&short, 10.0) <= 60.0, "{short}");
}

#[test]
fn figures_have_three_digits() {
    let figures = [92.007_434, 10000.0, 0.5, 0.0, 1.0, 39.7, 1234.5, 1e-9, 3e9].map(text::figure);
    assert_eq!(figures, ["92", "10000", "0.5", "0", "1", "39.7", "1234", "1.0e-9", "3.0e9"]);
}

#[test]
fn strips_are_lettered_like_rooms() {
    assert_eq!([0, 25, 26, 27, 701, 702].map(text::letters), ["a", "z", "aa", "ab", "zz", "aaa"]);
}
