//! A floor plan that was checked: its walls close outlines, cross nowhere, and its places are free.

use std::sync::Arc;

use super::check::{Check, Source};
use super::space::Space;
use crate::geometry::tolerance::SNAP_M;
use crate::geometry::{Point, Rect, Segment};
use crate::read::{Code, MapErrors, Problem};
use crate::world::{Bridge, Occupancy, Place, Shape, World};

/// Walls without thickness, solid things, and named places, in metres.
#[derive(Clone, Debug)]
pub struct FloorPlan {
    pub name: String,
    walls: Vec<[Point; 2]>,
    solids: Vec<Vec<Point>>,
    places: Vec<Place>,
    source: Source,
    space: Arc<Space>,
}

/// What a plan is made of, before it is checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawn {
    pub name: String,
    /// Walls by their ends. They may end on one another, and must not cross.
    pub walls: Vec<[Point; 2]>,
    /// Pillars and walls with a thickness, by their corners in order. They may overlap walls and one another.
    pub solids: Vec<Vec<Point>>,
    pub places: Vec<Place>,
}

impl FloorPlan {
    /// Checks a plan.
    ///
    /// # Returns
    /// All that is wrong with it: numbers that are none, walls without a length, crossing walls, open outlines,
    /// places in walls or outside.
    pub fn new(drawn: Drawn) -> Result<Self, MapErrors> {
        Self::from_source(drawn, Source::default())
    }

    /// The plan of the free space that a point lies in, and of nothing else: walls without that beside them are left
    /// out, and other free space counts as solid.
    pub fn around(drawn: Drawn, at: Point) -> Result<Self, MapErrors> {
        let Drawn { name, mut walls, solids, places } = drawn;
        let source = Source::default();
        let mut check = Check::new(&source);
        check.shapes(&walls, &solids);
        check.names(&places);
        check.stop()?;
        let (noded, ring_from) = check.outlines(&walls, &solids)?;
        let mut space = Space::new(&noded, ring_from);
        space.keep_around(at)?;
        let is_beside = |wall: &[Point; 2]| space.bounds().any(|edge| is_on(edge, *wall));
        walls.retain(is_beside);
        let (noded, ring_from) = check.outlines(&walls, &solids)?;
        let mut space = Space::new(&noded, ring_from);
        space.keep_around(at)?;
        check.places(&places, &walls, &solids, &space);
        check.stop()?;
        let space = Arc::new(space);
        Ok(Self { name, walls, solids, places, source, space })
    }

    /// The floor plan of a map: its edge and all that is solid on it, polygons as they are drawn. The map's clearance is
    /// left out: a disc has a margin of its own. So are named areas and doors, which are not solid.
    ///
    /// # Arguments
    /// `height` of the robot, metres: a bridge that it does not pass under is solid to it. Unknown, it passes under none.
    pub fn of_world(world: &World, height: Option<f64>) -> Result<Self, MapErrors> {
        let corners = |shape: &Shape| match shape {
            Shape::Rect(rect) => rect.corners().to_vec(),
            Shape::Polygon(corners) => corners.clone(),
        };
        let mut solids: Vec<Vec<Point>> = world.obstacles.iter().map(|item| corners(&item.shape)).collect();
        let is_low = |bridge: &&Bridge| height.is_none_or(|height| height >= bridge.height);
        let pictured = world.occupancy.iter().flat_map(Occupancy::rectangles);
        let low = world.bridges.iter().filter(is_low).map(|bridge| bridge.rect);
        solids.extend(pictured.chain(low).map(|rect| rect.corners().to_vec()));
        solids.extend(frame(&world.bounds));
        Self::new(Drawn { solids, places: world.places.clone(), ..Drawn::default() })
    }

    pub(super) fn from_source(drawn: Drawn, source: Source) -> Result<Self, MapErrors> {
        let Drawn { name, walls, solids, places } = drawn;
        let mut check = Check::new(&source);
        check.shapes(&walls, &solids);
        check.names(&places);
        check.stop()?;
        let (noded, ring_from) = check.outlines(&walls, &solids)?;
        let space = Space::new(&noded, ring_from);
        check.closed(&walls, &noded, ring_from, &space);
        check.places(&places, &walls, &solids, &space);
        check.stop()?;
        let space = Arc::new(space);
        Ok(Self { name, walls, solids, places, source, space })
    }

    /// The walls by their ends, as drawn.
    pub fn walls(&self) -> &[[Point; 2]] {
        &self.walls
    }

    /// The solid things by their corners, as drawn.
    pub fn solids(&self) -> &[Vec<Point>] {
        &self.solids
    }

    pub fn places(&self) -> &[Place] {
        &self.places
    }

    /// Whatever stops a robot or an echo: walls, and outlines of solid things.
    pub fn barriers(&self) -> Vec<[Point; 2]> {
        self.space.bounds().collect()
    }

    /// The area of the free space, square metres.
    pub fn free_area(&self) -> f64 {
        let plan = &self.space.plan;
        plan.cycles
            .iter()
            .filter(|cycle| self.space.free_half[cycle.first as usize])
            .map(|cycle| cycle.area)
            .sum()
    }

    /// Whether a point lies in free space; on a wall it may or may not.
    pub fn is_free(&self, p: Point) -> bool {
        self.space.is_free(p)
    }

    pub(super) fn space(&self) -> &Space {
        &self.space
    }

    /// A problem with a place, told where it stands in the file.
    pub(super) fn problem_of_place(&self, place: usize, code: Code, message: String) -> Problem {
        Check::new(&self.source).problem(self.source.places.get(place), code, message)
    }
}

/// Whether an edge is a part of a wall.
fn is_on([p, q]: [Point; 2], [a, b]: [Point; 2]) -> bool {
    [p, q].iter().all(|end| Segment::new(a, b).distance(*end) <= 2.0 * SNAP_M)
}

/// Something solid all around, as thick as the rectangle's smaller side.
fn frame(r: &Rect) -> Vec<Vec<Point>> {
    let thick = r.smaller_side();
    let Rect { x0, y0, x1, y1 } = r.grown(thick);
    let bars = [
        Rect::new(x0, y0, x1, r.y0),
        Rect::new(x0, r.y1, x1, y1),
        Rect::new(x0, r.y0, r.x0, r.y1),
        Rect::new(r.x1, r.y0, x1, r.y1),
    ];
    bars.iter().map(|bar| bar.corners().to_vec()).collect()
}
