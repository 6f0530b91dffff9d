//! Which corridors to take: the way of least weight through the network.
//!
//! petgraph's `astar` takes as long, where all passages are laid and weighed first (`cargo bench -p adit-planners --bench
//! search`); here a passage is weighed when the search comes to it, by rules that may fail, and of ways that weigh the same
//! one with fewest junctions is taken.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::network::Corridors;
use super::passage::{End, Passage};
use super::route_error::{NoRoute, RouteError};
use crate::geometry::Point;

/// The corridors to take from a start to a goal.
#[derive(Clone, Debug, PartialEq)]
pub struct Route<'a> {
    pub(super) corridors: &'a Corridors,
    pub(super) start: Point,
    pub(super) goal: Point,
    pub(super) junctions: Vec<usize>,
    pub(super) channels: Vec<usize>,
    weight: f64,
}

impl Route<'_> {
    pub fn start(&self) -> Point {
        self.start
    }

    pub fn goal(&self) -> Point {
        self.goal
    }

    /// Numbers of the junctions in which it turns, in the order of travel.
    pub fn junctions(&self) -> &[usize] {
        &self.junctions
    }

    /// Number of the channel of each leg: one more than junctions.
    pub fn channels(&self) -> &[usize] {
        &self.channels
    }

    /// The sum of the weights of its passages.
    pub fn weight(&self) -> f64 {
        self.weight
    }
}

/// What a way is to lead through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Through {
    Channel(usize),
    /// To turn there, by number.
    Junction(usize),
}

impl Through {
    fn is_met_by(self, passage: &Passage) -> bool {
        match self {
            Self::Channel(channel) => passage.channel == channel,
            Self::Junction(junction) => passage.to == End::Junction(junction),
        }
    }
}

/// Start, goal, and each junction once for each of the two channels by which it may be left.
type State = usize;
const START: State = 0;
const GOAL: State = 1;

/// How a state is reached best: weight, junctions on the way, from where, by which channel.
#[derive(Clone, Copy)]
struct Reached {
    weight: f64,
    steps: usize,
    from: State,
    channel: usize,
}

impl Corridors {
    /// The corridors of least total weight between two points; of ways that weigh the same, one with fewest junctions.
    ///
    /// # Arguments
    /// `weigh` says what a passage weighs, a number that is not negative; `None` where it must not be used. It is called
    /// only when the search comes to a passage, and once for each direction of it.
    ///
    /// # Returns
    /// The route; an error where a point lies in no channel, `weigh` fails, or [there is none](NoRoute).
    ///
    /// # Complexity
    /// For each channel that is reached, the square of its junctions.
    pub fn route<E>(
        &self,
        start: Point,
        goal: Point,
        weigh: impl FnMut(&Passage) -> Result<Option<f64>, E>,
    ) -> Result<Route<'_>, RouteError<E>> {
        self.route_through(start, goal, None, weigh)
    }

    /// As [`route`](Self::route), of the ways that lead through a channel or junction; all where none is given.
    pub fn route_through<E>(
        &self,
        start: Point,
        goal: Point,
        through: Option<Through>,
        mut weigh: impl FnMut(&Passage) -> Result<Option<f64>, E>,
    ) -> Result<Route<'_>, RouteError<E>> {
        for (what, point) in [(End::Start, start), (End::Goal, goal)] {
            if self.at(point).next().is_none() {
                return Err(RouteError::Outside { what, point });
            }
        }
        // each state once before what the way has to lead through, and once behind it
        let states = 2 + 2 * self.junctions().len();
        let mut reached: Vec<Option<Reached>> = vec![None; 2 * states];
        let mut is_settled = vec![false; reached.len()];
        let mut refused = Vec::new();
        let first = if through.is_some() { START } else { START + states };
        let mut queue = BinaryHeap::from([Reverse((0_u64, 0_usize, first))]);
        while let Some(Reverse((bits, steps, state))) = queue.pop() {
            if std::mem::replace(&mut is_settled[state], true) {
                continue;
            }
            if state == GOAL + states {
                return Ok(self.traced(start, goal, &reached, states));
            }
            // who is at the goal without having been where the way is to lead does not go on from there
            if state == GOAL {
                continue;
            }
            let so_far = f64::from_bits(bits);
            for passage in self.passages(start, goal, state % states) {
                let is_behind = state >= states || through.is_some_and(|through| through.is_met_by(&passage));
                let to = self.state(passage.to, passage.channel) + if is_behind { states } else { 0 };
                if is_settled[to] {
                    continue;
                }
                let Some(weight) = weigh(&passage).map_err(RouteError::Weigh)? else {
                    refused.push(passage);
                    continue;
                };
                if !(weight.is_finite() && weight >= 0.0) {
                    return Err(RouteError::BadWeight { passage, weight });
                }
                // without a sign, so that the bits of weights are in the order of the weights
                let arrival = Reached {
                    weight: (so_far + weight).abs(),
                    steps: steps + 1,
                    from: state,
                    channel: passage.channel,
                };
                let is_better = reached[to]
                    .is_none_or(|known| (arrival.weight, arrival.steps) < (known.weight, known.steps));
                if is_better {
                    reached[to] = Some(arrival);
                    queue.push(Reverse((arrival.weight.to_bits(), arrival.steps, to)));
                }
            }
        }
        Err(RouteError::NoRoute(NoRoute::new(self, start, goal, refused)))
    }

    /// The state in which one is behind a passage.
    fn state(&self, end: End, by: usize) -> State {
        match end {
            End::Start => START,
            End::Goal => GOAL,
            End::Junction(number) => {
                let left_by_upright = self.junctions()[number - 1].lying == by;
                2 * number + usize::from(left_by_upright)
            }
        }
    }

    /// All passages that lead on from a state.
    fn passages(&self, start: Point, goal: Point, state: State) -> impl Iterator<Item = Passage> {
        let (from, at) = match state {
            START => (End::Start, start),
            _ => (End::Junction(state / 2), self.junctions()[state / 2 - 1].rect.centre()),
        };
        let channels: Vec<usize> = match from {
            End::Junction(number) if state % 2 == 1 => vec![self.junctions()[number - 1].upright],
            End::Junction(number) => vec![self.junctions()[number - 1].lying],
            _ => self.at(start).collect(),
        };
        channels.into_iter().flat_map(move |channel| {
            let passage = move |to, point: Point| Passage {
                channel,
                from,
                to,
                length: at.distance(point),
                width: self.width(channel),
            };
            let junctions =
                self.on[channel - 1].iter().map(|index| (index + 1, &self.junctions()[*index].rect));
            // whoever stands in a junction is in both of its channels already
            let is_apart = move |number: usize, rect: &crate::geometry::Rect| match from {
                End::Junction(own) => own != number,
                _ => !rect.contains(start),
            };
            let on = junctions
                .filter(move |(number, rect)| is_apart(*number, rect))
                .map(move |(number, rect)| passage(End::Junction(number), rect.centre()));
            let here = match from {
                End::Junction(own) => self.junctions()[own - 1].rect.contains(goal),
                _ => false,
            };
            let ends = self.channel(channel).contains(goal) && !here;
            on.chain(ends.then(|| passage(End::Goal, goal)))
        })
    }

    /// The way back from the goal, turned round.
    fn traced(&self, start: Point, goal: Point, reached: &[Option<Reached>], states: usize) -> Route<'_> {
        let (mut junctions, mut channels, mut at) = (Vec::new(), Vec::new(), GOAL + states);
        while let Some(step) = reached[at].filter(|_| at % states != START) {
            channels.push(step.channel);
            if step.from % states != START {
                junctions.push(step.from % states / 2);
            }
            at = step.from;
        }
        junctions.reverse();
        channels.reverse();
        let weight = reached[GOAL + states].map_or(0.0, |goal| goal.weight);
        Route { corridors: self, start, goal, junctions, channels, weight }
    }
}
