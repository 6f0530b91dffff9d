//! What may stand where one types.

use std::collections::BTreeMap;

use lsp_types::{CompletionItem, CompletionItemKind, Documentation, MarkupContent, MarkupKind};

use super::hover::with_example;
use super::library::{File, Library};
use super::occurrences::{QUANTIFIERS, code};
use super::tokens::{Kind, Token, tokens};
use super::vocabulary::{Vocabulary, called, manual};

/// Proposals at a byte of a rule file.
pub fn complete(library: &Library, vocabulary: &Vocabulary, file: &File, byte: usize) -> Vec<CompletionItem> {
    let inside = tokens(&file.text).into_iter().any(|token| {
        let is_open = token.kind == Kind::Comment && byte == token.span().end;
        let is_prose = matches!(token.kind, Kind::Text | Kind::Comment);
        is_prose && (token.start < byte && byte < token.span().end || is_open)
    });
    if inside {
        return Vec::new();
    }
    let all = code(&file.text);
    let before: Vec<Token> = all.iter().take_while(|token| token.start < byte).copied().collect();
    // the word that is being written is no part of what it follows
    let written = before.last().filter(|last| last.kind == Kind::Name && last.span().end >= byte);
    let before = &before[..before.len() - usize::from(written.is_some())];
    let is = |back: usize, text: &str| {
        before.len().checked_sub(back).and_then(|at| before.get(at)).is_some_and(|token| token.is(text))
    };
    if is(1, ".") {
        return field(library, vocabulary, file, before, byte);
    }
    let subject = library.item(&file.path, byte).filter(|item| item.span.start < byte);
    if is(1, "in") || is(1, "names") || is(1, "of") && is(3, "class") || is(1, "property") {
        return classes(library, vocabulary);
    }
    let mut found: BTreeMap<String, CompletionItem> = BTreeMap::new();
    let mut add = |item: CompletionItem| {
        found.entry(item.label.clone()).or_insert(item);
    };
    if let Some(item) = subject {
        for (variable, class) in &item.variables {
            let what = manual().of_class(class).map(str::to_owned);
            add(proposal(variable, CompletionItemKind::VARIABLE, Some(class.clone()), what));
        }
        if item.word == "class" {
            let root = library.classes.root(&item.name).to_owned();
            properties(library, vocabulary, &root).into_iter().for_each(&mut add);
        }
    }
    for word in manual()
        .words()
        .chain(QUANTIFIERS)
        .chain(["where", "then", "by", "have", "given", "set", "rows", "level"])
    {
        let (what, example) = manual().of_word(word).unwrap_or_default();
        let what = (!what.is_empty()).then(|| with_example(what, example));
        add(proposal(word, CompletionItemKind::KEYWORD, None, what));
    }
    for (name, what) in manual().functions() {
        add(proposal(name, CompletionItemKind::FUNCTION, None, Some(what.to_owned())));
    }
    for occurrence in &file.names.occurrences {
        if let super::occurrences::Named::Own(name) = &occurrence.named {
            add(proposal(name, CompletionItemKind::FUNCTION, Some("of this file".to_owned()), None));
        }
    }
    found.into_values().collect()
}

/// What may follow `variable.`, `variable.link.`, or `property CLASS.`.
fn field(
    library: &Library,
    vocabulary: &Vocabulary,
    file: &File,
    before: &[Token],
    byte: usize,
) -> Vec<CompletionItem> {
    let mut chain: Vec<&str> = Vec::new();
    let mut at = before.len();
    while at >= 2 && before[at - 1].is(".") && before[at - 2].kind == Kind::Name {
        chain.insert(0, before[at - 2].text);
        at -= 2;
    }
    let Some((first, links)) = chain.split_first() else { return Vec::new() };
    let class = library
        .item(&file.path, byte)
        .and_then(|item| item.variables.get(*first))
        .map_or(*first, String::as_str);
    library.classes.along(class, links).map_or_else(Vec::new, |class| properties(library, vocabulary, class))
}

pub fn classes(library: &Library, vocabulary: &Vocabulary) -> Vec<CompletionItem> {
    let given =
        vocabulary.classes().into_iter().map(|class| (class, manual().of_class(class).map(str::to_owned)));
    let declared = library.classes.parents.iter();
    let declared =
        declared.map(|(class, parent)| (class.as_str(), Some(format!("{parent} that pass a condition"))));
    given
        .chain(declared)
        .map(|(class, what)| proposal(class, CompletionItemKind::CLASS, None, what))
        .collect()
}

pub fn properties(library: &Library, vocabulary: &Vocabulary, class: &str) -> Vec<CompletionItem> {
    let mut found: BTreeMap<&str, Option<&'static str>> = BTreeMap::new();
    for (property, kind) in vocabulary.given(class) {
        found.insert(property, kind.map(called));
    }
    for (property, is_set) in library.properties(class) {
        found.entry(property).or_insert(is_set.then_some("concluded by rules"));
    }
    found
        .into_iter()
        .map(|(property, detail)| {
            let what = manual().of(class, property).map(str::to_owned);
            proposal(property, CompletionItemKind::FIELD, detail.map(str::to_owned), what)
        })
        .collect()
}

fn proposal(
    label: &str,
    kind: CompletionItemKind,
    detail: Option<String>,
    what: Option<String>,
) -> CompletionItem {
    let documentation =
        what.map(|value| Documentation::MarkupContent(MarkupContent { kind: MarkupKind::Markdown, value }));
    CompletionItem {
        label: label.to_owned(),
        kind: Some(kind),
        detail,
        documentation,
        ..CompletionItem::default()
    }
}
