//! The first value at which others win, where weights are linear in it: lines of the ways that are best at two values lead to it.

use super::{Along, Piece};
use crate::state::tunable::Line;
use crate::why::contrast::straight::{At, Straight, is_inside};
use crate::why::contrast::{End, Path, Takeover};

/// Rounds in which an end is narrowed at most.
const ROUNDS: usize = 40;

/// Ways that bend otherwise at another value cost more at this one by such a share at most.
const BENT: f64 = 2e-5;

impl Along<'_> {
    /// The first value between two at which the others win; at `near` they have not.
    ///
    /// # Arguments
    /// `is_rising` says that nothing gets easier from `near` to `far`.
    pub(super) fn first(&mut self, line: &Line, near: At, far: At, is_rising: bool) -> Piece {
        // the nearest interval is the last; what lies beyond an end is not looked at
        let (mut waiting, mut end) = (vec![(near, far)], None);
        while let Some((near, far)) = waiting.pop() {
            if self.is_over() {
                return Piece::Unknown;
            }
            if far.look.is_turned {
                let Some((before, found)) = self.narrowed(line, &near, far) else { return Piece::Unknown };
                end = Some(found);
                waiting.clear();
                waiting.push((near, before));
            } else if let Some(middle) = self.may_turn(line, &near, &far) {
                let middle = self.look_at(line, middle, (&near, is_rising));
                let Some(mut middle) = middle else { return Piece::Unknown };
                if is_rising {
                    middle.look.least = middle.look.least.max(near.look.least);
                }
                if !middle.look.is_turned {
                    waiting.push((middle.clone(), far));
                }
                waiting.push((near, middle));
            }
        }
        end.map_or(Piece::Nothing, Piece::End)
    }

    /// The end between a value at which the others have not won and one at which they have, and the last value before it that was
    /// looked at.
    fn narrowed(&mut self, line: &Line, near: &At, far: At) -> Option<(At, End)> {
        let (mut before, mut beyond) = (near.clone(), far);
        for round in 0..ROUNDS {
            if self.is_over() {
                return None;
            }
            let middle = f64::midpoint(before.value, beyond.value);
            let hair = self.hair(middle);
            let value = if round % 4 == 3 { None } else { self.crossing(line, &before, &beyond) };
            let gap = (beyond.value - before.value).abs();
            let is_exact = self.contrast.hair() <= 0.0;
            // where what each way costs is known, both are known to cost the same there
            let is_found = value.is_some_and(|value| is_exact && !is_inside(value, &before, &beyond));
            if is_found || gap <= 2.0 * hair || gap <= 1e-9 * beyond.value.abs().max(1e-6) {
                return Some(self.ended(line, near, (before, beyond), value.unwrap_or(middle)));
            }
            let value = value.unwrap_or(middle);
            let side = (beyond.value - before.value).signum();
            let tries = if is_exact { [value, value] } else { [value - hair * side, value + hair * side] };
            for tried in tries {
                if !is_inside(tried, &before, &beyond) || (tried - before.value) * side <= 0.0 {
                    continue;
                }
                let at = self.glance_at(line, tried)?;
                if at.look.is_turned {
                    beyond = at;
                    break;
                }
                before = at;
            }
        }
        let middle = f64::midpoint(before.value, beyond.value);
        Some(self.ended(line, near, (before, beyond), middle))
    }

    fn ended(&self, line: &Line, near: &At, (mut before, beyond): (At, At), at: f64) -> (At, End) {
        let won_at = if self.contrast.hair() > 0.0 { beyond.value } else { at };
        let cost = |path: &Path| line.at(won_at).map(|weights| path.cost(&weights));
        let takeover = match &beyond.look.rival {
            Some((path, _)) => Takeover::Way(path.clone(), cost(path).unwrap_or(f64::INFINITY)),
            None => Takeover::NoWay,
        };
        // what the others cost is concave: between two values no less than the straight line
        if beyond.look.least.is_finite() {
            let share = (before.value - near.value) / (beyond.value - near.value);
            let (from, to) = (near.look.least, beyond.look.least);
            before.look.least = before.look.least.max(from + (to - from) * share);
        }
        (before, End { won_at, ..End::at(at, takeover) })
    }

    /// Where the way that holds at one value comes to cost what the one does that won at another.
    fn crossing(&self, line: &Line, near: &At, far: &At) -> Option<f64> {
        let ((own, _), (rival, _)) = (near.look.own.as_ref()?, far.look.rival.as_ref()?);
        let (one, two) = (Straight::of(line, own, near, far)?, Straight::of(line, rival, near, far)?);
        let meet = one.meets(&two)?;
        let is_exact = self.contrast.hair() <= 0.0;
        let is_between = (0.0..=1.0).contains(&meet) && two.to <= one.to;
        (is_exact || is_between).then(|| near.value + (far.value - near.value) * meet.clamp(0.0, 1.0))
    }

    /// A value between two at which the others have not won, if they may have won there: what the others cost at least lies above
    /// the straight line between both, and what the ways that hold cost at most under the lines of those at both ends.
    fn may_turn(&self, line: &Line, near: &At, far: &At) -> Option<f64> {
        let (Some((one, _)), Some((two, _))) = (&near.look.own, &far.look.own) else { return None };
        let (from, to) = (near.look.least, far.look.least);
        let (one, two) = (Straight::of(line, one, near, far)?, Straight::of(line, two, near, far)?);
        let share = one.meets(&two).filter(|share| (0.0..=1.0).contains(share))?;
        let value = near.value + (far.value - near.value) * share;
        let rival = from + (to - from) * share;
        // ways bend a little otherwise at each value, so that lines of two of them lie a little apart
        let is_won = self.contrast.is_turned(one.at(share), rival)
            && (self.contrast.hair() <= 0.0 || (one.at(share) - rival).abs() > BENT * rival);
        let is_wide = (far.value - near.value).abs() > 2.0 * self.hair(value);
        (is_won && is_wide && is_inside(value, near, far)).then_some(value)
    }
}
