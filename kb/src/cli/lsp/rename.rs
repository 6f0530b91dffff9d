//! Another name for something, in all the places where it stands.

use std::path::Path;

use super::library::{File, Library};
use super::occurrences::{Named, Occurrence, Role};
use super::vocabulary::Vocabulary;

/// The places to write the new name into, or why that cannot be.
pub fn places<'l>(
    library: &'l Library,
    vocabulary: &Vocabulary,
    (named, file): (&'l Named, &'l Path),
    new: &str,
) -> Result<Vec<(&'l File, &'l Occurrence)>, String> {
    check_name(named, new)?;
    if let Named::Property(class, property) = named {
        if vocabulary.is_given(class, property) {
            return Err(format!(
                "{class}.{property} comes from a table or the map: rules cannot name it otherwise"
            ));
        }
        let known = vocabulary.is_given(class, new) || library.properties(class).contains_key(new);
        if known {
            return Err(format!("{class} has a property {new} already"));
        }
    }
    if let Named::Class(class) = named
        && !library.classes.parents.contains_key(class)
    {
        return Err(format!("{class} is a table or comes from the map: rules cannot name it otherwise"));
    }
    let found: Vec<_> = library.all(named, file).collect();
    if let Named::Rule(name) = named {
        let beneath = found.iter().any(|(file, found)| !file.is_own && found.role == Role::Declared);
        let own = found.iter().any(|(file, found)| file.is_own && found.role == Role::Declared);
        if beneath && own {
            return Err(format!(
                "\"{name}\" replaces the rule of its name beneath: under another name both would count"
            ));
        }
    }
    if let Some((file, _)) = found.iter().find(|(file, _)| !file.is_own) {
        let name = file.path.file_name().unwrap_or_default().to_string_lossy();
        return Err(format!("it stands in {name}, which goes with the program and cannot be written"));
    }
    Ok(found)
}

fn check_name(named: &Named, new: &str) -> Result<(), String> {
    if let Named::Rule(_) = named {
        let fits = !new.trim().is_empty() && !new.contains(['"', '\\', '\n']);
        return if fits {
            Ok(())
        } else {
            Err("the name of a rule is a text in one line without quotes".to_owned())
        };
    }
    let fits = new.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_')
        && new.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_');
    if fits { Ok(()) } else { Err(format!("`{new}` is no name: letters a to z, digits and _ only")) }
}
