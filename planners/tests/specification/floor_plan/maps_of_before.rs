//! Maps of rectangles, polygons and cells are floor plans, too.

use adit_planners::floor_plan::{Disc, FloorPlan, Network, Regions, Rule};
use adit_planners::geometry::{Point, Rect};
use adit_planners::world::{Obstacle, Occupancy, Place, Shape, World};

/// 10 x 8 m with a wall across, 0.2 m thick, that leaves 1 m free at its upper end, and a triangle.
fn drawn() -> World {
    let mut world = World::empty(Rect::new(0.0, 0.0, 10.0, 8.0));
    let triangle = [(7.0, 2.0), (9.0, 2.0), (8.0, 4.0)].map(|(x, y)| Point::new(x, y));
    let shapes = [Shape::Rect(Rect::new(5.0, 0.0, 5.2, 7.0)), Shape::Polygon(triangle.to_vec())];
    world.obstacles = shapes.map(|shape| Obstacle { shape }).to_vec();
    world.places = [("left", 1.0), ("right", 6.0)]
        .map(|(name, x)| Place { name: name.to_owned(), at: Point::new(x, 1.0) })
        .to_vec();
    world
}

#[test]
fn a_vector_map_is_a_floor_plan_with_thick_walls() {
    let plan = FloorPlan::of_world(&drawn(), None).unwrap();
    assert!((plan.free_area() - (80.0 - 1.4 - 2.0)).abs() < 1e-6, "{}", plan.free_area());
    let regions = Regions::of(&plan).regions;
    assert!((regions.iter().map(|region| region.area).sum::<f64>() / plan.free_area() - 1.0).abs() < 1e-9);
    let network = Network::new(&plan, Disc { radius: 0.3, margin: 0.0 }).unwrap();
    let [left, right] = [0, 1].map(|place| plan.places()[place].at);
    let path = network.path(left, right, Rule::Tight, |way| Some(way.length)).unwrap();
    // up to the wall's upper end, about both its corners, and down again
    let up = |x: f64| f64::hypot(x, 6.0);
    assert!(
        path.length > up(4.0) + 0.2 + up(0.8) && path.length < up(4.0) + 1.2 + up(0.8),
        "{}",
        path.length
    );
}

#[test]
fn an_occupancy_map_is_a_floor_plan_of_cells() {
    let (columns, rows) = (40, 30);
    let is_wall = |cell: usize| {
        let (column, row) = (cell % columns, cell / columns);
        column == 0
            || row == 0
            || column == columns - 1
            || row == rows - 1
            || column == 20 && row != 8 && row != 9
    };
    let mut world = World::empty(Rect::new(0.0, 0.0, 4.0, 3.0));
    world.occupancy = Some(Occupancy {
        origin: Point::new(0.0, 0.0),
        resolution: 0.1,
        columns,
        rows,
        blocked: (0..columns * rows).map(is_wall).collect(),
    });
    let plan = FloorPlan::of_world(&world, None).unwrap();
    let free = (0..columns * rows).filter(|&cell| !is_wall(cell)).count() as f64 * 0.01;
    assert!((plan.free_area() - free).abs() < 1e-6);
    let regions = Regions::of(&plan);
    assert_eq!(regions.regions.len(), 3, "two rooms and the opening in the wall");
    assert_eq!(regions.doorways.len(), 2);
}

#[test]
fn a_map_without_free_space_is_refused() {
    let mut world = World::empty(Rect::new(0.0, 0.0, 2.0, 2.0));
    world.obstacles = vec![Obstacle { shape: Shape::Rect(Rect::new(0.0, 0.0, 2.0, 2.0)) }];
    assert!(FloorPlan::of_world(&world, None).is_err());
}
