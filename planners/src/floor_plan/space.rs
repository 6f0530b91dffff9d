//! The free space of a floor plan: on which sides of its walls it lies.

use super::noding::Noded;
use super::planar::Planar;
use crate::geometry::Point;
use crate::read::{Code, MapErrors, Problem};

/// The outline of all that is solid, and on which sides of it there is free space.
#[derive(Clone, Debug)]
pub(super) struct Space {
    pub plan: Planar,
    /// For each half-edge whether free space lies to its left.
    pub free_half: Vec<bool>,
}

impl Space {
    pub fn new(noded: &Noded, ring_from: usize) -> Self {
        let plan = Planar::new(noded.points.clone(), noded.edges.clone());
        let is_solid = |half: u32| half.is_multiple_of(2) && noded.wall_of[half as usize / 2] >= ring_from;
        let is_free = |face: &Option<u32>| face.is_some_and(|face| !plan.along(face).any(is_solid));
        let free: Vec<bool> = plan.faces().iter().map(is_free).collect();
        let free_half = plan.cycle_of.iter().map(|&cycle| free[cycle as usize]).collect();
        Self { plan, free_half }
    }

    /// Whether a point lies in free space; on its outline it may or may not.
    pub fn is_free(&self, p: Point) -> bool {
        self.cycle_around(p)
            .is_some_and(|cycle| self.free_half[self.plan.cycles[cycle as usize].first as usize])
    }

    /// The outline of the face that a point lies in.
    fn cycle_around(&self, p: Point) -> Option<u32> {
        let area = |&c: &u32| self.plan.cycles[c as usize].area;
        let outer = (0..self.plan.cycles.len() as u32).filter(|c| area(c) > 0.0);
        let around = outer.filter(|&c| self.plan.is_inside(c, p));
        around.min_by(|a, b| area(a).total_cmp(&area(b)))
    }

    /// Keeps of the free space the face that a point lies in.
    pub fn keep_around(&mut self, p: Point) -> Result<(), MapErrors> {
        let faces = self.plan.faces();
        let face = self.cycle_around(p).filter(|_| self.is_free(p)).and_then(|cycle| faces[cycle as usize]);
        let Some(face) = face else {
            let message = format!("no free space with a closed outline is around ({}, {})", p.x, p.y);
            return Err(Problem::of_file(Code::OpenOutline, message).into());
        };
        for (half, cycle) in self.plan.cycle_of.iter().enumerate() {
            self.free_half[half] &= faces[*cycle as usize] == Some(face);
        }
        Ok(())
    }

    /// The edges with free space on a side.
    pub fn bounds(&self) -> impl Iterator<Item = [Point; 2]> + '_ {
        let edges = self.plan.edges.iter().zip(self.free_half.chunks(2));
        let beside = edges.filter(|(_, halves)| halves.contains(&true));
        beside.map(|(edge, _)| edge.ends.map(|n| self.plan.points[n as usize]))
    }
}
