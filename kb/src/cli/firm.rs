//! `adit firm`.

use super::args::WayArgs;
use super::build::open;
use super::output::{json, line, table};
use crate::error::Result;
use crate::live::Live;
use crate::why::firm::{Beyond, FirmCell};
use crate::why::roughly;
use crate::words::number::number;

/// Prints how far each cell may change before another way is the best.
pub fn run(args: &WayArgs) -> Result<()> {
    let live = Live::open(open(&args.site)?)?;
    let firm = live.firm(&args.start, &args.goal, args.robot.as_deref())?;
    if args.site.json {
        return json(&firm);
    }
    let Some(cost) = firm.cost else {
        line(&format!(
            "there is no route from {0} to {1}; `adit route SITE {0} {1}` says why",
            args.start, args.goal
        ));
        return Ok(());
    };
    line(&format!(
        "the route from {} to {} costs {}; it stays the best",
        args.start,
        args.goal,
        number(cost)
    ));
    let rows = firm.cells.iter().map(|cell| {
        let name = format!("{}.{}.{}", cell.table, cell.key, cell.column);
        let way =
            |beyond: &Option<Beyond>| beyond.as_ref().map_or(String::new(), |beyond| beyond.way.clone());
        vec![name, number(cell.value), interval(cell), way(&cell.below), way(&cell.above)]
    });
    table(&["cell", "is", "from .. to", "below takes over", "above takes over"], rows);
    if firm.truncated {
        line("the time was over before all cells were looked at");
    }
    Ok(())
}

fn interval(cell: &FirmCell) -> String {
    let low = cell.low.map_or_else(|| "any".to_owned(), |low| roughly(low, f64::ceil));
    let high = cell.high.map_or_else(|| "any".to_owned(), |high| roughly(high, f64::floor));
    format!("{low} .. {high}{}", if cell.exact { "" } else { " (tried)" })
}
