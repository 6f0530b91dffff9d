//! What the tests stand on: a network of their own, a served site, the node, and clients of rclpy.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use adit_tests::service::Service;
use adit_tests::{TestSite, adit, within};
use serde_json::{Value, json};
use tempfile::NamedTempFile;

/// How long anything may take.
const PATIENCE: Duration = Duration::from_secs(40);

/// Says to a test that it runs in a network of its own.
const INSIDE: &str = "ADIT_TEST_NETWORK";

/// Runs this test again in a network that has nothing but `lo`, since DDS multicasts; true for who is not in it.
#[must_use]
pub fn is_outside(test: &str) -> bool {
    if std::env::var_os(INSIDE).is_some() {
        return false;
    }
    adit();
    let is_root = fs::metadata("/proc/self").is_ok_and(|of| std::os::unix::fs::MetadataExt::uid(&of) == 0);
    let up = "ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo && exec \"$0\" \"$@\"";
    let mut again = Command::new("unshare");
    again.arg(if is_root { "-n" } else { "-rn" }).args(["sh", "-c", up]);
    again.arg(std::env::current_exe().unwrap()).args(["--exact", test, "--nocapture"]).env(INSIDE, "1");
    assert!(again.status().expect("unshare and ip are installed").success(), "see above");
    true
}

/// A program that ends with its handle.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A served site with its node.
pub struct Floor {
    node: Running,
    log: NamedTempFile,
    pub service: Service,
    pub site: TestSite,
}

impl Floor {
    /// An example, with the node beside it.
    pub fn start(example: &str, settings: &[&str]) -> Self {
        let site = TestSite::example(example).built();
        let service = Service::start(&site);
        let log = NamedTempFile::new().unwrap();
        assert!(PathBuf::from(env!("CARGO_BIN_EXE_adit-ros")).with_file_name("adit") == adit());
        let mut program = Command::new(adit());
        let url = format!("http://{}", service.address);
        program.args(["ros", &url]).args(settings).stderr(log.reopen().unwrap());
        let floor = Self { node: Running(program.spawn().unwrap()), log, service, site };
        within("the node is there", || floor.log().contains("the node is there").then_some(()));
        floor
    }

    /// What the node said.
    pub fn log(&self) -> String {
        fs::read_to_string(self.log.path()).unwrap()
    }

    /// Waits until the node has said this.
    #[track_caller]
    pub fn says(&self, words: &str) {
        within(words, || self.log().contains(words).then_some(()));
    }

    pub fn pid(&self) -> u32 {
        self.node.0.id()
    }

    /// What `adit route --json` prints.
    pub fn route(&self, start: &str, goal: &str) -> Value {
        let ran = Command::new(adit())
            .arg("route")
            .arg(self.site.path())
            .args([start, goal, "--json"])
            .output()
            .unwrap();
        serde_json::from_slice(&ran.stdout).unwrap()
    }

    /// The waypoints of the route that `adit route --json` prints.
    pub fn waypoints(&self, start: &str, goal: &str) -> Vec<[f64; 2]> {
        let route = self.route(start, goal);
        let points = route["waypoints"].as_array().unwrap();
        points.iter().map(|point| [&point["x"], &point["y"]].map(|v| v.as_f64().unwrap())).collect()
    }

    /// Closes all doorways of the dock.
    pub fn close_dock(&self) {
        let map = self.service.ask("GET", "/api/map", None).1;
        let all = map["doorways"].as_array().unwrap();
        for doorway in all.iter().filter(|of| of["spaces"].as_array().unwrap().contains(&json!(1))) {
            self.edit(&json!({"kind": "close", "what": format!("doorway {}", doorway["doorway"])}));
        }
    }

    /// Makes an edit.
    pub fn edit(&self, edit: &Value) {
        let answer = self.service.ask("POST", "/api/edits", Some(&json!({"edit": edit})));
        assert_eq!(answer.0, 200, "{answer:?}");
    }
}

impl Drop for Floor {
    fn drop(&mut self) {
        if std::thread::panicking() {
            eprintln!("the node said:\n{}", self.log());
        }
    }
}

/// A client of rclpy.
pub struct Client {
    _running: Running,
    orders: ChildStdin,
    heard: Receiver<Value>,
    /// What was heard and not asked for yet.
    kept: Vec<Value>,
    count: u64,
}

impl Client {
    pub fn start(name: &str) -> Self {
        Self::several(name, 1)
    }

    /// So many nodes in one program, among which orders go round.
    pub fn several(name: &str, nodes: usize) -> Self {
        let script = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/ros/client.py");
        let mut program = Command::new(python());
        program
            .arg(script)
            .args([name, &nodes.to_string()])
            .env("RMW_IMPLEMENTATION", "rmw_fastrtps_cpp")
            .env("ROS_LOG_DIR", std::env::temp_dir());
        let mut child = program.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let (orders, out) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
        let (say, heard) = channel();
        std::thread::spawn(move || {
            for line in BufReader::new(out).lines().map_while(Result::ok) {
                if serde_json::from_str(&line).is_ok_and(|value: Value| say.send(value).is_err()) {
                    return;
                }
            }
        });
        let mut client = Self { _running: Running(child), orders, heard, kept: Vec::new(), count: 0 };
        client.until("rclpy is there", |said| said["is"] == "there");
        client
    }

    /// Orders something; the number under which it is answered.
    pub fn order(&mut self, what: &str, name: &str, kind: &str, message: &Value) -> u64 {
        self.tell(json!({"do": what, "name": name, "type": kind, "message": message}))
    }

    /// Hears a topic that is latched, or publishes on one.
    pub fn latched(&mut self, what: &str, name: &str, kind: &str, message: &Value) {
        self.tell(json!({"do": what, "name": name, "type": kind, "message": message, "latched": true}));
    }

    /// Publishes bytes that are nearly such a message, so many times.
    pub fn noise(
        &mut self,
        (name, kind): (&str, &str),
        message: &Value,
        (seed, count): (u64, u32),
        latched: bool,
    ) {
        let id = self
            .tell(json!({"do": "noise", "name": name, "type": kind, "message": message, "seed": seed,
            "count": count, "latched": latched}));
        self.until("all is published", |said| said["id"] == id && said["published"] == count);
    }

    pub fn cancel(&mut self, goal: u64) -> Value {
        let id = self.tell(json!({"do": "cancel", "goal": goal}));
        self.until("cancelled", |said| said["id"] == id)
    }

    fn tell(&mut self, mut order: Value) -> u64 {
        self.count += 1;
        order["id"] = self.count.into();
        writeln!(self.orders, "{order}").unwrap();
        self.count
    }

    /// Waits for something; what else is heard meanwhile is kept.
    #[track_caller]
    pub fn until(&mut self, what: &str, is: impl Fn(&Value) -> bool) -> Value {
        if let Some(index) = self.kept.iter().position(&is) {
            return self.kept.remove(index);
        }
        let began = Instant::now();
        while let Some(left) = PATIENCE.checked_sub(began.elapsed()) {
            let Ok(said) = self.heard.recv_timeout(left) else { break };
            assert!(said["error"].is_null(), "rclpy: {said}");
            if is(&said) {
                return said;
            }
            self.kept.push(said);
        }
        panic!("{what}: not in time; heard were {:#?}", self.kept);
    }

    /// What was heard already, if it was.
    pub fn heard(&mut self, is: impl Fn(&Value) -> bool) -> Option<Value> {
        while let Ok(said) = self.heard.try_recv() {
            assert!(said["error"].is_null(), "rclpy: {said}");
            self.kept.push(said);
        }
        let index = self.kept.iter().position(is)?;
        Some(self.kept.remove(index))
    }

    /// Asks for a plan.
    #[track_caller]
    pub fn plan(&mut self, request: &Value) -> Value {
        let id = self.order("call", "/get_plan", "nav_msgs/srv/GetPlan", request);
        self.until("a plan", |said| said["id"] == id)["response"]["plan"].clone()
    }

    /// Sends a goal, and waits for how it ends.
    #[track_caller]
    pub fn goal(&mut self, action: &str, goal: &Value) -> Value {
        let id = self.begin(action, goal);
        self.until("a result", |said| said["id"] == id && !said["status"].is_null())
    }

    /// Sends a goal that is accepted.
    #[track_caller]
    pub fn begin(&mut self, action: &str, goal: &Value) -> u64 {
        let kinds = [
            ("/compute_path_to_pose", "nav2_msgs/action/ComputePathToPose"),
            ("/compute_route", "nav2_msgs/action/ComputeRoute"),
            ("/compute_and_track_route", "nav2_msgs/action/ComputeAndTrackRoute"),
        ];
        let kind = kinds.iter().find(|(name, _)| *name == action).unwrap().1;
        let id = self.order("goal", action, kind, goal);
        let said = self.until("accepted", |said| said["id"] == id && !said["accepted"].is_null());
        assert_eq!(said["accepted"], true);
        id
    }
}

/// A pose in the map's frame.
pub fn pose(x: f64, y: f64) -> Value {
    pose_in("map", x, y)
}

pub fn pose_in(frame: &str, x: f64, y: f64) -> Value {
    json!({"header": {"frame_id": frame}, "pose": {"position": {"x": x, "y": y}, "orientation": {"w": 1.0}}})
}

/// The points of a path.
pub fn points(path: &Value) -> Vec<[f64; 2]> {
    let poses = path["poses"].as_array().unwrap();
    poses
        .iter()
        .map(|of| [&of["pose"]["position"]["x"], &of["pose"]["position"]["y"]].map(|v| v.as_f64().unwrap()))
        .collect()
}

/// Where `tests/run` put rclpy.
fn python() -> PathBuf {
    let exe = std::env::current_exe().unwrap();
    let folder = exe.ancestors().nth(3).unwrap().join("ros2");
    let python = folder.join("bin/python");
    assert!(
        folder.join("done").exists(),
        "bridges/ros/tests/ros/install.sh {} installs rclpy",
        folder.display()
    );
    python
}
