//! Asking whether the robot is free: what is known costs nothing, all else is evaluated, and counted.

use smallvec::{SmallVec, smallvec};

use super::robot::{Link, Links, Robot, links_between};
use super::workcell::{Placed, Workcell};

/// What plug-ins see of a cell. It does not show the objects, so nothing goes round the count.
#[derive(Debug)]
pub struct Probe<'c>(&'c mut Workcell);

/// A gap in what is known between two places as near as this is none, metres.
const NO_GAP_M: f64 = 1e-6;

/// Shares of a motion that are not known to be free.
type Gap = (f64, f64);

/// A motion under test against one object.
struct Motion<'m> {
    robot: &'m dyn Robot,
    from: &'m [f64],
    to: &'m [f64],
    travel: Vec<f64>,
}

impl Motion<'_> {
    fn links(&self, share: f64) -> Links {
        links_between(self.robot, self.from, self.to, share)
    }

    /// Cuts from a gap what is known at its two ends.
    fn shrunk(&self, placed: &Placed, gap: Gap) -> Option<Gap> {
        let low = self.march(placed, gap, 1.0)?;
        let high = self.march(placed, (low, gap.1), -1.0)?;
        Some((low, high))
    }

    /// Goes from one end of a gap towards the other as far as the motion is known to be free of an object, forward
    /// (`sense` 1) or backward (-1); `None` where that closes the gap.
    fn march(&self, placed: &Placed, (low, high): Gap, sense: f64) -> Option<f64> {
        const FINE: f64 = 1e-3;
        let mut rooms: SmallVec<[usize; 4]> = smallvec![usize::MAX; self.travel.len()];
        let mut share = if sense > 0.0 { low } else { high };
        loop {
            let links = self.links(share);
            // A link mostly stays in one room for some steps; all rooms are searched when that one ends.
            let mut step = self.step(placed, &links, |index, link| placed.known.slack_in(rooms[index], link));
            if step < FINE {
                step = self.step(placed, &links, |index, link| {
                    let (slack, room) = placed.known.slack(link);
                    rooms[index] = room;
                    slack
                });
            }
            share += sense * step;
            if (sense > 0.0 && share >= high) || (sense < 0.0 && share <= low) {
                return None;
            }
            if step < FINE {
                return Some(share);
            }
        }
    }

    /// By which share the motion may go on, either way, until a link leaves the room that it has; 0 where it has none.
    fn step(&self, placed: &Placed, links: &[Link], mut slack: impl FnMut(usize, &Link) -> f64) -> f64 {
        let mut step = f64::INFINITY;
        for (index, (link, travel)) in links.iter().zip(&self.travel).enumerate() {
            let slack = slack(index, &placed.inward(link));
            step = step.min(if slack < 0.0 { 0.0 } else { slack / travel.max(f64::MIN_POSITIVE) });
            if step <= 0.0 {
                break;
            }
        }
        step
    }

    /// How far a point of the robot goes at most.
    fn metres(&self) -> f64 {
        self.travel.iter().copied().fold(0.0, f64::max)
    }

    /// A few shares, close enough that what is known to be touched on the way is hardly missed.
    fn shares(&self) -> impl Iterator<Item = f64> + use<> {
        const STEP_M: f64 = 0.05;
        let steps = (self.metres() / STEP_M).ceil().max(1.0);
        (0..=steps as u32).map(move |step| f64::from(step) / steps)
    }
}

impl<'c> Probe<'c> {
    pub(super) fn new(cell: &'c mut Workcell) -> Self {
        Self(cell)
    }

    pub fn robot(&self) -> &dyn Robot {
        self.0.robot().as_ref()
    }

    /// How many configurations were evaluated against one object so far.
    pub fn evaluations(&self) -> u64 {
        self.0.evaluations()
    }

    /// Whether the robot is free of all objects at a configuration.
    pub fn is_free(&mut self, at: &[f64]) -> bool {
        if !self.robot().admits(at) {
            return false;
        }
        let links = self.robot().links(at);
        let objects = self.0.placed.len();
        if (0..objects).any(|index| self.0.is_known_to_touch(index, &links)) {
            return false;
        }
        (0..objects).all(|index| {
            self.0.placed[index].slack(&links).all(|slack| slack >= 0.0) || self.0.evaluate(index, &links)
        })
    }

    /// Whether the robot stays free of all objects on the straight motion between two configurations.
    ///
    /// An evaluation tells how far each link is from the object; the motion is free as long as the links stay in the room
    /// that is known to be free. What is not known is evaluated in the middle of the widest gap, so that a motion which
    /// is not free is refused early.
    pub fn is_motion_free(&mut self, from: &[f64], to: &[f64]) -> bool {
        if !self.robot().admits(from) || !self.robot().admits(to) {
            return false;
        }
        let robot = self.0.robot().clone();
        let motion = Motion { robot: robot.as_ref(), from, to, travel: robot.travel(from, to) };
        let mut gaps: Vec<(usize, Gap)> = Vec::new();
        for share in motion.shares() {
            let links = motion.links(share);
            if (0..self.0.placed.len()).any(|index| self.0.is_known_to_touch(index, &links)) {
                return false;
            }
        }
        for (index, placed) in self.0.placed.iter().enumerate() {
            gaps.extend(motion.shrunk(placed, (0.0, 1.0)).map(|gap| (index, gap)));
        }
        while let Some(widest) = widest(&gaps) {
            let (index, (low, high)) = gaps.swap_remove(widest);
            let middle = f64::midpoint(low, high);
            let links = motion.links(middle);
            if self.0.is_known_to_touch(index, &links) {
                return false;
            }
            let slack = self.0.placed[index].slack(&links).fold(f64::INFINITY, f64::min);
            if slack >= 0.0 && (high - low) * motion.metres() < NO_GAP_M {
                continue;
            }
            // Room that hardly holds the links hardly narrows the gap, so it is evaluated, too.
            let is_ample = slack >= self.0.touching_m() / 2.0;
            if !is_ample && !self.0.evaluate(index, &links) && slack < 0.0 {
                return false;
            }
            let placed = &self.0.placed[index];
            let rest = [(low, middle), (middle, high)].map(|half| motion.shrunk(placed, half));
            gaps.extend(rest.into_iter().flatten().map(|gap| (index, gap)));
        }
        true
    }
}

fn widest(gaps: &[(usize, Gap)]) -> Option<usize> {
    let width = |gap: &Gap| gap.1 - gap.0;
    (0..gaps.len()).max_by(|&a, &b| width(&gaps[a].1).total_cmp(&width(&gaps[b].1)).then(b.cmp(&a)))
}
