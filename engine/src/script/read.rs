//! From a file's text to its rules.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use rhai::{AST, ASTFlags, CustomExpr, Engine, Expr, ParseErrorType, Position, Stmt, StmtBlock};

use super::names::property_of;
use super::reaction::{reaction, told_by_functions};
use super::resolve::resolve;
use super::source::{MAX_FILE_BYTES, SourceFile};
use super::syntax::{Quantifier, Shape, Slot};
use crate::diagnostic::{Code, Diagnostic};
use crate::rule::{Action, Clause, Constant, FileScope, Operator, Rule};
use crate::value::Cell;

/// The rules of a file, and all that is wrong with it. Reading stops at the first error of syntax.
pub(crate) fn read(
    source: &SourceFile,
    reader: &Engine,
    known: &BTreeSet<String>,
) -> (Vec<Rule>, Vec<Diagnostic>) {
    if source.text().len() > MAX_FILE_BYTES {
        let place = source.place(Position::START);
        let message = format!(
            "the file has {} bytes; rule files up to {MAX_FILE_BYTES} bytes are read",
            source.text().len()
        );
        return (vec![], vec![Diagnostic::error(Code::TooLarge, &place, message)]);
    }
    let ast = match reader.compile(source.text()) {
        Ok(ast) => ast,
        Err(error) => {
            let message = syntax_message(error.err_type());
            let place = source.place(error.position());
            return (vec![], vec![Diagnostic::error(Code::Syntax, &place, message)]);
        }
    };
    let mut problems = vec![];
    let file = Arc::new(scope(source, &ast, &mut problems));
    let items: Vec<Item> = ast
        .statements()
        .iter()
        .filter_map(|stmt| match stmt {
            Stmt::Expr(expr) => match &**expr {
                Expr::Custom(custom, _) => Some(items(custom)),
                _ => None,
            },
            _ => None,
        })
        .flatten()
        .collect();
    let texts = item_texts(source, &items);
    let outside = outside(source.text(), &texts);
    let mut rules = vec![];
    for (item, &(start, end)) in items.iter().zip(&texts) {
        let text = &source.text()[start..end];
        if let Some(rule) = rule(item, text, &outside, &file, known, &mut problems) {
            rules.push(rule);
        }
    }
    (rules, problems)
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

/// A rule or revision as the inputs of its custom syntax.
struct Item<'a> {
    inputs: Vec<(Slot, &'a Expr)>,
}

impl Item<'_> {
    fn name(&self) -> Option<(&str, Position)> {
        match self.inputs.first() {
            Some((_, Expr::StringConstant(name, position))) => Some((name.as_str(), *position)),
            _ => None,
        }
    }
}

fn items(custom: &CustomExpr) -> Vec<Item<'_>> {
    let Some(shape) = custom.state.clone().try_cast::<Shape>() else { return vec![] };
    let mut items: Vec<Item> = vec![];
    for (&slot, input) in shape.slots.iter().zip(&custom.inputs) {
        match slot {
            Slot::RuleName | Slot::RevisionName | Slot::ReactionName => {
                items.push(Item { inputs: vec![(slot, input)] });
            }
            _ => items.iter_mut().last().into_iter().for_each(|item| item.inputs.push((slot, input))),
        }
    }
    items
}

/// First and last byte of each item, from its keyword to the last thing before the next one.
fn item_texts(source: &SourceFile, items: &[Item]) -> Vec<(usize, usize)> {
    let text = source.text();
    let starts: Vec<usize> = items
        .iter()
        .map(|item| {
            let name = item.name().map_or(0, |(_, position)| source.place(position).span.0);
            let word = match item.inputs[0].0 {
                Slot::RuleName => "rule",
                Slot::ReactionName => "on",
                _ => "revise",
            };
            text[..name].rfind(word).unwrap_or(name)
        })
        .collect();
    let next = starts.iter().skip(1).copied().chain(std::iter::once(text.len()));
    let end = |item: &Item, next: usize| match item.inputs.last() {
        Some((Slot::Then | Slot::Else, Expr::Stmt(block))) => {
            (source.place(block.end_position()).span.0 + 1).min(next)
        }
        _ => next,
    };
    starts
        .iter()
        .zip(next)
        .zip(items)
        .map(|((&start, next), item)| {
            (start, start + without_trailing_comments(&text[start..end(item, next)]))
        })
        .collect()
}

/// Length of the text without the blank lines and comments at its end.
fn without_trailing_comments(text: &str) -> usize {
    let mut len = text.trim_end().len();
    while let Some(start) = text[..len].rfind('\n') {
        if !text[start..len].trim_start().starts_with("//") {
            break;
        }
        len = text[..start].trim_end().len();
    }
    len
}

fn outside(text: &str, items: &[(usize, usize)]) -> String {
    let mut rest = String::new();
    let mut from = 0;
    for &(start, end) in items {
        rest.push_str(&text[from..start]);
        from = end;
    }
    rest.push_str(&text[from..]);
    rest
}

fn rule(
    item: &Item,
    text: &str,
    outside: &str,
    file: &Arc<FileScope>,
    known: &BTreeSet<String>,
    problems: &mut Vec<Diagnostic>,
) -> Option<Rule> {
    let (name, position) = item.name()?;
    let clauses = clauses(item);
    let action = action(item, &clauses, file, problems)?;
    let priority = priority(item, file, problems);
    let hypothesis = hypothesis(item, &clauses, file, problems);
    let mut rule = Rule {
        name: name.to_owned(),
        position,
        line: file.source.place(position).line,
        version: String::new(),
        priority,
        clauses,
        action,
        reads: BTreeMap::new(),
        sets: BTreeMap::new(),
        hypothesis,
        file: Arc::clone(file),
    };
    let shared = resolve(&mut rule, known, problems);
    rule.version = version(text, if shared { outside } else { "" });
    Some(rule)
}

fn priority(item: &Item, file: &FileScope, problems: &mut Vec<Diagnostic>) -> i64 {
    let given = item.inputs.iter().find(|(slot, _)| *slot == Slot::Priority);
    match given {
        None => 0,
        Some((_, Expr::IntegerConstant(priority, _))) => *priority,
        Some((_, other)) => {
            let place = file.source.place(other.start_position());
            let message = "a priority is a whole number, as in `priority 10` or `priority -1`";
            problems.push(Diagnostic::error(Code::Syntax, &place, message));
            0
        }
    }
}

fn hypothesis(
    item: &Item,
    clauses: &[Clause],
    file: &FileScope,
    problems: &mut Vec<Diagnostic>,
) -> Option<(usize, String, Position)> {
    let (_, given) = item.inputs.iter().find(|(slot, _)| *slot == Slot::Hypothesis)?;
    let first = clauses.first()?;
    match property_of(given) {
        Some((variable, property, position))
            if variable == first.variable && first.quantifier == Quantifier::Each =>
        {
            Some((0, property.to_owned(), position))
        }
        _ => {
            let place = file.source.place(given.start_position());
            let message = "a hypothesis is a property of the object of the rule's first `each`";
            let help = format!("as in `hypothesis {}.reachable`", first.variable);
            problems.push(Diagnostic::error(Code::Hypothesis, &place, message).help(help));
            None
        }
    }
}

fn clauses(item: &Item) -> Vec<Clause> {
    let mut clauses: Vec<Clause> = vec![];
    let mut number = None;
    for (slot, input) in &item.inputs {
        match (slot, input) {
            (Slot::Variable(quantifier), Expr::Variable(variable, _, position)) => clauses.push(Clause {
                quantifier: *quantifier,
                position: *position,
                variable: variable.1.to_string(),
                class: String::new(),
                class_position: Position::NONE,
                by: None,
                condition: None,
                have: None,
                number: number.take(),
            }),
            (Slot::Number, Expr::Variable(name, _, position)) => {
                number = Some((name.1.to_string(), *position));
            }
            (Slot::Class, Expr::Variable(class, _, position)) => {
                if let Some(clause) = clauses.last_mut() {
                    clause.class = class.1.to_string();
                    clause.class_position = *position;
                }
            }
            (slot, expr) => {
                let Some(clause) = clauses.last_mut() else { continue };
                match slot {
                    Slot::By => clause.by = Some((*expr).clone()),
                    Slot::Where => clause.condition = Some((*expr).clone()),
                    Slot::Have => clause.have = Some((*expr).clone()),
                    _ => {}
                }
            }
        }
    }
    clauses
}

fn action(
    item: &Item,
    clauses: &[Clause],
    file: &FileScope,
    problems: &mut Vec<Diagnostic>,
) -> Option<Action> {
    let block = |wanted: Slot| {
        item.inputs.iter().find_map(|(slot, input)| match input {
            Expr::Stmt(block) if *slot == wanted => Some(block.clone()),
            _ => None,
        })
    };
    let input = |wanted: Slot| item.inputs.iter().find(|(slot, _)| *slot == wanted).map(|(_, input)| *input);
    if let Some(then) = block(Slot::Then) {
        if item.inputs[0].0 == Slot::ReactionName {
            return Some(reaction(*then, clauses));
        }
        return Some(Action::Conclude { then, otherwise: block(Slot::Else) });
    }
    if input(Slot::Hypothesis).is_some() {
        return Some(Action::Conclude { then: Box::new(StmtBlock::NONE), otherwise: None });
    }
    let target = input(Slot::Target)?;
    let Some((index, property, position)) = property_of(target).and_then(|(variable, property, position)| {
        let index = clauses.iter().position(|clause| clause.variable == variable)?;
        Some((index, property.to_owned(), position))
    }) else {
        let place = file.source.place(target.start_position());
        let message = "a revision sets one property of one of its variables, as in `set door.hardness`";
        problems.push(Diagnostic::error(Code::Assignment, &place, message));
        return None;
    };
    let operator = match input(Slot::Operator)? {
        Expr::StringConstant(sign, _) => match sign.as_str() {
            "*" => Operator::Times,
            "+" => Operator::Plus,
            _ => Operator::Minus,
        },
        Expr::Variable(name, ..) if name.1.as_str() == "max" => Operator::Max,
        _ => Operator::Min,
    };
    let level = match input(Slot::Level) {
        Some(Expr::IntegerConstant(level, _)) => *level,
        _ => 0,
    };
    Some(Action::Revise {
        target: (index, property),
        operator,
        amount: input(Slot::Amount)?.clone(),
        level,
        position,
    })
}

/// FNV-1a, 64 bits, folded to 32: eight hexadecimal digits.
fn version(text: &str, shared: &str) -> String {
    let hash = text.bytes().chain(shared.bytes()).fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    format!("{:08x}", (hash >> 32) ^ (hash & 0xffff_ffff))
}
