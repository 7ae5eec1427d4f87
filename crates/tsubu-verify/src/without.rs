//! Claims that no wrong model is known to be refused by, and why: a list that may only become shorter.

/// Other gates of the case have controls.
const FEW: &str = "the wrong models that were run are refused by other gates of the case; one that this gate alone refuses is to be run";

/// They roll without a loss.
const ROLLS: &str = "it rolls without a loss: gravity and motion are all that its books hold, and no mutation touches one without the other";

/// A factor of two is wide.
const HEIGHT: &str = "a stream of three times the shear velocity is refused by length and speed of the hops, not by a factor of 2 in their height";

/// Case, how the names of its claims begin (all of the case: nothing), and why.
pub(crate) const CONTROL: &[(&str, &str, &str)] = &[
    ("incline", "slope of 35.0 degrees, sphere rolls: energy residual", ROLLS),
    ("incline", "slope of 31.0 degrees, disc rolls: energy residual", ROLLS),
    ("starts-to-roll", "start of rolling: energy residual", ROLLS),
    ("saltation-space", "leaping grains in space, Shields number 0.3: mean hop height", HEIGHT),
    ("saltation", "leaping grain, Shields number 0.3: mean hop height", HEIGHT),
    (
        "collapse-twin",
        "slope in degrees, CL-CA against DEM without rotation, friction 0.5",
        "discs that roll freely are held against the twin without friction alone",
    ),
    (
        "collapse-twin",
        "slope in degrees, discs with resistance",
        "the discs that do not turn for free ones are refused by other gates; none that is wrong in slope alone is known",
    ),
    ("collapse-twin", "time of DEM over that of CL-CA", "a cost: a wrong law takes as long"),
    ("litwiniszyn", "Litwiniszyn: B of the lattice", "it compares two constants; nothing is run"),
    (
        "plate-twin",
        "DEM: ",
        "what forces in any pressed bed look like; a bed in which they do not is still to be found",
    ),
    ("rheology", "discs at", "a flow that is not steady is to be run"),
    ("rheology", "discs: ", "the line through flows of other grains is to be run"),
    ("brazil-nut", "shaken bed, seed", "where the grain is put at the start: the scene says it"),
    ("beverloo", "", FEW),
    ("beverloo-3d", "", FEW),
    ("janssen", "Janssen: largest standard error", "how sure the stresses are, not what they are"),
    ("chute", "", FEW),
    ("dense-flow", "dense flow: speed", FEW),
    ("figure-3a", "", FEW),
    ("figure-3b", "", FEW),
    ("figure-3-extended", "", FEW),
    ("figure-12", "cost: DEM", "a cost: a wrong law takes as long"),
    ("avalanche", "avalanche, ", "a difference that is large: a wrong model that has none is to be run"),
    ("avalanche-stiff", "avalanche, ", "a difference that is large: a wrong model that has none is to be run"),
];
