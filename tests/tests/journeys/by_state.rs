//! Rooms by state: a route that a person believes, on a floor of thin walls.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use adit_tests::TestSite;
use adit_tests::service::Service;

/// Where on the way from the dock to ward 6 the robot does this: the least and the most x and y.
fn extent(site: &TestSite, action: &str) -> Option<Vec<f64>> {
    // a room's row says where the way in it ends; it began where the row before ended
    let rows = site.sqlite3(&format!(
        "WITH way AS (SELECT kind, action, lag(x) OVER (ORDER BY step) AS x0, x AS x1,
                             lag(y) OVER (ORDER BY step) AS y0, y AS y1
                      FROM action_sequence WHERE start = 'dock' AND goal = 'ward 6')
         SELECT min(x0), max(x1), min(y0), max(y1) FROM way
         WHERE kind = 'room' AND action = '{action}' AND (x1 <> x0 OR y1 <> y0) HAVING count(*) > 0"
    ));
    rows.first().map(|row| row.split('|').map(|v| v.parse().unwrap()).collect())
}

#[test]
fn from_the_dock_to_ward_6_the_robot_goes_sideways_through_the_narrow_door_unless_that_is_harder_than_the_pipe()
 {
    let site = TestSite::example("hospital").built();
    // the doorway of half a metre is at 27.2 m; the way around by it is 4.5 m longer and still the easier one
    let sideways = extent(&site, "SIDE-WALK").unwrap();
    assert!(sideways[0] > 26.9 && sideways[1] < 27.5, "{sideways:?}");
    assert_eq!(extent(&site, "WALK-ON-KNEE"), None);
    site.adit("tune", &["robots", "SIDE-STAND", "hardness", "8"]).expect_status(0);
    // the pipe hangs across the corridor at 18.5 to 20.5 m
    let knees = extent(&site, "WALK-ON-KNEE").unwrap();
    assert!(knees[0] < 18.5 && knees[1] > 20.5 && knees[2] > 11.15 && knees[3] < 14.85, "{knees:?}");
}

/// The way about the end of a wall: what it costs, and how near its waypoints say that it comes to walls between its ends.
fn about_the_wall(site: &TestSite) -> (f64, f64) {
    let route = site.adit("route", &["west", "east", "--json"]).expecting(0).json();
    let legs = route["waypoints"].as_array().unwrap().iter().skip(1);
    let clearances = legs.map(|waypoint| waypoint["clearance"].as_f64().unwrap());
    (route["cost"].as_f64().unwrap(), clearances.fold(f64::INFINITY, f64::min))
}

/// A hall with a wall half across it, and one robot 0.6 m wide.
fn half_a_wall() -> TestSite {
    let map = "width = 12.0\ndepth = 8.0\n[[obstacle]]\nrect = [5.9, 0.0, 6.1, 4.0]\n\
               [[place]]\nname = \"west\"\nat = [1.0, 2.0]\n[[place]]\nname = \"east\"\nat = [11.0, 2.0]\n";
    let robots =
        "[[robots]]\nstate = \"DRIVE\"\naction = \"DRIVE\"\nheight = 1.0\nwidth = 0.6\nhardness = 1.0\n";
    TestSite::empty()
        .with("map.toml", map)
        .with("robots.toml", robots)
        .with("site.toml", "name = \"half a wall\"\nmap = \"map.toml\"\nrobots = \"robots.toml\"\n")
}

#[test]
fn a_way_keeps_off_walls_where_that_costs_little_as_a_rule_says_and_whoever_tells_otherwise() {
    let site = half_a_wall().built();
    let (cost, clear) = about_the_wall(&site);
    assert!(clear > 0.0499, "5 cm by the shipped rule, not {clear}");
    let kept: f64 =
        site.sqlite3("SELECT cost FROM route WHERE start = 'west' AND goal = 'east'")[0].parse().unwrap();
    assert!((kept - cost).abs() < 1e-9 * cost, "the kept route costs {kept}");
    site.adit("tell", &["ROBOTS", "robot/DRIVE", "berth", "0"]).expect_status(0);
    let (tight, touches) = about_the_wall(&site);
    assert!(touches < 1e-5 && tight < cost && cost <= 1.01 * tight, "{tight}, then {cost}");
    site.adit("tell", &["ROBOTS", "robot/DRIVE", "berth", "0.3"]).expect_status(0);
    let (most, _) = about_the_wall(&site);
    assert!(most > cost && most <= 1.01 * tight, "as far as one in a hundred allows: {most} for {tight}");
    site.adit("tell", &["ROBOTS", "robot/DRIVE", "berth_cost", "0.2"]).expect_status(0);
    assert!(about_the_wall(&site).1 > 0.299, "{}", about_the_wall(&site).1);
    site.adit("tell", &["ROBOTS", "robot/DRIVE", "berth_cost", "-1"])
        .expecting(2)
        .complains(&["the berth_cost of `DRIVE` is -1", "it is finite and not negative"]);
}

#[test]
fn a_rule_without_a_berth_gives_the_shortest_way() {
    let (tight, touches) = about_the_wall(&half_a_wall().without_berth().built());
    let (cost, _) = about_the_wall(&half_a_wall().built());
    assert!(touches < 1e-5 && tight < cost, "{tight} and {cost}");
}

/// Where the ground is cut into rooms beside a wall, a way that keeps off it runs along the line between two of them.
#[test]
fn a_robot_passes_no_door_to_and_fro() {
    let site = TestSite::example("hospital").built();
    for hardness in ["2", "8", "20"] {
        site.adit("tune", &["robots", "SIDE-STAND", "hardness", hardness]).expect_status(0);
        let again = site.sqlite3(
            "SELECT start, goal, place, count(*) FROM action_sequence
             WHERE kind = 'door' AND start IN ('dock', 'ward 6')
             GROUP BY robot, start, goal, place HAVING count(*) > 1",
        );
        assert!(again.is_empty(), "SIDE-STAND {hardness}: {again:?}");
    }
}

#[test]
fn the_costs_of_the_steps_add_up() {
    let site = TestSite::example("hospital").built();
    let sums = site.sqlite3(
        "SELECT round(sum(hardness), 6) = round(max(cost), 6),
                (SELECT round(r.cost, 6) FROM route r WHERE r.start = 'dock' AND r.goal = 'ward 6') = round(max(cost), 6)
         FROM action_sequence WHERE start = 'dock' AND goal = 'ward 6'",
    );
    assert_eq!(sums, ["1|1"]);
}

#[test]
fn what_a_change_of_shape_costs_is_in_the_table_of_changes() {
    let site = TestSite::example("hospital").built();
    let cost = |site: &TestSite| -> f64 {
        site.sqlite3("SELECT cost FROM route WHERE start = 'dock' AND goal = 'ward 6'")[0].parse().unwrap()
    };
    let before = cost(&site);
    site.adit("tune", &["changes", "STAND/SIDE-STAND", "--add", "hardness=0.1"]).expect_status(0);
    assert!((cost(&site) - before - 0.1).abs() < 1e-6, "{} after {before}", cost(&site));
}

#[test]
fn any_two_points_are_answered_though_no_start_is_kept_there() {
    let site = TestSite::example("hospital").built();
    let kept = site.adit("route", &["dock", "ward 6", "--json"]).expecting(0).json();
    let points = site.adit("route", &["1.2,1.2", "42,24", "--json"]).expecting(0).json();
    let cost = |answer: &serde_json::Value| answer["cost"].as_f64().unwrap();
    // where shapes are changed is slid to the best place, from where either search left it
    assert!((cost(&points) - cost(&kept)).abs() < 1e-7 * cost(&kept));
    let states = |answer: &serde_json::Value| -> Vec<String> {
        let waypoints = answer["waypoints"].as_array().unwrap().iter();
        waypoints.map(|waypoint| waypoint["state"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(states(&points), states(&kept));
}

#[test]
fn sql_knows_a_way_to_every_room_to_which_the_service_finds_one() {
    let site = TestSite::example("clinic").built();
    let service = Service::start(&site);
    // rooms that are entered only by squatting down or by turning aside at the end of the way, too
    let kept = site.sqlite3("SELECT goal, status, coalesce(cost, 0.0) FROM route WHERE start = 'dock'");
    assert!(kept.len() > 1000, "{}", kept.len());
    for row in kept.iter().step_by(8) {
        let [goal, status, cost] = row.split('|').collect::<Vec<_>>().try_into().unwrap();
        let path = format!("/api/route?start=dock&goal={}", goal.replace(' ', "%20"));
        let (_, answer) = service.ask("GET", &path, None);
        assert_eq!(answer["status"], status, "{goal}: {answer}");
        let (kept, now): (f64, f64) = (cost.parse().unwrap(), answer["cost"].as_f64().unwrap_or(0.0));
        assert!((kept - now).abs() <= 0.01 * now, "to {goal}: {kept} by SQL, {now} by the service");
    }
    let open = kept.iter().filter(|row| row.contains("|ok|")).count();
    assert!(open > 1050, "{open}");
    let steps = "SELECT count(*) FROM route r WHERE start = 'dock' AND status = 'ok' AND length(goal) = 2 AND goal GLOB '[a-d]*' AND round(cost, 6) <>
                 (SELECT round(max(cost), 6) FROM action_sequence WHERE start = 'dock' AND goal = r.goal)";
    assert_eq!(site.sqlite3(steps), ["0"], "the last step of each sequence costs what its route does");
}

/// Centimetres for metres, most likely: routes go on in other states, and nobody would wonder.
#[test]
fn a_state_that_fits_nowhere_is_named() {
    let site =
        TestSite::example("starter").with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n");
    let site = site.built();
    let tuned = site.adit("tune", &["robots", "STAND", "width", "60"]).expecting(0);
    tuned.complains(&["state `STAND` fits nowhere on this map: it is 60 m wide"]);
    let undone = site.adit("undo", &[]).expecting(0);
    assert!(!undone.stderr.contains("fits nowhere"), "{}", undone.stderr);
    site.adit("tune", &["robots", "STAND", "height", "0"])
        .expecting(2)
        .complains(&["state `STAND` moves and is 0 m high"]);
}
