//! The graph of a site, for searches: which rooms and doors there are, and where points and names lie in it.

mod boundary;
mod building;
mod ends;
pub(crate) mod gauge;
pub(crate) mod itinerary;
mod layers;
mod named;
mod one_way;
pub(crate) mod pairs;
mod texts;

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::{self, Range};
use std::sync::Arc;

use adit_db::Tx;
use adit_db::door::{Door, DoorKind, Side};
use adit_db::place::Place;
use adit_db::room::Room;
use adit_db::schema::Row;
use adit_db::space::Doorway;
use adit_db::weight::Weight;
use adit_planners::geometry::tolerance::SNAP_M;
use adit_planners::geometry::{Convex, Point, Segment};
use adit_planners::rooms::outline;
use adit_planners::routes::{
    Berth, Closed, Crossing, DoorIndex, RoomIndex, RouteDoor, RouteGraph, RouteRoom, Walking,
};
use rayon::prelude::*;

pub use boundary::Closer;
use layers::Layer;

use crate::error;
use crate::knowledge::told::Whom;
use crate::words::point::point;
use crate::words::suggest::{did_you_mean, listed};

pub use building::{Building, why_one_way};
pub use layers::rect_of;
pub use named::Named;
pub use one_way::OneWay;

pub use texts::{Texts, word};

/// Rooms, doors and places as they stand in the tables, ready to be searched.
#[derive(Clone)]
pub struct SiteGraph {
    /// Rows of `rooms`, by [`RoomIndex`].
    pub rooms: Vec<Room>,
    /// Rows of `doors`, by [`DoorIndex`].
    pub doors: Vec<Door>,
    /// Rows of `places`, by index.
    pub places: Vec<Place>,
    pub building: Arc<Building>,
    graph: RouteGraph,
    /// The doors that are told to let nobody through.
    closed: BTreeSet<DoorIndex>,
    /// Of each closed boundary of the graph what closes it.
    closers: Vec<Closer>,
    index: Arc<Index>,
    texts: Option<Texts>,
}

/// Where to find what; the same for all copies, however they are weighed.
struct Index {
    /// Only looked up in: no order of theirs can reach an answer.
    room_by_key: HashMap<i64, RoomIndex>,
    room_by_name: HashMap<String, RoomIndex>,
    place_by_name: HashMap<String, usize>,
    layers: Vec<Layer>,
}

/// Names of the rules by their number.
pub type Rules = BTreeMap<i64, String>;

/// Something that a route starts from or leads to.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    Room(RoomIndex),
    /// A place, by index.
    Place(usize),
    /// A point that has no name.
    Point(Point),
    /// A space, by where it is widest; where nothing fits there, the nearest point is as good.
    Space(Point),
}

impl SiteGraph {
    /// Indexes the tables.
    pub fn new(
        mut rooms: Vec<Room>,
        mut doors: Vec<Door>,
        places: Vec<Place>,
        building: Arc<Building>,
    ) -> Self {
        let mut route_rooms = Vec::with_capacity(rooms.len());
        let outlines: Vec<_> = rooms.par_iter().map(outline_of).collect();
        let mut outlines = outlines.into_iter();
        // a room whose outline somebody else spoilt is none until it is built again
        rooms.retain(|room| {
            let outline = outlines.next().and_then(Result::ok);
            let is_kept = outline.is_some();
            route_rooms.extend(outline.map(|outline| RouteRoom {
                outline,
                radius: room.radius,
                berth: Berth { metres: room.berth.unwrap_or(0.0), share: room.berth_cost.unwrap_or(0.0) },
                walking: walking_in(room),
            }));
            is_kept
        });
        let room_by_key =
            rooms.iter().enumerate().map(|(index, room)| (room.room, RoomIndex::new(index))).collect();
        let route_doors = route_doors(&doors, &room_by_key, &route_rooms);
        // a door whose rooms somebody else took away leads nowhere
        let mut is_kept = route_doors.iter().map(Option::is_some);
        doors.retain(|_| is_kept.next().unwrap_or(false));
        let route_doors = route_doors.into_iter().flatten().collect();
        let named = |(index, room): (usize, &Room)| (room.name.clone(), RoomIndex::new(index));
        // of places of one name the first counts
        let placed = |(index, place): (usize, &Place)| (place.place.clone(), index);
        let (graph, index) = rayon::join(
            || RouteGraph::new(route_rooms, route_doors),
            || Index {
                room_by_key,
                room_by_name: rooms.iter().enumerate().map(named).collect(),
                place_by_name: places.iter().enumerate().rev().map(placed).collect(),
                layers: Layer::all(&rooms),
            },
        );
        let closed =
            (0..doors.len()).filter(|&door| is_told_closed(&doors[door])).map(DoorIndex::new).collect();
        let (closers, index) = (Vec::new(), Arc::new(index));
        let mut all = Self { rooms, doors, places, building, graph, closed, closers, index, texts: None };
        all.close();
        all
    }

    /// As the last build kept it.
    pub fn read(tx: &mut Tx<'_>) -> error::Result<Self> {
        Ok(Self::new(tx.rooms()?, tx.doors()?, tx.places()?, Arc::new(Building::read(tx)?)))
    }

    /// Closes doors that are told to let nobody through, and doorways that nobody passes, for every state.
    fn close(&mut self) {
        let (mut closers, mut boundaries) = (Vec::new(), Vec::new());
        let mut add = |closer, segments: Vec<Segment>, of: Closed| {
            closers.resize(closers.len() + segments.len(), closer);
            boundaries.extend(segments.into_iter().map(|segment| Closed { segment, ..of.clone() }));
        };
        for &door in &self.closed {
            let segments = self.of_door(&self.graph[door]);
            let Some(&of) = segments.first() else { continue };
            add(Closer::Door(door), segments, Closed::for_all(of));
        }
        for doorway in self.building.closed() {
            let of = match self.building.one_way(doorway) {
                Some(segment) => Closed::to_left(segment),
                None => Closed::for_all(Building::segment(doorway)),
            };
            add(Closer::Doorway(doorway.doorway), self.of_doorway(of.segment), of);
        }
        for (number, line) in self.building.lines.iter().enumerate() {
            let [x0, y0, x1, y1] = line.segment;
            let segment = Segment::new(Point::new(x0, y0), Point::new(x1, y1));
            let only = self.rooms_of(&line.whom);
            let (segments, of) = match &line.area {
                Some(_) => (vec![segment], Closed::to_left(segment)),
                None => (self.of_doorway(segment), Closed::for_all(segment)),
            };
            add(Closer::Line(number), segments, Closed { only, ..of });
        }
        for (number, area) in self.building.one_ways.iter().enumerate() {
            for of in area.boundaries() {
                add(Closer::OneWay(number), vec![of.segment], of);
            }
        }
        self.graph.close(boundaries);
        self.closers = closers;
    }

    /// The rooms of some robots, by index; `None`: all.
    fn rooms_of(&self, whom: &Whom) -> Option<Vec<Range<usize>>> {
        if *whom == Whom::All {
            return None;
        }
        let mut found: Vec<Range<usize>> = Vec::new();
        for (index, room) in self.rooms.iter().enumerate() {
            // rooms of the paper's modes are anybody's
            if room.layer.as_ref().is_some_and(|(robot, _)| !whom.holds_for(robot)) {
                continue;
            }
            match found.last_mut().filter(|last| last.end == index) {
                Some(last) => last.end += 1,
                None => found.push(index..index + 1),
            }
        }
        Some(found)
    }

    /// What people call the doorway through which a door leads into another space.
    pub fn doorway(&self, door: &Door) -> Option<String> {
        self.doorway_of(door).map(Building::name)
    }

    /// The doorway through which a door leads into another space.
    pub fn doorway_of(&self, door: &Door) -> Option<&Doorway> {
        let space = |side: &Side| self[self.room(side.room)?].space;
        let [one, other] = [space(&door.side1)?, space(&door.side2)?];
        let at = Point::new(door.at[0], door.at[1]);
        self.building.doorway(one, other, at).filter(|_| door.kind == DoorKind::Door)
    }

    /// What closes a boundary of the graph.
    pub fn closer(&self, boundary: usize) -> Closer {
        self.closers[boundary]
    }

    /// Makes answers quick between any two ends. Copies made from now on are prepared, too.
    pub fn prepare(&mut self) {
        self.graph.prepare();
        self.texts.get_or_insert_with(|| Texts::new(self.rooms.len(), self.doors.len()));
    }

    /// What answers over doors say of rooms and doors; `None` where it is not [prepared](Self::prepare), or rooms weigh
    /// their metres.
    pub fn texts(&self) -> Option<&Texts> {
        self.texts.as_ref().filter(|_| self.graph.is_on_doors())
    }

    /// The graph that is searched.
    pub fn graph(&self) -> &RouteGraph {
        &self.graph
    }

    /// Gives rooms and doors other weights.
    pub fn write(
        &mut self,
        rooms: impl IntoParallelIterator<Iter: IndexedParallelIterator, Item = (RoomIndex, Weight)>,
        doors: impl IntoParallelIterator<Iter: IndexedParallelIterator, Item = (DoorIndex, Weight)>,
        building: &Arc<Building>,
    ) {
        let rooms = put(&mut self.rooms, rooms, RoomIndex::index, walked);
        let doors = put(&mut self.doors, doors, DoorIndex::index, passed);
        self.weigh(rooms, doors, building);
    }

    /// Takes over the weights of some rooms and doors of another copy, and gives some other weights.
    pub fn follow(
        &mut self,
        from: &Self,
        (late_rooms, late_doors): (&[RoomIndex], &[DoorIndex]),
        rooms: impl IntoParallelIterator<Iter: IndexedParallelIterator, Item = (RoomIndex, Weight)>,
        doors: impl IntoParallelIterator<Iter: IndexedParallelIterator, Item = (DoorIndex, Weight)>,
        building: &Arc<Building>,
    ) {
        for &room in late_rooms {
            self.rooms[room.index()].clone_from(&from[room]);
        }
        for &door in late_doors {
            self.doors[door.index()].clone_from(&from[door]);
        }
        let mut rooms = put(&mut self.rooms, rooms, RoomIndex::index, walked);
        let mut doors = put(&mut self.doors, doors, DoorIndex::index, passed);
        rooms.extend(late_rooms.iter().map(|&room| walked(room, &self[room])));
        doors.extend(late_doors.iter().map(|&door| passed(door, &self[door])));
        self.weigh(rooms, doors, building);
    }

    /// Lets searches see the weights of these rows.
    fn weigh(&mut self, rooms: Vec<(RoomIndex, Walking)>, doors: Vec<Passed>, building: &Arc<Building>) {
        let is_other = self.building != *building;
        let mut is_closed_otherwise = is_other;
        for Passed { door, is_told_closed, .. } in &doors {
            is_closed_otherwise |=
                if *is_told_closed { self.closed.insert(*door) } else { self.closed.remove(door) };
        }
        if is_other {
            self.building = Arc::clone(building);
            // steps name spaces and doorways
            self.texts = self.texts.take().map(|_| Texts::new(self.rooms.len(), self.doors.len()));
        }
        if is_closed_otherwise {
            self.close();
        }
        if let Some(texts) = &mut self.texts {
            texts.forget(rooms.iter().map(|(room, _)| *room), doors.iter().map(|passed| passed.door));
        }
        self.graph.reweigh(rooms, doors.into_iter().map(|of| (of.door, of.hardness, of.passable)));
    }

    /// The room with this key.
    pub fn room(&self, key: i64) -> Option<RoomIndex> {
        self.index.room_by_key.get(&key).copied()
    }

    /// The door with this key.
    pub fn door(&self, key: i64) -> Option<DoorIndex> {
        self.doors.binary_search_by_key(&key, |door| door.door).ok().map(DoorIndex::new)
    }

    /// The node of a place.
    pub fn place_node(&self, place: &str) -> Option<i64> {
        self.index.place_by_name.get(place).copied().map(place_node)
    }

    /// The place whose node this is.
    pub fn place_of(&self, node: i64) -> Option<&str> {
        let index = usize::try_from(-node - 1).ok()?;
        self.places.get(index).map(|place| place.place.as_str())
    }

    /// The robots that have rooms of their own; none in the paper's modes.
    pub fn robots(&self) -> Vec<String> {
        let mut robots: Vec<String> = self
            .rooms
            .iter()
            .filter_map(|room| room.layer.as_ref().map(|(robot, _)| robot.clone()))
            .collect();
        robots.sort_unstable();
        robots.dedup();
        robots
    }

    /// What a name means: a place, a room, `x,y`, a space (where it is widest), or a room as answers call it: `room d`.
    pub fn end(&self, name: &str) -> Option<End> {
        if let Some(index) = self.index.place_by_name.get(name) {
            return Some(End::Place(*index));
        }
        if let Some(index) = self.index.room_by_name.get(name) {
            return Some(End::Room(*index));
        }
        if let Some(point) = point(name) {
            return Some(End::Point(point));
        }
        if let Some(space) = self.building.space_named(name) {
            return Some(End::Space(Point::new(space.x, space.y)));
        }
        self.index.room_by_name.get(name.strip_prefix("room ")?).copied().map(End::Room)
    }

    /// What is said of a name that no end has.
    pub fn no_end(&self, name: &str) -> (String, Option<String>) {
        let spaces = self.building.spaces.iter().filter_map(|space| self.building.space(space.space));
        let spaces: Vec<String> = spaces.collect();
        let places = || self.places.iter().map(|place| place.place.as_str());
        let rooms = self.rooms.iter().map(|room| room.name.as_str());
        let known = places().chain(spaces.iter().map(String::as_str)).chain(rooms);
        let places = || listed("places", places());
        let message = format!("`{name}` is no place, no space, no room and no point `x,y`");
        (message, did_you_mean(name, known).or_else(places))
    }

    /// The names of all places and rooms, places first.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.places
            .iter()
            .map(|place| place.place.as_str())
            .chain(self.rooms.iter().map(|room| room.name.as_str()))
    }

    /// Where an end is: a room stands for its centre.
    pub fn point(&self, end: &End) -> Point {
        match end {
            End::Room(index) => self.outline(*index).centre(),
            End::Place(index) => Point::new(self.places[*index].x, self.places[*index].y),
            End::Point(point) | End::Space(point) => *point,
        }
    }

    pub fn outline(&self, room: RoomIndex) -> &Convex {
        &self.graph[room].outline
    }

    /// Whether a room is this end, or holds it.
    pub fn holds(&self, room: RoomIndex, end: &End) -> bool {
        match end {
            End::Room(index) => *index == room,
            _ => self.outline(room).contains(self.point(end)),
        }
    }
}

impl ops::Index<RoomIndex> for SiteGraph {
    type Output = Room;

    fn index(&self, room: RoomIndex) -> &Room {
        &self.rooms[room.index()]
    }
}

impl ops::Index<DoorIndex> for SiteGraph {
    type Output = Door;

    fn index(&self, door: DoorIndex) -> &Door {
        &self.doors[door.index()]
    }
}

/// The point that `x,y` is.
/// Whether a room can be walked in: its hardness is known and it is passable, as with doors.
pub fn is_weighed(room: &Room) -> bool {
    walking_in(room) != Walking::Unknown
}

/// Whether a door lets nobody through because that is told of it, not because a rule says so: a rule speaks of the one
/// layer's door, what is told of the place.
fn is_told_closed(door: &Door) -> bool {
    door.kind == DoorKind::Door && door.passable.value == Some(false) && door.passable.rule.is_none()
}

/// Rooms of a state weigh their metres; of unknown hardness they are not entered. Rooms of the paper's modes weigh
/// metres only where a rule says so. Rooms that are not passable, or not known to be, are not entered.
pub(crate) fn walking(hardness: Option<f64>, passable: Option<bool>, of_state: bool) -> Walking {
    if passable != Some(true) {
        return Walking::Unknown;
    }
    match (hardness, of_state) {
        (Some(hardness), _) => Walking::PerMetre(hardness),
        (None, true) => Walking::Unknown,
        (None, false) => Walking::OnDoors,
    }
}

fn walking_in(room: &Room) -> Walking {
    walking(room.hardness.value, room.passable.value, room.layer.is_some())
}

/// The outline of a room; an error is what is wrong with it, without its subject.
pub fn outline_of(room: &Room) -> Result<Convex, String> {
    outline::read(room.outline.as_deref(), rect_of(room))
}

/// Where a door between rooms of these outlines is crossed.
pub fn crossing_of(door: &Door, [one, other]: [&Convex; 2]) -> Crossing {
    let [x0, y0, x1, y1] = door.segment;
    let across = Segment::new(Point::new(x0, y0), Point::new(x1, y1));
    match door.kind {
        DoorKind::Door => Crossing::Through(across),
        DoorKind::Change => {
            // there and back it is one area, to the bit
            let (one, other) = if door.side1.room <= door.side2.room { (one, other) } else { (other, one) };
            Crossing::Within(outline::shared(one, other, across.bounds()))
        }
    }
}

/// Doors as searches see them; `None` for one whose rooms are not there.
fn route_doors(
    doors: &[Door],
    keys: &HashMap<i64, RoomIndex>,
    rooms: &[RouteRoom],
) -> Vec<Option<RouteDoor>> {
    let room = |key: i64| keys.get(&key).map_or(RoomIndex::end(), |room| *room);
    let crossing = |door: &Door, ends: [RoomIndex; 2]| {
        let is_known = !ends.contains(&RoomIndex::end());
        is_known.then(|| crossing_of(door, ends.map(|room| &rooms[room.index()].outline)))
    };
    let is_back = |door: &Door, [from, to]: [RoomIndex; 2]| door.kind == DoorKind::Change && from > to;
    let first = |door: &Door| {
        let ends = [room(door.side1.room), room(door.side2.room)];
        (ends, if is_back(door, ends) { None } else { crossing(door, ends) })
    };
    let (ends, crossings): (Vec<[RoomIndex; 2]>, Vec<Option<Crossing>>) = doors.par_iter().map(first).unzip();
    // what is cut for the way there is not cut again for the way back; doors mostly stand in the order of their rooms
    let there = |door: &Door, [from, to]: [RoomIndex; 2]| {
        let there = ends.binary_search(&[to, from]).ok()?;
        let [x0, y0, x1, y1] = door.segment;
        let within = Segment::new(Point::new(x0, y0), Point::new(x1, y1)).bounds().grown(SNAP_M);
        let is_same = |there: &&Crossing| there.area().is_some_and(|area| within.encloses(&area.bounds()));
        crossings[there].as_ref().filter(is_same).cloned()
    };
    let route_door = |(place, door): (usize, &Door)| {
        let [room1, room2] = ends[place];
        let crossing = if is_back(door, ends[place]) {
            there(door, ends[place]).or_else(|| crossing(door, ends[place]))?
        } else {
            crossings[place].clone()?
        };
        Some(RouteDoor {
            door: u32::try_from(door.door).ok()?,
            room1,
            room2,
            crossing,
            at: Point::new(door.at[0], door.at[1]),
            hardness: door.hardness.value,
            passable: door.passable.value.unwrap_or(false),
            one_way: door.one_way,
        })
    };
    doors.par_iter().enumerate().map(route_door).collect()
}

/// What a search sees of a door that weighs otherwise.
struct Passed {
    door: DoorIndex,
    hardness: Option<f64>,
    passable: bool,
    is_told_closed: bool,
}

fn passed(index: DoorIndex, door: &Door) -> Passed {
    Passed {
        door: index,
        hardness: door.hardness.value,
        passable: door.passable.value.unwrap_or(false),
        is_told_closed: is_told_closed(door),
    }
}

fn walked(index: RoomIndex, room: &Room) -> (RoomIndex, Walking) {
    (index, walking_in(room))
}

/// Writes weights into rows, of each of which there is one at most, in their order; what is seen of these rows then.
fn put<R: Row + Send, I: Copy + Send, S: Send>(
    rows: &mut [R],
    weights: impl IntoParallelIterator<Iter: IndexedParallelIterator, Item = (I, Weight)>,
    place: fn(I) -> usize,
    seen: fn(I, &R) -> S,
) -> Vec<S> {
    let weights = weights.into_par_iter();
    if weights.len() == rows.len() {
        let put = |(row, (index, weight)): (&mut R, (I, Weight))| {
            row.weigh(weight);
            seen(index, row)
        };
        return rows.par_iter_mut().zip(weights).map(put).collect();
    }
    let weights: Vec<(I, Weight)> = weights.collect();
    let put = |(index, weight): (I, Weight)| {
        let row = &mut rows[place(index)];
        row.weigh(weight);
        seen(index, row)
    };
    weights.into_iter().map(put).collect()
}

/// A name of the cut of a floor: rooms, doors and places by their geometry.
pub fn layout(graph: &SiteGraph) -> Arc<str> {
    let mut hasher = DefaultHasher::new();
    for room in &graph.rooms {
        (room.room, &room.name, room.rect.map(f64::to_bits), &room.outline, &room.layer).hash(&mut hasher);
    }
    for door in &graph.doors {
        (door.door, door.side1.room, door.side2.room, door.segment.map(f64::to_bits)).hash(&mut hasher);
    }
    for place in &graph.places {
        (&place.place, place.x.to_bits(), place.y.to_bits()).hash(&mut hasher);
    }
    format!("{:016x}", hasher.finish()).into()
}

/// The node of a place.
pub fn place_node(index: usize) -> i64 {
    -(index as i64) - 1
}

/// Degrees counterclockwise from x; `None` where nothing moves.
pub fn heading(from: Point, to: Point) -> Option<f64> {
    // to a hundredth, as the tables keep it
    let degrees = (to.y - from.y).atan2(to.x - from.x).to_degrees();
    (from.distance(to) > 1e-9).then(|| (degrees * 100.0).round() / 100.0)
}
