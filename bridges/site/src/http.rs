//! Questions to the service by HTTP, and its streams of events.

use std::time::Duration;

use http_body_util::{BodyExt, Full};
use hyper::body::{Bytes, Incoming};
use hyper::client::conn::http1;
use hyper::{Request, Response};
use hyper_util::rt::TokioIo;
use serde_json::Value;
use tokio::net::TcpStream;

/// How long an answer may take; the service itself gives up after a minute.
const PATIENCE: Duration = Duration::from_secs(70);

/// How long a stream may be silent: the service shows each 15 s that it lives.
const SILENCE: Duration = Duration::from_secs(40);

/// Where the service is, and by what it lets us in.
#[derive(Clone, Debug)]
pub struct Site {
    /// `host:port`
    address: String,
    token: Option<String>,
}

/// Why there is no answer.
#[derive(Clone, Debug)]
pub enum Trouble {
    /// The service cannot be reached, or broke off.
    Away(String),
    /// It refused: its code, what it says, and which end of a way it is about (`start`, `goal`).
    Refused { code: String, words: String, end: Option<String> },
}

impl std::fmt::Display for Trouble {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Away(words) => write!(f, "the site's service does not answer: {words}"),
            Self::Refused { words, .. } => f.write_str(words),
        }
    }
}

fn away(error: impl std::fmt::Display) -> Trouble {
    Trouble::Away(error.to_string())
}

impl Site {
    /// The service at `http://host:port`.
    pub fn at(url: &str, token: Option<String>) -> anyhow::Result<Self> {
        let rest = url.strip_prefix("http://").ok_or_else(|| {
            anyhow::anyhow!("`{url}` is no address of a served site: expected `http://HOST:PORT` as `adit serve` prints it")
        })?;
        let address = rest.trim_end_matches('/');
        anyhow::ensure!(
            !address.is_empty() && !address.contains('/'),
            "`{url}` has a path; the service is asked at `http://HOST:PORT`"
        );
        let address = if address.contains(':') { address.to_owned() } else { format!("{address}:80") };
        Ok(Self { address, token })
    }

    /// What `GET` answers.
    pub async fn get(&self, path: &str) -> Result<Value, Trouble> {
        self.ask("GET", path, None).await
    }

    /// What `DELETE` answers.
    pub async fn delete(&self, path: &str) -> Result<Value, Trouble> {
        self.ask("DELETE", path, None).await
    }

    /// What `POST` answers.
    pub async fn post(&self, path: &str, body: &Value) -> Result<Value, Trouble> {
        self.ask("POST", path, Some(body)).await
    }

    async fn ask(&self, method: &str, path: &str, body: Option<&Value>) -> Result<Value, Trouble> {
        let asked = async {
            let answer = self.send(method, path, body).await?;
            let refused = !answer.status().is_success();
            let bytes = answer.into_body().collect().await.map_err(away)?.to_bytes();
            let value: Value = serde_json::from_slice(&bytes).map_err(away)?;
            if refused { Err(refusal(&value)) } else { Ok(value) }
        };
        tokio::time::timeout(PATIENCE, asked).await.map_err(|_| away("no answer in time"))?
    }

    async fn send(
        &self,
        method: &str,
        path: &str,
        body: Option<&Value>,
    ) -> Result<Response<Incoming>, Trouble> {
        let stream = TcpStream::connect(&self.address).await.map_err(away)?;
        let (mut sender, connection) = http1::handshake(TokioIo::new(stream)).await.map_err(away)?;
        tokio::spawn(connection);
        let mut request = Request::builder().method(method).uri(path).header("Host", &self.address);
        if let Some(token) = &self.token {
            request = request.header("Authorization", format!("Bearer {token}"));
        }
        if body.is_some() {
            request = request.header("Content-Type", "application/json");
        }
        let body = Full::new(Bytes::from(body.map(Value::to_string).unwrap_or_default()));
        sender.send_request(request.body(body).map_err(away)?).await.map_err(away)
    }

    /// Hears a stream of events until it ends, each with its name and data.
    pub async fn hear(&self, path: &str, mut on: impl FnMut(&str, &str)) -> Result<(), Trouble> {
        let answer = tokio::time::timeout(PATIENCE, self.send("GET", path, None));
        let answer = answer.await.map_err(|_| away("no answer in time"))??;
        if !answer.status().is_success() {
            let bytes = answer.into_body().collect().await.map_err(away)?.to_bytes();
            return Err(refusal(&serde_json::from_slice(&bytes).unwrap_or_default()));
        }
        let mut body = answer.into_body();
        let (mut unread, mut name) = (Vec::new(), String::new());
        loop {
            let frame = tokio::time::timeout(SILENCE, body.frame())
                .await
                .map_err(|_| away("its stream is silent"))?;
            let Some(frame) = frame else { return Ok(()) };
            let frame = frame.map_err(away)?;
            unread.extend_from_slice(frame.data_ref().map_or(&[], |data| data.as_ref()));
            while let Some(end) = unread.iter().position(|byte| *byte == b'\n') {
                let line: Vec<u8> = unread.drain(..=end).collect();
                let line = String::from_utf8_lossy(&line);
                let line = line.trim_end();
                if let Some(event) = line.strip_prefix("event: ") {
                    event.clone_into(&mut name);
                } else if let Some(data) = line.strip_prefix("data: ") {
                    on(&name, data);
                }
            }
        }
    }
}

fn refusal(answer: &Value) -> Trouble {
    let of = |key: &str| answer["error"][key].as_str().unwrap_or_default().to_owned();
    let (message, help) = (of("message"), of("help"));
    let words = if help.is_empty() { message } else { format!("{message}; {help}") };
    let end = answer["error"]["problems"][0]["nearest"]["end"].as_str().map(str::to_owned);
    Trouble::Refused { code: of("code"), words, end }
}

/// A query: `start=2%2C6&goal=gate`.
pub fn query(pairs: &[(&str, &str)]) -> String {
    form_urlencoded::Serializer::new(String::new()).extend_pairs(pairs).finish()
}
