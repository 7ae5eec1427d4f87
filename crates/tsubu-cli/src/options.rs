//! Options that several commands share.

use crate::failure::Failure;
use clap::{Args, value_parser};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use tsubu_frame::Existing;
use tsubu_scene::Scene;

/// Which scene.
#[derive(Args)]
pub struct SceneOptions {
    /// The scene file, or a folder with a scene.toml in it
    pub scene: PathBuf,
    /// Change a value of the scene, as in --set particles.balls.count=20 or --set duration='3 s'; may be repeated
    #[arg(long, value_name = "KEY.PATH=VALUE")]
    pub set: Vec<String>,
}

impl SceneOptions {
    /// Reads the scene.
    pub fn read(&self) -> Result<Scene, Failure> {
        Scene::read(&self.file(), &self.set).map_err(|complaints| Failure::from(&complaints))
    }

    /// What to type for the same scene with the same changes in another command.
    pub fn words(&self) -> String {
        let changes = self.set.iter().map(|change| format!(" --set {}", quoted(change)));
        quoted(&self.scene.display().to_string()) + &changes.collect::<String>()
    }

    fn file(&self) -> PathBuf {
        let inside = self.scene.join("scene.toml");
        if inside.is_file() { inside } else { self.scene.clone() }
    }

    /// Where results go unless told: `out/` and the scene's name; the folder's name where the file says only "scene".
    fn default_folder(&self, suffix: &str) -> PathBuf {
        let file = self.file();
        let stem = |path: &Path| path.file_stem().map(|s| s.to_string_lossy().into_owned());
        let name = match stem(&file) {
            Some(name) if name != "scene" => name,
            other => {
                let folder = file.parent().and_then(|p| p.canonicalize().ok());
                folder.and_then(|p| stem(&p)).or(other).unwrap_or_else(|| "scene".to_owned())
            }
        };
        Path::new("out").join(format!("{name}{suffix}"))
    }
}

/// Where to.
#[derive(Args)]
pub struct FolderOptions {
    /// Folder for the results [default: out/ and the scene's name]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Replace the results that are in the folder
    #[arg(long)]
    pub overwrite: bool,
}

impl FolderOptions {
    /// The folder.
    pub fn folder(&self, scene: &SceneOptions, suffix: &str) -> PathBuf {
        self.output.clone().unwrap_or_else(|| scene.default_folder(suffix))
    }

    /// Whether the user has named one.
    pub fn is_told(&self) -> bool {
        self.output.is_some()
    }

    /// What to do with an existing one.
    pub fn existing(&self) -> Existing {
        if self.overwrite { Existing::Overwrite } else { Existing::Refuse }
    }
}

/// With how much, and how loud.
#[derive(Args)]
pub struct WorkOptions {
    /// Threads to work with; results are the same for any number [default: all cores, shared by ranks]
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=4096))]
    threads: Option<u16>,
    /// The same, as one says where many runs are done side by side
    #[arg(long, value_name = "N", conflicts_with = "threads", value_parser = value_parser!(u16).range(1..=4096))]
    jobs: Option<u16>,
    /// No progress on stderr
    #[arg(short, long)]
    pub quiet: bool,
}

/// Threads that are always granted. More than four a core only stand in each other's way: with 4096, one ball took 27 s.
const MOST: usize = 16;

impl WorkOptions {
    /// The number of threads that the user has named.
    pub fn told(&self) -> Option<u16> {
        self.threads.or(self.jobs)
    }

    /// The option by which the user has named it.
    pub fn told_by(&self) -> Option<&'static str> {
        self.threads.map(|_| "--threads").or(self.jobs.map(|_| "--jobs"))
    }

    /// The threads to work with.
    pub fn pool(&self) -> Result<rayon::ThreadPool, Failure> {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let most = MOST.max(4 * cores);
        // Ranks that share a machine share its cores.
        let here = tsubu_mpi::started_here();
        let share = if here > 1 { (cores / here).max(1) } else { 0 };
        let told = self.told().map_or(share, usize::from);
        if told > most && !self.quiet {
            crate::output::tell(&format!("{told} threads cannot help on {cores} cores: working with {most}\n"));
        }
        rayon::ThreadPoolBuilder::new()
            .num_threads(told.min(most))
            .build()
            .map_err(|error| Failure::wrong(format!("cannot start the threads: {error}")))
    }
}

/// The words of the command line.
static TYPED: OnceLock<Vec<String>> = OnceLock::new();

/// Keeps the words of the command line, the name of the program first.
pub fn typed(words: &[OsString]) {
    TYPED.get_or_init(|| words.iter().map(|word| word.to_string_lossy().into_owned()).collect());
}

/// The command that goes on with what this one began.
pub fn command_to_resume() -> String {
    let mut words = vec!["tsubu".to_owned()];
    let typed = TYPED.get().into_iter().flatten().skip(1);
    words.extend(typed.filter(|word| *word != "--overwrite" && *word != "--resume").map(|w| quoted(w)));
    words.push("--resume".to_owned());
    words.join(" ")
}

/// This program, to be started again: its file, or from Python the script that has its name.
pub fn program() -> PathBuf {
    let own = std::env::current_exe().ok().filter(|file| file.file_stem().is_some_and(|stem| stem == "tsubu"));
    let typed = || PathBuf::from(TYPED.get().and_then(|words| words.first()).map_or("tsubu", String::as_str));
    own.unwrap_or_else(typed)
}

/// A word as a shell wants it.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,+:@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn words_survive_the_shell() {
        assert_eq!(quoted("particles.balls.count=20"), "particles.balls.count=20");
        assert_eq!(quoted("duration=3 s"), "'duration=3 s'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
        assert_eq!(quoted(""), "''");
    }
}
