//! Superellipsoids in pictures: where a line of sight meets one.

use tsubu_frame::{Frame, Kind, Values};

/// Steps of Newton's method along a line of sight; to a pixel two or three are enough, at the edge of a box more.
const STEPS: usize = 40;

/// A superellipsoid, turned to the viewer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// Directions of its axes: to the right, up, towards the viewer.
    axes: [[f64; 3]; 3],
    /// Semi-axes [m].
    semi_axes: [f64; 3],
    /// Exponents of profile and equator [-].
    exponents: [f64; 2],
}

impl Solid {
    /// Those of a frame, one for each grain, `None` for a sphere; empty where all are.
    pub fn all(frame: &Frame, turn: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<Option<Self>> {
        let semi_axes = frame.vectors(Kind::Grain, "semi-axes");
        let turned = match frame.column(Kind::Grain, "orientation").map(|column| &column.values) {
            Some(Values::Quaternion(turned)) if turned.len() == semi_axes.len() => turned,
            _ => return Vec::new(),
        };
        let [profile, equator] = ["profile exponent", "equator exponent"].map(|name| frame.scalars(Kind::Grain, name));
        let solid = |(i, (semi_axes, turned)): (usize, (&[f64; 3], &[f64; 4]))| {
            let exponents = [profile, equator].map(|column| column.get(i).copied().unwrap_or(2.0));
            let round = semi_axes.iter().all(|axis| *axis == semi_axes[0]) && exponents == [2.0; 2];
            let axes = [0, 1, 2].map(|k| turn(axis(*turned, k)));
            (!round).then_some(Self { axes, semi_axes: *semi_axes, exponents })
        };
        semi_axes.iter().zip(turned).enumerate().map(solid).collect()
    }

    /// Where the line of sight through (x, y) from the centre [m] meets it first: how near to the viewer [m], and the unit normal there.
    pub fn seen(&self, x: f64, y: f64, radius: f64) -> Option<(f64, [f64; 3])> {
        let mut z = radius;
        for _ in 0..STEPS {
            let (level, slope) = self.level([x, y, z]);
            // The level is convex along the line: from outside Newton's steps never go too far.
            if level <= 1.0 + 1e-4 {
                let length = slope.iter().map(|s| s * s).sum::<f64>().sqrt();
                return Some((z, slope.map(|s| s / length)));
            }
            if slope[2] <= 0.0 || z < -radius {
                return None;
            }
            z -= (level - 1.0) / slope[2];
        }
        None
    }

    /// ((|x/a|^r + |y/b|^r)^(p/r) + |z/c|^p)^(1/p) at a point from the centre, 1 on the surface, and its slope.
    fn level(&self, at: [f64; 3]) -> (f64, [f64; 3]) {
        let [p, r] = self.exponents;
        let own: [f64; 3] =
            std::array::from_fn(|k| (0..3).map(|i| self.axes[k][i] * at[i]).sum::<f64>() / self.semi_axes[k]);
        let [x, y, z] = own.map(|part| part.abs().max(1e-12));
        let equator = (x.powf(r) + y.powf(r)).powf(1.0 / r);
        let level = (equator.powf(p) + z.powf(p)).powf(1.0 / p);
        let round = (equator / level).powf(p - 1.0);
        let by = [round * (x / equator).powf(r - 1.0), round * (y / equator).powf(r - 1.0), (z / level).powf(p - 1.0)];
        let by: [f64; 3] = std::array::from_fn(|k| by[k].copysign(own[k]) / self.semi_axes[k]);
        (level, std::array::from_fn(|i| (0..3).map(|k| by[k] * self.axes[k][i]).sum()))
    }
}

/// Where an orientation (real part first) brings axis k.
fn axis([w, x, y, z]: [f64; 4], k: usize) -> [f64; 3] {
    match k {
        0 => [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        1 => [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
        _ => [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
    }
}

#[cfg(test)]
mod tests {
    use super::Solid;

    const ALONG: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    /// Nearly a box is seen in front at its face and past its edge not at all; an ellipsoid of the same size ends before the corner.
    #[test]
    fn a_line_of_sight_meets_what_is_there() {
        let body = |exponents| Solid { axes: ALONG, semi_axes: [2.0, 1.0, 0.5], exponents };
        let (z, normal) = body([8.0; 2]).seen(1.0, 0.5, 3.0).expect("the face");
        assert!((z - 0.5).abs() < 0.01 && normal[2] > 0.99, "{z} {normal:?}");
        assert!(body([8.0; 2]).seen(1.6, 0.8, 3.0).is_some() && body([2.0; 2]).seen(1.6, 0.8, 3.0).is_none());
        assert!(body([8.0; 2]).seen(2.1, 0.0, 3.0).is_none());
        let (z, _) = body([2.0; 2]).seen(1.0, 0.5, 3.0).expect("the ellipsoid");
        assert!((z - 0.5 * 0.5_f64.sqrt()).abs() < 1e-3, "{z}");
    }
}
