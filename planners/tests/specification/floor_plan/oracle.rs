//! The any-angle optimum: polyanya on walls grown by other means than the planner's.

use adit_planners::floor_plan::FloorPlan;
use adit_planners::geometry::Point;
use geo::{Contains, Coord, LineString, MapCoords, MultiPolygon, Polygon};
use polyanya::{Coords, Mesh, Triangulation};

/// A grown wall has so many edges a whole turn; corners lie on the circle, so that it is a little too small.
const EDGES: usize = 64;

/// Where the centre of a disc can be: one mesh for each connected part.
pub struct Oracle {
    parts: Vec<(Polygon, Mesh)>,
}

impl Oracle {
    pub fn new(plan: &FloorPlan, radius: f64) -> Self {
        let mut shapes: Vec<Polygon> =
            plan.barriers().into_iter().flat_map(|wall| grown(wall, radius)).collect();
        let solid = |corners: &Vec<Point>| Polygon::new(corners.iter().map(coord).collect(), Vec::new());
        shapes.extend(plan.solids().iter().map(solid));
        let blocked: MultiPolygon = geo::unary_union(&shapes);
        let holes: Vec<&LineString> = blocked.iter().flat_map(|polygon| polygon.interiors()).collect();
        let part = |ring: &&LineString| {
            let hull = Polygon::new((*ring).clone(), Vec::new());
            let inside = blocked.iter().filter(|other| hull.contains(&other.exterior().0[0]));
            let free = Polygon::new((*ring).clone(), inside.map(|other| other.exterior().clone()).collect());
            let single: geo::Polygon<f32> = free.map_coords(|c| Coord { x: c.x as f32, y: c.y as f32 });
            (free, Triangulation::from_geo_polygon(single).as_navmesh())
        };
        Self { parts: holes.iter().map(part).collect() }
    }

    /// The length of the shortest path; `None` where there is none.
    pub fn shortest(&self, from: Point, to: Point) -> Option<f64> {
        let holds = |polygon: &Polygon, p: Point| polygon.contains(&coord(&p));
        let (_, mesh) = self.parts.iter().find(|(free, _)| holds(free, from) && holds(free, to))?;
        let at = |p: Point| Coords::on_mesh([p.x as f32, p.y as f32].into());
        mesh.path(at(from), at(to)).map(|path| f64::from(path.length))
    }
}

fn coord(p: &Point) -> Coord {
    Coord { x: p.x, y: p.y }
}

/// A circle about each end, and a rectangle between them.
fn grown([a, b]: [Point; 2], radius: f64) -> Vec<Polygon> {
    let circle = |centre: Point| {
        let corner = |i: usize| {
            let angle = i as f64 / EDGES as f64 * std::f64::consts::TAU;
            Coord { x: centre.x + radius * angle.cos(), y: centre.y + radius * angle.sin() }
        };
        Polygon::new((0..EDGES).map(corner).collect(), Vec::new())
    };
    let length = a.distance(b);
    let (x, y) = (-(b.y - a.y) / length * radius, (b.x - a.x) / length * radius);
    let corners = [(a.x + x, a.y + y), (a.x - x, a.y - y), (b.x - x, b.y - y), (b.x + x, b.y + y)];
    let between = Polygon::new(corners.map(|(x, y)| Coord { x, y }).to_vec().into(), Vec::new());
    vec![circle(a), circle(b), between]
}
