//! Another program that holds a site's database.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, Command, Stdio};

use crate::TestSite;

/// Another program that writes to the site's database and takes its time: whoever writes, or tries what an edit would do,
/// waits for it.
pub struct Lock(Child);

impl Lock {
    /// Begins to write.
    #[must_use]
    pub fn hold(site: &TestSite) -> Self {
        let mut shell = Command::new("sqlite3")
            .arg(site.path().join("site.db"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the sqlite3 shell is installed (tests/run installs it)");
        let mut said = String::new();
        writeln!(shell.stdin.as_mut().expect("piped"), "BEGIN IMMEDIATE; SELECT 'held';")
            .expect("it listens");
        BufReader::new(shell.stdout.as_mut().expect("piped")).read_line(&mut said).expect("it answers");
        assert_eq!(said, "held\n");
        Self(shell)
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}
