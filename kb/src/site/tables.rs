//! Tables of the site's own as files: `tables/NAME.csv` seeds the table NAME once; from then on the database is what counts.

use std::path::{Path, PathBuf};

use adit_db::relation::Relation;
use adit_db::{Cell, Tx};
use miette::NamedSource;

use crate::error::{Code, Error, Finding, Result};

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

/// The files of tables in a site's folder of tables, by name.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let is_table = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "csv");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(is_table).collect();
    files.sort();
    files
}

/// Reads all of them.
pub fn read(folder: &Path) -> Result<Vec<TableFile>> {
    files(folder).iter().map(|path| TableFile::read(path)).collect()
}

impl TableFile {
    /// Reads a file: a line with the names of the columns, then a line a row. The key is the first column, or those whose
    /// names end in `*`. A column of numbers holds numbers, one of `true` and `false` truth values, any other texts; an
    /// empty cell is unknown.
    pub fn read(path: &Path) -> Result<Self> {
        let text = std::fs::read_to_string(path).map_err(|error| Error::io("read", path, &error))?;
        Self::parse(path, text.strip_prefix('\u{feff}').unwrap_or(&text))
    }

    fn parse(path: &Path, text: &str) -> Result<Self> {
        let file = path.display().to_string();
        let wrong = |at: usize, message: String, help: &str| {
            let end = text[at..].find('\n').map_or(text.len(), |end| at + end);
            let source = NamedSource::new(&file, text.to_owned());
            let finding = Finding::said(Code::TableFile, format!("{file}: {message}"), Some(help.to_owned()));
            Error::all([finding.at(source, (at, end - at))])
        };
        let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let is_name = |name: &str| {
            let mut chars = name.chars();
            chars.next().is_some_and(|first| first.is_ascii_alphabetic())
                && chars.all(|c| c.is_ascii_alphanumeric() || c == '_')
        };
        let help = "rules name tables and columns, so these are letters a to z, digits and _";
        if !is_name(&name) {
            return Err(wrong(0, format!("`{name}` is no name of a table"), help));
        }
        let mut reader =
            csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
        let mut lines = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|error| {
                let at = error.position().map_or(0, |position| position.byte() as usize);
                wrong(
                    at.min(text.len()),
                    "this line does not read as CSV".to_owned(),
                    "one row a line, cells parted by commas",
                )
            })?;
            let at = record.position().map_or(0, |position| position.byte() as usize);
            lines.push((at, record));
        }
        let Some(((at, head), rows)) = lines.split_first() else {
            return Err(wrong(0, "it is empty".to_owned(), "the first line names the columns"));
        };
        let mut names: Vec<String> = head.iter().map(|name| name.trim().to_owned()).collect();
        let mut key: Vec<usize> = (0..names.len()).filter(|&column| names[column].ends_with('*')).collect();
        if key.is_empty() {
            key.push(0);
        }
        for name in &mut names {
            *name = name.trim_end_matches('*').trim_end().to_owned();
        }
        for (place, name) in names.iter().enumerate() {
            if !is_name(name) {
                return Err(wrong(*at, format!("`{name}` is no name of a column"), help));
            }
            if names[..place].iter().any(|other| other.eq_ignore_ascii_case(name)) {
                return Err(wrong(
                    *at,
                    format!("two columns are called `{name}`"),
                    "each column has a name of its own",
                ));
            }
        }
        for (at, row) in rows {
            if row.len() != names.len() {
                let message =
                    format!("this row has {} cells, and there are {} columns", row.len(), names.len());
                return Err(wrong(*at, message, "a cell that holds a comma stands in double quotes"));
            }
            if let Some(&column) = key.iter().find(|&&column| row[column].trim().is_empty()) {
                let message = format!("this row has no `{}`", names[column]);
                return Err(wrong(
                    *at,
                    message,
                    "each row says which object it is: the first column, or those marked with *",
                ));
            }
        }
        let cells = |column: usize| rows.iter().map(move |(_, row)| row[column].trim());
        let kinds: Vec<&'static str> = (0..names.len()).map(|column| kind(cells(column))).collect();
        let cell = |column: usize, text: &str| match (kinds[column], text.trim()) {
            (_, "") => Cell::Null,
            ("BOOLEAN", text) => Cell::Integer(i64::from(text == "true")),
            ("INTEGER", text) => text.parse().map_or(Cell::Null, Cell::Integer),
            ("REAL", text) => text.parse().map_or(Cell::Null, Cell::Real),
            (_, text) => Cell::Text(text.to_owned()),
        };
        let read: Vec<Vec<Cell>> = rows
            .iter()
            .map(|(_, row)| row.iter().enumerate().map(|(at, text)| cell(at, text)).collect())
            .collect();
        let mut seen = std::collections::BTreeMap::new();
        for ((at, row), number) in rows.iter().zip(2..) {
            let said = key.iter().map(|&column| row[column].trim().to_owned()).collect::<Vec<_>>();
            if let Some(first) = seen.insert(said.clone(), number) {
                let message = format!("two rows are called {}", said.join("/"));
                return Err(wrong(*at, message, &format!("the first is row {first}")));
            }
        }
        let columns = names.into_iter().zip(kinds).collect();
        Ok(Self { path: path.to_owned(), name, columns, key, rows: read })
    }

    /// Fills the table the first time, or when asked; otherwise says where file and table differ.
    pub fn seed(&self, tx: &mut Tx<'_>, again: bool) -> Result<Option<String>> {
        let is_there = tx.user_tables()?.iter().any(|table| table.name.eq_ignore_ascii_case(&self.name));
        if is_there && !again {
            let kept = tx.read_table(&self.name)?;
            let file = self.path.display();
            return Ok((!self.is_same(&kept)).then(|| {
                format!(
                    "{file} differs from the table {}; the database counts (--reseed takes the file)",
                    self.name
                )
            }));
        }
        if tx.relations()?.iter().any(|known| known.name.eq_ignore_ascii_case(&self.name)) && !is_there {
            let message = format!("{}: the table {} is one of Adit's own", self.path.display(), self.name);
            return Err(Error::said(Code::TableTaken, message, Some("call the file otherwise".to_owned())));
        }
        let columns: Vec<(&str, &str)> =
            self.columns.iter().map(|(name, kind)| (name.as_str(), *kind)).collect();
        let key: Vec<&str> = self.key.iter().map(|&column| self.columns[column].0.as_str()).collect();
        tx.replace_user_table(&self.name, &columns, &key, self.rows.iter().cloned())?;
        Ok(None)
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
    let is_number = |cell: &str| cell.parse::<f64>().is_ok_and(f64::is_finite);
    if known.clone().all(|cell| cell == "true" || cell == "false") {
        "BOOLEAN"
    } else if known.clone().all(|cell| cell.parse::<i64>().is_ok()) {
        "INTEGER"
    } else if known.all(is_number) {
        "REAL"
    } else {
        "TEXT"
    }
}
