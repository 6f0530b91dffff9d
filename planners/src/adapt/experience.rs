//! The experience graph (Chen 1994, section 2): subgoals, and which of them Reach connects.

use std::collections::{BTreeMap, BTreeSet};

use super::robot::{Configuration, distance, length};
use super::workcell::Revision;
use crate::pose::Pose;
use crate::search::ByValue;

/// Number of a vertex; never given twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct VertexId(pub u32);

/// Number of an edge; never given twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EdgeId(pub u32);

/// Where a subgoal hangs (section 2.3).
#[derive(Clone, Debug, PartialEq)]
pub struct TagPoint {
    pub object: String,
    /// The tool's pose in the object's frame.
    pub tool: Pose,
    /// The branch of the inverse kinematics on which the robot is there.
    pub branch: u8,
}

/// A subgoal.
#[derive(Clone, Debug, PartialEq)]
pub struct Vertex {
    pub id: VertexId,
    /// The robot's configuration there, in the cell as it is now.
    pub at: Configuration,
    /// The object with which it moves along; `None` where no object serves.
    pub tag: Option<TagPoint>,
    pub made_task: u32,
}

/// A connection that Reach can follow, or could when it was verified.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    pub id: EdgeId,
    /// The vertices that it connects, the lower number first.
    pub ends: (VertexId, VertexId),
    /// The path of Reach from the first to the second, without both ends; empty where it goes straight.
    pub via: Vec<Configuration>,
    /// Length of the path, by the distance of configurations.
    pub length: f64,
    pub made_task: u32,
    pub verified_task: u32,
    /// The state of the cell in which it was last verified: it is free of all objects that have not changed since.
    pub verified_revision: Revision,
    pub times_verified: u32,
    /// Whether an end of it moved since, so that it has to be verified against all objects.
    pub is_loose: bool,
}

/// The graph, and the numbers that go on from where they were.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Experience {
    vertices: BTreeMap<VertexId, Vertex>,
    edges: BTreeMap<(VertexId, VertexId), Edge>,
    /// The other ends of the edges of each vertex.
    beside: BTreeMap<VertexId, BTreeSet<VertexId>>,
    /// How many vertices hang on each object.
    hung: BTreeMap<String, u32>,
    next_vertex: u32,
    next_edge: u32,
}

impl Edge {
    /// It goes straight from now on, over such a length, and nothing is known of it.
    pub(super) fn loosen(&mut self, length: f64) {
        self.via.clear();
        self.length = length;
        self.is_loose = true;
    }
}

/// Rows that are no graph.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ExperienceError {
    #[error("vertex {} stands twice, or is not below the next number", .0.0)]
    Vertex(VertexId),
    #[error("edge {} has a vertex that is not there, stands twice, or is not below the next number", .0.0)]
    Edge(EdgeId),
}

impl Experience {
    /// A graph from its rows, in any order; `next` are the numbers that the next vertex and the next edge get.
    pub fn from_rows(
        vertices: Vec<Vertex>,
        edges: Vec<Edge>,
        next: (u32, u32),
    ) -> Result<Self, ExperienceError> {
        let mut graph = Self { next_vertex: next.0, next_edge: next.1, ..Self::default() };
        for vertex in vertices {
            let id = vertex.id;
            if id.0 >= next.0 || graph.put_vertex(vertex).is_some() {
                return Err(ExperienceError::Vertex(id));
            }
        }
        for edge in edges {
            let (id, ends) = (edge.id, edge.ends);
            let is_there = |end| graph.vertices.contains_key(&end);
            let is_wrong = id.0 >= next.1 || ends.0 >= ends.1 || !is_there(ends.0) || !is_there(ends.1);
            if is_wrong || graph.put_edge(edge).is_some() {
                return Err(ExperienceError::Edge(id));
            }
        }
        Ok(graph)
    }

    /// The vertices, by number.
    pub fn vertices(&self) -> impl Iterator<Item = &Vertex> {
        self.vertices.values()
    }

    /// The edges, by their ends.
    pub fn edges(&self) -> impl Iterator<Item = &Edge> {
        self.edges.values()
    }

    pub fn next_numbers(&self) -> (u32, u32) {
        (self.next_vertex, self.next_edge)
    }

    pub fn vertex(&self, id: VertexId) -> Option<&Vertex> {
        self.vertices.get(&id)
    }

    pub fn edge(&self, a: VertexId, b: VertexId) -> Option<&Edge> {
        self.edges.get(&ends(a, b))
    }

    /// The path of Reach along an edge from one of its ends to the other, both included.
    pub fn path(&self, from: VertexId, to: VertexId) -> Option<Vec<Configuration>> {
        let edge = self.edge(from, to)?;
        let mut path = vec![self.vertices.get(&edge.ends.0)?.at.clone()];
        path.extend(edge.via.iter().cloned());
        path.push(self.vertices.get(&edge.ends.1)?.at.clone());
        if edge.ends.0 != from {
            path.reverse();
        }
        Some(path)
    }

    /// The vertices in order of their distance to a configuration (the paper's heuristic h1); of equally far ones the lower number
    /// first.
    pub fn by_distance(&self, to: &[f64]) -> Vec<VertexId> {
        let all = self.vertices.values().map(|vertex| (ByValue(distance(&vertex.at, to)), vertex.id));
        let mut all: Vec<(ByValue, VertexId)> = all.collect();
        all.sort_unstable();
        all.into_iter().map(|(_, id)| id).collect()
    }

    pub(super) fn add_vertex(&mut self, at: Configuration, tag: Option<TagPoint>, made_task: u32) -> &Vertex {
        let id = VertexId(self.next_vertex);
        self.next_vertex += 1;
        self.put_vertex(Vertex { id, at, tag, made_task });
        &self.vertices[&id]
    }

    fn put_vertex(&mut self, vertex: Vertex) -> Option<Vertex> {
        if let Some(tag) = &vertex.tag {
            *self.hung.entry(tag.object.clone()).or_default() += 1;
        }
        self.vertices.insert(vertex.id, vertex)
    }

    /// How many vertices hang on an object.
    pub(super) fn hung_on(&self, object: &str) -> u32 {
        self.hung.get(object).copied().unwrap_or(0)
    }

    /// Connects two vertices by a path of Reach from one to the other, both ends included; an edge between them is replaced.
    pub(super) fn add_edge(
        &mut self,
        from: VertexId,
        to: VertexId,
        mut path: Vec<Configuration>,
        when: (u32, Revision),
    ) -> &Edge {
        let id = EdgeId(self.next_edge);
        self.next_edge += 1;
        if from > to {
            path.reverse();
        }
        let length = length(&path);
        let via = path.split_off(1).into_iter().rev().skip(1).rev().collect();
        let edge = Edge {
            id,
            ends: ends(from, to),
            via,
            length,
            made_task: when.0,
            verified_task: when.0,
            verified_revision: when.1,
            times_verified: 1,
            is_loose: false,
        };
        self.put_edge(edge);
        &self.edges[&ends(from, to)]
    }

    fn put_edge(&mut self, edge: Edge) -> Option<Edge> {
        let (a, b) = edge.ends;
        self.beside.entry(a).or_default().insert(b);
        self.beside.entry(b).or_default().insert(a);
        self.edges.insert(edge.ends, edge)
    }

    pub(super) fn edge_mut(&mut self, a: VertexId, b: VertexId) -> Option<&mut Edge> {
        self.edges.get_mut(&ends(a, b))
    }

    pub(super) fn remove_edge(&mut self, a: VertexId, b: VertexId) -> Option<Edge> {
        for (one, other) in [(a, b), (b, a)] {
            if let Some(beside) = self.beside.get_mut(&one) {
                beside.remove(&other);
            }
        }
        self.edges.remove(&ends(a, b))
    }

    /// Takes a vertex out; its edges have to be out before.
    pub(super) fn remove_vertex(&mut self, id: VertexId) -> Option<Vertex> {
        let vertex = self.vertices.remove(&id)?;
        self.beside.remove(&id);
        if let Some(tag) = &vertex.tag
            && let Some(count) = self.hung.get_mut(&tag.object)
        {
            *count -= 1;
        }
        Some(vertex)
    }

    pub(super) fn edges_of(&self, id: VertexId) -> Vec<EdgeEnds> {
        self.beside.get(&id).into_iter().flatten().map(|&other| ends(id, other)).collect()
    }

    /// The edges of a vertex, by its neighbours' numbers.
    pub(super) fn edges_at(&self, id: VertexId) -> impl Iterator<Item = &Edge> {
        self.beside.get(&id).into_iter().flatten().filter_map(move |&other| self.edge(id, other))
    }

    /// Moves a vertex; nothing is known any more of its edges, which go straight from now on.
    pub(super) fn move_vertex(&mut self, id: VertexId, at: Configuration) {
        if let Some(vertex) = self.vertices.get_mut(&id) {
            vertex.at = at;
        }
    }
}

/// The two vertices of an edge, the lower number first.
pub(super) type EdgeEnds = (VertexId, VertexId);

pub(super) fn ends(a: VertexId, b: VertexId) -> EdgeEnds {
    (a.min(b), a.max(b))
}
