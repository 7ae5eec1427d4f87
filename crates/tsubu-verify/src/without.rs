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
    ("litwiniszyn", "Litwiniszyn: B of the lattice", "it compares two constants; nothing is run"),
    ("beverloo", "", FEW),
    ("beverloo-3d", "", FEW),
    ("janssen", "Janssen: largest standard error", "how sure the stresses are, not what they are"),
    ("chute", "", FEW),
    ("figure-3b", "", FEW),
    ("figure-3-extended", "", FEW),
    ("figure-12", "cost: DEM", "a cost: a wrong law takes as long"),
    ("avalanche-stiff", "avalanche, ", "a difference that is large: a wrong model that has none is to be run"),
];
