//! Maps of sites as floor plans: what was drawn, and what was scanned.

use std::time::Instant;

use adit_tests::{TestSite, shared};

use super::flat::on;

/// 6 x 4 m in cells of 0.1 m: a wall across with a door of 1 m, and a pillar.
fn scanned() -> TestSite {
    let (columns, rows) = (60, 40);
    let is_wall = |column: usize, row: usize| {
        let is_edge = column == 0 || row == 0 || column == columns - 1 || row == rows - 1;
        let is_across = column == 30 && !(15..25).contains(&row);
        is_edge || is_across || ((10..14).contains(&column) && (10..14).contains(&row))
    };
    let cells = (0..columns * rows).map(|cell| if is_wall(cell % columns, cell / columns) { 0 } else { 254 });
    let mut image = format!("P5\n{columns} {rows}\n255\n").into_bytes();
    image.extend(cells);
    let folder = TestSite::empty();
    folder.write("map.pgm", image);
    folder.write(
        "map.yaml",
        "image: map.pgm\nresolution: 0.1\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n",
    );
    folder.write(
        "world.toml",
        "[floor_plan]\nmap = \"map.yaml\"\nrobot = { radius = 0.2 }\n\n[[place]]\nname = \"dock\"\nat = [0.6, 2.0]\n\n[[place]]\nname = \"desk\"\nat = [5.0, 3.0]\n",
    );
    folder
}

#[test]
fn a_scanned_map_is_planned_on_driven_through_and_drawn() {
    let folder = scanned();
    let run = |verb: &str, args: &[&str]| on(&folder, verb, "world.toml", args);
    let found = run("route", &["dock", "desk", "--json"]).expect_status(0).json();
    run("draw", &["-o", "map.svg"]).expect_status(0);
    let length = found["distance"].as_f64().expect("a length");
    let straight = f64::hypot(4.4, 1.0);
    assert!(length > straight && length < 1.2 * straight, "{length}");
    assert!(folder.read("map.svg").contains("<g id=\"solids\">"));
    let rows = run("simulate", &["dock", "desk", "--json"]).expect_status(0).json();
    assert_eq!(rows[0]["ending"], "arrived");
    // A box laid over the map closes the door.
    let door = "\n[[obstacle]]\nrect = [2.9, 1.0, 3.2, 3.0]\n";
    folder.write("world.toml", folder.read("world.toml") + door);
    on(&folder, "route", "world.toml", &["dock", "desk"]).expect_status(1);
}

#[test]
fn a_drawn_map_is_a_floor_plan_too() {
    let folder = TestSite::empty();
    folder.write(
        "map.toml",
        "width = 8.0\ndepth = 6.0\n[[obstacle]]\nrect = [4.0, 0.0, 4.2, 4.5]\n[[place]]\nname = \"left\"\nat = [1.0, 1.0]\n[[place]]\nname = \"right\"\nat = [7.0, 1.0]\n",
    );
    folder.write("world.toml", "[floor_plan]\nmap = \"map.toml\"\n");
    let found = on(&folder, "route", "world.toml", &["left", "right", "--json"]).expect_status(0).json();
    assert!(found["distance"].as_f64().expect("a length") > 2.0 * f64::hypot(3.0, 3.7), "{found}");
    folder.edit("map.toml", "[1.0, 1.0]", "[4.1, 1.0]");
    on(&folder, "route", "world.toml", &["left", "right"])
        .expect_status(2)
        .complains(&["map.toml:7", "left"]);
}

/// 8 x 6 m, with a pipe of 1.3 m across the straight way, and a way round it.
const PIPE: &str = "width = 8.0\ndepth = 6.0\n[[bridge]]\nrect = [3.8, 0.0, 4.2, 4.5]\nheight = 1.3\n[[place]]\nname = \"left\"\nat = [1.0, 1.0]\n[[place]]\nname = \"right\"\nat = [7.0, 1.0]\n";

#[test]
fn a_low_bridge_is_driven_round_and_a_high_one_under() {
    let folder = TestSite::empty().with("map.toml", PIPE);
    let world = |height: &str| {
        folder.write(
            "world.toml",
            format!("[floor_plan]\nmap = \"map.toml\"\nrobot = {{ radius = 0.25{height} }}\n"),
        );
    };
    let length = |verb: &str| {
        let found = on(&folder, verb, "world.toml", &["left", "right", "--json"]).expect_status(0).json();
        let metres = if verb == "route" { &found["distance"] } else { &found[0]["length"] };
        metres.as_f64().expect("a length")
    };
    let round = 2.0 * f64::hypot(2.8, 3.5);
    world(", height = 1.2");
    assert!(length("route") < 6.1, "{}", length("route"));
    for height in [", height = 1.3", ", height = 1.7"] {
        world(height);
        assert!(length("route") > round && length("simulate") > round, "{} under {height}", length("route"));
    }
    world("");
    for verb in ["route", "simulate"] {
        on(&folder, verb, "world.toml", &["left", "right"]).expect_status(2).complains(&[
            "the map has a bridge of 1.3 m at (3.8, 0) to (4.2, 4.5)",
            "`robot` has no `height`",
            "world.toml:3",
        ]);
    }
    // one that the world itself lays over its map
    folder.write("map.toml", PIPE.replace("[[bridge]]\nrect = [3.8, 0.0, 4.2, 4.5]\nheight = 1.3\n", ""));
    world(", height = 1.7");
    let open = folder.read("world.toml");
    folder.write("world.toml", open + "[[bridge]]\nrect = [3.8, 0.0, 4.2, 4.5]\nheight = 1.3\n");
    assert!(length("route") > round);
}

#[test]
fn what_a_site_lays_over_its_map_counts_on_the_floor_plan_too() {
    let folder = TestSite::empty().with("map.toml", PIPE);
    folder.write("map.toml", PIPE.replace("height = 1.3", "height = 3.0"));
    folder.write("world.toml", "[floor_plan]\nmap = \"map.toml\"\nrobot = { radius = 0.25, height = 1.0 }\n");
    let length = || {
        let found = on(&folder, "route", "world.toml", &["left", "right", "--json"]).expect_status(0).json();
        found["distance"].as_f64().expect("a length")
    };
    assert!(length() < 6.1);
    let site = "map = \"map.toml\"\n[[obstacle]]\nrect = [3.8, 0.0, 4.2, 4.5]\n";
    folder.write("site.toml", site);
    assert!(length() > 2.0 * f64::hypot(2.8, 3.5), "{}", length());
    folder.write("site.toml", site.replace("map.toml", "other.toml"));
    assert!(length() < 6.1, "the site of another map");
    folder.write("site.toml", "map = \"map.toml\"\n[[obstacle]]\nrekt = [3.8, 0.0, 4.2, 4.5]\n");
    on(&folder, "route", "world.toml", &["left", "right"])
        .expect_status(2)
        .complains(&["site.toml:3", "rekt"]);
}

#[test]
fn areas_and_doors_that_say_more_than_a_name_are_open_or_closed() {
    let folder = TestSite::empty();
    let overlays = "[[area]]\nname = \"pit\"\nkind = \"keep-out\"\nrect = [3.8, 0.0, 4.2, 4.5]\n[[area]]\nname = \"lounge\"\nrect = [0.0, 0.0, 2.0, 2.0]\n[[door]]\nname = \"gate\"\nfrom = [3.0, 0.0]\nto = [3.0, 4.5]\nclosed = true\n";
    let free = PIPE.replace("height = 1.3", "height = 3.0");
    folder.write("map.toml", format!("{free}{overlays}"));
    let plan = |keys: &str| {
        let text =
            format!("[floor_plan]\nmap = \"map.toml\"\n{keys}robot = {{ radius = 0.25, height = 1.0 }}\n");
        folder.write("world.toml", text);
        on(&folder, "route", "world.toml", &["left", "right", "--json"])
    };
    plan("").expect_status(2).complains(&[
        "the map has the area `pit` (kind keep-out), and nothing says whether the robot may go there",
        "the map has the door `gate` (closed true)",
    ]);
    plan("open = [\"pit\"]\n").expect_status(2).complains(&["gate"]);
    let length = |keys: &str| plan(keys).expect_status(0).json()["distance"].as_f64().expect("a length");
    assert!(length("open = [\"pit\", \"gate\"]\n") < 6.1);
    let round = 2.0 * f64::hypot(2.0, 3.5);
    for keys in [
        "closed = [\"pit\", \"gate\"]\n",
        "open = [\"pit\"]\nclosed = [\"gate\"]\n",
        "open = [\"gate\"]\nclosed = [\"pit\"]\n",
    ] {
        assert!(length(keys) > round, "{keys}");
    }
    plan("open = [\"pit\", \"gat\"]\n").expect_status(2).complains(&["no area or door `gat`", "gate"]);
    plan("open = \"pit\"\n").expect_status(2).complains(&["`open`", "a list of names"]);
}

#[test]
fn maps_of_other_people_are_floor_plans() {
    for (map, from, to) in MAPS {
        let Some(path) = shared(map) else { continue };
        let folder = TestSite::empty();
        let text = format!(
            "[floor_plan]\nmap = \"{}\"\nspeck_area = 0.05\nrobot = {{ radius = 0.2 }}\n",
            path.display()
        );
        folder.write("world.toml", text);
        let begun = Instant::now();
        let found = on(&folder, "route", "world.toml", &[from, to, "--json"]).expect_status(0).json();
        assert_eq!(found["status"], "ok", "{map}");
        assert!(begun.elapsed().as_secs() < 60, "{map} took {:?}", begun.elapsed());
    }
}

/// Maps, and two points that are joined on them.
const MAPS: [(&str, &str, &str); 2] = [
    ("data/stage/lse_arena.yaml", "1.4,1.52", "2.05,2.65"),
    ("data/mir_robot/maze.yaml", "8.23,18.81", "18.79,7.33"),
];
