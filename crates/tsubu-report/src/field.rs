//! A field on a grid of points as a map.

use std::fmt::Write as _;

use crate::colour;
use crate::figure::Axis;
use crate::legend::colour_bar;
use crate::plot::{AXIS, INK};
use crate::quantity::prefix;
use crate::text::short;

/// More points than this make a file that is too heavy to open.
const MOST: usize = 10_000;
const WIDTH: f64 = 860.0;
const HIGHEST: f64 = 420.0;
const MARGIN: f64 = 64.0;

/// Values at points (the first axis to the right, the second up) as coloured cells with a colour bar; what is not a number
/// is left blank. `None` if there is nothing to draw.
pub(crate) fn map(places: &[[f64; 2]], values: &[f64], axes: &[Axis; 2], value: &Axis) -> Option<String> {
    let columns: [Vec<f64>; 2] = [0, 1].map(|a| {
        let mut column: Vec<f64> = places.iter().map(|p| p[a]).collect();
        column.sort_by(f64::total_cmp);
        column.dedup();
        column
    });
    let finite = || values.iter().copied().filter(|v| v.is_finite());
    let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    if places.is_empty() || places.len() > MOST || low > high {
        return None;
    }
    // Half a cell beyond the outermost points; a single point has no cell of its own.
    let step = [0, 1].map(|a| {
        let c = &columns[a];
        if c.len() > 1 { (c[c.len() - 1] - c[0]) / (c.len() - 1) as f64 } else { 0.0 }
    });
    let step = [
        if step[0] > 0.0 { step[0] } else { step[1].max(1.0) },
        if step[1] > 0.0 { step[1] } else { step[0].max(1.0) },
    ];
    let size = [0, 1].map(|a| step[a] * columns[a].len() as f64);
    let scale = ((WIDTH - 2.0 * MARGIN) / size[0]).min(HIGHEST / size[1]);
    let [w, h] = size.map(|s| s * scale);
    let (left, top) = (0.5 * (WIDTH - w), 8.0);
    let height = top + h + 86.0;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height:.0}\" viewBox=\"0 0 {WIDTH} \
         {height:.1}\" font-family=\"system-ui, -apple-system, Segoe UI, Roboto, Helvetica, Arial, sans-serif\" \
         fill=\"{INK}\">"
    );
    let [cell_w, cell_h] = step.map(|s| s * scale);
    for (place, v) in places.iter().zip(values).filter(|(_, v)| v.is_finite()) {
        let x = left + (place[0] - columns[0][0]) * scale;
        let y = top + h - cell_h - (place[1] - columns[1][0]) * scale;
        let shade = if high > low { (v - low) / (high - low) } else { 0.35 };
        // A little overlap closes the seams between cells.
        let _ = write!(
            out,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{}\"/>",
            cell_w + 0.6,
            cell_h + 0.6,
            colour::hex(shade)
        );
    }
    let _ = write!(
        out,
        "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"none\" stroke=\"{AXIS}\"/>"
    );
    for (a, axis) in axes.iter().enumerate() {
        let ends = [columns[a][0] - 0.5 * step[a], columns[a][columns[a].len() - 1] + 0.5 * step[a]];
        let (factor, unit) = prefix(&axis.unit, ends[0].abs().max(ends[1].abs()));
        let label = format!("{} [{unit}]", axis.label);
        let ends = ends.map(|x| short(x * factor));
        let mut text = |x: f64, y: f64, anchor: &str, what: &str| {
            let _ = write!(
                out,
                "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"12\" text-anchor=\"{anchor}\">{}</text>",
                crate::text::escape(what)
            );
        };
        if a == 0 {
            text(left, top + h + 16.0, "middle", &ends[0]);
            text(left + w, top + h + 16.0, "middle", &ends[1]);
            text(left + 0.5 * w, top + h + 16.0, "middle", &label);
        } else {
            text(left - 6.0, top + h, "end", &ends[0]);
            text(left - 6.0, top + 10.0, "end", &ends[1]);
            text(left - 6.0, top + 0.5 * h, "end", &label);
        }
    }
    let id = format!("field-{}", (high.to_bits() ^ low.to_bits().rotate_left(7) ^ values.len() as u64) % 1_000_003);
    colour_bar(
        &mut out,
        &(value.label.clone(), value.unit.clone()),
        (low, high),
        false,
        [0.5 * WIDTH, top + h + 40.0],
        &id,
    );
    out.push_str("</svg>");
    Some(out)
}
