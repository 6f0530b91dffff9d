//! The rule base: its files, tried and saved.

use std::fs;
use std::path::{Path, PathBuf};

use adit_engine::SourceFile;
use axum::Json;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use utoipa::ToSchema;

use super::extract::Site;
use super::extract::{Asked, Body, Named};
use crate::error::problem::Problem;
use crate::error::{Code, Error};
use crate::knowledge::Tested;
use crate::live::View;
use crate::serve::desk::{Cause, Desk};
use crate::serve::fault::{Answered, Failure, Fault};
use crate::serve::gate::require;
use crate::serve::role::{Caller, Role};
use crate::serve::token::hex;
use crate::site::base::Base;
use crate::site::{rules, whole};

/// The longest rule file, bytes.
const LONGEST: usize = 1 << 20;
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

fn version(text: &str) -> String {
    hex(&Sha256::digest(text.as_bytes())[..8])
}

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct CheckBody {
    file: String,
    text: String,
}

#[derive(Serialize, ToSchema)]
pub struct Checked {
    /// What is wrong with the rules, each with its place.
    problems: Vec<Problem>,
    /// What the tests gave; null where rules are wrong, so that no test runs.
    tests: Option<TestsOf>,
}

#[derive(Serialize, ToSchema)]
pub struct TestsOf {
    passed: usize,
    failed: usize,
    /// What failed, each with its place.
    failures: Vec<Problem>,
}

impl TestsOf {
    fn of(tested: Tested, folder: &Path) -> Self {
        let failed = tested.outcomes.iter().filter(|outcome| !outcome.failures.is_empty()).count();
        let passed = tested.outcomes.len() - failed;
        let failures = tested.outcomes.into_iter().flat_map(|outcome| outcome.failures);
        let failures =
            failures.map(|failure| near(Problem::of(&failure.diagnostic.into()), folder)).collect();
        Self { passed, failed, failures }
    }
}

/// A problem that names its file as the folder does.
fn near(mut problem: Problem, folder: &Path) -> Problem {
    if let Some(file) = &problem.file
        && let Ok(file) = Path::new(file).strip_prefix(folder)
    {
        problem.file = Some(file.display().to_string());
    }
    problem
}

fn near_all(error: &Error, folder: &Path) -> Vec<Problem> {
    Problem::all(error.problems()).into_iter().map(|problem| near(problem, folder)).collect()
}

/// Tries a text in place of a file's: compiled, checked, and tested with the tests beside the rules, in 10 s at most.
/// Nothing is saved. Role `rules`: what is tried runs.
#[utoipa::path(post, path = "/api/rules/check", tag = "rules", request_body = CheckBody,
    responses((status = 200, body = Checked)))]
pub async fn check(site: Site, caller: Caller, Body(body): Body<CheckBody>) -> Answered<Json<Checked>> {
    require(&caller, Role::Rules)?;
    check_name(&body.file)?;
    check_length(&body.text)?;
    let view = site.view.load().view.clone();
    let checked = site.at_length(move || {
        let (site, folder) = (view.site(), view.site().rule_folder());
        Ok(match site.try_rules(&body.file, Some(&body.text)) {
            Ok(tested) => Checked { problems: Vec::new(), tests: Some(TestsOf::of(tested, &folder)) },
            Err(error) => Checked { problems: near_all(&error, &folder), tests: None },
        })
    });
    checked.await.map(Json)
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
    require(&caller, Role::Rules)?;
    check_name(&file)?;
    check_length(&body.text)?;
    let SaveBody { text, version } = body;
    site.edit_at_desk(move |desk| replace(desk, &caller, (&file, Some(text)), version.as_deref()))
        .await
        .map(Json)
}

#[derive(Deserialize)]
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
    require(&caller, Role::Rules)?;
    check_name(&file)?;
    site.edit_at_desk(move |desk| replace(desk, &caller, (&file, None), version.as_deref())).await.map(Json)
}

/// Puts another text in place of a file's, or takes the file away; if the site cannot be built so, all is as it was.
fn replace(
    desk: &mut Desk,
    caller: &Caller,
    (file, text): (&str, Option<String>),
    read: Option<&str>,
) -> Answered<Saved> {
    let site = desk.shared.settings.open()?;
    let folder = site.rule_folder();
    let path = folder.join(file);
    let before = fs::read_to_string(&path).ok();
    if before.is_none() && text.is_none() {
        return Err(Fault::new(Code::RulesUnknownFile, format!("there is no rule file {file}")));
    }
    if before.is_some() && read.is_none() {
        let message = format!("{file} is there already: say the version that was read");
        return Err(
            Fault::new(Code::RulesConflict, message).helped("GET /api/rules says the version of each file")
        );
    }
    if before.as_deref().map(version).as_deref() != read {
        let message = format!("{file} is another by now: somebody saved it since it was read");
        return Err(
            Fault::new(Code::RulesConflict, message).helped("read it again, then make the change again")
        );
    }
    let refused = |error: Error| {
        let problems = near_all(&error, &folder);
        Fault::from(error).with_problems(problems)
    };
    let tested = site.try_rules(file, text.as_deref()).map_err(refused)?;
    let tests = TestsOf::of(tested, &folder);
    if tests.failed > 0 {
        let message = format!("{} of {} tests of the rules fail", tests.failed, tests.failed + tests.passed);
        return Err(Fault::new(Code::RulesTests, message).with_problems(tests.failures));
    }
    let made = !folder.exists();
    let kept = Kept::of(&path, before.as_deref())?;
    let taken = put(&path, text.as_deref()).and_then(|()| {
        let site = desk.shared.settings.open()?;
        desk.live.open_again(site).map_err(refused)
    });
    let outcome = match taken {
        Ok(outcome) => outcome,
        Err(fault) => {
            kept.back();
            if made {
                fs::remove_dir_all(&folder).ok();
            }
            return Err(fault);
        }
    };
    drop(kept);
    let doing = if text.is_some() { "saved" } else { "removed" };
    desk.publish(
        &outcome,
        &Cause { who: caller.name.clone(), why: String::new(), what: format!("{file} {doing}") },
    );
    desk.files_are_taken();
    Ok(Saved {
        generation: outcome.generation,
        version: text.as_deref().map(version),
        tests: Some(tests),
        rooms: outcome.rooms,
        doors: outcome.doors,
        layout: desk.live.view().layout().to_owned(),
    })
}

/// A file as it was, beside itself: going back to it takes no room on the disk.
struct Kept<'p> {
    path: &'p Path,
    beside: Option<PathBuf>,
}

impl<'p> Kept<'p> {
    fn of(path: &'p Path, text: Option<&str>) -> Answered<Self> {
        let kept = Self { path, beside: text.map(|_| path.with_extension("old")) };
        let written = kept
            .beside
            .iter()
            .zip(text)
            .try_for_each(|(old, text)| whole::write_beside(old, text.as_bytes()));
        written.map_err(|error| Error::io("write", path, &error))?;
        Ok(kept)
    }

    /// On a disk that syncs nothing any more all is as it was for whoever reads the file.
    fn back(&self) {
        match &self.beside {
            Some(beside) => whole::replace(self.path, beside),
            None => whole::remove(self.path),
        }
        .ok();
    }
}

impl Drop for Kept<'_> {
    fn drop(&mut self) {
        self.beside.as_ref().map(fs::remove_file);
    }
}

/// Writes a file whole, or takes it away; no power cut undoes it.
fn put(path: &Path, text: Option<&str>) -> Answered<()> {
    let done = match text {
        Some(text) => {
            let next = path.with_extension("new");
            let made = path.parent().map_or(Ok(()), whole::lasting_folder);
            let made = made.and_then(|()| whole::write_beside(&next, text.as_bytes()));
            let made = made.and_then(|()| whole::replace(path, &next));
            made.inspect_err(|_| drop(fs::remove_file(&next)))
        }
        None => whole::remove(path),
    };
    done.map_err(|error| Error::io("write", path, &error).into())
}

/// Only files of the rule base itself, by plain names.
fn check_name(file: &str) -> Answered<()> {
    let name = file.strip_prefix("tests/").unwrap_or(file);
    let extension = if name.len() < file.len() { ".toml" } else { ".rhai" };
    let is_plain = |c: char| c.is_alphanumeric() || ['-', '_', '.', ' '].contains(&c);
    let stem = name.strip_suffix(extension).unwrap_or_default();
    if !stem.is_empty() && !stem.starts_with(['.', ' ']) && stem.chars().all(is_plain) && name.len() < 100 {
        return Ok(());
    }
    Err(Fault::new(Code::RulesName, "a rule file is called NAME.rhai, and a test of rules tests/NAME.toml"))
}

fn check_length(text: &str) -> Answered<()> {
    if text.len() <= LONGEST {
        return Ok(());
    }
    Err(Fault::new(Code::RulesTooLong, format!("a rule file may have {LONGEST} bytes")))
}
