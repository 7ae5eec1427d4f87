//! What tsubu is held against: every claim re-run by one command, `tsubu verify`.

mod bedload;
mod beds;
mod bench;
mod brazil_nut;
mod chung_ooi_2011;
mod chute;
mod cl_ca_2001;
mod cohesion;
mod common_test;
mod contact;
mod cooling;
mod damper_2003;
mod drop;
mod drum;
mod drum_regimes;
mod film;
mod held;
mod host;
mod impact_damper;
mod lattice_grain;
mod lattice_review;
mod lump;
mod open_dem_benchmark;
mod orifice;
mod outlet;
mod pile_stress;
mod pile_twin;
mod random_loads;
mod recorded;
mod rheology;
mod rolling;
mod sediment_2004;
mod shapes;
mod sieving;
mod silo;
mod spin_in_water;
mod stack;
mod throw;
mod voids;
mod water;

pub use recorded::recorded;
use tsubu_frame::{Claim, RunFolder};

/// The claims of a case, or why it came to none.
pub type Judged = Result<Vec<Claim>, String>;

/// One verification case: a few claims from one set of runs.
pub struct Case {
    /// Name, as in `tsubu verify NAME`.
    pub name: &'static str,
    /// Study it belongs to; `tsubu verify STUDY` runs all its cases.
    pub study: &'static str,
    /// One line.
    pub about: &'static str,
    /// Minutes rather than seconds: only with `--all`, or when its name or its study's is given.
    pub long: bool,
    /// Runs it. The factor multiplies the constants of the contact law; 1 but in the tests that show that the
    /// claims can fail.
    pub run: fn(spoiler: f64) -> Judged,
    /// The same into a folder, where it leaves pictures and tables; `None`: claims are all there is.
    pub kept: Option<fn(folder: &RunFolder) -> Judged>,
}

/// All cases, in the order they are listed and run.
pub static CASES: &[Case] = &[
    quick("restitution", "contact", "V-05: restitution in = restitution out, every damping form", contact::restitution),
    quick(
        "chung-ooi-normal",
        "chung-ooi-2011",
        "V-02 to V-04: force, overlap and time of Hertz",
        chung_ooi_2011::elastic,
    ),
    quick("chung-ooi-restitution", "chung-ooi-2011", "V-04: restitution in = out", chung_ooi_2011::restitution),
    quick("chung-ooi-oblique", "chung-ooi-2011", "V-10: oblique impacts, Kharaz 2001", chung_ooi_2011::kharaz),
    quick("chung-ooi-sliding", "chung-ooi-2011", "V-11: gross sliding", chung_ooi_2011::gross_sliding),
    quick("chung-ooi-no-slip", "chung-ooi-2011", "V-13: spins that do not slip", chung_ooi_2011::no_slip),
    quick("chung-ooi-spin", "chung-ooi-2011", "V-12, V-14: spinning spheres", chung_ooi_2011::spinning),
    quick(
        "restitution-shapes",
        "contact",
        "V-05: restitution at grains, plane, cylinder, triangle",
        shapes::restitution,
    ),
    quick("damping-published", "contact", "V-05: damping without attraction, as published", shapes::thornton),
    quick("tangential-spring", "contact", "V-15: tangential restitution without slip", held::no_slip),
    quick("three-spheres", "contact", "V-16: a small sphere held by friction, any size ratio", held::three_spheres),
    quick("stacked", "contact", "V-07: two spheres pressed between planes", stack::stacked),
    quick("pull-off", "contact", "V-08: pull-off forces of DMT and JKR", cohesion::pull_off),
    quick("slide-to-roll", "rolling", "V-20: a sliding grain comes to roll", rolling::slide_to_roll),
    quick("incline", "rolling", "V-21: rolling and sliding down a slope", rolling::incline),
    quick("spin-down", "rolling", "V-22, V-24: torques of rolling resistance", rolling::spin_down),
    quick("rolling-models", "rolling", "V-23: stops and stays", rolling::models),
    quick("haff", "dem-benchmarks", "V-30: a gas of grains cools, in the plane and in space", cooling::haff),
    quick("centrifuging", "dem-benchmarks", "V-37: where a drum's grain leaves the wall", drum::centrifuging),
    quick("q-model", "dem-benchmarks", "V-40: random loads on a lattice", random_loads::q_model),
    quick("rebound-on-steel", "open-dem-benchmark", "V-48: rebound at 0.4 m/s", open_dem_benchmark::rebound),
    quick(
        "starts-to-roll",
        "open-dem-benchmark",
        "V-48: a steel sphere rolls down 45 degrees",
        open_dem_benchmark::roll,
    ),
    quick("drop-dem", "damper-2003", "V-06, A-F8: a ball dropped in a still box, by DEM", drop::dem),
    quick("drop-lattice", "damper-2003", "A-F8: the same by the automaton", drop::lattice),
    quick("lump", "shaken", "V-39: an inelastic ball locks to a shaken floor", lump::locking),
    quick("impact-damper", "damper", "V-60: one ball, two impacts a cycle", impact_damper::symmetric),
    quick("loss-factor", "damper", "the empty structure's loss factor by three ways", host::loss_factor),
    quick("added-mass", "damper", "V-65, A-7.1: a bed at rest is an added mass", host::added_mass),
    quick("ring-down", "damper", "loss factor with balls, driven and ringing down", host::loss_factor_with_grains),
    quick("figure-9", "damper-2003", "A-F9, A-F10: shaken box, landing and lift-off", damper_2003::figure_9),
    quick("contact-time", "sediment-2004", "B-F4, B-F12: contact time against stiffness", sediment_2004::contact_time),
    quick("damped-contact", "sediment-2004", "B-F5: contact time with damping", sediment_2004::damped),
    quick("overlap-band", "sediment-2004", "B-F8, B-F11: overlap, and the band of stiffness", sediment_2004::overlap),
    quick("bed-at-rest", "sediment-2004", "B-F9, B-F10: 42 grains come to rest, or do not", sediment_2004::settling),
    quick("pushed-row", "sediment-2004", "B-F22: a row of grains as a rod", sediment_2004::rod),
    quick("settling", "water", "V-50: terminal speeds by four drag laws", water::settling),
    quick("released", "water", "V-55: the begin of a fall, with added mass", water::released),
    quick("spin-in-water", "water", "V-54: torque on spin", spin_in_water::spin),
    quick("wet-rebound", "water", "V-56: a film on the way in, and restitution in a liquid", film::rebounds),
    quick("packed-column", "water", "V-52: Ergun's loss of pressure", water::packed),
    quick("fluidised", "water", "V-53: water that carries its bed", water::fluidised),
    long("bedload", "water", "V-57: transport rates of a coupled stream", bedload::rates),
    quick(
        "saltation",
        "sediment-2004",
        "B-F6, B-F7: a leaping grain, contact times and hops",
        sediment_2004::saltation,
    ),
    long("saltation-softest", "sediment-2004", "B-F6: the softest contacts", sediment_2004::softest),
    quick("saltation-spin", "sediment-2004", "B-F20, B-F21: the same with spin", sediment_2004::spinning),
    quick("saltation-space", "sediment-2004", "V-58: leaping grains in space", sediment_2004::saltation_space),
    long("dam-break-space", "sediment-2004", "a dam break in space: run-out", sediment_2004::dam_break_space),
    quick("fhp-collisions", "lattice-review", "R-3.0: what collisions make of a stress", lattice_review::collisions),
    quick("fhp-viscosity", "lattice-review", "R-3.0: viscosity of the lattice gases FHP", lattice_review::viscosity),
    quick("fhp-sound", "lattice-review", "R-3.0: speed of sound of the lattice gases", lattice_review::sound),
    quick("fhp-channel", "lattice-review", "R-3.0: flow in a channel, conservation", lattice_review::channel),
    quick("collapse", "cl-ca-2001", "C-F9 to F11: 540 grains lose a side wall", cl_ca_2001::collapse),
    quick("rise", "cl-ca-2001", "C-x1: a large grain rises in a shaken box", cl_ca_2001::rise),
    quick("convection", "cl-ca-2001", "C-x2: rolls between rough walls", cl_ca_2001::convection),
    quick("poured-heap", "cl-ca-2001", "C-x3: slopes of a poured heap", cl_ca_2001::pour),
    quick("pushed-plate", "cl-ca-2001", "C-x4: a plate pushed into a bed", cl_ca_2001::plate),
    quick("cl-ca-invariants", "cl-ca-2001", "C-6: what holds after every step", cl_ca_2001::invariants),
    quick("turning", "cl-ca-2001", "C-7: the collapse of triangles that may turn", cl_ca_2001::turning),
    long("plate-twin", "cl-ca-2001", "C-x4: the network of the plate beside forces of DEM", cl_ca_2001::plate_twin),
    long("collapse-twin", "cl-ca-2001", "C-F9 to F11: the same by DEM, and what both cost", cl_ca_2001::twin),
    Case {
        kept: Some(|folder| common_test::hopper(1.0, Some(folder))),
        ..long("common-hopper", "common-test", "a silo runs out, by every model", |s| common_test::hopper(s, None))
    },
    Case {
        kept: Some(|folder| common_test::heap(1.0, Some(folder))),
        ..long("common-heap", "common-test", "a heap grows, by every model", |s| common_test::heap(s, None))
    },
    Case {
        kept: Some(|folder| common_test::shaken(1.0, Some(folder))),
        ..long("common-shaken", "common-test", "two sizes are shaken, by every model", |s| common_test::shaken(s, None))
    },
    Case {
        kept: Some(|folder| common_test::collapse(1.0, Some(folder))),
        ..long("common-collapse", "common-test", "a wall goes, by every model", |s| common_test::collapse(s, None))
    },
    quick("litwiniszyn", "lattice-review", "R-1: voids that walk up at random", voids::litwiniszyn_case),
    quick("caram-hong", "lattice-review", "R-2: many voids, exclusion, a surface", voids::caram_hong_case),
    quick("savage", "lattice-review", "R-3.3: a chute on the square lattice that sorts by size", sieving::chute),
    quick("gutt-haff", "lattice-review", "R-4, A-F8: free fall, rebounds, momentum", lattice_grain::drop),
    quick("gutt-haff-silo", "lattice-review", "R-4: load on the floor of a silo", lattice_grain::janssen),
    quick("hemmingsson-herrmann", "lattice-review", "R-5: forces in a pile, row by row", pile_stress::pile),
    long("pile-twin", "lattice-review", "R-5: forces of a pile beside those of DEM", pile_twin::twin),
    quick("pipe-limit", "lattice-review", "R-3.1: grains that lose no energy are FHP-II", lattice_review::pipe_limit),
    quick("pipe-waves", "lattice-review", "R-3.1: when density waves run through a pipe", lattice_review::pipe_waves),
    quick(
        "hopper-order",
        "lattice-review",
        "R-3.2: elongated grains line up in a hopper",
        lattice_review::hopper_order,
    ),
    quick("pile-angle", "lattice-review", "R-3.4: the slope of a pile grows with friction", lattice_review::pile_angle),
    quick("pile-avalanches", "lattice-review", "R-3.4: avalanches are bounded", lattice_review::pile_avalanches),
    quick("pile-segregation", "lattice-review", "R-3.4: smooth grains go farther", lattice_review::pile_segregation),
    long(
        "fhp-viscosity-plain",
        "lattice-review",
        "R-3.0: the same in FHP-II and III as they are, where correlations tell",
        lattice_review::viscosity_plain,
    ),
    long("pipe-smooth", "lattice-review", "R-3.1: a pipe with smooth walls", lattice_review::pipe_smooth),
    long("hopper-walls", "lattice-review", "R-3.2: order of elongated grains near walls", lattice_review::hopper_walls),
    long("silo-layers", "lattice-review", "R-3.4: whether a poured silo has layers", lattice_review::silo_layers),
    long("pipe-spectrum", "lattice-review", "R-3.1: spectrum of the density in a pipe", lattice_review::pipe_spectrum),
    long("drum-regimes", "dem-benchmarks", "V-37: rolling, cascading, cataracting", drum_regimes::regimes),
    long("rheology", "dem-benchmarks", "V-35: friction against inertial number", rheology::friction),
    long("beverloo", "dem-benchmarks", "V-31: discharge through a slot, in the plane", outlet::beverloo),
    long("beverloo-3d", "dem-benchmarks", "V-31: discharge through a round hole", orifice::beverloo),
    long("janssen", "dem-benchmarks", "V-32: pressure in a silo, in the plane", silo::janssen),
    long("chute", "dem-benchmarks", "V-35, V-36: flow down a rough slope", chute::silbert),
    long("brazil-nut", "dem-benchmarks", "V-38: a large grain rises in a shaken bed", brazil_nut::brazil_nut),
    long("dam-break", "sediment-2004", "B-F19: slopes after a dam break", sediment_2004::dam_break),
    long("dam-break-rolling", "sediment-2004", "B-F19, B-F23: rolling friction", sediment_2004::dam_break_rolling),
    long("avalanche", "sediment-2004", "B-F13 to B-F16: rock at 40 degrees", sediment_2004::avalanche),
    long("mobile-bed", "sediment-2004", "B-F22: a mobile bed, rotation locked and free", sediment_2004::mobile_bed),
    long("dense-flow", "sediment-2004", "B-F17, Takahashi: dense flow in a flume", sediment_2004::dense_flow),
    long("avalanche-stiff", "sediment-2004", "the same with contacts of 0.1 ms", sediment_2004::avalanche_stiff),
    long("figure-3a", "damper-2003", "A-F3a: response by DEM, literal law", damper_2003::figure_3a),
    long("figure-3b", "damper-2003", "A-F3b: the same with more wall friction", damper_2003::figure_3b),
    long("figure-3-extended", "damper-2003", "A-F3: response by DEM, extended law", damper_2003::figure_3_extended),
    long(
        "figure-11-literal",
        "damper-2003",
        "A-F11: response by the automaton, literal",
        damper_2003::figure_11_literal,
    ),
    long("figure-11-extended", "damper-2003", "A-F11: the same, extended", damper_2003::figure_11_extended),
    long("figure-12", "damper-2003", "A-F12: cost of both methods against N", damper_2003::figure_12),
];

const fn quick(name: &'static str, study: &'static str, about: &'static str, run: fn(f64) -> Judged) -> Case {
    Case { name, study, about, long: false, run, kept: None }
}

const fn long(name: &'static str, study: &'static str, about: &'static str, run: fn(f64) -> Judged) -> Case {
    Case { name, study, about, long: true, run, kept: None }
}

/// The cases that the given names choose: case names or study names; none given means all quick ones.
/// Fails with the first name that is neither.
pub fn chosen(names: &[String], all: bool) -> Result<Vec<&'static Case>, String> {
    if names.is_empty() {
        return Ok(CASES.iter().filter(|c| all || !c.long).collect());
    }
    let mut chosen = Vec::new();
    for name in names {
        let before = chosen.len();
        chosen.extend(CASES.iter().filter(|c| c.name == name || c.study == name));
        if chosen.len() == before {
            return Err(format!("there is no verification case or study `{name}`; `tsubu verify --list` shows them"));
        }
    }
    Ok(chosen)
}

impl Case {
    /// Runs the case, into a folder if there is one; its claims carry its study's name.
    pub fn claims(&self, folder: Option<&RunFolder>) -> Judged {
        let claims = match (self.kept, folder) {
            (Some(kept), Some(folder)) => kept(folder)?,
            _ => (self.run)(1.0)?,
        };
        Ok(claims.into_iter().map(|c| c.of(self.study)).collect())
    }
}
