//! `adit tell`.

use adit_db::Store;
use clap::Args;
use jiff::Timestamp;

use super::args::SiteArgs;
use super::build::open;
use super::output::{json, line, table};
use super::tune::apply;
use crate::edit::Edit;
use crate::edit::Tell;
use crate::error::{Code, Error, Result};
use crate::graph::Building;
use crate::knowledge::KnowledgeBase;
use crate::words::cells::{object, text};
use crate::words::number::number;
use crate::words::point::point;

#[derive(Args, Debug)]
pub struct TellArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// The class: DOORS, ROOMS, ROBOTS, or any that rules read
    pub class: Option<String>,
    /// The object: its name, a point `x,y`, `door 7` or `room d`
    #[arg(allow_hyphen_values = true)]
    pub object: Option<String>,
    /// The property
    pub property: Option<String>,
    /// The value: a number, a text, `true` or `false`
    #[arg(allow_hyphen_values = true)]
    pub value: Option<String>,
    /// When it ends: `2026-11-21T18:00`, `18:00` (the next one), `2h`
    #[arg(long, value_name = "TIME", visible_alias = "for")]
    pub until: Option<String>,
    /// Why, for the history
    #[arg(long, value_name = "TEXT")]
    pub why: Option<String>,
    /// Show what would change and change nothing
    #[arg(long)]
    pub dry_run: bool,
    /// Tell a property that no rule reads yet
    #[arg(long)]
    pub new: bool,
    /// Show what is told
    #[arg(long, conflicts_with_all = ["class", "retract"])]
    pub list: bool,
    /// Take a fact back, by its number in the list
    #[arg(long, value_name = "ID", conflicts_with = "class")]
    pub retract: Option<i64>,
    /// As if it were this time
    #[arg(long, value_name = "TIME")]
    pub at: Option<String>,
}

/// Tells a fact, takes one back, or lists them.
pub fn run(args: &TellArgs) -> Result<()> {
    let knowledge = open(&args.site)?.at(args.at.as_deref())?;
    if args.list {
        return list(&knowledge, args.site.json);
    }
    let edit = match (args.retract, &args.class, &args.object, &args.property, &args.value) {
        (Some(id), ..) => Edit::Retract(id),
        (None, Some(class), Some(object), Some(property), Some(value)) => Edit::Tell(Tell {
            class: class.clone(),
            object: object.clone(),
            property: property.clone(),
            value: value.clone(),
            until: args.until.clone(),
            new_property: args.new,
        }),
        _ => {
            let help =
                "adit tell my-site DOORS \"door 7\" passable false --until 18:00; or --list, or --retract ID";
            return Err(Error::said(
                Code::TellUsage,
                "a fact is CLASS OBJECT PROPERTY VALUE",
                Some(help.to_owned()),
            ));
        }
    };
    apply(&knowledge, &edit, args.why.as_deref(), (args.dry_run, args.site.json))
}

/// Prints what is told: the rows of the view `facts_told`.
fn list(knowledge: &KnowledgeBase, as_json: bool) -> Result<()> {
    let (facts, building) = Store::open_read_only(knowledge.database())?
        .snapshot(|tx| Ok::<_, Error>((tx.read_table("facts_told")?, Building::read(tx)?)))?;
    let rows = facts.columns.first().map_or(0, |column| column.values.len());
    if as_json {
        let names = || facts.columns.iter().map(|column| &column.name);
        let row = |row: usize| object(names(), facts.columns.iter().map(|column| &column.values[row]));
        return json(&(0..rows).map(row).collect::<Vec<_>>());
    }
    if rows == 0 {
        line("nothing is told");
        return Ok(());
    }
    let at = |name: &str, row: usize| {
        let column = facts.column(name);
        column.map_or_else(String::new, |column| text(&column.values[row]))
    };
    let cells = |row: usize| {
        let [class, object, property, value] =
            ["class", "object", "property", "value"].map(|name| at(name, row));
        let about: Vec<String> = serde_json::from_str(&at("objects", row)).unwrap_or_default();
        let name = |key: &String| building.called(&class, key).unwrap_or_else(|| key.clone());
        let about: Vec<String> = about.iter().map(name).collect();
        let about = if about.is_empty() { at("state", row) } else { about.join(", ") };
        let what = format!("{class} {} {property} = {value}", shown(&object));
        let until = at("until", row);
        let is_over = until.parse::<Timestamp>().is_ok_and(|end| end <= Timestamp::now());
        let until = if is_over { format!("{until} (over)") } else { until };
        vec![at("id", row), what, about, until, at("who", row), at("why", row), at("at", row)]
    };
    table(&["fact", "what", "about", "until", "who", "why", "at"], (0..rows).map(cells));
    Ok(())
}

/// A point to the digits that people read; any other name as it is.
fn shown(object: &str) -> String {
    point(object).map_or_else(|| object.to_owned(), |at| format!("{},{}", number(at.x), number(at.y)))
}
