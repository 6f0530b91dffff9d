//! After any sequence of steps a site's database is, to the byte, that of one step from nothing: whether the steps were made
//! by a service that holds the site, or each by a command that opens it, and whatever was previewed in between.
//!
//! `ADIT_SEQUENCES=2000 cargo test --test journeys one_step` tries more sequences, `ADIT_SEQUENCES=1500..1600` those from 1500 on,
//! `ADIT_SEQUENCES=1552..1553` one again that failed.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use adit::edit::{Close, Edit, Lay, Thing};
use adit::{KnowledgeBase, Live, Silent, Tell};
use adit_db::Store;
use adit_db::history::Author;
use adit_tests::oracle::random::Chance;
use adit_tests::slanted::SlantedRooms;
use adit_tests::{Ran, TestSite};

/// How many sequences are tried where nobody says otherwise, and how many steps each has.
const SEQUENCES: usize = 40;
const STEPS: usize = 7;

/// Everything that follows from the tables; what people wrote stays.
const FORGET: &str = "
    UPDATE writer SET quiet = 1;
    DELETE FROM doors; DELETE FROM rooms; DELETE FROM rules; DELETE FROM witnesses; DELETE FROM derivations;
    DELETE FROM prime_area_strips; DELETE FROM strips; DELETE FROM starts; DELETE FROM ends; DELETE FROM tree_rows;
    DELETE FROM places; DELETE FROM frames; DELETE FROM attachments; DELETE FROM told_states; DELETE FROM site_hours;
    DELETE FROM spaces; DELETE FROM doorways; DELETE FROM blocks; DELETE FROM areas; DELETE FROM named_doors; DELETE FROM area_rooms; DELETE FROM door_rooms;
    DELETE FROM area_outlines;
    DELETE FROM site WHERE key NOT LIKE 'class.%'; UPDATE writer SET quiet = 0;";

#[derive(Clone, Debug)]
enum Step {
    Edit(Edit),
    /// What a file of the site holds from now on; without a text it is gone.
    File(&'static str, Option<String>),
    /// The moment that is asked about.
    Clock(&'static str),
}

/// The starter's only robot.
const ROBOT: &str = "robot";

const MOMENTS: [&str; 3] = ["2030-01-01T08:00:00Z", "2030-01-01T12:00:00Z", "2030-01-01T20:00:00Z"];

fn texts<const N: usize>(words: [&str; N]) -> [String; N] {
    words.map(str::to_owned)
}

fn step(chance: &mut Chance) -> Step {
    let state = ["STAND", "SIDE-STAND", "SQUAT"][chance.below(3)];
    let number = |chance: &mut Chance, low: f64, high: f64| chance.metres(low, high).to_string();
    let set = |column: &str, value: String| {
        Step::Edit(Edit::Set("robots".to_owned(), state.to_owned(), column.to_owned(), value))
    };
    match chance.below(14) {
        0 => set("hardness", number(chance, 0.0, 9.0)),
        1 => match chance.below(3) {
            0 => set("hardness", number(chance, 0.0, 9.0)),
            1 => set("speed", number(chance, 0.2, 2.0)),
            _ => set("power", number(chance, 0.0, 500.0)),
        },
        2 => set("width", number(chance, 0.3, 1.1)),
        3 => set("height", number(chance, 0.9, 1.9)),
        4 | 5 => {
            let place = format!("{},{}", chance.metres(0.2, 11.8), chance.metres(0.2, 7.8));
            let door = format!("door {}", 1 + chance.below(12));
            let hardness = number(chance, -1.0, 9.0);
            let told = match chance.below(3) {
                0 => ["ROOMS", &place, "hardness", &hardness],
                1 => ["DOORS", &door, "passable", "false"],
                _ => ["NAMED_DOORS", "gate", "closed", "true"],
            };
            let [class, object, property, value] = texts(told);
            let until = chance.is(0.4).then(|| "2030-01-01T12:00:00Z".to_owned());
            Step::Edit(Edit::Tell(Tell { class, object, property, value, until, new_property: false }))
        }
        6 => Step::Edit(Edit::Retract(1 + chance.below(4) as i64)),
        7 => {
            let value = number(chance, 0.5, 5.0);
            Step::Edit(Edit::SetInTuning("night".to_owned(), texts(["robots", state, "hardness", &value])))
        }
        8 => Step::Edit(Edit::Switch("night".to_owned(), chance.is(0.6))),
        9 => Step::Edit(match chance.below(3) {
            0 => {
                let cells = [("action", "ROLL"), ("height", "0.8"), ("width", "0.5"), ("hardness", "3")];
                let cells = cells.map(|(column, value)| (column.to_owned(), value.to_owned())).to_vec();
                Edit::Add("robots".to_owned(), "ROLL".to_owned(), cells)
            }
            1 => Edit::Remove("robots".to_owned(), "ROLL".to_owned()),
            _ if chance.is(0.5) => Edit::Undo(None),
            _ => {
                let set = |state: &str, value: String| {
                    let [table, key, column] = texts(["robots", state, "hardness"]);
                    Edit::Set(table, key, column, value)
                };
                Edit::Together(vec![
                    set("STAND", number(chance, 0.0, 9.0)),
                    set("SQUAT", number(chance, -1.0, 9.0)),
                ])
            }
        }),
        10 => match chance.below(3) {
            0 => Step::File("rules/extra.rhai", Some("// nothing yet".to_owned())),
            1 => {
                let rule = format!(
                    "revise \"slow on the left\"\n    each room in ROOMS where room.x1 < 6.0\n    set room.hardness by * {} level 10\n",
                    number(chance, 1.1, 3.0)
                );
                Step::File("rules/extra.rhai", Some(rule))
            }
            _ => Step::Clock(MOMENTS[chance.below(3)]),
        },
        11 => {
            let ahead =
                format!("{},{}@{}", chance.metres(0.2, 11.8), chance.metres(0.2, 7.8), chance.below(360));
            let what = ["gate", "puddle", "doorway 1", "doorway 2", "space 1", "window", &ahead];
            let what = what[chance.below(what.len())].to_owned();
            if chance.is(0.3) {
                return Step::Edit(Edit::Open(what));
            }
            let until = chance.is(0.4).then(|| "2030-01-01T12:00:00Z".to_owned());
            let some = || vec![ROBOT.to_owned()];
            let (only, except) = match chance.below(5) {
                0 => (some(), Vec::new()),
                1 => (Vec::new(), some()),
                _ => Default::default(),
            };
            let is_one_way = only.is_empty() && except.is_empty() && chance.is(0.3);
            let from = is_one_way.then(|| ["space 1", "space 2"][chance.below(2)].to_owned());
            Step::Edit(Edit::Close(Close { what, until, only, except, from }))
        }
        12 => laid(chance),
        _ => Step::File("map.toml", Some(map(chance.metres(2.0, 4.0)))),
    }
}

/// Something that is laid over the map, or lifted.
fn laid(chance: &mut Chance) -> Step {
    let name = ["pallets", "spill", "charger"][chance.below(3)].to_owned();
    if chance.is(0.3) {
        return Step::Edit(Edit::Lift(name));
    }
    if name == "charger" {
        let corners = vec![[chance.metres(-0.5, 11.0), chance.metres(-0.5, 7.0)]];
        return Step::Edit(Edit::Lay(Lay { what: Thing::Place, name, corners, ..Lay::default() }));
    }
    let is_area = name == "spill";
    let (x, y) = (chance.metres(-0.5, 11.0), chance.metres(-0.5, 7.0));
    let [right, above] = [0.3, 0.3].map(|least| chance.metres(least, 2.5));
    let corners = vec![[x, y], [x + right, y], [x, y + above]];
    let factor = ("hardness_factor".to_owned(), chance.metres(1.0, 4.0).to_string());
    Step::Edit(Edit::Lay(Lay {
        what: if is_area { Thing::Area } else { Thing::Obstacle },
        name,
        corners,
        kind: (is_area && chance.is(0.5)).then(|| "keep-out".to_owned()),
        properties: if !is_area {
            Vec::new()
        } else if chance.is(0.3) {
            vec![factor, ("heading".to_owned(), chance.metres(0.0, 360.0).to_string())]
        } else {
            vec![factor]
        },
        until: chance.is(0.4).then(|| "2030-01-01T12:00:00Z".to_owned()),
    }))
}

/// Two rooms, a doorway, a low pipe that somebody moved.
fn map(pipe: f64) -> String {
    format!(
        "width = 12.0\ndepth = 8.0\n\
         [[obstacle]]\nrect = [5.9, 0.0, 6.1, 3.0]\n[[obstacle]]\nrect = [5.9, 4.0, 6.1, 8.0]\n\
         [[obstacle]]\npolygon = [[8.0, 5.0], [9.0, 4.5], [9.5, 5.5], [8.5, 6.0]]\n\
         [[bridge]]\nrect = [{pipe}, 0.0, {}, 8.0]\nheight = 1.3\n\
         [[door]]\nname = \"gate\"\nfrom = [5.9, 3.0]\nto = [5.9, 4.0]\n\
         [[area]]\nname = \"puddle\"\nkind = \"wet\"\nrect = [7.0, 1.0, 8.0, 2.0]\nhardness_factor = 2.0\n\
         [[place]]\nname = \"home\"\nat = [1.0, 4.0]\n[[place]]\nname = \"window\"\nat = [11.0, 7.0]\n",
        pipe + 0.5
    )
}

fn author() -> Author {
    Author { who: "test".to_owned(), why: String::new() }
}

/// Every row of every table, but for the times in the history.
fn content(database: &Path) -> Vec<String> {
    let run = |argument: &str| {
        let output = Command::new("sqlite3").arg("-readonly").arg(database).arg(argument).output();
        Ran::new(&output.unwrap()).expecting(0).stdout
    };
    let mut rows: Vec<String> = run(".dump")
        .lines()
        .filter(|line| line.starts_with("INSERT INTO"))
        .filter(|line| !line.starts_with("INSERT INTO history"))
        .map(str::to_owned)
        .collect();
    rows.sort_unstable();
    rows
}

/// The first rows in which two databases differ.
fn differing(one: &[String], other: &[String]) -> Vec<String> {
    let only = |a: &[String], b: &[String], sign: &str| -> Vec<String> {
        a.iter().filter(|row| !b.contains(row)).take(4).map(|row| format!("{sign} {row}")).collect()
    };
    [only(one, other, "-"), only(other, one, "+")].concat()
}

/// A site, followed by a service and by single commands, each with a database of its own.
struct Run {
    site: TestSite,
    moment: &'static str,
    /// Whether rooms are no rectangles.
    is_slanted: bool,
    live: Live,
}

impl Run {
    fn new(mode: &str, is_slanted: bool) -> Self {
        let site = TestSite::example("starter");
        site.write("map.toml", map(2.5));
        site.write("site.toml", format!("name = \"steps\"\nrooms = \"{mode}\"\n"));
        site.copy_rules(mode);
        let moment = MOMENTS[0];
        let held = Self::open_in((&site, is_slanted), moment, "held.db");
        held.build(&Silent).unwrap();
        Self::open_in((&site, is_slanted), moment, "plain.db").build(&Silent).unwrap();
        Self { live: Live::open(held).unwrap(), site, moment, is_slanted }
    }

    fn open_in((site, is_slanted): (&TestSite, bool), moment: &str, database: &str) -> KnowledgeBase {
        let file = site.path().join(database);
        let mut knowledge = KnowledgeBase::open(site.path()).unwrap();
        if is_slanted {
            knowledge.register(Box::new(SlantedRooms));
        }
        knowledge.with_database(Some(&file)).at(Some(moment)).unwrap()
    }

    fn open(&self, database: &str) -> KnowledgeBase {
        Self::open_in((&self.site, self.is_slanted), self.moment, database)
    }

    fn database(&self, name: &str) -> PathBuf {
        self.site.path().join(name)
    }

    fn make(&mut self, step: &Step) {
        match step {
            Step::Edit(edit) => self.edit(edit),
            Step::File(name, text) => {
                let file = self.site.path().join(name);
                match text {
                    Some(text) => self.site.write(name, text),
                    None => drop(fs::remove_file(file)),
                }
                self.files_changed();
            }
            Step::Clock(moment) => {
                self.moment = moment;
                self.files_changed();
            }
        }
        self.live.renew_routes().unwrap();
    }

    fn files_changed(&mut self) {
        let plain = self.open("plain.db").build(&Silent);
        let held = self.live.open_again(self.open("held.db"));
        assert_eq!(plain.is_ok(), held.is_ok(), "{plain:?}\n{held:?}");
    }

    fn edit(&mut self, edit: &Edit) {
        let before = content(&self.database("held.db"));
        let preview = self.live.preview(std::slice::from_ref(edit), None);
        assert_eq!(content(&self.database("held.db")), before, "a preview changes nothing");
        let plain = self.open("plain.db").edit(edit, &author(), false, &Silent);
        let held = self.live.edit(edit, &author());
        match (plain, held, preview) {
            (Ok((_, report)), Ok(outcome), Ok(preview)) => {
                assert_eq!(report.generation, outcome.generation);
                if !preview.layout_changed {
                    let foretold = (preview.rooms.changed, preview.doors.changed);
                    assert_eq!((report.rooms.changed, report.doors.changed), foretold);
                    let mut store = Store::open_read_only(self.database("held.db")).unwrap();
                    let rooms = store.snapshot(|tx| tx.rooms()).unwrap();
                    for change in preview.rooms.list {
                        let room = rooms.iter().find(|room| room.room == change.room).unwrap();
                        assert_eq!(room.hardness.value, change.new.hardness, "room {}", room.name);
                    }
                }
            }
            (Err(plain), Err(held), Err(preview)) => {
                assert_eq!(held.to_string(), plain.to_string());
                assert_eq!(preview.to_string(), plain.to_string());
            }
            (plain, held, preview) => panic!("plain {plain:?}\nheld {held:?}\npreview {preview:?}"),
        }
    }

    /// Compares both databases with each other, and with one that is derived from nothing but the tables.
    fn check(&self, steps: &[Step]) {
        let held = content(&self.database("held.db"));
        let plain = content(&self.database("plain.db"));
        assert!(held == plain, "{steps:#?}\n- plain, + held: {:#?}", differing(&plain, &held));
        let nothing = self.database("nothing.db");
        fs::copy(self.database("plain.db"), &nothing).unwrap();
        let forgotten = Command::new("sqlite3").arg(&nothing).arg(FORGET).output();
        Ran::new(&forgotten.unwrap()).expect_status(0);
        self.open("nothing.db").build(&Silent).unwrap();
        let is_other = |row: &String| row.contains("VALUES('generation'");
        let [plain, anew] = [plain, content(&nothing)]
            .map(|rows| rows.into_iter().filter(|row| !is_other(row)).collect::<Vec<_>>());
        assert!(plain == anew, "{steps:#?}\n- after steps, + from nothing: {:#?}", differing(&plain, &anew));
        fs::remove_file(nothing).unwrap();
    }
}

fn sequence(seed: usize) {
    let mut chance = Chance::new(seed as u64);
    let mode = if seed.is_multiple_of(4) { "paper" } else { "by-state" };
    let mut run = Run::new(mode, seed % 8 == 1);
    let mut steps = Vec::new();
    for _ in 0..STEPS {
        let step = step(&mut chance);
        steps.push(step.clone());
        run.make(&step);
        if chance.is(0.3) {
            run.check(&steps);
        }
    }
    run.check(&steps);
}

#[test]
fn a_database_after_any_steps_is_that_of_one_step_from_nothing() {
    let wanted = std::env::var("ADIT_SEQUENCES").map_or(0..SEQUENCES, |text| {
        let (first, end) = text.split_once("..").unwrap_or(("0", &text));
        first.parse().unwrap()..end.parse().unwrap()
    });
    let workers = std::thread::available_parallelism().map_or(2, usize::from);
    std::thread::scope(|scope| {
        for worker in 0..workers {
            let seeds = wanted.clone().skip(worker).step_by(workers);
            scope.spawn(move || {
                for seed in seeds {
                    let tried = std::panic::catch_unwind(|| sequence(seed));
                    assert!(tried.is_ok(), "sequence {seed}");
                }
            });
        }
    });
}
