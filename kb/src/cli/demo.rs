//! `adit demo`: the paper's example and a clinic, built, routed and drawn.

use std::path::{Path, PathBuf};

use super::DemoArgs;
use super::build::show;
use super::output::{json, line, maybe, table};
use super::route;
use crate::draw::{Layers, Style, render_png, render_svg};
use crate::error::{Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::progress::Spinner;
use crate::scene::main_state;
use crate::shipped::{self, Sites};
use adit_db::Store;

/// Builds the examples into a folder and shows them.
pub fn run(args: &DemoArgs) -> Result<()> {
    let paper = build(args, "paper", ("f", "e"))?;
    let clinic = build(args, "clinic", ("dock", "ward 12"))?;
    if args.json {
        return json(&serde_json::json!([paper.json(), clinic.json()]));
    }
    line("== The paper's example (Abou-Ali et al.): a robot that walks, side-steps, squats and creeps\n");
    show(&paper.knowledge, &paper.report);
    rooms(&paper.knowledge)?;
    line("");
    route::steps(&paper.answer);
    line(&format!("picture: {}\n", paper.picture.display()));
    line("== A clinic: low pipes, narrow gaps, a corridor full of beds\n");
    show(&clinic.knowledge, &clinic.report);
    line("");
    route::summary(&clinic.answer);
    line(&format!("picture: {}\n", clinic.picture.display()));
    let site = args.out.join("clinic");
    let site = site.display();
    line("What to try next:");
    line(&format!("  adit route {site} dock \"ward 6\"                    another route"));
    line(&format!(
        "  adit tune {site} robots SQUAT hardness 6 --dry-run   what would follow if squatting were harder"
    ));
    line(&format!("  adit draw {site} -o clinic.svg --route lobby \"ward 9\""));
    line(&format!(
        "  sqlite3 {site}/site.db \"SELECT step, kind, place, action, cost FROM action_sequence WHERE start = 'dock' AND goal = 'ward 12' ORDER BY step\""
    ));
    line("  adit new my-site --map my-map.yaml                a site of your own");
    Ok(())
}

struct Shown {
    knowledge: KnowledgeBase,
    report: crate::report::Report,
    answer: crate::answer::Answer,
    picture: PathBuf,
}

impl Shown {
    fn json(&self) -> serde_json::Value {
        serde_json::json!({"build": self.report.json(), "route": self.answer, "picture": self.picture})
    }
}

fn build(args: &DemoArgs, name: &str, (start, goal): (&str, &str)) -> Result<Shown> {
    let folder = args.out.join(name);
    renew(&folder, name)?;
    let knowledge = KnowledgeBase::open(&folder)?;
    let spinner = Spinner::new();
    let report = knowledge.build(&spinner)?;
    let answer = knowledge.route(start, goal, None)?;
    let picture = args.out.join(format!("{name}.png"));
    let scene = knowledge.scene(Some((start, goal)), None)?;
    let layers = Layers { state: scene.route.as_ref().and_then(main_state), ..Layers::default() };
    let svg = render_svg(&scene, &layers, &Style::default());
    let png = render_png(&svg, 1600).map_err(|error| Error::said("draw/png", error.to_string(), None))?;
    std::fs::write(&picture, png).map_err(|error| Error::io("write", &picture, &error))?;
    drop(spinner);
    Ok(Shown { knowledge, report, answer, picture })
}

/// The example as it is shipped: files of an earlier demo make room, other people's do not.
fn renew(folder: &Path, name: &str) -> Result<()> {
    let files = shipped::files::<Sites>(name);
    if folder.exists() {
        for file in files.iter().map(|(file, _)| file.as_str()).chain(["site.db"]) {
            let path = folder.join(file);
            if path.exists() {
                std::fs::remove_file(&path).map_err(|error| Error::io("replace", &path, &error))?;
            }
        }
    }
    shipped::write::<Sites>(name, folder)
}

fn rooms(knowledge: &KnowledgeBase) -> Result<()> {
    let rooms = Store::open_read_only(knowledge.database())?.snapshot(|tx| tx.rooms())?;
    let rows = rooms.into_iter().map(|room| {
        let [x0, y0, x1, y1] = room.rect.map(|edge| maybe(Some(edge)));
        let height = room.height.map_or("unlimited".to_owned(), |height| maybe(Some(height)));
        vec![
            room.name,
            format!("{x0}, {y0}, {x1}, {y1}"),
            height,
            maybe(Some(room.width)),
            room.action.value.unwrap_or_default(),
        ]
    });
    line("");
    table(&["room", "x0, y0, x1, y1", "height", "width", "action"], rows);
    Ok(())
}
