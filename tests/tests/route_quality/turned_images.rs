//! Maps as images, turned: the same routes.

use std::path::Path;

use adit_planners::geometry::Point;
use adit_tests::oracle::body::Body;
use adit_tests::oracle::grid::Grid;
use adit_tests::oracle::judge::Judge;
use adit_tests::oracle::pictured::{quarter_turned, write_ros_map};
use adit_tests::oracle::random::Chance;
use adit_tests::oracle::site::Built;
use adit_tests::oracle::space::Space;
use adit_tests::{TestSite, shared};

/// How much a cost may differ.
const SAME: f64 = 0.02;

fn body() -> Body {
    Body::new(&[("DRIVE", 1.2, 0.35, 1.0), ("TUCKED", 0.5, 0.22, 3.0)])
        .with_changes(&[(0, 1, 0.5), (1, 0, 0.5)])
}

#[test]
fn an_image_turned_by_a_quarter_has_the_same_routes() {
    let Some(map) = shared("data/aws-robomaker/bookstore_map.yaml") else { return };
    let built = Built::of_map(&map, &body());
    let folder = TestSite::empty();
    let (cells, turn) = quarter_turned(built.world.occupancy.as_ref().unwrap());
    let turned = Built::of_map(&write_ros_map(&folder, &cells), &body());
    let mut wrong = Vec::new();
    let mut chance = Chance::new(3);
    let points = Judge::new(&built, 0.05).points(&mut chance, 16);
    for pair in points.chunks_exact(2) {
        let was = built.route(pair[0], pair[1]).map(|route| route.cost);
        let now = turned.route(turn(pair[0]), turn(pair[1])).map(|route| route.cost);
        let same = match (was, now) {
            (Some(was), Some(now)) => (now / was - 1.0).abs() <= SAME,
            (was, now) => was.is_some() == now.is_some(),
        };
        if !same {
            wrong.push(format!("{pair:?}: {was:?}, then {now:?}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The small warehouse as scanned, and as its publishers turned it: by 2.65 degrees (the pose under which the walls
/// of both lie upon each other), then by a quarter clockwise. A cell of a turned wall is where another cell was, so
/// routes are compared where the best ways are the same by the judge.
#[test]
fn the_warehouse_as_scanned_and_as_turned_has_the_same_routes() {
    let names = ["map.pgm", "map_rotated.pgm", "map_rotated.png"];
    let images = names.map(|name| shared(&format!("data/aws-robomaker/small_warehouse_005_{name}")));
    let [Some(scanned), Some(turned), Some(quarter)] = images else { return };
    let folders = [TestSite::empty(), TestSite::empty(), TestSite::empty()];
    let sites: Vec<Built> =
        folders.iter().zip([scanned, turned, quarter]).map(|(folder, image)| site(folder, &image)).collect();
    let (sin, cos) = 2.65f64.to_radians().sin_cos();
    let (x, y) = (-18.580 * 0.05, -18.626 * 0.05);
    let to_turned = |p: Point| Point::new(p.x * cos - p.y * sin + x, p.x * sin + p.y * cos + y);
    let to_quarter = |p: Point| Point::new(p.y, 423.0 * 0.05 - p.x);
    let poses = |p: Point| [p, to_turned(p), to_quarter(to_turned(p))];
    let spaces: Vec<Space> = sites.iter().map(|site| Space::new(&site.world, site.body(), 0.0)).collect();
    let grids: Vec<Grid> = spaces.iter().map(|space| Grid::new(space, 0.05)).collect();
    let mut chance = Chance::new(11);
    let candidates = Judge::new(&sites[0], 0.05).points(&mut chance, 40);
    let plain = |p: &Point| spaces.iter().zip(poses(*p)).all(|(space, p)| space.is_plain(p, 0.15));
    let points: Vec<Point> = candidates.into_iter().filter(plain).collect();
    let start = points[0];
    let ways: Vec<_> = grids.iter().zip(poses(start)).map(|(grid, start)| grid.ways_from(start)).collect();
    let (mut wrong, mut compared) = (Vec::new(), 0);
    for &goal in &points[1..] {
        let best: Vec<Option<f64>> = ways
            .iter()
            .zip(&spaces)
            .zip(poses(goal))
            .map(|((ways, space), p)| Some(ways.to(p)?.cost(space)))
            .collect();
        let Some(best) = best.into_iter().collect::<Option<Vec<f64>>>() else { continue };
        if best.iter().any(|cost| (cost / best[0] - 1.0).abs() > SAME / 2.0) {
            continue;
        }
        compared += 1;
        let ends = poses(start).into_iter().zip(poses(goal));
        let driven: Vec<f64> = sites
            .iter()
            .zip(ends)
            .map(|(site, (a, b))| site.route(a, b).map_or(f64::NAN, |r| r.cost))
            .collect();
        if !driven.iter().all(|cost| (cost / driven[0] - 1.0).abs() <= SAME) {
            wrong.push(format!("{goal:?}: {driven:?}, at best {best:?}"));
        }
    }
    eprintln!("{compared} of {} goals compared", points.len() - 1);
    assert!(compared >= 5, "{compared} of {} goals were compared", points.len() - 1);
    assert!(wrong.is_empty(), "{wrong:#?}");
}

fn site(folder: &TestSite, image: &Path) -> Built {
    let yaml = format!(
        "image: {}\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
        image.display()
    );
    folder.write("map.yaml", yaml);
    Built::of_map(&folder.path().join("map.yaml"), &body())
}
