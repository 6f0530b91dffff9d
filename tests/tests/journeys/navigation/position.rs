//! A robot knows where it is, with the rules that ship.

use super::flat::{flat, run};

#[test]
fn over_200_metres_the_pose_stays_within_5_cm_and_1_degree_while_dead_reckoning_is_metres_off() {
    let folder = flat();
    let drives =
        run(&folder, "simulate", &["--curve", "curve.svg", "--missions", "2", "--seed", "20000", "--json"]);
    let drives = drives.expect_status(0).json();
    let drives = drives.as_array().expect("a row a drive");
    assert_eq!(drives.len(), 4, "two with the walls known, two with a model built on the way");
    let mut reckoned = 0.0;
    for drive in drives {
        let figure = |key: &str| drive[key].as_f64().unwrap_or_else(|| panic!("{key} of {drive}"));
        assert!(figure("length") >= 200.0, "{drive}");
        assert!(figure("error") < 0.05 && figure("heading_error") < 1.0, "{drive}");
        reckoned += figure("worst_reckoned_error") / drives.len() as f64;
    }
    assert!(reckoned > 1.5, "{reckoned}");
    let picture = folder.read("curve.svg");
    for said in
        ["position, walls known", "heading, model built on the way", "estimated pose", "dead reckoning"]
    {
        assert!(picture.contains(said), "{said}");
    }
    let full = picture.matches("stroke=\"#17365D\" stroke-width=\"2\"").count();
    assert!(full >= 8, "position and heading of each drive: {full}");
}

#[test]
fn a_drive_that_cannot_be_is_refused() {
    let folder = flat();
    let refused = |args: &[&str]| run(&folder, "simulate", args).expect_status(2);
    refused(&["--curve", "curve.gif"]).complains(&["neither .svg nor .png"]);
    for metres in ["nan", "inf", "-1", "0", "1e300"] {
        refused(&["--curve", "curve.svg", "--metres", metres])
            .complains(&["is no distance; expected more than 0"]);
    }
}
