//! `adit demo`: a clinic and the paper's example, built, routed and drawn.

use std::path::{Path, PathBuf};

use clap::Args;

use super::build::show;
use super::output::{json, line, maybe, program, quoted, remark, table};
use super::picture::{WIDTH, save};
use super::route;
use crate::answer::scene::main_state;
use crate::draw::{Layers, Style, render_svg};
use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::site::shipped::{self, SITES};
use crate::site::whole::{self, Whole};
use crate::words::progress::Spinner;
use adit_db::Store;

#[derive(Args, Debug)]
pub struct DemoArgs {
    /// Where the example sites and pictures are written
    #[arg(long, value_name = "DIR", default_value = "adit-demo")]
    pub out: PathBuf,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

/// Builds the examples into a folder and shows them.
pub fn run(args: &DemoArgs) -> Result<()> {
    let clinic = build(args, "clinic", ("dock", "ward 12"))?;
    let paper = build(args, "paper", ("f", "e"))?;
    if args.json {
        return json(&serde_json::json!([clinic.json(), paper.json()]));
    }
    line(
        "== A clinic: low pipes, narrow gaps, a corridor full of beds; a robot that walks, side-steps and squats\n",
    );
    show(&clinic.knowledge, &clinic.report);
    line("");
    route::summary(&clinic.answer, &clinic.knowledge.measures()?);
    line(&format!("picture: {}\n", clinic.picture.display()));
    line("== The example of the paper (Abou-Ali et al.), from which this comes\n");
    show(&paper.knowledge, &paper.report);
    rooms(&paper.knowledge)?;
    line("");
    route::steps(&paper.answer, &paper.knowledge.measures()?);
    line(&format!("picture: {}\n", paper.picture.display()));
    let (adit, site) = (program(), quoted(&args.out.join("clinic")));
    let picture = quoted(&args.out.join("lobby.svg"));
    line("What to try next:");
    for (command, what) in [
        (format!("{adit} route {site} dock \"ward 6\""), "another route"),
        (
            format!("{adit} tune {site} robots SQUAT hardness 6 --dry-run"),
            "what would follow if squatting were harder",
        ),
        (format!("{adit} draw {site} -o {picture} --route lobby \"ward 9\""), "a picture of a third"),
        (
            format!(
                "{adit} sql {site} \"SELECT step, kind, place, action, cost FROM action_sequence \
                 WHERE start = 'dock' AND goal = 'ward 12' ORDER BY step\""
            ),
            "the same in any program that reads SQLite",
        ),
        (format!("{adit} serve {site}"), "the page where all of it is tuned, until Ctrl-C"),
        (format!("{adit} new my-site"), "a site of your own; --map FILE begins with your map"),
    ] {
        line(&format!("  {command}  # {what}"));
    }
    Ok(())
}

struct Shown {
    knowledge: KnowledgeBase,
    report: crate::live::report::Report,
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
    let mut made = Whole::default();
    renew(&folder, name, &mut made)?;
    let knowledge = KnowledgeBase::open(&folder)?;
    made.database(knowledge.database());
    let spinner = Spinner::new();
    let report = knowledge.build(&spinner)?;
    let answer = knowledge.route(start, goal, None)?;
    let picture = args.out.join(format!("{name}.png"));
    let scene = knowledge.scene(Some((start, goal)), None)?;
    let layers = Layers { state: scene.route.as_ref().and_then(main_state), ..Layers::default() };
    let svg = render_svg(&scene, &layers, &Style::default());
    save(svg, &picture, WIDTH)?;
    made.keep();
    drop(spinner);
    Ok(Shown { knowledge, report, answer, picture })
}

/// The example as it is shipped: that of an earlier demo makes room, a site of the user's does not.
fn renew(folder: &Path, name: &str, made: &mut Whole) -> Result<()> {
    if !folder.join("site.toml").exists() {
        return shipped::make(SITES, name, folder, made);
    }
    let files = shipped::files(SITES, name);
    let of_site = |text: &str| files.iter().any(|(file, shipped)| file == "site.toml" && shipped == text);
    if !std::fs::read_to_string(folder.join("site.toml")).is_ok_and(|text| of_site(&text)) {
        let message =
            format!("{} is a site, and not the example that would be written there", folder.display());
        let help = "name another folder with --out, or move this one away".to_owned();
        return Err(Error::said(Code::SiteExists, message, Some(help)));
    }
    for (file, text) in files {
        whole::write(&folder.join(file), text.as_bytes())?;
    }
    let database = folder.join("site.db");
    if database.exists() {
        make_room(&database)?;
    }
    Ok(())
}

/// Takes the database of an earlier demo away; one in which somebody edited something is kept under another name.
fn make_room(database: &Path) -> Result<()> {
    let edits = Store::open_read_only(database).and_then(|mut store| store.snapshot(|tx| tx.history(1)));
    if edits.is_ok_and(|edits| edits.is_empty()) {
        return std::fs::remove_file(database).map_err(|error| Error::io("replace", database, &error));
    }
    let mut number = 1;
    let mut kept = database.with_file_name("site-1.db");
    while kept.exists() {
        number += 1;
        kept.set_file_name(format!("site-{number}.db"));
    }
    // what a program that was killed had acknowledged lies in the file beside it
    for end in ["-wal", ""] {
        let [from, to] = [database, &kept].map(|file| {
            let mut name = file.as_os_str().to_owned();
            name.push(end);
            PathBuf::from(name)
        });
        if from.exists() {
            std::fs::rename(&from, &to).map_err(|error| Error::io("move away", &from, &error))?;
        }
    }
    remark(&format!("what you edited in the demo of before is kept in {}", kept.display()));
    Ok(())
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
