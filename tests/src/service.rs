//! The running service, as a program of somebody's that speaks HTTP sees it.

use std::io::{BufRead, BufReader, Lines, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::NamedTempFile;

use crate::{Ran, TestSite, adit};

/// How long the program may take to refuse to start.
const PATIENCE: Duration = Duration::from_secs(20);

/// `adit serve` on a site; ends with it.
pub struct Service {
    child: Child,
    log: NamedTempFile,
    /// Its address: `127.0.0.1:4711`.
    pub address: String,
}

impl Service {
    /// Serves the site on a port that is free.
    pub fn start(site: &TestSite) -> Self {
        Self::start_on(site, "127.0.0.1:0")
    }

    /// Serves the site on this address.
    pub fn start_on(site: &TestSite, address: &str) -> Self {
        Self::start_with(site, &["--listen", address])
    }

    /// Serves the site with these arguments.
    pub fn start_with(site: &TestSite, arguments: &[&str]) -> Self {
        Self::start_by(Command::new(adit()), site, arguments)
    }

    /// Serves the site by a command that becomes the program: `prlimit --as=2000000000 adit`.
    pub fn start_by(mut program: Command, site: &TestSite, arguments: &[&str]) -> Self {
        let log = NamedTempFile::new().expect("a temporary file");
        let mut child = program
            .arg("serve")
            .arg(site.path())
            .args(arguments)
            .args(on_database(site))
            .stdout(Stdio::piped())
            .stderr(log.reopen().expect("a temporary file"))
            .spawn()
            .expect("adit starts");
        let mut line = String::new();
        let out = child.stdout.take().expect("its output is piped");
        BufReader::new(out).read_line(&mut line).expect("it says where it listens");
        let address = line
            .trim()
            .strip_prefix("listening on http://")
            .unwrap_or_else(|| panic!("`adit serve` said `{line}`"))
            .trim_end_matches('/')
            .to_owned();
        Self { child, log, address }
    }

    /// What is printed where the service does not start.
    ///
    /// # Panics
    /// Where it does.
    pub fn refused(site: &TestSite, arguments: &[&str]) -> Ran {
        let mut child = Command::new(adit())
            .arg("serve")
            .arg(site.path())
            .args(arguments)
            .args(on_database(site))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("adit starts");
        let began = Instant::now();
        while child.try_wait().expect("it runs").is_none() {
            if began.elapsed() > PATIENCE {
                child.kill().expect("it runs");
                panic!("`adit serve` {arguments:?} starts, and should not");
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        Ran::new(&child.wait_with_output().expect("it has ended"))
    }

    /// What it has said so far to whoever runs it.
    pub fn log(&self) -> String {
        std::fs::read_to_string(self.log.path()).expect("its log is there")
    }

    /// The page's address, with what comes behind: `#sql`.
    pub fn page(&self, hash: &str) -> String {
        format!("http://{}/{hash}", self.address)
    }

    /// The program's number.
    pub fn pid(&self) -> u32 {
        self.child.id()
    }

    /// The most memory that the program had so far, in bytes.
    pub fn peak_memory(&self) -> u64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.pid())).expect("it runs");
        let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("it says its peak");
        peak.trim().trim_end_matches(" kB").parse::<u64>().expect("a number") * 1024
    }

    /// Tells the program to end, and waits until it has.
    pub fn end(self) {
        self.end_by("TERM");
    }

    /// As [`end`](Self::end), by this signal.
    pub fn end_by(mut self, signal: &str) {
        let told = Command::new("kill").args([&format!("-{signal}"), &self.pid().to_string()]).status();
        assert!(told.expect("kill is there").success());
        assert!(self.child.wait().expect("it ends").success());
    }

    /// Kills the program, as a power cut would.
    pub fn kill(mut self) {
        self.child.kill().expect("it runs");
        self.child.wait().expect("it ends");
    }

    /// Asks with headers (`Name: value`), and gives the status and the answer's JSON.
    pub fn ask_as(&self, headers: &[&str], method: &str, path: &str, body: Option<&Value>) -> (u16, Value) {
        let answer =
            exchange_with(&self.address, headers, (method, path), body).expect("somebody answers there");
        parsed(&answer)
    }

    /// Live events, from now on.
    pub fn events(&self) -> Events {
        self.events_as("Accept: text/event-stream")
    }

    /// Live events for whoever sends this header.
    pub fn events_as(&self, header: &str) -> Events {
        self.stream(header, "/api/events")
    }

    /// A route that is followed: `start=dock&goal=ward%2012`.
    pub fn follow(&self, question: &str) -> Events {
        self.stream("Accept: text/event-stream", &format!("/api/route/follow?{question}"))
    }

    /// A stream of events for whoever sends this header.
    pub fn stream(&self, header: &str, path: &str) -> Events {
        let mut stream = TcpStream::connect(&self.address).expect("somebody answers there");
        write!(stream, "GET {path} HTTP/1.1\r\nHost: {}\r\n{header}\r\n\r\n", self.address).expect("asked");
        stream.set_read_timeout(Some(Duration::from_secs(15))).expect("a time");
        Events { lines: BufReader::new(stream).lines() }
    }

    /// Asks, and hangs up after a while without an answer.
    pub fn hang_up(&self, method: &str, path: &str, body: &Value, after: Duration) {
        let mut stream = TcpStream::connect(&self.address).expect("somebody answers there");
        send(&mut stream, &self.address, &[], (method, path), Some(body)).expect("asked");
        std::thread::sleep(after);
    }

    /// What an address gives, as bytes.
    pub fn bytes(&self, path: &str) -> Vec<u8> {
        self.bytes_as(&[], path)
    }

    /// The same with headers.
    pub fn bytes_as(&self, headers: &[&str], path: &str) -> Vec<u8> {
        let mut stream = TcpStream::connect(&self.address).expect("somebody answers there");
        send(&mut stream, &self.address, headers, ("GET", path), None).expect("asked");
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).expect("answered");
        assert!(answer.starts_with(b"HTTP/1.1 200"), "{}", String::from_utf8_lossy(&answer[..200]));
        let head = answer.windows(4).position(|four| four == b"\r\n\r\n").expect("headers end");
        answer.split_off(head + 4)
    }

    /// Asks, and gives the status and the answer's JSON.
    pub fn ask(&self, method: &str, path: &str, body: Option<&Value>) -> (u16, Value) {
        request(&self.address, method, path, body)
    }
}

impl Drop for Service {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The arguments by which a site is served that is in PostgreSQL.
fn on_database(site: &TestSite) -> Vec<String> {
    let url = site.elsewhere.served(site.path());
    url.map_or(Vec::new(), |url| vec!["--database".to_owned(), url])
}

/// A stream of live events.
pub struct Events {
    lines: Lines<BufReader<TcpStream>>,
}

impl Events {
    /// The data of the next event of this name.
    ///
    /// # Panics
    /// Where none comes for 15 seconds.
    #[track_caller]
    pub fn next(&mut self, name: &str) -> Value {
        match self.read(name) {
            Ok(Some(data)) => data,
            Ok(None) => panic!("the stream ends without an event `{name}`"),
            Err(error) => panic!("no event `{name}` comes: {error}"),
        }
    }

    /// Reads on a thread of its own: the events of this name, each with the moment at which it came.
    #[must_use]
    pub fn heard(mut self, name: &'static str) -> Receiver<(Instant, Value)> {
        let (say, heard) = channel();
        std::thread::spawn(move || {
            while let Ok(Some(data)) = self.read(name) {
                if say.send((Instant::now(), data)).is_err() {
                    break;
                }
            }
        });
        heard
    }

    fn read(&mut self, name: &str) -> std::io::Result<Option<Value>> {
        let head = format!("event: {name}");
        let mut is_it = false;
        for line in self.lines.by_ref() {
            let line = line?;
            match line.strip_prefix("data: ").filter(|_| is_it) {
                Some(data) => return Ok(Some(serde_json::from_str(data).expect("data is JSON"))),
                None => is_it |= line == head,
            }
        }
        Ok(None)
    }

    /// Waits until the service ends the stream.
    ///
    /// # Panics
    /// Where it does not for 15 seconds.
    #[track_caller]
    pub fn end(&mut self) {
        let began = Instant::now();
        for line in self.lines.by_ref() {
            // a body in chunks ends with an empty one; signs of life come each 15 seconds
            match line {
                Ok(line) if line == "0" => return,
                Ok(_) if began.elapsed() < Duration::from_secs(14) => {}
                _ => panic!("the stream goes on"),
            }
        }
    }
}

/// One request over a connection of its own; the status and the answer's JSON, or its text.
pub fn request(address: &str, method: &str, path: &str, body: Option<&Value>) -> (u16, Value) {
    parsed(&exchange(address, method, path, body).expect("somebody answers there"))
}

/// As [`request`], of a service that may be killed or paused meanwhile; `None` where no whole answer comes.
pub fn try_request(address: &str, method: &str, path: &str, body: Option<&Value>) -> Option<(u16, Value)> {
    let mut stream = TcpStream::connect(address).ok()?;
    stream.set_read_timeout(Some(Duration::from_mins(1))).ok()?;
    send(&mut stream, address, &[], (method, path), body).ok()?;
    let mut answer = String::new();
    stream.read_to_string(&mut answer).ok()?;
    let status = answer.split(' ').nth(1)?.parse().ok()?;
    let (_, body) = answer.split_once("\r\n\r\n")?;
    Some((status, serde_json::from_str(body).ok()?))
}

fn parsed(answer: &str) -> (u16, Value) {
    let status = answer.split(' ').nth(1).and_then(|status| status.parse().ok()).expect("a status line");
    let (_, body) = answer.split_once("\r\n\r\n").expect("headers end");
    (status, serde_json::from_str(body).unwrap_or(Value::String(body.to_owned())))
}

/// What comes back for a request: status line, headers, body.
pub(crate) fn exchange(
    address: &str,
    method: &str,
    path: &str,
    body: Option<&Value>,
) -> std::io::Result<String> {
    exchange_with(address, &[], (method, path), body)
}

/// As [`exchange`], with headers; one that is given stands instead of the usual one of its name.
fn exchange_with(
    address: &str,
    headers: &[&str],
    (method, path): (&str, &str),
    body: Option<&Value>,
) -> std::io::Result<String> {
    let mut stream = TcpStream::connect(address)?;
    send(&mut stream, address, headers, (method, path), body)?;
    let mut answer = String::new();
    stream.read_to_string(&mut answer)?;
    Ok(answer)
}

fn send(
    stream: &mut TcpStream,
    address: &str,
    headers: &[&str],
    (method, path): (&str, &str),
    body: Option<&Value>,
) -> std::io::Result<()> {
    let body = match body {
        Some(Value::String(raw)) => raw.clone(),
        body => body.map(Value::to_string).unwrap_or_default(),
    };
    let name = |header: &str| header.split(':').next().unwrap_or_default().to_lowercase();
    let usual = [format!("Host: {address}"), "Content-Type: application/json".to_owned()];
    let usual = usual.iter().filter(|usual| !headers.iter().any(|given| name(given) == name(usual)));
    let headers: Vec<&str> = usual.map(String::as_str).chain(headers.iter().copied()).collect();
    let headers = headers.join("\r\n");
    write!(
        stream,
        "{method} {path} HTTP/1.1\r\n{headers}\r\nContent-Length: {}\r\nConnection: close\r\n\r\n{body}",
        body.len()
    )
}
