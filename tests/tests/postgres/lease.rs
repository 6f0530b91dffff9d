//! One writes at a time, and who has lost the right to write cannot commit.

use std::time::Duration;

use adit_db::postgres::{Failure, Place, Replica};
use adit_db::{Error, Store};
use adit_tests::cluster::Cluster;
use tempfile::TempDir;

use super::{copy, soon, with_site};

const LASTS: Duration = Duration::from_secs(1);

/// So long that its owner does not keep it up while a test runs.
const NOT_KEPT_UP: Duration = Duration::from_hours(1);

/// A copy of the site `paper`, as a service has it.
struct Copy {
    store: Store,
    _folder: TempDir,
}

impl Copy {
    fn of(cluster: &Cluster, owner: &str) -> Self {
        Self::lasting(cluster, owner, LASTS)
    }

    fn lasting(cluster: &Cluster, owner: &str, lasts: Duration) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("site.db");
        let place = Place::parse(&cluster.url("paper")).unwrap();
        let replica = Replica::make_lasting(&place, ("paper", owner), &file, lasts).unwrap();
        Self { store: Store::open_copy(&file, replica).unwrap(), _folder: folder }
    }

    fn write(&mut self, value: &str) -> Result<(), Error> {
        self.store.transaction(|tx| tx.set_site_value("test", Some(value)))
    }

    fn value(&mut self) -> Option<String> {
        self.store.snapshot(|tx| tx.site_value("test")).unwrap()
    }

    fn follow(&mut self) -> usize {
        let entries = self.store.waiting(true).unwrap();
        for entry in &entries {
            self.store.take::<(), Error>(entry, |_| Ok(None)).unwrap();
        }
        entries.len()
    }
}

fn kept(cluster: &Cluster) -> Vec<String> {
    cluster.ask("SELECT value FROM adit.site WHERE site = 'paper' AND key = 'test'")
}

fn is_fenced(done: &Result<(), Error>) -> bool {
    matches!(done, Err(Error::Postgres(Failure::Fenced(_))))
}

#[test]
fn the_right_to_write_lasts_while_its_holder_lives() {
    let (cluster, _site) = with_site("paper");
    let (mut holder, mut other) = (Copy::of(&cluster, "holder"), Copy::of(&cluster, "other"));
    assert!(
        matches!(holder.write("none"), Err(Error::Postgres(Failure::Held(_)))),
        "without the right nothing is written"
    );
    assert!(holder.store.lead().unwrap());
    assert!(!other.store.lead().unwrap(), "another has it");
    std::thread::sleep(2 * LASTS);
    assert!(!other.store.lead().unwrap(), "it is kept up");
    drop(holder);
    std::thread::sleep(2 * LASTS);
    assert!(other.store.lead().unwrap(), "it is kept up no more");
}

#[test]
fn a_holder_that_was_paused_cannot_commit_what_it_began() {
    let (cluster, _site) = with_site("paper");
    let (mut old, mut new) = (Copy::lasting(&cluster, "old", NOT_KEPT_UP), Copy::of(&cluster, "new"));
    assert!(old.store.lead().unwrap());
    // a paused holder keeps nothing up, and this is how that looks to others
    cluster.ask("UPDATE adit.sites SET until = now() - interval '1 second' WHERE site = 'paper'");
    let done = old.store.transaction(|tx| -> Result<(), Error> {
        tx.set_site_value("test", Some("old"))?;
        assert!(new.store.lead().unwrap(), "its time is over");
        new.write("new")?;
        Ok(())
    });
    assert!(is_fenced(&done), "{done:?}");
    assert_eq!((kept(&cluster), old.value()), (vec!["new".to_owned()], None));
    old.store.cede();
    // it hears of what was written, and may write after that alone
    assert!(old.store.lead().unwrap());
    assert!(is_fenced(&old.write("old")), "it lacks an entry");
    assert_eq!((old.follow(), old.value().as_deref()), (1, Some("new")));
    old.write("old").unwrap();
    assert_eq!((new.follow(), new.value().as_deref()), (1, Some("old")));
    assert_eq!(kept(&cluster), ["old"]);
}

#[test]
fn who_has_the_number_of_another_owner_is_refused() {
    let (cluster, _site) = with_site("paper");
    let mut copy = Copy::of(&cluster, "one");
    assert!(copy.store.lead().unwrap());
    cluster.ask("UPDATE adit.sites SET fence = fence + 1 WHERE site = 'paper'");
    assert!(is_fenced(&copy.write("x")));
    copy.store.cede();
    cluster.ask("UPDATE adit.sites SET owner = NULL WHERE site = 'paper'");
    assert!(copy.store.lead().unwrap());
    copy.write("y").unwrap();
    assert_eq!(kept(&cluster), ["y"]);
}

#[test]
fn who_is_too_far_behind_takes_all_rows() {
    let (cluster, _site) = with_site("paper");
    let (mut one, mut other) = (Copy::of(&cluster, "one"), Copy::of(&cluster, "other"));
    for value in ["a", "b", "c"] {
        assert!(one.store.lead().unwrap());
        one.write(value).unwrap();
    }
    cluster.ask("DELETE FROM adit.log WHERE site = 'paper' AND entry < 4");
    assert!(matches!(other.store.waiting(true), Err(Error::Postgres(Failure::TooFarBehind(_)))));
    other.store.take_whole().unwrap();
    assert_eq!((other.value().as_deref(), other.follow()), (Some("c"), 0));
    assert!(other.store.lead().unwrap());
    other.write("d").unwrap();
    assert_eq!((one.follow(), one.value().as_deref()), (1, Some("d")));
}

#[test]
fn what_the_database_refuses_is_not_in_the_copy_either() {
    let (cluster, _site) = with_site("paper");
    let mut copy = Copy::of(&cluster, "one");
    assert!(copy.store.lead().unwrap());
    // PostgreSQL has no text with a NUL in it
    let refused = copy.write("a\0b");
    assert!(matches!(refused, Err(Error::Postgres(Failure::Sql(_)))), "{refused:?}");
    assert_eq!((copy.value(), kept(&cluster)), (None, Vec::new()));
    copy.store.cede();
    assert!(copy.store.lead().unwrap());
    cluster.kill();
    assert!(copy.write("x").is_err());
    assert_eq!(copy.value(), None);
    cluster.up();
    copy.store.cede();
    std::thread::sleep(2 * LASTS);
    assert!(copy.store.lead().unwrap());
    copy.write("z").unwrap();
    assert_eq!((copy.value().as_deref(), kept(&cluster)), (Some("z"), vec!["z".to_owned()]));
}

/// They were told that PostgreSQL had refused a statement.
#[test]
fn who_waits_too_long_for_a_lock_of_anothers_is_told_that_another_edits() {
    let (cluster, site) = with_site("paper");
    let mut holder = Copy::lasting(&cluster, "holder", NOT_KEPT_UP);
    assert!(holder.store.lead().unwrap());
    std::thread::scope(|scope| {
        let lock = "SELECT 1 FROM adit.sites WHERE site = 'paper' FOR UPDATE; SELECT pg_sleep(60)";
        scope.spawn(|| cluster.ask_as("adit", lock).unwrap_err());
        let sleeps = "SELECT pid FROM pg_stat_activity WHERE wait_event = 'PgSleep'";
        soon(Duration::from_secs(10), || !cluster.ask(sleeps).is_empty());
        let late = holder.write("late");
        assert!(matches!(late, Err(Error::Postgres(Failure::Held(_)))), "{late:?}");
        let folder = site.path().display().to_string();
        copy(&[&folder, &cluster.url("paper"), "--replace"]).expect_status(2).complains(&["postgres/held"]);
        cluster.ask(&format!("SELECT pg_cancel_backend(pid) FROM ({sleeps}) AS of"));
    });
    assert!(kept(&cluster).is_empty());
    holder.write("now").unwrap();
    assert_eq!(kept(&cluster), ["now"]);
}
