//! What is raced: the workloads, and what is promised about each.

/// One workload.
#[derive(Debug)]
pub struct Course {
    /// Name in tables and for `--only`.
    pub name: &'static str,
    /// What it is, in words.
    pub about: &'static str,
    /// tsubu's scene in `benches/race/`, without the ending.
    pub scene: &'static str,
    pub grains: u32,
    /// LAMMPS's deck.
    pub deck: &'static str,
    /// LAMMPS's variables but style, skin and steps.
    pub variables: &'static [&'static str],
    /// The variable that chooses the style.
    pub chooser: &'static str,
    /// LAMMPS's styles: value of the chooser, and what it means. The first is its general one.
    pub styles: &'static [(&'static str, &'static str)],
    /// Diameter of a grain in the unit of length of both.
    pub diameter: f64,
    pub warm: u32,
    pub steps: u32,
    /// How many times faster tsubu is to be.
    pub wanted: f64,
    pub bands: Bands,
}

/// How near the two must end.
#[derive(Clone, Copy, Debug)]
pub enum Bands {
    /// A flow: kinetic energy, relative.
    Flow { kinetic: f64 },
    /// A bed at rest: height of the highest grain over the diameter, and the most kinetic energy of a grain [J], which is
    /// noise and not compared.
    Rest { height: f64, kinetic: f64 },
    /// A bed that a new law sets in motion: height likewise, energy of motion relative.
    Settling { height: f64, kinetic: f64 },
}

/// Contacts per grain may differ by this, relative.
pub const CONTACTS: f64 = 0.02;
/// How many times faster tsubu is to be on two cores.
pub const SCALING: f64 = 1.8;
/// The same on two ranks.
pub const SCALING_OF_RANKS: f64 = 1.85;
/// How many times as long as two threads two ranks may take.
pub const RANKS_OVER_THREADS: f64 = 1.05;
/// How many times LAMMPS's peak memory tsubu may take.
pub const MEMORY: f64 = 2.0;
/// Where memory is compared.
pub const LARGE: &str = "W2-100k";

/// A thousandth of what lifts a grain by its own diameter, m g d.
const NOISE: f64 = 1e-3 * 1.047_2e-5 * 9.81 * 2e-3;
const REST: Bands = Bands::Rest { height: 0.01, kinetic: NOISE };

const HERTZ: &[(&str, &str)] = &[("hertz", "granular hertz/material"), ("hertzhist", "gran/hertz/history")];

pub const COURSES: [Course; 4] = [
    Course {
        name: "W1",
        about: "chute, linear history",
        scene: "chute",
        grains: 32_000,
        deck: "in.chute",
        variables: &[],
        chooser: "style",
        styles: &[("granular", "granular hooke"), ("hookehist", "gran/hooke/history")],
        diameter: 1.0,
        warm: 100,
        steps: 400,
        wanted: 1.5,
        bands: Bands::Flow { kinetic: 1e-3 },
    },
    Course {
        name: "W2-10k",
        about: "settled bed, Hertz-Mindlin",
        scene: "settled",
        grains: 10_000,
        deck: "in.settle",
        variables: &["data", "settled_10000.data", "L", "0.05"],
        chooser: "model",
        styles: HERTZ,
        diameter: 2e-3,
        warm: 200,
        steps: 1000,
        wanted: 2.0,
        bands: REST,
    },
    Course {
        name: LARGE,
        about: "settled bed, Hertz-Mindlin",
        scene: "settled-100k",
        grains: 100_000,
        deck: "in.settle",
        variables: &["data", "settled_100000.data", "L", "0.107721735"],
        chooser: "model",
        styles: HERTZ,
        diameter: 2e-3,
        warm: 20,
        steps: 60,
        wanted: 2.0,
        bands: REST,
    },
    Course {
        name: "W3",
        about: "settled bed, rolling friction",
        scene: "rolling",
        grains: 10_000,
        deck: "in.settle",
        variables: &["data", "settled_10000.data", "L", "0.05"],
        chooser: "model",
        styles: &[("rolling", "granular hooke, rolling sds")],
        diameter: 2e-3,
        warm: 200,
        steps: 1000,
        wanted: 2.0,
        bands: Bands::Settling { height: 0.01, kinetic: 0.05 },
    },
];

/// Who runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Racer {
    Tsubu,
    /// The same, a rank of MPI on each of two cores.
    Ranks,
    /// LAMMPS with the style of that number.
    Lammps(usize),
}

impl Racer {
    /// Skins that are tried: tsubu's over the smallest diameter, LAMMPS's over the mean one.
    pub const fn skins(self) -> &'static [f64] {
        match self {
            Self::Tsubu | Self::Ranks => &[0.05, 0.1, 0.15, 0.2, 0.3],
            Self::Lammps(_) => &[0.05, 0.1, 0.2, 0.3],
        }
    }

    pub fn name(self, course: &Course) -> String {
        match self {
            Self::Tsubu => "tsubu".to_owned(),
            Self::Ranks => "tsubu, two ranks".to_owned(),
            Self::Lammps(style) => format!("LAMMPS `{}`", course.styles[style].1),
        }
    }
}

impl Course {
    /// All who run here on one core, tsubu first.
    pub fn racers(&self) -> Vec<Racer> {
        std::iter::once(Racer::Tsubu).chain((0..self.styles.len()).map(Racer::Lammps)).collect()
    }

    /// Million particle-steps a second.
    pub fn rate(&self, seconds: f64) -> f64 {
        f64::from(self.grains) * f64::from(self.steps) / seconds * 1e-6
    }
}
