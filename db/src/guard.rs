//! What sqlx does not offer and SQLite does: limits of a connection, and whether a text is one reading statement.
//! The only file of the crate that calls C.
#![allow(unsafe_code)]

use std::ffi::{CString, c_int};
use std::ptr;

use libsqlite3_sys::{
    SQLITE_DBCONFIG_DEFENSIVE, SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_LIMIT_ATTACHED, SQLITE_LIMIT_COLUMN,
    SQLITE_LIMIT_LENGTH, SQLITE_LIMIT_LIKE_PATTERN_LENGTH, SQLITE_LIMIT_SQL_LENGTH, SQLITE_OK, sqlite3,
    sqlite3_db_config, sqlite3_errmsg, sqlite3_finalize, sqlite3_limit, sqlite3_prepare_v2, sqlite3_stmt,
    sqlite3_stmt_readonly,
};
use sqlx::sqlite::LockedSqliteHandle;

/// Bytes of a value; a route's walk at a million rooms stays far below.
const LENGTH: c_int = 16_000_000;
const SQL_LENGTH: c_int = 100_000;

/// Makes a connection fit for text of a user: no other databases, no tricks by the schema, values and texts of sane
/// length.
pub(crate) fn restrict(handle: &mut LockedSqliteHandle<'_>) {
    let database = handle.as_raw_handle().as_ptr();
    let limits = [
        (SQLITE_LIMIT_ATTACHED, 0),
        (SQLITE_LIMIT_LENGTH, LENGTH),
        (SQLITE_LIMIT_SQL_LENGTH, SQL_LENGTH),
        (SQLITE_LIMIT_COLUMN, 500),
        (SQLITE_LIMIT_LIKE_PATTERN_LENGTH, 100),
    ];
    for (limit, value) in limits {
        // SAFETY: `handle` locks an open connection; the call takes any value.
        unsafe { sqlite3_limit(database, limit, value) };
    }
    for (setting, on) in [(SQLITE_DBCONFIG_DEFENSIVE, 1), (SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0)] {
        // SAFETY: as above; both settings take an int and a pointer to int, which may be null.
        unsafe { sqlite3_db_config(database, setting, on as c_int, ptr::null_mut::<c_int>()) };
    }
}

/// Says why `sql` is not exactly one statement that only reads.
pub(crate) fn one_reading_statement(handle: &mut LockedSqliteHandle<'_>, sql: &str) -> Result<(), String> {
    let database = handle.as_raw_handle().as_ptr();
    let text = CString::new(sql).map_err(|_| "a query cannot hold the character NUL".to_owned())?;
    let mut rest = text.as_ptr();
    let mut reading = Vec::new();
    // SAFETY: `rest` always points into `text`, which ends in NUL: SQLite leaves it at the statement's end.
    while unsafe { *rest } != 0 {
        let mut statement: *mut sqlite3_stmt = ptr::null_mut();
        // SAFETY: `database` is open and locked, `rest` a C string, and both results have a place.
        let code = unsafe { sqlite3_prepare_v2(database, rest, -1, &raw mut statement, &raw mut rest) };
        if code != SQLITE_OK {
            return Err(message(database));
        }
        // a comment or a lone semicolon is no statement
        if !statement.is_null() {
            // SAFETY: just prepared and not yet finalized.
            reading.push(unsafe { sqlite3_stmt_readonly(statement) } != 0);
            // SAFETY: as above, and not used afterwards.
            unsafe { sqlite3_finalize(statement) };
        }
        if reading.len() > 1 {
            return Err("one statement at a time, please".to_owned());
        }
    }
    match reading.as_slice() {
        [] => Err("the query is empty".to_owned()),
        [true] => Ok(()),
        _ => Err("only statements that read are allowed here: edit by `adit tune`".to_owned()),
    }
}

fn message(database: *mut sqlite3) -> String {
    // SAFETY: `database` is open and locked; the message is NUL-terminated and lives until the next call.
    let message = unsafe { std::ffi::CStr::from_ptr(sqlite3_errmsg(database)) };
    message.to_string_lossy().into_owned()
}
