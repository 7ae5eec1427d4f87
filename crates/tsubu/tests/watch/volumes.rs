//! Volumes of bodies that are no spheres, in the watches that ask for them.

use super::{column, near, once, scalar};
use std::f64::consts::PI;
use std::path::Path;
use tsubu::engine::Engine;
use tsubu::methods;
use tsubu::partner::Hosts;
use tsubu::view::Wants;
use tsubu::watch::{Sample, Watch, open};
use tsubu_scene::Scene;

const CUBE: &str = "polyhedron = { corners = [[-1, -1, -1], [1, -1, -1], [-1, 1, -1], [1, 1, -1], [-1, -1, 1], [1, -1, 1], [-1, 1, 1], [1, 1, 1]], rounding = 0.1";
const TETRAHEDRON: &str =
    "polyhedron = { corners = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], rounding = 1e-5";
const SQUARE: &str = "polygon = { corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]], rounding = 0.1, thickness = 3";
const ROD: &str = "clump = { centre = [[-1, 0, 0], [1, 0, 0]], diameter = [2.5, 2.5]";
const EGG: &str = "superellipsoid = { semi-axes = [2, 1.5, 1], exponents = [2, 2]";
const BOX: &str = "superellipsoid = { semi-axes = [2, 1.5, 1], exponents = [6, 4]";

/// Half diameter of the cube or square of side 2.
fn half(dimension: u32) -> f64 {
    0.9 * f64::from(dimension).sqrt() + 0.1
}

/// Volume of the rounded cube of side 2 (Steiner 1840), or area of the square.
fn rounded(dimension: u32) -> f64 {
    if dimension == 2 {
        4.0 - 0.01 * (4.0 - PI)
    } else {
        1.8_f64.powi(3) + 0.6 * 1.8 * 1.8 + 0.03 * PI * 1.8 + 0.004 / 3.0 * PI
    }
}

/// What a watch sees of bodies of one shape at the beginning of a scene.
fn seen(
    dimension: u32,
    shape: &str,
    diameter: f64,
    orientation: &str,
    more: &str,
    watch: &str,
) -> (Box<dyn Watch>, Sample) {
    let text = format!(
        "dimension = {dimension}\nduration = 1\ngravity = 0\n[materials.wood]\nyoung-modulus = 1e9\ndensity = 700\n[particles.bodies]\nmaterial = 'wood'\n\
         diameter = {diameter}\nshape.{shape}, orientation = '{orientation}' }}\n{more}\n[watch.w]\n{watch}\n"
    );
    let scene = Scene::parse("test", &text, Path::new("."), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
    let engine = methods::open(scene.plan(), &Hosts::default()).unwrap();
    let mut watch = open(&scene.plan().watch["w"].measure, scene.plan());
    let sample = once(&mut *watch, &Engine::view(&*engine, Wants::ALL));
    (watch, sample)
}

/// Places `step` apart, along all axes from `step` / 2 on, beside each other in a block.
fn block(dimension: u32, [across, up]: [u32; 2], step: f64) -> String {
    let at = |k: u32| (f64::from(k) + 0.5) * step;
    let mut places = Vec::new();
    for z in 0..up {
        for k in 0..across.pow(dimension - 1) {
            let (x, y) = (at(k % across), at(k / across));
            places.push(if dimension == 2 { format!("[{x}, {}]", at(z)) } else { format!("[{x}, {y}, {}]", at(z)) });
        }
    }
    format!("start.at.position = [{}]", places.join(", "))
}

/// Cubes and squares stacked side by side fill what their rounded edges leave, all of the stack, each layer and every slice of one. Spheres that hold them, and
/// have more than all of the volume, are refused.
#[test]
fn a_stack_of_cubes_is_as_solid_as_it_is() {
    for (dimension, shape) in [(2, SQUARE), (3, CUBE)] {
        let ends = if dimension == 2 { "low = [0, 0], high = [6, 8]" } else { "low = [0, 0, 0], high = [6, 6, 8]" };
        let exact = rounded(dimension) / 2.0_f64.powi(dimension as i32);
        for bins in [1, 4, 20] {
            let watch =
                format!("profile = {{ bins = {bins}, quantities = ['solid-fraction'], region = {{ {ends} }} }}");
            let stack = block(dimension, [3, 4], 2.0);
            let (watch, sample) = seen(dimension, shape, 2.0 * half(dimension), "as-drawn", &stack, &watch);
            let whole = scalar(&*watch, &sample, "solid fraction");
            assert!(near(whole, exact, 1e-9), "{dimension} {bins}: {whole} {exact}");
            let slices = column(&*watch, &sample, "solid fraction");
            assert!(slices.iter().all(|slice| near(*slice, exact, 1e-9)), "{slices:?} {exact}");
            let r = half(dimension);
            let held = if dimension == 2 { PI * r * r / 4.0 } else { PI / 6.0 * r.powi(3) };
            assert!(!near(whole, held, 0.1), "the control: {held}");
        }
    }
}

/// However bodies are turned, the shares of each sum up to its volume over all slices: of spheres that overlap in a clump what both have counts once.
#[test]
fn slices_share_out_the_volume_of_every_shape() {
    let (r, h) = (1.25_f64, 1.0_f64);
    let cap = r * r * (h / r).acos() - h * (r * r - h * h).sqrt();
    let ball = 2.0 / 3.0 * r.powi(3) + r * r * h - h.powi(3) / 3.0;
    let beta = |x: f64, y: f64| libm::tgamma(x) * libm::tgamma(y) / libm::tgamma(x + y);
    // Of exponents p and r (Jaklic, Leonardis and Solina 2000).
    let (e, f) = (2.0 / 6.0, 2.0 / 4.0);
    let boxy = 2.0 * 3.0 * e * f * beta(0.5 * e + 1.0, e) * beta(0.5 * f, 0.5 * f);
    // Of each the volume, and half the diameter in the same unit.
    let reach =
        |a: f64, b: f64, p: f64| (a.powf(2.0 * p / (p - 2.0)) + b.powf(2.0 * p / (p - 2.0))).powf(0.5 - 1.0 / p);
    let cases = [
        (2, SQUARE, rounded(2), half(2)),
        (2, ROD, 2.0 * (PI * r * r - cap), h + r),
        (3, CUBE, rounded(3), half(3)),
        (3, TETRAHEDRON, 8.0 / 3.0, 3.0_f64.sqrt()),
        (3, ROD, 2.0 * PI * ball, h + r),
        (3, EGG, 4.0 * PI, 2.0),
        (3, BOX, boxy, reach(reach(2.0, 1.5, 4.0), 1.0, 6.0)),
    ];
    for (dimension, shape, volume, half) in cases {
        let ends =
            if dimension == 2 { "low = [0, 0], high = [20, 20]" } else { "low = [0, 0, 0], high = [20, 20, 20]" };
        let region = 20.0_f64.powi(dimension as i32);
        let count = 5_u32.pow(dimension - 1) * 5;
        for bins in [1, 7, 100] {
            let watch =
                format!("profile = {{ bins = {bins}, quantities = ['solid-fraction'], region = {{ {ends} }} }}");
            // Each as large as a ball of diameter 4.
            let (watch, sample) = seen(dimension, shape, 3.999, "random", &block(dimension, [5, 5], 4.0), &watch);
            let unit = 0.5 * 3.999 / half;
            let exact = f64::from(count) * volume * unit.powi(dimension as i32) / region;
            let whole = scalar(&*watch, &sample, "solid fraction");
            assert!(near(whole, exact, 1e-4), "{shape} {bins}: {whole} {exact}");
            let slices = column(&*watch, &sample, "solid fraction");
            assert!(near(slices.iter().sum::<f64>() / f64::from(bins), whole, 1e-12), "{shape} {bins}");
            let spheres =
                f64::from(count) * if dimension == 2 { PI / 4.0 } else { PI / 6.0 } * 3.999_f64.powi(dimension as i32)
                    / region;
            assert!(!near(whole, spheres, 0.1), "the control: {shape} {whole} {spheres}");
        }
    }
}

/// One cube, pressed a little by six planes: what its edges leave is the porosity, and the box is as far as the planes stand, not the sphere that holds it.
#[test]
fn a_cube_between_planes_leaves_little_room() {
    let side: f64 = 2.0 - 2e-4;
    let mut planes = String::new();
    for (k, axis) in ["x", "y", "z"].iter().enumerate() {
        let mut far = [0.0; 3];
        far[k] = side;
        let wall = |end: &str, normal: &str, at: [f64; 3]| {
            format!(
                "[walls.{end}{k}]\nmaterial = 'wood'\nshape.plane = {{ point = {at:?}, normal = '{normal}{axis}' }}\n"
            )
        };
        planes.extend([wall("a", "", [0.0; 3]), wall("b", "-", far)]);
    }
    let middle = 0.5 * side;
    let more = format!("start.at.position = [[{middle}, {middle}, {middle}]]\n{planes}");
    let (watch, sample) = seen(3, CUBE, 2.0 * half(3), "as-drawn", &more, "stress-path = {}");
    let (porosity, exact) = (scalar(&*watch, &sample, "porosity"), 1.0 - rounded(3) / side.powi(3));
    assert!((porosity - exact).abs() < 1e-9, "{porosity} {exact}");
    // The control: the volume of the sphere would be more than all of the box.
    assert!(1.0 - 4.0 / 3.0 * PI * half(3).powi(3) / side.powi(3) < 0.0);
}

/// Bodies that go along a bed carry their volumes with them; in the plane with `width` what is as thick as it is.
#[test]
fn bedload_is_of_volumes_by_shape() {
    let carried = |dimension: u32, shape: &str, width: &str, half: f64| {
        let (low, high) = if dimension == 2 { ("[0, 0]", "[20, 20]") } else { ("[0, 0, 0]", "[20, 20, 20]") };
        let (at, by) = if dimension == 2 { ("[9, 9]", "[2, 0]") } else { ("[9, 9, 9]", "[2, 0, 0]") };
        let start = format!("start.at = {{ position = [{at}], velocity = [{by}] }}");
        let watch = format!("bedload = {{ region = {{ low = {low}, high = {high} }} {width} }}");
        let (watch, sample) = seen(dimension, shape, 2.0 * half, "random", &start, &watch);
        scalar(&*watch, &sample, "transport rate") * 20.0_f64.powi(dimension as i32 - 1) / 2.0
    };
    let (r, h) = (1.25_f64, 1.0_f64);
    assert!(near(carried(3, EGG, "", 2.0), 4.0 * PI, 1e-9));
    assert!(near(carried(3, CUBE, "", half(3)), rounded(3), 1e-9));
    assert!(near(carried(3, ROD, "", r + h), 2.0 * PI * (2.0 / 3.0 * r.powi(3) + r * r * h - h.powi(3) / 3.0), 1e-9));
    assert!(near(carried(2, SQUARE, "", half(2)), rounded(2), 1e-9));
    assert!(near(carried(2, SQUARE, ", width = 6", half(2)), 0.5 * rounded(2), 1e-9));
    assert!(!near(carried(3, EGG, "", 2.0), 4.0 / 3.0 * PI * 8.0, 0.1), "the control: no sphere");
}
