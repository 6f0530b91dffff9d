//! Rooms of the paper's modes, which no area cuts: a room lies in an area if more than half of it does.

use geo::{Area as _, BooleanOps};

use super::member_facts;
use crate::facts::Facts;
use crate::geometry::Rect;
use crate::known::KnownClass;
use crate::planner::{Planner, PlannerError, Signature};
use crate::world::{Shape, World};

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
        let needs = ["room", "x0", "y0", "x1", "y1"].map(|property| format!("ROOMS.{property}"));
        Signature { needs: needs.into(), gives: super::MEMBERS_GIVE.map(str::to_owned).into() }
    }

    fn facts(&self, world: &World, known: &Facts) -> Result<Facts, PlannerError> {
        let known = KnownClass::find(NAME, "ROOMS", known)?;
        let (keys, rooms) = (known.numbers("room")?, known.rects()?);
        let pairs = |of: usize, is_in: &dyn Fn(&Rect) -> bool| -> Vec<(usize, usize)> {
            let inside = keys.iter().zip(&rooms).filter(|(_, room)| is_in(room));
            inside.map(|(key, _)| (*key as usize, of)).collect()
        };
        let areas = world.areas.iter().enumerate();
        let areas: Vec<_> =
            areas.flat_map(|(of, area)| pairs(of, &|room| is_mostly_in(room, &area.shape))).collect();
        let doors = world.named_doors.iter().enumerate();
        let doors: Vec<_> =
            doors.flat_map(|(of, door)| pairs(of, &|room| room.is_crossed_by(door.from, door.to))).collect();
        Ok(member_facts(world, &areas, &doors))
    }
}

fn is_mostly_in(room: &Rect, shape: &Shape) -> bool {
    let Some(common) = room.intersection(&shape.enclosing_rect()) else { return false };
    let covered = match shape {
        Shape::Rect(_) => common.area(),
        Shape::Polygon(_) => shape.to_geo().intersection(&Shape::Rect(*room).to_geo()).unsigned_area(),
    };
    covered > room.area() / 2.0
}
