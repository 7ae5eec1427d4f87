//! Superellipsoids: how far they reach, how round they are there, and where two convex bodies touch.
//!
//! A convex body is told by its support function h(u), how far it reaches along a direction u: the point that reaches farthest is the gradient
//! of h, and the radii of curvature there are the eigenvalues of its second derivative across u. For semi-axes a, b, c, exponents of profile and
//! equator p and r, and their conjugates q = p / (p - 1), s = r / (r - 1):
//!
//! ```text
//! (|x/a|^r + |y/b|^r)^(p/r) + |z/c|^p = 1        h(u) = ((|a ux|^s + |b uy|^s)^(q/s) + |c uz|^q)^(1/q)
//! ```
//!
//! (Barr 1981; the dual norm, Rockafellar 1970).

#![allow(clippy::inline_always, reason = "a call inside a row would end the vector code of its loop")]

pub mod at_wall;
pub mod ellipsoids;
pub mod symmetric;
pub mod touch;

use ellipsoids::Ellipsoid;
use glam::{DMat3, DVec3};
use symmetric::Symmetric;

/// Radii of curvature end at so many times the farthest reach of a body: flat places have none.
pub const FLATTEST: f64 = 10.0;

/// Over which angle the curvature of bodies with flat places is blurred [rad].
const BLUR: f64 = 0.25;

/// Straight along an axis a flat place would have infinite radii: directions are this far from it.
const OFF_AXIS: f64 = 1e-14;

/// A superellipsoid about its centre, its semi-axes along x, y, z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Superellipsoid {
    /// Semi-axes [m].
    pub semi_axes: DVec3,
    /// Exponents of the profile and of the equator, 2 or more [-].
    pub exponents: [f64; 2],
    /// Radius of the sphere that just holds it [m].
    pub reach: f64,
}

/// A convex body as it is turned.
#[derive(Clone, Copy, Debug)]
pub struct Outline {
    form: Form,
    /// Sum over the axes of the squared semi-axis times the dyad of its direction [m^2].
    squared: DMat3,
    /// Radii of curvature end here [m].
    flattest: f64,
}

#[derive(Clone, Copy, Debug)]
enum Form {
    Sphere(f64),
    /// With the product of the semi-axes [m^3].
    Ellipsoid(f64),
    /// With the directions of its axes.
    Superellipsoid(Superellipsoid, DMat3),
}

/// What reaches farthest along a direction.
#[derive(Clone, Copy, Debug)]
pub struct Support {
    /// The point, from the centre [m].
    pub point: DVec3,
    /// Second derivative of the support function [m]: across the direction its eigenvalues are the radii of curvature.
    pub second: DMat3,
}

impl Superellipsoid {
    /// Whether it is an ellipsoid.
    #[inline]
    pub fn is_ellipsoid(&self) -> bool {
        self.exponents == [2.0; 2]
    }

    /// The ellipsoid with its semi-axes, turned so that these have these directions.
    pub fn ellipsoid(&self, axes: &DMat3) -> Ellipsoid {
        let squared = Symmetric::along(self.semi_axes * self.semi_axes, axes);
        let (product, flattest) = (self.semi_axes.element_product(), FLATTEST * self.reach);
        Ellipsoid { squared, product, flattest, inverse_inertia: Symmetric::default() }
    }

    /// The body, turned so that its axes have these directions.
    pub fn turned(&self, axes: &DMat3) -> Outline {
        let ellipsoid = self.ellipsoid(axes).outline();
        if self.is_ellipsoid() {
            return ellipsoid;
        }
        Outline { form: Form::Superellipsoid(*self, *axes), ..ellipsoid }
    }

    /// See [`Outline::roundness`], in the frame of the body and without its ends.
    fn roundness(&self, u: DVec3) -> (f64, DVec3) {
        let [q, s] = self.exponents.map(conjugate);
        let reach = self.semi_axes * u.abs();
        let squared = reach * reach + DVec3::splat(BLUR * BLUR * reach.length_squared());
        let blurred = squared.map(f64::sqrt);
        let (equator, [ex, ey], _) = norm(blurred.x, blurred.y, s);
        let sharp = reach.max(DVec3::splat(OFF_AXIS * reach.max_element()));
        let (sharp_equator, [fx, fy], _) = norm(sharp.x, sharp.y, s);
        let (whole, [he, hz], _) = norm(sharp_equator, sharp.z, q);
        let flat = (blurred.x * blurred.y).powf(0.5 * s - 1.0) * blurred.z.powf(0.5 * q - 1.0);
        let product = self.semi_axes.element_product() * ((q - 1.0) * (s - 1.0)).sqrt();
        let radius = product * flat * equator.powf(q - s) * whole.powf(1.0 - 1.5 * q);
        // Logarithmic slopes over the blurred reaches, and by them over the reaches.
        let inner = (q - s) / equator;
        let by = DVec3::new(
            (0.5 * s - 1.0) / blurred.x + inner * ex,
            (0.5 * s - 1.0) / blurred.y + inner * ey,
            (0.5 * q - 1.0) / blurred.z,
        ) / blurred;
        let slopes = reach * (by + DVec3::splat(BLUR * BLUR * by.element_sum()))
            + DVec3::new(he * fx, he * fy, hz) * ((1.0 - 1.5 * q) / whole);
        let sign = self.semi_axes * u.map(|x| 1.0_f64.copysign(x));
        (radius, slopes * sign * radius)
    }

    /// What reaches farthest along a unit direction, in the frame of the body.
    fn support(&self, u: DVec3) -> Support {
        let [q, s] = self.exponents.map(conjugate);
        let reach = self.semi_axes * u.abs();
        let reach = reach.max(DVec3::splat(OFF_AXIS * reach.max_element()));
        let (equator, [ex, ey], [exx, exy, eyy]) = norm(reach.x, reach.y, s);
        let (_, [he, hz], [hee, hez, hzz]) = norm(equator, reach.z, q);
        let sign = self.semi_axes * u.map(|x| 1.0_f64.copysign(x));
        let (xx, xy, yy) = (hee * ex * ex + he * exx, hee * ex * ey + he * exy, hee * ey * ey + he * eyy);
        let (xz, yz) = (hez * ex, hez * ey);
        let scale = DMat3::from_diagonal(sign);
        let second = DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, hzz]);
        Support { point: sign * DVec3::new(he * ex, he * ey, hz), second: scale * second * scale }
    }
}

/// The exponent q with 1/p + 1/q = 1.
fn conjugate(p: f64) -> f64 {
    p / (p - 1.0)
}

/// N = (x^q + y^q)^(1/q) of two positive numbers, its slopes, and its second derivatives by xx, xy and yy.
fn norm(x: f64, y: f64, q: f64) -> (f64, [f64; 2], [f64; 3]) {
    if q == 2.0 {
        let n = (x * x + y * y).sqrt();
        let (a, b) = (x / n, y / n);
        return (n, [a, b], [b * b / n, -a * b / n, a * a / n]);
    }
    // Of the greater one, so that no power is out of range.
    let (large, small) = if x > y { (x, y) } else { (y, x) };
    let ratio = small / large;
    let power = ratio.powf(q);
    let sum = 1.0 + power;
    let root = sum.powf(1.0 / q);
    let (a, b) = (root / sum, root / sum * power / ratio);
    // N is homogeneous, so the rows of second derivatives vanish along (x, y).
    let bend = (q - 1.0) * a / (sum * large) * power;
    let [ll, ls, ss] = [bend, -bend / ratio, bend / (ratio * ratio)];
    if x > y { (large * root, [a, b], [ll, ls, ss]) } else { (large * root, [b, a], [ss, ls, ll]) }
}

impl Outline {
    /// A sphere of a radius [m].
    pub fn sphere(radius: f64) -> Self {
        let squared = DMat3::from_diagonal(DVec3::splat(radius * radius));
        Self { form: Form::Sphere(radius), squared, flattest: f64::INFINITY }
    }

    /// What reaches farthest along a unit direction.
    pub fn support(&self, u: DVec3) -> Support {
        match &self.form {
            Form::Sphere(radius) => Support { point: *radius * u, second: DMat3::from_diagonal(DVec3::splat(*radius)) },
            Form::Ellipsoid(_) => {
                let along = self.squared * u;
                let reach = u.dot(along).sqrt();
                let point = along / reach;
                let dyad = DMat3::from_cols(point * point.x, point * point.y, point * point.z);
                Support { point, second: (self.squared - dyad) * (1.0 / reach) }
            }
            Form::Superellipsoid(body, axes) => {
                let own = body.support(axes.transpose() * u);
                Support { point: *axes * own.point, second: *axes * own.second * axes.transpose() }
            }
        }
    }

    /// How round the body is where it reaches farthest along a unit direction: the geometric mean of both radii of curvature, at most
    /// [`FLATTEST`] times its reach [m]; and how that changes with the direction, across it [m].
    ///
    /// Of an ellipsoid a b c / h^2. Of any other, with X = a |ux|, Y and Z alike, and E the inner norm, squared
    /// (a b c)^2 (q - 1) (s - 1) (X Y)^(s-2) Z^(q-2) E^(2q-2s) h^(2-3q). Straight along an axis that is infinite, and near it changes within
    /// thousandths of a radian, faster than steps in time resolve. So X, Y and Z in it, but not in h, are blurred: sqrt(X^2 + e^2 (X^2 + Y^2 + Z^2))
    /// with e = 1/4.
    pub fn roundness(&self, u: DVec3) -> (f64, DVec3) {
        let (radius, slope) = match &self.form {
            Form::Sphere(radius) => return (*radius, DVec3::ZERO),
            Form::Ellipsoid(product) => {
                let along = self.squared * u;
                let reach = u.dot(along);
                (product / reach, along * (-2.0 * product / (reach * reach)))
            }
            Form::Superellipsoid(body, axes) => {
                let (radius, slope) = body.roundness(axes.transpose() * u);
                (radius, *axes * slope)
            }
        };
        let least = 1e-6 * self.flattest;
        if radius < self.flattest && radius > least {
            (radius, slope - u * u.dot(slope))
        } else {
            (if radius > least { self.flattest } else { least }, DVec3::ZERO)
        }
    }

    /// A way over the sphere of directions that sets out from `u` along `way`: where it is after a share of it, and how fast it goes there.
    ///
    /// Where the surface is flat the farthest point runs away from an axis as a root of the direction does. The way goes evenly in that root,
    /// so that Newton's step, which takes the point to run evenly, ends where it should.
    fn walk(&self, u: DVec3, way: DVec3, share: f64) -> (DVec3, DVec3) {
        let Form::Superellipsoid(body, axes) = &self.form else { return (u + way * share, way) };
        let [profile, equator] = body.exponents;
        let (u, way) = (axes.transpose() * u, axes.transpose() * way);
        let one = |u: f64, way: f64, p: f64| {
            if p == 2.0 {
                return (u + way * share, way);
            }
            let size = u.abs().max(OFF_AXIS);
            let root = size.powf(1.0 / (p - 1.0)).copysign(u);
            let rate = (conjugate(p) - 1.0) * root.abs() / size * way;
            let root = root + rate * share;
            let power = root.abs().powf(p - 2.0);
            (root * power, (p - 1.0) * power * rate)
        };
        let ((x, dx), (y, dy), (z, dz)) =
            (one(u.x, way.x, equator), one(u.y, way.y, equator), one(u.z, way.z, profile));
        (*axes * DVec3::new(x, y, z), *axes * DVec3::new(dx, dy, dz))
    }
}

impl Support {
    /// The second derivative in two directions t and s across: by tt, ts and ss.
    fn across(&self, (t, s): (DVec3, DVec3)) -> [f64; 3] {
        let (along_t, along_s) = (self.second * t, self.second * s);
        [t.dot(along_t), t.dot(along_s), s.dot(along_s)]
    }
}
