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
                    let whole = |truth| matches!(&condition, Lane::Same(same) if *same == truth);
                    if whole(Truth::True) {
                        self.steps(then, targets, frame, mask, slots);
                    } else if whole(Truth::False) {
                        self.steps(otherwise, targets, frame, mask, slots);
                    } else {
                        let when = |wanted: Truth| when(&condition, wanted, frame.len, mask);
                        self.branch(then, changes, targets, frame, &when(Truth::True), slots);
                        self.branch(otherwise, changes, targets, frame, &when(Truth::False), slots);
                        let unknown = when(Truth::Unknown);
                        if unknown.contains(&true) {
                            for &slot in changes {
                                slots.put(slot, Values::UNKNOWN, frame.len, Some(&unknown));
                            }
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

fn when(condition: &Lane<Truth>, wanted: Truth, len: usize, mask: Mask) -> Vec<bool> {
    let mut chosen: Vec<bool> = match condition {
        Lane::Same(truth) => vec![*truth == wanted; len],
        Lane::Each(truths) => truths.iter().map(|&truth| truth == wanted).collect(),
    };
    if let Some(mask) = mask {
        chosen.iter_mut().zip(mask).for_each(|(chosen, &active)| *chosen &= active);
    }
    chosen
}

impl Machine<'_> {
    /// One branch of an `if`. Where few bindings take it, it runs for them alone.
    fn branch(
        &self,
        steps: &[Step],
        changes: &[usize],
        targets: &[Target],
        frame: &Frame,
        chosen: &[bool],
        slots: &mut Slots,
    ) {
        let count = chosen.iter().filter(|chosen| **chosen).count();
        if count == 0 || steps.is_empty() {
            return;
        }
        if count * 4 > frame.len {
            return self.steps(steps, targets, frame, Some(chosen), slots);
        }
        let taken: Vec<u32> = (0..).zip(chosen).filter(|(_, chosen)| **chosen).map(|(at, _)| at).collect();
        let mut own = Slots {
            values: slots.values.iter().map(|values| values.select(&taken)).collect(),
            written: vec![Written::Nowhere; slots.written.len()],
        };
        self.steps(steps, targets, &frame.select(&taken), None, &mut own);
        for &slot in changes {
            slots.scatter(slot, &own.values[slot], &own.written[slot], &taken, frame.len);
        }
    }
}

impl Slots {
    fn scatter(&mut self, slot: usize, values: &Values, written: &Written, taken: &[u32], len: usize) {
        let from: Vec<bool> = match written {
            Written::Nowhere => return,
            Written::Everywhere => vec![true; taken.len()],
            Written::Where(mask) => mask.clone(),
        };
        let written_now =
            taken.iter().zip(&from).filter(|(_, written)| **written).map(|(&at, _)| at as usize);
        match &mut self.written[slot] {
            Written::Everywhere => {}
            Written::Where(mask) => written_now.for_each(|at| mask[at] = true),
            nowhere @ Written::Nowhere => {
                let mut mask = vec![false; len];
                written_now.for_each(|at| mask[at] = true);
                *nowhere = Written::Where(mask);
            }
        }
        self.values[slot].scatter(values, taken, &from, len);
    }

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
