//! The race on paper: a page for people and the same numbers for programs.

use super::course::{Bands, CONTACTS, Racer};
use super::heat::{End, Run};
use super::host::Look;
use super::judge::Verdict;
use super::machine;
use super::stable::{Stable, said};
use super::{Heats, TRIES, median};
use crate::shell::command;
use serde_json::{Value, json};
use std::fmt::Write;

/// Machine and versions.
pub fn about(stable: &Stable, runs: usize) -> Result<Vec<(&'static str, String)>, String> {
    let mut about = machine::class();
    let commit = said(command("git", &["describe", "--always", "--dirty"])).unwrap_or_else(|_| "not told".to_owned());
    about.push(("tsubu", format!("{}, commit {}", env!("CARGO_PKG_VERSION"), commit.trim())));
    about.push(("LAMMPS", stable.version()?));
    about.push(("MPI", stable.mpi()));
    about.push(("runs", runs.to_string()));
    Ok(about)
}

/// Lowest and highest of some numbers.
fn range(numbers: impl IntoIterator<Item = f64>) -> (f64, f64) {
    numbers.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
}

/// The page.
pub fn page(about: &[(&str, String)], heats: &[Heats], verdict: &Verdict) -> String {
    let mut page = String::from(
        "# Race: tsubu against LAMMPS\n\n\
         `cargo xtask race --peers DIR --lammps LMP`: equal scenes (`benches/race/`), start states and steps; runs in turn, \
         pinned to cores;\neach the timed segment after a warm-up; each code with its best skin. Medians; quote ratios.\n\n",
    );
    for (what, value) in about {
        line(&mut page, format_args!("- {what}: {value}"));
    }
    let sections: [fn(&mut String, &[Heats], &Verdict); 8] =
        [claims, rates, scaling, memory, physics, skins, load, commands];
    for section in sections {
        section(&mut page, heats, verdict);
    }
    page
}

fn line(page: &mut String, text: std::fmt::Arguments<'_>) {
    // Writing to a string does not fail.
    let _ = writeln!(page, "{text}");
}

fn head(page: &mut String, title: &str, columns: &str) {
    let cells = columns.split(" | ").map(|_| "---").collect::<Vec<_>>().join("|");
    line(page, format_args!("\n## {title}\n\n| {columns} |\n|{cells}|"));
}

fn claims(page: &mut String, _: &[Heats], verdict: &Verdict) {
    head(page, "Claims", "verdict | claim | wanted | found");
    for c in &verdict.claims {
        let word = if c.holds { "holds" } else { "**FAIL**" };
        line(page, format_args!("| {word} | {} | {} | {} |", c.text, c.wanted, c.found));
    }
}

fn rates(page: &mut String, heats: &[Heats], _: &Verdict) {
    let columns = "workload | cores | code | median | range | tsubu over it | pair by pair";
    head(page, "Million particle-steps per second", columns);
    for h in heats {
        let course = h.course;
        for cores in [1, 2] {
            let tsubu = h.seconds(Racer::Tsubu, cores);
            for racer in h.racers(cores) {
                let seconds = h.seconds(racer, cores);
                let rate = course.rate(h.median(racer, cores));
                let (low, high) = range(seconds.iter().map(|s| course.rate(*s)));
                let ratio = h.median(racer, cores) / h.median(Racer::Tsubu, cores);
                let (least, most) = range(seconds.iter().zip(&tsubu).map(|(a, b)| a / b));
                line(
                    page,
                    format_args!(
                        "| {} {} | {cores} | {} | {rate:.2} | {low:.2} to {high:.2} | {ratio:.2} | {least:.2} to {most:.2} |",
                        course.name,
                        course.about,
                        racer.name(course),
                    ),
                );
            }
        }
    }
}

fn scaling(page: &mut String, heats: &[Heats], _: &Verdict) {
    head(page, "Two cores over one", "workload | code | gain");
    for h in heats {
        for racer in h.course.racers() {
            let gain = h.median(racer, 1) / h.median(racer, 2);
            line(page, format_args!("| {} | {} | {gain:.2} |", h.course.name, racer.name(h.course)));
        }
    }
}

fn memory(page: &mut String, heats: &[Heats], _: &Verdict) {
    head(page, "Peak memory, one process (VmHWM)", "workload | code | MiB | kB per grain");
    for h in heats {
        for racer in h.course.racers() {
            let (_, most) = range(h.of(racer, 1).filter_map(|run| run.memory));
            let grain = most / f64::from(h.course.grains);
            let name = racer.name(h.course);
            line(page, format_args!("| {} | {name} | {:.0} | {grain:.2} |", h.course.name, most / 1024.0));
        }
    }
}

fn physics(page: &mut String, heats: &[Heats], verdict: &Verdict) {
    head(
        page,
        "Equal physics: the end of the timed segment",
        "workload | code | kinetic | rotational | contacts per grain | highest grain | lists built",
    );
    let row = |page: &mut String, course: &str, name: &str, end: &End| {
        let told = |number: Option<f64>| number.map_or_else(|| "-".to_owned(), |number| number.to_string());
        let (highest, builds) = (told(end.highest), told(end.builds));
        line(
            page,
            format_args!(
                "| {course} | {name} | {:.8e} | {:.8e} | {:.5} | {highest} | {builds} |",
                end.kinetic, end.rotational, end.contacts
            ),
        );
    };
    for h in heats {
        let mine = verdict.physics.iter().filter(|p| p.course.name == h.course.name);
        for (i, p) in mine.enumerate() {
            if i == 0 {
                row(page, h.course.name, "tsubu", &p.tsubu);
            }
            row(page, h.course.name, &p.opponent.name(h.course), &p.lammps);
        }
    }
    line(page, format_args!("\nBands: contacts per grain within {CONTACTS}, relative."));
    for h in heats {
        let name = h.course.name;
        match h.course.bands {
            Bands::Flow { kinetic } => line(page, format_args!("{name}: kinetic energy within {kinetic:e}, relative.")),
            Bands::Rest { height, kinetic } => line(
                page,
                format_args!(
                    "{name}: highest grain within {height} diameters; the bed is at rest and the energy of motion noise, of \
                     both codes below {kinetic:.1e} J a grain,\na thousandth of what lifts it by its diameter."
                ),
            ),
            Bands::Settling { height, kinetic } => line(
                page,
                format_args!(
                    "{name}: highest grain within {height} diameters; the bed moves under a law that did not settle it, and \
                     the energy of\nmotion agrees within {kinetic}, relative."
                ),
            ),
        }
    }
}

fn skins(page: &mut String, heats: &[Heats], _: &Verdict) {
    head(
        page,
        &format!("Skins tried on one core: million particle-steps per second, the best of {TRIES}"),
        "workload | code | skin over diameter: speed | taken",
    );
    for h in heats {
        for &(racer, taken) in &h.skins {
            let tried = racer.skins().iter().map(|skin| {
                let runs = h.scan.iter().filter(|run| run.racer == racer && run.skin == *skin);
                let (_, best) = range(runs.map(|run| h.course.rate(run.end.seconds)));
                format!("{skin}: {best:.2}")
            });
            let tried = tried.collect::<Vec<_>>().join(", ");
            line(page, format_args!("| {} | {} | {tried} | {taken} |", h.course.name, racer.name(h.course)));
        }
    }
    line(page, format_args!("\ntsubu's skin is over the smallest diameter, LAMMPS's over the mean one."));
}

fn load(page: &mut String, heats: &[Heats], _: &Verdict) {
    let runs: Vec<&Run> = heats.iter().flat_map(|h| &h.runs).collect();
    let most = |i: usize| range(runs.iter().map(|run| run.load[i])).1;
    let disturbed = runs.iter().filter(|run| run.disturbed).count();
    let repeated: u32 = runs.iter().map(|run| run.repeated).sum();
    let felt = |of: fn(Look) -> f64, run: &Run| of(run.looks[0]).max(of(run.looks[1]));
    let steps: Vec<f64> = runs.iter().map(|run| felt(|look| look.step, run)).collect();
    let trips: Vec<f64> = runs.iter().filter(|run| run.cores > 1).map(|run| felt(|look| look.trip, run)).collect();
    let (quickest, slowest) = range(steps.iter().copied());
    let (nearest, farthest) = range(trips.iter().copied());
    line(
        page,
        format_args!(
            "\n## Load by others\n\nMost cores used by other processes before a run: {:.2}, during one: {:.2}; by the host of a \
             virtual machine during one: {:.2}.\nRuns that count although others used more than {} cores, the far cache was slow \
             or the cores were far from each other: {disturbed} of {}; made again because of that: {repeated}.\nThe longer of those \
             before and after a run: a step through the far cache {quickest:.0} to {slowest:.0} ns, median {:.0}; a line of the \
             cache from core to core and back {nearest:.0} to {farthest:.0} ns, median {:.0} (runs on two cores).",
            most(0),
            most(1),
            most(2),
            machine::QUIET,
            runs.len(),
            median(steps),
            median(trips),
        ),
    );
}

fn commands(page: &mut String, heats: &[Heats], _: &Verdict) {
    line(page, format_args!("\n## Commands\n\n```sh"));
    for h in heats {
        let mut told: Vec<&str> = h.runs.iter().map(|run| run.command.as_str()).collect();
        let mut seen = std::collections::HashSet::new();
        told.retain(|command| seen.insert(*command));
        for command in told {
            line(page, format_args!("{command}"));
        }
    }
    line(page, format_args!("```"));
}

/// Every run and every claim.
pub fn json(about: &[(&str, String)], heats: &[Heats], verdict: &Verdict) -> Value {
    let about: serde_json::Map<String, Value> = about.iter().map(|(k, v)| ((*k).to_owned(), json!(v))).collect();
    let claims = verdict
        .claims
        .iter()
        .map(|c| json!({ "claim": c.text, "wanted": c.wanted, "found": c.found, "holds": c.holds }));
    let workloads = heats.iter().map(|h| {
        let runs = |runs: &[Run]| runs.iter().map(|r| run(h, r)).collect::<Vec<_>>();
        json!({
            "workload": h.course.name,
            "about": h.course.about,
            "grains": h.course.grains,
            "warm-up steps": h.course.warm,
            "timed steps": h.course.steps,
            "scan of skins": runs(&h.scan),
            "runs": runs(&h.runs),
        })
    });
    json!({
        "about": about,
        "claims": claims.collect::<Vec<_>>(),
        "workloads": workloads.collect::<Vec<_>>(),
    })
}

fn run(heats: &Heats, run: &Run) -> Value {
    let [before, others, host] = run.load;
    json!({
        "code": run.racer.name(heats.course),
        "cores": run.cores,
        "skin": run.skin,
        "command": run.command,
        "seconds": run.end.seconds,
        "million particle-steps per second": heats.course.rate(run.end.seconds),
        "kinetic": run.end.kinetic,
        "rotational": run.end.rotational,
        "contacts per grain": run.end.contacts,
        "highest grain": run.end.highest,
        "lists built": run.end.builds,
        "peak memory [kB]": run.memory,
        "cores used by others before": before,
        "cores used by others meanwhile": others,
        "cores taken by the host meanwhile": host,
        "far cache, before and after [ns a step]": run.looks.map(|look| look.step),
        "core to core and back, before and after [ns]": run.looks.map(|look| look.trip),
        "disturbed": run.disturbed,
        "disturbed attempts before": run.repeated,
    })
}
