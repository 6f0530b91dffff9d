//! The program `adit-fleet`.

use std::process::ExitCode;

use adit_fleet::cli::{Cli, run};
use clap::Parser;

fn main() -> ExitCode {
    run(Cli::parse())
}
