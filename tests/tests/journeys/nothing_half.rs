//! What fails leaves nothing half done: no folder, no empty database, no half a picture; and takes nothing away that was
//! there before.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use adit_tests::{Ran, TestSite, adit, repository};

/// All files and folders below one, with what stands in them.
fn listed(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).expect("a folder").flatten() {
            let (path, is_folder) = (entry.path(), entry.file_type().expect("a type").is_dir());
            found.insert(
                path.clone(),
                if is_folder { Vec::new() } else { fs::read(&path).unwrap_or_default() },
            );
            if is_folder {
                folders.push(path);
            }
        }
    }
    found
}

fn run(folder: &TestSite, command: &str) -> Ran {
    let mut bash = Command::new("bash");
    let typed = command.replace("adit ", &format!("{} ", adit().display()));
    Ran::new(&bash.arg("-c").arg(typed).current_dir(folder.path()).output().expect("bash runs"))
}

/// Runs what must fail, and compares the folder with what it was.
fn fails(folder: &TestSite, command: &str, complaint: &str) {
    let before = listed(folder.path());
    let ran = run(folder, command).expecting(2);
    ran.complains(&[complaint]);
    let after = listed(folder.path());
    let names = |files: &BTreeMap<PathBuf, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&before), names(&after), "{command}");
    assert!(before == after, "{command} changed a file");
}

const ROS: &str = "image: map.pgm\nresolution: 0.1\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n";

fn image() -> Vec<u8> {
    let mut image = b"P5\n60 40\n255\n".to_vec();
    image.extend([254_u8; 2400]);
    image
}

#[test]
fn a_new_site_that_fails_leaves_nothing_and_the_next_try_works() {
    let folder = TestSite::empty();
    folder.write("bad.yaml", "image: no.pgm\nresolution: zero\n");
    folder.write("imageless.yaml", ROS);
    folder.write("bad.toml", "width = 12.0\n");
    folder.write("file", "");
    fails(&folder, "adit new site --map bad.yaml", "bad.yaml");
    fails(&folder, "adit new site --map bad.toml", "depth");
    fails(&folder, "adit new site --map imageless.yaml", "map.pgm");
    fails(&folder, "adit new site --map missing.yaml", "missing.yaml");
    fails(&folder, "adit new site --map .", "is no file");
    fails(&folder, "adit new file/site", "cannot");
    fails(&folder, "adit new file", "a file of this name is there");
    fails(&folder, "adit new far/away/site --map bad.toml", "depth");
    // a disk that is full after 1 kB of a file
    fails(&folder, "trap '' XFSZ; ulimit -f 1; adit new far/away/site", "cannot write");
    folder.write("map.pgm", image());
    run(&folder, "adit new site --map imageless.yaml").expect_status(0);
    fails(&folder, "adit new site", "is a site already");
    run(&folder, "adit build site").expect_status(0);
}

#[test]
fn a_new_site_in_a_folder_of_yours_takes_nothing_of_yours_away() {
    let folder = TestSite::empty().with("site/robots.toml", "# mine\n").with("site/rules/mine.txt", "mine\n");
    fails(&folder, "adit new site", "robots.toml is there already");
    fs::remove_file(folder.path().join("site/robots.toml")).expect("removed");
    run(&folder, "adit new site").expect_status(0);
    assert_eq!(folder.read("site/rules/mine.txt"), "mine\n");
}

#[test]
fn a_name_with_quotes_is_a_name() {
    let folder = TestSite::empty();
    fs::copy(repository().join("kb/sites/starter/map.toml"), folder.path().join("my \"map\".toml"))
        .expect("copied");
    run(&folder, "adit new 'a \"site\" \\ of mine' --map 'my \"map\".toml'").expect_status(0);
    run(&folder, "adit build 'a \"site\" \\ of mine'").expect_status(0);
}

#[test]
fn a_demo_takes_no_site_of_yours_away() {
    let folder = TestSite::empty();
    fs::create_dir(folder.path().join("clinic")).expect("made");
    for file in ["site.toml", "map.toml", "robots.toml"] {
        fs::copy(repository().join("kb/sites/clinic").join(file), folder.path().join("clinic").join(file))
            .expect("copied");
    }
    folder.edit("clinic/site.toml", "name", "# mine\nname");
    let before = listed(&folder.path().join("clinic"));
    run(&folder, "adit demo --out .").expecting(2).complains(&["clinic is a site, and not the example"]);
    assert!(before == listed(&folder.path().join("clinic")));
    run(&folder, "adit demo --out new").expect_status(0);
    let again = run(&folder, "adit demo --out new").expecting(0);
    assert!(!again.stderr.contains("is kept in"), "{}", again.stderr);
}

#[test]
fn a_demo_keeps_what_was_edited_in_the_one_of_before() {
    let folder = TestSite::empty();
    run(&folder, "adit demo").expect_status(0);
    let site = "adit-demo/paper";
    run(&folder, &format!("adit tune {site} robots SQUAT hardness 3 --why mine")).expect_status(0);
    let again = run(&folder, "adit demo").expecting(0);
    assert!(again.stderr.contains("is kept in adit-demo/paper/site-1.db"), "{}", again.stderr);
    let kept = run(&folder, &format!("adit history {site} --db {site}/site-1.db")).expecting(0);
    assert!(kept.stdout.contains("4 → 3") && kept.stdout.contains("mine"), "{}", kept.stdout);
}

#[test]
fn a_first_build_that_fails_leaves_no_database() {
    let folder = TestSite::example("paper").with("rules/slip.rhai", "rule \"slip\" each\n");
    fails(&folder, "adit build .", "slip.rhai");
    let folder = TestSite::example("paper");
    folder.edit("site.toml", "map.toml", "no.toml");
    fails(&folder, "adit build .", "no.toml");
    let folder = TestSite::example("paper");
    fails(&folder, "trap '' XFSZ; ulimit -f 8; adit build .", "");
    fails(&folder, "adit build . --db no/site.db", "no/site.db");
}

fn world(name: &str) -> TestSite {
    let folder = TestSite::empty();
    for file in [name, "flat.json"] {
        folder.write(file, fs::read(repository().join("kb/worlds").join(file)).expect("a world"));
    }
    folder
}

/// A folder with a map, and a built site of it called `home`.
fn with_site(name: &str) -> TestSite {
    let folder = world(name);
    run(&folder, &format!("adit new home --map {name} && adit build home")).expect_status(0);
    folder
}

#[test]
fn tasks_and_maps_alone_that_fail_leave_no_database_and_no_picture() {
    let cell = with_site("cell.toml");
    fails(&cell, "adit tasks cell.toml nowhere --db cell.db", "nowhere");
    fails(&cell, "adit tasks cell.toml load --from other --db cell.db", "no experience of other");
    fails(&cell, "trap '' XFSZ; ulimit -f 8; adit tasks home load --db cell.db", "");
    let flat = with_site("flat.toml");
    fails(&flat, "adit route flat.toml bed bath --db no/flat.db", "no/flat.db");
    fails(&flat, "trap '' XFSZ; ulimit -f 8; adit route flat.toml bed bath --db flat.db", "");
    fails(&flat, "trap '' XFSZ; ulimit -f 1; adit draw home -o flat.svg", "cannot write");
    flat.write("flat.svg", "<svg>of before</svg>");
    fails(&flat, "trap '' XFSZ; ulimit -f 1; adit draw home -o flat.svg", "cannot write");
    // what was there before the database of failed tasks stays
    run(&cell, "adit tasks cell.toml load --db cell.db").expect_status(0);
    let rows = "SELECT count(*) FROM tasks";
    let tasks = |folder: &TestSite| {
        let ran = Command::new("sqlite3").arg(folder.path().join("cell.db")).arg(rows).output();
        Ran::new(&ran.expect("the sqlite3 shell is installed")).expecting(0).stdout
    };
    let before = tasks(&cell);
    run(&cell, "adit tasks cell.toml nowhere --db cell.db").expect_status(2);
    assert_eq!(tasks(&cell), before);
}

#[test]
fn missions_that_fail_leave_no_database_and_no_film() {
    let flat = with_site("flat.toml");
    fails(&flat, "trap '' XFSZ; ulimit -f 8; adit simulate home bed bath --db missions.db", "");
    fails(&flat, "trap '' XFSZ; ulimit -f 1; adit simulate home bed bath --film film.svg", "cannot write");
    fails(&flat, "adit simulate flat.toml bed bath --film no/film.svg", "no/film.svg");
    // rules that fail at the first mission
    for entry in fs::read_dir(repository().join("rules/navigation")).expect("rules").flatten() {
        if entry.path().is_file() {
            let name = entry.file_name().to_string_lossy().into_owned();
            flat.write(&format!("mine/{name}"), fs::read(entry.path()).expect("readable"));
        }
    }
    flat.write(
        "mine/fails.rhai",
        "rule \"no next\" priority 99 each s in SITUATIONS then { s.next = \"nowhere\"; }\n",
    );
    fails(&flat, "adit simulate flat.toml bed bath --rules mine --db missions.db", "nowhere");
}

#[test]
fn figures_that_cannot_be_written_leave_those_of_before() {
    let folder = world("new-product.json");
    folder.write("curves.csv", "of before\n");
    let begun = "adit experiment new-product.json --runs 1 --strategy a3";
    fails(&folder, &format!("{begun} --csv curves.csv --rules no-rules"), "no-rules");
    fails(&folder, &format!("{begun} --csv no/curves.csv"), "no/curves.csv");
    fails(&folder, &format!("{begun} --csv curves.csv --picture no/curves.svg"), "no/curves.svg");
}

#[test]
fn a_token_that_cannot_be_written_leaves_those_of_before() {
    let folder = TestSite::example("paper");
    run(&folder, "adit token . add anna").expect_status(0);
    let long = "b".repeat(2_000);
    fails(&folder, &format!("trap '' XFSZ; ulimit -f 1; adit token . add {long}"), "cannot write");
}
