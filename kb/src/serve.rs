//! `adit serve`: the knowledge base over HTTP, with live events, and the page where an expert tunes it.
//!
//! Requests read a [`View`](crate::live::View) that no edit changes; edits are made one after the other at a
//! [desk](desk). What comes in passes the [gate](gate), what goes wrong leaves as one shape of JSON ([`fault`]).

mod desk;
mod event;
mod fault;
mod follower;
mod gate;
mod hints;
mod http;
mod listen;
mod meter;
mod page;
mod patient;
mod porter;
mod question;
pub(crate) mod role;
mod routes;
pub(crate) mod settings;
mod share;
mod shared;
pub(crate) mod token;
mod waiting;
mod whereabouts;

use std::sync::Arc;
use std::sync::mpsc::sync_channel;
use std::thread;
use std::time::{Duration, Instant};

use crate::error::{Code, Error, Result};
use crate::live::{Copy, Live};
use crate::site::lock;
use settings::Settings;
use shared::Shared;
use token::Tokens;

/// Jobs that may wait to be done one after the other.
const QUEUE: usize = 1_024;

/// How long an edit may still take when the service ends.
const FAREWELL: Duration = Duration::from_secs(10);

/// Serves a site until the program is told to end. `false` where another program reads the database at the end, so that
/// the newest edits are not in its file yet.
///
/// # Arguments
/// `ready` hears the address once requests are answered.
pub fn run(mut settings: Settings, ready: impl FnOnce(std::net::SocketAddr)) -> Result<bool> {
    // until the service ends
    let mut _alone = None;
    let mut copy = None;
    let mut live = if let Some(place) = settings.shared.clone() {
        let name = settings.shared_name(&place);
        let made = Copy::make(&place, &name, &settings.folder)?;
        (settings.database, copy) = (Some(made.database.clone()), Some((place, name)));
        let again = settings.clone();
        Live::open_shared(made, move || again.open())?
    } else {
        let site = settings.open()?;
        _alone = Some(lock::database(site.database())?);
        Live::open(site)?
    };
    let tokens = tokens(&settings)?;
    live.share()?;
    live.prepare();
    // what others wrote while the copy was made and opened; what cannot be followed now is followed by the desk, which says why
    live.follow_others().ok();
    let (jobs, waiting) = sync_channel(QUEUE);
    let shared = Arc::new(Shared::new(settings, desk::seen(&live), tokens, jobs));
    let desk = desk::start(live, Arc::clone(&shared), waiting)?;
    let watcher = routes::start(Arc::clone(&shared))?;
    let porter = porter::start(Arc::clone(&shared))?;
    let hints = match &copy {
        Some((place, name)) => Some(hints::start(Arc::clone(&shared), place.clone(), name.clone())?),
        None => None,
    };
    let served = listen::serve(&shared, ready);
    shared.ending.send_replace(true);
    let began = Instant::now();
    while !(desk.is_finished() && watcher.is_finished() && porter.is_finished()) {
        if began.elapsed() > FAREWELL {
            let message = "an edit was still at work and was broken off: nothing of it is kept";
            return Err(Error::said(Code::ServeBrokenOff, message, None));
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let (desk, watcher, porter) = (desk.join(), watcher.join(), porter.join());
    hints.map(thread::JoinHandle::join);
    served?;
    shared.stop_reading();
    match (desk, watcher, porter) {
        // a copy is made anew the next time
        (Ok(_), Ok(()), Ok(())) if copy.is_some() => Ok(true),
        (Ok(live), Ok(()), Ok(())) => live.unshare(),
        _ => Err(Error::said(Code::ServeEnded, "the service ended by a defect of its own", None)),
    }
}

/// The tokens to begin with. Without them the service is for those on this machine alone: it neither listens to others,
/// nor answers by the name that a proxy calls it by.
fn tokens(settings: &Settings) -> Result<Option<Tokens>> {
    let file = token::file(&settings.folder);
    match Tokens::read(&file)? {
        Some(tokens) if tokens.tokens.is_empty() => Err(token::none(&file)),
        Some(tokens) => Ok(Some(tokens)),
        None => {
            let elsewhere = match settings.hosts.first() {
                _ if !settings.listen.ip().is_loopback() => settings.listen.to_string(),
                Some(name) => name.clone(),
                None => return Ok(None),
            };
            let message = format!("{elsewhere} can be reached from elsewhere, and the site has no tokens");
            let help = "`adit token SITE add NAME --role tune` makes one".to_owned();
            Err(Error::said(Code::ServeNoTokens, message, Some(help)))
        }
    }
}
