//! Whether a site that a power cut has left is sound, has all that was acknowledged, and no edit by half.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use adit_tests::oracle::random::Chance;
use adit_tests::{Ran, TestSite};

use crate::disk::{Disk, Files, files_in};
use crate::tape::{Kind, Recorder, Tape};

/// What happened to a site, with what was there at first.
pub struct Recording {
    first: Files,
    tape: Tape,
    /// The content of the database as it was seen after so many events.
    seen: Mutex<BTreeMap<usize, Content>>,
}

/// All that a database says, and the edits in its history.
#[derive(Clone, PartialEq)]
pub struct Content {
    pub text: String,
    edits: BTreeSet<i64>,
}

/// What is wrong after a power cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fault {
    /// The database is damaged, or a program cannot go on with it.
    Unsound,
    /// An edit that was acknowledged is not there.
    Lost,
    /// What is there was never there while the program ran.
    Torn,
}

pub type Faults = Vec<(Fault, String)>;

impl Recording {
    /// Does something to the site, on a disk.
    pub fn of(site: &TestSite, recorder: &Recorder, happens: impl FnOnce()) -> Self {
        let first = files_in(site.path());
        happens();
        Self { first, tape: recorder.tape(), seen: Mutex::default() }
    }

    pub fn acknowledged(&self) -> usize {
        self.acknowledged_before(self.tape.events.len()).count()
    }

    fn acknowledged_before(&self, events: usize) -> impl Iterator<Item = i64> {
        let events = self.tape.events[..events].iter();
        events.filter(|event| event.kind == Kind::Acknowledged).map(|event| event.at as i64)
    }

    /// Cuts the power so often, each time at another moment, and gives what is wrong then. What every other cut leaves our
    /// program takes up, too.
    pub fn faults_of_cuts(&self, cuts: usize, seed: u64) -> Faults {
        let (next, faults) = (AtomicUsize::new(0), Mutex::new(Faults::new()));
        let work = || {
            loop {
                let number = next.fetch_add(1, Ordering::Relaxed);
                if number >= cuts {
                    return;
                }
                let mut chance = Chance::new(seed + number as u64);
                let moment = self.moment(&mut chance);
                if let Err((fault, words)) = self.cut(moment, number.is_multiple_of(2), &mut chance) {
                    let of = self.tape.events.len();
                    let words = format!("cut {number} of seed {seed}, after event {moment} of {of}: {words}");
                    faults.lock().unwrap().push((fault, words));
                }
            }
        };
        thread::scope(|scope| (0..2).for_each(|_| drop(scope.spawn(work))));
        faults.into_inner().unwrap()
    }

    /// Cuts the power so often, and shows what is left, with what was acknowledged last by then: 0 for nothing.
    pub fn after_cuts(&self, cuts: u64, mut look: impl FnMut(i64, &Files)) {
        for seed in 0..cuts {
            let mut chance = Chance::new(seed);
            let moment = self.moment(&mut chance);
            let left = Disk::after(&self.first, &self.tape, moment).after_a_power_cut(&mut chance);
            look(self.acknowledged_before(moment).last().unwrap_or(0), &left);
        }
    }

    /// Any moment; often one at which an edit has just been acknowledged.
    fn moment(&self, chance: &mut Chance) -> usize {
        let events = &self.tape.events;
        let any = chance.below(events.len() + 1);
        if chance.is(0.6) {
            return any;
        }
        let next = events[any..].iter().position(|event| event.kind == Kind::Acknowledged);
        next.map_or(any, |next| any + next + 1)
    }

    fn cut(&self, moment: usize, is_taken_up: bool, chance: &mut Chance) -> Result<(), (Fault, String)> {
        let left = Disk::after(&self.first, &self.tape, moment).after_a_power_cut(chance);
        let unsound = |words| (Fault::Unsound, words);
        let content = Content::of_files(&left).map_err(unsound)?;
        let lost: Vec<_> =
            self.acknowledged_before(moment).filter(|edit| !content.edits.contains(edit)).collect();
        if !lost.is_empty() {
            return Err((Fault::Lost, format!("edits {lost:?} were acknowledged, and are not there")));
        }
        if !self.ends_since_the_last_edit(moment).any(|end| self.seen_after(end) == content) {
            let last = content.edits.last();
            return Err((Fault::Torn, format!("never was the database as it is, with edits up to {last:?}")));
        }
        if is_taken_up { goes_on(&left, content.edits.is_empty()).map_err(unsound) } else { Ok(()) }
    }

    /// The moment itself, and those before at which a transaction may have ended, back to the last edit that was acknowledged.
    fn ends_since_the_last_edit(&self, moment: usize) -> impl Iterator<Item = usize> {
        let events = &self.tape.events[..moment];
        let last = events.iter().rposition(|event| event.kind == Kind::Acknowledged).unwrap_or(0);
        let is_end =
            move |end: &usize| *end == 0 || matches!(events[end - 1].kind, Kind::Sync | Kind::Remove);
        let before = (0..moment).rev().filter(is_end);
        let first = (0..=last).rev().find(is_end).unwrap_or(0);
        std::iter::once(moment).chain(before.take_while(move |end| *end >= first))
    }

    fn seen_after(&self, events: usize) -> Content {
        if let Some(content) = self.seen.lock().unwrap().get(&events) {
            return content.clone();
        }
        let content = Content::of_files(&Disk::after(&self.first, &self.tape, events).as_seen())
            .expect("what the program sees is sound");
        self.seen.lock().unwrap().insert(events, content.clone());
        content
    }
}

/// The files in a folder of their own.
pub fn laid_out(files: &Files) -> TestSite {
    let site = TestSite::empty();
    for (name, content) in files {
        site.write(name, content);
    }
    site
}

impl Content {
    /// What the `sqlite3` shell reads; an error where it finds damage.
    pub fn of(database: &Path) -> Result<Self, String> {
        let checks = "PRAGMA integrity_check; PRAGMA foreign_key_check; PRAGMA user_version;";
        let ran = Command::new("sqlite3").arg("-bail").arg(database).args([checks, ".dump"]).output();
        let ran = Ran::new(&ran.expect("the sqlite3 shell is installed (tests/run installs it)"));
        let text = ran.stdout;
        if ran.status != 0 || !text.starts_with("ok\n") || !ran.stderr.is_empty() {
            return Err(format!("{}{}", &text[..text.len().min(500)], ran.stderr));
        }
        let edit =
            |line: &str| line.strip_prefix("INSERT INTO history VALUES(")?.split(',').next()?.parse().ok();
        Ok(Self { edits: text.lines().filter_map(edit).collect(), text })
    }

    fn of_files(files: &Files) -> Result<Self, String> {
        Self::of(&laid_out(files).path().join("site.db"))
    }
}

/// Whether our program takes up what is left: it reads, finds nothing wrong, and makes the next edit. What was not built to
/// the end is built first.
fn goes_on(left: &Files, may_be_unbuilt: bool) -> Result<(), String> {
    let site = laid_out(left);
    let expect = |verb: &str, arguments: &[&str]| {
        let ran = site.adit(verb, arguments);
        let said = format!("adit {verb}: {}{}", ran.stdout, ran.stderr);
        if ran.status == 0 { Ok(()) } else { Err(said) }
    };
    // whoever only reads comes first
    expect(if may_be_unbuilt { "build" } else { "history" }, &[])?;
    expect("doctor", &[])?;
    expect("tune", &["robots", "SQUAT", "hardness", "17"])?;
    let squat = site.sqlite3("SELECT hardness FROM robots WHERE state = 'SQUAT'");
    let is_beside = |name: &String| name.starts_with("site.db-");
    let beside: Vec<_> = files_in(site.path()).into_keys().filter(is_beside).collect();
    match (squat.join(" ").as_str(), beside.as_slice()) {
        ("17.0", []) => Ok(()),
        wrong => Err(format!("the next edit leaves {wrong:?}")),
    }
}
