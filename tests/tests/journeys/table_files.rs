//! Tables go out to a spreadsheet and come back as one edit.
#![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

use std::process::Command;

use adit_tests::{Ran, TestSite};

/// Runs a few lines of Python, with openpyxl, in the site's folder.
fn python(site: &TestSite, script: &str) -> Ran {
    let ran = Command::new("/usr/bin/python3").current_dir(site.path()).args(["-c", script]).output();
    Ran::new(&ran.expect("python3 runs (tests/run installs it with openpyxl)")).expecting(0)
}

fn at(site: &TestSite, file: &str) -> String {
    site.path().join(file).display().to_string()
}

#[test]
fn a_table_goes_to_a_spreadsheet_and_comes_back_as_one_edit() {
    let site = TestSite::example("clinic").built();
    let (before, file) = (site.sqlite3("SELECT * FROM robots"), at(&site, "robots.xlsx"));
    let written = site.adit("table", &["robots", "--to", &file]).expecting(0).stdout;
    assert!(written.contains("rows of robots"), "{written}");
    site.adit("table", &["robots", "--from", &file]).expecting(2).complains(&["holds what", "says already"]);
    let script = "
import openpyxl
book = openpyxl.load_workbook('robots.xlsx')
sheet = book.active
heads = [cell.value for cell in sheet[1]]
hardness = heads.index('hardness') + 1
assert 'state*' in heads, heads
for row in (2, 3):
    sheet.cell(row, hardness).value = sheet.cell(row, hardness).value * 2
book.save('robots.xlsx')
print(sheet.max_row - 1, sheet.freeze_panes)
";
    let read = python(&site, script).stdout;
    assert_eq!(read.trim(), format!("{} A2", before.len()));
    let preview = site.adit("table", &["robots", "--from", &file, "--dry-run"]).expecting(0).stdout;
    assert!(preview.contains("robots is as") && preview.contains("2 cells set\n  "), "{preview}");
    assert!(preview.contains(".hardness: "), "{preview}");
    assert_eq!(site.sqlite3("SELECT * FROM robots"), before, "a preview changes nothing");
    let edited = site.adit("table", &["robots", "--from", &file, "--why", "measured"]).expecting(0).stdout;
    assert!(edited.contains("2 cells set") && edited.contains("dock to"), "{edited}");
    assert_eq!(site.sqlite3("SELECT count(DISTINCT change_set), count(*) FROM history"), ["1|2"]);
    assert_ne!(site.sqlite3("SELECT * FROM robots"), before);
    // one undo takes back all of it, and one more brings all of it back
    let undone = site.adit("undo", &[]).expecting(0).stdout;
    assert!(undone.contains("and one more that was made with it"), "{undone}");
    assert_eq!(site.sqlite3("SELECT * FROM robots"), before);
    let last = site.sqlite3("SELECT max(id) FROM history");
    site.adit("undo", &[&last[0]]).expect_status(0);
    assert_ne!(site.sqlite3("SELECT * FROM robots"), before);
}

#[test]
fn rows_come_and_go_and_what_is_wrong_names_the_row() {
    let site = TestSite::example("shop").built();
    let table = site.adit("table", &["orders"]).expecting(0).stdout;
    let rows: Vec<&str> = table.lines().collect();
    let orders = site.sqlite3("SELECT count(*) FROM orders");
    // the last row goes, another one comes
    let last = rows[rows.len() - 1].split_once(',').unwrap().1;
    let mut fewer = rows[..rows.len() - 1].to_vec();
    let new = format!("9,{last}");
    fewer.push(&new);
    site.write("orders.csv", fewer.join("\n"));
    let file = at(&site, "orders.csv");
    let edited = site.adit("table", &["orders", "--from", &file]).expecting(0).stdout;
    assert!(edited.contains("1 row new, 1 row gone"), "{edited}");
    assert_eq!(site.sqlite3("SELECT count(*) FROM orders"), orders);
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(site.adit("table", &["orders"]).expecting(0).stdout, table, "as it was, to the letter");

    let before = site.sqlite3("SELECT * FROM history");
    for (text, said) in [
        (table.replacen(rows[0], &format!("{},colour", rows[0]), 1), vec!["orders.csv:2", "cells, expected"]),
        (
            table.replacen(rows[0].split(',').nth(1).unwrap(), "colour", 1),
            vec!["orders.csv:1", "no column `colour`"],
        ),
        (format!("{table}\n{}", rows[1]), vec!["two rows are called"]),
        (String::new(), vec!["it is empty"]),
    ] {
        site.write("orders.csv", text);
        site.adit("table", &["orders", "--from", &file]).expecting(2).complains(&said);
    }
    site.write("orders.xlsx", "no workbook");
    site.adit("table", &["orders", "--from", &at(&site, "orders.xlsx")])
        .expecting(2)
        .complains(&["is no workbook"]);
    // small ones for which more memory would be asked than there may be
    let bombs = "import openpyxl, zipfile
book = openpyxl.Workbook()
book.active.append(['order*', 'pieces'])
book.save('many.xlsx')
with zipfile.ZipFile('many.xlsx', 'a') as to:
    to.writestr('xl/sharedStrings.xml', '<sst uniqueCount=\"1000000000000\"></sst>')
book.active['XFD1'] = 'far'
book.save('wide.xlsx')";
    python(&site, bombs);
    for (file, said) in
        [("wide.xlsx", "column C has no name"), ("many.xlsx", "many.xlsx unpacks to more than")]
    {
        site.adit("table", &["orders", "--from", &at(&site, file)]).expecting(2).complains(&[said]);
    }
    site.adit("table", &["orders", "--to", &at(&site, "orders.ods")])
        .expecting(2)
        .complains(&["neither .csv nor .xlsx"]);
    // of the site's own files it goes into that of the table alone
    let of_another = at(&site, "tables/products.csv");
    let products = std::fs::read(&of_another).unwrap();
    site.adit("table", &["orders", "--to", &of_another])
        .expecting(2)
        .complains(&["file/own", "products.csv"]);
    assert_eq!(std::fs::read(&of_another).unwrap(), products);
    site.adit("table", &["orders", "--to", &at(&site, "tables/orders.csv")]).expect_status(0);
    site.adit("table", &["ordres"]).expecting(2).complains(&["ordres"]);
    site.adit("table", &["conclusions", "--from", &at(&site, "orders.csv")])
        .expecting(2)
        .complains(&["empty"]);
    assert_eq!(site.sqlite3("SELECT * FROM history"), before, "nothing of it was kept");
}

#[test]
fn a_workbook_seeds_a_table_as_csv_does() {
    let (site, other) = (TestSite::example("shop"), TestSite::example("shop"));
    let name = std::fs::read_dir(site.path().join("tables")).unwrap().flatten().next().unwrap().file_name();
    let name = name.to_string_lossy().into_owned();
    let stem = name.strip_suffix(".csv").unwrap();
    let script = format!(
        "
import csv, openpyxl
book = openpyxl.Workbook()
def value(text):
    if text in ('true', 'false'): return text == 'true'
    try: return float(text)
    except ValueError: return text or None
for number, row in enumerate(csv.reader(open('tables/{stem}.csv'))):
    book.active.append([value(cell) if number else cell for cell in row])
book.save('tables/{stem}.xlsx')
"
    );
    python(&site, &script);
    std::fs::remove_file(site.path().join("tables").join(&name)).unwrap();
    site.adit("build", &[]).expect_status(0);
    other.adit("build", &[]).expect_status(0);
    let rows = format!("SELECT * FROM {stem}");
    assert_eq!(site.sqlite3(&rows), other.sqlite3(&rows));
}

#[test]
fn cells_of_a_workbook_that_are_none_are_named() {
    let site = TestSite::example("shop").built();
    let table = site.adit("table", &["orders", "--to", &at(&site, "orders.xlsx")]).expecting(0);
    assert!(table.stdout.contains("rows of orders"));
    for (edit, said) in [
        ("sheet['B3'] = datetime.date(2026, 1, 2)", "cell B3 is a date"),
        ("sheet.cell(2, 30).value = 5", "in a column without a name"),
        ("sheet['A2'] = None", "orders.xlsx, row 2: this row has no"),
    ] {
        let script = format!(
            "
import datetime, openpyxl
book = openpyxl.load_workbook('orders.xlsx')
sheet = book.active
{edit}
book.save('wrong.xlsx')
"
        );
        python(&site, &script);
        let said = said.replace("orders.xlsx", "wrong.xlsx");
        site.adit("table", &["orders", "--from", &at(&site, "wrong.xlsx")]).expecting(2).complains(&[&said]);
    }
}

#[test]
fn what_went_out_comes_back_to_the_letter() {
    let site = TestSite::example("shop");
    site.write("tables/odd.csv", "k,v,n\n007,010,1\n+1,\" lead\",2\n1e5,trail ,3\n-0,\"a\"\"b, c\",4\n");
    let site = site.built();
    let before = site.sqlite3("SELECT k, v, n, typeof(n) FROM odd");
    assert!(before.iter().any(|row| row.starts_with("007|010|1|")), "{before:?}");
    for file in ["odd.csv", "odd.xlsx"].map(|file| at(&site, file)) {
        site.adit("table", &["odd", "--to", &file]).expect_status(0);
        site.adit("table", &["odd", "--from", &file]).expecting(2).complains(&["says already"]);
    }
    assert_eq!(site.sqlite3("SELECT k, v, n, typeof(n) FROM odd"), before);
    let flat = site.path().join("flat");
    let map = adit_tests::repository().join("kb/worlds/flat.toml");
    let adit = |args: &[&str]| Ran::new(&Command::new(adit_tests::adit()).args(args).output().unwrap());
    let (flat, map) = (flat.display().to_string(), map.display().to_string());
    adit(&["new", &flat, "--map", &map]).expect_status(0);
    adit(&["build", &flat]).expect_status(0);
    for table in ["navigation", "walls", "solids", "vehicles", "marks", "places"] {
        for file in ["t.csv", "t.xlsx"].map(|file| at(&site, file)) {
            adit(&["table", &flat, table, "--to", &file]).expect_status(0);
            adit(&["table", &flat, table, "--from", &file]).expecting(2).complains(&["says already"]);
        }
    }
    // a map alone is not poured over the tables of a site
    let other = adit_tests::repository().join("kb/worlds/corridor-S.toml").display().to_string();
    let database = format!("{flat}/site.db");
    adit(&["route", &other, "start", "goal", "--db", &database])
        .expecting(2)
        .complains(&["is the database of flat"]);
    adit(&["build", &map, "--db", &database]).expecting(2).complains(&["is the database of flat"]);
}

#[test]
fn a_database_of_another_site_is_not_taken_over() {
    let (clinic, shop) = (TestSite::example("clinic").built(), TestSite::example("shop").built());
    clinic.adit("tune", &["robots", "STAND", "hardness", "3"]).expect_status(0);
    let history = "SELECT * FROM history";
    let (db, before) = (at(&clinic, "site.db"), clinic.sqlite3(history));
    let refused = &["is the database of", "name a file of its own"];
    for (verb, status) in [("build", 2), ("check", 1)] {
        shop.adit(verb, &["--db", &db]).expecting(status).complains(refused);
    }
    shop.adit("tune", &["products", "cup", "price", "7", "--db", &db]).expecting(2).complains(refused);
    assert_eq!(clinic.sqlite3(history), before);
    // a site that is moved keeps its database, whatever its folder is called
    let moved = clinic.path().join("moved");
    let copied = Command::new("cp").arg("-r").args([shop.path(), &moved]).status().unwrap();
    assert!(copied.success());
    let built = Command::new(adit_tests::adit()).arg("build").arg(&moved).output().unwrap();
    Ran::new(&built).expect_status(0);
}

#[test]
fn quotes_that_are_not_closed_formulas_without_values_and_cells_far_off_are_refused() {
    let site = TestSite::example("shop").built();
    let orders = site.sqlite3("SELECT * FROM orders");
    site.write("orders.csv", "order,customer,product,pieces\n1,\"Ada,kettle,1\n2,Bruno,tea,12\n");
    let from = |file: &str| site.adit("table", &["orders", "--from", &at(&site, file)]);
    from("orders.csv").expecting(2).complains(&["line 2: a quote is not closed"]);
    site.adit("table", &["orders", "--to", &at(&site, "orders.xlsx")]).expect_status(0);
    for (edit, said) in [
        ("sheet['D2'] = '=1+1'", "cell D2 is a formula without a value"),
        ("sheet['XFD1048576'] = 'z'", "cell XFD1048576 stands in a column without a name"),
    ] {
        let script = format!(
            "
import openpyxl
book = openpyxl.load_workbook('orders.xlsx')
sheet = book.active
{edit}
book.save('wrong.xlsx')
"
        );
        python(&site, &script);
        from("wrong.xlsx").expecting(2).complains(&[said]);
    }
    assert_eq!(site.sqlite3("SELECT * FROM orders"), orders);
}

#[test]
fn a_state_whose_name_is_misspelt_in_a_file_is_said_to_take_its_changes_with_it() {
    let site = TestSite::example("starter")
        .with("site.toml", "map = \"map.toml\"\nrobots = \"robots.toml\"\n")
        .built();
    let file = at(&site, "robots.csv");
    site.adit("table", &["robots", "--to", &file]).expect_status(0);
    site.edit("robots.csv", "SQUAT", "SQAT");
    let said = site.adit("table", &["robots", "--from", &file]).expecting(0);
    assert!(said.stdout.contains("robot/SQUAT is gone, with 4 rows of changes"), "{}", said.stdout);
    assert!(said.stderr.contains("what it costs robot to change into SQAT and out of it"), "{}", said.stderr);
    let gone = site.adit("tune", &["robots", "--remove", "SQAT"]).expecting(0).stdout;
    assert!(gone.contains("robots.robot/SQAT is gone\n"), "{gone}");
}

#[test]
fn a_word_among_numbers_is_named_with_its_line_where_rules_want_numbers() {
    let products =
        std::fs::read_to_string(TestSite::example("shop").path().join("tables/products.csv")).unwrap();
    let soft = products.replacen("39.90", "39,90 EUR", 1).replacen("39,90 EUR", "\"39,90 EUR\"", 1);
    assert_ne!(soft, products);
    let site = TestSite::example("shop").with("tables/products.csv", &soft);
    let said = site.adit("build", &[]).expecting(2);
    said.complains(&[
        "numbers are wanted here",
        "`39,90 EUR` is no number",
        "products.csv:2",
        "of `price` are",
    ]);
}

#[test]
fn a_table_is_read_as_spreadsheet_programs_of_many_countries_write_it() {
    let with_semicolons =
        "floor*;hard;smooth;name\r\ngravel;1,5;TRUE;a, b\r\ntiles;-2,25;FALSE;7,5 m\r\n;;;\r\n";
    let site = TestSite::example("shop").with("tables/floors.csv", with_semicolons);
    // a workbook that is open leaves a file beside it that is none
    let site = site.with("tables/~$floors.xlsx", "lock").built();
    let rows = site.sqlite3("SELECT floor, hard, smooth, name, typeof(hard) FROM floors");
    assert_eq!(rows, ["gravel|1.5|1|a, b|real", "tiles|-2.25|0|7,5 m|real"]);
    // among cells that are parted by commas they would be texts
    let site = site.with("tables/sizes.csv", "floor,size\ntiles,\"1,5\"\ngravel,2\n");
    let said = ["sizes.csv, row 2: `1,5` is written with a comma, so all of `size` counts as texts"];
    site.adit("build", &[]).expecting(0).complains(&said);
    // nobody knows what a point means among commas
    for (cell, file) in [("1.200", "floor;a;b\ntiles;1,5;1.200\n"), ("1.234,5", "floor;a\ntiles;1.234,5\n")] {
        site.write("floors.csv", file);
        let said = [format!("`{cell}` has a point between its thousands")];
        site.adit("table", &["floors", "--from", &at(&site, "floors.csv")])
            .expecting(2)
            .complains(&[said[0].as_str()]);
    }
    // a blank behind a name makes no other object of it
    let table = site.adit("table", &["floors"]).expecting(0).stdout;
    site.write("floors.csv", table.replace("gravel,", "gravel ,"));
    site.adit("table", &["floors", "--from", &at(&site, "floors.csv")])
        .expecting(2)
        .complains(&["says already"]);
    // a line that ends with two signs is shown whole
    site.write("floors.csv", "floor,hard\r\ngravel,1\r\ngravel,2\r\n");
    let said = ["floors.csv:3:1", "mark them: floor*, hard*"];
    site.adit("table", &["floors", "--from", &at(&site, "floors.csv")]).expecting(2).complains(&said);
}

#[test]
fn one_table_is_taken_from_its_file_again_and_what_the_others_hold_stays() {
    let site = TestSite::example("shop").built();
    site.adit("tune", &["products", "cup", "price", "7"]).expect_status(0);
    site.adit("tune", &["zones", "UK/1", "fee", "70"]).expect_status(0);
    let cells = || {
        site.sqlite3("SELECT price FROM products WHERE product = 'cup' UNION ALL SELECT max(fee) FROM zones")
    };
    assert_eq!(cells(), ["7.0", "70"]);
    site.adit("build", &["--reseed=zone"])
        .expecting(2)
        .complains(&["fills a table `zone`", "did you mean `zones`?"]);
    site.adit("build", &["--reseed=zones"]).expecting(0).complains(&["(--reseed=products takes the file)"]);
    assert_eq!(cells()[0], "7.0");
    assert_ne!(cells()[1], "70");
    site.adit("undo", &[]).expect_status(0);
    assert_eq!(cells(), ["7.0", "70"]);
}
