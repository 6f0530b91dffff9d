//! The command line.

use std::process::ExitCode;

use adit_site::ended;
use clap::Parser;
use rumqttc::AsyncClient;
use tokio::sync::mpsc::unbounded_channel;

use crate::broker;
use crate::fleet::{Fleet, Settings};
use crate::site::Site;
use crate::way::Margins;

/// Vehicles that speak VDA 5050 (2.0, 2.1, 3.0) drive the routes of a site that is served.
///
/// Which vehicles there are, and where each is to go, stands in the site's table `vehicles`; what they report is told to the site.
#[derive(Parser, Debug)]
#[command(name = "adit fleet", version, max_term_width = 110)]
pub struct Cli {
    /// The served site: `http://HOST:PORT`, as `adit serve` prints it
    site: String,
    /// The broker: `mqtt://[USER[:PASSWORD]@]HOST[:PORT]`; or the environment's `ADIT_MQTT`
    #[arg(long, value_name = "URL")]
    mqtt: Option<String>,
    /// The first part of all topics
    #[arg(long, default_value = "uagv")]
    interface: String,
    /// How vehicles call the map, unless their rows say otherwise; the name of the site where nothing is said
    #[arg(long)]
    map: Option<String>,
    /// Metres before a doorway at which a vehicle waits until it is let through, beside half its width
    #[arg(long, default_value_t = 0.3)]
    before: f64,
    /// Metres before such a point at which it is let through already, so that it need not stop
    #[arg(long, default_value_t = 3.0)]
    ahead: f64,
    /// The name under which the broker knows this program
    #[arg(long, default_value = "adit-fleet")]
    client: String,
}

/// Runs until SIGTERM or Ctrl-C.
pub fn run(cli: Cli) -> ExitCode {
    ended(serve(cli))
}

fn serve(cli: Cli) -> anyhow::Result<()> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    runtime.block_on(async {
        let site = Site::at(&cli.site, std::env::var("ADIT_TOKEN").ok())?;
        let url = cli.mqtt.or_else(|| std::env::var("ADIT_MQTT").ok());
        let url = url.ok_or_else(|| anyhow::anyhow!("which broker? say `--mqtt mqtt://HOST:PORT`"))?;
        let metres = [("--before", cli.before), ("--ahead", cli.ahead)];
        for (name, value) in metres {
            anyhow::ensure!(value.is_finite() && value >= 0.0, "`{name}` is {value}; expected metres");
        }
        broker::expect_topic(&cli.interface)?;
        let name = site.get("/api/site").await.map_err(|trouble| anyhow::anyhow!("{trouble}"))?;
        let map = cli.map.or_else(|| name["name"].as_str().map(str::to_owned));
        let map = map.unwrap_or_else(|| "map".to_owned());
        let margins = Margins { before: cli.before, ahead: cli.ahead };
        let (client, events) = AsyncClient::new(broker::options(&url, &cli.client)?, 1024);
        let (heard, hears) = unbounded_channel();
        let settings = Settings { interface: cli.interface, map, margins };
        let broker = broker::hear(client.clone(), events, settings.interface.clone(), heard.clone());
        let fleet = Fleet::new(site, client.clone(), settings, heard);
        let mut term = tokio::signal::unix::signal(tokio::signal::unix::SignalKind::terminate())?;
        let end = async {
            tokio::select! {
                _ = tokio::signal::ctrl_c() => {}
                _ = term.recv() => {}
            }
        };
        tokio::select! {
            () = broker => {}
            () = fleet.run(hears, end) => {}
        }
        let _ = client.try_disconnect();
        Ok(())
    })
}
