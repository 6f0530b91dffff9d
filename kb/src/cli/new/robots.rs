//! Robots to begin with, of sizes that such machines have.

use crate::error::{Code, Error, Result};
use crate::site::shipped::{self, SITES};
use crate::words::suggest::did_you_mean;

/// The robot of those who name none.
pub const FIRST: &str = "humanoid";

/// In which folder the program carries what a robot begins with.
fn folder(name: &str) -> String {
    if name == FIRST { "starter".to_owned() } else { format!("starter/robots/{name}") }
}

/// The robots that the program carries.
pub fn names() -> Vec<String> {
    let mut names = shipped::folders(SITES, "starter/robots");
    names.push(FIRST.to_owned());
    names.sort();
    names
}

/// The floor to begin with: that of the first robot which needs one of its own.
pub fn map(wanted: &[String]) -> String {
    let own = wanted.iter().find_map(|name| file(&folder(name), "map.toml"));
    own.or_else(|| file(&folder(FIRST), "map.toml")).unwrap_or_default()
}

fn file(folder: &str, name: &str) -> Option<String> {
    let files = shipped::files(SITES, folder);
    files.into_iter().find(|(known, _)| known == name).map(|(_, text)| text)
}

/// The robots of a site, as its file has them. Of several each says its name.
pub fn text(wanted: &[String]) -> Result<String> {
    match wanted {
        [] => of(FIRST),
        [one] => of(one),
        many if (1..many.len()).any(|at| many[..at].contains(&many[at])) => {
            let message = format!("a robot is named twice: {}", many.join(", "));
            let help = "one machine more of a kind gets a name of its own in robots.toml".to_owned();
            Err(Error::said(Code::SiteUnknownRobot, message, Some(help)))
        }
        many => {
            Ok(many.iter().map(|name| Ok(named(&of(name)?, name))).collect::<Result<Vec<_>>>()?.join("\n"))
        }
    }
}

fn of(name: &str) -> Result<String> {
    let known = names().iter().any(|known| known == name).then(|| file(&folder(name), "robots.toml"));
    known.flatten().ok_or_else(|| {
        let names = names();
        let help = did_you_mean(name, names.iter().map(String::as_str)).unwrap_or_else(|| {
            format!("there are {}; robots.toml can be edited afterwards", names.join(", "))
        });
        Error::said(Code::SiteUnknownRobot, format!("there is no robot `{name}` to begin with"), Some(help))
    })
}

/// A robot's file among others: each of its entries says of which robot it is, and so do its comments.
fn named(text: &str, name: &str) -> String {
    let line = |line: &str| {
        let whose = if line.starts_with("[[") {
            format!("robot = {}\n", toml::Value::from(name))
        } else {
            String::new()
        };
        let line = if line.starts_with('#') {
            line.replace(" robot/", &format!(" {name}/"))
        } else {
            line.to_owned()
        };
        format!("{line}\n{whose}")
    };
    text.lines().map(line).collect()
}
