//! The planner that asserts the rooms and doors of all layers.

use super::{Kind, KnownLayers, Layers, Room, State, cut_layers_anew};
use crate::facts::{Column, Facts, Table};
use crate::names::room_name;
use crate::overlays::{MEMBERS_GIVE, member_facts};
use crate::planner::{Planner, PlannerError, Signature};
use crate::rooms::GIVES;
use crate::world::World;

const NAME: &str = "rooms by state";

/// One layer of rooms a state. Which states move at all (`ROBOTS.moves`) a rule says.
///
/// Gives ROOMS by robot (in the order in which the table first names them), state and then as made; and DOORS of
/// kind `door` (within a layer) and `change` (one way, a pair where rooms of two states of a robot overlap), all
/// numbered by (room1, room2). `width` is a room's smaller side, a door's length, the smaller side of the overlap
/// of a change. `AREA_ROOMS` and `DOOR_ROOMS` say which room lies in which named area or door: rooms are cut along them.
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
        let needs = ["robot", "state", "height", "width", "length", "moves"].map(|p| format!("ROBOTS.{p}"));
        let gives = GIVES.iter().chain(&MEMBERS_GIVE).map(|given| (*given).to_owned()).collect();
        Signature { needs: needs.into(), gives }
    }

    fn facts(&self, world: &World, known: &Facts) -> Result<Facts, PlannerError> {
        let states = moving_states(known).map_err(|what| PlannerError::Fact {
            planner: NAME.to_owned(),
            class: "ROBOTS".to_owned(),
            what,
        })?;
        let layers = cut_layers_anew(world, &states, &self.known)
            .map_err(|what| PlannerError::World { planner: NAME.to_owned(), what })?;
        let rooms = rooms_table(&layers, &states);
        let keyed = |pairs: &[(usize, usize)]| -> Vec<(usize, usize)> {
            pairs.iter().map(|&(room, named)| (room + 1, named)).collect()
        };
        let mut facts = member_facts(world, &keyed(&layers.area_rooms), &keyed(&layers.door_rooms));
        facts.insert("ROOMS".to_owned(), rooms);
        facts.insert("DOORS".to_owned(), doors_table(&layers));
        Ok(facts)
    }
}

/// The states that move, by robot and then in the table's order.
fn moving_states(known: &Facts) -> Result<Vec<State>, String> {
    let table = known.get("ROBOTS").ok_or("the class is missing")?;
    let (robots, names) = (table.texts("robot")?, table.texts("state")?);
    let (heights, widths) = (table.numbers("height")?, table.numbers("width")?);
    let (lengths, moves) = (table.numbers("length")?, table.truths("moves")?);
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
        states.push(State {
            robot: robots[row].clone(),
            state: name.to_owned(),
            height: heights[row].ok_or_else(|| unknown("height"))?,
            width: widths[row].ok_or_else(|| unknown("width"))?,
            length: lengths[row],
        });
    }
    states.sort_by_key(|state| order.iter().position(|robot| **robot == state.robot));
    Ok(states)
}

fn rooms_table(layers: &Layers, states: &[State]) -> Table {
    let rooms = &layers.rooms;
    let number = |of: fn(&Room) -> f64| rooms.iter().map(of).collect::<Column>();
    Table::default()
        .with("room", (1..=rooms.len()).map(|key| key as f64).collect::<Column>())
        .with("name", (0..rooms.len()).map(room_name).collect::<Column>())
        .with("robot", rooms.iter().map(|room| states[room.state].robot.clone()).collect::<Column>())
        .with("state", rooms.iter().map(|room| states[room.state].state.clone()).collect::<Column>())
        .with("facing", rooms.iter().map(|room| room.facing).collect::<Column>())
        .with("x0", number(|room| room.rect.x0))
        .with("y0", number(|room| room.rect.y0))
        .with("x1", number(|room| room.rect.x1))
        .with("y1", number(|room| room.rect.y1))
        .with("height", rooms.iter().map(|room| room.height).collect::<Column>())
        .with("width", number(|room| room.rect.smaller_side()))
}

fn doors_table(layers: &Layers) -> Table {
    let (rooms, doors) = (&layers.rooms, &layers.crossings);
    let column = |of: &dyn Fn(usize) -> f64| (0..doors.len()).map(of).collect::<Column>();
    let room1 = |door: usize| &rooms[doors[door].room1];
    let room2 = |door: usize| &rooms[doors[door].room2];
    let distance = |door: usize, room: &Room| room.rect.centre().distance(doors[door].rect.centre());
    let kind = |kind| if kind == Kind::Door { "door" } else { "change" };
    let width = |door: usize| {
        let rect = doors[door].rect;
        if doors[door].kind == Kind::Door { rect.dx().max(rect.dy()) } else { rect.smaller_side() }
    };
    Table::default()
        .with("door", column(&|door| (door + 1) as f64))
        .with("kind", doors.iter().map(|door| kind(door.kind).to_owned()).collect::<Column>())
        .with("room1", column(&|door| (doors[door].room1 + 1) as f64))
        .with("room2", column(&|door| (doors[door].room2 + 1) as f64))
        .with("x", column(&|door| doors[door].rect.centre().x))
        .with("y", column(&|door| doors[door].rect.centre().y))
        .with("width", column(&width))
        .with("x0", column(&|door| doors[door].rect.x0))
        .with("y0", column(&|door| doors[door].rect.y0))
        .with("x1", column(&|door| doors[door].rect.x1))
        .with("y1", column(&|door| doors[door].rect.y1))
        .with("height1", (0..doors.len()).map(|door| room1(door).height).collect::<Column>())
        .with("width1", column(&|door| room1(door).rect.smaller_side()))
        .with("distance1", column(&|door| distance(door, room1(door))))
        .with("height2", (0..doors.len()).map(|door| room2(door).height).collect::<Column>())
        .with("width2", column(&|door| room2(door).rect.smaller_side()))
        .with("distance2", column(&|door| distance(door, room2(door))))
        .with("one_way", doors.iter().map(|door| door.kind == Kind::Change).collect::<Column>())
}
