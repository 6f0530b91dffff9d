//! A site's rules lie over others, and are never ignored in silence: what they replace is said, and what does not count.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_tests::TestSite;

/// The paper's example with a copy of the shipped rules as all there is.
fn with_rules() -> TestSite {
    let site = TestSite::example("paper");
    site.copy_rules_and_tests("paper");
    site
}

fn said(ran: &adit_tests::Ran) -> String {
    format!("{}{}", ran.stdout, ran.stderr)
        .split_whitespace()
        .filter(|word| *word != "│")
        .collect::<Vec<_>>()
        .join(" ")
}

#[test]
fn a_folder_rules_counts_though_site_toml_does_not_name_it() {
    let site = TestSite::example("paper");
    site.write("rules/slip.rhai", "rule \"slip\" each room in\n");
    for verb in ["check", "build", "test"] {
        let ran = site.adit(verb, &[]);
        assert_ne!(ran.status, 0, "{verb}: {}", ran.stdout);
        ran.complains(&["rules/slip.rhai:2"]);
    }
}

#[test]
fn the_rules_of_the_folder_decide() {
    let site = with_rules();
    std::fs::remove_dir_all(site.path().join("rules/tests")).expect("removed");
    let hardness = |site: &TestSite| site.sqlite3("SELECT sum(hardness) FROM doors");
    let shipped = hardness(&TestSite::example("paper").built());
    assert_eq!(hardness(&with_rules().built()), shipped);
    site.write(
        "rules/twice.rhai",
        "revise \"twice\" each door in DOORS set door.hardness by * 2.0 level 5\n",
    );
    assert_ne!(hardness(&site.built()), shipped);
}

/// A site over a rule base of a company's own: two rules are replaced, one is left out, three are added.
fn over_a_company() -> TestSite {
    let site = TestSite::example("paper");
    site.copy_rules_and_tests("paper");
    std::fs::rename(site.path().join("rules"), site.path().join("company")).expect("renamed");
    let plain = site.read("site.toml").replacen("rules = \"rules\"", "rules = \"company\"", 1);
    site.write("site.toml", plain);
    site.write("company/grey.rhai", "rule \"a grey door\" each door in DOORS then { door.grey = 1.0; }\n");
    let room = site.read("company/rooms.rhai");
    let rule = &room[room.find("rule \"").expect("a rule")..];
    let own = format!(
        "// mine\n{rule}\nwithout \"a grey door\"\n\n\
         rule \"a blue door\" each door in DOORS then {{ door.blue = 1.0; }}\n\
         rule \"a green door\" each door in DOORS then {{ door.green = door.blue + 1.0; }}\n\
         revise \"doors are hard on Mondays\" each door in DOORS where door.green > 1.0 set door.hardness by * 2.0 level 5\n"
    );
    site.write("rules/own.rhai", own.replacen("then {", "then { room.told = 1.0;", 1));
    site
}

#[test]
fn check_says_what_is_replaced_and_left_out_and_what_was_changed_beneath_since() {
    let site = over_a_company();
    let plain = TestSite::example("paper").built();
    let hardness = |site: &TestSite| site.sqlite3("SELECT round(sum(hardness), 3) FROM doors WHERE passable");
    let doubled = plain.sqlite3("SELECT round(2 * sum(hardness), 3) FROM doors WHERE passable");
    let site = site.built();
    assert_eq!(hardness(&site), doubled);
    let check = site.adit("check", &[]);
    let words = said(&check);
    assert!(words.contains("replaces the one beneath it"), "{words}");
    assert!(words.contains("the rules go without \"a grey door\""), "{words}");
    assert!(!words.contains("was changed since"), "{words}");

    let listed = site.adit("rules", &["--json"]).expecting(0).json();
    assert_eq!(listed["bases"].as_array().map(Vec::len), Some(2));
    let rule = listed["replaced"]
        .as_array()
        .and_then(|all| all.iter().find(|one| !one["by"].is_null()))
        .expect("one")
        .clone();
    let name = rule["rule"].as_str().expect("a name");
    let text = site.adit("rules", &[name]).expecting(0);
    assert!(text.stdout.contains("room.told = 1.0"), "the one that counts: {}", text.stdout);

    // the company mends the rule that is replaced here
    let file = "company/rooms.rhai";
    site.write(file, site.read(file).replacen("then {", "then { room.mended = 1.0;", 1));
    let words = said(&site.adit("check", &[]).expecting(1));
    assert!(words.contains("was changed since") && words.contains(name), "{words}");
    let site = site.built();
    assert!(
        said(&site.adit("check", &[])).contains("was changed since"),
        "a build alone takes nothing into account"
    );
    site.edit("rules/own.rhai", "room.told = 1.0", "room.told = 2.0");
    let site = site.built();
    assert!(!said(&site.adit("check", &[])).contains("was changed since"));
}

#[test]
fn what_is_left_out_must_be_there() {
    let site = TestSite::example("paper").with("rules/own.rhai", "\nwithout \"doors of the papr\"\n");
    site.adit("build", &[])
        .expecting(2)
        .complains(&["no rule beneath is called \"doors of the papr\"", "own.rhai:2:9"]);
}

#[test]
fn tests_beneath_need_not_hold_and_are_named() {
    let site = TestSite::example("paper")
        .with("rules/own.rhai", "revise \"twice\" each door in DOORS set door.hardness by * 2.0 level 5\n");
    site.adit("build", &[]).expect_status(0);
    let test = site.adit("test", &[]).expecting(0);
    assert!(said(&test).contains("do not hold with your rules"), "{}", test.stdout);
    let check = site.adit("check", &[]).expecting(0);
    assert!(said(&check).contains("of rooms/paper"), "{}", check.stderr);
    site.write("rules/tests/mine.toml", site_test("4.0"));
    site.adit("test", &[]).expect_status(1);
    site.adit("build", &[]).expecting(1).complains(&["should be 4"]);
}

/// A test that no rules of the paper hold.
fn site_test(hardness: &str) -> String {
    format!(
        "[given]\nDOORS = [{{ door = 1 }}]\n[[test]]\nname = \"none\"\n[test.conclude]\nDOORS.1.hardness = {hardness}\n"
    )
}

#[test]
fn a_base_without_a_rule_is_refused() {
    let site = TestSite::example("paper").with("rules/readme.txt", "");
    site.adit("build", &[]).expect_status(0);
    site.write("site.toml", format!("rules = \"rules\"\n{}", site.read("site.toml")));
    site.adit("build", &[]).expecting(2).complains(&["there is no rule in", "NAME.rhai"]);
    site.write("rules/doors.RHAI", "");
    site.adit("build", &[])
        .expecting(2)
        .complains(&["doors.RHAI is not read: rule files are called NAME.rhai"]);
    let plain = TestSite::example("paper").with("other/readme.txt", "");
    let other = plain.path().join("other");
    let ran = plain.adit("build", &["--rules", other.to_str().expect("a path")]);
    ran.expecting(2).complains(&["there is no rule in"]);
    let file = TestSite::example("paper").with("rules", "");
    file.adit("build", &[]).expecting(2).complains(&["read the rule base"]);
    let missing = TestSite::example("paper");
    missing.write("site.toml", format!("rules = [\"rooms/papr\"]\n{}", missing.read("site.toml")));
    missing.adit("build", &[]).expecting(2).complains(&["rooms/papr"]);
}

#[test]
fn a_copy_of_the_base_is_a_base_of_ones_own() {
    let site = TestSite::example("paper");
    site.adit("rules", &["--copy", "base"]).expect_status(0);
    site.adit("rules", &["--copy", "base"]).expecting(2).complains(&["there already"]);
    let before = site.copied().built().sqlite3("SELECT sum(hardness) FROM doors");
    site.write("site.toml", format!("rules = \"base\"\n{}", site.read("site.toml")));
    assert_eq!(site.built().sqlite3("SELECT sum(hardness) FROM doors"), before);
}

#[test]
fn files_that_look_like_rules_and_are_not_read_are_named() {
    let site = with_rules();
    let rule = "rule \"slip\" each room in\n";
    let test = "[[test]]\nname = \"none\"\n";
    for file in ["rules/a.RHAI", "rules/b.rhai.txt", "rules/more/c.rhai", "rules/tests/d.rhai"] {
        site.write(file, rule);
    }
    for file in ["rules/e.toml", "rules/tests/more/f.toml", "rules/tests/g.TOML"] {
        site.write(file, test);
    }
    // what editors and systems leave, and what is no rule at all
    for file in ["rules/h.rhai~", "rules/.i.rhai.swp", "rules/notes.txt", "rules/j.toml"] {
        site.write(file, "");
    }
    let said = site.adit("check", &[]).expecting(1).stderr;
    let said: String = said.split_whitespace().filter(|word| *word != "│").collect();
    for file in ["a.RHAI", "b.rhai.txt", "more/c.rhai", "tests/d.rhai", "e.toml", "more/f.toml", "g.TOML"] {
        assert!(said.contains(&format!("{file}isnotread")), "{file} in {said}");
    }
    for file in ["h.rhai", "i.rhai", "notes", "j.toml"] {
        assert!(!said.contains(file), "{file} in {said}");
    }
    let said = site.adit("build", &[]).expecting(0);
    assert!(format!("{}{}", said.stdout, said.stderr).contains("is not read"));
}

#[test]
fn a_text_that_is_nearly_one_of_the_tables_is_told_and_others_are_not() {
    let rule = |state: &str| {
        format!(
            "revise \"low\"\n    each room in ROOMS where room.state == \"{state}\"\n    set room.hardness by * 2.0 level 10\n"
        )
    };
    let site = TestSite::example("clinic").with("rules/low.rhai", &rule("SQAT"));
    for (verb, status) in [("check", 1), ("build", 0)] {
        let ran = site.adit(verb, &[]).expecting(status);
        let all = said(&ran);
        let slip = "line 1) asks for state \"SQAT\", which there is not: did you mean \"SQUAT\"?";
        assert_eq!(all.matches(slip).count(), 1, "{verb}: {all}");
    }
    for state in ["SQUAT", "SWIM"] {
        site.write("rules/low.rhai", rule(state));
        let all = said(&site.adit("check", &[]).expecting(0));
        assert!(!all.contains("which there is not"), "{all}");
    }
}

#[test]
fn what_a_rule_that_reacts_tells_is_a_table() {
    let site = with_rules();
    site.write(
        "rules/react.rhai",
        "// a comment\non \"a hard door is told\"\n    each door in DOORS where door.hardness > 5.0\n    then { tell(\"HARD\", #{ door: door.door }); }\n",
    );
    site.adit("check", &[]).expect_status(0);
    let said = site.adit("build", &[]).expecting(0).stdout;
    assert!(said.contains("by rule \"a hard door is told\""), "{said}");
    let hard = site.sqlite3("SELECT door FROM doors WHERE hardness > 5.0 ORDER BY door");
    assert!(!hard.is_empty());
    assert_eq!(site.sqlite3("SELECT CAST(door AS INTEGER) FROM hard ORDER BY door"), hard);
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT count(*) FROM hard"), [hard.len().to_string()], "once each");
}

/// A world's file in a folder with its own copy of the shipped rules.
fn world(text: &str, base: &str) -> TestSite {
    let folder = TestSite::empty();
    folder.write("world.toml", format!("rules = \"mine\"\n{text}"));
    let shipped = adit_tests::repository().join("rules").join(base);
    for entry in std::fs::read_dir(shipped).expect("a rule base").flatten() {
        if entry.path().is_file() {
            let name = entry.file_name().to_string_lossy().into_owned();
            folder.write(&format!("mine/{name}"), std::fs::read(entry.path()).expect("readable"));
        }
    }
    folder
}

fn shipped_world(name: &str) -> String {
    std::fs::read_to_string(adit_tests::repository().join("kb/worlds").join(name)).expect("a world")
}

fn run(folder: &TestSite, arguments: &[&str]) -> adit_tests::Ran {
    let mut adit = std::process::Command::new(adit_tests::adit());
    adit_tests::Ran::new(&adit.args(arguments).current_dir(folder.path()).output().expect("adit runs"))
}

/// Worlds, their rule bases, and a rule that reacts to what each of them is told.
const WORLDS: [(&str, &str, &str, &[&str]); 3] = [
    ("corridor-S.toml", "channels/corrected", "TURNS", &["route", "world.toml", "start", "goal"]),
    ("flat.toml", "navigation", "WAYS", &["simulate", "world.toml", "--missions", "1"]),
    ("cell.toml", "adapt", "EDGES", &["tasks", "world.toml", "load"]),
];

#[test]
fn a_rule_that_reacts_to_what_is_asked_one_at_a_time_is_refused() {
    for (file, base, class, arguments) in WORLDS {
        let folder = world(&shipped_world(file), base);
        if file == "flat.toml" {
            folder.write("flat.json", shipped_world("flat.json"));
        }
        run(&folder, arguments).expect_status(0);
        let rule = format!(
            "on \"tells\"\n    each one in {class}\n    then {{ tell(\"SEEN\", #{{ one: 1.0 }}); }}\n"
        );
        folder.write("mine/react.rhai", rule);
        run(&folder, arguments).expecting(2).complains(&[
            "rule \"tells\"",
            "of which rules are asked about one at a time",
            "mine/react.rhai:1:4",
        ]);
    }
}

#[test]
fn what_nobody_asks_of_a_worlds_rules_is_said() {
    for (file, base, class, arguments) in WORLDS {
        let folder = world(&shipped_world(file), base);
        if file == "flat.toml" {
            folder.write("flat.json", shipped_world("flat.json"));
        }
        let rule = format!("rule \"in vain\"\n    each one in {class}\n    then {{ one.wieght = 3.0; }}\n");
        folder.write("mine/vain.rhai", rule);
        folder.write("mine/more/other.rhai", "");
        let said = run(&folder, arguments).expecting(0);
        said.complains(&["\"in vain\"", &format!("{class}.wieght"), "more/other.rhai is not read"]);
    }
}

#[test]
fn misspelt_keys_of_sites_and_worlds_are_refused() {
    let site = TestSite::example("paper");
    site.write("site.toml", format!("rulez = \"rules\"\n{}", site.read("site.toml")));
    site.adit("build", &[]).expecting(2).complains(&["rulez", "rules"]);
    let folder = world(&shipped_world("corridor-S.toml"), "channels/corrected");
    folder.edit("world.toml", "rules =", "rule =");
    run(&folder, &["route", "world.toml", "start", "goal"]).expecting(2).complains(&["`rule`"]);
}

#[test]
fn an_edit_says_which_rules_were_edited_since_the_build_and_count_with_it() {
    let site = TestSite::example("starter")
        .with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n")
        .built();
    let tune = |value: &str| site.adit("tune", &["robots", "SQUAT", "hardness", value]).expecting(0).stderr;
    assert_eq!(tune("5"), "");
    let route = || site.adit("route", &["home", "window"]).expecting(0).stderr;
    assert_eq!(route(), "");
    let rule = "revise \"draughty\"\n    each room in ROOMS where room.y0 < 4.0\n    set room.hardness by * 2 level 10\n";
    site.write("rules/draughty.rhai", rule);
    let by_those = route();
    assert!(
        by_those.contains("a route is by those, until `adit build` takes these: \"draughty\""),
        "{by_those}"
    );
    site.write("rules/draughty.rhai", rule.replace("each", "ech"));
    assert!(route().contains("the rules are wrong as they are"));
    site.write("rules/draughty.rhai", rule);
    let edited = tune("6");
    assert!(
        edited.contains("rules differ from those of the last build") && edited.contains("\"draughty\" ("),
        "{edited}"
    );
    assert_eq!(tune("7"), "");
    assert_eq!(route(), "");
    std::fs::remove_file(site.path().join("rules/draughty.rhai")).unwrap();
    let gone = tune("8");
    assert!(gone.contains("\"draughty\", which is gone"), "{gone}");
}

#[test]
fn check_names_rows_and_rules_that_never_count_and_inputs_without_a_row() {
    let rules = "table \"grade\" first\n    each p in PRODUCTS\n    given [ p.price ]\n    set [ p.grade ]\n\
        \x20   rows [ [ at_least(10.0), \"dear\" ], [ at_least(20.0), \"very dear\" ] ]\n\
        rule \"all the same\" priority 3 each p in PRODUCTS then { p.price = 1.0; }\n";
    let site = TestSite::example("shop").with("rules/grade.rhai", rules).built();
    let checked = said(&site.adit("check", &[]));
    for words in [
        "row 2 is never reached",
        "no row matches where p.price is below 10",
        "what rule \"all the same\" gives PRODUCTS.price never counts: each object is told one",
    ] {
        assert!(checked.contains(words), "{words}: {checked}");
    }
    // a rule that says so is heard before the table
    site.write("rules/grade.rhai", "property PRODUCTS.price from rule, table;\n".to_owned() + rules);
    let checked = said(&site.adit("check", &[]));
    assert!(!checked.contains("never counts"), "{checked}");
}
