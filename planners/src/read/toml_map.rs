//! Vector maps: `width`, `depth`, `[[obstacle]]`, `[[bridge]]`, `[[place]]`, `[[area]]`, `[[door]]`, in metres from
//! (0, 0).

use super::diagnostic::{MapErrors, Problem};
use super::fields::Document;
use super::overlay::Overlay;
use crate::geometry::Rect;
use crate::world::World;

const KEYS: [&str; 7] = ["width", "depth", "obstacle", "bridge", "place", "area", "door"];

/// Reads a vector map.
///
/// # Arguments
/// `name` is how messages call the file, `text` its content.
///
/// # Returns
/// The world, and notes (what was cut at the edge).
pub fn read_toml_map(name: &str, text: &str) -> Result<(World, Vec<Problem>), MapErrors> {
    let document = Document::parse(name, text)?;
    let fields = document.fields("a map");
    let mut problems = Vec::new();
    fields.refuse_unknown(&KEYS, &mut problems);
    let width = fields.positive("width", &mut problems);
    let depth = fields.positive("depth", &mut problems);
    let overlay = Overlay::from_fields(&fields, &mut problems);
    let (Some(width), Some(depth)) = (width, depth) else { return Err(MapErrors { problems }) };
    let mut world = World::empty(Rect::new(0.0, 0.0, width.value, depth.value));
    match overlay.lay_over(&mut world) {
        Ok(notes) if problems.is_empty() => Ok((world, notes)),
        Ok(_) => Err(MapErrors { problems }),
        Err(more) => {
            problems.extend(more.problems);
            Err(MapErrors { problems })
        }
    }
}
