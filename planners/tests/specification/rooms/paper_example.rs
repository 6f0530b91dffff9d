//! The environment of Abou-Ali et al., Figure 3, with coordinates found by search: Tables 2, 3 and 4.

use adit_planners::bridges::Bridges;
use adit_planners::facts::{Column, Facts, Table};
use adit_planners::geometry::Rect;
use adit_planners::minimum::MinimumRooms;
use adit_planners::planner::{Planner, PlannerError};
use adit_planners::prime_areas::{PrimeAreas, prime_areas};
use adit_planners::rooms::PaperRooms;
use adit_planners::strips::Strips;
use adit_planners::world::{Bridge, Obstacle, Shape, World};

fn environment() -> World {
    let obstacle = |rect| Obstacle { shape: Shape::Rect(rect) };
    World {
        obstacles: vec![
            obstacle(Rect::new(19.1, 6.0, 29.5, 16.5)),
            obstacle(Rect::new(44.7, 9.6, 62.7, 34.0)),
        ],
        bridges: vec![
            Bridge { rect: Rect::new(19.1, 0.0, 29.5, 6.0), height: 4.0 },
            Bridge { rect: Rect::new(29.5, 9.6, 44.7, 16.5), height: 15.0 },
        ],
        ..World::empty(Rect::new(0.0, 0.0, 93.7, 41.1))
    }
}

/// What planners and rules know before rooms are made. The rules' part is played here: the least hard state is
/// 3 wide, the tallest 20 high.
fn known(world: &World) -> Facts {
    let mut known = PrimeAreas.facts(world, &Facts::new()).unwrap();
    known.extend(Bridges.facts(world, &Facts::new()).unwrap());
    decide(&mut known, "PRIME_AREAS", "width", "open", |width| width > 3.0);
    decide(&mut known, "BRIDGES", "height", "low", |height| height <= 20.0);
    known
}

fn decide(known: &mut Facts, class: &str, reads: &str, sets: &str, rule: impl Fn(f64) -> bool) {
    let table = known.remove(class).unwrap();
    let decided: Column = table.numbers(reads).unwrap().iter().map(|value| rule(value.unwrap())).collect();
    known.insert(class.to_owned(), table.with(sets, decided));
}

fn strings(strips: &Strips, rect: Rect) -> String {
    let block = strips.block(rect).unwrap();
    let bits = |ones: std::ops::Range<u32>, strips: u32| -> String {
        (0..strips).map(|strip| if ones.contains(&strip) { '1' } else { '0' }).collect()
    };
    let (left, right) = (bits(block.x0..block.x1, strips.columns()), bits(block.y0..block.y1, strips.rows()));
    format!("{left} - {right}")
}

fn rects(table: &Table) -> Vec<Rect> {
    let edge = |name| table.numbers(name).unwrap();
    (0..table.len())
        .map(|i| ["x0", "y0", "x1", "y1"].map(|name| edge(name)[i].unwrap()))
        .map(|[x0, y0, x1, y1]| Rect::new(x0, y0, x1, y1))
        .collect()
}

#[test]
fn table_2_prime_areas_and_bridges() {
    let world = environment();
    let (strips, areas) = prime_areas(&world);
    let mut found: Vec<_> = areas.iter().map(|&area| strings(&strips, strips.rect(area))).collect();
    found.sort();
    let table_2 = [
        "00001 - 11111",
        "00100 - 11111",
        "00111 - 11000",
        "10000 - 11111",
        "11100 - 00011",
        "11111 - 00001",
        "11111 - 10000",
    ];
    assert_eq!(found, table_2);
    let bridges: Vec<_> = world.bridges.iter().map(|bridge| strings(&strips, bridge.rect)).collect();
    assert_eq!(bridges, ["01000 - 10000", "00100 - 00100"]);
}

#[test]
fn table_2_as_facts() {
    let facts = PrimeAreas.facts(&environment(), &Facts::new()).unwrap();
    assert_eq!(facts["STRIPS"].len(), 10);
    let areas = &facts["PRIME_AREAS"];
    let first = |name: &str| areas.numbers(name).unwrap()[0].unwrap();
    let names = ["area", "width", "left_first", "left_last", "right_first", "right_last"];
    assert_eq!(names.map(first), [1.0, 19.1, 0.0, 0.0, 0.0, 4.0]);
}

#[test]
fn table_3_rooms_in_order() {
    let world = environment();
    let strips = Strips::of_world(&world);
    let facts = PaperRooms.facts(&world, &known(&world)).unwrap();
    let rooms = &facts["ROOMS"];
    let names = rooms.texts("name").unwrap().iter().flatten().cloned().collect::<Vec<_>>();
    assert_eq!(names, ["a", "b", "c", "d", "e", "f", "g"]);
    let found: Vec<_> = rects(rooms).into_iter().map(|room| strings(&strips, room)).collect();
    let table_3 = [
        "01000 - 10000",
        "00100 - 00100",
        "00001 - 11111",
        "11100 - 00011",
        "00110 - 11000",
        "10000 - 11100",
        "00010 - 00001",
    ];
    assert_eq!(found, table_3);
    assert_eq!(rooms.numbers("height").unwrap()[..3], [Some(4.0), Some(15.0), None]);
    let widths: Vec<_> = rooms.numbers("width").unwrap().iter().flatten().copied().collect();
    for (width, golden) in widths.into_iter().zip([6.0, 6.9, 31.0, 24.6, 9.6, 16.5, 7.1]) {
        assert!((width - golden).abs() < 1e-9, "{width} is not {golden}");
    }
}

#[test]
fn the_doors_of_figure_7() {
    let world = environment();
    let facts = PaperRooms.facts(&world, &known(&world)).unwrap();
    let doors = &facts["DOORS"];
    // room1, room2, width, distance1, distance2
    let golden = [
        [1.0, 5.0, 6.0, 5.2, 16.697_305],
        [1.0, 6.0, 6.0, 5.2, 10.897_936],
        [2.0, 4.0, 15.2, 3.45, 19.205_533],
        [2.0, 5.0, 15.2, 3.45, 10.2],
        [3.0, 5.0, 9.6, 22.097_794, 16.6],
        [3.0, 7.0, 7.1, 23.005_434, 9.0],
        [4.0, 6.0, 19.1, 17.751_901, 8.25],
        [4.0, 7.0, 7.1, 24.001_771, 9.0],
    ];
    assert_eq!(doors.len(), golden.len());
    for (name, column) in ["room1", "room2", "width", "distance1", "distance2"].into_iter().zip(0..) {
        for (door, row) in golden.iter().enumerate() {
            let value = doors.numbers(name).unwrap()[door].unwrap();
            assert!((value - row[column]).abs() < 1e-6, "{name} of door {}: {value}", door + 1);
        }
    }
    let door_1 = |name: &str| doors.numbers(name).unwrap()[0];
    assert_eq!(
        ["x", "y", "x0", "y0", "x1", "y1"].map(|name| door_1(name).unwrap()),
        [29.5, 3.0, 29.5, 0.0, 29.5, 6.0]
    );
    assert_eq!((door_1("height1"), door_1("height2")), (Some(4.0), None));
}

#[test]
fn seven_rooms_are_the_fewest_here() {
    let world = environment();
    let facts = MinimumRooms.facts(&world, &known(&world)).unwrap();
    assert_eq!(facts["ROOMS"].len(), 7);
}

#[test]
fn an_undecided_area_is_an_error_that_names_it() {
    let world = environment();
    let mut known = known(&world);
    let open = (0..7).map(|i| (i != 4).then_some(true)).collect();
    let columns = &mut known.get_mut("PRIME_AREAS").unwrap().columns;
    *columns.last_mut().unwrap() = ("open".to_owned(), Column::Truth(open));
    let error = PaperRooms.facts(&world, &known).unwrap_err();
    assert_eq!(
        error.to_string(),
        "planner `rooms of the paper`: PRIME_AREAS: property `open` of object 5 of 7 is unknown"
    );
}

#[test]
fn undecided_bridges_are_an_error() {
    let world = environment();
    let undecided = Bridges.facts(&world, &Facts::new()).unwrap();
    for (known, what) in [(undecided, "property `low` is missing"), (Facts::new(), "the class is missing")] {
        let error = MinimumRooms.facts(&world, &known).unwrap_err();
        assert!(
            matches!(&error, PlannerError::Fact { class, what: found, .. }
            if class == "BRIDGES" && found == what),
            "{error}"
        );
    }
}

#[test]
fn every_property_that_is_given_was_promised() {
    let world = environment();
    let known = known(&world);
    let planners: [&dyn Planner; 4] = [&PrimeAreas, &Bridges, &PaperRooms, &MinimumRooms];
    for planner in planners {
        let facts = planner.facts(&world, &known).unwrap();
        let given = facts.iter().flat_map(|(class, table)| {
            table.columns.iter().map(move |(property, _)| format!("{class}.{property}"))
        });
        let (mut given, mut promised): (Vec<String>, Vec<String>) =
            (given.collect(), planner.signature().gives);
        // a promise names the type, too, where that is not a number
        for promise in &mut promised {
            promise.truncate(promise.find(':').unwrap_or(promise.len()));
        }
        given.sort();
        promised.sort();
        assert_eq!(given, promised, "{}", planner.name());
    }
}
