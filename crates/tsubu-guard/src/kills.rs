//! Kills at random moments: a run that was killed and resumed must give what one gives that was left alone.

use crate::draw::Draw;
use crate::seeds::root;
use serde_json::Value;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use std::{fs, io};

/// Command, scene, duration [s], and what else is changed; each takes about a second.
type Run = (&'static str, &'static str, f64, &'static [&'static str]);

/// All kinds of runs: dry grains with watches of every kind, walls that move, hosts, beds that settle, water as a field and
/// by columns, every lattice method, and commands of many runs.
const RUNS: &[Run] = &[
    ("run", "heap", 0.4, &[]),
    ("run", "drum", 0.6, &[]),
    ("run", "hopper", 0.4, &[]),
    ("run", "press", 0.04, &[]),
    ("run", "from-lammps", 0.08, &[]),
    ("run", "shaken-box", 0.08, &[]),
    ("run", "damper", 0.3, &[]),
    ("run", "impact-damper", 15.0, &[]),
    ("run", "hops", 0.2, &[]),
    ("run", "settling", 0.2, &[]),
    ("run", "dam-break", 0.4, &[]),
    ("run", "bedload", 0.2, &[]),
    ("run", "debris-flow", 0.6, &[]),
    ("run", "damper", 2.0, &["method=\"lattice\""]),
    ("run", "collapse", 0.5, &["method=\"cl-ca\""]),
    ("run", "voids", 8.0, &[]),
    ("run", "sorting-chute", 30.0, &[]),
    ("run", "lattice-grains", 0.5, &[]),
    ("run", "gas-channel", 0.08, &[]),
    ("run", "gas-pipe", 2.0, &[]),
    ("run", "elongated-hopper", 0.6, &[]),
    ("run", "poured-silo", 40.0, &[]),
    ("sweep", "drop", 0.3, &["sweep.vary.\"materials.acrylic.restitution\"=[0.5, 0.6, 0.7, 0.8]"]),
    (
        "response",
        "damper",
        1.0,
        &[
            "method=\"lattice\"",
            "response.frequency-ratio=[0.9, 1.0, 1.1]",
            "response.vary.\"particles.balls.count\"=[0, 10]",
            "response.discard-periods=2",
            "response.measure-periods=4",
        ],
    ),
    (
        "atlas",
        "damper",
        1.0,
        &["method=\"lattice\"", "atlas.at-most=20", "atlas.vary.\"particles.balls.count\"=[10, 30]"],
    ),
    ("design", "damper", 1.0, &["method=\"lattice\"", "design.runs=40"]),
    ("calibrate", "calibrate", 1.0, &["calibrate.runs=16"]),
];

/// How many kills, and of which program.
pub struct Options {
    /// Seed of the runs and moments.
    pub seed: u64,
    /// How many kills.
    pub kills: u64,
    /// Runs of this scene alone.
    pub only: Option<String>,
    /// The program.
    pub tsubu: PathBuf,
}

/// What came of it.
#[derive(Debug, Default)]
pub struct Tally {
    /// Runs killed once or more often.
    pub runs: u64,
    /// Kills that found a run at work.
    pub kills: u64,
    /// Runs that gave another answer, or none.
    pub wrong: Vec<String>,
}

/// Kills runs of all kinds in turn until there are enough kills.
pub fn kills(options: &Options) -> io::Result<Tally> {
    let mut tally = Tally::default();
    let mut known: BTreeMap<usize, (Answer, Duration)> = BTreeMap::new();
    // One kind after the other, not always in the same order.
    let wanted = |kind: &usize| options.only.as_ref().is_none_or(|only| only == RUNS[*kind].1);
    let mut order: Vec<usize> = (0..RUNS.len()).filter(wanted).collect();
    if order.is_empty() {
        return Err(io::Error::other("no run of that scene is among those that are killed"));
    }
    let mut draw = Draw::new(options.seed, "kills", 0);
    while tally.kills < options.kills {
        if (tally.runs as usize).is_multiple_of(order.len()) {
            draw.shuffle(&mut order);
        }
        let kind = order[tally.runs as usize % order.len()];
        let folder = tempfile::tempdir()?;
        let (wanted, time) = match known.entry(kind) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(unknown) => {
                let begun = Instant::now();
                let whole = folder.path().join("whole");
                start(options, RUNS[kind], &whole, Go::Anew)?.wait()?;
                unknown.insert((Answer::of(&whole)?, begun.elapsed()))
            }
        };
        let (killed, wrong) = one(options, &mut draw, RUNS[kind], *time, &folder.path().join("killed"), wanted)?;
        tally.kills += killed;
        tally.runs += 1;
        let (command, scene, ..) = RUNS[kind];
        let told = wrong.as_deref().unwrap_or("the same");
        println!("{command} {scene}: {killed} kills, {told}");
        tally.wrong.extend(wrong.map(|text| format!("{command} {scene}: {text}")));
    }
    Ok(tally)
}

/// Kills one run up to three times, lets it end, and says what is different then.
fn one(
    options: &Options,
    draw: &mut Draw,
    run: Run,
    time: Duration,
    folder: &Path,
    wanted: &Answer,
) -> io::Result<(u64, Option<String>)> {
    let mut killed = 0;
    for _ in 0..=draw.below(3) {
        let mut child = start(options, run, folder, Go::of(run, folder))?;
        std::thread::sleep(time.mul_f64(draw.share()));
        if child.try_wait()?.is_some() {
            break;
        }
        // SIGKILL: nobody is asked.
        child.kill()?;
        child.wait()?;
        killed += 1;
    }
    let done = start(options, run, folder, Go::of(run, folder))?.wait_with_output()?;
    if !matches!(done.status.code(), Some(0 | 1)) {
        let text = String::from_utf8_lossy(&done.stderr).trim().lines().next().unwrap_or_default().to_owned();
        return Ok((killed, Some(format!("cannot be resumed ({}): {text}", done.status))));
    }
    Ok((killed, wanted.difference(&Answer::of(folder)?)))
}

/// How a run begins.
#[derive(Clone, Copy, PartialEq)]
enum Go {
    Anew,
    Resume,
}

impl Go {
    /// Where there is no checkpoint yet, the documented way is to begin again; what is made of many runs knows itself.
    fn of(run: Run, folder: &Path) -> Self {
        let resumes = run.0 != "run" || folder.join("checkpoint/state.tsubu").is_file();
        if resumes && folder.is_dir() { Self::Resume } else { Self::Anew }
    }
}

fn start(options: &Options, run: Run, folder: &Path, go: Go) -> io::Result<std::process::Child> {
    let (command, scene, duration, changes) = run;
    let mut words = vec![
        "claim=[]".to_owned(),
        format!("duration={duration}"),
        format!("output.history-interval={}", duration / 200.0),
        format!("output.checkpoint-interval={}", duration / 30.0),
    ];
    if command == "run" {
        words.push(format!("output.frame-interval={}", duration / 20.0));
    }
    words.extend(changes.iter().map(|text| (*text).to_owned()));
    let mut process = Command::new(&options.tsubu);
    process.arg(command).arg(root().join("scenes").join(scene).with_extension("toml"));
    for word in &words {
        process.args(["--set", word]);
    }
    process.args(["--quiet", "--threads", "2", "--output"]).arg(folder);
    process.arg(if go == Go::Resume { "--resume" } else { "--overwrite" });
    process.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn()
}

/// What a folder of results says, but for what the clock on the wall says.
struct Answer(BTreeMap<String, Vec<u8>>);

impl Answer {
    fn of(folder: &Path) -> io::Result<Self> {
        let mut files = BTreeMap::new();
        collect(folder, "", &mut files)?;
        Ok(Self(files))
    }

    fn difference(&self, other: &Self) -> Option<String> {
        let names = |a: &Self, b: &Self| a.0.keys().find(|name| !b.0.contains_key(*name)).cloned();
        if let Some(name) = names(self, other) {
            return Some(format!("{name} is missing"));
        }
        if let Some(name) = names(other, self) {
            return Some(format!("{name} is there too"));
        }
        self.0.iter().find(|(name, bytes)| other.0[*name] != **bytes).map(|(name, _)| format!("{name} is different"))
    }
}

fn collect(folder: &Path, inside: &str, files: &mut BTreeMap<String, Vec<u8>>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let full = format!("{inside}{name}");
        // What is hidden was on its way when the kill came; a verdict measures the machine, and figures show it.
        let passing = ["checkpoint", "figures", "check.txt", "report.html", "bench.json", "progress.jsonl"];
        if name.starts_with('.') || passing.contains(&name.as_str()) {
            continue;
        }
        if path.is_dir() {
            collect(&path, &format!("{full}/"), files)?;
            continue;
        }
        let bytes = fs::read(&path)?;
        let bytes = match name.as_str() {
            "summary.json" | "sweep.json" => lasting(&bytes),
            _ if path.extension().is_some_and(|ending| ending == "csv") => without_the_clock(&bytes),
            _ => bytes,
        };
        files.insert(full, bytes);
    }
    Ok(())
}

/// A summary, of a sweep too, without what the machine has to do with.
fn lasting(bytes: &[u8]) -> Vec<u8> {
    let Ok(Value::Object(mut summary)) = serde_json::from_slice(bytes) else { return bytes.to_vec() };
    summary.retain(|name, _| !["wall_seconds", "threads", "particle_steps_per_second"].contains(&name.as_str()));
    Value::Object(summary).to_string().into_bytes()
}

/// A table without the column that tells how long it took.
fn without_the_clock(bytes: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(bytes);
    let header = text.lines().next().unwrap_or_default();
    let Some(clock) = header.split(',').position(|cell| cell == "wall seconds [s]") else { return bytes.to_vec() };
    let rest = |line: &str| {
        let cells = line.split(',').enumerate().filter(|(column, _)| *column != clock);
        cells.map(|(_, cell)| cell).collect::<Vec<_>>().join(",")
    };
    text.lines().map(rest).collect::<Vec<_>>().join("\n").into_bytes()
}
