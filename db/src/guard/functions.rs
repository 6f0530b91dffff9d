//! Functions of SQLite's own that take time with the square of a text's length, in one instruction that nothing interrupts:
//! here they take time with the length.

use std::collections::BTreeSet;
use std::ffi::{CStr, c_int};
use std::{ptr, slice, str};

use libsqlite3_sys::{
    SQLITE_BLOB, SQLITE_DETERMINISTIC, SQLITE_INNOCUOUS, SQLITE_NULL, SQLITE_TRANSIENT, SQLITE_UTF8,
    sqlite3_context, sqlite3_create_function_v2, sqlite3_result_error_toobig, sqlite3_result_int64,
    sqlite3_result_text64, sqlite3_value, sqlite3_value_blob, sqlite3_value_bytes, sqlite3_value_text,
    sqlite3_value_type,
};
use memchr::memmem;
use sqlx::sqlite::LockedSqliteHandle;

/// Bytes of a value and of a row that is read, sorted or kept; a route's walk at a million rooms stays below. The time that
/// one instruction takes, which nothing interrupts, grows with it.
pub(super) const LENGTH: c_int = 1_000_000;

type Function = unsafe extern "C" fn(*mut sqlite3_context, c_int, *mut *mut sqlite3_value);

/// Puts them in the place of SQLite's own.
pub(super) fn replace(handle: &mut LockedSqliteHandle<'_>) {
    let functions: [(&CStr, c_int, Function); 5] = [
        (c"instr", 2, instr),
        (c"replace", 3, replaced),
        (c"trim", 2, trimmed::<true, true>),
        (c"ltrim", 2, trimmed::<true, false>),
        (c"rtrim", 2, trimmed::<false, true>),
    ];
    let form = SQLITE_UTF8 | SQLITE_DETERMINISTIC | SQLITE_INNOCUOUS;
    for (name, arguments, function) in functions {
        // SAFETY: `handle` locks an open connection, the name ends in NUL, and the function has no state.
        unsafe {
            sqlite3_create_function_v2(
                handle.as_raw_handle().as_ptr(),
                name.as_ptr(),
                arguments,
                form,
                ptr::null_mut(),
                Some(function),
                None,
                None,
                None,
            )
        };
    }
}

/// `instr(whole, part)`: where a part stands, from 1; letters are counted, and bytes if both are bytes.
unsafe extern "C" fn instr(context: *mut sqlite3_context, _: c_int, arguments: *mut *mut sqlite3_value) {
    // SAFETY: SQLite hands as many arguments as the function was registered with; they live as long as the call.
    let (whole, part) = unsafe { (*arguments, *arguments.add(1)) };
    // SAFETY: as above.
    let are_bytes = unsafe { kind(whole) == SQLITE_BLOB && kind(part) == SQLITE_BLOB };
    // SAFETY: as above.
    let Some((whole, part)) = (unsafe { content(whole, are_bytes).zip(content(part, are_bytes)) }) else {
        return;
    };
    let is_first = |byte: &&u8| are_bytes || **byte & 0xc0 != 0x80;
    let place = memmem::find(whole, part).map_or(0, |at| whole[..at].iter().filter(is_first).count() + 1);
    // SAFETY: `context` is that of this call.
    unsafe { sqlite3_result_int64(context, place as i64) };
}

/// `replace(text, part, by)`.
unsafe extern "C" fn replaced(context: *mut sqlite3_context, _: c_int, arguments: *mut *mut sqlite3_value) {
    // SAFETY: SQLite hands as many arguments as the function was registered with; they live as long as the call.
    let argument = |number| unsafe { content(*arguments.add(number), false) };
    let Some((text, part)) = argument(0).zip(argument(1)) else { return };
    if part.is_empty() {
        return answer(context, text);
    }
    let Some(by) = argument(2) else { return };
    let places: Vec<usize> = memmem::find_iter(text, part).collect();
    let length = text.len() - places.len() * part.len() + places.len() * by.len();
    if length > LENGTH as usize {
        // SAFETY: `context` is that of this call.
        return unsafe { sqlite3_result_error_toobig(context) };
    }
    let (mut whole, mut from) = (Vec::with_capacity(length), 0);
    for at in places {
        whole.extend_from_slice(&text[from..at]);
        whole.extend_from_slice(by);
        from = at + part.len();
    }
    whole.extend_from_slice(&text[from..]);
    answer(context, &whole);
}

/// `trim(text, letters)`: without these letters at its ends.
unsafe extern "C" fn trimmed<const LEFT: bool, const RIGHT: bool>(
    context: *mut sqlite3_context,
    _: c_int,
    arguments: *mut *mut sqlite3_value,
) {
    // SAFETY: SQLite hands as many arguments as the function was registered with; they live as long as the call.
    let texts = unsafe { content(*arguments, false).zip(content(*arguments.add(1), false)) };
    let Some((text, letters)) = texts else { return };
    let (Ok(mut rest), Ok(letters)) = (str::from_utf8(text), str::from_utf8(letters)) else {
        return answer(context, text);
    };
    let letters: BTreeSet<char> = letters.chars().collect();
    if LEFT {
        rest = rest.trim_start_matches(|letter| letters.contains(&letter));
    }
    if RIGHT {
        rest = rest.trim_end_matches(|letter| letters.contains(&letter));
    }
    answer(context, rest.as_bytes());
}

/// SAFETY: `value` is an argument of the call that is running.
unsafe fn kind(value: *mut sqlite3_value) -> c_int {
    // SAFETY: as the caller says.
    unsafe { sqlite3_value_type(value) }
}

/// The bytes of a value, as a text unless it is to be taken as bytes; nothing of NULL.
///
/// SAFETY: `value` is an argument of the call that is running; it is not asked for in another form meanwhile.
unsafe fn content<'c>(value: *mut sqlite3_value, as_bytes: bool) -> Option<&'c [u8]> {
    // SAFETY: as the caller says; the bytes are asked for before their length, as SQLite wants it.
    unsafe {
        if kind(value) == SQLITE_NULL {
            return None;
        }
        let first = if as_bytes { sqlite3_value_blob(value).cast() } else { sqlite3_value_text(value) };
        let length = sqlite3_value_bytes(value) as usize;
        // SQLite gives null for no bytes, and where its memory is at an end, which it says itself
        Some(if first.is_null() { &[] } else { slice::from_raw_parts(first, length) })
    }
}

fn answer(context: *mut sqlite3_context, text: &[u8]) {
    let first = text.as_ptr().cast();
    // SAFETY: `context` is that of the call that is running; SQLite copies the text.
    unsafe {
        sqlite3_result_text64(context, first, text.len() as u64, SQLITE_TRANSIENT(), SQLITE_UTF8 as u8);
    }
}
