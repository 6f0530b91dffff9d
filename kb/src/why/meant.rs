//! What a way is asked to lead through: anything that has a name, or a point.

use std::collections::BTreeSet;

use adit_db::space::Doorway;
use adit_engine::Value;
use adit_planners::geometry::Point;
use adit_planners::routes::RoomIndex;

use super::contrast::through::Via;
use super::subject::Subject;
use crate::edit::place;
use crate::error::{Code, Error, Result};
use crate::graph::{Building, End, Named};
use crate::knowledge::told::Object;
use crate::state::State;
use crate::words::number::number;
use crate::words::suggest::did_you_mean;

/// What a way is asked to lead through.
pub struct Meant {
    /// As people call it, with how a way leads there: `through ward 12`, `by 3.2,7`.
    pub name: String,
    pub is_point: bool,
    pub via: Via,
    /// A room or a door, by its number.
    pub subject: Option<Subject>,
    /// The doorway, by its number.
    pub doorway: Option<i64>,
}

impl Meant {
    /// `through ward 12`, `by 3.2,7`.
    pub fn words(&self) -> String {
        format!("{} {}", if self.is_point { "by" } else { "through" }, self.name)
    }
}

impl State {
    /// What a text means: a space, a doorway, an area, a named door, a room, a door, a place or a point.
    pub(super) fn meant(&self, text: &str, robot: &str) -> Result<Meant> {
        let (what, graph) = (text.trim(), self.graph());
        let meant = |name: &str, via: Via| Meant {
            name: name.to_owned(),
            is_point: matches!(via, Via::Point(..)),
            via,
            subject: None,
            doorway: None,
        };
        if let Some((at, heading)) = place::split(what) {
            if heading.is_some() {
                return self.ahead(what, (at, heading));
            }
            let via = self.by_point(at, robot);
            if let Via::Rooms(rooms) = &via
                && let [room] = rooms.iter().copied().collect::<Vec<_>>().as_slice()
            {
                // nothing is asked but whether its room is passed, so that is what is said
                return self.through_subject(&format!("room {}", graph[*room].name));
            }
            let name = format!("{},{}", number(at.x), number(at.y));
            return Ok(meant(&name, via));
        }
        let named = self.named();
        Ok(match named.class_of(what) {
            Some("DOORWAYS") => self.through_doorway(graph.building.doorway_named(what)),
            Some("SPACES") => {
                let space = graph.building.space_named(what).map(|space| space.space);
                let rooms = graph.graph().room_indices();
                let rooms = rooms.filter(|&room| space.is_some() && graph[room].space == space);
                meant(what, Via::Rooms(rooms.collect()))
            }
            Some("AREAS") => meant(what, Via::Rooms(self.rooms_of("AREA_ROOMS", "area", what))),
            Some("NAMED_DOORS") => meant(what, Via::Rooms(self.rooms_of("DOOR_ROOMS", "door", what))),
            _ => match graph.end(what) {
                Some(End::Place(place)) => meant(what, self.by_point(graph.point(&End::Place(place)), robot)),
                _ => self.through_subject(what).map_err(|error| {
                    let places = graph.places.iter().map(|place| place.place.clone());
                    let known: Vec<String> = named.names().chain(places).collect();
                    match did_you_mean(what, known.iter().map(String::as_str)) {
                        Some(help) => {
                            let message = format!("a route leads through nothing that is called `{what}`");
                            Error::said(Code::WhyThrough, message, Some(help))
                        }
                        None => error,
                    }
                })?,
            },
        })
    }

    /// What people have names for.
    pub(super) fn named(&self) -> Named<'_> {
        let names = |class: &str, key: &str| {
            let texts = self.knowledge.texts(class, key).unwrap_or_default();
            texts.into_iter().flatten().map(|name| name.to_string()).collect()
        };
        Named {
            areas: names("AREAS", "area"),
            doors: names("NAMED_DOORS", "door"),
            building: &self.graph().building,
        }
    }

    /// The doorway ahead of where a robot stands.
    fn ahead(&self, what: &str, at: (Point, Option<f64>)) -> Result<Meant> {
        let building = &self.graph().building;
        let doorway = match place::at(&self.world, building, at)? {
            Object::Point(_, Some(segment)) => building.doorway_at(segment),
            _ => None,
        };
        if doorway.is_none() {
            let message = format!("no doorway lies ahead of {what}");
            let help = "say the point without its heading".to_owned();
            return Err(Error::said(Code::WhyThrough, message, Some(help)));
        }
        Ok(self.through_doorway(doorway))
    }

    fn through_doorway(&self, doorway: Option<&Doorway>) -> Meant {
        let graph = self.graph();
        let number = doorway.map(|doorway| doorway.doorway);
        let leads = |door: &_| {
            let through = graph.doorway_of(&graph[*door]).map(|through| through.doorway);
            through.is_some() && through == number
        };
        Meant {
            name: doorway.map(Building::name).unwrap_or_default(),
            is_point: false,
            via: Via::Doors(graph.graph().door_indices().filter(leads).collect()),
            subject: None,
            doorway: number,
        }
    }

    /// A room or a door.
    fn through_subject(&self, what: &str) -> Result<Meant> {
        let (subject, graph) = (Subject::find(self, what)?, self.graph());
        let key = subject.key.parse().unwrap_or_default();
        let via = match subject.class.as_str() {
            "rooms" => Via::Rooms(graph.room(key).into_iter().collect()),
            "doors" => Via::Doors(graph.door(key).into_iter().collect()),
            _ => {
                let message = format!("a route leads through no {}", subject.name);
                let help =
                    "say a space, a doorway, an area, a named door, a room, a door, a place or a point x,y";
                return Err(Error::said(Code::WhyThrough, message, Some(help.to_owned())));
            }
        };
        Ok(Meant { name: subject.name.clone(), is_point: false, via, subject: Some(subject), doorway: None })
    }

    /// By a point; where rooms weigh nothing it makes no difference where in a room that is.
    fn by_point(&self, at: Point, robot: &str) -> Via {
        let graph = self.graph();
        let entries = graph.entries(Some(&*self.gauge), &End::Point(at), Some(robot));
        if graph.graph().is_on_doors() {
            return Via::Rooms(entries.iter().map(|entry| entry.room).collect());
        }
        Via::Point(at, entries)
    }

    /// The rooms that lie in a named area, or in which a named door is passed.
    pub(super) fn rooms_of(&self, class: &str, link: &str, name: &str) -> BTreeSet<RoomIndex> {
        let (knowledge, graph) = (&self.knowledge, self.graph());
        let rows = 0..knowledge.len(class).unwrap_or(0);
        let is_meant = |row: &usize| matches!(knowledge.value_at(class, *row, link), Some(Value::Text(of)) if &*of == name);
        let room = |row: usize| match knowledge.value_at(class, row, "room") {
            Some(Value::Number(key)) => graph.room(key as i64),
            _ => None,
        };
        rows.filter(is_meant).filter_map(room).collect()
    }
}
