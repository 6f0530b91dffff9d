//! The program `adit`.

use std::process::ExitCode;

use adit::cli::{Cli, run};
use clap::Parser;

fn main() -> ExitCode {
    run(&Cli::parse())
}
