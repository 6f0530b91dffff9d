//! Another program that holds a site's database, or another service that has the right to write.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, Command, Stdio};

use crate::TestSite;
use crate::database::cluster;

/// Another program that writes to the site's database and takes its time: whoever writes, or tries what an edit would do,
/// waits for it.
pub enum Lock {
    Shell(Child),
    Lease(String),
}

impl Lock {
    /// Begins to write.
    #[must_use]
    pub fn hold(site: &TestSite) -> Self {
        if let Some(name) = site.elsewhere.name() {
            let free = "owner IS NULL OR until < now()";
            let taken = format!(
                "UPDATE adit.sites SET owner = 'another', fence = fence + 1, until = now() + interval '1 hour'
                 WHERE site = '{name}' AND ({free}) RETURNING owner"
            );
            crate::within("nobody has the right to write", || {
                (cluster().ask(&taken) == ["another"]).then_some(())
            });
            return Self::Lease(name.to_owned());
        }
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
        Self::Shell(shell)
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        match self {
            Self::Shell(shell) => {
                let _ = shell.kill();
                let _ = shell.wait();
            }
            Self::Lease(name) => {
                let given_up = "UPDATE adit.sites SET owner = NULL, until = NULL WHERE owner = 'another'";
                cluster().ask(&format!("{given_up} AND site = '{name}'"));
            }
        }
    }
}
