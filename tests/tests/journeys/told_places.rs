//! Told by a point, a closed door stays closed wherever the map moves its number, or is reported as lost.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::fmt::Write as _;

use adit::edit::Edit;
use adit::{KnowledgeBase, Silent, Tell};
use adit_db::Store;
use adit_db::history::Author;
use adit_planners::geometry::{Point, Segment};
use adit_tests::TestSite;

/// Numbers that look random and are the same each time.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % sides
    }

    /// Metres between two numbers, by tenths.
    fn metres(&mut self, low: f64, high: f64) -> f64 {
        low + self.roll(((high - low) * 10.0) as u64 + 1) as f64 / 10.0
    }
}

/// Two rooms with a wall between them, a doorway of one metre in it, and obstacles that come and go.
struct Map {
    obstacles: Vec<[f64; 4]>,
    grid: f64,
}

impl Map {
    fn change(&mut self, dice: &mut Dice) {
        let new = |dice: &mut Dice| {
            let (x, y) = (dice.metres(0.0, 10.0), dice.metres(0.0, 7.0));
            [x, y, x + dice.metres(0.2, 1.5), y + dice.metres(0.2, 1.0)]
        };
        match dice.roll(5) {
            0 if !self.obstacles.is_empty() => {
                let at = dice.roll(self.obstacles.len() as u64) as usize;
                self.obstacles.remove(at);
            }
            1 if !self.obstacles.is_empty() => {
                let at = dice.roll(self.obstacles.len() as u64) as usize;
                self.obstacles[at] = new(dice);
            }
            2 => self.grid = [0.05, 0.1, 0.08][dice.roll(3) as usize],
            _ => self.obstacles.push(new(dice)),
        }
    }

    fn write(&self, site: &TestSite) {
        let mut text = "width = 12.0\ndepth = 8.0\n".to_owned();
        let walls = [[5.9, 0.0, 6.1, 3.0], [5.9, 4.0, 6.1, 8.0]];
        for [x0, y0, x1, y1] in walls.iter().chain(&self.obstacles) {
            write!(text, "[[obstacle]]\nrect = [{x0}, {y0}, {}, {}]\n", x1.min(12.0), y1.min(8.0)).unwrap();
        }
        site.write("map.toml", text);
        site.write(
            "site.toml",
            format!("map = \"map.toml\"\nrobots = \"robots.toml\"\ngrid = {}\n", self.grid),
        );
    }
}

fn author() -> Author {
    Author { who: "test".to_owned(), why: String::new() }
}

fn segment_of([x0, y0, x1, y1]: [f64; 4]) -> Segment {
    Segment::new(Point::new(x0, y0), Point::new(x1, y1))
}

/// Checks that just the doors at the told place are closed; whether there is one.
fn check(site: &TestSite, lost: usize, step: &str) -> bool {
    let mut store = Store::open_read_only(site.path().join("site.db")).unwrap();
    let (doors, told, standings) = store
        .snapshot(|tx| -> adit_db::Result<_> { Ok((tx.doors()?, tx.facts_told()?, tx.standings()?)) })
        .unwrap();
    let (at, segment) = (told[0].at.unwrap(), told[0].segment.unwrap());
    let is_attached = standings[0].state == "attached";
    assert_eq!(is_attached, !standings[0].keys.is_empty(), "{step}");
    assert_eq!(lost, usize::from(!is_attached), "{step}: what is lost is reported, and nothing else");
    for door in &doors {
        let is_meant = standings[0].keys.contains(&door.door.to_string());
        assert_eq!(door.passable.value, Some(!is_meant), "{step}: door {}", door.door);
        assert_eq!(door.passable.rule.is_none(), is_meant, "{step}: door {}", door.door);
        if is_meant {
            let (here, told) = (segment_of(door.segment), segment_of(segment));
            let apart = here.distance(Point::new(at[0], at[1]));
            assert!(apart <= 0.5, "{step}: door {} is elsewhere", door.door);
            let cosine = here.direction().dot(told.direction()).abs();
            assert!(cosine > 0.93, "{step}: door {} goes elsewhere", door.door);
        }
    }
    is_attached
}

#[test]
fn a_closed_door_survives_ten_random_edits_of_the_map_or_is_reported() {
    let (mut kept, mut lost) = (0, 0);
    for seed in 0..6 {
        let mut dice = Dice(seed);
        let mut map = Map { obstacles: Vec::new(), grid: 0.05 };
        let site = TestSite::example("starter");
        map.write(&site);
        let open = || KnowledgeBase::open(site.path()).unwrap();
        open().build(&Silent).unwrap();
        let object = if seed % 2 == 0 { door_in_the_doorway(&site) } else { "5.9,3.5".to_owned() };
        let [class, property, value] = ["doors", "passable", "false"].map(str::to_owned);
        let tell = Tell { class, object, property, value, ..Tell::default() };
        open().edit(&Edit::Tell(tell), &author(), false, &Silent).unwrap();
        for step in 0..10 {
            map.change(&mut dice);
            map.write(&site);
            let report = open().build(&Silent).unwrap();
            if check(&site, report.lost.len(), &format!("seed {seed}, step {step}")) {
                kept += 1;
            } else {
                lost += 1;
            }
        }
    }
    assert!(kept > 30, "the doorway is hardly ever blocked: kept {kept} times, lost {lost} times");
}

/// `door 7`: one whose segment is upright and nearest to the doorway's middle.
fn door_in_the_doorway(site: &TestSite) -> String {
    let nearest = "SELECT 'door ' || door FROM doors WHERE kind = 'door' AND abs(x1 - x0) < 1e-6
                   ORDER BY abs(x - 6) + abs(y - 3.5), door LIMIT 1";
    site.sqlite3(nearest).concat()
}

#[test]
fn what_a_wall_took_away_is_closed_again_when_the_wall_is_gone() {
    let site = TestSite::example("starter");
    let mut map = Map { obstacles: Vec::new(), grid: 0.05 };
    map.write(&site);
    let site = site.built();
    let door = door_in_the_doorway(&site);
    site.adit("tell", &["DOORS", &door, "passable", "false"]).expect_status(0);
    let closed = "SELECT door FROM doors WHERE NOT passable ORDER BY door";
    let before = site.sqlite3(closed);
    assert!(!before.is_empty());
    map.obstacles.push([4.8, 2.0, 7.2, 5.0]);
    map.write(&site);
    site.adit("build", &[])
        .expecting(0)
        .complains(&["is lost", "counts for nothing until its place is back"]);
    assert!(site.sqlite3(closed).is_empty());
    map.obstacles.pop();
    map.write(&site);
    site.adit("build", &[]).expect_status(0);
    assert_eq!(site.sqlite3(closed), before);
}

#[test]
fn a_fact_about_a_room_is_about_what_holds_its_point_in_every_layer() {
    let site = TestSite::example("starter");
    Map { obstacles: Vec::new(), grid: 0.05 }.write(&site);
    let site = site.built();
    site.adit("tell", &["ROOMS", "9.5,2", "hardness", "7"]).expect_status(0);
    let rooms = "SELECT DISTINCT state FROM rooms WHERE hardness = 7 ORDER BY state";
    assert_eq!(site.sqlite3(rooms), ["SIDE-STAND", "SQUAT", "STAND"]);
    let elsewhere = "SELECT count(*) FROM rooms WHERE hardness = 7
                     AND NOT (9.5 BETWEEN x0 AND x1 AND 2 BETWEEN y0 AND y1)";
    assert_eq!(site.sqlite3(elsewhere), ["0"]);
}

#[test]
fn a_fact_about_a_room_is_about_every_facing_of_a_long_body() {
    // once, of the eight layers of a state only the first was told, so a body that turned knew nothing of it
    let body = "[[robots]]\nstate = \"ROLL\"\naction = \"DRIVE\"\nheight = 1.0\nwidth = 0.3\nlength = 0.6\nhardness = 1.0\n";
    let site = TestSite::empty()
        .with("site.toml", "name = \"hall\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\n")
        .with("map.toml", "width = 4.0\ndepth = 4.0\n")
        .with("robots.toml", body)
        .built();
    let holding =
        site.sqlite3("SELECT count(*) FROM rooms WHERE 2.0 BETWEEN x0 AND x1 AND 2.0 BETWEEN y0 AND y1");
    assert!(holding[0].parse::<usize>().unwrap() >= 8, "{holding:?}");
    site.adit("tell", &["ROOMS", "2.0,2.0", "passable", "false"]).expect_status(0);
    assert_eq!(site.sqlite3("SELECT count(DISTINCT facing) FROM rooms WHERE passable = 0"), ["8"]);
}
