//! Which ways obstacles have cut.

use super::field::Ground;
use super::free_grid::FreeGrid;
use super::judge::WayFacts;
use crate::floor_plan::{Network, Spot, Way};
use crate::geometry::{Point, Rect, Segment};

/// An adit may be covered where beside it there is room; the nearest free place up to so far stands for it, metres.
const BESIDE_M: f64 = 0.4;

/// About a doorway so much is looked at, metres.
const ABOUT_DOORWAY_M: f64 = 1.0;

/// Which places of a window are joined.
#[derive(Clone, Debug)]
enum Parts {
    /// All that the network joins: no obstacle is in it.
    Whole,
    /// Those of the same number.
    Split { grid: FreeGrid, parts: Vec<Option<u32>> },
}

/// What becomes of ways as it is asked for.
#[derive(Debug)]
pub(super) struct Cuts<'a> {
    network: &'a Network,
    ground: Ground<'a>,
    /// What was found of each region so far.
    regions: Vec<Option<Parts>>,
}

impl<'a> Cuts<'a> {
    pub fn new(network: &'a Network, ground: Ground<'a>) -> Self {
        Self { network, ground, regions: vec![None; network.regions.regions.len()] }
    }

    /// What a judge is told of a way.
    pub fn facts<'w>(&mut self, way: &'w Way, blocked: &Blocked) -> WayFacts<'w> {
        let count = |counts: &[u32], index: Option<usize>| index.map_or(0, |index| counts[index]);
        let times_blocked = count(&blocked.doorways, way.doorway) + count(&blocked.regions, way.region);
        WayFacts { way, is_cut: self.is_cut(way), times_blocked }
    }

    fn is_cut(&mut self, way: &Way) -> bool {
        let (Some(&from), Some(&to)) = (way.points.first(), way.points.last()) else { return false };
        let joins = if let Some(region) = way.region {
            let (network, ground) = (self.network, self.ground);
            self.regions[region]
                .get_or_insert_with(|| Parts::of_region(network, region, &ground))
                .joins(from, to)
        } else {
            Parts::within(Rect::around([from, to]).grown(ABOUT_DOORWAY_M), &self.ground, |_| true)
                .joins(from, to)
        };
        !joins
    }
}

impl Parts {
    fn of_region(network: &Network, region: usize, ground: &Ground) -> Self {
        let shape = &network.regions.regions[region];
        let window = Rect::around(shape.outline.iter().copied()).grown(ground.grain);
        Self::within(window, ground, |at| shape.contains(at))
    }

    fn within(window: Rect, ground: &Ground, is_inside: impl Fn(Point) -> bool) -> Self {
        if !is_touched(&window, ground) {
            return Self::Whole;
        }
        let mut grid = FreeGrid::new(window, ground.grain);
        for barrier in ground.barriers {
            grid.block(&ground.rim, barrier, ground.reach);
        }
        grid.keep(is_inside);
        Self::Split { parts: grid.parts(), grid }
    }

    fn joins(&self, from: Point, to: Point) -> bool {
        let Self::Split { grid, parts } = self else { return true };
        let part = |p: Point| grid.nearest(p, BESIDE_M, |_| true).and_then(|cell| parts[cell]);
        part(from).is_some_and(|one| part(to) == Some(one))
    }
}

/// Whether an obstacle is in a window, or nearly.
fn is_touched(window: &Rect, ground: &Ground) -> bool {
    let grown = window.grown(ground.reach);
    let mut obstacles = ground.barriers.iter().skip(ground.obstacles_from);
    obstacles.any(|line| grown.clip(line.a, line.b).is_some() || grown.contains(line.a))
}

/// How often doorways and regions were reported closed.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocked {
    pub doorways: Vec<u32>,
    pub regions: Vec<u32>,
}

impl Blocked {
    pub fn new(network: &Network) -> Self {
        let Network { regions, .. } = network;
        Self { doorways: vec![0; regions.doorways.len()], regions: vec![0; regions.regions.len()] }
    }

    /// Whether nothing was reported.
    pub fn is_none(&self) -> bool {
        self.doorways.iter().chain(&self.regions).all(|&times| times == 0)
    }

    /// Takes note that a place is blocked.
    ///
    /// # Returns
    /// The doorway in which it is, or else the region.
    pub fn note(&mut self, network: &Network, at: Point, reach: f64) -> (Option<usize>, Option<usize>) {
        let far = |doorway: usize| {
            let door = &network.regions.doorways[doorway];
            Segment::new(door.from, door.to).distance(at)
        };
        let near = (0..self.doorways.len()).filter(|&doorway| far(doorway) <= reach);
        if let Some(doorway) = near.min_by(|&a, &b| far(a).total_cmp(&far(b))) {
            self.doorways[doorway] += 1;
            return (Some(doorway), None);
        }
        let region = network.regions.regions.iter().position(|region| region.contains(at));
        if let Some(region) = region {
            self.regions[region] += 1;
        }
        (None, region)
    }
}

/// Doorways that are closed whatever is seen: every way through them is. By index.
pub(super) fn forbidden(network: &Network, mut weigh: impl FnMut(&WayFacts) -> Option<f64>) -> Vec<usize> {
    let mut is_open = vec![false; network.regions.doorways.len()];
    let mut has_way = is_open.clone();
    for way in &network.ways {
        if let (Some(doorway), Spot::Adit(_)) = (way.doorway, way.from) {
            has_way[doorway] = true;
            is_open[doorway] |= weigh(&WayFacts { way, is_cut: false, times_blocked: 0 }).is_some();
        }
    }
    (0..is_open.len()).filter(|&doorway| has_way[doorway] && !is_open[doorway]).collect()
}
