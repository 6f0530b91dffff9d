//! Rule tests: what must be concluded from which facts, written as data beside the rules.

mod outcome;
mod read;
mod run;
mod toml_text;
mod vocabulary;

use crate::diagnostic::Diagnostics;
use crate::rule_base::RuleBase;
use crate::schema::Schema;
use crate::script::limits::Limits;
use crate::script::source::SourceFile;

pub use outcome::{TestFailure, TestOutcome};

/// The tests of a rule base, read from TOML files.
///
/// ```toml
/// tolerance = 0.0                       # how far a number may be off; 0 if not said
/// [keys]                                # the properties that tell objects apart, where the host does not say;
/// PLANTS = ["pot"]                      # objects of a class without a key are numbered from 1
///
/// [given]                               # facts of every test of this file, class by class
/// PEOPLE = [{ name = "Ann", can_carry = 0.2 }, { name = "Bob", can_carry = 5.0 }]
///
/// [[test]]
/// name = "who can carry it waters it"
/// [test.given]                          # replaces the class of that name above; what is left out is unknown
/// PLANTS = [{ pot = "fern", litres = 0.5 }]
/// [test.conclude]                       # class, key, property
/// PLANTS.fern = { waterer = "Bob", thirsty = { unknown = true } }
///
/// [[test.then]]                         # edits, and what must be concluded after them
/// tell.PLANTS.fern.litres = 0.1         # { unknown = true } takes a value back
/// add.PEOPLE = [{ name = "Cid", can_carry = 9.0 }]
/// remove.PEOPLE = ["Bob"]
/// conclude.PLANTS.fern.waterer = "Ann"
/// ```
///
/// Classes and properties that the host's [`Schema`] or another test knows are there in every test, empty or unknown; for
/// others a rule waits, as it does in life.
#[derive(Clone, Debug, Default)]
pub struct RuleTests {
    files: Vec<read::TestFile>,
}

impl RuleTests {
    /// Reads files of tests. All that is wrong in all of them is reported.
    pub fn read(files: &[SourceFile]) -> Result<Self, Diagnostics> {
        let (mut read, mut problems) = (vec![], vec![]);
        for file in files {
            match read::file(file) {
                Ok(file) => read.push(file),
                Err(wrong) => problems.extend(wrong),
            }
        }
        if problems.is_empty() { Ok(Self { files: read }) } else { Err(Diagnostics(problems)) }
    }

    pub fn len(&self) -> usize {
        self.files.iter().map(|file| file.tests.len()).sum()
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Runs every test on a knowledge base of its own. Names and types that cannot be right are an error.
    pub fn run(&self, rules: &RuleBase, schema: &Schema) -> Result<Vec<TestOutcome>, Diagnostics> {
        self.run_within(rules, schema, Limits::default())
    }

    /// As [`run`](Self::run), with limits: all tests together may take what one inference may.
    pub fn run_within(
        &self,
        rules: &RuleBase,
        schema: &Schema,
        limits: Limits,
    ) -> Result<Vec<TestOutcome>, Diagnostics> {
        let vocabulary = vocabulary::Vocabulary::new(&self.files, rules, schema).map_err(Diagnostics)?;
        let tests = self.files.iter().flat_map(|file| file.tests.iter().map(move |test| (file, test)));
        let limits = Limits { until: Some(limits.end(limits.inference)), ..limits };
        Ok(tests.map(|(file, test)| run::run(file, test, rules, (&vocabulary, limits))).collect())
    }
}
