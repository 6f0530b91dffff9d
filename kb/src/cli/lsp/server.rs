//! The conversation with an editor: what it opens and changes, and what it asks.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

use lsp_server::{Connection, ErrorCode, Message, Notification, Request, Response};
use lsp_types::notification::{
    DidChangeTextDocument, DidCloseTextDocument, DidOpenTextDocument, DidSaveTextDocument, Notification as _,
    PublishDiagnostics,
};
use lsp_types::request::{
    Completion, DocumentSymbolRequest, GotoDefinition, HoverRequest, PrepareRenameRequest, References,
    Rename, Request as _,
};
use lsp_types::{
    CompletionOptions, CompletionParams, Diagnostic, DiagnosticSeverity, DidChangeTextDocumentParams,
    DidCloseTextDocumentParams, DidOpenTextDocumentParams, DocumentSymbol, DocumentSymbolParams,
    DocumentSymbolResponse, GotoDefinitionParams, Hover, HoverContents, HoverParams, HoverProviderCapability,
    Location, MarkupContent, MarkupKind, NumberOrString, OneOf, Position, PublishDiagnosticsParams,
    ReferenceParams, RenameOptions, RenameParams, ServerCapabilities, SymbolKind, TextDocumentPositionParams,
    TextDocumentSyncCapability, TextDocumentSyncKind, TextEdit, Uri, WorkspaceEdit,
};
use percent_encoding::{AsciiSet, CONTROLS, percent_decode_str, utf8_percent_encode};
use serde::de::DeserializeOwned;
use serde_json::Value;
use tempfile::TempDir;

use super::complete::complete;
use super::hover;
use super::library::{File, Library};
use super::lines;
use super::occurrences::{Named, Occurrence, Role};
use super::project::{Checked, Project};
use super::rename;
use super::tokens::{Kind, tokens};
use super::vocabulary::Vocabulary;
use crate::error::{Error, Problem, Result};

/// How long nothing has to be typed before the project is looked at.
const PAUSE: Duration = Duration::from_millis(150);

/// What the server can do.
pub fn capabilities() -> ServerCapabilities {
    ServerCapabilities {
        text_document_sync: Some(TextDocumentSyncCapability::Kind(TextDocumentSyncKind::FULL)),
        completion_provider: Some(CompletionOptions {
            trigger_characters: Some(vec![".".to_owned()]),
            ..CompletionOptions::default()
        }),
        hover_provider: Some(HoverProviderCapability::Simple(true)),
        definition_provider: Some(OneOf::Left(true)),
        references_provider: Some(OneOf::Left(true)),
        document_symbol_provider: Some(OneOf::Left(true)),
        rename_provider: Some(OneOf::Right(RenameOptions {
            prepare_provider: Some(true),
            work_done_progress_options: lsp_types::WorkDoneProgressOptions::default(),
        })),
        ..ServerCapabilities::default()
    }
}

type Drafts = BTreeMap<PathBuf, String>;

pub struct Server<'c> {
    connection: &'c Connection,
    /// What stands in the editor.
    drafts: Drafts,
    shipped: TempDir,
    vocabularies: BTreeMap<Project, Vocabulary>,
    /// The files of each project that something was said of.
    said: BTreeMap<Project, BTreeSet<PathBuf>>,
    looks: Sender<(Project, Drafts)>,
    looked: Receiver<(Project, Checked)>,
}

impl<'c> Server<'c> {
    pub fn new(connection: &'c Connection) -> Result<Self> {
        let shipped = tempfile::Builder::new().prefix("adit-lsp-shipped-").tempdir();
        let shipped = shipped.map_err(|error| Error::io("make", &std::env::temp_dir(), &error))?;
        let (looks, wanted) = channel();
        let (found, looked) = channel();
        std::thread::spawn(move || look(&wanted, &found));
        Ok(Self {
            connection,
            drafts: Drafts::new(),
            shipped,
            vocabularies: BTreeMap::new(),
            said: BTreeMap::new(),
            looks,
            looked,
        })
    }

    /// Answers until the editor says goodbye.
    pub fn run(&mut self) {
        loop {
            while let Ok((project, checked)) = self.looked.try_recv() {
                self.publish(&project, checked);
            }
            let message = match self.connection.receiver.recv_timeout(Duration::from_millis(50)) {
                Ok(message) => message,
                Err(timeout) if timeout.is_timeout() => continue,
                Err(_) => return,
            };
            match message {
                Message::Request(request) => match self.connection.handle_shutdown(&request) {
                    Ok(false) => {
                        let answer = self.answer(&request);
                        self.send(Message::Response(answer));
                    }
                    Ok(true) | Err(_) => return,
                },
                Message::Notification(heard) => self.hear(heard),
                Message::Response(_) => {}
            }
        }
    }

    fn send(&self, message: Message) {
        // an editor that is gone ends the loop at the next message
        self.connection.sender.send(message).ok();
    }

    fn hear(&mut self, heard: Notification) {
        match heard.method.as_str() {
            DidOpenTextDocument::METHOD => {
                if let Some((path, params)) =
                    read(heard.params, |p: &DidOpenTextDocumentParams| &p.text_document.uri)
                {
                    self.drafts.insert(path.clone(), params.text_document.text);
                    self.look_at(&path);
                }
            }
            DidChangeTextDocument::METHOD => {
                if let Some((path, params)) =
                    read(heard.params, |p: &DidChangeTextDocumentParams| &p.text_document.uri)
                    && let Some(last) = params.content_changes.into_iter().last()
                {
                    self.drafts.insert(path.clone(), last.text);
                    self.look_at(&path);
                }
            }
            DidCloseTextDocument::METHOD => {
                if let Some((path, _)) =
                    read(heard.params, |p: &DidCloseTextDocumentParams| &p.text_document.uri)
                {
                    self.drafts.remove(&path);
                    self.look_at(&path);
                }
            }
            DidSaveTextDocument::METHOD => {
                let of = |params: &lsp_types::DidSaveTextDocumentParams| params.text_document.uri.clone();
                if let Some(path) =
                    serde_json::from_value(heard.params).ok().and_then(|params| path_of(&of(&params)))
                {
                    self.look_at(&path);
                }
            }
            _ => {}
        }
    }

    fn look_at(&self, path: &Path) {
        if let Some(project) = Project::of(path) {
            self.looks.send((project, self.drafts.clone())).ok();
        }
    }

    /// Says what is wrong in each file, and of files in which nothing is wrong any more, so.
    fn publish(&mut self, project: &Project, checked: Checked) {
        if let Some(vocabulary) = checked.vocabulary {
            self.vocabularies.insert(project.clone(), vocabulary);
        }
        let before = self.said.remove(project).unwrap_or_default();
        let now: BTreeSet<PathBuf> = checked.problems.keys().cloned().collect();
        for path in before.union(&now) {
            let text = self.text(path);
            let problems = checked.problems.get(path).into_iter().flatten();
            let diagnostics = problems.map(|problem| said(problem, &text)).collect();
            let Some(uri) = uri_of(path) else { continue };
            let params = PublishDiagnosticsParams { uri, diagnostics, version: None };
            self.send(Message::Notification(Notification::new(
                PublishDiagnostics::METHOD.to_owned(),
                params,
            )));
        }
        self.said.insert(project.clone(), now);
    }

    fn text(&self, path: &Path) -> String {
        self.drafts.get(path).cloned().or_else(|| std::fs::read_to_string(path).ok()).unwrap_or_default()
    }

    fn answer(&self, request: &Request) -> Response {
        let id = request.id.clone();
        let params = request.params.clone();
        let answered = match request.method.as_str() {
            Completion::METHOD => parsed(params).map(|params| self.complete(&params)),
            HoverRequest::METHOD => parsed(params).map(|params| self.hover(&params)),
            GotoDefinition::METHOD => parsed(params).map(|params| self.definition(&params)),
            References::METHOD => parsed(params).map(|params| self.references(&params)),
            DocumentSymbolRequest::METHOD => parsed(params).map(|params| self.symbols(&params)),
            PrepareRenameRequest::METHOD => parsed(params).map(|params| self.prepare_rename(&params)),
            Rename::METHOD => parsed(params).and_then(|params| self.rename(&params)),
            other => {
                let message = format!("`{other}` is nothing that this server does");
                return Response::new_err(id, ErrorCode::MethodNotFound as i32, message);
            }
        };
        match answered {
            Ok(value) => Response::new_ok(id, value),
            Err(message) => Response::new_err(id, ErrorCode::InvalidParams as i32, message),
        }
    }

    /// The library of the project of a file, with the vocabulary that is known of it.
    fn library(&self, path: &Path) -> Option<(Library, Vocabulary)> {
        let project = Project::of(path)?;
        let vocabulary = self.vocabularies.get(&project).cloned().unwrap_or_default();
        Some((Library::read(&project, &self.drafts, self.shipped.path()), vocabulary))
    }

    /// The name at a place, with all that its project knows.
    fn at<T>(
        &self,
        place: &TextDocumentPositionParams,
        what: impl FnOnce(&Library, &Vocabulary, &File, &Occurrence) -> T,
    ) -> Option<T> {
        let path = path_of(&place.text_document.uri)?;
        let (library, vocabulary) = self.library(&path)?;
        let byte = lines::offset(&library.file(&path)?.text, place.position);
        let (file, found) = library.at(&path, byte)?;
        Some(what(&library, &vocabulary, file, found))
    }

    fn complete(&self, params: &CompletionParams) -> Value {
        let place = &params.text_document_position;
        let proposals = path_of(&place.text_document.uri).and_then(|path| {
            let (library, vocabulary) = self.library(&path)?;
            let file = library.file(&path).filter(|_| path.extension().is_some_and(|kind| kind == "rhai"))?;
            Some(complete(&library, &vocabulary, file, lines::offset(&file.text, place.position)))
        });
        serde_json::json!(proposals.unwrap_or_default())
    }

    fn hover(&self, params: &HoverParams) -> Value {
        let place = &params.text_document_position_params;
        let named = self.at(place, |library, vocabulary, file, found| {
            (hover::of_name(library, vocabulary, file, found), Some(lines::span(&file.text, &found.span)))
        });
        let word = || {
            let text = self.text(&path_of(&place.text_document.uri)?);
            let byte = lines::offset(&text, place.position);
            let all = tokens(&text);
            let word = all.iter().find(|token| token.start <= byte && byte < token.span().end)?;
            let word = Some(word).filter(|word| word.kind == Kind::Name)?;
            Some((hover::of_word(word.text)?, Some(lines::span(&text, &word.span()))))
        };
        let found = named.or_else(word).map(|(value, range)| {
            let contents = HoverContents::Markup(MarkupContent { kind: MarkupKind::Markdown, value });
            Hover { contents, range }
        });
        serde_json::json!(found)
    }

    fn definition(&self, params: &GotoDefinitionParams) -> Value {
        let places = self.at(&params.text_document_position_params, |library, _, file, found| {
            let all: Vec<_> = library.all(&found.named, &file.path).collect();
            let of = |role| {
                all.iter().filter(|(_, found)| found.role == role).filter_map(Self::location).collect()
            };
            let declared: Vec<Location> = of(Role::Declared);
            let set: Vec<Location> = of(Role::Set);
            let is_property = matches!(found.named, Named::Property(..));
            let places = if is_property && !set.is_empty() { set } else { declared };
            if places.is_empty() { table(&found.named, &file.path) } else { places }
        });
        serde_json::json!(places.unwrap_or_default())
    }

    fn references(&self, params: &ReferenceParams) -> Value {
        let places: Option<Vec<Location>> =
            self.at(&params.text_document_position, |library, _, file, found| {
                let all = library.all(&found.named, &file.path);
                let wanted = all
                    .filter(|(_, found)| params.context.include_declaration || found.role != Role::Declared);
                let all: Vec<_> = wanted.collect();
                all.iter().filter_map(Self::location).collect()
            });
        serde_json::json!(places.unwrap_or_default())
    }

    /// Where a name stands; a file that the program carries is written out, to be looked at.
    fn location((file, found): &(&File, &Occurrence)) -> Option<Location> {
        if !file.is_own && !file.path.exists() {
            std::fs::create_dir_all(file.path.parent()?).ok()?;
            std::fs::write(&file.path, &file.text).ok()?;
            let mut rights = std::fs::metadata(&file.path).ok()?.permissions();
            rights.set_readonly(true);
            std::fs::set_permissions(&file.path, rights).ok()?;
        }
        Some(Location::new(uri_of(&file.path)?, lines::span(&file.text, &found.span)))
    }

    fn symbols(&self, params: &DocumentSymbolParams) -> Value {
        let found = path_of(&params.text_document.uri).and_then(|path| {
            let (library, _) = self.library(&path)?;
            let file = library.file(&path)?;
            let symbols = file.names.items.iter().map(|item| {
                let kind = match item.word.as_str() {
                    "class" => SymbolKind::CLASS,
                    "property" => SymbolKind::PROPERTY,
                    "const" => SymbolKind::CONSTANT,
                    "table" => SymbolKind::ARRAY,
                    _ => SymbolKind::FUNCTION,
                };
                let end = item.span.start + file.text[item.span.clone()].trim_end().len();
                #[allow(deprecated)] // the type has no other constructor
                DocumentSymbol {
                    name: if item.name.is_empty() { item.word.clone() } else { item.name.clone() },
                    detail: Some(item.word.clone()),
                    kind,
                    tags: None,
                    deprecated: None,
                    range: lines::span(&file.text, &(item.span.start..end)),
                    selection_range: lines::span(&file.text, &item.name_span),
                    children: None,
                }
            });
            Some(DocumentSymbolResponse::Nested(symbols.collect()))
        });
        serde_json::json!(found)
    }

    fn prepare_rename(&self, place: &TextDocumentPositionParams) -> Value {
        let span = self.at(place, |_, _, file, found| lines::span(&file.text, &found.span));
        serde_json::json!(span)
    }

    fn rename(&self, params: &RenameParams) -> std::result::Result<Value, String> {
        let project =
            path_of(&params.text_document_position.text_document.uri).and_then(|path| Project::of(&path));
        if project.is_some_and(|of| matches!(of, Project::Site(_)) && !self.vocabularies.contains_key(&of)) {
            return Err("the site is still being looked at, or was never built: what comes from its tables and map is not known yet".to_owned());
        }
        let edits = self.at(&params.text_document_position, |library, vocabulary, file, found| {
            let places = rename::places(library, vocabulary, (&found.named, &file.path), &params.new_name)?;
            let mut edits: Vec<(Uri, Vec<TextEdit>)> = Vec::new();
            for (file, found) in places {
                let edit = TextEdit::new(lines::span(&file.text, &found.span), params.new_name.clone());
                let Some(uri) = uri_of(&file.path) else { continue };
                match edits.last_mut().filter(|(last, _)| *last == uri) {
                    Some((_, edits)) => edits.push(edit),
                    None => edits.push((uri, vec![edit])),
                }
            }
            #[allow(clippy::mutable_key_type)] // the protocol's type has addresses as keys
            let changes = edits.into_iter().collect();
            Ok::<_, String>(WorkspaceEdit::new(changes))
        });
        let edits = edits.ok_or("nothing that has a name of its own stands here")??;
        Ok(serde_json::json!(edits))
    }
}

/// Looks at projects, each as it is when nothing more is typed.
fn look(wanted: &Receiver<(Project, Drafts)>, found: &Sender<(Project, Checked)>) {
    let mut waiting: BTreeMap<Project, Drafts> = BTreeMap::new();
    loop {
        if waiting.is_empty() {
            let Ok((project, drafts)) = wanted.recv() else { return };
            waiting.insert(project, drafts);
        }
        while let Ok((project, drafts)) = wanted.recv_timeout(PAUSE) {
            waiting.insert(project, drafts);
        }
        if let Some((project, drafts)) = waiting.pop_first() {
            let checked = project.check(&drafts);
            if found.send((project, checked)).is_err() {
                return;
            }
        }
    }
}

/// The table that a class is of, where it is a file: for names that no rule declares.
fn table(named: &Named, from: &Path) -> Vec<Location> {
    let (Named::Class(class) | Named::Property(class, _)) = named else { return Vec::new() };
    let Some(Project::Site(folder)) = Project::of(from) else { return Vec::new() };
    let file = match class.as_str() {
        "ROBOTS" | "CHANGES" | "LOADS" => folder.join("robots.toml"),
        class => folder.join("tables").join(format!("{}.csv", class.to_lowercase())),
    };
    let start = lsp_types::Range::new(Position::new(0, 0), Position::new(0, 0));
    let place = file.is_file().then(|| uri_of(&file)).flatten().map(|uri| Location::new(uri, start));
    place.into_iter().collect()
}

fn said(problem: &Problem, text: &str) -> Diagnostic {
    let start = lines::said(text, problem.line.unwrap_or(1), problem.column.unwrap_or(1));
    let end = problem
        .end_line
        .zip(problem.end_column)
        .map_or(start, |(line, column)| lines::said(text, line, column));
    let help = problem.help.as_ref().map(|help| format!("\n{help}")).unwrap_or_default();
    let severity = match problem.severity {
        "error" => DiagnosticSeverity::ERROR,
        "warning" => DiagnosticSeverity::WARNING,
        _ => DiagnosticSeverity::INFORMATION,
    };
    Diagnostic {
        range: lsp_types::Range::new(start, end),
        severity: Some(severity),
        code: problem.code.map(|code| NumberOrString::String(code.to_string())),
        source: Some("adit".to_owned()),
        message: format!("{}{help}", problem.message),
        ..Diagnostic::default()
    }
}

fn parsed<P: DeserializeOwned>(params: Value) -> std::result::Result<P, String> {
    serde_json::from_value(params).map_err(|error| format!("what was asked cannot be read: {error}"))
}

fn read<P: DeserializeOwned>(params: Value, uri: impl Fn(&P) -> &Uri) -> Option<(PathBuf, P)> {
    let params: P = serde_json::from_value(params).ok()?;
    Some((path_of(uri(&params))?, params))
}

/// The file that an address names; of anything but a file, none.
fn path_of(uri: &Uri) -> Option<PathBuf> {
    let text = uri.as_str().strip_prefix("file://")?;
    let path = percent_decode_str(&text[text.find('/')?..]).decode_utf8().ok()?.into_owned();
    Some(PathBuf::from(path))
}

/// What stands for itself in the path of an address, and is no letter or digit.
const APART: &AsciiSet = &CONTROLS
    .add(b' ')
    .add(b'"')
    .add(b'#')
    .add(b'%')
    .add(b'<')
    .add(b'>')
    .add(b'?')
    .add(b'[')
    .add(b']')
    .add(b'^')
    .add(b'`')
    .add(b'{')
    .add(b'|')
    .add(b'}')
    .add(b'\\');

fn uri_of(path: &Path) -> Option<Uri> {
    let path = utf8_percent_encode(path.to_str()?, APART).to_string();
    Uri::from_str(&format!("file://{path}")).ok()
}
