//! The files of a site that is in PostgreSQL: which they are, and how they come into a folder.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

use adit_db::postgres::File;
use siphasher::sip::SipHasher13;

use super::rules::Drafts;
use super::whole;
use crate::error::{Code, Error, Result};

/// In which file a folder says of which site its files are, and what they were.
const MARK: &str = ".adit-copy";

/// Where a service has its copy of the rows.
const COPY: &str = ".adit-copy.db";

/// The most that a site's files may be together.
const MOST: usize = 64 << 20;

/// What is no file of the site: who may come in is a matter of each service.
fn is_left_out(name: &str) -> bool {
    let is_anothers = name.contains(".db") || Path::new(name).extension().is_some_and(|end| end == "old");
    name.starts_with('.') || name == "tokens.toml" || name.ends_with('~') || is_anothers
}

/// All files of a site, by their paths from its folder.
///
/// # Arguments
/// `named` are those that the site names, which are to be in the folder.
pub fn files(folder: &Path, named: &[PathBuf]) -> Result<Vec<File>> {
    let inside = folder.canonicalize().map_err(|error| Error::io("read", folder, &error))?;
    for file in named {
        if file.canonicalize().is_ok_and(|file| !file.starts_with(&inside)) {
            let message =
                format!("{} is not in the site's folder, and so cannot be kept with it", file.display());
            let help = format!("copy it into {}, and name it so", folder.display());
            return Err(Error::said(Code::PostgresFiles, message, Some(help)));
        }
    }
    in_folder(folder)
}

fn in_folder(folder: &Path) -> Result<Vec<File>> {
    let (mut found, mut waiting, mut bytes) = (Vec::new(), vec![PathBuf::new()], 0);
    while let Some(below) = waiting.pop() {
        let at = folder.join(&below);
        let Ok(entries) = fs::read_dir(&at) else { continue };
        for entry in entries.flatten() {
            let Ok(name) = entry.file_name().into_string() else { continue };
            if is_left_out(&name) {
                continue;
            }
            let (path, full) = (below.join(&name), entry.path());
            if full.is_dir() {
                waiting.push(path);
                continue;
            }
            let content = fs::read(&full).map_err(|error| Error::io("read", &full, &error))?;
            bytes += content.len();
            if bytes > MOST {
                let message = format!("the files in {} are more than {} MB", folder.display(), MOST >> 20);
                return Err(Error::said(Code::PostgresFiles, message, None));
            }
            let parts: Vec<String> =
                path.components().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect();
            found.push(File { path: parts.join("/"), bytes: Some(content) });
        }
    }
    found.sort_by(|one, other| one.path.cmp(&other.path));
    Ok(found)
}

/// The files as they are once drafts of rule files are saved in their folder.
pub fn drafted(mut files: Vec<File>, folder: &Path, rules: &Path, drafts: &Drafts) -> Vec<File> {
    let Ok(below) = rules.strip_prefix(folder) else { return files };
    for (name, text) in drafts {
        let path: Vec<String> = below
            .join(name)
            .components()
            .map(|part| part.as_os_str().to_string_lossy().into_owned())
            .collect();
        let path = path.join("/");
        files.retain(|file| file.path != path);
        files.extend(text.as_ref().map(|text| File { path, bytes: Some(text.clone().into_bytes()) }));
    }
    files.sort_by(|one, other| one.path.cmp(&other.path));
    files
}

/// Where a folder has a service's copy of the rows, which is made anew: what a service left that was killed is taken away.
pub fn copy(folder: &Path) -> PathBuf {
    for end in ["", "-journal", "-wal", "-shm", "-files"] {
        fs::remove_file(folder.join(format!("{COPY}{end}"))).ok();
    }
    folder.join(COPY)
}

/// Puts a site's files into a folder: one that has none, or those that were put there before and are still the same.
pub fn take(folder: &Path, name: &str, files: &[File]) -> Result<()> {
    fs::create_dir_all(folder).map_err(|error| Error::io("make", folder, &error))?;
    let there = in_folder(folder)?;
    let mark = folder.join(MARK);
    let is_ours = fs::read_to_string(&mark).is_ok_and(|text| text == sign(name, &there));
    let is_marked = marked(folder).as_deref() == Some(name);
    if is_marked && !is_ours {
        // a service that was killed while it wrote them, or somebody who edited them meanwhile
        for file in there.iter().filter(|file| !files.contains(file)) {
            let kept = folder.join(format!("{}~", file.path));
            whole::write(&kept, file.bytes.as_deref().unwrap_or_default())?;
        }
    } else if !there.is_empty() && there != files && !is_ours {
        let other: BTreeMap<&String, &File> = files.iter().map(|file| (&file.path, file)).collect();
        let differs = there.iter().find(|file| other.get(&file.path) != Some(file));
        let differs = differs.map_or("a file is missing", |file| file.path.as_str());
        let message = format!(
            "the files in {} are not those of the site `{name}` in the database ({differs})",
            folder.display()
        );
        let help = "name an empty folder; or `adit copy FOLDER URL --replace` puts the folder's site into the database";
        return Err(Error::said(Code::PostgresFiles, message, Some(help.to_owned())));
    }
    write(folder, files)?;
    whole::write(&mark, sign(name, files).as_bytes())
}

fn sign(name: &str, files: &[File]) -> String {
    use std::hash::{Hash, Hasher};
    let mut hasher = SipHasher13::new();
    for file in files {
        (&file.path, &file.bytes).hash(&mut hasher);
    }
    format!("{name}\n{:016x}\n", hasher.finish())
}

/// Has a folder hold these files of a site, and no others of one; whether one was another before.
pub fn write(folder: &Path, files: &[File]) -> Result<bool> {
    let there = in_folder(folder)?;
    let gone = there.iter().filter(|file| !files.iter().any(|kept| kept.path == file.path));
    let gone: Vec<File> = gone.map(|file| File { path: file.path.clone(), bytes: None }).collect();
    let new: Vec<File> = files.iter().filter(|file| !there.contains(file)).cloned().collect();
    write_some(folder, &gone)?;
    write_some(folder, &new)?;
    Ok(!gone.is_empty() || !new.is_empty())
}

/// Writes files, and takes those away that are gone.
pub fn write_some(folder: &Path, files: &[File]) -> Result<()> {
    for file in files {
        let below = Path::new(&file.path);
        // what others wrote to a database names no file elsewhere
        if below.components().any(|part| !matches!(part, Component::Normal(_))) {
            let message = format!("the database names a file of the site `{}`", file.path);
            return Err(Error::said(Code::PostgresFiles, message, None));
        }
        let path = folder.join(below);
        match &file.bytes {
            Some(bytes) => {
                if let Some(parent) = path.parent() {
                    fs::create_dir_all(parent).map_err(|error| Error::io("make", parent, &error))?;
                }
                whole::write(&path, bytes)?;
            }
            None => {
                fs::remove_file(&path).ok();
            }
        }
    }
    if let (false, Some(name)) = (files.is_empty(), marked(folder)) {
        whole::write(&folder.join(MARK), sign(&name, &in_folder(folder)?).as_bytes())?;
    }
    Ok(())
}

/// The site whose files a folder holds, where they were put there.
fn marked(folder: &Path) -> Option<String> {
    let text = fs::read_to_string(folder.join(MARK)).ok()?;
    text.lines().next().map(str::to_owned)
}
