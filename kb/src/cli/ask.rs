//! `adit ask`.

use std::io::{BufRead, stdin};

use clap::Args;

use super::args::{SiteArgs, author};
use super::build::open;
use super::output::{json, line};
use crate::edit::{Edit, Tell};
use crate::error::{Code, Error, Result};
use crate::live::Live;
use crate::why::ask::{Asked, Said};
use crate::words::number::counted;

#[derive(Args, Debug)]
pub struct AskArgs {
    #[command(flatten)]
    pub site: SiteArgs,
    /// What to find out: class, object and property, as `orders.2.total`
    pub what: String,
    /// An answer given beforehand, as `cars.7.lights=yes`; nothing after the sign: it is not known
    #[arg(long, value_name = "WHAT=VALUE")]
    pub answer: Vec<String>,
    /// Tell the site what was answered
    #[arg(long)]
    pub tell: bool,
    /// When what is told ends: `2026-11-21T18:00`, `18:00` (the next one), `2h`
    #[arg(long, value_name = "TIME", requires = "tell")]
    pub until: Option<String>,
}

/// Asks on until it is settled; `false` where it is not.
pub fn run(args: &AskArgs) -> Result<bool> {
    let mut said = args.answer.iter().map(|text| answer(text)).collect::<Result<Vec<Said>>>()?;
    let mut live = Live::open(open(&args.site)?)?;
    let mut lines = stdin().lock().lines();
    let asked = loop {
        let asked = live.ask(&args.what, &said)?;
        let Some(question) = asked.question.as_ref().filter(|_| !args.site.json) else { break asked };
        line(&format!("{} (nothing: not known)", question.text));
        let Some(Ok(text)) = lines.next() else { break asked };
        let what = question.what.clone();
        let next = Said { what, value: value(&text) };
        said.push(next);
        if let Err(error) = live.ask(&args.what, &said) {
            // what cannot be is said, and asked again
            said.pop();
            super::output::problems(error.problems());
        }
    };
    if args.tell {
        tell(&mut live, (&said, args.until.as_ref()))?;
    }
    let is_known = asked.status == "known";
    if args.site.json {
        json(&asked)?;
        return Ok(is_known);
    }
    show(&asked, &said);
    Ok(is_known)
}

fn show(asked: &Asked, said: &[Said]) {
    let not_known: Vec<&str> =
        said.iter().filter(|said| said.value.is_none()).map(|said| said.what.as_str()).collect();
    match (asked.status, &asked.question) {
        ("known", _) => asked.why.iter().for_each(|why| line(why)),
        (_, Some(question)) => line(&format!("{} is not settled: {}", asked.what, question.text)),
        _ if !not_known.is_empty() => {
            line(&format!("{} is unknown as long as this is: {}", asked.what, not_known.join(", ")));
        }
        _ => {
            line(&format!("{} is unknown, and nothing that can be asked would settle it", asked.what));
            asked.why.iter().for_each(|why| line(why));
        }
    }
    if asked.weighed > 0 {
        line(&format!("rules weighed {} for it", counted(asked.weighed, "object")));
    }
}

fn tell(live: &mut Live, (said, until): (&[Said], Option<&String>)) -> Result<()> {
    for Said { what, value } in said {
        let (Some(value), Some((class, rest))) = (value, what.split_once('.')) else { continue };
        let Some((object, property)) = rest.rsplit_once('.') else { continue };
        let [class, object, property, value] = [class, object, property, value].map(str::to_owned);
        let tell = Tell { class, object, property, value, until: until.cloned(), new_property: true };
        live.edit(&Edit::Tell(tell), &author("answered"))?;
    }
    Ok(())
}

fn answer(text: &str) -> Result<Said> {
    let Some((what, said)) = text.split_once('=') else {
        let help = "say it as `cars.7.lights=yes`".to_owned();
        return Err(Error::said(Code::WhyUnknown, format!("`{text}` is no answer"), Some(help)));
    };
    Ok(Said { what: what.trim().to_owned(), value: value(said) })
}

fn value(text: &str) -> Option<String> {
    let text = text.trim();
    (!["", "?", "unknown"].contains(&text)).then(|| text.to_owned())
}
