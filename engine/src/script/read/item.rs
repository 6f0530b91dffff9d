//! The items of a file: their inputs, and their texts.

use rhai::{CustomExpr, Expr, Position};

use crate::script::source::SourceFile;
use crate::script::syntax::{Shape, Slot, Word};

pub(super) struct Item<'a> {
    pub(super) inputs: Vec<(Slot, &'a Expr)>,
}

impl Item<'_> {
    pub(super) fn word(&self) -> Word {
        match self.inputs.first() {
            Some((Slot::Name(word), _)) => *word,
            _ => Word::Rule,
        }
    }

    pub(super) fn name(&self) -> Option<(&str, Position)> {
        text(self.inputs.first()?.1)
    }

    pub(super) fn input(&self, wanted: Slot) -> Option<&Expr> {
        self.inputs.iter().find(|(slot, _)| *slot == wanted).map(|(_, input)| *input)
    }

    /// The first input of a kind, if it is a name, a text or a word.
    pub(super) fn text(&self, wanted: Slot) -> Option<(&str, Position)> {
        text(self.input(wanted)?)
    }
}

/// A name, a text or a word, and its place.
pub(super) fn text(expr: &Expr) -> Option<(&str, Position)> {
    match expr {
        Expr::StringConstant(text, position) => Some((text.as_str(), *position)),
        Expr::Variable(variable, _, position) => Some((variable.1.as_str(), *position)),
        _ => None,
    }
}

pub(super) fn items(custom: &CustomExpr) -> Vec<Item<'_>> {
    let Some(shape) = custom.state.clone().try_cast::<Shape>() else { return vec![] };
    let mut items: Vec<Item> = vec![];
    for (&slot, input) in shape.slots.iter().zip(&custom.inputs) {
        match slot {
            Slot::Name(_) => items.push(Item { inputs: vec![(slot, input)] }),
            _ => items.iter_mut().last().into_iter().for_each(|item| item.inputs.push((slot, input))),
        }
    }
    items
}

/// First and last byte of each item, from its keyword to the last thing before the next one.
pub(super) fn item_texts(source: &SourceFile, items: &[Item]) -> Vec<(usize, usize)> {
    let text = source.text();
    let starts: Vec<usize> = items
        .iter()
        .map(|item| {
            let name = item.name().map_or(0, |(_, position)| source.place(position).span.0);
            let word = item.word().as_str();
            text[..name].rfind(word).unwrap_or(name)
        })
        .collect();
    let next = starts.iter().skip(1).copied().chain(std::iter::once(text.len()));
    let end = |item: &Item, start: usize, next: usize| match item.inputs.last() {
        Some((Slot::Then | Slot::Else, Expr::Stmt(block))) => {
            (source.place(block.end_position()).span.0 + 1).min(next)
        }
        _ => start_of_others(text, start, next),
    };
    starts
        .iter()
        .zip(next)
        .zip(items)
        .map(|((&start, next), item)| {
            (start, start + without_trailing_comments(&text[start..end(item, start, next)]))
        })
        .collect()
}

/// Where, in a stretch of text that begins with an item, functions and constants of the file follow.
fn start_of_others(text: &str, start: usize, end: usize) -> usize {
    let other =
        |line: &str| ["fn ", "const ", "private "].iter().any(|word| line.trim_start().starts_with(word));
    let mut at = start;
    for line in text[start..end].split_inclusive('\n') {
        if other(line) {
            return at;
        }
        at += line.len();
    }
    end
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

pub(super) fn outside(text: &str, items: &[(usize, usize)]) -> String {
    let mut rest = String::new();
    let mut from = 0;
    for &(start, end) in items {
        rest.push_str(&text[from..start]);
        from = end;
    }
    rest.push_str(&text[from..]);
    rest
}
