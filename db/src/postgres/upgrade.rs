//! A database of sites of an older version becomes one of this version: its rows are read as the older version wrote them, go
//! through the steps of SQLite's schema, and are written as this version does.
//!
//! All of it is one transaction. What was there is kept, as the schema `adit_vN`, but for the rows by which services know their
//! site: one of the older version that runs on is told that the site was replaced, finds tables of another version, and edits
//! nothing any more.

use sqlx::{AssertSqlSafe, Connection, PgConnection, SqliteConnection};

use super::capture;
use super::changes::Changes;
use super::link::{Link, is_locked};
use super::place::Place;
use super::rows::{self, Head, Leaving, SCHEMA};
use super::schema::{self, KNOWN};
use super::tables::Template;
use crate::dynamic::identifier;
use crate::error::Result;
use crate::failure::Failure;
use crate::migrate::{self, STEPS};

/// What an upgrade did.
#[derive(Clone, Debug)]
pub struct Upgraded {
    /// The version that the sites are of now.
    pub version: String,
    /// The version of before, and the schema that has kept what was there; `None` where it was this one.
    pub before: Option<(String, String)>,
    /// The sites.
    pub sites: Vec<String>,
}

/// A site in the tables of before.
struct Old {
    site: String,
    entry: i64,
    fence: i64,
    worlds: bool,
}

/// Brings all sites in a database up to this program's version.
///
/// # Arguments
/// `on_site` hears how many sites are done, of how many, and which one is next.
pub fn upgrade(place: &Place, mut on_site: impl FnMut(usize, usize, &str)) -> Result<Upgraded> {
    let mut link = Link::new(place)?;
    let shown = place.shown();
    let found = link.again(schema::version)?.ok_or_else(|| Failure::NoSites(shown.clone()))?;
    if found == KNOWN {
        return Ok(Upgraded { version: KNOWN.to_string(), before: None, sites: rows::sites(place)? });
    }
    // a newer form of the same version cannot be read either
    let last = usize::try_from(found.schema).ok().filter(|_| found < KNOWN);
    let Some(steps) = last.and_then(|last| STEPS.get(..last)) else {
        return Err(found.unknown(shown));
    };
    let kept = format!("{SCHEMA}_v{}", found.to_string().replace('.', "_"));
    link.whole(true);
    // where it fails, the transaction ends with the connection
    let sites = begin(&mut link, &kept)?;
    for (at, old) in sites.iter().enumerate() {
        on_site(at, sites.len(), &old.site);
        let template = link.apart(Template::of(steps, old.worlds))?;
        let changes =
            link.once(async |connection| rows::read(connection, &kept, &old.site, &template).await)?;
        let (files, leaving) = link.apart(brought_up(&template, changes))?;
        let Leaving { template, mut changes, generation } = leaving;
        changes.files = files;
        let head = Head { entry: old.entry + 1, fence: old.fence + 1, generation };
        link.once(async |connection| {
            rows::put_whole(connection, &old.site, &template, &changes, head).await
        })?;
    }
    link.once(async |connection| end(connection, &kept).await)?;
    let sites = sites.into_iter().map(|old| old.site).collect();
    Ok(Upgraded { version: KNOWN.to_string(), before: Some((found.to_string(), kept)), sites })
}

/// Begins the transaction, sets what is there aside, and makes tables and views of this version.
fn begin(link: &mut Link, kept: &str) -> Result<Vec<Old>> {
    let shown = link.place().shown();
    let all = link.apart(Template::new(true))?;
    let script = schema::script(&all);
    link.once(async |connection| {
        // between two statements a site is brought up to date, which takes its time
        sqlx::raw_sql(
            "BEGIN; SET LOCAL idle_in_transaction_session_timeout = 0; SET LOCAL lock_timeout = '60s'",
        )
        .execute(&mut *connection)
        .await?;
        match sqlx::raw_sql("LOCK TABLE adit.sites IN ACCESS EXCLUSIVE MODE").execute(&mut *connection).await
        {
            Err(error) if is_locked(&error) => return Err(Failure::InUse(shown.clone()).into()),
            locked => locked?,
        };
        let sql = "SELECT count(*) FROM pg_catalog.pg_namespace WHERE nspname = $1";
        let there: i64 = sqlx::query_scalar(sql).bind(kept).fetch_one(&mut *connection).await?;
        if there > 0 {
            return Err(Failure::KeptAlready { place: shown.clone(), schema: kept.to_owned() }.into());
        }
        let sql = "SELECT site, entry, fence, worlds FROM adit.sites ORDER BY site";
        let sites: Vec<(String, i64, i64, bool)> = sqlx::query_as(sql).fetch_all(&mut *connection).await?;
        let sql = format!("ALTER SCHEMA {SCHEMA} RENAME TO {kept}; {script}");
        sqlx::raw_sql(AssertSqlSafe(sql)).execute(connection).await?;
        Ok(sites.into_iter().map(|(site, entry, fence, worlds)| Old { site, entry, fence, worlds }).collect())
    })
}

/// What a site is in this program's version, with its files.
async fn brought_up(template: &Template, mut changes: Changes) -> Result<(Vec<super::File>, Leaving)> {
    let files = std::mem::take(&mut changes.files);
    let nowhere = std::path::Path::new("");
    let mut connection = SqliteConnection::connect("sqlite::memory:").await?;
    template.make(&mut connection, nowhere).await?;
    sqlx::raw_sql("BEGIN").execute(&mut connection).await?;
    capture::fill(&mut connection, template.clone(), &changes).await?;
    sqlx::raw_sql("COMMIT").execute(&mut connection).await?;
    migrate::migrate_in_place(&mut connection, nowhere, STEPS).await?;
    let leaving = Leaving::read(&mut connection).await?;
    connection.close().await?;
    Ok((files, leaving))
}

/// Gives rights on what is still there to those who had them, takes the sites from services of before, and ends it.
async fn end(connection: &mut PgConnection, kept: &str) -> Result<()> {
    for right in rights(connection, kept).await? {
        sqlx::raw_sql(AssertSqlSafe(right)).execute(&mut *connection).await?;
    }
    let sql = format!(
        "INSERT INTO {kept}.log (site, entry, generation, owner, fence, changes)
           SELECT site, entry + 1, generation, '', fence, NULL FROM {kept}.sites;
         CREATE TABLE {kept}.sites_then AS TABLE {kept}.sites;
         DELETE FROM {kept}.sites; COMMIT"
    );
    sqlx::raw_sql(AssertSqlSafe(sql)).execute(connection).await?;
    Ok(())
}

/// The rights that others have on the schema that was, its tables and views, as statements that give the same on those of now.
async fn rights(connection: &mut PgConnection, kept: &str) -> Result<Vec<String>> {
    let sql = "SELECT NULL, a.privilege_type, a.grantee::oid::bigint, a.grantee::regrole::text
               FROM pg_catalog.pg_namespace n CROSS JOIN LATERAL aclexplode(n.nspacl) AS a
               WHERE n.nspname = $1 AND a.grantee <> n.nspowner
               UNION ALL
               SELECT c.relname, a.privilege_type, a.grantee::oid::bigint, a.grantee::regrole::text
               FROM pg_catalog.pg_class c JOIN pg_catalog.pg_namespace n ON n.oid = c.relnamespace
               CROSS JOIN LATERAL aclexplode(c.relacl) AS a
               WHERE n.nspname = $1 AND a.grantee <> c.relowner
               AND EXISTS (SELECT 1 FROM pg_catalog.pg_class t JOIN pg_catalog.pg_namespace m ON m.oid = t.relnamespace
                           WHERE m.nspname = $2 AND t.relname = c.relname)";
    let rights: Vec<(Option<String>, String, i64, String)> =
        sqlx::query_as(sql).bind(kept).bind(SCHEMA).fetch_all(connection).await?;
    let statement = |(relation, right, grantee, name): (Option<String>, String, i64, String)| {
        let on = relation.map_or_else(
            || format!("SCHEMA {SCHEMA}"),
            |relation| format!("{SCHEMA}.{}", identifier(&relation)),
        );
        let to = if grantee == 0 { "PUBLIC".to_owned() } else { name };
        format!("GRANT {right} ON {on} TO {to}")
    };
    Ok(rights.into_iter().map(statement).collect())
}
