//! Rules that are tried before they are saved: what is wrong with them, and what their tests give.

use std::collections::BTreeMap;
use std::path::Path;

use axum::Json;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::extract::{Body, Site};
use crate::edit::Edit;
use crate::error::problem::Problem;
use crate::error::{Code, Error};
use crate::knowledge::Tested;
use crate::serve::desk::Desk;
use crate::serve::fault::{Answered, Fault};
use crate::serve::gate::require;
use crate::serve::role::{Caller, Role};
use crate::site::rules;

#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct CheckBody {
    file: String,
    text: String,
    /// Texts that stand in place of those of other files, too; null for one that would be gone.
    #[serde(default)]
    others: BTreeMap<String, Option<String>>,
}

#[derive(Serialize, ToSchema)]
pub struct Checked {
    /// What is wrong with the rules, each with its place.
    problems: Vec<Problem>,
    /// What the tests gave; null where rules are wrong, so that no test runs.
    tests: Option<TestsOf>,
}

#[derive(Debug, Serialize, ToSchema)]
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
        let mut failures: Vec<Problem> =
            failures.map(|failure| Problem::of(&failure.diagnostic.into())).collect();
        for failure in &mut failures {
            place(failure, folder);
        }
        Self { passed, failed, failures }
    }
}

/// Has a problem name its file as the folder does.
pub fn place(problem: &mut Problem, folder: &Path) {
    if let Some(file) = &problem.file
        && let Ok(file) = Path::new(file).strip_prefix(folder)
    {
        problem.file = Some(file.display().to_string());
    }
}

/// A fault whose problems name their files as the folder does.
pub fn placed(mut fault: Fault, folder: &Path) -> Fault {
    for problem in &mut fault.problems {
        place(problem, folder);
    }
    fault
}

/// Why rules are refused.
pub fn refused(error: Error, folder: &Path) -> Fault {
    placed(error.into(), folder)
}

fn near_all(error: &Error, folder: &Path) -> Vec<Problem> {
    let mut problems = Problem::all(error.problems());
    for problem in &mut problems {
        place(problem, folder);
    }
    problems
}

/// What the tests of the rules give with an edit of their files; `None` where it is about none. Where one fails, the edit is
/// refused.
pub fn tried(desk: &mut Desk, caller: &Caller, edit: &Edit) -> Answered<Option<TestsOf>> {
    let files = desk.live.files_of(edit)?;
    if files.is_empty() {
        return Ok(None);
    }
    require(caller, Role::Rules)?;
    let site = desk.shared.settings.open()?;
    edit.check_files(&site)?;
    let folder = site.rule_folder();
    let tests = TestsOf::of(site.try_rules(files).map_err(|error| refused(error, &folder))?, &folder);
    if tests.failed > 0 {
        let message = format!("{} of {} tests of the rules fail", tests.failed, tests.failed + tests.passed);
        return Err(Fault::new(Code::RulesTests, message).with_problems(tests.failures));
    }
    Ok(Some(tests))
}

/// Tries a text in place of a file's: compiled, checked, and tested with the tests beside the rules, in 10 s at most.
/// Nothing is saved. Role `rules`: what is tried runs.
#[utoipa::path(post, path = "/api/rules/check", tag = "rules", request_body = CheckBody,
    responses((status = 200, body = Checked)))]
pub async fn check(site: Site, caller: Caller, Body(body): Body<CheckBody>) -> Answered<Json<Checked>> {
    require(&caller, Role::Rules)?;
    rules::check(&body.file, Some(&body.text))?;
    for (file, text) in &body.others {
        rules::check(file, text.as_deref())?;
    }
    let view = site.view.load().view.clone();
    let checked = site.at_length(move || {
        let (site, folder) = (view.site(), view.site().rule_folder());
        let mut drafts = body.others;
        drafts.insert(body.file, Some(body.text));
        Ok(match site.try_rules(drafts) {
            Ok(tested) => Checked { problems: Vec::new(), tests: Some(TestsOf::of(tested, &folder)) },
            Err(error) => Checked { problems: near_all(&error, &folder), tests: None },
        })
    });
    checked.await.map(Json)
}
