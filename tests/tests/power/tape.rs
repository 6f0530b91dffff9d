//! Programs whose writes go over the tests' disk (`disk.c`), and what was written down of them.

use std::fs::OpenOptions;
use std::io::Write;
use std::ops::Range;
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use adit_tests::{TestSite, adit};
use tempfile::NamedTempFile;

/// What programs did to a site's files from some moment on.
pub struct Recorder {
    folder: PathBuf,
    tape: NamedTempFile,
    room: NamedTempFile,
    is_deaf: bool,
}

/// The disk, compiled.
fn library() -> &'static Path {
    static LIBRARY: OnceLock<PathBuf> = OnceLock::new();
    LIBRARY.get_or_init(|| {
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/power/disk.c");
        let made = PathBuf::from(format!("{}/disk-{}.so", env!("CARGO_TARGET_TMPDIR"), std::process::id()));
        let mut compile = Command::new("cc");
        compile.args(["-shared", "-fPIC", "-O2", "-Wall", "-Wextra", "-Werror", "-o"]).arg(&made).arg(source);
        assert!(compile.status().expect("cc is installed (tests/run installs it)").success());
        made
    })
}

impl Recorder {
    pub fn of(site: &TestSite) -> Self {
        let room = NamedTempFile::new().unwrap();
        room.as_file().set_len(32).unwrap();
        Self { folder: site.path().to_owned(), tape: NamedTempFile::new().unwrap(), room, is_deaf: false }
    }

    /// As [`of`](Self::of), with a disk that says that it has synced, and has not.
    pub fn deaf(site: &TestSite) -> Self {
        Self { is_deaf: true, ..Self::of(site) }
    }

    /// The program `adit`, on this disk.
    pub fn adit(&self) -> Command {
        let mut program = Command::new(adit());
        program.env("LD_PRELOAD", library()).env("ADIT_DISK_FOLDER", &self.folder);
        program.env("ADIT_DISK_TAPE", self.tape.path()).env("ADIT_DISK_ROOM", self.room.path());
        if self.is_deaf {
            program.env("ADIT_DISK_DEAF", "1");
        }
        program
    }

    /// Writes down that an edit was acknowledged, by its number in the history.
    pub fn acknowledged(&self, edit: i64) {
        let head = [Kind::Acknowledged as u64, 0, edit as u64, 0].map(u64::to_ne_bytes).concat();
        let mut tape = OpenOptions::new().append(true).open(self.tape.path()).unwrap();
        tape.write_all(&head).unwrap();
    }

    /// Of the operations that need room from now on, those from number `refused.start` on to before `refused.end` find none.
    /// With `half`, half of the first one is still written.
    pub fn refuse(&self, refused: Range<u64>, half: bool) {
        self.set([0, refused.start, refused.end, u64::from(half)]);
    }

    /// There is room for all.
    pub fn make_room(&self) {
        self.refuse(0..0, false);
    }

    fn set(&self, room: [u64; 4]) {
        let file = OpenOptions::new().write(true).open(self.room.path()).unwrap();
        file.write_all_at(&room.map(u64::to_ne_bytes).concat(), 0).unwrap();
    }

    /// What was written down so far.
    pub fn tape(&self) -> Tape {
        Tape::read(std::fs::read(self.tape.path()).unwrap())
    }
}

/// As in `disk.c`; the last one is the test's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Write = 1,
    Size,
    Make,
    Folder,
    Remove,
    Rename,
    Sync,
    Acknowledged,
}

const KINDS: [Kind; 8] = [
    Kind::Write,
    Kind::Size,
    Kind::Make,
    Kind::Folder,
    Kind::Remove,
    Kind::Rename,
    Kind::Sync,
    Kind::Acknowledged,
];

pub struct Event {
    pub kind: Kind,
    pub name: String,
    pub at: u64,
    data: Range<usize>,
}

pub struct Tape {
    bytes: Vec<u8>,
    pub events: Vec<Event>,
}

impl Tape {
    fn read(bytes: Vec<u8>) -> Self {
        let (mut events, mut next) = (Vec::new(), 0);
        while next < bytes.len() {
            let head: [usize; 4] = std::array::from_fn(|number| {
                let place = next + 8 * number;
                u64::from_ne_bytes(bytes[place..place + 8].try_into().unwrap()) as usize
            });
            let name = next + 32..next + 32 + head[1];
            let data = name.end..name.end + head[3];
            next = data.end;
            let name = String::from_utf8(bytes[name].to_vec()).unwrap();
            events.push(Event { kind: KINDS[head[0] - 1], name, at: head[2] as u64, data });
        }
        Self { bytes, events }
    }

    pub fn data(&self, event: &Event) -> &[u8] {
        &self.bytes[event.data.clone()]
    }
}
