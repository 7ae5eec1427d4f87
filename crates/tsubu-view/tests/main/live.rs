//! A run that goes on beside its page, without and with a browser.

use crate::chromium::Page;
use crate::support::{Served, frame};
use std::io::Write;
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{JoinHandle, sleep};
use std::time::{Duration, Instant};
use tsubu_frame::{Frame, Kind};
use tsubu_view::Live;

/// A run of frames that come every 20 ms, until it is asked to stop.
struct Run {
    live: Arc<Live>,
    work: Option<JoinHandle<u32>>,
}

impl Run {
    fn begin() -> Self {
        let stop = Arc::new(AtomicBool::new(false));
        let asked = stop.clone();
        let stopped = Box::new(move || asked.store(true, Ordering::Relaxed));
        let live = Arc::new(Live::new("out/made".to_owned(), "dem", 2, stopped));
        let seen = live.clone();
        let work = std::thread::spawn(move || {
            let columns = ["time [s]", "kinetic energy [J]"].map(str::to_owned);
            let mut number = 0;
            seen.stage(0, "fill", "stage fill\nok   small steps\n");
            while !stop.load(Ordering::Relaxed) {
                if number == 10 {
                    seen.stage(1, "open", "stage fill\nok   small steps\n\nstage open\nwarn too large steps\n");
                }
                if !seen.paused() {
                    seen.moved(0.1 * f64::from(number), u64::from(10 * number), 0.5);
                    seen.row(&columns, &[0.1 * f64::from(number), f64::from(number)]);
                    if seen.wish().is_some() {
                        seen.frame(frame(number), Duration::from_micros(10));
                    }
                    number += 1;
                }
                sleep(Duration::from_millis(20));
            }
            seen.end("interrupted", "go on with `tsubu run made.toml --resume`".to_owned(), None);
            number
        });
        Self { live, work: Some(work) }
    }

    /// The number of steps when it has ended.
    fn ended(&mut self) -> u32 {
        let work = self.work.take().expect("it has not ended");
        let begun = Instant::now();
        while !work.is_finished() {
            assert!(begun.elapsed() < Duration::from_secs(10), "the run was not stopped");
            sleep(Duration::from_millis(5));
        }
        work.join().expect("it ends well")
    }
}

impl Drop for Run {
    fn drop(&mut self) {
        if let Some(work) = self.work.take() {
            // A test that failed leaves it.
            drop(work);
        }
    }
}

fn news(served: &Served) -> serde_json::Value {
    let (status, body) = served.get("run/0/news?a-page");
    assert_eq!(status, 200);
    serde_json::from_slice(&body).expect("JSON")
}

fn post(served: &Served, path: &str) -> u16 {
    let Served { port, token, .. } = served;
    served
        .say(&format!(
            "POST /{token}/{path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nOrigin: http://127.0.0.1:{port}\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"
        ))
        .0
}

#[test]
fn a_run_is_told_of_paused_and_stopped() {
    let mut run = Run::begin();
    let served = Served::of_live(run.live.clone());
    assert!(!run.live.is_looked_at());
    let begun = Instant::now();
    while news(&served)["stages"].as_array().map(Vec::len) < Some(2) {
        assert!(begun.elapsed() < Duration::from_secs(10), "{}", news(&served));
    }
    assert!(run.live.is_looked_at());
    let told = news(&served);
    assert_eq!((&told["status"], &told["stages"][1]), (&"running".into(), &"open".into()));
    assert!(told["verdict"].as_str().is_some_and(|text| text.contains("warn too large steps")));
    assert!(served.get("run/0/history").1.starts_with(b"time [s],kinetic energy [J]\n0,0\n0.1,1\n"));
    assert_eq!(served.get("run/0/frame/0?colour=velocity").0, 200);
    // Who follows a link changes nothing; who posts does.
    for (word, told) in [("pause", 403), ("stop", 403), ("bye", 403)] {
        assert_eq!(served.get(&format!("run/0/{word}")).0, told, "{word}");
    }
    assert_eq!((post(&served, "run/0/erase"), post(&served, "run/1/stop"), post(&served, "runs")), (403, 404, 403));
    assert!(!run.live.paused());
    assert_eq!(post(&served, "run/0/pause"), 200);
    sleep(Duration::from_millis(100));
    let before = news(&served)["steps"].clone();
    sleep(Duration::from_millis(200));
    assert_eq!((&news(&served)["steps"], &news(&served)["status"]), (&before, &"paused".into()));
    assert_eq!(post(&served, "run/0/go-on"), 200);
    let begun = Instant::now();
    while news(&served)["steps"] == before {
        assert!(begun.elapsed() < Duration::from_secs(5), "it did not go on");
    }
    assert_eq!(post(&served, "run/0/stop"), 200);
    run.ended();
    assert_eq!(news(&served)["status"], "interrupted");
    assert!(run.live.is_looked_at());
    assert_eq!(post(&served, "run/0/bye?a-page"), 200);
    assert!(!run.live.is_looked_at());
}

/// Clients that ask for much and read nothing, and one that has gone: giving moments away takes no longer.
#[test]
fn a_client_that_does_not_read_holds_nobody_up() {
    let live = Arc::new(Live::new("out/made".to_owned(), "dem", 3, Box::new(|| ())));
    let served = Served::of_live(live.clone());
    let mut large = Frame::default();
    large.integer(Kind::Grain, "id", "-", (0..200_000).collect());
    large.vector(Kind::Grain, "position", "m", vec![[0.5; 3]; 200_000]);
    large.scalar(Kind::Grain, "radius", "m", vec![1e-3; 200_000]);
    let give = |step: u64| {
        let frame = Frame { step, ..large.clone() };
        let begun = Instant::now();
        live.moved(0.0, step, 0.1);
        live.row(&["time [s]".to_owned()], &[step as f64]);
        let _ = live.wish();
        live.frame(frame, Duration::ZERO);
        begun.elapsed()
    };
    give(0);
    let stuck: Vec<TcpStream> = (0..20)
        .map(|_| {
            let mut stream = TcpStream::connect(("127.0.0.1", served.port)).expect("it listens");
            let Served { port, token, .. } = &served;
            let ask = format!("GET /{token}/run/0/frame/0 HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n");
            stream.write_all(ask.repeat(5).as_bytes()).expect("it reads");
            stream
        })
        .collect();
    sleep(Duration::from_millis(500));
    let mut times: Vec<Duration> = (1..=50).map(give).collect();
    times.sort();
    assert!(times[25] < Duration::from_millis(1), "half of the moments took longer than {:?}", times[25]);
    assert!(times[49] < Duration::from_millis(200), "one moment took {:?}", times[49]);
    drop(stuck);
    assert_eq!(served.get("run/0/about").0, 200);
}

#[test]
fn a_live_run_is_followed_paused_and_stopped_in_the_browser() {
    let mut run = Run::begin();
    let mut served = Served::of_live(run.live.clone());
    let Some(mut page) = Page::ready(&served.address) else {
        run.live.end("interrupted", String::new(), None);
        assert_eq!(post(&served, "run/0/stop"), 200);
        run.ended();
        return;
    };
    // The last moment is followed.
    page.wait("tsubu.player.times.length > 5 && tsubu.player.number === tsubu.player.times.length - 1");
    page.wait("document.getElementById('verdict').innerText.includes('check: 1 warning')");
    page.wait("document.querySelector('#verdict li[aria-current]').innerText === 'open (now)'");
    page.value("document.getElementById('pause').click()");
    page.wait("document.getElementById('status').textContent.startsWith('paused')");
    sleep(Duration::from_millis(600));
    let steps = page.value("tsubu.panes[0].about.steps");
    sleep(Duration::from_millis(600));
    assert_eq!(page.value("tsubu.panes[0].about.steps"), steps);
    page.wait("document.getElementById('pause').textContent === 'go on'");
    page.value("document.getElementById('pause').click()");
    page.wait(&format!("tsubu.panes[0].about.steps > {steps}"));
    // Who looks at an earlier moment stays there.
    page.press("Home");
    page.wait("tsubu.player.number === 0");
    let many = page.value("tsubu.player.times.length");
    page.wait(&format!("tsubu.player.times.length > {many}"));
    assert_eq!(page.value("tsubu.player.number"), 0);
    page.value("document.getElementById('stop').click()");
    run.ended();
    page.wait("document.getElementById('status').textContent.includes('--resume')");
    page.wait("document.getElementById('control').hidden");
    // The server goes when the page has what it wants of the end; that is no failure.
    let begun = Instant::now();
    while run.live.is_looked_at() {
        assert!(begun.elapsed() < Duration::from_secs(10), "the page did not say that it has all");
        sleep(Duration::from_millis(5));
    }
    served.end();
    sleep(Duration::from_millis(600));
    assert_eq!(page.value("document.getElementById('message').hidden"), true);
}

#[test]
fn a_live_run_that_is_killed_is_told() {
    let mut run = Run::begin();
    let mut served = Served::of_live(run.live.clone());
    let Some(mut page) = Page::ready(&served.address) else { return };
    served.end();
    page.wait("document.getElementById('message').textContent.includes('does not answer')");
    page.wait("!document.getElementById('message').hidden");
    run.live.end("interrupted", String::new(), None);
    run.work.take();
}
