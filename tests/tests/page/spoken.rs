//! The texts of the program's own files that reach a person over the service, as they stand there.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// A text, and whether it is a help beside what is wrong: of these the page leaves out what only helps in a terminal.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Text {
    pub words: String,
    pub is_help: bool,
}

/// What may come to the page: all crates but for what is only printed, and what only programs read.
const FOLDERS: [&str; 4] = ["engine/src", "planners/src", "db/src", "kb/src"];
const NOT_SHOWN: [&str; 7] = [
    "db/src/postgres",
    "kb/src/adapt",
    "kb/src/cli",
    "kb/src/live/once.rs",
    "kb/src/main.rs",
    "kb/src/serve/meter.rs",
    "kb/src/serve/token.rs",
];

/// What is said before there is a service.
const BEFORE_IT_IS_SERVED: [&str; 2] =
    ["… has schema version …, not yet …", "a site in PostgreSQL is asked and edited through a service"];

/// The texts of each file, by its path.
pub fn texts(repository: &Path) -> BTreeMap<String, Vec<Text>> {
    let mut all = BTreeMap::new();
    for folder in FOLDERS {
        let mut files = Vec::new();
        rust_files(&repository.join(folder), &mut files);
        for file in files {
            let name = file.strip_prefix(repository).unwrap().display().to_string();
            let is_test = name.contains("/tests") || name.ends_with("tests.rs");
            if is_test || NOT_SHOWN.iter().any(|not| name.starts_with(not)) {
                continue;
            }
            let source = fs::read_to_string(&file).unwrap();
            let tokens: TokenStream = source.parse().unwrap_or_else(|error| panic!("{name}: {error}"));
            let mut found = Vec::new();
            walk(tokens, &mut Vec::new(), &mut found);
            if !found.is_empty() {
                all.insert(name, found);
            }
        }
    }
    all
}

fn rust_files(folder: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// So many words before a text say what it is.
const BEFORE: usize = 14;
const HELPS: [&str; 7] = ["help", "helped", "with_help", "Some", "then", "unwrap_or_else", "unwrap_or"];

fn walk(tokens: TokenStream, before: &mut Vec<String>, found: &mut Vec<Text>) {
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        match token {
            // an attribute, or a comment that documents; tests say what they like
            TokenTree::Punct(mark) if mark.as_char() == '#' => {
                if matches!(tokens.peek(), Some(TokenTree::Punct(mark)) if mark.as_char() == '!') {
                    tokens.next();
                }
                let Some(TokenTree::Group(of)) = tokens.next_if(is_attribute) else { continue };
                if of.stream().to_string().replace(' ', "") == "cfg(test)" {
                    let is_body = |token: &TokenTree| matches!(token, TokenTree::Group(of) if of.delimiter() == Delimiter::Brace);
                    let is_end =
                        |token: &TokenTree| matches!(token, TokenTree::Punct(mark) if mark.as_char() == ';');
                    while tokens.next_if(|token| !is_body(token) && !is_end(token)).is_some() {}
                    tokens.next();
                } else if let Some(words) = of.stream().to_string().strip_prefix("error") {
                    // what an error says stands in its attribute
                    walk(words.parse().unwrap_or_default(), before, found);
                }
            }
            TokenTree::Group(of) => {
                walk(of.stream(), before, found);
                if of.delimiter() == Delimiter::Brace {
                    before.clear();
                }
            }
            TokenTree::Punct(mark) if mark.as_char() == ';' => before.clear(),
            TokenTree::Ident(name) => before.push(name.to_string()),
            TokenTree::Literal(of) => {
                let is_said = |words: &String| !BEFORE_IT_IS_SERVED.iter().any(|not| words.starts_with(not));
                // said by a panic: to who mends the program, not on the page
                let is_panic = before.last().is_some_and(|word| word == "expect" || word == "expect_err");
                if let Some(words) = sentence(&of.to_string()).filter(is_said).filter(|_| !is_panic) {
                    let near = before.iter().rev().take(BEFORE);
                    let is_help = near.clone().any(|word| HELPS.contains(&word.as_str()));
                    found.push(Text { words, is_help });
                }
            }
            TokenTree::Punct(_) => {}
        }
    }
}

fn is_attribute(token: &TokenTree) -> bool {
    matches!(token, TokenTree::Group(of) if of.delimiter() == Delimiter::Bracket)
}

/// A literal as people read it, `…` where something is put in; `None` where it is no sentence.
fn sentence(literal: &str) -> Option<String> {
    let inner = literal.strip_prefix('"')?.strip_suffix('"')?;
    let mut text = String::new();
    let mut letters = inner.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '\\' => match letters.next()? {
                '\n' => while letters.next_if(|next| next.is_whitespace()).is_some() {},
                'n' | 't' => text.push(' '),
                other => text.push(other),
            },
            '{' if letters.peek() == Some(&'{') => text.push(letters.next()?),
            '{' => {
                for skipped in letters.by_ref() {
                    if skipped == '}' {
                        break;
                    }
                }
                text.push('…');
            }
            '}' => drop(letters.next()),
            other => text.push(other),
        }
    }
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let words = text.split(' ').filter(|word| word.chars().filter(|c| c.is_alphabetic()).count() > 1).count();
    let first = text.split([' ', '(']).next().unwrap_or_default();
    let is_sql = first.len() > 2 && first.chars().all(|c| c.is_ascii_uppercase()) && first != "SQL";
    let is_markup = text.contains("=\"") || text.starts_with('<') || text.contains("attributeName");
    (words >= 2 && !is_sql && !is_markup).then_some(text)
}
