//! On which database tests serve their sites: in each site's own file, or all in one cluster of PostgreSQL.

use std::path::Path;
use std::process::Command;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use tempfile::TempDir;

use crate::cluster::Cluster;
use crate::{Ran, adit};

/// How the name of a test target ends that serves its sites from PostgreSQL.
const ON_POSTGRES: &str = "_on_postgres";

/// Commands that look at a site's files, or at who may come in: both are in the folder of a service on PostgreSQL, too.
const OF_THE_FOLDER: [&str; 4] = ["build", "check", "serve", "token"];

/// Commands that only read, and so do it in a copy.
const THAT_READ: [&str; 3] = ["history", "route", "sql"];

/// Whether these tests are about sites in PostgreSQL: by the name of their target, or by `ADIT_TESTS_ON=postgres`.
pub fn on_postgres() -> bool {
    static SAYS: OnceLock<bool> = OnceLock::new();
    *SAYS.get_or_init(|| {
        if let Some(said) = std::env::var_os("ADIT_TESTS_ON") {
            return said == "postgres";
        }
        let program = std::env::current_exe().expect("a test knows its own path");
        let name = program.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        name.rsplit_once('-').is_some_and(|(target, _)| target.ends_with(ON_POSTGRES))
    })
}

/// The cluster of all tests of this process.
pub fn cluster() -> &'static Cluster {
    static CLUSTER: OnceLock<Cluster> = OnceLock::new();
    CLUSTER.get_or_init(Cluster::start_for_all)
}

/// Where in PostgreSQL the site of a test is, once it is served there.
#[derive(Default)]
pub(crate) struct Elsewhere {
    name: OnceLock<String>,
}

impl Elsewhere {
    /// The site's URL, where it is to be served from PostgreSQL; it is moved there when this is asked first.
    pub(crate) fn served(&self, folder: &Path) -> Option<String> {
        let move_there = || {
            static NUMBER: AtomicUsize = AtomicUsize::new(0);
            let name = format!("site-{}", NUMBER.fetch_add(1, Ordering::Relaxed));
            copy(&folder.display().to_string(), &cluster().url(&name));
            std::fs::remove_file(folder.join("site.db")).expect("it was built");
            name
        };
        on_postgres().then(|| cluster().url(self.name.get_or_init(move_there)))
    }

    /// The site's name in the cluster, once it is there.
    pub(crate) fn name(&self) -> Option<&str> {
        self.name.get().map(String::as_str)
    }

    /// The site as it now is in PostgreSQL, in a folder.
    pub(crate) fn brought_back(&self) -> Option<TempDir> {
        let url = cluster().url(self.name.get()?);
        let folder = tempfile::tempdir().expect("a temporary folder");
        copy(&url, &folder.path().display().to_string());
        Some(folder)
    }

    /// The folder in which a command finds what it needs, where that is not the site's own.
    ///
    /// # Panics
    /// Where the command would edit the site.
    pub(crate) fn for_command(&self, verb: &str) -> Option<TempDir> {
        self.name.get().filter(|_| !OF_THE_FOLDER.contains(&verb))?;
        assert!(THAT_READ.contains(&verb), "`adit {verb}` does not edit a site in PostgreSQL");
        self.brought_back()
    }
}

fn copy(from: &str, to: &str) {
    let copied = Command::new(adit()).args(["copy", from, to]).output().expect("adit runs");
    Ran::new(&copied).expect_status(0);
}
