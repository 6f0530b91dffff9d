//! `adit serve` and `adit token`.

use std::time::Duration;

use super::output::{json, line, remark, table};
use super::{ServeArgs, TokenArgs, TokenVerb};
use crate::error::Result;
use crate::error::problem::Problem;
use crate::serve;
use crate::serve::settings::Settings;
use crate::serve::token::{self, Tokens};
use crate::site::Site;

/// Serves until the program is told to end.
pub fn run(args: &ServeArgs) -> Result<()> {
    let settings = Settings {
        folder: args.site.site.clone(),
        database: args.site.db.clone(),
        rules: args.site.rules.clone(),
        listen: args.listen,
        hosts: args.hosts.clone(),
        sql_deadline: Duration::from_secs_f64(args.sql_seconds),
        sql_rows: args.sql_rows,
        patience: Duration::from_secs_f64(args.answer_seconds),
        requests: args.requests,
        subscribers: args.subscribers,
        log: remark,
    };
    let site = settings.open()?;
    let name = &site.site().name;
    let is_whole = serve::run(settings, |address| {
        line(&format!("listening on http://{address}/"));
        remark(&format!("{name} is served; Ctrl-C ends it"));
    })?;
    if !is_whole {
        let database = site.database().display();
        remark(&format!(
            "another program still reads {database}: a copy needs {database}-wal beside it, until `adit build`"
        ));
    }
    Ok(())
}

/// Adds, lists or removes tokens.
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
