//! Every sentence that the page says by itself, in one document (`sentences.md`), to be read as a whole: after
//! `ADIT_SAID=write cargo test --workspace --test page sentences` its difference shows what is said otherwise.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use adit_tests::repository;

use crate::spoken;

/// A parser of JavaScript that others wrote, where `tests/run` installs it.
fn modules() -> PathBuf {
    let exe = std::env::current_exe().unwrap();
    exe.ancestors().nth(3).unwrap().join("axe")
}

/// What may be shown of what the service says, by its files.
fn spoken() -> String {
    let mut document = "\n# What the service says to it\n\nThe texts of the program's files that may come to the page: errors, reasons, notes, remarks, and words on pictures.\n".to_owned();
    for (file, texts) in spoken::texts(&repository()) {
        let shown: Vec<String> = texts
            .into_iter()
            .filter(|text| !(text.is_help && is_for_terminals(&text.words)))
            .map(|text| text.words)
            .collect();
        if !shown.is_empty() {
            write!(document, "\n## {file}\n\n- {}\n", shown.join("\n- ")).unwrap();
        }
    }
    document
}

/// As the page has it (`notice.js`).
fn is_for_terminals(help: &str) -> bool {
    let has_option = help.split("`--").skip(1).any(|rest| rest.starts_with(|c: char| c.is_ascii_lowercase()));
    has_option || ["`adit ", "/api/"].iter().any(|part| help.contains(part))
}

fn said() -> String {
    let here = repository().join("tests/tests/page");
    let mut node = Command::new("node");
    node.arg(here.join("sentences.mjs")).arg(repository().join("kb/page")).arg(modules());
    let out = node.output().expect("node runs");
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    let head = "# What the page says\n\nMade by a test; `…` stands for what is put in.\n\n";
    format!("{head}{}{}", String::from_utf8(out.stdout).unwrap(), spoken())
}

#[test]
fn the_document_has_every_sentence() {
    let (file, said) = (repository().join("tests/tests/page/sentences.md"), said());
    if std::env::var("ADIT_SAID").is_ok_and(|what| what == "write") {
        fs::write(&file, &said).unwrap();
    }
    let known = fs::read_to_string(&file).unwrap_or_default();
    let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
    let (known, said) = (lines(&known), lines(&said));
    let only = |these: &[String], those: &[String]| -> Vec<String> {
        these.iter().filter(|line| !those.contains(line)).cloned().collect()
    };
    let (new, gone) = (only(&said, &known), only(&known, &said));
    assert!(known == said, "said now: {new:#?}\nno longer: {gone:#?}\n(ADIT_SAID=write takes it over)");
    assert!(said.len() > 500, "{} lines", said.len());
}

/// The program's verbs, as its help lists them.
fn verbs() -> Vec<String> {
    let page = fs::read_to_string(repository().join("manual/src/commands.md")).unwrap();
    let verb = |line: &str| Some(line.strip_prefix("| `")?.split([' ', '`']).next()?.to_owned());
    page.lines().filter_map(verb).collect()
}

#[test]
fn the_service_says_nothing_that_only_helps_in_a_terminal_but_in_helps() {
    let said = spoken();
    let commands: Vec<&str> =
        said.lines().filter(|line| line.starts_with("- ") && is_for_terminals(line)).collect();
    assert!(commands.is_empty(), "the page would show: {commands:#?}");
    assert!(said.lines().count() > 1_000, "{} lines", said.lines().count());
    let page = fs::read_to_string(repository().join("kb/page/notice.js")).unwrap();
    assert!(
        page.contains(r"/`adit |\/api\/|`--[a-z]/u.test(help)"),
        "what the page leaves out is no longer what is looked for here"
    );
}

#[test]
fn no_sentence_is_code_a_command_or_json() {
    let said = said();
    let (said, _) = said.split_once("## Written into an editor").unwrap();
    let verbs = verbs();
    assert!(verbs.len() > 30, "{verbs:?}");
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let is_of_code = |word: &str| {
        let small = word.trim_matches(|c: char| !is_word(c));
        let is_camel = small.starts_with(char::is_lowercase) && small.contains(char::is_uppercase);
        small.contains('_') || is_camel || word.contains("=>") || word.contains("::")
    };
    for line in said.lines().filter_map(|line| line.strip_prefix("- ")) {
        let is_json = line.contains(['{', '}', '`', '"', '<', '>', '\\']) || line.contains("null");
        assert!(!is_json, "JSON or markup: {line}");
        assert!(!line.split_whitespace().any(is_of_code), "code: {line}");
        assert!(
            !line.contains("/api") && !line.contains("undefined") && !line.contains(" = "),
            "code: {line}"
        );
        let words: Vec<&str> = line.split(|c: char| !c.is_alphanumeric() && c != '-').collect();
        let is_command =
            |pair: &[&str]| pair[0] == "adit" && verbs.iter().any(|verb| verb.as_str() == pair[1]);
        assert!(!words.windows(2).any(is_command) && !line.starts_with("$ "), "a command: {line}");
        assert_eq!(line.matches('(').count(), line.matches(')').count(), "brackets: {line}");
    }
}
