//! The tables and views in PostgreSQL: derived from those of SQLite, and made where they are missing.

use sqlx::{AssertSqlSafe, PgConnection};

use super::link::Link;
use super::tables::{Table, Template};
use crate::dynamic::identifier;
use crate::error::{Error, Result};
use crate::failure::Failure;
use crate::migrate::VERSION;

const SHARED: &str = include_str!("../../sql/postgres/10-shared.sql");
const VIEWS: &str = include_str!("../../sql/postgres/20-views.sql");

/// The version of the tables; `None` where there are none.
pub(super) async fn version(connection: &mut PgConnection) -> Result<Option<i64>> {
    // who has no right to it is to be told so: the information schema would leave it out
    let sql = "SELECT count(*) FROM pg_catalog.pg_tables WHERE schemaname = 'adit' AND tablename = 'version'";
    let tables: i64 = sqlx::query_scalar(sql).fetch_one(&mut *connection).await?;
    if tables == 0 {
        return Ok(None);
    }
    Ok(sqlx::query_scalar("SELECT version FROM adit.version WHERE one = 1")
        .fetch_optional(connection)
        .await?)
}

/// Refuses tables of another version, and a database without any.
pub(super) fn check(link: &mut Link) -> Result<()> {
    let place = link.place().shown();
    match link.again(version)? {
        Some(VERSION) => Ok(()),
        Some(found) => Err(Failure::Version { place, found, known: VERSION }.into()),
        None => Err(Failure::NoSites(place).into()),
    }
}

/// Makes the tables and views where there are none.
pub(super) fn make(link: &mut Link, template: &Template) -> Result<()> {
    match check(link) {
        Err(Error::Postgres(Failure::NoSites(_))) => {}
        checked => return checked,
    }
    let script = script(template);
    let made = link.again(async |connection| {
        let whole = format!("BEGIN; {script} COMMIT;");
        sqlx::raw_sql(AssertSqlSafe(whole)).execute(connection).await?;
        Ok(())
    });
    // another program may have made them just now
    match check(link) {
        Ok(()) => Ok(()),
        checked => made.and(checked),
    }
}

/// All that makes the tables and views.
fn script(template: &Template) -> String {
    let mut parts = vec![SHARED.to_owned()];
    for table in template.tables.values().filter(|table| table.ours) {
        let columns: Vec<String> = table
            .columns
            .iter()
            .map(|column| {
                let required = if column.required { " NOT NULL" } else { "" };
                format!("  {} {}{required}", identifier(&column.name), column.kind.declared())
            })
            .collect();
        let name = identifier(&table.name);
        let key = keyed(&table.key);
        let columns = columns.join(",\n");
        parts.push(format!(
            "CREATE TABLE adit.{name} (\n  site text NOT NULL,\n{columns},\n  PRIMARY KEY ({key})\n);"
        ));
        let index = |columns: &Vec<String>| format!("CREATE INDEX ON adit.{name} ({});", keyed(columns));
        parts.extend(table.indexes.iter().map(index));
    }
    parts.extend([VIEWS.to_owned(), format!("INSERT INTO adit.version VALUES (1, {VERSION});\n")]);
    parts.join("\n")
}

/// Columns behind the site's name.
fn keyed(columns: &[String]) -> String {
    format!("site, {}", Table::list("", columns.iter().map(String::as_str)))
}
