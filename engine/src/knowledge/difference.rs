//! A class as it was and as it is asserted now.

use std::collections::HashMap;

use super::pending::Pending;
use crate::class::Table;
use crate::column::Column;

pub(super) fn difference(old: &Table, new: &Table) -> Pending {
    let kinds = |table: &Table| table.columns.iter().map(Column::kind).collect::<Vec<_>>();
    if old.names != new.names || old.key != new.key || kinds(old) != kinds(new) {
        return Pending::anew();
    }
    let mut pending = Pending::default();
    let same_keys = old.len == new.len && old.key.iter().all(|&at| old.columns[at].same(&new.columns[at]));
    if same_keys {
        for (name, (before, now)) in new.names.iter().zip(old.columns.iter().zip(&new.columns)) {
            for row in before.differing(now) {
                pending.change(name, row);
            }
        }
        return pending;
    }
    let moved = places(old, new);
    let mut kept = vec![false; new.len];
    moved.iter().flatten().for_each(|&row| kept[row as usize] = true);
    pending.added = (0..new.len as u32).filter(|&row| !kept[row as usize]).collect();
    for (name, (before, now)) in new.names.iter().zip(old.columns.iter().zip(&new.columns)) {
        for (from, to) in moved.iter().enumerate() {
            if let Some(to) = *to
                && !before.cell(from).same(now.cell(to as usize))
            {
                pending.change(name, to);
            }
        }
    }
    if !moved.iter().zip(0..).all(|(to, from)| *to == Some(from)) {
        pending.moved = Some(moved);
    }
    pending
}

/// For each old row its new one, by key; by place where the class has no key.
fn places(old: &Table, new: &Table) -> Vec<Option<u32>> {
    if new.key.is_empty() {
        return (0..old.len as u32).map(|row| Some(row).filter(|&row| (row as usize) < new.len)).collect();
    }
    let by_key: HashMap<Vec<u64>, u32> =
        (0..new.len).filter_map(|row| Some((new.key_bits(row)?, row as u32))).collect();
    (0..old.len).map(|row| by_key.get(&old.key_bits(row)?).copied()).collect()
}
