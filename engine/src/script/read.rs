//! From a file's text to its items.

mod declared;
mod item;
mod rule;
mod table;

use std::collections::BTreeMap;
use std::sync::Arc;

use rhai::{AST, ASTFlags, Engine, Expr, ParseErrorType, Position, Stmt};

use super::open;
use super::reaction::told_by_functions;
use super::source::{MAX_FILE_BYTES, SourceFile};
use super::syntax::{Word, start_file, starts_item};
use crate::declared::build::{ClassItem, PropertyItem};
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{FileScope, Rule};
use crate::suggest::nearest;
use crate::table::plain;

/// A rule whose names are not looked up yet, with what its version rests on: its own text, and what is outside of
/// all items of its file.
#[derive(Debug)]
pub(crate) struct Draft {
    pub(crate) rule: Rule,
    pub(crate) text: String,
    pub(crate) outside: Arc<str>,
}

/// `without NAME`: a rule of a base beneath that is not to count.
#[derive(Debug)]
pub(crate) struct Without {
    pub(crate) name: String,
    pub(crate) position: Position,
    pub(crate) file: Arc<FileScope>,
}

#[derive(Debug, Default)]
pub(crate) struct Read {
    pub(crate) drafts: Vec<Draft>,
    pub(crate) classes: Vec<ClassItem>,
    pub(crate) properties: Vec<PropertyItem>,
    pub(crate) withouts: Vec<Without>,
    pub(crate) problems: Vec<Diagnostic>,
}

/// The items of a file, and what is wrong with its syntax. After an error the file is read on from the next line
/// that begins an item; what such a file holds is looked at for more errors only.
pub(crate) fn read(source: &SourceFile, reader: &Engine) -> Read {
    if source.text().len() > MAX_FILE_BYTES {
        let place = source.place(Position::START);
        let message = format!(
            "the file has {} bytes; rule files up to {MAX_FILE_BYTES} bytes are read",
            source.text().len()
        );
        return Read {
            problems: vec![Diagnostic::error(Code::TooLarge, &place, message)],
            ..Read::default()
        };
    }
    let mut read = Read::default();
    match compile(source, reader, &mut read.problems) {
        Some(ast) => items(source, &ast, &mut read),
        None => recover(source, reader, &mut read.problems),
    }
    read
}

fn compile(source: &SourceFile, reader: &Engine, problems: &mut Vec<Diagnostic>) -> Option<AST> {
    start_file();
    match reader.compile(source.text()) {
        Ok(ast) => Some(ast),
        Err(error) => {
            let message = syntax_message(error.err_type(), line_about(source.text(), error.position()));
            let opened = match error.err_type() {
                ParseErrorType::MissingToken(token, _) => open::bracket(source.text(), token),
                _ => None,
            };
            let place = source.place(opened.unwrap_or(error.position()));
            problems.push(Diagnostic::error(Code::Syntax, &place, message));
            None
        }
    }
}

const MAX_SYNTAX_ERRORS: usize = 20;

/// Reads what comes after an error, with blank lines before it so that places hold.
fn recover(source: &SourceFile, reader: &Engine, problems: &mut Vec<Diagnostic>) {
    let lines: Vec<&str> = source.text().split_inclusive('\n').collect();
    while problems.len() < MAX_SYNTAX_ERRORS {
        let Some(last) = problems.last().map(|problem| problem.line) else { return };
        let Some(next) = (last..lines.len()).find(|&line| starts_item(lines[line])) else { return };
        let rest = format!("{}{}", "\n".repeat(next), lines[next..].concat());
        let rest = SourceFile::new(source.name(), rest);
        let mut found = vec![];
        if compile(&rest, reader, &mut found).is_some() {
            return;
        }
        problems.extend(found.into_iter().map(|problem| problem.moved_to(source)));
    }
}

fn items(source: &SourceFile, ast: &AST, read: &mut Read) {
    let problems = &mut read.problems;
    let file = Arc::new(scope(source, ast, problems));
    problems.extend(crate::lint::unused::lint(&file));
    let items: Vec<item::Item> = ast
        .statements()
        .iter()
        .filter_map(|stmt| match stmt {
            Stmt::Expr(expr) => match &**expr {
                Expr::Custom(custom, _) => Some(item::items(custom)),
                _ => None,
            },
            _ => None,
        })
        .flatten()
        .collect();
    let texts = item::item_texts(source, &items);
    let outside: Arc<str> = item::outside(source.text(), &texts).into();
    for (item, &(start, end)) in items.iter().zip(&texts) {
        let text = source.text()[start..end].to_owned();
        match item.word() {
            Word::Class => read.classes.extend(declared::class(item, text, &file)),
            Word::Property => read.properties.extend(declared::property(item, &text, &file)),
            Word::Without => {
                let named = item.name().map(|(name, position)| (name.to_owned(), position));
                let without = |(name, position)| Without { name, position, file: Arc::clone(&file) };
                read.withouts.extend(named.map(without));
            }
            Word::Rule | Word::Revise | Word::On | Word::Table => {
                let rule = rule::rule(item, &file, problems);
                let outside = Arc::clone(&outside);
                read.drafts.extend(rule.map(|rule| Draft { rule, text, outside }));
            }
        }
    }
}

/// What stands before and after the place of an error in its line.
fn line_about(text: &str, position: rhai::Position) -> (&str, &str) {
    let line = position.line().and_then(|line| text.lines().nth(line.checked_sub(1)?)).unwrap_or_default();
    let column = position.position().unwrap_or(1) - 1;
    line.split_at(line.char_indices().nth(column).map_or(line.len(), |(at, _)| at))
}

/// What a slip of the pen is that makes what comes after it look wrong.
fn slip((before, after): (&str, &str)) -> Option<String> {
    let is_digit = |sign: Option<char>| sign.is_some_and(|sign| sign.is_ascii_digit());
    if after.starts_with(',') && is_digit(before.chars().last()) && is_digit(after.chars().nth(1)) {
        return Some("a number is written with a point, not with a comma".to_owned());
    }
    let condition =
        before.trim_end().strip_suffix("then").filter(|condition| condition.ends_with(' '))?.trim_end();
    let sign = ["&&", "||", "==", "!=", "<=", ">=", "**", "<", ">", "=", "+", "-", "*", "/", "%"];
    let sign = sign.into_iter().find(|sign| condition.ends_with(sign))?;
    Some(format!("the condition before `then` ends in `{sign}`: something belongs behind it, or it goes"))
}

fn syntax_message(error: &ParseErrorType, about: (&str, &str)) -> String {
    let before = about.0.split_whitespace().next().unwrap_or_default();
    match error {
        ParseErrorType::Reserved(word) if word.starts_with('#') => {
            "a comment begins with `//`, not with `#`".to_owned()
        }
        ParseErrorType::Reserved(word) => {
            format!("`{word}` is a reserved word of the script language; use another name")
        }
        ParseErrorType::BadInput(error) => match error {
            rhai::LexError::ImproperSymbol(_, message) if !message.is_empty() => {
                slip(about).unwrap_or_else(|| message.clone())
            }
            rhai::LexError::UnexpectedInput(text) if text.chars().all(is_curly_quote) => {
                format!("`{text}` cannot stand here: a text stands between straight double quotes, `\"`")
            }
            rhai::LexError::UnexpectedInput(text) => cannot_stand(text, about.0),
            other => other.to_string(),
        },
        ParseErrorType::MissingSymbol(message) if message.contains("string") => {
            "the rule's name belongs here, in double quotes".to_owned()
        }
        ParseErrorType::MissingToken(token, _) if token == ";" => match before {
            "each" | "some" | "least" | "most" | "none" => {
                format!("`{before}` belongs in a rule, which begins with `rule \"what it says\"`")
            }
            _ if about == ("", "") => "the file ends in the middle of a rule".to_owned(),
            _ if about.1.starts_with('"') && about.0.split_whitespace().count() == 1 => no_item(before),
            _ => slip(about).unwrap_or_else(|| {
                "a `;` belongs before this, to part it from the statement before".to_owned()
            }),
        },
        ParseErrorType::MissingToken(token, _) if token == "," => {
            "a `,` belongs before this, or the bracket before it is not closed".to_owned()
        }
        ParseErrorType::MissingToken(token, _)
            if token == "]" && about.1.starts_with(',') && before.starts_with('[') =>
        {
            "a `,` is missing before this row: rows are parted by commas".to_owned()
        }
        ParseErrorType::MissingToken(token, _) if matches!(token.as_str(), "}" | "]" | ")") => {
            let opened = match token.as_str() {
                "}" => "{",
                "]" => "[",
                _ => "(",
            };
            format!("a `{token}` is missing: what a `{opened}` has opened is not closed")
        }
        ParseErrorType::UnexpectedEOF => "the file ends in the middle of a rule".to_owned(),
        other => other.to_string(),
    }
}

/// That a sign is out of place, with how a cell of a table says it.
fn cannot_stand(sign: &str, before: &str) -> String {
    let cell = match sign {
        ">" => "above(10)",
        ">=" => "at_least(10)",
        "<" => "below(10)",
        "<=" => "at_most(10)",
        "!=" => "not(10)",
        _ => return format!("`{sign}` cannot stand here"),
    };
    if before.trim_end().ends_with(['[', ',']) {
        return format!("`{sign}` cannot stand here: a cell of a table says `{cell}`");
    }
    format!("`{sign}` cannot stand here")
}

/// That a word begins nothing that a rule file holds.
fn no_item(word: &str) -> String {
    let words = Word::ALL.map(Word::as_str);
    let help = match (word, nearest(word, words)) {
        ("hypothesis", _) => "a rule says it, behind its conditions: `hypothesis object.property`".to_owned(),
        ("first" | "unique" | "any" | "collect", _) => {
            format!("a table begins with `table`: `table \"what it says\" {word}`")
        }
        (_, Some(meant)) => format!("did you mean `{meant}`?"),
        _ => format!("it holds what begins with {} or fn", words.join(", ")),
    };
    format!("`{word}` begins nothing in a rule file: {help}")
}

/// Whether a sign is one of the quotes that text programs put in for straight ones.
fn is_curly_quote(sign: char) -> bool {
    matches!(sign, '“' | '”' | '„' | '‘' | '’' | '«' | '»')
}

fn scope(source: &SourceFile, ast: &AST, problems: &mut Vec<Diagnostic>) -> FileScope {
    let mut constants = BTreeMap::new();
    for stmt in ast.statements() {
        match stmt {
            Stmt::Noop(_) => {}
            Stmt::Expr(expr) if matches!(**expr, Expr::Custom(..)) => {}
            Stmt::Var(var, flags, position) if flags.contains(ASTFlags::CONSTANT) => match plain(&var.1) {
                Some(value) => {
                    constants.insert(var.0.name.to_string(), value);
                }
                None => problems.push(
                    Diagnostic::error(
                        Code::Statement,
                        &source.place(*position),
                        format!("the constant `{}` is not a plain value", var.0.name),
                    )
                    .help("a constant of a rule file is a number, a text, true or false"),
                ),
            },
            other => problems.push(
                Diagnostic::error(
                    Code::Statement,
                    &source.place(other.position()),
                    "a rule file holds rules, revisions, reactions, tables, classes, properties, functions, constants and what it goes \
                     without; nothing in it runs by itself",
                )
                .label("not one of them"),
            ),
        }
    }
    let function_names =
        ast.iter_functions().map(|function| (function.name.to_owned(), function.params.len())).collect();
    let functions = ast.shared_lib().clone();
    let tells = told_by_functions(&functions);
    FileScope { source: source.clone(), constants, functions, function_names, tells }
}

/// FNV-1a, 64 bits, folded to 32: eight hexadecimal digits.
pub(crate) fn version<'t>(parts: impl IntoIterator<Item = &'t str>) -> String {
    let hash = parts.into_iter().flat_map(str::bytes).fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    format!("{:08x}", (hash >> 32) ^ (hash & 0xffff_ffff))
}
