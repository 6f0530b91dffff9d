//! What the values of each cell make of all weights, found by trying them.

use std::sync::Arc;

use super::{Probe, Prober};
use crate::error::Result;
use crate::state::tunable::{Course, Lever, Line, Side};

impl Prober {
    /// The cells of the columns that weigh, with what their values make of all weights.
    pub fn courses(&mut self) -> Result<Vec<Arc<Course>>> {
        let mut classes: Vec<String> = self.columns().into_iter().map(|(class, _)| class).collect();
        classes.dedup();
        let mut all = Vec::new();
        for class in classes {
            all.extend(self.courses_in(&class)?);
        }
        Ok(all)
    }

    /// Those of one class.
    pub fn courses_in(&mut self, class: &str) -> Result<Vec<Arc<Course>>> {
        let kept = Arc::clone(&self.fork.tunable);
        if let Some(known) = kept.of(class) {
            return Ok(known);
        }
        let mut found = Vec::new();
        for lever in self.levers_in(class)? {
            found.push(Arc::new(self.course(lever)?));
        }
        kept.keep(class, found.clone());
        Ok(found)
    }

    /// What the values of a cell make of all weights, as far as there are values.
    fn course(&mut self, lever: Lever) -> Result<Course> {
        let (mut lines, mut weighs) = ([None, None], false);
        for (line, side) in lines.iter_mut().zip([Side::Below, Side::Above]) {
            let limit = side.limit(&lever, None);
            if limit.total_cmp(&lever.value).is_ne() {
                *line = self.whole(&lever, &lever.breaks(limit), &mut weighs)?;
            }
        }
        self.restore(&lever)?;
        Ok(Course { lever, lines, weighs })
    }

    /// The weights from the present value to the last of some, where they are linear all the way.
    fn whole(&mut self, lever: &Lever, breaks: &[f64], weighs: &mut bool) -> Result<Option<Line>> {
        let mut line: Option<Line> = None;
        let mut from = lever.value;
        // outwards in: the last value makes the line, and each other one must lie on it
        let mut values = Vec::new();
        for &to in breaks {
            values.extend([f64::midpoint(from, to), to]);
            from = to;
        }
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
