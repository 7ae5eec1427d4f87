//! The page: files that are part of the program.

/// A file of the page by its name: its type and its bytes.
pub fn file(name: &str) -> Option<(&'static str, &'static [u8])> {
    FILES.iter().find(|(known, _)| *known == name).map(|(name, bytes)| (kind(name), *bytes))
}

/// The modules of the page with their texts; for one that carries its frames itself what it asks instead of a server.
pub fn modules(carried: bool) -> impl Iterator<Item = (&'static str, &'static str)> {
    let kept = move |name: &str| !carried || !["server.js", "packet.js", "begin.js"].contains(&name);
    let named = move |name| if carried && name == "embedded.js" { "server.js" } else { name };
    let scripts = FILES.iter().filter(move |(name, _)| kind(name).starts_with("text/javascript") && kept(name));
    scripts.filter_map(move |(name, bytes)| Some((named(name), std::str::from_utf8(bytes).ok()?)))
}

fn kind(name: &str) -> &'static str {
    match name.rsplit_once('.').map(|(_, ending)| ending) {
        Some("html") => "text/html; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        _ => "text/javascript; charset=utf-8",
    }
}

macro_rules! files {
    ($($name:literal)*) => { &[$(($name, include_bytes!(concat!("../page/", $name)))),*] };
}

const FILES: &[(&str, &[u8])] = files![
    "index.html" "style.css" "main.js" "server.js" "packet.js" "stage.js" "pane.js" "camera.js" "grains.js" "bodies.js" "walls.js"
    "bonds.js" "arrows.js" "film.js" "frame_of_reference.js" "palette.js" "legend.js" "scale_bar.js" "player.js" "curves.js" "table.js" "pick.js"
    "begin.js" "embedded.js" "cut.js" "live.js" "status.js" "theme.js" "screenshot.js" "numbers.js" "three.min.js"
];
