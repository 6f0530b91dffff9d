//! Has the desk look at once when another service on the site wrote something. Without hints it looks a few times a second.

use std::sync::Arc;
use std::thread;

use adit_db::postgres::{self, Place};

use super::desk::Desk;
use super::shared::Shared;
use crate::error::{Code, Error, Result};

/// Listens until the service ends.
pub fn start(shared: Arc<Shared>, place: Place, site: String) -> Result<thread::JoinHandle<()>> {
    let work = move || {
        let wanted = || !*shared.ending.borrow();
        let heard = || {
            shared.leave_at_desk(Desk::hear);
        };
        postgres::listen(&place, &site, wanted, heard);
    };
    thread::Builder::new().name("hints".to_owned()).spawn(work).map_err(Error::of(Code::ServeThread))
}
