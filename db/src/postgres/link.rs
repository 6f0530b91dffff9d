//! A connection to PostgreSQL that is made when it is needed, and made anew when it broke.

use std::time::{Duration, Instant};

use sqlx::postgres::PgConnectOptions;
use sqlx::{ConnectOptions, Connection, PgConnection};
use tokio::runtime::{Builder, Runtime};

use super::place::{CONNECTING, Place};
use crate::connection::wait;
use crate::error::{Error, Result};
use crate::failure::Failure;

/// How long one piece of work may take, and a whole site.
const WORK: Duration = Duration::from_mins(1);
const WHOLE: Duration = Duration::from_mins(30);

/// After a failure to connect nobody tries again for so long, but for who must.
const REST: Duration = Duration::from_millis(500);

/// Transactions that collide with others are tried so often.
const TRIES: u32 = 20;

/// What every connection of ours is told: it waits for no lock and for no lost client for long. A reader's pooler may refuse it.
const SETTINGS: &str =
    "SET lock_timeout = '2s'; SET idle_in_transaction_session_timeout = '5s'; SET synchronous_commit = on";

pub(super) struct Link {
    runtime: Runtime,
    connection: Option<PgConnection>,
    place: Place,
    failed: Option<Instant>,
    patience: Duration,
}

impl Link {
    pub(super) fn new(place: &Place) -> Result<Self> {
        let runtime = Builder::new_current_thread().enable_all().build();
        let runtime = runtime.map_err(|source| Error::Io { path: "PostgreSQL".into(), source })?;
        Ok(Self { runtime, connection: None, place: place.clone(), failed: None, patience: WORK })
    }

    /// Whole sites go through it from now on, or no longer.
    pub(super) fn whole(&mut self, on: bool) {
        self.patience = if on { WHOLE } else { WORK };
    }

    pub(super) fn place(&self) -> &Place {
        &self.place
    }

    /// Whether a failure to connect is so recent that it would most likely be the same.
    pub(super) fn rests(&self) -> bool {
        self.failed.is_some_and(|failed| failed.elapsed() < REST)
    }

    /// Does something beside the connection.
    pub(super) fn apart<T>(&self, work: impl Future<Output = T>) -> T {
        wait(&self.runtime, work)
    }

    /// Does something with the connection, once.
    pub(super) fn once<T>(&mut self, work: impl AsyncFnOnce(&mut PgConnection) -> Result<T>) -> Result<T> {
        self.connect()?;
        let Some(connection) = &mut self.connection else { return Err(self.unreachable("no connection")) };
        let worked =
            wait(&self.runtime, async { tokio::time::timeout(self.patience, work(connection)).await });
        match worked {
            Ok(Ok(value)) => Ok(value),
            Ok(Err(error)) => {
                if !matches!(&error, Error::Sql(error) if !is_broken(error)) {
                    self.drop_connection();
                }
                Err(self.said(error))
            }
            Err(_) => {
                self.drop_connection();
                Err(self.unreachable("it did not answer in time"))
            }
        }
    }

    /// Does something that may be done twice: again on a new connection where the old one broke, and again where it collided.
    pub(super) fn again<T>(
        &mut self,
        mut work: impl AsyncFnMut(&mut PgConnection) -> Result<T>,
    ) -> Result<T> {
        let had = self.connection.is_some();
        let first = self.once_uncollided(&mut work);
        match first {
            Err(Error::Postgres(Failure::Unreachable { .. })) if had => self.once_uncollided(&mut work),
            done => done,
        }
    }

    fn once_uncollided<T>(
        &mut self,
        work: &mut impl AsyncFnMut(&mut PgConnection) -> Result<T>,
    ) -> Result<T> {
        for tried in 1.. {
            let mut collided = false;
            let done = self.once(async |connection| {
                let done = work(connection).await;
                collided = matches!(&done, Err(Error::Sql(error)) if is_collision(error));
                if done.is_err() {
                    // a transaction that failed is ended before the connection serves again
                    sqlx::raw_sql("ROLLBACK").execute(&mut *connection).await.ok();
                }
                done
            });
            if !collided || tried >= TRIES {
                return done;
            }
            std::thread::sleep(Duration::from_millis(u64::from(tried) * 3));
        }
        Err(self.unreachable("it was never asked"))
    }

    fn connect(&mut self) -> Result<()> {
        if self.connection.is_some() {
            return Ok(());
        }
        let opened =
            wait(&self.runtime, async { tokio::time::timeout(CONNECTING, open(&self.place.options)).await });
        let opened = match opened {
            Ok(Ok(connection)) => Ok(connection),
            Ok(Err(error)) => Err(self.said(Error::Sql(error))),
            Err(_) => Err(self.unreachable("it did not answer in time")),
        };
        self.failed = opened.is_err().then(Instant::now);
        self.connection = Some(opened?);
        Ok(())
    }

    fn drop_connection(&mut self) {
        if let Some(connection) = self.connection.take() {
            let _inside = self.runtime.enter();
            drop(connection);
        }
    }

    fn unreachable(&self, reason: &str) -> Error {
        Failure::Unreachable { place: self.place.shown(), reason: reason.to_owned() }.into()
    }

    /// What PostgreSQL said, as a failure of ours.
    fn said(&self, error: Error) -> Error {
        let Error::Sql(error) = error else { return error };
        let place = self.place.shown();
        if let Some(reason) = unsafe_for(&error) {
            return Failure::Tls { place, reason }.into();
        }
        let database = error.as_database_error();
        let reason = database.map_or_else(|| error.to_string(), |error| error.message().to_owned());
        let failure = match database.and_then(|error| error.code()).as_deref() {
            Some("28000" | "28P01" | "3D000") => Failure::LetIn { place, reason },
            Some("42501") => Failure::Rights { place, reason },
            _ if is_broken(&error) => Failure::Unreachable { place, reason },
            _ => Failure::Sql(reason),
        };
        failure.into()
    }
}

impl Drop for Link {
    fn drop(&mut self) {
        if let Some(connection) = self.connection.take() {
            wait(&self.runtime, async {
                tokio::time::timeout(Duration::from_secs(1), connection.close()).await.ok();
            });
        }
    }
}

async fn open(options: &PgConnectOptions) -> sqlx::Result<PgConnection> {
    let mut connection = options.connect().await?;
    sqlx::raw_sql(SETTINGS).execute(&mut connection).await?;
    Ok(connection)
}

/// Why TLS is not as it was asked for.
fn unsafe_for(error: &sqlx::Error) -> Option<String> {
    match error {
        sqlx::Error::Tls(reason) | sqlx::Error::Configuration(reason) => Some(reason.to_string()),
        // what rustls says of a certificate
        sqlx::Error::Io(reason) if reason.kind() == std::io::ErrorKind::InvalidData => {
            Some(reason.to_string())
        }
        _ => None,
    }
}

/// Whether the connection serves no more, or never did.
fn is_broken(error: &sqlx::Error) -> bool {
    match error.as_database_error().and_then(|error| error.code()) {
        // told to end, starting, too many connections, lost in a transaction
        Some(code) => code.starts_with("57P") || code.starts_with("08") || code == "53300" || code == "25P03",
        None => matches!(error, sqlx::Error::Io(_) | sqlx::Error::Protocol(_) | sqlx::Error::WorkerCrashed),
    }
}

/// Whether a transaction collided with another one, so that it may be tried again.
pub(super) fn is_collision(error: &sqlx::Error) -> bool {
    let code = error.as_database_error().and_then(|error| error.code());
    matches!(code.as_deref(), Some("40001" | "40P01"))
}

/// Whether a lock was waited for in vain.
pub(super) fn is_locked(error: &sqlx::Error) -> bool {
    error.as_database_error().and_then(|error| error.code()).as_deref() == Some("55P03")
}
