//! `adit tell`.

use adit_db::Store;

use super::TellArgs;
use super::build::open;
use super::output::{json, line, table};
use super::tune::apply;
use crate::edit::Edit;
use crate::edit::Tell;
use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;

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
    let facts = Store::open_read_only(knowledge.database())?.snapshot(|tx| tx.read_table("facts_told"))?;
    let rows = facts.columns.first().map_or(0, |column| column.values.len());
    if as_json {
        let row = |row: usize| -> serde_json::Value {
            let cells = facts
                .columns
                .iter()
                .map(|column| (column.name.clone(), serde_json::json!(column.values[row])));
            serde_json::Value::Object(cells.collect())
        };
        return json(&(0..rows).map(row).collect::<Vec<_>>());
    }
    if rows == 0 {
        line("nothing is told");
        return Ok(());
    }
    let names: Vec<&str> = facts.columns.iter().map(|column| column.name.as_str()).collect();
    let text = |cell: &adit_db::Cell| match cell {
        adit_db::Cell::Null => String::new(),
        cell => cell.to_string(),
    };
    let cells = |row: usize| facts.columns.iter().map(|column| text(&column.values[row])).collect();
    table(&names, (0..rows).map(cells));
    Ok(())
}
