//! The race against LAMMPS: equal work, one machine, runs in turn.

mod course;
mod heat;
mod host;
mod judge;
mod machine;
mod report;
mod stable;

use course::{COURSES, Course, Racer};
use heat::Run;
use host::Host;
use stable::Stable;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// How often each skin is tried; the fastest counts, so these runs wait for nothing.
const TRIES: usize = 3;

const USAGE: &str = "\
cargo xtask race --peers DIR --lammps LMP [--runs 5] [--out benches/results/NAME] [--only W1]... [--patience 10] [--busy-ok]

  --peers DIR   decks and start states: lammps/in.chute, in.settle, model.*; data/data.chute.gz; states/settled_*.csv.gz
  --lammps LMP  the program, or the `lmp` of the environment it was installed in with its MPI
  --out NAME    writes NAME.md and NAME.json (without: into the work folder, `race/` among the build outputs)
  --patience M  minutes that each workload may lose by waiting for a quick far cache and cores near each other and
                by repeating disturbed runs; then runs count as they come
  --busy-ok     race although others use the machine; waits for nothing and repeats nothing";

/// What the command line says.
#[derive(Debug)]
struct Options {
    peers: PathBuf,
    lammps: PathBuf,
    runs: usize,
    out: Option<PathBuf>,
    only: Vec<String>,
    patience: Duration,
    busy_ok: bool,
}

/// What one workload came to.
#[derive(Debug)]
struct Heats {
    course: &'static Course,
    /// The short scan that chose the skins.
    scan: Vec<Run>,
    /// The skin of each racer.
    skins: Vec<(Racer, f64)>,
    /// In the order they were made.
    runs: Vec<Run>,
}

impl Heats {
    /// The runs of one racer.
    fn of(&self, racer: Racer, cores: u32) -> impl Iterator<Item = &Run> {
        self.runs.iter().filter(move |run| run.racer == racer && run.cores == cores)
    }

    /// Who ran on so many cores.
    fn racers(&self, cores: u32) -> impl Iterator<Item = Racer> {
        let ranks = std::iter::once(Racer::Ranks).filter(move |racer| self.of(*racer, cores).next().is_some());
        self.course.racers().into_iter().chain(ranks)
    }

    /// Seconds of the timed segment, in the order of the runs.
    fn seconds(&self, racer: Racer, cores: u32) -> Vec<f64> {
        self.of(racer, cores).map(|run| run.end.seconds).collect()
    }

    /// The median of those.
    fn median(&self, racer: Racer, cores: u32) -> f64 {
        median(self.seconds(racer, cores))
    }
}

/// Races and writes what came out; an error if a promise is not kept.
pub fn race(arguments: &[&str]) -> Result<(), String> {
    let options = Options::read(arguments)?;
    let courses: Vec<&'static Course> =
        COURSES.iter().filter(|c| options.only.is_empty() || options.only.iter().any(|o| o == c.name)).collect();
    if courses.is_empty() {
        let names: Vec<&str> = COURSES.iter().map(|course| course.name).collect();
        return Err(format!("no workload is called so; there are {}", names.join(", ")));
    }
    let stable = Stable::new(&options.peers, &options.lammps)?;
    let mut host = Host::new();
    let heats =
        courses.into_iter().map(|course| heats(&stable, &mut host, course, &options)).collect::<Result<Vec<_>, _>>()?;
    let verdict = judge::judge(&heats);
    let about = report::about(&stable, options.runs)?;
    let out = options.out.unwrap_or_else(|| stable.work.join("result"));
    if let Some(folder) = out.parent() {
        std::fs::create_dir_all(folder).map_err(|e| format!("cannot make {}: {e}", folder.display()))?;
    }
    let page = report::page(&about, &heats, &verdict);
    write(&out.with_extension("md"), &page)?;
    write(&out.with_extension("json"), &format!("{:#}\n", report::json(&about, &heats, &verdict)))?;
    println!("{page}");
    let broken: Vec<String> = verdict.claims.iter().filter(|c| !c.holds).map(|c| format!("FAIL {c}")).collect();
    if broken.is_empty() { Ok(()) } else { Err(format!("{} claims fail\n{}", broken.len(), broken.join("\n"))) }
}

/// Chooses skins and runs one workload.
fn heats(stable: &Stable, host: &mut Host, course: &'static Course, options: &Options) -> Result<Heats, String> {
    let mut heats = Heats { course, scan: Vec::new(), skins: Vec::new(), runs: Vec::new() };
    let run = |host: &mut Host, racer: Racer, cores: u32, skin: f64| {
        let run = heat::run(stable, host, course, racer, (cores, skin), options.busy_ok)?;
        let rate = course.rate(run.end.seconds);
        eprintln!("{:8} {:30} {cores} core(s), skin {skin:4}: {rate:7.3} M/s", course.name, racer.name(course));
        Ok::<Run, String>(run)
    };
    host.patience = Duration::ZERO;
    for _ in 0..TRIES {
        for racer in course.racers() {
            for &skin in racer.skins() {
                heats.scan.push(run(host, racer, 1, skin)?);
            }
        }
    }
    for racer in course.racers() {
        let tried = heats.scan.iter().filter(|tried| tried.racer == racer);
        let best = tried.min_by(|a, b| a.end.seconds.total_cmp(&b.end.seconds));
        heats.skins.extend(best.map(|best| (racer, best.skin)));
    }
    host.patience = options.patience;
    for _ in 0..options.runs {
        for cores in [1, 2] {
            for &(racer, skin) in &heats.skins {
                heats.runs.push(run(host, racer, cores, skin)?);
                if racer == Racer::Tsubu && cores == 2 && stable.ranks {
                    heats.runs.push(run(host, Racer::Ranks, cores, skin)?);
                }
            }
        }
    }
    Ok(heats)
}

impl Options {
    fn read(arguments: &[&str]) -> Result<Self, String> {
        let (mut peers, mut lammps) = (None, None);
        let (mut runs, mut out, mut only, mut busy_ok) = (5, None, Vec::new(), false);
        let mut patience = Duration::from_mins(10);
        let mut words = arguments.iter();
        while let Some(word) = words.next() {
            if *word == "--busy-ok" {
                (busy_ok, patience) = (true, Duration::ZERO);
                continue;
            }
            let value = words.next().ok_or_else(|| format!("`{word}` needs a value\n\n{USAGE}"))?;
            match *word {
                "--peers" => peers = Some(PathBuf::from(value)),
                "--lammps" => lammps = Some(PathBuf::from(value)),
                "--runs" => runs = value.parse().map_err(|_| format!("--runs: `{value}` is not a whole number"))?,
                "--patience" => {
                    let minutes: u32 =
                        value.parse().map_err(|_| format!("--patience: `{value}` is not a whole number"))?;
                    patience = Duration::from_mins(minutes.into());
                }
                "--out" => out = Some(PathBuf::from(value)),
                "--only" => only.push((*value).to_owned()),
                _ => return Err(format!("the race knows no `{word}`\n\n{USAGE}")),
            }
        }
        let (Some(peers), Some(lammps)) = (peers, lammps) else { return Err(USAGE.to_owned()) };
        if runs == 0 {
            return Err("--runs: at least one".to_owned());
        }
        Ok(Self { peers, lammps, runs, out, only, patience, busy_ok })
    }
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    std::fs::write(path, text).map_err(|e| format!("cannot write {}: {e}", path.display()))?;
    eprintln!("wrote {}", path.display());
    Ok(())
}

/// The middle of some numbers, of which there is at least one.
pub fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    let half = numbers.len() / 2;
    if numbers.len() % 2 == 1 { numbers[half] } else { 0.5 * (numbers[half - 1] + numbers[half]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.5);
    }

    #[test]
    fn options_are_read_and_wrong_ones_named() {
        let read = Options::read(&["--peers", "p", "--lammps", "l", "--runs", "7", "--only", "W3", "--busy-ok"]);
        let read = read.expect("options");
        assert_eq!((read.runs, read.only.as_slice(), read.busy_ok), (7, ["W3".to_owned()].as_slice(), true));
        assert!(read.patience.is_zero(), "nothing is waited for");
        let read = Options::read(&["--peers", "p", "--lammps", "l", "--patience", "7"]).expect("options");
        assert_eq!(read.patience, Duration::from_mins(7));
        for wrong in [
            &["--peers", "p"][..],
            &["--runs"],
            &["--speed", "9"],
            &["--peers", "p", "--lammps", "l", "--patience", "-1"],
            &["--peers", "p", "--lammps", "l", "--runs", "0"],
        ] {
            assert!(Options::read(wrong).is_err(), "{wrong:?}");
        }
    }
}
