//! The list of all cases.

use crate::case::{Case, Judged};
use crate::{
    bedload, brazil_nut, chung_ooi_2011, chute, cl_ca_2001, cohesion, common_test, contact, cooling, damper_2003, drop,
    drum, drum_regimes, expansion, film, held, host, impact_damper, lattice_grain, lattice_review, lump,
    open_dem_benchmark, order, orifice, outlet, pile_stress, pile_twin, plastic, random_loads, rheology, rolling,
    sediment_2004, shapes, sieving, silo, spin_in_water, stack, triaxial, twisting, voids, water,
};

/// All cases, in the order they are listed and run.
pub static CASES: &[Case] = &[
    case("restitution", "contact", 2, "restitution in = restitution out, every damping form", contact::restitution),
    case("oblique-order", "contact", 5, "error against time step", order::oblique),
    case("restitution-at-default-step", "contact", 5, "restitution in = out, at the default step", order::restitution),
    case("chung-ooi-normal", "chung-ooi-2011", 1, "force, overlap and time of Hertz", chung_ooi_2011::elastic),
    case("chung-ooi-restitution", "chung-ooi-2011", 1, "restitution in = out", chung_ooi_2011::restitution),
    case("chung-ooi-oblique", "chung-ooi-2011", 1, "oblique impacts, Kharaz 2001", chung_ooi_2011::kharaz),
    gap(case(
        "chung-ooi-default",
        "chung-ooi-2011",
        1,
        "oblique impacts by the default law",
        chung_ooi_2011::kharaz_default,
    )),
    case("chung-ooi-sliding", "chung-ooi-2011", 1, "gross sliding", chung_ooi_2011::gross_sliding),
    case("chung-ooi-no-slip", "chung-ooi-2011", 1, "spins that do not slip", chung_ooi_2011::no_slip),
    case("chung-ooi-spin", "chung-ooi-2011", 2, "spinning spheres", chung_ooi_2011::spinning),
    case("restitution-shapes", "contact", 1, "restitution at grains, plane, cylinder, triangle", shapes::restitution),
    case("damping-published", "contact", 1, "damping without attraction, as published", shapes::thornton),
    case("tangential-spring", "contact", 1, "tangential restitution without slip", held::no_slip),
    case("three-spheres", "contact", 1, "a small sphere held by friction, any size ratio", held::three_spheres),
    case("stacked", "contact", 1, "two spheres pressed between planes", stack::stacked),
    case("pull-off", "contact", 5, "pull-off forces of DMT and JKR", cohesion::pull_off),
    case("dent", "contact", 2, "impacts that yield and hold on, by Luding's law", plastic::dent),
    case("slide-to-roll", "rolling", 1, "a sliding grain comes to roll", rolling::slide_to_roll),
    case("incline", "rolling", 1, "rolling and sliding down a slope", rolling::incline),
    case("spin-down", "rolling", 1, "torques of rolling resistance", rolling::spin_down),
    case("rolling-models", "rolling", 2, "stops and stays", rolling::models),
    case("twist-down", "rolling", 2, "a sphere that spins about the normal", twisting::spin_about_normal),
    case("haff", "dem-benchmarks", 10, "a gas of grains cools, in the plane and in space", cooling::haff),
    gap(case("haff-inelastic", "dem-benchmarks", 10, "the same at a restitution of 0.8", cooling::haff_inelastic)),
    case("centrifuging", "dem-benchmarks", 1, "where a drum's grain leaves the wall", drum::centrifuging),
    case("q-model", "dem-benchmarks", 5, "random loads on a lattice", random_loads::q_model),
    case("rebound-on-steel", "open-dem-benchmark", 1, "rebound at 0.4 m/s", open_dem_benchmark::rebound),
    case("starts-to-roll", "open-dem-benchmark", 1, "a steel sphere rolls down 45 degrees", open_dem_benchmark::roll),
    case("drop-dem", "damper-2003", 2, "a ball dropped in a still box, by DEM (figure 8)", drop::dem),
    case("drop-lattice", "damper-2003", 1, "the same by the automaton (figure 8)", drop::lattice),
    case("meeting-lattice", "damper-2003", 1, "two balls of the automaton meet head-on", drop::meeting),
    case("lump", "shaken", 10, "an inelastic ball locks to a shaken floor", lump::locking),
    case("impact-damper", "damper", 60, "one ball, two impacts a cycle", impact_damper::symmetric),
    case("loss-factor", "damper", 1, "the empty structure's loss factor by three ways", host::loss_factor),
    case("added-mass", "damper", 5, "a bed at rest is an added mass", host::added_mass),
    case("ring-down", "damper", 10, "loss factor with balls, driven and ringing down", host::loss_factor_with_grains),
    case("figure-9", "damper-2003", 20, "shaken box, landing and lift-off (figures 9 and 10)", damper_2003::figure_9),
    case(
        "contact-time",
        "sediment-2004",
        1,
        "contact time against stiffness (figures 4 and 12)",
        sediment_2004::contact_time,
    ),
    case("damped-contact", "sediment-2004", 1, "contact time with damping (figure 5)", sediment_2004::damped),
    case(
        "overlap-band",
        "sediment-2004",
        1,
        "overlap, and the band of stiffness (figures 8 and 11)",
        sediment_2004::overlap,
    ),
    case(
        "bed-at-rest",
        "sediment-2004",
        5,
        "42 grains come to rest, or do not (figures 9 and 10)",
        sediment_2004::settling,
    ),
    case("pushed-row", "sediment-2004", 2, "a row of grains as a rod (figure 22)", sediment_2004::rod),
    case("settling", "water", 5, "terminal speeds by four drag laws", water::settling),
    case("released", "water", 1, "the begin of a fall, with added mass", water::released),
    case("spin-in-water", "water", 1, "torque on spin", spin_in_water::spin),
    case("wet-rebound", "water", 1, "a film on the way in, and restitution in a liquid", film::rebounds),
    case("packed-column", "water", 20, "Ergun's loss of pressure", water::packed),
    case("fluidised", "water", 20, "water that carries its bed", water::fluidised),
    case("expansion", "water", 30, "how far a carried bed expands", expansion::balance),
    gap(case("expansion-exponent", "water", 60, "by which power of the void fraction", expansion::exponents)),
    gap(case("bedload", "water", 3600, "transport rates of a coupled stream", bedload::rates)),
    case(
        "saltation",
        "sediment-2004",
        60,
        "a leaping grain, contact times and hops (figures 6 and 7)",
        sediment_2004::saltation,
    ),
    gap(case("saltation-softest", "sediment-2004", 1, "the softest contacts (figure 6)", sediment_2004::softest)),
    case("saltation-spin", "sediment-2004", 30, "the same with spin (figures 20 and 21)", sediment_2004::spinning),
    case("saltation-space", "sediment-2004", 5, "leaping grains in space", sediment_2004::saltation_space),
    case("dam-break-space", "sediment-2004", 90, "a dam break in space: run-out", sediment_2004::dam_break_space),
    case("fhp-collisions", "lattice-review", 1, "what collisions make of a stress", lattice_review::collisions),
    case("fhp-viscosity", "lattice-review", 10, "viscosity of the lattice gases FHP", lattice_review::viscosity),
    case("fhp-sound", "lattice-review", 1, "speed of sound of the lattice gases", lattice_review::sound),
    case("fhp-channel", "lattice-review", 5, "flow in a channel, conservation", lattice_review::channel),
    case("cl-ca-rules", "cl-ca-2001", 1, "each sketch of a rule, before and after (figures 4 to 8)", cl_ca_2001::rules),
    case("collapse", "cl-ca-2001", 1, "540 grains lose a side wall (figures 9 to 11)", cl_ca_2001::collapse),
    case("rise", "cl-ca-2001", 5, "a large grain rises in a shaken box", cl_ca_2001::rise),
    case("convection", "cl-ca-2001", 5, "rolls between rough walls", cl_ca_2001::convection),
    case("poured-heap", "cl-ca-2001", 1, "slopes of a poured heap", cl_ca_2001::pour),
    case("pushed-plate", "cl-ca-2001", 2, "a plate pushed into a bed", cl_ca_2001::plate),
    case("cl-ca-invariants", "cl-ca-2001", 2, "what holds after every step", cl_ca_2001::invariants),
    case("turning", "cl-ca-2001", 1, "the collapse of triangles that may turn", cl_ca_2001::turning),
    gap(case("plate-twin", "cl-ca-2001", 10, "the network of the plate beside forces of DEM", cl_ca_2001::plate_twin)),
    gap(case(
        "collapse-twin",
        "cl-ca-2001",
        10,
        "the same by DEM, and what both cost (figures 9 to 11)",
        cl_ca_2001::twin,
    )),
    Case {
        kept: Some(|folder| common_test::hopper(1.0, Some(folder))),
        ..gap(case("common-hopper", "common-test", 60, "a silo runs out, by every model", |s| {
            common_test::hopper(s, None)
        }))
    },
    Case {
        kept: Some(|folder| common_test::heap(1.0, Some(folder))),
        ..case("common-heap", "common-test", 90, "a heap grows, by every model", |s| common_test::heap(s, None))
    },
    Case {
        kept: Some(|folder| common_test::shaken(1.0, Some(folder))),
        ..gap(case("common-shaken", "common-test", 20, "two sizes are shaken, by every model", |s| {
            common_test::shaken(s, None)
        }))
    },
    Case {
        kept: Some(|folder| common_test::collapse(1.0, Some(folder))),
        ..gap(case("common-collapse", "common-test", 10, "a wall goes, by every model", |s| {
            common_test::collapse(s, None)
        }))
    },
    case("litwiniszyn", "lattice-review", 1, "voids that walk up at random", voids::litwiniszyn_case),
    case("caram-hong", "lattice-review", 2, "many voids, exclusion, a surface", voids::caram_hong_case),
    case("savage", "lattice-review", 2, "a chute on the square lattice that sorts by size", sieving::chute),
    case("gutt-haff", "lattice-review", 1, "free fall, rebounds, momentum", lattice_grain::drop),
    case("gutt-haff-silo", "lattice-review", 1, "load on the floor of a silo", lattice_grain::janssen),
    case("hemmingsson-herrmann", "lattice-review", 1, "forces in a pile, row by row", pile_stress::pile),
    gap(case("pile-twin", "lattice-review", 60, "forces of a pile beside those of DEM", pile_twin::twin)),
    case("pipe-limit", "lattice-review", 1, "grains that lose no energy are FHP-II", lattice_review::pipe_limit),
    case("pipe-waves", "lattice-review", 5, "when density waves run through a pipe", lattice_review::pipe_waves),
    case("hopper-order", "lattice-review", 5, "elongated grains line up in a hopper", lattice_review::hopper_order),
    case("pile-angle", "lattice-review", 1, "the slope of a pile grows with friction", lattice_review::pile_angle),
    case("pile-avalanches", "lattice-review", 1, "avalanches are bounded", lattice_review::pile_avalanches),
    case("pile-segregation", "lattice-review", 1, "smooth grains go farther", lattice_review::pile_segregation),
    gap(case(
        "fhp-viscosity-plain",
        "lattice-review",
        600,
        "the same in FHP-II and III as they are, where correlations tell",
        lattice_review::viscosity_plain,
    )),
    gap(case("pipe-smooth", "lattice-review", 2, "a pipe with smooth walls", lattice_review::pipe_smooth)),
    gap(case(
        "hopper-walls",
        "lattice-review",
        5,
        "order of elongated grains near walls",
        lattice_review::hopper_walls,
    )),
    gap(case("silo-layers", "lattice-review", 1, "whether a poured silo has layers", lattice_review::silo_layers)),
    case("pipe-spectrum", "lattice-review", 90, "spectrum of the density in a pipe", lattice_review::pipe_spectrum),
    gap(case("drum-regimes", "dem-benchmarks", 30, "rolling, cascading, cataracting", drum_regimes::regimes)),
    case("rheology", "dem-benchmarks", 1800, "friction against inertial number", rheology::friction),
    gap(case("beverloo", "dem-benchmarks", 1800, "discharge through a slot, in the plane", outlet::beverloo)),
    gap(case("beverloo-3d", "dem-benchmarks", 1800, "discharge through a round hole", orifice::beverloo)),
    gap(case("janssen", "dem-benchmarks", 1800, "pressure in a silo, in the plane", silo::janssen)),
    gap(case("chute", "dem-benchmarks", 1800, "flow down a rough slope", chute::silbert)),
    gap(case("triaxial", "triaxial-spheres", 1800, "strength and stiffness of spheres", triaxial::spheres)),
    case("brazil-nut", "dem-benchmarks", 1800, "a large grain rises in a shaken bed", brazil_nut::brazil_nut),
    gap(case("dam-break", "sediment-2004", 1800, "slopes after a dam break (figure 19)", sediment_2004::dam_break)),
    gap(case(
        "dam-break-rolling",
        "sediment-2004",
        1800,
        "rolling friction (figures 19 and 23)",
        sediment_2004::dam_break_rolling,
    )),
    gap(case("avalanche", "sediment-2004", 1800, "rock at 40 degrees (figures 13 to 16)", sediment_2004::avalanche)),
    gap(case(
        "mobile-bed",
        "sediment-2004",
        1800,
        "a mobile bed, rotation locked and free (figure 22)",
        sediment_2004::mobile_bed,
    )),
    gap(case(
        "dense-flow",
        "sediment-2004",
        1800,
        "dense flow in a flume, Takahashi 1978 (figure 17)",
        sediment_2004::dense_flow,
    )),
    gap(case(
        "avalanche-stiff",
        "sediment-2004",
        1800,
        "the same with contacts of 0.1 ms",
        sediment_2004::avalanche_stiff,
    )),
    case("figure-3a", "damper-2003", 1800, "response by DEM, literal law (figure 3a)", damper_2003::figure_3a),
    gap(case("figure-3b", "damper-2003", 1800, "the same with more wall friction (figure 3b)", damper_2003::figure_3b)),
    case(
        "figure-3-extended",
        "damper-2003",
        1800,
        "response by DEM, extended law (figure 3)",
        damper_2003::figure_3_extended,
    ),
    gap(case(
        "figure-11-literal",
        "damper-2003",
        1800,
        "response by the automaton, literal (figure 11)",
        damper_2003::figure_11_literal,
    )),
    case("figure-11-extended", "damper-2003", 1800, "the same, extended (figure 11)", damper_2003::figure_11_extended),
    gap(case("figure-12", "damper-2003", 300, "cost of both methods against N (figure 12)", damper_2003::figure_12)),
];

/// A case with claims and nothing to keep.
const fn case(
    name: &'static str,
    study: &'static str,
    budget: u32,
    about: &'static str,
    run: fn(f64) -> Judged,
) -> Case {
    Case { name, study, about, budget, gap: false, run, kept: None }
}

/// A case that shows a gap.
const fn gap(case: Case) -> Case {
    Case { gap: true, ..case }
}
