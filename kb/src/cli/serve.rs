//! `adit serve` and `adit token`.

use std::net::SocketAddr;
use std::path::PathBuf;
use std::time::Duration;

use adit_db::postgres::Place;
use clap::{Args, Subcommand};

use super::args::SiteArgs;
use super::lsp;
use super::output::{json, line, remark, table};
use crate::error::Result;
use crate::error::problem::Problem;
use crate::serve;
use crate::serve::role::Role;
use crate::serve::settings::Settings;
use crate::serve::token::{self, Tokens};
use crate::site::Site;

#[derive(Args, Debug)]
pub struct ServeArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// The site is in PostgreSQL, as `postgres://USER@HOST/DATABASE?site=NAME`: other services may be on it as well. Its files are put
    /// into the folder; without `site` it is called as the folder is
    #[arg(long, value_name = "URL", env = "ADIT_DATABASE", hide_env_values = true, conflicts_with_all = ["db", "rules"])]
    pub database: Option<String>,
    /// Where to listen; port 0 takes any free one. To be reached from elsewhere the site needs tokens
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1:7373", value_parser = address)]
    pub listen: SocketAddr,
    /// A name besides `localhost` and the address itself by which browsers may call the service
    #[arg(long = "host", value_name = "NAME", value_parser = host)]
    pub hosts: Vec<String>,
    /// Seconds that one SQL query may take
    #[arg(long, value_name = "SECONDS", default_value_t = 1.0, value_parser = seconds)]
    pub sql_seconds: f64,
    /// Rows that one SQL query may give
    #[arg(long, value_name = "ROWS", default_value_t = 100_000)]
    pub sql_rows: usize,
    /// Seconds that an answer may take; an edit that has begun by then is waited for
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, value_parser = seconds)]
    pub answer_seconds: f64,
    /// Requests that are worked on at once; more are told to come back
    #[arg(long, value_name = "N", default_value_t = 1_024, value_parser = some)]
    pub requests: usize,
    /// Streams of events that are open at once
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = some)]
    pub subscribers: usize,
}

/// A time of more than nothing and less than an hour.
fn seconds(text: &str) -> std::result::Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| format!("`{text}` is no number"))?;
    if seconds > 0.0 && seconds < 3600.0 {
        Ok(seconds)
    } else {
        Err("more than 0 and less than 3600 seconds".to_owned())
    }
}

/// One at least.
fn some(text: &str) -> std::result::Result<usize, String> {
    let number: usize = text.parse().map_err(|_| format!("`{text}` is no whole number"))?;
    if number > 0 { Ok(number) } else { Err("1 at least".to_owned()) }
}

/// An address and a port; `localhost` is this machine.
fn address(text: &str) -> std::result::Result<SocketAddr, String> {
    let of_name = text.strip_prefix("localhost:").map(|port| format!("127.0.0.1:{port}"));
    let wanted =
        "an address and a port, as `127.0.0.1:7373`, or `0.0.0.0:7373` for all addresses of this machine";
    of_name.as_deref().unwrap_or(text).parse().map_err(|_| wanted.to_owned())
}

/// A name as it stands in an address, without protocol, port and path.
fn host(text: &str) -> std::result::Result<String, String> {
    if text.is_empty() || text.contains(['/', ' ']) || (text.contains(':') && !text.starts_with('[')) {
        return Err("a name alone, as `robots.example.org`, without protocol, port and path".to_owned());
    }
    Ok(text.to_owned())
}

#[derive(Args, Debug)]
pub struct TokenArgs {
    /// Folder of the site
    pub site: PathBuf,
    /// What to do
    #[command(subcommand)]
    pub verb: TokenVerb,
    /// Print the list as JSON
    #[arg(long)]
    pub json: bool,
}

/// What to do with tokens.
#[derive(Subcommand, Debug)]
pub enum TokenVerb {
    /// Make a token; it is printed this once
    Add {
        /// Who holds it: edits are kept under this name
        name: String,
        /// What the holder may do, besides reading; may stand several times
        #[arg(long = "role", value_enum, default_values = ["read"])]
        roles: Vec<Role>,
    },
    /// Who has a token, and what it allows
    List,
    /// Make a token void
    Remove {
        /// Who holds it
        name: String,
    },
}

/// Serves until the program is told to end.
pub fn run(args: &ServeArgs) -> Result<()> {
    let settings = Settings {
        folder: args.site.site.clone(),
        database: args.site.db.clone(),
        shared: args.database.as_deref().map(Place::parse).transpose()?,
        rules: args.site.rules.clone(),
        listen: args.listen,
        hosts: args.hosts.clone(),
        sql_deadline: Duration::from_secs_f64(args.sql_seconds),
        sql_rows: args.sql_rows,
        patience: Duration::from_secs_f64(args.answer_seconds),
        requests: args.requests,
        subscribers: args.subscribers,
        log: remark,
        complete: lsp::propose,
        classes: lsp::classes,
    };
    let name = match &settings.shared {
        Some(place) => format!("{} in {}", settings.shared_name(place), place.shown()),
        None => settings.open()?.site().name.clone(),
    };
    let again = settings.clone();
    let is_whole = serve::run(settings, |address| {
        line(&format!("listening on http://{address}/"));
        remark(&format!("{name} is served; Ctrl-C ends it"));
    })?;
    if !is_whole {
        let site = again.open()?;
        let database = site.database().display();
        remark(&format!(
            "another program still reads {database}, or the disk is full: a copy needs {database}-wal beside it, until `adit build`"
        ));
    }
    Ok(())
}

pub fn token(args: &TokenArgs) -> Result<()> {
    let folder = Site::open(&args.site)?.folder;
    let file = token::file(&folder);
    let mut tokens = Tokens::read(&file)?.unwrap_or_default();
    match &args.verb {
        TokenVerb::Add { name, roles } => {
            let text = tokens.add(name, roles)?;
            tokens.write(&file)?;
            line(&text);
            remark(&format!("this is the token of `{name}`; it is shown this once"));
        }
        TokenVerb::Remove { name } => {
            tokens.remove(name)?;
            tokens.write(&file)?;
            remark(&format!("the token of `{name}` is void"));
            if tokens.tokens.is_empty() {
                remark("that was the last token");
                for problem in Problem::all(token::none(&file).problems()) {
                    remark(&problem.to_string());
                }
            }
        }
        TokenVerb::List if args.json => {
            let of = |token: &token::Token| serde_json::json!({"name": token.name, "roles": token.roles});
            json(&tokens.tokens.iter().map(of).collect::<Vec<_>>())?;
        }
        TokenVerb::List => {
            let roles = |token: &token::Token| {
                let names = token.roles.iter().map(|role| format!("{role:?}").to_lowercase());
                names.collect::<Vec<_>>().join(", ")
            };
            table(
                &["name", "roles"],
                tokens.tokens.iter().map(|token| vec![token.name.clone(), roles(token)]),
            );
        }
    }
    Ok(())
}
