//! What sqlx does not offer and SQLite does: limits of a connection, and one reading statement run step by step, so that a
//! row is measured before it is copied. With its [functions] the only part of the crate that calls C.
#![allow(unsafe_code)]

mod functions;

use std::cell::Cell as Counter;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::marker::PhantomData;
use std::rc::Rc;
use std::{ptr, slice};

use libsqlite3_sys::{
    SQLITE_BLOB, SQLITE_DBCONFIG_DEFENSIVE, SQLITE_DBCONFIG_ENABLE_TRIGGER, SQLITE_DBCONFIG_TRUSTED_SCHEMA,
    SQLITE_DENY, SQLITE_DONE, SQLITE_FLOAT, SQLITE_FUNCTION, SQLITE_INTEGER, SQLITE_LIMIT_ATTACHED,
    SQLITE_LIMIT_COLUMN, SQLITE_LIMIT_COMPOUND_SELECT, SQLITE_LIMIT_EXPR_DEPTH, SQLITE_LIMIT_FUNCTION_ARG,
    SQLITE_LIMIT_LENGTH, SQLITE_LIMIT_LIKE_PATTERN_LENGTH, SQLITE_LIMIT_SQL_LENGTH,
    SQLITE_LIMIT_TRIGGER_DEPTH, SQLITE_LIMIT_VARIABLE_NUMBER, SQLITE_LIMIT_VDBE_OP, SQLITE_NULL, SQLITE_OK,
    SQLITE_PRAGMA, SQLITE_READ, SQLITE_RECURSIVE, SQLITE_ROW, SQLITE_SELECT, sqlite3, sqlite3_column_blob,
    sqlite3_column_bytes, sqlite3_column_count, sqlite3_column_double, sqlite3_column_int64,
    sqlite3_column_name, sqlite3_column_text, sqlite3_column_type, sqlite3_db_config, sqlite3_errmsg,
    sqlite3_extended_errcode, sqlite3_finalize, sqlite3_hard_heap_limit64, sqlite3_limit,
    sqlite3_memory_used, sqlite3_prepare_v2, sqlite3_set_authorizer, sqlite3_step, sqlite3_stmt,
    sqlite3_stmt_readonly,
};
use sqlx::sqlite::LockedSqliteHandle;

use crate::cell::Cell;

const SQL_LENGTH: c_int = 100_000;
const COLUMNS: c_int = 200;

/// Functions that a statement may name, views included: SQLite does not look at the clock between those of one row.
const FUNCTIONS: u32 = 400;
/// Of these, comparisons with a pattern, the slowest.
const PATTERNS: u32 = 20;

/// Bytes that SQLite may hold in all, for everybody's connections. It is beyond what a query may take ([`memory`]): an edit
/// that is made meanwhile finds room.
const HEAP: i64 = 1 << 30;

/// Makes a connection fit for text of a user: no other databases, no tricks by the schema, values and texts of sane
/// length.
pub(crate) fn restrict(handle: &mut LockedSqliteHandle<'_>) {
    let database = handle.as_raw_handle().as_ptr();
    let limits = [
        (SQLITE_LIMIT_ATTACHED, 0),
        (SQLITE_LIMIT_LENGTH, functions::LENGTH),
        (SQLITE_LIMIT_SQL_LENGTH, SQL_LENGTH),
        (SQLITE_LIMIT_COLUMN, COLUMNS),
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
    // SAFETY: takes any number, at any time.
    unsafe { sqlite3_hard_heap_limit64(HEAP) };
    functions::replace(handle);
}

/// Has the triggers of a database fire, or not; those of the connection itself fire all the same.
pub(crate) fn fire_triggers(handle: &mut LockedSqliteHandle<'_>, on: bool) {
    let database = handle.as_raw_handle().as_ptr();
    // SAFETY: `handle` locks an open connection; the setting takes an int and a pointer to int, which may be null.
    unsafe {
        sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_TRIGGER, c_int::from(on), ptr::null_mut::<c_int>())
    };
}

/// Bytes that SQLite holds, for everybody's connections.
pub(crate) fn memory() -> i64 {
    // SAFETY: may be called at any time.
    unsafe { sqlite3_memory_used() }
}

const ONE: &str = "one statement at a time, please";
const READING: &str = "only statements that read are allowed here; edits go through the tables, so that they are checked and can be undone";

/// Functions that do more than compute, tell of more than the data, or take time with the square of a text's length or
/// memory with the product of two.
const FORBIDDEN: [&[u8]; 10] = [
    b"load_extension",
    b"fts3_tokenizer",
    b"readfile",
    b"writefile",
    b"edit",
    b"sqlite_compileoption_get",
    b"json_patch",
    b"jsonb_patch",
    b"json_pretty",
    b"unhex",
];

/// Pragmas that tell what tables and columns there are, and set nothing.
const TELLING: [&[u8]; 6] =
    [b"table_info", b"table_xinfo", b"table_list", b"index_list", b"index_info", b"foreign_key_list"];

/// How many functions a statement has named so far.
#[derive(Default)]
struct Named {
    functions: Counter<u32>,
    patterns: Counter<u32>,
}

impl Named {
    fn may(&self, function: &[u8]) -> bool {
        let is = |name: &&[u8]| name.eq_ignore_ascii_case(function);
        let is_pattern = [&b"like"[..], b"glob"].iter().any(is);
        self.functions.set(self.functions.get() + 1);
        self.patterns.set(self.patterns.get() + u32::from(is_pattern));
        !FORBIDDEN.iter().any(is) && self.functions.get() <= FUNCTIONS && self.patterns.get() <= PATTERNS
    }

    fn are_too_many(&self) -> bool {
        self.functions.get() > FUNCTIONS || self.patterns.get() > PATTERNS
    }
}

/// What SQLite asks before each part of a statement: only reading, and functions that compute, are allowed.
unsafe extern "C" fn may(
    named: *mut c_void,
    action: c_int,
    first: *const c_char,
    second: *const c_char,
    _: *const c_char,
    _: *const c_char,
) -> c_int {
    match action {
        SQLITE_SELECT | SQLITE_READ | SQLITE_RECURSIVE => SQLITE_OK,
        SQLITE_PRAGMA if !first.is_null() => {
            // SAFETY: SQLite hands the pragma's name, which ends in NUL and lives as long as the call.
            let name = unsafe { CStr::from_ptr(first) }.to_bytes();
            let tells = TELLING.iter().any(|known| known.eq_ignore_ascii_case(name));
            if tells { SQLITE_OK } else { SQLITE_DENY }
        }
        SQLITE_FUNCTION if !second.is_null() => {
            // SAFETY: SQLite hands the function's name, which ends in NUL and lives as long as the call.
            let name = unsafe { CStr::from_ptr(second) }.to_bytes();
            // SAFETY: the pointer that was set with this function, to what lives until it is taken away.
            let named = unsafe { &*named.cast::<Named>() };
            if named.may(name) { SQLITE_OK } else { SQLITE_DENY }
        }
        _ => SQLITE_DENY,
    }
}

/// What SQLite says went wrong: its primary result code, and its words.
#[derive(Debug)]
pub(crate) struct Failed {
    pub(crate) code: i32,
    pub(crate) message: String,
}

impl Failed {
    fn of(database: *mut sqlite3) -> Self {
        // SAFETY: `database` is open and locked.
        let code = unsafe { sqlite3_extended_errcode(database) } & 0xff;
        Self { code, message: message(database) }
    }

    /// A refusal of ours, told as an error of the text.
    fn refused(message: impl Into<String>) -> Self {
        Self { code: 1, message: message.into() }
    }
}

/// Exactly one statement that only reads, on a connection that nobody else uses meanwhile.
pub(crate) struct Statement<'h> {
    database: *mut sqlite3,
    prepared: *mut sqlite3_stmt,
    /// SQLite's authorizer points to it.
    named: Rc<Named>,
    handle: PhantomData<&'h mut ()>,
}

impl<'h> Statement<'h> {
    /// Says why `sql` is not exactly one statement that only reads.
    pub(crate) fn prepare(handle: &'h mut LockedSqliteHandle<'_>, sql: &str) -> Result<Self, Failed> {
        let database = handle.as_raw_handle().as_ptr();
        let text = CString::new(sql).map_err(|_| Failed::refused("a query cannot hold the character NUL"))?;
        let named = Rc::<Named>::default();
        // SAFETY: `handle` locks an open connection; `named` lives until the authorizer is taken away, in `drop`.
        unsafe { sqlite3_set_authorizer(database, Some(may), Rc::as_ptr(&named).cast_mut().cast()) };
        let mut own = Self { database, prepared: ptr::null_mut(), named, handle: PhantomData };
        let mut rest = text.as_ptr();
        // SAFETY: `rest` always points into `text`, which ends in NUL: SQLite leaves it at the statement's end.
        while unsafe { *rest } != 0 {
            let mut next: *mut sqlite3_stmt = ptr::null_mut();
            // SAFETY: `database` is open and locked, `rest` a C string, and both results have a place.
            let code = unsafe { sqlite3_prepare_v2(database, rest, -1, &raw mut next, &raw mut rest) };
            let is_second = !own.prepared.is_null();
            if code != SQLITE_OK {
                let failed = Failed::of(database);
                return Err(match failed.message.as_str() {
                    _ if is_second => Failed::refused(ONE),
                    _ if own.named.are_too_many() => Failed::refused(format!(
                        "a query may name {FUNCTIONS} functions, and {PATTERNS} times LIKE or GLOB"
                    )),
                    "not authorized" => Failed::refused(READING),
                    _ => failed,
                });
            }
            // a comment or a lone semicolon is no statement
            if next.is_null() {
                continue;
            }
            if is_second {
                // SAFETY: just prepared, and not used afterwards.
                unsafe { sqlite3_finalize(next) };
                return Err(Failed::refused(ONE));
            }
            own.prepared = next;
        }
        if own.prepared.is_null() {
            return Err(Failed::refused("the query is empty"));
        }
        // SAFETY: prepared above and not yet finalized.
        if unsafe { sqlite3_stmt_readonly(own.prepared) } == 0 {
            return Err(Failed::refused(READING));
        }
        Ok(own)
    }

    /// The columns' names.
    pub(crate) fn columns(&self) -> Vec<String> {
        let name = |column| {
            // SAFETY: the statement is prepared, and has this column.
            let name = unsafe { sqlite3_column_name(self.prepared, column) };
            if name.is_null() {
                return String::new();
            }
            // SAFETY: not null, ends in NUL, and lives until the statement is finalized or asked again.
            unsafe { CStr::from_ptr(name) }.to_string_lossy().into_owned()
        };
        (0..self.count()).map(name).collect()
    }

    fn count(&self) -> c_int {
        // SAFETY: the statement is prepared.
        unsafe { sqlite3_column_count(self.prepared) }
    }

    /// Goes to the next row; `false` where there is none.
    pub(crate) fn step(&mut self) -> Result<bool, Failed> {
        // SAFETY: the statement is prepared, and its connection locked.
        match unsafe { sqlite3_step(self.prepared) } {
            SQLITE_ROW => Ok(true),
            SQLITE_DONE => Ok(false),
            _ => Err(Failed::of(self.database)),
        }
    }

    /// How much room the row would take, about; nothing is copied for that.
    pub(crate) fn bytes(&self) -> usize {
        // SAFETY: the statement is prepared, and has these columns.
        let bytes = |column| match unsafe { sqlite3_column_type(self.prepared, column) } {
            // SAFETY: as above.
            SQLITE_BLOB | libsqlite3_sys::SQLITE_TEXT => unsafe {
                sqlite3_column_bytes(self.prepared, column) as usize
            },
            _ => 8,
        };
        (0..self.count()).map(bytes).sum()
    }

    /// The row's values.
    pub(crate) fn row(&self) -> Result<Vec<Cell>, Failed> {
        (0..self.count()).map(|column| self.cell(column)).collect()
    }

    fn cell(&self, column: c_int) -> Result<Cell, Failed> {
        // SAFETY: the statement is prepared, stands at a row, and has this column.
        match unsafe { sqlite3_column_type(self.prepared, column) } {
            SQLITE_NULL => Ok(Cell::Null),
            // SAFETY: as above.
            SQLITE_INTEGER => Ok(Cell::Integer(unsafe { sqlite3_column_int64(self.prepared, column) })),
            // SAFETY: as above.
            SQLITE_FLOAT => Ok(Cell::Real(unsafe { sqlite3_column_double(self.prepared, column) })),
            SQLITE_BLOB => {
                // SAFETY: as above; asked before its length, as SQLite wants it.
                let first = unsafe { sqlite3_column_blob(self.prepared, column) };
                Ok(Cell::Blob(self.copied(column, first.cast())))
            }
            _ => {
                // SAFETY: as above.
                let first = unsafe { sqlite3_column_text(self.prepared, column) };
                let text = String::from_utf8(self.copied(column, first));
                text.map(Cell::Text).map_err(|error| Failed::refused(format!("a text is no UTF-8: {error}")))
            }
        }
    }

    fn copied(&self, column: c_int, first: *const u8) -> Vec<u8> {
        // SAFETY: the statement is prepared, stands at a row, and has this column.
        let length = unsafe { sqlite3_column_bytes(self.prepared, column) } as usize;
        if first.is_null() || length == 0 {
            return Vec::new();
        }
        // SAFETY: SQLite gave so many bytes, which stay until the next step.
        unsafe { slice::from_raw_parts(first, length) }.to_vec()
    }
}

impl Drop for Statement<'_> {
    fn drop(&mut self) {
        // SAFETY: finalized this once (null is allowed); afterwards nothing points to what the authorizer counts in.
        unsafe {
            sqlite3_finalize(self.prepared);
            sqlite3_set_authorizer(self.database, None, ptr::null_mut());
        }
    }
}

fn message(database: *mut sqlite3) -> String {
    // SAFETY: `database` is open and locked; the message is NUL-terminated and lives until the next call.
    let message = unsafe { CStr::from_ptr(sqlite3_errmsg(database)) };
    message.to_string_lossy().into_owned()
}
