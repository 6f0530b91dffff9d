//! Miss Manners, a classic of rule engines: seats guests so that neighbours are of different sex and share a hobby.
//!
//! `cargo run --release -p adit-engine --example manners -- 16`

#[path = "manners/party.rs"]
mod party;

use adit_engine::Limits;
use party::{checked, guests, rules, seating, table};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count = std::env::args().nth(1).map_or(Ok(16), |count| count.parse())?;
    let guests = guests(count, 1);
    let rules = rules()?;
    let mut base = table(&guests, Limits { firings: 1_000_000, ..Limits::default() })?;
    let started = std::time::Instant::now();
    let run = base.react(&rules);
    let took = started.elapsed();
    for problem in &run.diagnostics {
        eprintln!("{problem}");
    }
    let order = seating(&base).ok_or("nobody found a seat")?;
    checked(&guests, &order)?;
    eprintln!("{}", order.join(", "));
    eprintln!("{count} guests: {} firings in {took:?}", run.firings.len());
    Ok(())
}
