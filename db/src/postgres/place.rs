//! Where a site is in PostgreSQL: `postgres://USER@HOST/DATABASE?site=NAME`.

use std::str::FromStr;
use std::time::Duration;

use sqlx::ConnectOptions;
use sqlx::postgres::PgConnectOptions;

use crate::error::Result;
use crate::failure::Failure;

/// How a URL of PostgreSQL begins.
const SCHEMES: [&str; 2] = ["postgres://", "postgresql://"];

/// What may stand behind the question mark besides `site` and the [files](FILES), as libpq has it.
const PARAMETERS: [&str; 9] =
    ["application_name", "dbname", "host", "hostaddr", "options", "password", "port", "sslmode", "user"];

/// Those that name files: whom to trust, and how to show who one is.
const FILES: [&str; 3] = ["sslrootcert", "sslcert", "sslkey"];

/// The longest name of a site, bytes.
const NAME: usize = 200;

/// A database of PostgreSQL, and a site in it.
#[derive(Clone)]
pub struct Place {
    pub(super) options: PgConnectOptions,
    /// The site that `?site=` names.
    site: Option<String>,
}

impl Place {
    /// Whether a text is meant as a place in PostgreSQL, and not as a folder.
    pub fn is_meant(text: &str) -> bool {
        SCHEMES.iter().any(|scheme| text.starts_with(scheme))
    }

    /// Reads a URL.
    pub fn parse(text: &str) -> Result<Self> {
        let refused = |reason: &str| Failure::Url(reason.to_owned());
        if !Self::is_meant(text) {
            return Err(refused("one begins with `postgres://`").into());
        }
        let (address, query) = text.split_once('?').unwrap_or((text, ""));
        let mut site = None;
        let mut rest = Vec::new();
        for part in query.split('&').filter(|part| !part.is_empty()) {
            let (name, value) = part.split_once('=').unwrap_or((part, ""));
            let value =
                decoded(&value.replace('+', " ")).ok_or_else(|| refused(&format!("`{name}` is no text")))?;
            match name {
                "site" => {
                    site = Some(value);
                    continue;
                }
                name if FILES.contains(&name) => std::fs::read(&value)
                    .map(drop)
                    .map_err(|error| refused(&format!("the file `{value}` that `{name}` names: {error}")))?,
                name if PARAMETERS.contains(&name) => {}
                // who mistypes `sslmode` would get a connection that is not safe
                name => {
                    let known = [&["site"][..], &PARAMETERS, &FILES].concat().join(", ");
                    return Err(refused(&format!("it has no `{name}`; there are {known}")).into());
                }
            }
            rest.push(part);
        }
        if site.as_deref().is_some_and(|name| name.is_empty() || name.len() > NAME || name.contains('\0')) {
            return Err(refused("the site's name is empty, or longer than 200 bytes").into());
        }
        let address =
            if rest.is_empty() { address.to_owned() } else { format!("{address}?{}", rest.join("&")) };
        // what sqlx says of a URL may hold its password
        let options = PgConnectOptions::from_str(&address).map_err(|_| {
            refused("it is written as `postgres://USER:PASSWORD@HOST:PORT/DATABASE?site=NAME`")
        })?;
        let options = options.application_name("adit").disable_statement_logging();
        Ok(Self { options, site })
    }

    /// The site that the URL names; `otherwise` where it names none.
    pub fn site_or(&self, otherwise: &str) -> String {
        self.site.clone().unwrap_or_else(|| otherwise.to_owned())
    }

    /// The site that the URL names.
    pub fn site(&self) -> Option<&str> {
        self.site.as_deref()
    }

    /// Where it is, as people may read it: without a password.
    pub fn shown(&self) -> String {
        let database = self.options.get_database().unwrap_or(self.options.get_username());
        match self.options.get_socket() {
            Some(socket) => format!("{database} at {}", socket.display()),
            None => format!("{database} at {}:{}", self.options.get_host(), self.options.get_port()),
        }
    }
}

impl std::fmt::Debug for Place {
    /// Without a password.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?} of {}", self.site, self.shown())
    }
}

/// How long a connection is waited for.
pub(super) const CONNECTING: Duration = Duration::from_secs(4);

/// A text in which `%41` is `A`; `None` where that is no UTF-8.
fn decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::new();
    let mut rest = text.as_bytes();
    while let Some((first, after)) = rest.split_first() {
        rest = after;
        let hex = after.get(..2).and_then(|digits| std::str::from_utf8(digits).ok());
        match hex.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) if *first == b'%' => {
                bytes.push(byte);
                rest = &after[2..];
            }
            _ => bytes.push(*first),
        }
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_site_is_taken_out_of_the_url_and_a_password_is_not_shown() {
        let place =
            Place::parse("postgres://u:secret@127.0.0.1:6543/plant?site=hall%203&sslmode=disable").unwrap();
        assert_eq!(place.site(), Some("hall 3"));
        assert_eq!(place.shown(), "plant at 127.0.0.1:6543");
        assert_eq!(Place::parse("postgres:///plant?host=/run/pg").unwrap().shown(), "plant at /run/pg");
        for bad in ["mysql://x/y", "postgres://h/d?site=", "postgres://h:port/d", "postgres://h/d?site=%ff"] {
            assert!(Place::parse(bad).is_err(), "{bad}");
        }
        for (bad, said) in [
            ("postgres://h/d?sslmod=require", "`sslmod`"),
            ("postgres://h/d?sslrootcert=/no/such.pem&sslmode=verify-full", "`/no/such.pem`"),
        ] {
            assert!(Place::parse(bad).unwrap_err().to_string().contains(said), "{bad}");
        }
    }
}
