//! Texts and files that nobody wrote: made of good ones, piece by piece, and read until a reader panics, hangs or takes much
//! memory.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use crate::oracle::random::Chance;

/// How long each reader is tried; `ADIT_FUZZ_SECONDS` says another time.
const SECONDS: f64 = 2.0;

/// How long one text may take, on a machine that has much else to do.
const PATIENCE: Duration = Duration::from_mins(2);

/// By how many bytes one text may make the program grow.
const MEMORY: u64 = 512 << 20;

/// Texts to make others of: so many of those that were read are kept beside the first ones.
const KEPT: usize = 400;

/// A longer text is not made.
const LONGEST: usize = 200_000;

/// Numbers at which readers trip.
const NUMBERS: [&str; 24] = [
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "0.01",
    "1e-9",
    "1e-320",
    "0.1",
    "3.0000000000000004",
    "65535",
    "65536",
    "2147483648",
    "4294967295",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551616",
    "1e9",
    "1e15",
    "1e16",
    "1e308",
    "-1e308",
    "nan",
    "inf",
];

/// Texts at which readers trip.
const TEXTS: [&str; 14] = [
    "",
    " ",
    "\0",
    "\u{1b}[31m",
    "ä",
    "\u{202e}x",
    "🤖",
    "../../etc/passwd",
    "/dev/zero",
    "a/b",
    "x,y",
    "'; DROP TABLE rooms; --",
    "null",
    "-",
];

/// What readers are given to begin with, and what they made of it.
pub struct Fuzz {
    name: &'static str,
    seeds: Vec<Vec<u8>>,
    /// Pieces that stand in any of the texts.
    words: Vec<String>,
}

impl Fuzz {
    /// A reader by its name, with texts that it reads.
    ///
    /// # Panics
    /// Where there is none.
    pub fn new(name: &'static str, seeds: Vec<Vec<u8>>) -> Self {
        assert!(!seeds.is_empty(), "{name} begins with something");
        let words = seeds.iter().flat_map(|seed| pieces(&String::from_utf8_lossy(seed))).collect();
        Self { name, seeds, words }
    }

    /// Has texts read, those that were found before first.
    ///
    /// # Arguments
    /// `read` says whether it made sense of one.
    ///
    /// # Panics
    /// Where a text makes a reader panic, hang or grow; it is kept in the folder `fuzz` of the target folder.
    pub fn run(self, read: impl Fn(&[u8]) -> bool + Send + 'static) {
        self.run_with(read, mutated);
    }

    /// As [`run`](Self::run), for what is no text: `make` makes one of another.
    ///
    /// # Panics
    /// As there.
    #[allow(clippy::print_stdout)] // how much was tried is what a long run is for
    pub fn run_with(
        mut self,
        read: impl Fn(&[u8]) -> bool + Send + 'static,
        make: impl Fn(&mut Chance, &[u8], &[String]) -> Vec<u8>,
    ) {
        let (name, first) = (self.name, self.seeds.len());
        let (give, taken) = channel::<Vec<u8>>();
        let (say, said) = channel();
        let work = move || {
            for text in taken {
                let read = catch_unwind(AssertUnwindSafe(|| read(&text)));
                if say.send(read.map_err(|panic| words_of(&*panic))).is_err() {
                    break;
                }
            }
        };
        let reader = std::thread::Builder::new().stack_size(16 << 20).spawn(work).expect("a thread");
        let mut chance = Chance::new(number("ADIT_FUZZ_SEED", 1.0) as u64);
        let until = Instant::now() + Duration::from_secs_f64(number("ADIT_FUZZ_SECONDS", SECONDS));
        let mut known = found_before(name).into_iter();
        let (mut tried, mut good, mut slowest) = (0_u64, 0_u64, Duration::ZERO);
        let mut found: Vec<String> = Vec::new();
        let place = kept_in().join(format!("{name}.last"));
        while Instant::now() < until && found.len() < 20 {
            let text = known.next().unwrap_or_else(|| {
                let seed = &self.seeds[chance.below(self.seeds.len())];
                make(&mut chance, seed, &self.words)
            });
            // a stack that overflows ends the program: what did it is there
            fs::write(&place, &text).expect("the target folder can be written");
            let (began, before) = (Instant::now(), peak());
            give.send(text.clone()).expect("it listens");
            let heard = said.recv_timeout(PATIENCE);
            let is_over = heard.is_err();
            tried += 1;
            slowest = slowest.max(began.elapsed());
            let wrong = match heard {
                Ok(Ok(is_read)) => {
                    good += u64::from(is_read);
                    if is_read && text.len() < LONGEST / 4 && !text.is_empty() && !self.seeds.contains(&text)
                    {
                        if self.seeds.len() < first + KEPT {
                            self.seeds.push(text.clone());
                        } else {
                            let old = first + chance.below(KEPT);
                            self.seeds[old].clone_from(&text);
                        }
                    }
                    (peak() > before + MEMORY).then(|| format!("grew by {} MB", (peak() - before) >> 20))
                }
                Ok(Err(panic)) => Some(panic),
                Err(RecvTimeoutError::Timeout) => Some(format!("took longer than {PATIENCE:?}")),
                Err(RecvTimeoutError::Disconnected) => Some("ended".to_owned()),
            };
            // the same words, but for their numbers, are the same fault
            let alike = |text: &str| text.replace(|c: char| c.is_ascii_digit(), "");
            let is_new = |wrong: &String| !found.iter().any(|known| alike(known).ends_with(&alike(wrong)));
            if let Some(wrong) = wrong.filter(is_new) {
                let file = kept_in().join(format!("{name}-{}", found.len()));
                fs::write(&file, &text).expect("the target folder can be written");
                found.push(format!("{}: {wrong}", file.display()));
            }
            if is_over {
                break;
            }
        }
        drop(give);
        // what it holds ends with it: a service, too
        if found.is_empty() {
            reader.join().expect("it has read all that it was given");
        }
        println!(
            "fuzz {name}: {tried} tried, {good} read, the slowest in {slowest:.1?}, {} found",
            found.len()
        );
        assert!(found.is_empty(), "{name}:\n{}", found.join("\n"));
    }
}

fn number(variable: &str, otherwise: f64) -> f64 {
    std::env::var(variable).ok().and_then(|text| text.parse().ok()).unwrap_or(otherwise)
}

fn words_of(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
    format!("panicked: {}", text.unwrap_or("?"))
}

fn kept_in() -> PathBuf {
    let exe = std::env::current_exe().expect("a test knows its own path");
    let folder = exe.ancestors().nth(3).expect("tests run in target/PROFILE/deps").join("fuzz");
    fs::create_dir_all(&folder).expect("the target folder can be written");
    folder
}

/// Texts that once did harm, as they were found: `tests/tests/fuzz/found/NAME-…`.
fn found_before(name: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/found");
    let mut files: Vec<PathBuf> =
        fs::read_dir(folder).expect("it is there").flatten().map(|file| file.path()).collect();
    files.sort();
    let is_of = |file: &PathBuf| {
        let file = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        file.strip_prefix(name).is_some_and(|rest| rest.starts_with('-'))
    };
    files.iter().filter(|file| is_of(file)).map(|file| fs::read(file).expect("it is there")).collect()
}

/// The most memory that this program had so far, bytes.
fn peak() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<u64>().ok()).unwrap_or_default() << 10
}

/// Words, numbers, quoted texts, space and single characters.
fn pieces(text: &str) -> Vec<String> {
    let (mut pieces, mut rest) = (Vec::new(), text);
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_alphanumeric() || "_.+-".contains(c);
        let end = if first == '"' {
            rest[1..].find('"').map_or(1, |end| end + 2)
        } else if is_word(first) {
            rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        } else if first == ' ' {
            rest.find(|c| c != ' ').unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        pieces.push(rest[..end].to_owned());
        rest = &rest[end..];
    }
    pieces
}

/// A text like another one: pieces changed, doubled, left out, nested; lines repeated.
pub fn mutated(chance: &mut Chance, seed: &[u8], words: &[String]) -> Vec<u8> {
    let mut pieces = pieces(&String::from_utf8_lossy(seed));
    for _ in 0..=chance.below(5) {
        if pieces.is_empty() {
            break;
        }
        let at = chance.below(pieces.len());
        match chance.below(12) {
            0..=2 => pieces[at] = like(chance, &pieces[at]),
            3 | 4 => pieces[at].clone_from(&words[chance.below(words.len())]),
            5 => drop(pieces.remove(at)),
            6 => pieces.insert(at, words[chance.below(words.len())].clone()),
            7 => {
                let other = chance.below(pieces.len());
                pieces.swap(at, other);
            }
            8 => {
                // lines, once more or many times
                let lines = line_about(&pieces, at, chance.below(4));
                let part: Vec<String> = pieces[lines.clone()].to_vec();
                let often = [1, 1, 2, 30, 300][chance.below(5)];
                let often = often.min(LONGEST / part.iter().map(String::len).sum::<usize>().max(1));
                let many = part.iter().cycle().take(part.len() * often).cloned().collect::<Vec<_>>();
                pieces.splice(lines.end..lines.end, many);
            }
            9 => drop(pieces.drain(line_about(&pieces, at, chance.below(3)))),
            10 => {
                let (open, close) =
                    [("[", "]"), ("{", "}"), ("(", ")"), ("-", ""), ("!", "")][chance.below(5)];
                let deep = [1, 2, 40, 2_000][chance.below(4)];
                pieces[at] = format!("{}{}{}", open.repeat(deep), pieces[at], close.repeat(deep));
            }
            _ => pieces.truncate(at),
        }
    }
    let mut text = pieces.concat().into_bytes();
    text.truncate(LONGEST);
    if chance.below(20) == 0 {
        scattered(chance, &mut text);
    }
    text
}

/// Another number in a number's place, another text in a text's.
fn like(chance: &mut Chance, piece: &str) -> String {
    let text = TEXTS[chance.below(TEXTS.len())];
    if piece.starts_with('"') {
        return match chance.below(3) {
            0 => format!("\"{}\"", text.escape_default()),
            1 => format!("\"{}\"", piece.trim_matches('"').repeat(1 + chance.below(400))),
            _ => NUMBERS[chance.below(NUMBERS.len())].to_owned(),
        };
    }
    match piece.parse::<f64>() {
        Ok(number) if chance.below(2) == 0 => format!("{:?}", number * chance.between(-1.5, 2.5)),
        Ok(_) => NUMBERS[chance.below(NUMBERS.len())].to_owned(),
        Err(_) if piece.trim().is_empty() => text.to_owned(),
        Err(_) => piece.chars().rev().collect(),
    }
}

/// The pieces of the line about one, and of so many lines more.
fn line_about(pieces: &[String], at: usize, more: usize) -> std::ops::Range<usize> {
    let first = pieces[..at].iter().rposition(|piece| piece == "\n").map_or(0, |line| line + 1);
    let mut end = at;
    for _ in 0..=more {
        end =
            pieces[end..].iter().position(|piece| piece == "\n").map_or(pieces.len(), |line| end + line + 1);
    }
    first..end.max(first)
}

/// Some bytes of it become others, or go.
pub fn scattered(chance: &mut Chance, bytes: &mut Vec<u8>) {
    for _ in 0..=chance.below(6) {
        if bytes.is_empty() {
            return;
        }
        let at = chance.below(bytes.len());
        match chance.below(4) {
            0 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff][chance.below(5)],
            1 => bytes[at] = chance.below(256) as u8,
            2 => bytes.truncate(at),
            _ => bytes[at] ^= 1 << chance.below(8),
        }
    }
}

/// The checksum of PNG and ZIP (CRC-32 of ISO 3309).
fn checksum(bytes: &[u8]) -> u32 {
    let step = |sum: u32, byte: &u8| {
        (0..8).fold(
            sum ^ u32::from(*byte),
            |sum, _| if sum & 1 == 1 { sum >> 1 ^ 0xedb8_8320 } else { sum >> 1 },
        )
    };
    !bytes.iter().fold(!0, step)
}

/// A PNG of these chunks, each with the checksum that it should have: readers look past it.
pub fn png(chunks: &[(&[u8; 4], Vec<u8>)]) -> Vec<u8> {
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    for (kind, data) in chunks {
        let body = [kind.as_slice(), data].concat();
        file.extend((data.len() as u32).to_be_bytes());
        file.extend(&body);
        file.extend(checksum(&body).to_be_bytes());
    }
    file
}

/// Bytes as zlib has them, not compressed.
pub fn stored(bytes: &[u8]) -> Vec<u8> {
    let mut file = vec![0x78, 0x01];
    let mut parts = bytes.chunks(0xffff).peekable();
    while let Some(part) = parts.next() {
        file.push(u8::from(parts.peek().is_none()));
        file.extend((part.len() as u16).to_le_bytes());
        file.extend((!(part.len() as u16)).to_le_bytes());
        file.extend(part);
    }
    let sums = bytes.iter().fold((1_u32, 0_u32), |(a, b), byte| {
        let a = (a + u32::from(*byte)) % 65_521;
        (a, (a + b) % 65_521)
    });
    file.extend((sums.1 << 16 | sums.0).to_be_bytes());
    file
}

/// A ZIP of these files, not compressed.
pub fn zip(files: &[(&str, Vec<u8>)]) -> Vec<u8> {
    let (mut file, mut directory) = (Vec::new(), Vec::new());
    for (name, data) in files {
        let offset = file.len() as u32;
        let mut head: Vec<u8> = [20_u16, 0, 0, 0, 0].iter().flat_map(|half| half.to_le_bytes()).collect();
        head.extend(
            [checksum(data), data.len() as u32, data.len() as u32].iter().flat_map(|word| word.to_le_bytes()),
        );
        head.extend([name.len() as u16, 0].iter().flat_map(|half| half.to_le_bytes()));
        file.extend(b"PK\x03\x04");
        file.extend(&head);
        file.extend(name.as_bytes());
        file.extend(data);
        directory.extend(b"PK\x01\x02\x14\x00");
        directory.extend(&head);
        directory.extend([0_u8; 10]);
        directory.extend(offset.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let (count, begin) = (files.len() as u16, file.len() as u32);
    file.extend(&directory);
    file.extend(b"PK\x05\x06\0\0\0\0");
    file.extend([count, count].iter().flat_map(|half| half.to_le_bytes()));
    file.extend([directory.len() as u32, begin].iter().flat_map(|word| word.to_le_bytes()));
    file.extend([0, 0]);
    file
}
