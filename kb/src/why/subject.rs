//! What a question is about: `door 7`, `room d`, `doors.7`, `doors.7.hardness`.

use adit_engine::Value;

use crate::error::{Code, Error, Result};
use crate::graph::Building;
use crate::state::State;
use crate::words::suggest::did_you_mean;

/// An object of a table or class, perhaps one property of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Subject {
    /// The class, in small letters: for most the name of a table.
    pub class: String,
    pub key: String,
    pub property: Option<String>,
    /// As people call it: `door 7`, `room d`, `robots robot/SQUAT`.
    pub name: String,
}

impl Subject {
    /// What a lane graph calls so: a door, a lift, a station, a node or a lane, by its key or its name. Numbers are those of several
    /// of them.
    fn of_lanes(fork: &State, text: &str) -> Option<Self> {
        if fork.courses.is_none() || text.parse::<f64>().is_ok() {
            return None;
        }
        let named = |class: &str| {
            let class = class.to_uppercase();
            let mut rows = 0..fork.knowledge.len(&class).unwrap_or(0);
            let is_it = |row: &usize| {
                let name = fork.knowledge.value_at(&class, *row, "name");
                name.is_some_and(|name| matches!(name, Value::Text(name) if *name == *text))
            };
            rows.find(is_it).and_then(|row| fork.knowledge.key(&class, row))
        };
        OF_LANES.into_iter().find_map(|class| {
            let found = Self::of(fork, class, text, None);
            let found = found.or_else(|| Self::of(fork, class, &named(class)?, None));
            found.map(|found| Self { name: text.to_owned(), ..found })
        })
    }

    /// Finds out what a text means; an object that is not there is an error.
    ///
    /// What the building has a name for comes first, as wherever a name is asked for: `room 1` is the space of that name,
    /// and not the first piece into which the floor is cut.
    pub fn find(fork: &State, text: &str) -> Result<Self> {
        if let Some(found) = Self::called(fork, text.trim()) {
            return Ok(found);
        }
        if let Some((kind, name)) = text.trim().split_once(' ')
            && let Some(class) =
                ["doors", "rooms", "doorways", "spaces"].into_iter().find(|class| is_called(class, kind))
        {
            let found =
                Self::of(fork, class, name.trim(), None).or_else(|| Self::of(fork, class, text.trim(), None));
            return found.ok_or_else(|| unknown(fork, class, name));
        }
        if let Some((kind, key)) = text.trim().split_once(' ') {
            // of a map that is not cut into rooms: `channel 3`, `goal load`
            let class = format!("{}s", kind.to_lowercase());
            let found = Self::of(fork, &class, key.trim(), None).filter(|_| fork.courses.is_some());
            if let Some(found) = found {
                return Ok(Self { name: text.trim().to_owned(), ..found });
            }
        }
        if let Some(found) = Self::of_lanes(fork, text.trim()) {
            return Ok(found);
        }
        let Some((class, rest)) = text.trim().split_once('.') else {
            let message = format!("`{text}` names no object");
            let named = fork.named();
            let help =
                did_you_mean(text.trim(), named.names().collect::<Vec<_>>().iter().map(String::as_str));
            let has_rooms = fork.site.site().has_rooms();
            let help = help.or_else(|| {
                (!has_rooms).then(|| "say class, object and property: `orders.2.total`".to_owned())
            });
            let help = help.unwrap_or_else(|| {
                "say what the building has a name for, or `door 7`, `room d`, `doors.7`, `doors.7.hardness`".to_owned()
            });
            return Err(Error::said(Code::WhyUnknown, message, Some(help)));
        };
        let class = class.to_lowercase();
        if let Some(found) = Self::of(fork, &class, rest, None) {
            return Ok(found);
        }
        let (key, property) = rest.rsplit_once('.').unwrap_or((rest, ""));
        let property = Some(property).filter(|property| !property.is_empty()).map(str::to_owned);
        Self::of(fork, &class, key, property).ok_or_else(|| unknown(fork, &class, key))
    }

    /// What the building has this name for.
    fn called(fork: &State, name: &str) -> Option<Self> {
        let class = fork.named().class_of(name)?.to_lowercase();
        let found = Self::of(fork, &class, name, None)?;
        Some(Self { name: name.to_owned(), ..found })
    }

    fn of(fork: &State, class: &str, key: &str, property: Option<String>) -> Option<Self> {
        let found = |key: String, name: String| Self { class: class.to_owned(), key, property, name };
        match class {
            "rooms" => {
                let mut rooms = fork.graph().rooms.iter();
                let room = rooms.find(|room| room.name == key || room.room.to_string() == key)?;
                Some(found(room.room.to_string(), format!("room {}", room.name)))
            }
            "doors" => {
                let graph = fork.graph();
                let door = &graph[graph.door(key.parse().ok()?)?];
                Some(found(door.door.to_string(), format!("door {}", door.door)))
            }
            "doorways" => {
                let graph = fork.graph();
                let doorway = graph.building.doorway_named(key).or_else(|| {
                    graph.building.doorways.iter().find(|doorway| doorway.doorway.to_string() == key)
                })?;
                Some(found(doorway.doorway.to_string(), Building::name(doorway)))
            }
            "spaces" => {
                let graph = fork.graph();
                let space = graph
                    .building
                    .space_named(key)
                    .or_else(|| graph.building.spaces.iter().find(|space| space.space.to_string() == key))?;
                let name =
                    graph.building.space(space.space).unwrap_or_else(|| format!("space {}", space.space));
                Some(found(space.space.to_string(), name))
            }
            _ => {
                let key = whole_key(fork, &class.to_uppercase(), key)?;
                let name = format!("{class} {key}");
                Some(found(key, name))
            }
        }
    }
}

/// What stands about lanes, in the order in which a name means it.
const OF_LANES: [&str; 5] = ["lane_doors", "lifts", "stations", "nodes", "lanes"];

/// The whole key of the one object of a class that a key means, or its last part: `SQUAT`, of `robot/SQUAT`.
fn whole_key(fork: &State, class: &str, key: &str) -> Option<String> {
    if fork.knowledge.row(class, key).is_some() {
        return Some(key.to_owned());
    }
    let ending = format!("/{key}");
    let all = (0..fork.knowledge.len(class).unwrap_or(0)).filter_map(|row| fork.knowledge.key(class, row));
    let mut meant = all.filter(|whole| whole.ends_with(&ending));
    meant.next().filter(|_| meant.next().is_none())
}

/// `door` and `doors` both mean the table.
fn is_called(class: &str, kind: &str) -> bool {
    let kind = kind.to_lowercase();
    kind == class || format!("{kind}s") == class
}

fn unknown(fork: &State, class: &str, key: &str) -> Error {
    let graph = fork.graph();
    let help = match class {
        "doors" => Some(match graph.doors.len() {
            1 => "there is one door, door 1".to_owned(),
            all => format!("there are {all} doors, numbered from 1"),
        }),
        "rooms" => did_you_mean(key, graph.rooms.iter().map(|room| room.name.as_str())),
        _ => None,
    };
    let message = match class.strip_suffix('s') {
        Some(one @ ("room" | "door")) => format!("there is no {one} `{key}`"),
        _ => format!("nothing is concluded about {class} {key}"),
    };
    Error::said(Code::WhyUnknown, message, help)
}
