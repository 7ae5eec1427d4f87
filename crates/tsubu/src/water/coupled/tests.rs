//! A stream by itself.

use super::step::logarithmic_mean;
use super::*;

fn stream(layers: usize, still: bool) -> Coupled {
    let setting = Setting {
        density: 1000.0,
        viscosity: 1e-6,
        roughness: 2e-3,
        gravity: 0.49,
        shear_velocity: None,
        top: Top::Lid { discharge: None },
        still,
    };
    Coupled::new(Layers::new(0.0, 0.02, layers, 1e-3), &setting)
}

/// Begun at rest, the empty stream becomes the log law of U* = sqrt(a H), within 1 % in every layer, for any layers: what
/// viscosity takes near the bottom is in that. With the plain mean of the mixing lengths it would miss more.
#[test]
fn the_empty_stream_is_the_log_law() {
    for layers in [5, 20, 80] {
        let mut stream = stream(layers, true);
        let none = vec![0.0; layers];
        for _ in 0..40_000 {
            stream.step(&none, &none, 1e-3);
        }
        let shear = (0.49f64 * 0.02).sqrt();
        for k in 0..layers {
            let z = stream.layers.middle(k);
            let law = shear * (8.5 + 5.75 * (z / 2e-3).log10());
            assert!((stream.velocity[k] / law - 1.0).abs() < 0.01, "{layers} {k}: {} {law}", stream.velocity[k]);
        }
        assert!((stream.bottom_shear_velocity() / shear - 1.0).abs() < 1e-3);
    }
    assert!((0.5 * (1.0 + 3.0) / logarithmic_mean(1.0, 3.0) - 1.0).abs() > 0.05);
}

/// Momentum of the water: what the drive gave less what the bottom and the grains took, to round-off, also while grains
/// that take from it sink through it; energy: what the drive did less what is lost and given.
#[test]
fn momentum_and_energy_close() {
    let mut stream = stream(20, false);
    let (momentum, energy) = (stream.momentum(), stream.energy());
    let (mut books, mut given) = (Turnover::default(), 0.0);
    let dt = 1e-4;
    for step in 0..2000 {
        let z = 0.018 - 1e-5 * f64::from(step);
        if step % 10 == 0 {
            let turned = stream.look(&[DVec3::new(0.0, 0.0, z.max(2e-3))], &[1.5e-3], 10.0 * dt);
            (books.work, books.lost) = (books.work + turned.work, books.lost + turned.lost);
        }
        let mut taken = vec![0.0; 20];
        taken[8] = 1e-4 * (f64::from(step) * 0.01).sin().abs();
        let old = stream.velocity[8];
        let before = stream.taken[8];
        let turned = stream.step(&taken, &[0.0; 20], dt);
        given += 0.5 * dt * (before + taken[8]) * 0.5 * (old + stream.velocity[8]);
        books.work += turned.work;
        books.lost += turned.lost;
    }
    let [drive, bottom, grains] = stream.impulses;
    let missing = stream.momentum() - momentum - drive - bottom + grains;
    assert!(missing.abs() < 1e-12 * stream.momentum(), "{missing:e}");
    let missing = stream.energy() - energy - books.work + books.lost + given;
    assert!(missing.abs() < 1e-10 * stream.energy(), "{missing:e}");
    assert!(grains > 0.0 && bottom < 0.0 && books.lost > 0.0);
}

/// A held discharge is held, also from rest.
#[test]
fn a_discharge_is_held() {
    let setting = Setting {
        density: 1000.0,
        viscosity: 1e-6,
        roughness: 2e-3,
        gravity: 0.0,
        shear_velocity: None,
        top: Top::Lid { discharge: Some(0.02) },
        still: true,
    };
    let mut stream = Coupled::new(Layers::new(0.0, 0.02, 20, 1e-3), &setting);
    for _ in 0..10_000 {
        stream.step(&[0.0; 20], &[0.0; 20], 1e-3);
    }
    assert!((stream.discharge() - 0.02).abs() < 1e-12);
    let shape = stream.velocity[19] / stream.velocity[0];
    let law = |z: f64| 8.5 + 5.75 * (z / 2e-3).log10();
    assert!((shape / (law(0.0195) / law(0.0005)) - 1.0).abs() < 0.01, "{shape}");
}

/// A reach that is fed finds the depth at which the log law on its slope carries what comes in, within 1 %, from above and from below.
/// The depth of a discharge larger by a twentieth is refused.
#[test]
fn a_fed_reach_finds_its_depth() {
    // The log law's discharge at a depth, by the midpoint rule.
    let carried = |depth: f64| {
        let law = |z: f64| (8.5 + 5.75 * (z / 2e-3).log10()).max(0.0);
        let n = 10_000;
        let mean = (0..n).map(|k| law((f64::from(k) + 0.5) / f64::from(n) * depth)).sum::<f64>() / f64::from(n);
        (0.49 * depth).sqrt() * mean * depth
    };
    for begin in [0.012, 0.03] {
        let setting = Setting {
            density: 1000.0,
            viscosity: 1e-6,
            roughness: 2e-3,
            gravity: 0.49,
            shear_velocity: None,
            top: Top::Free { supply: Some((carried(0.02), 0.5)) },
            still: false,
        };
        let mut stream = Coupled::new(Layers::new(0.0, begin, 40, 1e-3), &setting);
        let (momentum, energy, mut books) = (stream.momentum(), stream.energy(), Turnover::default());
        for _ in 0..1000 {
            for _ in 0..20 {
                let turned = stream.step(&[0.0; 40], &[0.0; 40], 1e-3);
                (books.work, books.lost) = (books.work + turned.work, books.lost + turned.lost);
            }
            let turned = stream.look(&[], &[], 0.02);
            (books.work, books.lost) = (books.work + turned.work, books.lost + turned.lost);
        }
        let depth = stream.layers.top();
        assert!((depth / 0.02 - 1.0).abs() < 0.01, "{begin}: {depth}");
        assert!((carried(depth) / (1.05 * carried(0.02)) - 1.0).abs() > 0.02);
        let [drive, bottom, _] = stream.impulses;
        let missing = stream.momentum() - momentum - drive - bottom;
        // Round-off of twenty thousand steps.
        assert!(missing.abs() < 1e-15 * 20_000.0 * drive, "{missing:e}");
        let missing = stream.energy() - energy - books.work + books.lost;
        assert!(missing.abs() < 1e-9 * books.work, "{missing:e}");
    }
}

/// U* of the turbulence is that of the stress at its height, sqrt(a (H - z)); that of the bottom would be refused.
#[test]
fn turbulence_follows_the_stress() {
    let stream = stream(40, false);
    let bottom = (0.49f64 * 0.02).sqrt();
    for (k, found) in stream.turbulence().iter().enumerate().take(35).skip(5) {
        let wanted = (0.49 * (0.02 - stream.layers.middle(k))).sqrt();
        assert!((found / wanted - 1.0).abs() < 0.02, "{k}: {found} {wanted}");
        assert!((bottom / wanted - 1.0).abs() > 0.02);
    }
}

/// Above a bed eddies are as long as the height over it lets them be, however deep the bed is: layers filled by 0.55, looser than
/// the densest packing, add nothing. Those of a suspension, filled by 0.45, do.
#[test]
fn a_deep_bed_mixes_no_more_than_a_shallow_one() {
    let stress_above = |bed: usize, filled: f64| {
        let mut stream = stream(40, false);
        stream.layers.porosity[..bed].fill(1.0 - filled);
        for k in 0..40 {
            stream.velocity[k] = 0.01 * k as f64;
        }
        // The water over the bed is as deep, so that its surface is as near.
        stream.layers.porosity.truncate(bed + 20);
        stream.velocity.truncate(bed + 20);
        stream.stiffness();
        stream.stiff[bed + 2]
    };
    let (shallow, deep) = (stress_above(4, 0.55), stress_above(16, 0.55));
    assert!((deep / shallow - 1.0).abs() < 1e-12 && shallow > 0.0, "{shallow} {deep}");
    let (shallow, deep) = (stress_above(4, 0.45), stress_above(16, 0.45));
    assert!(deep > 1.5 * shallow, "{shallow} {deep}");
}
