//! Every reader is given what nobody wrote (`adit_tests::fuzz`): it says what is wrong, and neither panics, nor hangs, nor takes
//! much memory. Longer than two seconds each: `ADIT_FUZZ_SECONDS=60 cargo test -p adit-tests --test fuzz -- --nocapture`.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{self, ExitCode, Stdio};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use adit::cli::{self, Cli};
use adit::navigation::body::{Link, Remote, Used};
use adit::{KnowledgeBase, Silent};
use adit_db::Store;
use adit_db::query::Limits;
use adit_engine::{RuleBase, SourceFile};
use adit_planners::body::{Body, Command};
use adit_planners::lanes::read_lane_graph;
use adit_planners::read::{MapSettings, Overlay, read_world};
use adit_planners::rim::Rim;
use adit_tests::fuzz::{Fuzz, mutated, png, scattered, stored, zip};
use adit_tests::oracle::random::Chance;
use adit_tests::service::Service;
use adit_tests::{TestSite, adit, repository, shared};
use clap::Parser;
use serde_json::json;

/// The files of a folder and those beneath it that end so.
fn files(folder: &Path, end: &str) -> Vec<Vec<u8>> {
    let mut found = Vec::new();
    let mut all: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    all.sort();
    for path in all {
        if path.is_dir() {
            found.extend(files(&path, end));
        } else if path.to_string_lossy().ends_with(end) {
            found.push(fs::read(path).unwrap());
        }
    }
    // long ones make long turns
    found.retain(|text| text.len() < 100_000);
    found
}

fn ours(folder: &str, end: &str) -> Vec<Vec<u8>> {
    files(&repository().join(folder), end)
}

fn of_others(folder: &str, end: &str) -> Vec<Vec<u8>> {
    shared(folder).map_or_else(Vec::new, |folder| files(&folder, end))
}

/// Reads a text from a file of this name.
fn from_file(
    name: &'static str,
    read: impl Fn(&Path) -> bool + Send + 'static,
) -> impl Fn(&[u8]) -> bool + Send {
    let folder = TestSite::empty();
    move |text| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        read(&path)
    }
}

fn utf8(text: &[u8]) -> String {
    String::from_utf8_lossy(text).into_owned()
}

#[test]
fn worlds() {
    let seeds = [ours("kb/sites", "map.toml"), ours("kb/worlds", ".toml")].concat();
    let read = |path: &Path| read_world(path, &MapSettings::default()).is_ok();
    Fuzz::new("world", seeds).run(from_file("map.toml", read));
}

#[test]
fn overlays() {
    let seeds = ours("kb/sites", "map.toml");
    let world = read_world(&repository().join("kb/sites/paper/map.toml"), &MapSettings::default()).unwrap().0;
    Fuzz::new("overlay", seeds).run(move |text| {
        let laid = Overlay::from_toml("site.toml", &utf8(text))
            .and_then(|overlay| overlay.lay_over(&mut world.clone()));
        laid.is_ok()
    });
}

const MAP: &str = "image: floor.pgm\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nnegate: 0\nmode: trinary\n\
                   occupied_thresh: 0.65\nfree_thresh: 0.196\n";

fn pgm() -> Vec<u8> {
    let pixel = |at: usize| if at.is_multiple_of(7) { 0 } else { 254 };
    [b"P5\n# a floor\n40 30\n255\n".to_vec(), (0..1200).map(pixel).collect()].concat()
}

#[test]
fn yaml_of_maps() {
    let folder = TestSite::empty();
    folder.write("floor.pgm", pgm());
    Fuzz::new("map-yaml", [vec![MAP.into()], of_others("data/mir_robot", ".yaml")].concat()).run(
        move |text| {
            folder.write("map.yaml", text);
            read_world(&folder.path().join("map.yaml"), &MapSettings::default()).is_ok()
        },
    );
}

/// Reads an image as the map's.
fn image() -> impl Fn(&[u8]) -> bool + Send {
    let folder = TestSite::empty();
    folder.write("map.yaml", MAP);
    move |image| {
        folder.write("floor.pgm", image);
        read_world(&folder.path().join("map.yaml"), &MapSettings::default()).is_ok()
    }
}

#[test]
fn pgm_images() {
    let plain = b"P2\n4 3\n255\n0 0 0 0 255 255 255 255 0 1 2 3\n".to_vec();
    Fuzz::new("pgm", vec![pgm(), plain]).run_with(image(), |chance, seed, words| {
        // the head is a text, the rest is bytes
        let head = seed.len().min(24);
        let mut rest = seed[head..].to_vec();
        scattered(chance, &mut rest);
        [mutated(chance, &seed[..head], words), rest].concat()
    });
}

#[test]
fn png_images() {
    Fuzz::new("png", vec![vec![0]]).run_with(image(), |chance, _, _| {
        let any = |chance: &mut Chance, of: &[u32]| of[chance.below(of.len())];
        let sizes = [7, 30, 40, 1, 30, 40, 0, 65_535, 0x7fff_ffff, 0xffff_ffff];
        let (wide, high) = (any(chance, &sizes[..8]), any(chance, &sizes));
        let (depth, colour) = (any(chance, &[8, 8, 8, 1, 2, 4, 16, 3]), any(chance, &[0, 0, 2, 4, 6, 3, 9]));
        let mut head = [wide.to_be_bytes(), high.to_be_bytes()].concat();
        head.extend([depth as u8, colour as u8, 0, 0, any(chance, &[0, 0, 0, 0, 1, 2]) as u8]);
        let channels = match colour {
            2 => 3,
            4 => 2,
            6 => 4,
            _ => 1,
        };
        let line = 1 + (wide as usize * channels * depth as usize).div_ceil(8);
        let whole = line.saturating_mul(high as usize).min(20_000);
        let count = if chance.is(0.8) { whole } else { chance.below(4_000) };
        let filter = |at: usize, byte: usize| if at.is_multiple_of(line) { byte % 5 } else { byte };
        let rows: Vec<u8> = (0..count).map(|at| filter(at, chance.below(256)) as u8).collect();
        let mut data = stored(&rows);
        if chance.below(3) == 0 {
            scattered(chance, &mut data);
        }
        let mut chunks: Vec<(&[u8; 4], Vec<u8>)> = vec![(b"IHDR", head)];
        if chance.below(2) == 0 {
            chunks.push((b"PLTE", (0..chance.below(800)).map(|at| at as u8).collect()));
        }
        chunks.extend([(b"IDAT", data), (b"IEND", Vec::new())]);
        if chance.below(4) == 0 {
            let (one, other) = (chance.below(chunks.len()), chance.below(chunks.len()));
            chunks.swap(one, other);
        }
        let mut file = png(&chunks);
        if chance.below(4) == 0 {
            scattered(chance, &mut file);
        }
        file
    });
}

fn lanes(name: &'static str, file: &'static str, seeds: Vec<Vec<u8>>) {
    Fuzz::new(name, seeds).run(from_file(file, |path| read_lane_graph(path).is_ok()));
}

#[test]
fn buildings_of_open_rmf() {
    let seeds = [ours("kb/worlds", ".building.yaml"), of_others("data/open-rmf", ".yaml")].concat();
    lanes("lanes-yaml", "graph.building.yaml", seeds);
}

#[test]
fn layouts_of_lif_and_sites_of_open_rmf() {
    let seeds = [
        ours("kb/worlds", ".lif.json"),
        of_others("data/open-rmf", ".json"),
        of_others("data/lif", ".lif.json"),
    ];
    lanes("lanes-json", "graph.json", seeds.concat());
}

#[test]
fn route_graphs_of_nav2() {
    let node = |id: u8| json!({"type": "Feature", "properties": {"id": id, "frame": "map"}, "geometry": {"type": "Point", "coordinates": [id, 0.5]}});
    let edge = json!({"type": "Feature", "properties": {"id": 9, "startid": 0, "endid": 1, "cost": 2.5, "overridable": false,
                      "metadata": {"speed_limit": 85.0, "abs_speed_limit": 0.5}},
                      "geometry": {"type": "MultiLineString", "coordinates": [[[0, 0.5], [1, 0.5]]]}});
    let graph = json!({"type": "FeatureCollection", "name": "g", "features": [node(0), node(1), edge]});
    lanes("lanes-geojson", "graph.geojson", vec![graph.to_string().into()]);
}

#[test]
fn rules() {
    Fuzz::new("rules", ours("rules", ".rhai"))
        .run(|text| RuleBase::compile(&[SourceFile::new("a.rhai", utf8(text))]).is_ok());
}

/// Rules that are read run, too, on the tests beside them; and tests that nobody wrote run on rules that somebody did.
#[test]
fn rules_and_tests_that_run() {
    let site = TestSite::example("paper");
    site.copy_rules_and_tests("paper");
    let site = site.built();
    let tests = files(&site.path().join("rules/tests"), ".toml");
    let seeds = [files(&site.path().join("rules"), ".rhai"), tests].concat();
    let knowledge = KnowledgeBase::open(site.path()).unwrap();
    Fuzz::new("trial", seeds).run(move |text| {
        let text = utf8(text);
        let file = if text.contains("[[test]]") { "tests/doors.toml" } else { "doors.rhai" };
        let _ = &site;
        knowledge.try_rules([(file.to_owned(), Some(text))].into()).is_ok()
    });
}

/// A site of one changed file is built, from nothing.
fn built(name: &'static str, example: &'static str, file: &'static str, seeds: Vec<Vec<u8>>) {
    Fuzz::new(name, seeds).run(build(example, file));
}

fn build(example: &'static str, file: &'static str) -> impl Fn(&[u8]) -> bool + Send {
    let site = TestSite::example(example);
    if site.path().join("map.toml").exists() {
        // a floor that is built in no time
        site.write("map.toml", "width = 8.0\ndepth = 6.0\n[[obstacle]]\nrect = [3.0, 0.0, 4.0, 4.0]\n");
    }
    move |text| {
        site.write(file, text);
        let built = KnowledgeBase::open(site.path()).and_then(|knowledge| knowledge.build(&Silent)).is_ok();
        for kept in ["site.db", "site.db-wal", "site.db-shm"] {
            fs::remove_file(site.path().join(kept)).ok();
        }
        built
    }
}

#[test]
fn settings_of_sites() {
    let further = "name = \"x\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"paper\"\ntimezone = \"Europe/Berlin\"\n\
                   clearance = 0.0\ngrid = 0.1\n[[place]]\nname = \"p\"\nat = [3.0, 3.0]\n[[area]]\nname = \"a\"\nkind = \"wet\"\n\
                   rect = [1.0, 1.0, 2.0, 2.0]\n[[mask]]\nfile = \"m.yaml\"\n[[zone_set]]\nfile = \"z.json\"\n";
    built("site", "paper", "site.toml", [ours("kb/sites", "site.toml"), vec![further.into()]].concat());
}

#[test]
fn tables_of_robots() {
    built("robots", "paper", "robots.toml", ours("kb/sites/paper", "robots.toml"));
}

#[test]
fn tables_of_csv() {
    built("csv", "shop", "tables/orders.csv", ours("kb/sites/shop/tables", ".csv"));
}

#[test]
fn workbooks() {
    let types = r#"<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="xml" ContentType="application/xml"/><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Override PartName="/xl/workbook.xml" ContentType="application/vnd.openxmlformats-officedocument.spreadsheetml.sheet.main+xml"/><Override PartName="/xl/worksheets/sheet1.xml" ContentType="application/vnd.openxmlformats-officedocument.spreadsheetml.worksheet+xml"/></Types>"#;
    let top = r#"<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="r1" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/officeDocument" Target="xl/workbook.xml"/></Relationships>"#;
    let book = r#"<?xml version="1.0"?><workbook xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main" xmlns:r="http://schemas.openxmlformats.org/officeDocument/2006/relationships"><sheets><sheet name="orders" sheetId="1" r:id="r1"/></sheets></workbook>"#;
    let rels = r#"<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="r1" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/worksheet" Target="worksheets/sheet1.xml"/></Relationships>"#;
    let sheet = r#"<?xml version="1.0"?><worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><dimension ref="A1:B3"/><sheetData><row r="1"><c r="A1" t="inlineStr"><is><t>order</t></is></c><c r="B1" t="inlineStr"><is><t>amount</t></is></c></row><row r="2"><c r="A2" t="inlineStr"><is><t>o1</t></is></c><c r="B2"><v>3.5</v></c></row><row r="3"><c r="A3" t="str"><v>o2</v></c><c r="B3" t="b"><v>1</v></c></row></sheetData></worksheet>"#;
    let parts = [
        "[Content_Types].xml",
        "_rels/.rels",
        "xl/workbook.xml",
        "xl/_rels/workbook.xml.rels",
        "xl/worksheets/sheet1.xml",
    ];
    let texts = [types, top, book, rels, sheet].map(str::as_bytes);
    Fuzz::new("xlsx", vec![sheet.into()]).run_with(
        build("shop", "tables/further.xlsx"),
        move |chance, seed, words| {
            let changed = chance.below(5);
            let seed = if seed.starts_with(b"PK") { sheet.as_bytes() } else { seed };
            let files: Vec<(&str, Vec<u8>)> = (0..5)
                .map(|part| {
                    let text = if part == 4 { seed } else { texts[part] };
                    let is_changed = part == changed || part == 4;
                    (parts[part], if is_changed { mutated(chance, text, words) } else { text.to_vec() })
                })
                .collect();
            let mut file = zip(&files);
            if chance.below(5) == 0 {
                scattered(chance, &mut file);
            }
            file
        },
    );
}

/// A mask laid over the paper's floor: what describes it, and its image.
#[test]
fn masks() {
    let described = MAP.replace("0.05", "0.5");
    let site = TestSite::example("paper");
    let kinds = [
        "kind = \"keepout\"",
        "kind = \"speed\"\nname = \"slow\"\nbase = 1.5\nmultiplier = -0.01\nunit = \"m/s\"",
    ];
    let of = |kind: &str| format!("\n[[mask]]\nfile = \"mask.yaml\"\n{kind}\n");
    site.write("site.toml", site.read("site.toml") + kinds.map(of).concat().as_str());
    let seeds = [vec![described.clone().into(), pgm()], of_others("data/mir_robot", ".yaml")].concat();
    Fuzz::new("mask", seeds).run(move |text| {
        let is_image = text.starts_with(b"P");
        site.write("mask.yaml", if is_image { described.as_bytes() } else { text });
        site.write("floor.pgm", if is_image { text.to_vec() } else { pgm() });
        KnowledgeBase::open(site.path()).and_then(|knowledge| knowledge.site().measured_world()).is_ok()
    });
}

/// Zone sets, laid over the paper's floor.
#[test]
fn zone_sets() {
    let set = json!({"zoneSet": {"mapId": "m", "zoneSetId": "s", "zones": [
        {"zoneId": "z1", "zoneType": "SPEED_LIMIT", "maximumSpeed": 0.5, "vertices": [{"x": 1, "y": 1}, {"x": 3, "y": 1}, {"x": 3, "y": 3}]},
        {"zoneId": "z2", "zoneType": "PENALTY", "penaltyFactor": 0.3, "vertices": [{"x": 5, "y": 1}, {"x": 7, "y": 1}, {"x": 7, "y": 3}]},
        {"zoneId": "z3", "zoneType": "BLOCKED", "vertices": [{"x": 5, "y": 5}, {"x": 7, "y": 5}, {"x": 7, "y": 6}, {"x": 5, "y": 6}]}]}});
    let site = TestSite::example("paper");
    site.write("site.toml", site.read("site.toml") + "\n[[zone_set]]\nfile = \"zones.json\"\n");
    let seeds = [vec![set.to_string().into()], of_others("data/vda5050/schemas-3", "zoneSet.json")].concat();
    Fuzz::new("zones", seeds).run(move |text| {
        site.write("zones.json", text);
        KnowledgeBase::open(site.path()).and_then(|knowledge| knowledge.site().measured_world()).is_ok()
    });
}

/// What the program does when it is called so.
fn called(arguments: &[&str]) -> bool {
    let ended = cli::run(&Cli::try_parse_from([&["adit"], arguments].concat()).unwrap());
    ended == ExitCode::SUCCESS
}

#[test]
fn files_of_tokens() {
    let token = |name: &str, roles: &str| {
        format!("[[token]]\nname = \"{name}\"\nroles = [{roles}]\nsha256 = \"{}\"\n", "0".repeat(64))
    };
    let seeds =
        [token("shift", "\"read\", \"tune\""), token("a", "\"read\"") + token("b", "\"admin\"").as_str()];
    let site = TestSite::example("paper");
    let path = site.path().to_str().unwrap().to_owned();
    Fuzz::new("tokens", seeds.map(String::into_bytes).into()).run(move |text| {
        site.write("tokens.toml", text);
        called(&["token", &path, "--json", "list"])
    });
}

const FLOOR: &str = "name = \"floor\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\nrooms = \"by-state\"\n";

/// What a body is told: the first line is what it is greeted with.
#[test]
fn orders_to_bodies() {
    let site = TestSite::example("starter").with("site.toml", FLOOR).built();
    let hello = r#"{"type": "hello", "protocol": 1, "shapes": ["STAND", "SQUAT"]}"#;
    let orders = [
        r#"{"type": "sense"}"#,
        r#"{"type": "turn", "by_rad": 1.5}"#,
        r#"{"type": "move", "distance_m": 0.8, "speed_m_s": 0.5}"#,
        r#"{"type": "change", "shape": "SQUAT"}"#,
        r#"{"type": "stop"}"#,
        r#"{"type": "move", "distance_m": 0.8, "speed_m_s": 0.5, "bearing_rad": 0.0}"#,
        r#"{"type": "bye"}"#,
    ];
    let all = [&[hello], &orders[..]].concat().join("\n") + "\n";
    let each = orders.map(|order| format!("{hello}\n{order}\n{}\n", orders[0]));
    let seeds = each.into_iter().chain([all]).map(String::into_bytes).collect();
    Fuzz::new("orders", seeds).run(move |text| {
        let mut body = process::Command::new(adit());
        body.arg("body").arg(site.path()).arg("home");
        let mut body =
            body.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
        // who hangs up early breaks the pipe
        body.stdin.take().unwrap().write_all(text).ok();
        let ended = body.wait_with_output().unwrap();
        assert!(ended.status.code().is_some_and(|code| code != 101), "{}", ended.status);
        ended.status.success() && !utf8(&ended.stdout).contains("refused")
    });
}

/// A body: what it answers to `hello` and to `sense` are lines of a text, what else it answers is good.
fn body_of(text: &Mutex<Vec<u8>>, stream: &TcpStream) {
    let text = text.lock().unwrap().clone();
    let mut lines = text.split_inclusive(|byte| *byte == b'\n');
    for asked in BufReader::new(stream).lines() {
        let Ok(asked) = asked else { return };
        let answer = if asked.contains("\"hello\"") || asked.contains("\"sense\"") {
            lines.next()
        } else if asked.contains("\"bye\"") {
            Some(&b"{\"type\": \"bye\"}\n"[..])
        } else {
            Some(&b"{\"type\": \"accepted\"}\n"[..])
        };
        let mut output = stream;
        let is_said =
            answer.is_some_and(|answer| output.write_all(answer).is_ok() && answer.ends_with(b"\n"));
        if !is_said {
            return;
        }
    }
}

/// What bodies answer, until they have said all.
#[test]
fn answers_of_bodies() {
    let shape = |name: &str, radius: f64| json!({"name": name, "radius_m": radius});
    let shapes = [shape("STAND", 0.2), shape("SIDE-STAND", 0.15), shape("SQUAT", 0.2)];
    let hello = json!({"type": "hello", "protocol": 1, "shapes": shapes, "shape": "STAND", "directions": 8, "range_m": 4.0, "has_skirt": true});
    let place = |along: f64| json!({"x_m": along, "y_m": 0.0, "heading_rad": 0.0});
    let sensed = |step: u32, is_busy: bool| {
        let along = 0.1 * f64::from(step);
        let echo = |beam: u32| {
            json!({"bearing_rad": 0.785 * f64::from(beam), "odometry": place(along),
                   "range_m": if beam.is_multiple_of(3) { json!(0.6 + 0.1 * f64::from(beam)) } else { json!(null) }})
        };
        json!({"type": "sensed", "time_s": f64::from(step), "odometry": place(along), "readings": (0..8).map(echo).collect::<Vec<_>>(),
               "contact": if step == 6 { json!({"bearing_rad": 0.1}) } else { json!(null) }, "is_busy": is_busy, "shape": "STAND"})
    };
    let told = |count: u32| -> Vec<u8> {
        let all = (0..count).map(|step| sensed(step, !step.is_multiple_of(2)).to_string());
        [hello.to_string()].into_iter().chain(all).map(|line| line + "\n").collect::<String>().into()
    };
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = format!("tcp://{}", listener.local_addr().unwrap());
    let script = Arc::new(Mutex::new(Vec::new()));
    let said = Arc::clone(&script);
    std::thread::spawn(move || listener.incoming().flatten().for_each(|stream| body_of(&said, &stream)));
    let used =
        |name: Option<&str>, width: f64| Used { name: name.map(str::to_owned), rim: Rim::of(width, None) };
    let shapes = [used(None, 0.6), used(Some("SIDE-STAND"), 0.35), used(Some("SQUAT"), 0.8)];
    Fuzz::new("answers", vec![told(2), told(4), told(12)]).run(move |text| {
        *script.lock().unwrap() = text.to_vec();
        let mut body = Remote::greet(Link::open(&address, Duration::from_secs(2)), &shapes);
        let commands = [
            Command::Move { distance_m: 0.5, bearing: 0.0, speed_m_s: 0.5 },
            Command::Turn { by: 1.0 },
            Command::Change { to: 2 },
            Command::Stop,
        ];
        for command in commands.into_iter().cycle() {
            if body.sense().is_err() {
                break;
            }
            body.command(command);
        }
        body.silence().is_some_and(|why| why.contains("it ended before it answered `sense`"))
    });
}

#[test]
fn questions_in_sql() {
    let seeds: Vec<Vec<u8>> = [
        "SELECT * FROM action_sequence WHERE start = 'home' AND goal = 'e' ORDER BY step",
        "WITH RECURSIVE c (x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c WHERE x < 9) SELECT x, hex(zeroblob(x)) FROM c",
        "SELECT state, sum(hardness) OVER (PARTITION BY robot ORDER BY hardness ROWS 2 PRECEDING) FROM robots GROUP BY state HAVING count(*) > 0",
        "SELECT json_extract('{\"a\": [1, 2]}', '$.a[1]'), replace('aa', 'a', 'b'), printf('%.3f', 2.5), instr('ab', 'b')",
        "SELECT r.room, d.door FROM rooms r LEFT JOIN doors d ON d.room1 = r.room WHERE r.name LIKE 'a%' OR r.name GLOB '*b' LIMIT 5 OFFSET 1",
        "SELECT value FROM json_each('[1, 2, 3]') UNION SELECT 4 EXCEPT SELECT 2 INTERSECT SELECT 1 ORDER BY 1 COLLATE NOCASE",
        "PRAGMA table_info(rooms); ATTACH 'x' AS y; CREATE TEMP TABLE t AS SELECT 1; DELETE FROM rooms",
        "SELECT group_concat(sql, char(10)) FROM sqlite_schema; VALUES (x'00', NULL, 1e999, -9223372036854775808)",
    ]
    .map(|query| query.as_bytes().to_vec())
    .into();
    let site = TestSite::example("paper").built();
    let store = Store::open_read_only(site.path().join("site.db")).unwrap();
    let before = fs::read(site.path().join("site.db")).unwrap();
    Fuzz::new("sql", seeds).run(move |text| {
        let limits = Limits { deadline: Duration::from_millis(200), rows: 1_000, bytes: 1 << 20 };
        let is_read = store.query(&utf8(text), &limits).is_ok();
        assert_eq!(fs::read(site.path().join("site.db")).unwrap(), before, "a query wrote");
        is_read
    });
}

/// What comes over the network, by all routes: no request is a defect of the service, and it goes on.
#[test]
fn requests() {
    let seeds: Vec<Vec<u8>> = [
        ("POST /api/edits", json!({"edit": {"kind": "set", "table": "robots", "key": "SQUAT", "column": "hardness", "value": 3.0}, "why": "x"}).to_string()),
        ("POST /api/edits", json!({"edit": {"kind": "close", "what": "door 7", "for_seconds": 60, "only": ["robot"]}}).to_string()),
        ("POST /api/edits", json!({"edit": {"kind": "undo", "edit": 1}}).to_string()),
        ("POST /api/facts", json!({"class": "DOORS", "object": "door 7", "property": "hardness", "value": 9, "until": "18:00"}).to_string()),
        ("POST /api/areas", json!({"name": "a", "what": "area", "corners": [[1, 1], [3, 1], [3, 3]], "properties": {"kind": "wet"}}).to_string()),
        ("POST /api/blocked", json!({"x": 3.0, "y": 3.0, "heading": 90, "for_seconds": 10}).to_string()),
        ("POST /api/preview", json!({"edits": [{"kind": "set", "table": "robots", "key": "SQUAT", "column": "hardness", "value": 9}], "start": "f", "goal": "e", "patience_ms": 50}).to_string()),
        ("POST /api/ask", json!({"what": "doors.7.hardness", "answers": [{"what": "doors.7.colour", "value": null}]}).to_string()),
        ("POST /api/traversals", json!({"traversals": [{"state": "SQUAT", "distance": 2.0, "measured": 8.0}], "measure": "seconds"}).to_string()),
        ("POST /api/sql", json!({"query": "SELECT 1", "limit": 5}).to_string()),
        ("PUT /api/queries/q", json!({"query": "SELECT 1"}).to_string()),
        ("GET /api/route?start=f&goal=e&within=0.3&avoid=d&at=18:00", String::new()),
        ("GET /api/why?what=door%207&start=f&goal=e", String::new()),
        ("GET /api/why-not?start=f&goal=e&through=d", String::new()),
        ("GET /api/sql?query=SELECT%201&format=csv", String::new()),
        ("DELETE /api/facts/1?why=x", String::new()),
    ]
    .map(|(asked, body)| format!("{asked} HTTP/1.1\nContent-Type: application/json\n\n{body}").into_bytes())
    .into();
    let site = TestSite::example("paper").built();
    let service = Service::start(&site);
    Fuzz::new("http", seeds).run(move |text| {
        let _ = &site;
        let text = utf8(text);
        let (head, body) = text.split_once("\n\n").unwrap_or((&text, ""));
        let head = head.replace('\n', "\r\n");
        let mut stream = TcpStream::connect(&service.address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(25))).unwrap();
        let asked = format!(
            "{head}\r\nHost: {}\r\nConnection: close\r\nContent-Length: {}\r\n\r\n{body}",
            service.address,
            body.len()
        );
        stream.write_all(asked.as_bytes()).unwrap();
        let mut answer = [0; 12];
        let status = match stream.read_exact(&mut answer) {
            Ok(()) => utf8(&answer[9..]),
            // hung up on, or a stream that is open
            Err(_) => "000".to_owned(),
        };
        assert_ne!(status, "500", "{}", service.log());
        status == "200"
    });
}
