//! Places of a text as the protocol counts them: lines from 0, and in a line units of UTF-16.

use std::ops::Range;

use lsp_types::{Position, Range as Span};

/// The byte at a place; where the line is shorter, its end.
pub fn offset(text: &str, at: Position) -> usize {
    let before: usize = text.split_inclusive('\n').take(at.line as usize).map(str::len).sum();
    let line = text[before..].split('\n').next().unwrap_or_default();
    let mut units = 0;
    for (byte, letter) in line.char_indices() {
        if units >= at.character as usize {
            return before + byte;
        }
        units += letter.len_utf16();
    }
    before + line.len()
}

/// The place of a byte.
pub fn position(text: &str, byte: usize) -> Position {
    let before = &text[..byte.min(text.len())];
    let line = before.matches('\n').count();
    let column: usize = before.rsplit('\n').next().unwrap_or_default().chars().map(char::len_utf16).sum();
    Position::new(u32::try_from(line).unwrap_or(u32::MAX), u32::try_from(column).unwrap_or(u32::MAX))
}

pub fn span(text: &str, bytes: &Range<usize>) -> Span {
    Span::new(position(text, bytes.start), position(text, bytes.end))
}

/// The place of a line and column from 1, in letters, as messages say it.
pub fn said(text: &str, line: usize, column: usize) -> Position {
    let found = text.split('\n').nth(line.saturating_sub(1)).unwrap_or_default();
    let units: usize = found.chars().take(column.saturating_sub(1)).map(char::len_utf16).sum();
    Position::new(
        u32::try_from(line.saturating_sub(1)).unwrap_or(u32::MAX),
        u32::try_from(units).unwrap_or(u32::MAX),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_beyond_one_unit_count_two() {
        let text = "a\n𝄞é = 1\n";
        let equals = text.find('=').unwrap_or_default();
        assert_eq!(position(text, equals), Position::new(1, 4));
        assert_eq!(offset(text, Position::new(1, 4)), equals);
        assert_eq!(said(text, 2, 4), Position::new(1, 4));
    }

    #[test]
    fn beyond_the_end_is_the_end() {
        assert_eq!(offset("ab\ncd", Position::new(0, 9)), 2);
        assert_eq!(offset("ab\ncd", Position::new(9, 9)), 5);
        assert_eq!(offset("", Position::new(0, 0)), 0);
    }
}
