//! Rows of rooms and doors once more, many in one value: the table `blocks`. They are read and written here alone, with
//! the rows; an edit of anybody else takes them away (triggers of `sql/v4`), and then the rows are read.

mod codec;

use futures_util::TryStreamExt;
use sqlx::{Row as _, SqliteConnection};

use crate::bulk::{self, Record, Values};
use crate::error::Result;
use crate::schema::{Part, Row, Weighing, select};
use crate::stale::in_bulk;
use crate::transaction::Tx;
use crate::weight::Weight;

/// The parts that are kept apart, with their name and how many rows one value has: what planners give changes as a whole,
/// what rules say in a few rows.
const PARTS: [(Part, &str, usize); 2] = [(Part::Cut, "cut", 4_096), (Part::Weight, WEIGHTS, WEIGHT_ROWS)];
const WEIGHTS: &str = "weights";
const WEIGHT_ROWS: usize = 128;

struct Block {
    class: &'static str,
    part: &'static str,
    at: usize,
    first: i64,
    bytes: Vec<u8>,
}

impl Record for Block {
    const TABLE: &'static str = "blocks";
    const COLUMNS: &'static [&'static str] = &["class", "part", "at", "first", "bytes"];

    fn bind(&self, values: &mut Values) {
        values.text(self.class);
        values.text(self.part);
        values.integer(self.at as i64);
        values.integer(self.first);
        values.blob(&self.bytes);
    }
}

struct Rewritten {
    class: &'static str,
    first: i64,
    bytes: Vec<u8>,
}

impl Record for Rewritten {
    const TABLE: &'static str = "blocks";
    const COLUMNS: &'static [&'static str] = &["class", "part", "first", "bytes"];

    fn bind(&self, values: &mut Values) {
        values.text(self.class);
        values.text(WEIGHTS);
        values.integer(self.first);
        values.blob(&self.bytes);
    }
}

/// All rows, by number: from blocks where they are whole, else row by row.
pub(crate) async fn read<R: Row>(connection: &mut SqliteConnection) -> Result<Vec<R>> {
    match whole(connection).await? {
        Some(rows) => Ok(rows),
        None => select(connection, "ORDER BY 1", &[]).await,
    }
}

/// The rows that blocks hold; `None` where one is missing or cannot be read, or there is none. Each block becomes rows
/// while SQLite reads the next.
async fn whole<R: Row>(connection: &mut SqliteConnection) -> Result<Option<Vec<R>>> {
    let mut rows = Vec::new();
    for (part, name, size) in PARTS {
        let sql = "SELECT at, bytes FROM blocks WHERE class = ? AND part = ? ORDER BY first";
        let mut blocks = sqlx::query(sql).bind(R::TABLE).bind(name).fetch(&mut *connection);
        let mut end = 0;
        while let Some(block) = blocks.try_next().await? {
            let (at, bytes): (i64, &[u8]) = (block.try_get(0)?, block.try_get(1)?);
            let length = codec::len(bytes).filter(|rows| *rows <= size && usize::try_from(at) == Ok(end));
            let Some(length) = length else { return Ok(None) };
            if part == Part::Cut {
                rows.resize(end + length, R::default());
            }
            let of_block = rows.get_mut(end..end + length);
            if of_block.and_then(|rows| codec::decode(R::columns_of(part), bytes, rows)).is_none() {
                return Ok(None);
            }
            end += length;
        }
        if end != rows.len() || rows.is_empty() {
            return Ok(None);
        }
    }
    Ok(Some(rows))
}

/// Replaces all rows by these, blocks and all.
pub(crate) async fn replace<R: Row>(connection: &mut SqliteConnection, rows: &[R]) -> Result<()> {
    in_bulk(connection, R::TABLE, async |connection| {
        bulk::insert(connection, rows).await?;
        forget::<R>(connection).await?;
        restore(connection, rows).await
    })
    .await
}

/// Has rules say something else of these rows, blocks and all; how many there were.
pub(crate) async fn reweigh<R: Row>(connection: &mut SqliteConnection, mut rows: Vec<R>) -> Result<u64> {
    if rows.is_empty() {
        return Ok(0);
    }
    rows.sort_by_key(R::key);
    in_bulk(connection, R::TABLE, async |connection| {
        rewrite(connection, &rows).await?;
        bulk::update::<1, _>(connection, rows.iter().map(Weighing)).await
    })
    .await
}

/// Writes blocks of what rules say anew in which these rows are; where that cannot be, takes all blocks away.
async fn rewrite<R: Row>(connection: &mut SqliteConnection, rows: &[R]) -> Result<()> {
    let keys = rows.iter().map(|row| row.key().to_string()).collect::<Vec<_>>().join(",");
    let sql = "SELECT first, bytes FROM blocks WHERE class = ?1 AND part = 'weights' AND first IN (
                 SELECT (SELECT max(first) FROM blocks WHERE class = ?1 AND part = 'weights' AND first <= value)
                 FROM json_each('[' || ?2 || ']'))
               ORDER BY first";
    let blocks = sqlx::query(sql).bind(R::TABLE).bind(keys).fetch_all(&mut *connection).await?;
    let firsts = blocks.iter().map(|block| block.try_get(0)).collect::<sqlx::Result<Vec<i64>>>()?;
    let mut rest = rows;
    let mut rewritten = Vec::with_capacity(blocks.len());
    for (index, block) in blocks.iter().enumerate() {
        let end = firsts.get(index + 1).copied().unwrap_or(i64::MAX);
        let (here, behind) = rest.split_at(rest.partition_point(|row| row.key() < end));
        let bytes = patched(block.try_get(1)?, here);
        rewritten.extend(bytes.map(|bytes| Rewritten { class: R::TABLE, first: firsts[index], bytes }));
        rest = behind;
    }
    if !rest.is_empty() || rewritten.len() < blocks.len() {
        return forget::<R>(connection).await;
    }
    bulk::update::<3, _>(connection, rewritten).await?;
    Ok(())
}

/// A block of what rules say with other rows in it; `None` where it lacks one of them, or cannot be read.
fn patched<R: Row>(bytes: &[u8], rows: &[R]) -> Option<Vec<u8>> {
    let mut all = vec![R::default(); codec::len(bytes).filter(|rows| *rows <= WEIGHT_ROWS)?];
    codec::decode(R::columns_of(Part::Weight), bytes, &mut all)?;
    for row in rows {
        let at = all.binary_search_by_key(&row.key(), R::key).ok()?;
        all[at].clone_from(row);
    }
    Some(codec::encode(R::columns_of(Part::Weight), &all))
}

async fn forget<R: Row>(connection: &mut SqliteConnection) -> Result<()> {
    sqlx::query("DELETE FROM blocks WHERE class = ?").bind(R::TABLE).execute(connection).await?;
    Ok(())
}

/// Writes the blocks of these rows, which are those of the table, where there are none.
pub(crate) async fn restore<R: Row>(connection: &mut SqliteConnection, rows: &[R]) -> Result<()> {
    let sql = "SELECT EXISTS (SELECT 1 FROM blocks WHERE class = ?)";
    let is_there: bool = sqlx::query_scalar(sql).bind(R::TABLE).fetch_one(&mut *connection).await?;
    if !is_there && rows.is_sorted_by_key(R::key) {
        for (part, name, size) in PARTS {
            let blocks = rows.chunks(size).enumerate().map(|(index, rows)| Block {
                class: R::TABLE,
                part: name,
                at: index * size,
                first: rows[0].key(),
                bytes: codec::encode(R::columns_of(part), rows),
            });
            bulk::insert(connection, blocks).await?;
        }
    }
    Ok(())
}

impl Tx<'_> {
    /// Gives these rooms or doors, by number, other weights; how many.
    pub fn put_weights<'w, R: Row>(
        &mut self,
        weights: impl IntoIterator<Item = (i64, &'w Weight)>,
    ) -> Result<u64> {
        let row = |(key, weight): (i64, &Weight)| {
            let mut row = R::numbered(key);
            row.weigh(weight.clone());
            row
        };
        let rows = weights.into_iter().map(row).collect();
        self.run(async |connection| reweigh::<R>(connection, rows).await)
    }

    /// Writes the blocks of the rooms or doors that there are, where they have none.
    pub fn restore_blocks<R: Row>(&mut self, rows: &[R]) -> Result<()> {
        self.run(async |connection| restore(connection, rows).await)
    }
}
