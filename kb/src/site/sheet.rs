//! Tables as files: CSV, and the first sheet of an XLSX workbook. A line with the names of the columns, then a line a row.

use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};

use adit_db::Cell;
use adit_db::relation::{Relation, RelationColumn};
use calamine::{DataRef, Reader, Xlsx, XlsxError};
use miette::NamedSource;
use rust_xlsxwriter::{Format, Workbook};
use zip::ZipArchive;

use crate::error::{Code, Error, Finding, Result};
use crate::words::cells;
use crate::words::number::counted;

/// Rows that a sheet of a workbook holds, the names of the columns included.
const MOST_ROWS: usize = 1_048_576;

/// Bytes that a workbook of one's own folders holds at most, unpacked: one that is small may unpack to more than there is memory.
const MOST_UNPACKED: u64 = 2 << 30;

/// Cells of a table that is read from a workbook, those included in which nothing stands.
const MOST_CELLS: usize = 32_000_000;

/// A file of a table, as texts.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    pub path: PathBuf,
    /// The names of the columns.
    pub columns: Vec<String>,
    /// The places of the columns of the key: the first, or those whose names end in `*`.
    pub key: Vec<usize>,
    /// As many texts a row as there are columns.
    pub rows: Vec<Vec<String>>,
    lines: Lines,
}

/// Where rows stand in the file, that of the names first.
#[derive(Clone, Debug, PartialEq)]
enum Lines {
    /// The text, and where in it each begins.
    Text(String, Vec<usize>),
    /// The numbers of rows of a sheet, from 1.
    Sheet(Vec<usize>),
}

/// Whether a file is one of a table, by its name.
pub fn is_sheet(path: &Path) -> bool {
    path.extension()
        .is_some_and(|ending| ["csv", "xlsx"].iter().any(|known| ending.eq_ignore_ascii_case(known)))
}

fn is_workbook(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("xlsx"))
}

/// Whether a text may name a table or a column: rules name them.
pub fn is_name(name: &str) -> bool {
    let mut chars = name.chars();
    chars.next().is_some_and(|first| first.is_ascii_alphabetic())
        && chars.all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// What names of tables and columns are made of.
const NAMES: &str = "rules name tables and columns, so these are letters a to z, digits and _";

/// Refuses a file that no table is read from or written to.
pub fn check(path: &Path) -> Result<()> {
    if is_sheet(path) {
        return Ok(());
    }
    Err(Error::said(Code::TableFile, format!("{} is neither .csv nor .xlsx", path.display()), None))
}

impl Sheet {
    /// Reads a file.
    pub fn read(path: &Path) -> Result<Self> {
        check(path)?;
        let bytes = std::fs::read(path).map_err(|error| Error::io("read", path, &error))?;
        Self::of(path, bytes, MOST_UNPACKED)
    }

    /// What a file of this name holds.
    ///
    /// # Arguments
    /// `most` is how many bytes it may have unpacked.
    pub fn of(path: &Path, bytes: Vec<u8>, most: u64) -> Result<Self> {
        check(path)?;
        let (lines, rows) =
            if is_workbook(path) { of_workbook(path, bytes, most)? } else { of_text(path, bytes)? };
        let mut rows = rows.into_iter();
        let Some(head) = rows.next() else {
            let help = Some("the first line names the columns".to_owned());
            return Err(Error::said(Code::TableFile, format!("{}: it is empty", path.display()), help));
        };
        let mut columns: Vec<String> = head.iter().map(|name| name.trim().to_owned()).collect();
        let mut key: Vec<usize> = (0..columns.len()).filter(|&at| columns[at].ends_with('*')).collect();
        if key.is_empty() {
            key.push(0);
        }
        for name in &mut columns {
            *name = name.trim_end_matches('*').trim_end().to_owned();
        }
        let sheet = Self { path: path.to_owned(), columns, key, rows: rows.collect(), lines };
        sheet.check()?;
        Ok(sheet)
    }

    fn check(&self) -> Result<()> {
        for (place, name) in self.columns.iter().enumerate() {
            if name.is_empty() {
                let help = "the first row names all columns, and nothing stands above it or beside it";
                return Err(self.wrong(None, &format!("column {} has no name", place + 1), help));
            }
            if !is_name(name) {
                return Err(self.wrong(None, &format!("`{name}` is no name of a column"), NAMES));
            }
            if self.columns[..place].iter().any(|other| other.eq_ignore_ascii_case(name)) {
                let message = format!("two columns are called `{name}`");
                return Err(self.wrong(None, &message, "each column has a name of its own"));
            }
        }
        let mut seen = BTreeMap::new();
        for (at, row) in self.rows.iter().enumerate() {
            if row.len() != self.columns.len() {
                let (found, expected) = (row.len(), self.columns.len());
                let message =
                    format!("this row has {}, expected {expected}, one a column", counted(found, "cell"));
                return Err(self.wrong(
                    Some(at),
                    &message,
                    "a cell that holds a comma stands in double quotes",
                ));
            }
            if let Some(&column) = self.key.iter().find(|&&column| row[column].trim().is_empty()) {
                let message = format!("this row has no `{}`", self.columns[column]);
                let help = "each row says which object it is: the first column, or those marked with *";
                return Err(self.wrong(Some(at), &message, help));
            }
            let said: Vec<&str> = self.key.iter().map(|&column| row[column].trim()).collect();
            if let Some(first) = seen.insert(said.clone(), at + 2) {
                let message = format!("two rows are called {}", said.join("/"));
                let mut help = format!("the first is row {first}");
                if self.key == [0] && self.columns.len() > 1 {
                    let [one, other] = [&self.columns[0], &self.columns[1]];
                    help = format!(
                        "{help}; where several columns say which object it is, mark them: {one}*, {other}*"
                    );
                }
                return Err(self.wrong(Some(at), &message, &help));
            }
        }
        Ok(())
    }

    /// The name of the table: that of the file.
    pub fn name(&self) -> Result<String> {
        let name = self.path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        if is_name(&name) {
            return Ok(name);
        }
        Err(self.wrong(None, &format!("`{name}` is no name of a table"), NAMES))
    }

    /// What is wrong with a row, or with the names of the columns, said where it stands.
    pub fn wrong(&self, row: Option<usize>, message: &str, help: &str) -> Error {
        let (file, at) = (self.path.display().to_string(), row.map_or(0, |row| row + 1));
        match &self.lines {
            Lines::Text(text, lines) => {
                let begin = lines.get(at).copied().unwrap_or(0);
                let end = text[begin..].find('\n').map_or(text.len(), |end| begin + end);
                let said =
                    Finding::said(Code::TableFile, format!("{file}: {message}"), Some(help.to_owned()));
                Error::all([said.at(NamedSource::new(&file, text.clone()), (begin, end - begin))])
            }
            Lines::Sheet(rows) => {
                let row = rows.get(at).copied().unwrap_or(1);
                Error::said(Code::TableFile, format!("{file}, row {row}: {message}"), Some(help.to_owned()))
            }
        }
    }
}

type Parts = (Lines, Vec<Vec<String>>);

fn of_text(path: &Path, bytes: Vec<u8>) -> Result<Parts> {
    let file = path.display();
    let text = String::from_utf8(bytes).map_err(|error| {
        let message = format!("{file}: byte {} is no UTF-8", error.utf8_error().valid_up_to());
        Error::said(Code::TableFile, message, Some("save it as CSV in UTF-8".to_owned()))
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text).to_owned();
    let mut open = None;
    for (number, line) in (1..).zip(text.lines()) {
        if line.matches('"').count() % 2 == 1 {
            open = if open.is_none() { Some(number) } else { None };
        }
    }
    if let Some(line) = open {
        let help =
            "quotes come in pairs: one that belongs to a text is written twice, within quotes".to_owned();
        return Err(Error::said(
            Code::TableFile,
            format!("{file}, line {line}: a quote is not closed"),
            Some(help),
        ));
    }
    // where numbers are written with a comma, spreadsheet programs part cells by semicolons
    let head = text.lines().next().unwrap_or_default();
    let is_with_semicolons = head.contains(';') && !head.contains(',');
    let mut builder = csv::ReaderBuilder::new();
    builder.has_headers(false).flexible(true).delimiter(if is_with_semicolons { b';' } else { b',' });
    let mut reader = builder.from_reader(text.as_bytes());
    let (mut lines, mut rows) = (Vec::new(), Vec::new());
    for record in reader.records() {
        let record = record.map_err(|error| {
            let message = format!("{file}: this does not read as CSV: {error}");
            Error::said(Code::TableFile, message, Some("one row a line, cells parted by commas".to_owned()))
        })?;
        // below the rows of a sheet others may have stood
        if record.iter().all(|cell| cell.trim().is_empty()) {
            continue;
        }
        let begin = record.position().map_or(0, |position| position.byte() as usize);
        // behind a line that ends with two signs the reader stands at the second one
        let ends = text[begin..].len() - text[begin..].trim_start_matches(['\r', '\n']).len();
        lines.push(begin + ends);
        rows.push(record.iter().map(str::to_owned).collect::<Vec<String>>());
    }
    if is_with_semicolons {
        let all = || rows.iter().flatten();
        if let Some(cell) =
            all().find(|cell| is_with_thousands(cell, all().any(|other| has_decimal_comma(other))))
        {
            let message = format!("{file}: `{cell}` has a point between its thousands");
            let help =
                "write thousands without a point; numbers of this file have a comma before their decimals"
                    .to_owned();
            return Err(Error::said(Code::TableFile, message, Some(help)));
        }
        rows.iter_mut().flatten().for_each(|cell| *cell = with_point(cell));
    }
    Ok((Lines::Text(text, lines), rows))
}

/// Whether a number has points between its thousands: `1.234,5`, and `1.234` among numbers with decimal commas.
fn is_with_thousands(cell: &str, among_commas: bool) -> bool {
    let cell = cell.trim();
    let (whole, decimals) = cell.split_once(',').map_or((cell, None), |(whole, part)| (whole, Some(part)));
    let is_digits = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
    let mut groups = whole.strip_prefix('-').unwrap_or(whole).split('.');
    let first = groups.next().unwrap_or_default();
    let groups: Vec<&str> = groups.collect();
    (1..=3).contains(&first.len())
        && is_digits(first)
        && !groups.is_empty()
        && groups.iter().all(|group| group.len() == 3 && is_digits(group))
        && decimals.map_or(among_commas || groups.len() > 1, |part| !part.is_empty() && is_digits(part))
}

/// A number that is written with a comma, with a point.
fn with_point(cell: &str) -> String {
    if has_decimal_comma(cell) { cell.replacen(',', ".", 1) } else { cell.to_owned() }
}

/// Whether a cell is a number but for a comma in place of the point.
pub fn has_decimal_comma(cell: &str) -> bool {
    let cell = cell.trim();
    let is_digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    cell.strip_prefix('-')
        .unwrap_or(cell)
        .split_once(',')
        .is_some_and(|(whole, part)| is_digits(whole) && is_digits(part))
}

fn of_workbook(path: &Path, bytes: Vec<u8>, most: u64) -> Result<Parts> {
    let file = path.display();
    let wrong = |message: String| Error::said(Code::TableFile, message, None);
    let too_much = || {
        let message = format!("{file} unpacks to more than {} MB", most >> 20);
        Error::said(Code::TableFile, message, Some("save it as .csv".to_owned()))
    };
    if unpacks_to_more(&bytes, most) {
        return Err(too_much());
    }
    let mut book: Xlsx<_> = Xlsx::new(Cursor::new(bytes)).map_err(|error| match error {
        XlsxError::Zip(_) => {
            let help = "save it as .xlsx in a spreadsheet program, or give a file of CSV the ending .csv";
            Error::said(Code::TableFile, format!("{file} is no workbook"), Some(help.to_owned()))
        }
        error => wrong(format!("{file} is no workbook: {error}")),
    })?;
    let name = book.sheet_names().first().cloned().ok_or_else(|| wrong(format!("{file} has no sheet")))?;
    let unread = |error: XlsxError| wrong(format!("{file}: its first sheet cannot be read: {error}"));
    // cell by cell: one that stands far off takes no more room than any other
    let mut found: BTreeMap<(u32, u32), String> = BTreeMap::new();
    let mut left = most;
    let mut cells = book.worksheet_cells_reader(&name).map_err(unread)?;
    while let Some(cell) = cells.next_cell().map_err(unread)? {
        let (row, column) = cell.get_position();
        let called = || format!("{}{}", letters(column), row + 1);
        let text = match cell.get_value() {
            DataRef::Empty => continue,
            DataRef::Error(error) => return Err(wrong(format!("{file}: cell {} is {error}", called()))),
            DataRef::Bool(truth) => truth.to_string(),
            DataRef::Int(number) => number.to_string(),
            DataRef::Float(number) => number.to_string(),
            DataRef::String(text) => text.clone(),
            DataRef::SharedString(text) => (*text).to_owned(),
            DataRef::DateTime(_) | DataRef::DateTimeIso(_) | DataRef::DurationIso(_) => {
                let message = format!("{file}: cell {} is a date, expected a number or a text", called());
                return Err(wrong(message));
            }
        };
        if !text.trim().is_empty() {
            // many cells may share one text
            left = left.checked_sub(text.len() as u64).ok_or_else(too_much)?;
            found.insert((row, column), text);
        }
    }
    drop(cells);
    let mut formulas = book.worksheet_cells_reader(&name).map_err(unread)?;
    while let Some(cell) = formulas.next_formula().map_err(unread)? {
        let (row, column) = cell.get_position();
        if !cell.get_value().is_empty() && !found.contains_key(&(row, column)) {
            let message = format!("{file}: cell {}{} is a formula without a value", letters(column), row + 1);
            let help = "open it in a spreadsheet program and save it, which works the values out".to_owned();
            return Err(Error::said(Code::TableFile, message, Some(help)));
        }
    }
    drop(formulas);
    // the names of the columns are in the first row that has anything; what stands beside them is none of the table's
    let Some((&(head, first), _)) = found.first_key_value() else {
        return Ok((Lines::Sheet(Vec::new()), Vec::new()));
    };
    let last =
        found.range((head, 0)..=(head, u32::MAX)).next_back().map_or(first, |((_, column), _)| *column);
    if let Some(gap) = (first..=last).find(|column| !found.contains_key(&(head, *column))) {
        return Err(wrong(format!("{file}: column {} has no name", letters(gap))));
    }
    let width = (last - first + 1) as usize;
    let mut cells = 0;
    let (mut numbers, mut rows): (Vec<usize>, Vec<Vec<String>>) = (Vec::new(), Vec::new());
    for ((row, column), text) in found {
        if !(first..=last).contains(&column) {
            let cell = format!("{}{}", letters(column), row + 1);
            return Err(wrong(format!("{file}: cell {cell} stands in a column without a name")));
        }
        if numbers.last() != Some(&(row as usize + 1)) {
            cells += width;
            if cells > MOST_CELLS {
                return Err(too_much());
            }
            numbers.push(row as usize + 1);
            rows.push(vec![String::new(); width]);
        }
        if let Some(cells) = rows.last_mut() {
            cells[(column - first) as usize] = text;
        }
    }
    Ok((Lines::Sheet(numbers), rows))
}

/// Whether what is packed has more bytes, whatever it says of itself. What is no archive says so to whoever reads it.
fn unpacks_to_more(bytes: &[u8], most: u64) -> bool {
    let Ok(mut archive) = ZipArchive::new(Cursor::new(bytes)) else { return false };
    let (mut all, mut buffer) = (0, vec![0; 1 << 16]);
    for number in 0..archive.len() {
        // what cannot be opened here nobody else opens either
        let Ok(mut packed) = archive.by_index(number) else { continue };
        let (mut own, mut begins) = (0, Vec::new());
        while let Ok(count) = packed.read(&mut buffer)
            && count > 0
        {
            own += count as u64;
            if all + own > most {
                return true;
            }
            begins.extend_from_slice(&buffer[..count.min(BEGINNING - begins.len().min(BEGINNING))]);
        }
        // room is made for so many texts as it says that there are
        if said_to_be(&begins).is_some_and(|texts| texts > own) {
            return true;
        }
        all += own;
    }
    false
}

/// So far into a part of a workbook its root says what it holds, bytes.
const BEGINNING: usize = 4096;

/// How many texts a part of a workbook says that it has.
fn said_to_be(begins: &[u8]) -> Option<u64> {
    let text = String::from_utf8_lossy(begins);
    let (_, after) = text.split_once("uniqueCount=")?;
    let digits: String = after.chars().skip(1).take_while(char::is_ascii_digit).collect();
    Some(digits.parse().unwrap_or(u64::MAX))
}

/// The name of a column of a sheet: A, B, ... AA.
fn letters(column: u32) -> String {
    let last = char::from(b'A' + (column % 26) as u8).to_string();
    if column < 26 { last } else { format!("{}{last}", letters(column / 26 - 1)) }
}

/// A table as a file of the format that the name asks for; columns that hold bytes are left out.
pub fn written(path: &Path, table: &Relation) -> Result<Vec<u8>> {
    let table = &without_bytes(table);
    let rows = table.columns.first().map_or(0, |column| column.values.len());
    if is_workbook(path) { workbook(path, table, rows) } else { Ok(text(table)?.into_bytes()) }
}

fn without_bytes(table: &Relation) -> Relation {
    let holds_bytes =
        |column: &RelationColumn| column.values.iter().any(|cell| matches!(cell, Cell::Blob(_)));
    let columns = table.columns.iter().filter(|column| !holds_bytes(column)).cloned().collect();
    Relation { name: table.name.clone(), columns }
}

/// The names of the columns: those of the key marked, where it is not the first one alone.
fn heads(table: &Relation) -> Vec<String> {
    let keys: Vec<bool> = table.columns.iter().map(|column| column.key > 0).collect();
    let is_first_alone =
        keys.iter().position(|key| *key) == Some(0) && keys.iter().filter(|key| **key).count() == 1;
    let head = |(column, key): (&RelationColumn, &bool)| {
        if *key && !is_first_alone { format!("{}*", column.name) } else { column.name.clone() }
    };
    table.columns.iter().zip(&keys).map(head).collect()
}

/// As CSV; columns that hold bytes are left out.
pub fn text(table: &Relation) -> Result<String> {
    let table = &without_bytes(table);
    let rows = table.columns.first().map_or(0, |column| column.values.len());
    let mut writer = csv::Writer::from_writer(Vec::new());
    let failed = |error: csv::Error| Error::said(Code::TableFile, error.to_string(), None);
    writer.write_record(heads(table)).map_err(failed)?;
    for row in 0..rows {
        let cells = table.columns.iter().map(|column| match truth(column, row) {
            Some(truth) => truth.to_string(),
            None => cells::text(&column.values[row]),
        });
        writer.write_record(cells).map_err(failed)?;
    }
    let bytes = writer.into_inner().map_err(|error| Error::said(Code::TableFile, error.to_string(), None))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// The truth value of a cell, where the column holds such.
fn truth(column: &RelationColumn, row: usize) -> Option<bool> {
    match column.values[row] {
        Cell::Integer(truth) if column.declared.contains("BOOL") => Some(truth != 0),
        _ => None,
    }
}

fn workbook(path: &Path, table: &Relation, rows: usize) -> Result<Vec<u8>> {
    if rows >= MOST_ROWS {
        let message = format!("{} has {rows} rows, and a sheet of a workbook holds {MOST_ROWS}", table.name);
        let help = format!("write it as {}", path.with_extension("csv").display());
        return Err(Error::said(Code::TableFile, message, Some(help)));
    }
    let failed = |error: rust_xlsxwriter::XlsxError| {
        Error::said(Code::TableFile, format!("{}: {error}", path.display()), None)
    };
    let mut book = Workbook::new();
    let sheet = book.add_worksheet();
    let bold = Format::new().set_bold();
    for (column, head) in (0..).zip(heads(table)) {
        sheet.write_string_with_format(0, column, head, &bold).map_err(failed)?;
    }
    for (column, of) in (0..).zip(&table.columns) {
        for (row, cell) in (1..).zip(&of.values) {
            match (truth(of, row as usize - 1), cell) {
                (Some(truth), _) => sheet.write_boolean(row, column, truth),
                (None, Cell::Null) => continue,
                (None, Cell::Integer(number)) => sheet.write_number(row, column, *number as f64),
                (None, Cell::Real(number)) => sheet.write_number(row, column, *number),
                (None, other) => sheet.write_string(row, column, other.to_string()),
            }
            .map_err(failed)?;
        }
    }
    sheet.set_freeze_panes(1, 0).map_err(failed)?;
    sheet.autofit();
    book.save_to_buffer().map_err(failed)
}
