//! From a file's text to its items.

mod declared;
mod item;
mod rule;
mod table;

use std::collections::BTreeMap;
use std::sync::Arc;

use rhai::{AST, ASTFlags, Engine, Expr, ParseErrorType, Position, Stmt};

use super::reaction::told_by_functions;
use super::source::{MAX_FILE_BYTES, SourceFile};
use super::syntax::{Word, start_file};
use crate::declared::build::{ClassItem, PropertyItem};
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{Constant, FileScope, Rule};
use crate::value::Cell;

/// A rule whose names are not looked up yet, with what its version rests on: its own text, and what is outside of
/// all items of its file.
#[derive(Debug)]
pub(crate) struct Draft {
    pub(crate) rule: Rule,
    pub(crate) text: String,
    pub(crate) outside: Arc<str>,
}

/// What stands in a file.
#[derive(Debug, Default)]
pub(crate) struct Read {
    pub(crate) drafts: Vec<Draft>,
    pub(crate) classes: Vec<ClassItem>,
    pub(crate) properties: Vec<PropertyItem>,
    pub(crate) problems: Vec<Diagnostic>,
}

/// The items of a file, and what is wrong with its syntax. Reading stops at the first error of syntax.
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
    start_file();
    let ast = match reader.compile(source.text()) {
        Ok(ast) => ast,
        Err(error) => {
            let message = syntax_message(error.err_type());
            let place = source.place(error.position());
            return Read {
                problems: vec![Diagnostic::error(Code::Syntax, &place, message)],
                ..Read::default()
            };
        }
    };
    let mut problems = vec![];
    let file = Arc::new(scope(source, &ast, &mut problems));
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
    let mut read = Read::default();
    for (item, &(start, end)) in items.iter().zip(&texts) {
        let text = source.text()[start..end].to_owned();
        match item.word() {
            Word::Class => read.classes.extend(declared::class(item, text, &file)),
            Word::Property => read.properties.extend(declared::property(item, text, &file)),
            Word::Rule | Word::Revise | Word::On | Word::Table => {
                let rule = rule::rule(item, &file, &mut problems);
                let outside = Arc::clone(&outside);
                read.drafts.extend(rule.map(|rule| Draft { rule, text, outside }));
            }
        }
    }
    read.problems = problems;
    read
}

fn syntax_message(error: &ParseErrorType) -> String {
    match error {
        ParseErrorType::Reserved(word) => {
            format!("`{word}` is a reserved word of the script language; use another name")
        }
        ParseErrorType::BadInput(error) => match error {
            rhai::LexError::ImproperSymbol(_, message) if !message.is_empty() => message.clone(),
            other => other.to_string(),
        },
        ParseErrorType::MissingSymbol(message) if message.contains("string") => {
            "the rule's name belongs here, in double quotes".to_owned()
        }
        ParseErrorType::UnexpectedEOF => "the file ends in the middle of a rule".to_owned(),
        other => other.to_string(),
    }
}

fn scope(source: &SourceFile, ast: &AST, problems: &mut Vec<Diagnostic>) -> FileScope {
    let mut constants = BTreeMap::new();
    for stmt in ast.statements() {
        match stmt {
            Stmt::Noop(_) => {}
            Stmt::Expr(expr) if matches!(**expr, Expr::Custom(..)) => {}
            Stmt::Var(var, flags, position) if flags.contains(ASTFlags::CONSTANT) => match constant(&var.1) {
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
                    "a rule file holds rules, revisions, reactions, functions and constants, nothing that runs by itself",
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

fn constant(expr: &Expr) -> Option<Constant> {
    Some(match expr {
        Expr::IntegerConstant(number, _) => Constant::Cell(Cell::Number(*number as f64)),
        Expr::FloatConstant(number, _) => Constant::Cell(Cell::number(**number)),
        Expr::BoolConstant(truth, _) => Constant::Cell(Cell::Truth(*truth)),
        Expr::StringConstant(text, _) => Constant::Text(text.to_string()),
        _ => return None,
    })
}

/// FNV-1a, 64 bits, folded to 32: eight hexadecimal digits.
pub(crate) fn version<'t>(parts: impl IntoIterator<Item = &'t str>) -> String {
    let hash = parts.into_iter().flat_map(str::bytes).fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    format!("{:08x}", (hash >> 32) ^ (hash & 0xffff_ffff))
}
