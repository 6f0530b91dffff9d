//! What the tests drive: a broker, a served depot, vehicles that others wrote, and the fleet program between them.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::net::{TcpListener, TcpStream};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use adit_tests::service::Service;
use adit_tests::{TestSite, adit, within};
use serde_json::{Value, json};
use tempfile::NamedTempFile;

/// How long anything may take.
const PATIENCE: Duration = Duration::from_secs(40);

/// A program that ends with its handle.
pub struct Running(pub Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A broker on a port of its own.
pub struct Broker {
    pub port: u16,
    running: Option<Running>,
}

impl Broker {
    pub fn start() -> Self {
        let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let mut broker = Self { port, running: None };
        broker.again();
        broker
    }

    /// Kills it, as a power cut would.
    pub fn kill(&mut self) {
        self.running = None;
    }

    pub fn again(&mut self) {
        let mut program = Command::new(mosquitto());
        program.args(["-p", &self.port.to_string()]).stdout(Stdio::null()).stderr(Stdio::null());
        self.running =
            Some(Running(program.spawn().expect("mosquitto is installed (tests/run installs it)")));
        within("the broker listens", || TcpStream::connect(("127.0.0.1", self.port)).ok());
    }

    pub fn url(&self) -> String {
        format!("mqtt://127.0.0.1:{}", self.port)
    }

    /// A connection that hears these topics, and may say anything.
    pub fn client(&self, topics: &[&str]) -> (rumqttc::Client, Receiver<(String, Value)>) {
        let mut options =
            rumqttc::MqttOptions::new(format!("test {:?}", Instant::now()), "127.0.0.1", self.port);
        options.set_max_packet_size(1 << 24, 1 << 24);
        let (client, mut connection) = rumqttc::Client::new(options, 1000);
        for topic in topics {
            client.subscribe(*topic, rumqttc::QoS::AtLeastOnce).unwrap();
        }
        let (say, heard) = channel();
        std::thread::spawn(move || {
            for event in connection.iter() {
                let Ok(rumqttc::Event::Incoming(rumqttc::Packet::Publish(message))) = event else {
                    if event.is_err() {
                        std::thread::sleep(Duration::from_millis(100));
                    }
                    continue;
                };
                let value = serde_json::from_slice(&message.payload).unwrap_or_default();
                if say.send((message.topic, value)).is_err() {
                    return;
                }
            }
        });
        (client, heard)
    }
}

fn mosquitto() -> PathBuf {
    let debian = PathBuf::from("/usr/sbin/mosquitto");
    if debian.exists() { debian } else { PathBuf::from("mosquitto") }
}

/// The depot with vehicles, served.
pub fn depot(vehicles: &str, rules: &str) -> (TestSite, Service) {
    let site = TestSite::example("depot");
    for folder in ["tables", "rules"] {
        fs::create_dir_all(site.path().join(folder)).unwrap();
    }
    site.write("tables/vehicles.csv", vehicles);
    // as fast as each vehicle drives, so that tests need not wait, and for rules to say
    let robots = site.read("robots.toml");
    let robots: Vec<&str> = robots.lines().filter(|line| !line.starts_with("speed")).collect();
    site.write("robots.toml", robots.join("\n"));
    if !rules.is_empty() {
        site.write("rules/own.rhai", rules);
    }
    let site = site.built();
    let service = Service::start(&site);
    (site, service)
}

/// The fleet program.
pub struct FleetProgram {
    running: Running,
    log: NamedTempFile,
}

impl FleetProgram {
    pub fn start(service: &Service, broker: &Broker) -> Self {
        let log = NamedTempFile::new().unwrap();
        let site = format!("http://{}", service.address);
        assert!(PathBuf::from(env!("CARGO_BIN_EXE_adit-fleet")).with_file_name("adit") == adit());
        let mut program = Command::new(adit());
        program.args(["fleet", &site, "--mqtt", &broker.url()]).stderr(log.reopen().unwrap());
        Self { running: Running(program.spawn().unwrap()), log }
    }

    /// Whether it is on the broker, and knows this vehicle.
    pub fn hears(&self, vehicle: &str) -> bool {
        let log = self.log();
        log.contains("the broker is there") && log.contains(&format!("vehicle {vehicle}: "))
    }

    /// Ends it as a service manager does, and waits until it has ended.
    pub fn ends(mut self) -> String {
        let kill = Command::new("kill").args(["-TERM", &self.pid().to_string()]).status().unwrap();
        assert!(kill.success());
        assert!(self.running.0.wait().unwrap().success(), "{}", self.log());
        self.log()
    }

    pub fn pid(&self) -> u32 {
        self.running.0.id()
    }

    pub fn log(&self) -> String {
        fs::read_to_string(self.log.path()).unwrap()
    }
}

impl Drop for FleetProgram {
    fn drop(&mut self) {
        if std::thread::panicking() {
            eprintln!("the fleet program said:\n{}", self.log());
        }
    }
}

/// A vehicle.
pub struct Vehicle {
    running: Running,
    states: Receiver<Value>,
    /// The last state that was heard.
    pub state: Value,
}

impl Vehicle {
    /// One at a point of the depot, as fast as that.
    pub fn start(broker: &Broker, version: &str, serial: &str, [x, y, speed]: [f64; 3]) -> Self {
        let script = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/fleet/vehicle.js");
        let mut program = Command::new("node");
        program.arg(script).arg(library()).arg(broker.url()).args([version, serial, "depot"]);
        program.args([x, y, speed].map(|number| number.to_string()));
        let mut child =
            program.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("node is installed");
        let out = child.stdout.take().unwrap();
        let (say, states) = channel();
        std::thread::spawn(move || {
            for line in BufReader::new(out).lines().map_while(Result::ok) {
                let Ok(state) = serde_json::from_str(&line) else { continue };
                if say.send(state).is_err() {
                    return;
                }
            }
        });
        Self { running: Running(child), states, state: Value::Null }
    }

    pub fn tell(&mut self, command: &str) {
        writeln!(self.running.0.stdin.as_mut().unwrap(), "{command}").unwrap();
    }

    /// Waits for a state of which this holds.
    #[track_caller]
    pub fn until(&mut self, what: &str, holds: impl Fn(&Value) -> bool) -> Value {
        let began = Instant::now();
        while began.elapsed() < PATIENCE {
            if let Ok(state) = self.states.recv_timeout(Duration::from_millis(200)) {
                self.state = state;
                if holds(&self.state) {
                    return self.state.clone();
                }
            }
        }
        panic!("{what}: not in time; the last state is {:#}", self.state);
    }

    /// Waits until it stands at the end of its order.
    #[track_caller]
    pub fn arrives(&mut self, node: &str) {
        self.until(&format!("it comes to {node}"), |state| {
            state["lastNodeId"] == node && state["nodeStates"] == json!([]) && state["driving"] == false
        });
    }
}

/// Where npm put the vehicle's library (`tests/run` does so too).
fn library() -> &'static PathBuf {
    // tests that begin at once do not install it into one folder at once
    static LIBRARY: OnceLock<PathBuf> = OnceLock::new();
    LIBRARY.get_or_init(|| {
        let exe = std::env::current_exe().unwrap();
        let folder = exe.ancestors().nth(3).unwrap().join("vda-5050");
        if !folder.join("node_modules/vda-5050-lib/package.json").exists() {
            let mut npm = Command::new("npm");
            npm.args(["install", "--silent", "--no-audit", "--no-fund", "--prefix"])
                .arg(&folder)
                .arg("vda-5050-lib@1.4");
            assert!(npm.status().expect("npm is installed").success());
        }
        folder
    })
}

/// A cell of the table of vehicles.
pub fn cell(service: &Service, vehicle: &str, column: &str) -> Value {
    let answer = service.ask("GET", "/api/tables", None).1;
    let table =
        answer["tables"].as_array().unwrap().iter().find(|table| table["table"] == "vehicles").unwrap();
    let index = |of: &Value, key: &str, name: &str| {
        let at = |entry: &Value| if key.is_empty() { entry == name } else { entry[key] == name };
        of.as_array().unwrap().iter().position(at).unwrap()
    };
    let (row, column) = (index(&table["keys"], "", vehicle), index(&table["columns"], "name", column));
    table["rows"][row][column].clone()
}

/// Sends a vehicle somewhere.
pub fn send(service: &Service, vehicle: &str, goal: &str) {
    let edit = json!({"kind": "set", "table": "vehicles", "key": vehicle, "column": "goal", "value": goal});
    let answer = service.ask("POST", "/api/edits", Some(&json!({"edit": edit})));
    assert_eq!(answer.0, 200, "{answer:?}");
}

/// Says something to the broker, which keeps it.
pub fn keep(broker: &Broker, topic: &str, message: &Value) {
    let (client, _) = broker.client(&[]);
    client.publish(topic, rumqttc::QoS::AtLeastOnce, true, message.to_string()).unwrap();
    let (_second, heard) = broker.client(&[topic]);
    heard.recv_timeout(PATIENCE).expect("the broker has it");
}

/// Closes something.
pub fn close(service: &Service, what: &str) {
    let body = json!({"edit": {"kind": "close", "what": what}});
    let answer = service.ask("POST", "/api/edits", Some(&body));
    assert_eq!(answer.0, 200, "{answer:?}");
}
