//! Waltz's labelling of line drawings, a classic of rule engines.
//!
//! `cargo run --release -p adit-engine --example waltz -- 12`

#[path = "waltz/scene.rs"]
mod scene;

use adit_engine::Limits;
use scene::{labels, picture, rules, scene};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let regions = std::env::args().nth(1).map_or(Ok(12), |count| count.parse())?;
    let lines = scene(5);
    let rules = rules()?;
    let mut base = picture(&lines, regions, Limits { firings: 1_000_000, ..Limits::default() })?;
    for problem in rules.check(&base.schema()) {
        eprintln!("{problem}");
    }
    let started = std::time::Instant::now();
    let run = base.react(&rules);
    let took = started.elapsed();
    for problem in &run.diagnostics {
        eprintln!("{problem}");
    }
    let labelled = labels(&base).len();
    eprintln!("{labelled} of {} edges are labelled", 2 * regions * lines.len());
    eprintln!("{regions} regions: {} firings in {took:?}", run.firings.len());
    Ok(())
}
