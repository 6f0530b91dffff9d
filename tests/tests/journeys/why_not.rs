//! What why-not claims is computed, and how firm says the same: the number that it names turns the way when it is
//! tried, and where it names none, no number of *how firm* turns the way to there.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit::edit::Edit;
use adit::preview::Wanted;
use adit::why::firm::Firm;
use adit::why::why_not::WhyNot;
use adit::{Answer, KnowledgeBase, Live};
use adit_db::history::Author;
use adit_db::route::Step;
use adit_tests::TestSite;
use adit_tests::oracle::random::Chance;

const PAIRS: [(&str, &str); 3] = [("dock", "ward 12"), ("lobby", "kitchen"), ("theatre", "pharmacy")];

fn live(site: &TestSite) -> Live {
    Live::open(KnowledgeBase::open(site.path()).unwrap()).unwrap()
}

fn set(table: &str, key: &str, column: &str, value: f64) -> Edit {
    Edit::Set(table.to_owned(), key.to_owned(), column.to_owned(), format!("{value}"))
}

/// Whether the best way leads through a room or door where a cell has the value that is named.
fn turns(live: &mut Live, answer: &WhyNot) -> bool {
    let cell = answer.would_win.as_ref().unwrap();
    let author = Author { who: "test".to_owned(), why: String::new() };
    let at = |value: f64| set(&cell.table, &cell.key, &cell.column, value);
    live.edit(&at(cell.wins_at), &author).unwrap();
    let there = live.why_not(&answer.start, &answer.goal, &answer.through, None).unwrap();
    live.edit(&at(cell.value), &author).unwrap();
    there.cost.unwrap() <= there.best.unwrap() * (1.0 + 2e-6) && there.reason.contains("the best route")
}

/// The rooms and doors of a route.
fn passed(route: &Answer) -> Vec<String> {
    let name = |step: &Step| format!("{} {}", if step.kind == "room" { "room" } else { "door" }, step.place);
    route.steps.iter().map(name).collect()
}

/// The rooms and doors of the ways that take over where a cell is a hair beyond an end of what is firm.
fn taking_over(live: &Live, firm: &Firm) -> Vec<String> {
    let mut through = Vec::new();
    for cell in &firm.cells {
        let below = cell.below.as_ref().and(cell.low).map(|low| low - 1e-4 * low.abs().max(0.1));
        let above = cell.above.as_ref().and(cell.high).map(|high| high + 1e-4 * high.abs().max(0.1));
        for value in below.into_iter().chain(above).filter(|value| *value >= 0.0) {
            let wanted = Wanted { start: &firm.start, goal: &firm.goal, robot: None };
            let edit = set(&cell.table, &cell.key, &cell.column, value);
            let route = live.preview(&[edit], Some(wanted)).unwrap().route.unwrap();
            through.extend(passed(&route));
        }
    }
    through
}

#[test]
fn the_number_that_why_not_names_turns_the_way_and_where_it_names_none_firm_has_none() {
    let site = TestSite::example("clinic").built();
    let mut live = live(&site);
    let rooms = site.sqlite3(
        "SELECT name FROM rooms WHERE state = 'STAND' ORDER BY (x1 - x0) * (y1 - y0) DESC LIMIT 120",
    );
    let doors = site.sqlite3("SELECT door FROM doors WHERE width > 0.3 ORDER BY door");
    let mut chance = Chance::new(3);
    let (mut named, mut none, mut cut) = (0, 0, 0);
    for (start, goal) in PAIRS {
        let firm = live.firm(start, goal, None).unwrap();
        assert!(!firm.truncated || firm.cost.is_some());
        let now = passed(&live.route(start, &[goal.to_owned()], None).unwrap());
        let mut others = taking_over(&live, &firm);
        others.retain(|other| !now.contains(other));
        for question in 0..8 {
            let through = match question % 4 {
                0 => format!("door {}", doors[chance.below(doors.len())]),
                // what does take over somewhere
                1 | 2 if !others.is_empty() => others[chance.below(others.len())].clone(),
                _ => format!("room {}", rooms[chance.below(rooms.len())]),
            };
            let answer = live.why_not(start, goal, &through, None).unwrap();
            let (Some(best), Some(cost)) = (answer.best, answer.cost) else { continue };
            assert!(cost >= best * (1.0 - 1e-6), "{}", answer.sentence);
            if cost <= best * (1.0 + 1e-6) {
                continue;
            }
            if answer.would_win.is_some() {
                named += 1;
                assert!(turns(&mut live, &answer), "{start} to {goal}: {}", answer.sentence);
            } else if answer.not_looked_further {
                cut += 1;
                assert!(!answer.sentence.contains("No single number"), "{}", answer.sentence);
            } else {
                none += 1;
                assert!(!others.contains(&through), "{start} to {goal}: {}", answer.sentence);
            }
        }
    }
    assert!(named >= 4, "{named} named, {none} none, {cut} cut");
}

#[test]
fn through_a_room_costs_no_more_than_by_a_point_in_it() {
    let site = TestSite::example("clinic").built();
    let live = live(&site);
    let rooms = site.sqlite3(
        "SELECT name, (x0 + x1) / 2, (y0 + y1) / 2 FROM rooms WHERE state = 'STAND' AND x1 - x0 > 0.05 \
         AND y1 - y0 > 0.05 ORDER BY (room * 7919) % 1009 LIMIT 12",
    );
    let mut compared = 0;
    for room in &rooms {
        let [name, x, y] = room.split('|').collect::<Vec<_>>()[..] else { panic!("{room}") };
        let cost = |through: &str| live.why_not("dock", "ward 12", through, None).unwrap().cost;
        let (Some(through), Some(by)) = (cost(&format!("room {name}")), cost(&format!("{x},{y}"))) else {
            continue;
        };
        compared += 1;
        // off walls, ways may cost a hundredth more than they must
        assert!(through <= by * 1.01, "room {name}: {through}, by its middle {x},{y}: {by}");
    }
    assert!(compared >= 6, "{compared} of {}", rooms.len());
}

/// A wall with two doorways; by the second one it is farther.
const TWO_DOORWAYS: &str = "width = 12.0\ndepth = 8.0\n\
    [[obstacle]]\nrect = [5.9, 0.0, 6.1, 2.0]\n[[obstacle]]\nrect = [5.9, 3.0, 6.1, 6.0]\n\
    [[obstacle]]\nrect = [5.9, 7.0, 6.1, 8.0]\n\
    [[place]]\nname = \"west\"\nat = [2.0, 2.5]\n[[place]]\nname = \"east\"\nat = [10.0, 2.5]\n";

#[test]
fn a_way_that_only_comes_up_to_a_closed_doorway_is_none_through_it() {
    let site = TestSite::example("starter").with("map.toml", TWO_DOORWAYS).with(
        "site.toml",
        "name = \"two\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\n",
    );
    let site = site.built();
    let asked = ["west", "east", "--through", "doorway 2"];
    let open = site.adit("why-not", &asked).expecting(0).stdout;
    assert!(open.contains("through doorway 2 it costs"), "{open}");
    for closing in [&["doorway 2"][..], &["doorway 2", "--only", "robot"]] {
        site.adit("close", closing).expect_status(0);
        let closed = site.adit("why-not", &asked).expecting(0).stdout;
        assert!(closed.contains("closed") && !closed.contains("costs"), "{closing:?}: {closed}");
        site.adit("open", &["doorway 2"]).expect_status(0);
    }
}

#[test]
fn on_the_clinic_side_walking_that_gets_harder_turns_the_way_through_the_corridor_in_the_east() {
    // once: "No single number of the tables makes it the best way", where *how firm* named this one
    let site = TestSite::example("clinic").built();
    let mut live = live(&site);
    let corridor = site.sqlite3(
        "SELECT 'room ' || name FROM rooms WHERE state = 'STAND' AND 58.5 BETWEEN x0 AND x1 AND 14 BETWEEN y0 AND y1
         ORDER BY (x1 - x0) * (y1 - y0) LIMIT 1",
    );
    let answer = live.why_not("dock", "ward 12", &corridor[0], None).unwrap();
    let cell = answer.would_win.as_ref().unwrap();
    assert_eq!(
        (cell.key.as_str(), cell.column.as_str()),
        ("robot/SIDE-STAND", "hardness"),
        "{}",
        answer.sentence
    );
    assert!(!answer.not_looked_further && answer.sentence.contains(" rose to "), "{}", answer.sentence);
    assert!(turns(&mut live, &answer), "{}", answer.sentence);
}
