//! A run folder of a few grains, a server of it, and plain requests.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

use tempfile::TempDir;
use tsubu_frame::series::{Formats, FrameWriter};
use tsubu_frame::{Frame, Kind};
use tsubu_view::{Live, Server};

/// Two grains in a frame: one at rest at the left, one at the right that rises and whose speed grows.
pub fn frame(number: u32) -> Frame {
    let t = f64::from(number);
    let mut frame = Frame { time: 0.1 * t, step: u64::from(10 * number), columns: Vec::new() };
    frame.integer(Kind::Grain, "id", "-", vec![7, 9]);
    frame.integer(Kind::Grain, "group", "-", vec![0, 1]);
    frame.vector(Kind::Grain, "position", "m", vec![[-1.0, 0.0, 0.0], [1.0, 0.0, 0.2 * t]]);
    frame.vector(Kind::Grain, "velocity", "m/s", vec![[0.0; 3], [0.0, 0.0, 2.0]]);
    frame.scalar(Kind::Grain, "radius", "m", vec![0.5, 0.5]);
    frame.integer(Kind::Contact, "first", "-", vec![7, 9]);
    frame.integer(Kind::Contact, "second", "-", vec![9, -1]);
    frame.vector(Kind::Contact, "position", "m", vec![[-0.5, 0.0, 0.0], [1.0, 0.0, 0.2 * t - 0.5]]);
    frame.vector(Kind::Contact, "force", "N", vec![[3.0, 0.0, 4.0], [0.0, 0.0, 1.0]]);
    frame.integer(Kind::Surface, "outline", "-", vec![0, 0, 0, 0]);
    frame.integer(Kind::Surface, "face", "-", vec![0; 4]);
    frame.vector(
        Kind::Surface,
        "position",
        "m",
        vec![[-2.0, 0.0, -2.0], [2.0, 0.0, -2.0], [2.0, 0.0, 2.0], [-2.0, 0.0, 2.0]],
    );
    frame
}

/// Adds frames to the first ones of a run folder, up to `frames`.
pub fn go_on(folder: &Path, from: u32, frames: u32) {
    let mut writer = FrameWriter::resume(folder, Formats::default(), frame(from).time).expect("frames");
    (from + 1..frames).for_each(|number| writer.write(&frame(number)).expect("written"));
    writer.flush().expect("written");
}

/// A run folder with so many frames and a history.
pub fn run_folder(frames: u32) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("frames")).expect("a folder");
    let mut writer = FrameWriter::create(folder.path(), Formats::default());
    (0..frames).for_each(|number| writer.write(&frame(number)).expect("written"));
    writer.flush().expect("written");
    let rows = (0..frames).map(|n| format!("{},{}\n", 0.1 * f64::from(n), n * n));
    let history: Vec<String> = std::iter::once("time [s],kinetic energy [J]\n".to_owned()).chain(rows).collect();
    std::fs::write(folder.path().join("history.csv"), history.concat()).expect("written");
    folder
}

/// A server at work, until it is dropped.
pub struct Served {
    pub address: String,
    pub port: u16,
    pub token: String,
    stop: Arc<AtomicBool>,
    work: Option<JoinHandle<()>>,
}

impl Served {
    pub fn of(folders: &[&Path]) -> Self {
        let folders: Vec<PathBuf> = folders.iter().map(|path| path.to_path_buf()).collect();
        Self::by(Server::bind(&folders, 0).expect("served"))
    }

    pub fn of_live(live: Arc<Live>) -> Self {
        Self::by(Server::of_live(live, 0).expect("served"))
    }

    fn by(server: Server) -> Self {
        let address = server.address();
        let (host, token) = address["http://".len()..].split_once('/').expect("a path");
        let port = host.rsplit_once(':').and_then(|(_, port)| port.parse().ok()).expect("a port");
        let token = token.trim_end_matches('/').to_owned();
        let stop = Arc::new(AtomicBool::new(false));
        let asked = stop.clone();
        let serve = move || server.serve(&|| asked.load(Ordering::Relaxed)).expect("served");
        Self { address, port, token, stop, work: Some(std::thread::spawn(serve)) }
    }

    /// The answer to a request in plain words: status and body.
    pub fn say(&self, request: &str) -> (u16, Vec<u8>) {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).expect("it listens");
        stream.write_all(request.as_bytes()).expect("it reads");
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).expect("it answers");
        let head = answer.windows(4).position(|w| w == b"\r\n\r\n").expect("a head");
        let status = String::from_utf8_lossy(&answer[9..12]).parse().expect("a status");
        (status, answer[head + 4..].to_vec())
    }

    /// The answer to a path behind the token, asked as the page does.
    pub fn get(&self, path: &str) -> (u16, Vec<u8>) {
        self.say(&format!(
            "GET /{}/{path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n\r\n",
            self.token, self.port
        ))
    }

    /// Ends it.
    pub fn end(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(work) = self.work.take() {
            work.join().expect("it ends well");
        }
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.end();
    }
}
