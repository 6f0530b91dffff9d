//! A party: guests, their table as a knowledge base, and whether a seating is right.

use std::collections::BTreeSet;

use adit_engine::{Class, ClassError, Diagnostics, KnowledgeBase, Limits, RuleBase, SourceFile};

/// Somebody to seat.
pub struct Guest {
    pub name: String,
    pub sex: &'static str,
    pub hobbies: Vec<u32>,
}

/// As many women as men, each with two or three of three hobbies: so any two share one.
pub fn guests(count: usize, seed: u64) -> Vec<Guest> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut draw = |below: u64| {
        // Marsaglia's xorshift.
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state % below
    };
    (0..count)
        .map(|number| {
            let left_out = draw(4) as u32;
            let hobbies = (1..=3).filter(|&hobby| hobby != left_out).collect();
            let sex = if number % 2 == 0 { "m" } else { "f" };
            Guest { name: format!("guest {}", number + 1), sex, hobbies }
        })
        .collect()
}

pub fn rules() -> Result<RuleBase, Diagnostics> {
    RuleBase::compile(&[SourceFile::new("manners.rhai", include_str!("manners.rhai"))])
}

/// The knowledge base before the first guest sits.
pub fn table(guests: &[Guest], limits: Limits) -> Result<KnowledgeBase, ClassError> {
    let rows: Vec<(&Guest, u32)> =
        guests.iter().flat_map(|guest| guest.hobbies.iter().map(move |&hobby| (guest, hobby))).collect();
    let mut base = KnowledgeBase::with_limits(limits);
    base.assert(
        Class::new("GUESTS", &[])
            .texts("name", rows.iter().map(|(guest, _)| Some(guest.name.as_str())))
            .texts("sex", rows.iter().map(|(guest, _)| Some(guest.sex)))
            .numbers("hobby", rows.iter().map(|(_, hobby)| Some(f64::from(*hobby)))),
    )?;
    base.assert(
        Class::new("PARTY", &[])
            .texts("doing", [Some("start")])
            .numbers("seats", [Some(guests.len() as f64)])
            .numbers("seatings", [Some(1.0)])
            .numbers("seating", [None]),
    )?;
    Ok(base)
}

/// The names in the order of the seats.
pub fn seating(base: &KnowledgeBase) -> Option<Vec<String>> {
    let id = base.numbers("PARTY", "seating")?.first().copied().flatten()?;
    let (ids, seats, names) =
        (base.numbers("PATH", "id")?, base.numbers("PATH", "seat")?, base.texts("PATH", "guest")?);
    let mut order: Vec<(u32, String)> = vec![];
    for ((of, seat), name) in ids.into_iter().zip(seats).zip(names) {
        if of == Some(id) {
            order.push((seat? as u32, name?.to_string()));
        }
    }
    order.sort();
    Some(order.into_iter().map(|(_, name)| name).collect())
}

/// Whether everybody sits once, beside people of the other sex with a hobby in common.
pub fn checked(guests: &[Guest], order: &[String]) -> Result<(), String> {
    let names: BTreeSet<&String> = order.iter().collect();
    if names.len() != guests.len() || order.len() != guests.len() {
        return Err(format!("{} seats for {} of {} guests", order.len(), names.len(), guests.len()));
    }
    let find = |name: &String| guests.iter().find(|guest| guest.name == *name).ok_or("a stranger");
    for pair in order.windows(2) {
        let (a, b) = (find(&pair[0])?, find(&pair[1])?);
        if a.sex == b.sex || !a.hobbies.iter().any(|hobby| b.hobbies.contains(hobby)) {
            return Err(format!("{} cannot sit beside {}", a.name, b.name));
        }
    }
    Ok(())
}
