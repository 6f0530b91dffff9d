//! On random maps, routes cost hardly more than the best way.

use adit_planners::geometry::Point;
use adit_tests::oracle::buildings;
use adit_tests::oracle::grid::Grid;
use adit_tests::oracle::random::Chance;
use adit_tests::oracle::site::Built;
use adit_tests::oracle::space::Space;
use adit_tests::oracle::tally::Tally;

const GRID: f64 = 0.05;

#[test]
fn baseline() {
    let mut fair = Tally::default();
    let mut exact = Tally::default();
    for seed in 0..12 {
        let mut chance = Chance::new(seed);
        let plan = if seed % 2 == 0 { buildings::hall(&mut chance) } else { buildings::wards(&mut chance) };
        let body = buildings::body(&mut chance);
        let t = std::time::Instant::now();
        let built = Built::of_plan(&plan, &body, GRID);
        let t1 = t.elapsed();
        let world = &built.world;
        let space = Space::new(world, &body, 0.0);
        let shy = Space::new(world, &body, GRID * 2f64.sqrt());
        let (grid, shy_grid) = (Grid::new(&space, GRID), Grid::new(&shy, GRID));
        let t2 = t.elapsed();
        let b = world.bounds;
        let mut points = Vec::new();
        for _ in 0..1000 {
            let p = Point::new(chance.metres(b.x0, b.x1), chance.metres(b.y0, b.y1));
            if points.len() < 5 && space.is_plain(p, 3.0 * GRID) {
                points.push(p);
            }
        }
        let Some((start, goals)) = points.split_first() else { continue };
        let (ways, shy_ways) = (grid.ways_from(*start), shy_grid.ways_from(*start));
        let t3 = t.elapsed();
        for goal in goals {
            let driven = built.route(*start, *goal);
            let best = ways.to(*goal);
            let shy_best = shy_ways.to(*goal);
            let of = format!("seed {seed} {},{} to {},{}", start.x, start.y, goal.x, goal.y);
            match (&driven, &best, &shy_best) {
                (Some(driven), Some(best), shy_best) => {
                    exact.add(driven.cost / best.cost(&body), of.clone());
                    if let Some(w) = shy_best {
                        fair.add(driven.cost / w.cost(&body), of.clone());
                    }
                    let sum = driven.way.cost(&body);
                    if (sum - driven.cost).abs() > 1e-6 {
                        eprintln!("{of}: sum {sum} cost {}", driven.cost);
                    }
                    if let Some(worst) = driven.way.worst_trespass(&space, 1e-6) {
                        eprintln!("{of}: trespass {worst:?}");
                    }
                }
                (None, None, _) => {}
                _ => eprintln!(
                    "{of}: driven {} best {} shy {}",
                    driven.is_some(),
                    best.is_some(),
                    shy_best.is_some()
                ),
            }
        }
        eprintln!(
            "{seed}: build {t1:?} grids {:?} search {:?} routes {:?}",
            t2 - t1,
            t3 - t2,
            t.elapsed() - t3
        );
    }
    eprintln!("exact {exact}\nfair {fair}");
}
