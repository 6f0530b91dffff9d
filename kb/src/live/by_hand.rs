//! What other programs wrote into the database that counts for nothing, in sentences.

use adit_db::Tx;
use adit_db::robot::{Change, State};

use crate::error::Result;
use crate::knowledge::KnowledgeBase;

/// Tables that follow from everything else, where a map is cut into rooms.
const FOLLOWING: [&str; 3] = ["rooms", "doors", "places"];

/// So many rows are named.
const NAMED: usize = 3;

/// A word about each kind of it.
pub fn remarks(tx: &mut Tx<'_>, site: &KnowledgeBase) -> Result<Vec<String>> {
    let put_back = if site.site().has_rooms() { put_back(tx)? } else { None };
    Ok([put_back, orphans(tx)?, empty_tunings(tx)?].into_iter().flatten().collect())
}

/// Rows of tables that follow from everything else.
fn put_back(tx: &mut Tx<'_>) -> Result<Option<String>> {
    let marks = tx.stale_marks()?;
    let written = FOLLOWING.iter().filter(|table| marks.iter().any(|mark| mark.table == **table));
    let written = written.copied().collect::<Vec<_>>().join(" and ");
    Ok((!written.is_empty()).then(|| {
        format!(
            "another program wrote rows of {written}: what they hold follows from the map, from other tables and from \
             rules, and is as those have it again"
        )
    }))
}

/// Changes of shape into or out of states that there are not.
fn orphans(tx: &mut Tx<'_>) -> Result<Option<String>> {
    let (states, changes) = (tx.states()?, tx.changes()?);
    let is_there =
        |robot: &str, state: &str| states.iter().any(|of: &State| of.robot == robot && of.state == state);
    let unknown = |change: &Change| {
        let of = [&change.from_state, &change.to_state].map(String::as_str);
        let missing = of.into_iter().find(|state| !is_there(&change.robot, state));
        missing.map(|state| format!("{}/{state}", change.robot))
    };
    let mut unknown: Vec<String> = changes.iter().filter_map(unknown).collect();
    unknown.sort_unstable();
    unknown.dedup();
    let count = unknown.len();
    let more = if count > NAMED { format!(" and {} more", count - NAMED) } else { String::new() };
    Ok((count > 0).then(|| {
        let named = unknown[..count.min(NAMED)].join(", ");
        format!("changes has rows of states that robots has not: {named}{more}; they count for nothing")
    }))
}

/// Tunings that are on and set nothing.
fn empty_tunings(tx: &mut Tx<'_>) -> Result<Option<String>> {
    let cells = tx.tuning_cells()?;
    let active = tx.active_tunings()?;
    let is_empty = |name: &&String| !cells.iter().any(|cell| cell.tuning == **name);
    let empty: Vec<String> = active.iter().filter(is_empty).map(|name| format!("`{name}`")).collect();
    Ok((!empty.is_empty()).then(|| format!("the tuning {} is on and sets nothing", empty.join(" and "))))
}
