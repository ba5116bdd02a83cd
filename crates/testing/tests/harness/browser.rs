//! A headless browser by its DevTools protocol: real input events, what the page asked for, what it complained of.

use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use base64::Engine;
use serde_json::{Value, json};
use tempfile::TempDir;
use tungstenite::{Message, WebSocket};

/// The longest that anything may take.
const PATIENCE: Duration = Duration::from_secs(60);

/// A browser with one page. It ends with the test.
pub struct Browser {
    process: Child,
    socket: WebSocket<TcpStream>,
    /// Of the page; empty before there is one.
    session: String,
    calls: u64,
    /// Everything that the browser has messages, in order.
    pub events: Vec<Value>,
    _profile: TempDir,
}

impl Drop for Browser {
    fn drop(&mut self) {
        // An error says that it has ended by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// The browser's program: the one that is named, else the first that answers.
fn program() -> String {
    if let Some(named) = std::env::var("TYNDALL_BROWSER").ok().filter(|name| !name.is_empty()) {
        return named;
    }
    let answers = |name: &&str| {
        let quiet = Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
        quiet.is_ok_and(|status| status.success())
    };
    let names = include_str!("browsers.txt");
    let Some(found) = names.lines().find(answers) else {
        panic!(
            "no browser answers: `cargo xtask test` installs one where it may; or install Chromium, or name a browser by TYNDALL_BROWSER"
        );
    };
    found.to_owned()
}

/// Chromium's sandbox does not work for root.
fn is_root() -> bool {
    Command::new("id").arg("-u").output().is_ok_and(|output| output.stdout.starts_with(b"0\n"))
}

impl Browser {
    /// Starts it with an empty page.
    pub fn open() -> Self {
        let profile = tempfile::tempdir().unwrap();
        let mut command = Command::new(program());
        let quiet = [
            "no-first-run",
            "disable-background-networking",
            "disable-component-update",
            "disable-sync",
            "disable-quic",
        ];
        command.args(quiet.map(|flag| format!("--{flag}")));
        command.args([
            "--headless",
            "--disable-gpu",
            "--hide-scrollbars",
            "--force-device-scale-factor=1",
            "--remote-debugging-port=0",
        ]);
        command.arg(format!("--user-data-dir={}", profile.path().display()));
        command.args(is_root().then_some("--no-sandbox"));
        let mut process = command.arg("about:blank").stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let address = address(&mut process, profile.path());
        let stream = TcpStream::connect(&address.0).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let (socket, _) = tungstenite::client(format!("ws://{}{}", address.0, address.1), stream).unwrap();
        let mut browser =
            Self { process, socket, session: String::new(), calls: 0, events: Vec::new(), _profile: profile };
        let target = browser.call("Target.createTarget", &json!({ "url": "about:blank" }));
        let attached =
            browser.call("Target.attachToTarget", &json!({ "targetId": target["targetId"], "flatten": true }));
        browser.session = attached["sessionId"].as_str().unwrap().to_owned();
        for domain in ["Page", "Runtime", "Network", "Log"] {
            browser.call(&format!("{domain}.enable"), &json!({}));
        }
        browser
    }

    /// Calls a method of the protocol and gives its result.
    pub fn call(&mut self, method: &str, params: &Value) -> Value {
        self.calls += 1;
        let id = self.calls;
        let mut message = json!({ "id": id, "method": method, "params": params });
        if !self.session.is_empty() {
            message["sessionId"] = self.session.as_str().into();
        }
        self.socket.send(Message::text(message.to_string())).unwrap();
        loop {
            let messages = self.listen();
            if messages["id"] == id {
                assert!(messages["error"].is_null(), "{method}: {}", messages["error"]);
                return messages["result"].clone();
            }
            self.events.push(messages);
        }
    }

    fn listen(&mut self) -> Value {
        loop {
            let message = self.socket.read().unwrap_or_else(|error| panic!("the browser is silent: {error}"));
            if let Message::Text(text) = message {
                return serde_json::from_str(&text).unwrap();
            }
        }
    }

    /// Opens a page and waits until all of it is there.
    pub fn go(&mut self, page: &Path) {
        let url = format!("file://{}", page.display());
        self.loads(|browser| drop(browser.call("Page.navigate", &json!({ "url": url }))));
    }

    /// Does what makes a page load, and waits until it has.
    pub fn loads(&mut self, act: impl FnOnce(&mut Self)) {
        let before = self.events.len();
        act(self);
        let start = Instant::now();
        while !self.events[before..].iter().any(|event| event["method"] == "Page.loadEventFired") {
            assert!(start.elapsed() < PATIENCE, "the page does not load");
            let messages = self.listen();
            self.events.push(messages);
        }
    }

    /// What an expression of JavaScript gives.
    pub fn evaluate(&mut self, expression: &str) -> Value {
        let found = self.call(
            "Runtime.evaluate",
            &json!({ "expression": expression, "returnByValue": true, "awaitPromise": true }),
        );
        assert!(found["exceptionDetails"].is_null(), "{expression}: {}", found["exceptionDetails"]);
        found["result"]["value"].clone()
    }

    /// How wide the window is, in CSS pixels.
    pub fn width(&mut self, width: u32) {
        let size = json!({ "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": false });
        self.call("Emulation.setDeviceMetricsOverride", &size);
    }

    /// What the user prefers: `light` or `dark`.
    pub fn prefer(&mut self, scheme: &str) {
        let feature = json!({ "name": "prefers-color-scheme", "value": scheme });
        self.call("Emulation.setEmulatedMedia", &json!({ "features": [feature] }));
    }

    /// Presses a key and lets it go: `j`, `ArrowRight`, `Tab`, `Enter`.
    pub fn press(&mut self, key: &str) {
        let (code, text) = match key {
            "ArrowLeft" => (37, ""),
            "ArrowRight" => (39, ""),
            "Tab" => (9, ""),
            "Enter" => (13, "\r"),
            letter => (u32::from(letter.as_bytes()[0].to_ascii_uppercase()), letter),
        };
        let down = json!({ "type": "keyDown", "key": key, "code": key, "windowsVirtualKeyCode": code, "text": text });
        self.call("Input.dispatchKeyEvent", &down);
        self.call(
            "Input.dispatchKeyEvent",
            &json!({ "type": "keyUp", "key": key, "code": key, "windowsVirtualKeyCode": code }),
        );
    }

    /// Presses the mouse at a place of the window, drags it to another, and lets it go.
    pub fn drag(&mut self, from: (f64, f64), to: (f64, f64)) {
        let mut mouse = |kind: &str, (x, y): (f64, f64)| {
            let event = json!({ "type": kind, "x": x, "y": y, "button": "left", "buttons": 1, "clickCount": 1 });
            self.call("Input.dispatchMouseEvent", &event);
        };
        mouse("mousePressed", from);
        mouse("mouseMoved", to);
        mouse("mouseReleased", to);
    }

    /// Left, top, width and height of an element in the window.
    pub fn place(&mut self, selector: &str) -> [f64; 4] {
        let found = self.evaluate(&format!(
            "(() => {{ const r = document.querySelector({selector:?}).getBoundingClientRect(); return [r.x, r.y, r.width, r.height]; }})()"
        ));
        std::array::from_fn(|index| found[index].as_f64().unwrap())
    }

    /// Writes a picture of the whole page.
    pub fn photograph(&mut self, path: &Path) {
        let shot = self.call("Page.captureScreenshot", &json!({ "format": "png", "captureBeyondViewport": true }));
        let png = base64::engine::general_purpose::STANDARD.decode(shot["data"].as_str().unwrap()).unwrap();
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, png).unwrap();
    }

    /// What pages complained of: exceptions, errors and warnings of the console, files that are not there.
    pub fn complaints(&self) -> Vec<&Value> {
        let complains = |event: &&Value| match event["method"].as_str() {
            Some("Runtime.exceptionThrown") => true,
            Some("Runtime.consoleAPICalled") => event["params"]["type"] != "log",
            Some("Log.entryAdded") => event["params"]["entry"]["level"] != "info",
            Some("Network.loadingFailed") => true,
            _ => false,
        };
        self.events.iter().filter(complains).collect()
    }

    /// Everything that pages asked for.
    pub fn requests(&self) -> Vec<&str> {
        let asked = self.events.iter().filter(|event| event["method"] == "Network.requestWillBeSent");
        asked.filter_map(|event| event["params"]["request"]["url"].as_str()).collect()
    }
}

/// Host with port, and path, where the browser listens: it writes them into its profile.
fn address(process: &mut Child, profile: &Path) -> (String, String) {
    let start = Instant::now();
    loop {
        let text = std::fs::read_to_string(profile.join("DevToolsActivePort")).unwrap_or_default();
        if let Some((port, path)) = text.split_once('\n') {
            return (format!("127.0.0.1:{port}"), path.trim_end().to_owned());
        }
        let ended = process.try_wait().unwrap();
        assert!(ended.is_none(), "the browser ended: {}", ended.unwrap());
        assert!(start.elapsed() < PATIENCE, "the browser does not start");
        std::thread::sleep(Duration::from_millis(50));
    }
}
