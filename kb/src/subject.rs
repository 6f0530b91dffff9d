//! What a question is about: `door 7`, `room d`, `doors.7`, `doors.7.hardness`.

use adit_db::Tx;
use adit_db::cell::Cell;

use crate::error::{Error, Result};
use crate::suggest::did_you_mean;

/// An object of a table or class, perhaps one property of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Subject {
    /// The table, or the class in small letters.
    pub class: String,
    /// The object's key.
    pub key: String,
    /// The property, where one is named.
    pub property: Option<String>,
    /// As people call it: `door 7`, `room d`, `robots robot/SQUAT`.
    pub name: String,
}

impl Subject {
    /// Finds out what a text means; an object that is not there is an error.
    pub fn find(tx: &mut Tx<'_>, text: &str) -> Result<Self> {
        if let Some((kind, name)) = text.trim().split_once(' ')
            && let Some(class) = ["doors", "rooms"].into_iter().find(|class| is_called(class, kind))
        {
            return Self::of(tx, class, name.trim(), None)?.ok_or_else(|| unknown(tx, class, name));
        }
        let Some((class, rest)) = text.trim().split_once('.') else {
            let message = format!("`{text}` names no object");
            let help = "say `door 7`, `room d`, `doors.7` or `doors.7.hardness`".to_owned();
            return Err(Error::said("why/unknown", message, Some(help)));
        };
        let class = class.to_lowercase();
        if let Some(found) = Self::of(tx, &class, rest, None)? {
            return Ok(found);
        }
        let (key, property) = rest.rsplit_once('.').unwrap_or((rest, ""));
        let property = Some(property).filter(|property| !property.is_empty()).map(str::to_owned);
        Self::of(tx, &class, key, property)?.ok_or_else(|| unknown(tx, &class, key))
    }

    fn of(tx: &mut Tx<'_>, class: &str, key: &str, property: Option<String>) -> Result<Option<Self>> {
        let found = |key: String, name: String| Self { class: class.to_owned(), key, property, name };
        Ok(match class {
            "rooms" => tx
                .rooms()?
                .into_iter()
                .find(|room| room.name == key || room.room.to_string() == key)
                .map(|room| found(room.room.to_string(), format!("room {}", room.name))),
            "doors" => tx
                .doors()?
                .into_iter()
                .find(|door| door.door.to_string() == key)
                .map(|door| found(door.door.to_string(), format!("door {}", door.door))),
            _ => {
                let concluded = !tx.conclusions(class, &Cell::from(key))?.is_empty()
                    || key.parse::<i64>().is_ok_and(|key| {
                        tx.conclusions(class, &Cell::Integer(key)).is_ok_and(|found| !found.is_empty())
                    });
                concluded.then(|| found(key.to_owned(), format!("{class} {key}")))
            }
        })
    }

    /// The key as the database holds it.
    pub fn cell(&self) -> Cell {
        match self.key.parse() {
            Ok(number) if ["rooms", "doors", "prime_areas"].contains(&self.class.as_str()) => {
                Cell::Integer(number)
            }
            _ => Cell::from(self.key.as_str()),
        }
    }
}

/// `door` and `doors` both mean the table.
fn is_called(class: &str, kind: &str) -> bool {
    let kind = kind.to_lowercase();
    kind == class || format!("{kind}s") == class
}

fn unknown(tx: &mut Tx<'_>, class: &str, key: &str) -> Error {
    let names: Vec<String> = match class {
        "rooms" => tx.rooms().map_or(vec![], |rooms| rooms.into_iter().map(|room| room.name).collect()),
        "doors" => {
            tx.doors().map_or(vec![], |doors| doors.iter().map(|door| door.door.to_string()).collect())
        }
        _ => vec![],
    };
    let help = match names.len() {
        0 => None,
        all if class == "doors" => Some(format!("there are {all} doors, numbered from 1")),
        _ => did_you_mean(key, names.iter().map(String::as_str)),
    };
    Error::said("why/unknown", format!("nothing is concluded about {class} {key}"), help)
}
