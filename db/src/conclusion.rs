//! Rules, what they chose, and what they concluded: the tables `rules`, `witnesses`, `derivations` and the view
//! `conclusions`.

use serde::Serialize;
use sqlx::{Row, SqliteConnection};

use crate::bulk::{self, Record, Values};
use crate::cell::Cell;
use crate::dynamic;
use crate::error::Result;
use crate::transaction::Tx;

/// A rule that concluded something.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Rule {
    /// Its number, which derived values name.
    pub rule: i64,
    /// Its name.
    pub name: String,
    /// Which text of the rule it was.
    pub version: String,
    /// The file that it stands in.
    pub file: Option<String>,
    /// The line where it begins, from 1.
    pub line: Option<i64>,
}

/// The facts that a rule chose.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Witness {
    /// Its number, which derived values name.
    pub witness: i64,
    /// The facts, as JSON text.
    pub facts: String,
}

/// A value concluded for a class that has no table of ours.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Derivation {
    /// The class.
    pub class: String,
    /// The object's key.
    pub key: Cell,
    /// The property.
    pub property: String,
    /// Its value.
    pub value: Cell,
    /// The rule's number.
    pub rule: i64,
    /// The witness's number.
    pub witness: Option<i64>,
}

/// A row of the view `conclusions`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Conclusion {
    /// Class and key, like `doors.7`.
    pub object: String,
    /// The property.
    pub property: String,
    /// Its value.
    pub value: Cell,
    /// The rule's name.
    pub rule: Option<String>,
    /// The rule's version.
    pub version: Option<String>,
    /// The facts that the rule chose, as JSON text.
    pub witness: Option<String>,
    /// The rule's file.
    pub file: Option<String>,
    /// The rule's line in it.
    pub line: Option<i64>,
}

impl Record for &Rule {
    const TABLE: &'static str = "rules";
    const COLUMNS: &'static [&'static str] = &["rule", "name", "version", "file", "line"];

    fn bind(&self, values: &mut Values) {
        values.integer(self.rule);
        values.text(&*self.name);
        values.text(&*self.version);
        values.text(self.file.as_deref());
        values.integer(self.line);
    }
}

impl Record for &Witness {
    const TABLE: &'static str = "witnesses";
    const COLUMNS: &'static [&'static str] = &["witness", "facts"];

    fn bind(&self, values: &mut Values) {
        values.integer(self.witness);
        values.text(&*self.facts);
    }
}

impl Record for &Derivation {
    const TABLE: &'static str = "derivations";
    const COLUMNS: &'static [&'static str] = &["class", "key", "property", "value", "rule", "witness"];

    fn bind(&self, values: &mut Values) {
        values.text(&*self.class);
        values.cell(&self.key);
        values.text(&*self.property);
        values.cell(&self.value);
        values.integer(self.rule);
        values.integer(self.witness);
    }
}

/// All rules, by number.
pub async fn rules(connection: &mut SqliteConnection) -> Result<Vec<Rule>> {
    let query = sqlx::query("SELECT rule, name, version, file, line FROM rules ORDER BY rule");
    let mut rules = Vec::new();
    for row in query.fetch_all(connection).await? {
        rules.push(Rule {
            rule: row.try_get(0)?,
            name: row.try_get(1)?,
            version: row.try_get(2)?,
            file: row.try_get(3)?,
            line: row.try_get(4)?,
        });
    }
    Ok(rules)
}

/// All witnesses, by number.
pub async fn witnesses(connection: &mut SqliteConnection) -> Result<Vec<Witness>> {
    let rows = sqlx::query("SELECT witness, facts FROM witnesses ORDER BY witness");
    let read = |row: &sqlx::sqlite::SqliteRow| -> sqlx::Result<Witness> {
        Ok(Witness { witness: row.try_get(0)?, facts: row.try_get(1)? })
    };
    Ok(rows.fetch_all(connection).await?.iter().map(read).collect::<sqlx::Result<_>>()?)
}

/// All values of classes that have no table of ours.
pub async fn derivations(connection: &mut SqliteConnection) -> Result<Vec<Derivation>> {
    let rows = sqlx::query("SELECT class, key, property, value, rule, witness FROM derivations");
    let read = |row: &sqlx::sqlite::SqliteRow| -> Result<Derivation> {
        Ok(Derivation {
            class: row.try_get(0)?,
            key: Cell::of(row, 1)?,
            property: row.try_get(2)?,
            value: Cell::of(row, 3)?,
            rule: row.try_get(4)?,
            witness: row.try_get(5)?,
        })
    };
    rows.fetch_all(connection).await?.iter().map(read).collect()
}

/// Takes some witnesses away, by number, and adds others.
pub async fn change_witnesses(
    connection: &mut SqliteConnection,
    gone: &[i64],
    new: &[Witness],
) -> Result<()> {
    for witness in gone {
        let query = sqlx::query("DELETE FROM witnesses WHERE witness = ?").bind(witness);
        query.execute(&mut *connection).await?;
    }
    bulk::insert(connection, new).await?;
    Ok(())
}

/// Takes some values of classes that have no table of ours away, and adds others. A value that changed is among both.
pub async fn change_derivations(
    connection: &mut SqliteConnection,
    gone: &[&Derivation],
    new: &[&Derivation],
) -> Result<()> {
    for derivation in gone {
        let sql = "DELETE FROM derivations WHERE class = ? AND key = ? AND property = ?".to_owned();
        let key = [Cell::from(&*derivation.class), derivation.key.clone(), Cell::from(&*derivation.property)];
        dynamic::execute(connection, sql, &key).await?;
    }
    bulk::insert(connection, new.iter().copied()).await?;
    Ok(())
}

/// Replaces all rules and witnesses by these.
pub async fn replace_rules(
    connection: &mut SqliteConnection,
    rules: &[Rule],
    witnesses: &[Witness],
) -> Result<()> {
    sqlx::query("DELETE FROM rules").execute(&mut *connection).await?;
    sqlx::query("DELETE FROM witnesses").execute(&mut *connection).await?;
    bulk::insert(connection, rules).await?;
    bulk::insert(connection, witnesses).await?;
    Ok(())
}

/// Replaces all values of classes that have no table of ours by these.
pub async fn replace_derivations(
    connection: &mut SqliteConnection,
    derivations: &[Derivation],
) -> Result<()> {
    sqlx::query("DELETE FROM derivations").execute(&mut *connection).await?;
    bulk::insert(connection, derivations).await?;
    Ok(())
}

/// What was concluded about the object `key` of `class` (a table's name), by property.
pub async fn about(connection: &mut SqliteConnection, class: &str, key: &Cell) -> Result<Vec<Conclusion>> {
    let sql = "SELECT object, property, value, rule, version, witness, file, line FROM conclusions \
               WHERE class = ? AND key = ? ORDER BY property";
    let mut conclusions = Vec::new();
    for row in dynamic::fetch(connection, sql.to_owned(), &[Cell::from(class), key.clone()]).await? {
        conclusions.push(Conclusion {
            object: row.try_get(0)?,
            property: row.try_get(1)?,
            value: Cell::of(&row, 2)?,
            rule: row.try_get(3)?,
            version: row.try_get(4)?,
            witness: row.try_get(5)?,
            file: row.try_get(6)?,
            line: row.try_get(7)?,
        });
    }
    Ok(conclusions)
}

impl Tx<'_> {
    /// All rules, by number.
    pub fn rules(&mut self) -> Result<Vec<Rule>> {
        self.run(rules)
    }

    /// All witnesses, by number.
    pub fn witnesses(&mut self) -> Result<Vec<Witness>> {
        self.run(witnesses)
    }

    /// Takes some witnesses away, by number, and adds others.
    pub fn change_witnesses(&mut self, gone: &[i64], new: &[Witness]) -> Result<()> {
        self.run(async |connection| change_witnesses(connection, gone, new).await)
    }

    /// All values of classes that have no table of ours.
    pub fn derivations(&mut self) -> Result<Vec<Derivation>> {
        self.run(derivations)
    }

    /// Takes some values of classes that have no table of ours away, and adds others. A value that changed is among
    /// both.
    pub fn change_derivations(&mut self, gone: &[&Derivation], new: &[&Derivation]) -> Result<()> {
        self.run(async |connection| change_derivations(connection, gone, new).await)
    }

    /// Replaces all rules and witnesses by these.
    pub fn replace_rules(&mut self, by: &[Rule], witnesses: &[Witness]) -> Result<()> {
        self.run(async |connection| replace_rules(connection, by, witnesses).await)
    }

    /// Replaces all values of classes that have no table of ours by these.
    pub fn replace_derivations(&mut self, by: &[Derivation]) -> Result<()> {
        self.run(async |connection| replace_derivations(connection, by).await)
    }

    /// What was concluded about the object `key` of `class` (a table's name), by property.
    pub fn conclusions(&mut self, class: &str, key: &Cell) -> Result<Vec<Conclusion>> {
        self.run(async |connection| about(connection, class, key).await)
    }
}
