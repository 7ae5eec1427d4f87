//! The bench of laws: what any contact law must do, asked of every stack of parts.

use proptest::prelude::*;
use tsubu::contact::chunk::Chunk;
use tsubu::contact::{Law, Pair};
use tsubu_scene::plan::{Contact, Damping, Normal, Rolling, Tangential};

/// Every stack that a scene can ask for.
fn laws() -> Vec<Contact> {
    let mut laws = Vec::new();
    for normal in [Normal::Hertz {}, Normal::Hooke { stiffness: 1e5 }] {
        for damping in [
            Damping::None {},
            Damping::Sqrt { reference_speed: 1.0 },
            Damping::Quarter {},
            Damping::Linear { reference_speed: 1.0 },
        ] {
            for tangential in
                [Tangential::None {}, Tangential::Coulomb { smoothing_speed: 1e-3 }, Tangential::Mindlin {}]
            {
                if matches!((&normal, &tangential), (Normal::Hooke { .. }, Tangential::Mindlin {})) {
                    continue;
                }
                for rolling in [Rolling::None {}, Rolling::Constant { smoothing_speed: 1e-3 }] {
                    laws.push(Contact {
                        normal: normal.clone(),
                        damping: damping.clone(),
                        attraction: false,
                        tangential: tangential.clone(),
                        rolling,
                        rotation: true,
                    });
                }
            }
        }
    }
    laws
}

fn pair(law: &Law) -> Pair {
    let mut pair = Pair {
        radius: 1.5e-3,
        mass: 1e-4,
        young: 0.27e9,
        shear_modulus: 0.06e9,
        restitution: 0.75,
        friction: 0.5,
        rolling_friction: 0.1,
        ..Pair::default()
    };
    law.prepare(&mut pair);
    pair
}

/// Overlap, closing speed, slip and roll into the one row; the normal is x, the slip along z, the roll about y.
fn fill(chunk: &mut Chunk, pair: &Pair, [overlap, closing, slip, roll]: [f64; 4]) {
    chunk.len = 1;
    chunk.overlap[0] = overlap;
    chunk.root[0] = overlap.sqrt();
    chunk.closing[0] = closing;
    chunk.normal[0][0] = 1.0;
    chunk.slip[2][0] = slip;
    chunk.roll[1][0] = roll;
    chunk.stiffness[0] = pair.stiffness;
    chunk.damping[0] = pair.damping;
    chunk.shear[0] = pair.shear;
    chunk.shear_damping[0] = pair.shear_damping;
    chunk.friction[0] = pair.friction;
    chunk.rolling[0] = pair.rolling_friction * pair.radius;
    chunk.radius[0] = pair.radius;
    chunk.mass[0] = pair.mass;
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Repels when pressed, friction inside the cone, losses never negative where the part cannot store, finite always.
    #[test]
    fn every_law_is_a_law(
        overlap in 1e-12f64..1e-3, closing in -20.0f64..20.0, slip in -20.0f64..20.0, roll in -1e4f64..1e4,
    ) {
        for contact in laws() {
            let law = Law::new(&contact);
            let pair = pair(&law);
            let mut chunk = Box::<Chunk>::default();
            fill(&mut chunk, &pair, [overlap, closing, slip, roll]);
            law.apply(&mut chunk, 1e-6);
            let force = chunk.normal_force[0];
            prop_assert!(force >= 0.0 && force.is_finite(), "{contact:?}: {force}");
            let tangential = chunk.tangential_force[2][0];
            prop_assert!(tangential.abs() <= pair.friction * force * (1.0 + 1e-12), "{contact:?}: {tangential} {force}");
            prop_assert!(tangential * slip <= 0.0, "friction pushes along the slip");
            prop_assert!(chunk.torque[1][0] * roll <= 0.0, "rolling resistance turns along the roll");
            prop_assert!(chunk.lost_normal[0] >= -1e-12, "{contact:?}: {}", chunk.lost_normal[0]);
            prop_assert!(chunk.lost_rolling[0] >= 0.0);
            prop_assert!(chunk.stored[0] >= 0.0 && chunk.lost_sliding[0].is_finite());
        }
    }

    /// A loading and unloading cycle never gives energy: the work taken is not negative, and what is not stored is lost.
    #[test]
    fn no_cycle_adds_energy(depth in 1e-6f64..1e-4, width in 1e-6f64..1e-4) {
        for contact in laws() {
            let law = Law::new(&contact);
            let pair = pair(&law);
            let (steps, dt) = (2000, 1e-7);
            let (mut work, mut lost) = (0.0, 0.0);
            // The history stays in the row from step to step.
            let mut chunk = Box::<Chunk>::default();
            for k in 0..steps {
                let angle = std::f64::consts::TAU * (f64::from(k) + 0.5) / f64::from(steps);
                let rate = std::f64::consts::TAU / (f64::from(steps) * dt);
                let overlap = 0.5 * depth * (1.0 - angle.cos());
                let closing = 0.5 * depth * rate * angle.sin();
                // Side to side, once within the push.
                let slip = width * rate * angle.cos();
                fill(&mut chunk, &pair, [overlap.max(1e-15), closing, slip, 0.0]);
                law.apply(&mut chunk, dt);
                work += (chunk.normal_force[0] * closing - chunk.tangential_force[2][0] * slip) * dt;
                lost += (chunk.lost_normal[0] + chunk.lost_sliding[0] + chunk.lost_rolling[0]) * dt;
            }
            let scale = pair.stiffness * depth.powf(pair.exponent + 1.0);
            prop_assert!(work > -1e-3 * scale, "{contact:?}: a cycle gave {work:e} J of {scale:e}");
            prop_assert!((work - lost).abs() < 5e-3 * scale + 1e-3 * lost.abs(), "{contact:?}: work {work:e} lost {lost:e} scale {scale:e}");
        }
    }
}

/// Names are unique and every part says what it is.
#[test]
fn every_part_speaks() {
    for contact in laws() {
        for part in Law::new(&contact).parts() {
            let about = part.about();
            for text in [about.name, about.models, about.formula, about.symbols, about.limits, about.reference] {
                assert!(!text.is_empty(), "{}: a section is empty", about.name);
            }
            assert!(about.symbols.contains('['), "{}: symbols without units", about.name);
        }
    }
}

/// Komatsuzaki 2003, eqs. (5), (6) and the coefficients that the specification derives from them.
#[test]
fn stiffness_of_the_paper() {
    let (e, s, r, m) = (0.5e9_f64, 0.3_f64, 3e-3_f64, 0.2e-3);
    let law = Law::new(&Contact {
        normal: Normal::Hertz {},
        damping: Damping::Sqrt { reference_speed: 1.0 },
        attraction: true,
        tangential: Tangential::None {},
        rolling: Rolling::None {},
        rotation: false,
    });
    let young = e / (2.0 * (1.0 - s * s));
    for (radius, mass, stiffness, damping) in [(r, m, 2.00631e7, 203.8), (r / 2.0, m / 2.0, 1.41868e7, 125.4)] {
        let mut pair = Pair { radius, mass, young, restitution: 0.75, ..Pair::default() };
        law.prepare(&mut pair);
        assert!((pair.stiffness / stiffness - 1.0).abs() < 1e-5, "{}", pair.stiffness);
        assert!((pair.damping / damping - 1.0).abs() < 1e-3, "{}", pair.damping);
        // Expected single-contact numbers at 1 m/s: 43.47 um and 1.280e-4 s at the wall, 37.85 um and 1.114e-4 s in a pair.
        let (overlap, time) = if radius == r { (43.47e-6, 1.280e-4) } else { (37.85e-6, 1.114e-4) };
        assert!((pair.largest_overlap(1.0) / overlap - 1.0).abs() < 1e-3);
        assert!((pair.contact_time(1.0) / time - 1.0).abs() < 1e-3);
    }
}
