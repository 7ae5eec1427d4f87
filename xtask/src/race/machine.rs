//! The machine: its class, and how busy it is with other things.

use super::stable::said;
use std::fs;
use std::process::Command;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Cores that others may use while a run counts as undisturbed.
pub const QUIET: f64 = 0.1;
/// Ticks of `/proc` in a second: the same in every Linux of today.
const TICKS: f64 = 100.0;
/// CPU time by which the counters of processes and of cores may disagree [s].
const RESOLUTION: f64 = 3.0 / TICKS;
const SAMPLE: Duration = Duration::from_millis(300);
const PATIENCE: Duration = Duration::from_mins(2);

/// CPU time of a moment [s].
#[derive(Clone, Copy, Debug)]
pub struct Load {
    at: Instant,
    busy: f64,
    stolen: f64,
    own: f64,
}

impl Load {
    pub fn now() -> Result<Self, String> {
        let (busy, stolen) = all(&read("/proc/stat")?).ok_or("/proc/stat is not understood")?;
        let own = own(&read("/proc/self/stat")?).ok_or("/proc/self/stat is not understood")?;
        Ok(Self { at: Instant::now(), busy, stolen, own })
    }

    /// Whether others that used so many cores since have disturbed what ran.
    pub fn disturbed(&self, others: f64) -> bool {
        others > QUIET + RESOLUTION / self.at.elapsed().as_secs_f64()
    }

    /// Cores that others have used since: processes of this machine, and its host.
    pub fn others(&self) -> Result<(f64, f64), String> {
        let now = Self::now()?;
        let seconds = (now.at - self.at).as_secs_f64();
        let busy = (now.busy - self.busy) - (now.own - self.own);
        Ok((busy.max(0.0) / seconds, (now.stolen - self.stolen) / seconds))
    }
}

/// Busy and stolen CPU time of all cores [s].
fn all(stat: &str) -> Option<(f64, f64)> {
    let cells: Vec<f64> = stat.lines().next()?.split_whitespace().skip(1).flat_map(str::parse).collect();
    // user, nice, system, idle, iowait, irq, softirq, steal
    let [user, nice, system, _, _, irq, soft, stolen] = *cells.first_chunk::<8>()?;
    Some(((user + nice + system + irq + soft) / TICKS, stolen / TICKS))
}

/// CPU time of this process and of those it has waited for [s].
fn own(stat: &str) -> Option<f64> {
    // The name, in brackets, may hold anything; after it the state is field 3, and times begin at field 14.
    let (_, rest) = stat.rsplit_once(')')?;
    let times: Vec<f64> = rest.split_whitespace().skip(11).take(4).flat_map(str::parse).collect();
    (times.len() == 4).then(|| times.iter().sum::<f64>() / TICKS)
}

/// Waits until others leave the cores alone; says how much they still use.
pub fn quiet(busy_ok: bool) -> Result<f64, String> {
    let begun = Instant::now();
    loop {
        let load = Load::now()?;
        sleep(SAMPLE);
        let (others, _) = load.others()?;
        if others <= QUIET || busy_ok {
            return Ok(others);
        }
        if begun.elapsed() > PATIENCE {
            return Err(format!(
                "others have used {others:.1} cores for {} s: wait for a quiet machine, or race with --busy-ok",
                PATIENCE.as_secs()
            ));
        }
        sleep(Duration::from_secs(2));
    }
}

/// The class of this machine: processor, cores, memory; no names.
pub fn class() -> Vec<(&'static str, String)> {
    let of = |path: &str, key: &str| {
        let text = fs::read_to_string(path).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix(key));
        line.map_or_else(|| "not told".to_owned(), |line| line.trim_matches([':', ' ', '\t']).to_owned())
    };
    let cpu = |key: &str| of("/proc/cpuinfo", key);
    let flags = cpu("flags");
    let wide = ["avx512f", "avx2", "sse2"].into_iter().find(|set| flags.split(' ').any(|flag| flag == *set));
    let cores = std::thread::available_parallelism().map_or_else(|e| e.to_string(), |n| n.to_string());
    let said = |program: &str, words: &[&str]| {
        let mut command = Command::new(program);
        command.args(words);
        said(command).map_or_else(|_| "not told".to_owned(), |text| text.trim().to_owned())
    };
    vec![
        ("processor", cpu("model name")),
        ("family, model", format!("{}, {}", cpu("cpu family"), cpu("model\t"))),
        ("widest instructions", wide.unwrap_or("not told").to_owned()),
        ("cores", cores),
        ("memory", of("/proc/meminfo", "MemTotal")),
        ("rustc", said("rustc", &["--version"])),
        ("date", said("date", &["-u", "+%F"])),
    ]
}

fn read(path: &str) -> Result<String, String> {
    fs::read_to_string(path).map_err(|e| format!("cannot read {path}: {e}; the race needs Linux"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_read_as_proc_tells_them() {
        assert_eq!(all("cpu  100 10 50 9999 7 3 2 40 0 0\ncpu0 1 1 1 1 1 1 1 1\n"), Some((1.65, 0.4)));
        let stat = "12 (a ) name) S 1 12 12 0 -1 4194560 1 2 3 4 100 50 300 25 20 0 1 0 5";
        assert_eq!(own(stat), Some(4.75));
        assert_eq!(own("12 (short) S 1"), None);
    }
}
