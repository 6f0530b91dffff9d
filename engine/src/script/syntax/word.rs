//! The words that begin an item, and where they do.

use std::cell::RefCell;

use rhai::{Engine, Token};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Word {
    Rule,
    Revise,
    On,
    Class,
    Property,
    Table,
    Without,
}

impl Word {
    pub(crate) const ALL: [Self; 7] =
        [Self::Rule, Self::Revise, Self::On, Self::Class, Self::Property, Self::Table, Self::Without];

    pub(crate) fn of(text: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|word| word.as_str() == text)
    }

    pub(crate) const fn as_str(self) -> &'static str {
        match self {
            Self::Rule => "rule",
            Self::Revise => "revise",
            Self::On => "on",
            Self::Class => "class",
            Self::Property => "property",
            Self::Table => "table",
            Self::Without => "without",
        }
    }

    /// How the parser knows it where it begins an item. No name in a file is written like this.
    pub(super) const fn key(self) -> &'static str {
        match self {
            Self::Rule => "rule:",
            Self::Revise => "revise:",
            Self::On => "on:",
            Self::Class => "class:",
            Self::Property => "property:",
            Self::Table => "table:",
            Self::Without => "without:",
        }
    }
}

pub(crate) fn starts_item(line: &str) -> bool {
    let end = line.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(line.len());
    Word::of(&line[..end]).is_some() && line[end..].starts_with([' ', '\t'])
}

/// What the last token leaves behind for the next one.
#[derive(Debug, Default)]
struct Before {
    line: usize,
    /// Whether an item may follow on the same line.
    ended: bool,
    open: Vec<Bracket>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Bracket {
    Brace,
    Other,
}

thread_local! {
    static BEFORE: RefCell<Before> = RefCell::new(Before::default());
}

pub(crate) fn start_file() {
    BEFORE.set(Before::default());
}

/// Makes the words begin items where items may stand; everywhere else they are names: `lamp.on`,
/// `each table in TABLES`.
pub(super) fn register(engine: &mut Engine) {
    #[allow(deprecated)] // rhai calls it volatile, not deprecated; the specification tests would notice.
    engine.on_parse_token(|token, position, _| {
        BEFORE.with_borrow_mut(|before| {
            let line = position.line().unwrap_or(0);
            let begins = line != before.line || before.ended;
            let inside = before.open.last().copied();
            before.see(&token, line);
            // In braces no item may stand; rules are seen there, to be refused.
            let may_stand = |word: &Word| match inside {
                None => true,
                Some(Bracket::Brace) => matches!(word, Word::Rule | Word::Revise),
                Some(Bracket::Other) => false,
            };
            match &token {
                Token::Identifier(name) if begins => Word::of(name)
                    .filter(may_stand)
                    .map_or(token, |word| Token::Identifier(Box::new(word.key().into()))),
                _ => token,
            }
        })
    });
}

impl Before {
    fn see(&mut self, token: &Token, line: usize) {
        match token {
            Token::LeftBrace => self.open.push(Bracket::Brace),
            Token::LeftParen | Token::LeftBracket | Token::MapStart => self.open.push(Bracket::Other),
            Token::RightBrace | Token::RightParen | Token::RightBracket => {
                self.open.pop();
            }
            _ => {}
        }
        self.line = line;
        self.ended = matches!(token, Token::LeftBrace | Token::RightBrace | Token::SemiColon);
    }
}
