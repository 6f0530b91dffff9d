//! Functions of the interpreter that make much of little in one call: what they would give is measured before.
//!
//! rhai measures what a native function gave, which is too late where that is gigabytes.

use rhai::{Array, Dynamic, Engine, EvalAltResult, ImmutableString, Position};

use super::limits::{MAX_ARRAY, MAX_TEXT};

type Measured = Result<(), Box<EvalAltResult>>;

pub(super) fn register(engine: &mut Engine) {
    engine
        .register_fn("replace", |text: &mut ImmutableString, part: &str, by: &str| replace(text, part, by))
        .register_fn("replace", |text: &mut ImmutableString, letter: char, by: &str| {
            replace(text, letter.encode_utf8(&mut [0; 4]), by)
        })
        .register_fn("pad", |text: &mut ImmutableString, letters: i64, with: &str| {
            pad_text(text, letters, with)
        })
        .register_fn("pad", |array: &mut Array, len: i64, item: Dynamic| pad_array(array, len, item));
}

fn replace(text: &mut ImmutableString, part: &str, by: &str) -> Measured {
    if text.is_empty() {
        return Ok(());
    }
    let found = text.matches(part).count();
    fits(text.len() - found * part.len() + found * by.len(), MAX_TEXT, "Length of string")?;
    *text = text.replace(part, by).into();
    Ok(())
}

/// rhai's own never ends where there is nothing to pad with.
fn pad_text(text: &mut ImmutableString, letters: i64, with: &str) -> Measured {
    let letters = usize::try_from(letters).unwrap_or(0);
    let missing = letters.saturating_sub(text.chars().count());
    if missing == 0 {
        return Ok(());
    }
    fits(letters, MAX_TEXT, "Length of string")?;
    if with.is_empty() {
        return Err("an empty text fills nothing up".into());
    }
    let padded: String = text.chars().chain(with.chars().cycle().take(missing)).collect();
    fits(padded.len(), MAX_TEXT, "Length of string")?;
    *text = padded.into();
    Ok(())
}

/// rhai's own measures, too, but its product overflows.
fn pad_array(array: &mut Array, len: i64, item: Dynamic) -> Measured {
    let len = usize::try_from(len).unwrap_or(0);
    let missing = len.saturating_sub(array.len());
    if missing > 0 {
        let added = missing.saturating_mul(1 + elements(&item));
        fits(array.len().saturating_add(added), MAX_ARRAY, "Size of array/BLOB")?;
        array.resize(len, item);
    }
    Ok(())
}

fn elements(value: &Dynamic) -> usize {
    if let Ok(array) = value.as_array_ref() {
        return array.iter().map(|element| 1 + elements(element)).sum();
    }
    if let Ok(map) = value.as_map_ref() {
        return map.values().map(|element| 1 + elements(element)).sum();
    }
    value.as_blob_ref().map_or(0, |blob| blob.len())
}

fn fits(size: usize, most: usize, what: &str) -> Measured {
    if size <= most {
        return Ok(());
    }
    Err(EvalAltResult::ErrorDataTooLarge(what.to_owned(), Position::NONE).into())
}
