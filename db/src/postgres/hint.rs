//! Hints that something was written, where PostgreSQL can give them.

use std::time::Duration;

use sqlx::postgres::{PgListener, PgPoolOptions};
use tokio::runtime::Builder;

use super::place::{CONNECTING, Place};

/// How long a hint is waited for before it is asked whether that is still wanted.
const WAIT: Duration = Duration::from_millis(250);

/// How long it is waited before it is tried again.
const REST: Duration = Duration::from_secs(2);

/// Where hints about a site are given: of a thousand sites in one database each service is woken for its own alone. A name has room
/// for 63 bytes, and a site's may be longer: what has the same sum is told apart by what is said.
pub(super) fn channel(site: &str) -> String {
    format!("adit_{:08x}", crc32fast::hash(site.as_bytes()))
}

/// Calls `heard` at each hint about the site, until `wanted` is no longer so. Where there are no hints nothing is called.
pub fn listen(place: &Place, site: &str, wanted: impl Fn() -> bool, heard: impl Fn()) {
    let Ok(runtime) = Builder::new_current_thread().enable_all().build() else { return };
    runtime.block_on(async {
        while wanted() {
            let options = PgPoolOptions::new().max_connections(1).acquire_timeout(CONNECTING);
            let pool = options.connect_lazy_with(place.options.clone());
            if let Ok(mut listener) = PgListener::connect_with(&pool).await
                && listener.listen(&channel(site)).await.is_ok()
            {
                heard();
                while wanted() {
                    match tokio::time::timeout(WAIT, listener.try_recv()).await {
                        Ok(Ok(Some(hint))) if hint.payload() == site => heard(),
                        Ok(Ok(Some(_))) | Err(_) => {}
                        Ok(_) => break,
                    }
                }
            }
            let mut rested = Duration::ZERO;
            while wanted() && rested < REST {
                tokio::time::sleep(WAIT).await;
                rested += WAIT;
            }
        }
    });
}
