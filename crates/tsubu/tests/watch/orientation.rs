//! Bodies that lie as is known, and contacts counted by body.

use super::{ball, column, near, once, scalar, touching, view, watch};
use glam::DVec3;
use std::f64::consts::TAU;
use std::path::Path;
use tsubu::interrupt::{Interrupt, Watcher};
use tsubu::random::{Purpose, unit, words};
use tsubu::run::run;
use tsubu::view::{Body, View};
use tsubu_frame::{Existing, ResultValue};
use tsubu_scene::Scene;

/// Bodies of one grain each, with these long axes.
fn lying(axes: &[DVec3]) -> View<'static> {
    let balls: Vec<_> = (0..axes.len()).map(|k| ball(k as f64, 0.0, 0.0, 0.1)).collect();
    let body = |(grain, long): (usize, &DVec3)| Body {
        grain,
        centre: balls[grain].at,
        long: *long,
        short: long.any_orthonormal_vector(),
    };
    let bodies = axes.iter().enumerate().map(body).collect();
    View { bodies, body_of: (0..axes.len() as u32).map(Some).collect(), ..view(&balls, Vec::new(), [None; 3]) }
}

/// Evenly over the sphere, over the plane x-z, or along one direction; half of them head down.
fn drawn(number: usize, of: impl Fn(f64, f64) -> DVec3) -> Vec<DVec3> {
    let one = |k: usize| {
        let w = words(7, Purpose::Orientation, k as u32, 0);
        of(unit(w[0], w[1]), unit(w[2], w[3])) * if k.is_multiple_of(2) { 1.0 } else { -1.0 }
    };
    (0..number).map(one).collect()
}

const WATCH: &str = "orientation = { bins = 6 }";
const SCENE: &str = "[particles.rods]\nmaterial = \"glass\"\ndiameter = 1\nshape.clump = { centre = [[-1, 0, 0], [1, 0, 0]], diameter = [2, 2] }\n\
                     start.at.position = [[0, 0, 0]]\n";

fn measured(axes: &[DVec3]) -> ([f64; 4], Vec<f64>) {
    let mut watch = super::watch_of(3, SCENE, WATCH);
    let sample = once(&mut *watch, &lying(axes));
    let names = ["order parameter", "alignment", "director x", "director z"];
    (names.map(|name| scalar(&*watch, &sample, name)), column(&*watch, &sample, "density over random"))
}

/// Aligned bodies have an order of 1 whatever their heads do; random ones of 0 within what so many bodies have at random; those that are random in a plane
/// of 1/4, along its normal -1/2. The mean direction, which a first moment would give, is near zero for all three and refused.
#[test]
fn order_is_what_closed_forms_say() {
    let number = 40_000;
    let along = DVec3::new(0.6, 0.0, 0.8);
    let aligned = drawn(number, |_, _| along);
    let random = drawn(number, |u, v| {
        let (z, angle) = (2.0 * u - 1.0, TAU * v);
        DVec3::new((1.0 - z * z).sqrt() * angle.cos(), (1.0 - z * z).sqrt() * angle.sin(), z)
    });
    let flat = drawn(number, |u, _| DVec3::new((TAU * u).cos(), (TAU * u).sin(), 0.0));
    let ([order, alignment, x, z], _) = measured(&aligned);
    assert!((order - 1.0).abs() < 1e-12 && (x - 0.6).abs() < 1e-9 && (z - 0.8).abs() < 1e-9);
    assert!((alignment - (1.5 * 0.64 - 0.5)).abs() < 1e-9);
    let ([order, alignment, ..], density) = measured(&random);
    // Entries of Q scatter by 1 / sqrt(5 N) on the diagonal; the largest eigenvalue lies some of these above 0.
    let scatter = (0.2 / number as f64).sqrt();
    assert!(order > 0.0 && order < 4.0 * scatter && alignment.abs() < 4.0 * scatter, "{order} {alignment}");
    assert!(density.iter().all(|density| (density - 1.0).abs() < 0.05), "{density:?}");
    let ([order, alignment, ..], density) = measured(&flat);
    assert!((order - 0.25).abs() < 4.0 / (number as f64).sqrt() && (alignment + 0.5).abs() < 1e-9, "{order}");
    assert!(density[..5].iter().all(|density| *density == 0.0));
    // The control: by the mean of the axes all three would be alike.
    for axes in [&aligned, &random, &flat] {
        assert!((axes.iter().sum::<DVec3>() / number as f64).length() < 0.02);
    }
}

/// A rod turns from 0.2 rad above the x axis to 0.2 rad below. The director, whose last entry is not negative, points right and then left, and
/// the mean of its components was near (0, 0.1); its mean axis is x. Of n and -n neither is the larger.
#[test]
fn the_mean_of_a_director_is_its_mean_axis() {
    let (c, s) = (0.2_f64.cos(), 0.2_f64.sin());
    let text = format!(
        "dimension = 2\nduration = '0.4 s'\ngravity = 0\n[materials.glass]\ndensity = 2500\nyoung-modulus = '10 MPa'\n[particles.rod]\n\
         material = 'glass'\ndiameter = '4 mm'\nstart.at = {{ position = [[0, 0]], spin = [1] }}\n\
         shape.clump = {{ centre = [[{c}, {s}], [{}, {}]], diameter = [1, 1], orientation = 'as-drawn' }}\n[dem]\ntime-step = '1 ms'\n\
         [watch.o]\norientation = {{}}\nevery = '10 ms'\n",
        -c, -s
    );
    let scene = Scene::parse("rod", &text, Path::new("."), &[]).unwrap_or_else(|complaints| panic!("{complaints}"));
    let folder = tempfile::tempdir().expect("a folder");
    let watcher = Watcher { interrupt: &Interrupt::new(), progress: &|_| {} };
    let summary = run(&scene, folder.path(), Existing::Overwrite, &watcher).expect("a run");
    let number = |name: &str| match summary.results.get(name) {
        Some(ResultValue::Number(value)) => Some(*value),
        _ => None,
    };
    assert!(number("o director x").is_some_and(|x| near(x.abs(), 1.0, 1e-6)), "{:?}", number("o director x"));
    assert!(number("o director z").is_some_and(|z| z.abs() < 1e-6), "{:?}", number("o director z"));
    assert!(number("o director x final").is_some_and(|x| near(x, -c, 1e-3)), "{:?}", number("o director x final"));
    for of_no_axis in ["spread", "least", "largest"] {
        assert_eq!(number(&format!("o director x {of_no_axis}")), None);
        assert!(number(&format!("o alignment {of_no_axis}")).is_some());
    }
}

/// A clump touches another with two of its balls: two contacts, one pair of bodies.
#[test]
fn contacts_are_counted_by_body_too() {
    let balls =
        [ball(0.0, 0.0, 0.0, 0.5), ball(0.0, 0.0, 1.0, 0.5), ball(0.99, 0.0, 0.0, 0.5), ball(0.99, 0.0, 1.0, 0.5)];
    let contacts: Vec<_> = touching(&balls, [None; 3], 1.0).into_iter().filter(|c| c.normal.x.abs() > 0.9).collect();
    let body = |grain: usize| Body { grain, centre: balls[grain].at, long: DVec3::Z, short: DVec3::X };
    let look = View {
        bodies: vec![body(0), body(2)],
        body_of: vec![Some(0), Some(0), Some(1), Some(1)],
        ..view(&balls, contacts, [None; 3])
    };
    let mut list = super::watch_of(3, SCENE, "contacts = {}");
    let sample = once(&mut *list, &look);
    assert_eq!(["contacts", "pairs of bodies"].map(|name| scalar(&*list, &sample, name)), [2.0, 1.0]);
    assert_eq!(column(&*list, &sample, "first body"), [0.0, 0.0]);
    assert_eq!(column(&*list, &sample, "second body"), [2.0, 2.0]);
    // Where all grains are spheres it says nothing of bodies.
    assert!(!watch(3, "contacts = {}").scalars().iter().any(|name| name.contains("bodies")));
}

/// Two clumps of two balls and a ball by itself, of mass 1 each, where a bond holds one clump and the ball together: two fragments, not four.
#[test]
fn the_spheres_of_a_clump_are_one_fragment() {
    let balls: Vec<_> = (0..5).map(|k| ball(f64::from(k), 0.0, 0.0, 0.5)).collect();
    let body = |grain: usize| Body { grain, centre: balls[grain].at, long: DVec3::X, short: DVec3::Z };
    let look = View {
        bodies: vec![body(0), body(2)],
        body_of: vec![Some(0), Some(0), Some(1), Some(1), None],
        bonds: vec![[3, 4]],
        ..view(&balls, Vec::new(), [None; 3])
    };
    let mut fragments = super::watch_of(3, SCENE, "fragments = {}");
    let sample = once(&mut *fragments, &look);
    assert_eq!(["bonds", "fragments", "largest"].map(|name| scalar(&*fragments, &sample, name)), [1.0, 2.0, 0.6]);
    // The control: who does not ask for bodies counts every sphere.
    let spheres = View { bodies: Vec::new(), body_of: Vec::new(), ..look };
    let sample = once(&mut *fragments, &spheres);
    assert_eq!(scalar(&*fragments, &sample, "fragments"), 4.0);
}
