//! Parts that leave through channels: Lee's section 4 and three other assemblies, number by number.

#![allow(clippy::float_cmp, reason = "sums of few binary digits are exact")]

mod chains;
mod female_parts;
mod oracle;
mod random_chains;
mod refusals;
mod table1;

use adit_planners::channels::assembly::{
    Assembly, Cuboid, Decision, Margin, PartPath, PathError, StepFacts, bounding_box, channels_of,
};
use serde_json::Value;

use table1::{table_for_any_dimension, table1};

const FEMALE: [[f64; 2]; 12] = [
    [0.0, 0.0],
    [0.0, 7.0],
    [1.0, 7.0],
    [1.0, 2.0],
    [4.0, 2.0],
    [4.0, 1.0],
    [7.0, 1.0],
    [7.0, 6.0],
    [5.0, 6.0],
    [5.0, 7.0],
    [8.0, 7.0],
    [8.0, 0.0],
];
const MALE: [[f64; 2]; 4] = [[4.5, 1.01], [4.5, 4.0], [6.99, 4.0], [6.99, 1.01]];

fn section_4() -> Assembly<2> {
    let part = bounding_box(&MALE).unwrap();
    Assembly::new(channels_of(&FEMALE, &part).unwrap(), part).unwrap()
}

fn with_gap(assembly: &Assembly<2>, gap: f64) -> PartPath<2> {
    assembly.disassemble(None, |facts| table1(facts, [gap; 2])).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

fn rows(value: &Value) -> Vec<Vec<f64>> {
    value.as_array().unwrap().iter().map(numbers).collect()
}

fn cuboids(value: &Value) -> Vec<Cuboid<2>> {
    rows(value).iter().map(|row| Cuboid::new([row[0], row[1]], [row[2], row[3]])).collect()
}

fn assert_close(what: &str, found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{what}: {found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-5, "{what}: {found} is not {expected}");
    }
}

#[test]
fn table_1_takes_parts_out_as_verified_numbers_say() {
    let golden: Value = serde_json::from_str(include_str!("../golden/assembly.json")).unwrap();
    let mut paths = 0;
    for case in golden["cases"].as_array().unwrap() {
        let part = &case["part"];
        let part = Cuboid::new(
            [part[0].as_f64().unwrap(), part[1].as_f64().unwrap()],
            [part[2].as_f64().unwrap(), part[3].as_f64().unwrap()],
        );
        let assembly = Assembly::new(cuboids(&case["channels"]), part).unwrap();
        assert_eq!(assembly.junctions(), cuboids(&case["junctions"]));
        for expected in case["paths"].as_array().unwrap() {
            let name = format!("{}, gap {}", case["name"], expected["gap"]);
            let mut gaps = Vec::new();
            let decide = |facts: &StepFacts<2>| {
                let given = &expected["gap"];
                let gap = if given.is_null() { facts.bound } else { [numbers(given)[0], numbers(given)[1]] };
                gaps.push(gap);
                table1(facts, gap)
            };
            let path = assembly.disassemble(None, decide).unwrap();
            let rules: Vec<Option<f64>> = path.legs.iter().map(|leg| leg.rule).collect();
            let rules_expected: Vec<Option<f64>> =
                expected["rules"].as_array().unwrap().iter().map(Value::as_f64).collect();
            assert_eq!(rules, rules_expected, "{name}");
            let junctions: Vec<usize> = path.legs.iter().map(|leg| leg.junction).collect();
            assert_eq!(junctions, (0..path.legs.len()).rev().collect::<Vec<_>>(), "{name}");
            for (gap, expected) in gaps.iter().zip(rows(&expected["gaps"])) {
                assert_close(&name, gap, &expected);
            }
            for (leg, expected) in path.legs.iter().zip(rows(&expected["displacements"])) {
                assert_close(&name, &leg.displacement, &expected);
            }
            for (waypoint, expected) in path.waypoints.iter().zip(rows(&expected["waypoints"])) {
                assert_close(&name, waypoint, &expected);
            }
            assert_close(&name, &[path.length], &[expected["length"].as_f64().unwrap()]);
            assert_close(&name, &path.clearances, &numbers(&expected["clearances"]));
            let least = path.legs.iter().map(|leg| leg.min_clearance).fold(f64::INFINITY, f64::min);
            assert_eq!(path.min_clearance.to_bits(), least.to_bits(), "{name}");
            // The verified numbers look at 401 places of each leg; between them it may be nearer by a little.
            for ((leg, start), expected) in
                path.legs.iter().zip(&path.waypoints).zip(numbers(&expected["leg_clearances_at_401_places"]))
            {
                let at = |step: i32| {
                    let moved = leg.displacement.map(|by| by * f64::from(step) / 400.0);
                    let size = [part.size(0), part.size(1)];
                    let there = Cuboid::new(*start, [start[0] + size[0], start[1] + size[1]]);
                    assembly.clearance(&there.moved(&moved))
                };
                assert_close(&name, &[(0..=400).map(at).fold(f64::INFINITY, f64::min)], &[expected]);
                assert!(leg.min_clearance < expected + 1e-6, "{name}: {}", leg.min_clearance);
                let half_a_step = leg.displacement[0].hypot(leg.displacement[1]) / 800.0;
                assert!(leg.min_clearance > expected - half_a_step - 1e-6, "{name}: {}", leg.min_clearance);
            }
            paths += 1;
        }
    }
    assert_eq!(paths, 12);
}

#[test]
fn the_channels_of_section_4_are_found_from_the_outline() {
    let expected = [[1.0, 2.0, 5.0, 7.0], [1.0, 2.0, 7.0, 6.0], [4.0, 1.0, 7.0, 6.0]];
    let expected = expected.map(|[x0, z0, x1, z1]| Cuboid::new([x0, z0], [x1, z1]));
    assert_eq!(section_4().channels(), expected);
    let other_sense: Vec<_> = FEMALE.into_iter().rev().collect();
    assert_eq!(channels_of(&other_sense, &section_4().part()).unwrap(), expected);
}

#[test]
fn what_is_told_at_a_junction_is_what_table_1_asks() {
    let mut told = Vec::new();
    let assembly = section_4();
    assembly
        .disassemble(None, |facts| {
            told.push(*facts);
            table1(facts, [0.01; 2])
        })
        .unwrap();
    let [inner, mouth] = told[..] else { panic!("two junctions: {told:?}") };
    assert_eq!((inner.number, inner.junction), (2, Cuboid::new([4.0, 2.0], [7.0, 6.0])));
    assert_eq!((inner.entering, inner.leaving), (1, 0));
    assert_eq!(inner.next, Some(Cuboid::new([1.0, 2.0], [5.0, 6.0])));
    assert_close("bound", &inner.bound, &[0.255, 0.505]);
    assert!(inner.next_is_not_lower);
    assert_eq!((mouth.number, mouth.next), (1, None));
    assert_eq!((mouth.entering, mouth.leaving), (0, 1));
    assert_close("part", &mouth.part.min, &[4.01, 2.01]);
}

/// Section 4: f1 from (12, -6) to (14, 1). The part goes out, up to its final height, then across, so that
/// it is never nearer to the female part than at the mouth or where it ends.
#[test]
fn what_follows_outside_leads_to_the_final_displacement() {
    let assembly = section_4();
    let path = assembly.disassemble(Some([2.0, 7.0]), |facts| table1(facts, [0.2; 2])).unwrap();
    let outside: Vec<[f64; 2]> = path.waypoints[3..].to_vec();
    for (found, expected) in outside.iter().zip([[2.31, 7.0], [2.31, 8.01], [6.5, 8.01]]) {
        assert_close("outside", found, &expected);
    }
    assert_eq!(outside.len(), 3);
    let last = path.legs.last().unwrap();
    assert_eq!((last.junction, last.rule), (0, None));
    assert_close("clearance above the walls", &[last.min_clearance], &[1.01]);
    let refused = assembly.disassemble(Some([2.0, 5.0]), |facts| table1(facts, [0.2; 2])).unwrap_err();
    assert_eq!(refused, PathError::NotOut { height: 6.01, top: 7.0 });
}

#[test]
fn the_way_in_is_the_way_out_reversed() {
    let path = with_gap(&section_4(), 0.2);
    let back = path.reversed();
    let mut waypoints = path.waypoints.clone();
    waypoints.reverse();
    assert_eq!(back.waypoints, waypoints);
    assert_eq!(back.legs[0].displacement, [0.0, -path.legs[2].displacement[1]]);
    assert_eq!((back.length, back.min_clearance), (path.length, path.min_clearance));
    assert_eq!(back.reversed(), path);
}

/// (4, 2) and (2.51, 3.01) are the corners that a point would be pulled taut about: 6.899 is the least.
#[test]
fn a_small_gap_is_nearly_the_shortest_way() {
    let least = 6.899;
    let length = with_gap(&section_4(), 0.01).length;
    assert!(least < length && length < 1.003 * least, "{length}");
}

#[test]
fn a_gap_beyond_the_bound_that_sends_the_part_into_a_wall_is_refused_with_place_and_wall() {
    let assembly = section_4();
    let refused = assembly.disassemble(None, |facts| table1(facts, [0.6; 2])).unwrap_err();
    let PathError::Collides { junction, part, wall } = &refused else { panic!("{refused}") };
    assert_eq!((*junction, wall.min[0]), (2, 7.0));
    assert!((part.max[0] - 7.0).abs() < 1e-6, "{part}");
    let text = refused.to_string();
    assert!(text.starts_with("on its way to junction 2 the part hits the wall [7, "), "{text}");
    let nan = assembly.disassemble(None, |facts| table1(facts, [0.1, f64::NAN])).unwrap_err();
    assert_eq!(
        nan.to_string(),
        "at junction 2 the gap along axis 1 is NaN; expected a finite number of metres"
    );
    let undecided = assembly.disassemble(None, |_| Err("no rule fires")).unwrap_err();
    assert_eq!(undecided, PathError::Undecided { junction: 2, reason: "no rule fires" });
}

#[test]
fn walls_are_all_that_is_not_channel_with_a_ring_around_and_an_open_top() {
    let walls = section_4().walls(2.0);
    let area: f64 = walls.iter().map(|wall| wall.size(0) * wall.size(1)).sum();
    // The frame is 10 by 8 below the mouth; channels have 20 + (24 - 16) + (15 - 12) in all.
    assert!((area - (80.0 - 31.0)).abs() < 1e-9, "{area}: {walls:?}");
    assert!(walls.iter().all(|wall| wall.max[1] <= 7.0));
    for (index, wall) in walls.iter().enumerate() {
        assert!(walls[..index].iter().all(|other| wall.intersection(other).is_none()));
    }
}

#[test]
fn a_part_that_keeps_its_place_moves_only_as_far_as_the_gap_asks() {
    let junction = Cuboid::new([0.0, 0.0], [10.0, 10.0]);
    let decision = |gap| Decision { rule: None, gap: [gap, gap], margin: [Margin::Keep, Margin::Keep] };
    let part = Cuboid::new([4.0, 7.5], [6.0, 9.5]);
    assert_eq!(decision(0.1).target(&junction, &part), [4.0, 7.5]);
    assert_eq!(decision(1.0).target(&junction, &part), [4.0, 7.0]);
    assert_eq!(decision(4.0).target(&junction, &part), [4.0, 4.0]);
}

/// The corner of the step, (4, 2), passes the lower left corner of the part, which starts 0.01 beside and above
/// it and moves by (-1.51, 0.99): the foot of the perpendicular, not a place of some grid.
#[test]
fn the_least_clearance_is_that_of_the_line_itself() {
    let path = with_gap(&section_4(), 0.01);
    let exact = (0.01 * 0.99 + 0.01 * 1.51) / f64::hypot(1.51, 0.99);
    assert!((path.legs[1].min_clearance - exact).abs() < 1e-12, "{}", path.legs[1].min_clearance);
}

/// A pipe with two elbows: up, to the right, and away along y.
#[test]
fn three_dimensions_need_no_other_code() {
    let channels = vec![
        Cuboid::new([0.0, 0.0, 0.0], [3.0, 3.0, 9.0]),
        Cuboid::new([0.0, 0.0, 0.0], [10.0, 3.0, 3.0]),
        Cuboid::new([7.0, 0.0, 0.0], [10.0, 12.0, 3.0]),
    ];
    let part = Cuboid::new([7.5, 8.0, 0.5], [9.5, 10.0, 2.5]);
    let assembly = Assembly::new(channels, part).unwrap();
    assert_eq!(assembly.axes(), [2, 0, 1]);
    let path = assembly.disassemble(None, |facts| table_for_any_dimension(facts, [0.25; 3])).unwrap();
    let expected = [[7.5, 8.0, 0.5], [7.25, 0.75, 0.5], [0.75, 0.75, 0.75], [0.75, 0.75, 9.0]];
    assert_eq!(path.waypoints, expected);
    // At the inner elbow the nearest wall is the edge between the two passages.
    assert_close("clearances", &path.clearances, &[0.5, 0.125_f64.sqrt(), 0.25, 0.25]);
    assert_eq!(path.min_clearance, 0.25);
}
