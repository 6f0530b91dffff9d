//! A terminal in a folder of its own: commands are typed word for word.

use std::fs;
use std::io::{BufRead, BufReader};
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use adit_tests::{Ran, adit, repository};
use tempfile::TempDir;

/// Where the pages say that the service listens; the one of a test takes a port that is free.
const ADDRESS: &str = "127.0.0.1:7373";
/// What lasts until Ctrl-C. Each says something when it is ready, and goes on.
const LASTING: [&str; 3] = [" serve ", " watch ", "curl -N"];

/// The terminal.
pub struct Terminal {
    folder: TempDir,
    path: String,
    service: Option<Service>,
}

struct Service {
    child: Child,
    address: String,
}

impl Terminal {
    /// With `adit` on the path.
    pub fn new() -> Self {
        let programs = adit().parent().expect("it lies in a folder").display();
        Self::with(format!("{programs}:{}", std::env::var("PATH").unwrap_or_default()))
    }

    /// Without.
    pub fn without_adit() -> Self {
        Self::with("/usr/bin:/bin".to_owned())
    }

    fn with(path: String) -> Self {
        Self { folder: tempfile::tempdir().expect("a temporary folder"), path, service: None }
    }

    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// A folder of the repository is here as well.
    pub fn link(&self, name: &str) {
        std::os::unix::fs::symlink(repository().join(name), self.folder().join(name)).expect("linked");
    }

    pub fn write(&self, name: &str, text: &str) {
        fs::write(self.folder().join(name), text).unwrap_or_else(|error| panic!("{name}: {error}"));
    }

    pub fn add(&self, name: &str, text: &str) {
        let before =
            fs::read_to_string(self.folder().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
        self.write(name, &format!("{before}\n{text}"));
    }

    fn bash(&self, command: &str) -> Command {
        let mut bash = Command::new("bash");
        bash.arg("-c").arg(command).current_dir(self.folder()).env("PATH", &self.path).stdin(Stdio::null());
        bash
    }

    /// Types a command. It must do what it is for: exit status 0, or, of one that lasts, an answer. Where the page shows beside it what
    /// it prints (`# …, takes about 23 s`), it must print that.
    pub fn run(&mut self, command: &str, at: &str) {
        let command = match &self.service {
            Some(service) => command.replace(ADDRESS, &service.address),
            None => command.to_owned(),
        };
        let is_asked = command.contains("curl ");
        if !is_asked {
            self.end_service();
        }
        if LASTING.iter().any(|words| command.contains(words)) {
            self.start(&command, at);
            return;
        }
        let ran = Ran::new(&self.bash(&command).output().expect("bash runs"));
        assert_eq!(ran.status, 0, "{at}: {command}\n{}\n{}", ran.stdout, ran.stderr);
        if let Some((_, printed)) = command.split_once("# …, ") {
            assert!(ran.stdout.contains(printed.trim()), "{at}: {command}\n{}", ran.stdout);
        }
    }

    /// Starts what lasts, and waits for its first line. A service goes on, for what asks it; the others end.
    fn start(&mut self, command: &str, at: &str) {
        let is_service = command.contains(" serve ");
        let typed = match command.split_once('#') {
            Some((typed, _)) if is_service => typed,
            _ => command,
        };
        let port = if is_service { " --listen 127.0.0.1:0" } else { "" };
        // who starts the tests in the background may have had Ctrl-C ignored, which all that they start inherits
        let mut bash = self.bash(&format!("exec env --default-signal=INT {typed}{port}"));
        let mut child = bash.process_group(0).stdout(Stdio::piped()).spawn().expect("bash runs");
        let mut said = String::new();
        BufReader::new(child.stdout.take().expect("piped")).read_line(&mut said).expect("it says something");
        assert!(!said.is_empty(), "{at}: {command} said nothing, and ended with {:?}", child.wait());
        if is_service {
            let address = said.trim().strip_prefix("listening on http://").map(|at| at.trim_end_matches('/'));
            let address = address.unwrap_or_else(|| panic!("{at}: {said}")).to_owned();
            // what has answered hears Ctrl-C, too
            let asked = Command::new("curl")
                .args(["-sS", "--fail", &format!("http://{address}/api/health")])
                .output();
            assert_eq!(Ran::new(&asked.expect("curl is there")).stdout, "ok", "{at}: {command}");
            self.service = Some(Service { child, address });
        } else {
            end(&mut child);
        }
    }

    fn end_service(&mut self) {
        if let Some(mut service) = self.service.take() {
            let status = end(&mut service.child);
            assert_eq!(status, Some(0), "`adit serve` ends well on Ctrl-C");
        }
    }

    /// The rows that the plain `sqlite3` shell prints.
    pub fn sqlite3(&self, database: &str, query: &str, at: &str) -> Vec<String> {
        let mut sqlite3 = Command::new("sqlite3");
        let ran = sqlite3.arg("-readonly").arg(self.folder().join(database)).arg(query).output();
        let ran = Ran::new(&ran.expect("the sqlite3 shell is installed (tests/run installs it)"));
        assert_eq!(ran.status, 0, "{at}: {query}\n{}", ran.stderr);
        ran.stdout.lines().map(str::to_owned).collect()
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        if let Some(mut service) = self.service.take() {
            end(&mut service.child);
        }
    }
}

/// Ctrl-C.
fn end(child: &mut Child) -> Option<i32> {
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill is there");
    child.wait().expect("it ends").code()
}
