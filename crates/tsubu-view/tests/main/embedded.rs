//! The page in one file: from the disk, without a server.

use crate::chromium::Page;
use crate::support::frame;
use std::time::Duration;
use tsubu_frame::{FileError, Frame, Kind};
use tsubu_view::embedded::{BYTES, Run, embed};

const RUN: Run = Run {
    name: "made",
    history: "time [s],kinetic energy [J]\n0,0\n0.5,25\n",
    scene: "[particles.large]\n[particles.small]\n",
};

fn made(count: usize) -> (String, String) {
    let mut read = |number: usize| Ok::<Frame, FileError>(frame(number as u32));
    let made = embed(count, &RUN, &mut read).expect("read").expect("frames");
    (made.html, made.left_out)
}

/// A page of that text on the disk.
fn on_disk(html: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("page.html");
    std::fs::write(&path, html).expect("written");
    let address = format!("file://{}", path.display());
    (folder, address)
}

fn near(a: [u8; 3], b: [u8; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 4)
}

#[test]
fn a_page_from_the_disk_shows_plays_and_tells() {
    let (html, left_out) = made(6);
    assert!(!left_out.contains("frames") && left_out.contains("rounded"), "{left_out}");
    let (_folder, address) = on_disk(&html);
    let Some(mut page) = Page::ready(&address) else { return };
    // It plays by itself, over and over.
    page.wait("tsubu.player.playing && tsubu.player.number > 2");
    page.wait("tsubu.player.number === 0");
    page.press("Home");
    page.wait("tsubu.player.number === 0 && !tsubu.player.playing");
    let places = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]].map(|point| page.place(0, point));
    let seen = page.colours(&places);
    let wanted = [[68, 1, 84], [253, 231, 37], [255, 255, 255]];
    for (seen, wanted) in seen.iter().zip(wanted) {
        assert!(seen.iter().zip(wanted).all(|(a, b)| a.abs_diff(b) <= 4), "{seen:?}, not {wanted:?}");
    }
    page.press("End");
    page.wait("tsubu.player.number === 5");
    // The grain that has risen by 1 m in steps of a 65,534th of that.
    let height = page.value("tsubu.panes[0].frame.position[5]").as_f64().expect("a number");
    assert!((height - 1.0).abs() < 1e-4, "{height}");
    let place = page.place(0, [1.0, 0.0, 1.1]);
    page.click(place);
    page.wait("document.getElementById('grain').innerText.includes('grain 9')");
    page.wait("document.getElementById('curve').options.length === 2");
    // Contacts have come along.
    page.value("document.getElementById('contacts').click()");
    page.wait("tsubu.panes[0].bonds.geometry.instanceCount === 2 && tsubu.panes[0].frame.forces[0] === 5");
    page.stilled(&address);
    page.wait("window.tsubu?.ready === true && tsubu.player.loop");
    std::thread::sleep(Duration::from_millis(600));
    assert_eq!(page.value("[tsubu.player.playing, tsubu.player.number]"), serde_json::json!([false, 0]));
}

/// In a report the page had no height yet when it began, and nothing was ever seen in it.
#[test]
fn a_page_that_is_laid_out_late_is_framed_then() {
    let (html, _) = made(2);
    let (_folder, address) = on_disk(&html);
    let Some(mut page) = Page::ready(&address) else { return };
    page.value("document.getElementById('stage').style.display = 'none'; tsubu.stage.resize(); 0");
    page.value("document.getElementById('stage').style.display = ''; tsubu.stage.resize(); 0");
    page.wait("Number.isFinite(tsubu.stage.view.half) && Number.isFinite(tsubu.stage.view.camera.left)");
    let seen = page.place(0, [-1.0, 0.0, 0.0]);
    assert!(near(page.colours(&[seen])[0], [68, 1, 84]), "the grain is not where it was");
}

/// As a report carries it: in a frame that reaches nothing.
#[test]
fn a_page_in_a_page_is_drawn() {
    let (html, _) = made(2);
    let inside = html.replace('&', "&amp;").replace('"', "&quot;");
    let around = "position:fixed;inset:0;width:100%;height:100%;border:0";
    let (_folder, address) =
        on_disk(&format!("<iframe sandbox=\"allow-scripts\" style=\"{around}\" srcdoc=\"{inside}\"></iframe>"));
    let Some(mut page) = Page::open(&address) else { return };
    let begun = std::time::Instant::now();
    // Somewhere in the middle line of the picture stands the dark grain.
    let line: Vec<[f64; 2]> = (0..600).map(|x| [f64::from(x), 300.0]).collect();
    let dark = |colour: &[u8; 3]| colour.iter().zip([68, 1, 84]).all(|(a, b)| a.abs_diff(b) <= 4);
    while !page.colours(&line).iter().any(dark) {
        assert!(begun.elapsed() < Duration::from_secs(30), "no grain is seen");
    }
}

#[test]
fn a_page_is_never_larger_than_a_mail_takes_and_says_what_it_leaves_out() {
    let mut large = frame(0);
    large.columns.retain(|column| column.kind != Kind::Contact);
    let mut read = |number: usize| {
        let mut frame = Frame { time: number as f64, ..Frame::default() };
        // Places without any order pack badly.
        let mut seed = number as u64 + 1;
        let mut draw = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let grains = 60_000;
        frame.integer(Kind::Grain, "id", "-", (0..grains).collect());
        frame.vector(Kind::Grain, "position", "m", (0..grains).map(|_| [draw(), draw(), draw()]).collect());
        frame.scalar(Kind::Grain, "radius", "m", vec![1e-3; grains as usize]);
        Ok::<Frame, FileError>(frame)
    };
    let made = embed(200, &RUN, &mut read).expect("read").expect("frames");
    assert!(made.html.len() <= BYTES && made.html.len() > BYTES / 3, "{} bytes", made.html.len());
    assert!(made.left_out.contains("of 200 frames"), "{}", made.left_out);
    let (small, left_out) = self::made(100);
    assert!(small.len() < BYTES / 4 && left_out.contains("60 of 100 frames"), "{} bytes, {left_out}", small.len());
    assert!(embed(0, &RUN, &mut read).expect("nothing is read").is_none());
}
