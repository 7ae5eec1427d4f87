//! Folders, whole files, the summary.

use std::fs;
use std::io::Write as _;

use tsubu_frame::whole::write_atomically;
use tsubu_frame::{Claim, Existing, FileError, Named, ResultValue, RunFolder, Source, Status, Summary};

const NONE: [&str; 0] = [];

#[test]
fn a_used_folder_is_refused_with_both_ways_out() {
    let parent = tempfile::tempdir().unwrap();
    let path = parent.path().join("out");
    let folder = RunFolder::create(&path, Existing::Refuse, NONE).unwrap();
    folder.write("summary.json", b"{}").unwrap();
    drop(folder);
    let error = RunFolder::create(&path, Existing::Refuse, NONE).unwrap_err().to_string();
    for word in ["out", "--resume", "--overwrite", "-o"] {
        assert!(error.contains(word), "{error}");
    }
}

/// What a name of ours stood on was taken for ours and removed: `mkdir s; cp drop.toml s/scene.toml; tsubu run s -o s --overwrite`
/// lost the user's scene, and a folder that tsubu never wrote lost its `report.html`.
#[test]
fn what_tsubu_did_not_write_is_never_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let names = ["scene.toml", "report.html", "frames/", "watch/a.csv"];
    for mine in ["scene.toml", "report.html", "frames/film.mp4", "watch/a.csv", "watch", "frames"] {
        let path = folder.path().join(mine);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, "mine").unwrap();
        for existing in [Existing::Overwrite, Existing::Refuse, Existing::Resume] {
            let error = RunFolder::create(folder.path(), existing, names).unwrap_err();
            let named =
                matches!(&error, FileError::Foreign { path: found } if path.starts_with(found) || found == &path);
            assert!(existing != Existing::Overwrite || named, "{mine}: {error}");
            assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
        }
        let error = RunFolder::open(folder.path(), names).unwrap_err();
        assert!(matches!(error, FileError::Foreign { .. }), "{mine}: {error}");
        assert!(!folder.path().join(".tsubu").exists(), "{mine}: something is left behind");
        fs::remove_file(&path).unwrap();
        for emptied in ["frames", "watch"] {
            let _ = fs::remove_dir(folder.path().join(emptied));
        }
    }
    // Beside them there is room.
    fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    fs::create_dir(folder.path().join("frames")).unwrap();
    let folder_of_ours = RunFolder::create(folder.path(), Existing::Overwrite, names).unwrap();
    folder_of_ours.write("report.html", b"ours").unwrap();
    drop(folder_of_ours);
    RunFolder::create(folder.path(), Existing::Overwrite, names).unwrap();
    assert!(folder.path().join("notes.txt").exists() && !folder.path().join("report.html").exists());
}

#[test]
fn an_edited_scene_is_the_users() {
    let parent = tempfile::tempdir().unwrap();
    let path = parent.path().join("out");
    let folder = RunFolder::create(&path, Existing::Refuse, NONE).unwrap();
    folder.write_editable("scene.toml", b"first").unwrap();
    // Written again with another content, as by a run that goes on: both are ours.
    folder.write_editable("scene.toml", b"second").unwrap();
    folder.write("history.csv", b"").unwrap();
    drop(folder);
    for ours in ["first", "second"] {
        fs::write(path.join("scene.toml"), ours).unwrap();
        drop(RunFolder::create(&path, Existing::Resume, ["scene.toml"]).unwrap());
    }
    fs::write(path.join("scene.toml"), "second, with my remarks").unwrap();
    for (existing, names) in
        [(Existing::Overwrite, &["scene.toml"][..]), (Existing::Resume, &["scene.toml"]), (Existing::Overwrite, &[])]
    {
        let error = RunFolder::create(&path, existing, names).unwrap_err();
        assert!(matches!(error, FileError::Edited { .. }), "{error}");
    }
    assert!(path.join("history.csv").exists(), "part of the folder was cleared before it was refused");
}

/// Whole folders were removed, whatever a user had put into them, and files with names of their own stayed for ever.
#[test]
fn overwrite_tells_ours_from_theirs_in_every_folder() {
    let parent = tempfile::tempdir().unwrap();
    let path = parent.path().join("out");
    let ours = [
        "walls-tray.obj",
        "figures/speed.svg",
        "watch/slope.csv",
        "watch/index.json",
        "frames/grains_000123.vtp",
        "frames/walls.pvd",
        "frames/.grains_000124.vtp.tmp",
        "checkpoint/state.tsubu",
        "cases/0003/history.csv",
        "cases/0003/walls-tray.obj",
        "dem/frames/contacts_1000000.vtp",
        "locked/summary.json",
    ];
    let theirs = [
        "walls-mine.obj",
        "figures/mine.svg",
        "frames/grains_best.vtp",
        "frames/film.mp4",
        "checkpoint/older.tsubu",
        "cases/notes.txt",
        "cases/0004/summary.json",
        "dem/notes.txt",
    ];
    let folder = RunFolder::create(&path, Existing::Refuse, NONE).unwrap();
    folder.claim(["walls-tray.obj", "figures/speed.svg", "watch/slope.csv", "watch/index.json", "frames/"]).unwrap();
    folder.claim(["checkpoint/state.tsubu", "cases/", "dem/", "locked/"]).unwrap();
    for (inner, names) in
        [("cases/0003", &["history.csv", "walls-tray.obj"][..]), ("dem", &["frames/"]), ("locked", &["summary.json"])]
    {
        RunFolder::create(path.join(inner), Existing::Refuse, NONE).unwrap().claim(names).unwrap();
    }
    drop(folder);
    for name in ours.iter().chain(&theirs) {
        let file = path.join(name);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, "").unwrap();
    }
    fs::write(parent.path().join("outside.txt"), "mine").unwrap();
    fs::create_dir(parent.path().join("elsewhere")).unwrap();
    fs::write(parent.path().join("elsewhere/summary.json"), "mine").unwrap();
    let altered = fs::read_to_string(path.join(".tsubu")).unwrap() + "../outside.txt\n../elsewhere/\n";
    fs::write(path.join(".tsubu"), altered).unwrap();
    RunFolder::create(&path, Existing::Overwrite, NONE).unwrap();
    for name in ours {
        assert!(!path.join(name).exists(), "{name} stays");
    }
    for name in theirs {
        assert!(path.join(name).exists(), "{name} is gone");
    }
    assert!(parent.path().join("outside.txt").exists() && parent.path().join("elsewhere/summary.json").exists());
    assert!(!path.join("locked").exists() && !path.join("watch").exists() && !path.join("cases/0003").exists());
}

/// Two runs into one folder left a history with rows missing, and both ended well.
#[test]
fn one_at_a_time() {
    let parent = tempfile::tempdir().unwrap();
    let path = parent.path().join("out");
    let first = RunFolder::create(&path, Existing::Refuse, NONE).unwrap();
    first.claim(["dem/"]).unwrap();
    let inner = RunFolder::create(path.join("dem"), Existing::Refuse, NONE).unwrap();
    let locked = |error: FileError, at: &str| {
        assert!(matches!(&error, FileError::Locked { path: lock } if lock.ends_with(at)), "{error}");
    };
    for existing in [Existing::Refuse, Existing::Overwrite, Existing::Resume] {
        locked(RunFolder::create(&path, existing, NONE).unwrap_err(), "out/.tsubu");
    }
    locked(RunFolder::open(&path, NONE).unwrap_err(), "out/.tsubu");
    drop(first);
    locked(RunFolder::create(&path, Existing::Overwrite, NONE).unwrap_err(), "dem/.tsubu");
    drop(inner);
    RunFolder::create(&path, Existing::Overwrite, NONE).unwrap();
}

/// Frames were written through a link, and the history behind one would have been cut.
#[test]
#[cfg(unix)]
fn nothing_is_written_through_a_link() {
    let parent = tempfile::tempdir().unwrap();
    let (path, elsewhere) = (parent.path().join("out"), parent.path().join("elsewhere"));
    let folder = RunFolder::create(&path, Existing::Refuse, NONE).unwrap();
    folder.claim(["frames/", "history.csv"]).unwrap();
    drop(folder);
    fs::create_dir(&elsewhere).unwrap();
    fs::write(elsewhere.join("grains_000000.vtp"), "mine").unwrap();
    for (name, target) in [("frames", &elsewhere), ("history.csv", &elsewhere.join("grains_000000.vtp"))] {
        std::os::unix::fs::symlink(target, path.join(name)).unwrap();
        for existing in [Existing::Overwrite, Existing::Resume] {
            let error = RunFolder::create(&path, existing, ["frames/", "history.csv"]).unwrap_err();
            assert!(matches!(&error, FileError::Link { path: link } if link.ends_with(name)), "{error}");
        }
        fs::remove_file(path.join(name)).unwrap();
    }
    // The folder itself may stand anywhere.
    std::os::unix::fs::symlink(&path, parent.path().join("linked")).unwrap();
    RunFolder::create(parent.path().join("linked"), Existing::Overwrite, ["frames/"]).unwrap();
    assert!(elsewhere.join("grains_000000.vtp").exists());
}

#[test]
fn resume_needs_a_folder() {
    let parent = tempfile::tempdir().unwrap();
    let error = RunFolder::create(parent.path().join("none"), Existing::Resume, NONE).unwrap_err();
    assert!(error.to_string().contains("leave out --resume"), "{error}");
}

#[test]
fn a_failed_write_leaves_the_old_file_and_no_litter() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    fs::write(&path, "old").unwrap();
    let error = write_atomically(&path, |out| {
        out.write_all(b"half of the new")?;
        Err(std::io::ErrorKind::StorageFull.into())
    })
    .unwrap_err();
    assert!(error.is_disk_full() && error.to_string().contains("scene.toml"), "{error}");
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

/// `/dev/full` takes every open and refuses every write, as a full disk does.
#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_an_error_with_the_name() {
    let error = fs::File::options()
        .write(true)
        .open("/dev/full")
        .and_then(|mut f| std::io::Write::write_all(&mut f, b"x"))
        .map_err(FileError::write(std::path::Path::new("out/history.csv")))
        .unwrap_err();
    assert!(error.is_disk_full() && error.to_string().contains("history.csv"), "{error}");
}

#[test]
fn the_summary_comes_back_in_order_and_survives_not_a_number() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("summary.json");
    let mut summary = Summary { status: Status::Interrupted, contacts_mean: f64::NAN, ..Summary::default() };
    summary.energy.terms.insert("kinetic", 1.5);
    summary.energy.terms.insert("dissipated by friction", 0.1 + 0.2);
    summary.energy.terms.insert("a", f64::NAN);
    summary.energy.residual_relative = f64::INFINITY;
    summary.results.insert("peak", 4.083_61);
    summary.results.insert("phases", vec![0.1, f64::NAN]);
    summary.claims.push(Claim::judge("peak", f64::NAN, Some(4.0), None, Source::scene("closed form")));
    summary.write(&path).unwrap();
    let back = Summary::read(&path).unwrap();
    let names: Vec<_> = back.energy.terms.iter().map(|(n, _)| n.to_owned()).collect();
    assert_eq!(names, ["kinetic", "dissipated by friction", "a"]);
    assert_eq!(back.energy.terms.get("dissipated by friction").unwrap().0, 0.1 + 0.2);
    assert!(back.contacts_mean.is_nan() && back.energy.residual_relative.is_nan());
    assert_eq!(back.results.get("peak"), Some(&ResultValue::Number(4.083_61)));
    assert!(matches!(back.results.get("phases"), Some(ResultValue::List(v)) if v[0] == 0.1 && v[1].is_nan()));
    assert!(!back.claims[0].pass);
}

#[test]
fn the_summary_has_the_keys_users_build_on() {
    let text = serde_json::to_value(Summary::default()).unwrap();
    let keys: Vec<_> = text.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(
        keys,
        [
            "tsubu_version",
            "status",
            "method",
            "dimension",
            "particles",
            "steps",
            "time_step",
            "simulated_seconds",
            "wall_seconds",
            "threads",
            "particle_steps_per_second",
            "contacts_mean",
            "energy",
            "state_hash",
            "results",
            "claims",
            "warnings"
        ]
    );
    assert_eq!(text["status"], "finished");
    assert_eq!(text["energy"]["residual_relative"], 0.0);
}

#[test]
fn claims_include_the_ends_of_their_range() {
    let pass = |x| Claim::judge("n", x, Some(1.0), Some(2.0), Source::scene("s")).pass;
    assert!(pass(1.0) && pass(2.0) && !pass(2.000_000_1) && !pass(f64::NAN));
    let named: Named<f64> = [("a", 1.0), ("b", 2.0), ("a", 3.0)].into_iter().collect();
    assert_eq!((named.len(), named.get("a")), (2, Some(&3.0)));
}
