//! Clearance the slow way: walls cell by cell, the part looked at in many places of its way.

use adit_planners::channels::assembly::Cuboid;

/// Every cell between neighbouring coordinates of channels whose middle is below the mouth and in no channel.
pub struct Cells<const D: usize> {
    walls: Vec<Cuboid<D>>,
}

impl<const D: usize> Cells<D> {
    pub fn new(channels: &[Cuboid<D>]) -> Self {
        let lines: [Vec<f64>; D] = std::array::from_fn(|axis| {
            let ends = channels.iter().flat_map(|channel| [channel.min[axis], channel.max[axis]]);
            let mut lines: Vec<f64> = ends.chain([-1e4, 1e4]).collect();
            lines.sort_by(f64::total_cmp);
            lines.dedup();
            lines
        });
        let count: usize = lines.iter().map(|lines| lines.len() - 1).product();
        let cell = |mut index: usize| {
            let mut cell = Cuboid::new([0.0; D], [0.0; D]);
            for (axis, lines) in lines.iter().enumerate() {
                let place = index % (lines.len() - 1);
                index /= lines.len() - 1;
                cell.min[axis] = lines[place];
                cell.max[axis] = lines[place + 1];
            }
            cell
        };
        let is_wall = |cell: &Cuboid<D>| {
            let middle: [f64; D] = std::array::from_fn(|k| f64::midpoint(cell.min[k], cell.max[k]));
            let within = |channel: &Cuboid<D>| {
                (0..D).all(|k| channel.min[k] < middle[k] && middle[k] < channel.max[k])
            };
            middle[D - 1] < channels[0].max[D - 1] && !channels.iter().any(within)
        };
        Self { walls: (0..count).map(cell).filter(is_wall).collect() }
    }

    /// The distance of a box from the nearest wall; negative where it is in one, by how deep.
    pub fn clearance(&self, part: &Cuboid<D>) -> f64 {
        let to = |wall: &Cuboid<D>| {
            let gaps = (0..D).map(|k| (wall.min[k] - part.max[k]).max(part.min[k] - wall.max[k]));
            let (mut sum, mut largest) = (0.0, f64::NEG_INFINITY);
            for gap in gaps {
                sum += gap.max(0.0).powi(2);
                largest = gap.max(largest);
            }
            if largest < 0.0 { largest } else { sum.sqrt() }
        };
        self.walls.iter().map(to).fold(f64::INFINITY, f64::min)
    }

    /// The least clearance at `count` + 1 places of a line, ends included.
    pub fn along(&self, part: &Cuboid<D>, by: &[f64; D], count: usize) -> f64 {
        let at = |index: usize| part.moved(&by.map(|by| by * index as f64 / count as f64));
        (0..=count).map(|index| self.clearance(&at(index))).fold(f64::INFINITY, f64::min)
    }
}
