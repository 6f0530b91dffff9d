//! Questions in SQL: everything may be read, nothing else be done.

use adit_tests::TestSite;
use adit_tests::service::Service;
use serde_json::{Value, json};

use super::served;

fn ask(service: &Service, query: &str) -> (u16, Value) {
    service.ask("POST", "/api/sql", Some(&json!({"query": query})))
}

#[test]
fn the_best_sequence_of_actions_is_one_query_away() {
    let (_site, service) = served("paper");
    let query = "SELECT place, action FROM action_sequence WHERE start = 'f' AND goal = 'e' ORDER BY step";
    let (status, answer) = ask(&service, query);
    assert_eq!((status, &answer["columns"]), (200, &json!(["place", "action"])));
    assert_eq!(answer["rows"][3], json!(["3", "WALK-ON-KNEE"]));
    let link = "/api/sql?query=SELECT%20room,%20name%20FROM%20rooms%20LIMIT%202&format=";
    let (_, csv) = service.ask("GET", &format!("{link}csv"), None);
    assert_eq!(csv, json!("room,name\n1,a\n2,b\n"));
    let (_, rows) = service.ask("GET", &format!("{link}json"), None);
    assert_eq!(rows, json!([{"room": 1, "name": "a"}, {"room": 2, "name": "b"}]));
    let wide = ask(&service, "SELECT * FROM conclusions, rooms, doors").1;
    assert_eq!((wide["rows"].as_array().unwrap().len(), &wide["truncated"]), (1_000, &json!(true)));
}

#[test]
fn every_table_and_view_can_be_read() {
    let (_site, service) = served("clinic");
    let (_, schema) = service.ask("GET", "/api/schema", None);
    let tables = schema["tables"].as_array().unwrap();
    assert!(tables.len() > 20);
    for table in tables {
        let name = table["name"].as_str().unwrap();
        let (status, answer) = ask(&service, &format!("SELECT * FROM \"{name}\" LIMIT 3"));
        assert_eq!(status, 200, "{name}: {answer}");
        assert_eq!(answer["columns"], table["columns"], "{name}");
    }
}

#[test]
fn nothing_but_reading_is_done() {
    let site = TestSite::example("paper").built();
    let other = TestSite::example("paper").built();
    let service = Service::start(&site);
    let file = other.path().join("site.db").display().to_string();
    let forbidden = [
        format!("ATTACH '{file}' AS other"),
        "PRAGMA journal_mode = DELETE".to_owned(),
        "SELECT * FROM pragma_database_list".to_owned(),
        "CREATE TEMP TABLE t (x)".to_owned(),
        "DELETE FROM robots".to_owned(),
        "WITH r AS (SELECT 1) DELETE FROM robots".to_owned(),
        "INSERT INTO robots SELECT * FROM robots".to_owned(),
        "SELECT load_extension('x')".to_owned(),
        "SELECT LOAD_extension('x')".to_owned(),
        "VACUUM INTO '/tmp/never'".to_owned(),
        "BEGIN IMMEDIATE".to_owned(),
        "EXPLAIN SELECT 1; DELETE FROM robots".to_owned(),
        "SELECT 1; SELECT 2".to_owned(),
        "SELECT 1; DELETE FROM robots; SELECT 2".to_owned(),
        "REINDEX".to_owned(),
        String::new(),
        "SELECT 1\0; DELETE FROM robots".to_owned(),
    ];
    let before = site.sqlite3("SELECT * FROM robots");
    for query in forbidden {
        let (status, answer) = ask(&service, &query);
        assert_eq!((status, &answer["error"]["code"]), (400, &json!("sql/refused")), "{query}: {answer}");
    }
    assert_eq!(site.sqlite3("SELECT * FROM robots"), before);
    assert_eq!(ask(&service, "SELECT count(*) FROM robots").0, 200, "and it goes on answering");
}

#[test]
fn what_takes_too_much_is_stopped() {
    let (_site, service) = served("paper");
    let hungry = [
        "WITH RECURSIVE c (x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) SELECT count(*) FROM c".to_owned(),
        "SELECT count(*) FROM conclusions a, conclusions b, conclusions c, conclusions d, conclusions e, conclusions f"
            .to_owned(),
        "SELECT zeroblob(1000000000)".to_owned(),
        "SELECT group_concat(hex(randomblob(100000)), '') FROM conclusions a, conclusions b, conclusions c".to_owned(),
        format!("SELECT {}", "(".repeat(5_000)),
format!("SELECT {}1", "1+".repeat(60_000)),
        format!("SELECT {}", vec!["1"; 3_000].join(",")),
    ];
    for query in hungry {
        let began = std::time::Instant::now();
        let (status, answer) = ask(&service, &query);
        let query: String = query.chars().take(60).collect();
        assert_eq!((status, &answer["error"]["code"]), (400, &json!("sql/refused")), "{query}: {answer}");
        assert!(began.elapsed().as_secs_f64() < 5.0, "{query}");
    }
}

#[test]
fn queries_are_kept_by_name() {
    let (_site, service) = served("paper");
    let save = |name: &str, query: &str| {
        service.ask("PUT", &format!("/api/queries/{name}"), Some(&json!({"query": query})))
    };
    assert_eq!(save("doors", "SELECT * FROM doors").0, 200);
    let (_, kept) = save("doors", "SELECT door FROM doors");
    assert_eq!(kept["queries"][0]["query"], "SELECT door FROM doors");
    assert_eq!(kept["queries"].as_array().unwrap().len(), 1);
    assert_eq!(save("%20", "SELECT 1").0, 400);
    assert_eq!(service.ask("DELETE", "/api/queries/doors", None).1["queries"], json!([]));
    assert_eq!(service.ask("DELETE", "/api/queries/doors", None).0, 404);
}
