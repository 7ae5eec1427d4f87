//! Studies, output and claims.

use super::{Family, Key, Kind, Word};
use crate::units::{ACCELERATION, FREQUENCY, LENGTH, MASS, NUMBER, TIME, VOLUME};

pub(super) static KEEP: &[Word] = &[
    Word { name: "displacement", about: "The amplitude of the displacement" },
    Word { name: "velocity", about: "The amplitude of the velocity" },
    Word { name: "acceleration", about: "The amplitude of the acceleration, as on a shaker" },
];

static PATH: &[Word] = &[
    Word { name: "apart", about: "Each frequency begins by itself, from the bed" },
    Word {
        name: "up",
        about: "From the lowest to the highest, each in the state that the one before has left (stepped sine)",
    },
    Word { name: "down", about: "From the highest to the lowest" },
    Word {
        name: "up-and-down",
        about: "Both ways, a curve each: where they part, two motions are possible (hysteresis)",
    },
];

pub(super) static RESPONSE: &[Key] = &[
    Key::new(
        "host",
        Kind::Name(Family::Host),
        "The host whose displacement is measured; its base or force must be a sine",
    )
    .derived("the only host"),
    Key::new(
        "frequency-ratio",
        Kind::Ratios,
        "Frequencies over the host's first undamped natural frequency; without `step` a few, and more where the curve bends",
    ),
    Key::new(
        "peak-within",
        Kind::Quantity(&NUMBER),
        "More frequencies are measured until those beside the highest are as near to it as this, as frequency ratios",
    )
    .at_least(1e-5)
    .derived("0.01 where `frequency-ratio` has no `step`; otherwise no more are measured"),
    Key::new("keep", Kind::OneOf(KEEP), "What of the base motion stays the same at all frequencies")
        .derived("what its sine is given by: `amplitude`, `velocity` or `acceleration`"),
    Key::new("path", Kind::OneOf(PATH), "Whether each frequency begins by itself, or where the one before has ended").default("'apart'"),
    Key::new("discard-periods", Kind::Whole, "Periods thrown away before measuring, with grains, which begin at rest; `steady`: they begin in the motion expected, until three blocks of three periods agree")
        .at_least(0.0)
        .at_most(1e6)
        .word("steady"),
    Key::new("discard-periods-empty", Kind::Whole, "The same for the empty host").at_least(0.0).at_most(1e6).word("steady"),
    Key::new("measure-periods", Kind::Whole, "Periods measured").default("10").at_least(1.0).at_most(1e6),
    Key::new("seeds", Kind::Whole, "Number of random seeds, from the scene's seed upwards")
        .default("1")
        .at_least(1.0)
        .at_most(1e4),
    Key::new("vary", Kind::Vary, "Scene keys and the values they take; every combination is a curve").default("{}"),
];

pub(super) static ATLAS: &[Key] = &[
    Key::new("host", Kind::Name(Family::Host), "The host whose walls are shaken along its direction, in its stead")
        .derived("the only host"),
    Key::new("frequency", Kind::Ends(&FREQUENCY), "Lowest and highest frequency").above(0.0),
    Key::new(
        "acceleration",
        Kind::Ends(&ACCELERATION),
        "Lowest and highest amplitude of the acceleration; `g` is a unit",
    )
    .above(0.0),
    Key::new(
        "within",
        Kind::Quantity(&NUMBER),
        "Points are added until none lies farther off the line between its neighbours than this share of the grains' mass",
    )
    .default("0.1")
    .at_least(1e-4)
    .at_most(1.0),
    Key::new("at-most", Kind::Whole, "Points of a case, at most").default("100").at_least(15.0).at_most(1e5),
    Key::new(
        "measure-periods",
        Kind::Whole,
        "Periods measured at each point, at most: of a regular motion twenty are, of one that scatters as many as it takes",
    )
    .default("100")
    .at_least(4.0)
    .at_most(1e6),
    Key::new("seeds", Kind::Whole, "Number of random seeds, from the scene's seed upwards")
        .default("1")
        .at_least(1.0)
        .at_most(1e4),
    Key::new("vary", Kind::Vary, "Scene keys and the values they take; every combination is a cavity of the atlas").default("{}"),
];

static GOAL: &[Word] = &[
    Word { name: "peak", about: "The lowest peak" },
    Word { name: "band", about: "The lowest root mean square over the frequencies of `response.frequency-ratio`" },
];

static ENVELOPE: &[Key] = &[
    Key::new("width", Kind::Quantity(&LENGTH), "Along x").above(0.0).optional(),
    Key::new("depth", Kind::Quantity(&LENGTH), "Along y").above(0.0).optional(),
    Key::new("height", Kind::Quantity(&LENGTH), "Along z").above(0.0).optional(),
];

static COST: &[Key] = &[
    Key::new("per-kilogram", Kind::Quantity(&NUMBER), "Cost of a kilogram, in any one unit of money")
        .default("0")
        .at_least(0.0),
    Key::new("per-grain", Kind::Quantity(&NUMBER), "Cost of a grain beside that, in the same unit")
        .default("0")
        .at_least(0.0),
];

static CHEAP: &[Word] = &[Word { name: "lattice", about: "The automaton" }];

pub(super) static DESIGN: &[Key] = &[
    Key::new(
        "vary",
        Kind::Vary,
        "Scene keys and the values they may take; every combination is a candidate, keys may be many, values listed in their order",
    ),
    Key::new("goal", Kind::OneOf(GOAL), "What is to be low: root mean square displacements of `response.host`")
        .default("'peak'"),
    Key::new(
        "levels",
        Kind::Ratios,
        "Factors of the drive's amplitude at which a candidate is to serve: the worst counts, over its factor",
    )
    .default("[1.0]"),
    Key::new("mass-limit", Kind::Quantity(&MASS), "Mass of all grains, at most").above(0.0).optional(),
    Key::new("stroke-limit", Kind::Quantity(&LENGTH), "Displacement of the host from its mean, at most")
        .above(0.0)
        .optional(),
    Key::new(
        "space-limit",
        Kind::Quantity(&VOLUME),
        "Volume of the upright box that just holds the walls of the host, their thickness left out, at most",
    )
    .above(0.0)
    .optional(),
    Key::new("envelope", Kind::Table(ENVELOPE), "Sides of that box, at most").optional(),
    Key::new("cost-limit", Kind::Quantity(&NUMBER), "Cost of all grains, at most, in the unit in which `cost` is told")
        .above(0.0)
        .optional(),
    Key::new("cost", Kind::Named(COST, "What grains of a material cost, by its name"), "What grains cost").default("{}"),
    Key::new(
        "runs",
        Kind::Whole,
        "Runs at one frequency each: half of them to search, the others to confirm with `seeds`; the best is confirmed even beyond them",
    )
    .default("200")
    .at_least(20.0)
    .at_most(1e6),
    Key::new(
        "cheap",
        Kind::OneOf(CHEAP),
        "A method that is run for many candidates first, to tell where the scene's own is worth its time; its runs count by theirs",
    )
    .optional(),
    Key::new(
        "within",
        Kind::Quantity(&NUMBER),
        "Where no candidate is expected to be better by this share, the search looks far from all that were measured",
    )
    .default("0.01")
    .at_least(1e-4)
    .at_most(1.0),
    Key::new(
        "until",
        Kind::Quantity(&NUMBER),
        "Ends before `runs` are spent: when no candidate is expected to be better by this share and half the 95 % interval of the best is within it; the best gets more seeds for that",
    )
    .at_least(1e-4)
    .at_most(1.0)
    .optional(),
    Key::new("seeds", Kind::Whole, "Number of random seeds that confirm the best candidate and its neighbours")
        .default("3")
        .at_least(2.0)
        .at_most(1e3),
];

static MEASURED: &[Key] = &[
    Key::new("result", Kind::Text, "Name of the result, as in `results` of summary.json"),
    Key::new("value", Kind::Quantity(&NUMBER), "What was measured, in the unit of the result"),
    Key::new(
        "uncertainty",
        Kind::Quantity(&NUMBER),
        "Its standard uncertainty, in the same unit: of two in three measurements the truth lies within it",
    )
    .above(0.0),
    Key::new("source", Kind::Text, "Where it was measured").default("''"),
];

static RESPONDED: &[Word] = &[
    Word { name: "rms-displacement", about: "Root mean square of the displacement, mean removed [m]" },
    Word { name: "peak-displacement", about: "Largest displacement from the mean [m]" },
    Word { name: "acceleration", about: "Amplitude of the acceleration at the driving frequency [m/s^2]" },
    Word {
        name: "transmissibility",
        about: "Amplitude of the displacement over that of the base [-]; of a force, of the force on the base over it",
    },
    Word { name: "base-force", about: "Amplitude of the force on the base [N]" },
    Word { name: "apparent-mass", about: "The mass that the grains add [kg]" },
    Word { name: "loss-per-cycle", about: "Energy lost per cycle [J]" },
];

static CURVE: &[Key] = &[
    Key::new(
        "file",
        Kind::Text,
        "CSV file beside the scene with three columns, `frequency`, what was measured, and its `uncertainty`; the header tells what and in which units: `frequency [Hz], rms displacement [mm], uncertainty [mm]`",
    )
    .optional()
    .rivals(&["quantity", "frequency", "value", "uncertainty"]),
    Key::new("quantity", Kind::OneOf(RESPONDED), "What was measured at each frequency").derived("from `file`").rivals(&["file"]),
    Key::new("frequency", Kind::Quantities(&FREQUENCY), "Frequencies, rising").above(0.0).derived("from `file`").rivals(&["file"]),
    Key::new("value", Kind::Quantities(&NUMBER), "What was measured there, in SI units").derived("from `file`").rivals(&["file"]),
    Key::new("uncertainty", Kind::Quantities(&NUMBER), "Standard uncertainties, in SI units")
        .above(0.0)
        .derived("from `file`")
        .rivals(&["file"]),
    Key::new("source", Kind::Text, "Where it was measured").default("''"),
];

pub(super) static CALIBRATE: &[Key] = &[
    Key::new(
        "vary",
        Kind::Vary,
        "Scene keys with the least and the largest value of each; a range of a factor of 10 or more counts by its logarithm",
    ),
    Key::new(
        "measured",
        Kind::Many(MEASURED),
        "What a run of the scene should give; with a `curve`, what its response should",
    )
    .default("[]"),
    Key::new(
        "curve",
        Kind::Table(CURVE),
        "A measured response curve: each run is then a response at its frequencies, as `[response]` says, without what that varies",
    )
    .optional(),
    Key::new("runs", Kind::Whole, "Runs, at most, beside those that check what was found")
        .default("100")
        .at_least(8.0)
        .at_most(1e4),
    Key::new(
        "within",
        Kind::Quantity(&NUMBER),
        "Runs are added until the results are known as near as this share of what was measured's uncertainty",
    )
    .default("0.3")
    .at_least(1e-3)
    .at_most(1.0),
    Key::new("checks", Kind::Whole, "Runs with other seeds and values from what was found, which check it")
        .default("6")
        .at_least(2.0)
        .at_most(1e3),
];

pub(super) static SWEEP: &[Key] =
    &[Key::new("vary", Kind::Vary, "Scene keys and the values they take; every combination is a run")];

pub(super) static OUTPUT: &[Key] = &[
    Key::new("history-interval", Kind::Quantity(&TIME), "Simulated time between rows of history.csv")
        .above(0.0)
        .derived("duration / 1000")
        .may_change(),
    Key::new("frame-interval", Kind::Quantity(&TIME), "Simulated time between frames")
        .above(0.0)
        .word("none")
        .may_change(),
    Key::new("checkpoint-interval", Kind::Quantity(&TIME), "Simulated time between checkpoints")
        .above(0.0)
        .derived("duration / 10")
        .may_change(),
    Key::new(
        "contacts",
        Kind::Flag,
        "Write the contacts of every frame, with their forces, beside the grains: more bytes than these",
    )
    .default("true")
    .may_change(),
    Key::new("xyz", Kind::Flag, "Also write extended XYZ, which OVITO opens").default("false").may_change(),
    Key::new("lammps", Kind::Flag, "Also write LAMMPS dump files, for `read_dump`, `rerun` and OVITO")
        .default("false")
        .may_change(),
];

pub(super) static CLAIM: &[Key] = &[
    Key::new("result", Kind::Text, "Name of the result, as in `results` of summary.json"),
    Key::new("low", Kind::Quantity(&NUMBER), "Lower end of the accepted range").optional(),
    Key::new("high", Kind::Quantity(&NUMBER), "Upper end of the accepted range").optional(),
    Key::new("source", Kind::Text, "Where the accepted range comes from"),
];
