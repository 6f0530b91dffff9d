//! Rows as bytes, column by column, and back. What was written by another list of columns, is damaged, or is no block at
//! all is not read.
//!
//! A checksum; what the columns are; how many rows; then each column: one value for all rows, or one for each. Integers
//! stand as differences from the least one, texts and integers that lie far apart as their place among the different
//! ones, a NULL among numbers as the NaN that no table takes.

use std::collections::HashMap;
use std::hash::Hash;

use crate::schema::{Column, Kind, Row, Value};

/// Behind which there is a value for each row.
const EACH: u8 = 0;
/// Behind which there is one value for all rows.
const ALIKE: u8 = 1;
/// Behind which the different integers stand, and for each row the place of its own among them.
const PLACES: u8 = 2;

pub(super) fn encode<'c, R: Row>(
    columns: impl Iterator<Item = &'c Column<R>> + Clone,
    rows: &[R],
) -> Vec<u8> {
    let mut body = Vec::with_capacity(rows.len() * 32);
    body.extend(fingerprint(columns.clone()).to_le_bytes());
    body.extend((rows.len() as u32).to_le_bytes());
    for column in columns {
        put_column(&mut body, column.kind, rows.iter().map(column.get));
    }
    let mut bytes = crc32fast::hash(&body).to_le_bytes().to_vec();
    bytes.extend(body);
    bytes
}

/// Puts what the block says into rows; how many it has. `None` where it cannot be read, or has more than there are rows.
pub(super) fn decode<'c, R: Row>(
    columns: impl Iterator<Item = &'c Column<R>> + Clone,
    bytes: &[u8],
    rows: &mut [R],
) -> Option<usize> {
    let mut bytes = Bytes(bytes);
    if bytes.u32()? != crc32fast::hash(bytes.0) || bytes.u32()? != fingerprint(columns.clone()) {
        return None;
    }
    let rows = rows.get_mut(..bytes.u32()? as usize)?;
    for column in columns {
        take_column(&mut bytes, column, rows)?;
    }
    bytes.0.is_empty().then_some(rows.len())
}

/// How many rows a block says that it has.
pub(super) fn len(bytes: &[u8]) -> Option<usize> {
    Bytes(bytes.get(8..)?).u32().map(|rows| rows as usize)
}

fn fingerprint<'c, R: Row>(columns: impl Iterator<Item = &'c Column<R>>) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    for column in columns {
        hasher.update(format!("{} {:?};", column.name, column.kind).as_bytes());
    }
    hasher.finalize()
}

fn put_column<'r>(out: &mut Vec<u8>, kind: Kind, values: impl ExactSizeIterator<Item = Value<'r>> + Clone) {
    let first = values.clone().next().unwrap_or(Value::Null);
    let is_alike = values.clone().all(|value| value == first);
    let values = values.take(if is_alike { 1 } else { usize::MAX });
    let far = !is_alike && kind == Kind::Integer && width(values.clone().map(integer)).1 == FAR;
    out.push(if is_alike {
        ALIKE
    } else if far {
        PLACES
    } else {
        EACH
    });
    match kind {
        Kind::Real => values.for_each(|value| out.extend(bits(value).to_le_bytes())),
        Kind::Integer if far => {
            let (different, places) = places(values.map(integer));
            out.extend((different.len() as u32).to_le_bytes());
            for value in different {
                out.extend(value.to_le_bytes());
            }
            put_integers(out, places.into_iter());
        }
        Kind::Integer | Kind::Truth => put_integers(out, values.map(integer)),
        Kind::Text => {
            let (different, places) = places(values.map(text));
            out.extend((different.len() as u32).to_le_bytes());
            for text in different {
                out.extend((text.len() as u32).to_le_bytes());
                out.extend(text.as_bytes());
            }
            put_integers(out, places.into_iter());
        }
    }
}

/// The different values in the order in which they come, and the place of each among them.
fn places<T: Copy + Eq + Hash>(values: impl Iterator<Item = Option<T>>) -> (Vec<T>, Vec<Option<i64>>) {
    let (mut different, mut known) = (Vec::new(), HashMap::new());
    let mut place = |value| {
        *known.entry(value).or_insert_with(|| {
            different.push(value);
            different.len() as i64 - 1
        })
    };
    let places = values.map(|value| value.map(&mut place)).collect();
    (different, places)
}

fn text(value: Value<'_>) -> Option<&str> {
    if let Value::Text(text) = value { Some(text) } else { None }
}

fn bits(value: Value<'_>) -> u64 {
    // SQLite knows one zero
    if let Value::Real(real) = value { (real + 0.0).to_bits() } else { f64::NAN.to_bits() }
}

fn integer(value: Value<'_>) -> Option<i64> {
    match value {
        Value::Integer(value) => Some(value),
        Value::Truth(truth) => Some(truth.into()),
        _ => None,
    }
}

/// In how many bytes differences are written that do not fit into four.
const FAR: u8 = 8;

/// The least integer, and how many bytes hold the largest difference from it and something above, for a NULL.
fn width(values: impl Iterator<Item = Option<i64>> + Clone) -> (i64, u8) {
    let least = values.clone().flatten().min().unwrap_or(0);
    let most = values.flatten().max().map_or(0, |most| most.wrapping_sub(least) as u64);
    let width = [1_u8, 2, 4].into_iter().find(|bytes| most < (1 << (8 * bytes)) - 1);
    (least, width.unwrap_or(FAR))
}

fn put_integers(out: &mut Vec<u8>, values: impl Iterator<Item = Option<i64>> + Clone) {
    let (least, width) = width(values.clone());
    out.extend(least.to_le_bytes());
    out.push(width);
    for value in values {
        let difference = value.map_or(u64::MAX, |value| value.wrapping_sub(least) as u64);
        out.extend(&difference.to_le_bytes()[..width.into()]);
    }
}

struct Bytes<'b>(&'b [u8]);

impl<'b> Bytes<'b> {
    fn take(&mut self, count: usize) -> Option<&'b [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    fn u32(&mut self) -> Option<u32> {
        self.array().map(u32::from_le_bytes)
    }

    fn integers(&mut self, count: usize) -> Option<impl Iterator<Item = Option<i64>> + use<'b>> {
        let least = self.array().map(i64::from_le_bytes)?;
        let width = usize::from(self.array::<1>()?[0]);
        if ![1, 2, 4, 8].contains(&width) {
            return None;
        }
        let null = u64::MAX >> (64 - 8 * width);
        let value = move |bytes: &[u8]| {
            let mut all = [0; 8];
            all[..width].copy_from_slice(bytes);
            let difference = u64::from_le_bytes(all);
            (difference != null).then(|| least.wrapping_add(difference as i64))
        };
        Some(self.take(count.checked_mul(width)?)?.chunks_exact(width).map(value))
    }

    /// The values that stand as their place among the different ones.
    fn placed<'v>(
        &mut self,
        count: usize,
        different: &'v [Value<'b>],
    ) -> Option<impl Iterator<Item = Option<Value<'b>>> + use<'b, 'v>> {
        let at = |place| different.get(usize::try_from(place).ok()?).copied();
        Some(self.integers(count)?.map(move |place| place.map_or(Some(Value::Null), at)))
    }
}

fn take_column<R: Row>(bytes: &mut Bytes<'_>, column: &Column<R>, rows: &mut [R]) -> Option<()> {
    let [form] = bytes.array()?;
    let is_alike = form == ALIKE;
    let count = if is_alike { 1 } else { rows.len() };
    match column.kind {
        Kind::Real => {
            let reals = bytes.take(count.checked_mul(8)?)?.chunks_exact(8).map(|real| {
                let real = f64::from_le_bytes(real.try_into().unwrap_or_default());
                Some(if real.is_nan() { Value::Null } else { Value::Real(real) })
            });
            fill(column, rows, is_alike, reals)
        }
        Kind::Integer if form == PLACES => {
            let mut different = Vec::new();
            for _ in 0..bytes.u32()? {
                different.push(Value::Integer(i64::from_le_bytes(bytes.array()?)));
            }
            fill(column, rows, is_alike, bytes.placed(count, &different)?)
        }
        Kind::Integer => {
            let integers = bytes.integers(count)?;
            let integer = |value: Option<i64>| Some(value.map_or(Value::Null, Value::Integer));
            fill(column, rows, is_alike, integers.map(integer))
        }
        Kind::Truth => {
            let truth =
                |value: Option<i64>| Some(value.map_or(Value::Null, |value| Value::Truth(value != 0)));
            let integers = bytes.integers(count)?;
            fill(column, rows, is_alike, integers.map(truth))
        }
        Kind::Text => {
            let mut texts = Vec::new();
            for _ in 0..bytes.u32()? {
                let length = bytes.u32()? as usize;
                texts.push(Value::Text(std::str::from_utf8(bytes.take(length)?).ok()?));
            }
            fill(column, rows, is_alike, bytes.placed(count, &texts)?)
        }
    }
}

fn fill<'v, R: Row>(
    column: &Column<R>,
    rows: &mut [R],
    is_alike: bool,
    mut values: impl Iterator<Item = Option<Value<'v>>>,
) -> Option<()> {
    let alike = if is_alike { Some(values.next()??) } else { None };
    for row in rows {
        let value = alike.or_else(|| values.next()?)?;
        if !(column.put)(row, value) {
            return None;
        }
    }
    Some(())
}
