//! Every command that the documents print works as it stands there, in a folder made as the text says.

mod page;
mod terminal;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use adit_tests::{Ran, adit, repository};

use page::{Item, Kind, items};
use terminal::Terminal;

/// What a block that is no command is for.
enum Use {
    /// The text has the reader make this file of it.
    File(&'static str),
    /// The text has the reader add it to this file.
    Added(&'static str),
    /// Nothing on the page works with it: it shows a form.
    Shown,
}

/// A page, what its blocks are for, by words in them, and the database that its SQL asks, by words in it.
struct Page {
    file: &'static str,
    blocks: &'static [(&'static str, Use)],
    databases: &'static [(&'static str, &'static str)],
}

const fn page(file: &'static str) -> Page {
    Page { file, blocks: &[], databases: &[] }
}

const PAGES: [Page; 25] = [
    Page {
        file: "README.md",
        blocks: &[
            ("dock to ward 12, hardness", Use::Shown),
            ("the south is draughty", Use::File("my-site/rules/south.rhai")),
        ],
        databases: &[("action_sequence", "my-site/site.db")],
    },
    Page {
        file: "manual/src/tutorials/a-map-of-yours.md",
        blocks: &[("name = \"charger\"", Use::Added("shop-floor/site.toml"))],
        databases: &[("FROM waypoints", "shop-floor/site.db")],
    },
    page("manual/src/tutorials/an-experts-table.md"),
    Page { file: "manual/src/tutorials/in-sql.md", blocks: &[], databases: &[("FROM", "my-site/site.db")] },
    Page {
        file: "manual/src/tutorials/a-first-rule.md",
        blocks: &[
            ("the south is draughty", Use::File("my-site/rules/south.rhai")),
            ("only the south is harder", Use::File("my-site/rules/tests/south.toml")),
        ],
        databases: &[],
    },
    Page {
        file: "manual/src/tutorials/the-paper.md",
        blocks: &[],
        databases: &[("FROM", "adit-demo/paper/site.db")],
    },
    Page {
        file: "manual/src/sites.md",
        blocks: &[
            ("width = 12.0", Use::File("drawn.toml")),
            ("state = \"SQUAT\"", Use::Shown),
            ("load = \"crate\"", Use::Added("my-site/robots.toml")),
        ],
        databases: &[],
    },
    Page {
        file: "manual/src/rules.md",
        blocks: &[
            ("rule \"a room is as hard as its state\"", Use::Shown),
            ("by the tap", Use::Added("my-site/site.toml")),
            ("revise \"wet floors are slippery\"", Use::File("my-site/rules/wet.rhai")),
            ("rule \"a raised arm", Use::File("my-site/rules/arm.rhai")),
            ("a metre weighs what the state weighs", Use::File("my-site/rules/tests/metre.toml")),
        ],
        databases: &[],
    },
    Page {
        file: "manual/src/without-a-map.md",
        blocks: &[("presents are wrapped", Use::File("my-shop/rules/presents.rhai"))],
        databases: &[],
    },
    page("manual/src/tuning.md"),
    Page {
        file: "manual/src/measures.md",
        blocks: &[
            ("changing shape costs", Use::File("quick/rules/quick.rhai")),
            ("every metre is a risk", Use::File("my-site/rules/risk.rhai")),
            ("each leg in LEGS", Use::File("halls/rules/own.rhai")),
        ],
        databases: &[("action_sequence", "my-site/site.db"), ("FROM waypoints", "my-site/site.db")],
    },
    Page {
        file: "manual/src/telling.md",
        blocks: &[
            ("name = \"ward door\"", Use::Added("my-site/site.toml")),
            ("a robot found blocked", Use::File("my-site/rules/blocked.rhai")),
            ("timezone = ", Use::Shown),
        ],
        databases: &[],
    },
    Page {
        file: "manual/src/asking-why.md",
        blocks: &[("Walk-on-knee in corridor 15", Use::Shown), ("distance,measured", Use::File("runs.csv"))],
        databases: &[],
    },
    Page {
        file: "manual/src/sql.md",
        blocks: &[],
        databases: &[("action_sequence", "my-site/site.db"), ("FROM route", "my-site/site.db")],
    },
    Page {
        file: "manual/src/bodies.md",
        blocks: &[("\"type\":\"hello\"", Use::Shown), ("kb/bodies/disc.py}}", Use::Shown)],
        databases: &[],
    },
    Page {
        file: "manual/src/geodata.md",
        blocks: &[("file = \"keepout.yaml\"", Use::Shown), ("file = \"zones.json\"", Use::Shown)],
        databases: &[],
    },
    page("manual/src/ways.md"),
    page("manual/src/other-maps.md"),
    page("manual/src/lane-graphs.md"),
    Page {
        file: "manual/src/corridors-and-parts.md",
        blocks: &[],
        databases: &[("action_sequence", "part.db")],
    },
    Page {
        file: "manual/src/floor-plans-and-missions.md",
        blocks: &[
            ("start 1.5,1.5 90", Use::File("orders.txt")),
            ("squeaks = true", Use::Shown),
            ("at_once = 1", Use::Shown),
            ("nobody crosses what is wet", Use::Shown),
        ],
        databases: &[("journal", "missions.db"), ("floor_regions", "flat.db")],
    },
    Page { file: "manual/src/cells.md", blocks: &[], databases: &[("FROM edges", "cell.db")] },
    Page {
        file: "manual/src/service.md",
        blocks: &[
            ("\"error\"", Use::Shown),
            ("\"follower\"", Use::Shown),
            ("\"together\"", Use::Shown),
            ("\"robots\"", Use::Shown),
        ],
        databases: &[],
    },
    page("manual/src/packages.md"),
    page("manual/src/figures.md"),
];

/// What is not run, and why.
const NOT_RUN: [(&str, &str); 7] = [
    ("cargo ", "builds the program or its documents anew: minutes; the tests run what it builds"),
    ("podman ", "needs an engine for containers, and the image; packages.rs makes what it is built of"),
    ("tests/run", "runs all tests, this one too"),
    ("tests/peers/", "needs other people's programs; tests/tests/peers.rs runs them where these are"),
    ("tests/fuzz_coverage.sh", "compiles all of it anew, with counters"),
    ("tests/pictures.sh", "draws pictures to be looked at"),
    ("DELETE FROM", "a fragment"),
];

/// Statements that find nothing where all is well.
const MAY_BE_EMPTY: [&str; 2] = ["FROM journal", "FROM edges"];

fn check(file: &str) {
    let page = PAGES.iter().find(|page| page.file == file).expect("a page of the list");
    let mut terminal = Terminal::new();
    terminal.link("kb");
    map_of_yours(terminal.folder());
    let text = fs::read_to_string(repository().join(file)).expect("a page");
    let all = items(&text);
    // a file is there before the commands that need it, though the page may show it below them
    for item in all.iter().filter(|item| matches!(item.kind, Kind::Block)) {
        if let Use::File(name) = used(page, item)
            && !name.contains('/')
        {
            terminal.write(name, &item.text);
        }
    }
    for item in &all {
        let at = format!("{file}, line {}", item.line);
        match item.kind {
            Kind::Command if NOT_RUN.iter().any(|(words, _)| item.text.starts_with(words)) => {
                if let Some(script) =
                    item.text.split_whitespace().next().filter(|word| word.starts_with("tests/"))
                {
                    assert!(repository().join(script).is_file(), "{at}: there is no {script}");
                }
            }
            Kind::Command => terminal.run(&item.text, &at),
            Kind::Sql => {
                let found = page.databases.iter().find(|(words, _)| item.text.contains(words));
                let (_, database) =
                    found.unwrap_or_else(|| panic!("{at}: of which database is this?\n{}", item.text));
                let rows = terminal.sqlite3(database, &item.text, &at);
                let may_be_empty = MAY_BE_EMPTY.iter().any(|words| item.text.contains(words));
                assert!(may_be_empty || !rows.is_empty(), "{at}: no row\n{}", item.text);
            }
            Kind::Block => match used(page, item) {
                Use::File(name) => terminal.write(name, &item.text),
                Use::Added(name) => terminal.add(name, &item.text),
                Use::Shown => {}
            },
        }
    }
}

fn used<'p>(page: &'p Page, item: &Item) -> &'p Use {
    let found = page.blocks.iter().find(|(words, _)| item.text.contains(words));
    &found
        .unwrap_or_else(|| {
            panic!("{}, line {}: what is this block for?\n{}", page.file, item.line, item.text)
        })
        .1
}

/// The `map.yaml` with its image that a reader has: 30 x 14 m, free but for its edge.
fn map_of_yours(folder: &Path) {
    let (columns, rows) = (300, 140);
    let is_edge = |cell: usize| {
        let (column, row) = (cell % columns, cell / columns);
        column == 0 || row == 0 || column == columns - 1 || row == rows - 1
    };
    let mut image = format!("P5\n{columns} {rows}\n255\n").into_bytes();
    image.extend((0..columns * rows).map(|cell| if is_edge(cell) { 0 } else { 254 }));
    fs::write(folder.join("map.pgm"), image).expect("written");
    let text = "image: map.pgm\nresolution: 0.1\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n";
    fs::write(folder.join("map.yaml"), text).expect("written");
}

macro_rules! each_page {
    ($($name:ident: $file:literal;)*) => {
        $(#[test]
        fn $name() {
            check($file);
        })*
    };
}

each_page! {
    the_readme: "README.md";
    a_map_of_yours: "manual/src/tutorials/a-map-of-yours.md";
    an_experts_table: "manual/src/tutorials/an-experts-table.md";
    answers_in_sql: "manual/src/tutorials/in-sql.md";
    a_first_rule: "manual/src/tutorials/a-first-rule.md";
    the_paper: "manual/src/tutorials/the-paper.md";
    sites: "manual/src/sites.md";
    rules: "manual/src/rules.md";
    without_a_map: "manual/src/without-a-map.md";
    tuning: "manual/src/tuning.md";
    seconds_and_joules: "manual/src/measures.md";
    telling: "manual/src/telling.md";
    asking_why: "manual/src/asking-why.md";
    sql: "manual/src/sql.md";
    a_robot_of_your_own: "manual/src/bodies.md";
    geodata: "manual/src/geodata.md";
    ways: "manual/src/ways.md";
    other_maps: "manual/src/other-maps.md";
    parts_and_corridors: "manual/src/corridors-and-parts.md";
    floor_plans_and_missions: "manual/src/floor-plans-and-missions.md";
    cells_and_experience: "manual/src/cells.md";
    the_service: "manual/src/service.md";
    lane_graphs: "manual/src/lane-graphs.md";
    packages: "manual/src/packages.md";
    figures: "manual/src/figures.md";
}

#[test]
fn every_verb_has_its_line_in_the_manual() {
    let page = fs::read_to_string(repository().join("manual/src/commands.md")).expect("a page");
    let help = Command::new(adit()).arg("--help").output().expect("the program runs").stdout;
    let help = String::from_utf8(help).expect("text");
    let verbs = help.lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let verbs: Vec<&str> =
        verbs.filter(|verb| verb.starts_with(char::is_lowercase) && *verb != "help").collect();
    assert!(verbs.len() > 30, "{help}");
    let is_there = |verb: &&&str| [' ', '`'].iter().any(|end| page.contains(&format!("`{verb}{end}")));
    assert_eq!(verbs.iter().filter(|verb| !is_there(verb)).collect::<Vec<_>>(), Vec::<&&str>::new());
}

#[test]
fn no_other_page_prints_a_command() {
    let mut found = Vec::new();
    pages(&repository(), &mut found);
    assert!(found.len() > PAGES.len(), "{found:?}");
    for page in found {
        let name = page.strip_prefix(repository()).expect("in the repository").to_string_lossy().into_owned();
        // what changed is told of what was, and a bridge's own tests run what its page prints
        if name == "CHANGELOG.md"
            || name.starts_with("bridges/")
            || PAGES.iter().any(|page| page.file == name)
        {
            continue;
        }
        let text = fs::read_to_string(&page).expect("a page");
        let commands: Vec<Item> = items(&text).into_iter().filter(|item| item.kind != Kind::Block).collect();
        let runs = |item: &Item| NOT_RUN.iter().all(|(words, _)| !item.text.starts_with(words));
        assert!(!commands.iter().any(runs), "{name} prints commands, and no test runs them: {commands:?}");
    }
}

/// The Markdown files of the repository.
fn pages(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let (path, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            if !name.starts_with('.') && name != "target" && name != "node_modules" {
                pages(&path, found);
            }
        } else if path.extension().is_some_and(|ending| ending == "md") {
            found.push(path);
        }
    }
}

/// The commands that a program said one might run next.
fn next(said: &str) -> Vec<String> {
    let listed = said.split_once("What to try next:\n").map_or("", |(_, listed)| listed).lines();
    let one = said.lines().filter_map(|line| line.strip_prefix("next: "));
    listed.chain(one).map(|line| line.trim().to_owned()).collect()
}

#[test]
fn what_the_demo_and_a_new_site_say_to_try_next_runs_where_no_adit_is_installed() {
    let mut terminal = Terminal::without_adit();
    for arguments in [&["demo"][..], &["demo", "--out", "a demo's"], &["new", "a new site"]] {
        let ran = Command::new(adit()).args(arguments).current_dir(terminal.folder()).output();
        let said = Ran::new(&ran.expect("adit runs")).expecting(0).stdout;
        let commands = next(&said);
        assert!(!commands.is_empty(), "{said}");
        for command in commands {
            terminal.run(&command, &arguments.join(" "));
        }
        fs::remove_dir_all(terminal.folder().join("my-site")).ok();
    }
}
