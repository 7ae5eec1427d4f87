use assert_cmd::cargo::cargo_bin;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Balls in a box on a spring; `{...}` is filled in by [`Desk::scene`].
pub const SCENE: &str = r#"
title = "Twenty balls"
gravity = "10 m/s^2"
duration = "0.05 s"

[materials.acrylic]
young-modulus = "0.5 GPa"
restitution = 0.75
friction = 0.5

[particles.balls]
material = "acrylic"
count = 20
diameter = "6 mm"
mass = "0.2 g"
start.rows = { spacing = 1.1, jitter = 0.5, speed = 0.3 }

[walls.box]
material = "acrylic"
host = "spring"
shape.box = { width = "60 mm", height = "96 mm", depth = "6 mm" }

[hosts.spring]
structure.oscillator = { mass = "86 g", stiffness = "123.4 N/m", damping = "0.08 N s/m" }
base.sine = { amplitude = "5 mm", frequency = "6 Hz" }

[response]
frequency-ratio = [0.9, 0.95, 1.0, 1.05]
discard-periods = 1
discard-periods-empty = 1
measure-periods = 2
vary = { "particles.balls.count" = [0, 10, 20] }

[sweep]
vary = { "materials.acrylic.restitution" = [0.5, 0.6, 0.7, 0.8] }

[output]
history-interval = "1 ms"
frame-interval = "10 ms"
"#;

/// The scene with a design of four candidates.
pub fn designed() -> String {
    let asked = "[design]\nruns = 30\nmass-limit = \"6 g\"\nlevels = [0.5, 1.0]\n[design.vary]\n\
                 \"particles.balls.count\" = [10, 20, 30, 40]\n";
    let steady = SCENE.replace("discard-periods = 1\ndiscard-periods-empty = 1\n", "");
    let steady = steady.replace("5 mm", "0.5 mm").replace("[0.9, 0.95, 1.0, 1.05]", "{ from = 0.9, to = 1.05 }");
    format!("{steady}\n{asked}")
}

/// A folder to work in.
pub struct Desk {
    folder: tempfile::TempDir,
}

/// How a command ended.
pub struct Ended {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Desk {
    /// An empty one.
    pub fn empty() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    /// One with `scene.toml` of twenty balls in it.
    pub fn new() -> Self {
        Self::with(SCENE)
    }

    /// One with this as `balls.toml`.
    pub fn with(scene: &str) -> Self {
        let desk = Self::empty();
        fs::write(desk.path("balls.toml"), scene).unwrap();
        desk
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// A command of ours, words parted by spaces; `'` keeps words together.
    pub fn command(&self, line: &str) -> Command {
        let mut command = Command::new(cargo_bin("tsubu"));
        command
            .args(words(line))
            .current_dir(self.folder.path())
            .env("NO_COLOR", "1")
            .env("XDG_CACHE_HOME", self.folder.path().join(".cache"))
            .stdin(Stdio::null());
        command
    }

    pub fn run(&self, line: &str) -> Ended {
        let out = self.command(line).output().unwrap();
        Ended {
            code: out.status.code(),
            stdout: String::from_utf8(out.stdout).unwrap(),
            stderr: String::from_utf8(out.stderr).unwrap(),
        }
    }

    /// Runs it and expects success.
    pub fn done(&self, line: &str) -> Ended {
        let ended = self.run(line);
        assert_eq!(ended.code, Some(0), "tsubu {line}\n{}\n{}", ended.stdout, ended.stderr);
        ended
    }

    /// Runs it, and gives what a user sees, fit for a snapshot.
    pub fn shown(&self, line: &str) -> String {
        let ended = self.run(line);
        let mut text = format!("$ tsubu {line}\n");
        if !ended.stdout.is_empty() {
            let _ = writeln!(text, "--- stdout\n{}", ended.stdout.trim_end());
        }
        if !ended.stderr.is_empty() {
            let _ = writeln!(text, "--- stderr\n{}", ended.stderr.trim_end());
        }
        let _ = writeln!(text, "--- exit code {}", ended.code.unwrap());
        let _ = write!(text, "--- files: {}", self.files().join(" "));
        text.replace(self.folder.path().to_str().unwrap(), "DESK")
    }

    /// All files of the desk.
    pub fn files(&self) -> Vec<String> {
        let mut found = Vec::new();
        list(self.folder.path(), self.folder.path(), &mut found);
        found.sort();
        found
    }

    /// Starts it in the background.
    pub fn start(&self, line: &str) -> Child {
        self.command(line).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
    }

    pub fn summary(&self, folder: &str) -> serde_json::Value {
        serde_json::from_str(&self.read(&format!("{folder}/summary.json"))).unwrap()
    }

    pub fn hash(&self, folder: &str) -> String {
        let summary = self.summary(folder);
        assert_eq!(summary["status"], "finished");
        summary["state_hash"].as_str().unwrap().to_owned()
    }
}

fn list(root: &Path, folder: &Path, found: &mut Vec<String>) {
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() {
            list(root, &path, found);
        } else {
            found.push(path.strip_prefix(root).unwrap().display().to_string());
        }
    }
}

/// Whether a file has this extension.
pub fn is(file: &str, extension: &str) -> bool {
    Path::new(file).extension().is_some_and(|found| found == extension)
}

/// Waits for a file to appear.
pub fn wait_for(file: &Path) {
    let begun = Instant::now();
    while !file.exists() {
        assert!(begun.elapsed() < Duration::from_mins(1), "{} never came", file.display());
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// Waits until a child of ours listens to signals: on a busy machine a program takes its time to begin.
pub fn listening(child: &Child) {
    let begun = Instant::now();
    while !listens(child) {
        assert!(begun.elapsed() < Duration::from_mins(1), "the program never listened to signals");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Sends a signal to a child of ours that listens, or kills it.
pub fn signal(child: &Child, name: &str) {
    if name != "KILL" {
        listening(child);
    }
    let status = Command::new("kill").args(["-s", name, &child.id().to_string()]).status().unwrap();
    assert!(status.success());
}

/// Whether a program has a handler for Ctrl-C, as Linux tells; elsewhere it is taken to have one.
fn listens(child: &Child) -> bool {
    let Ok(status) = fs::read_to_string(format!("/proc/{}/status", child.id())) else { return true };
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
    u64::from_str_radix(caught.trim(), 16).unwrap() & 0b10 != 0
}

fn words(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    for (index, part) in line.split('\'').enumerate() {
        if index % 2 == 1 {
            words.push(part.to_owned());
        } else {
            words.extend(part.split_whitespace().map(str::to_owned));
        }
    }
    words
}

/// The options that cut the scene of a command short: each stage of a scene that has stages.
pub fn shortened(command: &str, duration: &str) -> String {
    let scene = command.split_whitespace().map(Path::new).find(|word| word.extension().is_some_and(|e| e == "toml"));
    let text = std::fs::read_to_string(scene.expect("a scene")).unwrap();
    let stages = text.split("\n[[stage]]\n").skip(1).enumerate();
    let shorter: Vec<String> = stages
        .map(|(stage, text)| {
            let key = if text.contains("\nat-most = ") { "at-most" } else { "duration" };
            format!("--set 'stage.{stage}.{key}={duration}'")
        })
        .collect();
    if shorter.is_empty() { format!("--set 'duration={duration}'") } else { shorter.join(" ") }
}
