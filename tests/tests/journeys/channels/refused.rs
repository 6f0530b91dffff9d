//! What cannot be: said with file, line and numbers.

use super::support::{S, SECTION_4, maps, on, route_of, with_gap};

#[track_caller]
fn unusable(text: &str, wanted: &[&str]) {
    let ran = route_of(text, &[]).expect_status(2);
    ran.complains(&["map.toml:"]);
    ran.complains(wanted);
}

#[track_caller]
fn no_route(text: &str, wanted: &[&str]) {
    let ran = route_of(text, &[]).expect_status(1);
    for wanted in wanted {
        assert!(ran.stdout.contains(wanted), "no `{wanted}` in:\n{}", ran.stdout);
    }
}

#[test]
fn channels_that_do_not_meet() {
    let apart = SECTION_4.replace("[1, 2, 7, 6]", "[1, 2, 3, 6]");
    unusable(&apart, &["channel 2 [1, 2, 3, 6] and channel 3 [4, 1, 7, 6] do not overlap", ":3:"]);
    no_route(
        &S.replace("[0, 6, 12, 9]", "[4, 6, 12, 9]"),
        &["the start is in channel 1", "channels 1 and 2 are nearest, 1 m apart"],
    );
}

#[test]
fn neighbours_that_are_not_orthogonal() {
    unusable(
        &SECTION_4.replace("[1, 2, 7, 6]", "[4, 0, 8, 3.5]"),
        &["channel 1 [1, 2, 5, 7] and channel 2 [4, 0, 8, 3.5]"],
    );
    unusable(
        &S.replace("[0, 6, 12, 9]", "[2, 8, 12, 11]").replace("[9, 6, 12, 18]", "[9, 8, 12, 18]"),
        &["channels 1 and 2 overlap, but are not orthogonal: they overlap at a corner only"],
    );
}

#[test]
fn a_part_larger_than_a_junction() {
    no_route(
        &with_gap(
            &SECTION_4.replace("[1, 2, 7, 6]", "[1, 2, 7, 4.5]").replace("[4, 1, 7, 6]", "[4, 1, 7, 4.5]"),
            "0.01",
        ),
        &["junction 2 is 3 x 2.5, and must be larger than the part, which is 2.49 x 2.99"],
    );
}

#[test]
fn a_robot_wider_than_a_corridor() {
    no_route(
        &S.replace("width = 1.0", "width = 3.5"),
        &["channel 1 from the start to junction 1", "channel 1 is 3 wide, and the robot 3.5"],
    );
}

#[test]
fn a_move_towards_minus_z() {
    // Up the shaft, over into the next one, down again.
    let pass = "[assembly]\ngap = 0.1\nmale = [[15, 6], [16, 6], [16, 7], [15, 7]]\n\
                channels = [[0, 0, 3, 9], [0, 0, 10, 3], [7, 0, 10, 8], [7, 5, 17, 8]]\n";
    no_route(
        pass,
        &["after junction 3, which reaches up to z = 8", "junction 2, which ends at z = 3", "(3.2)"],
    );
}

#[test]
fn a_gap_beyond_the_bound() {
    no_route(
        &with_gap(SECTION_4, "0.26"),
        &["the gap in x at junction 2 is 0.26, and at most 0.255 is possible"],
    );
    unusable(&with_gap(SECTION_4, "-0.1"), &["`gap` is -0.1, and a gap is what is left free"]);
}

#[test]
fn a_part_that_lies_elsewhere_or_crosses_itself() {
    let crossing = SECTION_4.replace("[6.99, 4.0], [6.99, 1.01]", "[6.99, 1.01], [6.99, 4.0]");
    unusable(&crossing, &["corner 2", ":4:"]);
    let outside = SECTION_4.replace("4.5, 1.01", "3.5, 1.01").replace("4.5, 4.0", "3.5, 4.0");
    unusable(&outside, &["sticks out of channel 3 [4, 1, 7, 6], the last one, by 0.5"]);
}

#[test]
fn a_female_part_that_no_channels_model() {
    let male = "male = [[4.5, 1.01], [4.5, 4.0], [6.99, 4.0], [6.99, 1.01]]\ngap = 0.1\n";
    let solid = format!("[assembly]\n{male}female = [[0, 0], [8, 0], [8, 7], [0, 7]]\n");
    unusable(&solid, &["the part [4.5, 1.01, 6.99, 4] and the female part overlap"]);
    let crossing = format!("[assembly]\n{male}female = [[0, 0], [8, 7], [0, 7], [8, 0]]\n");
    unusable(&crossing, &["edge"]);
}

#[test]
fn files_that_are_no_maps_of_channels() {
    for (text, wanted) in [
        ("[assembly]\nchanels = []\n", "did you mean `channels`?"),
        (
            "[assembly]\nchannels = [[1, 2, 5]]\nmale = [[0, 0], [1, 0], [1, 1]]\n",
            "expected [x0, z0, x1, z1]",
        ),
        ("[corridor]\nchannels = [[0, 0, 3, 9]]\nstart = [1, 1]\ngoal = [2, 2]\n", "needs a `robot`"),
        (
            "[corridor]\nchannels = [[0, 0, 3, 9]]\nstart = [5, 1]\ngoal = [2, 2]\nrobot = { width = 1, length = 1 }\n",
            "the start (5, 1) lies in no channel",
        ),
        (
            "[corridor]\nchannels = [[0, 0, 3, 9]]\nstart = [1, 1]\ngoal = [2, 2]\nrobot = { width = 0, length = 1 }\n",
            "`width` is 0 and must be more than 0",
        ),
        ("[assembly]\nchannels = [[1, 2, 5, nan]]\nmale = [[0, 0], [1, 0], [1, 1]]\n", "finite"),
        ("[assembly]\nchannels = [[1, 2, 5, 7]]\nmale = [[2, 3], [3, 3], [3, 4]]\ngap = \"wide\"\n", "`gap`"),
        (
            "[assembly]\nchannels = [[1, 2, 5, 7]]\nmale = [[2, 3], [3, 3], [3, 4]]\nmoves = \"both\"\n",
            "expected \"male\" or \"female\"",
        ),
    ] {
        unusable(text, &[wanted]);
    }
    for (text, wanted) in [
        ("", "no map of corridors, parts, walls or a cell"),
        ("[assembly]\n[corridor]\n", "one map has one of them"),
    ] {
        let folder = maps().with("map.toml", text);
        on(&folder, &["route", "map.toml", "start", "goal"]).expect_status(2).complains(&[wanted]);
    }
    route_of(&format!("rules = \"nowhere\"\n{SECTION_4}"), &[]).expect_status(2).complains(&["nowhere"]);
    route_of(SECTION_4, &["--rules", "nowhere"]).expect_status(2).complains(&["nowhere"]);
}
