//! Claims that no wrong model is known to be refused by, and why: a list that may only become shorter.

/// A factor of two is wide.
const HEIGHT: &str = "a stream of three times the shear velocity is refused by length and speed of the hops, not by a factor of 2 in their height";

/// Case, how the names of its claims begin (all of the case: nothing), and why.
pub(crate) const CONTROL: &[(&str, &str, &str)] = &[
    ("saltation-space", "leaping grains in space, Shields number 0.3: mean hop height", HEIGHT),
    ("saltation", "leaping grain, Shields number 0.3: mean hop height", HEIGHT),
    ("litwiniszyn", "Litwiniszyn: B of the lattice", "it compares two constants; nothing is run"),
    ("figure-12", "cost: DEM", "a cost: a wrong law takes as long"),
];
