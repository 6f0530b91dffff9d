//! The planner that asserts the rooms and doors of all layers.

use rayon::prelude::*;

use super::{Crossing, Kind, KnownLayers, Room, State, cut_layers_anew};
use crate::facts::Facts;
use crate::overlays::{AREAS, MEMBERS_GIVE, member_facts};
use crate::planner::{Planner, PlannerError, Signature};
use crate::rooms::{DoorRow, GIVES, RoomRow, facts};
use crate::routes::Berth;
use crate::spaces::{Located, OF_SPACES};
use crate::world::World;

const NAME: &str = "rooms by state";

/// One layer of rooms a state. Which states move at all (`ROBOTS.moves`) a rule says.
///
/// Gives ROOMS by robot (in the order in which the table first names them), state and then as made; and DOORS of
/// kind `door` (within a layer) and `change` (one way, a pair where rooms of two states of a robot overlap), all
/// numbered by (room1, room2). `width` is a room's smaller side, a door's length, the smaller side of the overlap
/// of a change. `AREA_ROOMS` and `DOOR_ROOMS` say which room lies in which named area or door: rooms are cut along them. An
/// area is entered by the robot's middle, or, where a rule or the map says so (`AREAS.whole_body`), by any part of it.
///
/// Layers are kept from one run to the next: where the size of one state changes, the others' are not cut again.
#[derive(Debug, Default)]
pub struct RoomsByState {
    known: KnownLayers,
}

impl Planner for RoomsByState {
    fn name(&self) -> &'static str {
        NAME
    }

    fn signature(&self) -> Signature {
        let of_robots = ["robot", "state", "height", "width", "length", "moves", "berth?", "berth_cost?"]
            .map(|p| format!("ROBOTS.{p}"));
        let of_areas = ["area", "whole_body"].map(|p| format!("{AREAS}.{p}?"));
        let of_spaces = OF_SPACES.map(str::to_owned);
        let needs: Vec<String> = of_robots.into_iter().chain(of_areas).chain(of_spaces).collect();
        let gives = GIVES.iter().chain(&MEMBERS_GIVE).map(|given| (*given).to_owned()).collect();
        Signature { needs, gives }
    }

    fn keeps(&self) -> bool {
        true
    }

    fn facts(&self, world: &World, known: &Facts) -> Result<Facts, PlannerError> {
        let fact = |class: &str| {
            let class = class.to_owned();
            move |what: String| PlannerError::Fact { planner: NAME.to_owned(), class, what }
        };
        let (states, berths) = moving_states(known, world.clearance).map_err(fact("ROBOTS"))?;
        let whole = for_the_whole_body(world, known).map_err(fact(AREAS))?;
        let layers = cut_layers_anew(world, &states, &whole, &self.known)
            .map_err(|what| PlannerError::World { planner: NAME.to_owned(), what })?;
        let room = |room: &Room| RoomRow {
            robot: states[room.state].robot.clone(),
            state: Some(states[room.state].state.clone()),
            facing: room.facing,
            outline: room.outline.clone(),
            radius: room.radius,
            berth: berths[room.state],
            height: room.height,
        };
        let door = |crossing: &Crossing| DoorRow {
            rooms: [crossing.room1, crossing.room2],
            across: crossing.across,
            at: crossing.at,
            width: crossing.width,
            is_change: crossing.kind == Kind::Change,
        };
        let rooms: Vec<RoomRow> = layers.rooms.par_iter().map(room).collect();
        let doors: Vec<DoorRow> = layers.crossings.par_iter().map(door).collect();
        let keyed = |pairs: &[(usize, usize)]| -> Vec<(usize, usize)> {
            pairs.iter().map(|&(room, named)| (room + 1, named)).collect()
        };
        let mut all = facts(&rooms, &doors, &Located::read(NAME, known)?);
        all.extend(member_facts(world, &keyed(&layers.area_rooms), &keyed(&layers.door_rooms)));
        Ok(all)
    }
}

/// The areas, by number, that any part of the robot enters.
fn for_the_whole_body(world: &World, known: &Facts) -> Result<Vec<usize>, String> {
    let Some(table) = known.get(AREAS).filter(|table| table.column("whole_body").is_some()) else {
        return Ok(Vec::new());
    };
    let (names, whole) = (table.texts("area")?, table.truths("whole_body")?);
    let is_whole = |name: &str| {
        let row = names.iter().position(|other| other.as_deref() == Some(name));
        row.is_some_and(|row| whole[row] == Some(true))
    };
    Ok((0..world.areas.len()).filter(|&area| is_whole(&world.areas[area].name)).collect())
}

/// The states that move, by robot and then in the table's order, each with how much farther off walls than the clearance that
/// is kept anyway its ways keep.
fn moving_states(known: &Facts, clearance: f64) -> Result<(Vec<State>, Vec<Option<Berth>>), String> {
    let table = known.get("ROBOTS").ok_or("the class is missing")?;
    let (robots, names) = (table.texts("robot")?, table.texts("state")?);
    let (heights, widths) = (table.numbers("height")?, table.numbers("width")?);
    let (lengths, moves) = (table.numbers("length")?, table.truths("moves")?);
    let [berths, costs] =
        ["berth", "berth_cost"].map(|name| table.column(name).map(|_| table.numbers(name)).transpose());
    let (berths, costs) = (berths?, costs?);
    let mut order: Vec<&Option<String>> = Vec::new();
    let mut states = Vec::new();
    for row in 0..table.len() {
        let name = names[row].as_deref().ok_or_else(|| format!("the state of row {} is unknown", row + 1))?;
        let unknown = |property| format!("whether `{name}` moves is decided, but its {property} is unknown");
        if !moves[row].ok_or_else(|| format!("whether state `{name}` moves is unknown"))? {
            continue;
        }
        if !order.contains(&&robots[row]) {
            order.push(&robots[row]);
        }
        let least =
            |property: &str, values: Option<&[Option<f64>]>| match values.and_then(|values| values[row]) {
                Some(value) if !(value.is_finite() && value >= 0.0) => {
                    Err(format!("the {property} of `{name}` is {value}; it is finite and not negative"))
                }
                value => Ok(value),
            };
        let berth = least("berth", berths)?.zip(least("berth_cost", costs)?);
        let berth = berth.map(|(metres, share)| Berth { metres: (metres - clearance).max(0.0), share });
        let state = State {
            robot: robots[row].clone(),
            state: name.to_owned(),
            height: heights[row].ok_or_else(|| unknown("height"))?,
            width: widths[row].ok_or_else(|| unknown("width"))?,
            length: lengths[row],
        };
        states.push((state, berth));
    }
    states.sort_by_key(|(state, _)| order.iter().position(|robot| **robot == state.robot));
    Ok(states.into_iter().unzip())
}
