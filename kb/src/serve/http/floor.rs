//! The floor as the page draws it, packed: of a large one `/api/map` has tens of megabytes.

use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::Serialize;

use super::extract::Site;
use super::map::MapAnswer;
use crate::error::{Code, Error, Result};
use crate::serve::fault::Answered;

/// The text before the numbers.
#[derive(Serialize)]
struct Head {
    /// Without walls, rooms and doors.
    #[serde(flatten)]
    map: MapAnswer,
    /// Of rooms.
    names: Vec<String>,
    /// How many walls, rooms and doors follow.
    counts: [usize; 3],
}

/// Walls, rooms and doors as the page draws them, packed as numbers, which the manual describes. What `/api/map` has besides is
/// there as JSON. Doors at which a robot changes its shape are left out.
#[utoipa::path(get, path = "/api/floor", tag = "map",
    responses((status = 200, body = Vec<u8>, content_type = "application/octet-stream")))]
pub async fn floor(site: Site) -> Answered<Response> {
    let seen = site.view.load_full();
    let packed = site.at_length(move || packed(MapAnswer::of(&seen.view, false))).await?;
    Ok(([(header::CONTENT_TYPE, "application/octet-stream")], packed).into_response())
}

fn packed(mut map: MapAnswer) -> Result<Vec<u8>> {
    let walls = std::mem::take(&mut map.walls);
    let mut rooms = std::mem::take(&mut map.rooms);
    let doors = std::mem::take(&mut map.doors);
    let mut numbers = Numbers { bytes: Vec::new(), origin: [map.bounds[0], map.bounds[1]] };
    numbers.polygons(walls.iter().map(Vec::as_slice));
    numbers.integers(rooms.iter().map(|room| room.room));
    // which has none is of the layer -1
    numbers.integers(rooms.iter().map(|room| room.layer.map_or(-1, |layer| layer as i64)));
    // a rectangle is two of its corners
    numbers.polygons(rooms.iter().map(|room| room.outline.as_deref().unwrap_or(&room.rect)));
    numbers.integers(doors.iter().map(|door| door.door));
    numbers.integers(doors.iter().map(|door| door.room1));
    numbers.points(doors.iter().flat_map(|door| door.segment));
    let counts = [walls.len(), rooms.len(), doors.len()];
    let names = rooms.iter_mut().map(|room| std::mem::take(&mut room.name)).collect();
    let head = serde_json::to_vec(&Head { map, names, counts });
    let mut head = head.map_err(Error::of(Code::ServiceInternal))?;
    // spaces, so that the numbers begin where readers may look at them as such
    head.resize(head.len().next_multiple_of(4), b' ');
    let mut packed = (head.len() as u32).to_le_bytes().to_vec();
    packed.append(&mut head);
    packed.append(&mut numbers.bytes);
    Ok(packed)
}

/// Numbers of 32 bits, one after the other, the lowest byte first.
struct Numbers {
    bytes: Vec<u8>,
    /// From where coordinates are counted: from far away they would lose their millimetres.
    origin: [f64; 2],
}

impl Numbers {
    fn integers(&mut self, of: impl Iterator<Item = i64>) {
        self.bytes.extend(of.flat_map(|number| (number as i32).to_le_bytes()));
    }

    /// Coordinates x, y, x, y, …
    fn points(&mut self, of: impl Iterator<Item = f64>) {
        let from = [self.origin[0], self.origin[1]].into_iter().cycle();
        self.bytes.extend(of.zip(from).flat_map(|(at, from)| ((at - from) as f32).to_le_bytes()));
    }

    /// How many corners each has, then all corners.
    fn polygons<'p>(&mut self, of: impl Iterator<Item = &'p [f64]> + Clone) {
        self.integers(of.clone().map(|polygon| polygon.len() as i64 / 2));
        self.points(of.flatten().copied());
    }
}
