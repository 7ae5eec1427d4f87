//! Watches: when they look. What they look at stands in the plan, a row a kind.

use super::{Key, Kind};
use crate::plan::Measure;
use crate::units::TIME;

const TIMES: [Key; 3] = [
    Key::new("from", Kind::Quantity(&TIME), "When the first look is taken").default("0").at_least(0.0),
    Key::new("until", Kind::Quantity(&TIME), "After this no look is taken").above(0.0).word("end"),
    Key::new("every", Kind::Quantity(&TIME), "Simulated time between looks, or \"step\": at every step")
        .above(0.0)
        .derived_or_word("`output.history-interval`; of `hops` and `spectrum` every step", "step"),
];

pub(super) static WATCH: &[Key] = &times_and_kinds();

const fn times_and_kinds() -> [Key; TIMES.len() + Measure::KEYS.len()] {
    let mut keys = [TIMES[0]; TIMES.len() + Measure::KEYS.len()];
    let mut k = 1;
    while k < keys.len() {
        keys[k] = if k < TIMES.len() { TIMES[k] } else { Measure::KEYS[k - TIMES.len()] };
        k += 1;
    }
    keys
}
