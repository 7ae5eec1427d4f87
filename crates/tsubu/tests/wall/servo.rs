//! A wall on a guide under a constant force, against closed forms, with books that close.

use glam::DVec3;
use tsubu::wall::Servo;
use tsubu_frame::State;
use tsubu_scene::plan;

const FORCE: f64 = 2.0;
const MASS: f64 = 0.5;
const STIFFNESS: f64 = 300.0;

fn servo(damping: f64) -> Servo {
    Servo::new(&plan::Servo { direction: [0.0, 0.6, -0.8], force: Some(FORCE), pressure: None, mass: MASS, damping })
}

/// Runs against a spring that stands for grains; returns displacement, and the energy residual.
fn run(damping: f64, time: f64, steps: u32) -> (f64, f64) {
    let mut servo = servo(damping);
    let dt = time / f64::from(steps);
    let (mut work, mut lost) = (0.0, 0.0);
    servo.start(DVec3::ZERO);
    for _ in 0..steps {
        servo.before(dt);
        let spring = servo.direction * (-STIFFNESS * servo.displacement());
        let exchange = servo.after(spring, dt);
        work += exchange.work;
        lost += exchange.lost;
    }
    let held = servo.kinetic() + 0.5 * STIFFNESS * servo.displacement().powi(2);
    (servo.displacement(), held - work + lost)
}

/// s(t) of M s'' + c s' + k s = F from rest.
fn closed_form(damping: f64, t: f64) -> f64 {
    let decay = damping / (2.0 * MASS);
    let w = (STIFFNESS / MASS - decay * decay).sqrt();
    FORCE / STIFFNESS * (1.0 - (-decay * t).exp() * ((w * t).cos() + decay / w * (w * t).sin()))
}

#[test]
fn damped_oscillation_second_order() {
    for damping in [0.0, 3.0] {
        let exact = closed_form(damping, 0.7);
        let errors = [2000, 4000].map(|n| (run(damping, 0.7, n).0 - exact).abs());
        assert!(errors[0] < 1e-4 * FORCE / STIFFNESS, "{damping}: {errors:?}");
        assert!((3.8..4.2).contains(&(errors[0] / errors[1])), "{damping}: {errors:?}");
    }
    // Books with the damper's sign turned would miss twice its loss: the closing gate below sees 2e-5 of the work.
    for damping in [0.0, 3.0] {
        let missed = [2000, 4000].map(|n| run(damping, 0.7, n).1.abs());
        let scale = FORCE * FORCE / STIFFNESS;
        assert!(missed[0] < 2e-5 * scale, "{damping}: {missed:?}");
    }
}

/// Freely pushed it reaches F / c; a damper far too stiff for the step stays stable.
#[test]
fn terminal_speed() {
    for (damping, dt) in [(5.0, 1e-3), (50.0, 0.1)] {
        let mut servo = servo(damping);
        for _ in 0..3000 {
            servo.before(dt);
            servo.after(DVec3::ZERO, dt);
        }
        assert!((servo.velocity() * damping / FORCE - 1.0).abs() < 1e-9, "{}", servo.velocity());
    }
}

#[test]
fn resumes_with_the_same_bits() {
    let go = |servo: &mut Servo, steps: u32| {
        for _ in 0..steps {
            servo.before(1e-3);
            let push = DVec3::new(0.0, -0.1, 20.0 * servo.displacement());
            servo.after(push, 1e-3);
        }
    };
    let mut through = servo(1.0);
    go(&mut through, 50);
    let mut state = State::default();
    through.save("wall.press", &mut state);
    let mut resumed = servo(1.0);
    resumed.load("wall.press", &state).unwrap();
    go(&mut through, 50);
    go(&mut resumed, 50);
    assert_eq!(through, resumed);
}
