//! A browser without a window, told what to do over its debugging protocol. Pictures are drawn by the processor: no graphics card is needed.

use std::io::{BufRead, BufReader};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tempfile::TempDir;
use tungstenite::stream::MaybeTlsStream;
use tungstenite::{Message, WebSocket};

const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

const OPTIONS: [&str; 9] = [
    "--headless",
    "--no-sandbox",
    "--no-first-run",
    "--disable-dev-shm-usage",
    "--disable-background-networking",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--remote-debugging-port=0",
];

/// How long a page may take for anything.
const PATIENCE: Duration = Duration::from_secs(30);

/// A page in a browser, which ends with it.
pub struct Page {
    browser: Child,
    socket: WebSocket<MaybeTlsStream<TcpStream>>,
    session: Option<String>,
    calls: u64,
    _profile: TempDir,
}

impl Page {
    /// Opens an address; nothing where there is no browser, which is said.
    pub fn open(address: &str) -> Option<Self> {
        let mut page = Self::blank()?;
        page.go(address);
        Some(page)
    }

    /// Goes to an address.
    pub fn go(&mut self, address: &str) {
        self.call("Page.navigate", &json!({ "url": address }));
    }

    /// A window of 900 by 600 without anything in it; nothing where there is no browser, which is said.
    pub fn blank() -> Option<Self> {
        let profile = tempfile::tempdir().expect("a folder");
        let start = |name: &&str| {
            let profile = format!("--user-data-dir={}", profile.path().display());
            Command::new(name).args(OPTIONS).arg(profile).stderr(Stdio::piped()).stdout(Stdio::null()).spawn().ok()
        };
        let unwanted = std::env::var("TSUBU_BROWSER").is_ok_and(|name| name == "none");
        let Some(mut browser) = NAMES.iter().filter(|_| !unwanted).find_map(start) else {
            let why = if unwanted {
                "as TSUBU_BROWSER is none".into()
            } else {
                format!("for want of {}", NAMES.join(" or "))
            };
            eprintln!("\nSKIPPED: the page is not tested, {why}");
            return None;
        };
        let mut lines = BufReader::new(browser.stderr.take().expect("piped")).lines().map_while(Result::ok);
        let told = lines.find_map(|line| line.strip_prefix("DevTools listening on ").map(str::to_owned));
        let (socket, _) = tungstenite::connect(told.expect("it listens")).expect("it answers");
        let mut page = Self { browser, socket, session: None, calls: 0, _profile: profile };
        let target = page.call("Target.createTarget", &json!({ "url": "about:blank" }));
        let attached = json!({ "targetId": target["targetId"], "flatten": true });
        page.session = page.call("Target.attachToTarget", &attached)["sessionId"].as_str().map(str::to_owned);
        let window = json!({ "width": 900, "height": 600, "deviceScaleFactor": 1, "mobile": false });
        page.call("Emulation.setDeviceMetricsOverride", &window);
        Some(page)
    }

    /// Asks for motion to be reduced, as a system does, and opens the address again.
    pub fn stilled(&mut self, address: &str) {
        let feature = json!({ "features": [{ "name": "prefers-reduced-motion", "value": "reduce" }] });
        self.call("Emulation.setEmulatedMedia", &feature);
        self.go(address);
    }

    /// Makes the window a phone's.
    pub fn narrow(&mut self) {
        let window = json!({ "width": 390, "height": 844, "deviceScaleFactor": 1, "mobile": true });
        self.call("Emulation.setDeviceMetricsOverride", &window);
    }

    /// Opens the page of a server, and waits until it shows a frame.
    pub fn ready(address: &str) -> Option<Self> {
        let mut page = Self::open(address)?;
        page.wait("window.tsubu?.ready === true");
        Some(page)
    }

    fn call(&mut self, method: &str, params: &Value) -> Value {
        self.calls += 1;
        let mut call = json!({ "id": self.calls, "method": method, "params": params });
        if let Some(session) = &self.session {
            call["sessionId"] = session.clone().into();
        }
        self.socket.send(Message::text(call.to_string())).expect("it listens");
        loop {
            let Message::Text(text) = self.socket.read().expect("it answers") else { continue };
            let answer: Value = serde_json::from_str(&text).expect("JSON");
            if answer["id"] == self.calls {
                assert!(answer["error"].is_null(), "{method}: {answer}");
                return answer["result"].clone();
            }
        }
    }

    /// The value of an expression in the page.
    pub fn value(&mut self, expression: &str) -> Value {
        let wanted = json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let answer = self.call("Runtime.evaluate", &wanted);
        assert!(answer["exceptionDetails"].is_null(), "{expression}: {answer}");
        answer["result"]["value"].clone()
    }

    /// Waits until an expression is true.
    pub fn wait(&mut self, expression: &str) {
        let began = Instant::now();
        while self.value(expression) != true {
            let message = "document.getElementById('message')?.textContent ?? document.body?.textContent";
            assert!(began.elapsed() < PATIENCE, "{expression}: {}", self.value(message));
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// Presses a key.
    pub fn press(&mut self, key: &str) {
        for kind in ["keyDown", "keyUp"] {
            self.call("Input.dispatchKeyEvent", &json!({ "type": kind, "key": key }));
        }
    }

    /// Clicks at a place.
    pub fn click(&mut self, [x, y]: [f64; 2]) {
        for kind in ["mousePressed", "mouseReleased"] {
            let event = json!({ "type": kind, "x": x, "y": y, "button": "left", "clickCount": 1 });
            self.call("Input.dispatchMouseEvent", &event);
        }
    }

    /// Where on the page a point of a pane's world is seen.
    pub fn place(&mut self, pane: usize, [x, y, z]: [f64; 3]) -> [f64; 2] {
        let place = self.value(&format!(
            "(() => {{
                const {{ stage, panes }} = tsubu;
                const [left, top, width, height] = stage.place({pane});
                const at = panes[{pane}].box.min.clone().set({x}, {y}, {z}).project(stage.view.camera);
                const canvas = stage.canvas.getBoundingClientRect();
                return [canvas.left + left + (at.x + 1) / 2 * width, canvas.top + top + (1 - at.y) / 2 * height];
            }})()"
        ));
        serde_json::from_value(place).expect("two numbers")
    }

    /// The colours of places, as they are on the screen.
    pub fn colours(&mut self, places: &[[f64; 2]]) -> Vec<[u8; 3]> {
        // Two pictures later all wishes are drawn.
        self.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(0))))");
        let shot = self.call("Page.captureScreenshot", &json!({ "format": "png" }));
        let bytes = base64::Engine::decode(
            &base64::engine::general_purpose::STANDARD,
            shot["data"].as_str().expect("a picture"),
        );
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes.expect("base64"))).read_info().expect("PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("it fits")];
        let info = reader.next_frame(&mut pixels).expect("PNG");
        let each = info.color_type.samples();
        let at = |[x, y]: &[f64; 2]| (y.round() as usize * info.width as usize + x.round() as usize) * each;
        places.iter().map(|place| std::array::from_fn(|k| pixels[at(place) + k])).collect()
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        let _ = self.browser.kill();
        let _ = self.browser.wait();
    }
}
