//! Where superellipsoids touch, and how round they are there.

use glam::{DMat3, DQuat, DVec3};
use std::f64::consts::TAU;
use tsubu::random::{Purpose, unit, words};
use tsubu::superellipsoid::ellipsoids::{Ellipsoid, Pairs};
use tsubu::superellipsoid::touch::{Touch, touch};
use tsubu::superellipsoid::{Outline, Superellipsoid};

/// Numbers between 0 and 1, one after the other.
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 += 1;
        let w = words(7, Purpose::Orientation, 0, self.0);
        unit(w[0], w[1])
    }

    fn turned(&mut self) -> DQuat {
        let [u, v, w] = [self.next(), TAU * self.next(), TAU * self.next()];
        let (low, high) = ((1.0 - u).sqrt(), u.sqrt());
        DQuat::from_xyzw(low * v.sin(), low * v.cos(), high * w.sin(), high * w.cos())
    }

    fn body(&mut self, exponents: [f64; 2]) -> Superellipsoid {
        let semi_axes = DVec3::new(0.3 + 0.7 * self.next(), 0.3 + 0.7 * self.next(), 0.3 + 0.7 * self.next());
        Superellipsoid { semi_axes, exponents, reach: 2.0 }
    }
}

/// Two bodies as they are turned, and where the second is; pressed into each other by little.
struct Pair {
    bodies: [(Superellipsoid, DQuat); 2],
    apart: DVec3,
}

impl Pair {
    fn drawn(draw: &mut Draw, exponents: [[f64; 2]; 2]) -> Self {
        let bodies = exponents.map(|exponents| (draw.body(exponents), draw.turned()));
        Self::pressed(bodies, draw.turned() * DVec3::Z)
    }

    fn pressed(bodies: [(Superellipsoid, DQuat); 2], way: DVec3) -> Self {
        let mut pair = Self { bodies, apart: way };
        let (mut inside, mut outside) = (0.2, 4.0);
        while outside - inside > 2e-3 {
            let middle = f64::midpoint(inside, outside);
            pair.apart = way * middle;
            *(if pair.touch().is_some() { &mut inside } else { &mut outside }) = middle;
        }
        pair.apart = way * inside;
        pair
    }

    fn outlines(&self) -> [Outline; 2] {
        [0, 1].map(|k| self.bodies[k].0.turned(&DMat3::from_quat(self.bodies[k].1)))
    }

    fn touch(&self) -> Option<Touch> {
        let [a, b] = &self.outlines();
        touch([a, b], self.apart, 0.0)
    }

    /// The overlap along a direction.
    fn along(&self, n: DVec3) -> f64 {
        let [a, b] = &self.outlines();
        n.dot(a.support(n).point - b.support(-n).point - self.apart)
    }
}

/// For random pairs of every exponent the search ends at the least overlap: no direction near it has less, and both farthest points lie on one line
/// along the normal. The line of centres alone, as for spheres, is wrong by far and refused.
#[test]
fn random_pairs_touch_where_the_overlap_is_least() {
    for (exponents, mean, worst) in [
        ([[2.0; 2]; 2], 6.0, 12),
        ([[2.0; 2], [4.0; 2]], 8.0, 40),
        ([[4.0, 2.0], [3.0, 5.0]], 9.0, 60),
        ([[4.0; 2]; 2], 9.0, 60),
        ([[6.0; 2]; 2], 12.0, 100),
        ([[8.0; 2]; 2], 16.0, 100),
    ] {
        let mut draw = Draw(1);
        let (mut sum, mut most, mut coarse) = (0, 0, 0);
        let pairs = 3000;
        for _ in 0..pairs {
            let pair = Pair::drawn(&mut draw, exponents);
            let touch = pair.touch().unwrap();
            (sum, most) = (sum + touch.looks, most.max(touch.looks));
            for spread in [1e-1, 1e-2, 1e-3] {
                let near = (touch.normal + draw.turned() * DVec3::X * spread).normalize();
                assert!(pair.along(near) > touch.overlap - 3e-7, "{exponents:?} {}", pair.along(near) - touch.overlap);
            }
            let line = touch.points[0] - touch.points[1] - pair.apart;
            assert!((line - touch.normal * touch.overlap).length() < 1e-9);
            coarse += usize::from(pair.along(pair.apart.normalize()) > touch.overlap + 1e-3);
        }
        println!("{exponents:?}: {} looks on average, at most {most}", f64::from(sum as u32) / f64::from(pairs));
        assert!(f64::from(sum as u32) / f64::from(pairs) < mean && most <= worst, "{exponents:?} {sum} {most}");
        assert!(coarse > pairs as usize / 2, "{coarse}");
    }
}

/// The radius of curvature of an ellipsoid in closed form is that of the second derivative, to rounding, and that of bodies with flat places in their
/// middle, where its blur tells least, to a third; its slope is that of differences.
#[test]
fn bodies_are_as_round_as_their_second_derivative_says() {
    let mut draw = Draw(2);
    for exponents in [[2.0; 2], [4.0; 2], [3.0, 6.0], [5.0, 2.0]] {
        for _ in 0..200 {
            let (body, turned) = (draw.body(exponents), draw.turned());
            let outline = body.turned(&DMat3::from_quat(turned));
            let n = draw.turned() * DVec3::Z;
            let (radius, slope) = outline.roundness(n);
            let (t, s) = n.any_orthonormal_pair();
            let second = outline.support(n).second;
            let across = |a: DVec3, b: DVec3| a.dot(second * b);
            let expected = (across(t, t) * across(s, s) - across(t, s).powi(2)).sqrt();
            let off = (radius / expected).ln().abs();
            let own = (turned.conjugate() * n * body.semi_axes).abs();
            let corner = own.min_element() > 0.5 * own.max_element();
            assert!(if exponents == [2.0; 2] { off < 1e-9 } else { off < 0.35 || !corner }, "{exponents:?} {off}");
            if radius < 15.0 {
                let step = 1e-6;
                let there = |way: DVec3| outline.roundness((n + way).normalize()).0;
                for way in [t, s] {
                    let found = (there(way * step) - there(way * -step)) / (2.0 * step);
                    assert!((found - slope.dot(way)).abs() < 1e-4 * (radius + slope.length()), "{found}");
                }
            }
        }
    }
}

/// The force and the torques of the effective radius are its slopes over places and angles; without them the energy of a contact would come and go
/// from nowhere, and the gate refuses that.
#[test]
fn rounding_is_the_slope_of_the_effective_radius() {
    let mut draw = Draw(3);
    let effective = |pair: &Pair| {
        let [a, b] = pair.touch().unwrap().radii;
        a * b / (a + b)
    };
    let mut largest = 0.0_f64;
    for exponents in [[2.0; 2], [3.0; 2]] {
        for _ in 0..100 {
            let pair = Pair::drawn(&mut draw, [exponents, [2.0, 2.0]]);
            let touch = pair.touch().unwrap();
            if touch.radii[0] > 5.0 {
                continue;
            }
            let step = 1e-6;
            let with = |change: &dyn Fn(&mut Pair, f64)| {
                let at = |by: f64| {
                    let mut moved = Pair { bodies: pair.bodies, apart: pair.apart };
                    change(&mut moved, by);
                    effective(&moved)
                };
                (at(step) - at(-step)) / (2.0 * step)
            };
            let rounding = touch.rounding;
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                // The first body goes forward: the second is nearer by as much.
                let moved = with(&|pair, by| pair.apart -= axis * by);
                let turned = [0, 1]
                    .map(|k| with(&|pair, by| pair.bodies[k].1 = DQuat::from_axis_angle(axis, by) * pair.bodies[k].1));
                let scale = rounding.force.length() + rounding.torques[0].length() + rounding.torques[1].length();
                let near = |found: f64, expected: f64| (found - expected).abs() < 1e-4 * (scale + 1.0);
                assert!(near(-moved, rounding.force.dot(axis)), "{moved} {}", rounding.force);
                assert!((0..2).all(|k| near(-turned[k], rounding.torques[k].dot(axis))), "{turned:?} {rounding:?}");
                largest = largest.max(moved.abs());
            }
        }
    }
    assert!(largest > 0.1, "{largest}");
}

/// Many pairs at once are found where each alone is, whatever is beside them in the columns and whether the other is a sphere; the place that the
/// search sets out from is none of these and refused.
#[test]
fn ellipsoids_side_by_side_touch_where_one_pair_does() {
    let mut draw = Draw(4);
    let (mut away, mut rounding, mut coarse, mut many) = (0.0_f64, 0.0_f64, 0, 0);
    for round in 0..100 {
        let pairs: Vec<Pair> = (0..30)
            .map(|k| {
                let pair = Pair::drawn(&mut draw, [[2.0; 2]; 2]);
                if k % 5 != 0 {
                    return pair;
                }
                // A sphere, and a body ten times as long as wide.
                let mut bodies = pair.bodies;
                bodies[0].0.semi_axes = DVec3::ONE;
                bodies[1].0.semi_axes = DVec3::new(1.0, 0.1, 0.1);
                Pair::pressed(bodies, pair.apart.normalize())
            })
            .collect();
        let bodies: Vec<[Ellipsoid; 2]> = pairs
            .iter()
            .map(|pair| pair.bodies.map(|(body, turned)| body.ellipsoid(&DMat3::from_quat(turned))))
            .collect();
        let body = |number: u32| &bodies[number as usize / 2][number as usize % 2];
        let search = |from: usize, to: usize| {
            let mut side_by_side = Pairs::default();
            for (k, pair) in pairs.iter().enumerate().take(to).skip(from) {
                let number = [2 * k as u32, 2 * k as u32 + 1];
                side_by_side.push(k as u32, number, number.map(body), pair.apart);
            }
            side_by_side.sieve(0.01);
            let guess: Vec<f64> = (0..side_by_side.rows()).map(|i| side_by_side.overlap(i)).collect();
            side_by_side.descend(0.0, body);
            (guess, side_by_side)
        };
        let (guess, found) = search(0, pairs.len());
        for i in 0..found.rows() {
            let pair = &pairs[found.name[i] as usize];
            let Some(alone) = pair.touch() else {
                assert!(found.overlap(i) <= 0.0 || !found.arrived(i));
                continue;
            };
            if !found.arrived(i) {
                continue;
            }
            many += 1;
            let touch = found.touch(i);
            coarse += usize::from(guess[i] - alone.overlap > 1e-6);
            away = away.max((touch.normal - alone.normal).length()).max((touch.overlap - alone.overlap).abs());
            for k in 0..2 {
                away = away.max((touch.points[k] - alone.points[k]).length());
                away = away.max((touch.radii[k] / alone.radii[k] - 1.0).abs());
                let scale = 1.0 + alone.rounding.torques[k].length();
                rounding = rounding.max((touch.rounding.torques[k] - alone.rounding.torques[k]).length() / scale);
            }
            let scale = 1.0 + alone.rounding.force.length();
            rounding = rounding.max((touch.rounding.force - alone.rounding.force).length() / scale);
            // Alone in the columns it has the same bits.
            if round < 5 {
                let (_, single) = search(found.name[i] as usize, found.name[i] as usize + 1);
                assert_eq!(single.touch(0).normal, touch.normal);
                assert_eq!(single.touch(0).rounding.torques, touch.rounding.torques);
            }
        }
    }
    assert!(away < 1e-8 && rounding < 1e-4, "{away:e} {rounding:e}");
    assert!(many > 2500 && coarse > many / 3, "{many} {coarse}");
}
