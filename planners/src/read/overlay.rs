//! Places, bridges and obstacles as `[[place]]`, `[[bridge]]`, `[[obstacle]]`: the content of a vector map, and what
//! a site lays over any map. One reader and one set of checks for both.

mod checks;
mod items;

use toml::de::DeTable;

use super::diagnostic::{MapErrors, Problem, Text};
use super::fields::{Fields, Located};
use super::syntax_problem;
use crate::world::{Bridge, Place, Shape, World};

/// Items with their places in a text, checked in themselves (finite, positive, with an area) but not yet
/// against a world.
#[derive(Clone, Debug)]
pub struct Overlay {
    text: Text,
    obstacles: Vec<Located<Shape>>,
    bridges: Vec<Located<Bridge>>,
    places: Vec<Located<Place>>,
}

impl Overlay {
    /// The keys that an overlay takes from a document.
    pub const KEYS: [&'static str; 3] = ["place", "bridge", "obstacle"];

    /// Reads the items of a TOML document such as `site.toml`. Keys other than [`Self::KEYS`] are left to the
    /// caller; inside of the items unknown keys are refused.
    ///
    /// # Arguments
    /// `name` is how messages call the file, `text` its content.
    pub fn from_toml(name: &str, text: &str) -> Result<Self, MapErrors> {
        let source = Text::new(name, text);
        let document = DeTable::parse(text).map_err(|error| syntax_problem(&source, &error))?;
        let span = document.span();
        let fields = Fields { what: "the site", table: document.get_ref(), span, text: &source };
        let mut problems = Vec::new();
        let overlay = Self::from_fields(&fields, &mut problems);
        if problems.is_empty() { Ok(overlay) } else { Err(MapErrors { problems }) }
    }

    /// Reads the items of a document that is read field by field; what is wrong is added to `problems`.
    pub fn from_fields(fields: &Fields<'_, '_>, problems: &mut Vec<Problem>) -> Self {
        Self {
            obstacles: items::obstacles(fields, problems),
            bridges: items::bridges(fields, problems),
            places: items::places(fields, problems),
            text: fields.text.clone(),
        }
    }

    /// Whether there is nothing to lay.
    pub fn is_empty(&self) -> bool {
        self.obstacles.is_empty() && self.bridges.is_empty() && self.places.is_empty()
    }

    /// Lays the items over a world. Items partly outside are cut at the edge; places are checked against
    /// everything solid, old and new.
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
        let (notes, problems): (Vec<_>, Vec<_>) =
            found.into_iter().partition(|problem| problem.severity == miette::Severity::Advice);
        if !problems.is_empty() {
            return Err(MapErrors { problems });
        }
        *world = laid;
        Ok(notes)
    }
}
