//! What of a lane graph can be closed, by the name that people have for it: a lane, a door, a lift, a node.

use std::collections::HashMap;

use adit_db::{Cell, Tx};
use adit_planners::geometry::{Point, Segment};

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

/// How far what is closed may be from where a robot was blocked, metres.
pub(super) const NEAR_M: f64 = 1.5;

/// A vehicle that is blocked on a lane looks along it, give or take so many degrees.
const AHEAD_DEGREES: f64 = 60.0;

/// Of two lanes that differ by less than this a point does not say which is meant.
const ALIKE_M: f64 = 0.05;
const ALIKE_DEGREES: f64 = 5.0;

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
    let Some(keys) = relation.column(kind.key) else { return Ok(Vec::new()) };
    let name = |row: usize| match relation.value("name", row) {
        Some(Cell::Text(name)) => Some(name.clone()),
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

/// The lane on which a vehicle was blocked that stood at a point and was heading somewhere; without a heading the only lane
/// that is near.
pub(super) fn at(
    tx: &mut Tx<'_>,
    what: &str,
    (at, heading): (Point, Option<f64>),
) -> Result<Option<(&'static str, String)>> {
    let [lane, ..] = &KINDS;
    let lanes = things(tx, lane)?;
    if lanes.is_empty() {
        return Ok(None);
    }
    let (nodes, ends) = (tx.read_table("nodes")?, tx.read_table("lanes")?);
    let real = |name: &str, row: usize| match nodes.value(name, row) {
        Some(Cell::Real(value)) => Some(*value),
        Some(Cell::Integer(value)) => Some(*value as f64),
        _ => None,
    };
    let rows = 0..nodes.columns.first().map_or(0, |column| column.values.len());
    let node = |row: usize| {
        let key = nodes.value("node", row)?.to_string();
        Some((key, Point::new(real("x", row)?, real("y", row)?)))
    };
    let nodes_at: HashMap<String, Point> = rows.filter_map(node).collect();
    let end = |name: &str, row: usize| nodes_at.get(&ends.value(name, row)?.to_string()).copied();
    let near = |(row, (key, name)): (usize, (String, Option<String>))| {
        let segment = Segment::new(end("from_node", row)?, end("to_node", row)?);
        let way = segment.b - segment.a;
        let turned = heading.map_or(0.0, |heading| {
            let off = (way.y.atan2(way.x).to_degrees() - heading).rem_euclid(360.0);
            off.min(360.0 - off)
        });
        let far = segment.distance(at);
        // at its end nothing of a lane is ahead
        if heading.is_some() && segment.b.distance(at) <= far + ALIKE_M {
            return None;
        }
        (far <= NEAR_M && turned <= AHEAD_DEGREES).then_some((far, turned, name, key))
    };
    let mut near: Vec<_> = lanes.into_iter().enumerate().filter_map(near).collect();
    near.sort_by(|one, other| (one.0.total_cmp(&other.0)).then(one.1.total_cmp(&other.1)));
    let is_alike = |other: &&(f64, f64, Option<String>, String)| {
        near.first().is_some_and(|first| other.0 - first.0 <= ALIKE_M && other.1 - first.1 <= ALIKE_DEGREES)
    };
    let alike: Vec<_> = near.iter().filter(is_alike).collect();
    match alike[..] {
        [] => Ok(None),
        [(_, _, _, key)] => Ok(Some((lane.class, key.clone()))),
        _ => {
            let said: Vec<String> = alike.iter().map(|(_, _, _, key)| format!("lane {key}")).collect();
            let message = format!("{what} lies on {}", said.join(" and on "));
            let help = match heading {
                Some(_) => "say which".to_owned(),
                None => "say which, or the heading as well: x,y@90".to_owned(),
            };
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
