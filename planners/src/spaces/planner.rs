//! The planner that asserts spaces and doorways.

use std::fmt::Write as _;
use std::sync::{Arc, Mutex, PoisonError};

use super::{Doorway, Space, Spaces};
use crate::facts::{Column, Facts, Table};
use crate::geometry::polygon::sides;
use crate::geometry::{Point, Rect};
use crate::known::keys;
use crate::planner::{Planner, PlannerError, Signature};
use crate::world::{Area, NamedDoor, Obstacle, Occupancy, World};

const NAME: &str = "spaces and doorways";

/// An area gives its name to a space of which it takes at least this share: a wet spot in a hall is no name for the hall.
const MOST: f64 = 0.5;

const GIVES: [&str; 22] = [
    "SPACES.space",
    "SPACES.called: text",
    "SPACES.area",
    "SPACES.breadth",
    "SPACES.x",
    "SPACES.y",
    "SPACES.outline: text",
    "SPACES.closed: truth",
    "DOORWAYS.doorway",
    "DOORWAYS.called: text",
    "DOORWAYS.space1",
    "DOORWAYS.space2",
    "DOORWAYS.x",
    "DOORWAYS.y",
    "DOORWAYS.x0",
    "DOORWAYS.y0",
    "DOORWAYS.x1",
    "DOORWAYS.y1",
    "DOORWAYS.width",
    "DOORWAYS.height",
    "DOORWAYS.closed: truth",
    "DOORWAYS.closed_from: text",
];

/// Gives the spaces of a building and the doorways between them, the same for all robots; metres.
///
/// SPACES by number: `called` (the only place in it, else the only area whose middle lies in it and that is at least half as
/// large), `area`, `breadth` (where it is widest, at `x` and `y`), `outline` (a JSON array of rings of `[x, y]`, the outer one
/// first). DOORWAYS by number:
/// `called` (the named door that lies there), the two spaces, its ends, its middle, `width`, and `height`, the lowest bridge
/// over it, unknown where there is none. Whether either is `closed`, and from which space alone (`closed_from`, by name), is for
/// rules, and for whoever tells it. A named door is a doorway wherever it is drawn.
///
/// What was found last is kept for as long as walls, obstacles and named doors stay where they are: areas and places only name it.
#[derive(Debug, Default)]
pub struct SpacesAndDoorways(Mutex<Option<(Walls, Arc<Spaces>)>>);

/// What spaces and doorways hang on.
#[derive(Debug, PartialEq)]
struct Walls {
    bounds: Rect,
    obstacles: Vec<Obstacle>,
    named_doors: Vec<NamedDoor>,
    occupancy: Option<Occupancy>,
}

impl Walls {
    fn of(world: &World) -> Self {
        Self {
            bounds: world.bounds,
            obstacles: world.obstacles.clone(),
            named_doors: world.named_doors.clone(),
            occupancy: world.occupancy.clone(),
        }
    }
}

impl SpacesAndDoorways {
    fn found(&self, world: &World) -> Result<Arc<Spaces>, String> {
        let walls = Walls::of(world);
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, found)) = kept.as_ref().filter(|(of, _)| *of == walls) {
            return Ok(Arc::clone(found));
        }
        let found = Arc::new(Spaces::of(world)?);
        *kept = Some((walls, Arc::clone(&found)));
        Ok(found)
    }
}

impl Planner for SpacesAndDoorways {
    fn name(&self) -> &'static str {
        NAME
    }

    fn signature(&self) -> Signature {
        Signature::new(&[], &GIVES)
    }

    fn facts(&self, world: &World, _known: &Facts) -> Result<Facts, PlannerError> {
        let found =
            self.found(world).map_err(|what| PlannerError::World { planner: NAME.to_owned(), what })?;
        Ok(Facts::from([
            ("SPACES".to_owned(), spaces(world, &found)),
            ("DOORWAYS".to_owned(), doorways(world, &found.doorways)),
        ]))
    }
}

fn spaces(world: &World, found: &Spaces) -> Table {
    let of = |at: Point, space: usize| found.at(at) == Some(space);
    let called = |space: usize| {
        let places = world.places.iter().filter(|place| of(place.at, space)).map(|place| &place.name);
        let is_most = |area: &&Area| {
            let corners = area.shape.corners();
            let signed: f64 = sides(&corners).map(|side| side.a.cross(side.b)).sum();
            of(area.centre, space) && signed.abs() / 2.0 >= MOST * found.spaces[space].area
        };
        let areas = world.areas.iter().filter(is_most).map(|area| &area.name);
        only(places).or_else(|| only(areas)).cloned()
    };
    let all = &found.spaces;
    let column = |of: fn(&Space) -> f64| all.iter().map(of).collect::<Column>();
    Table::default()
        .with("space", keys(all.len()))
        .with("called", (0..all.len()).map(called).collect::<Column>())
        .with("area", column(|space| space.area))
        .with("breadth", column(|space| space.breadth))
        .with("x", column(|space| space.at.x))
        .with("y", column(|space| space.at.y))
        .with("outline", all.iter().map(|space| json(&space.outline)).collect::<Column>())
        .with("closed", Column::Truth(vec![None; all.len()]))
}

fn only<T>(mut all: impl Iterator<Item = T>) -> Option<T> {
    all.next().filter(|_| all.next().is_none())
}

/// To a millimetre.
fn json(rings: &[Vec<Point>]) -> String {
    let mut text = String::from("[");
    for (number, ring) in rings.iter().enumerate() {
        text.push_str(if number > 0 { ",[" } else { "[" });
        for (number, p) in ring.iter().enumerate() {
            let comma = if number > 0 { "," } else { "" };
            let [x, y] = [p.x, p.y].map(|metres| (metres * 1000.0).round() / 1000.0);
            write!(text, "{comma}[{x},{y}]").expect("memory takes any text");
        }
        text.push(']');
    }
    text.push(']');
    text
}

fn doorways(world: &World, found: &[Doorway]) -> Table {
    let called = |doorway: &Doorway| Some(world.named_doors[doorway.named?].name.clone());
    let height = |doorway: &Doorway| {
        let Rect { x0, y0, x1, y1 } = doorway.segment.bounds();
        let over = |rect: &Rect| {
            rect.x0 < x1 && x0 < rect.x1 && rect.y0 < y1 && y0 < rect.y1
                || rect.contains(doorway.segment.middle())
        };
        let above = world.bridges.iter().filter(|bridge| over(&bridge.rect));
        above.map(|bridge| bridge.height).min_by(f64::total_cmp)
    };
    let column = |of: fn(&Doorway) -> f64| found.iter().map(of).collect::<Column>();
    Table::default()
        .with("doorway", keys(found.len()))
        .with("called", found.iter().map(called).collect::<Column>())
        .with("space1", column(|doorway| (doorway.spaces[0] + 1) as f64))
        .with("space2", column(|doorway| (doorway.spaces[1] + 1) as f64))
        .with("x", column(|doorway| doorway.segment.middle().x))
        .with("y", column(|doorway| doorway.segment.middle().y))
        .with("x0", column(|doorway| doorway.segment.a.x))
        .with("y0", column(|doorway| doorway.segment.a.y))
        .with("x1", column(|doorway| doorway.segment.b.x))
        .with("y1", column(|doorway| doorway.segment.b.y))
        .with("width", column(|doorway| doorway.segment.length()))
        .with("height", found.iter().map(height).collect::<Column>())
        .with("closed", Column::Truth(vec![None; found.len()]))
        .with("closed_from", Column::Text(vec![None; found.len()]))
}
