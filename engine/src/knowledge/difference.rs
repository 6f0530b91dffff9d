//! A class as it was and as it is asserted now.

use std::collections::HashMap;

use super::dirty::Dirty;
use super::pending::Pending;
use crate::class::Table;

pub(super) fn difference(old: &Table, new: &Table) -> Pending {
    let kinds = |table: &Table| table.columns.iter().map(|column| column.kind()).collect::<Vec<_>>();
    if old.names != new.names || old.key != new.key || kinds(old) != kinds(new) {
        return Pending::anew();
    }
    let mut pending = Pending::default();
    // as far as both go: objects that are numbered, or have no key, come and go at the end
    let are_first_alike = old.key.iter().all(|&at| old.columns[at].differing(&new.columns[at]).is_empty());
    if are_first_alike {
        for (name, (before, now)) in new.names.iter().zip(old.columns.iter().zip(&new.columns)) {
            let rows = before.differing(now);
            if !rows.is_empty() {
                pending.changed.insert(name.clone(), Dirty::Rows(rows));
            }
        }
        let (before, now) = (old.len as u32, new.len as u32);
        pending.added = (before..now).collect();
        pending.moved =
            (before > now).then(|| (0..before).map(|row| Some(row).filter(|row| *row < now)).collect());
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

/// For each old row its new one, by key.
fn places(old: &Table, new: &Table) -> Vec<Option<u32>> {
    let by_key: HashMap<Vec<u64>, u32> =
        (0..new.len).filter_map(|row| Some((new.key_bits(row)?, row as u32))).collect();
    (0..old.len).map(|row| by_key.get(&old.key_bits(row)?).copied()).collect()
}
