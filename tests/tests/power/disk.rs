//! What a disk holds after a power cut, of what was written to it.
//!
//! What was synced is there. Of what was written since, each block holds what it was at any moment since, or, torn, the
//! beginning of one such moment and the end of the one before; a file has any of its sizes; and names of a folder that was
//! not synced since are those of before or of now, each for itself.

use std::collections::BTreeMap;
use std::path::Path;

use adit_tests::oracle::random::Chance;

use crate::tape::{Event, Kind, Tape};

/// Files by name, as they lie in the site's folder.
pub type Files = BTreeMap<String, Vec<u8>>;

#[derive(Default)]
struct File<'t> {
    is_folder: bool,
    synced: Vec<u8>,
    since: Vec<Change<'t>>,
}

enum Change<'t> {
    Written(usize, &'t [u8]),
    Sized(usize),
}

impl Change<'_> {
    fn make(&self, content: &mut Vec<u8>) {
        match self {
            Self::Written(at, data) => {
                content.resize(content.len().max(at + data.len()), 0);
                content[*at..at + data.len()].copy_from_slice(data);
            }
            Self::Sized(size) => content.resize(*size, 0),
        }
    }
}

/// What became of a name: which file it is from now on.
struct Named(String, Option<usize>);

/// Names that change together.
type Renaming = Vec<Named>;

#[derive(Default)]
pub struct Disk<'t> {
    files: Vec<File<'t>>,
    now: BTreeMap<String, usize>,
    synced: BTreeMap<String, usize>,
    since: Vec<Renaming>,
}

impl<'t> Disk<'t> {
    /// The disk with what was on it at first, and what the first of a tape's events did to it.
    pub fn after(first: &Files, tape: &'t Tape, events: usize) -> Self {
        let mut disk = Self::default();
        for (name, content) in first {
            disk.files.push(File { synced: content.clone(), ..File::default() });
            disk.now.insert(name.clone(), disk.files.len() - 1);
        }
        disk.synced.clone_from(&disk.now);
        for event in &tape.events[..events] {
            disk.follow(event, tape.data(event));
        }
        disk
    }

    fn follow(&mut self, event: &Event, data: &'t [u8]) {
        let known = self.now.get(&event.name).copied();
        let mut change = |change| {
            // a file that was removed may still be open
            if let Some(file) = known {
                self.files[file].since.push(change);
            }
        };
        match event.kind {
            // it is mapped into memory, and rebuilt after a crash
            _ if event.name.ends_with("-shm") => {}
            Kind::Write => change(Change::Written(event.at as usize, data)),
            Kind::Size => change(Change::Sized(event.at as usize)),
            Kind::Make | Kind::Folder => {
                self.files.push(File { is_folder: event.kind == Kind::Folder, ..File::default() });
                self.name(vec![Named(event.name.clone(), Some(self.files.len() - 1))]);
            }
            Kind::Remove => self.name(vec![Named(event.name.clone(), None)]),
            Kind::Rename => {
                let to = String::from_utf8(data.to_vec()).unwrap();
                self.name(vec![Named(event.name.clone(), None), Named(to, known)]);
            }
            Kind::Sync => match known.filter(|file| !self.files[*file].is_folder) {
                Some(file) => self.files[file].sync(),
                None => self.sync_names(&event.name),
            },
            Kind::Acknowledged => {}
        }
    }

    fn name(&mut self, renaming: Renaming) {
        rename(&mut self.now, &renaming);
        self.since.push(renaming);
    }

    fn sync_names(&mut self, folder: &str) {
        let is_in = |named: &Named| named.0.rsplit_once('/').map_or("", |(folder, _)| folder) == folder;
        let since = std::mem::take(&mut self.since);
        let (synced, since) = since.into_iter().partition(|renaming: &Renaming| renaming.iter().any(is_in));
        self.since = since;
        for renaming in synced {
            rename(&mut self.synced, &renaming);
        }
    }

    /// What is there after a power cut.
    pub fn after_a_power_cut(&self, chance: &mut Chance) -> Files {
        let block = [512, 4_096][chance.below(2)];
        // from all lost to all kept
        let kept = [0.0, 0.1, 0.5, 0.9, 1.0][chance.below(5)];
        let names_kept = [0.0, 0.5, 1.0][chance.below(3)];
        let mut names = self.synced.clone();
        for renaming in &self.since {
            if chance.is(names_kept) {
                rename(&mut names, renaming);
            }
        }
        self.content(&names, |file| file.after_a_power_cut(block, kept, chance))
    }

    /// What the program saw at this moment; also what is there when it is killed.
    pub fn as_seen(&self) -> Files {
        self.content(&self.now, |file| file.now())
    }

    fn content(
        &self,
        names: &BTreeMap<String, usize>,
        mut content: impl FnMut(&File<'_>) -> Vec<u8>,
    ) -> Files {
        // a folder that was made, and is not among the names, is lost with what is in it
        let is_there = |name: &str| {
            name.rsplit_once('/')
                .is_none_or(|(folder, _)| !self.now.contains_key(folder) || names.contains_key(folder))
        };
        let files = names.iter().filter(|(name, file)| !self.files[**file].is_folder && is_there(name));
        files.map(|(name, file)| (name.clone(), content(&self.files[*file]))).collect()
    }
}

fn rename(names: &mut BTreeMap<String, usize>, renaming: &Renaming) {
    for Named(name, file) in renaming {
        match file {
            Some(file) => names.insert(name.clone(), *file),
            None => names.remove(name),
        };
    }
}

impl File<'_> {
    fn now(&self) -> Vec<u8> {
        let mut content = self.synced.clone();
        self.since.iter().for_each(|change| change.make(&mut content));
        content
    }

    fn sync(&mut self) {
        for change in std::mem::take(&mut self.since) {
            change.make(&mut self.synced);
        }
    }

    fn after_a_power_cut(&self, block: usize, kept: f64, chance: &mut Chance) -> Vec<u8> {
        let (moments, sizes) = self.moments(block);
        let mut content = self.synced.clone();
        for (number, moments) in moments {
            let last = moments.len() - 1;
            let moment = if chance.is(kept) { last } else { chance.below(last + 1) };
            let mut held = moments[moment].clone();
            if moment < last && chance.is(0.2) {
                let torn = chance.below(block);
                held[..torn].copy_from_slice(&moments[moment + 1][..torn]);
            }
            Change::Written(number * block, &held).make(&mut content);
        }
        let size = if chance.is(kept) { sizes.len() - 1 } else { chance.below(sizes.len()) };
        content.resize(sizes[size], 0);
        content
    }

    /// What each block that was changed since the last sync held, from then on, and the sizes that the file had.
    fn moments(&self, block: usize) -> (BTreeMap<usize, Vec<Vec<u8>>>, Vec<usize>) {
        let held = |content: &[u8], number: usize| {
            let there = content.len().min(number * block)..content.len().min((number + 1) * block);
            let mut held = content[there].to_vec();
            held.resize(block, 0);
            held
        };
        let mut content = self.synced.clone();
        let (mut moments, mut sizes) = (BTreeMap::<_, Vec<_>>::new(), vec![content.len()]);
        for change in &self.since {
            let touched = match change {
                Change::Written(at, data) => *at..at + data.len(),
                Change::Sized(size) => *size..content.len(),
            };
            change.make(&mut content);
            sizes.push(content.len());
            if touched.is_empty() {
                continue;
            }
            for number in touched.start / block..=(touched.end - 1) / block {
                let moments = moments.entry(number).or_insert_with(|| vec![held(&self.synced, number)]);
                moments.push(held(&content, number));
            }
        }
        (moments, sizes)
    }
}

/// The files in a folder, and in folders in it.
pub fn files_in(folder: &Path) -> Files {
    let mut files = Files::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap().to_str().unwrap().to_owned();
                files.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    files
}
