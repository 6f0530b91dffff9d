//! Pages for `man` and completions for shells, made of the command line itself.

use std::path::PathBuf;

use clap::{Args, Command};
use clap_complete::Shell;

use super::output::line;
use crate::error::{Error, Result};

#[derive(Args, Debug)]
pub struct ManArgs {
    /// The folder in which they are made: `adit.1`, and a page for each verb
    pub folder: PathBuf,
}

#[derive(Args, Debug)]
pub struct CompletionsArgs {
    /// The shell that is to complete the words of `adit`
    pub shell: Shell,
}

/// Writes the pages into the folder, which is made where it is missing.
pub fn man(args: &ManArgs, command: Command) -> Result<()> {
    let folder = &args.folder;
    std::fs::create_dir_all(folder).map_err(|error| Error::io("make the folder", folder, &error))?;
    clap_mangen::generate_to(command, folder).map_err(|error| Error::io("write the pages", folder, &error))
}

/// Prints what the shell reads.
pub fn completions(args: &CompletionsArgs, mut command: Command) {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut command, "adit", &mut text);
    line(String::from_utf8_lossy(&text).trim_end());
}
