//! Asking whether the robot is free: what is known costs nothing, all else is evaluated, and counted.

use std::ops::Range;

use smallvec::{SmallVec, smallvec};

use super::clearance::Room;
use super::robot::{Link, Links, Robot, links_between, wider};
use super::workcell::{Placed, Workcell};
use crate::geometry::Rect;

/// What plug-ins see of a cell. It does not show the objects, so nothing goes round the count.
#[derive(Debug)]
pub struct Probe<'c>(&'c mut Workcell);

/// A gap in what is known between two places as near as this is none, metres.
const NO_GAP_M: f64 = 1e-6;

/// Room that exceeds the robot by less hardly narrows a gap, metres.
const AMPLE_M: f64 = 1e-4;

/// Shares of a motion that are not known to be free.
type Gap = (f64, f64);

/// A motion under test.
struct Motion<'m> {
    robot: &'m dyn Robot,
    from: &'m [f64],
    to: &'m [f64],
    travel: Vec<f64>,
    bend: Vec<f64>,
    kept_m: f64,
    /// The body at both ends, from which each object is asked about.
    ends: [Links; 2],
}

/// What is known to hold a link, and by how many metres it exceeds that.
struct Held<'r> {
    link: usize,
    slack: f64,
    room: &'r Room,
}

impl<'m> Motion<'m> {
    fn new(cell: &Workcell, robot: &'m dyn Robot, from: &'m [f64], to: &'m [f64]) -> Self {
        let (travel, bend) = (robot.travel(from, to), robot.bend(from, to));
        Self {
            robot,
            from,
            to,
            travel,
            bend,
            kept_m: cell.kept_m(),
            ends: [from, to].map(|end| cell.links(end)),
        }
    }

    fn links(&self, share: f64) -> Links {
        if share <= 0.0 || share >= 1.0 {
            return self.ends[usize::from(share >= 1.0)].clone();
        }
        wider(links_between(self.robot, self.from, self.to, share), self.kept_m)
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
        /// What would take smaller steps is left to an evaluation.
        const FINE: f64 = 1e-3;
        let (mut share, last) = if sense > 0.0 { (low, high) } else { (high, low) };
        let mut links = self.links(share);
        loop {
            let left = (last - share) * sense;
            let Some(held) = self.held(placed, &links, left) else { return Some(share) };
            // As far as each link may go anywhere from here, and as far as it may go at all.
            let sure = held.iter().fold(left, |sure, held| sure.min(self.anywhere(held.link, held.slack)));
            let mut step =
                held.iter().fold(left, |most, held| most.min(self.straight(held.link, held.slack)));
            // A room is convex: what is in it before and after is in it between, but for how far it strays from the straight way.
            loop {
                if step < FINE && step < left {
                    return Some(share);
                }
                let sure_step = step.max(sure).min(left);
                if sure_step <= sure {
                    step = sure_step;
                    break;
                }
                let there = self.links(share + sense * step);
                let holds = |held: &Held| {
                    let slack = held.room.slack(&placed.inward(&there[held.link]));
                    self.straight(held.link, slack) >= step
                };
                if held.iter().all(holds) {
                    break;
                }
                step /= 2.0;
            }
            if step >= left {
                return None;
            }
            share += sense * step;
            links = self.links(share);
        }
    }

    /// What holds each link; `None` where one is not known to be free.
    fn held<'r>(&self, placed: &'r Placed, links: &[Link], left: f64) -> Option<SmallVec<[Held<'r>; 4]>> {
        // The last link goes farthest, so it is the first that is not known to be free any more.
        let held = links.iter().enumerate().rev().map(|(link, body)| {
            let (slack, room) = placed.known.room(&placed.inward(body), left * self.travel[link])?;
            (slack >= 0.0).then_some(Held { link, slack, room })
        });
        held.collect()
    }

    /// The share over which a link with some slack may go wherever it goes.
    fn anywhere(&self, link: usize, slack: f64) -> f64 {
        slack / self.travel[link].max(f64::MIN_POSITIVE)
    }

    /// The share over which a link may go that has so much slack before and after; negative where it has none.
    fn straight(&self, link: usize, slack: f64) -> f64 {
        if slack < 0.0 {
            return slack;
        }
        let bent = (8.0 * slack / self.bend[link].max(f64::MIN_POSITIVE)).sqrt();
        bent.max(2.0 * self.anywhere(link, slack))
    }

    /// How far a point of the robot goes at most.
    fn metres(&self) -> f64 {
        self.travel.iter().copied().fold(0.0, f64::max)
    }

    /// Whether the robot is known to touch an object on the way: looked at in the middle of what is left, ever finer, since
    /// how far it is from what is known to be taken says how much is out of the question at once.
    fn is_known_to_touch(&self, cell: &mut Workcell) -> bool {
        /// As long a stretch is looked at in one place only: what is known to be touched on it is hardly missed.
        const SHORT_M: f64 = 0.05;
        let short = SHORT_M / 2.0 / self.metres().max(SHORT_M / 2.0);
        // Most objects are so far that one look at the middle is enough.
        let mut near: SmallVec<[usize; 64]> = SmallVec::new();
        let middle = self.links(0.5);
        let about = self.about(&middle, 0.5);
        for object in 0..cell.placed.len() {
            if !cell.placed[object].may_be_taken_in(&about) {
                continue;
            }
            match cell.known_clear(object, &middle, &self.travel, 0.5) {
                None => return true,
                Some(clear) if clear < 0.5 => near.push(object),
                Some(_) => {}
            }
        }
        if near.is_empty() {
            return false;
        }
        // Each gap with those of the objects that may be touched in it, by their places among `near`.
        let all = 0..near.len();
        let mut left: SmallVec<[(Gap, Range<usize>); 32]> =
            smallvec![((1.0, 1.0), all.clone()), ((0.0, 1.0), all)];
        let mut next = 0;
        while let Some(((low, high), of)) = left.get(next).cloned() {
            next += 1;
            let (middle, half) = (f64::midpoint(low, high), (high - low) / 2.0);
            let links = self.links(middle);
            let mut clear = half;
            let first = near.len();
            for at in of {
                let object = near[at];
                match cell.known_clear(object, &links, &self.travel, half) {
                    None => return true,
                    Some(its) if its < half => {
                        near.push(object);
                        clear = clear.min(its);
                    }
                    Some(_) => {}
                }
            }
            let clear = clear.max(short);
            if clear < half {
                let still = first..near.len();
                left.extend([((low, middle - clear), still.clone()), ((middle + clear, high), still)]);
            }
        }
        false
    }

    /// A rectangle about all that the robot may take over so much of the motion before and after it has these links.
    fn about(&self, links: &[Link], share: f64) -> Rect {
        let each = links.iter().zip(&self.travel);
        let each = each.map(|(link, travel)| link.axis.bounds().grown(link.radius + share * travel));
        Rect::around(each.flat_map(|rect| rect.corners()))
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

    /// Whether the robot is free of all objects at a configuration, by the whole of what counts as touching: not by what is
    /// kept along motions, so that it is the same whatever is known.
    pub fn is_free(&mut self, at: &[f64]) -> bool {
        if !self.robot().admits(at) {
            return false;
        }
        let links = self.0.links(at);
        let whole = wider(self.robot().links(at), self.0.touching_m());
        let objects = self.0.placed.len();
        if (0..objects).any(|index| self.0.is_known_to_touch(index, &links)) {
            return false;
        }
        (0..objects)
            .all(|index| self.0.placed[index].slack(&whole, 0.0) >= 0.0 || self.0.evaluate(index, &links))
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
        let motion = Motion::new(self.0, robot.as_ref(), from, to);
        if motion.is_known_to_touch(self.0) {
            return false;
        }
        let mut gaps: Vec<(usize, Gap)> = Vec::new();
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
            let slack = self.0.placed[index].slack(&links, AMPLE_M);
            if slack >= 0.0 && (high - low) * motion.metres() < NO_GAP_M {
                continue;
            }
            // Room that hardly holds the links hardly narrows the gap, so it is evaluated, too.
            if slack < AMPLE_M && !self.0.evaluate(index, &links) && slack < 0.0 {
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
