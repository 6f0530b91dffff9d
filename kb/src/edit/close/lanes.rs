//! What of a lane graph can be closed, by the name that people have for it: a lane, a door, a lift, a node.

use adit_db::Tx;

use crate::error::{Code, Error, Result};

/// A kind of things: the word before its key, its class, its table, the column of the key.
struct Kind {
    word: &'static str,
    class: &'static str,
    table: &'static str,
    key: &'static str,
}

const KINDS: [Kind; 4] = [
    Kind { word: "lane", class: "LANES", table: "lanes", key: "lane" },
    Kind { word: "door", class: "LANE_DOORS", table: "lane_doors", key: "door" },
    Kind { word: "lift", class: "LIFTS", table: "lifts", key: "lift" },
    Kind { word: "node", class: "NODES", table: "nodes", key: "node" },
];

/// What Open-RMF calls a node.
const WAYPOINT: &str = "waypoint";

/// Keys of the things of a kind, with the name of each that has one.
fn things(tx: &mut Tx<'_>, kind: &Kind) -> Result<Vec<(String, Option<String>)>> {
    // other maps have tables of these names, too, of which none has nodes
    let tables = tx.user_tables()?;
    if !["nodes", kind.table].iter().all(|name| tables.iter().any(|table| table.name == *name)) {
        return Ok(Vec::new());
    }
    let relation = tx.read_table(kind.table)?;
    let column = |name: &str| relation.columns.iter().find(|column| column.name == name);
    let Some(keys) = column(kind.key) else { return Ok(Vec::new()) };
    let name = |row: usize| match column("name").and_then(|names| names.values.get(row)) {
        Some(adit_db::Cell::Text(name)) => Some(name.clone()),
        _ => None,
    };
    Ok(keys.values.iter().enumerate().map(|(row, key)| (key.to_string(), name(row))).collect())
}

/// What a name stands for: class and key. `lane 12` and `node 12` by their keys; anything by a name of its own.
pub(super) fn meant(tx: &mut Tx<'_>, what: &str) -> Result<Option<(&'static str, String)>> {
    let mut found: Vec<(&Kind, String)> = Vec::new();
    for kind in &KINDS {
        let words = [kind.word, if kind.word == "node" { WAYPOINT } else { kind.word }];
        let of_key = words.iter().find_map(|word| what.strip_prefix(word)?.strip_prefix(' ')).map(str::trim);
        // keys of lanes and nodes are mostly numbers, which mean nothing alone
        let is_named = |key: &str| ["door", "lift"].contains(&kind.word) && key == what;
        let is_it = |(key, name): &(String, Option<String>)| {
            of_key == Some(key.as_str()) || is_named(key) || name.as_deref() == Some(what)
        };
        found.extend(things(tx, kind)?.into_iter().filter(is_it).map(|(key, _)| (kind, key)));
    }
    match found.as_slice() {
        [] => Ok(None),
        [(kind, key)] => Ok(Some((kind.class, key.clone()))),
        several => {
            let said: Vec<String> =
                several.iter().map(|(kind, key)| format!("{} {key}", kind.word)).collect();
            let message = format!("`{what}` may be {}", said.join(" or "));
            let help = format!("say which: `{}`", said[0]);
            Err(Error::said(Code::TellUnknownObject, message, Some(help)))
        }
    }
}

/// What can be closed, as people call it.
pub(super) fn names(tx: &mut Tx<'_>) -> Result<Vec<String>> {
    let mut names = Vec::new();
    for kind in &KINDS {
        for (key, name) in things(tx, kind)? {
            names.push(name.unwrap_or_else(|| format!("{} {key}", kind.word)));
        }
    }
    Ok(names)
}
