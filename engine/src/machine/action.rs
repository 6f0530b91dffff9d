//! Runs an action over a batch: every step over all bindings, branches by masks.

use super::Machine;
use super::evaluate::{Batch, Mask};
use super::lane::{Frame, Lane, Values};
use crate::plan::action::{ActionPlan, Step, Target};
use crate::value::{Cell, Truth};

/// What the slots of an action hold after a batch, and where they were written.
pub(crate) struct Slots {
    pub(crate) values: Vec<Values<'static>>,
    /// For each slot the bindings that wrote it; `None` is all.
    pub(crate) written: Vec<Written>,
}

/// Which bindings wrote a slot.
#[derive(Clone, Debug)]
pub(crate) enum Written {
    Nowhere,
    Everywhere,
    Where(Vec<bool>),
}

impl Written {
    pub(crate) fn extend(&self, out: &mut Vec<bool>, len: usize) {
        match self {
            Self::Nowhere => out.resize(out.len() + len, false),
            Self::Everywhere => out.resize(out.len() + len, true),
            Self::Where(mask) => out.extend_from_slice(&mask[..len]),
        }
    }
}

impl Machine<'_> {
    pub(crate) fn act(&self, plan: &ActionPlan, frame: &Frame) -> Slots {
        let mut slots =
            Slots { values: vec![Values::UNKNOWN; plan.slots], written: vec![Written::Nowhere; plan.slots] };
        self.steps(&plan.steps, &plan.targets, frame, None, &mut slots);
        slots
    }

    fn steps(&self, steps: &[Step], targets: &[Target], frame: &Frame, mask: Mask, slots: &mut Slots) {
        for step in steps {
            match step {
                Step::Put { slot, value } => {
                    let value =
                        self.evaluate(value, Batch { frame, slots: &slots.values, mask }).into_static();
                    slots.put(*slot, value, frame.len, mask);
                }
                Step::If { condition, then, otherwise, changes } => {
                    let batch = Batch { frame, slots: &slots.values, mask };
                    let condition = self.evaluate(condition, batch).truths().into_static();
                    let active = |index| mask.is_none_or(|mask| mask[index]);
                    let when = |wanted: Truth| -> Vec<bool> {
                        (0..frame.len).map(|index| active(index) && condition.at(index) == wanted).collect()
                    };
                    let (yes, no, unknown) = (when(Truth::True), when(Truth::False), when(Truth::Unknown));
                    if yes.contains(&true) {
                        self.steps(then, targets, frame, Some(&yes), slots);
                    }
                    if no.contains(&true) {
                        self.steps(otherwise, targets, frame, Some(&no), slots);
                    }
                    if unknown.contains(&true) {
                        for &slot in changes {
                            slots.put(slot, Values::UNKNOWN, frame.len, Some(&unknown));
                        }
                    }
                }
                Step::Interpret(fragment) => {
                    let mut cells: Vec<Vec<Option<Cell>>> = vec![vec![]; targets.len()];
                    for index in 0..frame.len {
                        let batch = Batch { frame, slots: &slots.values, mask };
                        let set = self.interpret_action(fragment, targets, batch, index);
                        cells.iter_mut().zip(set).for_each(|(column, cell)| column.push(cell));
                    }
                    for (target, column) in targets.iter().zip(cells) {
                        let mask: Vec<bool> = column.iter().map(Option::is_some).collect();
                        let values = column.into_iter().map(|cell| cell.unwrap_or(Cell::Unknown)).collect();
                        slots.put(target.slot, Values::Cells(Lane::Each(values)), frame.len, Some(&mask));
                    }
                }
            }
        }
    }
}

impl Slots {
    fn put(&mut self, slot: usize, value: Values<'static>, len: usize, mask: Mask) {
        let Some(mask) = mask else {
            self.values[slot] = value;
            self.written[slot] = Written::Everywhere;
            return;
        };
        let old = std::mem::replace(&mut self.values[slot], Values::UNKNOWN);
        self.values[slot] = old.blend(value, len, |index| mask[index]);
        match &mut self.written[slot] {
            Written::Everywhere => {}
            Written::Where(written) => written.iter_mut().zip(mask).for_each(|(old, new)| *old |= new),
            nowhere @ Written::Nowhere => *nowhere = Written::Where(mask.to_vec()),
        }
    }
}
