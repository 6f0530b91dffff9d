//! The rule base: its files, as they are read and saved, and their versions.

use std::collections::BTreeMap;
use std::path::Path;

use adit_db::Cell;
use adit_engine::{Grid, SourceFile};
use axum::Json;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::edits::{self, Edited};
use super::extract::{Asked, Body, Named, Site};
use super::trial::TestsOf;
use crate::edit::{Edit, Write};
use crate::error::Code;
use crate::knowledge::generation;
use crate::live::View;
use crate::serve::fault::{Answered, Failure, Fault};
use crate::serve::gate::require;
use crate::serve::role::{Caller, Role};
use crate::serve::settings::{Known, Proposal};
use crate::site::base::Base;
use crate::site::journal::FILES;
use crate::site::rules::{self, version};
use crate::why::MadeTest;

#[derive(Serialize, ToSchema)]
pub struct RulesAnswer {
    generation: u64,
    /// The name of the folder in which the site's own rules are written.
    folder: String,
    /// The files of all rule bases that lie over each other, the lowest first.
    files: Vec<FileOf>,
    tests: Vec<FileOf>,
}

#[derive(Serialize, ToSchema)]
struct FileOf {
    /// Its name: of the site's own as `doors.rhai` or `tests/doors.toml`, of one beneath with its rule base before it, as
    /// `rooms/by-state/doors.rhai`.
    file: String,
    /// Whether it is one of the site's own: others are only read.
    own: bool,
    /// Names its text: whoever saves says what was read.
    version: String,
    text: String,
}

/// The rule base: its files, and its tests.
#[utoipa::path(get, path = "/api/rules", tag = "rules", responses((status = 200, body = RulesAnswer)))]
pub async fn list(site: Site) -> Answered<Json<RulesAnswer>> {
    let view = site.view.load().view.clone();
    site.beside(move || read(&view)).await.map(Json)
}

fn read(view: &View) -> Answered<RulesAnswer> {
    let site = view.site();
    let folder = site.rule_folder();
    let (mut files, mut tests) = (Vec::new(), Vec::new());
    for sources in rules::sources(&site.rule_bases())? {
        let own = sources.base.folder() == Some(&folder);
        let before = if own { String::new() } else { format!("{}/", beneath(&sources.base)) };
        let file = |prefix: &str, source: &SourceFile| {
            let name = Path::new(source.name()).file_name().unwrap_or_default().to_string_lossy();
            let file = format!("{before}{prefix}{name}");
            FileOf { file, own, version: version(source.text()), text: source.text().to_owned() }
        };
        files.extend(sources.rules.iter().map(|source| file("", source)));
        tests.extend(sources.tests.iter().map(|source| file("tests/", source)));
    }
    let folder = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok(RulesAnswer { generation: view.generation(), folder, files, tests })
}

/// A rule base beneath the site's own, as files are called by it.
fn beneath(base: &Base) -> String {
    match base {
        Base::Shipped(name) => name.clone(),
        Base::Folder(folder) => folder.file_name().unwrap_or_default().to_string_lossy().into_owned(),
    }
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct SaveBody {
    text: String,
    /// The version that was read before; null for a file that is new.
    version: Option<String>,
}

#[derive(Serialize, ToSchema)]
pub struct Saved {
    /// Number of the knowledge base's state from now on.
    generation: u64,
    /// Names the text; null where the file is gone.
    version: Option<String>,
    tests: Option<TestsOf>,
    /// Rooms with another hardness, action or passability.
    rooms: usize,
    /// Doors with another hardness, action or passability.
    doors: usize,
    /// Names the cut of the floor.
    layout: String,
}

/// Saves a rule file or a test of rules, if all rules are right with it and every test passes; else nothing is saved.
#[utoipa::path(put, path = "/api/rules/{*file}", tag = "rules", request_body = SaveBody,
    params(("file" = String, Path, description = "`doors.rhai`, or `tests/doors.toml`")),
    responses((status = 200, body = Saved), (status = 409, description = "the file is another by now", body = Failure),
        (status = 422, description = "the rules are wrong with it", body = Failure)))]
pub async fn save(
    site: Site,
    caller: Caller,
    Named(file): Named<String>,
    Body(body): Body<SaveBody>,
) -> Answered<Json<Saved>> {
    let SaveBody { text, version } = body;
    replace(&site, &caller, Write { file, text: Some(text), seen: version }).await.map(Json)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Version {
    version: Option<String>,
}

/// Takes a rule file away, if all rules are right without it.
#[utoipa::path(delete, path = "/api/rules/{*file}", tag = "rules",
    params(("file" = String, Path, description = "`doors.rhai`, or `tests/doors.toml`"),
           ("version" = Option<String>, Query, description = "The version that was read before")),
    responses((status = 200, body = Saved), (status = 409, body = Failure), (status = 422, body = Failure)))]
pub async fn remove(
    site: Site,
    caller: Caller,
    Named(file): Named<String>,
    Asked(Version { version }): Asked<Version>,
) -> Answered<Json<Saved>> {
    replace(&site, &caller, Write { file, text: None, seen: version }).await.map(Json)
}

/// Puts another text in place of a file's, or takes the file away; if the site cannot be built so, all is as it was.
async fn replace(site: &Site, caller: &Caller, write: Write) -> Answered<Saved> {
    require(caller, Role::Rules)?;
    let version = write.text.as_deref().map(version);
    let edited = edits::make(site, caller, Edit::Write(write), String::new()).await?;
    let Edited { generation, tests, rooms, doors, layout, .. } = edited;
    Ok(Saved { generation, version, tests, rooms, doors, layout })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct VersionsOf {
    file: String,
}

#[derive(Serialize, ToSchema)]
pub struct VersionsAnswer {
    generation: u64,
    file: String,
    /// The newest first. One that nobody saved here, but with another program, is there once something was saved over it.
    versions: Vec<VersionOf>,
}

#[derive(Serialize, ToSchema)]
struct VersionOf {
    /// Names the text: whoever saves another one says which was read.
    version: Option<String>,
    /// The text; null where there was no file.
    text: Option<String>,
    /// Since when, in UTC; null where another program saved it.
    at: Option<String>,
    who: Option<String>,
    why: Option<String>,
    /// The entry of the history that made it.
    edit: Option<i64>,
}

/// The texts that a rule file or a test of rules had, as the history has them.
#[utoipa::path(get, path = "/api/rules/versions", tag = "rules",
    params(("file" = String, Query, description = "`doors.rhai`, or `tests/doors.toml`")),
    responses((status = 200, body = VersionsAnswer)))]
pub async fn versions(
    site: Site,
    Asked(VersionsOf { file }): Asked<VersionsOf>,
) -> Answered<Json<VersionsAnswer>> {
    rules::check(&file, None)?;
    let path = site.view.load().view.site().rule_folder().join(&file);
    let answer = site.read(move |tx| {
        let entries = tx.history_of(FILES, Some(&file))?;
        let mut versions: Vec<VersionOf> = Vec::new();
        let mut put = |text: Option<String>, entry: Option<&adit_db::history::Edit>| {
            if versions.last().is_some_and(|last| last.text == text && entry.is_none()) {
                return;
            }
            versions.push(VersionOf {
                version: text.as_deref().map(version),
                text,
                at: entry.map(|entry| entry.at.clone()),
                who: entry.map(|entry| entry.who.clone()),
                why: entry.map(|entry| entry.why.clone()),
                edit: entry.map(|entry| entry.id),
            });
        };
        let text = |cell: &Cell| match cell {
            Cell::Text(text) => Some(text.clone()),
            _ => None,
        };
        let now = rules::text(&path)?;
        if entries.first().is_none_or(|newest| text(&newest.new) != now) {
            put(now, None);
        }
        for (place, entry) in entries.iter().enumerate() {
            put(text(&entry.new), Some(entry));
            let before = text(&entry.old);
            if entries.get(place + 1).is_none_or(|older| text(&older.new) != before) {
                put(before, None);
            }
        }
        Ok(VersionsAnswer { generation: generation::read(tx)?, file, versions })
    });
    answer.await.map(Json)
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct CompleteBody {
    file: String,
    text: String,
    /// Texts that stand in place of those of other files, too; null for one that would be gone.
    #[serde(default)]
    others: BTreeMap<String, Option<String>>,
    /// Before which character of the text, from 0, in UTF-16.
    at: usize,
}

#[derive(Serialize, ToSchema)]
pub struct CompleteAnswer {
    proposals: Vec<Proposal>,
}

/// What may stand at a place of a rule file: classes, properties, variables, words and functions. Role `rules`.
#[utoipa::path(post, path = "/api/rules/complete", tag = "rules", request_body = CompleteBody,
    responses((status = 200, body = CompleteAnswer)))]
pub async fn complete(
    site: Site,
    caller: Caller,
    Body(body): Body<CompleteBody>,
) -> Answered<Json<CompleteAnswer>> {
    require(&caller, Role::Rules)?;
    let CompleteBody { file, text, others, at } = body;
    rules::check(&file, Some(&text))?;
    for (file, text) in &others {
        rules::check(file, text.as_deref())?;
    }
    let (view, complete) = (site.view.load().view.clone(), site.settings.complete);
    let answer = site.at_length(move || {
        let mut units = 0;
        let before = |c: &char| {
            units += c.len_utf16();
            units <= at
        };
        let byte = text.chars().take_while(before).map(char::len_utf8).sum();
        let mut drafts = others;
        drafts.insert(file.clone(), Some(text));
        Ok(CompleteAnswer { proposals: complete(view.site(), &drafts, &file, byte)? })
    });
    answer.await.map(Json)
}

#[derive(Serialize, ToSchema)]
pub struct ClassesAnswer {
    /// By name.
    classes: Vec<Known>,
}

/// What rules may speak of: classes with their properties, the types of these, and what the manual says of them.
#[utoipa::path(get, path = "/api/rules/classes", tag = "rules", responses((status = 200, body = ClassesAnswer)))]
pub async fn classes(site: Site) -> Answered<Json<ClassesAnswer>> {
    let (view, classes) = (site.view.load().view.clone(), site.settings.classes);
    site.at_length(move || Ok(ClassesAnswer { classes: classes(view.site())? })).await.map(Json)
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct DecisionTablesBody {
    /// The file, as the list of rules calls it.
    file: String,
    /// A text in place of what is saved; it takes the role `rules`.
    #[serde(default)]
    text: Option<String>,
}

#[derive(Serialize, ToSchema)]
pub struct DecisionTablesAnswer {
    /// In the order of the file.
    #[schema(value_type = Vec<Object>)]
    tables: Vec<Grid>,
}

/// The decision tables of a rule file as people read them, with gaps, overlaps and rows that are never reached. A file that does
/// not read has none.
#[utoipa::path(post, path = "/api/rules/tables", tag = "rules", request_body = DecisionTablesBody,
    responses((status = 200, body = DecisionTablesAnswer)))]
pub async fn tables(
    site: Site,
    caller: Caller,
    Body(body): Body<DecisionTablesBody>,
) -> Answered<Json<DecisionTablesAnswer>> {
    if body.text.is_some() {
        require(&caller, Role::Rules)?;
    }
    let view = site.view.load().view.clone();
    let DecisionTablesBody { file, text } = body;
    let saved = |file: &str| -> Answered<Option<String>> {
        let found = read(&view)?.files.into_iter().find(|of| of.file == file);
        Ok(found.map(|of| of.text))
    };
    let Some(text) = text.map_or_else(|| saved(&file), |text| Ok(Some(text)))? else {
        return Err(Fault::new(Code::ServicePath, format!("no rule file is called `{file}`")));
    };
    let tables = site.at_length(move || Ok(Grid::of(&SourceFile::new(file, text))));
    Ok(Json(DecisionTablesAnswer { tables: tables.await? }))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct What {
    what: String,
}

/// A test of rules of what is there: it holds as long as rules say of an object what they say of it now. Role `rules`: it
/// runs.
#[utoipa::path(get, path = "/api/rules/test", tag = "rules",
    params(("what" = String, Query, description = "`room d`, `door 7`, `doors.7`")),
    responses((status = 200, body = MadeTest)))]
pub async fn made_test(
    site: Site,
    caller: Caller,
    Asked(What { what }): Asked<What>,
) -> Answered<Json<MadeTest>> {
    require(&caller, Role::Rules)?;
    site.on_fork(move |fork| fork.made_test(&what)).await.map(Json)
}
