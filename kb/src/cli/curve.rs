//! `adit simulate --curve`: how well a robot knows where it is.

use std::path::Path;

use super::args::SimulateArgs;
use super::output::{either, table};
use super::picture;
use crate::error::{Code, Error, Result};
use crate::navigation::tours::{Driven, draw};

/// A drive is at most so long, metres.
const FARTHEST_M: f64 = 100_000.0;

/// Drives, draws and prints a row a drive.
///
/// # Arguments
/// `drive` has so many drives driven so far, metres, from the first seed on.
pub fn run(
    args: &SimulateArgs,
    (world, output): (&str, &Path),
    drive: impl FnOnce(f64, u64, u64) -> Result<Vec<Driven>>,
) -> Result<()> {
    picture::check(output)?;
    if !(args.metres > 0.0 && args.metres <= FARTHEST_M) {
        let message = format!(
            "--metres {:?} is no distance; expected more than 0 and at most {FARTHEST_M}",
            args.metres
        );
        return Err(Error::said(Code::SimulateMetres, message, None));
    }
    let drives = drive(args.metres, u64::from(args.missions), args.seed)?;
    picture::save(draw(world, &drives), output, picture::WIDTH)?;
    either(args.json, &drives[..], show)
}

fn show(drives: &[Driven]) {
    let rows = drives.iter().map(|driven| {
        vec![
            if driven.is_known { "known" } else { "built on the way" }.to_owned(),
            driven.seed.to_string(),
            format!("{:.1}", driven.length),
            format!("{:.1}", 100.0 * driven.error),
            format!("{:.2}", driven.heading_error),
            format!("{:.1}", 100.0 * driven.worst_error),
            format!("{:.2}", driven.reckoned_error),
            format!("{:.2}", driven.worst_reckoned_error),
            format!("{:.1}", driven.reckoned_heading_error),
        ]
    });
    let head = [
        "walls",
        "seed",
        "metres",
        "median cm",
        "median degrees",
        "worst cm",
        "reckoned m",
        "worst reckoned m",
        "reckoned degrees",
    ];
    table(&head, rows);
}
