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

/// A version of the tables: that of SQLite's, and the how manieth form of them in PostgreSQL.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Version {
    pub schema: i64,
    form: i64,
}

/// What this program knows. Its form grows where what is here or in `sql/postgres` changes, and SQLite's version does not.
pub(super) const KNOWN: Version = Version { schema: VERSION, form: 1 };

/// Forms of one version of SQLite's.
const FORMS: i64 = 100;

impl Version {
    /// As the table `version` has it: the first releases wrote that of SQLite's alone.
    fn read(number: i64) -> Self {
        if number < FORMS {
            Self { schema: number, form: 0 }
        } else {
            Self { schema: number / FORMS, form: number % FORMS }
        }
    }

    pub(super) fn number(self) -> i64 {
        self.schema * FORMS + self.form
    }

    /// What is said of one that is not known here.
    pub(super) fn unknown(self, place: String) -> Error {
        let then =
            if self < KNOWN { "`adit upgrade` brings them up to it" } else { "a newer program serves them" };
        Failure::Version { place, found: self.to_string(), known: KNOWN.to_string(), then }.into()
    }
}

impl std::fmt::Display for Version {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}.{}", self.schema, self.form)
    }
}

/// The version of the tables; `None` where there are none. Statements are prepared anew: those of before an upgrade would read
/// what it has kept.
pub(super) async fn version(connection: &mut PgConnection) -> Result<Option<Version>> {
    // who has no right to it is to be told so: the information schema would leave it out
    let sql = "SELECT count(*) FROM pg_catalog.pg_tables WHERE schemaname = 'adit' AND tablename = 'version'";
    let tables: i64 = sqlx::query_scalar(sql).fetch_one(&mut *connection).await?;
    if tables == 0 {
        return Ok(None);
    }
    let query = sqlx::query_scalar("SELECT version FROM adit.version WHERE one = 1").persistent(false);
    Ok(query.fetch_optional(connection).await?.map(Version::read))
}

/// Refuses tables of another version, and a database without any.
pub(super) fn check(link: &mut Link) -> Result<()> {
    let place = link.place().shown();
    match link.again(version)? {
        Some(KNOWN) => Ok(()),
        Some(found) => Err(found.unknown(place)),
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
pub(super) fn script(template: &Template) -> String {
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
    parts.extend([VIEWS.to_owned(), format!("INSERT INTO adit.version VALUES (1, {});\n", KNOWN.number())]);
    parts.join("\n")
}

/// Columns behind the site's name.
fn keyed(columns: &[String]) -> String {
    format!("site, {}", Table::list("", columns.iter().map(String::as_str)))
}
