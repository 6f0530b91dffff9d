//! Rows of a site into PostgreSQL and out of it; whole sites copied either way.

use std::path::Path;

use futures_util::TryStreamExt;
use sqlx::postgres::{PgArguments, PgRow};
use sqlx::{Arguments, AssertSqlSafe, PgConnection, Row, SqliteConnection};

use super::capture;
use super::changes::{self, Changes, File, Object, Rows};
use super::link::{Link, is_locked};
use super::place::Place;
use super::schema;
use super::tables::{Kind, Table, Template};
use crate::cell::Cell;
use crate::connection::{self, Connection};
use crate::dynamic::identifier;
use crate::error::{Error, Result};
use crate::failure::Failure;
use crate::worlds;

/// The schema of PostgreSQL in which all of it is.
pub(super) const SCHEMA: &str = "adit";

/// Rows that one statement takes.
const ROWS: usize = 5_000;

/// The names of the sites in a database.
pub fn sites(place: &Place) -> Result<Vec<String>> {
    let mut link = Link::new(place)?;
    schema::check(&mut link)?;
    link.again(names)
}

async fn names(connection: &mut PgConnection) -> Result<Vec<String>> {
    Ok(sqlx::query_scalar("SELECT site FROM adit.sites ORDER BY site").fetch_all(connection).await?)
}

/// What is said of a site that is not there.
pub(super) fn unknown(link: &mut Link, site: &str) -> Error {
    match link.again(names) {
        Ok(names) => {
            let sites = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            Failure::UnknownSite { place: link.place().shown(), site: site.to_owned(), sites }.into()
        }
        Err(error) => error,
    }
}

/// All that a database holds of a site, on its way into PostgreSQL.
pub(crate) struct Leaving {
    pub(super) template: Template,
    pub(super) changes: Changes,
    pub(super) generation: i64,
}

impl Leaving {
    /// Reads it.
    pub(crate) async fn read(connection: &mut SqliteConnection) -> Result<Self> {
        let template = Template::new(worlds::are_kept(connection).await?).await?;
        let changes = capture::everything(connection, &template).await?;
        let generation = crate::site::value(connection, "generation").await?;
        Ok(Self { template, changes, generation: generation.and_then(|text| text.parse().ok()).unwrap_or(0) })
    }
}

/// Puts a site into PostgreSQL: all that is in its database, and its files.
pub(crate) fn copy_in(
    leaving: Leaving,
    files: &[File],
    (place, site): (&Place, &str),
    replace: bool,
) -> Result<()> {
    let Leaving { template, mut changes, generation } = leaving;
    let mut link = Link::new(place)?;
    let all = link.apart(async { Template::new(true).await })?;
    schema::make(&mut link, &all)?;
    changes.files = files.to_vec();
    let exists = Failure::SiteExists { place: place.shown(), site: site.to_owned() };
    let tables: Vec<Table> = all.tables.values().cloned().collect();
    link.whole(true);
    let put = link.again(async |connection| {
        sqlx::raw_sql("BEGIN").execute(&mut *connection).await?;
        let sql = "SELECT entry FROM adit.sites WHERE site = $1 FOR UPDATE";
        let there: Option<i64> =
            match sqlx::query_scalar(sql).bind(site).fetch_optional(&mut *connection).await {
                Err(error) if is_locked(&error) => return Err(Failure::Held(site.to_owned()).into()),
                there => there?,
            };
        if there.is_some() && !replace {
            sqlx::raw_sql("ROLLBACK").execute(&mut *connection).await?;
            return Ok(false);
        }
        for table in tables.iter().filter(|table| table.ours) {
            clear(connection, &table.name, site).await?;
        }
        for table in ["own_rows", "files", "log"] {
            clear(connection, table, site).await?;
        }
        let head = Head { entry: there.unwrap_or(0) + 1, fence: 0, generation };
        put_whole(connection, site, &template, &changes, head).await?;
        sqlx::raw_sql("COMMIT").execute(&mut *connection).await?;
        Ok(true)
    })?;
    if put { Ok(()) } else { Err(exists.into()) }
}

/// Where a site is: the newest entry of its log, the number of its owner at least, and its generation.
pub(super) struct Head {
    pub entry: i64,
    pub fence: i64,
    pub generation: i64,
}

/// Writes all of a site, of which no row is there, and that it was replaced.
pub(super) async fn put_whole(
    connection: &mut PgConnection,
    site: &str,
    template: &Template,
    changes: &Changes,
    Head { entry, fence, generation }: Head,
) -> Result<()> {
    write(connection, site, template, changes).await?;
    let sql = "INSERT INTO adit.sites (site, entry, generation, worlds, fence) VALUES ($1, $2, $3, $4, $5)
               ON CONFLICT (site) DO UPDATE SET entry = excluded.entry, generation = excluded.generation,
               worlds = excluded.worlds, owner = NULL, until = NULL, fence = adit.sites.fence + 1";
    let row = sqlx::query(sql).bind(site).bind(entry).bind(generation).bind(template.keeps_worlds());
    row.bind(fence).execute(&mut *connection).await?;
    let sql = "INSERT INTO adit.log (site, entry, generation, owner, fence, changes) VALUES ($1, $2, $3, '', 0, NULL)";
    sqlx::query(sql).bind(site).bind(entry).bind(generation).execute(connection).await?;
    Ok(())
}

/// Makes a database of a site that is in PostgreSQL.
///
/// # Arguments
/// `file` must not exist.
///
/// # Returns
/// The site's files.
pub fn copy_out(place: &Place, site: &str, file: &Path) -> Result<Vec<File>> {
    let mut link = Link::new(place)?;
    let (template, whole) = snapshot(&mut link, site)?;
    whole.make(&template, file)?;
    Ok(whole.changes.files)
}

/// A whole site, as it was at one entry of its log.
pub(super) struct Whole {
    pub entry: i64,
    pub changes: Changes,
}

impl Whole {
    /// Makes a database of it, of the template's version.
    pub(super) fn make(&self, template: &Template, file: &Path) -> Result<()> {
        let options = connection::options(file, std::time::Duration::from_secs(5))?.create_if_missing(true);
        let mut connection = Connection::open(file, &options)?;
        connection.run(async |connection| template.make(connection, file).await)?;
        connection.execute("BEGIN IMMEDIATE")?;
        connection
            .run(async |connection| capture::fill(connection, template.clone(), &self.changes).await)?;
        connection.execute("COMMIT")
    }
}

/// Reads a whole site, all of it at one moment.
pub(super) fn snapshot(link: &mut Link, site: &str) -> Result<(Template, Whole)> {
    schema::check(link)?;
    link.whole(true);
    let read = link.again(async |connection| {
        sqlx::raw_sql("BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY").execute(&mut *connection).await?;
        let sql = "SELECT entry, worlds FROM adit.sites WHERE site = $1";
        let head: Option<(i64, bool)> =
            sqlx::query_as(sql).bind(site).fetch_optional(&mut *connection).await?;
        let read = match head {
            Some((entry, worlds)) => {
                let template = Template::new(worlds).await?;
                let changes = read(connection, SCHEMA, site, &template).await?;
                Some((template, Whole { entry, changes }))
            }
            None => None,
        };
        sqlx::raw_sql("COMMIT").execute(&mut *connection).await?;
        Ok(read)
    });
    link.whole(false);
    read?.ok_or_else(|| unknown(link, site))
}

/// Writes what was changed to the rows of the site.
pub(super) async fn write(
    connection: &mut PgConnection,
    site: &str,
    template: &Template,
    changes: &Changes,
) -> Result<()> {
    for (name, rows) in &changes.tables {
        match template.tables.get(name).filter(|table| table.ours) {
            Some(table) => {
                if rows.whole {
                    clear(connection, name, site).await?;
                }
                remove(connection, site, table, &rows.gone).await?;
                put(connection, site, table, &rows.now).await?;
            }
            None => put_own(connection, site, name, rows).await?,
        }
    }
    if let Some(objects) = &changes.objects {
        clear(connection, "own_objects", site).await?;
        for Object { kind, name, table, sql } in objects {
            let text = "INSERT INTO adit.own_objects VALUES ($1, $2, $3, $4, $5)";
            let query = sqlx::query(text).bind(site).bind(kind).bind(name).bind(table).bind(sql);
            query.execute(&mut *connection).await?;
        }
        let tables: Vec<&str> =
            objects.iter().filter(|of| of.kind == "table").map(|of| of.name.as_str()).collect();
        let sql = "DELETE FROM adit.own_rows WHERE site = $1 AND NOT table_name = ANY ($2)
                   AND table_name NOT LIKE 'gpkg%'";
        sqlx::query(sql).bind(site).bind(tables).execute(&mut *connection).await?;
    }
    if let Some(sequences) = &changes.sequences {
        clear(connection, "sequences", site).await?;
        for (name, last) in sequences {
            let sql = "INSERT INTO adit.sequences VALUES ($1, $2, $3)";
            sqlx::query(sql).bind(site).bind(name).bind(last).execute(&mut *connection).await?;
        }
    }
    for file in &changes.files {
        let sql = match file.bytes {
            Some(_) => {
                "INSERT INTO adit.files VALUES ($1, $2, $3) ON CONFLICT (site, path) DO UPDATE SET bytes = excluded.bytes"
            }
            None => "DELETE FROM adit.files WHERE site = $1 AND path = $2 AND $3::bytea IS NULL",
        };
        sqlx::query(sql).bind(site).bind(&file.path).bind(&file.bytes).execute(&mut *connection).await?;
    }
    Ok(())
}

async fn clear(connection: &mut PgConnection, table: &str, site: &str) -> Result<()> {
    let sql = format!("DELETE FROM adit.{} WHERE site = $1", identifier(table));
    sqlx::query(AssertSqlSafe(sql)).bind(site).execute(connection).await?;
    Ok(())
}

async fn remove(connection: &mut PgConnection, site: &str, table: &Table, keys: &[Vec<Cell>]) -> Result<()> {
    let key: Vec<&str> = table.key.iter().map(String::as_str).collect();
    for some in keys.chunks(ROWS) {
        let sql = format!(
            "DELETE FROM adit.{} WHERE site = $1 AND ({}) IN (SELECT * FROM {})",
            identifier(&table.name),
            Table::list("", key.iter().copied()),
            unnested(table, &key)
        );
        let arguments = bound(site, table, &key, some)?;
        sqlx::query_with(AssertSqlSafe(sql), arguments).execute(&mut *connection).await?;
    }
    Ok(())
}

async fn put(connection: &mut PgConnection, site: &str, table: &Table, rows: &[Vec<Cell>]) -> Result<()> {
    let columns = table.read();
    let set: Vec<String> = columns
        .iter()
        .filter(|name| !table.key.iter().any(|key| key == *name))
        .map(|name| format!("{0} = excluded.{0}", identifier(name)))
        .collect();
    let then = if set.is_empty() { "NOTHING".to_owned() } else { format!("UPDATE SET {}", set.join(", ")) };
    for some in rows.chunks(ROWS) {
        let sql = format!(
            "INSERT INTO adit.{} (site, {}) SELECT $1, * FROM {} ON CONFLICT (site, {}) DO {then}",
            identifier(&table.name),
            Table::list("", columns.iter().copied()),
            unnested(table, &columns),
            Table::list("", table.key.iter().map(String::as_str)),
        );
        let arguments = bound(site, table, &columns, some)?;
        sqlx::query_with(AssertSqlSafe(sql), arguments).execute(&mut *connection).await?;
    }
    Ok(())
}

/// Lists of values, one a column, as rows.
fn unnested(table: &Table, columns: &[&str]) -> String {
    let lists: Vec<String> =
        (2..).zip(columns).map(|(at, name)| format!("${at}::{}[]", table.kind(name).declared())).collect();
    format!("unnest({})", lists.join(", "))
}

fn bound(site: &str, table: &Table, columns: &[&str], rows: &[Vec<Cell>]) -> Result<PgArguments> {
    let mut arguments = PgArguments::default();
    let refused = |error| Error::Sql(sqlx::Error::Encode(error));
    arguments.add(site).map_err(refused)?;
    for (at, name) in columns.iter().enumerate() {
        let cells = rows.iter().map(|row| row.get(at).unwrap_or(&Cell::Null));
        let added = match table.kind(name) {
            Kind::Integer => arguments.add(cells.map(whole).collect::<Vec<_>>()),
            Kind::Real => arguments.add(cells.map(real).collect::<Vec<_>>()),
            Kind::Text => arguments.add(cells.map(text).collect::<Vec<_>>()),
            Kind::Any => arguments.add(cells.map(any).collect::<Vec<_>>()),
            Kind::Blob => arguments.add(cells.map(blob).collect::<Vec<_>>()),
        };
        added.map_err(refused)?;
    }
    Ok(arguments)
}

fn whole(cell: &Cell) -> Option<i64> {
    if let Cell::Integer(value) = cell { Some(*value) } else { None }
}

fn real(cell: &Cell) -> Option<f64> {
    if let Cell::Real(value) = cell { Some(*value) } else { None }
}

fn text(cell: &Cell) -> Option<&str> {
    if let Cell::Text(value) = cell { Some(value) } else { None }
}

fn any(cell: &Cell) -> Option<String> {
    (*cell != Cell::Null).then(|| changes::value(cell).to_string())
}

fn blob(cell: &Cell) -> Option<&[u8]> {
    if let Cell::Blob(value) = cell { Some(value) } else { None }
}

/// The rows of somebody's own table, known by their key as JSON.
async fn put_own(connection: &mut PgConnection, site: &str, table: &str, rows: &Rows) -> Result<()> {
    if rows.whole {
        let sql = "DELETE FROM adit.own_rows WHERE site = $1 AND table_name = $2";
        sqlx::query(sql).bind(site).bind(table).execute(&mut *connection).await?;
    }
    for some in rows.gone.chunks(ROWS) {
        let keys: Vec<String> = some.iter().map(|key| changes::line(key).to_string()).collect();
        let sql = "DELETE FROM adit.own_rows WHERE site = $1 AND table_name = $2 AND key = ANY ($3)";
        sqlx::query(sql).bind(site).bind(table).bind(keys).execute(&mut *connection).await?;
    }
    for some in rows.now.chunks(ROWS) {
        let keys: Vec<String> =
            some.iter().map(|row| changes::line(&row[..rows.key.min(row.len())]).to_string()).collect();
        let lines: Vec<String> = some.iter().map(|row| changes::line(row).to_string()).collect();
        let sql = "INSERT INTO adit.own_rows SELECT $1, $2, * FROM unnest($3::text[], $4::text[])
                   ON CONFLICT (site, table_name, key) DO UPDATE SET row = excluded.row";
        sqlx::query(sql).bind(site).bind(table).bind(keys).bind(lines).execute(&mut *connection).await?;
    }
    Ok(())
}

/// Reads the rows of a site in a schema of PostgreSQL.
pub(super) async fn read(
    connection: &mut PgConnection,
    schema: &str,
    site: &str,
    template: &Template,
) -> Result<Changes> {
    let mut changes = Changes::default();
    for (name, table) in template.tables.iter().filter(|(_, table)| table.ours) {
        let columns = table.read();
        let sql = format!(
            "SELECT {} FROM {schema}.{} WHERE site = $1 ORDER BY {}",
            Table::list("", columns.iter().copied()),
            identifier(name),
            Table::list("", table.key.iter().map(String::as_str))
        );
        let mut rows = sqlx::query(AssertSqlSafe(sql)).bind(site).fetch(&mut *connection);
        let mut now = Vec::new();
        while let Some(row) = rows.try_next().await? {
            let cells = columns.iter().enumerate().map(|(at, name)| cell(&row, at, table.kind(name)));
            now.push(cells.collect::<Result<Vec<_>>>()?);
        }
        changes.tables.insert(name.clone(), Rows { whole: true, now, ..Rows::default() });
    }
    let whole_of = |columns: &str, table: &str| {
        AssertSqlSafe(format!("SELECT {columns} FROM {schema}.{table} WHERE site = $1 ORDER BY 1"))
    };
    let sql = whole_of("table_name, row", "own_rows");
    let own: Vec<(String, String)> = sqlx::query_as(sql).bind(site).fetch_all(&mut *connection).await?;
    let sql = whole_of("kind, name, of_table, sql", "own_objects");
    let objects: Vec<(String, String, String, String)> =
        sqlx::query_as(sql).bind(site).fetch_all(&mut *connection).await?;
    let mut objects: Vec<Object> =
        objects.into_iter().map(|(kind, name, table, sql)| Object { kind, name, table, sql }).collect();
    Template::order(&mut objects);
    let whole = || Rows { whole: true, ..Rows::default() };
    let theirs = template.tables.values().filter(|table| !table.ours).map(|table| &table.name);
    for name in
        objects.iter().filter(|object| object.kind == "table").map(|object| &object.name).chain(theirs)
    {
        changes.tables.insert(name.clone(), whole());
    }
    for (table, row) in own {
        let row = serde_json::from_str(&row).ok().as_ref().and_then(changes::cells);
        let row = row.ok_or_else(|| Failure::Sql(format!("a row of {table} cannot be read")))?;
        changes.tables.entry(table).or_insert_with(whole).now.push(row);
    }
    changes.objects = Some(objects);
    let sql = whole_of("name, last", "sequences");
    changes.sequences = Some(sqlx::query_as(sql).bind(site).fetch_all(&mut *connection).await?);
    let sql = whole_of("path, bytes", "files");
    let files: Vec<(String, Vec<u8>)> = sqlx::query_as(sql).bind(site).fetch_all(connection).await?;
    changes.files = files.into_iter().map(|(path, bytes)| File { path, bytes: Some(bytes) }).collect();
    Ok(changes)
}

fn cell(row: &PgRow, at: usize, kind: Kind) -> Result<Cell> {
    Ok(match kind {
        Kind::Integer => row.try_get::<Option<i64>, _>(at)?.map_or(Cell::Null, Cell::Integer),
        Kind::Real => row.try_get::<Option<f64>, _>(at)?.map_or(Cell::Null, Cell::Real),
        Kind::Text => row.try_get::<Option<String>, _>(at)?.map_or(Cell::Null, Cell::Text),
        Kind::Blob => row.try_get::<Option<Vec<u8>>, _>(at)?.map_or(Cell::Null, Cell::Blob),
        Kind::Any => match row.try_get::<Option<String>, _>(at)? {
            None => Cell::Null,
            Some(text) => serde_json::from_str(&text)
                .ok()
                .as_ref()
                .and_then(changes::cell)
                .ok_or_else(|| Failure::Sql("a value cannot be read".to_owned()))?,
        },
    })
}
