//! Which ways obstacles have cut.

use super::detour::Ground;
use super::field::window;
use super::free_grid::FreeGrid;
use super::judge::WayFacts;
use crate::floor_plan::clear::distance_between;
use crate::floor_plan::{Network, Spot, Way};
use crate::geometry::{Point, Rect};

/// An adit may be covered where beside it there is room; the nearest free place up to so far stands for it, metres.
const BESIDE_M: f64 = 0.4;

/// About a doorway so much is looked at, metres.
const ABOUT_DOORWAY_M: f64 = 1.0;

/// Free space in a window, and which places of it are joined.
#[derive(Clone, Debug)]
struct Parts {
    grid: FreeGrid,
    parts: Vec<Option<u32>>,
}

/// What becomes of ways as it is asked for.
#[derive(Debug)]
pub(super) struct Cuts<'a> {
    network: &'a Network,
    ground: Ground<'a>,
    regions: Vec<Option<Option<Parts>>>,
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
        let (Some(from), Some(to)) = (way.points.first(), way.points.last()) else { return false };
        match way.region {
            Some(region) => self.region(region).as_ref().is_some_and(|parts| !parts.joins(*from, *to)),
            None => {
                let window = window([*from, *to], ABOUT_DOORWAY_M);
                self.is_touched(&window) && !Parts::new(window, &self.ground).joins(*from, *to)
            }
        }
    }

    /// Parts of a region; `None` where no obstacle is in it.
    fn region(&mut self, region: usize) -> &Option<Parts> {
        if self.regions[region].is_none() {
            let shape = &self.network.regions.regions[region];
            let window = window(shape.outline.iter().copied(), self.ground.grain);
            let parts = self.is_touched(&window).then(|| {
                let mut grid = blocked_grid(window, &self.ground);
                grid.keep(|at| shape.contains(at));
                Parts { parts: grid.parts(), grid }
            });
            self.regions[region] = Some(parts);
        }
        self.regions[region].as_ref().unwrap_or(&None)
    }

    fn is_touched(&self, window: &Rect) -> bool {
        let reach = self.ground.reach;
        let obstacles = self.ground.barriers.iter().skip(self.ground.obstacles_from);
        let grown = Rect::new(window.x0 - reach, window.y0 - reach, window.x1 + reach, window.y1 + reach);
        obstacles.into_iter().any(|line| grown.clip(line.a, line.b).is_some() || grown.contains(line.a))
    }
}

impl Parts {
    fn new(window: Rect, ground: &Ground) -> Self {
        let grid = blocked_grid(window, ground);
        Self { parts: grid.parts(), grid }
    }

    fn joins(&self, from: Point, to: Point) -> bool {
        let part = |p: Point| self.grid.nearest(p, BESIDE_M, |_| true).and_then(|cell| self.parts[cell]);
        part(from).is_some_and(|one| part(to) == Some(one))
    }
}

fn blocked_grid(window: Rect, ground: &Ground) -> FreeGrid {
    let mut grid = FreeGrid::new(window, ground.grain);
    for barrier in ground.barriers {
        grid.block(barrier, ground.reach);
    }
    grid
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

    /// Takes note that a place is blocked.
    ///
    /// # Returns
    /// The doorway in which it is, or else the region.
    pub fn note(&mut self, network: &Network, at: Point, reach: f64) -> (Option<usize>, Option<usize>) {
        let far = |doorway: usize| {
            let door = &network.regions.doorways[doorway];
            distance_between([at, at], [door.from, door.to])
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

/// Doorways that are closed whatever is seen: every way through them is.
pub(super) fn forbidden(
    network: &Network,
    mut weigh: impl FnMut(&WayFacts) -> Option<f64>,
) -> Vec<crate::segment::Segment> {
    let mut is_open = vec![false; network.regions.doorways.len()];
    let mut has_way = is_open.clone();
    for way in &network.ways {
        if let (Some(doorway), Spot::Adit(_)) = (way.doorway, way.from) {
            has_way[doorway] = true;
            is_open[doorway] |= weigh(&WayFacts { way, is_cut: false, times_blocked: 0 }).is_some();
        }
    }
    let closed = (0..is_open.len()).filter(|&doorway| has_way[doorway] && !is_open[doorway]);
    let line = |doorway: usize| {
        let door = &network.regions.doorways[doorway];
        crate::segment::Segment::new(door.from, door.to)
    };
    closed.map(line).collect()
}
