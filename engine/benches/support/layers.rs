//! Rooms cut for each state and the doors between them, made up; and what the shipped `by-state` rules conclude of them.

use adit_engine::{Class, KnowledgeBase, RuleBase, SourceFile};

/// The rules as they are shipped.
const RULES: [(&str, &str); 3] = [
    ("states.rhai", include_str!("../../../rules/rooms/by-state/states.rhai")),
    ("rooms.rhai", include_str!("../../../rules/rooms/by-state/rooms.rhai")),
    ("doors.rhai", include_str!("../../../rules/rooms/by-state/doors.rhai")),
];

/// States that move, with action and hardness.
const STATES: [(&str, &str, f64); 4] = [
    ("STAND", "WALK", 1.0),
    ("SIDE-STAND", "SIDE-WALK", 2.0),
    ("SQUAT", "WALK-ON-KNEE", 4.0),
    ("LIE-FACE-DOWN", "CREEP", 8.0),
];
/// Changes of shape that cost something, by the number of the state; the others cost nothing.
const CHANGES: [(usize, usize, f64); 4] = [(0, 2, 2.5), (2, 0, 3.0), (2, 3, 4.5), (3, 2, 6.0)];
/// Doors for each room; and of how many doors one joins two layers.
const DOORS_A_ROOM: usize = 4;
const A_CHANGE_IN: usize = 4;

/// Rooms by their state, and doors as the rows of the rooms that they join.
pub struct Layers {
    rooms: Vec<usize>,
    doors: Vec<(usize, usize)>,
}

/// As many doors, a quarter of them between two states.
pub fn made(doors: usize) -> Layers {
    let states = STATES.len();
    let rooms: Vec<usize> = (0..(doors / DOORS_A_ROOM).max(2 * states)).map(|room| room % states).collect();
    let mut seed = 19_900_607_u64;
    let mut draw = |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % below
    };
    let layer = rooms.len() / states;
    let join = |nth: usize| {
        let (room, state, step) = (draw(layer), draw(states), 1 + draw(layer - 1));
        let from = room * states + state;
        if nth.is_multiple_of(A_CHANGE_IN) {
            (from, room * states + (state + 1 + draw(states - 1)) % states)
        } else {
            (from, (room + step) % layer * states + state)
        }
    };
    Layers { doors: (0..doors).map(join).collect(), rooms }
}

/// The compiled rules.
pub fn compiled() -> RuleBase {
    let files = RULES.map(|(name, text)| SourceFile::new(name, text));
    RuleBase::compile(&files).expect("the rules are right")
}

/// A knowledge base to which the facts are told, and nothing concluded.
pub fn told(layers: &Layers) -> KnowledgeBase {
    let Layers { rooms, doors } = layers;
    let state = |state: usize| STATES.get(state).map_or("IMPOSSIBLE", |state| state.0);
    let numbers = |count: usize| (1..=count).map(|number| Some(number as f64));
    let room = |row: usize| Some((row + 1) as f64);
    let all = 0..=STATES.len();
    let classes = [
        Class::new("ROBOTS", &["robot", "state"])
            .texts("robot", all.clone().map(|_| Some("robot")))
            .texts("state", all.clone().map(|row| Some(state(row))))
            .texts(
                "action",
                all.clone().map(|row| Some(STATES.get(row).map_or("NO-ACTION", |state| state.1))),
            )
            .numbers("hardness", all.map(|row| Some(STATES.get(row).map_or(10000.0, |state| state.2)))),
        Class::new("CHANGES", &["robot", "from_state", "to_state"])
            .texts("robot", CHANGES.map(|_| Some("robot")))
            .texts("from_state", CHANGES.map(|change| Some(state(change.0))))
            .texts("to_state", CHANGES.map(|change| Some(state(change.1))))
            .numbers("hardness", CHANGES.map(|change| Some(change.2))),
        Class::new("ROOMS", &["room"])
            .numbers("room", numbers(rooms.len()))
            .texts("robot", rooms.iter().map(|_| Some("robot")))
            .texts("state", rooms.iter().map(|&of| Some(state(of)))),
        Class::new("DOORS", &["door"])
            .numbers("door", numbers(doors.len()))
            .texts("kind", layers.changes().map(|change| Some(if change { "change" } else { "door" })))
            .numbers("room1", doors.iter().map(|door| room(door.0)))
            .numbers("room2", doors.iter().map(|door| room(door.1))),
    ];
    let mut base = KnowledgeBase::new();
    for class in classes {
        base.assert(class).expect("the objects have keys");
    }
    base
}

/// Not a faster wrong answer: panics if a room or a door is not as compiled Rust has it.
pub fn check(layers: &Layers, base: &KnowledgeBase) {
    let hardness = |&(from, to): &(usize, usize)| {
        let (from, to) = (layers.rooms[from], layers.rooms[to]);
        let change = CHANGES.iter().find(|change| (change.0, change.1) == (from, to));
        Some(change.map_or(0.0, |change| change.2))
    };
    let doors: Vec<_> = layers.doors.iter().map(hardness).collect();
    assert_eq!(base.numbers("DOORS", "hardness"), Some(doors), "hardness of doors");
    let actions = base.texts("DOORS", "action").expect("the rules set it");
    let right = layers.doors.iter().map(|door| STATES[layers.rooms[door.1]].1);
    assert!(actions.iter().map(Option::as_deref).eq(right.map(Some)), "actions of doors");
    let rooms = layers.rooms.iter().map(|&state| Some(STATES[state].2)).collect();
    assert_eq!(base.numbers("ROOMS", "hardness"), Some(rooms), "hardness of rooms");
}

impl Layers {
    fn changes(&self) -> impl Iterator<Item = bool> {
        self.doors.iter().map(|door| self.rooms[door.0] != self.rooms[door.1])
    }
}
