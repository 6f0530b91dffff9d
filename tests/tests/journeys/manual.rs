//! The manual: each page is in its contents, no link leads nowhere, and what rules see stands there.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use adit_tests::{TestSite, repository};

fn pages() -> Vec<PathBuf> {
    let root = repository().join("manual/src");
    let folders = [root.clone(), root.join("tutorials")];
    let files = folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap().flatten());
    let mut pages: Vec<PathBuf> = files
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|is| is == "md"))
        .collect();
    pages.sort();
    assert!(pages.len() > 20, "{pages:?}");
    pages
}

/// Where the links of a page lead that lead to files: the file, and the heading there.
fn links(text: &str) -> Vec<(String, Option<String>)> {
    let links = text.split("](").skip(1).filter_map(|rest| rest.split_once(')').map(|(link, _)| link));
    let inside = links.filter(|link| !link.contains("://") && !link.starts_with("mailto:"));
    inside
        .map(|link| match link.split_once('#') {
            Some((file, heading)) => (file.to_owned(), Some(heading.to_owned())),
            None => (link.to_owned(), None),
        })
        .collect()
}

/// A heading as links name it.
fn anchor(heading: &str) -> String {
    let letters = heading.trim_start_matches('#').trim().to_lowercase();
    letters
        .chars()
        .filter_map(|c| match c {
            ' ' => Some('-'),
            c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c),
            _ => None,
        })
        .collect()
}

fn check_links(page: &Path) {
    let text = fs::read_to_string(page).unwrap();
    for (file, heading) in links(&text) {
        let target = if file.is_empty() { page.to_owned() } else { page.parent().unwrap().join(&file) };
        assert!(target.exists(), "{}: there is no {file}", page.display());
        if let Some(heading) = heading {
            let there = fs::read_to_string(&target).unwrap();
            let is_it = |line: &str| line.starts_with('#') && anchor(line) == heading;
            assert!(there.lines().any(is_it), "{}: {file} has no heading #{heading}", page.display());
        }
    }
}

#[test]
fn no_link_leads_nowhere() {
    for page in pages() {
        check_links(&page);
        let text = fs::read_to_string(&page).unwrap();
        for included in text.split("{{#include ").skip(1).filter_map(|rest| rest.split_once("}}")) {
            let file = page.parent().unwrap().join(included.0);
            assert!(file.is_file(), "{}: {} is not there", page.display(), included.0);
        }
    }
    for page in ["README.md", "ARCHITECTURE.md", "GLOSSARY.md", "SECURITY.md"] {
        check_links(&repository().join(page));
    }
}

#[test]
fn each_page_is_in_the_contents_once() {
    let root = repository().join("manual/src");
    let contents = fs::read_to_string(root.join("SUMMARY.md")).unwrap();
    let listed: Vec<PathBuf> = links(&contents).into_iter().map(|(file, _)| root.join(file)).collect();
    let once: BTreeSet<&PathBuf> = listed.iter().collect();
    assert_eq!(once.len(), listed.len(), "a page stands twice");
    let summary = root.join("SUMMARY.md");
    let all: Vec<PathBuf> = pages().into_iter().filter(|page| *page != summary).collect();
    assert_eq!(once.into_iter().cloned().collect::<Vec<_>>(), all);
}

#[test]
fn every_property_that_rules_see_stands_in_the_manual() {
    let page = fs::read_to_string(repository().join("manual/src/what-rules-see.md")).unwrap();
    let site = TestSite::example("starter")
        .with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\n")
        .built();
    for class in [
        "ROOMS",
        "DOORS",
        "ROBOTS",
        "CHANGES",
        "LOADS",
        "SMALLER_STATES",
        "SPACES",
        "DOORWAYS",
        "AREAS",
        "NAMED_DOORS",
        "AREA_ROOMS",
        "DOOR_ROOMS",
        "HOURS",
        "ROUTES",
    ] {
        let part = page.split("\n\n").find(|part| part.contains(&format!("`{class}`")));
        let part = part.unwrap_or_else(|| panic!("{class} is not in the manual"));
        site.write(
            "rules/asks.rhai",
            format!("rule \"asks\" priority 3\n    each thing in {class} where thing.none_such == 1\n    then {{ thing.made_up = 2; }}\n"),
        );
        let found = site.adit("check", &["--json"]).expecting(1);
        let said = format!("{}{}", found.stdout, found.stderr);
        let listed = said.split("it has ").nth(1).unwrap_or_else(|| panic!("{class}: {said}"));
        let listed = listed.split('"').next().unwrap();
        for property in listed.split(", ").filter(|name| *name != "made_up") {
            assert!(part.contains(&format!("`{property}`")), "{class}.{property} is not in the manual");
        }
    }
}
