//! A TOML file of rule tests.

use std::collections::BTreeMap;

use toml::de::DeTable;

use super::toml_text::{Entry, Located, Reader, get, in_order};
use crate::diagnostic::{Code, Diagnostic};
use crate::script::source::{MAX_FILE_BYTES, SourceFile};
use crate::value::Value;

#[derive(Clone, Debug)]
pub(super) struct TestFile {
    pub(super) source: SourceFile,
    pub(super) keys: BTreeMap<String, Located<Vec<String>>>,
    pub(super) tests: Vec<Test>,
}

/// A test: facts, what must be concluded from them, and edits.
#[derive(Clone, Debug)]
pub(super) struct Test {
    pub(super) name: Located<String>,
    pub(super) tolerance: f64,
    pub(super) given: Vec<Objects>,
    /// The first edits nothing.
    pub(super) steps: Vec<Step>,
}

#[derive(Clone, Debug)]
pub(super) struct Objects {
    pub(super) class: Located<String>,
    pub(super) objects: Vec<Object>,
}

/// Properties of one object; `None` is unknown.
#[derive(Clone, Debug)]
pub(super) struct Object {
    pub(super) cells: Vec<(Located<String>, Located<Option<Value>>)>,
    pub(super) place: Located<()>,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Step {
    pub(super) tell: Vec<Fact>,
    pub(super) add: Vec<Objects>,
    pub(super) remove: Vec<(Located<String>, Located<String>)>,
    pub(super) expected: Vec<Fact>,
}

#[derive(Clone, Debug)]
pub(super) struct Fact {
    pub(super) class: Located<String>,
    pub(super) key: Located<String>,
    pub(super) property: Located<String>,
    pub(super) value: Located<Option<Value>>,
}

pub(super) fn file(source: &SourceFile) -> Result<TestFile, Vec<Diagnostic>> {
    let refused = |code, span, message| vec![Diagnostic::error(code, &source.place_of(&span), message)];
    if source.text().len() > MAX_FILE_BYTES {
        let message = format!("{} is longer than {MAX_FILE_BYTES} bytes", source.name());
        return Err(refused(Code::TooLarge, 0..0, message));
    }
    let parsed = DeTable::parse(source.text()).map_err(|error| {
        refused(Code::TestSyntax, error.span().unwrap_or(0..0), error.message().replace('\n', ", "))
    })?;
    let mut reader = Reader { source, problems: vec![] };
    let table = parsed.get_ref();
    reader.refuse_others(table, "a file of tests", &["keys", "given", "tolerance", "test"]);
    let tolerance = get(table, "tolerance").map_or(0.0, |entry| reader.tolerance(entry));
    let given = get(table, "given").map_or(vec![], |entry| reader.classes(entry, "`given`"));
    let keys = get(table, "keys").map_or(BTreeMap::new(), |entry| reader.keys(entry));
    let entries = reader.list(get(table, "test"), "`test`");
    let tests = entries.into_iter().filter_map(|entry| reader.test(entry, tolerance, &given)).collect();
    let file = TestFile { source: source.clone(), keys, tests };
    if reader.problems.is_empty() { Ok(file) } else { Err(reader.problems) }
}

impl Reader<'_> {
    fn keys(&mut self, entry: &Entry<'_>) -> BTreeMap<String, Located<Vec<String>>> {
        let mut keys = BTreeMap::new();
        for (class, entry) in self.free_table(entry, "`keys`").map_or(vec![], in_order) {
            let what = format!("the key of {}", class.value);
            let parts = self.list(Some(entry), &what);
            let parts = parts.into_iter().filter_map(|part| self.text(part, &what)).collect();
            keys.insert(class.value, Located { value: parts, span: entry.span() });
        }
        keys
    }

    fn test(&mut self, entry: &Entry<'_>, tolerance: f64, shared: &[Objects]) -> Option<Test> {
        let known = ["name", "given", "conclude", "then", "tolerance"];
        let table = self.table(entry, "a test", &known)?;
        let Some(name) = get(table, "name") else {
            self.refuse(&entry.span(), "a test needs a `name` that says what must hold");
            return None;
        };
        let name = Located { value: self.text(name, "`name`")?, span: name.span() };
        let tolerance = get(table, "tolerance").map_or(tolerance, |entry| self.tolerance(entry));
        let mut given = get(table, "given").map_or(vec![], |entry| self.classes(entry, "`given`"));
        let own: Vec<String> = given.iter().map(|objects| objects.class.value.clone()).collect();
        given.extend(shared.iter().filter(|objects| !own.contains(&objects.class.value)).cloned());
        let mut steps =
            vec![Step { expected: self.facts(get(table, "conclude"), "`conclude`"), ..Step::default() }];
        for entry in self.list(get(table, "then"), "`then`") {
            steps.extend(self.step(entry));
        }
        if steps.iter().all(|step| step.expected.is_empty()) {
            self.refuse(&name.span, "this test expects nothing: say it under [test.conclude]");
        }
        Some(Test { name, tolerance, given, steps })
    }

    fn step(&mut self, entry: &Entry<'_>) -> Option<Step> {
        let table = self.table(entry, "`then`", &["tell", "add", "remove", "conclude"])?;
        let tell = self.facts(get(table, "tell"), "`tell`");
        let add = get(table, "add").map_or(vec![], |entry| self.classes(entry, "`add`"));
        let mut remove = vec![];
        if let Some(gone) = get(table, "remove").and_then(|entry| self.free_table(entry, "`remove`")) {
            for (class, entry) in in_order(gone) {
                for key in self.list(Some(entry), "a class under `remove`") {
                    if let Some(text) = self.text(key, "the key of an object") {
                        remove.push((class.clone(), Located { value: text, span: key.span() }));
                    }
                }
            }
        }
        let expected = self.facts(get(table, "conclude"), "`conclude`");
        Some(Step { tell, add, remove, expected })
    }

    fn classes(&mut self, entry: &Entry<'_>, what: &str) -> Vec<Objects> {
        let mut classes = vec![];
        for (class, entry) in self.free_table(entry, what).map_or(vec![], in_order) {
            let entries = self.list(Some(entry), &format!("class {}", class.value));
            let objects = entries.into_iter().filter_map(|entry| self.object(entry)).collect();
            classes.push(Objects { class, objects });
        }
        classes
    }

    fn object(&mut self, entry: &Entry<'_>) -> Option<Object> {
        let table = self.free_table(entry, "an object")?;
        let cells =
            in_order(table).into_iter().map(|(property, entry)| (property, self.value(entry))).collect();
        Some(Object { cells, place: Located { value: (), span: entry.span() } })
    }

    /// Class, key, property and value, in the order of the text.
    fn facts(&mut self, entry: Option<&Entry<'_>>, what: &str) -> Vec<Fact> {
        let mut facts = vec![];
        let Some(classes) = entry.and_then(|entry| self.free_table(entry, what)) else { return facts };
        for (class, entry) in in_order(classes) {
            let objects = self.free_table(entry, &format!("class {}", class.value));
            for (key, entry) in objects.map_or(vec![], in_order) {
                let properties = self.free_table(entry, &format!("{} {}", class.value, key.value));
                for (property, entry) in properties.map_or(vec![], in_order) {
                    let (class, key) = (class.clone(), key.clone());
                    facts.push(Fact { class, key, property, value: self.value(entry) });
                }
            }
        }
        facts.sort_by_key(|fact| fact.value.span.start);
        facts
    }
}
