//! A site's folder as it would be if what stands in an editor were saved: a folder of links, with the drafts as files among
//! them. So an editor hears what `adit check` says of the site, and of all of it.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};
use std::{fs, io};

use tempfile::TempDir;

/// A path below the mirrored folder, with the text that shall stand there; without one it is a folder of its own.
type Wanted<'p> = (Vec<&'p Path>, Option<&'p str>);

/// How many folders above a site its settings may name something in, as `map = "../maps/floor.yaml"` does.
const ABOVE: usize = 3;

pub struct Mirror {
    top: TempDir,
    /// The folder that `top` stands for.
    of: PathBuf,
}

impl Mirror {
    /// # Arguments
    /// `drafts` are texts by their absolute paths; those that do not lie under what is mirrored are left out.
    pub fn new(folder: &Path, drafts: &BTreeMap<PathBuf, String>) -> io::Result<Self> {
        let of = folder.ancestors().take(ABOVE + 1).last().unwrap_or(folder).to_owned();
        let top = tempfile::Builder::new().prefix("adit-lsp-").tempdir()?;
        let mut wanted: Vec<Wanted<'_>> = vec![(below(folder, &of), None)];
        wanted.extend(
            drafts
                .iter()
                .filter(|(path, _)| path.starts_with(&of))
                .map(|(path, text)| (below(path, &of), Some(text.as_str()))),
        );
        fill(&of, top.path(), &wanted)?;
        Ok(Self { top, of })
    }

    /// Where a file of the site lies in the mirror.
    pub fn at(&self, path: &Path) -> PathBuf {
        path.strip_prefix(&self.of).map_or_else(|_| path.to_owned(), |below| self.top.path().join(below))
    }

    /// Where a file of the mirror lies in the site.
    pub fn back(&self, path: &Path) -> PathBuf {
        path.strip_prefix(self.top.path()).map_or_else(|_| path.to_owned(), |below| self.of.join(below))
    }

    /// A sentence that names files of the mirror, as it would be said of the site.
    pub fn said(&self, sentence: &str) -> String {
        sentence.replace(&self.top.path().display().to_string(), &self.of.display().to_string())
    }
}

fn below<'p>(path: &'p Path, of: &Path) -> Vec<&'p Path> {
    let rest = path.strip_prefix(of).unwrap_or(path).components();
    rest.filter(|part| matches!(part, Component::Normal(_))).map(|part| Path::new(part.as_os_str())).collect()
}

/// Links all that lies in a folder, but for what is wanted as a folder or a text of its own.
fn fill(from: &Path, into: &Path, wanted: &[Wanted<'_>]) -> io::Result<()> {
    let mut own: BTreeMap<&Path, Vec<Wanted<'_>>> = BTreeMap::new();
    for (path, text) in wanted {
        if let Some((first, rest)) = path.split_first() {
            own.entry(first).or_default().push((rest.to_vec(), *text));
        }
    }
    // a folder that nobody may list has at least what is wanted of it
    for entry in fs::read_dir(from).into_iter().flatten().flatten() {
        let name = entry.file_name();
        if !own.contains_key(Path::new(&name)) {
            std::os::unix::fs::symlink(entry.path(), into.join(&name))?;
        }
    }
    for (name, inside) in own {
        if let Some(text) = inside.iter().find_map(|(rest, text)| text.filter(|_| rest.is_empty())) {
            fs::write(into.join(name), text)?;
        } else {
            fs::create_dir_all(into.join(name))?;
            fill(&from.join(name), &into.join(name), &inside)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // in a test a failed unwrap is a failed test

    use super::*;

    #[test]
    fn drafts_stand_among_links_and_nothing_of_the_site_changes() {
        let folder = tempfile::tempdir().unwrap();
        let site = folder.path().join("one/two/site");
        fs::create_dir_all(site.join("rules")).unwrap();
        fs::write(site.join("site.toml"), "saved").unwrap();
        fs::write(site.join("rules/a.rhai"), "saved").unwrap();
        fs::write(folder.path().join("one/map.toml"), "above").unwrap();
        let drafts = BTreeMap::from([
            (site.join("rules/a.rhai"), "draft".to_owned()),
            (site.join("rules/tests/new.toml"), "new".to_owned()),
            (PathBuf::from("/elsewhere/b.rhai"), "not here".to_owned()),
        ]);
        let mirror = Mirror::new(&site, &drafts).unwrap();
        let read = |path: &str| fs::read_to_string(mirror.at(&site).join(path)).unwrap();
        assert_eq!(read("site.toml"), "saved");
        assert_eq!(read("rules/a.rhai"), "draft");
        assert_eq!(read("rules/tests/new.toml"), "new");
        assert_eq!(read("../../map.toml"), "above");
        assert_eq!(fs::read_to_string(site.join("rules/a.rhai")).unwrap(), "saved");
        assert!(!site.join("rules/tests").exists());
        assert_eq!(mirror.back(&mirror.at(&site.join("x"))), site.join("x"));
    }
}
