//! Trees of least-cost routes: the tables `starts`, `ends` and `tree_rows`.

use std::cmp::Ordering;

use serde::Serialize;
use sqlx::SqliteConnection;

use crate::bulk::{self, Record, Values};
use crate::error::Result;
use crate::transaction::Tx;

/// A start that has a tree. Several names may share one.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Start {
    /// A name of `ends`.
    pub name: String,
    /// The robot.
    pub robot: String,
    /// The tree.
    pub tree: i64,
}

/// What a name of a start or goal stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum EndKind {
    /// A place.
    Place,
    /// A room.
    Room,
}

/// A name that a route may start or end at.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct End {
    /// The name; places and rooms share no name.
    pub name: String,
    /// The tree node to end at: a room's key, or a negative number for a place that has a node of its own.
    pub node: i64,
    /// What it stands for.
    pub kind: EndKind,
    /// Whether trees lead to it.
    pub kept: bool,
}

/// The last step of the least-cost route into one node. A node is a room's key, or a negative number for a place
/// or for a crossing that must be told apart from others of its room. An unreachable node has no row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TreeRow {
    /// The node.
    pub node: i64,
    /// The node before; `None` for the start.
    pub prev: Option<i64>,
    /// The room that the step walks through. May be left out where `prev` is that room's key; at a start, the room
    /// that it lies in, unless `node` is that room's key.
    pub from_room: Option<i64>,
    /// The door passed at the end of the step; `None` at the start, and for a place within the room.
    pub door: Option<i64>,
    /// Doors passed since the start.
    pub hops: i64,
    /// cost(prev) + leg. The cost on arrival is reach + the door's hardness.
    pub reach: f64,
    /// What the walk in the room adds; 0 in the paper's modes, where the doors bear it all.
    pub leg: f64,
    /// Metres walked in the room since its door, of which `leg` is the hardness; `None` where ways are not measured.
    pub walked: Option<f64>,
    /// Where the step ends, metres; `None` is the door's own point.
    pub at: Option<[f64; 2]>,
    /// Direction of the movement into that point: degrees counterclockwise from +x, kept to 0.01 degrees; `None`
    /// where nothing moves.
    pub heading: Option<f64>,
    /// Metres from the start; `None` where ways are not measured.
    pub distance: Option<f64>,
    /// The least metres between the robot's rim and anything solid since the last bend; `None`: not measured.
    pub clearance: Option<f64>,
    /// Whether the robot turns or changes its shape where the step begins.
    pub bend: bool,
}

impl Record for &Start {
    const TABLE: &'static str = "starts";
    const COLUMNS: &'static [&'static str] = &["name", "robot", "tree"];

    fn bind(&self, values: &mut Values) {
        values.text(&*self.name);
        values.text(&*self.robot);
        values.integer(self.tree);
    }
}

impl Record for &End {
    const TABLE: &'static str = "ends";
    const COLUMNS: &'static [&'static str] = &["name", "node", "kind", "kept"];

    fn bind(&self, values: &mut Values) {
        values.text(&*self.name);
        values.integer(self.node);
        values.text(match self.kind {
            EndKind::Place => "place",
            EndKind::Room => "room",
        });
        values.integer(i64::from(self.kept));
    }
}

struct Rooted {
    tree: i64,
    row: TreeRow,
}

impl Record for Rooted {
    const TABLE: &'static str = "tree_rows";
    const COLUMNS: &'static [&'static str] = &[
        "tree",
        "node",
        "prev",
        "from_room",
        "door",
        "hops",
        "reach",
        "leg",
        "x",
        "y",
        "heading",
        "distance",
        "clearance",
        "bend",
        "walked",
    ];

    fn bind(&self, values: &mut Values) {
        let row = &self.row;
        values.integer(self.tree);
        values.integer(row.node);
        values.integer(row.prev);
        values.integer(row.from_room);
        values.integer(row.door);
        values.integer(row.hops);
        values.real(row.reach);
        values.real(row.leg);
        values.real(row.at.map(|at| at[0]));
        values.real(row.at.map(|at| at[1]));
        values.integer(row.heading.map(|degrees| (degrees * 100.0).round() as i64));
        values.real(row.distance);
        values.real(row.clearance);
        values.integer(i64::from(row.bend));
        values.real(row.walked);
    }
}

/// Takes all trees and starts away.
pub async fn clear(connection: &mut SqliteConnection) -> Result<()> {
    sqlx::query("DELETE FROM starts").execute(&mut *connection).await?;
    sqlx::query("DELETE FROM tree_rows").execute(connection).await?;
    Ok(())
}

/// Writes one tree in place of what it was. Rows in the order of their nodes are written fastest.
pub async fn put(
    connection: &mut SqliteConnection,
    tree: i64,
    rows: impl IntoIterator<Item = TreeRow>,
) -> Result<u64> {
    sqlx::query("DELETE FROM tree_rows WHERE tree = ?").bind(tree).execute(&mut *connection).await?;
    bulk::insert(connection, rows.into_iter().map(|row| Rooted { tree, row })).await
}

/// A row that differs from what is stored in how far it is from the start, and in nothing else.
struct Further {
    tree: i64,
    node: i64,
    reach: f64,
}

impl Record for Further {
    const TABLE: &'static str = "tree_rows";
    const COLUMNS: &'static [&'static str] = &["tree", "node", "reach"];

    fn bind(&self, values: &mut Values) {
        values.integer(self.tree);
        values.integer(self.node);
        values.real(self.reach);
    }
}

/// What changed in one tree.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TreeChange {
    /// Nodes that are no longer reached, ascending.
    pub gone: Vec<i64>,
    /// Rows of nodes that were not reached before, by node.
    pub new: Vec<TreeRow>,
    /// Rows of which only `reach` changed, as node and reach, by node.
    pub further: Vec<(i64, f64)>,
    /// Rows that changed otherwise, by node.
    pub changed: Vec<TreeRow>,
}

impl TreeChange {
    /// How rows differ from what they were, both in the order of their nodes.
    pub fn between(before: &[TreeRow], now: &[TreeRow]) -> Self {
        let mut change = Self::default();
        let (mut old, mut new) = (before.iter().peekable(), now.iter().peekable());
        loop {
            let order = match (old.peek(), new.peek()) {
                (Some(old), Some(new)) => old.node.cmp(&new.node),
                (Some(_), None) => Ordering::Less,
                (None, Some(_)) => Ordering::Greater,
                (None, None) => return change,
            };
            let old = if order.is_le() { old.next() } else { None };
            let new = if order.is_ge() { new.next() } else { None };
            change.note(old, new);
        }
    }

    /// Notes how the row of one node differs.
    pub fn note(&mut self, before: Option<&TreeRow>, now: Option<&TreeRow>) {
        match (before, now) {
            (Some(old), None) => self.gone.push(old.node),
            (None, Some(row)) => self.new.push(*row),
            (Some(old), Some(new)) if old != new => {
                if *old == (TreeRow { reach: old.reach, ..*new }) {
                    self.further.push((new.node, new.reach));
                } else {
                    self.changed.push(*new);
                }
            }
            _ => {}
        }
    }

    /// How many rows changed.
    pub fn len(&self) -> usize {
        self.gone.len() + self.new.len() + self.further.len() + self.changed.len()
    }

    /// Whether nothing changed.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Writes the rows of a tree that changed.
pub async fn change(connection: &mut SqliteConnection, tree: i64, rows: &TreeChange) -> Result<()> {
    if !rows.gone.is_empty() {
        let gone = rows.gone.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
        let sql = "DELETE FROM tree_rows WHERE tree = ?
                   AND node IN (SELECT value FROM json_each('[' || ? || ']'))";
        sqlx::query(sql).bind(tree).bind(gone).execute(&mut *connection).await?;
    }
    bulk::insert(connection, rows.new.iter().map(|&row| Rooted { tree, row })).await?;
    let further = rows.further.iter().map(|&(node, reach)| Further { tree, node, reach });
    bulk::update::<2, _>(connection, further).await?;
    bulk::update::<2, _>(connection, rows.changed.iter().map(|&row| Rooted { tree, row })).await?;
    Ok(())
}

/// Replaces all starts by these.
pub async fn replace_starts(connection: &mut SqliteConnection, starts: &[Start]) -> Result<()> {
    sqlx::query("DELETE FROM starts").execute(&mut *connection).await?;
    bulk::insert(connection, starts).await?;
    Ok(())
}

/// Replaces all names of starts and goals by these.
pub async fn replace_ends(connection: &mut SqliteConnection, ends: &[End]) -> Result<()> {
    sqlx::query("DELETE FROM ends").execute(&mut *connection).await?;
    bulk::insert(connection, ends).await?;
    Ok(())
}

impl Tx<'_> {
    /// Takes all trees and starts away.
    pub fn clear_trees(&mut self) -> Result<()> {
        self.run(clear)
    }

    /// Writes one tree in place of what it was, row by row as they come; how many. Rows in the order of their nodes
    /// are written fastest.
    pub fn put_tree(&mut self, tree: i64, rows: impl IntoIterator<Item = TreeRow>) -> Result<u64> {
        self.run(async |connection| put(connection, tree, rows).await)
    }

    /// Writes many trees, each row with its tree's number; how many rows. What these trees were must be cleared first.
    pub fn put_trees(&mut self, rows: impl IntoIterator<Item = (i64, TreeRow)>) -> Result<u64> {
        let rooted = rows.into_iter().map(|(tree, row)| Rooted { tree, row });
        self.run(async |connection| bulk::insert(connection, rooted).await)
    }

    /// Writes the rows of a tree that changed.
    pub fn change_tree(&mut self, tree: i64, rows: &TreeChange) -> Result<()> {
        self.run(async |connection| change(connection, tree, rows).await)
    }

    /// Replaces all starts by these.
    pub fn replace_starts(&mut self, by: &[Start]) -> Result<()> {
        self.run(async |connection| replace_starts(connection, by).await)
    }

    /// Replaces all names of starts and goals by these.
    pub fn replace_ends(&mut self, by: &[End]) -> Result<()> {
        self.run(async |connection| replace_ends(connection, by).await)
    }
}
