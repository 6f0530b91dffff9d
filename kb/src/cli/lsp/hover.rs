//! What a word means.

use std::fmt::Write;

use super::library::{File, Library};
use super::occurrences::{Named, Occurrence};
use super::vocabulary::{Vocabulary, called, manual};

/// What stands at a name, in Markdown.
pub fn of_name(library: &Library, vocabulary: &Vocabulary, file: &File, found: &Occurrence) -> String {
    match &found.named {
        Named::Rule(name) => {
            let declared: Vec<String> = library
                .files
                .iter()
                .flat_map(|file| file.names.items.iter().map(move |item| (file, item)))
                .filter(|(_, item)| item.name == *name && item.word != "without")
                .map(|(file, item)| format!("- {} in `{}`", item.word, called_file(file)))
                .collect();
            let replaced = if declared.len() > 1 { "\n\nThe uppermost of its name counts." } else { "" };
            format!("**\"{name}\"**\n\n{}{replaced}", declared.join("\n"))
        }
        Named::Class(class) => of_class(library, vocabulary, class),
        Named::Property(class, property) => of_property(library, vocabulary, class, property),
        Named::Variable(begin, name) => {
            let item = file.names.items.iter().find(|item| item.span.start == *begin);
            match item.and_then(|item| item.variables.get(name)) {
                Some(class) => format!("`{name}`: an object of\n\n{}", of_class(library, vocabulary, class)),
                None => format!("`{name}`: a number that a clause gives"),
            }
        }
        Named::Own(name) => {
            let declared = file.names.items.iter().find(|item| item.name == *name);
            let line = declared.map_or(name.as_str(), |item| {
                file.text[item.span.clone()].lines().next().unwrap_or_default()
            });
            format!("```rhai\n{line}\n```")
        }
    }
}

/// What a word of the language or one of its functions means.
pub fn of_word(word: &str) -> Option<String> {
    if let Some((what, example)) = manual().of_word(word) {
        return Some(format!("`{word}`: {}", with_example(what, example)));
    }
    manual().of_function(word).map(|what| format!("`{word}`: {what}"))
}

/// What a word is for, and how it looks where a line shows that.
pub fn with_example(what: &str, example: &str) -> String {
    if example.is_empty() { what.to_owned() } else { format!("{what}\n```rhai\n{example}\n```") }
}

fn of_class(library: &Library, vocabulary: &Vocabulary, class: &str) -> String {
    let root = library.classes.root(class);
    let mut said = format!("**{class}**");
    if root != class {
        write!(said, ": those of {root} that pass a condition").ok();
    }
    if let Some(what) = manual().of_class(root).filter(|what| !what.is_empty()) {
        write!(said, "\n\n{what}").ok();
    }
    let mut all: Vec<&str> = vocabulary.given(root).map(|(property, _)| property).collect();
    all.extend(library.properties(root).into_keys());
    all.sort_unstable();
    all.dedup();
    if !all.is_empty() {
        let listed: Vec<String> = all.iter().map(|property| format!("`{property}`")).collect();
        write!(said, "\n\n{}", listed.join(", ")).ok();
    }
    said
}

fn of_property(library: &Library, vocabulary: &Vocabulary, class: &str, property: &str) -> String {
    let mut said = format!("**{class}.{property}**");
    if let Some(kind) = vocabulary.kind(class, property) {
        write!(said, ": {}", called(kind)).ok();
    }
    if let Some(what) = manual().of(class, property) {
        write!(said, "\n\n{what}").ok();
    }
    let named = Named::Property(class.to_owned(), property.to_owned());
    for (file, item) in library.setting(&named) {
        write!(said, "\n- set by {} \"{}\" in `{}`", item.word, item.name, called_file(file)).ok();
    }
    said
}

/// A file as people call it: beneath, the shipped ones.
fn called_file(file: &File) -> String {
    let name = file.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    if file.is_own { name } else { format!("{name}, which goes with the program") }
}
