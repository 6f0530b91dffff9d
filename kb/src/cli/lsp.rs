//! `adit lsp`: what an editor shows of rules, their tests and a site's files while one types, by the Language Server Protocol
//! over standard input and output.

mod complete;
mod hover;
mod library;
mod lines;
mod mirror;
mod occurrences;
mod project;
mod rename;
mod server;
mod test_names;
mod tokens;
mod vocabulary;

use clap::Args;
use lsp_server::Connection;

use self::server::{Server, capabilities};
use crate::error::{Code, Error, Result};

#[derive(Args, Debug)]
pub struct LspArgs {
    /// Taken, since editors say it: there is no other way
    #[arg(long)]
    pub stdio: bool,
}

/// Serves one editor, until it says goodbye.
pub fn run(_: &LspArgs) -> Result<()> {
    let (connection, threads) = Connection::stdio();
    let failed =
        |why: String| Error::said(Code::EditorLost, format!("the editor cannot be understood: {why}"), None);
    let abilities = serde_json::json!(capabilities());
    connection.initialize(abilities).map_err(|error| failed(error.to_string()))?;
    Server::new(&connection)?.run();
    drop(connection);
    threads.join().map_err(|error| failed(error.to_string()))
}
