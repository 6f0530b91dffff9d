//! Rows that go with another one: the changes of shape from and to a state that is removed. The removed row's JSON
//! holds them under [`CHANGES`], so that taking the removal back brings them back, too.

use sqlx::SqliteConnection;

use super::table::Table;
use crate::cell::Cell;
use crate::dynamic;
use crate::error::Result;

/// The table, and the key in the JSON of a removed state.
pub(super) const CHANGES: &str = "changes";

/// The JSON of the row that `key` finds, with the rows that go with it.
pub(super) async fn with(
    connection: &mut SqliteConnection,
    table: &str,
    key: &[Cell],
    row: Cell,
) -> Result<Cell> {
    if table != "robots" {
        return Ok(row);
    }
    let changes = Table::editable(connection, CHANGES).await?;
    let sql = format!(
        "SELECT json_set(?3, '$.{CHANGES}', json_group_array(json({}))) FROM {CHANGES}
         WHERE robot IS ?1 AND ?2 IN (from_state, to_state) HAVING count(*) > 0",
        changes.json()
    );
    let mut values = key.to_vec();
    values.push(row.clone());
    let found = dynamic::fetch(connection, sql, &values).await?;
    found.first().map_or(Ok(row), |found| Cell::of(found, 0))
}

/// The keys of the rows that went with a removed one.
pub(super) async fn keys(
    connection: &mut SqliteConnection,
    table: &str,
    removed: &Cell,
) -> Result<Vec<String>> {
    if table != "robots" || !matches!(removed, Cell::Text(_)) {
        return Ok(Vec::new());
    }
    let key = ["robot", "from_state", "to_state"].map(|part| format!("json_extract(value, '$.{part}')"));
    let sql = format!(
        "SELECT {} FROM json_each(CASE WHEN json_valid(?1) THEN ?1 ELSE '{{}}' END, '$.{CHANGES}')",
        key.join(" || '/' || ")
    );
    let rows = dynamic::fetch(connection, sql, std::slice::from_ref(removed)).await?;
    rows.iter().map(|row| Ok(Cell::of(row, 0)?.to_string())).collect()
}
