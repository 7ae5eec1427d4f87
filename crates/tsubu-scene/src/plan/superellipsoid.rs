//! Superellipsoids: ellipsoids, and bodies between them and boxes or cylinders.

use super::{Clump, ClumpOrientation, Vector};
use libm::tgamma;

/// Directions over a quarter of a turn that [`Superellipsoid::lightness`] looks along.
const DIRECTIONS: u32 = 48;

/// A superellipsoid of diameter 1: (|x/a|^r + |y/b|^r)^(p/r) + |z/c|^p = 1 (Barr 1981).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Superellipsoid {
    /// Semi-axes a, b and c.
    pub semi_axes: Vector,
    /// Exponents of the profile and of the equator, p and r.
    pub exponents: [f64; 2],
}

/// The longest vector from the middle of |x/a|^p + |y/b|^p = 1, p at least 2.
fn longest(a: f64, b: f64, p: f64) -> f64 {
    // (a^2k + b^2k)^(1/2k), k = p / (p - 2) (Hoelder), of the longer one, so that no power is out of range.
    let (long, short) = if a > b { (a, b) } else { (b, a) };
    if p <= 2.0 {
        return long;
    }
    let twice = 2.0 * p / (p - 2.0);
    long * (1.0 + (short / long).powf(twice)).powf(1.0 / twice)
}

/// Semi-axes with a depth: in the plane, where two are given and the one between them is 0, it is the shorter of both.
pub(crate) fn deep([a, b, c]: Vector) -> Vector {
    [a, if b == 0.0 { a.min(c) } else { b }, c]
}

/// Euler's beta function.
fn beta(x: f64, y: f64) -> f64 {
    tgamma(x) * tgamma(y) / tgamma(x + y)
}

impl Superellipsoid {
    /// Scaled so that a sphere of diameter 1 just holds it; of two semi-axes as deep as the shorter one.
    pub fn new(semi_axes: Vector, exponents: [f64; 2]) -> Self {
        let semi_axes = deep(semi_axes);
        let [a, b, c] = semi_axes;
        let [profile, equator] = exponents;
        let reach = longest(longest(a, b, equator), c, profile);
        Self { semi_axes: semi_axes.map(|axis| 0.5 * axis / reach), exponents }
    }

    /// Volume, and principal moments of inertia over the mass about x, y and z (Jaklic, Leonardis and Solina 2000).
    fn solid(&self) -> (f64, Vector) {
        let [a, b, c] = self.semi_axes;
        let [e, f] = self.exponents.map(|exponent| 2.0 / exponent);
        let size = 0.5 * a * b * c * e * f;
        let volume = 4.0 * size * beta(0.5 * e + 1.0, e) * beta(0.5 * f, 0.5 * f);
        let across = size * beta(1.5 * f, 0.5 * f) * beta(0.5 * e, 2.0 * e + 1.0);
        let along = 4.0 * size * beta(0.5 * f, 0.5 * f + 1.0) * beta(1.5 * e, e + 1.0);
        let moments = [b * b * across + c * c * along, a * a * across + c * c * along, (a * a + b * b) * across];
        (volume, moments.map(|moment| moment / volume))
    }

    /// Area of its cut with the plane of a and c, 4 a c Gamma(1 + 1/p)^2 / Gamma(1 + 2/p).
    pub(super) fn area(&self) -> f64 {
        let ([a, _, c], p) = (self.semi_axes, self.exponents[0]);
        4.0 * a * c * tgamma(1.0 + 1.0 / p).powi(2) / tgamma(1.0 + 2.0 / p)
    }

    /// Its surface, to about 1e-4: of a direction u of the solid angle dw it is |grad F| / F^3 dw, F(u) = 1 on the surface.
    pub(super) fn surface(&self) -> f64 {
        const ROWS: u32 = 400;
        let [a, b, c] = self.semi_axes;
        let [p, r] = self.exponents;
        let middle = |k: u32| (f64::from(k) + 0.5) / f64::from(ROWS);
        // Of one octant, with rows of equal solid angle.
        let element = |(i, k): (u32, u32)| {
            let z = middle(i);
            let (sin, cos) = (middle(k) * std::f64::consts::FRAC_PI_2).sin_cos();
            let across = (1.0 - z * z).sqrt();
            let [x, y, z] = [across * cos / a, across * sin / b, z / c];
            let equator = x.powf(r) + y.powf(r);
            let sum = equator.powf(p / r) + z.powf(p);
            let (f, outer) = (sum.powf(1.0 / p), sum.powf(1.0 / p - 1.0));
            let inner = outer * equator.powf(p / r - 1.0);
            let slope = [inner * x.powf(r - 1.0) / a, inner * y.powf(r - 1.0) / b, outer * z.powf(p - 1.0) / c];
            slope.iter().map(|s| s * s).sum::<f64>().sqrt() / f.powi(3)
        };
        let all = (0..ROWS).flat_map(|i| (0..ROWS).map(move |k| (i, k)));
        4.0 * std::f64::consts::PI / f64::from(ROWS * ROWS) * all.map(element).sum::<f64>()
    }

    /// As a body: in the place of the one sphere that holds it.
    pub(super) fn body(self, orientation: ClumpOrientation) -> Clump {
        let (volume, moments) = self.solid();
        Clump {
            pieces: vec![([0.0; 3], 0.5)],
            volume,
            moments,
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            orientation,
            superellipsoid: Some(self),
            polyhedron: None,
        }
    }

    /// The point that reaches farthest along a direction with no part below 0: the slope of ((|a ux|^s + |b uy|^s)^(q/s) + |c uz|^q)^(1/q), with
    /// 1/p + 1/q = 1 and 1/r + 1/s = 1.
    fn farthest(&self, u: Vector) -> Vector {
        let [q, s] = self.exponents.map(|p| p / (p - 1.0));
        let [x, y, z] = [0, 1, 2].map(|k| self.semi_axes[k] * u[k]);
        let equator = (x.powf(s) + y.powf(s)).powf(1.0 / s);
        let whole = (equator.powf(q) + z.powf(q)).powf(1.0 / q);
        // Nothing over nothing: straight up.
        let share = |part: f64, of: f64, q: f64| if part > 0.0 { (part / of).powf(q - 1.0) } else { 0.0 };
        let round = share(equator, whole, q);
        let parts = [round * share(x, equator, s), round * share(y, equator, s), share(z, whole, q)];
        [0, 1, 2].map(|k| self.semi_axes[k] * parts[k])
    }

    /// The greatest radius of curvature that contacts are given: of an ellipsoid a b c over the square of the shortest, at most ten times the radius of
    /// the sphere that holds it, which every flat place has.
    pub(super) fn flattest(&self) -> f64 {
        let shortest = self.semi_axes.iter().copied().fold(f64::INFINITY, f64::min);
        let round = self.semi_axes.iter().product::<f64>() / (shortest * shortest);
        if self.exponents == [2.0; 2] { round.min(5.0) } else { 5.0 }
    }

    /// The mass over the smallest that it shows to an impact anywhere: 1 + (r x n) . I^-1 (r x n) m, of the worst of many normals n and the point r
    /// there; to about 1 %.
    pub(super) fn lightness(&self) -> f64 {
        let (_, moments) = self.solid();
        let angle = |k: u32| f64::from(k) / f64::from(DIRECTIONS) * std::f64::consts::FRAC_PI_2;
        let normals = (0..=DIRECTIONS).flat_map(|i| (0..=DIRECTIONS).map(move |k| (angle(i), angle(k))));
        let turning = |(theta, phi): (f64, f64)| {
            let n = [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()];
            let r = self.farthest(n);
            let arm = [r[1] * n[2] - r[2] * n[1], r[2] * n[0] - r[0] * n[2], r[0] * n[1] - r[1] * n[0]];
            (0..3).map(|k| arm[k] * arm[k] / moments[k]).sum::<f64>()
        };
        1.0 + normals.map(turning).fold(0.0, f64::max)
    }
}
