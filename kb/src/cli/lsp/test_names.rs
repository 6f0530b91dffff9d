//! Where tests of rules name classes and their properties.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::occurrences::{Named, Names, Occurrence, Role};

/// The keys that objects stand below by their class: `[given]`, `tell`, `add`, `remove`, `conclude`.
const OBJECTS: [&str; 5] = ["given", "tell", "add", "remove", "conclude"];

/// Reads a file of tests as far as it is whole.
pub fn names(text: &str) -> Names {
    let mut occurrences = Vec::new();
    let (parsed, _) = DeTable::parse_recoverable(text);
    below(parsed.get_ref(), &mut occurrences);
    occurrences.sort_by_key(|occurrence: &Occurrence| occurrence.span.start);
    Names { items: Vec::new(), occurrences }
}

fn below(table: &DeTable<'_>, found: &mut Vec<Occurrence>) {
    for (key, value) in table {
        let is_objects = OBJECTS.contains(&key.get_ref().as_ref());
        match value.get_ref() {
            DeValue::Table(inside) if is_objects => inside.iter().for_each(|class| objects(class, found)),
            DeValue::Table(inside) => below(inside, found),
            DeValue::Array(parts) => {
                for part in parts {
                    if let DeValue::Table(inside) = part.get_ref() {
                        below(inside, found);
                    }
                }
            }
            _ => {}
        }
    }
}

type Entry<'e, 't> = (&'e Spanned<std::borrow::Cow<'t, str>>, &'e Spanned<DeValue<'t>>);

/// `CLASS = [{ property = … }]`, or `CLASS.key = { property = … }`.
fn objects((class, value): Entry<'_, '_>, found: &mut Vec<Occurrence>) {
    let name = class.get_ref().to_string();
    found.push(Occurrence { named: Named::Class(name.clone()), role: Role::Used, span: class.span() });
    let mut object = |table: &DeTable<'_>| {
        found.extend(table.iter().map(|(property, _)| Occurrence {
            named: Named::Property(name.clone(), property.get_ref().to_string()),
            role: Role::Used,
            span: property.span(),
        }));
    };
    match value.get_ref() {
        DeValue::Array(rows) => rows.iter().for_each(|row| {
            if let DeValue::Table(row) = row.get_ref() {
                object(row);
            }
        }),
        DeValue::Table(keys) => keys.iter().for_each(|(_, row)| {
            if let DeValue::Table(row) = row.get_ref() {
                object(row);
            }
        }),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn properties_are_found_in_what_is_given_told_and_concluded() {
        let text = "[given]\nROBOTS = [{ robot = \"r\", hardness = 1.0 }]\n[[test]]\nname = \"t\"\n[test.conclude]\n\
                    ROOMS.1 = { hardness = 1.0 }\n[[test.then]]\ntell.ROBOTS.\"r/S\".hardness = 2.5\n";
        let found = names(text).occurrences;
        let hardness = |class: &str| {
            let named = Named::Property(class.to_owned(), "hardness".to_owned());
            found.iter().filter(|one| one.named == named && text[one.span.clone()] == *"hardness").count()
        };
        assert_eq!((hardness("ROBOTS"), hardness("ROOMS")), (2, 1));
        names("[given\nROOMS = [{ a = ");
    }
}
