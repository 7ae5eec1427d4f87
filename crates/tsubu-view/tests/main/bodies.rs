//! Bodies that are no spheres in a real browser: drawn, and picked, as they are.

use crate::chromium::Page;
use crate::support::Served;
use std::path::Path;
use tsubu_frame::series::{Formats, FrameWriter};
use tsubu_frame::{FileError, Frame, Kind};
use tsubu_view::embedded::{Run, embed};

/// Side by side from the left: an ellipsoid that was long along x and stands upright now, an upright bar with flat faces, a ball; a radius of 1 holds each.
fn bodies() -> Frame {
    let mut frame = Frame { time: 0.5, ..Frame::default() };
    let half = 0.5_f64.sqrt();
    frame.integer(Kind::Grain, "id", "-", vec![4, 5, 6]);
    frame.vector(Kind::Grain, "position", "m", vec![[-3.0, 0.5, 0.0], [0.0, 0.0, 0.0], [3.0, 0.0, 0.0]]);
    frame.scalar(Kind::Grain, "radius", "m", vec![1.0; 3]);
    frame.quaternion(
        Kind::Grain,
        "orientation",
        vec![[half, 0.0, -half, 0.0], [1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]],
    );
    frame.vector(Kind::Grain, "semi-axes", "m", vec![[1.0, 0.2, 0.2], [1.0; 3], [1.0; 3]]);
    frame.scalar(Kind::Grain, "profile exponent", "-", vec![2.0; 3]);
    frame.scalar(Kind::Grain, "equator exponent", "-", vec![2.0; 3]);
    frame.integer(Kind::Grain, "polyhedron", "-", vec![-1, 0, -1]);
    let sides = [0, 1, 2].into_iter().flat_map(|axis| {
        [1.0, -1.0].map(|sign| {
            let mut normal = [0.0; 3];
            normal[axis] = sign;
            normal
        })
    });
    frame.vector(Kind::Global, "polyhedron normal", "-", sides.collect());
    frame.scalar(Kind::Global, "polyhedron offset", "-", vec![0.1, 0.1, 0.1, 0.1, 0.48, 0.48]);
    frame.integer(Kind::Global, "polyhedron of face", "-", vec![0; 6]);
    frame.scalar(Kind::Global, "polyhedron rounding", "-", vec![0.02]);
    frame
}

/// Where the page shows places off the middles of the three; what was told at the side has made room by then.
fn places(page: &mut Page, off: [f64; 3]) -> [[f64; 2]; 3] {
    page.colours(&[]);
    [[-3.0, 0.5, 0.0], [0.0; 3], [3.0, 0.0, 0.0]].map(|middle| page.place(0, [0, 1, 2].map(|k| middle[k] + off[k])))
}

/// All three reach up, and the ball alone to the side.
fn as_they_are(page: &mut Page) {
    const UP: [f64; 3] = [0.0, 0.0, 0.85];
    const ASIDE: [f64; 3] = [0.85, 0.0, 0.0];
    let mut seen = |off| {
        let places = places(page, off);
        page.colours(&places).iter().map(|colour| colour.iter().any(|part| *part < 250)).collect::<Vec<_>>()
    };
    assert_eq!(seen(UP), [true, true, true]);
    assert_eq!(seen(ASIDE), [false, false, true], "nothing is seen beside what is slender");
    for (k, id) in (4..7).enumerate() {
        let place = places(page, UP)[k];
        page.click(place);
        page.wait(&format!("document.getElementById('grain').innerText.includes('grain {id}')"));
    }
    let place = places(page, ASIDE)[0];
    page.click(place);
    page.wait("document.getElementById('grain').hidden");
}

fn written(folder: &Path) {
    std::fs::create_dir(folder.join("frames")).expect("a folder");
    let mut writer = FrameWriter::create(folder, Formats::default());
    writer.write(&bodies()).expect("written");
    writer.flush().expect("written");
}

#[test]
fn bodies_are_drawn_and_picked_as_they_are() {
    let folder = tempfile::tempdir().expect("a folder");
    written(folder.path());
    let served = Served::of(&[folder.path()]);
    let Some(mut page) = Page::ready(&served.address) else { return };
    as_they_are(&mut page);
}

#[test]
fn a_page_from_the_disk_draws_them_too() {
    let mut read = |_| Ok::<Frame, FileError>(bodies());
    let html = embed(1, &Run::default(), &mut read).expect("read").expect("frames").html;
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("page.html");
    std::fs::write(&path, html).expect("written");
    let Some(mut page) = Page::ready(&format!("file://{}", path.display())) else { return };
    as_they_are(&mut page);
}
