//! Cases of command lines.

use crate::bundle::Bundle;
use crate::draw::Draw;
use crate::limits::{beside, limited};
use crate::nasty;
use crate::outcome::Outcome;
use crate::seeds::root;
use crate::spots::spots;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const COMMANDS: &[&str] = &[
    "run",
    "check",
    "sweep",
    "response",
    "atlas",
    "predict",
    "design",
    "calibrate",
    "compare",
    "verify",
    "report",
    "new",
    "schema",
    "completions",
    "view",
    "help",
    "explain",
    "bench",
];

const OPTIONS: &[&str] = &[
    "--help",
    "--version",
    "--overwrite",
    "--resume",
    "--quiet",
    "-q",
    "--list",
    "--all",
    "--no-such-option",
    "--",
    "-",
    "--threads=1",
    "--threads=0",
    "--threads=4096",
    "--jobs=-1",
    "--threads=nan",
    "--set",
    "-o",
    "--methods=dem,lattice",
    "--methods=",
    "--methods=dem,dem",
    "--methods=none",
];

const WORDS: &[&str] = &[
    "scene.toml",
    "scene.toml",
    "scene.toml",
    "done",
    "no-such.toml",
    ".",
    "..",
    "",
    " ",
    "/dev/null",
    "/dev/full",
    "done/scene.toml",
    "done/summary.json",
    "scene.toml/scene.toml",
    "folder",
    "damper",
    "zsh",
    "日本語",
    "a\nb",
    "\u{1b}[31m",
    "-1",
    "1e9",
    "*",
];

/// How long a command may take before it is interrupted, and then to end.
const PATIENCE: Duration = Duration::from_secs(3);
/// Two seconds are promised; a busy machine may take its time.
const GRACE: Duration = Duration::from_secs(6);

/// A command line in a folder with a scene.
pub fn draw(draw: &mut Draw) -> Bundle {
    let scene = std::fs::read_to_string(root().join("scenes/drop.toml")).unwrap_or_default();
    let table: toml::Table = scene.parse().unwrap_or_default();
    let spots = spots(&table);
    let mut words = vec![(*draw.pick(COMMANDS)).to_owned()];
    if draw.one_in(10) {
        words[0] = nasty::misspelt(draw, &words[0]);
    }
    if !draw.one_in(4) {
        words.push("scene.toml".to_owned());
    }
    for _ in 0..draw.below(5) {
        match draw.below(5) {
            0 => words.push((*draw.pick(OPTIONS)).to_owned()),
            1 => words.push((*draw.pick(WORDS)).to_owned()),
            2 => words.extend(["-o".to_owned(), (*draw.pick(WORDS)).to_owned()]),
            _ => {
                let spot = draw.pick(&spots);
                words.extend(["--set".to_owned(), format!("{}={}", spot.dotted(), nasty::text(draw))]);
            }
        }
    }
    let words = serde_json::to_vec(&words).unwrap_or_default();
    Bundle::default().with("scene.toml", scene).with("folder/note", "not of tsubu").with("arguments.json", words)
}

/// Runs the command line.
pub fn judge(bundle: &Bundle, folder: &Path) -> Result<Outcome, String> {
    let folder = folder.join("here");
    bundle.write(&folder).map_err(|error| error.to_string())?;
    let judged = judge_in(bundle, &folder);
    let _ = std::fs::remove_dir_all(&folder);
    judged
}

fn judge_in(bundle: &Bundle, folder: &Path) -> Result<Outcome, String> {
    let words: Vec<String> =
        bundle.bytes("arguments.json").and_then(|bytes| serde_json::from_slice(bytes).ok()).unwrap_or_default();
    let before = Bundle::read(folder).map_err(|error| error.to_string())?;
    let program = beside("tsubu").map_err(|error| error.to_string())?;
    let error = |error: std::io::Error| format!("cannot start {}: {error}", program.display());
    let log = tempfile::NamedTempFile::new().map_err(error)?;
    // A word with a null byte is no word for any program.
    let words = words.iter().filter(|word| !word.contains('\0'));
    let mut child = limited(&program)
        .args(words)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(log.reopen().map_err(error)?)
        .spawn()
        .map_err(error)?;
    let mut status = end(&mut child, PATIENCE);
    if status.is_none() {
        let _ = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
        status = end(&mut child, GRACE);
    }
    let Some(status) = status else {
        let _ = child.kill();
        let _ = child.wait();
        return Err("does not end after an interrupt".to_owned());
    };
    let text = std::fs::read(log.path()).map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).unwrap_or_default();
    if let Some(line) = text.lines().find(|line| line.contains("panicked at") || line.contains("mistake in tsubu")) {
        return Err(line.to_owned());
    }
    match status.code() {
        Some(0 | 1 | 3 | 130) => Ok(Outcome::Accepted),
        Some(2) => {
            let after = Bundle::read(folder).map_err(|error| error.to_string())?;
            if text.trim().is_empty() {
                Err("refused without a word".to_owned())
            } else if after == before {
                Ok(Outcome::Refused)
            } else {
                Err("refused with exit code 2, and something was written".to_owned())
            }
        }
        other => Err(format!("exit code {other:?}: {}", text.lines().last().unwrap_or_default())),
    }
}

/// Waits so long.
fn end(child: &mut Child, patience: Duration) -> Option<std::process::ExitStatus> {
    let begun = Instant::now();
    while begun.elapsed() < patience {
        if let Ok(Some(status)) = child.try_wait() {
            return Some(status);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    None
}
