//! More of the page in a real browser: arrows, groups, outlines, curves of grains, films, a phone.

use crate::chromium::Page;
use crate::support::{Served, run_folder};
use tsubu_frame::series::{Formats, FrameWriter};
use tsubu_frame::{Frame, Kind};

fn choose(page: &mut Page, what: &str, value: &str) {
    page.value(&format!(
        "(() => {{ const box = document.getElementById('{what}'); box.value = '{value}'; box.onchange(); }})()"
    ));
}

fn near(a: [u8; 3], b: [u8; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 4)
}

#[test]
fn arrows_stand_for_vectors() {
    let folder = run_folder(2);
    let served = Served::of(&[folder.path()]);
    let Some(mut page) = Page::ready(&served.address) else { return };
    // The grain at the right rises at 2 m/s: its arrow is six radii long.
    let place = page.place(0, [1.0, 0.0, 1.5]);
    assert!(near(page.colours(&[place])[0], [255, 255, 255]));
    choose(&mut page, "arrows", "velocity");
    page.wait("document.getElementById('scales').textContent === 'longest arrow: 2 m/s'");
    let seen = page.colours(&[place])[0];
    assert!(near(seen, [0xd9, 0x2d, 0x20]), "{seen:?}");
    let place = page.place(0, [-1.0, 0.0, 1.5]);
    assert!(near(page.colours(&[place])[0], [255, 255, 255]), "the grain at rest has an arrow");
    choose(&mut page, "arrows", "");
    page.wait("document.getElementById('scales').textContent === ''");
}

#[test]
fn groups_have_names_and_colours_of_their_own() {
    let folder = run_folder(2);
    std::fs::write(folder.path().join("scene.toml"), "[particles.sand]\n[particles.gravel.start]\n[walls.floor]\n")
        .expect("written");
    let served = Served::of(&[folder.path()]);
    let Some(mut page) = Page::ready(&served.address) else { return };
    choose(&mut page, "colour", "group");
    page.wait("document.getElementById('legend').innerText.trim().split(/\\s+/).join() === 'group,gravel,sand'");
    page.wait("!tsubu.player.busy");
    let places = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]].map(|point| page.place(0, point));
    let seen = page.colours(&places);
    assert!(near(seen[0], [0, 114, 178]) && near(seen[1], [230, 159, 0]), "{seen:?}");
}

#[test]
fn a_picked_grain_has_a_curve() {
    let folder = run_folder(4);
    let served = Served::of(&[folder.path()]);
    let (status, curve) = served.get("run/0/grain/9?colour=position+z");
    let curve: [Vec<f64>; 2] = serde_json::from_slice(&curve).expect("JSON");
    assert_eq!((status, curve[0].len()), (200, 4));
    assert!(curve[1].iter().zip([0.0, 0.2, 0.4, 0.6]).all(|(a, b)| (a - b).abs() < 1e-12), "{curve:?}");
    // A grain that is nowhere has no value at any time.
    assert!(served.get("run/0/grain/77?colour=radius").1.ends_with(b"[null,null,null,null]]"));
    assert_eq!(served.get("run/0/grain/nine").0, 404);
    let Some(mut page) = Page::ready(&served.address) else { return };
    let place = page.place(0, [1.0, 0.0, 0.0]);
    page.click(place);
    page.wait("document.getElementById('curve').value === 'grain 9: velocity [m/s]'");
    page.wait("document.getElementById('curves').getAttribute('aria-label').startsWith('grain 9: velocity')");
    choose(&mut page, "colour", "position z");
    page.wait("document.getElementById('curve').value === 'grain 9: position z [m]'");
    let nowhere = page.place(0, [0.0, 0.0, 0.0]);
    page.click(nowhere);
    page.wait("document.getElementById('curve').value === 'kinetic energy [J]'");
}

#[test]
fn a_film_is_a_video_of_the_run() {
    let folder = run_folder(4);
    let served = Served::of(&[folder.path()]);
    let Some(mut page) = Page::ready(&served.address) else { return };
    let told = page.value(
        "import(new URL('page/film.js', location.href).href)
            .then(({ film }) => film(tsubu.stage, tsubu.player, () => ({ title: 't', ends: [{ text: '1' }], now: 'n' })))
            .then(async (blob) => [blob.type, blob.size, [...new Uint8Array(await blob.slice(0, 4).arrayBuffer())], tsubu.player.number])",
    );
    // The first bytes of a Matroska file.
    assert_eq!(
        (&told[0], &told[2], &told[3]),
        (&"video/webm".into(), &[0x1a, 0x45, 0xdf, 0xa3].to_vec().into(), &3.into())
    );
    assert!(told[1].as_u64() > Some(1000), "{told}");
}

#[test]
fn grains_that_are_no_discs_have_outlines() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("frames")).expect("a folder");
    let mut frame = Frame { time: 0.5, ..Frame::default() };
    frame.integer(Kind::Grain, "id", "-", vec![0, 1]);
    frame.integer(Kind::Grain, "shape", "-", vec![3, 3]);
    frame.vector(Kind::Grain, "position", "m", vec![[0.0; 3], [4.0, 0.0, 0.0]]);
    frame.scalar(Kind::Grain, "radius", "m", vec![0.2; 2]);
    frame.integer(Kind::Global, "shape of corner", "-", vec![3, 3, 3, 7]);
    frame.vector(Kind::Global, "corner", "m", vec![[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 1.0], [9.0; 3]]);
    let mut writer = FrameWriter::create(folder.path(), Formats::default());
    writer.write(&frame).expect("written");
    writer.flush().expect("written");
    let served = Served::of(&[folder.path()]);
    let Some(mut page) = Page::ready(&served.address) else { return };
    // Three lines round each grain, none by the corners of another shape.
    assert_eq!(page.value("[...tsubu.panes[0].frame.outlines].length"), 2 * 3 * 2 * 3);
    assert_eq!(page.value("Math.max(...tsubu.panes[0].frame.outlines)"), 5);
}

#[test]
fn a_phone_shows_all_of_it() {
    let folder = run_folder(3);
    let served = Served::of(&[folder.path()]);
    let Some(mut page) = Page::blank() else { return };
    page.narrow();
    page.go(&served.address);
    page.wait("window.tsubu?.ready === true");
    assert_eq!(page.value("document.documentElement.scrollWidth <= 390"), true);
    let out = "[...document.querySelectorAll('button, select, input, canvas')].filter((node) => node.offsetParent).filter((node) => {
        const { left, right, bottom } = node.getBoundingClientRect();
        return left < 0 || right > 390 || bottom > 844;
    }).map(({ id }) => id)";
    assert_eq!(page.value(out), serde_json::json!([]), "these are cut off");
    assert_eq!(page.value("document.getElementById('canvas').clientHeight > 300"), true);
}

/// Whoever cannot see the page hears what everything on it is.
#[test]
fn everything_has_a_name() {
    let folder = run_folder(3);
    let served = Served::of(&[folder.path()]);
    let Some(mut page) = Page::ready(&served.address) else { return };
    let nameless = "[...document.querySelectorAll('button, select, input, canvas, [role=img]')]
        .filter((node) => !node.closest('[role=img] canvas'))
        .filter((node) => !node.getAttribute('aria-label') && !node.textContent.trim() && !node.closest('label')).map(({ id }) => id)";
    assert_eq!(page.value(nameless), serde_json::json!([]));
    page.press("ArrowRight");
    page.wait("document.getElementById('time').getAttribute('aria-valuetext').includes('frame 2 of 3')");
}
