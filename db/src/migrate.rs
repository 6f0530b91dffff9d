//! Schema versions. A database says its version in `user_version`, and that it is ours in `application_id`.

use std::path::Path;

use sqlx::{AssertSqlSafe, Connection, SqliteConnection};

use crate::backup;
use crate::error::{Error, Result};
use crate::relation::{self, Named};
use crate::worlds;

/// "Adit" in ASCII.
pub(crate) const APPLICATION: i64 = 0x4164_6974;

type Scripts = &'static [&'static str];

/// What changes a schema.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Change {
    /// In every database.
    pub(crate) all: Scripts,
    /// In those that keep worlds, after that.
    pub(crate) worlds: Scripts,
}

/// What a version of the schema changes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    change: Change,
    /// What it and all steps before it come to: a new database begins with that, in a tenth of the time.
    sum: Option<Change>,
}

impl Step {
    pub(crate) const fn of_all(all: Scripts) -> Self {
        Self::of(all, &[])
    }

    pub(crate) const fn of_worlds(worlds: Scripts) -> Self {
        Self::of(&[], worlds)
    }

    pub(crate) const fn of(all: Scripts, worlds: Scripts) -> Self {
        Self { change: Change { all, worlds }, sum: None }
    }

    const fn with_sum(self, sum: Change) -> Self {
        Self { sum: Some(sum), ..self }
    }
}

/// What makes version n of version n - 1; the first makes a database of an empty file. Never edited once released. The sum of all
/// of them is made by a test (below), and stands at the newest.
pub(crate) const STEPS: &[Step] = &[
    Step::of_all(&[
        include_str!("../sql/v1/01-site.sql"),
        include_str!("../sql/v1/02-rules.sql"),
        include_str!("../sql/v1/03-areas.sql"),
        include_str!("../sql/v1/04-rooms.sql"),
        include_str!("../sql/v1/05-doors.sql"),
        include_str!("../sql/v1/06-conclusions.sql"),
        include_str!("../sql/v1/07-stale.sql"),
        include_str!("../sql/v1/08-routes.sql"),
        include_str!("../sql/v1/09-action-sequence.sql"),
        include_str!("../sql/v1/10-history.sql"),
    ]),
    Step::of_all(&[
        include_str!("../sql/v2/01-anew.sql"),
        include_str!("../sql/v2/09-staleness.sql"),
        include_str!("../sql/v2/10-routes.sql"),
        include_str!("../sql/v2/11-waypoints.sql"),
        include_str!("../sql/v2/20-prime-areas.sql"),
        include_str!("../sql/v2/21-rooms-passable.sql"),
        include_str!("../sql/v2/22-conclusions.sql"),
        include_str!("../sql/v2/31-told.sql"),
        include_str!("../sql/v2/32-hours.sql"),
        include_str!("../sql/v2/33-tunings.sql"),
        include_str!("../sql/v2/40-fleet.sql"),
        include_str!("../sql/v2/50-in-force.sql"),
    ]),
    Step::of_all(&[
        include_str!("../sql/v3/10-traversals.sql"),
        include_str!("../sql/v3/20-saved-queries.sql"),
    ]),
    Step::of_all(&[include_str!("../sql/v4/10-blocks.sql")]),
    Step::of_worlds(&[
        include_str!("../sql/v5/10-plans.sql"),
        include_str!("../sql/v5/20-missions.sql"),
        include_str!("../sql/v5/30-floor-plans.sql"),
        include_str!("../sql/v5/40-learned.sql"),
        include_str!("../sql/v5/50-experience.sql"),
    ]),
    Step::of_all(&[include_str!("../sql/v6/10-outlines.sql")]),
    Step::of_all(&[include_str!("../sql/v7/10-spaces.sql")]),
    Step::of_all(&[include_str!("../sql/v8/10-laid.sql")]),
    Step::of_all(&[include_str!("../sql/v9/10-berth.sql")]),
    Step::of_all(&[include_str!("../sql/v10/10-carried-out.sql")]),
    Step::of_all(&[include_str!("../sql/v11/10-courses.sql")]),
    Step::of(
        &[include_str!("../sql/v12/20-change-sets.sql")],
        &[include_str!("../sql/v12/10-plans-are-sites.sql")],
    ),
    Step::of_all(&[
        include_str!("../sql/v13/10-views-for-all.sql"),
        include_str!("../sql/v13/20-geopackage.sql"),
    ]),
    Step::of_all(&[include_str!("../sql/v14/10-measures.sql"), include_str!("../sql/v14/20-routes.sql")]),
    Step::of_all(&[include_str!("../sql/v15/10-map-routes.sql")]),
    Step::of_all(&[include_str!("../sql/v16/10-one-way.sql")]),
    Step::of_all(&[include_str!("../sql/v17/10-laid-places.sql")]),
    Step::of_all(&[include_str!("../sql/v18/10-no-outline.sql")]),
    Step::of_worlds(&[include_str!("../sql/v19/10-lost.sql")]),
    Step::of_worlds(&[include_str!("../sql/v20/10-endings.sql")]),
    Step::of_worlds(&[include_str!("../sql/v21/10-robots.sql")]),
    Step::of_all(&[include_str!("../sql/v22/10-derived.sql")]),
    Step::of_all(&[include_str!("../sql/v23/10-laid-bridges.sql")]),
    Step::of_all(&[include_str!("../sql/v24/10-map-routes.sql")]).with_sum(Change {
        all: &[include_str!("../sql/sum/all.sql")],
        worlds: &[include_str!("../sql/sum/worlds.sql")],
    }),
];

/// The newest schema version.
pub const VERSION: i64 = STEPS.len() as i64;

/// What a file says it is.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Nothing in it yet.
    Empty,
    /// Ours, of this version.
    Adit(i64),
    /// Somebody else's.
    Other,
}

pub(crate) async fn kind(connection: &mut SqliteConnection) -> Result<Kind> {
    let application: i64 = sqlx::query_scalar("PRAGMA application_id").fetch_one(&mut *connection).await?;
    let version: i64 = sqlx::query_scalar("PRAGMA user_version").fetch_one(&mut *connection).await?;
    let objects: i64 = sqlx::query_scalar("SELECT count(*) FROM sqlite_schema").fetch_one(connection).await?;
    Ok(match (application, objects) {
        (APPLICATION, _) if version > 0 => Kind::Adit(version),
        (0, 0) if version == 0 => Kind::Empty,
        _ => Kind::Other,
    })
}

/// Brings the database up to the last of `steps`, each in a transaction of its own, or an empty one all in one. One that holds
/// data is copied beside itself first.
pub(crate) async fn migrate(connection: &mut SqliteConnection, path: &Path, steps: &[Step]) -> Result<()> {
    let known = steps.len() as i64;
    match kind(connection).await? {
        Kind::Adit(found) if found > known => {
            return Err(Error::Newer { path: path.to_owned(), found, known });
        }
        Kind::Adit(found) if found < known => backup::before_migration(connection, path, found).await?,
        Kind::Adit(_) | Kind::Empty | Kind::Other => {}
    }
    migrate_in_place(connection, path, steps).await
}

/// As [`migrate`], without a copy: of a database of which there is another one.
pub(crate) async fn migrate_in_place(
    connection: &mut SqliteConnection,
    path: &Path,
    steps: &[Step],
) -> Result<()> {
    let mut found = kind(connection).await?;
    if found == Kind::Empty {
        let all: Vec<_> = from_nothing(steps).into_iter().map(|upgrade| (upgrade, Made::default())).collect();
        take(connection, path, &all).await?;
        // another program may have been first, and know fewer steps
        found = kind(connection).await?;
    }
    match found {
        Kind::Other => return Err(Error::NotAdit(path.to_owned())),
        Kind::Adit(found) if found < steps.len() as i64 => {
            let upgrades = one_by_one(steps);
            for (upgrade, made) in upgrades.iter().zip(made_by(&upgrades).await?) {
                take(connection, path, &[(*upgrade, made)]).await?;
            }
        }
        Kind::Adit(_) | Kind::Empty => {}
    }
    Ok(())
}

/// A change that leads from one version to another.
#[derive(Clone, Copy)]
struct Upgrade {
    from: i64,
    to: i64,
    change: Change,
}

fn one_by_one(steps: &[Step]) -> Vec<Upgrade> {
    (0..).zip(steps).map(|(from, step)| Upgrade { from, to: from + 1, change: step.change }).collect()
}

/// The last sum that is known, and the steps after it.
fn from_nothing(steps: &[Step]) -> Vec<Upgrade> {
    let mut upgrades = one_by_one(steps);
    let sums = (1..).zip(steps).filter_map(|(to, step)| Some(Upgrade { from: 0, to, change: step.sum? }));
    if let Some(sum) = sums.last() {
        upgrades.splice(..sum.to as usize, [sum]);
    }
    upgrades
}

/// Makes changes in one transaction, each from its version, unless another program made them while we waited for the lock.
async fn take(connection: &mut SqliteConnection, path: &Path, upgrades: &[(Upgrade, Made)]) -> Result<()> {
    let mut transaction = connection.begin_with("BEGIN IMMEDIATE").await?;
    for (Upgrade { from, to, change }, made) in upgrades {
        let version: i64 = sqlx::query_scalar("PRAGMA user_version").fetch_one(&mut *transaction).await?;
        if version != *from {
            continue;
        }
        run(&mut transaction, path, change.all, &made.in_all).await?;
        if worlds::are_kept(&mut transaction).await? {
            run(&mut transaction, path, change.worlds, &made.for_worlds).await?;
        }
        let mark = format!("PRAGMA application_id = {APPLICATION}; PRAGMA user_version = {to}");
        sqlx::raw_sql(AssertSqlSafe(mark)).execute(&mut *transaction).await?;
    }
    transaction.commit().await?;
    Ok(())
}

/// Has a database that is up to the last of `steps` keep worlds from now on.
pub(crate) async fn keep_worlds(
    connection: &mut SqliteConnection,
    path: &Path,
    steps: &[Step],
) -> Result<()> {
    let mut transaction = connection.begin_with("BEGIN IMMEDIATE").await?;
    if worlds::are_kept(&mut transaction).await? {
        return Ok(());
    }
    let upgrades = from_nothing(steps);
    for (upgrade, made) in upgrades.iter().zip(made_by(&upgrades).await?) {
        run(&mut transaction, path, upgrade.change.worlds, &made.for_worlds).await?;
    }
    transaction.commit().await?;
    Ok(())
}

/// Runs scripts that make the tables `made`, unless somebody's own table has the name of one.
async fn run(connection: &mut SqliteConnection, path: &Path, scripts: Scripts, made: &[Named]) -> Result<()> {
    let there = if made.is_empty() { Vec::new() } else { relation::all(connection).await? };
    for other in there {
        let of_that_name = made.iter().find(|table| table.name.eq_ignore_ascii_case(&other.name));
        if of_that_name.is_some_and(|table| table.columns != other.columns) {
            return Err(Error::Taken { path: path.to_owned(), table: other.name });
        }
    }
    for script in scripts {
        sqlx::raw_sql(*script).execute(&mut *connection).await?;
    }
    Ok(())
}

/// The tables and views that a change makes.
#[derive(Clone, Default)]
struct Made {
    in_all: Vec<Named>,
    for_worlds: Vec<Named>,
}

/// What each change makes where nothing was before the first.
async fn made_by(upgrades: &[Upgrade]) -> Result<Vec<Made>> {
    let mut empty = SqliteConnection::connect("sqlite::memory:").await?;
    let mut made = Vec::new();
    for Upgrade { change, .. } in upgrades {
        let in_all = made_in(&mut empty, change.all).await?;
        made.push(Made { in_all, for_worlds: made_in(&mut empty, change.worlds).await? });
    }
    Ok(made)
}

async fn made_in(connection: &mut SqliteConnection, scripts: Scripts) -> Result<Vec<Named>> {
    let before = relation::all(connection).await?;
    for script in scripts {
        sqlx::raw_sql(*script).execute(&mut *connection).await?;
    }
    let mut made = relation::all(connection).await?;
    made.retain(|table| !before.iter().any(|there| there.name == table.name));
    Ok(made)
}

#[cfg(test)]
mod sum_tests;

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;

    const ONE: Step = Step::of_all(&["CREATE TABLE door (id INTEGER); INSERT INTO door VALUES (7)"]);
    const TWO: Step = Step::of_all(&["ALTER TABLE door ADD COLUMN width REAL"]);
    const BROKEN: Step = Step::of_all(&["DROP TABLE door", "SELECT nonsense"]);

    async fn open(path: &Path) -> SqliteConnection {
        let url = format!("sqlite://{}?mode=rwc", path.display());
        SqliteConnection::connect(&url).await.unwrap()
    }

    fn in_a_folder(work: impl AsyncFnOnce(PathBuf)) {
        let folder = tempfile::tempdir().unwrap();
        let runtime = tokio::runtime::Builder::new_current_thread().build().unwrap();
        runtime.block_on(work(folder.path().join("site.db")));
    }

    #[test]
    fn an_older_database_is_copied_and_brought_up_to_date() {
        in_a_folder(async |path| {
            let mut connection = open(&path).await;
            migrate(&mut connection, &path, &[ONE]).await.unwrap();
            migrate(&mut connection, &path, &[ONE, TWO]).await.unwrap();
            assert_eq!(kind(&mut connection).await.unwrap(), Kind::Adit(2));
            sqlx::query("SELECT id, width FROM door").fetch_one(&mut connection).await.unwrap();
            let mut copy = open(&path.with_file_name("site.db.bak-v1")).await;
            assert_eq!(kind(&mut copy).await.unwrap(), Kind::Adit(1));
        });
    }

    #[test]
    fn an_empty_one_begins_with_the_last_sum_and_takes_the_steps_after_it() {
        const SUM: Change = Change {
            all: &["CREATE TABLE door (id INTEGER, of_sum); INSERT INTO door (id) VALUES (7)"],
            worlds: &[],
        };
        in_a_folder(async |path| {
            let mut connection = open(&path).await;
            migrate(&mut connection, &path, &[BROKEN, ONE.with_sum(SUM), TWO]).await.unwrap();
            assert_eq!(kind(&mut connection).await.unwrap(), Kind::Adit(3));
            sqlx::query("SELECT id, of_sum, width FROM door").fetch_one(&mut connection).await.unwrap();
        });
    }

    #[test]
    fn a_step_that_fails_leaves_the_version_before_it() {
        in_a_folder(async |path| {
            let mut connection = open(&path).await;
            migrate(&mut connection, &path, &[ONE]).await.unwrap();
            for copies in 1..=2 {
                migrate(&mut connection, &path, &[ONE, BROKEN]).await.unwrap_err();
                assert_eq!(kind(&mut connection).await.unwrap(), Kind::Adit(1));
                let files = std::fs::read_dir(path.parent().unwrap()).unwrap();
                let backups =
                    files.filter(|file| file.as_ref().unwrap().file_name().to_string_lossy().contains("bak"));
                assert_eq!(backups.count(), copies);
            }
            sqlx::query("SELECT id FROM door").fetch_one(&mut connection).await.unwrap();
        });
    }
}
