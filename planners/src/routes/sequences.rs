//! Changes of shape one after the other at one point, where that costs less than one change does.

use std::collections::BTreeMap;

use super::cone::Segment;
use super::graph::RouteGraph;
use super::mesh::{EPSILON, Exit};
use super::parts::{DoorIndex, RoomIndex};
use crate::geometry::Point;

/// Of two layers the least and the most that a change from one into the other costs; infinite where it is not made.
type Prices = BTreeMap<u32, BTreeMap<u32, [f64; 2]>>;

impl RouteGraph {
    /// Whether a change of shape between the layers of two rooms costs more than several one after the other, or is not made.
    pub(super) fn is_sequence_cheaper(&self, from: RoomIndex, to: RoomIndex) -> bool {
        !self.sequences().is_empty() && self.sequences().contains_key(&self.layers_of(from, to))
    }

    /// What changes between the layers of two rooms cost together at least, where several cost less than one.
    pub(super) fn least_of_sequence(&self, from: RoomIndex, to: RoomIndex) -> f64 {
        self.sequences().get(&self.layers_of(from, to)).copied().unwrap_or(0.0)
    }

    fn layers_of(&self, from: RoomIndex, to: RoomIndex) -> (u32, u32) {
        let mesh = &self.turning().mesh;
        (mesh.layer(from), mesh.layer(to))
    }

    fn sequences(&self) -> &BTreeMap<(u32, u32), f64> {
        self.turning().sequences.get_or_init(|| {
            let prices = self.prices();
            // of changes out of each layer, and into it, the cheapest
            let (mut out_of, mut into) = (BTreeMap::new(), BTreeMap::new());
            for (&from, all) in &prices {
                for (&to, &[least, _]) in all {
                    for (known, layer) in [(&mut out_of, from), (&mut into, to)] {
                        let known: &mut f64 = known.entry(layer).or_insert(least);
                        *known = known.min(least);
                    }
                }
            }
            let mut cheaper = BTreeMap::new();
            for (&from, all) in &prices {
                for (over, [first, _]) in all {
                    for (&to, [second, _]) in prices.get(over).into_iter().flatten() {
                        let Some([at_once, most]) = all.get(&to) else { continue };
                        if first + second < most - EPSILON {
                            // no sequence costs less than its first and its last change together
                            let least = at_once.min(out_of[&from] + into[&to]);
                            cheaper.insert((from, to), least);
                        }
                    }
                }
            }
            cheaper
        })
    }

    fn prices(&self) -> Prices {
        let mut prices = Prices::new();
        let mut last = None;
        for door in self.doors().iter().filter(|door| door.is_change()) {
            let of = [door.room1, door.room2];
            let is_entered = of.iter().all(|&room| self.is_entered(room));
            let price = door.weight().filter(|_| is_entered).unwrap_or(f64::INFINITY);
            let [one, two] = of.map(|room| self.turning().mesh.layer(room));
            // most doors are between the layers of the one before, and cost what it does
            let this = Some((one, two, price.to_bits(), door.one_way));
            if this == last {
                continue;
            }
            last = this;
            let mut note = |from: u32, to: u32| {
                let known = prices.entry(from).or_default().entry(to).or_insert([price, price]);
                *known = [known[0].min(price), known[1].max(price)];
            };
            note(one, two);
            if !door.one_way {
                note(two, one);
            }
        }
        prices
    }

    /// Of a change that costs more than several one after the other: where the space of a state between ends in which they are made, so
    /// that beyond it there is the dear change alone.
    pub(super) fn ends_of_sequences(&self, door: DoorIndex, from: RoomIndex, to: RoomIndex) -> Vec<Segment> {
        let Some(area) = self[door].crossing.area() else { return Vec::new() };
        let leads_there = |between: RoomIndex| {
            self.exits.changes(between).iter().any(|exit| exit.to == to && self.is_open(exit.door))
        };
        let between = self.exits.changes(from).iter().filter(|exit| exit.to != to && self.is_open(exit.door));
        between
            .filter(|exit| leads_there(exit.to))
            .flat_map(|exit| self[exit.to].outline.sides().flat_map(|side| self.rim(exit.to, side)))
            .filter_map(|end| area.clip(end))
            .flat_map(|end| self.clear_of_walls(from, end))
            .collect()
    }

    /// The changes at a point that lead from a room into another and together cost least (Dijkstra), each with what they
    /// cost up to there; `None` where none do.
    pub(super) fn cheapest_changes(
        &self,
        from: RoomIndex,
        to: RoomIndex,
        at: Point,
    ) -> Option<Vec<(Exit, f64)>> {
        // rooms that were reached: the change into each, what all cost up to there, and the one before
        let mut reached: Vec<(Exit, f64, Option<usize>)> = Vec::new();
        let mut done: Vec<bool> = Vec::new();
        let (mut room, mut cost, mut before) = (from, 0.0, None);
        while room != to {
            for exit in self.exits.changes(room).iter().filter(|exit| exit.to != from) {
                let Some(price) = self.passage(exit.door) else { continue };
                if !self[exit.door].crossing.area().is_some_and(|area| area.contains(at)) {
                    continue;
                }
                let next = (*exit, cost + price, before);
                match reached.iter_mut().find(|(known, ..)| known.to == exit.to) {
                    Some(known) if known.1 > next.1 + EPSILON => *known = next,
                    Some(_) => {}
                    None => {
                        reached.push(next);
                        done.push(false);
                    }
                }
            }
            let open = (0..reached.len()).filter(|&place| !done[place]);
            let place = open.min_by(|&one, &two| reached[one].1.total_cmp(&reached[two].1))?;
            done[place] = true;
            (room, cost, before) = (reached[place].0.to, reached[place].1, Some(place));
        }
        let mut steps = Vec::new();
        while let Some(place) = before {
            let (exit, cost, previous) = reached[place];
            steps.push((exit, cost));
            before = previous;
        }
        steps.reverse();
        Some(steps)
    }
}
