//! Claims that no wrong model is known to be refused by, and why: a list that may only become shorter.

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
    ("janssen", "Janssen: largest standard error", "how sure the stresses are, not what they are"),
    ("figure-12", "cost: DEM", "a cost: a wrong law takes as long"),
];
