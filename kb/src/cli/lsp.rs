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

use std::path::{Path, PathBuf};

use clap::Args;
use lsp_server::Connection;
use lsp_types::{CompletionItem, CompletionItemKind, Documentation};

use self::complete::complete;
use self::library::Library;
use self::project::Project;
use self::server::{Server, capabilities};
use self::vocabulary::Vocabulary;
use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::serve::settings::{Known, Proposal};
use crate::site::rules::Drafts;

fn absolute(path: &Path) -> Result<PathBuf> {
    std::path::absolute(path).map_err(|error| Error::io("find", path, &error))
}

/// The files of a site, as they are with these drafts.
fn library(site: &KnowledgeBase, drafts: &Drafts) -> Result<Library> {
    let (home, folder) = (absolute(&site.site().folder)?, absolute(&site.rule_folder())?);
    let texts = drafts.iter().filter_map(|(file, text)| Some((folder.join(file), text.clone()?)));
    Ok(Library::read(&Project::Site(home), &texts.collect(), Path::new("")))
}

/// What rules of a site may speak of: its classes with their properties.
pub fn classes(site: &KnowledgeBase) -> Result<Vec<Known>> {
    let (library, vocabulary) = (library(site, &Drafts::default())?, Vocabulary::new(site.classes()?));
    let mut found: Vec<Known> = complete::classes(&library, &vocabulary)
        .into_iter()
        .map(|class| Known {
            properties: complete::properties(&library, &vocabulary, library.classes.root(&class.label))
                .into_iter()
                .map(proposal)
                .collect(),
            class: proposal(class),
        })
        .collect();
    found.sort_by(|one, other| one.class.text.cmp(&other.class.text));
    Ok(found)
}

/// What may stand at a byte of a rule file of a site, as it is with these drafts.
pub fn propose(site: &KnowledgeBase, drafts: &Drafts, file: &str, byte: usize) -> Result<Vec<Proposal>> {
    let (library, folder) = (library(site, drafts)?, absolute(&site.rule_folder())?);
    let Some(of) = library.file(&folder.join(file)).filter(|_| !file.starts_with("tests/")) else {
        return Ok(Vec::new());
    };
    let vocabulary = Vocabulary::new(site.classes()?);
    Ok(complete(&library, &vocabulary, of, byte).into_iter().map(proposal).collect())
}

fn proposal(item: CompletionItem) -> Proposal {
    Proposal {
        text: item.label,
        kind: match item.kind {
            Some(CompletionItemKind::CLASS) => "class",
            Some(CompletionItemKind::FIELD) => "property",
            Some(CompletionItemKind::VARIABLE) => "variable",
            Some(CompletionItemKind::FUNCTION) => "function",
            _ => "word",
        },
        detail: item.detail,
        what: item.documentation.map(|said| match said {
            Documentation::String(text) => text,
            Documentation::MarkupContent(said) => said.value,
        }),
    }
}

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
