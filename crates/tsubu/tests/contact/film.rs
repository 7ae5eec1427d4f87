//! The film of liquid, as a part of every law.

use super::{Numbers, Subject, stack};
use std::f64::consts::PI;
use tsubu::contact::Chunk;
use tsubu_scene::plan::{Contact, Film};

const VISCOSITY: f64 = 1e-3;
const ROUGHNESS: f64 = 2e-6;
const REACH: f64 = 1e-4;
const RADIUS: f64 = 1e-3;
const MASS: f64 = 1e-5;
const DT: f64 = 1e-9;

fn film(in_contact: bool) -> Film {
    Film::Lubrication { roughness: ROUGHNESS, reach: REACH, viscosity: VISCOSITY, in_contact }
}

/// One row with a gap [m], closing [m/s], sliding, rolling and twisting.
fn row(subject: &Subject, gap: f64, closing: f64) -> Box<Chunk> {
    let mut chunk = subject.chunk(1);
    (chunk.overlap[0], chunk.closing[0], chunk.normal[0][0]) = (-gap, closing, 1.0);
    (chunk.effective_radius[0], chunk.effective_mass[0]) = (RADIUS, MASS);
    let mut numbers = Numbers::new(7);
    let any = |numbers: &mut Numbers| numbers.vector(1.0) * glam::DVec3::new(0.0, 1.0, 1.0);
    let (slip, roll) = (any(&mut numbers), 1e3 * any(&mut numbers));
    Chunk::set(&mut chunk.slip, 0, slip);
    Chunk::set(&mut chunk.roll, 0, roll);
    chunk.twist[0] = 100.0;
    subject.apply(&mut chunk, DT);
    chunk
}

fn wet(contact: &Contact, in_contact: bool) -> Subject {
    stack::subject(&Contact { film: film(in_contact), ..contact.clone() })
}

/// Across a gap every law of the bench has nothing but the film: no friction, no rolling or twisting resistance, no attraction,
/// nothing stored. What the film takes is lost normally, in approach and in parting. Where bodies touch, the dry law is left as it is.
#[test]
fn across_a_gap_there_is_the_film_alone() {
    for dry in stack::PAIRS.iter() {
        let name = &dry.contact;
        let law = wet(name, false);
        for (gap, closing) in [(1e-8, 0.3), (5e-6, 0.3), (5e-5, -0.3), (2e-4, 0.3)] {
            let chunk = row(&law, gap, closing);
            let reached = if gap < REACH { 6.0 * PI * VISCOSITY * RADIUS * RADIUS / gap.max(ROUGHNESS) } else { 0.0 };
            let wanted = reached * closing;
            assert!((chunk.normal_force[0] - wanted).abs() <= 1e-3 * wanted.abs(), "{name:?} {gap}");
            assert_eq!(chunk.damping_force[0], chunk.normal_force[0], "{name:?}");
            assert_eq!(chunk.lost_normal[0], chunk.normal_force[0] * closing, "{name:?}");
            for column in chunk.tangential_force.iter().chain(&chunk.torque) {
                assert_eq!(column[0], 0.0, "{name:?} {gap}");
            }
            assert_eq!([chunk.stored[0], chunk.lost_sliding[0], chunk.lost_rolling[0]], [0.0; 3], "{name:?} {gap}");
        }
        let (touching, bare) = (row(&law, -1e-6, 0.3), row(dry, -1e-6, 0.3));
        assert_eq!(touching.normal_force[0], bare.normal_force[0], "{name:?}");
        assert_eq!(touching.lost_normal[0], bare.lost_normal[0], "{name:?}");
        for k in 0..3 {
            assert_eq!(touching.tangential_force[k][0], bare.tangential_force[k][0], "{name:?}");
            assert_eq!(touching.torque[k][0], bare.torque[k][0], "{name:?}");
        }
        let through = row(&wet(name, true), -1e-6, 0.3);
        let more = through.normal_force[0] - bare.normal_force[0];
        assert!((more / (6.0 * PI * VISCOSITY * RADIUS * RADIUS / ROUGHNESS * 0.3) - 1.0).abs() < 1e-6, "{name:?}");
        assert_eq!(through.tangential_force[1][0], bare.tangential_force[1][0], "friction sees the film: {name:?}");
    }
}

/// The verdict's numbers: the dashpot where the film is thinnest, and what an approach loses.
#[test]
fn the_verdict_knows_the_film() {
    let pair = wet(&stack::hertz(), false).pair(RADIUS, MASS);
    let strength = 6.0 * PI * VISCOSITY * RADIUS * RADIUS;
    assert!((pair.film / (strength / ROUGHNESS) - 1.0).abs() < 1e-12);
    assert!((pair.film_takes / (strength * ((REACH / ROUGHNESS).ln() + 1.0)) - 1.0).abs() < 1e-12);
    let law = wet(&stack::hertz(), false);
    assert_eq!(law.law.reach(&pair), REACH);
    let about = law.law.parts().last().unwrap().about();
    assert!(about.key == "contact.film.lubrication" && about.symbols.contains('['));
}
