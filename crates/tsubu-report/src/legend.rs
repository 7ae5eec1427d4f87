//! What a particle picture says beside the grains: its time, and the scale of its colours.

use std::fmt::Write as _;

use crate::colour;
use crate::quantity::prefix;
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

/// Room of a name beside its letters [pixels], and of a letter.
const SWATCH: f64 = 34.0;
const LETTER: f64 = 7.5;
/// Height of a row of names [pixels].
const ROW: f64 = 20.0;

/// The legend of values that are numbers of something: the colour of each beside its name.
pub(crate) struct Names {
    /// Colours and names.
    all: Vec<(String, String)>,
    /// Columns, and how wide each is [pixels].
    columns: usize,
    wide: f64,
}

impl Names {
    /// Of those within the range of the colours, for a picture of that width [pixels]; nothing where values measure.
    pub fn of(names: &[String], (low, high): (f64, f64), width: f64) -> Option<Self> {
        let shade = |value: f64| if high > low { (value - low) / (high - low) } else { 0.35 };
        let numbered = names.iter().enumerate().map(|(number, name)| (number as f64, name));
        let seen = numbered.filter(|(value, _)| (low..=high).contains(value));
        let all: Vec<_> = seen.map(|(value, name)| (colour::hex(shade(value)), name.clone())).collect();
        let longest = all.iter().map(|(_, name)| name.chars().count()).max()?;
        let wide = SWATCH + LETTER * longest as f64;
        Some(Self { all, columns: ((width - 10.0) / wide).floor().max(1.0) as usize, wide })
    }

    /// [pixels]
    pub fn height(&self) -> f64 {
        ROW * self.all.len().div_ceil(self.columns) as f64
    }

    /// Draws it from a height downwards.
    pub fn draw(&self, out: &mut String, top: f64) {
        for (k, (colour, name)) in self.all.iter().enumerate() {
            let (x, y) = (10.0 + self.wide * (k % self.columns) as f64, top + ROW * (k / self.columns) as f64);
            let _ = write!(
                out,
                "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"12\" height=\"12\" rx=\"2\" fill=\"{colour}\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"12\">{}</text>",
                x + 18.0,
                y + 10.5,
                escape(name)
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Groups had a colour bar from 0 to 1 and no names.
    #[test]
    fn groups_have_their_names_beside_their_colours() {
        let groups = ["peas", "rice <long>", "sand"].map(str::to_owned);
        let legend = Names::of(&groups, (0.0, 2.0), 600.0).expect("a legend");
        let mut svg = String::new();
        legend.draw(&mut svg, 0.0);
        for (k, name) in ["peas", "rice &lt;long&gt;", "sand"].into_iter().enumerate() {
            assert!(svg.contains(name) && svg.contains(&colour::hex(0.5 * k as f64)), "{svg}");
        }
        assert!((legend.height() - ROW).abs() < 1e-9);
        // A narrow picture has them one below the other; a group of which nothing is left is not named; what measures has a scale.
        assert!((Names::of(&groups, (0.0, 2.0), 150.0).expect("a legend").height() - 3.0 * ROW).abs() < 1e-9);
        assert_eq!(Names::of(&groups, (0.0, 1.0), 600.0).expect("a legend").all.len(), 2);
        assert!(Names::of(&[], (0.0, 2.0), 600.0).is_none());
    }
}
