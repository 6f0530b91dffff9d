//! What the program carries as data: the shipped rule bases, the example sites, the page, and what it quotes of the manual, as tables of paths and bytes.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// The table's name, its folder, and the endings of the files that go into it.
const CARRIED: [(&str, &str, &[&str]); 4] = [
    ("RULES", "rules", &["rhai", "toml"]),
    ("SITES", "sites", &["csv", "rhai", "toml"]),
    ("PAGE", "page", &["css", "html", "js", "svg"]),
    ("MANUAL", "manual", &["md"]),
];

fn main() -> io::Result<()> {
    let here = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").ok_or(io::ErrorKind::NotFound)?);
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?);
    let mut text = String::new();
    for (name, folder, endings) in CARRIED {
        // rules/ is a link out of the crate in the repository, and a folder in a packed crate
        let top = here.join(folder).canonicalize()?;
        println!("cargo::rerun-if-changed={}", top.display());
        let mut found = Vec::new();
        files(&top, endings, &mut found)?;
        // the same order on every machine
        found.sort();
        writeln!(text, "pub static {name}: Files = &[").map_err(io::Error::other)?;
        for path in found {
            let below = path.strip_prefix(&top).map_err(io::Error::other)?;
            let [below, path] =
                [below, &path].map(|path| path.to_str().ok_or(io::ErrorKind::InvalidFilename));
            // quoted as Rust quotes a text
            let (below, path) = (below?, path?);
            writeln!(text, "    ({below:?}, include_bytes!({path:?})),").map_err(io::Error::other)?;
        }
        writeln!(text, "];").map_err(io::Error::other)?;
    }
    fs::write(out.join("carried.rs"), text)
}

fn files(folder: &Path, endings: &[&str], found: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            files(&path, endings, found)?;
        } else if path.extension().is_some_and(|ending| endings.iter().any(|known| ending == *known)) {
            found.push(path);
        }
    }
    Ok(())
}
