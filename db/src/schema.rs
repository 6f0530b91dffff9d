//! The columns of a table, once: what SQL reads and writes, what a block holds and what planners give follow from them.
//!
//! A column more on rooms or doors is a field of [`Room`](crate::room::Room) or [`Door`](crate::door::Door), a line in
//! `COLUMNS` below it, and an `ALTER TABLE` in a new step of `sql/` (`migrate.rs` lists the steps; `WRITE_SCHEMA=1 cargo test -p
//! adit-db --lib` writes what they come to, with which new databases begin).

use sqlx::Row as _;
use sqlx::SqliteConnection;
use sqlx::sqlite::SqliteRow;

use crate::bulk::{Record, Values};
use crate::cell::Cell;
use crate::dynamic;
use crate::error::{Error, Result};
use crate::weight::Weight;

/// A value of a column, lent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value<'v> {
    Null,
    Integer(i64),
    Real(f64),
    Text(&'v str),
    Truth(bool),
}

/// What a column holds besides NULL.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    Integer,
    Real,
    Text,
    /// An integer in SQL, 0 or 1.
    Truth,
}

/// Who says what a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// The row's number.
    Key,
    /// Planners, who cut the floor.
    Cut,
    /// Rules, with what they rest on.
    Weight,
}

/// A column of a table whose rows are `R`.
pub struct Column<R: 'static> {
    pub name: &'static str,
    pub kind: Kind,
    pub part: Part,
    pub get: for<'r> fn(&'r R) -> Value<'r>,
    /// Takes a value over; `false` where it is of another kind, or is missing and must not.
    pub put: fn(&mut R, Value<'_>) -> bool,
}

/// A line of `COLUMNS`: whose it is, what it holds, its name, and the field that holds it.
macro_rules! column {
    ($part:ident $kind:ident $name:literal $($field:ident).+ $([$index:literal])?) => {
        $crate::schema::Column {
            name: $name,
            kind: $crate::schema::Kind::$kind,
            part: $crate::schema::Part::$part,
            get: |row| $crate::schema::Field::value(&row.$($field).+ $([$index])?),
            put: |row, value| $crate::schema::Field::put(&mut row.$($field).+ $([$index])?, value),
        }
    };
}
pub(crate) use column;

/// A row of a table whose columns stand in one list: the key first, what planners give, what rules say.
pub trait Row: Default + Clone + Send + Sync + 'static {
    const TABLE: &'static str;
    const COLUMNS: &'static [Column<Self>];
    /// The names of all columns.
    const NAMES: &'static [&'static str];
    /// The names of the key and of what rules say.
    const WEIGHT_NAMES: &'static [&'static str];

    fn key(&self) -> i64;

    /// A row of which nothing is known but its number.
    fn numbered(key: i64) -> Self;

    /// What rules say of it.
    fn weight(&self) -> Weight;

    /// Whether rules say this of it.
    fn weighs(&self, weight: &Weight) -> bool;

    /// Has rules say something else of it.
    fn weigh(&mut self, weight: Weight);

    /// The key's column and those of a part.
    fn columns_of(part: Part) -> impl Iterator<Item = &'static Column<Self>> + Clone {
        Self::COLUMNS.iter().filter(move |column| column.part == Part::Key || column.part == part)
    }
}

pub(crate) const fn names<R: 'static, const N: usize>(
    columns: &[Column<R>],
    from: usize,
) -> [&'static str; N] {
    let mut names = [columns[0].name; N];
    let mut at = 1;
    while at < N {
        names[at] = columns[from + at].name;
        at += 1;
    }
    names
}

/// What a field of a row holds.
pub trait Field {
    fn value(&self) -> Value<'_>;

    fn put(&mut self, value: Value<'_>) -> bool;
}

/// A field that holds what one kind of value holds.
macro_rules! field {
    ($of:ty, $kind:ident, |$own:ident| $get:expr, |$value:ident| $take:expr) => {
        impl Field for $of {
            fn value(&self) -> Value<'_> {
                let $own = self;
                Value::$kind($get)
            }

            fn put(&mut self, value: Value<'_>) -> bool {
                let Value::$kind($value) = value else { return false };
                *self = $take;
                true
            }
        }
    };
}

field!(i64, Integer, |own| *own, |value| value);
field!(f64, Real, |own| *own, |value| value);
field!(bool, Truth, |own| *own, |value| value);
field!(String, Text, |own| own, |value| value.to_owned());

impl<T: Field + Default> Field for Option<T> {
    fn value(&self) -> Value<'_> {
        self.as_ref().map_or(Value::Null, T::value)
    }

    fn put(&mut self, value: Value<'_>) -> bool {
        if value == Value::Null {
            *self = None;
            return true;
        }
        self.get_or_insert_default().put(value)
    }
}

impl Values {
    fn lent(&mut self, value: Value<'_>) {
        match value {
            Value::Null => self.integer(None),
            Value::Integer(value) => self.integer(value),
            Value::Real(value) => self.real(value),
            Value::Text(value) => self.text(value),
            Value::Truth(value) => self.truth(value),
        }
    }
}

impl<R: Row> Record for &R {
    const TABLE: &'static str = R::TABLE;
    const COLUMNS: &'static [&'static str] = R::NAMES;

    fn bind(&self, values: &mut Values) {
        for column in R::COLUMNS {
            values.lent((column.get)(self));
        }
    }
}

/// What rules say of a row.
pub(crate) struct Weighing<'r, R>(pub &'r R);

impl<R: Row> Record for Weighing<'_, R> {
    const TABLE: &'static str = R::TABLE;
    const COLUMNS: &'static [&'static str] = R::WEIGHT_NAMES;

    fn bind(&self, values: &mut Values) {
        R::columns_of(Part::Weight).for_each(|column| values.lent((column.get)(self.0)));
    }
}

/// The rows for which a condition (or an order) holds.
pub(crate) async fn select<R: Row>(
    connection: &mut SqliteConnection,
    condition: &str,
    values: &[Cell],
) -> Result<Vec<R>> {
    let sql = format!("SELECT {} FROM {} {condition}", R::NAMES.join(","), R::TABLE);
    let rows = dynamic::fetch(connection, sql, values).await?;
    rows.iter().enumerate().map(|(at, row)| read(row, at + 1)).collect()
}

fn read<R: Row>(row: &SqliteRow, number: usize) -> Result<R> {
    let mut made = R::default();
    for (at, column) in R::COLUMNS.iter().enumerate() {
        let is_taken = match column.kind {
            Kind::Integer => (column.put)(&mut made, row.try_get::<Option<i64>, _>(at)?.value()),
            Kind::Real => (column.put)(&mut made, row.try_get::<Option<f64>, _>(at)?.value()),
            Kind::Truth => (column.put)(&mut made, row.try_get::<Option<bool>, _>(at)?.value()),
            Kind::Text => {
                let text = row.try_get::<Option<&str>, _>(at)?;
                (column.put)(&mut made, text.map_or(Value::Null, Value::Text))
            }
        };
        if !is_taken {
            let (table, row) = (R::TABLE.to_owned(), number);
            let (column, reason) = (column.name.to_owned(), "the column cannot hold it".to_owned());
            return Err(Error::Unreadable { table, column, row, reason });
        }
    }
    Ok(made)
}
