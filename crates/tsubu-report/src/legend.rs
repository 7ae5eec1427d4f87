//! What a particle picture says beside the grains: its time, and the scale of its colours.

use std::fmt::Write as _;

use crate::colour;
use crate::figure::prefix;
use crate::text::{escape, short};

/// Time as a reader writes it: all times of a series, up to `last` [s], in one unit with as many digits.
pub fn time_label(time: f64, last: f64) -> String {
    match last.abs() {
        100.0.. => format!("t = {time:.1} s"),
        0.1.. => format!("t = {time:.3} s"),
        _ => format!("t = {:.2} ms", time * 1e3),
    }
}

/// The colour scale with its ends, about a middle; `above`: there are values beyond its upper end.
pub(crate) fn colour_bar(
    out: &mut String,
    (name, unit): &(String, String),
    (low, high): (f64, f64),
    above: bool,
    [middle, top]: [f64; 2],
    id: &str,
) {
    let (factor, unit) = prefix(unit, low.abs().max(high.abs()));
    let title = if unit == "-" { name.clone() } else { format!("{name} [{unit}]") };
    let half = 90.0;
    let _ = write!(
        out,
        "<defs><linearGradient id=\"{id}\">{}</linearGradient></defs>\
         <rect x=\"{:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"9\" rx=\"2\" fill=\"url(#{id})\"/>\
         <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"12\" text-anchor=\"end\">{}</text>\
         <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"12\">{}{}</text>\
         <text x=\"{middle:.1}\" y=\"{:.1}\" font-size=\"12\" text-anchor=\"middle\">{}</text>",
        colour::stops(),
        middle - half,
        2.0 * half,
        middle - half - 7.0,
        top + 9.0,
        short(low * factor),
        middle + half + 7.0,
        top + 9.0,
        if above { "≥ " } else { "" },
        short(high * factor),
        top + 25.0,
        escape(&title),
    );
}
