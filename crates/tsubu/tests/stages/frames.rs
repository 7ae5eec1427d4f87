//! A run that begins from a frame of another.

use super::{FILL, SILO, go};
use std::path::{Path, PathBuf};
use tsubu_frame::vtp_read::read_frame;
use tsubu_frame::{Existing, Frame, Kind};

/// The frames of a run in the order of their times.
fn frames(folder: &Path) -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder.join("frames")).unwrap().flatten().map(|file| file.path());
    let grains = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().starts_with("grains_");
    let mut all: Vec<PathBuf> = files.filter(grains).collect();
    all.sort();
    all
}

/// Grains stand where they were, move and spin as they did; their contacts begin anew.
#[test]
fn grains_begin_as_they_stood_in_a_frame() {
    let desk = tempfile::tempdir().unwrap();
    let filmed = SILO.replace("[output]", "[output]\nframe-interval = \"40 ms\"");
    go(&format!("{filmed}{FILL}"), &desk.path().join("fill"), Existing::Refuse);
    let all = frames(&desk.path().join("fill"));
    let middle = &all[all.len() / 2];
    let (_, rest) = filmed.split_once("start.stream = ").unwrap();
    let (_, rest) = rest.split_once('\n').unwrap();
    let (head, _) = filmed.split_once("count = 120").unwrap();
    let text = format!(
        "{head}start.file = {{ path = {middle:?}, kind = 1 }}\n{rest}[[stage]]\nname = \"on\"\nduration = \"1 ms\"\n"
    );
    go(&text, &desk.path().join("on"), Existing::Refuse);
    let (was, is) = (read_frame(middle).unwrap(), read_frame(&frames(&desk.path().join("on"))[0]).unwrap());
    for name in ["position", "velocity", "spin"] {
        let column = |frame: &Frame| frame.column(Kind::Grain, name).unwrap().values.clone();
        assert_eq!(column(&was), column(&is), "{name}");
    }
}
