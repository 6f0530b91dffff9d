//! From an item's inputs to a declaration.

use std::sync::Arc;

use rhai::Expr;

use super::item::{Item, text};
use crate::declared::build::{ClassItem, PropertyItem};
use crate::declared::{Link, Source};
use crate::rule::FileScope;
use crate::script::syntax::Slot;

pub(super) fn class(item: &Item, written: String, file: &Arc<FileScope>) -> Option<ClassItem> {
    let (name, position) = item.name()?;
    let (parent, parent_position) = item.text(Slot::Parent)?;
    Some(ClassItem {
        name: name.to_owned(),
        position,
        parent: parent.to_owned(),
        parent_position,
        condition: item.input(Slot::Where)?.clone(),
        text: written,
        file: Arc::clone(file),
    })
}

pub(super) fn property(item: &Item, written: &str, file: &Arc<FileScope>) -> Option<PropertyItem> {
    let (class, class_position) = item.name()?;
    let (property, position) = item.text(Slot::Declared)?;
    let key = item.text(Slot::LinkKey).map(|(key, position)| (key.to_owned(), position));
    let link = item.text(Slot::LinkClass).map(|(class, class_position)| Link {
        class: class.to_owned(),
        class_position,
        key,
        position,
        signature: written.to_owned(),
        file: Arc::clone(file),
    });
    let default = item.input(Slot::Default).cloned();
    let sources = item.inputs.iter().filter_map(|(slot, input)| source(*slot, input, written)).collect();
    Some(PropertyItem {
        class: class.to_owned(),
        class_position,
        property: property.to_owned(),
        position,
        link,
        sources,
        default,
        file: Arc::clone(file),
    })
}

fn source(slot: Slot, input: &Expr, written: &str) -> Option<Source> {
    match (slot, text(input)) {
        (Slot::Source, Some(("table", _))) => Some(Source::Table),
        (Slot::Source, Some(("planner", _))) => Some(Source::Planner),
        (Slot::Source, _) => Some(Source::Rule),
        (Slot::Ask, Some((question, _))) => Some(Source::Ask(question.to_owned())),
        (Slot::Default, _) => Some(Source::Default(default_text(written))),
        _ => None,
    }
}

/// What stands after `default`, up to the next source.
fn default_text(written: &str) -> String {
    let after = written.split_once("default").map_or("", |(_, after)| after);
    let end = after.rfind(", ask").unwrap_or(after.len());
    after[..end].trim().trim_end_matches(';').trim_end().to_owned()
}
