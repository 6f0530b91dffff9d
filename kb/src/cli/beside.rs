//! Verbs that are programs of their own, which lie beside this one, so that nobody builds what they do not use.

use std::ffi::OsString;
use std::os::unix::process::CommandExt;
use std::process::Command;

use clap::Args;

use crate::error::{Code, Error, Result};

#[derive(Args, Debug)]
#[command(disable_help_flag = true)]
pub struct BesideArgs {
    /// Its arguments; `--help` lists them
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "ARGS")]
    pub args: Vec<OsString>,
}

/// Becomes the program `adit-NAME` that lies beside this one.
pub fn run(name: &str, args: &BesideArgs) -> Result<u8> {
    let beside =
        std::env::current_exe().ok().and_then(|here| Some(here.parent()?.join(format!("adit-{name}"))));
    let Some(program) = beside.filter(|program| program.is_file()) else {
        let message = format!("the program `adit-{name}` does not lie beside `adit`");
        let help =
            format!("`cargo install --locked --path bridges/{name}` in Adit's repository puts it there");
        return Err(Error::said(Code::ProgramMissing, message, Some(help)));
    };
    let error = Command::new(&program).args(&args.args).exec();
    Err(Error::io("start", &program, &error))
}
