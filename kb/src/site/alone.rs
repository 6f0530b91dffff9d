//! A map alone as a site: in a folder that is made for it and goes with the program.

use std::io::Read;
use std::path::Path;

use tempfile::TempDir;

use super::{Layout, whole};
use crate::error::{Code, Error, Result};
use crate::plan::course_of;

/// Whether a file begins as SQLite's do.
fn is_database(file: &Path) -> bool {
    let mut head = [0; 16];
    let read = std::fs::File::open(file).and_then(|mut file| file.read_exact(&mut head));
    read.is_ok() && head == *b"SQLite format 3\0"
}

/// Makes the folder of a site whose map is this file, which stays where it is.
pub fn folder(map: &Path) -> Result<TempDir> {
    if Layout::of(map).is_none() {
        if map.extension().is_some_and(|extension| extension == "toml") {
            Layout::refuse_slips(map)?;
            course_of(map)?;
        }
        if let Some(name) = map.file_name().filter(|_| is_database(map)) {
            let of = map.parent().filter(|folder| !folder.as_os_str().is_empty());
            let of = of.unwrap_or_else(|| Path::new(".")).display();
            let message =
                format!("{} is a database, and the site is the folder that it is of", map.display());
            let help = match name.to_str() {
                Some("site.db") => format!("say {of}"),
                _ => format!("say the site's folder, and --db {}", map.display()),
            };
            return Err(Error::said(Code::SiteMissing, message, Some(help)));
        }
        let map = map.display();
        let message = format!("{map} is no site, and no map of corridors, parts, walls, a cell or lanes");
        let help = format!("`adit new DIR --map {map}` makes a site of a map that is cut into rooms");
        return Err(Error::said(Code::SiteMissing, message, Some(help)));
    }
    let file = std::path::absolute(map).map_err(|error| Error::io("read", map, &error))?;
    let name = map.file_stem().unwrap_or_default();
    let [name, file] = [name.display().to_string(), file.display().to_string()].map(toml::Value::from);
    let folder = tempfile::tempdir().map_err(|error| Error::io("make", &std::env::temp_dir(), &error))?;
    whole::write(&folder.path().join("site.toml"), format!("name = {name}\nmap = {file}\n").as_bytes())?;
    Ok(folder)
}
