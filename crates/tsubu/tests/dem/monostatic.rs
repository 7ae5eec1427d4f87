//! A body of one material that rests on one face alone.
//!
//! The solid of Conway and Guy (1969, SIAM Review 11, 78): a prism whose section is a double spiral of right-angled triangles about a point O, each a turn of pi / 9 on from the one before and shorter by the cosine of that, closed by
//! one side; 17 sides, and two oblique ends. O is straight above the lower end of each side but the last, so with a centre of mass below O the body rolls on from each to the next, down to the last. The ends make it heavy below.
//! A body that is round everywhere, as the Gömböc of Várkonyi and Domokos (2006), has more corners as a polyhedron than one may have here.

use super::open_text;
use glam::{DMat3, DQuat, DVec3};
use std::f64::consts::PI;
use tsubu::engine::Engine;
use tsubu::partner::Hosts;
use tsubu_frame::{Frame, Kind, Values};

const TURN: f64 = PI / 9.0;
const ROUNDING: f64 = 0.03;

/// The corners, O at the origin; at the height z ends are `slope` (`top` - z) from the middle, or as far where it is cut `straight`.
fn solid(straight: bool) -> Vec<DVec3> {
    let (slope, top) = (6.5, 1.03);
    let section = (-8..=8).map(|k: i32| {
        let radius = TURN.cos().powi(k.abs());
        let angle = TURN * f64::from(k);
        (radius * angle.sin(), radius * angle.cos())
    });
    let length = |z: f64| slope * (top - if straight { 0.0 } else { z });
    section.flat_map(|(x, z)| [-1.0, 1.0].map(|side| DVec3::new(x, side * length(z), z))).collect()
}

fn scene(corners: &[DVec3], height: f64) -> String {
    let corners: Vec<[f64; 3]> = corners.iter().map(DVec3::to_array).collect();
    format!(
        r#"
dimension = 3
duration = "10 s"
gravity = 9.81
[materials.wood]
young-modulus = "100 MPa"
poisson-ratio = 0.3
density = "700 kg/m^3"
restitution = 0.3
friction = 0.5
[dem]
largest-overlap = 0.5
[particles.solid]
material = "wood"
diameter = "100 mm"
shape.polyhedron = {{ corners = {corners:?}, rounding = {ROUNDING}, orientation = "as-drawn" }}
start.at = {{ position = [[0, 0, {height}]] }}
[walls.floor]
material = "wood"
shape.plane = {{ point = [0, 0, 0], normal = [0, 0, 1] }}
"#
    )
}

/// What a frame tells of the one body: normals of its faces as it is turned, and their distances from the centre of mass [m].
struct Faces {
    normals: Vec<DVec3>,
    heights: Vec<f64>,
    rounding: f64,
}

impl Faces {
    fn of(frame: &Frame) -> Self {
        let Some(Values::Quaternion(turned)) = frame.column(Kind::Grain, "orientation").map(|column| &column.values)
        else {
            panic!("no orientation")
        };
        let [w, x, y, z] = turned[0];
        let turned = DQuat::from_xyzw(x, y, z, w);
        let size = 2.0 * frame.scalars(Kind::Grain, "radius")[0];
        let normals = frame.vectors(Kind::Global, "polyhedron normal").iter();
        Self {
            normals: normals.map(|normal| turned * DVec3::from_array(*normal)).collect(),
            heights: frame.scalars(Kind::Global, "polyhedron offset").iter().map(|offset| offset * size).collect(),
            rounding: frame.scalars(Kind::Global, "polyhedron rounding")[0] * size,
        }
    }

    /// Whether the centre of mass is straight above the flat part of a face.
    fn is_stable(&self, face: usize) -> bool {
        let foot = self.normals[face] * (self.heights[face] - self.rounding);
        self.normals.iter().zip(&self.heights).all(|(n, height)| n.dot(foot) <= height - self.rounding + 1e-12)
    }

    /// The face that is turned down, and how far it is from lying flat [rad].
    fn lowest(&self) -> (usize, f64) {
        let down = |face: &usize| -self.normals[*face].z;
        let lowest = (0..self.normals.len()).max_by(|a, b| down(a).total_cmp(&down(b))).unwrap();
        (lowest, self.normals[lowest].angle_between(-DVec3::Z))
    }
}

fn faces(engine: &dyn Engine) -> Faces {
    Faces::of(&engine.frame(&Hosts::default()))
}

/// Lays a body on each of its faces, but for those whose mirror image is another, and lets it go. Gives, face by face, whether it was stable there, whether it lies on a stable face after `seconds`, and whether on that on which it was laid.
fn laid(corners: &[DVec3], seconds: f64) -> Vec<[bool; 3]> {
    let drawn = faces(&*open_text(&scene(corners, 1.0), &[]).0);
    let lay = |face: usize| {
        let turn = DMat3::from_quat(DQuat::from_rotation_arc(drawn.normals[face], -DVec3::Z));
        let corners: Vec<DVec3> = corners.iter().map(|corner| turn * *corner).collect();
        let (mut engine, mut hosts, mut ledger) = open_text(&scene(&corners, drawn.heights[face]), &[]);
        let begin = faces(&*engine);
        let (on, off) = begin.lowest();
        assert!(off < 1e-6);
        let steps = (seconds / engine.time_step()) as u64;
        engine.advance(steps, &mut hosts, &mut ledger).unwrap();
        let end = faces(&*engine);
        let (lies_on, off) = end.lowest();
        let spin = DVec3::from_array(engine.frame(&Hosts::default()).vectors(Kind::Grain, "spin")[0]);
        // Where the centre of mass is near the end of a face its corners give way unequally. Faces are 0.35 apart.
        assert!(off < 0.01 && spin.length() < 0.01, "{face} is at rest: {off} {spin}");
        [begin.is_stable(on), end.is_stable(lies_on), on == lies_on]
    };
    (0..drawn.normals.len()).filter(|face| drawn.normals[*face].truncate().min_element() > -1e-9).map(lay).collect()
}

/// Of 19 faces the solid has one on which it can stand, and laid on any of them it comes to rest on that one. The same prism with straight ends, whose centre of mass is above O, stays on several.
#[test]
fn the_solid_of_conway_and_guy_rests_on_one_face() {
    let drawn = faces(&*open_text(&scene(&solid(false), 1.0), &[]).0);
    let stable = (0..drawn.normals.len()).filter(|face| drawn.is_stable(*face)).count();
    assert_eq!((drawn.normals.len(), stable), (19, 1));
    let oblique = laid(&solid(false), 3.0);
    assert_eq!(oblique.len(), 10);
    assert!(oblique.iter().all(|[_, ends_stable, _]| *ends_stable));
    assert_eq!(oblique.iter().filter(|[.., same]| *same).count(), 1);
    let straight = laid(&solid(true), 3.0);
    assert!(straight.iter().filter(|[stable, _, same]| *stable && *same).count() > 2, "{straight:?}");
}
