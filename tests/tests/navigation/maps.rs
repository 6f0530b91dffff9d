//! Maps of sites as floor plans: what was drawn, and what was scanned.

use std::time::Instant;

use adit_tests::{TestSite, shared};

use crate::flat::on;

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
    let found = run("plan", &["dock", "desk", "-o", "map.svg", "--json"]).expect_status(0).json();
    let length = found["length"].as_f64().expect("a length");
    let straight = f64::hypot(4.4, 1.0);
    assert!(length > straight && length < 1.2 * straight, "{length}");
    assert!(folder.read("map.svg").contains("<g id=\"solids\">"));
    let rows = run("simulate", &["dock", "desk", "--json"]).expect_status(0).json();
    assert_eq!(rows[0]["ending"], "arrived");
    // A box laid over the map closes the door.
    let door = "\n[[obstacle]]\nrect = [2.9, 1.0, 3.2, 3.0]\n";
    folder.write("world.toml", folder.read("world.toml") + door);
    on(&folder, "plan", "world.toml", &["dock", "desk"]).expect_status(1);
}

#[test]
fn a_drawn_map_is_a_floor_plan_too() {
    let folder = TestSite::empty();
    folder.write(
        "map.toml",
        "width = 8.0\ndepth = 6.0\n[[obstacle]]\nrect = [4.0, 0.0, 4.2, 4.5]\n[[place]]\nname = \"left\"\nat = [1.0, 1.0]\n[[place]]\nname = \"right\"\nat = [7.0, 1.0]\n",
    );
    folder.write("world.toml", "[floor_plan]\nmap = \"map.toml\"\n");
    let found = on(&folder, "plan", "world.toml", &["left", "right", "--json"]).expect_status(0).json();
    assert!(found["length"].as_f64().expect("a length") > 2.0 * f64::hypot(3.0, 3.7), "{found}");
    folder.edit("map.toml", "[1.0, 1.0]", "[4.1, 1.0]");
    on(&folder, "plan", "world.toml", &["left", "right"]).expect_status(2).complains(&["map.toml:7", "left"]);
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
        let found = on(&folder, "plan", "world.toml", &[from, to, "--json"]).expect_status(0).json();
        assert_eq!(found["status"], "ok", "{map}");
        assert!(begun.elapsed().as_secs() < 60, "{map} took {:?}", begun.elapsed());
    }
}

/// Maps, and two points that are joined on them.
const MAPS: [(&str, &str, &str); 2] = [
    ("data/stage/lse_arena.yaml", "1.4,1.52", "2.05,2.65"),
    ("data/mir_robot/maze.yaml", "8.23,18.81", "18.79,7.33"),
];
