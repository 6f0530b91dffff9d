//! A planner of rooms that are no rectangles, whatever the map: it cuts the floor along slanted lines, for each state
//! elsewhere, and takes no heed of walls.

use adit_planners::facts::{Column, Facts, Table};
use adit_planners::geometry::{Convex, Point, Segment};
use adit_planners::planner::{Planner, PlannerError, Signature};
use adit_planners::rooms::outline;
use adit_planners::world::World;

/// The planner. Of each robot's states that move, the last one has one room, the floor; of the others the room in the
/// lower right corner is missing. On a floor wider than 12 m rooms are numbered the other way round.
pub struct SlantedRooms;

struct Room {
    robot: Option<String>,
    state: Option<String>,
    outline: Convex,
}

struct Door {
    rooms: [usize; 2],
    across: Segment,
    /// What both rooms have in common, where it is a change of shape.
    area: Option<Convex>,
}

impl Planner for SlantedRooms {
    fn name(&self) -> &'static str {
        "slanted rooms"
    }

    fn signature(&self) -> Signature {
        let rooms = "room name:text robot:text state:text facing x0 y0 x1 y1 outline:text height width";
        let doors = "door kind:text room1 room2 x y width x0 y0 x1 y1 height1 width1 distance1 height2 width2 \
                     distance2 one_way:truth";
        let of = |class: &str, names: &str| -> Vec<String> {
            names.split_whitespace().map(|name| format!("{class}.{name}")).collect()
        };
        Signature {
            needs: of("ROBOTS", "robot state height width length moves"),
            gives: [of("ROOMS", rooms), of("DOORS", doors)].concat(),
        }
    }

    fn facts(&self, world: &World, known: &Facts) -> Result<Facts, PlannerError> {
        let wrong = |what| PlannerError::Fact { planner: self.name().into(), class: "ROBOTS".into(), what };
        let states = known.get("ROBOTS").ok_or_else(|| wrong("is missing".to_owned()))?;
        let rooms = rooms(world, states).map_err(wrong)?;
        let doors = doors(&rooms);
        Ok(Facts::from([
            ("ROOMS".to_owned(), room_table(&rooms)),
            ("DOORS".to_owned(), door_table(&rooms, &doors)),
        ]))
    }
}

/// The pieces of a floor for a state of this width.
fn pieces(floor: &Convex, width: f64) -> Vec<Convex> {
    let line =
        |from: (f64, f64), to: (f64, f64)| Segment::new(Point::new(from.0, from.1), Point::new(to.0, to.1));
    // each line has what is wanted first to its left
    let [below, rest] = halves(floor, line((6.0 + width, 0.0), (0.0, 6.0 + width)));
    let [band, above] = halves(&rest, line((12.0, 2.0), (6.0, 8.0)));
    let [left, right] = halves(&band, line((2.0 + width, 0.0), (10.0 + width, 8.0)));
    let [middle, corner] = halves(&right, line((5.6, 0.0), (12.0, 6.4)));
    vec![below, above, left, middle, corner]
}

/// What of a piece lies to the left of a line, and what to its right.
fn halves(piece: &Convex, by: Segment) -> [Convex; 2] {
    [by, by.reversed()].map(|side| piece.left_of(side).expect("the line cuts the piece"))
}

fn rooms(world: &World, states: &Table) -> Result<Vec<Room>, String> {
    let (robots, names) = (states.texts("robot")?, states.texts("state")?);
    let (widths, moves) = (states.numbers("width")?, states.truths("moves")?);
    let moving: Vec<usize> = (0..states.len()).filter(|&row| moves[row] == Some(true)).collect();
    let floor = Convex::from(world.bounds);
    let corner = Point::new(world.bounds.x1, world.bounds.y0);
    let mut rooms = Vec::new();
    for &row in &moving {
        let is_last = !moving.iter().any(|&other| other > row && robots[other] == robots[row]);
        let outlines = if is_last { vec![floor.clone()] } else { pieces(&floor, widths[row].unwrap_or(1.0)) };
        let outlines = outlines.into_iter().filter(|piece| is_last || !piece.contains(corner));
        rooms.extend(outlines.map(|outline| Room {
            robot: robots[row].clone(),
            state: names[row].clone(),
            outline,
        }));
    }
    if world.bounds.dx() > 12.0 {
        rooms.reverse();
    }
    Ok(rooms)
}

fn doors(rooms: &[Room]) -> Vec<Door> {
    let mut doors = Vec::new();
    for (first, one) in rooms.iter().enumerate() {
        for (second, other) in rooms.iter().enumerate() {
            let is_one_layer = (&one.robot, &one.state) == (&other.robot, &other.state);
            if is_one_layer && first < second {
                let across = one.outline.border(&other.outline);
                doors.extend(across.map(|across| Door { rooms: [first, second], across, area: None }));
            } else if !is_one_layer && one.robot == other.robot {
                let Some(area) = one.outline.common(&other.outline) else { continue };
                let about = area.bounds();
                let across = Segment::new(Point::new(about.x0, about.y0), Point::new(about.x1, about.y1));
                doors.push(Door { rooms: [first, second], across, area: Some(area) });
            }
        }
    }
    doors
}

fn numbers<T>(of: &[T], number: impl Fn(&T) -> f64) -> Column {
    of.iter().map(number).collect()
}

fn room_table(rooms: &[Room]) -> Table {
    let number = |of: &dyn Fn(&Convex) -> f64| numbers(rooms, |room| of(&room.outline));
    Table::default()
        .with("room", (1..=rooms.len()).map(|room| room as f64).collect::<Column>())
        .with("name", (1..=rooms.len()).map(|room| format!("r{room}")).collect::<Column>())
        .with("robot", rooms.iter().map(|room| room.robot.clone()).collect::<Column>())
        .with("state", rooms.iter().map(|room| room.state.clone()).collect::<Column>())
        .with("facing", Column::Number(vec![None; rooms.len()]))
        .with("x0", number(&|outline| outline.bounds().x0))
        .with("y0", number(&|outline| outline.bounds().y0))
        .with("x1", number(&|outline| outline.bounds().x1))
        .with("y1", number(&|outline| outline.bounds().y1))
        .with("outline", rooms.iter().map(|room| outline::write(&room.outline)).collect::<Column>())
        .with("height", Column::Number(vec![None; rooms.len()]))
        .with("width", number(&Convex::breadth))
}

fn door_table(rooms: &[Room], doors: &[Door]) -> Table {
    let number = |of: &dyn Fn(&Door) -> f64| numbers(doors, of);
    let at = |door: &Door| door.area.as_ref().map_or_else(|| door.across.middle(), Convex::centre);
    let width = |door: &Door| door.area.as_ref().map_or_else(|| door.across.length(), Convex::breadth);
    let kind = |door: &Door| if door.area.is_some() { "change" } else { "door" }.to_owned();
    let mut table = Table::default()
        .with("door", (1..=doors.len()).map(|door| door as f64).collect::<Column>())
        .with("kind", doors.iter().map(kind).collect::<Column>())
        .with("room1", number(&|door| (door.rooms[0] + 1) as f64))
        .with("room2", number(&|door| (door.rooms[1] + 1) as f64))
        .with("x", number(&|door| at(door).x))
        .with("y", number(&|door| at(door).y))
        .with("width", number(&width))
        .with("x0", number(&|door| door.across.a.x))
        .with("y0", number(&|door| door.across.a.y))
        .with("x1", number(&|door| door.across.b.x))
        .with("y1", number(&|door| door.across.b.y));
    for side in 0..2 {
        let outline = |door: &Door| &rooms[door.rooms[side]].outline;
        let name = |of: &str| format!("{of}{}", side + 1);
        table = table
            .with(&name("height"), Column::Number(vec![None; doors.len()]))
            .with(&name("width"), number(&|door| outline(door).breadth()))
            .with(&name("distance"), number(&|door| outline(door).centre().distance(at(door))));
    }
    table.with("one_way", doors.iter().map(|door| door.area.is_some()).collect::<Column>())
}
