//! What is wrong with a vector map is said with a code, the place and a help, all of it in one run.

use adit_planners::geometry::{Point, Rect};
use adit_planners::overlays::Overlays;
use adit_planners::planner::Planner as _;
use adit_planners::read::Overlay;
use adit_planners::read::diagnostic::{MapErrors, Problem};
use adit_planners::read::toml_map::read_toml_map;
use adit_planners::world::{Obstacle, Shape, World};
use miette::Diagnostic;

/// Code and the marked text of each problem, in the order in which they are said.
fn said(problems: &[Problem], text: &str) -> Vec<(&'static str, String)> {
    let marked = |problem: &Problem| {
        let label = problem.labels().and_then(|mut labels| labels.next());
        label.map_or(String::new(), |l| text[l.offset()..l.offset() + l.len()].to_owned())
    };
    problems.iter().map(|problem| (problem.code.as_str(), marked(problem))).collect()
}

fn errors(text: &str) -> MapErrors {
    read_toml_map("map.toml", text).unwrap_err()
}

/// The only problem of a map of 10 x 8 m with these items.
fn only(items: &str) -> (&'static str, String, Problem) {
    let text = format!("width = 10.0\ndepth = 8.0\n{items}");
    let problems = errors(&text).problems;
    let (code, marked) = said(&problems, &text).remove(0);
    assert_eq!(problems.len(), 1, "{problems:?}");
    (code, marked, problems[0].clone())
}

#[test]
fn an_unknown_key_is_marked_and_the_known_one_suggested() {
    let (code, marked, problem) = only("[[obstacle]]\nrekt = [1, 1, 2, 2]\nrect = [1, 1, 2, 2]");
    assert_eq!((code, marked.as_str()), ("map/unknown-key", "rekt"));
    assert_eq!(problem.message, "`rekt` is not a key of [[obstacle]]");
    assert_eq!(problem.help.as_deref(), Some("did you mean `rect`?"));
    let (code, marked, problem) = only("wall = 3");
    assert_eq!((code, marked.as_str()), ("map/unknown-key", "wall"));
    assert_eq!(
        problem.help.as_deref(),
        Some("known keys: width, depth, obstacle, bridge, place, area, door")
    );
}

#[test]
fn numbers_are_finite_and_sizes_positive() {
    let cases = [
        ("[[obstacle]]\nrect = [1, nan, 2, 2]", "map/not-finite", "nan"),
        ("[[obstacle]]\nrect = [1, 1, inf, 2]", "map/not-finite", "inf"),
        ("[[bridge]]\nrect = [1, 1, 2, 2]\nheight = -1.5", "map/not-positive", "-1.5"),
        ("[[bridge]]\nrect = [1, 1, 2, 2]\nheight = 0", "map/not-positive", "0"),
        ("[[bridge]]\nrect = [1, 1, 2, 2]\nheight = nan", "map/not-finite", "nan"),
        ("[[place]]\nname = 'a'\nat = [1, -inf]", "map/not-finite", "-inf"),
    ];
    for (items, code, marked) in cases {
        let found = only(items);
        assert_eq!((found.0, found.1.as_str()), (code, marked), "{items}");
    }
    for (width, code) in [("nan", "map/not-finite"), ("0.0", "map/not-positive"), ("-3", "map/not-positive")]
    {
        let text = format!("width = {width}\ndepth = 8.0");
        assert_eq!(said(&errors(&text).problems, &text), [(code, width.to_owned())]);
    }
}

#[test]
fn shapes_have_an_area_and_a_simple_outline() {
    let cases = [
        ("[[obstacle]]\nrect = [1, 1, 1, 2]", "map/degenerate", "a wall needs a thickness, say 0.1 m"),
        (
            "[[obstacle]]\npolygon = [[1, 2], [2, 2], [3, 2]]",
            "map/degenerate",
            "an outline has corners on either side: a wall needs a thickness, say 0.1 m",
        ),
        ("[[obstacle]]\nrect = [4, 1, 2, 2]", "map/degenerate", "did you mean [2, 1, 4, 2]?"),
        (
            "[[bridge]]\nrect = [1, 1, 2, 1]\nheight = 2",
            "map/degenerate",
            "a wall needs a thickness, say 0.1 m",
        ),
        (
            "[[obstacle]]\npolygon = [[1, 1], [3, 3], [3, 1], [1, 3]]",
            "map/self-crossing",
            "list the corners in order around the obstacle, each once",
        ),
    ];
    for (items, code, help) in cases {
        let found = only(items);
        assert_eq!((found.0, found.2.help.as_deref()), (code, Some(help)), "{items}");
    }
    assert_eq!(only("[[obstacle]]\npolygon = [[1, 1], [3, 3], [1, 1]]").0, "map/few-corners");
    assert_eq!(only("[[obstacle]]\nrect = [1, 1, 2]").0, "map/wrong-type");
    assert_eq!(only("[[obstacle]]\nrect = 'here'").0, "map/wrong-type");
    assert_eq!(only("[[obstacle]]\n").0, "map/missing-key");
    assert_eq!(only("[obstacle]\nrect = [1, 1, 2, 2]").0, "map/wrong-type");
}

#[test]
fn an_obstacle_outside_is_an_error_and_one_partly_outside_is_cut() {
    let (code, _, problem) = only("[[obstacle]]\nrect = [10, 1, 12, 2]");
    assert_eq!(code, "map/outside");
    assert!(problem.message.ends_with("the environment, which is x 0 to 10, y 0 to 8"));
    let text = "width = 10\ndepth = 8\n[[obstacle]]\nrect = [9, 1, 12, 2]";
    let (world, notes) = read_toml_map("map.toml", text).unwrap();
    assert_eq!(world.obstacles, [Obstacle { shape: Shape::Rect(Rect::new(9.0, 1.0, 10.0, 2.0)) }]);
    assert_eq!(said(&notes, text)[0].0, "map/clipped");
}

#[test]
fn a_place_is_named_once_inside_and_in_free_space() {
    let place = |name: &str, at: &str| format!("[[place]]\nname = '{name}'\nat = {at}\n");
    assert_eq!(only(&place(" ", "[1, 1]")).0, "map/empty-name");
    assert_eq!(only(&place("home", "[11, 1]")).0, "map/place-outside");
    let twice = place("home", "[1, 1]") + &place("home", "[2, 1]");
    let (code, marked, problem) = only(&twice);
    assert_eq!((code, marked.as_str()), ("map/duplicate-place", "'home'"));
    assert_eq!(problem.message, "`home` is already the name of the place on line 4");
    let inside = "[[obstacle]]\nrect = [4, 4, 6, 6]\n".to_owned() + &place("home", "[5, 5]");
    let (code, marked, problem) = only(&inside);
    assert_eq!((code, marked.as_str()), ("map/place-in-wall", "[5, 5]"));
    assert_eq!(problem.message, "the place `home` at (5, 5) lies inside the obstacle on line 3");
}

#[test]
fn a_key_that_is_misspelt_is_not_told_to_be_missing_as_well() {
    let (code, marked, problem) = only("[[obstacle]]\nrekt = [1, 1, 2, 2]");
    assert_eq!((code, marked.as_str()), ("map/unknown-key", "rekt"));
    assert_eq!(problem.help.as_deref(), Some("did you mean `rect`?"));
}

#[test]
fn one_run_shows_everything() {
    let text = "width = 10\ndepth = 8\nwidht = 3\n[[obstacle]]\nrect = [1, 1, 1, 2]\n[[bridge]]\n\
                rect = [1, 1, 2, 2]\nheight = 0\n[[place]]\nname = 'a'\nat = [20, 3]\n";
    let errors = errors(text);
    let codes: Vec<_> = errors.problems.iter().map(|problem| problem.code.as_str()).collect();
    let expected = ["map/unknown-key", "map/degenerate", "map/not-positive", "map/place-outside"];
    assert_eq!(codes, expected);
    assert_eq!(errors.to_string(), "`widht` is not a key of a map (and 3 more)");
}

#[test]
fn text_that_is_not_toml_is_marked_where_it_breaks() {
    let text = "width = 10\ndepth = = 8";
    let problems = errors(text).problems;
    assert_eq!(problems[0].code.as_str(), "map/syntax");
    let label = problems[0].labels().unwrap().next().unwrap();
    assert!(label.offset() >= text.find("= 8").unwrap() - 2);
}

#[test]
fn an_overlay_is_checked_against_the_map_below() {
    let mut world = World::empty(Rect::new(0.0, 0.0, 10.0, 8.0));
    world.obstacles.push(Obstacle { shape: Shape::Rect(Rect::new(1.0, 1.0, 2.0, 2.0)) });
    let overlay =
        Overlay::from_toml("site.toml", "map = 'm.toml'\n[[place]]\nname = 'a'\nat = [5, 5]").unwrap();
    overlay.lay_over(&mut world).unwrap();
    assert_eq!(world.places[0].at, Point::new(5.0, 5.0));
    let before = world.clone();
    let mut refused = |text: &str| {
        let overlay = Overlay::from_toml("site.toml", text).unwrap();
        let problems = overlay.lay_over(&mut world).unwrap_err().problems;
        assert_eq!(world, before, "a refused overlay changes nothing");
        said(&problems, text)[0].0
    };
    assert_eq!(refused("[[place]]\nname = 'a'\nat = [6, 5]"), "map/duplicate-place");
    assert_eq!(refused("[[place]]\nname = 'b'\nat = [1.5, 1.5]"), "map/place-in-wall");
    assert_eq!(refused("[[bridge]]\nrect = [14, 4, 16, 6]\nheight = 1"), "map/outside");
    // a pallet may be put down on a place
    let pallet = Overlay::from_toml("site.toml", "[[obstacle]]\nrect = [4, 4, 6, 6]").unwrap();
    assert!(pallet.lay_over(&mut world).is_ok());
    assert_eq!((world.obstacles.len(), world.places.len()), (2, 1));
}

#[test]
fn a_polygon_that_crosses_itself_names_the_two_edges() {
    let text = "[[area]]\nname = 'spot'\npolygon = [[1, 1], [4, 4], [4, 1], [1, 4]]";
    let (code, marked, problem) = only(text);
    assert_eq!((code, marked.as_str()), ("map/self-crossing", "[[1, 1], [4, 4], [4, 1], [1, 4]]"));
    assert_eq!(
        problem.message,
        "this polygon crosses itself: its edge from (1, 1) to (4, 4) meets its edge from (4, 1) to (1, 4)"
    );
    let all = format!("width = 10.0\ndepth = 8.0\n{text}");
    let labels: Vec<String> =
        problem.labels().unwrap().map(|l| all[l.offset()..l.offset() + l.len()].to_owned()).collect();
    assert_eq!(labels[1..], ["[1, 1]", "[4, 1]"]);
    let spike = only("[[area]]\nname = 'spot'\npolygon = [[1, 1], [4, 1], [4, 4], [4, 1.5], [1, 2]]");
    assert_eq!(spike.0, "map/self-crossing", "one edge leads back along the other");
}

#[test]
fn an_area_has_a_name_an_outline_and_a_surface() {
    let cases = [
        ("[[area]]\nrect = [1, 1, 2, 2]", "map/missing-key", "[[area]]"),
        ("[[area]]\nname = 'a'", "map/missing-key", "[[area]]"),
        ("[[area]]\nname = ' '\nrect = [1, 1, 2, 2]", "map/empty-name", "' '"),
        ("[[area]]\nname = 'a'\npolygon = [[1, 1], [2, 2]]", "map/few-corners", "[[1, 1], [2, 2]]"),
        (
            "[[area]]\nname = 'a'\npolygon = [[1, 1], [2, 2], [3, 3]]",
            "map/degenerate",
            "[[1, 1], [2, 2], [3, 3]]",
        ),
        ("[[area]]\nname = 'a'\nrect = [1, 1, 1, 2]", "map/degenerate", "[1, 1, 1, 2]"),
        ("[[area]]\nname = 'a'\nrect = [11, 1, 12, 2]", "map/outside", "'a'"),
        // the rectangle about the triangle meets the map, the triangle does not
        ("[[area]]\nname = 'a'\npolygon = [[9, 9], [12, 6], [12, 9]]", "map/outside", "'a'"),
    ];
    for (items, code, marked) in cases {
        let found = only(items);
        assert_eq!((found.0, found.1.as_str()), (code, marked), "{items}");
    }
    let (_, _, problem) = only("[[area]]\nname = 'a'\nrekt = 'b'");
    assert_eq!(problem.help.as_deref(), Some("is `rekt` meant to be `rect`?"));
}

#[test]
fn a_door_has_a_name_and_two_posts_in_the_map() {
    let cases = [
        ("[[door]]\nname = 'd'\nfrom = [1, 1]", "map/missing-key", "[[door]]"),
        ("[[door]]\nname = 'd'\nfrom = [1, 1]\nto = [1, 1]", "map/degenerate", "[1, 1]"),
        ("[[door]]\nname = 'd'\nfrom = [11, 1]\nto = [12, 1]", "map/outside", "'d'"),
        ("[[door]]\nname = 'd'\nfrom = [9, 9]\nto = [12, 6.5]", "map/outside", "'d'"),
    ];
    for (items, code, marked) in cases {
        let found = only(items);
        assert_eq!((found.0, found.1.as_str()), (code, marked), "{items}");
    }
}

#[test]
fn what_is_cut_at_the_edge_or_lies_in_a_wall_is_noted() {
    let text = "width = 10.0\ndepth = 8.0
        [[obstacle]]\nrect = [4.0, 0.0, 6.0, 4.0]
        [[area]]\nname = 'rect'\nrect = [8, 1, 12, 2]
        [[area]]\nname = 'corner'\npolygon = [[9, 0], [11, 0], [11, 2], [9, 2]]
        [[door]]\nname = 'gate'\nfrom = [9, 5]\nto = [11, 5]
        [[door]]\nname = 'bricked up'\nfrom = [4.5, 2]\nto = [5.5, 2]
        [[door]]\nname = 'to the wall'\nfrom = [3.5, 2]\nto = [5.5, 2]";
    let (world, notes) = read_toml_map("map.toml", text).unwrap();
    let expected = ["'rect'", "'corner'", "'gate'", "'bricked up'"];
    let codes = ["map/clipped", "map/clipped", "map/clipped", "map/door-in-wall"];
    let expected: Vec<_> = codes.into_iter().zip(expected.map(str::to_owned)).collect();
    assert_eq!(said(&notes, text), expected);
    let middles: Vec<Point> = world.areas.iter().map(|area| area.centre).collect();
    assert_eq!(middles, [Point::new(9.0, 1.5), Point::new(9.5, 1.0)], "of what lies in the map");
    assert_eq!(world.named_doors[0].to, Point::new(10.0, 5.0));
}

#[test]
fn places_areas_and_doors_share_one_space_of_names() {
    let place = "[[place]]\nname = 'ward'\nat = [1, 1]\n";
    let area = "[[area]]\nname = 'ward'\nrect = [1, 1, 2, 2]\n";
    let door = "[[door]]\nname = 'ward'\nfrom = [1, 1]\nto = [2, 1]\n";
    for (items, first) in [
        (format!("{place}{area}"), "place"),
        (format!("{area}{door}"), "area"),
        (format!("{door}{door}"), "door"),
    ] {
        let (code, _, problem) = only(&items);
        assert_eq!(code, "map/duplicate-name");
        assert_eq!(problem.message, format!("`ward` is already the name of the {first} on line 4"));
    }
    // across two files
    let (mut world, _) = read_toml_map("map.toml", &format!("width = 10.0\ndepth = 8.0\n{area}")).unwrap();
    let before = world.clone();
    for items in [place, area, door] {
        let overlay = Overlay::from_toml("site.toml", items).unwrap();
        let problems = overlay.lay_over(&mut world).unwrap_err().problems;
        assert_eq!(problems[0].message, "the map has an area `ward` already");
        assert_eq!(world, before);
    }
}

#[test]
fn what_else_is_said_of_areas_has_a_name_for_rules_and_one_kind() {
    let area = |name: &str, more: &str| format!("[[area]]\nname = '{name}'\nrect = [1, 1, 2, 2]\n{more}\n");
    let cases = [
        (area("a", "Floor = 1"), "map/unknown-key", "Floor"),
        (area("a", "'two words' = 1"), "map/unknown-key", "'two words'"),
        (area("a", "x = 1"), "map/unknown-key", "x"),
        (area("a", "floor = [1, 2]"), "map/wrong-type", "[1, 2]"),
        (area("a", "floor = nan"), "map/not-finite", "nan"),
        (area("a", "hardness_factor = 'two'"), "map/wrong-type", "hardness_factor = 'two'"),
        (area("a", "floor = 1") + &area("b", "floor = 'one'"), "map/wrong-type", "floor = 'one'"),
    ];
    for (items, code, marked) in cases {
        let found = only(&items);
        assert_eq!((found.0, found.1.as_str()), (code, marked), "{items}");
    }
    let (mut world, _) =
        read_toml_map("map.toml", &format!("width = 10.0\ndepth = 8.0\n{}", area("a", "floor = 1"))).unwrap();
    let overlay = Overlay::from_toml("site.toml", &area("b", "floor = true\nwet = true")).unwrap();
    let mut empty = World::empty(world.bounds);
    overlay.clone().lay_over(&mut empty).unwrap();
    let gives = Overlays::of(&empty).signature().gives;
    let further: Vec<_> =
        gives.iter().filter(|given| !Overlays::default().signature().gives.contains(given)).collect();
    assert_eq!(further, ["AREAS.floor: truth", "AREAS.wet: truth"]);
    let problems = overlay.lay_over(&mut world).unwrap_err().problems;
    assert!(problems[0].message.contains("`floor` is a truth here and a number in the map"), "{problems:?}");
}
