//! What the journeys share: the built program, sites in a temporary folder, and the clients that users have.

pub mod browser;
pub mod cluster;
pub mod database;
pub mod floor;
pub mod fuzz;
pub mod lock;
pub mod oracle;
pub mod service;
pub mod slanted;

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use std::time::{Duration, Instant, UNIX_EPOCH};

use serde_json::Value;
use tempfile::TempDir;

use database::Elsewhere;

/// The program `adit` of this build; built first where it is missing or old.
pub fn adit() -> &'static Path {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    PROGRAM.get_or_init(|| {
        let exe = std::env::current_exe().expect("a test knows its own path");
        let profile = exe.ancestors().nth(2).expect("tests run in target/PROFILE/deps").to_path_buf();
        let mut build = cargo();
        build.args(["build", "--quiet", "--locked", "--package", "adit"]);
        if profile.ends_with("release") {
            build.arg("--release");
        }
        assert!(build.status().expect("cargo runs").success());
        profile.join("adit")
    })
}

/// Cargo, in the repository, as whoever runs the tests calls it.
pub fn cargo() -> Command {
    let mut cargo = untold(Command::new(env!("CARGO")));
    cargo.current_dir(repository());
    cargo
}

/// A program that may call cargo, without what cargo tells a test of the test's package: build scripts of others (ring's) would look
/// at it, and all that stands on them would be built anew.
pub fn untold(mut program: Command) -> Command {
    let of_package = |name: &OsString| {
        let name = name.to_string_lossy();
        name.starts_with("CARGO_PKG_") || name.starts_with("CARGO_MANIFEST_")
    };
    for name in std::env::vars_os().map(|(name, _)| name).filter(of_package) {
        program.env_remove(name);
    }
    program
}

/// The top folder of the repository.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("tests/ lies in the repository").to_path_buf()
}

/// Other people's maps, beside the repository; says loudly when they are missing.
pub fn shared(path: &str) -> Option<PathBuf> {
    let found = std::env::var_os("ADIT_SHARED").map_or_else(|| repository().join("../shared"), PathBuf::from);
    let found = found.join(path);
    if found.exists() {
        return Some(found);
    }
    eprintln!("\n!!! SKIPPED: ../shared/{path} is missing, so this test has tested nothing !!!\n");
    None
}

/// A site in a folder of its own that goes away with it.
pub struct TestSite {
    folder: TempDir,
    pub(crate) elsewhere: Elsewhere,
    /// The example that it is a copy of.
    example: Option<String>,
}

impl TestSite {
    /// An empty folder.
    pub fn empty() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        Self { folder, elsewhere: Elsewhere::default(), example: None }
    }

    /// A copy of one of the example sites in `kb/sites`.
    pub fn example(name: &str) -> Self {
        let copy = Self::copy_of(&repository().join("kb/sites").join(name));
        Self { example: Some(name.to_owned()), ..copy }
    }

    /// The clinic with a robot that is longer than wide, and so all the time.
    pub fn barrow() -> Self {
        let of = "robot = \"barrow\"\n";
        let sizes = "height = 0.7\nwidth = 0.4\nlength = 0.9\nhardness = 1.0\nspeed = 0.8\n";
        let turn = "from_state = \"GO\"\nto_state = \"GO\"\nhardness = 0.2\n";
        let robots =
            format!("[[robots]]\n{of}state = \"GO\"\naction = \"GO\"\n{sizes}[[changes]]\n{of}{turn}");
        Self::example("clinic").with("robots.toml", &robots).built()
    }

    /// A copy of one of the sites in `tests/tests/hostile/sites`.
    pub fn hostile(name: &str) -> Self {
        Self::copy_of(&repository().join("tests/tests/hostile/sites").join(name))
    }

    /// A copy of the site as it is now, database and all.
    #[must_use]
    pub fn copied(&self) -> Self {
        Self::copy_of(self.path())
    }

    fn copy_of(folder: &Path) -> Self {
        let site = Self::empty();
        copy(folder, site.path());
        site
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Writes a file of the site.
    #[must_use]
    pub fn with(self, name: &str, text: &str) -> Self {
        self.write(name, text);
        self
    }

    /// Writes a file of the site, with its folders.
    pub fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        let file = self.path().join(name);
        fs::create_dir_all(file.parent().expect("a folder")).expect("folder made");
        fs::write(file, text).expect("written");
    }

    /// Reads a file of the site.
    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path().join(name)).expect("readable")
    }

    /// Replaces text in a file of the site; the text must be there.
    pub fn edit(&self, name: &str, from: &str, to: &str) {
        let text = self.read(name);
        assert!(text.contains(from), "{name} has no `{from}`");
        self.write(name, text.replacen(from, to, 1));
    }

    /// The site with the shipped rules for rooms by state, but for ways that keep no farther off walls than they must.
    #[must_use]
    pub fn without_berth(self) -> Self {
        self.copy_rules("by-state");
        self.edit("rules/states.rhai", "state.berth      = 0.05;", "state.berth      = 0.0;");
        self
    }

    /// Copies a shipped rule base into the site's folder `rules`.
    pub fn copy_rules(&self, base: &str) {
        for entry in fs::read_dir(repository().join("rules/rooms").join(base)).expect("a rule base") {
            let file = entry.expect("a file").path();
            if file.extension().is_some_and(|e| e == "rhai") {
                let name = file.file_name().expect("a name").to_string_lossy().into_owned();
                self.write(&format!("rules/{name}"), fs::read(&file).expect("readable"));
            }
        }
        let site = self.read("site.toml");
        self.write("site.toml", format!("rules = \"rules\"\n{site}"));
    }

    /// Copies a shipped rule base with its tests into the site's folder `rules`.
    pub fn copy_rules_and_tests(&self, base: &str) {
        self.copy_rules(base);
        let tests = repository().join("rules/rooms").join(base).join("tests");
        for entry in fs::read_dir(tests).expect("tests of a rule base") {
            let file = entry.expect("a file").path();
            let name = file.file_name().expect("a name").to_string_lossy().into_owned();
            self.write(&format!("rules/tests/{name}"), fs::read(&file).expect("readable"));
        }
    }

    /// Runs `adit VERB SITE ARGS…`.
    pub fn adit(&self, verb: &str, args: &[&str]) -> Ran {
        let elsewhere = self.elsewhere.for_command(verb);
        let mut command = Command::new(adit());
        command.arg(verb).arg(elsewhere.as_ref().map_or(self.path(), TempDir::path)).args(args);
        Ran::new(&command.output().expect("adit runs"))
    }

    /// Builds the site and expects that to work. An example that nobody changed is built once for all tests and copied.
    #[must_use]
    pub fn built(self) -> Self {
        let is_as_shipped =
            |name: &&String| files(self.path()) == files(&repository().join("kb/sites").join(name));
        if let Some(name) = self.example.as_ref().filter(is_as_shipped) {
            copy(&built_example(name), self.path());
        } else {
            self.adit("build", &[]).expect_status(0);
        }
        self
    }

    /// The rows that the plain `sqlite3` shell prints, read-only, columns joined by `|`.
    pub fn sqlite3(&self, query: &str) -> Vec<String> {
        let elsewhere = self.elsewhere.brought_back();
        let folder = elsewhere.as_ref().map_or(self.path(), TempDir::path);
        let ran = Command::new("sqlite3").arg("-readonly").arg(folder.join("site.db")).arg(query).output();
        Ran::new(&ran.expect("the sqlite3 shell is installed (tests/run installs it)"))
            .expect_status(0)
            .stdout
            .lines()
            .map(str::to_owned)
            .collect()
    }

    /// Edits the database with the plain `sqlite3` shell, as any program may.
    pub fn outside_edit(&self, statement: &str) {
        let ran = Command::new("sqlite3").arg(self.path().join("site.db")).arg(statement).output();
        Ran::new(&ran.expect("the sqlite3 shell is installed")).expect_status(0);
    }
}

/// A folder with an example as this program builds it: whichever test is first builds it, and no other program takes it.
fn built_example(name: &str) -> PathBuf {
    let program = fs::metadata(adit()).and_then(|program| program.modified()).expect("the program is there");
    let stamp = program.duration_since(UNIX_EPOCH).expect("programs are made after 1970").as_nanos();
    let all = adit().with_file_name("built-examples");
    let built = all.join(format!("{name}-{stamp}"));
    if !built.exists() {
        fs::create_dir_all(&all).expect("folder made");
        let building = tempfile::tempdir_in(&all).expect("a temporary folder");
        copy(&repository().join("kb/sites").join(name), building.path());
        let ran = Command::new(adit()).arg("build").arg(building.path()).output().expect("adit runs");
        Ran::new(&ran).expect_status(0);
        let is_older = |path: &PathBuf| {
            let stem = path.file_name().and_then(|file| file.to_str()).and_then(|file| file.rsplit_once('-'));
            stem.is_some_and(|(of, at)| of == name && at != stamp.to_string())
        };
        let others = fs::read_dir(&all).expect("a folder").filter_map(Result::ok).map(|entry| entry.path());
        for old in others.filter(is_older) {
            fs::remove_dir_all(old).ok();
        }
        // where another test was first, its site is there, and this one goes
        fs::rename(building.path(), &built).ok();
    }
    built
}

/// The files of a folder with what is in them.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let of = path.strip_prefix(folder).expect("within the folder").to_path_buf();
                found.insert(of, fs::read(&path).expect("readable"));
            }
        }
    }
    found
}

/// Waits until there is something.
///
/// # Panics
/// Where there is nothing in 40 s.
#[track_caller]
pub fn within<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let began = Instant::now();
    while began.elapsed() < Duration::from_secs(40) {
        if let Some(found) = look() {
            return found;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    panic!("{what}: not in time");
}

/// What a program printed.
pub struct Ran {
    /// Exit status.
    pub status: i32,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
}

impl Ran {
    /// What a finished process left.
    pub fn new(output: &Output) -> Self {
        Self {
            status: output.status.code().unwrap_or(-1),
            stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }

    /// Fails the test, showing all that was printed, unless the status is this.
    #[must_use]
    #[track_caller]
    pub fn expecting(self, status: i32) -> Self {
        assert_eq!(self.status, status, "stdout:\n{}\nstderr:\n{}", self.stdout, self.stderr);
        self
    }

    /// [`Ran::expecting`], where the rest is looked at or not.
    #[track_caller]
    #[allow(clippy::must_use_candidate, clippy::return_self_not_must_use)] // a check by itself is a use
    pub fn expect_status(self, status: i32) -> Self {
        self.expecting(status)
    }

    /// Standard output as JSON.
    #[track_caller]
    pub fn json(&self) -> Value {
        serde_json::from_str(&self.stdout)
            .unwrap_or_else(|error| panic!("no JSON ({error}):\n{}\n{}", self.stdout, self.stderr))
    }

    /// Fails the test unless standard error has every one of these texts, line breaks of the printer aside.
    #[track_caller]
    pub fn complains(&self, texts: &[&str]) {
        let said: String = self
            .stderr
            .split(|c: char| c.is_whitespace() || c == '│')
            .filter(|w| !w.is_empty())
            .fold(String::new(), |mut all, word| {
                all.push_str(word);
                all.push(' ');
                all
            });
        for text in texts {
            assert!(said.contains(text), "`{text}` is not in:\n{}", self.stderr);
        }
    }
}

/// Copies what is in a folder into another one that is there.
fn copy(from: &Path, into: &Path) {
    for entry in fs::read_dir(from).expect("a site") {
        let entry = entry.expect("a file");
        let there = into.join(entry.file_name());
        if entry.path().is_dir() {
            fs::create_dir_all(&there).expect("folder made");
            copy(&entry.path(), &there);
        } else {
            fs::copy(entry.path(), there).expect("copied");
        }
    }
}
