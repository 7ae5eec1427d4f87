//! Watches of bodies that are no spheres: by which numbers grains go, and how far they reach.

use super::{Ball, ball, column, on_wall, once, plan, scalar, view, watch, watch_of};
use crate::dem::open_text;
use glam::DVec3;
use tsubu::view::{Contact, View, Wants};
use tsubu::watch::open;
use tsubu_frame::State;

/// Two clumps of three spheres, and a ball.
const CLUMPS: &str = "[particles.a]\nmaterial = \"glass\"\ndiameter = 1\n\
                      shape.clump = { centre = [[-1, 0, 0], [0, 0, 0], [1, 0, 0]], diameter = [1, 1, 1] }\n\
                      start.at.position = [[0, 0, 0], [0, 0, 5]]\n\
                      [particles.b]\nmaterial = \"glass\"\ndiameter = 1\nstart.at.position = [[9, 0, 0]]\n";

/// Seven grains in a row, of which the last is the ball.
fn row() -> View<'static> {
    let balls: Vec<Ball> = (0..7).map(|k| ball(f64::from(k), 0.0, 0.0, 0.1)).collect();
    view(&balls, Vec::new(), [None; 3])
}

/// Grains of a group were counted from the number of clumps before it, not from that of their spheres: a sphere of a clump was followed for
/// the ball, and grains that are there were refused.
#[test]
fn grains_behind_clumps_are_found_by_their_numbers() {
    let mut behind = watch_of(3, CLUMPS, "track = { ids = [0], group = \"b\" }");
    let sample = once(&mut *behind, &row());
    assert_eq!(column(&*behind, &sample, "id"), [6.0]);
    let mut all = watch_of(3, CLUMPS, "track = { ids = [6] }");
    let sample = once(&mut *all, &row());
    assert_eq!(column(&*all, &sample, "position x"), [6.0]);
}

/// A run with clumps and a `hops` watch could not go on: its courses name spheres, and were held against the number of clumps.
#[test]
fn hops_of_clumps_go_on() {
    let plan = plan(3, CLUMPS, "hops = { bed = [\"free-grains\"] }");
    let mut hops = open(&plan.watch["w"].measure, &plan);
    once(&mut *hops, &row());
    let mut state = State::default();
    hops.save("w", &mut state);
    let mut again = open(&plan.watch["w"].measure, &plan);
    again.load("w", &state).unwrap();
}

/// Four squares that lie on a floor: their surface was that of the balls that hold them, a fifth too high, and so was their front too far.
#[test]
fn squares_reach_as_far_as_their_sides() {
    let squares = r#"
        dimension = 2
        gravity = 0
        duration = 1
        [materials.glass]
        young-modulus = 1e7
        density = 2500
        [particles.squares]
        material = "glass"
        diameter = "10 mm"
        shape.polygon = { corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]], rounding = 0.1, thickness = "1 mm", orientation = "as-drawn" }
        start.at.position = [[0, "4 mm"], ["15 mm", "4 mm"], ["30 mm", "4 mm"], ["45 mm", "4 mm"]]
    "#;
    let (engine, ..) = open_text(squares, &[]);
    let seen = engine.view(Wants::GRAINS);
    let [low, high] = seen.ends(0, 2);
    let held = seen.grains.radius[0];
    assert!(high < 0.9 * held && (low + high).abs() < 1e-12, "{low} {high} of {held}");
    let top = |seen: &View| {
        let mut slope =
            watch(2, "slope = { bins = 4, touching = false, region = { low = [-7.5e-3, 0], high = [52.5e-3, 1] } }");
        let sample = once(&mut *slope, seen);
        scalar(&*slope, &sample, "surface height")
    };
    assert!((top(&seen) - (4e-3 + high)).abs() < 1e-12, "{}", top(&seen));
    // The control: of balls it is the radius.
    let balls = View { shapes: None, ..seen };
    assert!((top(&balls) - (4e-3 + held)).abs() < 1e-12, "{}", top(&balls));
    // On a floor, which is what the front goes by.
    let on_floor: Vec<Ball> = (0..4).map(|k| ball(15e-3 * f64::from(k), 0.0, 4e-3, held)).collect();
    let contact = |i| Contact { overlap: 1e-6, ..on_wall(&on_floor, i, -4e-3 * DVec3::Z, DVec3::Z) };
    let seen = View { contacts: (0..4).map(contact).collect(), ..engine.view(Wants::GRAINS) };
    let ends = |seen: &View| {
        let text = "run-out = { direction = \"x\", bins = 4, region = { low = [-7.5e-3, 0], high = [52.5e-3, 1] } }";
        let mut run_out = watch(2, text);
        let sample = once(&mut *run_out, seen);
        ["front", "deposit height"].map(|name| scalar(&*run_out, &sample, name))
    };
    let off = |[front, height]: [f64; 2], reach: f64| (front - 45e-3 - reach).abs().max((height - 4e-3 - reach).abs());
    assert!(off(ends(&seen), high) < 1e-12, "{:?}", ends(&seen));
    let balls = View { shapes: None, ..seen };
    assert!(off(ends(&balls), held) < 1e-12, "{:?}", ends(&balls));
}

/// One grain in every cell is as mixed as it is apart: the index was minus infinity.
#[test]
fn cells_of_one_grain_have_no_index() {
    let balls: Vec<Ball> = (0..4).map(|k| Ball { group: k % 2, ..ball(f64::from(k) + 0.5, 0.5, 0.5, 0.1) }).collect();
    let index = |cell: f64| {
        let mut mixed = watch_of(2, super::GROUPS, &format!("segregation = {{ cell = {cell} }}"));
        let sample = once(&mut *mixed, &view(&balls, Vec::new(), [None; 3]));
        scalar(&*mixed, &sample, "Lacey index")
    };
    assert!(index(1.0).is_nan());
    assert!(index(2.0).is_finite());
}
