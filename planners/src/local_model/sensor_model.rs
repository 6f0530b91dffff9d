//! From readings to segments: the paper's `BuildSM`.
//!
//! Echoes that lie near one another are a group; a group is cut where it bends most until each part is straight; parts
//! that turn out to be one straight line are joined again.

use super::Settings;
use super::beam::{Beam, Shift};
use super::fit::{Echo, Fit};
use crate::geometry::{Point, Segment};

/// A straight surface that a scan shows.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub line: Segment,
    pub fit: Fit,
    pub echoes: Vec<Echo>,
    /// Metres that the robot has driven since its echoes were heard, on average.
    pub since_m: f64,
}

impl Seen {
    /// The surface through echoes, if they are enough. `is_corner` tells of the first and the last echo whether another
    /// surface begins there: such an echo may lie on that one only.
    fn new(echoes: &[Echo], is_corner: [bool; 2], beams: &[Beam], settings: &Settings) -> Option<Self> {
        let inner = echoes.get(usize::from(is_corner[0])..echoes.len() - usize::from(is_corner[1]));
        let fit = Fit::new(inner.filter(|inner| inner.len() > 2).unwrap_or(echoes), beams)?;
        let line = fit.segment(echoes);
        let is_enough = echoes.len() >= settings.fewest_echoes && line.length() >= settings.shortest_m;
        let since_m = echoes.iter().map(|echo| beams[echo.beam].since_m).sum::<f64>() / echoes.len() as f64;
        is_enough.then(|| Self { line, fit, echoes: echoes.to_vec(), since_m })
    }

    /// The same, once the pose that it was placed by is found to be another.
    pub fn moved(&self, shift: &Shift) -> Self {
        let moved = |p: Point| shift.of(p);
        let (tip, centre) = (self.fit.at(1.0), moved(self.fit.centre));
        let tip = moved(tip);
        let along = tip - centre;
        let echoes = self.echoes.iter().map(|echo| Echo { at: moved(echo.at), ..*echo }).collect();
        let line = Segment::new(moved(self.line.a), moved(self.line.b));
        Self { line, fit: Fit { centre, along, ..self.fit }, echoes, ..*self }
    }

    /// The piece of it between two places along its line, with the echoes there.
    pub fn piece(&self, from: f64, to: f64, echoes: Vec<Echo>) -> Self {
        let middle = f64::midpoint(from, to);
        let sigma_m = self.fit.sigma_m.hypot(middle * self.fit.sigma_angle);
        let fit = Fit { centre: self.fit.at(middle), sigma_m, ..self.fit };
        let line = Segment::new(self.fit.at(from), self.fit.at(to));
        Self { line, fit, echoes, ..*self }
    }
}

/// Groups of neighbouring echoes in the order of the scan.
pub(super) fn groups(beams: &[Beam], settings: &Settings) -> Vec<Vec<Echo>> {
    let echo = |beam: usize| beams[beam].echo().map(|at| Echo { at, beam });
    let mut echoes: Vec<Echo> = (0..beams.len()).filter_map(echo).collect();
    let is_near = |a: &Echo, b: &Echo| a.at.distance(b.at) <= settings.largest_gap_m;
    // A single echo off from both its neighbours, which are near each other, is a false one.
    let is_false = |i: usize| {
        let (before, at, after) = (&echoes[i - 1], &echoes[i], &echoes[i + 1]);
        is_near(before, after) && !is_near(before, at) && !is_near(at, after)
    };
    let false_ones: Vec<usize> = (1..echoes.len().saturating_sub(1)).filter(|&i| is_false(i)).collect();
    for i in false_ones.into_iter().rev() {
        echoes.remove(i);
    }
    // A whole turn has no beginning: it is made to begin at a gap, or at the farthest echo, which comes from a corner.
    let gap = (1..echoes.len()).find(|&i| !is_near(&echoes[i - 1], &echoes[i]));
    let far = |echo: &Echo| beams[echo.beam].range_m.unwrap_or(0.0);
    let farthest = (0..echoes.len()).max_by(|&i, &j| far(&echoes[i]).total_cmp(&far(&echoes[j])));
    if let (Some(begin), Some(first), Some(last)) = (gap.or(farthest), echoes.first(), echoes.last())
        && is_near(first, last)
    {
        echoes.rotate_left(begin);
        if gap.is_none() {
            // the corner ends the last wall as it begins the first
            echoes.push(echoes[0]);
        }
    }
    echoes.chunk_by(|a, b| is_near(a, b)).map(<[Echo]>::to_vec).collect()
}

/// All straight surfaces that a scan shows.
pub(super) fn build(groups: &[Vec<Echo>], beams: &[Beam], settings: &Settings) -> Vec<Seen> {
    let mut seen = Vec::new();
    for group in groups.iter().filter(|group| group.len() >= settings.fewest_echoes) {
        let mut cuts = vec![0];
        split(group, 0, beams, settings, &mut cuts);
        cuts.push(group.len() - 1);
        merge(group, &mut cuts, beams, settings);
        let last = group.len() - 1;
        // a closed turn begins and ends with the same echo, in a corner
        let is_corner = |cut: usize| (cut > 0 && cut < last) || group[0].beam == group[last].beam;
        let part = |ends: &[usize]| {
            let corners = [ends[0], ends[1]].map(is_corner);
            Seen::new(&group[ends[0]..=ends[1]], corners, beams, settings)
        };
        let mut parts: Vec<Option<Seen>> = cuts.windows(2).map(part).collect();
        join(&mut parts, settings);
        seen.extend(parts.into_iter().flatten());
    }
    seen
}

/// Where a run of echoes bends, by the echo farthest from the line between its ends, again and again.
fn split(echoes: &[Echo], offset: usize, beams: &[Beam], settings: &Settings, cuts: &mut Vec<usize>) {
    let (Some(first), Some(last)) = (echoes.first(), echoes.last()) else { return };
    if echoes.len() < 3 {
        return;
    }
    let chord = Segment::new(first.at, last.at);
    let fit = Fit { centre: first.at, along: chord.direction(), sigma_m: 0.0, sigma_angle: 0.0 };
    let excess = |echo: &Echo| {
        let allowed = (settings.split_sigmas * fit.deviation(&beams[echo.beam])).max(settings.split_m);
        fit.offset(echo.at).abs() / allowed
    };
    let inner = echoes[1..echoes.len() - 1].iter().map(excess).enumerate();
    let Some((worst, by)) = inner.max_by(|a, b| a.1.total_cmp(&b.1)) else { return };
    if by > 1.0 {
        let at = worst + 1;
        split(&echoes[..=at], offset, beams, settings, cuts);
        cuts.push(offset + at);
        split(&echoes[at..], offset + at, beams, settings, cuts);
    }
}

/// Takes back cuts where one line does for both sides.
fn merge(group: &[Echo], cuts: &mut Vec<usize>, beams: &[Beam], settings: &Settings) {
    let mut at = 1;
    while at + 1 < cuts.len() {
        let both = &group[cuts[at - 1]..=cuts[at + 1]];
        let fits = Fit::new(both, beams)
            .is_some_and(|fit| fit.holds(both, beams, settings.split_sigmas, settings.split_m));
        if fits {
            cuts.remove(at);
        } else {
            at += 1;
        }
    }
}

/// Neighbouring parts end in the corner where their lines meet.
fn join(parts: &mut [Option<Seen>], settings: &Settings) {
    for i in 1..parts.len() {
        let (before, after) = parts.split_at_mut(i);
        let (Some(Some(a)), Some(Some(b))) = (before.last_mut(), after.first_mut()) else { continue };
        let Some(corner) = meeting(&a.fit, &b.fit) else { continue };
        if corner.distance(a.line.b) <= settings.join_m && corner.distance(b.line.a) <= settings.join_m {
            (a.line.b, b.line.a) = (corner, corner);
        }
    }
}

fn meeting(a: &Fit, b: &Fit) -> Option<Point> {
    let cross = a.along.cross(b.along);
    // lines that differ by less than 6 degrees meet anywhere
    (cross.abs() > 0.1).then(|| a.at(b.offset(a.centre) / cross))
}
