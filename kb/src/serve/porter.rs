//! Follows the file of tokens, on a thread of its own: who may come in does not wait for an edit.

use std::path::Path;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use super::shared::{Shared, Source};
use super::token::{self, Tokens};
use crate::error::problem::Problem;
use crate::error::{Code, Error, Result};

/// How often the file is looked at. What still changes is being written: it is taken when two looks agree.
const TICK: Duration = Duration::from_millis(200);

/// Works until the service ends.
pub fn start(shared: Arc<Shared>) -> Result<thread::JoinHandle<()>> {
    let file = token::file(&shared.settings.folder);
    let work = move || {
        let (mut looked, mut taken) = (None, None);
        while !*shared.ending.borrow() {
            let now = token::text(&file);
            if looked.as_ref() == Some(&now) && taken.as_ref() != Some(&now) {
                take(&shared, &file, Tokens::of(&file, &now));
                taken = Some(now.clone());
            }
            looked = Some(now);
            thread::sleep(TICK);
        }
    };
    let builder = thread::Builder::new().name("porter".to_owned());
    builder.spawn(work).map_err(Error::of(Code::ServeThread))
}

/// Takes the tokens as they now are. Where they cannot be read, those of before stay good.
fn take(shared: &Shared, file: &Path, read: Result<Option<Tokens>>) {
    let problems = match read {
        Ok(tokens) => {
            shared.tokens.send_if_modified(|known| {
                // who asked for tokens once asks for them until it ends, whatever becomes of the file
                let next = tokens.or_else(|| known.as_ref().map(|_| Tokens::default()));
                let is_other = *known != next;
                *known = next;
                is_other
            });
            let is_closed = shared.tokens.borrow().as_ref().is_some_and(|tokens| tokens.tokens.is_empty());
            if is_closed { Problem::all(token::none(file).problems()) } else { Vec::new() }
        }
        Err(error) => Problem::all(error.problems()),
    };
    shared.say_problems(Source::Tokens, problems);
}
