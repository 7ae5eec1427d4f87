//! How fast 100,000 grains in 200 frames are shown. A measurement, for `cargo test --release -p tsubu-view -- --ignored --nocapture`: what it
//! asks for is the promise of the book, what it prints stands in `benches/notes`.

use crate::chromium::Page;
use crate::support::Served;
use std::time::Instant;
use tsubu_frame::series::{Formats, FrameWriter};
use tsubu_frame::{Frame, Kind};

const GRAINS: usize = 100_000;
const FRAMES: u32 = 200;

/// Frames that the browser shows one after the other.
const MEASURED: usize = 12;

/// A cube of grains that turns about its middle.
fn frame(number: u32) -> Frame {
    let mut frame = Frame { time: 0.01 * f64::from(number), step: u64::from(number), columns: Vec::new() };
    let (sin, cos) = (0.01 * f64::from(number)).sin_cos();
    let place = |i: usize| {
        let [x, y, z] = [i % 46, i / 46 % 46, i / 2116].map(|n| n as f64 - 23.0);
        [0.01 * (cos * x - sin * y), 0.01 * (sin * x + cos * y), 0.01 * z]
    };
    let place: Vec<[f64; 3]> = (0..GRAINS).map(place).collect();
    frame.integer(Kind::Grain, "id", "-", (0..GRAINS as i64).collect());
    frame.integer(Kind::Grain, "group", "-", vec![0; GRAINS]);
    frame.vector(Kind::Grain, "velocity", "m/s", place.iter().map(|[x, y, _]| [-y, *x, 0.0]).collect());
    frame.vector(Kind::Grain, "position", "m", place);
    frame.scalar(Kind::Grain, "radius", "m", vec![0.005; GRAINS]);
    frame
}

/// Memory of this process [MB].
fn memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmRSS")).unwrap_or_default();
    line.split_whitespace()
        .nth(1)
        .and_then(|text| text.parse().ok())
        .map_or(f64::NAN, |kilobytes: f64| kilobytes / 1024.0)
}

#[test]
#[ignore = "writes 1.4 GB and takes a minute"]
fn a_large_run_is_shown_soon_and_in_flat_memory() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("frames")).expect("a folder");
    let mut writer = FrameWriter::create(folder.path(), Formats::default());
    (0..FRAMES).for_each(|number| writer.write(&frame(number)).expect("written"));
    writer.flush().expect("written");
    let served = Served::of(&[folder.path()]);
    let Some(mut page) = Page::blank() else { return };
    let begun = Instant::now();
    page.go(&served.address);
    page.wait("window.tsubu?.stage.drawings > 0");
    let first = begun.elapsed().as_secs_f64();
    page.wait("window.tsubu.ready === true");
    let ready = page.value("tsubu.stage.first").as_f64().expect("a number") / 1000.0;
    let mut costs = Vec::new();
    // A processor that stands in for a graphics card draws such a picture in seconds: a few are enough.
    for _ in 0..MEASURED {
        page.press("ArrowRight");
        page.wait("!tsubu.player.busy");
        let told = "new Promise((done) => requestAnimationFrame(() => setTimeout(() => done(tsubu.state.cost + tsubu.stage.cost))))";
        costs.push(page.value(told).as_f64().expect("a number"));
    }
    drop(page);
    let before = memory();
    let mut most = before;
    for number in 0..FRAMES {
        assert_eq!(served.get(&format!("run/0/frame/{number}?colour=velocity")).0, 200);
        most = most.max(memory());
    }
    costs.sort_by(f64::total_cmp);
    let (half, tenth) = (costs[costs.len() / 2], costs[costs.len() * 9 / 10]);
    println!("first picture ready for the graphics call after {ready:.2} s, seen after {first:.2} s");
    println!("a frame outside the graphics call {half:.2} ms, nine tenths below {tenth:.2} ms");
    println!("memory of the server {before:.0} MB at first, {most:.0} MB at most over {FRAMES} frames");
    assert!(ready < 2.0 && half < 5.0 && most < before + 100.0);
}
