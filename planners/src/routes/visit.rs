//! The graph of routes as [petgraph](https://docs.rs/petgraph) asks for one: any of its algorithms can be handed it.
//!
//! Nodes are rooms and edges are passages of doors that are open, both ways where a door is not one-way. An edge weighs the hardness of its door: what walking in a room weighs is not in it, nor is a
//! [closed](RouteGraph::close) boundary.

use std::iter::{Map, Zip};
use std::ops::Range;
use std::slice::Iter;

use fixedbitset::FixedBitSet;
use petgraph::visit::{
    Data, EdgeCount, EdgeIndexable, EdgeRef, GraphBase, GraphProp, IntoEdgeReferences, IntoEdges,
    IntoEdgesDirected, IntoNeighbors, IntoNeighborsDirected, IntoNodeIdentifiers, IntoNodeReferences,
    NodeCompactIndexable, NodeCount, NodeIndexable, Visitable,
};
use petgraph::{Directed, Direction};

use super::graph::RouteGraph;
use super::mesh::Exit;
use super::parts::{DoorIndex, RoomIndex, RouteRoom};
use crate::search::Csr;

type Rooms = Map<Range<usize>, fn(usize) -> RoomIndex>;

fn all(rooms: usize) -> Rooms {
    (0..rooms).map(RoomIndex::new)
}

/// A door that is open, passed one way.
#[derive(Clone, Copy, Debug)]
pub struct OpenDoor<'g> {
    from: RoomIndex,
    to: RoomIndex,
    door: DoorIndex,
    hardness: &'g f64,
}

impl EdgeRef for OpenDoor<'_> {
    type NodeId = RoomIndex;
    type EdgeId = DoorIndex;
    type Weight = f64;

    fn source(&self) -> RoomIndex {
        self.from
    }

    fn target(&self) -> RoomIndex {
        self.to
    }

    fn weight(&self) -> &f64 {
        self.hardness
    }

    fn id(&self) -> DoorIndex {
        self.door
    }
}

/// The passages out of some rooms, or into one.
#[derive(Clone, Debug)]
pub struct OpenDoors<'g> {
    graph: &'g RouteGraph,
    room: RoomIndex,
    direction: Direction,
    exits: std::iter::Chain<Iter<'g, Exit>, Iter<'g, Exit>>,
    /// Those whose turn comes next.
    rooms: Rooms,
}

impl<'g> OpenDoors<'g> {
    fn of(graph: &'g RouteGraph, room: RoomIndex, direction: Direction) -> Self {
        let exits = match direction {
            Direction::Outgoing => graph.exits(room),
            Direction::Incoming => graph.entries().of(room.index()).iter().chain(&[]),
        };
        Self { graph, room, direction, exits, rooms: all(0) }
    }
}

impl<'g> Iterator for OpenDoors<'g> {
    type Item = OpenDoor<'g>;

    fn next(&mut self) -> Option<OpenDoor<'g>> {
        loop {
            for exit in self.exits.by_ref() {
                let Exit { door, to: other } = *exit;
                let Some(hardness) = self.graph[door].hardness.as_ref() else { continue };
                if !self.graph.is_open(door) {
                    continue;
                }
                let (from, to) = match self.direction {
                    Direction::Outgoing => (self.room, other),
                    Direction::Incoming => (other, self.room),
                };
                return Some(OpenDoor { from, to, door, hardness });
            }
            self.room = self.rooms.next()?;
            self.exits = self.graph.exits(self.room);
        }
    }
}

impl RouteGraph {
    /// The doors out of a room, open or not.
    pub(super) fn exits(&self, room: RoomIndex) -> std::iter::Chain<Iter<'_, Exit>, Iter<'_, Exit>> {
        self.exits.portals(room).iter().chain(self.exits.changes(room))
    }

    /// For each room the doors into it, with the rooms that they lead from; found when first asked for.
    pub(super) fn entries(&self) -> &Csr<Exit> {
        self.entries.get_or_init(|| {
            let into = |room: RoomIndex| {
                self.exits(room).map(move |exit| (exit.to.index(), Exit { to: room, ..*exit }))
            };
            Csr::new(self.rooms.len(), self.room_indices().flat_map(into))
        })
    }
}

impl GraphBase for RouteGraph {
    type NodeId = RoomIndex;
    type EdgeId = DoorIndex;
}

impl GraphProp for RouteGraph {
    type EdgeType = Directed;
}

impl Data for RouteGraph {
    type NodeWeight = RouteRoom;
    type EdgeWeight = f64;
}

impl NodeCount for RouteGraph {
    fn node_count(&self) -> usize {
        self.rooms.len()
    }
}

impl NodeIndexable for RouteGraph {
    fn node_bound(&self) -> usize {
        self.rooms.len()
    }

    fn to_index(&self, room: RoomIndex) -> usize {
        room.index()
    }

    fn from_index(&self, room: usize) -> RoomIndex {
        RoomIndex::new(room)
    }
}

impl NodeCompactIndexable for RouteGraph {}

impl EdgeCount for RouteGraph {
    fn edge_count(&self) -> usize {
        self.edge_references().count()
    }
}

impl EdgeIndexable for RouteGraph {
    fn edge_bound(&self) -> usize {
        self.doors.len()
    }

    fn to_index(&self, door: DoorIndex) -> usize {
        door.index()
    }

    fn from_index(&self, door: usize) -> DoorIndex {
        DoorIndex::new(door)
    }
}

impl Visitable for RouteGraph {
    type Map = FixedBitSet;

    fn visit_map(&self) -> FixedBitSet {
        FixedBitSet::with_capacity(self.rooms.len())
    }

    fn reset_map(&self, map: &mut FixedBitSet) {
        map.clear();
        map.grow(self.rooms.len());
    }
}

impl IntoNodeIdentifiers for &RouteGraph {
    type NodeIdentifiers = Rooms;

    fn node_identifiers(self) -> Rooms {
        all(self.rooms.len())
    }
}

impl<'g> IntoNodeReferences for &'g RouteGraph {
    type NodeRef = (RoomIndex, &'g RouteRoom);
    type NodeReferences = Zip<Rooms, Iter<'g, RouteRoom>>;

    fn node_references(self) -> Self::NodeReferences {
        self.node_identifiers().zip(&self.rooms)
    }
}

impl<'g> IntoEdgeReferences for &'g RouteGraph {
    type EdgeRef = OpenDoor<'g>;
    type EdgeReferences = OpenDoors<'g>;

    fn edge_references(self) -> OpenDoors<'g> {
        let exits = [].iter().chain(&[]);
        let (room, direction, rooms) = (RoomIndex::end(), Direction::Outgoing, self.node_identifiers());
        OpenDoors { graph: self, room, direction, exits, rooms }
    }
}

impl<'g> IntoEdges for &'g RouteGraph {
    type Edges = OpenDoors<'g>;

    fn edges(self, room: RoomIndex) -> OpenDoors<'g> {
        OpenDoors::of(self, room, Direction::Outgoing)
    }
}

impl<'g> IntoEdgesDirected for &'g RouteGraph {
    type EdgesDirected = OpenDoors<'g>;

    fn edges_directed(self, room: RoomIndex, direction: Direction) -> OpenDoors<'g> {
        OpenDoors::of(self, room, direction)
    }
}

type Neighbours<'g> = Map<OpenDoors<'g>, fn(OpenDoor<'g>) -> RoomIndex>;

impl<'g> IntoNeighbors for &'g RouteGraph {
    type Neighbors = Neighbours<'g>;

    fn neighbors(self, room: RoomIndex) -> Neighbours<'g> {
        self.edges(room).map(|door| door.to)
    }
}

impl<'g> IntoNeighborsDirected for &'g RouteGraph {
    type NeighborsDirected = Neighbours<'g>;

    fn neighbors_directed(self, room: RoomIndex, direction: Direction) -> Neighbours<'g> {
        let neighbour: fn(OpenDoor<'g>) -> RoomIndex = match direction {
            Direction::Outgoing => |door| door.to,
            Direction::Incoming => |door| door.from,
        };
        self.edges_directed(room, direction).map(neighbour)
    }
}
