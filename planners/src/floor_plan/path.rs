//! Paths over the network of places: by the nearest adits, over all adits, and pulled tight.

use super::funnel::{funnel, straightened};
use super::mesh::Gate;
use super::network::{Network, Spot, Standing, Way};
use super::trees::{Route, Trees};
use crate::geometry::{Point, path_length};

/// Paths over adits that are longer than the shortest by at most this share are pulled tight, too: straightened they
/// may be shorter.
const SLACK: f64 = 0.2;

/// So many paths are pulled tight.
const MOST_PULLED: usize = 12;

/// How a path is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Over the adit nearest to the start and the one nearest to the goal, the first left out where the next lies in
    /// the same region, and the last likewise (Crowley, section 4.4).
    Nearest,
    /// Over the adits of least weight.
    AllAdits,
    /// As [`Self::AllAdits`], and pulled tight through the doorways.
    Tight,
    /// As [`Self::Tight`], of the paths that pass this doorway, and pass it once.
    Through(usize),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The centre of the disc goes straight from each to the next.
    pub points: Vec<Point>,
    /// Metres.
    pub length: f64,
    /// What its ways weigh; pulled tight, less by the metres that this saves.
    pub weight: f64,
    /// The doorways that it passes, by index, in order.
    pub doorways: Vec<usize>,
    /// The adits that it was found over, by index, in order.
    pub adits: Vec<usize>,
}

/// Why there is no path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NoPath {
    #[error("the disc cannot stand at the start: a wall is too near, or it lies outside of the plan")]
    Start,
    #[error("the disc cannot stand at the goal: a wall is too near, or it lies outside of the plan")]
    Goal,
    #[error("no way that is open to the disc joins the start and the goal")]
    NoWay,
}

/// What a search has at hand.
struct Query<'n, W> {
    network: &'n Network,
    ends: [Standing; 2],
    first: Vec<Way>,
    last: Vec<Way>,
    trees: Trees<'n>,
    weigh: W,
}

impl Network {
    /// The path of least weight between two points.
    ///
    /// # Arguments
    /// `weigh` gives the weight of a way, which may be walked in both directions; `None` closes it, and so does what is
    /// negative or no number. Where each way weighs its length the path is the shortest. A weight that is more than
    /// the length is kept whole when the path is pulled tight.
    pub fn path(
        &self,
        from: Point,
        to: Point,
        rule: Rule,
        mut weigh: impl FnMut(&Way) -> Option<f64>,
    ) -> Result<Path, NoPath> {
        let start = self.stand(from).ok_or(NoPath::Start)?;
        let goal = self.stand(to).ok_or(NoPath::Goal)?;
        let first = self.ways_from(Spot::Start, start);
        let last = self.ways_from(Spot::Goal, goal);
        let mut weight = |way: &Way| weigh(way).filter(|weight| weight.is_finite() && *weight >= 0.0);
        let weights: Vec<Option<f64>> = self.ways.iter().map(&mut weight).collect();
        let trees = Trees::new(self, weights);
        let mut query = Query { network: self, ends: [start, goal], first, last, trees, weigh: weight };
        match rule {
            Rule::Nearest => query.nearest(),
            Rule::AllAdits => query.all_adits(),
            Rule::Tight => query.tight(),
            Rule::Through(doorway) => query.through(doorway),
        }
        .ok_or(NoPath::NoWay)
    }
}

impl<W: FnMut(&Way) -> Option<f64>> Query<'_, W> {
    /// The way straight to the goal, where both lie in one region, with its weight.
    fn direct(&mut self) -> Option<(Way, f64)> {
        let [start, goal] = self.ends;
        if start.region != goal.region {
            return None;
        }
        let way = self.network.inside([Spot::Start, Spot::Goal], start, goal)?;
        let weight = (self.weigh)(&way)?;
        Some((way, weight))
    }

    /// The ways from an end to its adits that are open, with their weights.
    fn open(&mut self, ways: impl Fn(&Self) -> &Vec<Way>) -> Vec<(usize, f64)> {
        let ways = ways(self).clone();
        let open = ways.iter().filter_map(|way| {
            let Spot::Adit(adit) = way.to else { return None };
            Some((adit, (self.weigh)(way)?))
        });
        open.collect()
    }

    fn nearest(&mut self) -> Option<Path> {
        if let Some((way, weight)) = self.direct() {
            return Some(path_of(way.points, weight, &[], self.network));
        }
        let [start, goal] = self.ends;
        let network = self.network;
        let near = |open: Vec<(usize, f64)>, at: Point| {
            let distance = |adit: usize| network.adits[adit].at.distance(at);
            open.into_iter().min_by(|a, b| distance(a.0).total_cmp(&distance(b.0)).then(a.0.cmp(&b.0)))
        };
        let (first, last) = (self.open(|query| &query.first), self.open(|query| &query.last));
        let (near_start, near_goal) = (near(first.clone(), start.at)?, near(last.clone(), goal.at)?);
        let mut route = self.trees.routes(&[near_start], &[near_goal], 0.0).into_iter().next()?;
        let region = |adit: usize| network.adits[adit].region;
        if let [one, two, ..] = route.adits[..]
            && region(one) == region(two)
        {
            route.adits.remove(0);
            route.weight += weight_to(&first, two)? - near_start.1 - self.trees.between(one, two)?;
        }
        if let [.., two, one] = route.adits[..]
            && region(one) == region(two)
        {
            route.adits.pop();
            route.weight += weight_to(&last, two)? - near_goal.1 - self.trees.between(one, two)?;
        }
        Some(self.over_adits(&route))
    }

    fn all_adits(&mut self) -> Option<Path> {
        let direct = self.direct();
        let (first, last) = (self.open(|query| &query.first), self.open(|query| &query.last));
        let route = self.trees.routes(&first, &last, 0.0).into_iter().next();
        match (direct, route) {
            (Some((way, weight)), route) if route.as_ref().is_none_or(|route| weight <= route.weight) => {
                Some(path_of(way.points, weight, &[], self.network))
            }
            (_, Some(route)) => Some(self.over_adits(&route)),
            _ => None,
        }
    }

    fn tight(&mut self) -> Option<Path> {
        let direct = self.direct().map(|(way, weight)| path_of(way.points, weight, &[], self.network));
        let (first, last) = (self.open(|query| &query.first), self.open(|query| &query.last));
        let mut routes = self.trees.routes(&first, &last, SLACK);
        routes.truncate(MOST_PULLED);
        let pulled = routes.iter().filter_map(|route| self.pulled(route));
        direct.into_iter().chain(pulled).min_by(|a, b| a.weight.total_cmp(&b.weight))
    }

    fn through(&mut self, doorway: usize) -> Option<Path> {
        let network = self.network;
        let (first, last) = (self.open(|query| &query.first), self.open(|query| &query.last));
        let mut routes = self.trees.routes(&first, &last, f64::MAX);
        routes.retain(|route| passed(&route.adits, network).any(|passed| passed == doorway));
        let least = routes.first()?.weight;
        routes.retain(|route| route.weight <= least * (1.0 + SLACK));
        routes.truncate(MOST_PULLED);
        let pulled = routes.iter().filter_map(|route| self.pulled(route));
        pulled.min_by(|a, b| a.weight.total_cmp(&b.weight))
    }

    fn over_adits(&self, route: &Route) -> Path {
        let mut points = vec![self.ends[0].at];
        let mut before = None;
        for &adit in &route.adits {
            let leg = match before {
                None => {
                    self.first.iter().find(|way| way.to == Spot::Adit(adit)).map(|way| way.points.clone())
                }
                Some(before) => self.trees.points(before, adit),
            };
            points.extend(leg.unwrap_or_default());
            before = Some(adit);
        }
        let end = before.and_then(|adit| self.last.iter().find(|way| way.to == Spot::Adit(adit)));
        points.extend(end.into_iter().flat_map(|way| way.points.iter().rev().copied()));
        points.push(self.ends[1].at);
        path_of(straightened(points), route.weight, &route.adits, self.network)
    }

    fn pulled(&self, route: &Route) -> Option<Path> {
        let network = self.network;
        let (mut gates, mut at): (Vec<Gate>, _) = (Vec::new(), self.ends[0]);
        let mut adits = route.adits.iter().copied().peekable();
        while let Some(adit) = adits.next() {
            if adits.peek() != Some(&network.adits[adit].twin) {
                continue;
            }
            let opening = &network.mesh.openings[adit / 2];
            let [near, far] = [adit % 2, 1 - adit % 2];
            let [a, b] = opening.ends;
            gates.extend(network.mesh.gates(at.region, at.triangle, opening.triangles[near])?);
            gates.push(if near == 0 { [b, a] } else { [a, b] });
            let region = network.regions.doorways[opening.doorway].regions[far];
            at = Standing { region, triangle: opening.triangles[far], at: opening.middle() };
        }
        gates.extend(network.mesh.gates(at.region, at.triangle, self.ends[1].triangle)?);
        let points = funnel(self.ends[0].at, &gates, self.ends[1].at);
        let untightened = self.over_adits(route).length;
        let weight = (route.weight - untightened + path_length(&points)).max(0.0);
        Some(path_of(points, weight, &route.adits, network))
    }
}

fn weight_to(open: &[(usize, f64)], adit: usize) -> Option<f64> {
    open.iter().find(|end| end.0 == adit).map(|end| end.1)
}

/// The doorways that a path over adits passes.
fn passed<'n>(adits: &'n [usize], network: &'n Network) -> impl Iterator<Item = usize> + 'n {
    let passed = adits.windows(2).filter(|pair| network.adits[pair[0]].twin == pair[1]);
    passed.map(|pair| network.adits[pair[0]].doorway)
}

fn path_of(points: Vec<Point>, weight: f64, adits: &[usize], network: &Network) -> Path {
    let doorways = passed(adits, network).collect();
    Path { length: path_length(&points), points, weight, doorways, adits: adits.to_vec() }
}
