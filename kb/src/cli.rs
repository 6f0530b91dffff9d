//! The command line `adit`: its verbs, and what they print.

mod args;
mod ask;
mod beside;
mod body;
mod build;
mod close;
mod copy;
mod curve;
mod demo;
mod doctor;
mod drive;
mod experiment;
mod export;
mod firm;
mod fit;
mod kept;
mod lay;
mod layer;
mod learn;
mod lsp;
mod missions;
mod new;
mod output;
mod pages;
mod picture;
mod route;
mod routed;
mod rules;
mod serve;
mod simulate;
mod sql;
mod table;
mod tasks;
mod tell;
mod test;
mod tune;
mod tuning;
mod upgrade;
mod watch;
mod why;

use std::process::ExitCode;

use args::{SiteArgs, WayArgs};
use clap::{CommandFactory, Parser, Subcommand};

/// A rule engine and knowledge base that tells a mobile robot which way to go and how to move.
#[derive(Parser, Debug)]
#[command(name = "adit", version, arg_required_else_help = true, max_term_width = 110)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

#[derive(Subcommand, Debug)]
pub enum Verb {
    /// Build the bundled examples, show rooms, routes and a picture, and say what to try next
    Demo(demo::DemoArgs),
    /// Start a site: map, robot table, and a place for rules of its own
    New(new::NewArgs),
    /// Map, facts, rules, routes: into the site's database
    Build(build::BuildArgs),
    /// The action sequence from START to GOAL: a place, a space, a room, or `x,y` in metres
    Route(route::RouteArgs),
    /// Edit one cell of a table as a transaction, and show what changes
    Tune(tune::TuneArgs),
    /// A table as a file (CSV, XLSX): written for a spreadsheet, and read back as one edit
    Table(table::TableArgs),
    /// Tell a fact about one object, with an end if it has one; list and retract what was told
    Tell(tell::TellArgs),
    /// Let nobody pass a doorway, a space, an area, a named door, or the place where a robot was blocked
    Close(close::CloseArgs),
    /// Let everybody pass again what was closed
    Open(close::OpenArgs),
    /// Lay an area or an obstacle over the map, until it is lifted
    Lay(lay::LayArgs),
    /// Take away what was laid over the map
    Lift(lay::LiftArgs),
    /// Named sets of edits: list, set, switch on and off, preview, compare
    Tuning(tuning::TuningArgs),
    /// Lint rules, tables and map without building
    Check(SiteArgs),
    /// The rules that count, by the rule bases that lie over each other; the text of one of them
    Rules(rules::RulesArgs),
    /// Run the tests of the site's rules
    Test(SiteArgs),
    /// Check, test and build on each save of a rule, the map or a table, until Ctrl-C
    Watch(SiteArgs),
    /// What a value is; what rules lack to conclude it is asked, question by question
    Ask(ask::AskArgs),
    /// Why something is as it is: the rule and the facts behind it; or why a route does what it does
    Why(why::WhyArgs),
    /// Why the route does not lead through something: what that would cost, what decides, and which number would turn it
    WhyNot(why::WhyNotArgs),
    /// How firm a route is: how far each hardness may change before another way is the best
    Firm(WayArgs),
    /// The hardness that fits best what robots measured on their way
    Fit(fit::FitArgs),
    /// A read-only SQL query on the site, or a small shell without QUERY
    Sql(sql::SqlArgs),
    /// A layer of the site (rooms, spaces, doorways, areas, routes) as GeoJSON; its lane graph for Open-RMF, Nav2 or LIF
    Export(export::ExportArgs),
    /// Draw the map with rooms, doors, hardness and a route, as SVG or PNG
    Draw(picture::DrawArgs),
    /// Tasks of a robot in a cell, one after the other: it learns from each for the next, and keeps what it learns
    Tasks(tasks::TasksArgs),
    /// Missions of a simulated robot on a floor plan or on the routes of a site, with obstacles that it does not know
    Simulate(args::SimulateArgs),
    /// A mission of a robot that is heard by lines of JSON, on the routes of a site
    Drive(drive::DriveArgs),
    /// Our simulated robot on a site, as such a robot: it answers lines of JSON
    Body(body::BodyArgs),
    /// Whether a robot that answers lines of JSON does what the protocol asks, check by check
    Conform(body::ConformArgs),
    /// A scenario of a robot that learns, over many seeds: what each strategy of repair costs (CSV, picture)
    Experiment(experiment::ExperimentArgs),
    /// Who changed what, when and why
    History(tune::HistoryArgs),
    /// Take back the last edit, or edit N of the history
    Undo(tune::UndoArgs),
    /// Serve the site: HTTP, live events, and the page where experts tune it
    Serve(serve::ServeArgs),
    /// Copy a site, with its whole history, into PostgreSQL or out of it
    Copy(copy::CopyArgs),
    /// Bring the sites in a database of PostgreSQL up to this program's version
    Upgrade(upgrade::UpgradeArgs),
    /// Vehicles that speak VDA 5050 drive the routes of a served site (the program `adit-fleet`)
    Fleet(beside::BesideArgs),
    /// A ROS 2 node that plans routes of a served site, as Nav2's planner and route server do (the program `adit-ros`)
    Ros(beside::BesideArgs),
    /// What editors show while one writes rules, their tests and site files (Language Server Protocol)
    Lsp(lsp::LspArgs),
    /// Who may do what by HTTP: add, list and remove tokens
    Token(serve::TokenArgs),
    /// Integrity, versions, backup
    Doctor(doctor::DoctorArgs),
    /// Words that a shell completes: for bash, zsh, fish, elvish or PowerShell, printed
    Completions(pages::CompletionsArgs),
    /// Pages for `man`, one for each verb, into a folder
    Man(pages::ManArgs),
}

/// Runs a verb and prints what came of it.
///
/// # Returns
/// 0 done, 1 no route or a failed check, 2 unusable input.
pub fn run(cli: &Cli) -> ExitCode {
    let (as_json, outcome) = match &cli.verb {
        Verb::Demo(args) => (args.json, demo::run(args).map(|()| 0)),
        Verb::New(args) => (args.json, new::run(args).map(|()| 0)),
        Verb::Build(args) => (args.site.json, build::run(args).map(|()| 0)),
        Verb::Route(args) => (args.way.site.json, route::run(args)),
        Verb::Tune(args) => (args.site.json, tune::tune(args).map(|()| 0)),
        Verb::Table(args) => (args.site.json, table::run(args).map(|()| 0)),
        Verb::Tell(args) => (args.site.json, tell::run(args).map(|()| 0)),
        Verb::Close(args) => (args.site.json, close::close(args).map(|()| 0)),
        Verb::Open(args) => (args.site.json, close::open(args).map(|()| 0)),
        Verb::Lay(args) => (args.site.json, lay::lay(args).map(|()| 0)),
        Verb::Lift(args) => (args.site.json, lay::lift(args).map(|()| 0)),
        Verb::Tuning(args) => (args.site.json, tuning::run(args).map(|()| 0)),
        Verb::Check(args) => (args.json, doctor::check(args).map(|sound| u8::from(!sound))),
        Verb::Rules(args) => (args.site.json, rules::run(args).map(|()| 0)),
        Verb::Test(args) => (args.json, test::run(args).map(|passed| u8::from(!passed))),
        Verb::Watch(args) => (args.json, watch::run(args).map(|()| 0)),
        Verb::Ask(args) => (args.site.json, ask::run(args).map(|known| u8::from(!known))),
        Verb::Why(args) => (args.site.json, why::why(args).map(|()| 0)),
        Verb::WhyNot(args) => (args.way.site.json, why::why_not(args).map(|()| 0)),
        Verb::Firm(args) => (args.site.json, firm::run(args).map(|()| 0)),
        Verb::Fit(args) => (args.site.json, fit::run(args).map(|()| 0)),
        Verb::Sql(args) => (args.site.json, sql::run(args).map(|well| if well { 0 } else { 2 })),
        Verb::Export(args) => (args.site.json, export::run(args).map(|()| 0)),
        Verb::Draw(args) => (args.site.json, picture::run(args).map(|()| 0)),
        Verb::Tasks(args) => (args.json, tasks::run(args).map(|found| u8::from(!found))),
        Verb::Simulate(args) => (args.json, simulate::run(args).map(|right| u8::from(!right))),
        Verb::Drive(args) => (args.json, drive::run(args).map(|arrived| u8::from(!arrived))),
        Verb::Body(args) => (false, body::body(args).map(|()| 0)),
        Verb::Conform(args) => (args.json, body::conform(args).map(|held| u8::from(!held))),
        Verb::Experiment(args) => (args.json, experiment::run(args).map(|found| u8::from(!found))),
        Verb::History(args) => (args.site.json, tune::history(args).map(|()| 0)),
        Verb::Undo(args) => (args.site.json, tune::undo(args).map(|()| 0)),
        Verb::Serve(args) => (args.site.json, serve::run(args).map(|()| 0)),
        Verb::Copy(args) => (args.json, copy::run(args).map(|()| 0)),
        Verb::Upgrade(args) => (args.json, upgrade::run(args).map(|()| 0)),
        Verb::Fleet(args) => (false, beside::run("fleet", args)),
        Verb::Ros(args) => (false, beside::run("ros", args)),
        Verb::Lsp(args) => (false, lsp::run(args).map(|()| 0)),
        Verb::Token(args) => (args.json, serve::token(args).map(|()| 0)),
        Verb::Doctor(args) => (args.site.json, doctor::doctor(args).map(|sound| u8::from(!sound))),
        Verb::Completions(args) => {
            pages::completions(args, Cli::command());
            (false, Ok(0))
        }
        Verb::Man(args) => (false, pages::man(args, Cli::command()).map(|()| 0)),
    };
    match outcome {
        Ok(_) if output::is_lost() => ExitCode::from(2),
        Ok(status) => ExitCode::from(status),
        Err(error) => {
            if as_json {
                output::line(&serde_json::json!({"error": output::as_json(error.problems())}).to_string());
            }
            output::problems(error.problems());
            ExitCode::from(error.exit())
        }
    }
}
