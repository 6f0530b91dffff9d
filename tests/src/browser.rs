//! A real browser (Chromium, without a window) for the journeys on the page.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use fantoccini::actions::{InputSource, MOUSE_BUTTON_LEFT, MouseActions, PointerAction};
use fantoccini::elements::Element;
use fantoccini::{Client, ClientBuilder, Locator};
use hyper_util::client::legacy::connect::HttpConnector;
use serde_json::{Value, json};

/// How long a journey waits for what must come.
const PATIENCE: Duration = Duration::from_secs(40);

/// Ctrl, as `DevTools` count it among the keys that are held.
const CTRL: u8 = 2;

/// The pause in a double click of somebody slow.
const BETWEEN_CLICKS: Duration = Duration::from_millis(400);

/// What the browser is seen on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Screen {
    /// A desk: 1380 x 880.
    Desktop,
    /// A phone in the hall: 390 x 844, touched.
    Phone,
}

/// A driver with the port on which it listens; `None` where it ends before it does.
fn driver() -> Option<(Child, u16)> {
    let mut driver = Command::new("chromedriver")
        .arg("--port=0")
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("chromedriver is installed (tests/run installs it)");
    let out = BufReader::new(driver.stdout.take().expect("its output is piped"));
    let port = out.lines().map_while(Result::ok).find_map(|line| {
        let (_, port) = line.split_once("successfully on port ")?;
        port.trim_end_matches('.').parse::<u16>().ok()
    });
    if port.is_none() {
        driver.wait().expect("a driver that has ended");
    }
    port.map(|port| (driver, port))
}

/// Chromium with a page.
pub struct Browser {
    driver: Child,
    address: String,
    session: String,
    /// For all that has no word here.
    pub client: Client,
}

impl Browser {
    /// Opens an address.
    ///
    /// # Panics
    /// Where `chromedriver` or `chromium` is missing: `tests/run` installs them.
    pub async fn open(address: &str, screen: Screen) -> Self {
        // a port that somebody else takes meanwhile ends the driver
        let (driver, port) = (0..5).find_map(|_| driver()).expect("chromedriver says its port");
        let mut options = json!({ "args": [
            "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu", "--force-prefers-reduced-motion",
            "--window-size=1380,1020", "--lang=en",
        ] });
        if screen == Screen::Phone {
            options["mobileEmulation"] =
                json!({ "deviceMetrics": { "width": 390, "height": 844, "pixelRatio": 2.0, "touch": true } });
        }
        let driver_address = format!("127.0.0.1:{port}");
        let wishes = json!({ "goog:chromeOptions": options, "unhandledPromptBehavior": "accept" });
        let client = ClientBuilder::new(HttpConnector::new())
            .capabilities(wishes.as_object().expect("an object").clone())
            .connect(&format!("http://{driver_address}"))
            .await
            .expect("Chromium starts (tests/run installs it)");
        let session = client.session_id().await.expect("asked").expect("a session");
        let browser = Self { driver, address: driver_address, session, client };
        browser.goto(address).await;
        browser
    }

    /// Goes to an address and waits until the map is drawn, where it is the map's.
    pub async fn goto(&self, address: &str) {
        self.client.goto(address).await.expect("the page loads");
        self.until("document.body.dataset.connected === 'true'", "the page follows the service").await;
    }

    /// The first element that is shown, once there is one.
    pub async fn find(&self, css: &str) -> Element {
        let began = Instant::now();
        loop {
            for element in self.client.find_all(Locator::Css(css)).await.expect("a selector") {
                if element.is_displayed().await.unwrap_or(false) {
                    return element;
                }
            }
            assert!(began.elapsed() < PATIENCE, "{css} is not shown");
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }

    /// Clicks the first such element; once more where the page has just put another in its place, and from the middle of what
    /// scrolls where something lies over it.
    pub async fn click(&self, css: &str) {
        let began = Instant::now();
        while let Err(error) = self.find(css).await.click().await {
            self.run(&format!("document.querySelector({css:?})?.scrollIntoView({{ block: 'center' }})"))
                .await;
            assert!(began.elapsed() < PATIENCE, "{css} cannot be clicked: {error}");
            tokio::time::sleep(Duration::from_millis(30)).await;
        }
    }

    /// Clicks the button with this text inside an element, once it can be pressed: one that does something cannot until that is done.
    pub async fn press(&self, within: &str, text: &str) {
        let script = format!(
            "[...document.querySelectorAll('{within} button, {within} a')].find((b) => b.checkVisibility() && !b.disabled && b.textContent.includes({text:?}))"
        );
        self.until(&format!("Boolean({script})"), &format!("a button `{text}` in {within}")).await;
        self.run(&format!("{script}.click()")).await;
    }

    /// Types a text in place of what is there.
    pub async fn type_into(&self, css: &str, text: &str) {
        let field = self.find(css).await;
        field.clear().await.expect("a field");
        field.send_keys(text).await.expect("typed");
    }

    /// What an element says, as it is seen.
    pub async fn text(&self, css: &str) -> String {
        for _ in 0..20 {
            match self.find(css).await.text().await {
                // the page has put another element in its place meanwhile
                Err(error) if error.is_stale_element_reference() => {}
                text => return text.expect("a text"),
            }
        }
        panic!("{css} is put in place anew all the time");
    }

    /// Runs JavaScript on the page and gives what it returns.
    pub async fn run(&self, script: &str) -> Value {
        self.client.execute(script, Vec::new()).await.unwrap_or_else(|error| panic!("{script}: {error}"))
    }

    /// The value of an expression.
    pub async fn value(&self, expression: &str) -> Value {
        self.run(&format!("return {expression}")).await
    }

    /// Presses Enter and holds it, so that it comes again and again.
    pub async fn hold_enter(&self) {
        for n in 0..6 {
            self.enter("keyDown", &json!({ "text": "\r", "autoRepeat": n > 0 }));
            tokio::time::sleep(Duration::from_millis(60)).await;
        }
        self.enter("keyUp", &json!({}));
    }

    /// Presses Enter with Ctrl, wherever the focus is; `WebDriver` would scroll there first.
    pub fn ctrl_enter(&self) {
        self.enter("keyDown", &json!({ "modifiers": CTRL }));
        self.enter("keyUp", &json!({ "modifiers": CTRL }));
    }

    fn enter(&self, kind: &str, more: &Value) {
        let mut key = json!({ "type": kind, "key": "Enter", "code": "Enter", "windowsVirtualKeyCode": 13 });
        key.as_object_mut().expect("an object").extend(more.as_object().expect("an object").clone());
        self.devtools("Input.dispatchKeyEvent", &key);
    }

    /// Clicks an element twice, as fast as people do who think that everything takes a double click.
    pub async fn double_click(&self, css: &str) {
        let element = self.find(css).await;
        let (down, up) = (
            PointerAction::Down { button: MOUSE_BUTTON_LEFT },
            PointerAction::Up { button: MOUSE_BUTTON_LEFT },
        );
        let mouse = MouseActions::new("mouse".to_owned())
            .then(PointerAction::MoveToElement { element, duration: None, x: 0.0, y: 0.0 })
            .then(down.clone())
            .then(up.clone())
            .pause(BETWEEN_CLICKS)
            .then(down)
            .then(up);
        self.client.perform_actions(mouse).await.expect("clicked");
    }

    /// Where a point of the map is on the screen, in pixels from the middle of the canvas.
    async fn on_screen(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let seen = "(({ dataset, clientWidth, clientHeight }) => [...dataset.view.split(' ').map(Number), clientWidth, clientHeight])(document.getElementById('canvas'))";
        let is_painted = "(({ dataset }) => dataset.view && dataset.painted === dataset.view)(document.getElementById('canvas'))";
        self.until(is_painted, "the map is drawn").await;
        // while a page comes to its size the map does, too
        let mut before = Value::Null;
        let seen = loop {
            let now = self.value(seen).await;
            if now == before {
                break now;
            }
            before = now;
            tokio::time::sleep(Duration::from_millis(120)).await;
        };
        let seen: Vec<f64> = serde_json::from_value(seen).expect("numbers");
        let [scale, right, down, width, height] = seen[..] else { panic!("{seen:?}") };
        [(right + x * scale - width / 2.0).round(), (down - y * scale - height / 2.0).round()]
    }

    async fn pointer_on_map(&self, points: &[[f64; 2]], is_pressed: bool) {
        let canvas = self.find("#canvas").await;
        let mut mouse = MouseActions::new("mouse".to_owned());
        for (at, point) in points.iter().enumerate() {
            let [x, y] = self.on_screen(*point).await;
            let element = canvas.clone();
            let duration = (at > 0).then(|| Duration::from_millis(100));
            mouse = mouse.then(PointerAction::MoveToElement { element, duration, x, y });
            if at == 0 && is_pressed {
                mouse = mouse.then(PointerAction::Down { button: MOUSE_BUTTON_LEFT });
            }
        }
        if is_pressed {
            mouse = mouse.then(PointerAction::Up { button: MOUSE_BUTTON_LEFT });
        }
        self.client.perform_actions(mouse).await.expect("moved");
    }

    /// Drags from one point of the map to another, metres.
    pub async fn drag_on_map(&self, from: [f64; 2], to: [f64; 2]) {
        self.pointer_on_map(&[from, to], true).await;
    }

    /// Presses on a point of the map, metres.
    pub async fn tap_on_map(&self, at: [f64; 2]) {
        self.pointer_on_map(&[at], true).await;
        // what follows is no double click
        tokio::time::sleep(Duration::from_millis(120)).await;
    }

    /// Points at a point of the map, metres.
    pub async fn hover_on_map(&self, at: [f64; 2]) {
        self.pointer_on_map(&[at], false).await;
    }

    /// Tells Chromium something that `WebDriver` has no word for.
    fn devtools(&self, command: &str, parameters: &Value) {
        let body = json!({ "cmd": command, "params": parameters }).to_string();
        let mut stream = TcpStream::connect(&self.address).expect("the driver runs");
        let path = format!("/session/{}/goog/cdp/execute", self.session);
        let head =
            format!("POST {path} HTTP/1.1\r\nHost: {}\r\nContent-Type: application/json", self.address);
        write!(stream, "{head}\r\nContent-Length: {}\r\n\r\n{body}", body.len()).expect("asked");
        // it keeps the line open, so one look at its answer is enough
        let mut answer = [0; 1_024];
        let read = stream.read(&mut answer).expect("answered");
        assert!(answer[..read].starts_with(b"HTTP/1.1 200"), "{}", String::from_utf8_lossy(&answer[..read]));
    }

    /// Waits until an expression is true.
    #[track_caller]
    pub fn until<'a>(&'a self, expression: &'a str, what: &'a str) -> impl Future<Output = ()> + 'a {
        let caller = std::panic::Location::caller();
        async move {
            let began = Instant::now();
            let script = format!("try {{ return Boolean({expression}) }} catch (e) {{ return false }}");
            while self.run(&script).await != Value::Bool(true) {
                if began.elapsed() > PATIENCE {
                    let seen = self.run("return document.body.innerText").await;
                    let seen = seen.as_str().unwrap_or_default().chars().take(3_000).collect::<String>();
                    panic!("waited in vain for: {what} ({caller}). The page says:\n{seen}");
                }
                tokio::time::sleep(Duration::from_millis(20)).await;
            }
        }
    }

    /// Waits until an element says this.
    pub async fn says(&self, css: &str, text: &str) {
        let expression = format!(
            "[...document.querySelectorAll({css:?})].some((e) => e.checkVisibility() && e.innerText.includes({text:?}))"
        );
        self.until(&expression, &format!("{css} says `{text}`")).await;
    }

    /// A picture of what is seen, to be looked at: `target/screenshots/NAME.png`.
    pub async fn screenshot(&self, name: &str) {
        let exe = std::env::current_exe().expect("a test knows its own path");
        let folder: PathBuf =
            exe.ancestors().nth(3).expect("tests run in target/PROFILE/deps").join("screenshots");
        std::fs::create_dir_all(&folder).expect("a folder");
        let picture = self.client.screenshot().await.expect("a picture");
        std::fs::write(folder.join(format!("{name}.png")), picture).expect("written");
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // The session first: a driver that is killed leaves its browser behind. It keeps the line open, so one look at its
        // answer is enough.
        if let Ok(mut stream) = TcpStream::connect(&self.address) {
            let _ = stream.set_read_timeout(Some(Duration::from_secs(5)));
            let request =
                format!("DELETE /session/{} HTTP/1.1\r\nHost: {}\r\n\r\n", self.session, self.address);
            let _ = stream.write_all(request.as_bytes());
            let _ = stream.read(&mut [0; 1_024]);
        }
        let _ = self.driver.kill();
        let _ = self.driver.wait();
    }
}
