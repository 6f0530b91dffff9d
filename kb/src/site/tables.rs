//! Tables of the site's own as files: `tables/NAME.csv` or `NAME.xlsx` seeds the table NAME once; from then on the database is
//! what counts.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use adit_db::relation::Relation;
use adit_db::{Cell, Tx};
use adit_planners::facts::{Column, Table};

use super::sheet::{Sheet, has_decimal_comma, is_sheet};
use crate::error::{Code, Error, Finding, Result};
use crate::words::number::counted;

/// A table of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct TableFile {
    pub path: PathBuf,
    pub name: String,
    /// Name and declared type of each column, those of the key first among them.
    columns: Vec<(String, &'static str)>,
    /// The places of the columns of the key.
    key: Vec<usize>,
    rows: Vec<Vec<Cell>>,
}

/// The files of tables in a folder, by name, but for those by which spreadsheet programs mark what is open: `~$ores.xlsx`.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let is_lock = |name: &str| name.starts_with("~$") || name.starts_with(".~lock");
    let entries = entries.filter(|entry| !is_lock(&entry.file_name().to_string_lossy()));
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(|path| is_sheet(path)).collect();
    files.sort();
    files
}

/// Reads all of them.
pub fn read(folder: &Path) -> Result<Vec<TableFile>> {
    let mut tables: Vec<TableFile> = Vec::new();
    for path in files(folder) {
        let sheet = Sheet::read(&path)?;
        let table = TableFile::of(&sheet)?;
        if let Some(other) = tables.iter().find(|known| known.name.eq_ignore_ascii_case(&table.name)) {
            let message = format!("this is table `{}`, and so is {}", table.name, other.path.display());
            return Err(sheet.wrong(
                None,
                &message,
                "take one of the two files away, or give it another name",
            ));
        }
        tables.push(table);
    }
    Ok(tables)
}

/// A word about each column that is of texts for the one reason that its numbers are written with commas.
pub fn with_commas(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for sheet in files(folder).iter().filter_map(|path| Sheet::read(path).ok()) {
        for (at, column) in sheet.columns.iter().enumerate() {
            let cells = || sheet.rows.iter().map(|row| row[at].trim()).enumerate();
            let mut known = cells().filter(|(_, cell)| !cell.is_empty());
            let is_number = |(_, cell): (usize, &str)| is_number(cell) || has_decimal_comma(cell);
            if let Some((row, text)) = cells().find(|(_, cell)| has_decimal_comma(cell))
                && known.all(is_number)
            {
                let (file, row) = (sheet.path.display(), row + 2);
                found.push(format!(
                    "{file}, row {row}: `{text}` is written with a comma, so all of `{column}` counts as texts, not as numbers"
                ));
            }
        }
    }
    found
}

/// Cells that are no numbers in columns that hold numbers otherwise, so that rules take the whole column for texts.
///
/// # Arguments
/// `is_meant` says of a column whether it is asked about.
pub fn mixed(folder: &Path, is_meant: impl Fn(&str) -> bool) -> Vec<Finding> {
    let mut found = Vec::new();
    for sheet in files(folder).iter().filter_map(|path| Sheet::read(path).ok()) {
        for (at, column) in sheet.columns.iter().enumerate().filter(|(_, column)| is_meant(column)) {
            let cells = sheet.rows.iter().map(|row| row[at].trim()).enumerate();
            let (numbers, texts): (Vec<_>, Vec<_>) =
                cells.filter(|(_, cell)| !cell.is_empty()).partition(|(_, cell)| is_number(cell));
            let Some((row, text)) = texts.first().filter(|_| texts.len() < numbers.len()) else { continue };
            let others = counted(numbers.len(), "cell");
            let message =
                format!("`{text}` is no number, and {others} of `{column}` are: all of it counts as texts");
            let help = "a number stands alone in its cell, written with a point";
            found.extend(sheet.wrong(Some(*row), &message, help).into_problems());
        }
    }
    found
}

impl TableFile {
    /// A column of numbers holds numbers, one of `true` and `false` truth values, any other texts; an empty cell is unknown.
    fn of(sheet: &Sheet) -> Result<Self> {
        let cells = |column: usize| sheet.rows.iter().map(move |row| row[column].trim());
        let kinds: Vec<&'static str> = (0..sheet.columns.len()).map(|column| kind(cells(column))).collect();
        let cell = |column: usize, text: &str| match (kinds[column], text.trim()) {
            (_, "") => Cell::Null,
            ("BOOLEAN", text) => Cell::Integer(i64::from(truth(text) == Some(true))),
            ("INTEGER", text) => text.parse().map_or(Cell::Null, Cell::Integer),
            ("REAL", text) => text.parse().map_or(Cell::Null, Cell::Real),
            (_, text) => Cell::Text(text.to_owned()),
        };
        let row = |row: &Vec<String>| -> Vec<Cell> {
            row.iter().enumerate().map(|(at, text)| cell(at, text)).collect()
        };
        let rows: Vec<Vec<Cell>> = sheet.rows.iter().map(row).collect();
        // numbers may be written otherwise, and be the same
        let mut seen = BTreeMap::new();
        for (at, row) in rows.iter().enumerate() {
            let key: Vec<String> = sheet.key.iter().map(|&column| row[column].to_string()).collect();
            let said = key.join("/");
            if let Some(first) = seen.insert(key, at + 2) {
                let message = format!("two rows are called {said}");
                return Err(sheet.wrong(Some(at), &message, &format!("the first is row {first}")));
            }
        }
        Ok(Self {
            path: sheet.path.clone(),
            name: sheet.name()?,
            columns: sheet.columns.iter().cloned().zip(kinds.iter().copied()).collect(),
            key: sheet.key.clone(),
            rows,
        })
    }

    /// A table that another file fills: that of a map.
    ///
    /// # Arguments
    /// `columns` are those of the key first, `key` how many these are.
    pub fn of_map(
        path: &Path,
        name: &str,
        (columns, key): (&[(&str, &'static str)], usize),
        rows: Vec<Vec<Cell>>,
    ) -> Self {
        let columns = columns.iter().map(|(name, kind)| ((*name).to_owned(), *kind)).collect();
        Self { path: path.to_owned(), name: name.to_owned(), columns, key: (0..key).collect(), rows }
    }

    /// As a class without objects: what its columns hold.
    pub fn class(&self) -> Table {
        let column = |(name, kind): &(String, &'static str)| {
            let none = match *kind {
                "BOOLEAN" => Column::Truth(Vec::new()),
                "TEXT" => Column::Text(Vec::new()),
                _ => Column::Number(Vec::new()),
            };
            (name.clone(), none)
        };
        Table { columns: self.columns.iter().map(column).collect() }
    }

    /// Fills the table the first time, or when asked; otherwise says where file and table differ.
    pub fn seed(&self, tx: &mut Tx<'_>, again: bool) -> Result<Option<String>> {
        let is_there = tx.user_tables()?.iter().any(|table| table.name.eq_ignore_ascii_case(&self.name));
        if is_there && !again {
            let kept = tx.read_table(&self.name)?;
            let file = self.path.display();
            return Ok((!self.is_same(&kept)).then(|| {
                format!(
                    "{file} differs from the table {0}; the database counts (--reseed={0} takes the file)",
                    self.name
                )
            }));
        }
        if tx.relations()?.iter().any(|known| known.name.eq_ignore_ascii_case(&self.name)) && !is_there {
            let message = format!("{}: the table {} is one of Adit's own", self.path.display(), self.name);
            return Err(Error::said(
                Code::TableTaken,
                message,
                Some("give the file another name".to_owned()),
            ));
        }
        let replaced = if is_there { Some(tx.read_table(&self.name)?) } else { None };
        let note = replaced.filter(|kept| !self.is_same(kept)).map(|kept| {
            let (file, had) =
                (self.path.display(), kept.columns.first().map_or(0, |column| column.values.len()));
            format!(
                "the table {} is as {file} has it again: {had} rows before, {} now",
                self.name,
                self.rows.len()
            )
        });
        let columns: Vec<(&str, &str)> =
            self.columns.iter().map(|(name, kind)| (name.as_str(), *kind)).collect();
        let key: Vec<&str> = self.key.iter().map(|&column| self.columns[column].0.as_str()).collect();
        tx.replace_user_table(&self.name, &columns, &key, self.rows.iter().cloned())?;
        Ok(note)
    }

    fn is_same(&self, kept: &Relation) -> bool {
        let names = kept.columns.iter().map(|column| &column.name);
        if !names.eq(self.columns.iter().map(|(name, _)| name)) {
            return false;
        }
        let count = kept.columns.first().map_or(0, |column| column.values.len());
        let row = |row: usize| {
            kept.columns.iter().map(move |column| column.values[row].to_string()).collect::<Vec<_>>()
        };
        let mut held: Vec<Vec<String>> = (0..count).map(row).collect();
        let mut read: Vec<Vec<String>> =
            self.rows.iter().map(|row| row.iter().map(ToString::to_string).collect()).collect();
        held.sort();
        read.sort();
        held == read
    }
}

/// What a column of these cells holds.
fn kind<'c>(cells: impl Iterator<Item = &'c str> + Clone) -> &'static str {
    let mut known = cells.filter(|cell| !cell.is_empty()).peekable();
    if known.peek().is_none() {
        return "TEXT";
    }
    if known.clone().all(|cell| truth(cell).is_some()) {
        "BOOLEAN"
    } else if known.clone().all(|cell| is_plain(cell) && cell.parse::<i64>().is_ok()) {
        "INTEGER"
    } else if known.all(is_number) {
        "REAL"
    } else {
        "TEXT"
    }
}

/// `true` and `false`, and as spreadsheet programs write them.
fn truth(cell: &str) -> Option<bool> {
    [("true", true), ("false", false)]
        .into_iter()
        .find_map(|(word, is)| cell.eq_ignore_ascii_case(word).then_some(is))
}

/// `007` and `+1` are names, and not numbers.
fn is_plain(cell: &str) -> bool {
    let digits = cell.strip_prefix('-').unwrap_or(cell);
    let is_padded = digits.len() > 1 && digits.starts_with('0') && !digits.starts_with("0.");
    !digits.starts_with('+') && !is_padded
}

fn is_number(cell: &str) -> bool {
    is_plain(cell) && cell.parse::<f64>().is_ok_and(f64::is_finite)
}
