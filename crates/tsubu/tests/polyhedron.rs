//! Where polyhedra touch, and what that stores.

use glam::{DMat3, DQuat, DVec3};
use std::f64::consts::TAU;
use tsubu::polyhedron::awake::{Awake, Couple};
use tsubu::polyhedron::contact::Contact;
use tsubu::polyhedron::near::Near;
use tsubu::polyhedron::touch::{Search, touch};
use tsubu::polyhedron::{Faceted, Polyhedron, Turned, with_round};
use tsubu::random::{Purpose, unit, words};
use tsubu::superellipsoid::Superellipsoid;
use tsubu_scene::plan::{ClumpOrientation, GrainShape};

/// Numbers between 0 and 1, one after the other.
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 += 1;
        let w = words(11, Purpose::Orientation, 0, self.0);
        unit(w[0], w[1])
    }

    fn turned(&mut self) -> DQuat {
        let [u, v, w] = [self.next(), TAU * self.next(), TAU * self.next()];
        let (low, high) = ((1.0 - u).sqrt(), u.sqrt());
        DQuat::from_xyzw(low * v.sin(), low * v.cos(), high * w.sin(), high * w.cos())
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.next() - 0.5, self.next() - 0.5, self.next() - 0.5)
    }
}

const CUBE: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [1.0, 1.0, 1.0],
];
const PRISM: [[f64; 3]; 6] =
    [[-1.0, -0.6, -2.0], [1.0, -0.6, -2.0], [0.0, 1.1, -2.0], [-1.0, -0.6, 2.0], [1.0, -0.6, 2.0], [0.0, 1.1, 2.0]];
const TETRAHEDRON: [[f64; 3]; 4] = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];

/// A body of diameter 1, as drawn.
fn body(corners: &[[f64; 3]], rounding: f64) -> Polyhedron {
    let shape = GrainShape::Polyhedron { corners: corners.to_vec(), rounding, orientation: ClumpOrientation::AsDrawn };
    let clump = shape.clump().unwrap();
    // Along the axes as drawn: of a cube they could be any.
    let mut plan = clump.polyhedron.unwrap();
    let drawn = |v: &[f64; 3]| {
        let axes = clump.axes.map(DVec3::from_array);
        (axes[0] * v[0] + axes[1] * v[1] + axes[2] * v[2]).to_array()
    };
    plan.corners.iter_mut().for_each(|corner| *corner = drawn(corner));
    plan.faces.iter_mut().for_each(|face| face.normal = drawn(&face.normal));
    Polyhedron::new(&plan)
}

/// A body of one of some shapes, of diameter 1, as it is turned.
fn body_turned(shape: usize, shapes: &[Polyhedron], turned: DQuat) -> Turned<'_> {
    Faceted::new(shape as u32, 1.0, shapes).at(shapes, &DMat3::from_quat(turned))
}

/// Contacts of two bodies of diameter 1 as they are turned.
fn contacts(shapes: [&Polyhedron; 2], turned: [DQuat; 2], apart: DVec3, reach: f64) -> Vec<Contact> {
    let shapes = shapes.map(Clone::clone);
    let [a, b] = [0, 1].map(|k| body_turned(k, &shapes, turned[k]));
    let mut found = Vec::new();
    touch([&a, &b], apart, reach, &mut Search::default(), &mut found);
    found
}

/// Bodies of three kinds graze and tumble about each other: step by step what is remembered of them gives, to the bit, the contacts of a look at everything. With a path that is
/// told ten times too short it misses some.
#[test]
fn what_sleeps_does_not_touch() {
    let shapes = [body(&CUBE, 0.15), body(&PRISM, 0.12), body(&TETRAHEDRON, 0.1)];
    // Of so many steps in which something touched, in how many contacts differ.
    let differ = |share: f64| {
        let (mut draw, mut search) = (Draw(7), Search::default());
        let (mut some, mut differ) = (0, 0);
        for round in 0..60 {
            let kinds = [round % 3, round / 3 % 3];
            let (mut turned, mut apart) = pair(&mut draw, kinds.map(|kind| &shapes[kind]));
            let turning = [draw.vector(), draw.vector()].map(|spin| spin * 1e-3);
            let (way, mut path) = (draw.vector() * 1e-3, 0.0);
            let (mut near, mut awake) = (Near::default(), Awake::default());
            near.forget(1);
            for step in 0..400 {
                let [a, b] = [0, 1].map(|k| body_turned(kinds[k], &shapes, turned[k]));
                let (mut all, mut found) = (Vec::new(), Vec::new());
                touch([&a, &b], apart, 0.0, &mut search, &mut all);
                let couple = Couple { pair: 0, bodies: [0, 1], apart, path: share * path };
                if !near.is_apart(0, couple.path) {
                    near.wake(couple, [&a, &b], 0.0, &mut search, &mut awake);
                    awake.touch(&mut near, (&[a, b], 0.0), &mut found, |_| ());
                }
                some += usize::from(!all.is_empty());
                differ += usize::from(format!("{all:?}") != format!("{found:?}"));
                // There and back.
                let sign = if step % 200 < 100 { 1.0 } else { -1.0 };
                apart += way * sign;
                path += way.length();
                for (turned, spin) in turned.iter_mut().zip(turning) {
                    *turned = (DQuat::from_scaled_axis(spin * sign) * *turned).normalize();
                    path += 0.5 * spin.length();
                }
            }
        }
        (some, differ)
    };
    let (some, wrong) = differ(1.0);
    assert!(some > 5000 && wrong == 0, "{some} {wrong}");
    assert!(differ(0.1).1 > 100, "{}", differ(0.1).1);
}

/// What springs of stiffness 1 store; and force on the first body, torques on both about their centres.
fn pressed(found: &[Contact], slope: impl Fn(&Contact) -> f64) -> (f64, [DVec3; 3]) {
    let (mut energy, mut push) = (0.0, [DVec3::ZERO; 3]);
    for contact in found.iter().filter(|contact| contact.overlap > 0.0) {
        energy += 0.5 * contact.overlap * contact.overlap;
        let force = -contact.normal * (contact.overlap * slope(contact));
        push[0] += force;
        push[1] += contact.points[0].cross(force);
        push[2] -= contact.points[1].cross(force);
    }
    (energy, push)
}

/// Two bodies of a kind at random places, pressed into each other until something overlaps by a tenth of the radii.
fn pair(draw: &mut Draw, shapes: [&Polyhedron; 2]) -> ([DQuat; 2], DVec3) {
    let mut turned = [draw.turned(), draw.turned()];
    let mut way = (draw.turned() * DVec3::Z).normalize();
    if draw.next() < 0.5 {
        // Nearly face on face, edges nearly parallel: what is hard.
        turned = [DQuat::IDENTITY, DQuat::from_scaled_axis(draw.vector() * 0.02)];
        way = (DVec3::Z + draw.vector() * 0.6).normalize();
    }
    let radii = shapes[0].rounding() + shapes[1].rounding();
    let (mut inside, mut outside) = (0.02, 1.1);
    for _ in 0..60 {
        let middle = f64::midpoint(inside, outside);
        let deepest =
            contacts(shapes, turned, way * middle, 0.0).iter().map(|contact| contact.overlap).fold(0.0, f64::max);
        *(if deepest > 0.1 * radii { &mut inside } else { &mut outside }) = middle;
    }
    (turned, way * outside)
}

/// Force and torques are the slopes of the stored energy, at random places and where faces and edges are nearly parallel, to the error of differences. Without the
/// share of edges that lie back, or with the contact of crossing edges at their middles, they are not.
#[test]
fn forces_are_the_slopes_of_an_energy() {
    let shapes = [body(&CUBE, 0.15), body(&PRISM, 0.12), body(&TETRAHEDRON, 0.1)];
    let mut draw = Draw(0);
    let (mut worst, mut worst_wrong, mut crossed, mut many) = (0.0_f64, 0.0_f64, 0, 0);
    for round in 0..600 {
        let pair_of = [&shapes[round % 3], &shapes[round / 3 % 3]];
        let (turned, apart) = pair(&mut draw, pair_of);
        let found = contacts(pair_of, turned, apart, 0.0);
        crossed += found.iter().filter(|contact| contact.share < 1.0 && contact.overlap > 0.0).count();
        many += usize::from(found.len() > 2);
        let (_, push) = pressed(&found, |contact| contact.share);
        let (_, wrong) = pressed(&found, |_| 1.0);
        let size = found.iter().map(|contact| contact.overlap).fold(0.0, f64::max);
        let step = 1e-6;
        for k in 0..9 {
            let axis = DVec3::from_array([0, 1, 2].map(|i| f64::from(u8::from(i == k % 3))));
            let energy = |step: f64| {
                let (mut turned, mut apart) = (turned, apart);
                match k / 3 {
                    0 => apart -= axis * step,
                    side => turned[side - 1] = DQuat::from_scaled_axis(axis * step) * turned[side - 1],
                }
                pressed(&contacts(pair_of, turned, apart, 0.0), |contact| contact.share).0
            };
            let slope = -(energy(step) - energy(-step)) / (2.0 * step);
            worst = worst.max((push[k / 3].dot(axis) - slope).abs() / size);
            worst_wrong = worst_wrong.max((wrong[k / 3].dot(axis) - slope).abs() / size);
        }
    }
    assert!(crossed > 100 && many > 100, "{crossed} {many}");
    assert!(worst < 2e-5, "{worst:e}");
    assert!(worst_wrong > 1e-4, "{worst_wrong:e}");
}

/// A cube goes round over and beside another, its contacts from face to edge to corner: neither force nor torque jumps. Of the one deepest contact alone the place jumps.
#[test]
fn no_force_jumps() {
    let cube = body(&CUBE, 0.15);
    let radii = 2.0 * cube.rounding();
    let half = cube.corners()[0].abs().max_element();
    let (mut last, mut worst, mut last_deepest, mut worst_deepest, mut kinds) =
        (None::<[DVec3; 3]>, 0.0_f64, None, 0.0_f64, std::collections::BTreeSet::new());
    for step in 0..40_000 {
        let t = f64::from(step) / 40_000.0;
        let turned =
            [DQuat::IDENTITY, DQuat::from_rotation_z(0.3 * t) * DQuat::from_rotation_x(0.01 * (40.0 * t).sin())];
        let apart = DVec3::new(2.4 * half * t, 0.7 * half * t, 2.0 * half + 0.9 * radii);
        let found = contacts([&cube; 2], turned, apart, 0.0);
        kinds.extend(found.iter().map(|contact| contact.feature));
        let (_, push) = pressed(&found, |contact| contact.share);
        if let Some(last) = last {
            worst = (0..3).map(|k| (push[k] - last[k]).length()).fold(worst, f64::max);
        }
        last = Some(push);
        let deepest = found.iter().max_by(|a, b| a.overlap.total_cmp(&b.overlap)).map(|c| c.points[0] * c.overlap);
        if let (Some(now), Some(before)) = (deepest, last_deepest) {
            worst_deepest = worst_deepest.max(DVec3::length(now - before));
        }
        last_deepest = deepest.or(last_deepest);
    }
    assert!(kinds.len() > 20, "{}", kinds.len());
    // The steepest change there is: of an overlap by a step, a few contacts at once.
    let step = 4.0 * half / 40_000.0 * 8.0;
    assert!(worst < step, "{worst:e} {step:e}");
    assert!(worst_deepest > 10.0 * step, "{worst_deepest:e} {step:e}");
}

/// No pair is missed: what alternating projections (Cheney and Goldstein 1959) bring near touches. And where a corner is nearest no direction shows the cores nearer to each other.
#[test]
fn bodies_touch_where_they_are_near() {
    let shapes = [body(&CUBE, 0.15), body(&PRISM, 0.12), body(&TETRAHEDRON, 0.1)];
    let mut draw = Draw(500_000);
    let (mut touching, mut apart_yet_near) = (0, 0);
    for round in 0..400 {
        let pair_of = [&shapes[round % 3], &shapes[round / 3 % 3]];
        let turned = [draw.turned(), draw.turned()];
        let apart = (draw.turned() * DVec3::Z) * (0.55 + 0.4 * draw.next());
        let cut = pair_of[0].rounding() + pair_of[1].rounding();
        let planes = [0, 1].map(|k| {
            let centre = if k == 0 { DVec3::ZERO } else { apart };
            let planes = pair_of[k].planes();
            planes
                .map(|(n, h)| (turned[k] * n, h - pair_of[k].rounding() + (turned[k] * n).dot(centre)))
                .collect::<Vec<_>>()
        });
        let onto = |planes: &[(DVec3, f64)], point: DVec3| {
            let (mut at, mut left) = (point, vec![DVec3::ZERO; planes.len()]);
            for _ in 0..400 {
                for ((n, h), left) in planes.iter().zip(&mut left) {
                    let before = at + *left;
                    at = before - *n * (n.dot(before) - h).max(0.0);
                    *left = before - at;
                }
            }
            at
        };
        let (mut a, mut b) = (DVec3::ZERO, apart);
        for _ in 0..60 {
            a = onto(&planes[0], b);
            b = onto(&planes[1], a);
        }
        // What projections have found so far is never less than the distance.
        let distance = (b - a).length();
        // Cores that meet are beyond what features can say.
        if distance < 0.02 * cut {
            continue;
        }
        let found = contacts(pair_of, turned, apart, 0.0);
        let nearest = found.iter().max_by(|a, b| a.overlap.total_cmp(&b.overlap));
        // Edges that cross at their ends lie back by 2 % of the radii each.
        let back = (distance * distance + 0.08 * cut * cut).sqrt();
        assert!(back >= cut || nearest.is_some_and(|contact| cut - contact.overlap < back + 1e-9), "{distance}");
        let Some(contact) = nearest.filter(|contact| contact.overlap < 0.9 * cut) else {
            apart_yet_near += usize::from(distance > cut && apart.length() < 1.0);
            continue;
        };
        // Whatever the direction, cores are as far apart as along it; where the way between the points is the normal of both there is no nearer pair.
        let far = |k: usize, n: DVec3| {
            pair_of[k].corners().iter().map(|c| n.dot(turned[k] * *c)).fold(f64::NEG_INFINITY, f64::max)
        };
        let way = apart + contact.points[1] - contact.points[0];
        let gap = contact.normal.dot(apart) - far(0, contact.normal) - far(1, -contact.normal);
        assert!(gap <= way.length() + 1e-12);
        let nearer = |other: &Contact| (apart + other.points[1] - other.points[0]).length() < way.length();
        if contact.share == 1.0 && way.length() < 0.9 * cut && !found.iter().any(nearer) {
            assert!(gap > way.length() - 1e-9, "{gap} {}", way.length());
            touching += 1;
        }
    }
    assert!(touching > 20 && apart_yet_near > 50, "{touching} {apart_yet_near}");
}

/// A superellipsoid overlaps a cube by the least, over all directions, of what both reach along it: no direction of many tells less, and one near the normal tells hardly more. The
/// line of centres tells more.
#[test]
fn a_superellipsoid_overlaps_by_the_least() {
    let mut draw = Draw(1);
    let shapes = [body(&CUBE, 0.15)];
    let (mut found, mut naive, mut apart_yet_near) = (0, 0, 0);
    for exponents in [[2.0, 2.0], [4.0, 3.0]] {
        for _ in 0..600 {
            let semi_axes = DVec3::new(0.2 + 0.3 * draw.next(), 0.2 + 0.3 * draw.next(), 0.1 + 0.4 * draw.next());
            let round = Superellipsoid { semi_axes, exponents, reach: 0.5 }.turned(&DMat3::from_quat(draw.turned()));
            let axes = draw.turned();
            let cube = body_turned(0, &shapes, axes);
            let apart = (draw.turned() * DVec3::Z) * (0.6 + 0.2 * draw.next());
            let least = |n: DVec3| {
                let core = cube.corners().map(|(_, corner)| n.dot(corner)).fold(f64::INFINITY, f64::min);
                n.dot(round.support(n).point) - n.dot(apart) - core + cube.rounding
            };
            // Nothing is found where a direction has a gap, and only there; however thin a body is, its far side does not count.
            let mut best = apart.normalize();
            for k in 0..1000 {
                let n = (best + draw.vector() * 0.5_f64.powi(k / 30)).normalize();
                best = if least(n) < least(best) { n } else { best };
            }
            let found_one = with_round::touch(&round, &cube, apart, 0.0);
            apart_yet_near += usize::from(found_one.is_none());
            let Some(touch) = found_one else {
                assert!(least(best) <= 1e-6, "{} of {semi_axes} at {apart} {axes:?}", least(best));
                continue;
            };
            assert!(touch.overlap < 0.1 || least(best) > 1e-3, "{} {}", least(best), touch.overlap);
            if touch.overlap > 0.1 {
                continue;
            }
            found += 1;
            assert!((least(touch.normal) - touch.overlap).abs() < 1e-9, "{} {}", least(touch.normal), touch.overlap);
            for k in 0..400 {
                let spread = if k % 2 == 0 { 1.0 } else { 1e-3 };
                let n = (touch.normal + draw.vector() * spread).normalize();
                assert!(least(n) > touch.overlap - 1e-12, "{} {}", least(n), touch.overlap);
            }
            let line = apart.normalize();
            naive += usize::from(least(line) > touch.overlap + 1e-3);
        }
    }
    assert!(found > 100 && naive > found / 2 && apart_yet_near > 100, "{found} {naive} {apart_yet_near}");
}

/// A tetrahedron is cut exactly: from its tip down the share grows as the cube of the way. As of the sphere that holds it the same would be off by far.
#[test]
fn a_plane_cuts_a_tetrahedron_as_it_should() {
    let shapes = [body(&TETRAHEDRON, 1e-9), body(&CUBE, 0.1)];
    let mut draw = Draw(5);
    for _ in 0..50 {
        let turned = draw.turned();
        let tetrahedron = body_turned(0, &shapes, turned);
        let tip = DVec3::from_array(TETRAHEDRON[0]).normalize();
        let n = turned * tip;
        // From the centre 1/2 up to the tip and 1/6 down to the face.
        let [low, high] = tetrahedron.ends(n);
        assert!((low + 1.0 / 6.0).abs() < 1e-8 && (high - 0.5).abs() < 1e-8, "{low} {high}");
        for k in 1..10 {
            let way = f64::from(k) / 10.0;
            let above = 1.0 - tetrahedron.below(n, 0.5 - way * 2.0 / 3.0);
            assert!((above - way.powi(3)).abs() < 1e-7, "{above} {way}");
            assert!((above - way * way * (3.0 - 2.0 * way)).abs() > 1e-2);
        }
        // Any cut of a cube leaves two halves that are alike.
        let cube = body_turned(1, &shapes, turned);
        let (along, height) = (draw.vector().normalize(), 0.5 * draw.next());
        let cut = |height: f64| cube.below(along, height);
        assert!((cut(height) + cut(-height) - 1.0).abs() < 1e-12);
        assert!((cut(0.0) - 0.5).abs() < 1e-12 && cut(0.51) == 1.0 && cut(-0.51) == 0.0);
    }
}
