//! `adit watch`: builds on each save, until Ctrl-C.

use std::sync::atomic::AtomicBool;

use super::args::SiteArgs;
use super::build::{changes, notes, unbuilt};
use super::output::{as_json, line, problems, remark};
use crate::error::Result;
use crate::live::report::Report;
use crate::live::watch::{Event, PAUSE, watch};

/// Watches the site; does not come back.
pub fn run(args: &SiteArgs) -> Result<()> {
    // a folder that is no site is an error at once, not something to wait for
    let knowledge = unbuilt(args)?;
    knowledge.needs_folder()?;
    let name = &knowledge.site().name;
    remark(&format!("watching {name}; Ctrl-C ends it"));
    let stop = AtomicBool::new(false);
    let mut last = None;
    let mut said = |event: Event| match event {
        Event::Built(report) => {
            if args.json {
                let mut value = report.json();
                value["event"] = "built".into();
                line(&value.to_string());
                notes(&report);
            } else {
                show(&report, last);
            }
            last = Some(report.generation);
        }
        Event::Refused(error) => {
            if args.json {
                let event = serde_json::json!({"event": "refused", "error": as_json(error.problems())});
                line(&event.to_string());
            }
            problems(error.problems());
            remark("refused; the site is as it was");
        }
    };
    watch(&|| unbuilt(args), &stop, PAUSE, &mut said);
    Ok(())
}

/// What a build changed; all there is the first time.
fn show(report: &Report, last: Option<u64>) {
    let generation = report.generation;
    if last == Some(generation) {
        line(&format!("nothing changes (generation {generation})"));
        return;
    }
    let took: f64 = report.stages.iter().map(|stage| stage.took.as_secs_f64()).sum();
    line(&format!("built in {took:.2} s (generation {generation})"));
    changes("", report);
}
