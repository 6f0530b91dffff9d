//! The running service, as a program of somebody's that speaks HTTP sees it.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};

use serde_json::Value;

use crate::{TestSite, adit};

/// `adit serve` on a site; ends with it.
pub struct Service {
    child: Child,
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
        let mut child = Command::new(adit())
            .arg("serve")
            .arg(site.path())
            .args(["--listen", address])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
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
        Self { child, address }
    }

    /// The page's address, with what comes behind: `#sql`.
    pub fn page(&self, hash: &str) -> String {
        format!("http://{}/{hash}", self.address)
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

/// One request over a connection of its own; the status and the answer's JSON, or its text.
fn request(address: &str, method: &str, path: &str, body: Option<&Value>) -> (u16, Value) {
    let mut stream = TcpStream::connect(address).expect("somebody listens there");
    let body = body.map(Value::to_string).unwrap_or_default();
    write!(
        stream,
        "{method} {path} HTTP/1.1\r\nHost: {address}\r\nContent-Type: application/json\r\n\
         Content-Length: {}\r\nConnection: close\r\n\r\n{body}",
        body.len()
    )
    .expect("sent");
    let mut answer = String::new();
    stream.read_to_string(&mut answer).expect("an answer in UTF-8");
    let status = answer.split(' ').nth(1).and_then(|status| status.parse().ok()).expect("a status line");
    let (_, body) = answer.split_once("\r\n\r\n").expect("headers end");
    (status, serde_json::from_str(body).unwrap_or(Value::String(body.to_owned())))
}
