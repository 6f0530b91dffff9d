//! A cluster of PostgreSQL of a test's own: in a temporary folder, on a Unix socket and on loopback, as another user than root.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use tempfile::TempDir;

/// The password of the user `adit` by TCP; by the socket it needs none.
pub const PASSWORD: &str = "a secret";

/// A running cluster with a database `plant`, whose owner is `adit`.
pub struct Cluster {
    folder: TempDir,
    port: u16,
    programs: PathBuf,
    /// Settings besides the usual ones.
    settings: &'static str,
    /// Ends it with this process, where nothing else does.
    #[allow(dead_code, reason = "it is held, and not looked at")]
    watcher: Option<Child>,
}

/// Of what a crash would take.
const UNSAFE: &str = "-c fsync=off -c full_page_writes=off -c autovacuum_naptime=5s";

/// Where PostgreSQL's programs are, the newest first.
fn programs() -> PathBuf {
    let versions = std::fs::read_dir("/usr/lib/postgresql").expect("the package `postgresql` is installed");
    let mut versions: Vec<PathBuf> = versions.flatten().map(|entry| entry.path().join("bin")).collect();
    versions.sort();
    versions
        .into_iter()
        .rfind(|bin| bin.join("initdb").is_file())
        .expect("the package `postgresql` is installed")
}

fn is_root() -> bool {
    let said = Command::new("id").arg("-u").output().expect("id is there");
    said.stdout.trim_ascii() == b"0"
}

impl Cluster {
    /// Makes a cluster and starts it.
    pub fn start() -> Self {
        Self::start_with("")
    }

    /// Makes a cluster that ends with this process, however that ends, and keeps nothing of what it holds safe from a crash.
    pub fn start_for_all() -> Self {
        let mut cluster = Self::start_with(UNSAFE);
        // the other end of its input is closed when this process is gone
        let script = "trap '' HUP INT TERM; read -r _; kill -QUIT $(head -n 1 \"$0/data/postmaster.pid\"); \
            while [ -e \"$0/data/postmaster.pid\" ]; do sleep 0.05; done; rm -rf \"$0\"";
        let watcher =
            Command::new("sh").args(["-c", script]).arg(cluster.path()).stdin(Stdio::piped()).spawn();
        cluster.watcher = Some(watcher.expect("sh is there"));
        cluster
    }

    /// Makes a cluster with settings besides the usual ones: `-c NAME=VALUE`.
    pub fn start_with(settings: &'static str) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let port = std::net::TcpListener::bind("127.0.0.1:0")
            .and_then(|free| free.local_addr())
            .expect("a port")
            .port();
        let cluster = Self { folder, port, programs: programs(), settings, watcher: None };
        let password = cluster.path().join("password");
        std::fs::write(&password, PASSWORD).expect("a file");
        if is_root() {
            let owned = Command::new("chown").arg("-R").arg("postgres").arg(cluster.path()).status();
            assert!(owned.expect("chown is there").success());
        }
        let data = cluster.path().join("data");
        let (data, password) = (data.display().to_string(), password.display().to_string());
        let made = cluster.run(
            "initdb",
            &[
                "-D",
                &data,
                "-U",
                "adit",
                "-E",
                "UTF8",
                "--locale=C",
                "--auth-local=trust",
                "--auth-host=scram-sha-256",
                "--pwfile",
                &password,
            ],
        );
        assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
        cluster.up();
        cluster.sql("CREATE DATABASE plant", "postgres");
        cluster
    }

    fn path(&self) -> &Path {
        self.folder.path()
    }

    fn run(&self, program: &str, arguments: &[&str]) -> Output {
        let program = self.programs.join(program);
        let mut command = if is_root() {
            let mut command = Command::new("setpriv");
            command.args(["--reuid=postgres", "--regid=postgres", "--clear-groups"]).arg(program);
            command
        } else {
            Command::new(program)
        };
        command.current_dir(self.path()).args(arguments).output().expect("PostgreSQL's programs run")
    }

    /// Starts it after it was [killed](Self::kill).
    pub fn up(&self) {
        let (data, log) = (self.path().join("data"), self.path().join("log"));
        let (data, log) = (data.display().to_string(), log.display().to_string());
        let options = format!(
            "-k {} -p {} -c listen_addresses=127.0.0.1 -c max_connections=200 -c shared_buffers=64MB {}",
            self.path().display(),
            self.port,
            self.settings
        );
        for tried in 0.. {
            // its output goes to the log, and not into a pipe that it would hold open
            let started = self.run("pg_ctl", &["-D", &data, "-l", &log, "-o", &options, "-w", "start"]);
            if started.status.success() {
                break;
            }
            let said = std::fs::read_to_string(&log).unwrap_or_default();
            assert!(tried < 50, "PostgreSQL does not start: {said}");
            std::thread::sleep(Duration::from_millis(100));
        }
    }

    /// Lets it offer TLS from now on, as `127.0.0.1`. Gives the certificate of who vouches for it.
    pub fn secure(&self) -> PathBuf {
        self.certify("ca", &["-x509", "-days", "2"]);
        self.certify("server", &[]);
        std::fs::write(self.path().join("names"), "subjectAltName = IP:127.0.0.1").expect("a file");
        let signed = "x509 -req -in server.pem -CA ca.pem -CAkey ca.key -CAcreateserial -days 2 -extfile names -out signed.pem";
        self.openssl(&signed.split(' ').collect::<Vec<_>>());
        for (setting, file) in [("ssl_cert_file", "signed.pem"), ("ssl_key_file", "server.key")] {
            self.ask(&format!("ALTER SYSTEM SET {setting} = '{}'", self.path().join(file).display()));
        }
        self.ask("ALTER SYSTEM SET ssl = on");
        self.ask("SELECT pg_reload_conf()");
        self.path().join("ca.pem")
    }

    /// Makes a key, and beside it a certificate, or the request for one.
    fn certify(&self, name: &str, more: &[&str]) {
        let (key, certificate, subject) =
            (format!("{name}.key"), format!("{name}.pem"), format!("/CN=a test's {name}"));
        let made = ["req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes"];
        let files = ["-keyout", &key, "-out", &certificate, "-subj", &subject];
        self.openssl(&[&made[..], &files, more].concat());
    }

    fn openssl(&self, arguments: &[&str]) {
        let made = self.run("/usr/bin/openssl", arguments);
        assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    }

    /// Ends it as `kill -9` would.
    pub fn kill(&self) {
        let file = self.path().join("data/postmaster.pid");
        let pid = std::fs::read_to_string(file).expect("it runs");
        let pid = pid.lines().next().expect("it runs").to_owned();
        let children = Command::new("pgrep").args(["-P", &pid]).output().expect("pgrep is there");
        let children = String::from_utf8_lossy(&children.stdout).into_owned();
        Command::new("kill")
            .arg("-9")
            .arg(&pid)
            .args(children.split_whitespace())
            .status()
            .expect("kill is there");
        while Path::new("/proc").join(&pid).exists() {
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    /// What it has said so far.
    pub fn log(&self) -> String {
        std::fs::read_to_string(self.path().join("log")).expect("it was started")
    }

    /// The URL of a site, by the socket.
    pub fn url(&self, site: &str) -> String {
        self.url_as("adit", site)
    }

    /// The URL of a site for a user of the database, by the socket.
    pub fn url_as(&self, user: &str, site: &str) -> String {
        format!("postgres://{user}@localhost:{}/plant?host={}&site={site}", self.port, self.path().display())
    }

    /// The URL of a site by TCP, with this password.
    pub fn tcp(&self, password: &str, site: &str) -> String {
        let password = password.replace(' ', "%20");
        format!("postgres://adit:{password}@127.0.0.1:{}/plant?site={site}", self.port)
    }

    /// What SQL gives, a text a row, its columns joined by `|`.
    ///
    /// # Panics
    /// Where it is refused.
    pub fn ask(&self, sql: &str) -> Vec<String> {
        self.sql(sql, "plant")
    }

    /// The same as another user, or what was said instead.
    pub fn ask_as(&self, user: &str, sql: &str) -> Result<Vec<String>, String> {
        self.psql(user, sql, "plant")
    }

    fn sql(&self, sql: &str, database: &str) -> Vec<String> {
        self.psql("adit", sql, database).unwrap_or_else(|said| panic!("{sql}: {said}"))
    }

    /// Runs a script of SQL.
    pub fn load(&self, script: &Path) {
        // where the server's user may read it
        let copy = self.path().join("script.sql");
        std::fs::copy(script, &copy).expect("the script is there");
        self.run_psql("adit", ["-f", &copy.display().to_string()], "plant").expect("it runs");
    }

    fn psql(&self, user: &str, sql: &str, database: &str) -> Result<Vec<String>, String> {
        self.run_psql(user, ["-c", sql], database)
    }

    fn run_psql(&self, user: &str, [how, what]: [&str; 2], database: &str) -> Result<Vec<String>, String> {
        let port = self.port.to_string();
        let host = self.path().display().to_string();
        let said = self.run(
            "psql",
            &[
                "-h",
                &host,
                "-p",
                &port,
                "-U",
                user,
                "-d",
                database,
                "-XAtq",
                "-v",
                "ON_ERROR_STOP=1",
                how,
                what,
            ],
        );
        if !said.status.success() {
            return Err(String::from_utf8_lossy(&said.stderr).into_owned());
        }
        Ok(String::from_utf8_lossy(&said.stdout).lines().map(str::to_owned).collect())
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        let data = self.path().join("data").display().to_string();
        self.run("pg_ctl", &["-D", &data, "-m", "immediate", "stop"]);
    }
}
