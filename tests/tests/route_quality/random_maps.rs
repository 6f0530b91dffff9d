//! On random maps, routes cost hardly more than the best way, and lie in the free space throughout.

use adit_tests::oracle::body::Body;
use adit_tests::oracle::buildings;
use adit_tests::oracle::judge::{Findings, Judge};
use adit_tests::oracle::random::Chance;
use adit_tests::oracle::site::Built;

/// Side of the layers' cells, and of the judge's, metres: a twelfth of the slimmest state, so that few passages
/// hang on a cell.
const GRID: f64 = 0.025;

fn judged(seeds: std::ops::Range<u64>, goals: usize, body: fn(&mut Chance) -> Body) -> Findings {
    let mut found = Findings::default();
    for seed in seeds {
        let mut chance = Chance::new(seed);
        let plan =
            if seed.is_multiple_of(2) { buildings::hall(&mut chance) } else { buildings::wards(&mut chance) };
        let plan = if seed % 4 < 2 { plan } else { buildings::with_areas(plan, &mut chance) };
        let body = body(&mut chance);
        let built = Built::of_plan(&plan, &body, GRID);
        let judge = Judge::new(&built, GRID);
        if let Some((start, goals)) = judge.points(&mut chance, goals + 1).split_first() {
            found.extend(judge.judge(&format!("seed {seed}"), *start, goals, GRID));
        }
    }
    found
}

#[test]
fn routes_on_random_maps_cost_hardly_more_than_the_best_way() {
    let found = judged(0..20, 4, buildings::body);
    found.print("random maps");
    found.expect_good();
}

#[test]
fn routes_cost_hardly_more_than_the_best_way_where_some_changes_cost_more_than_two_others() {
    let found = judged(0..12, 4, buildings::uneven_body);
    found.print("random maps, uneven changes");
    found.expect_good();
}

#[test]
#[ignore = "minutes; ADIT_MAPS=400 cargo test --release -p adit-tests --test route_quality -- --ignored --nocapture"]
fn routes_on_very_many_random_maps_cost_hardly_more_than_the_best_way() {
    let maps = std::env::var("ADIT_MAPS").map_or(400, |maps| maps.parse().expect("ADIT_MAPS is a number"));
    let mut found = judged(1000..1000 + maps, 6, buildings::body);
    found.extend(judged(1000..1000 + maps, 6, buildings::uneven_body));
    found.print("very many random maps");
    found.expect_good();
}
