//! Waltz's labelling: what the rules find is what an independent search finds.

use std::collections::BTreeMap;

use adit_engine::Limits;

#[path = "../../examples/waltz/scene.rs"]
mod scene;

use scene::{Labels, Line, MEANINGS, labels, picture, rules, scene};

type Point = (i32, i32);

/// A junction: its kind, and its neighbours counter-clockwise.
fn junctions(lines: &[Line]) -> BTreeMap<Point, (&'static str, Vec<Point>)> {
    let mut neighbours: BTreeMap<Point, Vec<Point>> = BTreeMap::new();
    for &[x1, y1, x2, y2] in lines {
        neighbours.entry((x1, y1)).or_default().push((x2, y2));
        neighbours.entry((x2, y2)).or_default().push((x1, y1));
    }
    let junction = |(at, mut arms): (Point, Vec<Point>)| {
        let angle = |to: &Point| f64::from(to.1 - at.1).atan2(f64::from(to.0 - at.0));
        arms.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        let gap = |nth: usize| {
            (angle(&arms[(nth + 1) % arms.len()]) - angle(&arms[nth])).rem_euclid(std::f64::consts::TAU)
        };
        let widest = (0..arms.len()).max_by(|&a, &b| gap(a).total_cmp(&gap(b))).unwrap();
        let turn = gap(widest) - std::f64::consts::PI;
        let kind = match arms.len() {
            2 => "L",
            _ if turn.abs() < 1e-9 => "tee",
            _ if turn > 0.0 => "arrow",
            _ => "fork",
        };
        let first = (widest + 1) % arms.len();
        arms.rotate_left(first);
        (at, (kind, arms))
    };
    neighbours.into_iter().map(junction).collect()
}

/// The edges between the scene and the background, from junction to junction with the background on the left.
fn contour(junctions: &BTreeMap<Point, (&str, Vec<Point>)>) -> Vec<(Point, Point)> {
    let (&first, (_, arms)) = junctions.iter().next().unwrap();
    let steep = |to: &&Point| f64::from(to.1 - first.1).atan2(f64::from(to.0 - first.0));
    let second = *arms.iter().max_by(|a, b| steep(a).total_cmp(&steep(b))).unwrap();
    let mut walk = vec![(first, second)];
    loop {
        let &(from, at) = walk.last().unwrap();
        let arms = &junctions[&at].1;
        let came = arms.iter().position(|&arm| arm == from).unwrap();
        let next = (at, arms[(came + arms.len() - 1) % arms.len()]);
        if next == walk[0] {
            return walk;
        }
        walk.push(next);
    }
}

fn seen_from_there(label: &str) -> &str {
    match label {
        ">" => "<",
        "<" => ">",
        same => same,
    }
}

/// All labellings in which every junction means something, by trying every meaning of one junction after the other.
fn labellings(lines: &[Line]) -> Vec<Labels> {
    let junctions = junctions(lines);
    let mut found = vec![];
    let mut known = Labels::new();
    for (from, to) in contour(&junctions) {
        known.insert((from, to), ">".to_owned());
        known.insert((to, from), "<".to_owned());
    }
    let order: Vec<Point> = junctions.keys().copied().collect();
    try_all(&junctions, &order, &known, &mut found);
    found
}

fn try_all(
    junctions: &BTreeMap<Point, (&str, Vec<Point>)>,
    open: &[Point],
    known: &Labels,
    found: &mut Vec<Labels>,
) {
    let Some((&at, rest)) = open.split_first() else {
        found.push(known.clone());
        return;
    };
    let (kind, arms) = &junctions[&at];
    for (_, meaning) in MEANINGS.iter().filter(|(of, _)| of == kind) {
        let mut labels = known.clone();
        let fits = arms.iter().zip(meaning).all(|(&to, &label)| {
            labels.insert((to, at), seen_from_there(label).to_owned());
            labels.insert((at, to), label.to_owned()).is_none_or(|before| before == label)
        });
        if fits {
            try_all(junctions, rest, &labels, found);
        }
    }
}

fn labelled(lines: &[Line], copies: usize) -> Labels {
    let mut base = picture(lines, copies, Limits { firings: 100_000, ..Limits::default() }).unwrap();
    let rules = rules().unwrap();
    let run = base.react(&rules);
    assert!(run.diagnostics.is_empty(), "{:?}", run.diagnostics);
    labels(&base)
}

#[test]
fn small_scenes_are_read_as_an_independent_search_reads_them() {
    for cubes in [0, 1, 2] {
        let lines = scene(cubes);
        let right = labellings(&lines);
        assert_eq!(right.len(), 1, "the scene can be read in one way");
        assert_eq!(labelled(&lines, 1), right[0]);
    }
}

#[test]
fn twelve_regions_are_read_as_one_is() {
    let lines = scene(5);
    let right = labellings(&lines);
    assert_eq!(right.len(), 1);
    let all = labelled(&lines, 12);
    assert_eq!(all.len(), 12 * 2 * lines.len());
    for copy in 0..12 {
        for (((x1, y1), (x2, y2)), label) in &right[0] {
            let x = 500 * copy;
            assert_eq!(&all[&((x1 + x, *y1), (x2 + x, *y2))], label);
        }
    }
}
