//! Maps as images: an occupancy written as a map of ROS, and turned.

use std::path::PathBuf;

use adit_planners::geometry::Point;
use adit_planners::world::Occupancy;

use crate::TestSite;

/// Writes a map of ROS into a folder: walls black, all else free. Returns the file `map.yaml`.
pub fn write_ros_map(folder: &TestSite, cells: &Occupancy) -> PathBuf {
    let mut image = format!("P5\n{} {}\n255\n", cells.columns, cells.rows).into_bytes();
    for row in (0..cells.rows).rev() {
        image.extend((0..cells.columns).map(|column| if cells.is_blocked(column, row) { 0 } else { 254 }));
    }
    folder.write("map.pgm", image);
    let yaml = format!(
        "image: map.pgm\nresolution: {:?}\norigin: [{:?}, {:?}, 0.0]\nnegate: 0\noccupied_thresh: 0.65\n\
         free_thresh: 0.196\n",
        cells.resolution, cells.origin.x, cells.origin.y
    );
    folder.write("map.yaml", yaml);
    folder.path().join("map.yaml")
}

/// An occupancy turned by a quarter, counterclockwise, cell by cell, and how a point turns with it.
pub fn quarter_turned(cells: &Occupancy) -> (Occupancy, impl Fn(Point) -> Point + use<>) {
    let Occupancy { origin, resolution, columns, rows, .. } = *cells;
    let blocked = |column: usize, row: usize| cells.is_blocked(row, rows - 1 - column);
    let turned = Occupancy {
        origin: Point::new(0.0, 0.0),
        resolution,
        columns: rows,
        rows: columns,
        blocked: (0..columns).flat_map(|row| (0..rows).map(move |column| blocked(column, row))).collect(),
    };
    let depth = rows as f64 * resolution;
    (turned, move |p: Point| Point::new(depth - (p.y - origin.y), p.x - origin.x))
}
