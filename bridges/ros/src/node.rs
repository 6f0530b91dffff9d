//! The node: which topics, services and actions there are, and what each of them does.

use std::sync::Arc;

use adit_site::say;
use anyhow::{Context as _, anyhow};
use ros2_client::action::ActionServerQosPolicies;
use ros2_client::qos::{Durability, History, Reliability, WhenFull};
use ros2_client::{
    ActionServer, ActionTypeName, Context, Message, MessageTypeName, Name, Node, NodeName, NodeOptions,
    Publisher, QosProfile, ServiceMapping, ServiceTypeName, Subscription,
};
use tokio::runtime::Handle;
use tokio::sync::watch;

use crate::actions::{Actions, Ended};
use crate::ears::{Ears, words};
use crate::frames::Frames;
use crate::msgs::{
    Empty, GetPlanRequest, GetPlanResponse, OccupancyGrid, PolygonStamped, PoseStamped, RouteGoal,
    RouteResult, Text, TfMessage, ToPoseGoal, ToPoseResult, TrackFeedback, TrackResult,
};
use crate::planner::Planner;
use crate::presence::Presence;
use crate::{body, keepout, plans, told, track, whereabouts};

/// The settings of the node.
pub struct Settings {
    /// Before all names but those of TF: `/` or `/robot1`.
    pub namespace: String,
    /// How requests are told apart, as the clients' middleware does it.
    pub mapping: ServiceMapping,
    /// For how many seconds a blocked way is closed.
    pub blocked: u32,
}

/// What others say to us over the node.
pub struct Said {
    pub masks: watch::Receiver<Option<Arc<OccupancyGrid>>>,
}

/// What we say over the node.
pub struct Says {
    pub map: Publisher<OccupancyGrid>,
    pub keepout: Publisher<OccupancyGrid>,
    pub action: Publisher<Text>,
    pub footprint: Publisher<PolygonStamped>,
}

/// A node of ROS 2.
pub struct Ros {
    node: Node,
    settings: Settings,
    ears: Ears,
    presence: Arc<Presence>,
    // what it made ends with it
    _context: Context,
}

/// Reliable, so many kept.
fn qos(depth: usize) -> QosProfile {
    QosProfile::publisher_default()
        .reliability(Reliability::Reliable { when_full: WhenFull::DEFAULT })
        .history(History::KeepLast { depth })
}

/// As a latched topic was: who comes later hears the last one.
fn latched() -> QosProfile {
    qos(1).durability(Durability::TransientLocal)
}

impl Ros {
    pub fn new(domain: u16, settings: Settings) -> anyhow::Result<Self> {
        let options = ros2_client::ContextOptions::new().domain_id(domain);
        let context = Context::with_options(options)
            .map_err(|error| anyhow!("DDS does not start in domain {domain}: {}", words(error)))?;
        let name = NodeName::new(&settings.namespace, "adit").map_err(|error| {
            anyhow!("`--namespace {}` is no name in ROS: {}", settings.namespace, words(error))
        })?;
        let options = NodeOptions::new().enable_rosout(false).start_parameter_services(false);
        let mut node = context
            .new_node(name, options)
            .map_err(|error| anyhow!("the node does not start: {}", words(error)))?;
        let spinner = node.spinner().map_err(|error| anyhow!("the node does not start: {}", words(error)))?;
        tokio::spawn(async move {
            if let Err(error) = spinner.spin().await {
                say(&format!("the node no longer hears who else is there: {}", words(error)));
            }
        });
        let presence = Presence::of(&node)?;
        Ok(Self { node, settings, ears: Ears::new()?, presence, _context: context })
    }

    fn name(&self, name: &str) -> anyhow::Result<Name> {
        let full = match name.strip_prefix('/') {
            Some(_) => name.to_owned(),
            None => format!("{}/{name}", self.settings.namespace.trim_end_matches('/')),
        };
        Name::parse(&full).map_err(|error| anyhow!("`{full}` is no name in ROS: {}", words(error)))
    }

    fn subscription<M: Message + 'static>(
        &mut self,
        name: &str,
        kind: [&str; 2],
        qos: &QosProfile,
    ) -> anyhow::Result<Subscription<M>> {
        let full = self.name(name)?;
        let topic = self.node.create_topic(&full, MessageTypeName::new(kind[0], kind[1]), qos);
        let topic = topic.map_err(|error| anyhow!("topic {name}: {}", words(error)))?;
        self.node.create_subscription(&topic, None).map_err(|error| anyhow!("topic {name}: {}", words(error)))
    }

    fn publisher<M: Message>(
        &mut self,
        name: &str,
        kind: [&str; 2],
        qos: &QosProfile,
    ) -> anyhow::Result<Publisher<M>> {
        let full = self.name(name)?;
        let topic = self.node.create_topic(&full, MessageTypeName::new(kind[0], kind[1]), qos);
        let topic = topic.map_err(|error| anyhow!("topic {name}: {}", words(error)))?;
        self.node.create_publisher(&topic, None).map_err(|error| anyhow!("topic {name}: {}", words(error)))
    }

    /// The topics that we say something on.
    pub fn says(&mut self) -> anyhow::Result<Says> {
        Ok(Says {
            map: self.publisher("map", ["nav_msgs", "OccupancyGrid"], &latched())?,
            keepout: self.publisher("adit/keepout_mask", ["nav_msgs", "OccupancyGrid"], &latched())?,
            action: self.publisher("adit/action", ["std_msgs", "String"], &latched())?,
            footprint: self.publisher("adit/footprint", ["geometry_msgs", "PolygonStamped"], &qos(1))?,
        })
    }

    /// Hears topics.
    pub fn hears(&mut self, planner: &Arc<Planner>) -> anyhow::Result<Said> {
        for (name, is_static) in [("/tf", false), ("/tf_static", true)] {
            let qos = if is_static { qos(100).durability(Durability::TransientLocal) } else { qos(100) };
            let qos = if is_static { qos } else { qos.reliability(Reliability::BestEffort) };
            let topic = self.subscription::<TfMessage>(name, ["tf2_msgs", "TFMessage"], &qos)?;
            let frames = Arc::clone(&planner.frames);
            let on = move |message| report(frames.hear(&message, is_static));
            self.ears.topic(topic, name.to_owned(), on)?;
        }
        let poses = qos(1).reliability(Reliability::BestEffort);
        let topic =
            self.subscription::<PoseStamped>("robot_pose", ["geometry_msgs", "PoseStamped"], &poses)?;
        let all = Arc::clone(planner);
        self.ears.topic(topic, "robot_pose".to_owned(), move |pose| {
            match all.frames.on_floor("robot", &pose) {
                Ok(at) => all.is_at(at),
                Err(failure) => say(&format!("robot_pose: {}", failure.words)),
            }
        })?;
        let runtime = Handle::current();
        for (name, kind) in [("adit/close", "close"), ("adit/open", "open")] {
            let topic = self.subscription::<Text>(name, ["std_msgs", "String"], &qos(10))?;
            let (all, runtime) = (Arc::clone(planner), runtime.clone());
            let on = move |what| drop(runtime.spawn(told::closing(Arc::clone(&all), kind, what)));
            self.ears.topic(topic, name.to_owned(), on)?;
        }
        let topic =
            self.subscription::<PoseStamped>("adit/blocked", ["geometry_msgs", "PoseStamped"], &qos(10))?;
        let (all, seconds) = (Arc::clone(planner), self.settings.blocked);
        self.ears.topic(topic, "adit/blocked".to_owned(), move |pose| {
            drop(runtime.spawn(told::blocked(Arc::clone(&all), pose, seconds)));
        })?;
        let (say, masks) = watch::channel(None);
        let topic = self.subscription::<OccupancyGrid>(
            "keepout_filter_mask",
            ["nav_msgs", "OccupancyGrid"],
            &latched(),
        )?;
        let on = move |mask| drop(say.send(Some(Arc::new(mask))));
        self.ears.topic(topic, "keepout_filter_mask".to_owned(), on)?;
        Ok(Said { masks })
    }

    /// Answers requests for plans.
    pub fn answers(&mut self, planner: &Arc<Planner>) -> anyhow::Result<()> {
        let name = self.name("get_plan")?;
        let kind = ServiceTypeName::new("nav_msgs", "GetPlan");
        let service = self
            .node
            .create_server::<GetPlanRequest, GetPlanResponse>(
                self.settings.mapping,
                &name,
                &kind,
                qos(100),
                qos(100),
            )
            .map_err(|error| anyhow!("service get_plan: {}", words(error)))?;
        let (all, runtime, presence) = (Arc::clone(planner), Handle::current(), Arc::clone(&self.presence));
        self.ears.service(service, "get_plan".to_owned(), move |service, id, request| {
            let (service, all, presence) = (Arc::clone(service), Arc::clone(&all), Arc::clone(&presence));
            runtime.spawn(async move {
                let plan = plans::get_plan(&all, &request).await;
                let send = move || {
                    if let Err(error) = service.send_response(id, GetPlanResponse { plan: plan.clone() }) {
                        say(&format!("get_plan: the answer cannot be sent: {}", words(error)));
                    }
                };
                send();
                presence.sent(&id, send);
            });
        })?;
        let all = Arc::clone(planner);
        self.action::<ToPoseGoal, ToPoseResult, Empty, _, _>(
            "compute_path_to_pose",
            "ComputePathToPose",
            move |goal, _| plans::to_pose(Arc::clone(&all), goal),
        )?;
        let all = Arc::clone(planner);
        self.action::<RouteGoal, RouteResult, Empty, _, _>(
            "compute_route",
            "ComputeRoute",
            move |goal, _| plans::route(Arc::clone(&all), goal),
        )?;
        let all = Arc::clone(planner);
        self.action::<RouteGoal, TrackResult, TrackFeedback, _, _>(
            "compute_and_track_route",
            "ComputeAndTrackRoute",
            move |goal, says| track::track(Arc::clone(&all), goal, says),
        )
    }

    fn action<G, R, F, D, W>(&mut self, name: &str, kind: &str, run: D) -> anyhow::Result<()>
    where
        G: Message + Clone + Send + 'static,
        R: Message + Clone + Default + Send + 'static,
        F: Message + std::fmt::Debug + Send + 'static,
        D: Fn(G, crate::actions::Feedback<G, R, F>) -> W + Send + Sync + Clone + 'static,
        W: Future<Output = Ended<R>> + Send + 'static,
        ActionServer<G, R, F>: Send + Sync,
    {
        let full = self.name(name)?;
        let policies = ActionServerQosPolicies {
            goal_service: qos(100),
            result_service: qos(100),
            cancel_service: qos(100),
            feedback_publisher: qos(100),
            status_publisher: latched(),
        };
        let server = self
            .node
            .create_action_server::<G, R, F>(
                self.settings.mapping,
                &full,
                &ActionTypeName::new("nav2_msgs", kind),
                policies,
            )
            .map_err(|error| anyhow!("action {name}: {}", words(error)))?;
        Actions::serve(name, server, (&mut self.ears, Arc::clone(&self.presence)), Handle::current(), run)
    }

    /// Hears from now on, until the program ends.
    pub fn listen(self) -> anyhow::Result<Node> {
        let ears = self.ears;
        std::thread::Builder::new()
            .name("ears".to_owned())
            .spawn(move || ears.listen())
            .context("no thread to hear")?;
        Ok(self.node)
    }

    /// Says action and footprint as the robot goes, and lays masks over the site.
    pub fn goes_along(
        planner: &Arc<Planner>,
        sizes: watch::Receiver<body::Sizes>,
        action: Publisher<Text>,
        footprint: Publisher<PolygonStamped>,
        said: Said,
        masks: keepout::Settings,
    ) {
        tokio::spawn(body::follow(Arc::clone(planner), sizes, action, footprint));
        tokio::spawn(whereabouts::follow(Arc::clone(planner)));
        let frames: Arc<Frames> = Arc::clone(&planner.frames);
        tokio::spawn(keepout::follow(planner.site.clone(), frames, masks, said.masks));
    }
}

fn report(heard: Result<(), String>) {
    if let Err(words) = heard {
        say(&words);
    }
}
