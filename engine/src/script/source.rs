//! A rule file's text, and places in it.

use std::ops::Range;
use std::sync::Arc;

use miette::NamedSource;
use rhai::Position;

/// Largest rule file that is read, in bytes.
pub const MAX_FILE_BYTES: usize = 1_000_000;

/// A rule file as the host hands it over: a name for messages, and the text.
#[derive(Clone, Debug)]
pub struct SourceFile {
    named: Arc<NamedSource<String>>,
}

impl SourceFile {
    /// A file; `name` is what messages call it.
    pub fn new(name: impl AsRef<str>, text: impl Into<String>) -> Self {
        Self { named: Arc::new(NamedSource::new(name, text.into())) }
    }

    pub fn name(&self) -> &str {
        self.named.name()
    }

    pub fn text(&self) -> &str {
        self.named.inner()
    }

    pub(crate) const fn named(&self) -> &Arc<NamedSource<String>> {
        &self.named
    }

    pub(crate) fn place_at(&self, offset: usize) -> Place {
        self.place_of(&(offset..offset + token_len(&self.text()[offset..])))
    }

    /// The place of a token. The interpreter counts lines and characters from 1.
    pub(crate) fn place(&self, position: Position) -> Place {
        let line = position.line().unwrap_or(1);
        let column = position.position().unwrap_or(1).max(1);
        let text = self.text();
        let start: usize = text.split_inclusive('\n').take(line - 1).map(str::len).sum();
        let rest = &text[start..];
        let offset = start + rest.char_indices().nth(column - 1).map_or(rest.len(), |(at, _)| at);
        Place { source: self.clone(), span: (offset, token_len(&text[offset..])), line, column }
    }

    /// The cells of the list that begins at a place, as they are written.
    pub(crate) fn cells(&self, list: Position) -> Vec<String> {
        cells(&self.text()[self.place(list).span.0..])
    }

    pub(crate) fn place_of(&self, bytes: &Range<usize>) -> Place {
        let text = self.text();
        let start = text.floor_char_boundary(bytes.start.min(text.len()));
        let end = text.floor_char_boundary(bytes.end.clamp(start, text.len()));
        let before = &text[..start];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Place {
            source: self.clone(),
            span: (start, end - start),
            line: before.matches('\n').count() + 1,
            column: text[line_start..start].chars().count() + 1,
        }
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Place {
    pub(crate) source: SourceFile,
    pub(crate) span: (usize, usize),
    pub(crate) line: usize,
    pub(crate) column: usize,
}

/// Bytes of the name, number, text or sign at the start.
fn token_len(text: &str) -> usize {
    let mut chars = text.chars();
    match chars.next() {
        None => 0,
        Some('"') => text[1..].find(['"', '\n']).map_or(1, |end| end + 2).min(text.len()),
        Some(first) if first.is_alphanumeric() || first == '_' => {
            text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len())
        }
        Some(first) => first.len_utf8(),
    }
}

/// The cells of a list as they are written, from its bracket on.
fn cells(list: &str) -> Vec<String> {
    let (mut cells, mut cell, mut deep) = (vec![], String::new(), 0);
    let (mut is_text, mut is_comment) = (false, false);
    let mut letters = list.chars().skip(1).peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '\n' => is_comment = false,
            _ if is_comment => continue,
            '"' => is_text = !is_text,
            _ if is_text => {}
            '/' if letters.peek() == Some(&'/') => {
                is_comment = true;
                continue;
            }
            '[' | '(' | '{' => deep += 1,
            ',' | ']' if deep == 0 => {
                cells.push(cell.split_whitespace().collect::<Vec<_>>().join(" "));
                cell.clear();
                if letter == ']' {
                    break;
                }
                continue;
            }
            ']' | ')' | '}' => deep -= 1,
            _ => {}
        }
        cell.push(letter);
    }
    cells
}
