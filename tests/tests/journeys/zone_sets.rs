//! Zone sets of VDA 5050 3.0 that other programs drew are areas of a site, and are told to vehicles as they were read.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_tests::TestSite;
use serde_json::{Value, json};

fn zone(id: &str, kind: &str, [x0, y0, x1, y1]: [f64; 4], said: &Value) -> Value {
    let vertices = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|[x, y]| json!({"x": x, "y": y}));
    let mut zone = json!({"zoneId": id, "zoneType": kind, "vertices": vertices});
    zone.as_object_mut().unwrap().extend(said.as_object().unwrap().clone());
    zone
}

fn set(map: &str, zones: &[Value]) -> Value {
    json!({"mapId": map, "zoneSetId": "1", "zones": zones})
}

/// Two ways round a wall from `here` to `there`, 2 m wide each, and a zone set.
fn site(zones: &Value) -> TestSite {
    let map = "width = 12.0\ndepth = 6.0\n[[obstacle]]\nrect = [2.0, 2.0, 10.0, 4.0]\n\
               [[place]]\nname = \"here\"\nat = [1.0, 2.5]\n[[place]]\nname = \"there\"\nat = [11.0, 2.5]\n";
    let robots = "[[robots]]\nstate = \"DRIVE\"\naction = \"DRIVE\"\nheight = 1.2\nwidth = 0.4\nhardness = 1.0\nspeed = 1.0\n";
    let text = "map = \"map.toml\"\nrobots = \"robots.toml\"\nstarts = [\"here\"]\n[[zone_set]]\nfile = \"zones.json\"\n";
    TestSite::empty()
        .with("map.toml", map)
        .with("robots.toml", robots)
        .with("site.toml", text)
        .with("zones.json", &serde_json::to_string_pretty(zones).unwrap())
}

/// What the kept route costs and takes, and whether it leads below the wall.
fn route(site: &TestSite) -> (f64, f64, bool) {
    let row = site.sqlite3(
        "SELECT round(cost, 2), round(seconds, 2), \
         (SELECT min(y) < 2 FROM waypoints WHERE start = 'here' AND goal = 'there') \
         FROM route WHERE start = 'here' AND goal = 'there'",
    );
    let cells: Vec<&str> = row[0].split('|').collect();
    (cells[0].parse().unwrap(), cells[1].parse().unwrap(), cells[2] == "1")
}

const BELOW: [f64; 4] = [4.0, 0.0, 8.0, 2.0];

#[test]
fn each_type_of_zone_is_an_area_that_says_what_the_zone_said() {
    let zones = json!({"headerId": 1, "zoneSet": set("m", &[
        zone("a", "BLOCKED", [0.0, 0.0, 0.5, 0.5], &json!({"zoneDescriptor": "stairs"})),
        zone("b", "SPEED_LIMIT", [0.5, 0.0, 1.0, 0.5], &json!({"maximumSpeed": 0.3})),
        zone("c", "PENALTY", [1.0, 0.0, 1.5, 0.5], &json!({"penaltyFactor": 0.75, "zoneDescriptor": "wet"})),
        zone("d", "PRIORITY", [1.5, 0.0, 2.0, 0.5], &json!({"priorityFactor": 1, "zoneDescriptor": "wet"})),
        zone("e", "DIRECTED", [2.0, 0.0, 2.5, 0.5], &json!({"direction": 0.0, "directedLimitation": "STRICT"})),
        zone("f", "ACTION", [3.0, 0.0, 3.5, 0.5], &json!({"entryActions": [{"actionType": "beep", "blockingType": "NONE"}],
            "duringActions": [], "exitActions": []})),
        zone("g", "LINE_GUIDED", [4.0, 0.0, 4.5, 0.5], &json!({})),
        zone("h", "RELEASE", [5.0, 0.0, 5.5, 0.5], &json!({"releaseLossBehavior": "STOP", "zoneDescriptor": "g"})),
    ])});
    let site = site(&zones);
    let built = site.adit("build", &[]).expecting(0);
    built.complains(&["the zone `h` is of type RELEASE", "Adit grants nothing"]);
    let areas = site.sqlite3(
        "SELECT area, kind, zone, zone_factor, speed_limit, zone_direction, zone_limitation, zone_action, zone_blocking \
         FROM areas ORDER BY zone_id",
    );
    assert_eq!(
        areas,
        [
            "stairs|keep-out|||||||",
            "b|speed-limit|||0.3||||",
            "c|penalty|PENALTY|0.75|||||",
            "d|priority|PRIORITY|1.0|||||",
            "e|directed|DIRECTED|||0.0|STRICT||",
            "f|action|ACTION|||||beep|NONE",
            "g|line-guided|LINE_GUIDED||||||",
            "h|release|RELEASE||||||",
        ],
        "called by its words where no other zone has the same"
    );
}

#[test]
fn zones_lead_routes_round_and_make_them_slower_as_the_shipped_rules_say() {
    let way = |zones: &[Value]| route(&site(&set("m", zones)).built());
    let (cost, seconds, below) = way(&[]);
    assert!(below, "the shorter way");
    assert!((cost - seconds).abs() < 0.05, "at 1 m/s: {cost}, {seconds}");
    let blocked = way(&[zone("a", "BLOCKED", BELOW, &json!({}))]);
    assert!(!blocked.2 && blocked.0 > cost, "{blocked:?}");
    let shunned = way(&[zone("a", "PENALTY", BELOW, &json!({"penaltyFactor": 0.9}))]);
    assert_eq!(shunned, blocked);
    let bearable = way(&[zone("a", "PENALTY", BELOW, &json!({"penaltyFactor": 0.1}))]);
    assert!(bearable.2 && bearable.0 > cost, "{bearable:?}");
    let above = [4.0, 4.0, 8.0, 6.0];
    let liked = way(&[zone("a", "PRIORITY", above, &json!({"priorityFactor": 1.0}))]);
    assert!(!liked.2, "{liked:?}");
    let slow = way(&[zone("a", "SPEED_LIMIT", BELOW, &json!({"maximumSpeed": 0.5}))]);
    assert_eq!((slow.0, slow.2), (cost, true), "a limit makes a way longer, not harder");
    assert!((slow.1 - seconds - 4.0).abs() < 0.1, "4 m at half the speed: {slow:?}");
}

#[test]
fn a_file_may_hold_the_zones_of_several_maps() {
    let zone = |id| zone(id, "BLOCKED", [4.0, 0.0, 8.0, 1.0], &json!({}));
    let site = site(&json!([set("m", &[zone("a")]), {"zoneSet": set("other", &[zone("b")])}]));
    site.adit("build", &[])
        .expecting(2)
        .complains(&["has zones of several maps: m, other", "say `map = \"m\"`"]);
    let names = |map: &str| {
        site.edit(
            "site.toml",
            "file = \"zones.json\"\n",
            &format!("file = \"zones.json\"\nmap = \"{map}\"\n"),
        );
        let ran = site.adit("build", &[]);
        site.edit("site.toml", &format!("map = \"{map}\"\n"), "");
        ran
    };
    names("other").expect_status(0);
    assert_eq!(site.sqlite3("SELECT area FROM areas"), ["b"]);
    names("none").expecting(2).complains(&["has no zones of the map `none`, but of m, other"]);
}

#[test]
fn ids_of_several_sets_may_be_the_same_and_zones_off_the_map_are_told() {
    let here = |id, x: f64| zone(id, "BLOCKED", [x, 0.0, x + 0.5, 0.5], &json!({}));
    let other = json!({"mapId": "m", "zoneSetId": "night", "zones": [here("a", 3.0), here("here", 5.0)]});
    let site = site(&json!([set("m", &[here("a", 1.0), here("far", 40.0)]), other]));
    site.write("more.json", set("m", &[here("a", 7.0)]).to_string());
    site.edit("site.toml", "[[zone_set]]\n", "[[zone_set]]\nfile = \"more.json\"\n[[zone_set]]\n");
    let built = site.adit("build", &[]).expecting(0);
    built.complains(&["the zone `far` lies off the map, and is left out"]);
    assert_eq!(
        site.sqlite3("SELECT area, zone_id, x FROM areas ORDER BY x"),
        ["a (1)|a|1.25", "a (night)|a|3.25", "here (night)|here|5.25", "a|a|7.25"],
        "by their sets where something is called so already"
    );
}

#[test]
fn a_zone_set_that_is_wrong_is_refused_at_its_line() {
    let refused = |zones: &Value, said: &[&str]| site(zones).adit("build", &[]).expecting(2).complains(said);
    let one = |zone| set("m", &[zone]);
    let square = [1.0, 0.0, 2.0, 1.0];
    refused(
        &one(zone("a", "PENALTY", square, &json!({"penaltyFactor": 1.5}))),
        &[
            "zones[0].penaltyFactor is 1.5, expected a number from 0 to 1",
            "zones.json:",
            "\"penaltyFactor\": 1.5",
        ],
    );
    refused(&one(zone("a", "PENALTY", square, &json!({}))), &["zones[0] has no `penaltyFactor`"]);
    refused(
        &one(zone("a", "PENALTI", square, &json!({}))),
        &["zones[0].zoneType is the text \"PENALTI\"", "did you mean \"PENALTY\"?"],
    );
    let mut crossed = zone("a", "BLOCKED", square, &json!({}));
    crossed["vertices"] = json!([{"x": 1, "y": 0}, {"x": 2, "y": 1}, {"x": 2, "y": 0}, {"x": 1, "y": 1}]);
    refused(&one(crossed), &["the zone `a`: this polygon crosses itself", "zones.json:"]);
    refused(
        &one(zone("a", "BLOCKED", [40.0, 0.0, 41.0, 1.0], &json!({}))),
        &["outside of the environment", "\"zoneId\": \"a\""],
    );
    refused(&json!({"zoneSet": {}}), &["zoneSet has no `mapId`"]);
    let across =
        zone("a", "BIDIRECTED", square, &json!({"direction": 0.0, "bidirectedLimitation": "STRICT"}));
    refused(&one(across), &["bidirectedLimitation is the text \"STRICT\", expected one of SOFT, RESTRICTED"]);
    let site = site(&json!({}));
    site.write("zones.yaml", "mapId: m\nzoneSetId: s: t\n");
    site.edit("site.toml", "zones.json", "zones.yaml");
    site.adit("build", &[]).expecting(2).complains(&["not YAML", "zones.yaml:2:"]);
    site.edit("site.toml", "zones.yaml", "zones.json");
    site.write("zones.json", "{\n  \"mapId\": \"m\",\n  \"zones\": [}\n");
    site.adit("build", &[]).expecting(2).complains(&["not JSON: expected value", "zones.json:3:13"]);
    site.write("zones.json", "{\n  \"mapId\": \"m\",\n  \"zones\": [],\n  \"mapId\": \"n\"\n}\n");
    site.adit("build", &[]).expecting(2).complains(&["the key `mapId` stands twice", "zones.json:4:"]);
    site.edit("site.toml", "zones.json", "none.json");
    site.adit("build", &[]).expecting(2).complains(&["none.json` cannot be read"]);
}
