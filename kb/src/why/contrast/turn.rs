//! From which value of a number on the ways that hold give way to the others.

use std::rc::Rc;
use std::time::Instant;

use super::end::LARGEST;
use super::linear::Line;
use super::straight::{At, Straight, is_inside};
use super::{Contrast, End, Found, Lever, Look, Path, Probe, Prober, Side, Takeover, Weights, least};
use crate::error::Result;

/// Values that are tried in a piece where weights are not linear.
const TRIED: usize = 8;

/// Most intervals of a piece that are looked into.
const LOOKS: usize = 60;

/// Ways that cost the same to such a share are as good as each other.
const TIE: f64 = 2e-9;

/// So near to the last value of a range, as a share of it, there is no end.
const LAST: f64 = 1e-4;

/// Values so near to each other, as a share, are one end.
const NARROW: f64 = 1e-5;

/// So often the first value is guessed from ways that took over elsewhere.
const GUESSES: usize = 4;

/// What the values of a cell make of all weights.
pub struct Course {
    pub lever: Lever,
    /// Below and above the present value; `None` where weights are not linear all the way.
    lines: [Option<Line>; 2],
    /// Whether any value weighs something otherwise.
    pub weighs: bool,
}

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
    contrast: &'t dyn Contrast,
    deadline: Instant,
    /// What is best at present.
    here: Option<Look>,
    /// Ways that took over somewhere.
    rivals: Vec<Path>,
    is_exact: bool,
    weighs: bool,
}

impl<'t> Turn<'t> {
    pub fn new(prober: &'t mut Prober, contrast: &'t dyn Contrast, deadline: Instant) -> Self {
        let here = contrast.look(&prober.present);
        Self { prober, contrast, deadline, here, rivals: Vec::new(), is_exact: true, weighs: false }
    }

    /// How much a cell would have to change, as a share of what it is, were both ways to be driven as now: a guess, to look at
    /// likely ones first.
    pub fn guess(&mut self, lever: &Lever) -> Result<f64> {
        let nudge = lever.value.abs().max(1.0) / f64::from(1 << 20);
        let there = self.prober.at(lever, lever.value + nudge)?;
        self.prober.restore(lever)?;
        let Some(Look { own: Some((own, cost)), rival: Some((rival, dearer)), .. }) = &self.here else {
            return Ok(f64::INFINITY);
        };
        let Probe::Weighs(weights) = there else { return Ok(f64::INFINITY) };
        let lead = dearer - cost;
        let slope = (rival.cost(&weights) - own.cost(&weights) - lead) / nudge;
        let change = -lead / slope;
        let is_possible = change.is_finite() && (lever.value < 0.0 || lever.value + change >= 0.0);
        Ok(if is_possible { change.abs() / lever.scale() } else { f64::INFINITY })
    }

    /// What the values of a cell make of all weights, as far as there are values.
    pub fn course(&mut self, lever: Lever) -> Result<Course> {
        self.weighs = false;
        let mut lines = [None, None];
        for (line, side) in lines.iter_mut().zip([Side::Below, Side::Above]) {
            let limit = side.limit(&lever, None);
            if limit.total_cmp(&lever.value).is_ne() {
                *line = self.whole(&lever, &lever.breaks(limit))?;
            }
        }
        self.prober.restore(&lever)?;
        Ok(Course { lever, lines, weighs: self.weighs })
    }

    /// The first value on one side of the present one at which the ways that hold give way.
    ///
    /// # Arguments
    /// `within` is how far it is looked for, as a share of the present value; `None`: as far as there are values.
    pub fn end(&mut self, course: &Course, side: Side, within: Option<f64>) -> Result<Found> {
        self.is_exact = true;
        let lever = &course.lever;
        let limit = side.limit(lever, within);
        let piece = match &course.lines[side as usize] {
            _ if limit.total_cmp(&lever.value).is_eq() || !course.weighs => Piece::Nothing,
            Some(line) if line.is_level() => Piece::Nothing,
            Some(line) => self.on_line(line, lever.value, limit),
            None => {
                let piece = self.by_pieces(lever, limit);
                self.prober.restore(lever)?;
                piece?
            }
        };
        let (end, is_whole) = match piece {
            Piece::End(end) => (Some(end), true),
            Piece::Nothing => (None, true),
            Piece::Unknown => (None, false),
        };
        Ok(Found { end, is_exact: self.is_exact, is_whole })
    }

    /// Of some cells those that have no end below, found by looking at many of them at once: where all of them fall together and
    /// the others still cost more than the way that holds does now, none of them does it alone.
    pub fn without_end_below(&mut self, courses: &[Course], within: Option<f64>) -> Vec<bool> {
        let mut never = vec![false; courses.len()];
        let Some(Look { own: Some((_, cost)), is_turned: false, .. }) = &self.here else { return never };
        let (cost, lines) = (*cost, |course: &Course| course.lines[Side::Below as usize].is_some());
        let mut asked: Vec<usize> =
            (0..courses.len()).filter(|&of| courses[of].weighs && lines(&courses[of])).collect();
        while !asked.is_empty() && Instant::now() < self.deadline {
            let mut least = Weights::clone(&self.prober.present);
            for &of in &asked {
                if let Some(line) = &courses[of].lines[Side::Below as usize] {
                    line.lower(Side::Below.limit(&courses[of].lever, within), &mut least);
                }
            }
            let rival = self.contrast.rival(&least);
            let Some((path, _)) = rival.filter(|(_, rival)| self.contrast.is_turned(cost, *rival)) else {
                asked.into_iter().for_each(|of| never[of] = true);
                break;
            };
            let before = asked.len();
            asked.retain(|&of| {
                let limit = Side::Below.limit(&courses[of].lever, within);
                let line = &courses[of].lines[Side::Below as usize];
                !line.as_ref().is_some_and(|line| line.lowers(limit, &path))
            });
            self.remember(path);
            if asked.len() == before {
                break;
            }
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

    /// Keeps a way that may take over elsewhere, too.
    fn remember(&mut self, path: Path) {
        if !self.rivals.contains(&path) {
            self.rivals.push(path);
        }
    }

    fn probe(&mut self, lever: &Lever, value: f64) -> Result<Probe> {
        let probe = self.prober.at(lever, value)?;
        self.weighs |= !matches!(&probe, Probe::Weighs(weights) if *weights == *self.prober.present);
        Ok(probe)
    }

    /// The weights from the present value to the last of some, where they are linear all the way.
    fn whole(&mut self, lever: &Lever, breaks: &[f64]) -> Result<Option<Line>> {
        let mut line: Option<Line> = None;
        let mut from = lever.value;
        // outwards in: the last value makes the line, and each other one must lie on it
        let mut values = Vec::new();
        for &to in breaks {
            values.extend([f64::midpoint(from, to), to]);
            from = to;
        }
        for value in values.into_iter().rev() {
            if Instant::now() >= self.deadline {
                return Ok(None);
            }
            let Probe::Weighs(weights) = self.probe(lever, value)? else { return Ok(None) };
            match &line {
                None => {
                    line = Some(Line::new((lever.value, Rc::clone(&self.prober.present)), (value, &weights)))
                }
                Some(line) if line.holds(value, &weights) => {}
                Some(_) => return Ok(None),
            }
        }
        Ok(line)
    }

    /// The first value from `from` on, up to `to` and with it: rules may switch there.
    fn piece(&mut self, lever: &Lever, from: f64, to: f64) -> Result<Piece> {
        if Instant::now() >= self.deadline {
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
            return Ok(Piece::End(End { at: from, is_closed: true, beyond }));
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
            Some(Some(line)) => self.on_line(&line, from, to),
            Some(None) => self.tried(lever, from, to)?,
        };
        if !matches!(found, Piece::Nothing) {
            return Ok(found);
        }
        let is_last = to.total_cmp(&least(lever)).is_eq() || to.abs() >= LARGEST;
        let beyond = self.beyond(lever, to)?;
        // at the last value that a cell may have, what costs the same takes nothing over
        if is_last && matches!(beyond, Some(Takeover::Way(..))) && self.contrast.is_turned(1.0, 1.0) {
            return Ok(Piece::Nothing);
        }
        Ok(beyond.map_or(Piece::Nothing, |beyond| Piece::End(End { at: to, is_closed: false, beyond })))
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
        Ok(self.contrast.look(&weights).and_then(Look::takeover))
    }

    /// The first value of a piece in which weights are linear.
    fn on_line(&mut self, line: &Line, from: f64, to: f64) -> Piece {
        let (Some(nearly), Some(farly)) = (line.at(from), line.at(to)) else { return Piece::Unknown };
        let near = match &self.here {
            Some(here) if nearly == *self.prober.present => Some(here.clone()),
            _ => self.contrast.look(&nearly),
        };
        let Some(near) = near else { return Piece::Nothing };
        if near.is_turned {
            let beyond = near.takeover().unwrap_or(Takeover::NoWay);
            return Piece::End(End { at: from, is_closed: true, beyond });
        }
        // what gets dearer for all does not get cheaper for the others, and the way that holds costs no more than they cost already
        if let (Some((own, _)), Some((_, rival))) = (&near.own, &near.rival)
            && farly.are_no_less_than(&nearly)
            && !self.contrast.is_turned(own.cost(&farly), *rival)
        {
            return Piece::Nothing;
        }
        let mut near = At { value: from, look: near };
        for guesses in (0..=GUESSES).rev() {
            let guess = if guesses > 0 { self.guessed(line, &near, to) } else { None };
            let Some(far) = self.look_at(line, guess.as_ref().map_or(to, |(value, _)| *value)) else {
                return Piece::Nothing;
            };
            let is_last = guess.is_none();
            // a way that is known already may cost what the one does that holds, and less from there on
            let ties = guess.filter(|_| !far.look.is_turned).and_then(|(value, path)| {
                let cost = line.at(value).map(|weights| path.cost(&weights))?;
                let (_, own) = far.look.own.as_ref()?;
                let is_tie = (cost - own).abs() <= TIE * own.abs() && !self.contrast.is_turned(1.0, 1.0);
                is_tie.then_some((path, cost))
            });
            let piece = self.first(line, near, far.clone());
            match (piece, ties) {
                (Piece::Nothing, Some((path, cost))) => {
                    return Piece::End(End {
                        at: far.value,
                        is_closed: true,
                        beyond: Takeover::Way(path, cost),
                    });
                }
                (Piece::Nothing, None) if is_last => return Piece::Nothing,
                (Piece::Nothing, None) => near = far,
                // at the last value that a cell may have, what costs the same takes nothing over
                (Piece::End(end), _) if (end.at - to).abs() <= LAST * (to - from).abs() => {
                    return Piece::Nothing;
                }
                (piece, _) => {
                    if let Piece::End(End { beyond: Takeover::Way(path, _), .. }) = &piece {
                        self.remember(path.clone());
                    }
                    return piece;
                }
            }
        }
        Piece::Unknown
    }

    /// The first value up to another one at which a way that took over elsewhere comes to cost what the one does that holds.
    fn guessed(&self, line: &Line, near: &At, to: f64) -> Option<(f64, Path)> {
        let (own, _) = near.look.own.as_ref()?;
        let far = At { value: to, look: near.look.clone() };
        let own = Straight::of(line, own, near, &far)?;
        let crossings = self.rivals.iter().filter_map(|path| {
            let rival = Straight::of(line, path, near, &far)?;
            let share = own.meets(&rival).filter(|share| (1e-9..1.0).contains(share))?;
            let value = near.value + (to - near.value) * share;
            (rival.to < own.to && is_inside(value, near, &far)).then_some((value, path))
        });
        let away = |value: f64| (value - near.value).abs();
        let first = crossings.min_by(|(one, _), (two, _)| away(*one).total_cmp(&away(*two)));
        first.map(|(value, path)| (value, path.clone()))
    }

    fn look_at(&self, line: &Line, value: f64) -> Option<At> {
        Some(At { value, look: self.contrast.look(&line.at(value)?)? })
    }

    /// The first value between two at which the others win; at `near` they have not.
    fn first(&self, line: &Line, near: At, far: At) -> Piece {
        // the nearest interval is the last
        let mut waiting = vec![(near, far)];
        for _ in 0..LOOKS {
            let Some((near, far)) = waiting.pop() else { return Piece::Nothing };
            if Instant::now() >= self.deadline {
                return Piece::Unknown;
            }
            let middle = if far.look.is_turned {
                let Some(end) = self.between(line, &near, &far) else {
                    let beyond = far.look.takeover().unwrap_or(Takeover::NoWay);
                    return Piece::End(End { at: near.value, is_closed: true, beyond });
                };
                match end {
                    Ok(end) => return Piece::End(end),
                    Err(middle) => Some(middle),
                }
            } else {
                self.may_turn(line, &near, &far)
            };
            let Some(middle) = middle else { continue };
            let Some(middle) = self.look_at(line, middle) else { return Piece::Unknown };
            if !middle.look.is_turned {
                waiting.push((middle.clone(), far));
            }
            waiting.push((near, middle));
        }
        // ways bend a little otherwise at each value, and may go on doing so: what is left is as near as makes no difference
        let turned = waiting.into_iter().rev().find(|(_, far)| far.look.is_turned);
        turned.map_or(Piece::Nothing, |(near, far)| match self.between(line, &near, &far) {
            Some(Ok(end)) => Piece::End(end),
            found => {
                let beyond = far.look.takeover().unwrap_or(Takeover::NoWay);
                let at = found.and_then(std::result::Result::err).unwrap_or(near.value);
                Piece::End(End { at, is_closed: true, beyond })
            }
        })
    }

    /// The end between a value at which the others have not won and one at which they have, if it lies at the one or the other;
    /// else a value between them to look at. `None` where ways cannot be compared.
    fn between(&self, line: &Line, near: &At, far: &At) -> Option<std::result::Result<End, f64>> {
        let ((own, _), (rival, _)) = (near.look.own.as_ref()?, far.look.rival.as_ref()?);
        let (one, two) = (Straight::of(line, own, near, far)?, Straight::of(line, rival, near, far)?);
        let meet = one.meets(&two)?.clamp(0.0, 1.0);
        let value = near.value + (far.value - near.value) * meet;
        if is_inside(value, near, far) {
            return Some(Err(value));
        }
        let end = |at: f64| {
            Some(Ok(End { at, is_closed: true, beyond: Takeover::Way(rival.clone(), two.at(meet)) }))
        };
        // where a tie is no end yet, the end is where both cost the same
        if !self.contrast.is_turned(1.0, 1.0) {
            return end(value);
        }
        let is_at_far = (far.value - value).abs() < (value - near.value).abs();
        let middle = f64::midpoint(near.value, far.value);
        let is_narrow = (far.value - near.value).abs() <= NARROW * far.value.abs().max(1e-3);
        // a search nearby may miss the way that won
        if !is_at_far && !is_narrow && is_inside(middle, near, far) {
            return Some(Err(middle));
        }
        end(far.value)
    }

    /// A value between two at which the others have not won, if they may have won there: what the others cost at most lies under
    /// the straight line between both, and what the ways that hold cost at least under the lines of those at both ends.
    fn may_turn(&self, line: &Line, near: &At, far: &At) -> Option<f64> {
        let ((Some((one, _)), Some((two, _))), (Some((_, from)), Some((_, to)))) =
            ((&near.look.own, &far.look.own), (&near.look.rival, &far.look.rival))
        else {
            return None;
        };
        let (one, two) = (Straight::of(line, one, near, far)?, Straight::of(line, two, near, far)?);
        let share = one.meets(&two).filter(|share| (0.0..=1.0).contains(share))?;
        let value = near.value + (far.value - near.value) * share;
        let is_won = self.contrast.is_turned(one.at(share), from + (to - from) * share);
        (is_won && is_inside(value, near, far)).then_some(value)
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
            while (bad - good).abs() > 1e-7 * good.abs().max(1e-3) {
                if Instant::now() >= self.deadline {
                    return Ok(Piece::Unknown);
                }
                let middle = f64::midpoint(good, bad);
                match self.beyond(lever, middle)? {
                    Some(found) => (bad, beyond) = (middle, found),
                    None => good = middle,
                }
            }
            return Ok(Piece::End(End { at: good, is_closed: true, beyond }));
        }
        Ok(Piece::Nothing)
    }
}
