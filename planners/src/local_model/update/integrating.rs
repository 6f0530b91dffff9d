//! What a scan shows put together with the model.

use super::super::fit::Echo;
use super::super::matching::{Match, Nearby};
use super::super::reinforce::{reinforce, same_surface};
use super::super::sensor_model::Seen;
use super::super::{LocalModel, SegmentId};
use super::Update;
use super::looking::{Explained, Look};
use crate::geometry::Rect;

/// A surface that known ones do not explain has at least so many echoes that none of them explains.
const FEWEST_OTHERS: usize = 2;

impl LocalModel {
    /// Reinforces and extends what was seen again.
    ///
    /// # Returns
    /// What is new in the scan, and the places of segments that changed.
    pub(super) fn integrate(
        &mut self,
        seen: &[Seen],
        near: &Nearby,
        looks: &mut [Look],
        explained: &mut [Explained],
        update: &mut Update,
    ) -> (Vec<Seen>, Vec<usize>) {
        let (mut new, mut changed) = (Vec::new(), Vec::new());
        for one in seen {
            // whatever lies on the same line leaves nothing of it, however short the part beside it
            let beside = self.matches(one, 0.0, near);
            let found: Vec<&Match> = beside.iter().filter(|on| on.is_enough).collect();
            if found.is_empty() {
                // a line through the echoes on either side of a known corner is no surface
                let others = one.echoes.iter().filter(|echo| !explained[echo.beam].by_known).count();
                if others >= FEWEST_OTHERS {
                    new.push(one.clone());
                }
                continue;
            }
            update.matched += 1;
            for on in &found {
                looks[on.model].is_matched = true;
            }
            if found.iter().any(|on| self.segments[on.model].is_anchored) {
                new.extend(self.beside(one, &beside));
            } else {
                let segment = &mut self.segments[found[0].model];
                reinforce(segment, &one.fit, &one.line, &self.estimate);
                changed.push(found[0].model);
            }
            for echo in &one.echoes {
                explained[echo.beam].by_any = true;
            }
        }
        changed.sort_unstable();
        changed.dedup();
        (new, changed)
    }

    /// The pieces of a scan's segment that lie beside none of the segments `on` which parts of it lie. One between two walls, with
    /// echoes in it, fills the gap: a closed door. One at an end has to be enough for a segment of its own.
    fn beside(&self, one: &Seen, on: &[Match]) -> Vec<Seen> {
        let place = |p| one.fit.place(p);
        let ordered = |a: f64, b: f64| (a.min(b), a.max(b));
        let lines = on.iter().map(|on| self.segments[on.model].line);
        let mut covered: Vec<(f64, f64)> = lines.map(|line| ordered(place(line.a), place(line.b))).collect();
        covered.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (begin, end) = ordered(place(one.line.a), place(one.line.b));
        let (mut gaps, mut from) = (Vec::new(), begin);
        for (cover, until) in covered {
            gaps.push((from, cover.min(end), from > begin && cover < end));
            from = from.max(until);
        }
        gaps.push((from, end, false));
        // an end is not known better than two segments that are joined there
        let margin = self.settings.join_m / 2.0;
        let piece = |(from, to, is_between): (f64, f64, bool)| {
            let is_in = |echo: &&Echo| (from + margin..=to - margin).contains(&place(echo.at));
            let echoes: Vec<Echo> = one.echoes.iter().filter(is_in).copied().collect();
            let enough = if is_between { 2 } else { self.settings.fewest_echoes };
            let is_enough = echoes.len() >= enough && to - from >= self.settings.shortest_m + 2.0 * margin;
            is_enough.then(|| one.piece(from, to, echoes))
        };
        gaps.into_iter().filter(|(from, to, _)| from + 2.0 * margin < *to).filter_map(piece).collect()
    }

    /// Joins segments that have grown over one another.
    ///
    /// # Returns
    /// The names of those that were absorbed.
    pub(super) fn merge(
        &mut self,
        changed: &[SegmentId],
        near: &Nearby,
        looks: &mut Vec<Look>,
    ) -> Vec<SegmentId> {
        let reach = self.settings.match_offset_m;
        let is_apart = |a: &Rect, b: &Rect| {
            a.x1 + reach < b.x0 || b.x1 + reach < a.x0 || a.y1 + reach < b.y0 || b.y1 + reach < a.y0
        };
        let mut bounds: Vec<Rect> =
            near.walls.iter().map(|wall| self.segments[wall.model].line.bounds()).collect();
        let mut is_absorbed = vec![false; self.segments.len()];
        for id in changed {
            let Ok(one) = self.place(*id) else { continue };
            // those near stand in the order of their places
            let Ok(own) = near.walls.binary_search_by_key(&one, |wall| wall.model) else { continue };
            if is_absorbed[one] || self.segments[one].is_anchored {
                continue;
            }
            for index in 0..near.walls.len() {
                let other = near.walls[index].model;
                if is_apart(&bounds[own], &bounds[index]) || one == other || is_absorbed[other] {
                    continue;
                }
                let (a, b) = (&self.segments[one], &self.segments[other]);
                if b.is_anchored || a.object != b.object {
                    continue;
                }
                if let Some(line) = same_surface(a, b, &self.settings) {
                    let other_one = *b;
                    let segment = &mut self.segments[one];
                    reinforce(segment, &line, &other_one.line, &self.estimate);
                    segment.confidence = segment.confidence.max(other_one.confidence);
                    segment.counts_for_pose |= other_one.counts_for_pose;
                    segment.age = segment.age.max(other_one.age);
                    bounds[own] = segment.line.bounds();
                    is_absorbed[other] = true;
                }
            }
        }
        let mut kept = is_absorbed.iter().map(|is_absorbed| !is_absorbed);
        looks.retain(|_| kept.next().unwrap_or(true));
        let (mut places, mut ids) = (is_absorbed.into_iter(), Vec::new());
        self.segments.retain(|segment| {
            let is_absorbed = places.next().unwrap_or(false);
            if is_absorbed {
                ids.push(segment.id);
            }
            !is_absorbed
        });
        ids
    }
}
