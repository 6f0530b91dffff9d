//! Maps of ROS: what they mean, and what is said about bad ones.

use std::fs;
use std::path::PathBuf;

use adit_planners::geometry::{Point, Rect};
use adit_planners::read::diagnostic::MapErrors;
use adit_planners::read::{MapReport, MapSettings, Overlay, Unknown, read_map};
use adit_planners::world::World;
use miette::Diagnostic;
use tempfile::TempDir;

const YAML: &str = "image: map.pgm\nresolution: 0.5\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\n\
                    occupied_thresh: 0.65\nfree_thresh: 0.196\n";
/// White, unknown grey and black; the first row is the upper one.
const PGM: &str = "P2\n# a plain one\n4 3\n255\n0 0 0 0\n254 254 205 0\n254 0 254 254\n";

struct Folder(TempDir);

impl Folder {
    fn new(yaml: &str, image: impl AsRef<[u8]>) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("map.yaml"), yaml).unwrap();
        fs::write(folder.path().join("map.pgm"), image).unwrap();
        Self(folder)
    }

    fn map(&self) -> PathBuf {
        self.0.path().join("map.yaml")
    }

    fn read(&self, settings: &MapSettings) -> Result<(World, MapReport), MapErrors> {
        read_map(&self.map(), settings)
    }
}

/// Code, marked text and message of the only problem.
fn refused(yaml: &str, image: impl AsRef<[u8]>) -> (&'static str, String, String) {
    let folder = Folder::new(yaml, image);
    let problems = folder.read(&MapSettings::default()).unwrap_err().problems;
    assert_eq!(problems.len(), 1, "{problems:?}");
    let label = problems[0].labels().and_then(|mut labels| labels.next());
    let marked = label.map_or(String::new(), |l| yaml[l.offset()..l.offset() + l.len()].to_owned());
    (problems[0].code.as_str(), marked, problems[0].message.clone())
}

fn with(key: &str, value: &str) -> String {
    let line = |line: &str| {
        if line.starts_with(key) { format!("{key}: {value}\n") } else { format!("{line}\n") }
    };
    YAML.lines().map(line).collect()
}

fn is_about(value: f64, expected: f64) -> bool {
    (value - expected).abs() < 1e-9
}

#[test]
fn the_last_row_of_the_image_is_the_lowest_and_the_origin_its_corner() {
    let (world, _) = Folder::new(YAML, PGM).read(&MapSettings::default()).unwrap();
    assert_eq!(world.bounds, Rect::new(-1.0, 2.0, 1.0, 3.5));
    let walls = world.occupancy.unwrap();
    let rows: Vec<Vec<bool>> =
        (0..3).map(|row| (0..4).map(|column| walls.is_blocked(column, row)).collect()).collect();
    let expected =
        [vec![false, true, false, false], vec![false, false, true, true], vec![true, true, true, true]];
    assert_eq!(rows, expected);
}

#[test]
fn the_report_says_what_each_step_gave_and_cost() {
    let folder = Folder::new(YAML, PGM);
    let report = folder.read(&MapSettings::default()).unwrap().1;
    assert!(is_about(report.free_in_file, 5.0 * 0.25) && is_about(report.unknown_in_file, 0.25));
    assert!(is_about(report.unknown, 0.0) && is_about(report.specks, 0.0));
    let settings = MapSettings { unknown: Unknown::Free, ..MapSettings::default() };
    let report = folder.read(&settings).unwrap().1;
    assert!(is_about(report.unknown, 0.25) && report.straightened <= 1e-5);
    assert!(is_about(report.free, 1.5 + report.straightened), "{report:?}");
    let clear = MapSettings { clearance: 0.25, unknown: Unknown::Free, ..MapSettings::default() };
    let report = folder.read(&clear).unwrap().1;
    let hardly = report.clearance < -1.0 && (0.0..0.01).contains(&report.free);
    assert!(hardly, "hardly a point is clear of both walls: {report:?}");
}

#[test]
fn the_frame_turns_about_the_corner_of_the_image() {
    let (world, _) = Folder::new(YAML, PGM).read(&MapSettings::default()).unwrap();
    assert!(
        is_about(world.frame.at.x, 0.0)
            && is_about(world.frame.at.y, 0.0)
            && is_about(world.frame.heading, 0.0)
    );
    let turned = with("origin", "[-1.0, 2.0, 1.5707963267948966]");
    let (world, _) = Folder::new(&turned, PGM).read(&MapSettings::default()).unwrap();
    let (sin, cos) = world.frame.heading.sin_cos();
    let ros = |p: Point| {
        Point::new(world.frame.at.x + cos * p.x - sin * p.y, world.frame.at.y + sin * p.x + cos * p.y)
    };
    let corner = ros(Point::new(-1.0, 2.0));
    assert!(corner.distance(Point::new(-1.0, 2.0)) < 1e-9, "the corner stays");
    let right = ros(Point::new(1.0, 2.0));
    assert!(right.distance(Point::new(-1.0, 4.0)) < 1e-9, "what was to its right is above");
}

#[test]
fn negate_may_be_a_number_or_a_truth_value() {
    let free = |negate: &str| {
        let report = Folder::new(&with("negate", negate), PGM).read(&MapSettings::default()).unwrap().1;
        report.free_in_file / 0.25
    };
    assert!(is_about(free("0"), 5.0) && is_about(free("false"), 5.0));
    assert!(is_about(free("1"), 6.0) && is_about(free("true"), 6.0));
    let wrong = Folder::new(&with("negate", "2"), PGM).read(&MapSettings::default()).unwrap_err().to_string();
    assert!(wrong.contains("`negate` must be 0 or 1, found 2"), "{wrong}");
}

#[test]
fn colours_are_averaged_and_raw_pgm_and_png_are_read_alike() {
    let plain = Folder::new(YAML, PGM).read(&MapSettings::default()).unwrap().0;
    let grey: Vec<u8> = vec![0, 0, 0, 0, 254, 254, 205, 0, 254, 0, 254, 254];
    let raw = [b"P5 4 3 255\n".to_vec(), grey.clone()].concat();
    assert_eq!(Folder::new(YAML, raw).read(&MapSettings::default()).unwrap().0, plain);
    let rgb = grey.iter().flat_map(|&v| [v, v, v]).collect();
    let folder = Folder::new(&with("image", "map.png"), PGM);
    let png = folder.0.path().join("map.png");
    image::RgbImage::from_vec(4, 3, rgb).unwrap().save(&png).unwrap();
    assert_eq!(folder.read(&MapSettings::default()).unwrap().0, plain);
    // nav2 averages alpha in: an opaque black is 255 / 4, still a wall.
    let rgba = grey.iter().flat_map(|&v| [v, v, v, 255]).collect();
    image::RgbaImage::from_vec(4, 3, rgba).unwrap().save(&png).unwrap();
    let walls = folder.read(&MapSettings::default()).unwrap().0.occupancy.unwrap();
    assert!(walls.is_blocked(0, 2) && !walls.is_blocked(0, 0));
}

#[test]
fn bad_values_are_marked() {
    let cases = [
        ("resolution", "0.0", "map/not-positive"),
        ("resolution", "-0.05", "map/not-positive"),
        ("resolution", ".nan", "map/not-finite"),
        ("occupied_thresh", "1.5", "map/thresholds"),
        ("free_thresh", "-0.1", "map/thresholds"),
        ("free_thresh", "0.9", "map/thresholds"),
    ];
    for (key, value, code) in cases {
        let found = refused(&with(key, value), PGM);
        assert_eq!((found.0, found.1.as_str()), (code, value), "{key}: {value}: {}", found.2);
    }
    assert_eq!(refused(&with("origin", "[1.0, 2.0]"), PGM).0, "map/wrong-type");
    assert_eq!(refused(&with("origin", "[1.0, .inf, 0.0]"), PGM).0, "map/not-finite");
    assert_eq!(refused(&(YAML.to_owned() + "mode: quaternary\n"), PGM).0, "map/mode");
    let (code, marked, message) = refused(&(YAML.to_owned() + "free_tresh: 0.2\n"), PGM);
    assert_eq!((code, marked.as_str()), ("map/unknown-key", "free_tresh"));
    assert_eq!(message, "`free_tresh` is not a key of a ROS map");
    assert_eq!(refused(&YAML.replace("resolution: 0.5\n", ""), PGM).0, "map/missing-key");
    assert_eq!(refused("image: [", PGM).0, "map/syntax");
}

#[test]
fn bad_images_are_refused_by_their_name() {
    let (code, marked, message) = refused(&with("image", "floor.pgm"), PGM);
    assert_eq!((code, marked.as_str()), ("map/image-missing", "floor.pgm"));
    assert_eq!(message, "the image `floor.pgm` is missing");
    let (code, _, message) = refused(YAML, "P5 4 3 65535\n000000000000000000000000");
    assert_eq!(code, "map/image-depth");
    assert_eq!(message, "the image `map.pgm` has 16 bits a channel; a map has 8");
    assert_eq!(refused(YAML, "P5 4 3 255\n0000000").0, "map/image-truncated");
    assert_eq!(refused(YAML, "P2 4 3 255\n0 0 0 0 0").0, "map/image-truncated");
    assert_eq!(refused(YAML, "P5 4").0, "map/image-truncated");
    assert_eq!(refused(YAML, "<svg></svg>").0, "map/not-an-image");
    assert_eq!(refused(YAML, "").0, "map/not-an-image");
    assert_eq!(refused(YAML, "P5 0 3 255\n").0, "map/not-an-image");
}

#[test]
fn a_huge_image_is_refused_from_its_header() {
    let (code, _, message) = refused(YAML, "P5 60000 60000 255\n");
    assert_eq!(code, "map/image-too-large");
    assert!(message.contains("60000 x 60000 pixels"), "{message}");
    let ihdr = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\xea\x60\0\0\xea\x60\x08\0\0\0\0".as_slice();
    let header = [ihdr, b"\xa5\xb9\x2a\x9e", b"\0\0\0\0IDAT\x35\xaf\x06\x1e"].concat();
    assert_eq!(refused(YAML, header).0, "map/image-too-large");
}

#[test]
fn a_truncated_png_is_refused() {
    let folder = Folder::new(&with("image", "map.png"), PGM);
    let png = folder.0.path().join("map.png");
    let noise: Vec<u8> = (0u32..64 * 64).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    image::GrayImage::from_vec(64, 64, noise).unwrap().save(&png).unwrap();
    let whole = fs::read(&png).unwrap();
    fs::write(&png, &whole[..whole.len() / 2]).unwrap();
    let problems = folder.read(&MapSettings::default()).unwrap_err().problems;
    assert_eq!(problems[0].code.as_str(), "map/image-truncated", "{}", problems[0].message);
}

#[test]
fn settings_and_files_that_make_no_sense_are_refused() {
    let folder = Folder::new(YAML, PGM);
    let code = |settings| folder.read(&settings).unwrap_err().problems[0].code.as_str();
    assert_eq!(code(MapSettings { grid: Some(0.0), ..MapSettings::default() }), "map/not-positive");
    assert_eq!(
        code(MapSettings { speck_area: Some(f64::NAN), ..MapSettings::default() }),
        "map/not-positive"
    );
    assert_eq!(code(MapSettings { clearance: -1.0, ..MapSettings::default() }), "map/not-positive");
    assert_eq!(code(MapSettings { grid: Some(1e-6), ..MapSettings::default() }), "map/grid-too-fine");
    let missing = |name: &str| {
        let error = read_map(&folder.0.path().join(name), &MapSettings::default()).unwrap_err();
        error.problems[0].code.as_str()
    };
    assert_eq!(missing("nowhere.yaml"), "map/unreadable");
    assert_eq!(missing("map.dwg"), "map/unknown-format");
}

#[test]
fn a_place_on_a_wall_of_the_image_is_refused() {
    let (mut world, _) = Folder::new(YAML, PGM).read(&MapSettings::default()).unwrap();
    let on = |x: f64, y: f64| format!("[[place]]\nname = 'p{x}{y}'\nat = [{x}, {y}]");
    let mut lay = |x, y| Overlay::from_toml("site.toml", &on(x, y)).unwrap().lay_over(&mut world);
    assert_eq!(lay(-0.8, 3.2).unwrap_err().problems[0].code.as_str(), "map/place-in-wall");
    assert!(lay(-0.8, 2.2).unwrap().is_empty());
}
