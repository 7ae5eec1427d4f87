//! A grain on a plane cut into triangles feels one plane.

use super::{Dice, contacts, mesh, plan_wall, still, touches};
use glam::DVec3;
use tsubu::partner::Hosts;
use tsubu::wall::triangle::Triangle;
use tsubu::wall::{Touch, Wall};
use tsubu_scene::plan::{Rotation, Signal};

/// The square (-1, 1) on a grid with jittered inner corners and diagonals by chance.
fn jittered(dice: &mut Dice, cells: usize) -> Vec<[DVec3; 3]> {
    let mut corner = vec![DVec3::ZERO; (cells + 1) * (cells + 1)];
    let step = 2.0 / cells as f64;
    for j in 0..=cells {
        for i in 0..=cells {
            let jitter =
                |dice: &mut Dice, k: usize| if k.is_multiple_of(cells) { 0.0 } else { dice.between(-0.35, 0.35) };
            let (dx, dy) = (jitter(dice, i), jitter(dice, j));
            corner[j * (cells + 1) + i] = DVec3::new((i as f64 + dx) * step - 1.0, (j as f64 + dy) * step - 1.0, 0.0);
        }
    }
    let mut triangles = Vec::new();
    for j in 0..cells {
        for i in 0..cells {
            let at = |i: usize, j: usize| corner[j * (cells + 1) + i];
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            // Also left-handed ones: a shell has no inside.
            let turn = |t: [DVec3; 3], dice: &mut Dice| if dice.roll() < 0.5 { t } else { [t[1], t[0], t[2]] };
            let halves = if dice.roll() < 0.5 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
            triangles.extend(halves.map(|t| turn(t, dice)));
        }
    }
    triangles
}

/// The square split again and again at random inner points: no T-junctions, but needles and fans.
fn random(dice: &mut Dice, points: usize) -> Vec<[DVec3; 3]> {
    let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let [a, b, c, d] = [at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)];
    let mut triangles = vec![[a, b, c], [a, c, d]];
    for _ in 0..points {
        let k = (dice.roll() * triangles.len() as f64) as usize;
        let [a, b, c] = triangles.swap_remove(k);
        let (u, v) = (dice.between(0.1, 0.45), dice.between(0.1, 0.45));
        let p = a + (b - a) * u + (c - a) * v;
        triangles.extend([[a, b, p], [b, c, p], [c, a, p]]);
    }
    triangles
}

/// Two halves of the square cut differently: corners of one rest on edges of the other.
fn with_t_junctions() -> Vec<[DVec3; 3]> {
    let strip = |cells: usize, x: [f64; 2]| {
        (0..cells).flat_map(move |k| {
            let y = |k: usize| 2.0 * k as f64 / cells as f64 - 1.0;
            let at = |i: usize, k: usize| DVec3::new(x[i], y(k), 0.0);
            [[at(0, k), at(1, k), at(1, k + 1)], [at(0, k), at(1, k + 1), at(0, k + 1)]]
        })
    };
    strip(7, [-1.0, 0.1]).chain(strip(5, [0.1, 1.0])).collect()
}

fn planes() -> Vec<Wall> {
    let mut dice = Dice::new(7);
    let jittered = jittered(&mut dice, 30);
    let random = random(&mut dice, 400);
    [jittered, random, with_t_junctions()].iter().map(|t| still(mesh(t))).collect()
}

/// Centres on random straight tracks, 0.29 above the plane, and across a grid point by point.
fn tracks(dice: &mut Dice) -> Vec<DVec3> {
    let mut centres = Vec::new();
    for _ in 0..20 {
        let (a, b) = (dice.vector(0.65), dice.vector(0.65));
        centres.extend((0..100).map(|k| a.lerp(b, f64::from(k) / 99.0).with_z(0.29)));
    }
    centres.extend((0..=40).map(|k| DVec3::new(0.1, 0.03 * f64::from(k - 20), -0.29)));
    centres
}

const RADIUS: f64 = 0.3;

#[test]
fn one_contact_with_the_plane_normal() {
    let mut dice = Dice::new(8);
    for (k, wall) in planes().iter().enumerate() {
        for centre in tracks(&mut dice) {
            let touching = contacts(wall, centre, RADIUS);
            assert_eq!(touching.len(), 1, "plane {k} at {centre}");
            let n = &touching[0].nearest;
            assert!((n.normal - DVec3::Z * centre.z.signum()).length() < 1e-12, "plane {k} at {centre}: {n:?}");
            assert!((n.distance - 0.29).abs() < 1e-15);
            assert_eq!(wall.key(touching[0].element), 0, "history goes on over every seam");
        }
    }
}

/// The same gate refuses the naive rules: every touch counts; and a touch is dropped only for *accepted* nearer
/// triangles.
#[test]
fn naive_rules_fail_the_gate() {
    let mut dice = Dice::new(8);
    let wall = &planes()[0];
    let tsubu::wall::Surface::Mesh(mesh) = &wall.surface else { panic!("a mesh") };
    let (mut all, mut accepted_only) = (0, 0);
    let tracks = tracks(&mut dice);
    for &centre in &tracks {
        let mut touching = touches(wall, centre, RADIUS);
        all += usize::from(touching.len() == 1);
        touching.sort_by(|a, b| a.nearest.distance.total_cmp(&b.nearest.distance));
        let mut accepted: Vec<Touch> = Vec::new();
        for touch in touching {
            let on = |t: &Triangle| t.holds(touch.nearest.point, 1e-9);
            if !accepted.iter().any(|a| on(&mesh.triangles()[a.element as usize])) {
                accepted.push(touch);
            }
        }
        accepted_only += usize::from(accepted.len() == 1);
    }
    assert!(all < tracks.len() / 10 && accepted_only < tracks.len() / 10, "{all} {accepted_only} of {}", tracks.len());
}

/// A plane that was drawn askew and turned: the world's normal is as exact.
#[test]
fn turned_plane() {
    let mut dice = Dice::new(9);
    let mut plan = plan_wall(mesh(&jittered(&mut dice, 20)));
    let axis = dice.direction();
    let signal = Signal::Steady { rate: 1.0 };
    plan.rotation = Some(Rotation { centre: [0.2, 0.1, -0.3], axis: axis.to_array(), signal });
    let mut wall = super::wall(&plan);
    wall.follow(0.8, &Hosts::default());
    let normal = wall.pose.direction(DVec3::Z);
    for own in tracks(&mut dice) {
        let touching = contacts(&wall, wall.pose.to_world(own), RADIUS);
        assert_eq!(touching.len(), 1);
        assert!((touching[0].nearest.normal - normal * own.z.signum()).length() < 1e-12);
    }
}
