//! What programs of bridges have in common: where they say things, and how they end.

use std::process::ExitCode;

/// Says something to whoever runs the program.
#[allow(clippy::print_stderr)] // it is the log
pub fn say(words: &str) {
    eprintln!("{words}");
}

/// How a program ends that ended so; 2 where something was wrong, which is said.
pub fn ended(how: anyhow::Result<()>) -> ExitCode {
    match how {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            say(&format!("error: {error:#}"));
            ExitCode::from(2)
        }
    }
}
