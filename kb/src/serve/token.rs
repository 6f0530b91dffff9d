//! Tokens: who may do what. The file `tokens.toml` of a site keeps their hashes; a token itself is shown once.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{fs, io};

use miette::NamedSource;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use subtle::ConstantTimeEq;

use super::role::{Caller, Role};
use crate::error::{Code, Error, Finding, Result};
use crate::site::whole;

/// The file's name, in the folder of the site.
pub const FILE: &str = "tokens.toml";

/// Random bytes of a token.
const BYTES: usize = 24;

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tokens {
    /// One for each holder.
    #[serde(default, rename = "token")]
    pub tokens: Vec<Token>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Token {
    /// Its holder: edits are kept under this name.
    pub name: String,
    /// What the holder may do.
    pub roles: Vec<Role>,
    /// The SHA-256 of the token in hexadecimal digits. A token is random and long, so no slower hash is needed.
    pub sha256: String,
}

/// The file of a site.
pub fn file(folder: &Path) -> PathBuf {
    folder.join(FILE)
}

/// What the file holds, or why it cannot be read.
pub type Text = std::result::Result<String, io::ErrorKind>;

/// What the file holds now.
pub fn text(file: &Path) -> Text {
    fs::read_to_string(file).map_err(|error| error.kind())
}

/// That nobody can come in.
pub fn none(file: &Path) -> Error {
    let message = format!("there is no token in {}: nobody is let in", file.display());
    let help = "`adit token SITE add NAME` makes one; a service that is started without this file lets in whoever \
                reaches this machine";
    Error::said(Code::TokensNone, message, Some(help.to_owned()))
}

fn unreadable(message: String) -> Finding {
    Finding::said(Code::TokensUnreadable, message, Some("`adit token` writes this file".to_owned()))
}

impl Tokens {
    /// Reads the file; `None` where there is none, so that no token is needed.
    pub fn read(file: &Path) -> Result<Option<Self>> {
        Self::of(file, &text(file))
    }

    /// The tokens that a file's text holds.
    pub fn of(file: &Path, text: &Text) -> Result<Option<Self>> {
        match text {
            Ok(text) => {
                let read: Self = toml::from_str(text).map_err(|error| {
                    let place = NamedSource::new(file.display().to_string(), text.clone());
                    let finding = unreadable(error.message().replace('\n', ", "));
                    Error::all([finding.at(place, error.span().unwrap_or_default())])
                })?;
                read.check()
                    .map_err(|wrong| Error::all([unreadable(format!("{}: {wrong}", file.display()))]))?;
                Ok(Some(read))
            }
            Err(io::ErrorKind::NotFound) => Ok(None),
            Err(kind) => Err(Error::io("read", file, &(*kind).into())),
        }
    }

    /// Whether each can let somebody in, and says who that is.
    fn check(&self) -> std::result::Result<(), String> {
        for (index, token) in self.tokens.iter().enumerate() {
            let name = &token.name;
            if self.tokens[..index].iter().any(|before| before.name == *name) {
                return Err(format!("there are two tokens `{name}`, expected one for each holder"));
            }
            let is_digit = |c: char| c.is_ascii_digit() || ('a'..='f').contains(&c);
            if token.sha256.len() != 2 * Sha256::output_size() || !token.sha256.chars().all(is_digit) {
                return Err(format!(
                    "`sha256` of the token `{name}` is none, expected 64 hexadecimal digits"
                ));
            }
        }
        Ok(())
    }

    /// Writes the file whole, readable by its owner only.
    pub fn write(&self, file: &Path) -> Result<()> {
        let text = toml::to_string(self).map_err(Error::of(Code::TokensUnwritable))?;
        let text = format!("# Written by `adit token`. Who holds a token may do what its roles say.\n{text}");
        let next = file.with_extension("toml.new");
        let written = whole::write_beside(&next, text.as_bytes())
            .and_then(|()| private(&next))
            .and_then(|()| whole::replace(file, &next));
        written.map_err(|error| {
            fs::remove_file(&next).ok();
            Error::io("write", file, &error)
        })
    }

    /// A new token for a holder; the text is nowhere else.
    pub fn add(&mut self, name: &str, roles: &[Role]) -> Result<String> {
        if name.trim().is_empty() || name.contains(char::is_control) {
            return Err(Error::said(Code::TokensName, format!("a token cannot be called {name:?}"), None));
        }
        if self.tokens.iter().any(|token| token.name == name) {
            let help = format!("`adit token SITE remove {name}` takes the old one away");
            return Err(Error::said(
                Code::TokensExists,
                format!("there is a token `{name}` already"),
                Some(help),
            ));
        }
        let text = format!("adit_{}", random::<BYTES>()?);
        let mut roles = roles.to_vec();
        roles.sort_unstable();
        roles.dedup();
        self.tokens.push(Token { name: name.to_owned(), roles, sha256: hash(&text) });
        Ok(text)
    }

    /// Takes a holder's token away.
    pub fn remove(&mut self, name: &str) -> Result<()> {
        let before = self.tokens.len();
        self.tokens.retain(|token| token.name != name);
        if self.tokens.len() == before {
            return Err(Error::said(Code::TokensUnknown, format!("there is no token `{name}`"), None));
        }
        Ok(())
    }

    /// Who holds this token. Every one that is kept is compared, in a time that does not tell how much was right.
    pub fn holder(&self, text: &str) -> Option<Caller> {
        let hash = hash(text);
        let mut found = None;
        for token in &self.tokens {
            if bool::from(token.sha256.as_bytes().ct_eq(hash.as_bytes())) {
                found = Some(Caller { name: token.name.clone(), roles: token.roles.clone() });
            }
        }
        found
    }
}

fn hash(text: &str) -> String {
    hex(&Sha256::digest(text.as_bytes()))
}

/// So many random bytes in hexadecimal digits: nobody guesses them.
pub fn random<const COUNT: usize>() -> Result<String> {
    let mut bytes = [0; COUNT];
    getrandom::fill(&mut bytes)
        .map_err(|error| Error::said(Code::TokensRandom, format!("no random numbers: {error}"), None))?;
    Ok(hex(&bytes))
}

/// Bytes in hexadecimal digits.
pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        write!(text, "{byte:02x}").ok();
        text
    })
}

#[cfg(unix)]
fn private(file: &Path) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(file, fs::Permissions::from_mode(0o600))
}

#[cfg(not(unix))]
fn private(_: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_token_is_known_by_its_text_alone_and_only_until_it_is_removed() {
        let mut tokens = Tokens::default();
        let anna = tokens.add("anna", &[Role::Tune]).unwrap();
        tokens.add("dock robot", &[Role::Tell]).unwrap();
        let holder = tokens.holder(&anna).unwrap();
        assert_eq!(holder.name, "anna");
        assert!(holder.may(Role::Tell) && holder.may(Role::Read) && !holder.may(Role::Rules));
        assert!(tokens.holder(&anna[..anna.len() - 1]).is_none());
        assert!(!toml::to_string(&tokens).unwrap().contains(&anna));
        tokens.remove("anna").unwrap();
        assert!(tokens.holder(&anna).is_none());
        assert!(tokens.remove("anna").is_err());
    }
}
