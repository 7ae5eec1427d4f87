//! Cases of run folders that are resumed: damaged checkpoints, and whole ones that say what cannot be.

use crate::bundle::Bundle;
use crate::draw::Draw;
use crate::outcome::Outcome;
use crate::reading::{self, Expect};
use crate::seeds::root;
use crate::spoil;
use std::path::Path;
use std::sync::OnceLock;

use tsubu::interrupt::Interrupt;
use tsubu::interrupt::Watcher;
use tsubu::run::run;
use tsubu_frame::state::Section;
use tsubu_frame::{Existing, State, checkpoint};
use tsubu_scene::Scene;

const STATE: &str = "checkpoint/state.tsubu";

/// A scene, how long it runs before it is cut [s], and what else is changed.
const RUNS: &[(&str, f64, &[&str])] = &[
    ("hops", 0.001, &[]),
    ("saltation", 0.01, &[]),
    ("damper", 0.05, &["method=\"lattice\""]),
    ("damper", 0.05, &["method=\"lattice\"", "lattice.ball-radius=2"]),
    ("collapse", 0.02, &["method=\"cl-ca\""]),
    ("voids", 0.5, &[]),
    ("gas-pipe", 0.02, &[]),
    ("press", 0.0005, &[]),
];

/// A folder of a run that ended half way, and the change that makes it go on.
fn folders() -> &'static [Bundle] {
    static FOLDERS: OnceLock<Vec<Bundle>> = OnceLock::new();
    FOLDERS.get_or_init(|| RUNS.iter().filter_map(|(name, time, changes)| folder(name, *time, changes)).collect())
}

fn folder(name: &str, time: f64, changes: &[&str]) -> Option<Bundle> {
    let mut changes: Vec<String> = changes.iter().map(|text| (*text).to_owned()).collect();
    changes.push(format!("duration={time}"));
    changes.push(format!("output.history-interval={}", time / 10.0));
    let scene = Scene::read(&root().join("scenes").join(name).with_extension("toml"), &changes).ok()?;
    let folder = tempfile::tempdir().ok()?;
    run(&scene, folder.path(), Existing::Overwrite, &watcher(&Interrupt::new())).ok()?;
    // The time it took is not the same the next time.
    let (header, mut state) = checkpoint::read(&folder.path().join(STATE)).ok()?;
    state.put_real("run.wall-seconds", vec![0.0]);
    checkpoint::write(folder.path(), &state, &header).ok()?;
    let longer = serde_json::to_vec(&[format!("duration={}", 1.5 * time)]).ok()?;
    let mut bundle = Bundle::read(folder.path()).ok()?.with("changes.json", longer);
    bundle.retain(|name| !name.starts_with("frames/") && !["summary.json", "check.txt"].contains(&name));
    Some(bundle)
}

fn watcher(interrupt: &Interrupt) -> Watcher<'_> {
    Watcher { interrupt, progress: &|_| () }
}

/// A folder with one damage.
pub fn draw(draw: &mut Draw) -> Bundle {
    let folder = draw.pick(folders());
    let other = draw.pick(folders());
    let whole = folder.bytes(STATE).unwrap_or_default();
    let mut bundle = folder.clone();
    let (change, expect) = match draw.below(4) {
        0 => {
            let names: Vec<&str> = folder.names().filter(|name| ![STATE, "changes.json"].contains(name)).collect();
            let name = *draw.pick(&names);
            let spoilt =
                spoil::bytes(draw, folder.bytes(name).unwrap_or_default(), other.bytes(name).unwrap_or_default());
            bundle.put(name, spoilt);
            ("another file damaged", Expect::Survive)
        }
        1 => {
            let spoilt = spoil::bytes(draw, whole, other.bytes(STATE).unwrap_or_default());
            let refuse = spoilt != whole;
            bundle.put(STATE, spoilt);
            ("damaged bytes", if refuse { Expect::Refuse } else { Expect::Survive })
        }
        _ => match forged(draw, whole) {
            Some((bytes, change, expect)) => {
                bundle.put(STATE, bytes);
                (change, expect)
            }
            None => ("", Expect::Survive),
        },
    };
    expect.of(change, bundle, &Bundle::default())
}

/// A checkpoint whose checksums are right and whose content is not.
fn forged(draw: &mut Draw, whole: &[u8]) -> Option<(Vec<u8>, &'static str, Expect)> {
    let folder = tempfile::tempdir().ok()?;
    Bundle::default().with(STATE, whole).write(folder.path()).ok()?;
    let (mut header, state) = checkpoint::read(&folder.path().join(STATE)).ok()?;
    let mut sections: Vec<(String, Section)> =
        state.sections().map(|(name, section)| (name.to_owned(), section.clone())).collect();
    let at = draw.below(sections.len());
    let mut expect = Expect::Survive;
    let change = match draw.below(10) {
        0 => {
            header.scene_hash.push('0');
            expect = Expect::Refuse;
            "of another scene"
        }
        1 => {
            "9.9.9".clone_into(&mut header.tsubu_version);
            expect = Expect::Refuse;
            "of another version"
        }
        2 => {
            header.time *= 1.25;
            expect = Expect::Refuse;
            "of another time"
        }
        3 => {
            header.step = draw.whole();
            "of another step"
        }
        4 => {
            sections.remove(at);
            "without a section"
        }
        5 => {
            sections[at].0.push('x');
            "with a section of another name"
        }
        6 => {
            let other = sections[draw.below(sections.len())].1.clone();
            sections[at].1 = other;
            "with the content of another section"
        }
        _ => {
            forge(draw, &mut sections[at].1);
            "with another content"
        }
    };
    let mut state = State::default();
    for (name, section) in sections {
        state.insert(name, section);
    }
    checkpoint::write(folder.path(), &state, &header).ok()?;
    Some((std::fs::read(folder.path().join(STATE)).ok()?, change, expect))
}

/// Numbers that were never written, or not so many.
fn forge(draw: &mut Draw, section: &mut Section) {
    const REAL: &[f64] = &[0.0, -1.0, 1e300, -1e300, 1e-300, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    const WHOLE: &[i64] = &[0, -1, 1, i64::MAX, i64::MIN, 1 << 31, 1 << 53, 1_000_000];
    match section {
        Section::Real(numbers) => list(draw, numbers.to_mut(), REAL),
        Section::Integer(numbers) => list(draw, numbers, WHOLE),
        Section::Index(numbers) => list(draw, numbers.to_mut(), &[0, 1, u32::MAX]),
        Section::Text(text) => text.push('x'),
    }
}

fn list<T: Copy>(draw: &mut Draw, numbers: &mut Vec<T>, nasty: &[T]) {
    let value = *draw.pick(nasty);
    match draw.below(4) {
        0 => drop(numbers.pop()),
        1 => numbers.push(value),
        2 => numbers.iter_mut().for_each(|number| *number = value),
        _ if numbers.is_empty() => numbers.push(value),
        _ => {
            let at = draw.below(numbers.len());
            numbers[at] = value;
        }
    }
}

/// Resumes the run in a folder.
pub fn judge(bundle: &Bundle, folder: &Path) -> Result<Outcome, String> {
    let folder = folder.join("run");
    let Ok(scene) = reading::read(bundle, &folder) else { return Ok(Outcome::Refused) };
    bundle.write(&folder).map_err(|error| error.to_string())?;
    let done = run(&scene, &folder, Existing::Resume, &watcher(&Interrupt::new()));
    let _ = std::fs::remove_dir_all(&folder);
    match (done, Expect::read(bundle)) {
        (Ok(_), Expect::Refuse) => Err(format!("accepted ({})", bundle.text("expect").unwrap_or_default().trim())),
        (Ok(_), _) => Ok(Outcome::Accepted),
        (Err(_), _) => Ok(Outcome::Refused),
    }
}
