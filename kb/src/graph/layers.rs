//! The rooms by layer, found by where they are.

use std::collections::VecDeque;
use std::iter;

use adit_db::room::Room;
use adit_planners::geometry::{Point, Rect};
use adit_planners::rect_index::RectIndex;
use adit_planners::routes::{RoomIndex, RouteGraph};
use rayon::prelude::*;

/// Robot and state, and the degrees to which it faces; neither in the paper's modes.
pub type Shape<'a> = (Option<&'a (String, String)>, Option<f64>);

/// The rooms of one state of one robot, at one facing; in the paper's modes there is one layer.
pub struct Layer {
    /// Robot and state.
    of: Option<(String, String)>,
    facing: Option<f64>,
    /// In their order.
    rooms: Vec<RoomIndex>,
    index: RectIndex,
}

impl Layer {
    /// The layers of all rooms.
    pub fn all(rooms: &[Room]) -> Vec<Self> {
        let mut layers: Vec<(&Room, Vec<RoomIndex>)> = Vec::new();
        let is_like = |one: &Room, two: &Room| one.layer == two.layer && one.facing == two.facing;
        for (index, room) in rooms.iter().enumerate().map(|(index, room)| (RoomIndex::new(index), room)) {
            // rooms of a layer mostly follow one another
            match layers.iter_mut().rev().find(|(first, _)| is_like(first, room)) {
                Some((_, members)) => members.push(index),
                None => layers.push((room, vec![index])),
            }
        }
        let layer = |(first, members): (&Room, Vec<RoomIndex>)| Self {
            of: first.layer.clone(),
            facing: first.facing,
            index: RectIndex::new(members.iter().map(|&room| rect_of(&rooms[room.index()]))),
            rooms: members,
        };
        layers.into_par_iter().map(layer).collect()
    }

    /// The rooms that hold a point.
    pub fn at(&self, graph: &RouteGraph, point: Point) -> impl Iterator<Item = RoomIndex> {
        let rooms = self.index.at(point).into_iter().map(|member| self.rooms[member]);
        rooms.filter(move |&room| graph[room].outline.contains(point))
    }

    /// The rooms with their metres from a point, the nearest first.
    pub fn nearest(&self, graph: &RouteGraph, point: Point) -> impl Iterator<Item = (RoomIndex, f64)> {
        let mut boxes = self.index.nearest(point).peekable();
        let mut waiting: VecDeque<(RoomIndex, f64)> = VecDeque::new();
        iter::from_fn(move || {
            // a room is at least as far away as the box about it
            while let Some((member, metres)) =
                boxes.next_if(|(_, metres)| waiting.front().is_none_or(|(_, nearest)| metres < nearest))
            {
                let room = self.rooms[member];
                let outline = &graph[room].outline;
                let metres = if outline.rect().is_some() { metres } else { outline.distance(point) };
                waiting.insert(waiting.partition_point(|(_, nearer)| *nearer <= metres), (room, metres));
            }
            waiting.pop_front()
        })
    }

    /// The rooms about which a box meets a rectangle.
    pub fn meeting(&self, rect: Rect) -> impl Iterator<Item = RoomIndex> {
        self.index.meeting(rect).map(|member| self.rooms[member])
    }

    pub fn holds(&self, room: RoomIndex) -> bool {
        self.rooms.contains(&room)
    }

    /// Whether it is a robot's; those of the paper's modes are anybody's.
    pub fn is_of(&self, robot: &str) -> bool {
        self.of.as_ref().is_none_or(|(of, _)| of == robot)
    }

    pub fn state(&self) -> Option<&str> {
        self.of.as_ref().map(|(_, state)| state.as_str())
    }

    /// Robot and state, and the degrees to which it faces.
    pub fn shape(&self) -> Shape<'_> {
        (self.of.as_ref(), self.facing)
    }
}

pub fn rect_of(room: &Room) -> Rect {
    let [x0, y0, x1, y1] = room.rect;
    Rect::new(x0, y0, x1, y1)
}
