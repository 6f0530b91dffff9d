//! `adit rules`: what counts of the rule bases that lie over each other.

use std::path::PathBuf;

use adit_engine::{Instead, Rule, RuleBase};
use clap::Args;

use super::args::SiteArgs;
use super::build::open;
use super::output::{json, line};
use crate::error::{Code, Error, Result};
use crate::site::base::{Base, TESTS};
use crate::site::whole::Whole;
use crate::words::suggest::did_you_mean;

#[derive(Args, Debug)]
pub struct RulesArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// The name of a rule: its text is printed
    pub rule: Option<String>,
    /// Copy the lowest rule base into this folder of the site, with its tests, to name it in site.toml
    #[arg(long, value_name = "FOLDER", conflicts_with = "rule")]
    pub copy: Option<PathBuf>,
}

/// Lists the rules that count, prints one, or copies the rule base beneath.
pub fn run(args: &RulesArgs) -> Result<()> {
    let knowledge = open(&args.site)?;
    let bases = knowledge.rule_bases();
    if let Some(folder) = &args.copy {
        let Some(lowest) = bases.first() else { return Ok(()) };
        return copy(lowest, &knowledge.site().folder.join(folder), folder, args.site.json);
    }
    let rules = knowledge.rule_base()?;
    if let Some(name) = &args.rule {
        let found = rules.rules().iter().find(|rule| rule.name() == name && !rule.text().is_empty());
        let rule = found.ok_or_else(|| unknown(name, &rules))?;
        if args.site.json {
            return json(&as_json(rule));
        }
        line(&format!("// {}, line {}, version {}", rule.file(), rule.line(), rule.version()));
        line(rule.text());
        return Ok(());
    }
    if args.site.json {
        let replaced = rules.replaced().iter().map(|replaced| {
            let by = match &replaced.by {
                Instead::Rule(by) => {
                    serde_json::json!({"file": by.file, "line": by.line, "version": by.version})
                }
                Instead::Without { .. } => serde_json::Value::Null,
            };
            let beneath = &replaced.beneath;
            serde_json::json!({"rule": replaced.rule, "file": beneath.file, "line": beneath.line,
                "version": beneath.version, "by": by})
        });
        return json(&serde_json::json!({
            "bases": bases.iter().map(Base::name).collect::<Vec<_>>(),
            "rules": rules.rules().iter().filter(|rule| !rule.text().is_empty()).map(as_json).collect::<Vec<_>>(),
            "replaced": replaced.collect::<Vec<_>>(),
        }));
    }
    let mut file = "";
    for rule in rules.rules().iter().filter(|rule| !rule.text().is_empty()) {
        if rule.file() != file {
            file = rule.file();
            line(file);
        }
        line(&format!("  {:<4} {}", rule.line(), rule.name()));
    }
    let (replaced, left_out): (Vec<_>, Vec<_>) =
        rules.replaced().iter().partition(|replaced| matches!(replaced.by, Instead::Rule(_)));
    let listed = |what: &str, found: Vec<&adit_engine::Replaced>| {
        for (index, replaced) in found.iter().enumerate() {
            if index == 0 {
                line(what);
            }
            line(&format!("  {} ({}, line {})", replaced.rule, replaced.beneath.file, replaced.beneath.line));
        }
    };
    listed("replaced by those of their names above", replaced);
    listed("left out", left_out);
    Ok(())
}

fn as_json(rule: &Rule) -> serde_json::Value {
    serde_json::json!({"rule": rule.name(), "file": rule.file(), "line": rule.line(), "version": rule.version(),
        "text": rule.text()})
}

fn unknown(name: &str, rules: &RuleBase) -> Error {
    let help = did_you_mean(name, rules.rules().iter().map(Rule::name));
    Error::said(Code::RulesUnknown, format!("there is no rule \"{name}\""), help)
}

/// Writes the files of a rule base into a folder, all of them or none.
fn copy(base: &Base, into: &std::path::Path, named: &std::path::Path, as_json: bool) -> Result<()> {
    let mut made = Whole::default();
    made.folder(into)?;
    let (rules, tests) = (base.rules()?, base.tests()?);
    let name = |name: &str| PathBuf::from(name).file_name().unwrap_or_default().to_owned();
    for source in &rules {
        made.file(&into.join(name(source.name())), source.text())?;
    }
    if !tests.is_empty() {
        made.folder(&into.join(TESTS))?;
    }
    for source in &tests {
        made.file(&into.join(TESTS).join(name(source.name())), source.text())?;
    }
    made.keep();
    let files = rules.len() + tests.len();
    if as_json {
        return json(&serde_json::json!({"folder": into, "files": files}));
    }
    line(&format!("{files} files of {} are in {} now", base.name(), into.display()));
    let named = named.display().to_string();
    line(&format!("in site.toml, `rules = {}` puts them in its place", toml::Value::from(named)));
    Ok(())
}
