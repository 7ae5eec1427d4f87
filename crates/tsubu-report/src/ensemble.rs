//! Ensembles of claims: a strip each, with every member, the mean with its interval, the accepted range, and what the source says.

use crate::plot::{AXIS, FAINT, INK, PALETTE};
use crate::text::{escape, short};
use std::fmt::Write as _;
use tsubu_frame::{Claim, Ensemble};

/// The drawing, from left to right [pixels].
const WIDTH: f64 = 860.0;
const LEFT: f64 = 24.0;
const RIGHT: f64 = 836.0;
/// A strip, from its top [pixels]: its name, the lowest dots, the mean, the axis.
const NAME: f64 = 16.0;
const DOTS: f64 = 58.0;
const MEAN: f64 = 70.0;
const LINE: f64 = 80.0;
const HEIGHT: f64 = 112.0;
/// Radius of a dot, and how many stand upon each other before they come closer [pixels].
const DOT: f64 = 3.2;
const STACK: usize = 6;
/// What the colours of the palette stand for.
const MEMBER: &str = PALETTE[0];
const SOURCE: &str = PALETTE[1];
const ACCEPTED: &str = PALETTE[2];

/// What is to be read under the drawing.
pub(crate) const CAPTION: &str = "Every dot is a run with its own seed; below them the mean with its 95 % interval. Green: accepted. Dashed, where \
     there is one: the number that the source gives.";

/// The strips of the claims that are on ensembles, below one another; none where no claim is.
pub(crate) fn strips(claims: &[&Claim]) -> Option<String> {
    let all: Vec<(&Claim, &Ensemble, [f64; 2])> = claims
        .iter()
        .filter_map(|claim| {
            let ensemble = claim.ensemble.as_ref()?;
            Some((*claim, ensemble, ensemble.interval.as_slice().try_into().ok()?))
        })
        .filter(|(_, ensemble, interval)| ensemble.members.iter().chain(interval).all(|x| x.is_finite()))
        .collect();
    if all.is_empty() {
        return None;
    }
    let height = HEIGHT * all.len() as f64;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" viewBox=\"0 0 {WIDTH} {height}\" \
         font-family=\"system-ui, sans-serif\" font-size=\"12\">"
    );
    for (row, (claim, ensemble, interval)) in all.into_iter().enumerate() {
        let _ = write!(svg, "<g transform=\"translate(0 {})\">", HEIGHT * row as f64);
        strip(&mut svg, claim, ensemble, interval);
        svg += "</g>";
    }
    Some(svg + "</svg>")
}

fn strip(svg: &mut String, claim: &Claim, ensemble: &Ensemble, [from, to]: [f64; 2]) {
    let word = claim.verdict().word();
    let seen =
        ensemble.members.iter().copied().chain([from, to]).chain(claim.beside).chain(claim.low).chain(claim.high);
    let scale = Scale::of(seen.filter(|x| x.is_finite()));
    let name = escape(&claim.name);
    let _ = write!(svg, "<text x=\"{LEFT}\" y=\"{NAME}\" fill=\"{INK}\" font-size=\"13\">{name}: {word}</text>");
    let (low, high) = (claim.low.map_or(LEFT, |x| scale.at(x)), claim.high.map_or(RIGHT, |x| scale.at(x)));
    let (top, tall) = (NAME + 8.0, LINE - NAME - 8.0);
    let wide = (high - low).max(1.0);
    let _ = write!(
        svg,
        "<rect x=\"{low:.1}\" y=\"{top}\" width=\"{wide:.1}\" height=\"{tall}\" fill=\"{ACCEPTED}\" fill-opacity=\"0.16\"/>"
    );
    let _ = write!(svg, "<line x1=\"{LEFT}\" x2=\"{RIGHT}\" y1=\"{LINE}\" y2=\"{LINE}\" stroke=\"{AXIS}\"/>");
    for tick in scale.ticks() {
        let x = scale.at(tick);
        let (end, text) = (LINE + 5.0, LINE + 18.0);
        let _ = write!(
            svg,
            "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{top}\" y2=\"{LINE}\" stroke=\"{FAINT}\"/>\
             <line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{LINE}\" y2=\"{end}\" stroke=\"{AXIS}\"/>\
             <text x=\"{x:.1}\" y=\"{text}\" fill=\"{INK}\" text-anchor=\"middle\">{}</text>",
            short(tick)
        );
    }
    if let Some(said) = claim.beside {
        let x = scale.at(said);
        let _ = write!(
            svg,
            "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{top}\" y2=\"{LINE}\" stroke=\"{SOURCE}\" stroke-width=\"1.6\" stroke-dasharray=\"5 4\"/>"
        );
    }
    for [x, y] in stacked(ensemble.members.iter().map(|member| scale.at(*member)).collect()) {
        let _ =
            write!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{DOT}\" fill=\"{MEMBER}\" fill-opacity=\"0.75\"/>");
    }
    let [mean, left, right] = [claim.value, from, to].map(|x| scale.at(x));
    let (up, down) = (MEAN - 4.0, MEAN + 4.0);
    let _ = write!(
        svg,
        "<line x1=\"{left:.1}\" x2=\"{right:.1}\" y1=\"{MEAN}\" y2=\"{MEAN}\" stroke=\"{INK}\" stroke-width=\"2\"/>\
         <line x1=\"{left:.1}\" x2=\"{left:.1}\" y1=\"{up}\" y2=\"{down}\" stroke=\"{INK}\" stroke-width=\"2\"/>\
         <line x1=\"{right:.1}\" x2=\"{right:.1}\" y1=\"{up}\" y2=\"{down}\" stroke=\"{INK}\" stroke-width=\"2\"/>\
         <circle cx=\"{mean:.1}\" cy=\"{MEAN}\" r=\"4\" fill=\"{INK}\"/>"
    );
}

/// Dots of one value stand upon each other; those of many come closer, so that they stay below the name.
fn stacked(mut places: Vec<f64>) -> Vec<[f64; 2]> {
    places.sort_by(f64::total_cmp);
    let mut piles: Vec<Vec<f64>> = Vec::new();
    for x in places {
        match piles.last_mut() {
            Some(pile) if pile.first().is_some_and(|first| x - first < 1.5 * DOT) => pile.push(x),
            _ => piles.push(vec![x]),
        }
    }
    let highest = piles.iter().map(Vec::len).max().unwrap_or_default();
    let apart = 1.9 * DOT * (STACK as f64 / highest.max(STACK) as f64);
    let dots = piles.iter().flat_map(|pile| pile.iter().enumerate().map(|(up, x)| [*x, DOTS - apart * up as f64]));
    dots.collect()
}

/// From values to pixels.
struct Scale {
    low: f64,
    high: f64,
}

impl Scale {
    /// All that is to be seen, with room at both sides.
    fn of(seen: impl Iterator<Item = f64>) -> Self {
        let (low, high) = seen.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let room = if high > low { 0.06 * (high - low) } else { 0.1 * high.abs().max(1e-300) };
        Self { low: low - room, high: high + room }
    }

    fn at(&self, x: f64) -> f64 {
        LEFT + (RIGHT - LEFT) * (x - self.low) / (self.high - self.low)
    }

    /// Three to eight round numbers.
    fn ticks(&self) -> Vec<f64> {
        let rough = (self.high - self.low) / 6.0;
        let power = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|k| k * power).into_iter().find(|step| *step >= rough).unwrap_or(rough);
        let (first, last) = ((self.low / step).ceil() as i64, (self.high / step).floor() as i64);
        // So that none is called 0.30000000000000004.
        (first..=last).map(|k| k as f64 * step).map(|x| format!("{x:.12e}").parse().unwrap_or(x)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tsubu_frame::{Origin, Source};

    fn claim(members: Vec<f64>, interval: [f64; 2], low: Option<f64>, high: Option<f64>) -> Claim {
        let seeds = (1..=members.len() as u64).collect();
        let ensemble = Ensemble { seeds, members, interval: interval.to_vec() };
        Claim::judge_ensemble("height & width", ensemble, low, high, Source::new(Origin::Own, "a test"))
    }

    #[test]
    fn every_member_is_drawn_and_nothing_leaves_the_strip() {
        let of = claim(vec![0.2; 20], [0.19, 0.21], Some(0.1), None).beside(0.3);
        let svg = strips(&[&of]).expect("a drawing");
        assert_eq!(svg.matches("<circle").count(), 21);
        assert!(svg.contains("height &amp; width: pass") && svg.contains("stroke-dasharray"), "{svg}");
        let number = |text: &str| text.split('"').next().and_then(|n| n.parse::<f64>().ok()).expect("a number");
        let heights: Vec<f64> = svg.split("cy=\"").skip(1).map(number).collect();
        assert!(heights.iter().all(|y| *y > NAME && *y < LINE), "{heights:?}");
        let across = svg.split("cx=\"").skip(1).map(number);
        assert!(across.into_iter().all(|x| (LEFT..=RIGHT).contains(&x)));
    }

    #[test]
    fn ticks_are_round_and_inside() {
        for (low, high) in [(0.0, 1.0), (-0.2, -0.15), (1e-7, 3e-7), (90.0, 1.1e4)] {
            let scale = Scale { low, high };
            let ticks = scale.ticks();
            assert!((3..=8).contains(&ticks.len()), "{ticks:?}");
            assert!(ticks.iter().all(|x| (low..=high).contains(x) && x.to_string().len() < 14), "{ticks:?}");
        }
    }

    #[test]
    fn claims_on_single_runs_have_no_strip() {
        let single = Claim::judge("x", 1.0, None, None, Source::new(Origin::Own, "a test"));
        let broken = claim(vec![f64::NAN, 1.0], [f64::NAN, f64::NAN], None, None);
        assert_eq!(strips(&[&single, &broken]), None);
    }
}
