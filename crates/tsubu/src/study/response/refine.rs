//! Which frequencies are measured next: where the curve bends, and beside its top.

/// A bend that is told from a straight line: this share of the highest point.
const BEND: f64 = 0.03;

/// Neighbours of the highest point that are lower than this share of it leave room for a higher one between.
const SHOULDER: f64 = 0.9;

/// How much nearer than asked for they may come then.
const NEARER: f64 = 1.0 / 64.0;

/// Places to be measured next between those of a curve of (place, height), ascending: beside the highest until its neighbours are
/// as near as `within` and nearly as high, and where a point lies off the line between its neighbours. None are needed when it is empty.
pub(in crate::study) fn next(curve: &[(f64, f64)], within: f64) -> Vec<f64> {
    let Some((top, &(_, height))) = curve.iter().enumerate().max_by(|a, b| a.1.1.total_cmp(&b.1.1)) else {
        return Vec::new();
    };
    let mut wanted = vec![false; curve.len().saturating_sub(1)];
    let mut halve = |interval: usize, until: f64| {
        if let Some(wanted) = wanted.get_mut(interval) {
            *wanted |= curve[interval + 1].0 - curve[interval].0 > until * (1.0 + 1e-9);
        }
    };
    for (i, three) in curve.windows(3).enumerate() {
        let [(x0, y0), (x, y), (x2, y2)] = [three[0], three[1], three[2]];
        let off = y - (y0 + (y2 - y0) * (x - x0) / (x2 - x0));
        if off.abs() > BEND * height {
            halve(i, 2.0 * within);
            halve(i + 1, 2.0 * within);
        }
    }
    let near = |neighbour: usize| {
        let steep = curve.get(neighbour).is_some_and(|(_, beside)| *beside < SHOULDER * height);
        if steep { within * NEARER } else { within }
    };
    halve(top, near(top + 1));
    if top > 0 {
        halve(top - 1, near(top - 1));
    }
    let halves = curve.windows(2).map(|ends| tidy(0.5 * (ends[0].0 + ends[1].0)));
    halves.zip(wanted).filter_map(|(half, wanted)| wanted.then_some(half)).collect()
}

/// Half of 0.85 and 0.8875 has more digits than anybody wants to read.
fn tidy(x: f64) -> f64 {
    format!("{x:.6}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::next;
    use crate::study::response::peak;

    fn refined(height: impl Fn(f64) -> f64, within: f64) -> Vec<(f64, f64)> {
        let mut curve: Vec<(f64, f64)> =
            (0..=8).map(|i| 0.85 + 0.0375 * f64::from(i)).map(|x| (x, height(x))).collect();
        for _ in 0..20 {
            curve.extend(next(&curve, within).into_iter().map(|x| (x, height(x))));
            curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        curve
    }

    /// The curve of an oscillator: the top is found within what was asked for with half the points of an even grid that finds it
    /// as well, and where nothing happens none are added.
    #[test]
    fn points_go_where_the_curve_bends() {
        let height = |r: f64| 1.0 / ((1.0 - r * r).powi(2) + (0.06 * r).powi(2)).sqrt();
        let curve = refined(height, 0.005);
        let top = curve.iter().max_by(|a, b| a.1.total_cmp(&b.1)).expect("a curve has a top");
        assert!((top.0 - 1.0).abs() <= 0.005, "{}", top.0);
        assert!(curve.len() < 30, "{}", curve.len());
        assert!(curve[1].0 - curve[0].0 > 0.03);
        assert_eq!(next(&curve, 0.005), Vec::<f64>::new());
    }

    /// The curve of an oscillator with a hundredth of the damping, whose top is a thirtieth as wide as what was asked for: it is found all
    /// the same, within 3 % of its height; to halve until points are as near as that finds half of it.
    #[test]
    fn a_narrow_top_is_found() {
        let height = |r: f64| 1.0 / ((1.0 - r * r).powi(2) + (0.0012 * r).powi(2)).sqrt();
        let place = |r: f64| height(r - 0.0021);
        let top = |curve: &[(f64, f64)]| peak(curve).map_or(f64::NAN, |top| top.rms);
        let found = top(&refined(place, 0.01));
        assert!((found * 0.0012 - 1.0).abs() < 0.03, "{found}");
        let wide: Vec<(f64, f64)> = (0..=40).map(|i| 0.85 + 0.0075 * f64::from(i)).map(|x| (x, place(x))).collect();
        assert!(top(&wide) * 0.0012 < 0.5);
    }

    #[test]
    fn ends_and_single_points_are_no_trouble() {
        assert_eq!(next(&[], 0.01), Vec::<f64>::new());
        assert_eq!(next(&[(1.0, 2.0)], 0.01), Vec::<f64>::new());
        assert_eq!(next(&[(0.9, 2.0), (1.0, 1.0)], 0.01), [0.95]);
        // A curve that falls all the way: its top is the first point.
        let falling = refined(|r| 2.0 - r, 0.01);
        assert!((falling[1].0 - falling[0].0 - 0.009_375).abs() < 1e-6);
        assert_eq!(falling.len(), 11);
    }
}
