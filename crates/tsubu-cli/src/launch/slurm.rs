//! An array job of Slurm, a task a line, and a last job that gathers.
//!
//! Slurm does all of it: it shares tasks out, starts them again when a node is lost or they are preempted, and holds the last job back. What a site
//! wants beside (partition, account) `sbatch` reads from its own variables, as `SBATCH_PARTITION`.

use super::job::Job;
use crate::failure::Failure;
use crate::options::quoted;
use crate::output;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use tsubu::check::human_time;

/// Time that a task gets over what was estimated: nodes differ, and others work there too.
const TIME: f64 = 3.0;
/// And at least [min].
const LEAST: f64 = 10.0;
/// The same of memory, beside what the program takes [bytes].
const MEMORY: f64 = 1.5;
const PROGRAM: f64 = 200e6;

/// File with the numbers of the jobs that were submitted last.
const NUMBERS: &str = "slurm";

/// The job script. With a number in the array it does that task; without, it gathers.
pub fn script(job: &Job) -> String {
    let (runs, tasks) = (job.runs(), job.tasks.len());
    let array = array(job);
    let mut text = format!(
        "#!/bin/bash\n\
         # tsubu {}: {runs} runs in {tasks} tasks, and a last job that gathers what is there. By hand, where\n\
         # an earlier launch, or the same command with `--gather`, has made the folder:\n\
         #   job=$(sbatch --parsable {array} FILE) && sbatch --dependency=afterany:$job FILE\n\
         #SBATCH --job-name=tsubu-{}\n\
         #SBATCH --output=\"{}/%A_%a.txt\"\n\
         #SBATCH --open-mode=append\n\
         # After a lost node or preemption a task goes on from its checkpoint; before its time is over it writes one.\n\
         #SBATCH --requeue\n\
         #SBATCH --signal=B:TERM@60\n\
         {}#SBATCH --ntasks={}\n\
         #SBATCH --cpus-per-task={}\n",
        job.name,
        job.name,
        job.logs().display(),
        // Ranks may be on several nodes.
        if job.ranks == 1 { "#SBATCH --nodes=1\n" } else { "" },
        job.ranks,
        job.threads
    );
    match job.need {
        Some(need) => {
            let ranks = f64::from(job.ranks);
            let minutes = LEAST + (TIME * need.seconds * job.longest() as f64 / ranks / 60.0).ceil();
            let megabytes = ((MEMORY * need.bytes + PROGRAM) / 1e6).ceil();
            // A node may have any number of the ranks.
            let memory = match job.ranks {
                1 => format!("--mem={megabytes:.0}M"),
                _ => format!("--mem-per-cpu={:.0}M", (megabytes / f64::from(job.threads)).ceil()),
            };
            let _ = writeln!(
                text,
                "# The longest run was estimated here to take {} and {:.0} MB; SBATCH_TIMELIMIT says otherwise.\n\
                 #SBATCH --time={minutes:.0}\n#SBATCH {memory}",
                human_time(need.seconds),
                need.bytes / 1e6
            );
        }
        None => text += "# What a run takes could not be estimated: SBATCH_TIMELIMIT says it, else the partition.\n",
    }
    let words: Vec<String> = job.command().iter().map(|word| quoted(word)).collect();
    let _ = writeln!(text, "\ntsubu=({})\ntasks=(", words.join(" "));
    for task in &job.tasks {
        let cases: Vec<String> = task.iter().map(|name| format!("--case {name}")).collect();
        let _ = writeln!(text, "  \"{}\"", cases.join(" "));
    }
    text += ")\nif [ -z \"${SLURM_ARRAY_TASK_ID:-}\" ]; then\n  exec \"${tsubu[@]}\" --gather --launcher slurm";
    if let Some(per_task) = job.per_task {
        let _ = write!(text, " --per-task {per_task}");
    }
    if job.ranks > 1 {
        let _ = write!(text, " --ranks {}", job.ranks);
    }
    text += "\nfi\nexec ";
    if job.ranks > 1 {
        let _ = write!(text, "mpirun -n {} ", job.ranks);
    }
    text += "\"${tsubu[@]}\" ${tasks[$SLURM_ARRAY_TASK_ID]}\n";
    text
}

fn array(job: &Job) -> String {
    format!("--array=0-{}", job.tasks.len() - 1)
}

/// Refuses where there is no Slurm, or what was submitted for this folder has not ended.
pub fn ready(folder: &Path) -> Result<(), Failure> {
    told("sbatch", &["--version"], "")?;
    let numbers = std::fs::read_to_string(folder.join(super::logs::FOLDER).join(NUMBERS)).unwrap_or_default();
    let numbers: Vec<&str> = numbers.split_whitespace().collect();
    if numbers.is_empty() {
        return Ok(());
    }
    // Slurm forgets jobs that are over, and calls their numbers invalid.
    let list = told("squeue", &["--noheader", "--format=%F", "--jobs", &numbers.join(",")], "").unwrap_or_default();
    let own = std::env::var("SLURM_JOB_ID").unwrap_or_default();
    if list.split_whitespace().any(|number| number != own) {
        let message = format!("{} is being worked at: {} of Slurm has not ended", folder.display(), jobs(&numbers));
        return Err(Failure::wrong(message)
            .hint(format!("wait for its end (`squeue`), or give it up: scancel {}", numbers.join(" "))));
    }
    Ok(())
}

fn jobs(numbers: &[&str]) -> String {
    let word = if numbers.len() == 1 { "job" } else { "one of the jobs" };
    format!("{word} {}", numbers.join(", "))
}

/// Hands the array and the last job to Slurm, and says so.
pub fn submit(job: &Job) -> Result<(), Failure> {
    let logs = job.logs();
    let kept = |error: std::io::Error| Failure::failed(format!("cannot write {}: {error}", logs.display()));
    std::fs::create_dir_all(&logs).map_err(kept)?;
    let script = script(job);
    let number = told("sbatch", &["--parsable", &array(job)], &script)?;
    let number = first(&number);
    let after = format!("--dependency=afterany:{number}");
    let output = format!("--output={}", logs.join("%j_last.txt").display());
    let last = told("sbatch", &["--parsable", "--ntasks=1", &after, &output], &script)?;
    let last = first(&last);
    std::fs::write(logs.join(NUMBERS), format!("{number} {last}\n")).map_err(kept)?;
    let folder = job.folder.display();
    output::tell(&format!(
        "{} runs in {} tasks are Slurm's job {number}; job {last} gathers them into {folder}\n\
         what they say is in {}; the same command does what is missing then\n",
        job.runs(),
        job.tasks.len(),
        logs.display()
    ));
    Ok(())
}

/// The number of a job, of `NUMBER;CLUSTER`.
fn first(answer: &str) -> &str {
    answer.trim().split(';').next().unwrap_or_default()
}

/// What a program of Slurm prints.
fn told(program: &str, arguments: &[&str], input: &str) -> Result<String, Failure> {
    let child = Command::new(program)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let missing = |error: &std::io::Error| {
        Failure::wrong(format!("there is no Slurm here: `{program}` does not start ({error})")).hint(
            "install its client (Debian and Ubuntu: apt-get install slurm-client), or print the script with `--dry-run` \
             and submit it where Slurm is",
        )
    };
    let mut child = child.map_err(|error| missing(&error))?;
    if let Some(mut stdin) = child.stdin.take() {
        // Whoever does not read says why below.
        let _ = stdin.write_all(input.as_bytes());
    }
    let done = child.wait_with_output().map_err(|error| missing(&error))?;
    if done.status.success() {
        return Ok(String::from_utf8_lossy(&done.stdout).into_owned());
    }
    let said = String::from_utf8_lossy(&done.stderr);
    Err(Failure::wrong(format!("`{program}` refuses: {}", said.trim())))
}
