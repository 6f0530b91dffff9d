//! Doors to weigh, a robot's states; and Table 6 in compiled Rust, to compare with.

use adit_engine::{Class, KnowledgeBase, RuleBase, SourceFile, Value};

/// Table 6's rule as it is shipped.
pub const TABLE_6: &str = include_str!("../../../rules/rooms/paper/doors.rhai");

/// The properties of a door, in the order of [`Door`].
pub const PROPERTIES: [&str; 7] =
    ["height1", "width1", "distance1", "height2", "width2", "distance2", "width"];

/// What Table 6 reads of a door.
pub type Door = [f64; 7];

/// A state of the robot.
#[derive(Clone, Debug)]
pub struct State {
    /// Its name; the rule refuses doors decided by `IMPOSSIBLE`.
    pub name: &'static str,
    /// What the robot does in it.
    pub action: &'static str,
    /// Height, width and hardness.
    pub sizes: [f64; 3],
}

/// All that the rule reads.
#[derive(Clone, Debug)]
pub struct Facts {
    /// The doors.
    pub doors: Vec<Door>,
    /// The states; of equally hard ones the first is taken.
    pub states: Vec<State>,
}

/// What the rule sets: hardness (by its bits), action, whether a state can pass.
pub type Weighed = (Option<u64>, Option<String>, Option<bool>);

/// The published states. Where the last one is not named `IMPOSSIBLE`, the shipped rule multiplies its hardness by
/// distances like that of any other state.
pub fn states(last: &'static str) -> Vec<State> {
    let state = |name, action, sizes| State { name, action, sizes };
    vec![
        state("STAND", "WALK", [20.0, 3.0, 1.0]),
        state("SIDE-STAND", "SIDE-WALK", [20.0, 1.0, 2.0]),
        state("SQUAT", "WALK-ON-KNEE", [10.0, 5.0, 4.0]),
        state("LIE-FACE-DOWN", "CREEP", [5.0, 5.0, 8.0]),
        state(last, "NO-ACTION", [0.0, 0.0, 10000.0]),
    ]
}

/// A knowledge base to which the facts are told, and nothing concluded.
pub fn told(facts: &Facts) -> KnowledgeBase {
    let mut doors = Class::new("DOORS", &["door"])
        .numbers("door", (1..=facts.doors.len()).map(|number| Some(number as f64)));
    for (nth, name) in PROPERTIES.into_iter().enumerate() {
        doors = doors.numbers(name, facts.doors.iter().map(|door| Some(door[nth])));
    }
    let size = |nth: usize| facts.states.iter().map(move |state| Some(state.sizes[nth]));
    let states = Class::new("ROBOTS", &["robot", "state"])
        .texts("robot", facts.states.iter().map(|_| Some("robot")))
        .texts("state", facts.states.iter().map(|state| Some(state.name)))
        .texts("action", facts.states.iter().map(|state| Some(state.action)))
        .numbers("height", size(0))
        .numbers("width", size(1))
        .numbers("hardness", size(2));
    let mut base = KnowledgeBase::new();
    base.assert(doors).expect("the doors are numbered");
    base.assert(states).expect("the states have names");
    base
}

/// The properties of a state as they are told when it is added.
pub fn object(state: &State) -> [(&'static str, Value); 6] {
    let [height, width, hardness] = state.sizes.map(Value::Number);
    let [robot, name, action] = ["robot", state.name, state.action].map(Value::from);
    [
        ("robot", robot),
        ("state", name),
        ("action", action),
        ("height", height),
        ("width", width),
        ("hardness", hardness),
    ]
}

/// Compiles one rule file.
pub fn compiled(text: &str) -> RuleBase {
    RuleBase::compile(&[SourceFile::new("doors.rhai", text)]).expect("the rule is right")
}

/// Table 6 in compiled Rust: hardness, the state that passes, and whether it can.
pub fn weigh(states: &[State], &[h1, w1, d1, h2, w2, d2, width]: &Door) -> Option<(f64, usize, bool)> {
    let (first, second, through) =
        (best(states, h1, w1)?, best(states, h2, w2)?, best(states, h1.min(h2), width)?);
    let refusing = [through, first, second].into_iter().find(|&state| states[state].name == "IMPOSSIBLE");
    if let Some(state) = refusing {
        return Some((states[state].sizes[2], state, false));
    }
    let [first, second, third] = [first, second, through].map(|state| states[state].sizes[2]);
    Some((d1 * first + d2 * second + third, through, true))
}

fn best(states: &[State], height: f64, width: f64) -> Option<usize> {
    let mut best = None;
    let mut least = f64::INFINITY;
    for (nth, &State { sizes: [tall, wide, hardness], .. }) in states.iter().enumerate() {
        if tall < height && wide < width && hardness < least {
            (best, least) = (Some(nth), hardness);
        }
    }
    best
}

/// What compiled Rust says of all doors.
pub fn expected(facts: &Facts) -> Vec<Weighed> {
    let said = |door| match weigh(&facts.states, door) {
        Some((hardness, state, passable)) => {
            (Some(hardness.to_bits()), Some(facts.states[state].action.to_owned()), Some(passable))
        }
        None => (None, None, Some(false)),
    };
    facts.doors.iter().map(said).collect()
}

/// What a knowledge base says of all doors.
pub fn concluded(base: &KnowledgeBase) -> Vec<Weighed> {
    let hardness = base.numbers("DOORS", "hardness").expect("the rule sets it");
    let actions = base.texts("DOORS", "action").expect("the rule sets it");
    let passable = base.truths("DOORS", "passable").expect("the rule sets it");
    let both = hardness.into_iter().zip(actions).zip(passable);
    both.map(|((hardness, action), passable)| {
        (hardness.map(f64::to_bits), action.map(|action| action.to_string()), passable)
    })
    .collect()
}
