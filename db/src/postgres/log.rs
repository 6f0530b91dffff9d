//! The lease on a site, and its log: who may write, what was written, and what others wrote.

use std::time::{Duration, Instant};

use sqlx::PgConnection;

use super::changes::Changes;
use super::hint::channel;
use super::link::{Link, is_collision, is_locked};
use super::rows;
use super::schema;
use super::tables::Template;
use crate::error::{Error, Result};
use crate::failure::Failure;

/// Entries of the log that are kept, for services that lag behind; who is farther behind reads all rows.
const KEPT: i64 = 512;

/// How long it is tried to find out whether an entry was kept, when the connection broke.
const FINDING_OUT: Duration = Duration::from_secs(20);

/// Entries that are read at once.
const AT_ONCE: i64 = 64;

/// The right to write, until it ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Lease {
    /// The how manieth owner this is.
    pub fence: i64,
    /// The newest entry of the log when it was given.
    pub entry: i64,
}

/// Asks for the right to write; `None` where another has it.
pub(super) fn acquire(link: &mut Link, site: &str, owner: &str, lasts: Duration) -> Result<Option<Lease>> {
    let sql = "UPDATE adit.sites SET owner = $2, fence = fence + 1, until = now() + $3 * interval '1 second'
               WHERE site = $1 AND (owner IS NULL OR owner = $2 OR until < now())
               AND (SELECT version FROM adit.version WHERE one = 1) = $4 RETURNING fence, entry";
    let given: Option<(i64, i64)> = link.again(async |connection| {
        let query = sqlx::query_as(sql).bind(site).bind(owner).bind(lasts.as_secs_f64());
        match query.bind(schema::KNOWN.number()).fetch_optional(connection).await {
            // another one is at work on it this moment
            Err(error) if is_locked(&error) => Ok(None),
            given => Ok(given?),
        }
    })?;
    if given.is_none() {
        // nor is it given to whoever writes rows of another version
        schema::check(link)?;
    }
    Ok(given.map(|(fence, entry)| Lease { fence, entry }))
}

/// Has the right to write last longer; `false` where it is another's by now.
pub(super) fn extend(
    link: &mut Link,
    site: &str,
    owner: &str,
    (fence, lasts): (i64, Duration),
) -> Result<bool> {
    let sql = "UPDATE adit.sites SET until = now() + $4 * interval '1 second'
               WHERE site = $1 AND owner = $2 AND fence = $3";
    link.again(async |connection| {
        let query = sqlx::query(sql).bind(site).bind(owner).bind(fence).bind(lasts.as_secs_f64());
        Ok(query.execute(connection).await?.rows_affected() == 1)
    })
}

/// Gives the right to write up.
pub(super) fn release(link: &mut Link, site: &str, owner: &str, fence: i64) -> Result<()> {
    let sql =
        "UPDATE adit.sites SET owner = NULL, until = NULL WHERE site = $1 AND owner = $2 AND fence = $3";
    link.again(async |connection| {
        sqlx::query(sql).bind(site).bind(owner).bind(fence).execute(connection).await?;
        Ok(())
    })
}

/// What is to be kept, and by whose right.
pub(super) struct Draft<'d> {
    pub site: &'d str,
    pub owner: &'d str,
    pub fence: i64,
    /// The number of the entry.
    pub entry: i64,
    pub generation: i64,
    pub changes: &'d Changes,
}

/// Keeps an entry: the rows and the log in one transaction, which gives the right to write up as well. Where the connection broke it
/// is found out whether it was kept.
pub(super) fn publish(link: &mut Link, template: &Template, draft: &Draft<'_>) -> Result<()> {
    let text = draft.changes.text();
    let mut tries = 0;
    loop {
        let (mut collided, mut locked) = (false, false);
        let kept = link.once(async |connection| {
            let kept = keep(connection, template, draft, &text).await;
            if let Err(error) = &kept {
                collided = matches!(error, Error::Sql(error) if is_collision(error));
                locked = matches!(error, Error::Sql(error) if is_locked(error));
                sqlx::raw_sql("ROLLBACK").execute(&mut *connection).await.ok();
            }
            kept
        });
        tries += 1;
        match kept {
            Ok(true) => return Ok(()),
            Ok(false) => return Err(Failure::Fenced(draft.site.to_owned()).into()),
            Err(_) if collided && tries < 20 => {
                std::thread::sleep(Duration::from_millis(tries * 3));
            }
            Err(_) if locked => return Err(Failure::Held(draft.site.to_owned()).into()),
            Err(Error::Postgres(Failure::Unreachable { place, reason })) => {
                return match find_out(link, draft) {
                    Some(true) => Ok(()),
                    Some(false) => Err(Failure::Unreachable { place, reason }.into()),
                    None => Err(Failure::UnknownOutcome(place).into()),
                };
            }
            Err(error) => return Err(error),
        }
    }
}

async fn keep(
    connection: &mut PgConnection,
    template: &Template,
    draft: &Draft<'_>,
    text: &str,
) -> Result<bool> {
    let Draft { site, owner, fence, entry, generation, changes } = *draft;
    sqlx::raw_sql("BEGIN").execute(&mut *connection).await?;
    let sql = "UPDATE adit.sites SET entry = $4, generation = $5, owner = NULL, until = NULL
               WHERE site = $1 AND owner = $2 AND fence = $3 AND entry = $4 - 1";
    let query = sqlx::query(sql).bind(site).bind(owner).bind(fence).bind(entry).bind(generation);
    if query.execute(&mut *connection).await?.rows_affected() != 1 {
        sqlx::raw_sql("ROLLBACK").execute(&mut *connection).await?;
        return Ok(false);
    }
    rows::write(connection, site, template, changes).await?;
    let sql = "INSERT INTO adit.log (site, entry, generation, owner, fence, changes) VALUES ($1, $2, $3, $4, $5, $6)";
    let query = sqlx::query(sql).bind(site).bind(entry).bind(generation).bind(owner).bind(fence).bind(text);
    query.execute(&mut *connection).await?;
    if entry % 16 == 0 {
        let sql = "DELETE FROM adit.log WHERE site = $1 AND entry <= $2";
        sqlx::query(sql).bind(site).bind(entry - KEPT).execute(&mut *connection).await?;
    }
    sqlx::raw_sql("COMMIT").execute(&mut *connection).await?;
    Ok(true)
}

/// Whether an entry was kept whose transaction was not heard of any more; `None` where that cannot be found out. The row of the
/// site is locked for it: a transaction that is still at work has that lock, so that what is read then is its outcome.
fn find_out(link: &mut Link, draft: &Draft<'_>) -> Option<bool> {
    let began = Instant::now();
    while began.elapsed() < FINDING_OUT {
        let found = link.once(async |connection| {
            sqlx::raw_sql("BEGIN").execute(&mut *connection).await?;
            let sql = "SELECT entry FROM adit.sites WHERE site = $1 FOR UPDATE";
            let head: Option<i64> =
                match sqlx::query_scalar(sql).bind(draft.site).fetch_optional(&mut *connection).await {
                    Ok(head) => head,
                    Err(error) => {
                        sqlx::raw_sql("ROLLBACK").execute(&mut *connection).await.ok();
                        return Err(error.into());
                    }
                };
            let sql =
                "SELECT count(*) FROM adit.log WHERE site = $1 AND entry = $2 AND owner = $3 AND fence = $4";
            let query = sqlx::query_scalar(sql).bind(draft.site).bind(draft.entry);
            let kept: i64 = query.bind(draft.owner).bind(draft.fence).fetch_one(&mut *connection).await?;
            sqlx::raw_sql("ROLLBACK").execute(&mut *connection).await?;
            Ok((head, kept > 0))
        });
        match found {
            Ok((_, true)) => return Some(true),
            // what is not there while the head is older cannot come any more: its transaction has ended
            Ok((Some(head), false)) if head < draft.entry + KEPT / 2 => return Some(false),
            Ok(_) => return None,
            Err(_) => std::thread::sleep(Duration::from_millis(100)),
        }
    }
    None
}

/// An entry of the log, as it stands there.
pub(super) struct Written {
    pub entry: i64,
    /// `None`: the site was replaced.
    pub changes: Option<String>,
}

/// The entries after one, in their order.
pub(super) fn after(link: &mut Link, site: &str, entry: i64) -> Result<Vec<Written>> {
    let sql = "SELECT entry, changes FROM adit.log WHERE site = $1 AND entry > $2 ORDER BY entry LIMIT $3";
    let rows: Vec<(i64, Option<String>)> = link.again(async |connection| {
        Ok(sqlx::query_as(sql).bind(site).bind(entry).bind(AT_ONCE).fetch_all(connection).await?)
    })?;
    Ok(rows.into_iter().map(|(entry, changes)| Written { entry, changes }).collect())
}

/// Tells services on the site that there is an entry: a hint, without which they look once in a while.
pub(super) fn hint(link: &mut Link, site: &str) -> Result<()> {
    link.once(async |connection| {
        sqlx::query("SELECT pg_notify($1, $2)").bind(channel(site)).bind(site).execute(connection).await?;
        Ok(())
    })
}
