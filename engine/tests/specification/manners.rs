//! Miss Manners: joins, negation and the agenda together. The party is that of the example.

use adit_engine::Limits;

#[path = "../../examples/manners/party.rs"]
mod party;

use party::{checked, guests, rules, seating, table};

#[test]
fn sixteen_guests_sit_beside_somebody_that_they_can_talk_to() {
    let guests = guests(16, 1);
    let mut base = table(&guests, Limits::default()).unwrap();
    let run = base.react(&rules().unwrap());
    assert!(run.diagnostics.is_empty(), "{:?}", run.diagnostics);
    checked(&guests, &seating(&base).unwrap()).unwrap();
}
