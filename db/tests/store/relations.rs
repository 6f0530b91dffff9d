//! Tables of the domain expert's own.

use adit_db::relation::{Form, UserTable};
use adit_db::{Cell, Error};

use crate::paper;

#[test]
fn the_expert_s_tables_and_views_are_found_and_read() {
    let (_folder, mut store) = paper::site();
    let python = "import sqlite3, sys
c = sqlite3.connect(sys.argv[1])
c.executescript('''CREATE TABLE wet_floors(room TEXT PRIMARY KEY, depth REAL, slippery BOOLEAN);
CREATE VIEW \"deep \"\"floors\" AS SELECT room FROM wet_floors WHERE depth > 0.01''')
c.executemany('INSERT INTO wet_floors VALUES (?,?,?)', [('d', 0.02, True), ('b', None, False)])
c.commit()";
    if !crate::clients::python(python, store.path()) {
        return;
    }
    store
        .snapshot(|tx| {
            let named = |name: &str, form| UserTable { name: name.into(), form };
            assert_eq!(
                tx.user_tables()?,
                [named("deep \"floors", Form::View), named("wet_floors", Form::Table)]
            );
            let wet = tx.read_table("wet_floors")?;
            let column = |at: usize| {
                (wet.columns[at].name.as_str(), wet.columns[at].declared.as_str(), wet.columns[at].key)
            };
            assert_eq!(
                [column(0), column(1), column(2)],
                [("room", "TEXT", 1), ("depth", "REAL", 0), ("slippery", "BOOLEAN", 0)]
            );
            assert_eq!(wet.columns[0].values, ["b", "d"].map(Cell::from));
            assert_eq!(wet.columns[1].values, [Cell::Null, Cell::Real(0.02)]);
            assert_eq!(wet.columns[2].values, [Cell::Integer(0), Cell::Integer(1)]);
            assert_eq!(tx.read_table("deep \"floors")?.columns[0].values, [Cell::from("d")]);
            assert_eq!(tx.read_table("doors")?.columns[0].values.len(), 8);
            let unknown = tx.read_table("x; DROP TABLE doors");
            assert!(matches!(unknown, Err(Error::UnknownTable(_))));
            Ok::<_, Error>(())
        })
        .unwrap();
}
