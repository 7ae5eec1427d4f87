//! Workers of Dask: a small Python program hands them the tasks, and waits.

use super::job::Job;
use crate::failure::Failure;
use serde_json::json;
use std::io::Write as _;
use std::process::{Command, Stdio};

/// What Python does with the tasks.
const TASKS: &str = include_str!("dask.py");

/// Finds the scheduler, and says what is missing where it cannot.
const READY: &str = "\
import sys
try:
    import dask
    from distributed import Client
except ImportError as error:
    sys.exit(f'PACKAGE {error}')
address = sys.argv[1] or dask.config.get('scheduler-address', None)
if not address:
    sys.exit('ADDRESS')
try:
    Client(address, timeout=10, set_as_default=False).close()
except (OSError, ValueError, ImportError) as error:
    sys.exit(f'no scheduler of Dask answers at {address}: {error}')
";

/// Refuses where there is no Dask, or no scheduler.
pub fn ready(scheduler: Option<&str>) -> Result<(), Failure> {
    let done = Command::new("python3").args(["-c", READY, scheduler.unwrap_or_default()]).stdin(Stdio::null()).output();
    let install = "install it where `python3` finds it: pip install distributed";
    let done = done.map_err(|error| {
        Failure::wrong(format!("there is no Dask here: `python3` does not start ({error})")).hint(install)
    })?;
    if done.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&done.stderr);
    let last = said.trim().lines().last().unwrap_or_default();
    Err(match last {
        "ADDRESS" => Failure::wrong("no scheduler of Dask is named").hint(
            "name it with `--scheduler tcp://NODE:8786` or in DASK_SCHEDULER_ADDRESS; `dask scheduler` and `dask worker` start one",
        ),
        text => match text.strip_prefix("PACKAGE ") {
            Some(error) => Failure::wrong(format!("there is no Dask here: {error}")).hint(install),
            None => Failure::wrong(text),
        },
    })
}

/// The program, its tasks filled in.
pub fn script(job: &Job, scheduler: Option<&str>) -> String {
    let tasks: Vec<Vec<&str>> =
        job.tasks.iter().map(|task| task.iter().flat_map(|name| ["--case", name.as_str()]).collect()).collect();
    let lines: Vec<String> = tasks.iter().map(|task| format!("    {},\n", json!(task))).collect();
    // Lists of texts are the same in JSON and in Python.
    format!(
        "SCHEDULER = {}\nCOMMAND = {}\nLOGS = {}\nTASKS = [\n{}]\n\n{TASKS}",
        json!(scheduler.unwrap_or_default()),
        json!(job.command()),
        json!(job.logs().display().to_string()),
        lines.concat()
    )
}

/// Hands the tasks over, and waits until none is left.
pub fn run(job: &Job, scheduler: Option<&str>) -> Result<(), Failure> {
    let broken = |error: std::io::Error| Failure::failed(format!("Python has ended before the tasks: {error}"));
    let mut child = Command::new("python3").arg("-").stdin(Stdio::piped()).spawn().map_err(broken)?;
    if let Some(mut stdin) = child.stdin.take() {
        stdin.write_all(script(job, scheduler).as_bytes()).map_err(broken)?;
    }
    let status = child.wait().map_err(broken)?;
    if status.success() {
        return Ok(());
    }
    Err(Failure::failed(format!("Dask has ended before the tasks ({status})"))
        .hint("what is done is kept; the same command does what is missing"))
}
