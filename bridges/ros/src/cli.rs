//! The command line.

use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use adit_site::{Site, ended, say};
use clap::{Parser, ValueEnum};
use ros2_client::ServiceMapping;
use tokio::sync::watch;

use crate::frames::Frames;
use crate::node::{self, Ros, Says};
use crate::planner::{self, Planner};
use crate::shown::Shown;
use crate::{body, keepout};

/// A ROS 2 node that plans routes of a site that is served, with the services, actions and topics of Nav2.
///
/// It needs no ROS installation. What it hears of closings and keepout masks is told to the site.
#[derive(Parser, Debug)]
#[command(name = "adit ros", version, max_term_width = 110)]
pub struct Cli {
    /// The served site: `http://HOST:PORT`, as `adit serve` prints it
    site: String,
    /// Whose routes; a site with several robots needs it
    #[arg(long)]
    robot: Option<String>,
    /// What people call the robot; unless said, its namespace, or else whose routes it drives, or `robot`
    #[arg(long)]
    name: Option<String>,
    /// The map's frame
    #[arg(long, default_value = "map")]
    frame: String,
    /// The robot's own frame, where TF says where it is
    #[arg(long, default_value = "base_link")]
    base: String,
    /// What all names begin with, but those of TF
    #[arg(long, default_value = "/")]
    namespace: String,
    /// The DDS domain; or the environment's `ROS_DOMAIN_ID`
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=232))]
    domain: Option<u16>,
    /// The middleware of those that ask: they tell requests apart in different ways
    #[arg(long, value_enum, default_value = "fastrtps")]
    rmw: Rmw,
    /// The `planner_id` of Nav2 that is ours, beside none and the names of the site's robots
    #[arg(long, default_value = "GridBased")]
    planner: String,
    /// Metres by which a start or goal may be moved to where the robot fits, where a request says nothing of it
    #[arg(long, value_name = "METRES", default_value_t = 0.5)]
    tolerance: f64,
    /// Seconds that a plan may take
    #[arg(long, value_name = "SECONDS", default_value_t = 10.0)]
    timeout: f64,
    /// Metres of a cell of the map that is published
    #[arg(long, value_name = "METRES", default_value_t = 0.05)]
    resolution: f64,
    /// The `kind` of areas that are not to be entered: what a keepout mask becomes, and what is published as one
    #[arg(long, default_value = "keep-out")]
    keepout: String,
    /// From which value on a cell of a keepout mask is not to be entered
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(i8).range(1..=100))]
    keepout_from: i8,
    /// Seconds for which a way is closed that is said to be blocked
    #[arg(long, value_name = "SECONDS", default_value_t = 60)]
    blocked: u32,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Rmw {
    /// `rmw_fastrtps_cpp`, the default of ROS 2
    Fastrtps,
    /// `rmw_cyclonedds_cpp`
    Cyclonedds,
}

/// Runs until SIGTERM or Ctrl-C.
pub fn run(cli: Cli) -> ExitCode {
    ended(serve(cli))
}

fn serve(cli: Cli) -> anyhow::Result<()> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    runtime.block_on(async {
        let positive = [("--timeout", cli.timeout, "seconds"), ("--resolution", cli.resolution, "metres")];
        for (name, value, unit) in positive {
            anyhow::ensure!(value.is_finite() && value > 0.0, "`{name}` is {value}; expected {unit} above 0");
        }
        let tolerance = cli.tolerance;
        anyhow::ensure!(
            tolerance.is_finite() && tolerance >= 0.0,
            "`--tolerance` is {tolerance}; expected metres"
        );
        let domain = match (cli.domain, std::env::var("ROS_DOMAIN_ID")) {
            (Some(domain), _) => domain,
            (None, Ok(text)) if !text.is_empty() => {
                text.parse().ok().filter(|domain| *domain <= 232).ok_or_else(|| {
                    anyhow::anyhow!("ROS_DOMAIN_ID is `{text}`; expected a number from 0 to 232")
                })?
            }
            _ => 0,
        };
        let site = Site::at(&cli.site, std::env::var("ADIT_TOKEN").ok())?;
        let answer = site.get("/api/site").await.map_err(|trouble| anyhow::anyhow!("{trouble}"))?;
        let robots: Vec<&str> =
            answer["robots"].as_array().into_iter().flatten().filter_map(|of| of.as_str()).collect();
        if let Some(robot) = &cli.robot {
            let known = robots.join(", ");
            anyhow::ensure!(
                robots.contains(&robot.as_str()),
                "the site has no robot `{robot}`; it has {known}"
            );
        }
        let frames = Arc::new(Frames::new(&cli.frame));
        let namespace = Some(cli.namespace.trim_matches('/')).filter(|namespace| !namespace.is_empty());
        let name = cli.name.or_else(|| namespace.map(str::to_owned)).or_else(|| cli.robot.clone());
        let settings = planner::Settings {
            name: name.unwrap_or_else(|| "robot".to_owned()),
            robot: cli.robot,
            planner: cli.planner,
            base: cli.base,
            tolerance,
            timeout: Duration::try_from_secs_f64(cli.timeout)?,
        };
        let planner = Arc::new(Planner::new(site.clone(), frames, settings));
        let mapping = match cli.rmw {
            Rmw::Fastrtps => ServiceMapping::Enhanced,
            Rmw::Cyclonedds => ServiceMapping::Cyclone,
        };
        let settings = node::Settings { namespace: cli.namespace, mapping, blocked: cli.blocked };
        let mut ros = Ros::new(domain, settings)?;
        let Says { map, keepout, action, footprint } = ros.says()?;
        let said = ros.hears(&planner)?;
        ros.answers(&planner)?;
        let (tell, sizes) = watch::channel(body::Sizes::new());
        let masks = keepout::Settings { kind: cli.keepout.clone(), least: cli.keepout_from };
        Ros::goes_along(&planner, sizes, action, footprint, said, masks);
        let _node = ros.listen()?;
        let shown = Shown { planner, map, keepout, kind: cli.keepout, metres: cli.resolution, tell };
        say(&format!("the node is there, in domain {domain}"));
        let mut term = tokio::signal::unix::signal(tokio::signal::unix::SignalKind::terminate())?;
        tokio::select! {
            () = shown.follow() => {}
            _ = tokio::signal::ctrl_c() => {}
            _ = term.recv() => {}
        }
        Ok(())
    })
}
