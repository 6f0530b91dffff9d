//! The program `adit-ros`.

use std::process::ExitCode;

use adit_ros::cli::{Cli, run};
use clap::Parser;

fn main() -> ExitCode {
    run(Cli::parse())
}
