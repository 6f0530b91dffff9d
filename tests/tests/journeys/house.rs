//! The shape of the house: who imports whom, how many rooms there are, and whether its plan is true.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, NodeIndex};

fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A module by its path below the crate, as `["state", "step"]`; the crate's root is empty.
type Module = Vec<String>;

/// The modules of a crate that are not tests: their texts up to the tests at the end.
fn modules(of: &str) -> BTreeMap<Module, String> {
    let root = top().join(of).join("src");
    let mut modules = BTreeMap::new();
    let mut folders = vec![root.clone()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_stem().unwrap().to_str().unwrap();
            if path.is_dir() && name != "tests" {
                folders.push(path);
            } else if path.extension().is_some_and(|kind| kind == "rs") && !["tests", "main"].contains(&name)
            {
                let below = path.strip_prefix(&root).unwrap().with_extension("");
                let parts = below.iter().map(|part| part.to_str().unwrap().to_owned());
                let module = if name == "lib" { Vec::new() } else { parts.collect() };
                let text = fs::read_to_string(&path).unwrap();
                modules.insert(module, text.split("#[cfg(test)]").next().unwrap().to_owned());
            }
        }
    }
    modules
}

/// `a::{b, c::d}` as `a::b` and `a::c::d`.
fn unfold(tree: &str) -> Vec<Vec<String>> {
    let tree = tree.trim();
    let Some((before, inside)) = tree.split_once('{') else {
        let path = tree.split(" as ").next().unwrap();
        return vec![path.split("::").map(|part| part.trim().to_owned()).collect()];
    };
    let before: Vec<String> =
        before.split("::").map(str::trim).filter(|part| !part.is_empty()).map(str::to_owned).collect();
    let inside = inside.trim_end().strip_suffix('}').unwrap();
    let (mut depth, mut begin, mut parts) = (0, 0, Vec::new());
    for (at, letter) in inside.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&inside[begin..at]);
                begin = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&inside[begin..]);
    let parts = parts.into_iter().filter(|part| !part.trim().is_empty());
    parts.flat_map(unfold).map(|path| [before.clone(), path].concat()).collect()
}

/// What a module imports or names by its path, and what it exports of others: paths from the crate's root.
fn uses(module: &Module, text: &str, modules: &BTreeMap<Module, String>) -> Vec<(bool, Vec<String>)> {
    let mut found = Vec::new();
    let mut statement: Option<(bool, String)> = None;
    for line in text.lines() {
        let line = line.split("//").next().unwrap().trim();
        if statement.is_none() {
            let is_public = line.starts_with("pub");
            let import = if is_public {
                line.split_once(" use ").map(|(_, rest)| rest)
            } else {
                line.strip_prefix("use ")
            };
            statement = import.map(|rest| (is_public, rest.to_owned()));
        } else if let Some((_, so_far)) = &mut statement {
            so_far.push_str(line);
        }
        if statement.is_none() {
            let words = line.split(|letter: char| !letter.is_alphanumeric() && !"_:".contains(letter));
            let paths = words.filter(|word| word.contains("::") && !word.starts_with(':'));
            let path =
                |word: &str| word.trim_end_matches(':').split("::").map(str::to_owned).collect::<Vec<_>>();
            found.extend(
                paths.filter_map(|word| from_root(module, &path(word), modules)).map(|path| (false, path)),
            );
        }
        if let Some((is_public, whole)) = statement.take_if(|(_, so_far)| so_far.ends_with(';')) {
            for path in unfold(whole.trim_end_matches(';')) {
                found.extend(from_root(module, &path, modules).map(|path| (is_public, path)));
            }
        }
    }
    found
}

/// A path as it is written, from the crate's root; `None` where it is another crate's.
fn from_root(module: &Module, path: &[String], modules: &BTreeMap<Module, String>) -> Option<Vec<String>> {
    let ups = path.iter().take_while(|part| *part == "super").count();
    match path[0].as_str() {
        "crate" => Some(path[1..].to_vec()),
        "self" => Some([module, &path[1..]].concat()),
        "super" => Some([&module[..module.len().checked_sub(ups)?], &path[ups..]].concat()),
        first => {
            let child = [module.as_slice(), &[first.to_owned()]].concat();
            modules.contains_key(&child).then(|| [module.as_slice(), path].concat())
        }
    }
}

/// The module in which what a path names is written, through what others export of it.
fn home(
    path: &[String],
    modules: &BTreeMap<Module, String>,
    exports: &BTreeMap<Vec<String>, Vec<String>>,
) -> Module {
    let mut path = path.to_vec();
    for _ in 0..5 {
        let module =
            (0..=path.len()).rev().map(|end| &path[..end]).find(|part| modules.contains_key(*part)).unwrap();
        let named = (module.len() + 1).min(path.len());
        match exports.get(&path[..named]) {
            Some(other) if named > module.len() => path = [other.as_slice(), &path[named..]].concat(),
            _ => return module.to_vec(),
        }
    }
    path
}

/// Files of a crate that import each other in a circle.
fn circles(of: &str) -> Vec<Vec<Module>> {
    let modules = modules(of);
    let all: Vec<(Module, bool, Vec<String>)> = modules
        .iter()
        .flat_map(|(module, text)| {
            uses(module, text, &modules).into_iter().map(|(public, path)| (module.clone(), public, path))
        })
        .collect();
    let exports: BTreeMap<_, _> = all
        .iter()
        .filter(|(_, is_public, _)| *is_public)
        .filter_map(|(module, _, path)| {
            Some(([module.as_slice(), &[path.last()?.clone()]].concat(), path.clone()))
        })
        .collect();
    let keys: Vec<&Module> = modules.keys().collect();
    let number = |module: &Module| keys.binary_search(&module).unwrap();
    let mut graph = DiGraph::<(), ()>::new();
    for _ in &keys {
        graph.add_node(());
    }
    for (module, _, path) in all.iter().filter(|(_, is_public, _)| !is_public) {
        let other = home(path, &modules, &exports);
        if other != *module {
            graph.add_edge(NodeIndex::new(number(module)), NodeIndex::new(number(&other)), ());
        }
    }
    let found = tarjan_scc(&graph).into_iter().filter(|circle| circle.len() > 1);
    found.map(|circle| circle.into_iter().map(|at| keys[at.index()].clone()).collect()).collect()
}

/// Whether files are those of one folder, with the file of its name: `state.rs` beside `state/step.rs`.
fn is_one_folder(circle: &[Module]) -> bool {
    let parent = |module: &Module| module[..module.len().saturating_sub(1)].to_vec();
    let mut folders = circle.iter().flat_map(|module| [module.clone(), parent(module)]);
    folders.any(|folder| circle.iter().all(|module| *module == folder || parent(module) == folder))
}

#[test]
fn files_import_each_other_in_a_circle_in_one_folder_only_and_where_a_sentence_says_why() {
    let mut wrong = Vec::new();
    for of in ["engine", "planners", "db", "kb"] {
        let texts = modules(of);
        for circle in circles(of) {
            let heads = circle
                .iter()
                .flat_map(|module| texts[module].lines().take_while(|line| line.starts_with("//!")));
            let is_told = heads.clone().any(|line| line.contains("circle"));
            if !is_one_folder(&circle) || !is_told {
                let names: Vec<String> = circle.iter().map(|module| module.join("/")).collect();
                wrong.push(format!("{of}: {}", names.join(", ")));
            }
        }
    }
    assert!(wrong.is_empty(), "circles:\n{}", wrong.join("\n"));
}

#[test]
fn the_root_of_the_knowledge_base_has_at_most_twenty_entries() {
    let entries: BTreeSet<_> = fs::read_dir(top().join("kb/src"))
        .unwrap()
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_owned())
        .collect();
    assert!(entries.len() <= 20, "{entries:?}");
}

#[test]
fn the_architecture_is_at_most_150_lines_and_each_path_in_it_is_there() {
    let text = fs::read_to_string(top().join("ARCHITECTURE.md")).unwrap();
    assert!(text.lines().count() <= 150);
    let prose: String = text.split("```").step_by(2).collect();
    let named: Vec<&str> = prose.split('`').skip(1).step_by(2).filter(|word| word.contains('/')).collect();
    assert!(named.len() > 20);
    let roots = [
        "",
        "engine",
        "planners",
        "db",
        "kb",
        "kb/src",
        "engine/src",
        "planners/src",
        "tests",
        "bridges/fleet",
        "bridges/ros",
        "planners/src/navigation",
    ];
    for name in named {
        let is_there = |root: &&str| {
            let path = top().join(root).join(name);
            path.exists() || path.with_extension("rs").exists()
        };
        assert!(roots.iter().any(is_there), "ARCHITECTURE.md names {name}, and there is no such path");
    }
}
