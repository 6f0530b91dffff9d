//! Hot reload: on each save of a rule file, a rule test, the map or a table the site is checked, tested and built, and
//! what does not pass leaves it as it was.

mod eye;

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use adit_db::Store;

use crate::error::{Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::live::report::Report;
use crate::words::progress::Silent;
pub(crate) use eye::{Eye, Files};
use eye::{Stamp, stamp};

/// How often the files are looked at.
pub const PAUSE: Duration = Duration::from_millis(300);

/// What came of a save.
pub enum Event {
    /// The site was built of what was saved.
    Built(Box<Report>),
    /// What was saved cannot be used; the site is as it was.
    Refused(Error),
}

/// Builds the site, and again after each change, until `stop` says so.
///
/// # Arguments
/// `open` opens the site anew each time, since `site.toml` may be what was saved; `said` hears what came of each build.
pub fn watch(
    open: &dyn Fn() -> Result<KnowledgeBase>,
    stop: &AtomicBool,
    pause: Duration,
    said: &mut dyn FnMut(Event),
) {
    let mut eye = Eye::default();
    let mut done: Option<State> = None;
    let mut last = None;
    while !stop.load(Ordering::Relaxed) {
        let files = eye.look(open);
        let now = State { files, edited: edited(eye.database()) };
        // what still changes is being written: it is read when two looks agree
        if last.as_ref() == Some(&now) && done.as_ref() != Some(&now) {
            match open().and_then(|knowledge| knowledge.build(&Silent)) {
                Ok(report) => {
                    said(Event::Built(Box::new(report)));
                    done = Some(State { edited: None, ..now.clone() });
                }
                Err(error) => {
                    said(Event::Refused(error));
                    done = Some(now.clone());
                }
            }
        }
        last = Some(now);
        std::thread::sleep(pause);
    }
}

/// What a build would start from.
#[derive(Clone, Debug, PartialEq)]
struct State {
    files: Files,
    /// When the database was last written, where it holds edits that no build has followed up.
    edited: Option<Stamp>,
}

/// When the database was last written, where it holds edits that no build has followed up.
fn edited(database: &Path) -> Option<Stamp> {
    let marks = Store::open_read_only(database).and_then(|mut store| {
        store.snapshot(|tx| -> std::result::Result<_, adit_db::Error> { tx.stale_marks() })
    });
    // one who is writing just now is looked at the next time
    if marks.is_ok_and(|marks| !marks.is_empty()) { stamp(database) } else { None }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::sync::mpsc::{Receiver, channel};
    use std::thread;

    use super::*;
    use crate::site::shipped::{self, RULES, SITES};
    use crate::site::whole::Whole;

    /// What a watched copy of the paper's example said, one text an event.
    struct Watched {
        said: Receiver<String>,
        folder: tempfile::TempDir,
    }

    impl Watched {
        fn next(&self) -> String {
            self.said.recv_timeout(Duration::from_secs(30)).unwrap()
        }

        fn edit(&self, file: &str, from: &str, to: &str) {
            let file = self.folder.path().join(file);
            let text = fs::read_to_string(&file).unwrap();
            assert!(text.contains(from));
            fs::write(&file, text.replace(from, to)).unwrap();
        }
    }

    fn watching(work: impl FnOnce(&Watched)) {
        let folder = tempfile::tempdir().unwrap();
        let site = folder.path().to_owned();
        let mut made = Whole::default();
        shipped::make(SITES, "paper", &site, &mut made).unwrap();
        shipped::make(RULES, "rooms/paper", &site.join("rules"), &mut made).unwrap();
        shipped::make(RULES, "rooms/paper/tests", &site.join("rules/tests"), &mut made).unwrap();
        made.keep();
        let toml = fs::read_to_string(site.join("site.toml")).unwrap();
        fs::write(site.join("site.toml"), format!("rules = \"rules\"\n{toml}")).unwrap();
        let (say, said) = channel();
        let stop = AtomicBool::new(false);
        thread::scope(|scope| {
            scope.spawn(|| {
                let open = || KnowledgeBase::open(&site);
                watch(&open, &stop, Duration::from_millis(20), &mut |event| {
                    let text = match event {
                        Event::Built(report) => format!("built {}", report.generation),
                        Event::Refused(error) => error.to_string(),
                    };
                    say.send(text).ok();
                });
            });
            // a test that fails must not wait for a watcher that nobody stops
            let outcome = catch_unwind(AssertUnwindSafe(|| work(&Watched { said, folder })));
            stop.store(true, Ordering::Relaxed);
            outcome.unwrap();
        });
    }

    #[test]
    fn each_save_is_built_or_refused_and_the_next_one_is_tried_again() {
        watching(|site| {
            assert_eq!(site.next(), "built 1");
            site.edit("rules/doors.rhai", "= door.distance1 *", "= 2.0 *");
            assert!(site.next().contains("should be"));
            site.edit("rules/doors.rhai", "= 2.0 *", "= door.distanc1 *");
            assert!(site.next().contains("distanc1"));
            site.edit("rules/doors.rhai", "= door.distanc1 *", "= door.distance1 *");
            assert_eq!(site.next(), "built 1", "all is as it was");
            site.edit("map.toml", "height = 15.0", "height = 9.0");
            assert_eq!(site.next(), "built 2");
            site.edit("site.toml", "rooms", "roms");
            assert!(site.next().contains("roms"));
            site.edit("site.toml", "roms", "rooms");
            assert_eq!(site.next(), "built 2");
        });
    }
}
