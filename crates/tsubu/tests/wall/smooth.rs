//! A grain in a tessellated cylinder meets one smooth surface: the energy of its contacts has no jumps.

use super::{Dice, contacts, mesh, still};
use glam::DVec3;
use std::f64::consts::TAU;
use tsubu::wall::{Surface, Touch, Wall};

const RADIUS: f64 = 0.2;
const STEPS: usize = 20_000;

/// A cylinder of radius 1 about y from flat pieces.
fn drum(pieces: usize) -> Wall {
    let at = |k: usize, y: f64| {
        let (sin, cos) = (TAU * k as f64 / pieces as f64).sin_cos();
        DVec3::new(cos, y, sin)
    };
    let quads = (0..pieces).flat_map(|k| {
        let [a, b, c, d] = [at(k, -1.0), at(k + 1, -1.0), at(k + 1, 1.0), at(k, 1.0)];
        [[a, b, c], [a, c, d]]
    });
    still(mesh(&quads.collect::<Vec<_>>()))
}

/// Largest jump of the sum of overlap^2 / 2 between neighbouring points of a track inside the drum, over the largest
/// that a smooth force could make, and the most contacts at a time.
fn jump(wall: &Wall, path: impl Fn(usize) -> DVec3, judge: impl Fn(&Wall, DVec3) -> Vec<Touch>) -> (f64, usize) {
    let (mut worst, mut most, mut last) = (0.0f64, 0, None);
    for k in 0..STEPS {
        let centre = path(k);
        let touching = judge(wall, centre);
        most = most.max(touching.len());
        let overlap = |t: &Touch| RADIUS - t.nearest.distance;
        let energy: f64 = touching.iter().map(|t| 0.5 * overlap(t).powi(2)).sum();
        let force: f64 = touching.iter().map(overlap).sum();
        if let Some((energy_before, force_before, before)) = last {
            let (energy_before, force_before): (f64, f64) = (energy_before, force_before);
            let allowed = force.max(force_before) * centre.distance(before);
            worst = worst.max((energy - energy_before).abs() / (allowed + 1e-15));
        }
        last = Some((energy, force, centre));
    }
    (worst, most)
}

/// The wrong rule: contacts are only dropped if their point lies on a nearer triangle.
fn nearer_triangles_only(wall: &Wall, centre: DVec3) -> Vec<Touch> {
    let Surface::Mesh(mesh) = &wall.surface else { panic!("a mesh") };
    let mut near = Vec::new();
    wall.near(centre, RADIUS, &mut near);
    let mut touching: Vec<Touch> = near.iter().map(|&e| Touch::new(e, wall.nearest(e, centre))).collect();
    touching.sort_by(|a, b| a.nearest.distance.total_cmp(&b.nearest.distance));
    let holds = |a: &Touch, t: &Touch| mesh.triangles()[a.element as usize].holds(t.nearest.point, 1e-7);
    let own = |k: usize| !touching[..k].iter().any(|a| holds(a, &touching[k]));
    (0..touching.len()).filter(|&k| own(k)).map(|k| touching[k]).collect()
}

/// Round the drum with overlaps of 0.2 to 1.2 % of the radius, changing on the way.
fn round(k: usize) -> DVec3 {
    let angle = 0.9 * k as f64 / STEPS as f64;
    let reach = 1.0 - RADIUS + 0.007 * RADIUS + 0.005 * RADIUS * (40.0 * angle).sin();
    DVec3::new(reach * angle.cos(), 0.3 * angle, reach * angle.sin())
}

#[test]
fn no_energy_jumps_in_a_tessellated_drum() {
    for pieces in [30, 72, 200] {
        let (worst, most) = jump(&drum(pieces), round, |wall, centre| contacts(wall, centre, RADIUS));
        assert!(worst < 1.01 && most == 1, "{pieces} pieces: {worst}, {most} contacts");
    }
    // The gate refuses the first rule alone: a second contact vanishes with overlap left.
    let (worst, most) = jump(&drum(72), round, nearer_triangles_only);
    assert!(worst > 3.0 && most > 1, "{worst}, {most} contacts");
}

/// Cells of the hills' grid along a side.
const CELLS: usize = 40;

/// Gentle hills cut into triangles: ridges, valleys and saddles, all of them shallow.
#[test]
fn no_energy_jumps_on_gentle_hills() {
    let mut dice = Dice::new(41);
    let mut corner = |i: usize, j: usize| {
        let (x, y) = (i as f64 + dice.between(-0.3, 0.3), j as f64 + dice.between(-0.3, 0.3));
        let (x, y) = (2.0 * x / CELLS as f64 - 1.0, 2.0 * y / CELLS as f64 - 1.0);
        DVec3::new(x, y, 0.02 * (6.0 * x).sin() * (5.0 * y + 0.5).cos())
    };
    let corners: Vec<DVec3> =
        (0..=CELLS).flat_map(|j| (0..=CELLS).map(move |i| (i, j))).map(|(i, j)| corner(i, j)).collect();
    let at = |i: usize, j: usize| corners[j * (CELLS + 1) + i];
    let cells = (0..CELLS).flat_map(|j| (0..CELLS).map(move |i| (i, j)));
    let triangles = cells.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    let wall = still(mesh(&triangles.collect::<Vec<_>>()));
    // Over the hills at a height that keeps the overlap near 1 %.
    let track = |k: usize| {
        let s = 1.4 * k as f64 / STEPS as f64 - 0.7;
        let mut centre = DVec3::new(s, 0.6 * s + 0.05, 0.25);
        for _ in 0..4 {
            let mut near = Vec::new();
            wall.near(centre, 0.3, &mut near);
            let nearest = near.iter().map(|&e| wall.nearest(e, centre).distance).fold(1.0, f64::min);
            centre.z -= nearest - RADIUS * (0.992 + 0.005 * (60.0 * s).sin());
        }
        centre
    };
    let (worst, most) = jump(&wall, track, |wall, centre| contacts(wall, centre, RADIUS));
    assert!(worst < 1.01 && most == 1, "{worst}, {most} contacts");
    let (worst, most) = jump(&wall, track, nearer_triangles_only);
    assert!(worst > 3.0 && most > 1, "{worst}, {most} contacts");
}

/// Keys of neighbouring pieces are adjacent, those of opposite ones are not.
#[test]
fn history_finds_its_predecessor() {
    let wall = drum(72);
    let key = |piece: u32| wall.key(2 * piece);
    assert_eq!(wall.key(0), wall.key(1));
    assert!((0..72).all(|k| wall.adjacent(key(k), key((k + 1) % 72)) && !wall.adjacent(key(k), key((k + 2) % 72))));
}
