//! A run that is looked at: the same to the last bit, and stopped by its page as by Ctrl-C.

use crate::support::{Desk, wait_for};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

/// A run that goes on, and the address of its page.
struct Shown {
    child: Child,
    port: u16,
    token: String,
}

impl Shown {
    fn begin(desk: &Desk, line: &str) -> Self {
        let mut child = desk.command(line).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut address = String::new();
        BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut address).unwrap();
        let (host, token) = address.trim()["http://".len()..].trim_end_matches('/').split_once('/').unwrap();
        let port = host.rsplit_once(':').unwrap().1.parse().unwrap();
        Self { child, port, token: token.to_owned() }
    }

    /// Asks for something; nothing where nobody listens any more.
    fn ask(&self, method: &str, path: &str) -> Option<String> {
        let Self { port, token, .. } = self;
        let mut stream = TcpStream::connect(("127.0.0.1", *port)).ok()?;
        let host = format!("Host: 127.0.0.1:{port}\r\nContent-Length: 0\r\nConnection: close");
        stream.write_all(format!("{method} /{token}/{path} HTTP/1.1\r\n{host}\r\n\r\n").as_bytes()).ok()?;
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).ok()?;
        Some(String::from_utf8_lossy(&answer).into_owned())
    }

    /// Asks for news until they contain a text.
    fn wait(&self, text: &str) {
        let begun = Instant::now();
        while !self.ask("GET", "run/0/news?test").is_some_and(|news| news.contains(text)) {
            assert!(begun.elapsed() < Duration::from_mins(1), "{text} never came");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    fn code(mut self) -> (Option<i32>, String) {
        let mut said = String::new();
        self.child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        (self.child.wait().unwrap().code(), said)
    }
}

/// Whoever looks, much or little, and whoever asks and never reads: the bits are those of a run that nobody looks at.
#[test]
fn who_looks_changes_nothing() {
    let desk = Desk::new();
    desk.done("run balls.toml -q -o alone");
    desk.done("run balls.toml -q -o unseen --view --no-open");
    assert_eq!(desk.hash("unseen"), desk.hash("alone"));
    let seen = Shown::begin(&desk, "view balls.toml -q -o seen --no-open --threads 2");
    let stuck = TcpStream::connect(("127.0.0.1", seen.port)).unwrap();
    seen.wait("\"numbers\":[0,");
    assert!(seen.ask("GET", "run/0/frame/0?contacts=1").is_some_and(|frame| frame.contains("bonds")));
    // As long as a page is open it is served; then the command ends, well.
    seen.wait("\"status\":\"finished\"");
    assert!(seen.ask("GET", "run/0/history").is_some_and(|table| table.contains("kinetic energy [J]")));
    assert!(seen.ask("POST", "run/0/bye?test").is_some());
    let (code, said) = seen.code();
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("the page is open"), "{said}");
    drop(stuck);
    assert_eq!(desk.hash("seen"), desk.hash("alone"));
}

#[test]
fn a_page_stops_a_run_and_it_goes_on_from_there() {
    let desk = Desk::new();
    let slow = "--set 'duration=1 s' --set 'output.history-interval=20 ms'";
    desk.done(&format!("run balls.toml -q -o whole {slow}"));
    let shown = Shown::begin(&desk, &format!("run balls.toml -q -o cut --view --no-open {slow}"));
    shown.wait("\"status\":\"running\"");
    assert!(shown.ask("POST", "run/0/pause").is_some_and(|news| news.contains("paused")));
    shown.wait("\"status\":\"paused\"");
    // A link cannot stop it.
    assert!(shown.ask("GET", "run/0/stop").is_some_and(|answer| answer.contains("403")));
    assert!(shown.ask("POST", "run/0/stop").is_some());
    shown.wait("interrupted");
    let (code, said) = shown.code();
    assert_eq!(code, Some(130), "{said}");
    assert!(said.contains("hint: go on with"), "{said}");
    assert_eq!(desk.summary("cut")["status"], "interrupted");
    wait_for(&desk.path("cut/checkpoint/state.tsubu"));
    desk.done(&format!("run balls.toml -q -o cut --resume {slow}"));
    assert_eq!(desk.hash("cut"), desk.hash("whole"));
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let desk = Desk::new();
    desk.done("run balls.toml -q -o out");
    for (line, said) in [
        ("run balls.toml -o other --port 8000", "add `--view`"),
        ("view out --set duration=1", "`--set` is for a scene"),
        ("view out --threads 2", "`--threads` is for a scene"),
        ("view balls.toml out", "is a file: one scene"),
        ("view balls.toml -o out", "out"),
        ("view nothing.toml", "nothing.toml is not a folder"),
    ] {
        let ended = desk.run(line);
        assert_eq!(ended.code, Some(2), "{line}: {}", ended.stderr);
        assert!(ended.stderr.contains(said), "{line}: {}", ended.stderr);
    }
    assert!(!desk.path("other").exists());
}
