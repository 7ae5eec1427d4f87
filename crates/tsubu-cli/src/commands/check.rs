//! `tsubu check`: a verdict a line.

use crate::failure::Failure;
use crate::machine;
use crate::options::SceneOptions;
use crate::output;
use crate::stream::Stream;
use clap::{Args, value_parser};
use std::fmt::Write as _;
use std::sync::mpsc;
use std::time::{Duration, Instant};
use tsubu::check::Verdict;
use tsubu::trial::{Target, check};
use tsubu_scene::Scene;

/// How long a user waits for a verdict.
const LIMIT: Duration = Duration::from_secs(9);

#[derive(Args)]
#[command(after_help = "\
Examples:
  tsubu check damper.toml
  tsubu check damper.toml --set dem.time-step='20 us' --strict
  tsubu check chute.toml --ranks 4")]
pub struct Options {
    #[command(flatten)]
    scene: SceneOptions,
    /// Estimate memory, messages and time for so many ranks of MPI, too
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u16).range(1..=1024))]
    ranks: u16,
    /// Exit with 2 if there is a warning
    #[arg(long)]
    strict: bool,
}

pub fn run(options: &Options) -> Result<(), Failure> {
    let begun = Instant::now();
    let scene = options.scene.read()?;
    let verdict = judged(&scene, usize::from(options.ranks), LIMIT.saturating_sub(begun.elapsed()))?;
    let stream = Stream::Data;
    let mut text = String::new();
    for line in &verdict.lines {
        let word = if line.good { stream.green("ok  ") } else { stream.yellow("warn") };
        let _ = writeln!(text, "{word} {}", line.text);
        if !line.advice.is_empty() {
            let _ = writeln!(text, "       change: {}", line.advice);
        }
    }
    output::print(&text)?;
    let warnings = verdict.lines.iter().filter(|line| !line.good).count();
    let plural = if warnings == 1 { "" } else { "s" };
    if verdict.fails {
        return Err(Failure::wrong("the scene cannot be run as it is").hint("see the last warning above"));
    }
    if options.strict && warnings > 0 {
        return Err(Failure::wrong(format!("{warnings} warning{plural}, and `--strict` lets none pass")));
    }
    match warnings {
        0 => output::tell(&format!("the scene is right; run it: tsubu run {}\n", options.scene.words())),
        n => output::tell(&format!("the scene can be run, with {n} warning{plural}\n")),
    }
    Ok(())
}

/// The verdict, with an estimate for so many ranks; if it takes longer than a user waits, as far as it has come.
pub fn judged(scene: &Scene, ranks: usize, limit: Duration) -> Result<Verdict, Failure> {
    let (begun, plans) = (Instant::now(), scene.plans().to_vec());
    let (send, news) = mpsc::channel();
    std::thread::spawn(move || {
        let mut whole = Verdict::default();
        for (at, plan) in plans.iter().enumerate() {
            let stage = plan.stage.get(at).map(|stage| stage.name.as_str());
            // Nobody listens any more where it came too late.
            let mut ahead =
                |verdict: &Verdict, next| _ = send.send((Ok(whole.clone().with(stage, verdict.clone())), Some(next)));
            let bench = machine::known();
            match check(plan, Target { bench: bench.as_ref(), ranks }, &mut ahead) {
                Ok(verdict) => whole = whole.with(stage, verdict),
                Err(error) => {
                    let _ = send.send((Err(error), None));
                    return;
                }
            }
        }
        _ = send.send((Ok(whole), None));
    });
    let (mut known, mut doing) = (Verdict::default(), "placing the grains");
    loop {
        match news.recv_timeout(limit.saturating_sub(begun.elapsed())) {
            Ok((done, None)) => return done.map_err(|error| Failure::of_open(&error, scene)),
            Ok((verdict, Some(next))) => (known, doing) = (verdict.unwrap_or_default(), next),
            Err(mpsc::RecvTimeoutError::Timeout) => {
                let text = format!("no time to end: after {} s `check` is still at {doing}", LIMIT.as_secs());
                let advice =
                    "fewer or heavier grains, a softer material or a longer step, if a run is not to take as long";
                known.warn(text, advice);
                return Ok(known);
            }
            Err(mpsc::RecvTimeoutError::Disconnected) => return Err(Failure::failed("the judgement broke off")),
        }
    }
}
