//! One run of one racer: started, watched, understood.

use super::course::{Course, Racer};
use super::host::{Host, Look};
use super::machine::{Load, quiet};
use super::stable::{Stable, typed};
use std::fs::{self, File};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How often a run is repeated when others disturb it.
const ATTEMPTS: u32 = 4;

/// What a run came to.
#[derive(Clone, Debug)]
pub struct Run {
    pub racer: Racer,
    pub cores: u32,
    /// Over the diameter, see [`Racer::skins`].
    pub skin: f64,
    pub command: String,
    pub end: End,
    /// The most memory the process held [kB]; on one core.
    pub memory: Option<f64>,
    /// Cores that others used before, others meanwhile, and the machine's host meanwhile.
    pub load: [f64; 3],
    /// The host before and after.
    pub looks: [Look; 2],
    /// Whether others disturbed it, and earlier attempts that they did.
    pub disturbed: bool,
    pub repeated: u32,
}

/// What a racer tells at its end.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct End {
    /// Of the timed segment [s].
    pub seconds: f64,
    pub kinetic: f64,
    pub rotational: f64,
    /// Grain contacts of a grain that moves, in the mean.
    pub contacts: f64,
    /// Height of the highest grain; not told for the chute by LAMMPS.
    pub highest: Option<f64>,
    /// Lists that LAMMPS built in the timed segment.
    pub builds: Option<f64>,
}

/// Runs a racer once, on cores that nobody else uses.
pub fn run(
    stable: &Stable,
    host: &mut Host,
    course: &Course,
    racer: Racer,
    (cores, skin): (u32, f64),
    busy_ok: bool,
) -> Result<Run, String> {
    let mut repeated = 0;
    loop {
        let before = quiet(busy_ok)?;
        let look = host.wait(cores);
        let begun = Instant::now();
        let command = stable.command(course, racer, cores, skin);
        let told = typed(&command);
        let load = Load::now()?;
        let (output, watched) = watch(stable, command).map_err(|e| format!("`{told}`: {e}"))?;
        let (others, taken) = load.others()?;
        let looks = [look, host.look()];
        let disturbed = load.disturbed(others) || looks.iter().any(|look| host.disturbed(*look, cores));
        if disturbed && repeated + 1 < ATTEMPTS && !host.patience.is_zero() {
            repeated += 1;
            host.lose(begun.elapsed());
            continue;
        }
        let understood = match racer {
            Racer::Tsubu | Racer::Ranks => of_tsubu(&output),
            Racer::Lammps(_) => of_lammps(&output).map(|end| (end, None)),
        };
        let Some((end, own_memory)) = understood else {
            let tail: Vec<&str> = output.lines().rev().take(8).collect();
            return Err(format!(
                "`{told}` does not say what it should:\n{}",
                tail.into_iter().rev().collect::<Vec<_>>().join("\n")
            ));
        };
        // With `mpirun` the process that is watched does no work.
        let memory = own_memory.or(watched).filter(|_| cores == 1);
        return Ok(Run {
            racer,
            cores,
            skin,
            command: told,
            end,
            memory,
            load: [before, others, taken],
            looks,
            disturbed,
            repeated,
        });
    }
}

/// Runs a command; what it printed, and the most memory it held [kB].
fn watch(stable: &Stable, mut command: Command) -> Result<(String, Option<f64>), String> {
    let path = stable.work.join("output.txt");
    let told = |e: std::io::Error| e.to_string();
    let file = File::create(&path).map_err(told)?;
    command.stdin(Stdio::null()).stderr(file.try_clone().map_err(told)?).stdout(file);
    let mut child = command.spawn().map_err(told)?;
    let (status, peak) = follow(&mut child).map_err(told)?;
    let output = fs::read_to_string(&path).map_err(told)?;
    if status.success() { Ok((output, peak)) } else { Err(format!("{status}\n{output}")) }
}

/// Waits for the end; `taskset` becomes the program it starts, so its number is the program's.
fn follow(child: &mut Child) -> std::io::Result<(ExitStatus, Option<f64>)> {
    let path = format!("/proc/{}/status", child.id());
    let mut peak = None;
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok((status, peak));
        }
        let status = fs::read_to_string(&path).unwrap_or_default();
        peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).and_then(kilobytes).or(peak);
        sleep(Duration::from_millis(20));
    }
}

fn kilobytes(text: &str) -> Option<f64> {
    text.trim().strip_suffix("kB")?.trim().parse().ok()
}

/// The line of JSON of tsubu's bench, and its peak memory [kB].
fn of_tsubu(output: &str) -> Option<(End, Option<f64>)> {
    let line = output.lines().find(|line| line.starts_with('{'))?;
    let told: serde_json::Value = serde_json::from_str(line).ok()?;
    let number = |key: &str| told[key].as_f64();
    let end = End {
        seconds: number("seconds")?,
        kinetic: number("kinetic")?,
        rotational: number("rotational")?,
        contacts: number("contacts per grain")?,
        highest: number("highest grain"),
        builds: None,
    };
    Some((end, number("peak memory [kB]")))
}

/// The second segment of LAMMPS's output.
fn of_lammps(output: &str) -> Option<End> {
    let (_, timed) = output.split_once("=== timed segment ===\n")?;
    let lines: Vec<&str> = timed.lines().collect();
    let finish = lines.iter().position(|line| line.starts_with("Loop time of"))?;
    let heads: Vec<&str> =
        lines[..finish].iter().rfind(|l| l.trim_start().starts_with("Step"))?.split_whitespace().collect();
    let row: Vec<f64> = lines[finish.checked_sub(1)?].split_whitespace().flat_map(str::parse).collect();
    let column = |name: &str| heads.iter().position(|head| *head == name).and_then(|i| row.get(i).copied());
    let builds = lines.iter().find_map(|line| line.strip_prefix("Neighbor list builds = "));
    Some(End {
        seconds: lines[finish].split_whitespace().nth(3)?.parse().ok()?,
        kinetic: column("KinEng")?,
        rotational: column("c_1").or_else(|| column("c_rke"))?,
        contacts: column("c_z")?,
        highest: column("c_mz"),
        builds: builds.and_then(|count| count.trim().parse().ok()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAMMPS: &str = "\
Loop time of 0.97 on 1 procs for 50 steps with 100000 atoms
=== timed segment ===
   Step        Atoms        KinEng         c_rke           c_z            c_mz
        50      100000   4.946958e-06   3.7345495e-06  4.96558        0.062719566
       150      100000   2.6721654e-06  1.2550382e-06  4.95144        0.062717819
Loop time of 2.24565 on 1 procs for 100 steps with 100000 atoms
Neighbor list builds = 3
";

    #[test]
    fn the_timed_segment_is_read() {
        let end = of_lammps(LAMMPS).expect("an end");
        let expected = End {
            seconds: 2.24565,
            kinetic: 2.672_165_4e-6,
            rotational: 1.255_038_2e-6,
            contacts: 4.95144,
            highest: Some(0.062_717_819),
            builds: Some(3.0),
        };
        assert_eq!(end, expected);
        assert_eq!(of_lammps("ERROR: no\nLoop time of 3\n"), None);
    }

    #[test]
    fn tsubu_is_read() {
        let line = r#"{"seconds":2.5,"kinetic":1.0,"rotational":0.5,"contacts per grain":4.7,"highest grain":0.03,"peak memory [kB]":1000}"#;
        let (end, memory) = of_tsubu(line).expect("an end");
        assert_eq!((end.seconds, end.contacts, end.highest, memory), (2.5, 4.7, Some(0.03), Some(1000.0)));
    }
}
