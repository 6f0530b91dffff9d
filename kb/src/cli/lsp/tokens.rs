//! A rule file as words, texts and marks, whatever state it is in: an editor's file is mostly half written.

use std::ops::Range;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Name,
    /// In quotes of any kind, which belong to it.
    Text,
    Number,
    Comment,
    /// One letter that is none of the above.
    Mark,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token<'t> {
    pub kind: Kind,
    pub text: &'t str,
    /// Its first byte in the file.
    pub start: usize,
}

impl Token<'_> {
    pub fn span(&self) -> Range<usize> {
        self.start..self.start + self.text.len()
    }

    pub fn is(&self, text: &str) -> bool {
        self.text == text && self.kind != Kind::Text
    }

    /// Of a text, what stands between its quotes.
    pub fn inside(&self) -> Range<usize> {
        let quote = &self.text[..1];
        let closed = self.text.len() > 1 && self.text.ends_with(quote);
        self.start + 1..self.start + self.text.len() - usize::from(closed)
    }
}

/// All that stands in a text but its blanks.
pub fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut found = Vec::new();
    let mut rest = 0;
    while let Some(first) = text[rest..].chars().next() {
        let (kind, length) = match first {
            blank if blank.is_whitespace() => {
                rest += blank.len_utf8();
                continue;
            }
            '/' if text[rest..].starts_with("//") => (Kind::Comment, until(&text[rest..], "\n", 0)),
            '/' if text[rest..].starts_with("/*") => (Kind::Comment, until(&text[rest..], "*/", 2)),
            '"' | '`' | '\'' => (Kind::Text, quoted(&text[rest..], first)),
            letter if letter.is_alphabetic() || letter == '_' => {
                (Kind::Name, while_so(&text[rest..], |letter| letter.is_alphanumeric() || letter == '_'))
            }
            digit if digit.is_ascii_digit() => (Kind::Number, number(&text[rest..])),
            mark => (Kind::Mark, mark.len_utf8()),
        };
        found.push(Token { kind, text: &text[rest..rest + length], start: rest });
        rest += length;
    }
    found
}

fn until(text: &str, end: &str, of_it: usize) -> usize {
    text.find(end).map_or(text.len(), |at| at + of_it)
}

fn while_so(text: &str, belongs: impl Fn(char) -> bool) -> usize {
    text.find(|letter| !belongs(letter)).unwrap_or(text.len())
}

/// `1.5` is a number; of `1..5`, `1` is one.
fn number(text: &str) -> usize {
    let belongs = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
    let whole = while_so(text, belongs);
    match text[whole..].strip_prefix('.') {
        Some(after) if after.starts_with(|letter: char| letter.is_ascii_digit()) => {
            whole + 1 + while_so(after, belongs)
        }
        _ => whole,
    }
}

/// A text that is not closed ends with its line, but for one in backticks.
fn quoted(text: &str, quote: char) -> usize {
    let mut is_escaped = false;
    for (at, letter) in text.char_indices().skip(1) {
        match letter {
            _ if is_escaped => is_escaped = false,
            '\\' if quote != '`' => is_escaped = true,
            '\n' if quote != '`' => return at,
            letter if letter == quote => return at + 1,
            _ => {}
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(text: &str) -> Vec<&str> {
        tokens(text).iter().map(|token| token.text).collect()
    }

    #[test]
    fn names_texts_numbers_and_marks_are_told_apart() {
        assert_eq!(
            texts(r#"rule "a \"b\"" each x in X where x.y>=1.5 // why"#),
            [
                "rule",
                r#""a \"b\"""#,
                "each",
                "x",
                "in",
                "X",
                "where",
                "x",
                ".",
                "y",
                ">",
                "=",
                "1.5",
                "// why"
            ]
        );
        assert_eq!(texts("between(1..5)"), ["between", "(", "1", ".", ".", "5", ")"]);
    }

    #[test]
    fn what_is_not_closed_ends_somewhere() {
        assert_eq!(texts("rule \"half\neach x"), ["rule", "\"half", "each", "x"]);
        assert_eq!(texts("/* never closed"), ["/* never closed"]);
        assert_eq!(texts("\""), ["\""]);
        assert_eq!(tokens("\"half")[0].inside(), 1..5);
        assert_eq!(tokens("\"\"")[0].inside(), 1..1);
        assert_eq!(tokens("\"")[0].inside(), 1..1);
    }
}
