//! Lists of numbers as JSON texts, exact to the bit: what a reader of JSON makes of a number may differ in its last bit.

use std::fmt::Write;

/// `[1.5,-2.0]`
pub(super) fn text(numbers: &[f64]) -> String {
    let mut text = String::from("[");
    for (index, number) in numbers.iter().enumerate() {
        let comma = if index > 0 { "," } else { "" };
        // Writing to a String cannot fail.
        let _ = write!(text, "{comma}{number:?}");
    }
    text.push(']');
    text
}

/// `[[1.5,-2.0],[0.0,1.0]]`
pub(super) fn rows_text<'r>(rows: impl IntoIterator<Item = &'r [f64]>) -> String {
    let rows: Vec<String> = rows.into_iter().map(text).collect();
    format!("[{}]", rows.join(","))
}

/// The numbers of such a text; `None` where it is none.
pub(super) fn read(text: &str) -> Option<Vec<f64>> {
    let inner = text.trim().strip_prefix('[')?.strip_suffix(']')?.trim();
    if inner.is_empty() {
        return Some(Vec::new());
    }
    let finite = |part: &str| part.trim().parse().ok().filter(|number: &f64| number.is_finite());
    inner.split(',').map(finite).collect()
}

/// The rows of such a text; `None` where it is none.
pub(super) fn read_rows(text: &str) -> Option<Vec<Vec<f64>>> {
    let inner = text.trim().strip_prefix('[')?.strip_suffix(']')?.trim();
    if inner.is_empty() {
        return Some(Vec::new());
    }
    let rows = inner.strip_prefix('[')?.strip_suffix(']')?;
    rows.split("],").map(|row| read(&format!("[{}]", row.trim().trim_start_matches('[')))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_written_is_read_to_the_bit() {
        let numbers = vec![0.1, -0.0, 1e-300, 1.0 / 3.0, 2.0, f64::MAX];
        let back = read(&text(&numbers)).expect("numbers");
        assert!(numbers.iter().zip(&back).all(|(one, other)| one.to_bits() == other.to_bits()));
        assert_eq!(read(&text(&[])), Some(vec![]));
        let rows = [vec![0.1, 2.0], vec![-1.0 / 3.0]];
        assert_eq!(read_rows(&rows_text(rows.iter().map(Vec::as_slice))).as_deref(), Some(rows.as_slice()));
        assert_eq!(read_rows("[]"), Some(vec![]));
        assert_eq!(read_rows("[[1.0, 2.0], [3.0]]"), Some(vec![vec![1.0, 2.0], vec![3.0]]));
    }

    #[test]
    fn what_is_no_list_of_numbers_is_none() {
        for text in ["", "1", "[1,]", "[a]", "[inf]", "[NaN]"] {
            assert_eq!(read(text), None, "{text}");
        }
        assert_eq!(read_rows("[1]"), None);
    }
}
