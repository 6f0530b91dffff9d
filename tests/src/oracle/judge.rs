//! The judge of a site's routes: each beside the best way, and everything about it that cannot be right.

use adit_planners::geometry::{Point, Segment};

use super::driven::Driven;
use super::grid::Grid;
use super::random::Chance;
use super::silly::{self, Silly};
use super::site::Built;
use super::space::Space;
use super::tally::Tally;

/// How far a waypoint's piece may come into a wall: what decimal fractions lose in binary and in JSON, metres.
const TRESPASS: f64 = 1e-6;
/// How much a told cost may differ from that of the way told, as a part of it.
const ROUNDING: f64 = 1e-6;
/// What the best way that routes are measured by keeps off walls, metres: none may hang on a passage as wide as the robot.
const ROOM: f64 = 0.005;
/// How much cheaper than the best way known a route may be before the judge is to blame.
const JUDGE_MISSES: f64 = 0.01;

/// What was found out about routes.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    /// Cost of each route over that of the best way that keeps five millimetres off walls.
    pub exact: Tally,
    /// What cannot be right.
    pub wrong: Vec<String>,
    /// What no person would do.
    pub silly: Vec<String>,
    /// Pairs between which there is no way.
    pub cut_off: usize,
}

impl Findings {
    /// Adds those of another.
    pub fn extend(&mut self, other: Self) {
        self.exact.extend(other.exact);
        self.wrong.extend(other.wrong);
        self.silly.extend(other.silly);
        self.cut_off += other.cut_off;
    }

    /// Prints how the ratios are spread, for who reads a test's output.
    pub fn print(&self, what: &str) {
        eprintln!("{what}: {} pairs cut off", self.cut_off);
        eprintln!("  beside the best way: {}", self.exact);
        for (kind, all) in [("wrong", &self.wrong), ("silly", &self.silly)] {
            eprintln!("  {kind}: {}", all.len());
            all.iter().take(40).for_each(|one| eprintln!("    {one}"));
        }
    }

    /// Fails the test unless routes are as good as they are said to be.
    #[track_caller]
    pub fn expect_good(&self) {
        assert!(self.wrong.is_empty(), "{:#?}", self.wrong);
        assert!(self.exact.count() > 0, "no route was judged");
        assert!(self.exact.median() <= 1.005, "median {}", self.exact);
        assert!(self.exact.worst() <= 1.05, "worst {}", self.exact);
        assert!(self.silly.is_empty(), "{:#?}", self.silly);
    }
}

/// Judges the routes of a site.
pub struct Judge<'a> {
    built: &'a Built,
    side: f64,
    exact: Space,
    roomy: Space,
    fair: Space,
    /// Free on every lattice, whatever slivers are dropped.
    surely: Space,
}

impl<'a> Judge<'a> {
    /// A judge of a site whose layers have cells of `side` metres.
    pub fn new(built: &'a Built, side: f64) -> Self {
        let diagonal = side * 2f64.sqrt();
        let space = |margin: f64| Space::new(&built.world, built.body(), margin).with_areas(&built.areas);
        Self {
            built,
            side,
            exact: space(0.0),
            roomy: space(ROOM),
            fair: space(diagonal),
            surely: space(3.0 * diagonal),
        }
    }

    /// The true free space.
    pub fn space(&self) -> &Space {
        &self.exact
    }

    /// Points by chance at which no answer hangs on a cell.
    pub fn points(&self, chance: &mut Chance, count: usize) -> Vec<Point> {
        let b = self.exact.bounds();
        let tries =
            (0..400 * count).map(|_| Point::new(chance.metres(b.x0, b.x1), chance.metres(b.y0, b.y1)));
        tries.filter(|&p| self.exact.is_plain(p, 5.0 * self.side)).take(count).collect()
    }

    /// Judges the routes from one point to others. `step` is that of the grids, metres.
    #[track_caller]
    pub fn judge(&self, name: &str, start: Point, goals: &[Point], step: f64) -> Findings {
        let grids = [&self.roomy, &self.exact].map(|space| Grid::new(space, step));
        let roomy = grids[0].ways_from(start);
        let exact = std::cell::LazyCell::new(|| grids[1].ways_from(start));
        let mut found = Findings::default();
        for &goal in goals {
            let of = format!("{name}: {},{} to {},{}", start.x, start.y, goal.x, goal.y);
            let Some(driven) = self.built.route(start, goal) else {
                found.cut_off += 1;
                if Grid::new(&self.surely, step).ways_from(start).over_the_grid(goal).is_some() {
                    found.wrong.push(format!("{of}: no route, though there is a way"));
                }
                continue;
            };
            self.look_at(&driven, &of, (start, goal), &mut found);
            let best = roomy.to(goal).map(|way| way.cost(&self.roomy));
            if best.is_none_or(|best| driven.cost < best * (1.0 - JUDGE_MISSES)) {
                match exact.to(goal).map(|way| way.cost(&self.exact)) {
                    None => found.wrong.push(format!("{of}: a route, though the judge knows no way")),
                    Some(best) if driven.cost < best * (1.0 - JUDGE_MISSES) => {
                        let what =
                            format!("{of}: costs {}, the judge knows nothing below {best}", driven.cost);
                        found.wrong.push(what);
                    }
                    Some(_) => {}
                }
            }
            if let Some(best) = best {
                found.exact.add(driven.cost / best, of);
            }
        }
        found
    }

    /// Adds what is wrong and silly about a route by itself.
    pub fn look_at(&self, driven: &Driven, of: &str, ends: (Point, Point), found: &mut Findings) {
        found.wrong.extend(self.faults(driven, of, ends));
        let seen = silly::find(&driven.way, [&self.exact, &self.fair], self.side);
        let say = |Silly { at, what }: Silly| format!("{of}: {what} at {:.3},{:.3}", at.x, at.y);
        found.silly.extend(seen.into_iter().map(say));
    }

    /// What cannot be right about a route by itself.
    fn faults(&self, driven: &Driven, of: &str, (start, goal): (Point, Point)) -> Vec<String> {
        let mut faults = driven.faults(&self.exact);
        let way = &driven.way;
        if let Some((piece, depth)) = way.worst_trespass(&self.exact, TRESPASS) {
            faults.push(format!("waypoints are {depth:.6} m too near to a wall on {piece:?}"));
        }
        let sum = way.cost(&self.exact);
        if (sum - driven.cost).abs() > ROUNDING * driven.cost.max(1.0) {
            faults.push(format!("costs {}, its waypoints {sum}", driven.cost));
        }
        let ends = |points: &[Point]| [points[0].distance(start), points[points.len() - 1].distance(goal)];
        let off = [ends(&way.points), ends(&driven.steps.points)].concat();
        if off.iter().any(|off| *off > TRESPASS) {
            faults.push(format!("waypoints and steps begin and end {off:?} m off"));
        }
        // a step may bend within its room: only where it ends lies on the way
        for p in &driven.steps.points {
            let off = way.pieces().map(|piece| Segment::new(piece.from, piece.to).distance(*p));
            let off = off.fold(p.distance(way.points[0]), f64::min);
            if off > TRESPASS {
                faults.push(format!("a step ends at {p:?}, {off} m beside the way"));
            }
        }
        faults.into_iter().map(|fault| format!("{of}: {fault}")).collect()
    }
}
