//! Mass and moments of inertia of spheres that are one body: where several overlap, their mass is counted once.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use std::f64::consts::{PI, TAU};

/// Lines along each side of a body that is not round about a line.
const LINES: usize = 600;

/// Gauss and Legendre's points and weights for polynomials of degree five, over a length of one.
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.774_596_669_241_483_4, 5.0 / 18.0)];

/// A solid of even density.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solid {
    /// Its volume.
    pub volume: f64,
    /// Its centre of mass.
    pub centre: [f64; 3],
    /// Its principal moments of inertia over its mass, smallest first.
    pub moments: [f64; 3],
    /// Directions of the principal axes: a right-handed set.
    pub axes: [[f64; 3]; 3],
}

/// Integrals over a solid: of 1, of x, and of x x'.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Integrals {
    pub volume: f64,
    pub first: Vector3<f64>,
    pub second: Matrix3<f64>,
}

impl Integrals {
    pub fn add(&mut self, other: &Self) {
        self.volume += other.volume;
        self.first += other.first;
        self.second += other.second;
    }

    /// The solid that has them.
    pub fn solid(&self) -> Solid {
        let centre = self.first / self.volume;
        let spread = self.second / self.volume - centre * centre.transpose();
        let inertia = Matrix3::identity() * spread.trace() - spread;
        let eigen = SymmetricEigen::new((inertia + inertia.transpose()) * 0.5);
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let [x, y] = [order[0], order[1]].map(|index| forward(eigen.eigenvectors.column(index).into()));
        Solid {
            volume: self.volume,
            centre: centre.into(),
            moments: order.map(|index| eigen.eigenvalues[index]),
            axes: [x.into(), y.into(), x.cross(&y).into()],
        }
    }
}

impl Solid {
    /// Of spheres by centre and radius. To rounding where none overlap or all centres are on a line; otherwise by lines through the body, to about
    /// 1e-5 of volume and moments. `None` without a sphere.
    pub fn of(spheres: &[([f64; 3], f64)]) -> Option<Self> {
        let spheres: Vec<(Vector3<f64>, f64)> =
            spheres.iter().map(|(centre, radius)| (Vector3::from(*centre), *radius)).collect();
        let &(origin, _) = spheres.first()?;
        let apart =
            |(i, a): (usize, &(Vector3<f64>, f64))| spheres[..i].iter().all(|b| (a.0 - b.0).norm() >= a.1 + b.1);
        let integrals = if spheres.iter().enumerate().all(apart) {
            let mut sum = Integrals::default();
            for (centre, radius) in &spheres {
                sum.add(&sphere(*centre, *radius));
            }
            sum
        } else {
            line(&spheres, origin).map_or_else(|| by_lines(&spheres), |axis| round(&spheres, origin, axis))
        };
        Some(integrals.solid())
    }
}

/// The one of two opposite vectors whose largest part is positive.
fn forward(vector: Vector3<f64>) -> Vector3<f64> {
    vector * vector[vector.iamax()].signum()
}

fn sphere(centre: Vector3<f64>, radius: f64) -> Integrals {
    let volume = 4.0 / 3.0 * PI * radius.powi(3);
    let second = (centre * centre.transpose() + Matrix3::identity() * (0.2 * radius * radius)) * volume;
    Integrals { volume, first: centre * volume, second }
}

/// The line that all centres are on, if they are on one.
fn line(spheres: &[(Vector3<f64>, f64)], origin: Vector3<f64>) -> Option<Vector3<f64>> {
    let far = spheres.iter().map(|(centre, _)| centre - origin).max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    let axis = if far.norm() > 0.0 { far.normalize() } else { Vector3::x() };
    let off = |centre: &Vector3<f64>| ((centre - origin) - axis * axis.dot(&(centre - origin))).norm();
    spheres.iter().all(|(centre, radius)| off(centre) <= 1e-12 * radius).then_some(axis)
}

/// Slices across the line are discs, whose squared radius is a polynomial between the places where the widest sphere changes.
fn round(spheres: &[(Vector3<f64>, f64)], origin: Vector3<f64>, axis: Vector3<f64>) -> Integrals {
    let places: Vec<(f64, f64)> =
        spheres.iter().map(|(centre, radius)| (axis.dot(&(centre - origin)), *radius)).collect();
    let mut ends: Vec<f64> = places.iter().flat_map(|(s, r)| [s - r, s + r]).collect();
    for (i, (a, p)) in places.iter().enumerate() {
        for (b, q) in &places[..i] {
            // Where two are equally wide: p^2 - (s-a)^2 = q^2 - (s-b)^2.
            ends.extend((a != b).then(|| ((p * p - a * a) - (q * q - b * b)) / (2.0 * (b - a))));
        }
    }
    ends.sort_by(f64::total_cmp);
    let mut sum = Integrals::default();
    let along = axis * axis.transpose();
    for piece in ends.windows(2) {
        let (middle, length) = (0.5 * (piece[0] + piece[1]), piece[1] - piece[0]);
        for (at, weight) in GAUSS {
            let s = middle + 0.5 * length * at;
            let width = places.iter().map(|(a, r)| r * r - (s - a).powi(2)).fold(0.0, f64::max);
            let (area, centre) = (PI * width * weight * length, origin + axis * s);
            sum.add(&Integrals {
                volume: area,
                first: centre * area,
                second: centre * centre.transpose() * area + (Matrix3::identity() - along) * (0.25 * width * area),
            });
        }
    }
    sum
}

/// Lines along z, evenly over what the body covers: of each, what is inside any sphere.
fn by_lines(spheres: &[(Vector3<f64>, f64)]) -> Integrals {
    let end = |axis: usize, sign: f64| {
        spheres.iter().map(|(centre, radius)| sign * centre[axis] + radius).fold(f64::NEG_INFINITY, f64::max) * sign
    };
    let (low, high) = ([end(0, -1.0), end(1, -1.0)], [end(0, 1.0), end(1, 1.0)]);
    let step = [0, 1].map(|axis| (high[axis] - low[axis]) / LINES as f64);
    let area = step[0] * step[1];
    let mut sum = Integrals::default();
    let mut inside: Vec<(f64, f64)> = Vec::new();
    let mut near: Vec<(Vector3<f64>, f64)> = Vec::new();
    for cell in 0..LINES * LINES {
        let x = low[0] + (cell % LINES) as f64 * step[0] + 0.5 * step[0];
        let y = low[1] + (cell / LINES) as f64 * step[1] + 0.5 * step[1];
        if cell % LINES == 0 {
            near.clear();
            near.extend(spheres.iter().filter(|(centre, radius)| (y - centre.y).abs() < *radius));
        }
        inside.clear();
        inside.extend(near.iter().filter_map(|(centre, radius)| {
            let squared = radius * radius - (x - centre.x).powi(2) - (y - centre.y).powi(2);
            (squared > 0.0).then(|| (centre.z - squared.sqrt(), centre.z + squared.sqrt()))
        }));
        inside.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut from = f64::NEG_INFINITY;
        for (low, high) in &inside {
            let low = low.max(from);
            if *high > low {
                let [one, z, zz] = [high - low, (high.powi(2) - low.powi(2)) / 2.0, (high.powi(3) - low.powi(3)) / 3.0];
                sum.volume += area * one;
                sum.first += Vector3::new(x * one, y * one, z) * area;
                let second =
                    Matrix3::new(x * x * one, x * y * one, x * z, x * y * one, y * y * one, y * z, x * z, y * z, zz);
                sum.second += second * area;
                from = *high;
            }
        }
    }
    sum
}

/// Area of a union of discs, by the arcs that are in no other disc (Green's theorem).
pub(crate) fn area_of_discs(discs: &[([f64; 2], f64)]) -> f64 {
    let of_one = |(i, &([x, z], r)): (usize, &([f64; 2], f64))| {
        let mut hidden = Vec::new();
        for (j, ([a, b], other)) in discs.iter().enumerate().filter(|(j, _)| *j != i) {
            let (dx, dz) = (a - x, b - z);
            let apart = dx.hypot(dz);
            // Of two that are the same the first has the arc.
            let (within, around) = (apart + r <= *other, apart + other <= r);
            if within && !(around && i < j) {
                return 0.0;
            }
            if around || apart >= r + other {
                continue;
            }
            let half = ((r * r + apart * apart - other * other) / (2.0 * r * apart)).clamp(-1.0, 1.0).acos();
            let begin = (dz.atan2(dx) - half).rem_euclid(TAU);
            hidden.push((begin, begin + 2.0 * half));
            // What goes on beyond a full turn begins anew.
            hidden.push((begin - TAU, begin - TAU + 2.0 * half));
        }
        hidden.sort_by(|a, b| a.0.total_cmp(&b.0));
        let arc = |from: f64, to: f64| {
            0.5 * r * (r * (to - from) + x * (to.sin() - from.sin()) - z * (to.cos() - from.cos()))
        };
        let (mut area, mut from) = (0.0, 0.0);
        for (begin, end) in hidden {
            if begin > from {
                area += arc(from, begin);
            }
            from = end.max(from);
        }
        if from < TAU { area + arc(from, TAU) } else { area }
    };
    discs.iter().enumerate().map(of_one).sum()
}

/// Points on a sphere of which those in no other one tell the surface of all.
const POINTS: usize = 2000;

/// Surface of a union of spheres, to about 5e-3: by points spread evenly over each (Vogel's spiral).
pub(crate) fn surface(spheres: &[([f64; 3], f64)]) -> f64 {
    let spheres: Vec<(Vector3<f64>, f64)> = spheres.iter().map(|(centre, r)| (Vector3::from(*centre), *r)).collect();
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    let directions: Vec<Vector3<f64>> = (0..POINTS)
        .map(|k| {
            let z = 1.0 - (2 * k + 1) as f64 / POINTS as f64;
            let (sin, cos) = (golden * k as f64).sin_cos();
            let across = (1.0 - z * z).sqrt();
            Vector3::new(across * cos, across * sin, z)
        })
        .collect();
    let of_one = |(i, (centre, radius)): (usize, &(Vector3<f64>, f64))| {
        let others =
            spheres.iter().enumerate().filter(|(j, (other, r))| *j != i && (other - centre).norm() < r + radius);
        let others: Vec<&(Vector3<f64>, f64)> = others.map(|(_, sphere)| sphere).collect();
        let free = |way: &&Vector3<f64>| {
            let point = centre + *way * *radius;
            others.iter().all(|(other, r)| (point - other).norm_squared() >= r * r)
        };
        4.0 * PI * radius * radius * directions.iter().filter(free).count() as f64 / POINTS as f64
    };
    spheres.iter().enumerate().map(of_one).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, expected: f64, within: f64) {
        assert!((found / expected - 1.0).abs() < within, "{found} {expected}");
    }

    #[test]
    fn one_sphere_is_a_sphere() {
        let solid = Solid::of(&[([1.0, 2.0, 3.0], 0.5)]).expect("a solid");
        near(solid.volume, PI / 6.0, 1e-14);
        solid.moments.iter().for_each(|moment| near(*moment, 0.1, 1e-12));
        assert!(Solid::of(&[]).is_none());
    }

    /// Two spheres of radius R, 2 h apart, h < R. Half of them is a sphere cut by the plane at h below its centre: volume
    /// V = pi (2/3 R^3 + R^2 h - h^3/3); about the line of centres the moment is pi/2 times the integral of (R^2 - s^2)^2 from -h to R.
    #[test]
    fn two_that_overlap_are_their_closed_form() {
        let (radius, half) = (0.5_f64, 0.3_f64);
        let solid = Solid::of(&[([half, 0.0, 0.0], radius), ([-half, 0.0, 0.0], radius)]).expect("a solid");
        let volume = 2.0 * PI * (2.0 / 3.0 * radius.powi(3) + radius.powi(2) * half - half.powi(3) / 3.0);
        near(solid.volume, volume, 1e-12);
        let primitive = |s: f64| radius.powi(4) * s - 2.0 / 3.0 * radius.powi(2) * s.powi(3) + s.powi(5) / 5.0;
        near(solid.moments[0], PI * (primitive(radius) - primitive(-half)) / volume, 1e-12);
        // Across it: half of that, and the integral of (half + s)^2 pi (R^2 - s^2), twice.
        let squares = |s: f64| {
            radius.powi(2) * (half.powi(2) * s + half * s.powi(2) + s.powi(3) / 3.0)
                - (half.powi(2) * s.powi(3) / 3.0 + half * s.powi(4) / 2.0 + s.powi(5) / 5.0)
        };
        let across = 2.0 * PI * (squares(radius) - squares(-half)) / volume + 0.5 * solid.moments[0];
        near(solid.moments[1], across, 1e-12);
        near(solid.moments[2], across, 1e-12);
        assert!((solid.axes[0][0] - 1.0).abs() < 1e-12, "{:?}", solid.axes);
        // Counted twice where they overlap, the mass is another by a sixth: not within the same 1e-12.
        assert!((2.0 * 4.0 / 3.0 * PI * radius.powi(3) / volume - 1.0).abs() > 0.1);
    }

    /// Two discs of radius R, 2 h apart: twice what a chord at h leaves of one. Apart, within each other and twice the same; three that overlap by
    /// counting points. Their sum would be too much.
    #[test]
    fn discs_that_overlap_count_once() {
        let (r, h) = (0.5_f64, 0.3_f64);
        let cap = r * r * (h / r).acos() - h * (r * r - h * h).sqrt();
        let two = [([0.2 - h, 1.0], r), ([0.2 + h, 1.0], r)];
        near(area_of_discs(&two), 2.0 * (PI * r * r - cap), 1e-12);
        assert!(2.0 * PI * r * r / area_of_discs(&two) > 1.1);
        near(area_of_discs(&[([0.0, 0.0], 1.0), ([3.0, 0.0], 2.0)]), 5.0 * PI, 1e-12);
        near(area_of_discs(&[([0.0, 0.0], 1.0), ([0.3, 0.1], 0.2), ([0.0, 0.0], 1.0)]), PI, 1e-12);
        let three = [([0.0, 0.0], 0.5), ([0.5, 0.1], 0.4), ([0.2, -0.4], 0.3)];
        let side = 2000;
        let at = |k: i32| -1.0 + 2.0 * (f64::from(k) + 0.5) / f64::from(side);
        let within = |x: f64, z: f64| three.iter().any(|([a, b], r)| (x - a).hypot(z - b) < *r);
        let count = (0..side * side).filter(|k| within(at(k % side), at(k / side))).count();
        near(area_of_discs(&three), count as f64 * 4.0 / f64::from(side * side), 1e-4);
    }

    /// The lines see what slices see, to the error that is stated: a row of four, one of them off the line by a hair.
    #[test]
    fn lines_and_slices_agree() {
        let row = |off: f64| {
            [([0.0, 0.0, 0.0], 0.5), ([0.4, 0.0, off], 0.4), ([0.8, 0.0, 0.0], 0.3), ([0.4, 0.0, 0.0], 0.45)]
        };
        let (slices, lines) = (Solid::of(&row(0.0)).expect("a solid"), Solid::of(&row(1e-9)).expect("a solid"));
        near(lines.volume, slices.volume, 1e-5);
        for (a, b) in lines.moments.iter().zip(slices.moments) {
            near(*a, b, 1e-5);
        }
        near(lines.centre[0], slices.centre[0], 1e-5);
    }
}
