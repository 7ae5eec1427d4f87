//! Why claims do not hold, in a sentence each: what is known of it, or that it is not known.

/// Case, how the names of the claims begin that it is said of (all of the case: nothing), sentence.
const REASONS: &[(&str, &str, &str)] = &[
    (
        "chung-ooi-default",
        "",
        "the default spring is scaled down with its stiffness on unloading and has a dashpot, which makes no energy; the published curve is that of the undamped secant law, which does",
    ),
    (
        "saltation-softest",
        "",
        "in a contact of 1 ms the grain goes on by 0.36 d along the bed, so that the grain below lets it go early; the closed form is for a grain that falls on its top",
    ),
    (
        "expansion-exponent",
        "bed of 0.3 mm",
        "the law itself: the balance of Di Felice's drag and the weight expands by a power of 4.25 at this size, a quarter more than was measured",
    ),
    (
        "expansion-exponent",
        "bed of 2 mm",
        "the stream of a column knows one velocity a layer: coarse beads part into sheets with water between them, which stay where they are, and the void fraction is 2 % larger, the bed 4 to 6 % higher, than those of one that is alike everywhere",
    ),
    (
        "drum-regimes",
        "",
        "the surface is straight where a cascade has an S; a drum of 30 diameters is small, and one of 100 bends by 5.7 degrees",
    ),
    (
        "haff-inelastic",
        "",
        "the gas cools 3 to 4 % more slowly than by molecular chaos, whatever step and stiffness: neighbours come to move alike, in a box near the size at which vortices grow",
    ),
    (
        "triaxial",
        "spheres without friction",
        "the published angle is that of large and slow samples without walls: 1000 grains have 7.2 to 8.3 degrees, 4000 have 6.7 to 7.3, and the interval ends outside",
    ),
    (
        "apparent-mass",
        "beads in a shaken box: mass",
        "beads of 100 MPa are soft: sound of 12 m/s makes a bed of 14 mm swing at 220 Hz, which adds 5 % to its mass at 50 Hz",
    ),
    (
        "apparent-mass",
        "beads in a shaken box: loss factor, below",
        "2.5 % is lost in a bed that swings, in an interval from 1.8 to 3.1 about the end of the range; where in it is not known",
    ),
    (
        "apparent-mass",
        "beads in a shaken box: power",
        "powers of -2.4 and -0.79 where -2 and -1 were measured: fifteen draws of so few beads leave intervals about the ends of the ranges; \
         how far the powers hang on the levels and on the lid that is not there is not known",
    ),
    (
        "dam-break-space",
        "dam break in space: power",
        "of five fillings of each height it is 0.7 to 1.6, for the two heights are near each other: the mean is 1.26 and its interval reaches from 0.8 to 1.7",
    ),
    (
        "damper-hexagons",
        "balls of 19 cells",
        "ten such balls fill one row from side to side and bounce each on its own: their curve has a ragged top of 5 to 7 mm from 0.97 to 1.01, lower than a bell would be; fifty damp a fifth more than a lump",
    ),
    (
        "damper-hexagons",
        "shaken box",
        "without friction the bed comes apart more than by DEM: its loose balls are back at the floor after about half of a period, 0.48 with 20 balls and 0.51 with 40, at phases that scatter",
    ),
    (
        "beverloo-3d",
        "",
        "one finding: the law holds with k = 1.74 and C = 0.57, within 3.7 to 4.6 % and not within 3, and not with k = 1.4, which makes the exponent too large and lets C grow \
         with the hole; the law of Mankoc et al. is nearer, within 1.6 to 3.4 %",
    ),
    (
        "janssen",
        "",
        "both are one: a tenth of the friction at the walls is missing, as where grains roll along them, and the exponential knows only the product, which is 1.01",
    ),
    (
        "chute",
        "chute at 22 degrees: mean speed over surface speed",
        "at 22 degrees a layer of 24 is near the height at which it stops, and its profile near the straight one of thin layers: five beds have 0.52 to 0.56",
    ),
    (
        "chute",
        "chute at 22 degrees: inertial number",
        "in a world of 8 by 6 diameters the shear rate of half a layer is known to a tenth from bed to bed: the mean is 1.02, and the interval ends outside",
    ),
    (
        "chute",
        "chute at 25 degrees: inertial number",
        "the upper half has an inertial number a tenth lower, 0.89 to 0.92 in five beds, where the range ends, which is ours; 40 layers in a world of 20 by 10 have 0.98 at 24 degrees and 0.97 at 26, \
         so it is the size of this one",
    ),
    (
        "chute",
        "",
        "a layer of 12 is thin: both exponents are what 3/2 gives if the lowest 2.9 to 3.2 diameters do not take part",
    ),
    (
        "dam-break",
        "",
        "locked grains lie at 44 degrees by any integrator that keeps the energy; by forward differences, which gain it, at 31, 36, 39 and 45 with 14, 15, 16 and 20 steps a contact: the paper's 33 are those of a step that it does not name",
    ),
    (
        "dam-break-rolling",
        "",
        "the contact of hard grains is narrow: a torque of at most f' times its width cannot hold 33 degrees",
    ),
    (
        "avalanche",
        "avalanche, forward-euler, 0.01 s and 0.001 s: turns",
        "paths with short contacts bend 1.3 times as sharply and make nearly twice the detour, but turn up or down less often: the slower flow meets fewer neighbours",
    ),
    (
        "avalanche",
        "avalanche, forward-euler, 0.01 s and 0.001 s: distance",
        "with long contacts grains go 10.4 % farther in the mean of ten draws, in an interval from 9.8 to 10.9, about a bar of 10 % that is ours",
    ),
    (
        "avalanche",
        "avalanche, forward",
        "the longer contact is the faster one as in the paper, but by more than the 1 m/s that it names, 3.6 in ten draws, and 14 % denser; energy gained by forward differences is a part of it",
    ),
    (
        "avalanche",
        "avalanche, velocity-verlet on 50 degrees, 0.01 s and 0.001 s: turns",
        "with short contacts the flow has half the speed and meets fewer neighbours: its paths bend twice as sharply and turn less often",
    ),
    (
        "avalanche",
        "avalanche, velocity-verlet on 50 degrees",
        "the longer contact is the faster one, as in the paper, but by 13 m/s and not by 1, and 14 % denser: its tangential spring is soft, too, and holds grains less",
    ),
    (
        "avalanche",
        "avalanche, velocity",
        "with short contacts the locked layer stands up to 43 degrees: the law gives no flow at 40 to compare with",
    ),
    (
        "avalanche-stiff",
        "avalanche, forward-euler, 0.01 s and 0.0001 s: turns",
        "paths with short contacts bend 1.3 times as sharply and make nearly twice the detour, but turn up or down less often: the slower flow meets fewer neighbours",
    ),
    (
        "avalanche-stiff",
        "avalanche, forward",
        "the longer contact is the faster one as in the paper, but by 4 m/s and not by 1, and 13 % denser: energy gained by forward differences is a part of it",
    ),
    (
        "avalanche-stiff",
        "avalanche, velocity",
        "with short contacts the locked layer stands up to 43 degrees: the law gives no flow at 40 to compare with",
    ),
    (
        "figure-3b",
        "",
        "the response by DEM does not hang on the friction at the walls: 0.6 for 0.5 changes the peaks with 30 and 50 balls by less than 0.2 %, which no figure shows",
    ),
    (
        "figure-11-literal",
        "",
        "in the mean over 20 seeds the peak moves down in seven of twelve steps, and three are not decided; the paper names no amplitude",
    ),
    (
        "bed-at-rest",
        "42 grains, 100 N/cm, forward differences, 14",
        "just above the 13.9 steps a contact at which forward differences gain what the dashpot takes, a bed loses its motion slowly: two of 42 grains still move at 0.125 s, none at 0.5 s",
    ),
    (
        "bed-at-rest",
        "42 grains, 1 N/cm, forward differences, 12",
        "by forward differences the soft bed boils with all of its grains below 13.9 steps a contact, and rests above: that half of them vibrate is found at no number of steps that was tried",
    ),
    (
        "bed-at-rest",
        "42 grains, 100 N/cm, forward differences, 12",
        "at 12 steps a contact two grains of 42 vibrate in two fillings of five, none in the others",
    ),
    (
        "rise",
        "radius 2",
        "a grain of twice the radius of the others comes to the top within 200 cycles in two boxes of six; in the others it has risen by less than half of the bed",
    ),
    (
        "pipe-spectrum",
        "",
        "five pipes have exponents from 1.42 to 1.61, about the upper end of a range that is ours: the paper says 4/3",
    ),
    (
        "figure-12",
        "",
        "without resting impulses 50 balls cost 3.9 times as much as 5 at steps of 20 us, and 2.2 times at 0.1 ms: the bed comes loose in every swing, which takes two to three times as long, \
         and at the shorter step two to three times more because each ball of a collision changes itself alone",
    ),
    (
        "dense-flow",
        "dense flow, coupled",
        "where grains slow the water, concentration falls evenly towards the surface: 0.13 in its upper third, 0.14 with turbulence; either flow is 1.84 cm deep, a quarter more than the flume's",
    ),
    (
        "mobile-bed",
        "mobile bed, rotation locked, 4 degrees",
        "seven fillings of fifteen lie still, and of the others a tenth to a quarter of the grains move: 4 degrees is where locked grains begin",
    ),
    (
        "mobile-bed",
        "mobile bed: difference",
        "locked grains that touch and move differ less in their velocities than free ones, but by a fifth and not by a third: fifteen fillings gave 0.53 to 1.2, and the interval of their mean begins at 0.69",
    ),
    (
        "bedload",
        "",
        "the two formulas lie a factor of two apart: near the begin of motion the rate is half of the one, at a Shields number of 0.5 more than twice the other",
    ),
    (
        "plate-twin",
        "share of grains that carry",
        "by the draw a fifth to all as many grains carry as of discs: fifteen leave an interval from 0.62 to 0.85 about the end of the range",
    ),
    (
        "plate-twin",
        "",
        "pairs of the automaton share one point or two: nothing stands for the few strong chains of discs",
    ),
    (
        "collapse-twin",
        "",
        "CL-CA has no friction to set: beside locked discs of friction 0.5 its slope is nearly the same and its front goes half as far; of friction 0.3 neither is near",
    ),
    (
        "common-hopper",
        "hopper, after-baxter",
        "with two grains a site the bed of Baxter and Behringer is half a gas, whose rate falls with the height",
    ),
    (
        "common-hopper",
        "hopper, litwiniszyn",
        "fifteen draws of voids that walk at random give 0.76 to 0.89, an interval about the end of the range: the rate is even until half is out, then the narrow funnel over the slot is empty and voids find nothing to take",
    ),
    ("common-hopper", "hopper, after-peng", "fifteen draws give 0.84 to 0.92, an interval about the end of the range"),
    (
        "common-hopper",
        "hopper, locked",
        "discs that do not turn jam in the slot in two draws of fifteen, which counts as a rate of zero; in the others the ratio is 1.01",
    ),
    (
        "chute-stopping",
        "a layer of",
        "layers of 4 to 10 rest 0.9 to 1.6 degrees below the published slopes, and within 0.25 degrees of each other on three bases: the slope is lowered after 50 time units, and thin layers stop late",
    ),
    (
        "chute-stopping",
        "chute at 22 degrees: exponent",
        "the law of all flows has an offset, b h / h_stop - c, so that near the height at which a layer stops speed grows faster than with the power 3/2: the exponent falls from \
         1.83 at 22 degrees to 1.57 at 26",
    ),
    (
        "chute-stopping",
        "chute at 22 degrees: inertial",
        "near the height at which a layer stops the shear rate of half a layer is known to a tenth from base to base: the mean is 0.99",
    ),
    (
        "chute-stopping",
        "all flows",
        "by published heights flows of 24 degrees lie above the line and the rise is a sixth too large; by heights found on these bases it is as published",
    ),
    ("common-collapse", "", "CL-CA has no friction to set, and stands for one larger than that of the common test"),
    (
        "common-shapes",
        "rods by CL-CA",
        "rods of CL-CA turn by 60 degrees where they are stuck: eighteen draws leave open whether those go farther, 1.09 times with an interval from 0.80 to 1.38",
    ),
    (
        "common-shapes",
        "rods that turn: alignment",
        "rods of CL-CA turn by 60 degrees, and only where they are stuck and can go on after that: most lie as they fell; by DEM an end that lands first is turned by the weight",
    ),
    (
        "common-shapes",
        "rods that turn: height",
        "rods of CL-CA do not lie down, and lie 9 % higher: eighteen draws leave an interval about the end of the range",
    ),
    (
        "common-shapes",
        "rods that do not turn: height",
        "by DEM rods that do not turn meet at any angle and hold each other up; those of CL-CA have three directions and fit together, 15 % lower",
    ),
    (
        "common-shapes",
        "",
        "CL-CA has no friction to set, and the same outlines do not change that: beside hexagons of DEM that do not turn it stands for a friction between 0.5 and 0.9, not for 0.3",
    ),
    (
        "common-shaken",
        "shaken, cl-ca: deepest",
        "grains of CL-CA stand on points that are 1 mm apart, and the box moves by less: the deepest is 0.94 mm below the floor in thirteen draws \
         of fifteen, 0.44 mm in two",
    ),
    (
        "common-shaken",
        "",
        "fifteen draws of 40 periods: locked discs and CL-CA in a box at rest gain a tenth of the height, by the draw from nothing to 0.18, in intervals that begin at 0.078 and 0.070",
    ),
    (
        "pile-twin",
        "",
        "150 heaps of discs poured from a point make no dip for the arching to explain, and small discs between large ones carry next to nothing, which a lattice of equal grains cannot show",
    ),
    (
        "fhp-viscosity-plain",
        "FHP-III, d = 0.3: viscosity over the formula, 64 columns, without",
        "0.7 % low, for a wave of 64 columns is not endlessly long; its interval ends 0.1 % outside",
    ),
    (
        "fhp-viscosity-plain",
        "",
        "particles that meet have met before: the closed forms leave correlations out, and with slots shuffled between steps the same program gives them",
    ),
    (
        "pipe-smooth",
        "",
        "in our reading of the rule grains that come to rest beside one another take momentum from the gas, so that jams need no rough wall; the paper's own rule was not found",
    ),
    ("hopper-walls", "", "few grains get to the walls, and those were thrown there along the oblique axes"),
    ("silo-layers", "", "grains part along the slope and not in layers; perhaps layers are no demand of that paper"),
];

/// Why a claim of a case does not hold; none where nobody has said so.
pub fn reason(case: &str, claim: &str) -> Option<&'static str> {
    let said = REASONS.iter().filter(|(of, ..)| *of == case).find(|(_, begin, _)| claim.starts_with(begin));
    said.map(|(_, _, reason)| *reason)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CASES, recorded};

    /// A claim that does not hold and of which nothing is said is no finding; a reason for what holds is out of date.
    #[test]
    fn what_does_not_hold_has_a_reason_and_nothing_else_has() {
        for case in CASES {
            for claim in recorded(case.name).iter().filter(|claim| !claim.pass) {
                assert!(reason(case.name, &claim.name).is_some(), "{}: why does `{}` not hold?", case.name, claim.name);
            }
        }
        for (case, begin, _) in REASONS {
            assert!(CASES.iter().any(|known| known.name == *case), "there is no case `{case}`");
            let kept = recorded(case);
            let needed = kept.iter().any(|claim| !claim.pass && claim.name.starts_with(begin));
            assert!(
                needed || kept.is_empty(),
                "{case}: what begins with `{begin}` holds now: take its reason from the list"
            );
        }
    }
}
