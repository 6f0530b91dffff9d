//! Spaces and doorways of a floor plan for `tests/peers/spaces.sh`, and the seconds that finding them took:
//! `spaces MAP.yaml LABELS.pgm DOORWAYS.json`.

use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

use adit_planners::geometry::Point;
use adit_planners::read::{MapSettings, read_map};
use adit_planners::spaces::Spaces;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, map, labels, doorways] = arguments.as_slice() else {
        panic!("spaces MAP.yaml LABELS.pgm DOORWAYS.json")
    };
    let (world, _) = read_map(Path::new(map), &MapSettings::default()).expect("a map");
    let start = Instant::now();
    let spaces = Spaces::of(&world).expect("spaces");
    eprintln!("{:.3}", start.elapsed().as_secs_f64());
    let image = world.occupancy.as_ref().expect("an image");
    let mut text = format!("P2\n{} {}\n65535\n", image.columns, image.rows);
    for row in (0..image.rows).rev() {
        for column in 0..image.columns {
            let centre = image.cell(column, row).centre();
            let number = spaces.at(centre).map_or(0, |space| space + 1);
            write!(text, "{number} ").expect("memory");
        }
        text.push('\n');
    }
    std::fs::write(labels, text).expect("labels");
    let local = |p: Point| [p.x - image.origin.x, p.y - image.origin.y];
    let rows: Vec<String> = spaces
        .doorways
        .iter()
        .map(|doorway| {
            let ([x0, y0], [x1, y1]) = (local(doorway.segment.a), local(doorway.segment.b));
            format!("[{x0},{y0},{x1},{y1}]")
        })
        .collect();
    std::fs::write(doorways, format!("[{}]", rows.join(","))).expect("doorways");
}
