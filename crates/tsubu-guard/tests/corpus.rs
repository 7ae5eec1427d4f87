//! What was once found must not come back.

use std::path::Path;
use std::process::Command;
use tsubu_guard::corpus;
use tsubu_guard::kind::Kind;

fn replay(kind: Kind, cases: &[std::path::PathBuf]) -> (bool, String) {
    let done = Command::new(env!("CARGO_BIN_EXE_tsubu-guard")).args(["replay", kind.name()]).args(cases).output();
    let done = done.expect("the guard starts");
    (done.status.success(), String::from_utf8_lossy(&done.stdout).into_owned())
}

#[test]
fn what_was_found_holds() {
    for kind in Kind::ALL {
        let cases = corpus::cases(&corpus::folder(), kind).expect("a folder of cases");
        let (held, text) = replay(kind, &cases);
        assert!(held, "{}:\n{text}", kind.name());
    }
}

/// The guard itself: a scene that is right, said to be one that must be refused, is found.
#[test]
fn a_case_that_does_not_hold_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/drop.toml");
    std::fs::copy(scene, folder.path().join("scene.toml")).expect("a copy");
    let cases = [folder.path().to_path_buf()];
    assert!(replay(Kind::Scenes, &cases).0);
    std::fs::write(folder.path().join("expect"), "refuse").expect("written");
    let (held, text) = replay(Kind::Scenes, &cases);
    assert!(!held && text.contains("accepted (refuse)"), "{text}");
}
