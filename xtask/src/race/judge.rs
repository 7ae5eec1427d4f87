//! What was promised, and whether it holds.

use super::Heats;
use super::course::{Bands, CONTACTS, Course, LARGE, MEMORY, RANKS_OVER_THREADS, Racer, SCALING, SCALING_OF_RANKS};
use super::heat::{End, Run};
use std::fmt;

/// A promise with what was found.
#[derive(Debug)]
pub struct Claim {
    pub text: String,
    pub wanted: String,
    pub found: String,
    pub holds: bool,
}

impl fmt::Display for Claim {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}: wanted {}, found {}", self.text, self.wanted, self.found)
    }
}

/// All claims, and the numbers behind those on physics.
#[derive(Debug)]
pub struct Verdict {
    pub claims: Vec<Claim>,
    pub physics: Vec<Physics>,
}

/// The end of tsubu's runs beside the end of LAMMPS's.
#[derive(Debug)]
pub struct Physics {
    pub course: &'static Course,
    pub opponent: Racer,
    /// Of the first run.
    pub tsubu: End,
    /// Of the first run.
    pub lammps: End,
    /// What is compared, in words, with what was found: the worst of all runs.
    pub rows: Vec<(String, f64, f64)>,
}

/// Holds the runs against the promises.
pub fn judge(heats: &[Heats]) -> Verdict {
    let physics: Vec<Physics> = heats.iter().flat_map(physics).collect();
    let mut claims: Vec<Claim> = heats.iter().flat_map(speed).collect();
    claims.extend(heats.iter().map(scaling));
    claims.extend(heats.iter().flat_map(ranks));
    claims.extend(heats.iter().filter(|h| h.course.name == LARGE).filter_map(memory));
    let equal = |p: &Physics, (what, found, most): &(String, f64, f64)| Claim {
        text: format!("{}, {}: {what}", p.course.name, p.opponent.name(p.course)),
        wanted: format!("<= {most:.3e}"),
        found: format!("{found:.3e}"),
        holds: found <= most,
    };
    claims.extend(physics.iter().flat_map(|p| p.rows.iter().map(move |row| equal(p, row))));
    Verdict { claims, physics }
}

fn at_least(text: String, wanted: f64, found: f64) -> Claim {
    Claim { text, wanted: format!(">= {wanted}"), found: format!("{found:.3}"), holds: found >= wanted }
}

/// One claim for every style of LAMMPS and every number of cores.
fn speed(heats: &Heats) -> Vec<Claim> {
    let course = heats.course;
    let against = |cores: u32, style: usize| {
        let ratio = heats.median(Racer::Lammps(style), cores) / heats.median(Racer::Tsubu, cores);
        let name = Racer::Lammps(style).name(course);
        at_least(
            format!("{} ({}), {cores} core(s), speed over {name}", course.name, course.about),
            course.wanted,
            ratio,
        )
    };
    [1, 2].into_iter().flat_map(|cores| (0..course.styles.len()).map(move |style| against(cores, style))).collect()
}

fn scaling(heats: &Heats) -> Claim {
    let gain = heats.median(Racer::Tsubu, 1) / heats.median(Racer::Tsubu, 2);
    at_least(format!("{} ({}), tsubu on two cores over one", heats.course.name, heats.course.about), SCALING, gain)
}

/// What is promised of two ranks, if there were any.
fn ranks(heats: &Heats) -> Vec<Claim> {
    let course = heats.course;
    if heats.of(Racer::Ranks, 2).next().is_none() {
        return Vec::new();
    }
    let name = format!("{} ({}), tsubu on two ranks", course.name, course.about);
    let ranks = heats.median(Racer::Ranks, 2);
    let over_threads = ranks / heats.median(Racer::Tsubu, 2);
    let lammps = (0..course.styles.len()).map(|style| {
        let racer = Racer::Lammps(style);
        at_least(format!("{name}, speed over {}", racer.name(course)), course.wanted, heats.median(racer, 2) / ranks)
    });
    let own = [
        at_least(format!("{name} over one core"), SCALING_OF_RANKS, heats.median(Racer::Tsubu, 1) / ranks),
        Claim {
            text: format!("{name}, time over that of two threads"),
            wanted: format!("<= {RANKS_OVER_THREADS}"),
            found: format!("{over_threads:.3}"),
            holds: over_threads <= RANKS_OVER_THREADS,
        },
    ];
    own.into_iter().chain(lammps).collect()
}

/// tsubu's most over the least of LAMMPS's styles.
fn memory(heats: &Heats) -> Option<Claim> {
    let most = |racer: Racer| heats.of(racer, 1).filter_map(|run| run.memory).reduce(f64::max);
    let least = (0..heats.course.styles.len()).filter_map(|style| most(Racer::Lammps(style))).reduce(f64::min)?;
    let ratio = most(Racer::Tsubu)? / least;
    Some(Claim {
        text: format!("{}, peak memory of one process over that of the leaner LAMMPS style", heats.course.name),
        wanted: format!("<= {MEMORY}"),
        found: format!("{ratio:.3}"),
        holds: ratio <= MEMORY,
    })
}

/// Compares the ends, style by style: every run of tsubu with every run of LAMMPS.
fn physics(heats: &Heats) -> Vec<Physics> {
    let course = heats.course;
    let ends = |racer: Racer| heats.runs.iter().filter(move |run: &&Run| run.racer == racer).map(|run| &run.end);
    let tsubu: Vec<&End> = ends(Racer::Tsubu).collect();
    let against = |style: usize| {
        let opponent = Racer::Lammps(style);
        let lammps: Vec<&End> = ends(opponent).collect();
        let worst = |difference: &dyn Fn(&End, &End) -> f64| {
            let pairs = tsubu.iter().flat_map(|a| lammps.iter().map(|b| difference(a, b)));
            // What is not a number is the worst there is.
            pairs.fold(0.0, |most: f64, found| if found <= most { most } else { found })
        };
        let top = |end: &End| end.highest.unwrap_or(f64::NAN);
        let grain = |end: &End| (end.kinetic + end.rotational) / f64::from(course.grains);
        let high = worst(&|a, b| (top(a) - top(b)).abs() / course.diameter);
        let moving = worst(&|a, b| (grain(a) / grain(b) - 1.0).abs());
        let high = |most: f64| ("height of the highest grain, difference over the diameter".to_owned(), high, most);
        let mut rows = match course.bands {
            Bands::Flow { kinetic } => vec![(
                "kinetic energy, relative difference".to_owned(),
                worst(&|a, b| (a.kinetic / b.kinetic - 1.0).abs()),
                kinetic,
            )],
            Bands::Rest { height, kinetic } => {
                let most = worst(&|a, b| grain(a).max(grain(b)));
                let what = "kinetic and rotational energy of a grain [J], the larger of both";
                vec![high(height), (what.to_owned(), most, kinetic)]
            }
            Bands::Settling { height, kinetic } => {
                vec![high(height), ("kinetic and rotational energy, relative difference".to_owned(), moving, kinetic)]
            }
        };
        let contacts = worst(&|a, b| (a.contacts / b.contacts - 1.0).abs());
        rows.push(("contacts per grain, relative difference".to_owned(), contacts, CONTACTS));
        Some(Physics { course, opponent, tsubu: (*tsubu.first()?).clone(), lammps: (*lammps.first()?).clone(), rows })
    };
    (0..course.styles.len()).filter_map(against).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::race::course::COURSES;
    use crate::race::host::Look;

    fn run(racer: Racer, cores: u32, seconds: f64, end: &End) -> Run {
        let end = End { seconds, ..end.clone() };
        let memory = Some(100.0);
        Run {
            racer,
            cores,
            skin: 0.1,
            command: String::new(),
            end,
            memory,
            load: [0.0; 3],
            looks: [Look { step: 20.0, trip: 80.0 }; 2],
            disturbed: false,
            repeated: 0,
        }
    }

    /// The large bed, with tsubu at these seconds on one core and on two, LAMMPS at 4 and 2.
    fn heats(one: f64, two: f64, tsubu: &End, lammps: &End) -> Heats {
        let course = COURSES.iter().find(|course| course.name == LARGE).expect("a large bed");
        let mut runs = vec![run(Racer::Tsubu, 1, one, tsubu), run(Racer::Tsubu, 2, two, tsubu)];
        for style in 0..2 {
            runs.push(run(Racer::Lammps(style), 1, 4.0, lammps));
            runs.push(run(Racer::Lammps(style), 2, 2.0, lammps));
        }
        Heats { course, scan: Vec::new(), skins: Vec::new(), runs }
    }

    fn broken(heats: Heats) -> usize {
        judge(&[heats]).claims.iter().filter(|claim| !claim.holds).count()
    }

    #[test]
    fn promises_are_kept_or_broken_one_by_one() {
        let end = End { contacts: 5.0, highest: Some(0.06), ..End::default() };
        assert_eq!(broken(heats(2.0, 1.0, &end, &end)), 0);
        assert_eq!(broken(heats(2.1, 1.0, &end, &end)), 2, "one core is too slow for both styles");
        assert_eq!(broken(heats(1.5, 0.9, &end, &end)), 1, "the second core is worth too little");
        let higher = End { highest: Some(0.06 + 3e-5), ..end.clone() };
        assert_eq!(broken(heats(2.0, 1.0, &higher, &end)), 2, "the bed is higher than both styles'");
        let lost = End { highest: None, ..end.clone() };
        assert_eq!(broken(heats(2.0, 1.0, &end, &lost)), 2, "what is not told is not equal");
        let restless = End { kinetic: 1.0, ..end.clone() };
        assert_eq!(broken(heats(2.0, 1.0, &end, &restless)), 2);
        let looser = End { contacts: 4.85, ..end.clone() };
        assert_eq!(broken(heats(2.0, 1.0, &looser, &end)), 2);
    }
}
