//! A Reach of somebody else's: a plug-in that slides along what is in the way.

use adit_planners::adapt::{Configuration, Probe, Reach, distance};

/// Goes straight, and where something is in the way slides along it, as long as that brings it nearer (Glavina 1990).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sliding {
    /// The length of a step while it slides, by the distance of configurations.
    pub step: f64,
    /// After so many steps it gives up.
    pub steps: u32,
}

impl Reach for Sliding {
    fn reach(&self, probe: &mut Probe<'_>, from: &[f64], to: &[f64]) -> Option<Vec<Configuration>> {
        // Either end may be asked for first: it always slides from the same one.
        let is_turned = from > to;
        let (start, end) = if is_turned { (to, from) } else { (from, to) };
        let mut path = self.slide(probe, start, end)?;
        if is_turned {
            path.reverse();
        }
        Some(path)
    }
}

impl Sliding {
    fn slide(self, probe: &mut Probe<'_>, from: &[f64], to: &[f64]) -> Option<Vec<Configuration>> {
        let mut path = vec![from.to_vec()];
        let mut here = from.to_vec();
        for _ in 0..self.steps {
            if probe.is_motion_free(&here, to) {
                path.push(to.to_vec());
                return Some(path);
            }
            here = self.next(probe, &here, to)?;
            path.push(here.clone());
        }
        None
    }

    /// The step that leads nearest to the end, straight towards it or with a joint left out; `None` where none leads nearer.
    fn next(self, probe: &mut Probe<'_>, here: &[f64], to: &[f64]) -> Option<Configuration> {
        let ways = std::iter::once(None).chain((0..here.len()).map(Some));
        let mut steps: Vec<Configuration> =
            ways.filter_map(|left_out| self.step(here, to, left_out)).collect();
        steps.sort_by(|a, b| distance(a, to).total_cmp(&distance(b, to)));
        steps
            .into_iter()
            .find(|next| distance(next, to) < distance(here, to) && probe.is_motion_free(here, next))
    }

    fn step(self, here: &[f64], to: &[f64], left_out: Option<usize>) -> Option<Configuration> {
        let lack = here.iter().zip(to).map(|(a, b)| b - a).enumerate();
        let lack: Vec<f64> = lack.map(|(joint, d)| if left_out == Some(joint) { 0.0 } else { d }).collect();
        let long = lack.iter().map(|d| d * d).sum::<f64>().sqrt();
        let share = (self.step / long).min(1.0);
        (long > 0.0).then(|| here.iter().zip(&lack).map(|(a, d)| a + share * d).collect())
    }
}
