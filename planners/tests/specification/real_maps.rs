//! Maps that robots drive on: each is read, cut into layers for five states, and shown with its figures
//! (`cargo test -p adit-planners real_maps -- --nocapture`).

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test stops at the first surprise and shows figures"
)]

use std::path::{Path, PathBuf};
use std::time::Instant;

use adit_planners::layers::{Kind, State, cut_layers};
use adit_planners::read::{MapSettings, read_map};

/// The folder of other people's maps; `None` (and a loud line) where it is not there.
fn data() -> Option<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared");
    let data = std::env::var_os("ADIT_SHARED").map_or(here, PathBuf::from).join("data");
    if data.is_dir() {
        return Some(data);
    }
    println!("SKIPPED: ../shared/data is missing");
    None
}

fn states() -> Vec<State> {
    let state =
        |state: &str, height, width| State { robot: None, state: state.into(), height, width, length: None };
    vec![
        state("STAND", 1.7, 0.6),
        state("SIDE-STAND", 1.7, 0.35),
        state("SQUAT", 1.1, 0.8),
        state("LIE", 0.6, 0.8),
        state("SPREAD", 1.7, 1.0),
    ]
}

/// Builds all layers of a map, prints what came out, and checks what must hold of every map.
fn build(path: &Path) {
    let start = Instant::now();
    let (world, report) = read_map(path, &MapSettings::default()).unwrap();
    let read = start.elapsed();
    let start = Instant::now();
    let layers = cut_layers(&world, &states()).unwrap();
    let cut = start.elapsed();
    println!("{}: read {read:.0?}, cut {cut:.0?}", path.display());
    println!(
        "  free {:.1} m², unknown {:.1} m² (walls), {} doors, {} changes",
        report.free_in_file,
        report.unknown_in_file,
        layers.crossings.iter().filter(|crossing| crossing.kind == Kind::Door).count(),
        layers.crossings.iter().filter(|crossing| crossing.kind == Kind::Change).count(),
    );
    for (index, state) in states().iter().enumerate() {
        let rooms: Vec<_> = layers.rooms.iter().filter(|room| room.state == index).collect();
        let area: f64 = rooms.iter().map(|room| room.outline.area()).sum();
        let thinner = rooms.iter().filter(|room| room.outline.breadth() < 0.1).count();
        println!(
            "  {:10} {:5} rooms, {:7.1} m², thinner than 10 cm {thinner:5}",
            state.state,
            rooms.len(),
            area
        );
        assert!(area <= report.free + 1e-6, "a layer is inside of the free space");
        assert!(!rooms.is_empty(), "{} can be somewhere", state.state);
    }
}

#[test]
fn maps_of_ros_build() {
    let Some(data) = data() else { return };
    for map in [
        "nav2/depot.yaml",
        "nav2/tb3_sandbox.yaml",
        "turtlebot3/map.yaml",
        "aws-robomaker/bookstore_map.yaml",
        "aws-robomaker/small_warehouse_005_map.yaml",
        "mir_robot/maze.yaml",
        "stage/lse_arena.yaml",
    ] {
        build(&data.join(map));
    }
}

/// The warehouse as it was scanned lies askew in its image: its walls are staircases.
#[test]
fn the_warehouse_askew_builds() {
    let Some(data) = data() else { return };
    let folder = tempfile::tempdir().unwrap();
    let image = data.join("aws-robomaker/small_warehouse_005_map.pgm");
    let path = folder.path().join("askew.yaml");
    let yaml = format!(
        "image: {}\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
        image.canonicalize().unwrap().display()
    );
    std::fs::write(&path, yaml).unwrap();
    build(&path);
}
