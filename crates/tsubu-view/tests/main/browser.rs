//! The page in a real browser. Where there is none, these tests say so and pass.

use crate::chromium::Page;
use crate::support::{Served, go_on, run_folder};

const DARKEST: [u8; 3] = [68, 1, 84];
const BRIGHTEST: [u8; 3] = [253, 231, 37];
const PAPER: [u8; 3] = [255, 255, 255];

/// Whether colours are the same but for rounding.
fn near(a: [u8; 3], b: [u8; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 3)
}

#[test]
fn grains_have_their_place_size_and_colour() {
    let folder = run_folder(3);
    let served = Served::of(&[folder.path()]);
    let Some(mut page) = Page::ready(&served.address) else { return };
    let points = [[-1.0, 0.0], [-1.35, 0.0], [1.0, 0.0], [1.0, 0.35], [0.0, 0.0], [-1.0, 0.56], [-1.56, 0.0]];
    let places = points.map(|[x, z]| page.place(0, [x, 0.0, z]));
    let wanted = [DARKEST, DARKEST, BRIGHTEST, BRIGHTEST, PAPER, PAPER, PAPER];
    let seen = page.colours(&places);
    for ((point, seen), wanted) in points.iter().zip(seen).zip(wanted) {
        assert!(near(seen, wanted), "{point:?}: {seen:?}, not {wanted:?}");
    }
    // By group the same grains have the ends of the palette, by radius one colour.
    page.value("document.getElementById('colour').value = 'radius'; document.getElementById('colour').onchange()");
    page.wait("document.querySelector('#legend .title').textContent === 'radius [m]'");
    page.wait("tsubu.state.colour === 'radius' && !tsubu.player.busy");
    let seen = page.colours(&places);
    assert!(near(seen[0], seen[2]) && !near(seen[0], DARKEST), "{seen:?}");
    // Dark paper, and a cut that leaves the left grain.
    page.press("d");
    page.value("document.getElementById('cut-axis').value = 'x'; document.getElementById('cut-axis').onchange()");
    let seen = page.colours(&places);
    assert!(near(seen[4], [20, 23, 28]) && near(seen[2], seen[4]) && !near(seen[0], seen[4]), "{seen:?}");
    let foreign =
        "performance.getEntriesByType('resource').filter(({ name }) => !name.startsWith(location.href)).length";
    assert_eq!(page.value(foreign), 0, "something was loaded from elsewhere");
}

#[test]
fn time_goes_by_keys_and_by_playing() {
    let folder = run_folder(4);
    let served = Served::of(&[folder.path()]);
    let Some(mut page) = Page::ready(&served.address) else { return };
    page.press("ArrowRight");
    page.wait("tsubu.player.number === 1");
    let risen = page.place(0, [1.0, 0.0, 0.2]);
    assert!(near(page.colours(&[risen])[0], BRIGHTEST));
    page.wait("document.getElementById('now').textContent === '0.1 s, frame 2 of 4'");
    page.press("End");
    page.wait("tsubu.player.number === 3");
    page.press(" ");
    page.wait("tsubu.player.playing && tsubu.player.number < 3");
    page.value("document.getElementById('speed').value = 10; document.getElementById('speed').onchange()");
    page.wait("!tsubu.player.playing && tsubu.player.number === 3");
}

#[test]
fn a_grain_that_is_clicked_tells_its_numbers() {
    let folder = run_folder(3);
    let served = Served::of(&[folder.path()]);
    let Some(mut page) = Page::ready(&served.address) else { return };
    let place = page.place(0, [1.1, 0.0, 0.1]);
    page.click(place);
    page.wait("document.getElementById('grain').innerText.includes('grain 9')");
    page.wait("document.getElementById('grain').innerText.includes('velocity [m/s]\\t0 0 2')");
    page.press("ArrowRight");
    page.wait("document.getElementById('grain').innerText.includes('1 0 0.2')");
    let place = page.place(0, [0.0, 0.0, 0.0]);
    page.click(place);
    page.wait("document.getElementById('grain').hidden");
}

#[test]
fn two_runs_share_camera_clock_and_colours() {
    let (long, short) = (run_folder(4), run_folder(2));
    let served = Served::of(&[short.path(), long.path()]);
    let Some(mut page) = Page::ready(&served.address) else { return };
    // The long one gives the clock.
    page.press("End");
    page.wait("tsubu.player.number === 3");
    let places = [page.place(0, [1.0, 0.0, 0.2]), page.place(1, [1.0, 0.0, 0.6])];
    assert!(places[1] != places[0]);
    for seen in page.colours(&places) {
        assert!(near(seen, BRIGHTEST), "{seen:?}");
    }
}

/// Who looks at the last frame of a run that goes on is taken along; who looks at an earlier one is left there.
#[test]
fn a_run_that_goes_on_is_followed() {
    let folder = run_folder(2);
    let served = Served::of(&[folder.path()]);
    let Some(mut page) = Page::ready(&served.address) else { return };
    page.press("End");
    page.wait("tsubu.player.number === 1");
    go_on(folder.path(), 1, 4);
    page.wait("tsubu.player.number === 3 && !tsubu.player.busy");
    let risen = page.place(0, [1.0, 0.0, 0.6]);
    assert!(near(page.colours(&[risen])[0], BRIGHTEST));
    page.press("ArrowLeft");
    page.wait("tsubu.player.number === 2");
    go_on(folder.path(), 3, 6);
    page.wait("tsubu.player.times.length === 6");
    assert_eq!(page.value("tsubu.player.number"), 2);
}

#[test]
fn a_picture_is_a_png_with_the_grains_in_it() {
    let folder = run_folder(1);
    let served = Served::of(&[folder.path()]);
    let Some(mut page) = Page::ready(&served.address) else { return };
    let size = page.value(
        "import(new URL('page/screenshot.js', location.href).href)
            .then(({ picture }) => picture(tsubu.stage, { title: 't', ends: [{ text: '1' }], now: 'n' }))
            .then(async (blob) => [blob.type, blob.size, (await createImageBitmap(blob)).width === tsubu.stage.canvas.width])",
    );
    assert_eq!((size[0].as_str(), size[2].as_bool()), (Some("image/png"), Some(true)));
    assert!(size[1].as_u64() > Some(2000), "{size}");
}

#[test]
fn a_server_that_is_gone_and_a_wrong_token_are_told() {
    let folder = run_folder(9);
    let mut served = Served::of(&[folder.path()]);
    let wrong = served.address.replace(&served.token, &"0".repeat(32));
    let Some(mut page) = Page::open(&wrong) else { return };
    page.wait("document.body?.textContent.includes('refused') === true");
    let Some(mut page) = Page::ready(&served.address) else { return };
    served.end();
    page.press("End");
    page.wait("document.getElementById('message').textContent.includes('does not answer')");
    page.wait("!document.getElementById('message').hidden");
}
