//! What other programs wrote into the database that counts for nothing, in sentences.

use std::collections::BTreeSet;

use adit_db::Tx;
use adit_db::robot::{Change, State};
use adit_engine::RuleBase;

use crate::edit::cells;
use crate::error::Result;
use crate::knowledge::KnowledgeBase;
use crate::knowledge::told::{Fact, kinds};

/// Tables that follow from everything else, where a map is cut into rooms.
const FOLLOWING: [&str; 3] = ["rooms", "doors", "places"];

/// So many rows are named.
const NAMED: usize = 3;

/// A word about each kind of it.
pub fn remarks(tx: &mut Tx<'_>, site: &KnowledgeBase, rules: &RuleBase) -> Result<Vec<String>> {
    let [put_back, carried] =
        if site.site().has_rooms() { [put_back(tx)?, carried_by_nobody(tx)?] } else { [None, None] };
    let others = [put_back, orphans(tx)?, carried, empty_tunings(tx)?, vain_tunings(tx)?];
    Ok(others.into_iter().flatten().chain(unread_facts(tx, site, rules)?).collect())
}

/// Facts that another program wrote about properties that nobody reads.
fn unread_facts(tx: &mut Tx<'_>, site: &KnowledgeBase, rules: &RuleBase) -> Result<Vec<String>> {
    let marks = tx.stale_marks()?;
    if !marks.iter().any(|mark| mark.table == "told") {
        return Ok(Vec::new());
    }
    let mut told = site.told(tx, rules)?;
    let facts = std::mem::take(&mut told.facts);
    let schema = site.schema(&told);
    let is_written = |fact: &&Fact| {
        let id = fact.id.to_string();
        schema.has(&fact.class) && marks.iter().any(|mark| mark.table == "told" && mark.key == id)
    };
    let remark = |fact: &Fact| {
        let (message, meant) = kinds::unread(&fact.class, &fact.property, &schema, rules)?;
        let meant = meant.map_or_else(String::new, |meant| format!("; {meant}"));
        Some(format!("{} counts for nothing: {message}{meant}", fact.name()))
    };
    Ok(facts.iter().filter(is_written).filter_map(remark).collect())
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
    Ok(listed(changes.iter().filter_map(unknown)).map(|unknown| {
        format!("changes has rows of states that robots does not have: {unknown}; they count for nothing")
    }))
}

/// Loads of robots that there are not.
fn carried_by_nobody(tx: &mut Tx<'_>) -> Result<Option<String>> {
    let (states, loads) = (tx.states()?, tx.loads()?);
    let unknown = loads.into_iter().map(|load| load.robot);
    let unknown = unknown.filter(|robot| !states.iter().any(|state| state.robot == *robot));
    Ok(listed(unknown).map(|unknown| {
        format!("loads has rows of robots that do not exist: {unknown}; they count for nothing")
    }))
}

/// A few of the names, each once, and how many more there are; `None` where there is none.
fn listed(names: impl Iterator<Item = String>) -> Option<String> {
    let names: BTreeSet<String> = names.collect();
    let (named, more) = (names.iter().take(NAMED).cloned(), names.len().saturating_sub(NAMED));
    let listed = named.collect::<Vec<_>>().join(", ");
    (!names.is_empty()).then(|| if more > 0 { format!("{listed} and {more} more") } else { listed })
}

/// Cells of tunings that are on, of what is no table that is tuned.
fn vain_tunings(tx: &mut Tx<'_>) -> Result<Option<String>> {
    let active = tx.active_tunings()?;
    let mut vain = Vec::new();
    for cell in tx.tuning_cells()?.into_iter().filter(|cell| active.contains(&cell.tuning)) {
        if cells::columns(tx, &cell.table).is_err() {
            vain.push(format!("{}.{}.{}", cell.table, cell.key, cell.column));
        }
    }
    let said = |vain: String| {
        format!(
            "tunings set what nobody tunes, since it follows from other things or is not there: {vain}; it counts for nothing"
        )
    };
    Ok(listed(vain.into_iter()).map(said))
}

/// Tunings that are on and set nothing.
fn empty_tunings(tx: &mut Tx<'_>) -> Result<Option<String>> {
    let cells = tx.tuning_cells()?;
    let active = tx.active_tunings()?;
    let is_empty = |name: &&String| !cells.iter().any(|cell| cell.tuning == **name);
    let empty: Vec<String> = active.iter().filter(is_empty).map(|name| format!("`{name}`")).collect();
    Ok(match empty.as_slice() {
        [] => None,
        [one] => Some(format!("the tuning {one} is on and sets nothing")),
        several => Some(format!("the tunings {} are on and set nothing", several.join(" and "))),
    })
}
