//! Rooms of the paper's modes, which no area cuts: a room lies in an area if more than half of it does.

use geo::{Area as _, BooleanOps};

use super::member_facts;
use crate::facts::Facts;
use crate::geometry::{Convex, Segment, cross};
use crate::known::KnownClass;
use crate::planner::{Planner, PlannerError, Signature};
use crate::world::{NamedDoor, Shape, World};

const NAME: &str = "rooms in overlays";

/// Which rooms lie in which area or named door, for rooms that were cut without regard to them: `AREA_ROOMS` has a
/// room where more than half of its surface lies in the area, `DOOR_ROOMS` where the segment passes through it.
#[derive(Clone, Copy, Debug, Default)]
pub struct RoomsInOverlays;

impl Planner for RoomsInOverlays {
    fn name(&self) -> &'static str {
        NAME
    }

    fn signature(&self) -> Signature {
        let needs = ["room", "x0", "y0", "x1", "y1", "outline?"].map(|property| format!("ROOMS.{property}"));
        Signature { needs: needs.into(), gives: super::MEMBERS_GIVE.map(str::to_owned).into() }
    }

    fn facts(&self, world: &World, known: &Facts) -> Result<Facts, PlannerError> {
        let known = KnownClass::find(NAME, "ROOMS", known)?;
        let (keys, rooms) = (known.numbers("room")?, known.outlines()?);
        let pairs = |of: usize, is_in: &dyn Fn(&Convex) -> bool| -> Vec<(usize, usize)> {
            let inside = keys.iter().zip(&rooms).filter(|(_, room)| is_in(room));
            inside.map(|(key, _)| (*key as usize, of)).collect()
        };
        let areas = world.areas.iter().enumerate();
        let areas: Vec<_> =
            areas.flat_map(|(of, area)| pairs(of, &|room| is_mostly_in(room, &area.shape))).collect();
        let doors = world.named_doors.iter().enumerate();
        let across = |room: &Convex, door: &NamedDoor| is_crossed(room, Segment::new(door.from, door.to));
        let doors: Vec<_> = doors.flat_map(|(of, door)| pairs(of, &|room| across(room, door))).collect();
        Ok(member_facts(world, &areas, &doors))
    }
}

fn is_mostly_in(room: &Convex, shape: &Shape) -> bool {
    if !room.bounds().overlaps(&shape.enclosing_rect()) {
        return false;
    }
    let covered = match shape {
        Shape::Rect(rect) => room.common(&(*rect).into()).map_or(0.0, |common| common.area()),
        Shape::Polygon(_) => {
            shape.to_geo().intersection(&Shape::Polygon(room.corners().collect()).to_geo()).unsigned_area()
        }
    };
    covered > room.area() / 2.0
}

/// Whether a part of some length lies inside, not just on the outline.
fn is_crossed(room: &Convex, by: Segment) -> bool {
    let inside = room.clip(by).map(|part| part.middle());
    inside.is_some_and(|p| room.sides().all(|side| cross(side.a, side.b, p) > 0.0))
}
