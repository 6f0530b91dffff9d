//! What sqlx does not offer and SQLite does: limits of a connection, and whether a text is one reading statement.
//! The only file of the crate that calls C.
#![allow(unsafe_code)]

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr;

use libsqlite3_sys::{
    SQLITE_DBCONFIG_DEFENSIVE, SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DENY, SQLITE_FUNCTION,
    SQLITE_LIMIT_ATTACHED, SQLITE_LIMIT_COLUMN, SQLITE_LIMIT_COMPOUND_SELECT, SQLITE_LIMIT_EXPR_DEPTH,
    SQLITE_LIMIT_FUNCTION_ARG, SQLITE_LIMIT_LENGTH, SQLITE_LIMIT_LIKE_PATTERN_LENGTH,
    SQLITE_LIMIT_SQL_LENGTH, SQLITE_LIMIT_TRIGGER_DEPTH, SQLITE_LIMIT_VARIABLE_NUMBER, SQLITE_LIMIT_VDBE_OP,
    SQLITE_OK, SQLITE_READ, SQLITE_RECURSIVE, SQLITE_SELECT, sqlite3, sqlite3_db_config, sqlite3_errmsg,
    sqlite3_finalize, sqlite3_limit, sqlite3_prepare_v2, sqlite3_set_authorizer, sqlite3_stmt,
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
        (SQLITE_LIMIT_EXPR_DEPTH, 100),
        (SQLITE_LIMIT_COMPOUND_SELECT, 50),
        (SQLITE_LIMIT_VDBE_OP, 250_000),
        (SQLITE_LIMIT_FUNCTION_ARG, 32),
        (SQLITE_LIMIT_VARIABLE_NUMBER, 100),
        (SQLITE_LIMIT_TRIGGER_DEPTH, 10),
    ];
    for (limit, value) in limits {
        // SAFETY: `handle` locks an open connection; the call takes any value.
        unsafe { sqlite3_limit(database, limit, value) };
    }
    for (setting, on) in [(SQLITE_DBCONFIG_DEFENSIVE, 1), (SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0)] {
        // SAFETY: as above; both settings take an int and a pointer to int, which may be null.
        unsafe { sqlite3_db_config(database, setting, on as c_int, ptr::null_mut::<c_int>()) };
    }
    // SAFETY: as above; the function has no state, so it may be called as long as the connection is open.
    unsafe { sqlite3_set_authorizer(database, Some(may), ptr::null_mut()) };
}

const ONE: &str = "one statement at a time, please";
const READING: &str = "only statements that read are allowed here: edit by `adit tune`";

/// Functions that do more than compute, or tell of more than the data.
const FORBIDDEN: [&[u8]; 6] =
    [b"load_extension", b"fts3_tokenizer", b"readfile", b"writefile", b"edit", b"sqlite_compileoption_get"];

/// What SQLite asks before each part of a statement: only reading, and functions that compute, are allowed.
unsafe extern "C" fn may(
    _: *mut c_void,
    action: c_int,
    _: *const c_char,
    second: *const c_char,
    _: *const c_char,
    _: *const c_char,
) -> c_int {
    match action {
        SQLITE_SELECT | SQLITE_READ | SQLITE_RECURSIVE => SQLITE_OK,
        SQLITE_FUNCTION if !second.is_null() => {
            // SAFETY: SQLite hands the function's name, which ends in NUL and lives as long as the call.
            let name = unsafe { CStr::from_ptr(second) }.to_bytes();
            let is_forbidden = FORBIDDEN.iter().any(|forbidden| forbidden.eq_ignore_ascii_case(name));
            if is_forbidden { SQLITE_DENY } else { SQLITE_OK }
        }
        _ => SQLITE_DENY,
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
            return Err(match message(database) {
                _ if !reading.is_empty() => ONE.to_owned(),
                said if said == "not authorized" => READING.to_owned(),
                said => said,
            });
        }
        // a comment or a lone semicolon is no statement
        if !statement.is_null() {
            // SAFETY: just prepared and not yet finalized.
            reading.push(unsafe { sqlite3_stmt_readonly(statement) } != 0);
            // SAFETY: as above, and not used afterwards.
            unsafe { sqlite3_finalize(statement) };
        }
        if reading.len() > 1 {
            return Err(ONE.to_owned());
        }
    }
    match reading.as_slice() {
        [] => Err("the query is empty".to_owned()),
        [true] => Ok(()),
        _ => Err(READING.to_owned()),
    }
}

fn message(database: *mut sqlite3) -> String {
    // SAFETY: `database` is open and locked; the message is NUL-terminated and lives until the next call.
    let message = unsafe { std::ffi::CStr::from_ptr(sqlite3_errmsg(database)) };
    message.to_string_lossy().into_owned()
}
