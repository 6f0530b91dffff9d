//! Occupancy grids: the site's walls and areas as cells, and cells as rectangles.

use serde_json::Value;

use crate::msgs::{Header, MapMetaData, OccupancyGrid, Point, Pose, Quaternion, Time};

/// What is solid, or not to be entered.
pub const FULL: i8 = 100;

/// The most cells of a grid of ours.
const CELLS: f64 = 64.0e6;

/// A grid of the site's size, in cells of so many metres (longer ones where there would be too many), where these polygons are full.
pub fn drawn<'a>(
    bounds: [f64; 4],
    metres: f64,
    frame: &str,
    full: impl Iterator<Item = &'a [f64]>,
) -> OccupancyGrid {
    let [x0, y0, x1, y1] = bounds;
    let least = ((x1 - x0) * (y1 - y0) / CELLS).sqrt();
    let metres = metres.max(least);
    let count = |length: f64| ((length / metres).ceil() as usize).max(1);
    let (width, height) = (count(x1 - x0), count(y1 - y0));
    let mut data = vec![0_i8; width * height];
    for polygon in full {
        fill(&mut data, width, [x0, y0], metres, polygon);
    }
    let origin = Pose { position: Point { x: x0, y: y0, z: 0.0 }, orientation: Quaternion::yaw(0.0) };
    let info = MapMetaData {
        map_load_time: Time::now(),
        resolution: metres as f32,
        width: width as u32,
        height: height as u32,
        origin,
    };
    OccupancyGrid { header: Header::now(frame), info, data }
}

/// Fills the cells whose middle lies in a polygon (x, y, x, y, …), line by line.
fn fill(data: &mut [i8], width: usize, [x0, y0]: [f64; 2], metres: f64, polygon: &[f64]) {
    let points: Vec<[f64; 2]> = polygon.chunks_exact(2).map(|at| [at[0], at[1]]).collect();
    for (line, cells) in data.chunks_exact_mut(width).enumerate() {
        let y = y0 + (line as f64 + 0.5) * metres;
        let sides = points.iter().zip(points.iter().cycle().skip(1));
        let crossed = sides.filter(|(a, b)| (a[1] > y) != (b[1] > y));
        let mut xs: Vec<f64> =
            crossed.map(|(a, b)| a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])).collect();
        xs.sort_by(f64::total_cmp);
        for pair in xs.chunks_exact(2) {
            let cell = |x: f64| (((x - x0) / metres - 0.5).ceil().max(0.0) as usize).min(width);
            cells[cell(pair[0])..cell(pair[1])].fill(FULL);
        }
    }
}

/// The polygons of a list of the site's map.
pub fn polygons(of: &Value) -> Vec<Vec<f64>> {
    let all = of.as_array().into_iter().flatten();
    all.filter_map(|polygon| serde_json::from_value(polygon.clone()).ok()).collect()
}

/// A rectangle in cells: from, and to without it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cells {
    pub from: [usize; 2],
    pub to: [usize; 2],
}

/// Why a grid is none, in words.
pub fn check(grid: &OccupancyGrid) -> Result<(), String> {
    let MapMetaData { resolution, width, height, .. } = grid.info;
    let cells = u64::from(width) * u64::from(height);
    if cells != grid.data.len() as u64 {
        return Err(format!("it is {width} by {height} cells, and has {} of them", grid.data.len()));
    }
    if !(resolution.is_finite() && resolution > 0.0) {
        return Err(format!("its resolution is {resolution}; expected metres"));
    }
    Ok(())
}

/// The full cells as rectangles, no more than `most` of them: where there would be more, cells are joined by twos until they do,
/// so that nothing that is full is left out.
pub fn rectangles(data: &[i8], width: usize, least: i8, most: usize) -> (Vec<Cells>, usize) {
    let mut full: Vec<bool> = data.iter().map(|cell| *cell >= least).collect();
    let mut across = width.max(1);
    let mut joined = 1;
    loop {
        let found = runs(&full, across);
        if found.len() <= most || across <= 1 {
            return (found, joined);
        }
        (full, across) = halved(&full, across);
        joined *= 2;
    }
}

fn halved(full: &[bool], width: usize) -> (Vec<bool>, usize) {
    let across = width.div_ceil(2);
    let high = (full.len() / width).div_ceil(2);
    let mut half = vec![false; across * high];
    for (index, is_full) in full.iter().enumerate() {
        half[index / width / 2 * across + index % width / 2] |= is_full;
    }
    (half, across)
}

/// Runs of full cells in each line, joined with the same run of the line before.
fn runs(full: &[bool], width: usize) -> Vec<Cells> {
    let mut found: Vec<Cells> = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    for (y, line) in full.chunks_exact(width).enumerate() {
        let mut here = Vec::new();
        let mut x = 0;
        while x < width {
            let from = x;
            while x < width && line[x] == line[from] {
                x += 1;
            }
            if !line[from] {
                continue;
            }
            let same =
                open.iter().copied().find(|index| found[*index].from[0] == from && found[*index].to[0] == x);
            let index = same.unwrap_or_else(|| {
                found.push(Cells { from: [from, y], to: [x, y] });
                found.len() - 1
            });
            found[index].to[1] = y + 1;
            here.push(index);
        }
        open = here;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_drawn_is_found_again() {
        let square = [1.0, 1.0, 3.0, 1.0, 3.0, 2.0, 1.0, 2.0];
        let grid = drawn([0.0, 0.0, 4.0, 4.0], 0.5, "map", std::iter::once(&square[..]));
        assert_eq!((grid.info.width, grid.info.height), (8, 8));
        let (found, joined) = rectangles(&grid.data, 8, FULL, 10);
        assert_eq!((found, joined), (vec![Cells { from: [2, 2], to: [6, 4] }], 1));
    }

    #[test]
    fn too_many_are_joined_and_nothing_is_left_out() {
        let chess: Vec<i8> =
            (0..64 * 64).map(|cell| if (cell + cell / 64) % 2 == 0 { FULL } else { 0 }).collect();
        let (found, joined) = rectangles(&chess, 64, FULL, 100);
        assert_eq!((found, joined), (vec![Cells { from: [0, 0], to: [32, 32] }], 2));
    }
}
