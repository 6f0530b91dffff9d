//! Lines to a body, and lines from it: a program that is started, or a socket.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{Shutdown, TcpStream, ToSocketAddrs};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

use super::limits::{LINE_BYTES, shortened};
use super::message::{Answer, Order, line};

/// How long a program may take to end once it is told to.
const LAST_WORDS: Duration = Duration::from_secs(2);

enum Heard {
    Line(String),
    /// What is no line, in words. Nothing is heard after it.
    Broken(String),
}

/// Who is at the other end.
enum Peer {
    Program(Child),
    Socket(TcpStream),
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ends {
    /// None came in time.
    Late(String),
    /// Nothing is heard any more.
    Over(String),
    /// What came is no message.
    Unreadable(String),
}

impl Ends {
    pub fn why(&self) -> &str {
        let (Self::Late(why) | Self::Over(why) | Self::Unreadable(why)) = self;
        why
    }
}

/// A link to a body.
pub struct Link {
    /// `None` once nothing is said any more.
    output: Option<Box<dyn Write + Send>>,
    heard: Receiver<Heard>,
    timeout: Duration,
    peer: Peer,
    /// The last that was heard.
    line: String,
}

impl Link {
    /// A link to what `tcp://HOST:PORT` is answered by, or to a program that is started.
    pub fn open(body: &str, timeout: Duration) -> Result<Self, String> {
        match body.strip_prefix("tcp://") {
            Some(address) => Self::connect(address, timeout),
            None => Self::start(body, timeout),
        }
    }

    fn start(command: &str, timeout: Duration) -> Result<Self, String> {
        let words = shlex::split(command).filter(|words| !words.is_empty()).ok_or_else(|| {
            format!("`{command}` is no command: expected a program and its arguments, quotes closed")
        })?;
        let cannot = |what: &str| format!("cannot start `{}`: {what}", words[0]);
        let mut program = Command::new(&words[0]);
        program.args(&words[1..]).stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = program.spawn().map_err(|error| cannot(&error.to_string()))?;
        let (Some(input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(cannot("it has no standard input and output"));
        };
        Ok(Self {
            output: Some(Box::new(input)),
            heard: listen(output),
            timeout,
            peer: Peer::Program(child),
            line: String::new(),
        })
    }

    fn connect(address: &str, timeout: Duration) -> Result<Self, String> {
        let cannot = |error: io::Error| format!("cannot connect to tcp://{address}: {error}");
        let mut last = io::Error::other("no such address");
        for address in address.to_socket_addrs().map_err(cannot)? {
            match TcpStream::connect_timeout(&address, timeout) {
                Ok(stream) => return Self::over(stream, timeout).map_err(cannot),
                Err(error) => last = error,
            }
        }
        Err(cannot(last))
    }

    fn over(stream: TcpStream, timeout: Duration) -> io::Result<Self> {
        stream.set_nodelay(true)?;
        stream.set_write_timeout(Some(timeout))?;
        let (input, output) = (stream.try_clone()?, stream.try_clone()?);
        Ok(Self {
            output: Some(Box::new(output)),
            heard: listen(input),
            timeout,
            peer: Peer::Socket(stream),
            line: String::new(),
        })
    }

    /// Says something, and waits for the answer.
    pub fn ask(&mut self, order: &Order) -> Result<Answer, Ends> {
        self.ask_line(&line(order), order.word())
    }

    /// Says a line, which messages call by a word, and waits for the answer.
    pub fn ask_line(&mut self, text: &str, word: &str) -> Result<Answer, Ends> {
        self.nothing_unasked()?;
        if let Err(error) = self.say(text) {
            // who has ended neither hears nor answers: which of both is met first is chance
            let what = match error.kind() {
                io::ErrorKind::BrokenPipe | io::ErrorKind::ConnectionReset => unanswered(word),
                _ => format!("`{word}` cannot be said to it: {error}"),
            };
            return Err(self.over_with(&what));
        }
        let answer = match self.heard.recv_timeout(self.timeout) {
            Ok(Heard::Line(text)) => {
                self.line = text;
                Answer::of_line(&self.line)
            }
            Ok(Heard::Broken(why)) => Err(why),
            Err(RecvTimeoutError::Timeout) => {
                let seconds = self.timeout.as_secs_f64();
                return Err(Ends::Late(format!("`{word}` was not answered within {seconds} s")));
            }
            Err(RecvTimeoutError::Disconnected) => {
                return Err(self.over_with(&unanswered(word)));
            }
        };
        answer.map_err(|why| Ends::Unreadable(format!("the answer to `{word}` is no message: {why}")))
    }

    /// The last line that was heard, shortened.
    pub fn line(&self) -> String {
        shortened(&self.line)
    }

    /// Whether nothing is heard any more, within the timeout.
    pub fn ends(&mut self) -> bool {
        self.output = None;
        if let Peer::Socket(stream) = &self.peer {
            stream.shutdown(Shutdown::Write).ok();
        }
        matches!(self.heard.recv_timeout(self.timeout), Err(RecvTimeoutError::Disconnected))
    }

    /// How the program at the other end ended, in words; `None` where it runs, or is none of ours.
    pub fn status(&mut self) -> Option<(bool, String)> {
        let Peer::Program(child) = &mut self.peer else { return None };
        let until = Instant::now() + LAST_WORDS;
        loop {
            match child.try_wait() {
                Ok(Some(status)) => return Some((status.success(), status.to_string())),
                Ok(None) if Instant::now() < until => thread::sleep(Duration::from_millis(5)),
                _ => return None,
            }
        }
    }

    /// Says something last, without waiting for an answer: that the robot should stop, whatever else is wrong.
    pub fn leave(mut self) {
        for order in [Order::Stop {}, Order::Bye {}] {
            self.say(&line(&order)).ok();
        }
    }

    fn say(&mut self, text: &str) -> io::Result<()> {
        let output = self.output.as_mut().ok_or(io::ErrorKind::NotConnected)?;
        output.write_all(text.as_bytes())?;
        output.flush()
    }

    fn nothing_unasked(&mut self) -> Result<(), Ends> {
        match self.heard.try_recv() {
            Ok(Heard::Line(text)) => {
                let why = format!(
                    "it said what it was not asked, expected one line for each: {}",
                    shortened(&text)
                );
                Err(Ends::Unreadable(why))
            }
            Ok(Heard::Broken(why)) => Err(Ends::Unreadable(why)),
            Err(TryRecvError::Empty) => Ok(()),
            Err(TryRecvError::Disconnected) => Err(self.over_with("it ended")),
        }
    }

    fn over_with(&mut self, what: &str) -> Ends {
        let status = self.status().map_or_else(String::new, |(_, status)| format!(" ({status})"));
        Ends::Over(format!("{what}{status}"))
    }
}

impl Drop for Link {
    fn drop(&mut self) {
        // who reads nothing more ends
        self.output = None;
        if self.status().is_some() {
            return;
        }
        match &mut self.peer {
            Peer::Program(child) => {
                child.kill().ok();
                child.wait().ok();
            }
            Peer::Socket(stream) => {
                stream.shutdown(Shutdown::Both).ok();
            }
        }
    }
}

fn unanswered(word: &str) -> String {
    format!("it ended before it answered `{word}`")
}

/// Reads lines on a thread of its own, so that waiting for one can end.
fn listen(input: impl Read + Send + 'static) -> Receiver<Heard> {
    let (tell, heard) = sync_channel(2);
    thread::spawn(move || {
        let mut input = BufReader::new(input);
        while let Some(next) = read_line(&mut input) {
            let is_broken = matches!(next, Heard::Broken(_));
            if tell.send(next).is_err() || is_broken {
                break;
            }
        }
    });
    heard
}

/// The next line; `None` at the end.
fn read_line(input: &mut impl BufRead) -> Option<Heard> {
    let mut bytes = Vec::new();
    let read = input.take(LINE_BYTES as u64 + 1).read_until(b'\n', &mut bytes);
    if let Err(error) = read {
        return Some(Heard::Broken(format!("it cannot be read: {error}")));
    }
    if bytes.is_empty() {
        return None;
    }
    let is_whole = bytes.pop_if(|last| *last == b'\n').is_some();
    let text = String::from_utf8(bytes);
    Some(match text {
        Ok(text) if is_whole => Heard::Line(text),
        Ok(text) if text.len() > LINE_BYTES => {
            Heard::Broken(format!("a line is longer than {LINE_BYTES} bytes: {}", shortened(&text)))
        }
        Ok(text) => Heard::Broken(format!("it ended within a line: {}", shortened(&text))),
        Err(error) => {
            let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
            Heard::Broken(format!("a line is no UTF-8: {}", shortened(&text)))
        }
    })
}

/// The next line that who drives a body says to it; `None` at the end.
///
/// # Errors
/// Where that is no line, in words.
pub fn order_line(input: &mut impl BufRead) -> Result<Option<String>, String> {
    match read_line(input) {
        None => Ok(None),
        Some(Heard::Line(text)) => Ok(Some(text)),
        Some(Heard::Broken(why)) => Err(why),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(mut bytes: &[u8]) -> Vec<Result<String, String>> {
        std::iter::from_fn(|| order_line(&mut bytes).transpose()).take(3).collect()
    }

    #[test]
    fn what_is_no_line_is_said() {
        assert_eq!(lines(b"one\ntwo\n"), [Ok("one".to_owned()), Ok("two".to_owned())]);
        let said = |bytes: &[u8]| lines(bytes)[0].clone().expect_err("no line");
        assert_eq!(said(b"hal"), "it ended within a line: `hal`");
        assert!(said(b"\xff\n").starts_with("a line is no UTF-8"));
        assert!(said(&vec![b'x'; LINE_BYTES + 5]).starts_with("a line is longer than 1048576 bytes: `xxx"));
        assert!(lines(&[vec![b'x'; LINE_BYTES], b"\n".to_vec()].concat())[0].is_ok());
    }
}
