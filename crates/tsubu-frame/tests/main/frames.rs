//! Snapshots: written, read back, indexed, resumed.

use std::path::Path;
use std::process::Command;

use proptest::prelude::*;
use tsubu_frame::{Formats, Frame, FrameWriter, Kind, read_frame, snapshots, vtp_read};

const ALL: Formats = Formats { contacts: true, xyz: true, lammps: true };

fn sample(time: f64) -> Frame {
    let mut frame = Frame { time, step: (time * 1e4) as u64, ..Frame::default() };
    frame.vector(Kind::Grain, "position", "m", vec![[0.1, 0.2, 0.0], [0.3, 0.1 + 0.2, -0.0]]);
    frame.vector(Kind::Grain, "velocity", "m/s", vec![[1.0, 0.0, 0.0], [0.0, -1e-12, 0.0]]);
    frame.scalar(Kind::Grain, "radius", "m", vec![0.003, 0.003]);
    frame.integer(Kind::Grain, "id", "-", vec![0, 1]);
    frame.vector(Kind::Contact, "position", "m", vec![[0.2, 0.2, 0.0]]);
    frame.vector(Kind::Contact, "force", "N", vec![[0.0, 5.0, 0.0]]);
    frame.scalar(Kind::Contact, "overlap", "m", vec![1e-6]);
    frame.integer(Kind::Contact, "first", "-", vec![1]);
    frame.integer(Kind::Contact, "second", "-", vec![-1]);
    let corners = [[0.0, 0.0, 0.0], [0.5, 0.0, 0.0], [0.5, 0.4, 0.0], [0.0, 0.4, 0.0]];
    let triangle = vec![[0.1, 0.0, 0.0], [0.1, 0.1, 0.0], [0.1, 0.1, 0.125]];
    let walls = [corners.to_vec(), triangle, vec![[0.1, 0.0, 0.0], [0.1, 0.1, 0.0]]].concat();
    frame.vector(Kind::Surface, "position", "m", walls);
    frame.integer(Kind::Surface, "outline", "-", vec![0, 0, 0, 0, 1, 1, 1, 2, 2]);
    frame.integer(Kind::Surface, "face", "-", vec![0, 0, 0, 0, 1, 1, 1, 0, 0]);
    frame.quaternion(Kind::Grain, "orientation", vec![[1.0, 0.0, 0.0, 0.0], [0.8, 0.0, 0.6, 0.0]]);
    frame.scalar(Kind::Global, "host displacement", "m", vec![0.004]);
    frame
}

fn same(a: &Frame, b: &Frame) {
    assert_eq!((a.time, a.step), (b.time, b.step));
    for column in &a.columns {
        let back = b.column(column.kind, column.name).unwrap_or_else(|| panic!("no {}", column.name));
        assert_eq!(back, column);
    }
    assert_eq!(a.columns.len(), b.columns.len());
}

#[test]
fn a_snapshot_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let mut writer = FrameWriter::create(folder.path(), ALL);
    writer.write(&sample(0.0)).unwrap();
    writer.write(&sample(0.25)).unwrap();
    let found = snapshots(folder.path()).unwrap();
    assert_eq!(found.iter().map(|s| s.time).collect::<Vec<_>>(), [0.0, 0.25]);
    same(&sample(0.25), &read_frame(&found[1].path).unwrap());
}

/// A snapshot of which contacts come first and grains later is the same, file by file; with the files of grains written once.
#[test]
fn parts_make_the_files_of_the_whole() {
    let [at_once, in_parts] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let whole = sample(0.25);
    let part = |of: fn(Kind) -> bool| {
        let mut part = whole.clone();
        part.columns.retain(|column| of(column.kind) || column.kind == Kind::Global);
        part
    };
    FrameWriter::create(at_once.path(), ALL).write(&whole).unwrap();
    let parts = [part(|kind| kind == Kind::Contact), part(|kind| kind != Kind::Contact)];
    let mut writer = FrameWriter::create(in_parts.path(), ALL);
    writer.write_parts(&parts).unwrap();
    assert_eq!(writer.count(), 1);
    drop(writer);
    let files = |folder: &Path| {
        let entries = std::fs::read_dir(folder.join("frames")).unwrap().map(|entry| entry.unwrap().path());
        let file = |path: std::path::PathBuf| (path.file_name().unwrap().to_owned(), std::fs::read(path).unwrap());
        entries.map(file).collect::<std::collections::BTreeMap<_, _>>()
    };
    assert_eq!(files(in_parts.path()), files(at_once.path()));
    assert_eq!(files(at_once.path()).len(), 8);
}

/// The unit of the time, which stands in every file of a moment, was taken for that of the last column that had been read before:
/// where nothing else stands beside the time, positions came back in seconds.
#[test]
fn positions_come_back_in_metres() {
    let folder = tempfile::tempdir().unwrap();
    let mut frame = sample(0.5);
    frame.columns.retain(|column| column.kind != Kind::Global);
    FrameWriter::create(folder.path(), ALL).write(&frame).unwrap();
    same(&frame, &read_frame(&snapshots(folder.path()).unwrap()[0].path).unwrap());
}

#[test]
fn resumed_snapshots_go_on_with_the_number_after_the_checkpoint() {
    let folder = tempfile::tempdir().unwrap();
    let mut writer = FrameWriter::create(folder.path(), Formats::default());
    for time in [0.0, 0.1, 0.2, 0.3] {
        writer.write(&sample(time)).unwrap();
    }
    writer.sync().unwrap();
    let mut writer = FrameWriter::resume(folder.path(), Formats::default(), 0.1).unwrap();
    assert_eq!(writer.count(), 2);
    assert_eq!(snapshots(folder.path()).unwrap().len(), 4, "cut before all was looked at");
    writer.cut().unwrap();
    assert!(!folder.path().join("frames/grains_000003.vtp").exists());
    writer.write(&sample(0.2)).unwrap();
    writer.sync().unwrap();
    let times: Vec<_> = snapshots(folder.path()).unwrap().iter().map(|s| s.time).collect();
    assert_eq!(times, [0.0, 0.1, 0.2]);
}

/// Every snapshot wrote its index anew: ten thousand of one ball took a minute.
#[test]
fn indices_are_whole_always_and_written_seldom() {
    let folder = tempfile::tempdir().unwrap();
    let mut writer = FrameWriter::create(folder.path(), Formats { contacts: false, ..Formats::default() });
    let mut renewed = 0;
    for k in 0..300 {
        writer.write(&sample(f64::from(k))).unwrap();
        let named = snapshots(folder.path()).unwrap();
        assert!(named.iter().all(|snapshot| snapshot.path.exists()));
        assert!(10 * named.len() >= 9 * (k as usize + 1), "{} of {} are named", named.len(), k + 1);
        renewed += usize::from(named.len() == k as usize + 1);
    }
    assert!(renewed < 60, "the index was written {renewed} times");
    writer.sync().unwrap();
    assert_eq!(snapshots(folder.path()).unwrap().len(), 300);
    assert!(!folder.path().join("frames/contacts_000000.vtp").exists());
    assert!(!folder.path().join("frames/contacts.pvd").exists());
}

#[test]
fn an_empty_moment_and_no_folder_are_no_errors() {
    let folder = tempfile::tempdir().unwrap();
    assert!(snapshots(folder.path()).unwrap().is_empty());
    let mut empty = Frame::default();
    empty.vector(Kind::Grain, "position", "m", vec![]);
    let mut writer = FrameWriter::create(folder.path(), ALL);
    writer.write(&empty).unwrap();
    assert_eq!(read_frame(&snapshots(folder.path()).unwrap()[0].path).unwrap().rows(Kind::Grain), 0);
}

#[test]
fn extended_xyz_reads_as_its_comment_line_says() {
    let folder = tempfile::tempdir().unwrap();
    FrameWriter::create(folder.path(), ALL).write(&sample(0.5)).unwrap();
    let text = std::fs::read_to_string(folder.path().join("frames/grains_000000.xyz")).unwrap();
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines[0], "2");
    assert!(lines[1].contains("Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:id:I:1:orientation:R:4 Time=0.5"));
    assert!(lines[1].starts_with("Lattice=\"0.5 0 0 0 0.4 0 0 0 0.128\" Origin=\"0.0 0.0 -0.003\""));
    assert_eq!(lines[2], "grain 0.1 0.2 0.0 1.0 0.0 0.0 0.003 0 0.0 0.0 0.0 1.0");
    assert_eq!(lines.len(), 4);
}

#[test]
fn a_repeating_world_is_the_cell_of_xyz_and_dump() {
    let folder = tempfile::tempdir().unwrap();
    let mut frame = sample(0.5);
    for (name, value) in
        [("periodic low", [-1.0, 0.0, 0.0]), ("periodic high", [2.0, 0.0, 0.0]), ("periodic", [1.0, 0.0, 0.0])]
    {
        frame.vector(Kind::Global, name, "-", vec![value]);
    }
    FrameWriter::create(folder.path(), ALL).write(&frame).unwrap();
    let read = |name: &str| std::fs::read_to_string(folder.path().join("frames").join(name)).unwrap();
    let xyz = read("grains_000000.xyz");
    assert!(xyz.contains("Lattice=\"3.0 0 0 0 0.4 ") && xyz.contains("Origin=\"-1.0 0.0 "), "{xyz}");
    assert!(xyz.contains("pbc=\"T F F\""), "{xyz}");
    let dump = read("grains_000000.lammpstrj");
    let lines: Vec<&str> = dump.lines().collect();
    assert_eq!(lines[4..9], ["ITEM: TIMESTEP", "5000", "ITEM: NUMBER OF ATOMS", "2", "ITEM: BOX BOUNDS pp ff ff"]);
    assert_eq!(lines[9], "-1.0 2.0");
    assert_eq!(lines[12], "ITEM: ATOMS id type x y z vx vy vz omegax omegay omegaz radius mass");
    assert_eq!(lines[13], "1 1 0.1 0.2 0.0 1.0 0.0 0.0 0.0 0.0 0.0 0.003 0.0");
    assert_eq!(lines.len(), 15);
}

#[test]
fn a_cut_snapshot_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    FrameWriter::create(folder.path(), Formats::default()).write(&sample(0.5)).unwrap();
    let path = folder.path().join("frames/grains_000000.vtp");
    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() / 3]).unwrap();
    let error = read_frame(&path).unwrap_err().to_string();
    assert!(error.contains("grains_000000.vtp"), "{error}");
    assert!(read_frame(Path::new("nowhere/grains_000000.vtp")).is_err());
}

fn bytes_of_sample() -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    FrameWriter::create(folder.path(), Formats::default()).write(&sample(0.5)).unwrap();
    std::fs::read(folder.path().join("frames/grains_000000.vtp")).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn damaged_snapshots_never_panic(flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8), cut in any::<prop::sample::Index>()) {
        let mut bytes = bytes_of_sample();
        for (at, value) in flips {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        let _ = vtp_read::parse(&bytes, Kind::Grain, &mut Frame::default());
        bytes.truncate(cut.index(bytes.len()));
        let _ = vtp_read::parse(&bytes, Kind::Grain, &mut Frame::default());
    }
}

#[test]
#[ignore = "needs Python's vtk: cargo xtask check installs it"]
fn vtk_reads_every_snapshot() {
    let python = std::env::var_os("TSUBU_VTK_PYTHON").unwrap_or_else(|| "python3".into());
    let folder = tempfile::tempdir().unwrap();
    let mut writer = FrameWriter::create(folder.path(), Formats::default());
    for time in [0.0, 0.1, 0.2] {
        writer.write(&sample(time)).unwrap();
    }
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/read_with_vtk.py");
    let out = Command::new(python).arg(script).arg(folder.path().join("frames")).output().unwrap();
    let said = String::from_utf8_lossy(&out.stdout);
    assert!(out.status.success(), "{said}{}", String::from_utf8_lossy(&out.stderr));
    assert!(said.contains("grains: 3 files, 6 points"), "{said}");
    assert!(said.contains("walls: 3 files, 27 points, 9 cells"), "{said}");
    assert!(said.contains("velocity [m/s]"), "{said}");
}

/// The unit of the time in the file of the walls was taken for that of the last column of the grains: positions were in seconds.
#[test]
fn units_stay_with_their_columns() {
    let folder = tempfile::tempdir().unwrap();
    let mut frame = Frame { time: 0.5, ..Frame::default() };
    frame.vector(Kind::Grain, "velocity", "m/s", vec![[0.0; 3]]);
    frame.vector(Kind::Grain, "position", "m", vec![[0.0; 3]]);
    frame.integer(Kind::Surface, "outline", "-", vec![0, 0]);
    frame.vector(Kind::Surface, "position", "m", vec![[0.0; 3], [1.0; 3]]);
    let mut writer = FrameWriter::create(folder.path(), Formats::default());
    writer.write(&frame).unwrap();
    writer.flush().unwrap();
    let read = read_frame(&snapshots(folder.path()).unwrap()[0].path).unwrap();
    for (kind, name, unit) in
        [(Kind::Grain, "velocity", "m/s"), (Kind::Grain, "position", "m"), (Kind::Surface, "position", "m")]
    {
        assert_eq!(read.column(kind, name).map(|column| column.unit), Some(unit), "{name}");
    }
}
