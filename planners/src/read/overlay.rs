//! Places, bridges, obstacles, named areas and named doors as `[[place]]`, `[[bridge]]`, `[[obstacle]]`, `[[area]]`,
//! `[[door]]`: the content of a vector map, and what a site lays over any map. One reader and one set of checks for
//! both.

mod checks;
mod items;
mod named;
mod named_checks;
mod names;
mod outline;

use super::diagnostic::{MapErrors, Problem, Text};
use super::fields::{Document, Fields, Located};
use crate::overlays::AREAS;
use crate::world::{Area, Bridge, NamedDoor, Place, Shape, World};
use named::Given;
pub(super) use named::centre;
use names::Names;
pub(super) use outline::ring;

/// Items with their places in a text, checked in themselves (finite, positive, with an area) but not yet
/// against a world.
#[derive(Clone, Debug)]
pub struct Overlay {
    text: Text,
    obstacles: Vec<Located<Shape>>,
    bridges: Vec<Located<Bridge>>,
    places: Vec<Located<Place>>,
    areas: Vec<Located<Area>>,
    doors: Vec<Located<NamedDoor>>,
    given: Vec<Located<Given>>,
}

impl Overlay {
    /// The keys that an overlay takes from a document.
    pub const KEYS: [&'static str; 5] = ["place", "bridge", "obstacle", "area", "door"];

    /// The places, as they are written.
    pub fn places(&self) -> impl Iterator<Item = &Place> {
        self.places.iter().map(|place| &place.value)
    }

    /// Reads the items of a TOML document such as `site.toml`. Keys other than [`Self::KEYS`] are left to the
    /// caller; inside of the items unknown keys are refused.
    ///
    /// # Arguments
    /// `name` is how messages call the file, `text` its content.
    pub fn from_toml(name: &str, text: &str) -> Result<Self, MapErrors> {
        let document = Document::parse(name, text)?;
        let mut problems = Vec::new();
        let overlay = Self::from_fields(&document.fields("the site"), &mut problems);
        if problems.is_empty() { Ok(overlay) } else { Err(MapErrors { problems }) }
    }

    /// Reads the items of a document that is read field by field; what is wrong is added to `problems`.
    pub fn from_fields(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Self {
        let (mut names, mut given) = (Names::default(), Vec::new());
        Self {
            obstacles: items::obstacles(fields, problems),
            bridges: items::bridges(fields, problems),
            places: items::places(fields, &mut names, problems),
            areas: named::areas(fields, &mut names, &mut given, problems),
            doors: named::doors(fields, &mut names, &mut given, problems),
            given,
            text: fields.text.clone(),
        }
    }

    /// Areas that were made of what stands in a text.
    pub(super) fn of_areas(text: &Text, areas: Vec<Located<Area>>) -> Self {
        let given = areas.iter().flat_map(|area| {
            area.value.further.iter().map(|(property, value)| Located {
                value: Given { class: AREAS, property: property.clone(), kind: value.kind() },
                span: area.span.clone(),
            })
        });
        Self {
            given: given.collect(),
            text: text.clone(),
            obstacles: Vec::new(),
            bridges: Vec::new(),
            places: Vec::new(),
            areas,
            doors: Vec::new(),
        }
    }

    pub fn is_empty(&self) -> bool {
        let drawn = self.obstacles.is_empty() && self.bridges.is_empty();
        drawn && self.places.is_empty() && self.areas.is_empty() && self.doors.is_empty()
    }

    /// Lays the items over a world. Items partly outside are cut at the edge; places are checked against
    /// everything solid, old and new; names and properties against those of the world.
    ///
    /// # Returns
    /// Notes (what was cut). On an error the world is as it was.
    pub fn lay_over(self, world: &mut World) -> Result<Vec<Problem>, MapErrors> {
        let before = world.obstacles.len();
        let mut found = Vec::new();
        let mut laid = world.clone();
        for obstacle in &self.obstacles {
            checks::add_obstacle(&mut laid, &self.text, obstacle, &mut found);
        }
        for bridge in &self.bridges {
            checks::add_bridge(&mut laid, &self.text, bridge, &mut found);
        }
        checks::known_places(&laid, &self.text, &self.obstacles, before, &mut found);
        for place in &self.places {
            checks::add_place(&mut laid, &self.text, place, &self.obstacles, &mut found);
        }
        for area in &self.areas {
            named_checks::add_area(&mut laid, &self.text, area, &mut found);
        }
        for door in &self.doors {
            named_checks::add_door(&mut laid, &self.text, door, &mut found);
        }
        named_checks::one_kind_each(world, &self.text, &self.given, &mut found);
        let (notes, problems): (Vec<_>, Vec<_>) =
            found.into_iter().partition(|problem| problem.severity == miette::Severity::Advice);
        if !problems.is_empty() {
            return Err(MapErrors { problems });
        }
        *world = laid;
        Ok(notes)
    }
}
