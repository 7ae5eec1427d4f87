//! Oblique impacts on a plane.

use super::two::{Ball, Two};
use super::{Subject, constants, stack};
use glam::DVec3;
use tsubu::contact::pair::Constants;
use tsubu_scene::plan::{Contact, Damping, MindlinForm, Tangential};

/// A sphere that meets the plane with a velocity (along x, downward) and no spin; returns its velocity along x and its spin
/// about y afterwards.
fn oblique(subject: &Subject, ball: Ball, along: f64, down: f64) -> (f64, f64) {
    let velocity = DVec3::new(along, 0.0, -down);
    let ball = Ball { position: DVec3::new(0.0, 0.0, ball.radius), velocity, ..ball };
    let mut two = Two::new(subject, [ball, Ball::plane()]);
    two.fill();
    let pair = subject.pair(two.chunk.effective_radius[0], two.chunk.effective_mass[0]);
    two.meet(pair.contact_time(down) / 4000.0, 100_000);
    (two.balls[0].velocity.x, two.balls[0].spin.y)
}

/// Chung and Ooi 2011, test 4 (verification.md V-10), aluminium oxide: tangential restitution and spin by the secant form, as an
/// independent program found them; and exact where the contact slides throughout.
#[test]
fn oxide_spheres_of_chung_and_ooi() {
    let (young, poisson, radius, speed, e, friction) = (380e9, 0.23, 2.5e-3, 3.9_f64, 0.98, 0.092);
    let constants = Constants {
        effective_modulus: young / (1.0 - poisson * poisson),
        shear_modulus: young / (2.0 * (1.0 + poisson) * (2.0 - poisson)),
        restitution: e,
        friction,
        ..constants()
    };
    let contact = |form| Contact {
        damping: Damping::Quarter {},
        tangential: Tangential::Mindlin { form, damping: Some(0.0) },
        ..stack::hertz()
    };
    let ball = Ball::new(radius, 4000.0, DVec3::ZERO);
    let secant = Subject::new(&contact(MindlinForm::Secant), constants);
    let published: [(f64, f64, f64); 11] = [
        (5.0, 0.953, -16.0),
        (10.0, 0.698, -204.0),
        (15.0, 0.630, -374.0),
        (20.0, 0.620, -507.0),
        (25.0, 0.638, -597.0),
        (30.0, 0.6845, -615.0),
        (40.0, 0.783, -544.0),
        (50.0, 0.847, -457.0),
        (60.0, 0.895, -355.0),
        (70.0, 0.934, -243.0),
        (80.0, 0.968, -123.0),
    ];
    for (degrees, ratio, spin) in published {
        let (along, down) = (speed * degrees.to_radians().sin(), speed * degrees.to_radians().cos());
        let (left, turned) = oblique(&secant, ball, along, down);
        assert!((left / along - ratio).abs() < 3e-3 && (turned.abs() + spin).abs() < 4.0, "{degrees}: {left} {turned}");
        if degrees >= 35.0 {
            let exact = along - friction * (1.0 + e) * down;
            assert!((left / exact - 1.0).abs() < 2e-3, "{degrees}: {left} {exact}");
            let exact = 2.5 * friction * (1.0 + e) * down / radius;
            assert!((turned.abs() / exact - 1.0).abs() < 2e-3);
        }
    }
    // The control: friction of 0.1 is refused by the same gates.
    let wrong = Subject::new(&contact(MindlinForm::Secant), Constants { friction: 0.1, ..constants });
    let (along, down) = (speed * 50f64.to_radians().sin(), speed * 50f64.to_radians().cos());
    assert!((oblique(&wrong, ball, along, down).0 / along - 0.847).abs() > 3e-3);
    // The incremental form differs where it sticks, and not where it slides.
    let incremental = Subject::new(&contact(MindlinForm::Incremental), constants);
    let (along, down) = (speed * 10f64.to_radians().sin(), speed * 10f64.to_radians().cos());
    assert!((oblique(&incremental, ball, along, down).0 / along - 0.698).abs() > 3e-3);
}

/// The dashpot of Mindlin's spring: equal damping ratios, c_t / c_n = sqrt(k_t / k_n) with the tangent stiffness 3/2 f/d, or as
/// told.
#[test]
fn the_tangential_dashpot_is_as_told() {
    for told in [None, Some(0.3)] {
        let tangential = Tangential::Mindlin { form: MindlinForm::Incremental, damping: told };
        let contact = Contact { damping: Damping::Quarter {}, tangential, ..stack::hertz() };
        let subject = Subject::new(&contact, constants());
        let mut chunk = subject.chunk(1);
        (chunk.normal[0][0], chunk.effective_radius[0], chunk.effective_mass[0], chunk.overlap[0]) =
            (1.0, 1e-3, 1e-5, 1e-5);
        (chunk.slip[1][0], chunk.closing[0]) = (1e-3, 0.1);
        subject.apply(&mut chunk, 1e-12);
        let dashpot = -(chunk.tangential_force[1][0] + chunk.tangential_stiffness[0] * 1e-15) / 1e-3;
        let equal = (chunk.tangential_stiffness[0] / (1.5 * chunk.secant_stiffness[0])).sqrt();
        let expected = told.unwrap_or(equal) * chunk.damping_coefficient[0];
        assert!((dashpot / expected - 1.0).abs() < 1e-6, "{dashpot} {expected}");
    }
}

/// A linear spring that does not slide turns the contact point round as cos(pi sqrt(7/2 k_t/k_n)): verification.md V-15.
#[test]
fn a_linear_spring_reverses_the_slip() {
    for (ratio, expected) in [(2.0 / 7.0, -1.0), (0.1, (std::f64::consts::PI * 0.35_f64.sqrt()).cos())] {
        let contact =
            Contact { tangential: Tangential::Spring { ratio, damping: 0.0, cohesion: 0.0 }, ..stack::hooke(1e6) };
        let subject = Subject::new(&contact, Constants { friction: 1e6, ..constants() });
        let ball = Ball::new(1e-3, 2500.0, DVec3::ZERO);
        let (left, turned) = oblique(&subject, ball, 0.1, 1.0);
        // The velocity of the contact point: centre, and spin about y on an arm downward.
        let back = (left - turned * ball.radius) / 0.1;
        // The arm is shorter than the radius by half the overlap, here 1 % at most.
        assert!((back - expected).abs() < 1e-2, "{back} {expected}");
        // The control: the factor of a disc, 3 in place of 7/2.
        let disc = (std::f64::consts::PI * (3.0 * ratio).sqrt()).cos();
        assert!((back - disc).abs() > 1e-2, "{back} {disc}");
    }
}

/// Grain-level cohesion: the tangential force reaches mu f_n + c, and no more (Osada 2004, eq. B4).
#[test]
fn cohesion_widens_the_cone() {
    let tangential = Tangential::Spring { ratio: 0.5, damping: 0.0, cohesion: 0.3 };
    let subject = Subject::new(&Contact { tangential, ..stack::hooke(1e5) }, constants());
    let mut chunk = subject.chunk(1);
    (chunk.normal[0][0], chunk.effective_radius[0], chunk.effective_mass[0], chunk.overlap[0]) =
        (1.0, 1e-3, 1e-5, 1e-5);
    chunk.slip[1][0] = 1.0;
    for _ in 0..1000 {
        subject.apply(&mut chunk, 1e-7);
    }
    // 0.5 of 1 N and 0.3 N.
    assert!((chunk.tangential_force[1][0] + 0.8).abs() < 1e-12, "{}", chunk.tangential_force[1][0]);
    chunk.overlap[0] = 0.0;
    subject.apply(&mut chunk, 1e-7);
    assert!(chunk.tangential_force[1][0] == 0.0, "cohesion without touch");
}
