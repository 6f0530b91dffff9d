//! Masks as Nav2's costmap filters read them are areas of a site: what they keep robots out of is not entered, and rules read how
//! fast robots may go.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::path::Path;

use adit_tests::{TestSite, shared};

const ROBOTS: &str = r#"
[[robots]]
state = "DRIVE"
action = "DRIVE"
height = 1.2
width = 0.35
hardness = 1.0
"#;

fn site(map: &Path, ends: [[f64; 2]; 2], masks: &str) -> TestSite {
    let [[x0, y0], [x1, y1]] = ends;
    let text = format!(
        "map = \"{}\"\nstarts = [\"here\"]\n{masks}\n\
         [[place]]\nname = \"here\"\nat = [{x0}, {y0}]\n[[place]]\nname = \"there\"\nat = [{x1}, {y1}]\n",
        map.display()
    );
    TestSite::empty().with("robots.toml", ROBOTS).with("site.toml", &text)
}

/// The pixels of a plain or raw PGM, the top row first, with its columns.
fn pixels(file: &Path) -> (usize, Vec<u8>) {
    let bytes = std::fs::read(file).unwrap();
    let mut at = 0;
    let mut head = Vec::new();
    while head.len() < 4 {
        let end = at + bytes[at..].iter().position(|&byte| byte == b'\n').unwrap();
        let line = std::str::from_utf8(&bytes[at..end]).unwrap();
        if !line.starts_with('#') {
            head.extend(line.split_whitespace().map(str::to_owned));
        }
        at = end + 1;
    }
    (head[1].parse().unwrap(), bytes[at..].to_vec())
}

/// How many samples of the kept route lie in pixels of a mask that are black and free on the map.
fn trespasses(site: &TestSite, mask: &Path, map: &Path) -> usize {
    let (columns, marked) = pixels(mask);
    let walls = pixels(map).1;
    let rows = marked.len() / columns;
    let points: Vec<[f64; 2]> = site
        .sqlite3("SELECT x, y FROM waypoints WHERE start = 'here' AND goal = 'there' ORDER BY waypoint")
        .iter()
        .map(|row| {
            let (x, y) = row.split_once('|').unwrap();
            [x.parse().unwrap(), y.parse().unwrap()]
        })
        .collect();
    assert!(points.len() > 1);
    let is_within = |x: f64, y: f64| {
        let (column, row) = ((x / 0.05) as usize, rows - 1 - (y / 0.05) as usize);
        marked[row * columns + column] == 0 && walls[row * columns + column] > 250
    };
    let samples = points.windows(2).flat_map(|leg| {
        (0..200).map(move |step| {
            let share = f64::from(step) / 200.0;
            [0, 1].map(|axis| leg[0][axis] + (leg[1][axis] - leg[0][axis]) * share)
        })
    });
    samples.filter(|&[x, y]| is_within(x, y)).count()
}

#[test]
fn routes_keep_out_of_the_keepout_mask_of_the_depot_and_areas_say_its_speeds() {
    let Some(map) = shared("data/nav2/depot.yaml") else { return };
    let folder = map.parent().unwrap().to_owned();
    // on either side of a shelf that the mask marks and the scan does not show
    let ends = [[15.0, 10.9], [19.0, 10.9]];
    let masks = format!(
        "[[mask]]\nfile = \"{0}/depot_keepout.yaml\"\nkind = \"keepout\"\nname = \"kept out\"\n\
         [[mask]]\nfile = \"{0}/depot_speed.yaml\"\nkind = \"speed\"\nname = \"slow\"\n",
        folder.display()
    );
    let (keepout, depot) = (folder.join("depot_keepout.pgm"), folder.join("depot.pgm"));
    let free = site(&map, ends, "").built();
    assert!(trespasses(&free, &keepout, &depot) > 0, "without the mask the way leads through");
    let masked = site(&map, ends, &masks).built();
    assert_eq!(trespasses(&masked, &keepout, &depot), 0);
    let speeds = masked.sqlite3(
        "SELECT DISTINCT speed_percent FROM areas WHERE kind = 'speed-limit' AND speed_percent > 0 ORDER BY 1",
    );
    assert!(speeds.contains(&"50.0".to_owned()) && speeds.contains(&"75.0".to_owned()), "{speeds:?}");
}

#[test]
fn the_virtual_walls_of_the_maze_are_areas_that_lie_where_the_image_has_them() {
    let Some(map) = shared("data/mir_robot/maze.yaml") else { return };
    let walls = map.with_file_name("maze_virtual_walls.yaml");
    let mask = format!("[[mask]]\nfile = \"{}\"\nkind = \"keepout\"\n", walls.display());
    let text = format!("map = \"{}\"\n{mask}", map.display());
    let site = TestSite::empty().with("robots.toml", ROBOTS).with("site.toml", &text).built();
    let areas = site.sqlite3("SELECT count(*) > 0, min(kind), max(kind) FROM map_areas");
    assert_eq!(areas, ["1|keep-out|keep-out"]);
    let entered = "SELECT count(*) FROM area_rooms JOIN rooms USING (room) WHERE passable <> 0";
    assert_eq!(site.sqlite3(entered), ["0"], "no room in them is entered");
}

/// A mask of 4 by 2 pixels of half a metre, whose lower left corner is at `origin`; the left half is marked.
fn mask(origin: &str) -> TestSite {
    let yaml = format!(
        "image: mask.pgm\nresolution: 0.5\norigin: {origin}\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n"
    );
    TestSite::example("starter")
        .with("mask.yaml", &yaml)
        .with("mask.pgm", "P2\n4 2\n255\n0 0 254 254\n0 0 254 254\n")
        .with(
            "site.toml",
            "map = \"map.toml\"\nrobots = \"robots.toml\"\n[[mask]]\nfile = \"mask.yaml\"\nkind = \"keepout\"\n",
        )
}

#[test]
fn a_mask_lies_where_its_own_origin_resolution_and_yaw_put_it() {
    let middle = |origin: &str| {
        mask(origin).built().sqlite3("SELECT area, round(x, 2), round(y, 2) FROM areas ORDER BY area")
    };
    // with a pixel more around it
    assert_eq!(middle("[7.0, 1.0, 0.0]"), ["mask 1|7.75|1.5"]);
    assert_eq!(middle("[9.0, 1.0, 1.5707963267948966]"), ["mask 1|8.5|1.75"]);
}

#[test]
fn a_mask_that_cannot_be_laid_is_refused_in_words() {
    let refused = |site: &TestSite, said: &[&str]| site.adit("build", &[]).expecting(2).complains(said);
    refused(&mask("[70.0, 1.0, 0.0]"), &["nothing of the mask `mask.pgm` lies on the map", "its `origin`"]);
    refused(&mask("[7.0, 1.0]"), &["`origin` has 2 entries and needs three"]);
    let with = |from: &str, to: &str| {
        let site = mask("[7.0, 1.0, 0.0]");
        site.edit("site.toml", from, to);
        site
    };
    refused(&with("mask.yaml", "none.yaml"), &["none.yaml` cannot be read"]);
    refused(&with("keepout", "keepot"), &["`keepot` is no kind of a mask", "did you mean \"keepout\"?"]);
    refused(
        &with("kind = \"keepout\"", "kind = \"keepout\"\nbase = 3"),
        &["`base` is said of a mask of kind \"speed\" only"],
    );
    refused(
        &with("kind = \"keepout\"", "kind = \"speed\"\nunit = \"mph\""),
        &["`mph` is no unit of a mask", "percent, m/s"],
    );
    refused(&with("kind = \"keepout\"", ""), &["[[mask]] needs a `kind`"]);
    refused(&with("kind =", "colour = 1\nkind ="), &["`colour` is not a key of [[mask]]"]);
}
