//! The value of a cell nearest to its present one with which some other way is the best: where the best of all ways and
//! the best of those ways come to cost the same.

use std::time::Instant;

use super::linear::Line;
use super::path::is_least;
use super::probe::Probe;
use super::search::{LARGEST, TRIED, breaks};
use super::{Lever, Path, Prober, Routes, Weights};
use crate::error::Result;

/// Most looks at one piece of a cell's range.
const LOOKS: usize = 400;

/// Most steps to the first value of a piece.
const STEPS: usize = 60;

/// Ways among which one is asked for: those through a room, or through a door.
pub trait Through {
    fn best(&self, weights: &Weights) -> Option<Path>;

    /// Whether a way is one of them.
    fn holds(&self, path: &Path) -> bool;
}

/// What is best at a value.
#[derive(Clone)]
struct Look {
    value: f64,
    /// The best way, and what it costs.
    best: (Path, f64),
    /// The best of the ways that are asked for, where there is one.
    through: Option<(Path, f64)>,
    /// Whether both cost the same.
    is_turned: bool,
}

impl Look {
    fn cost(&self) -> f64 {
        self.through.as_ref().map_or(f64::INFINITY, |(_, cost)| *cost)
    }
}

/// What a piece of the range showed.
enum Found {
    At(f64, f64),
    Nothing,
    Unknown,
}

pub struct Turn<'t> {
    prober: &'t mut Prober,
    routes: &'t Routes,
    through: &'t dyn Through,
    deadline: Instant,
    /// What is best at present; `None` where there is no way.
    here: Option<Look>,
    is_cut: bool,
}

impl<'t> Turn<'t> {
    pub fn new(
        prober: &'t mut Prober,
        routes: &'t Routes,
        through: &'t dyn Through,
        deadline: Instant,
    ) -> Self {
        let mut all = Self { prober, routes, through, deadline, here: None, is_cut: false };
        all.here = all.look(0.0, &all.prober.present);
        all
    }

    /// How much a cell would have to change, were both ways to be driven as now: a guess, to look at likely ones first.
    pub fn guess(&mut self, lever: &Lever) -> Result<f64> {
        let nudge = lever.value.abs().max(1.0) / f64::from(1 << 20);
        let there = self.prober.at(lever, lever.value + nudge)?;
        self.prober.restore(lever)?;
        let (Probe::Weighs(weights), Some(here)) = (there, &self.here) else { return Ok(f64::INFINITY) };
        let Some((through, cost)) = &here.through else { return Ok(f64::INFINITY) };
        let lead = cost - here.best.1;
        let slope = (through.cost(&weights) - here.best.0.cost(&weights) - lead) / nudge;
        let change = -lead / slope;
        let is_possible = change.is_finite() && (lever.value < 0.0 || lever.value + change >= 0.0);
        Ok(if is_possible { change.abs() / scale(lever) } else { f64::INFINITY })
    }

    /// The value nearest to the present one, if it is not farther than so much of its size, and what the way costs there.
    pub fn nearest(&mut self, lever: &Lever, within: f64) -> Result<Option<(f64, f64)>> {
        let reach = within * scale(lever);
        let least = if lever.value < 0.0 { -LARGEST } else { 0.0 };
        let mut nearest: Option<(f64, f64)> = None;
        for limit in [(lever.value - reach).max(least), (lever.value + reach).min(LARGEST)] {
            let away = |value: f64| (value - lever.value).abs();
            if let Some((value, cost)) = self.towards(lever, limit)?
                && nearest.is_none_or(|(known, _)| away(value) < away(known))
            {
                nearest = Some((value, cost));
            }
        }
        self.prober.restore(lever)?;
        Ok(nearest)
    }

    /// Whether some of what cells may be was not looked at.
    pub fn is_cut(&self) -> bool {
        self.is_cut
    }

    fn towards(&mut self, lever: &Lever, limit: f64) -> Result<Option<(f64, f64)>> {
        let mut from = lever.value;
        if from.total_cmp(&limit).is_eq() {
            return Ok(None);
        }
        let breaks = breaks(lever, limit);
        let found = if let Some(line) = self.whole(lever, &breaks)? {
            self.on_line(&line, from, limit)
        } else {
            let mut found = Found::Nothing;
            for to in breaks {
                found = self.piece(lever, from, to)?;
                if !matches!(found, Found::Nothing) {
                    break;
                }
                from = to;
            }
            found
        };
        self.is_cut |= matches!(found, Found::Unknown);
        let Found::At(value, cost) = found else { return Ok(None) };
        // where a metre weighs nothing, a detour costs no more: that turns nothing
        let is_last = (value - limit).abs() <= 1e-9 * limit.abs().max(1.0);
        Ok(if is_last && !self.leads_through(lever, limit)? { None } else { Some((value, cost)) })
    }

    /// Whether the best way at a value is one of those that are asked for, not only as cheap.
    fn leads_through(&mut self, lever: &Lever, value: f64) -> Result<bool> {
        let Probe::Weighs(weights) = self.prober.at(lever, value)? else { return Ok(false) };
        Ok(self.routes.best(&weights).is_some_and(|best| self.through.holds(&best)))
    }

    /// The weights from the present value to the last of some, where they are linear all the way.
    fn whole(&mut self, lever: &Lever, breaks: &[f64]) -> Result<Option<Line>> {
        let mut line: Option<Line> = None;
        let mut from = lever.value;
        // outwards in: the last value makes the line, and each other one must lie on it
        let mut values = Vec::new();
        for &to in breaks {
            values.extend([0.125, 0.5, 0.875, 1.0].map(|share| from + (to - from) * share));
            from = to;
        }
        for value in values.into_iter().rev() {
            if Instant::now() >= self.deadline {
                return Ok(None);
            }
            let Probe::Weighs(weights) = self.prober.at(lever, value)? else { return Ok(None) };
            match &line {
                None => line = Some(Line::new((lever.value, self.prober.present.clone()), (value, weights))),
                Some(line) if line.holds(value, &weights) => {}
                Some(_) => return Ok(None),
            }
        }
        Ok(line)
    }

    /// The first value from `from` on, up to `to` and with it: rules may switch there.
    fn piece(&mut self, lever: &Lever, from: f64, to: f64) -> Result<Found> {
        if Instant::now() >= self.deadline {
            return Ok(Found::Unknown);
        }
        let values = [0.125, 0.5, 0.875].map(|share| from + (to - from) * share);
        let mut weights = Vec::new();
        for value in values {
            match self.prober.at(lever, value)? {
                Probe::Weighs(found) => weights.push(found),
                // what rooms cut anew would give is not looked at
                Probe::CutAnew | Probe::Refused => return Ok(Found::Unknown),
            }
        }
        if let [one, two, three] = weights.as_slice()
            && (*one != self.prober.present || one != two || two != three)
        {
            let line = Line::through((values[0], one.clone()), (values[1], two), (values[2], three.clone()));
            let found = match line {
                Some(line) => self.on_line(&line, from, to),
                None => self.tried(lever, from, to)?,
            };
            if !matches!(found, Found::Nothing) {
                return Ok(found);
            }
        }
        let Probe::Weighs(weights) = self.prober.at(lever, to)? else { return Ok(Found::Unknown) };
        if weights == self.prober.present {
            return Ok(Found::Nothing);
        }
        Ok(match self.look(to, &weights) {
            Some(look) if look.is_turned => Found::At(to, look.cost()),
            Some(_) | None => Found::Nothing,
        })
    }

    fn look(&self, value: f64, weights: &Weights) -> Option<Look> {
        let best = self.routes.best(weights)?;
        let cost = best.cost(weights);
        if self.through.holds(&best) {
            let through = Some((best.clone(), cost));
            return Some(Look { value, best: (best, cost), through, is_turned: true });
        }
        let through = self.through.best(weights).map(|path| {
            let cost = path.cost(weights);
            (path, cost)
        });
        let is_turned = through.as_ref().is_some_and(|(_, through)| is_least(self.routes, *through, cost));
        Some(Look { value, best: (best, cost), through, is_turned })
    }

    /// The first value of a piece in which weights are linear. What ways cost is concave there: a straight line between two
    /// values is less than what the ways asked for cost, and any way costs at least what the best one does.
    fn on_line(&self, line: &Line, from: f64, to: f64) -> Found {
        let look = |value: f64| line.at(value).and_then(|weights| self.look(value, &weights));
        let (Some(nearly), Some(farly)) = (line.at(from), line.at(to)) else { return Found::Unknown };
        let near = match &self.here {
            Some(here) if nearly == self.prober.present => Some(Look { value: from, ..here.clone() }),
            _ => self.look(from, &nearly),
        };
        let Some(near) = near else { return Found::Nothing };
        if near.is_turned {
            return Found::At(from, near.cost());
        }
        // what gets dearer for all does not get cheaper for those ways, and this one stays below what they cost already
        if farly.are_no_less_than(&nearly) && !is_least(self.routes, near.cost(), near.best.0.cost(&farly)) {
            return Found::Nothing;
        }
        let Some(far) = look(to) else { return Found::Nothing };
        // the nearest interval is the last
        let mut waiting = vec![(near, far)];
        for _ in 0..LOOKS {
            let Some((near, far)) = waiting.pop() else { return Found::Nothing };
            if Instant::now() >= self.deadline {
                return Found::Unknown;
            }
            if far.is_turned {
                return self.first(line, near, far);
            }
            let Some(middle) = self.in_between(line, &near, &far) else { continue };
            let Some(middle) = look(middle) else { return Found::Unknown };
            if middle.is_turned {
                return self.first(line, near, middle);
            }
            waiting.push((middle.clone(), far));
            waiting.push((near, middle));
        }
        Found::Unknown
    }

    /// A value between two at which such a way may be the best, if there may be one.
    fn in_between(&self, line: &Line, near: &Look, far: &Look) -> Option<f64> {
        let (nearly, farly) = (line.at(near.value)?, line.at(far.value)?);
        // the best way of each end, at the other one
        let (stays, comes) = (near.best.0.cost(&farly), far.best.0.cost(&nearly));
        let (leaving, coming) = (stays - far.best.1, comes - near.best.1);
        let is_one = |more: f64, cost: f64| is_least(self.routes, cost + more, cost);
        if is_one(leaving, far.best.1) || is_one(coming, near.best.1) {
            return None;
        }
        let share = coming / (leaving + coming);
        let value = near.value + (far.value - near.value) * share;
        let best = near.best.1 + (stays - near.best.1) * share;
        let through = near.cost() + (far.cost() - near.cost()) * share;
        let is_between = (value - near.value).abs() > 1e-9 * value.abs().max(1e-6)
            && (value - far.value).abs() > 1e-9 * value.abs().max(1e-6);
        (is_between && is_least(self.routes, through, best)).then_some(value)
    }

    /// The first value, where `far` is one and `near` is none.
    fn first(&self, line: &Line, mut near: Look, mut far: Look) -> Found {
        for _ in 0..STEPS {
            let (Some(nearly), Some(farly), Some((through, _))) =
                (line.at(near.value), line.at(far.value), &far.through)
            else {
                break;
            };
            let behind = through.cost(&nearly) - near.best.1;
            let ahead = near.best.0.cost(&farly) - far.cost();
            let share = behind / (behind + ahead);
            let value = near.value + (far.value - near.value) * share;
            let is_new = |known: f64| (value - known).abs() > 1e-12 * value.abs().max(1e-9);
            if !share.is_finite() || !is_new(far.value) || !is_new(near.value) {
                break;
            }
            match line.at(value).and_then(|weights| self.look(value, &weights)) {
                Some(look) if look.is_turned => far = look,
                Some(look) => near = look,
                None => break,
            }
        }
        Found::At(far.value, far.cost())
    }

    /// Where weights are not linear: some values are tried, so that none found means nothing.
    fn tried(&mut self, lever: &Lever, from: f64, to: f64) -> Result<Found> {
        let mut before = from;
        for part in 1..=TRIED {
            let value = from + (to - from) * part as f64 / (TRIED + 1) as f64;
            if let Some(mut cost) = self.turned_at(lever, value)? {
                let (mut bad, mut good) = (before, value);
                while (bad - good).abs() > 1e-7 * good.abs().max(1e-3) && Instant::now() < self.deadline {
                    let middle = f64::midpoint(bad, good);
                    match self.turned_at(lever, middle)? {
                        Some(found) => (good, cost) = (middle, found),
                        None => bad = middle,
                    }
                }
                return Ok(Found::At(good, cost));
            }
            before = value;
        }
        Ok(Found::Unknown)
    }

    fn turned_at(&mut self, lever: &Lever, value: f64) -> Result<Option<f64>> {
        let Probe::Weighs(weights) = self.prober.at(lever, value)? else { return Ok(None) };
        Ok(self.look(value, &weights).filter(|look| look.is_turned).map(|look| look.cost()))
    }
}

/// What a change of a cell is measured by.
pub fn scale(lever: &Lever) -> f64 {
    lever.value.abs().max(0.1)
}
