//! Salt on other people's maps is told from things, and dropped; maps without it stay as they are.
#![allow(clippy::print_stdout)] // a test stops at the first surprise and shows figures

use std::path::{Path, PathBuf};

use adit_planners::geometry::Point;
use adit_planners::layers::{Layers, State, cut_layers};
use adit_planners::random::Random;
use adit_planners::read::{Code, MapReport, MapSettings, read_map};
use adit_planners::world::{Occupancy, World};
use petgraph::unionfind::UnionFind;

/// The folder of other people's maps; `None` (and a loud line) where it is not there.
fn data() -> Option<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared");
    let data = std::env::var_os("ADIT_SHARED").map_or(here, PathBuf::from).join("data");
    if data.is_dir() {
        return Some(data);
    }
    println!("\n!!! SKIPPED: ../shared/data is missing, so this test has tested nothing !!!\n");
    None
}

/// Maps without salt, the furnished ones with things of one pixel, and bigger ones.
const MAPS: [&str; 6] = [
    "aws-robomaker/small_warehouse_005_map.yaml",
    "nav2/depot.yaml",
    "room-segmentation/Freiburg52_scan.yaml",
    "room-segmentation/lab_ipa.yaml",
    "room-segmentation/lab_ipa_furnitures.yaml",
    "room-segmentation/office_b_furnitures.yaml",
];

fn states() -> [State; 1] {
    [State { robot: None, state: "DRIVE".to_owned(), height: 1.0, width: 0.4, length: None }]
}

fn cells(world: &World) -> &Occupancy {
    world.occupancy.as_ref().unwrap()
}

/// The map with each pixel black by chance, written and read again.
fn strewn(clean: &Occupancy, share: f64, settings: &MapSettings) -> (World, MapReport) {
    let mut chance = Random::new(7);
    let folder = tempfile::tempdir().unwrap();
    let mut image = format!("P5\n{} {}\n255\n", clean.columns, clean.rows).into_bytes();
    for row in (0..clean.rows).rev() {
        image.extend((0..clean.columns).map(|column| {
            let is_salt = chance.share() < share;
            if is_salt || clean.is_blocked(column, row) { 0 } else { 254 }
        }));
    }
    std::fs::write(folder.path().join("map.pgm"), image).unwrap();
    let yaml = format!(
        "image: map.pgm\nresolution: {:?}\norigin: [{:?}, {:?}, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
        clean.resolution, clean.origin.x, clean.origin.y
    );
    let file = folder.path().join("map.yaml");
    std::fs::write(&file, yaml).unwrap();
    read_map(&file, settings).unwrap()
}

/// A point of the largest part of the floor that one can go about in, and another one of it, far away.
fn ends(layers: &Layers) -> [Point; 2] {
    let label = parts(layers);
    let area = |part: usize| -> f64 {
        let of_part = layers.rooms.iter().zip(&label).filter(|(_, label)| **label == part);
        of_part.map(|(room, _)| room.outline.area()).sum()
    };
    let largest = label.iter().copied().max_by(|&a, &b| area(a).total_cmp(&area(b))).unwrap();
    let rooms = layers
        .rooms
        .iter()
        .zip(&label)
        .filter(|(room, label)| **label == largest && room.outline.breadth() > 0.5);
    let centres: Vec<Point> = rooms.map(|(room, _)| room.outline.centre()).collect();
    let from = centres[0];
    let to = centres.iter().copied().max_by(|a, b| a.distance(from).total_cmp(&b.distance(from))).unwrap();
    [from, to]
}

fn parts(layers: &Layers) -> Vec<usize> {
    let mut joined = UnionFind::new(layers.rooms.len());
    layers.crossings.iter().for_each(|crossing| {
        joined.union(crossing.room1, crossing.room2);
    });
    joined.into_labeling()
}

fn are_joined(layers: &Layers, [from, to]: [Point; 2]) -> bool {
    let label = parts(layers);
    let room = |p: Point| layers.rooms.iter().position(|room| room.outline.contains(p));
    room(from).zip(room(to)).is_some_and(|(from, to)| label[from] == label[to])
}

#[test]
fn a_map_without_salt_is_read_as_it_is_drawn() {
    let Some(data) = data() else { return };
    for map in MAPS {
        let (read, report) = read_map(&data.join(map), &MapSettings::default()).unwrap();
        let all = MapSettings { speck_area: Some(0.0), ..MapSettings::default() };
        let (drawn, _) = read_map(&data.join(map), &all).unwrap();
        assert!(read == drawn, "{map}: {} m² of specks were dropped", report.specks);
    }
}

/// How much a map's rooms may change, as a share of them; a handful may in any case.
fn is_alike(clean: usize, salted: usize) -> bool {
    clean.abs_diff(salted) as f64 <= (0.25 * clean as f64).max(3.0)
}

#[test]
fn salt_on_a_map_leaves_its_rooms_and_its_goals() {
    let Some(data) = data() else { return };
    let (mut told_apart, mut wrong) = (0, Vec::new());
    for map in MAPS {
        let (clean, _) = read_map(&data.join(map), &MapSettings::default()).unwrap();
        let layers = cut_layers(&clean, &states()).unwrap();
        let (rooms, ends) = (layers.rooms.len(), ends(&layers));
        for share in [0.001, 0.005, 0.01] {
            let all = MapSettings { speck_area: Some(0.0), ..MapSettings::default() };
            let ruined = cut_layers(&strewn(cells(&clean), share, &all).0, &states()).unwrap().rooms.len();
            let (mut world, report) = strewn(cells(&clean), share, &MapSettings::default());
            let note = report.notes.iter().find(|note| note.code == Code::Salt).unwrap().to_string();
            if note.contains("taken for salt") {
                told_apart += 1;
                assert!(report.specks > 0.0, "{map}: {note}");
            } else {
                // where a tenth of a percent of salt lies among legs of furniture, what is said restores the floor
                let (_, after) = note.split_once("speck_area = ").unwrap();
                let area = after.split('`').next().unwrap().parse().unwrap();
                world = strewn(cells(&clean), share, &MapSettings { speck_area: Some(area), ..all }).0;
            }
            let salted = cut_layers(&world, &states()).unwrap();
            let line = format!(
                "{map} {share}: {rooms} rooms, {} with salt, {ruined} if all is kept: {note}",
                salted.rooms.len()
            );
            println!("{line}");
            if !is_alike(rooms, salted.rooms.len()) || !are_joined(&salted, ends) {
                wrong.push(line);
            }
        }
    }
    assert!(told_apart >= 15, "salt was seen {told_apart} times");
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn a_few_specks_legs_in_groups_and_a_pillar_among_salt_stay() {
    let (columns, rows) = (400, 400);
    let empty =
        |blocked: Vec<bool>| Occupancy { origin: Point::default(), resolution: 0.05, columns, rows, blocked };
    let mut cells = vec![false; columns * rows];
    let mut chance = Random::new(3);
    let mut place = |margin: usize| {
        let along = |chance: &mut Random| margin + chance.below(columns - 2 * margin);
        along(&mut chance) * columns + along(&mut chance)
    };
    (0..40).for_each(|_| cells[place(1)] = true);
    let note = |cells: &Occupancy| {
        let (world, report) = strewn(cells, 0.0, &MapSettings::default());
        (world, report.notes.first().map(ToString::to_string).unwrap_or_default())
    };
    let few = empty(cells.clone());
    assert!(note(&few).0.occupancy.as_ref() == Some(&few), "forty specks are none too many");
    // thirty tables of four legs
    for _ in 0..30 {
        let corner = place(20);
        for leg in [0, 12, 12 * columns, 12 * columns + 12] {
            cells[corner + leg] = true;
        }
    }
    let tables = empty(cells);
    let (world, said) = note(&tables);
    assert!(world.occupancy.as_ref() == Some(&tables) && said.contains("in groups"), "{said}");
    // a pillar of two by two pixels among salt of half a percent
    let pillar = [180 * columns + 180, 180 * columns + 181, 181 * columns + 180, 181 * columns + 181];
    let mut salted = vec![false; columns * rows];
    (0..800).for_each(|_| salted[place(1)] = true);
    for row in 176..186 {
        salted[row * columns + 176..row * columns + 186].fill(false);
    }
    for cell in pillar {
        salted[cell] = true;
    }
    let (world, said) = note(&empty(salted));
    let left = &world.occupancy.unwrap().blocked;
    assert!(said.contains("taken for salt"), "{said}");
    assert!(pillar.iter().all(|&cell| left[cell]), "the pillar is gone");
    // three pixels that touch are less likely than not, so they stay
    let left = left.iter().filter(|&&is_wall| is_wall).count();
    assert!(left <= 20, "{left} pixels of 804 are left");
}

#[test]
fn thin_walls_of_any_slant_keep_their_ends_among_salt() {
    let (columns, rows) = (400, 400);
    let mut wrong = Vec::new();
    for seed in 0..8 {
        let mut chance = Random::new(seed);
        let mut walls = vec![false; columns * rows];
        // sixteen walls of a pixel's breadth, sixty pixels long or so, each in a square of its own
        for square in 0..16_i32 {
            let (left, low) = (100 * (square % 4) + 50, 100 * (square / 4) + 50);
            let angle = chance.share() * std::f64::consts::TAU;
            for step in -30_i32..=30 {
                let along = |share: f64| (share * f64::from(step)).round() as i32;
                let (x, y) = (left + along(angle.cos()), low + along(angle.sin()));
                walls[y as usize * columns + x as usize] = true;
            }
        }
        let mut salted = walls.clone();
        (0..800).for_each(|_| salted[(3 + chance.below(394)) * columns + 3 + chance.below(394)] = true);
        let occupancy =
            Occupancy { origin: Point::default(), resolution: 0.05, columns, rows, blocked: salted };
        let (world, report) = strewn(&occupancy, 0.0, &MapSettings::default());
        assert!(
            report
                .notes
                .iter()
                .any(|note| note.code == Code::Salt && note.to_string().contains("taken for salt"))
        );
        let left = world.occupancy.unwrap().blocked;
        let lost = (0..walls.len()).filter(|&cell| walls[cell] && !left[cell]).count();
        wrong.extend((lost > 0).then(|| format!("seed {seed}: {lost} pixels of walls")));
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
