//! On the floor plans and scans of others, furnished ones too, routes of one, three and five states cost hardly more than
//! the best way.

use adit_tests::oracle::body::Body;
use adit_tests::oracle::judge::{Findings, Judge};
use adit_tests::oracle::random::Chance;
use adit_tests::oracle::site::Built;
use adit_tests::shared;

fn bodies() -> [Body; 3] {
    let states = [
        ("DRIVE", 1.2, 0.35, 1.0),
        ("TUCKED", 0.5, 0.22, 3.0),
        ("LOADED", 1.4, 0.6, 1.5),
        ("SIDE", 1.2, 0.28, 2.0),
        ("TALL", 1.7, 0.45, 0.8),
    ];
    let all = |count: usize| {
        let body = Body::new(&states[..count]);
        let pairs = (0..count).flat_map(|a| (0..count).filter(move |b| *b != a).map(move |b| (a, b, 0.5)));
        body.with_changes(&pairs.collect::<Vec<_>>())
    };
    [all(1), all(3), all(5)]
}

#[test]
#[ignore = "an hour; ADIT_MAPS=40 cargo test --release -p adit-tests --test route_quality many_maps -- --ignored --nocapture"]
fn routes_on_maps_of_others_cost_hardly_more_than_the_best_way() {
    let most = std::env::var("ADIT_MAPS").map_or(40, |maps| maps.parse().expect("ADIT_MAPS is a number"));
    let finer: f64 =
        std::env::var("ADIT_FINER").map_or(1.0, |by| by.parse().expect("ADIT_FINER is a number"));
    let Some(folder) = shared("data/room-segmentation") else { return };
    let mut maps: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    maps.retain(|path| path.extension().is_some_and(|extension| extension == "yaml"));
    maps.sort();
    let mut all = Findings::default();
    for (map, body) in maps.iter().take(most).flat_map(|map| bodies().map(|body| (map, body))) {
        let built = Built::of_map(map, &body);
        let side = built.world.occupancy.as_ref().expect("an image").resolution;
        let judge = Judge::new(&built, side);
        let points = judge.points(&mut Chance::new(5), 9);
        let Some((start, goals)) = points.split_first() else { continue };
        let name =
            format!("{} with {} states", map.file_stem().unwrap().to_string_lossy(), body.states.len());
        let found = judge.judge(&name, *start, goals, side / finer);
        found.print(&name);
        all.extend(found);
    }
    all.print("all");
    all.expect_good();
}
