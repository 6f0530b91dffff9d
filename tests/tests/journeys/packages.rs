//! The packages that `dist/` makes are installed by those who install such, and what they hold runs. Here they carry the
//! program of this build, which is not static; `dist/binary` itself refuses one that is not.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use adit_tests::{Ran, adit, cargo, repository};
use serde_json::Value;
use tempfile::TempDir;

/// A folder in which a maker of packages leaves what it makes.
struct Made(TempDir);

impl Made {
    fn new() -> Self {
        let made = Self(tempfile::tempdir().expect("a temporary folder"));
        // what debuggers need would be packed for minutes
        done(Command::new("strip").arg("-o").arg(made.program()).arg(adit()).output());
        made
    }

    fn program(&self) -> PathBuf {
        self.0.path().join("adit")
    }

    fn folder(&self) -> PathBuf {
        self.0.path().join("dist")
    }

    /// Runs a maker on the program of this build.
    fn run(&self, maker: &str, arguments: &[&str]) -> Ran {
        let mut command = Command::new(repository().join("dist").join(maker));
        command.args(arguments).env("ADIT_PROGRAM", self.program()).env("CARGO_TARGET_DIR", self.0.path());
        Ran::new(&command.output().expect("the maker runs"))
    }

    /// The one package with this ending.
    fn package(&self, ending: &str) -> PathBuf {
        let entries = fs::read_dir(self.folder()).expect("a folder").flatten().map(|entry| entry.path());
        let found: Vec<PathBuf> =
            entries.filter(|path| path.extension().is_some_and(|e| e == ending)).collect();
        let [package] = &found[..] else { panic!("one package .{ending} is made: {found:?}") };
        package.clone()
    }
}

fn done(output: std::io::Result<Output>) -> String {
    Ran::new(&output.expect("the program is installed (tests/run installs it)")).expecting(0).stdout
}

/// Begins a site, builds it and asks for a route, by the program that was installed.
fn expect_works(program: &Path) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run =
        |arguments: &[&str]| done(Command::new(program).args(arguments).current_dir(folder.path()).output());
    run(&["new", "my-site"]);
    run(&["build", "my-site"]);
    assert!(
        run(&["route", "my-site", "home", "window"]).contains("WALK-ON-KNEE"),
        "the starter's route squats"
    );
}

#[test]
fn debian_unpacks_the_package_and_man_bash_and_the_program_work() {
    let made = Made::new();
    made.run("deb", &[]).expect_status(0);
    let package = made.package("deb");
    let field = |name: &str| done(Command::new("dpkg-deb").arg("--field").arg(&package).arg(name).output());
    assert_eq!(field("Package").trim(), "adit");
    assert_eq!(field("Version").trim(), env!("CARGO_PKG_VERSION"));
    assert!(field("Depends").contains("libc6"), "a program that is not static needs the C library");
    let root = tempfile::tempdir().expect("a temporary folder");
    done(Command::new("dpkg-deb").arg("--extract").arg(&package).arg(root.path()).output());
    let usr = root.path().join("usr");
    expect_works(&usr.join("bin/adit"));

    let page = usr.join("share/man/man1/adit-why-not.1.gz");
    let page = done(Command::new("gzip").arg("-dc").arg(page).output());
    assert!(page.contains(".TH") && page.contains("through"), "{page}");

    let ask =
        "source \"$1\"; COMP_WORDS=(adit rou); COMP_CWORD=1; _adit adit rou adit; echo \"${COMPREPLY[*]}\"";
    let words = usr.join("share/bash-completion/completions/adit");
    let completed = done(Command::new("bash").args(["-c", ask, "bash"]).arg(words).output());
    assert_eq!(completed.trim(), "route");

    let notices = usr.join("share/doc/adit/THIRD-PARTY.txt.gz");
    let notices = done(Command::new("gzip").arg("-dc").arg(notices).output());
    for said in ["rhai ", "SQLite", "SIL OPEN FONT LICENSE", "UBUNTU FONT LICENCE"] {
        assert!(notices.to_uppercase().contains(&said.to_uppercase()), "the notices name {said}");
    }
}

#[test]
fn pip_installs_the_wheel_into_a_fresh_environment_and_adit_is_on_its_path() {
    let made = Made::new();
    made.run("wheel", &[]).expect_status(0);
    let wheel = made.package("whl");
    let environment = made.folder().join("venv");
    done(Command::new("/usr/bin/python3").args(["-m", "venv"]).arg(&environment).output());
    let pip = environment.join("bin/pip");
    done(Command::new(pip).args(["install", "--quiet", "--no-index"]).arg(&wheel).output());
    expect_works(&environment.join("bin/adit"));
    assert!(environment.join("share/man/man1/adit.1.gz").is_file(), "its pages come along");

    let first = fs::read(&wheel).expect("readable");
    made.run("wheel", &[]).expect_status(0);
    assert!(fs::read(&wheel).expect("readable") == first, "made again, it is the same bytes");
}

#[test]
fn an_image_is_not_made_of_a_program_that_needs_libraries() {
    let made = Made::new();
    let refused = made.run("container", &[]).expecting(2);
    assert!(
        refused.stderr.contains("the program needs libraries, and the image has none"),
        "{}",
        refused.stderr
    );
    made.run("container", &["--context"]).expect_status(0);
    let context = made.folder().join("container");
    let file = fs::read_to_string(context.join("Containerfile")).expect("readable");
    assert!(file.contains("FROM scratch") && file.contains("COPY root/ /"), "{file}");
    assert!(context.join("root/usr/bin/adit").is_file());
    assert!(context.join("root/usr/share/doc/adit/THIRD-PARTY.txt").is_file());
}

#[test]
fn the_bill_of_materials_has_all_that_is_linked_with_checksums_and_names_nothing_else() {
    let bill: Value =
        serde_json::from_str(&done(Command::new(repository().join("dist/sbom")).output())).expect("JSON");
    assert_eq!((&bill["bomFormat"], &bill["specVersion"]), (&"CycloneDX".into(), &"1.5".into()));
    let components = bill["components"].as_array().expect("components");
    let named = |name: &str| components.iter().find(|component| component["name"] == name);
    for carried in ["rhai", "libsqlite3-sys", "epaint_default_fonts"] {
        let component = named(carried).unwrap_or_else(|| panic!("{carried} is carried"));
        assert_eq!(component["hashes"][0]["content"].as_str().expect("a checksum").len(), 64);
    }
    assert!(named("proptest").is_none(), "what only tests need is not carried");
    let references: BTreeSet<&str> = components
        .iter()
        .chain([&bill["metadata"]["component"]])
        .map(|component| component["bom-ref"].as_str().expect("a reference"))
        .collect();
    for dependency in bill["dependencies"].as_array().expect("dependencies") {
        for needed in dependency["dependsOn"].as_array().expect("a list") {
            assert!(references.contains(needed.as_str().expect("a reference")), "{needed} is no component");
        }
    }
}

#[test]
fn crates_are_packed_with_rules_page_licences_and_a_readme() {
    let made = Made::new();
    let crates = ["adit-engine", "adit-planners", "adit-db", "adit", "adit-site", "adit-fleet", "adit-ros"];
    let mut cargo = cargo();
    cargo.args(["package", "--locked", "--allow-dirty", "--no-verify", "--quiet"]);
    cargo.args(crates.iter().flat_map(|name| ["--package", name]));
    done(cargo.env("CARGO_TARGET_DIR", made.0.path()).output());
    for name in crates {
        let packed =
            made.0.path().join("package").join(format!("{name}-{}.crate", env!("CARGO_PKG_VERSION")));
        let listed = done(Command::new("tar").arg("--list").arg("--file").arg(&packed).output());
        let has = |file: &str| {
            listed.lines().any(|line| line.split_once('/').is_some_and(|(_, below)| below == file))
        };
        for file in ["README.md", "LICENSE-MIT", "LICENSE-APACHE", "Cargo.toml"] {
            assert!(has(file), "{name} has {file}: {listed}");
        }
        if name == "adit" {
            for file in [
                "rules/rooms/paper/rooms.rhai",
                "page/index.html",
                "sites/clinic/map.toml",
                "manual/what-rules-see.md",
                "build.rs",
            ] {
                assert!(has(file), "{name} has {file}: {listed}");
            }
        }
    }
}
