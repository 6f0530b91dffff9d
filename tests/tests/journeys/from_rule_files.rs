//! Problems from the literature, run as sites without a map: rule files and tables alone. What they come to is what the engine
//! comes to in a program.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::fmt::Display;

use adit_engine::Limits;
use adit_tests::{TestSite, repository};

#[path = "../../../engine/examples/manners/party.rs"]
mod party;
#[path = "../../../engine/examples/waltz/scene.rs"]
mod scene;

/// A site of the rules of an example.
fn site(example: &str, tables: &[(&str, String)]) -> TestSite {
    let site = TestSite::empty();
    for folder in ["rules", "tables"] {
        std::fs::create_dir_all(site.path().join(folder)).unwrap();
    }
    site.write("site.toml", "rooms = \"none\"\n");
    let rules = repository().join(format!("engine/examples/{example}/{example}.rhai"));
    site.write("rules/rules.rhai", std::fs::read(rules).unwrap());
    if example == "manners" {
        // what no table has is declared
        site.write("rules/party.rhai", "property PARTY.seating from table, default 0\n");
    }
    for (name, text) in tables {
        site.write(&format!("tables/{name}.csv"), text);
    }
    site.built()
}

fn lines(head: &str, rows: impl IntoIterator<Item = impl Display>) -> String {
    rows.into_iter().fold(format!("{head}\n"), |text, row| format!("{text}{row}\n"))
}

#[test]
fn sixteen_guests_sit_as_they_do_in_a_program() {
    // as a table has them: by name
    let mut guests = party::guests(16, 1);
    guests.sort_by(|one, other| one.name.cmp(&other.name));
    let rows: Vec<String> = guests
        .iter()
        .flat_map(|guest| {
            guest.hobbies.iter().map(move |hobby| format!("{},{hobby},{}", guest.name, guest.sex))
        })
        .collect();
    let party = "dinner,start,16,1".to_owned();
    let site = site(
        "manners",
        &[
            ("guests", lines("name*,hobby*,sex", rows)),
            ("party", lines("party,doing,seats,seatings", [party])),
        ],
    );
    assert_eq!(site.sqlite3("SELECT doing FROM party"), ["done"]);
    let sit = "SELECT guest FROM path WHERE id = (SELECT seating FROM party) ORDER BY seat";
    let seating = site.sqlite3(sit);
    party::checked(&guests, &seating).unwrap();
    let mut base = party::table(&guests, Limits::default()).unwrap();
    base.react(&party::rules().unwrap());
    assert_eq!(Some(seating), party::seating(&base));
}

#[test]
fn the_edges_of_a_stair_and_a_cube_mean_what_they_do_in_a_program() {
    let drawn = scene::scene(1);
    let rows =
        drawn.iter().enumerate().map(|(nth, [x1, y1, x2, y2])| format!("{},0,{x1},{y1},{x2},{y2}", nth + 1));
    let meanings = scene::MEANINGS.iter().enumerate();
    let meanings = meanings.map(|(nth, (kind, [a, b, c]))| format!("{nth},{kind},\"{a}\",\"{b}\",\"{c}\""));
    let site = site(
        "waltz",
        &[
            ("lines", lines("line,drawing,x1,y1,x2,y2", rows)),
            ("drawings", lines("drawing", ["0"])),
            ("meanings", lines("number,kind,a,b,c", meanings)),
            ("picture", lines("picture,doing", ["first,edges"])),
        ],
    );
    assert_eq!(site.sqlite3("SELECT doing FROM picture"), ["done"]);
    let mut base = scene::picture(&drawn, 1, Limits::default()).unwrap();
    base.react(&scene::rules().unwrap());
    let expected: Vec<String> = scene::labels(&base)
        .iter()
        .map(|((from, to), label)| format!("{}|{}|{}|{}|{label}", from.0, from.1, to.0, to.1))
        .collect();
    let mut found = site.sqlite3(
        "SELECT CAST(x AS INTEGER), CAST(y AS INTEGER), CAST(x + dx AS INTEGER), CAST(y + dy AS INTEGER), label FROM edges
         WHERE label IS NOT NULL",
    );
    let mut expected = expected;
    expected.sort();
    found.sort();
    assert_eq!(found.len(), 2 * drawn.len());
    assert_eq!(found, expected);
}
