//! The one door for SQL text that is put together at run time. Values are always bound; identifiers come from the
//! schema and are quoted here.

use sqlx::sqlite::{SqliteArguments, SqliteRow};
use sqlx::{AssertSqlSafe, SqliteConnection};

use crate::cell::Cell;
use crate::error::Result;

/// `name` as an SQL identifier.
pub(crate) fn identifier(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}

/// `text` as an SQL literal.
pub(crate) fn literal(text: &str) -> String {
    format!("'{}'", text.replace('\'', "''"))
}

/// Runs a statement of our making; the number of rows that it touched.
pub(crate) async fn execute(connection: &mut SqliteConnection, sql: String, values: &[Cell]) -> Result<u64> {
    let query = sqlx::query_with(AssertSqlSafe(sql), bound(values)?);
    Ok(query.execute(connection).await?.rows_affected())
}

/// The rows of a query of our making.
pub(crate) async fn fetch(
    connection: &mut SqliteConnection,
    sql: String,
    values: &[Cell],
) -> Result<Vec<SqliteRow>> {
    Ok(sqlx::query_with(AssertSqlSafe(sql), bound(values)?).fetch_all(connection).await?)
}

fn bound(values: &[Cell]) -> Result<SqliteArguments> {
    let mut arguments = SqliteArguments::default();
    for value in values {
        value.bind(&mut arguments)?;
    }
    Ok(arguments)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotes_in_names_cannot_leave_the_identifier() {
        assert_eq!(identifier("a\"; DROP TABLE x"), "\"a\"\"; DROP TABLE x\"");
        assert_eq!(literal("it's"), "'it''s'");
    }
}
