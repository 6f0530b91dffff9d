//! Lee's Figures 5 and 8.

use adit_planners::channels::assembly::{Assembly, Cuboid, Decision, Margin};
use adit_planners::channels::corridor::{
    Axis, Corridors, Extreme, Offset, Part, Robot, Steer, StepFacts, Turn,
};
use adit_planners::geometry::{Point, Rect};

use super::keep;
use crate::draw::{ChannelPanel, render_channels};

fn section_4() -> Assembly<2> {
    let channels = vec![
        Cuboid::new([1.0, 2.0], [5.0, 7.0]),
        Cuboid::new([1.0, 2.0], [7.0, 6.0]),
        Cuboid::new([4.0, 1.0], [7.0, 6.0]),
    ];
    Assembly::new(channels, Cuboid::new([4.5, 1.01], [6.99, 4.0])).expect("section 4 is a chain")
}

/// At junction 2 rule 1 of Table 1, at junction 1 rule 3. Without a gap: the safest.
fn way_out(gap: Option<f64>, displacement: Option<[f64; 2]>) -> ChannelPanel {
    let assembly = section_4();
    let decide = |facts: &adit_planners::channels::assembly::StepFacts<2>| {
        let margin = if facts.number == 2 { [Margin::Low; 2] } else { [Margin::High; 2] };
        Ok::<_, String>(Decision { rule: None, gap: gap.map_or(facts.bound, |gap| [gap; 2]), margin })
    };
    let path = assembly.disassemble(displacement, decide).expect("a way within the bounds");
    let name = gap.map_or_else(|| "safest gaps".to_owned(), |gap| format!("gap_x = gap_z = {gap}"));
    ChannelPanel::assembly(&name, &assembly, &path, [0, 1])
}

#[test]
fn figure_5_shows_the_part_at_each_waypoint_for_each_gap() {
    let panels = [Some(0.01), Some(0.2), None].map(|gap| way_out(gap, None));
    let svg = render_channels("Disassembly path for different clearance gaps", &panels);
    keep("lee-figure-5", &svg);
    for caption in [
        "a) gap_x = gap_z = 0.01",
        "c) safest gaps",
        "length 7.403 m",
        "clearance 0.010 m; without leg 1: 0.200 m",
    ] {
        assert!(svg.contains(caption), "{caption}");
    }
    // The part at four waypoints in each panel, the last one dashed; two junctions dashed otherwise.
    assert_eq!(svg.matches("fill-opacity=\"0.28\"").count(), 3);
    assert_eq!(svg.matches("fill-opacity=\"0.07\"").count(), 9);
    assert_eq!(svg.matches("stroke-dasharray=\"5 4\"").count(), 6);
}

#[test]
fn what_follows_outside_is_within_the_picture() {
    let svg = render_channels("To the final displacement (2, 7)", &[way_out(Some(0.2), Some([2.0, 7.0]))]);
    keep("lee-section-4-outside", &svg);
    assert_eq!(svg.matches("fill-opacity=\"0.07\"").count(), 5);
}

fn cuboids_in_space() -> Assembly<3> {
    let channels = vec![
        Cuboid::new([0.0, 0.0, 0.0], [3.0, 3.0, 9.0]),
        Cuboid::new([0.0, 0.0, 0.0], [10.0, 3.0, 3.0]),
        Cuboid::new([7.0, 0.0, 0.0], [10.0, 12.0, 3.0]),
    ];
    Assembly::new(channels, Cuboid::new([7.5, 8.0, 0.5], [9.5, 10.0, 2.5])).expect("a pipe with two elbows")
}

#[test]
fn an_assembly_in_space_is_seen_from_the_front_and_from_above() {
    let assembly = cuboids_in_space();
    let decide = |facts: &adit_planners::channels::assembly::StepFacts<3>| {
        let mut margin = [Margin::Keep; 3];
        margin[facts.entering] = Margin::High;
        margin[facts.leaving] = if facts.leaving == 2 { Margin::High } else { Margin::Low };
        Ok::<_, String>(Decision { rule: None, gap: [0.25; 3], margin })
    };
    let path = assembly.disassemble(None, decide).expect("a way within the bounds");
    let panels = [("from the front", [0, 2]), ("from above", [0, 1])]
        .map(|(name, axes)| ChannelPanel::assembly(name, &assembly, &path, axes));
    let svg = render_channels("A pipe with two elbows", &panels);
    keep("two-elbows", &svg);
    assert_eq!(svg.matches(">J2</text>").count(), 2);
}

/// Table 2 where the robot comes up or to the right: rules 1, 5 and 7.
fn table_2(facts: &StepFacts, gap: f64) -> Steer {
    let plus = |part| Offset { is_negative: false, part };
    let minus = |part| Offset { is_negative: true, part };
    let (rule, corner, turn, arriving) = if facts.entering == Axis::Y {
        (1, (Extreme::Max, Extreme::Min), Turn::Right, (minus(Part::Cos), plus(Part::Sin)))
    } else if facts.next.y > facts.rect.centre().y {
        (5, (Extreme::Min, Extreme::Max), Turn::Left, (plus(Part::Sin), minus(Part::Cos)))
    } else {
        (7, (Extreme::Min, Extreme::Min), Turn::Right, (plus(Part::Sin), plus(Part::Cos)))
    };
    Steer { rule: Some(rule), corner, turn, gap, arriving, measured_along: facts.entering.across() }
}

#[test]
fn figure_8_shows_the_robot_along_its_way_for_each_gap() {
    let robot = Robot { width: 1.0, length: 1.5 };
    let mut panels = Vec::new();
    for (last, goal) in [
        (Rect::new(9.0, 0.0, 12.0, 9.0), Point::new(10.5, 2.0)),
        (Rect::new(9.0, 6.0, 12.0, 18.0), Point::new(10.5, 16.0)),
    ] {
        let channels = [Rect::new(0.0, 0.0, 3.0, 9.0), Rect::new(0.0, 6.0, 12.0, 9.0), last];
        let corridors = Corridors::new(&channels).expect("three corridors");
        let start = Point::new(1.5, 2.0);
        let route = corridors.route(start, goal, |passage| Ok::<_, String>(Some(passage.length)));
        let route = route.expect("they meet");
        for gap in [0.2, 0.6, 1.0] {
            let drive = route
                .drive(robot, None, |facts| Ok::<_, String>(table_2(facts, gap)))
                .expect("no wall is hit");
            panels.push(ChannelPanel::drive(&format!("gap_r = {gap}"), &corridors, robot, &drive));
        }
    }
    let svg = render_channels("Mobile robot paths with different clearance gaps", &panels);
    keep("lee-figure-8", &svg);
    assert!(svg.contains("d) gap_r = 0.2"));
    // A guiding circle for each corner.
    assert_eq!(svg.matches("stroke-dasharray=\"4 3\"").count(), 12);
}
