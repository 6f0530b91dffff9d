//! From which value of a number on the ways that hold give way to the others.

mod first;

use std::collections::BTreeMap;
use std::sync::Arc;

use rayon::prelude::*;

use super::straight::{At, Straight, is_inside, slope};
use super::{Contrast, End, Found, Known, Look, Path, Takeover};
use crate::error::Result;
use crate::site::calm::side_by_side;
use crate::state::Waits;
use crate::state::tunable::{Effect, LARGEST, LAST, Lever, Line, Side, Weights, lowest};
use crate::why::probe::{Probe, Prober};

/// Values that are tried in a piece where weights are not linear.
const TRIED: usize = 8;

/// Values that are tried for one answer, beyond which nothing is begun.
const PATIENCE: usize = 2_000;

/// So far beyond where two ways cost the same, as a share, the one is the best.
const BEYOND: f64 = 1e-6;

/// So many sides are looked at side by side. Each may spend what is left of [`PATIENCE`], and the next ones what is left then: it
/// hangs on no machine.
const AT_ONCE: usize = 8;

/// So often the first value is guessed from ways that took over elsewhere.
const GUESSES: usize = 4;

/// What a piece of the range showed.
enum Piece {
    End(End),
    Nothing,
    /// Time was over.
    Unknown,
}

/// The search for ends of cells.
pub struct Turn<'t> {
    prober: &'t mut Prober,
    along: Along<'t>,
    is_exact: bool,
}

/// The search along values in which weights are linear; of several ones each has its own, so that none waits for another.
#[derive(Clone)]
struct Along<'t> {
    contrast: &'t dyn Contrast,
    present: Arc<Weights>,
    /// How often values were tried.
    spent: usize,
    /// What is best at present.
    here: Option<Look>,
    /// Ways that took over somewhere.
    rivals: Vec<Path>,
    waits: Waits,
}

impl<'t> Turn<'t> {
    pub fn new(prober: &'t mut Prober, contrast: &'t dyn Contrast) -> Self {
        let mut here = contrast.look(&prober.present);
        if let Some(here) = here.as_mut().filter(|here| here.rival.is_none()) {
            here.rival = contrast.rival(&prober.present, f64::INFINITY);
            here.least = here.rival.as_ref().map_or(f64::INFINITY, |(_, cost)| *cost);
        }
        let present = Arc::clone(&prober.present);
        let waits = prober.fork.waits.clone();
        let along = Along { contrast, present, spent: 0, here, rivals: Vec::new(), waits };
        Self { prober, along, is_exact: true }
    }

    /// How much a cell would have to change, as a share of what it is, were both ways to be driven as now: a guess, to look at
    /// likely ones first.
    pub fn guess(&self, effect: &Effect) -> f64 {
        let Some(Look { own: Some((own, cost)), rival: Some((rival, dearer)), .. }) = &self.along.here else {
            return f64::INFINITY;
        };
        let lever = &effect.lever;
        let slope = |line: &Line| Some(slope(line, rival)? - slope(line, own)?);
        let Some(slope) = effect.lines.iter().flatten().find_map(slope) else { return f64::INFINITY };
        let change = (cost - dearer) / slope;
        let is_possible = change.is_finite() && (lever.value < 0.0 || lever.value + change >= 0.0);
        if is_possible { change.abs() / lever.scale() } else { f64::INFINITY }
    }

    /// The first values on sides of the present ones at which the ways that hold give way.
    ///
    /// # Arguments
    /// `within` is how far they are looked for, as a share of the present value; `None`: as far as there are values.
    pub fn ends(&mut self, asked: &[(&Effect, Side)], within: Option<f64>) -> Result<Vec<Found>> {
        let mut all = Vec::new();
        for some in asked.chunks(AT_ONCE) {
            let (begun, before) = (self.along.clone(), self.along.spent);
            let at_once = |&(effect, side): &(&Effect, Side)| {
                let mut along = begun.clone();
                let piece = along.side(effect, side, within)?;
                Some((piece, along))
            };
            let found: Vec<Option<(Piece, Along)>> = side_by_side(|| some.par_iter().map(at_once).collect());
            self.prober.fork.go_on()?;
            for (&(effect, side), found) in some.iter().zip(found) {
                self.is_exact = true;
                let piece = if let Some((piece, along)) = found {
                    self.along.join(along, before);
                    piece
                } else {
                    let piece = self.by_pieces(&effect.lever, side.limit(&effect.lever, within));
                    self.prober.restore(&effect.lever)?;
                    piece?
                };
                let (end, is_whole) = match piece {
                    Piece::End(end) => (Some(end), true),
                    Piece::Nothing => (None, true),
                    Piece::Unknown => (None, false),
                };
                all.push(Found { end, is_exact: self.is_exact, is_whole });
            }
        }
        Ok(all)
    }

    /// Of some cells those that have no end below, found by looking at many of them at once: where all of them fall together and
    /// the others still cost more than the way that holds does now, none of them does it alone.
    pub fn without_end_below(&mut self, effects: &[Arc<Effect>], within: Option<f64>) -> Vec<bool> {
        let mut never = vec![false; effects.len()];
        let Some(Look { own: Some((_, cost)), is_turned: false, .. }) = &self.along.here else {
            return never;
        };
        let cost = *cost;
        let lines = |effect: &Arc<Effect>| effect.lines[Side::Below as usize].is_some();
        // together where they weigh the same kind of thing: where all weighs nothing, nothing is told apart
        let mut groups: BTreeMap<(&str, &str), Vec<usize>> = BTreeMap::new();
        for of in (0..effects.len()).filter(|&of| effects[of].weighs && lines(&effects[of])) {
            let lever = &effects[of].lever;
            groups.entry((&lever.class, &lever.column)).or_default().push(of);
        }
        let groups: Vec<Vec<usize>> = groups.into_values().collect();
        let (begun, before) = (self.along.clone(), self.along.spent);
        let alone = |group: &Vec<usize>| {
            let mut along = begun.clone();
            (along.without_end_below(effects, group.clone(), (within, cost)), along)
        };
        let found: Vec<(Vec<usize>, Along)> = side_by_side(|| groups.par_iter().map(alone).collect());
        for (group, along) in found {
            for of in group {
                never[of] = true;
            }
            self.along.join(along, before);
        }
        never
    }

    fn by_pieces(&mut self, lever: &Lever, limit: f64) -> Result<Piece> {
        let mut from = lever.value;
        for to in lever.breaks(limit) {
            let piece = self.piece(lever, from, to)?;
            if !matches!(piece, Piece::Nothing) {
                return Ok(piece);
            }
            from = to;
        }
        Ok(Piece::Nothing)
    }

    fn probe(&mut self, lever: &Lever, value: f64) -> Result<Probe> {
        self.along.spend();
        self.prober.at(lever, value)
    }

    /// The first value from `from` on, up to `to` and with it: rules may switch there.
    fn piece(&mut self, lever: &Lever, from: f64, to: f64) -> Result<Piece> {
        if self.along.is_over() {
            return Ok(Piece::Unknown);
        }
        let values = [0.125, 0.5, 0.875].map(|share| from + (to - from) * share);
        let (mut weights, mut other) = (Vec::new(), None);
        for value in values {
            match self.probe(lever, value)? {
                Probe::Weighs(found) => weights.push(found),
                probe => other = other.or(Takeover::of(&probe)),
            }
        }
        if let (true, Some(beyond)) = (weights.is_empty(), other) {
            return Ok(Piece::End(End::at(from, beyond)));
        }
        let line = match weights.as_slice() {
            [one, two, three] if one == two && two == three && *one == *self.prober.present => None,
            [one, two, three] => {
                Some(Line::through((values[0], one.clone()), (values[1], two), (values[2], three)))
            }
            _ => Some(None),
        };
        let found = match line {
            None => Piece::Nothing,
            Some(Some(line)) => self.along.on_line(&line, from, to),
            Some(None) => self.tried(lever, from, to)?,
        };
        if !matches!(found, Piece::Nothing) {
            return Ok(found);
        }
        let is_last = to.total_cmp(&lowest(lever)).is_eq() || to.abs() >= LARGEST;
        let beyond = self.beyond(lever, to)?;
        // at the last value that a cell may have, what costs the same takes nothing over
        if is_last && matches!(beyond, Some(Takeover::Way(..))) && self.along.contrast.is_turned(1.0, 1.0) {
            return Ok(Piece::Nothing);
        }
        Ok(beyond
            .map_or(Piece::Nothing, |beyond| Piece::End(End { is_closed: false, ..End::at(to, beyond) })))
    }

    /// What has taken over at a value.
    fn beyond(&mut self, lever: &Lever, value: f64) -> Result<Option<Takeover>> {
        let weights = match self.probe(lever, value)? {
            Probe::Weighs(weights) => weights,
            probe => return Ok(Takeover::of(&probe)),
        };
        if weights == *self.prober.present {
            return Ok(None);
        }
        Ok(self.along.look(&weights).and_then(Look::takeover))
    }

    /// Where weights are not linear: some values are tried, then halved.
    fn tried(&mut self, lever: &Lever, from: f64, to: f64) -> Result<Piece> {
        self.is_exact = false;
        let mut good = from;
        for part in 1..=TRIED {
            let mut bad = from + (to - from) * part as f64 / (TRIED + 1) as f64;
            let Some(mut beyond) = self.beyond(lever, bad)? else {
                good = bad;
                continue;
            };
            while (bad - good).abs() > (0.1 * self.along.hair(good)).max(1e-7 * good.abs().max(1e-3)) {
                if self.along.is_over() {
                    return Ok(Piece::Unknown);
                }
                let middle = f64::midpoint(good, bad);
                match self.beyond(lever, middle)? {
                    Some(found) => (bad, beyond) = (middle, found),
                    None => good = middle,
                }
            }
            return Ok(Piece::End(End { won_at: bad, ..End::at(good, beyond) }));
        }
        Ok(Piece::Nothing)
    }
}

impl Along<'_> {
    fn spend(&mut self) {
        self.spent += 1;
    }

    /// Whether enough was tried for one answer, so that it comes in time, and is the same on each machine; or nobody waits
    /// for one.
    fn is_over(&self) -> bool {
        self.spent >= PATIENCE || !self.waits.is_anybody()
    }

    /// Keeps a way that may take over elsewhere, too.
    fn remember(&mut self, path: Path) {
        if !self.rivals.contains(&path) {
            self.rivals.push(path);
        }
    }

    /// Takes over what another one found.
    ///
    /// # Arguments
    /// `before` is how often values had been tried when it began.
    fn join(&mut self, other: Self, before: usize) {
        self.spent += other.spent.saturating_sub(before);
        for path in other.rivals {
            self.remember(path);
        }
    }

    /// What one side of a cell shows; `None` where weights are not linear.
    fn side(&mut self, effect: &Effect, side: Side, within: Option<f64>) -> Option<Piece> {
        let lever = &effect.lever;
        let limit = side.limit(lever, within);
        match &effect.lines[side as usize] {
            _ if limit.total_cmp(&lever.value).is_eq() || !effect.weighs => Some(Piece::Nothing),
            Some(line) if line.is_level() => Some(Piece::Nothing),
            Some(line) => Some(self.on_line(line, lever.value, limit)),
            None => None,
        }
    }

    /// Of some cells those that have no end below.
    fn without_end_below(
        &mut self,
        effects: &[Arc<Effect>],
        mut asked: Vec<usize>,
        (within, cost): (Option<f64>, f64),
    ) -> Vec<usize> {
        let limit = |of: usize| Side::Below.limit(&effects[of].lever, within);
        let line = |of: usize| effects[of].lines[Side::Below as usize].as_ref();
        while !asked.is_empty() && !self.is_over() {
            let mut least = Weights::clone(&self.present);
            for &of in &asked {
                if let Some(line) = line(of) {
                    line.lower(limit(of), &mut least);
                }
            }
            self.spend();
            let rival = self.contrast.rival(&least, cost);
            let Some((path, _)) = rival.filter(|(_, rival)| self.contrast.is_turned(cost, *rival)) else {
                return asked;
            };
            let before = asked.len();
            asked.retain(|&of| {
                let Some(line) = line(of) else { return true };
                let mut lower = Weights::clone(&self.present);
                line.lower(limit(of), &mut lower);
                path.cost(&lower) >= path.cost(&self.present)
            });
            self.remember(path);
            if asked.len() == before {
                break;
            }
        }
        Vec::new()
    }

    /// The first value of a piece in which weights are linear.
    fn on_line(&mut self, line: &Line, from: f64, to: f64) -> Piece {
        if self.is_over() {
            return Piece::Unknown;
        }
        let (Some(nearly), Some(farly)) = (line.at(from), line.at(to)) else { return Piece::Unknown };
        let near = match &self.here {
            Some(here) if nearly == *self.present => Some(here.clone()),
            _ => self.look(&nearly),
        };
        let Some(near) = near else { return Piece::Nothing };
        if near.is_turned {
            let beyond = near.takeover().unwrap_or(Takeover::NoWay);
            return Piece::End(End::at(from, beyond));
        }
        // what gets dearer for all does not get cheaper for the others, and the way that holds costs no more than they cost already
        let is_rising = farly.are_no_less_than(&nearly);
        if let Some((own, _)) = &near.own
            && is_rising
            && !self.contrast.is_turned(own.cost(&farly), near.least)
        {
            return Piece::Nothing;
        }
        let mut near = At { value: from, look: near };
        for guesses in (0..=GUESSES).rev() {
            let guess = if guesses > 0 { self.guessed(line, &near, to) } else { None };
            let far = self.look_at(line, guess.unwrap_or(to), (&near, is_rising));
            let Some(mut far) = far else { return Piece::Nothing };
            if is_rising {
                far.look.least = far.look.least.max(near.look.least);
            }
            match self.first(line, near, far.clone(), is_rising) {
                Piece::Nothing if guess.is_none() => return Piece::Nothing,
                Piece::Nothing => near = far,
                // at the last value that a cell may have, what costs the same takes nothing over
                Piece::End(end) if (end.at - to).abs() <= LAST * (to - from).abs() => {
                    return Piece::Nothing;
                }
                piece => {
                    if let Piece::End(End { beyond: Takeover::Way(path, _), .. }) = &piece {
                        self.remember(path.clone());
                    }
                    return piece;
                }
            }
        }
        Piece::Unknown
    }

    /// The first value up to another one a little beyond which a way that took over elsewhere costs less than the one does that
    /// holds.
    fn guessed(&self, line: &Line, near: &At, to: f64) -> Option<f64> {
        let (own, _) = near.look.own.as_ref()?;
        let far = At { value: to, look: near.look.clone() };
        let own = Straight::of(line, own, near, &far)?;
        let beyond = |value: f64| value + self.hair(value).max(BEYOND * value.abs()) * (to - value).signum();
        let crossings = self.rivals.iter().filter_map(|path| {
            let rival = Straight::of(line, path, near, &far)?;
            let share = own.meets(&rival).filter(|share| (1e-9..1.0).contains(share))?;
            let value = beyond(near.value + (to - near.value) * share);
            let is_before = (value - near.value).abs() < (to - near.value).abs();
            (rival.to < own.to && is_before && is_inside(value, near, &far)).then_some(value)
        });
        let away = |value: &f64| (value - near.value).abs();
        crossings.min_by(|one, two| away(one).total_cmp(&away(two)))
    }

    fn hair(&self, value: f64) -> f64 {
        self.contrast.hair() * value.abs().max(0.1)
    }

    fn look(&mut self, weights: &Weights) -> Option<Look> {
        self.spend();
        self.contrast.look(weights)
    }

    /// A look at a value beyond another one.
    fn look_at(&mut self, line: &Line, value: f64, (near, is_rising): (&At, bool)) -> Option<At> {
        let weights = line.at(value)?;
        self.spend();
        let look = match &near.look.own {
            Some((own, _)) => {
                let least = if is_rising { near.look.least } else { 0.0 };
                self.contrast.look_beside(&weights, &Known { own, least })
            }
            None => self.contrast.look(&weights),
        };
        Some(At { value, look: look? })
    }

    fn glance_at(&mut self, line: &Line, value: f64) -> Option<At> {
        self.spend();
        Some(At { value, look: self.contrast.glance(&line.at(value)?)? })
    }
}
