//! Edits of facts that doors were weighed by, each with the one that takes it back.

use adit_engine::KnowledgeBase;

use super::doors::{Door, Facts, PROPERTIES, State, object, states};

/// One edit.
#[derive(Clone, Debug)]
pub enum Edit {
    /// A property of the door in a row.
    Door(usize, usize, f64),
    /// A size of the state with this name: 0 its height, 1 its width, 2 its hardness.
    State(&'static str, usize, f64),
    /// A new state, last of all.
    Add(State),
    /// A state that is gone.
    Remove(&'static str),
}

/// An edit and its way back.
#[derive(Clone, Debug)]
pub struct Case {
    /// What is done.
    pub name: &'static str,
    /// The edit.
    pub there: Edit,
    /// What undoes it, but for the order of rows.
    pub back: Edit,
}

const LIE: &str = "LIE-FACE-DOWN";
const SIZES: [&str; 3] = ["height", "width", "hardness"];
/// The door and the width that the peers change.
const DOOR: (usize, f64) = (505, 1.5);

impl Edit {
    /// Tells the edit to a knowledge base that holds these facts, and changes the facts alike.
    pub fn tell(&self, base: &mut KnowledgeBase, facts: &mut Facts) {
        let place = |facts: &Facts, name: &str| {
            facts.states.iter().position(|state| state.name == name).expect("the state is there")
        };
        match self {
            &Edit::Door(row, property, value) => {
                base.tell_row("DOORS", row, PROPERTIES[property], Some(value.into())).expect("a number");
                facts.doors[row][property] = value;
            }
            &Edit::State(name, size, value) => {
                let row = place(facts, name);
                base.tell_row("ROBOTS", row, SIZES[size], Some(value.into())).expect("a number");
                facts.states[row].sizes[size] = value;
            }
            Edit::Add(state) => {
                base.add("ROBOTS", &object(state)).expect("the name is new");
                facts.states.push(state.clone());
            }
            Edit::Remove(name) => {
                let row = place(facts, name);
                base.remove_row("ROBOTS", row).expect("the row is there");
                facts.states.remove(row);
            }
        }
    }
}

/// Every kind of edit that Table 6 can meet.
pub fn cases(doors: &[Door]) -> Vec<Case> {
    let lie = states("IMPOSSIBLE").swap_remove(3);
    let size = |name, of, size, before, after| Case {
        name,
        there: Edit::State(of, size, after),
        back: Edit::State(of, size, before),
    };
    let new = |name, state: &'static str, sizes| Case {
        name,
        there: Edit::Add(State { name: state, action: "NEW", sizes }),
        back: Edit::Remove(state),
    };
    vec![
        size("LIE-FACE-DOWN hardness 8 to 9", LIE, 2, 8.0, 9.0),
        Case {
            name: "one door's width",
            there: Edit::Door(DOOR.0, 6, DOOR.1),
            back: Edit::Door(DOOR.0, 6, doors[DOOR.0][6]),
        },
        size("LIE-FACE-DOWN hardness 8 to 7", LIE, 2, 8.0, 7.0),
        size("LIE-FACE-DOWN hardness 8 to 3, past SQUAT", LIE, 2, 8.0, 3.0),
        size("SQUAT hardness 4 to 9, past LIE-FACE-DOWN", "SQUAT", 2, 4.0, 9.0),
        size("LIE-FACE-DOWN height 5 to 4.5", LIE, 0, 5.0, 4.5),
        size("LIE-FACE-DOWN height 5 to 6", LIE, 0, 5.0, 6.0),
        size("LIE-FACE-DOWN width 5 to 4", LIE, 1, 5.0, 4.0),
        new("a state more, in the middle (7 high, 5 wide, 6)", "STOOP", [7.0, 5.0, 6.0]),
        new("a state more, the hardest but one (2, 2, 20)", "CRAWL", [2.0, 2.0, 20.0]),
        Case { name: "LIE-FACE-DOWN removed", there: Edit::Remove(LIE), back: Edit::Add(lie) },
    ]
}
