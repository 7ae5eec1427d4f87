//! From a number to a colour.

use std::fmt::Write as _;

/// Viridis at equal distances: it grows evenly to the eye, in print and for colour-blind readers.
const VIRIDIS: [[u8; 3]; 11] = [
    [68, 1, 84],
    [72, 36, 117],
    [65, 68, 135],
    [53, 95, 141],
    [42, 120, 142],
    [33, 145, 140],
    [34, 168, 132],
    [68, 191, 112],
    [122, 209, 81],
    [189, 223, 38],
    [253, 231, 37],
];

/// The colour at `t` in 0..1; outside values take the nearer end, not-a-number is grey.
pub fn at(t: f64) -> [u8; 3] {
    if t.is_nan() {
        return [150, 150, 150];
    }
    let place = t.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let low = (place as usize).min(VIRIDIS.len() - 2);
    let part = place - low as f64;
    let (a, b) = (VIRIDIS[low], VIRIDIS[low + 1]);
    std::array::from_fn(|k| (f64::from(a[k]) + part * (f64::from(b[k]) - f64::from(a[k]))).round() as u8)
}

/// The same as SVG text, `#rrggbb`.
pub fn hex(t: f64) -> String {
    let [r, g, b] = at(t);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The stops of an SVG gradient over the whole map.
pub fn stops() -> String {
    (0..=10).fold(String::new(), |mut out, i| {
        let colour = hex(f64::from(i) / 10.0);
        let _ = write!(out, "<stop offset=\"{}%\" stop-color=\"{colour}\"/>", i * 10);
        out
    })
}
