//! What the values of each cell make of all weights, found by trying them.

use std::sync::Arc;

use super::{Probe, Prober};
use crate::error::Result;
use crate::state::tunable::{Effect, Lever, Line, Side};

/// Values of the cells of one class that are tried at most.
const PATIENCE: usize = 2_000;

impl Prober {
    /// The cells of the columns that weigh, with what their values make of all weights.
    pub fn effects(&mut self) -> Result<Vec<Arc<Effect>>> {
        let mut classes: Vec<String> = self.columns().into_iter().map(|(class, _)| class).collect();
        classes.dedup();
        let mut all = Vec::new();
        for class in classes {
            all.extend(self.effects_in(&class)?);
        }
        Ok(all)
    }

    /// Those of one class.
    pub fn effects_in(&mut self, class: &str) -> Result<Vec<Arc<Effect>>> {
        let kept = Arc::clone(&self.fork.tunable);
        if let Some(known) = kept.of(class) {
            return Ok(known);
        }
        let (mut found, mut left) = (Vec::new(), PATIENCE);
        for lever in self.levers_in(class)? {
            found.push(Arc::new(self.effect(lever, &mut left)?));
        }
        kept.keep(class, &found);
        Ok(found)
    }

    /// What the values of a cell make of all weights, as far as there are values.
    ///
    /// # Arguments
    /// `left` is how many values may be tried yet; where that is none, it is left open whether weights are linear.
    fn effect(&mut self, lever: Lever, left: &mut usize) -> Result<Effect> {
        let (mut lines, mut weighs) = ([None, None], false);
        for (line, side) in lines.iter_mut().zip([Side::Below, Side::Above]) {
            let limit = side.limit(&lever, None);
            if limit.total_cmp(&lever.value).is_ne() {
                let mut values = lever.values(limit);
                if values.len() > *left {
                    (values, weighs) = (Vec::new(), true);
                }
                *left -= values.len();
                *line = self.whole(&lever, values, &mut weighs)?;
            }
        }
        self.restore(&lever)?;
        Ok(Effect { lever, lines, weighs })
    }

    /// The weights from the present value to the last of some, where they are linear all the way.
    fn whole(&mut self, lever: &Lever, values: Vec<f64>, weighs: &mut bool) -> Result<Option<Line>> {
        let mut line: Option<Line> = None;
        // outwards in: the last value makes the line, and each other one must lie on it
        for value in values.into_iter().rev() {
            let probe = self.at(lever, value)?;
            *weighs |= !matches!(&probe, Probe::Weighs(weights) if *weights == *self.present);
            let Probe::Weighs(weights) = probe else { return Ok(None) };
            match &line {
                None => {
                    let present = (lever.value, Arc::clone(&self.present));
                    line = Some(Line::new(present, (value, &weights)));
                }
                Some(line) if line.holds(value, &weights) => {}
                Some(_) => return Ok(None),
            }
        }
        Ok(line)
    }
}
