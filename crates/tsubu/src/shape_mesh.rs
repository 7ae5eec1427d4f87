//! Meshes of the bodies of a scene, for programs that draw a mesh at every row of a frame.
//!
//! A group has one shape, in any size: one mesh of radius 1 along the principal axes. Times `radius`, turned by `orientation` and put at
//! `position`, it is the grain. Normals are those of the surface, not of the facets.

use glam::DVec3;
use std::f64::consts::{PI, TAU};
use tsubu_frame::{FileError, Frame, Kind, RunFolder, vtp};
use tsubu_scene::Scene;
use tsubu_scene::plan::{Clump, Polyhedron, Superellipsoid};

/// Parts of a quarter of a turn that a round edge is drawn with.
const QUARTER: f64 = 5.0;
/// Rows of facets from pole to pole of a superellipsoid.
const ROWS: u32 = 32;

/// A point of a surface, and the normal there.
type Vertex = (DVec3, DVec3);

/// A body that is neither a sphere nor made of spheres.
enum Body {
    Superellipsoid(Superellipsoid),
    Polyhedron(Polyhedron),
}

impl Body {
    fn of(clump: Clump) -> Option<Self> {
        clump.superellipsoid.map(Self::Superellipsoid).or(clump.polyhedron.map(Self::Polyhedron))
    }

    fn facets(&self) -> Vec<Vec<Vertex>> {
        match self {
            Self::Superellipsoid(body) => of_superellipsoid(body),
            Self::Polyhedron(body) if body.edges.is_empty() => vec![of_polygon(body)],
            Self::Polyhedron(body) => of_polyhedron(body),
        }
    }
}

/// The groups of a scene with frames that have a mesh, and what is drawn of each.
fn drawn(scene: &Scene) -> impl Iterator<Item = (String, Body)> {
    let frames = scene.plans().iter().any(|plan| plan.output.frame_interval.is_some());
    let groups = scene.plan().particles.iter().enumerate().filter(move |_| frames);
    groups.filter_map(move |(number, (name, group))| {
        let safe = |c: char| if c.is_alphanumeric() || c == '-' { c } else { '_' };
        let name = format!("shapes/{number}-{}.vtp", name.chars().map(safe).collect::<String>());
        Some((name, Body::of(group.shape.clump()?)?))
    })
}

/// The files that [`write`] writes: `shapes/` with the number of the group, as in frames, and its name.
pub(crate) fn names(scene: &Scene) -> Vec<String> {
    drawn(scene).map(|(name, _)| name).collect()
}

/// Writes the meshes of a scene into a folder that knows their names.
pub(crate) fn write(folder: &RunFolder, scene: &Scene) -> Result<(), FileError> {
    for (name, body) in drawn(scene) {
        vtp::write(&folder.file(&name), &frame(&body.facets()), Kind::Surface)?;
    }
    Ok(())
}

/// The facets, of a body of diameter 1, as polygons of one of radius 1.
fn frame(facets: &[Vec<Vertex>]) -> Frame {
    let mut frame = Frame::default();
    let corners = || facets.iter().flatten();
    let outline = (0..).zip(facets).flat_map(|(number, facet)| facet.iter().map(move |_| number));
    frame.vector(Kind::Surface, "position", "-", corners().map(|(point, _)| (2.0 * *point).to_array()).collect());
    frame.vector(Kind::Surface, "Normals", "-", corners().map(|(_, normal)| normal.to_array()).collect());
    frame.integer(Kind::Surface, "outline", "-", outline.collect());
    frame.integer(Kind::Surface, "face", "-", vec![1; corners().count()]);
    frame
}

/// Facets along circles of latitude about z and of longitude, where rays from the middle leave the body.
fn of_superellipsoid(body: &Superellipsoid) -> Vec<Vec<Vertex>> {
    let axes = DVec3::from_array(body.semi_axes);
    let [p, r] = body.exponents;
    let vertex = |row: u32, column: u32| {
        let (theta, phi) = (PI * f64::from(row) / f64::from(ROWS), PI * f64::from(column) / f64::from(ROWS));
        let ray = axes * DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
        let at = (ray / axes).abs();
        let equator = at.x.powf(r) + at.y.powf(r);
        let ray = ray / (equator.powf(p / r) + at.z.powf(p)).powf(1.0 / p);
        let at = ray / axes;
        let equator = at.x.abs().powf(r) + at.y.abs().powf(r);
        // On the axis z the equator's share of the slope is nothing times infinity, where r is above p.
        let inner = if equator > 0.0 { equator.powf(p / r - 1.0) } else { 0.0 };
        let steep = |x: f64, exponent: f64| x.signum() * x.abs().powf(exponent - 1.0);
        let slope = DVec3::new(inner * steep(at.x, r), inner * steep(at.y, r), steep(at.z, p)) / axes;
        (ray, slope.normalize())
    };
    let facets = (0..ROWS).flat_map(|row| (0..2 * ROWS).map(move |column| (row, column)));
    facets
        .map(|(row, column)| {
            let [a, b, c, d] = [(row, column), (row + 1, column), (row + 1, column + 1), (row, column + 1)];
            let round = match row {
                0 => vec![a, b, c],
                row if row + 1 == ROWS => vec![a, b, d],
                _ => vec![a, b, c, d],
            };
            round.into_iter().map(|(row, column)| vertex(row, column)).collect()
        })
        .collect()
}

/// The corners of a polygon one after the other, rounded.
fn of_polygon(body: &Polyhedron) -> Vec<Vertex> {
    let normal = |side: usize| DVec3::from_array(body.faces[side].normal);
    let angle = |side: &usize| normal(*side).z.atan2(normal(*side).x);
    let mut sides: Vec<usize> = (0..body.faces.len()).collect();
    sides.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    let mut outline = Vec::new();
    for (k, &side) in sides.iter().enumerate() {
        let next = sides[(k + 1) % sides.len()];
        let shared = body.faces[side].corners.iter().find(|corner| body.faces[next].corners.contains(corner));
        let corner = shared.map_or(DVec3::ZERO, |corner| DVec3::from_array(body.corners[*corner]));
        outline.extend(arc(normal(side), normal(next)).into_iter().map(|n| (corner + body.rounding * n, DVec3::NEG_Y)));
    }
    outline
}

/// Faces as they are, edges as parts of cylinders, corners as parts of a sphere.
fn of_polyhedron(body: &Polyhedron) -> Vec<Vec<Vertex>> {
    let corner = |k: usize| DVec3::from_array(body.corners[k]);
    let normal = |face: usize| DVec3::from_array(body.faces[face].normal);
    let at = |k: usize, n: DVec3| (corner(k) + body.rounding * n, n);
    let faces =
        (0..body.faces.len()).map(|face| body.faces[face].corners.iter().map(|&k| at(k, normal(face))).collect());
    let mut facets: Vec<Vec<Vertex>> = faces.collect();
    for face in 0..body.faces.len() {
        let round = &body.faces[face].corners;
        for (k, &first) in round.iter().enumerate() {
            let second = round[(k + 1) % round.len()];
            // Each edge from one of its faces: that with the lower number.
            let Some(other) = next_face(body, second, first).filter(|other| *other > face) else { continue };
            let way = arc(normal(face), normal(other));
            facets.extend(
                way.windows(2).map(|n| vec![at(second, n[0]), at(first, n[0]), at(first, n[1]), at(second, n[1])]),
            );
        }
    }
    for k in 0..body.corners.len() {
        facets
            .extend(cap(&round_corner(body, k)).into_iter().map(|facet| facet.into_iter().map(|n| at(k, n)).collect()));
    }
    facets
}

/// The face round which corner `second` follows corner `first`.
fn next_face(body: &Polyhedron, first: usize, second: usize) -> Option<usize> {
    body.faces.iter().position(|face| {
        let next = face.corners.iter().cycle().skip(1);
        face.corners.iter().zip(next).any(|(a, b)| [*a, *b] == [first, second])
    })
}

/// The normals of the faces at a corner and of the edges between them, one after the other counter-clockwise from outside.
fn round_corner(body: &Polyhedron, corner: usize) -> Vec<DVec3> {
    let normal = |face: usize| DVec3::from_array(body.faces[face].normal);
    let first = body.faces.iter().position(|face| face.corners.contains(&corner));
    let mut round = Vec::new();
    let mut face = first;
    while let Some(now) = face {
        let corners = &body.faces[now].corners;
        let here = corners.iter().position(|k| *k == corner).unwrap_or_default();
        let before = corners[(here + corners.len() - 1) % corners.len()];
        let next = next_face(body, corner, before);
        if let Some(next) = next {
            let mut way = arc(normal(now), normal(next));
            way.pop();
            round.extend(way);
        }
        // A corner has no more faces than there are.
        face = next.filter(|next| Some(*next) != first && round.len() < 64 * body.faces.len());
    }
    round
}

/// Part of a unit sphere within these directions, in rings about the middle of them.
fn cap(round: &[DVec3]) -> Vec<Vec<DVec3>> {
    let middle = round.iter().sum::<DVec3>().normalize_or_zero();
    let widest = round.iter().map(|n| middle.angle_between(*n)).fold(0.0, f64::max);
    let rings = parts(widest);
    let ring = |k: u32, n: DVec3| middle.lerp(n, f64::from(k) / f64::from(rings)).normalize_or_zero();
    let sides = round.iter().zip(round.iter().cycle().skip(1));
    let sectors = sides.flat_map(|(&a, &b)| {
        (0..rings).map(move |k| match k {
            0 => vec![middle, ring(1, a), ring(1, b)],
            k => vec![ring(k, a), ring(k + 1, a), ring(k + 1, b), ring(k, b)],
        })
    });
    sectors.collect()
}

/// Directions from one to another, both with them, on the shortest way.
fn arc(from: DVec3, to: DVec3) -> Vec<DVec3> {
    let angle = from.angle_between(to);
    let count = parts(angle);
    let between = |k: u32| {
        let share = f64::from(k) / f64::from(count);
        (from * ((1.0 - share) * angle).sin() + to * (share * angle).sin()) / angle.sin()
    };
    std::iter::once(from).chain((1..count).map(between)).chain([to]).collect()
}

/// How many parts an angle is drawn in.
fn parts(angle: f64) -> u32 {
    (4.0 * QUARTER * angle / TAU).ceil().max(1.0) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use std::path::Path;

    /// The body of a group of one grain in space, and in the plane.
    fn body(shape: &str, plane: bool) -> Clump {
        let dimension = if plane { 2 } else { 3 };
        let text = format!(
            "method = \"dem\"\ndimension = {dimension}\nduration = 1.0\n[materials.stone]\ndensity = 2600\nyoung-modulus = 1e7\n[contact.normal.hertz]\n\
             [particles.one]\nmaterial = \"stone\"\ndiameter = 0.1\n[particles.one.start.at]\nposition = [[0, 0, 0]]\n[particles.one.shape.{shape}\n"
        );
        let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|wrong| panic!("{wrong}"));
        scene.plan().particles["one"].shape.clump().expect("a body")
    }

    /// Volume within facets, and how many of their edges no other has the other way round.
    fn volume_and_open_edges(facets: &[Vec<Vertex>]) -> (f64, usize) {
        let key = |point: DVec3| (point * 1e9).round().to_array().map(|x| x as i64);
        let sides = |facet: &Vec<Vertex>| {
            let round: Vec<_> = facet.iter().map(|(point, _)| key(*point)).collect();
            (0..round.len()).map(|k| [round[k], round[(k + 1) % round.len()]]).collect::<Vec<_>>()
        };
        let of = |facet: &Vec<Vertex>| {
            let first = facet[0].0;
            facet.windows(2).map(|v| first.dot(v[0].0.cross(v[1].0)) / 6.0).sum::<f64>()
        };
        let all: BTreeSet<_> = facets.iter().flat_map(sides).collect();
        let open = all.iter().filter(|[a, b]| !all.contains(&[*b, *a])).count();
        (facets.iter().map(of).sum(), open)
    }

    /// Closed, outwards, and as large as the body but for what round parts lose to facets. Without its caps a cube has holes.
    #[test]
    fn meshes_are_closed_and_as_large_as_the_body() {
        let cube = "polyhedron]\nrounding = 0.1\ncorners = [[-1,-1,-1],[1,-1,-1],[-1,1,-1],[1,1,-1],[-1,-1,1],[1,-1,1],[-1,1,1],[1,1,1]]";
        let wedge = "polyhedron]\nrounding = 0.2\ncorners = [[0,0,0],[2,0,0],[0,3,0],[2,3,0],[0,0,1],[0,3,1]]";
        for shape in [cube, wedge] {
            let clump = body(shape, false);
            let polyhedron = clump.polyhedron.expect("a polyhedron");
            let facets = of_polyhedron(&polyhedron);
            let (volume, open) = volume_and_open_edges(&facets);
            assert_eq!(open, 0);
            assert!(volume < clump.volume && volume > 0.99 * clump.volume, "{volume} of {}", clump.volume);
            let open: Vec<_> = facets.iter().filter(|facet| facet.len() > 3).cloned().collect();
            assert!(volume_and_open_edges(&open).1 > 0);
        }
        for exponents in ["[2, 2]", "[8, 8]", "[2, 6]", "[6, 2]"] {
            let clump = body(&format!("superellipsoid]\nsemi-axes = [3, 2, 1]\nexponents = {exponents}"), false);
            let facets = of_superellipsoid(&clump.superellipsoid.expect("a superellipsoid"));
            let (volume, open) = volume_and_open_edges(&facets);
            assert_eq!(open, 0, "{exponents}");
            assert!(volume < clump.volume && volume > 0.98 * clump.volume, "{exponents}: {volume} of {}", clump.volume);
        }
    }

    /// A polygon has the area of the body, and goes round it.
    #[test]
    fn a_polygon_is_its_outline() {
        let clump =
            body("polygon]\nrounding = 0.1\nthickness = 0.01\ncorners = [[0,0,0],[2,0,0],[2,0,1],[0,0,1.5]]", true);
        let outline = of_polygon(&clump.polyhedron.expect("a polygon"));
        let next = outline.iter().cycle().skip(1);
        let area: f64 = outline.iter().zip(next).map(|((a, _), (b, _))| 0.5 * (a.x * b.z - a.z * b.x)).sum();
        assert!(area < clump.volume && area > 0.995 * clump.volume, "{area} of {}", clump.volume);
    }
}
