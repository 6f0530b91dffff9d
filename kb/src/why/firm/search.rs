//! The ends of the interval of a cell, from its present value outwards, piece by piece.

use std::time::Instant;

use super::corridor::SameWay;
use super::linear::Line;
use super::probe::Probe;
use super::words::Takeover;
use super::{Beyond, FirmCell, Lever, Path, Prober, Routes, Weights, words};
use crate::error::Result;

/// Values beyond this are not looked at: there is no end.
pub(super) const LARGEST: f64 = 1e6;

/// Most cuts on the way to an end.
const CUTS: usize = 60;

/// Values that are tried in a piece where weights are not linear.
pub(super) const TRIED: usize = 8;

/// Where the way stops being the best.
struct End {
    at: f64,
    /// Whether it is still the best there.
    closed: bool,
    beyond: Takeover,
}

/// How far a cell may change; `None` where nothing that it can be weighs anything.
pub(super) fn firm_cell(
    prober: &mut Prober,
    routes: &Routes,
    same: &SameWay,
    lever: &Lever,
    deadline: Instant,
) -> Result<Option<FirmCell>> {
    let least = if lever.value < 0.0 { -LARGEST } else { 0.0 };
    let mut side = Side { prober, routes, same, lever, deadline, weighs: false, exact: true };
    let low = side.end(least)?;
    let high = side.end(LARGEST.max(lever.value * 2.0))?;
    let (weighs, exact) = (side.weighs, side.exact);
    let mut beyond = |end: &Option<End>, way: f64| {
        let said = end.as_ref().map(|end| words::beyond(prober, same, lever, (end.at, way), &end.beyond));
        said.transpose()
    };
    let (below, above) = (beyond(&low, -1.0)?, beyond(&high, 1.0)?);
    prober.restore(lever)?;
    if !weighs {
        return Ok(None);
    }
    Ok(Some(FirmCell {
        table: lever.class.to_lowercase(),
        key: lever.key.clone(),
        column: lever.column.clone(),
        value: lever.value,
        low: Some(low.as_ref().map_or(least, |end| end.at)),
        high: high.as_ref().map(|end| end.at),
        low_closed: low.as_ref().is_none_or(|end| end.closed),
        high_closed: high.as_ref().is_some_and(|end| end.closed),
        exact,
        below,
        above,
    }))
}

/// The way that costs less than the present one; none where there is no way at all.
struct Rival(Option<Path>);

/// The search for one end of one cell.
struct Side<'s> {
    prober: &'s mut Prober,
    routes: &'s Routes,
    same: &'s SameWay,
    lever: &'s Lever,
    deadline: Instant,
    /// Whether any value weighed something differently.
    weighs: bool,
    /// Whether weights were linear wherever they were looked at.
    exact: bool,
}

/// The values between the present one and a limit, exclusively, where rules may switch, outwards; the limit is the last.
pub(super) fn breaks(lever: &Lever, limit: f64) -> Vec<f64> {
    let (low, high) = (lever.value.min(limit), lever.value.max(limit));
    let mut breaks: Vec<f64> =
        lever.others.iter().copied().filter(|other| *other > low && *other < high).collect();
    if limit < lever.value {
        breaks.reverse();
    }
    breaks.push(limit);
    breaks
}

impl Side<'_> {
    /// Where the way stops being the best between the present value and a limit.
    fn end(&mut self, limit: f64) -> Result<Option<End>> {
        let mut from = self.lever.value;
        if from.total_cmp(&limit).is_eq() {
            return Ok(None);
        }
        for to in breaks(self.lever, limit) {
            if let Some(end) = self.end_between(from, to)? {
                return Ok(Some(end));
            }
            if let Some(end) = self.end_at(to)? {
                return Ok(Some(end));
            }
            from = to;
        }
        Ok(None)
    }

    fn probe(&mut self, value: f64) -> Result<Probe> {
        let probe = self.prober.at(self.lever, value)?;
        self.weighs |= !matches!(&probe, Probe::Weighs(weights) if *weights == self.prober.present);
        Ok(probe)
    }

    /// What takes over at a probe, where the way is not the best there.
    fn takeover(&self, probe: &Probe, value: f64) -> Option<Takeover> {
        match probe {
            Probe::CutAnew => Some(Takeover::CutAnew),
            Probe::Refused => Some(Takeover::Refused),
            Probe::Weighs(weights) => self.rival(weights).map(|rival| match rival {
                Rival(Some(path)) => Takeover::Way(path, value),
                Rival(None) => Takeover::NoWay,
            }),
        }
    }

    /// What is better than this way, if anything is.
    fn rival(&self, weights: &Weights) -> Option<Rival> {
        let cost = self.same.cost(weights);
        let Some(best) = self.routes.best(weights) else { return Some(Rival(None)) };
        (!self.same.is_best(cost, best.cost(weights))).then_some(Rival(Some(best)))
    }

    /// An end at a value where rules may switch.
    fn end_at(&mut self, value: f64) -> Result<Option<End>> {
        let probe = self.probe(value)?;
        let beyond = self.takeover(&probe, value);
        Ok(beyond.map(|beyond| End { at: value, closed: false, beyond }))
    }

    /// An end between two values between which rules hardly switch.
    fn end_between(&mut self, from: f64, to: f64) -> Result<Option<End>> {
        let inside = |share: f64| from + (to - from) * share;
        let values = [0.125, 0.5, 0.875].map(inside);
        let mut weights = Vec::new();
        for value in values {
            match self.probe(value)? {
                Probe::Weighs(found) => weights.push(found),
                Probe::CutAnew | Probe::Refused => {}
            }
        }
        if weights.is_empty() {
            let probe = self.probe(values[0])?;
            let beyond = self.takeover(&probe, values[0]).unwrap_or(Takeover::CutAnew);
            return Ok(Some(End { at: from, closed: true, beyond }));
        }
        if let [one, two, three] = weights.as_slice() {
            if one == two && two == three && *one == self.prober.present {
                return Ok(None);
            }
            let line = Line::through((values[0], one.clone()), (values[1], two), (values[2], three.clone()));
            if let Some(line) = line {
                return Ok(self.cut(&line, from, to));
            }
        }
        self.tried(from, to)
    }

    /// An end on a line, by cutting.
    fn cut(&self, line: &Line, from: f64, to: f64) -> Option<End> {
        let at = |value: f64| line.at(value);
        let mut value = to;
        // where the weights are those of the far end, the way is one of many that cost the same, or the best, or is not
        let mut rival = self.rival(&at(value)?);
        if rival.is_none() && !self.routes.is_on_doors() {
            // the same way may lose in between, and win again
            for share in [0.25, 0.5, 0.75] {
                value = from + (to - from) * share;
                rival = self.rival(&at(value)?);
                if rival.is_some() {
                    break;
                }
            }
        }
        let Rival(mut path) = rival?;
        for _ in 0..CUTS {
            let Some(way) = &path else {
                return Some(End { at: from, closed: true, beyond: Takeover::NoWay });
            };
            let next = self.crossing(line, way, from, value)?;
            let is_cut = (next - value).abs() > 1e-13 * value.abs().max(1e-9);
            let further = if is_cut { self.rival(&at(next)?) } else { None };
            value = next;
            let Some(Rival(further)) = further else { break };
            path = further;
        }
        let beyond = path.map_or(Takeover::NoWay, |path| Takeover::Way(path, value));
        Some(End { at: value, closed: true, beyond })
    }

    /// Where a way that costs less at `to` costs as much as this one; `from` where it does so already there.
    fn crossing(&self, line: &Line, way: &Path, from: f64, to: f64) -> Option<f64> {
        let lead = |value: f64| -> Option<f64> {
            let weights = line.at(value)?;
            Some(way.cost(&weights) - self.same.cost(&weights))
        };
        let (near, far) = (lead(from)?, lead(to)?);
        if near <= 0.0 || !near.is_finite() && !far.is_finite() {
            return Some(from);
        }
        if self.routes.is_on_doors() && near.is_finite() {
            return Some(from + (to - from) * (near / (near - far)));
        }
        let (mut near, mut far) = (from, to);
        for _ in 0..48 {
            let middle = f64::midpoint(near, far);
            if lead(middle)? > 0.0 {
                near = middle;
            } else {
                far = middle;
            }
        }
        Some(far)
    }

    /// An end between two values by trying some, then halving.
    fn tried(&mut self, from: f64, to: f64) -> Result<Option<End>> {
        self.exact = false;
        let mut good = from;
        for part in 1..=TRIED {
            let mut bad = from + (to - from) * part as f64 / (TRIED + 1) as f64;
            let probe = self.probe(bad)?;
            let Some(mut beyond) = self.takeover(&probe, bad) else {
                good = bad;
                continue;
            };
            while (bad - good).abs() > 1e-7 * good.abs().max(1e-3) && Instant::now() < self.deadline {
                let middle = f64::midpoint(good, bad);
                let probe = self.probe(middle)?;
                match self.takeover(&probe, middle) {
                    Some(found) => (bad, beyond) = (middle, found),
                    None => good = middle,
                }
            }
            return Ok(Some(End { at: good, closed: true, beyond }));
        }
        Ok(None)
    }
}

impl Beyond {
    /// What takes over, with what the present way costs at the end.
    pub(super) fn new(cost: f64, way: String, route_differs_at: Option<String>) -> Self {
        Self { cost_at_end: Some(cost).filter(|cost| cost.is_finite()), way, route_differs_at }
    }
}
