//! What is closed and opened again by the name that people have for it: a doorway, a named door, an area, a space, or the
//! place at which a robot was blocked. Each becomes a fact, or takes facts back.

use adit_db::Tx;
use adit_db::edit::Edited;
use adit_db::history::Author;
use adit_db::told::Told as Row;
use adit_engine::RuleBase;
use adit_planners::facts::Column;

use super::place;
use super::tell::Tell;
use crate::error::{Code, Error, Result};
use crate::graph::{Building, Named};
use crate::knowledge::KnowledgeBase;
use crate::knowledge::tables;
use crate::knowledge::told::closing::{CLOSED, CLOSED_TO, OPEN_TO, lists_robots};
use crate::words::suggest::did_you_mean;

/// Something that is closed, as it is said.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Close {
    /// A name; or a point `x,y`, with the heading of a robot that was blocked there: `x,y@90`.
    pub what: String,
    /// When it ends, as [`KnowledgeBase::moment`] reads times.
    pub until: Option<String>,
    /// The robots that are kept out; all where none is said.
    pub only: Vec<String>,
    /// The robots that come through all the same; `only` says nothing then.
    pub except: Vec<String>,
}

impl Close {
    /// The fact that says it.
    pub(super) fn fact(&self, tx: &mut Tx<'_>) -> Result<Tell> {
        let what = self.what.trim();
        let class = class_of(tx, what)?;
        let (property, value) = match (self.only.as_slice(), self.except.as_slice()) {
            ([], []) => (CLOSED, "true".to_owned()),
            (only, []) => (CLOSED_TO, only.join(", ")),
            ([], except) => (OPEN_TO, except.join(", ")),
            _ => {
                let message = "it is closed to `only` some robots, or to all `except` some, not both";
                return Err(Error::said(Code::TellUsage, message, None));
            }
        };
        if property != CLOSED && !lists_robots(class, property) {
            let message = format!("`{what}` is an area, and areas are closed to everybody");
            let help = "close its doorways, or say in rules which robots are kept out".to_owned();
            return Err(Error::said(Code::TellUsage, message, Some(help)));
        }
        Ok(Tell {
            class: class.to_owned(),
            object: what.to_owned(),
            property: property.to_owned(),
            value,
            until: self.until.clone(),
            new_property: false,
        })
    }
}

/// Takes back all facts that close something; where none does, tells that it is not closed.
pub(super) fn open(
    tx: &mut Tx<'_>,
    (site, rules): (&KnowledgeBase, &RuleBase),
    what: &str,
    author: &Author,
) -> Result<Edited> {
    let tell = Close { what: what.to_owned(), ..Close::default() }.fact(tx)?;
    let row = tell.row(tx, site, rules, author)?;
    let closes = |fact: &&Row| {
        let value = |name: &str| row.iter().find(|(column, _)| *column == name).map(|(_, cell)| cell.clone());
        let is_same = |name: &str, of: Option<f64>| match value(name) {
            Some(adit_db::Cell::Real(real)) => of.is_some_and(|of| (of - real).abs() < 1e-6),
            _ => of.is_none(),
        };
        let ends = fact.segment.map_or([None; 4], |segment| segment.map(Some));
        fact.class == tell.class
            && [CLOSED, CLOSED_TO, OPEN_TO].contains(&fact.property.as_str())
            && fact.key.as_deref().map(adit_db::Cell::from) == value("key")
            && is_same("x0", ends[0])
            && is_same("y0", ends[1])
            && is_same("x1", ends[2])
            && is_same("y1", ends[3])
            && (fact.segment.is_some()
                || is_same("x", fact.at.map(|at| at[0])) && is_same("y", fact.at.map(|at| at[1])))
    };
    let ids: Vec<i64> = tx.facts_told()?.iter().filter(closes).map(|fact| fact.id).collect();
    let mut last = None;
    for id in ids {
        last = Some(tx.remove_row("told", &id.to_string(), author)?);
    }
    if let Some(entry) = last {
        return Ok(entry);
    }
    let tell = Tell { value: "false".to_owned(), ..tell };
    let row = tell.row(tx, site, rules, author)?;
    Ok(tx.add_row("told", &row, author)?)
}

/// Of which class something is that people have a name for.
fn class_of(tx: &mut Tx<'_>, what: &str) -> Result<&'static str> {
    if place::split(what).is_some() {
        return Ok("DOORWAYS");
    }
    let building = Building::read(tx)?;
    let named = Named {
        areas: names(tx, "areas", "area")?,
        doors: names(tx, "named_doors", "door")?,
        building: &building,
    };
    if let Some(class) = named.class_of(what) {
        return Ok(class);
    }
    let known: Vec<String> = named.names().collect();
    let help = did_you_mean(what, known.iter().map(String::as_str));
    let help =
        help.or_else(|| Some("say a doorway, a space, an area, a named door, or a point as x,y".to_owned()));
    Err(Error::said(
        Code::TellUnknownObject,
        format!("the site has nothing called `{what}` that could be closed"),
        help,
    ))
}

/// The names of what planners gave of a class.
fn names(tx: &mut Tx<'_>, table: &str, key: &str) -> Result<Vec<String>> {
    Ok(match tables::kept(tx, table)?.column(key) {
        Some(Column::Text(names)) => names.iter().flatten().cloned().collect(),
        _ => Vec::new(),
    })
}
