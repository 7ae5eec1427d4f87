//! Superellipsoids and polyhedra in pictures: where a line of sight meets one.

use std::sync::Arc;
use tsubu_frame::{Frame, Kind, Values};

/// Steps of Newton's method along a line of sight; to a pixel two or three are enough, at the edge of a box more.
const STEPS: usize = 40;

/// A superellipsoid or polyhedron, turned to the viewer.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Directions of its axes: to the right, up, towards the viewer.
    axes: [[f64; 3]; 3],
    form: Form,
}

#[derive(Clone, Debug, PartialEq)]
enum Form {
    Superellipsoid {
        /// Semi-axes [m].
        semi_axes: [f64; 3],
        /// Exponents of profile and equator [-].
        exponents: [f64; 2],
    },
    /// With its diameter [m].
    Polyhedron(Arc<Faces>, f64),
}

/// The faces of a polyhedron of diameter 1.
#[derive(Clone, Debug, Default, PartialEq)]
struct Faces {
    /// Normals, and distances from the centre.
    planes: Vec<([f64; 3], f64)>,
    rounding: f64,
}

impl Solid {
    /// Those of a frame, one for each grain, `None` for a sphere; empty where all are.
    pub fn all(frame: &Frame, turn: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<Option<Self>> {
        let forms = Form::all(frame);
        let turned = match frame.column(Kind::Grain, "orientation").map(|column| &column.values) {
            Some(Values::Quaternion(turned)) if turned.len() == forms.len() => turned,
            _ => return Vec::new(),
        };
        let solid = |(form, turned): (Option<Form>, &[f64; 4])| {
            Some(Self { axes: [0, 1, 2].map(|k| turn(axis(*turned, k))), form: form? })
        };
        forms.into_iter().zip(turned).map(solid).collect()
    }

    /// Where the line of sight through (x, y) from the centre [m] meets it first: how near to the viewer [m], and the unit normal there.
    pub fn seen(&self, x: f64, y: f64, radius: f64) -> Option<(f64, [f64; 3])> {
        match &self.form {
            Form::Superellipsoid { semi_axes, exponents } => {
                let mut z = radius;
                for _ in 0..STEPS {
                    let (level, slope) = self.level([x, y, z], *semi_axes, *exponents);
                    // The level is convex along the line: from outside Newton's steps never go too far.
                    if level <= 1.0 + 1e-4 {
                        return Some((z, unit(slope)));
                    }
                    if slope[2] <= 0.0 || z < -radius {
                        return None;
                    }
                    z -= (level - 1.0) / slope[2];
                }
                None
            }
            Form::Polyhedron(faces, size) => self.faced(faces, *size, [x, y]),
        }
    }

    /// The same of a polyhedron. Within the rounding radius of an edge the normals of its faces are mixed; seen straight from above all sides of a polygon are.
    fn faced(&self, faces: &Faces, size: f64, [x, y]: [f64; 2]) -> Option<(f64, [f64; 3])> {
        let planes = || {
            faces.planes.iter().map(|(n, h)| {
                let turned: [f64; 3] = std::array::from_fn(|i| (0..3).map(|k| n[k] * self.axes[k][i]).sum());
                (turned, h * size)
            })
        };
        let (mut near, mut far) = (f64::INFINITY, f64::NEG_INFINITY);
        for ([nx, ny, nz], h) in planes() {
            let rest: f64 = h - nx * x - ny * y;
            if nz.abs() < 1e-9 {
                if rest < 0.0 {
                    return None;
                }
            } else if nz > 0.0 {
                near = near.min(rest / nz);
            } else {
                far = far.max(rest / nz);
            }
        }
        if near < far {
            return None;
        }
        let flat = near == f64::INFINITY;
        let (z, first) = if flat { (0.0, [0.0, 0.0, 1.0]) } else { (near, [0.0; 3]) };
        let edge = faces.rounding * size;
        let normal = planes().fold(first, |sum, (n, h): ([f64; 3], f64)| {
            let away = (h - n[0] * x - n[1] * y - n[2] * z) / edge;
            let share = (1.0 - away).clamp(0.0, 1.0).powi(2);
            std::array::from_fn(|i| sum[i] + share * n[i])
        });
        Some((z, unit(normal)))
    }

    /// ((|x/a|^r + |y/b|^r)^(p/r) + |z/c|^p)^(1/p) at a point from the centre, 1 on the surface, and its slope.
    fn level(&self, at: [f64; 3], semi_axes: [f64; 3], [p, r]: [f64; 2]) -> (f64, [f64; 3]) {
        let own: [f64; 3] =
            std::array::from_fn(|k| (0..3).map(|i| self.axes[k][i] * at[i]).sum::<f64>() / semi_axes[k]);
        let [x, y, z] = own.map(|part| part.abs().max(1e-12));
        let equator = (x.powf(r) + y.powf(r)).powf(1.0 / r);
        let level = (equator.powf(p) + z.powf(p)).powf(1.0 / p);
        let round = (equator / level).powf(p - 1.0);
        let by = [round * (x / equator).powf(r - 1.0), round * (y / equator).powf(r - 1.0), (z / level).powf(p - 1.0)];
        let by: [f64; 3] = std::array::from_fn(|k| by[k].copysign(own[k]) / semi_axes[k]);
        (level, std::array::from_fn(|i| (0..3).map(|k| by[k] * self.axes[k][i]).sum()))
    }
}

impl Form {
    /// Of the grains of a frame, `None` for a sphere; empty where all are.
    fn all(frame: &Frame) -> Vec<Option<Self>> {
        let semi_axes = frame.vectors(Kind::Grain, "semi-axes");
        let [profile, equator] = ["profile exponent", "equator exponent"].map(|name| frame.scalars(Kind::Grain, name));
        let round = |(i, semi_axes): (usize, &[f64; 3])| {
            let exponents = [profile, equator].map(|column| column.get(i).copied().unwrap_or(2.0));
            let round = semi_axes.iter().all(|axis| *axis == semi_axes[0]) && exponents == [2.0; 2];
            (!round).then_some(Self::Superellipsoid { semi_axes: *semi_axes, exponents })
        };
        let mut forms: Vec<Option<Self>> = semi_axes.iter().enumerate().map(round).collect();
        let (number, radius) = (frame.integers(Kind::Grain, "polyhedron"), frame.scalars(Kind::Grain, "radius"));
        let shapes = Faces::all(frame);
        forms.resize(forms.len().max(number.len()), None);
        for ((form, number), radius) in forms.iter_mut().zip(number).zip(radius) {
            if let Some(faces) = usize::try_from(*number).ok().and_then(|number| shapes.get(number)) {
                *form = Some(Self::Polyhedron(Arc::clone(faces), 2.0 * radius));
            }
        }
        forms
    }
}

impl Faces {
    /// Those of a frame by number.
    fn all(frame: &Frame) -> Vec<Arc<Self>> {
        let of = frame.integers(Kind::Global, "polyhedron of face");
        let normals = frame.vectors(Kind::Global, "polyhedron normal");
        let offsets = frame.scalars(Kind::Global, "polyhedron offset");
        let shape = |(number, rounding): (i64, &f64)| {
            let planes = of.iter().zip(normals.iter().zip(offsets)).filter(|(of, _)| **of == number);
            Arc::new(Self { planes: planes.map(|(_, (n, h))| (*n, *h)).collect(), rounding: *rounding })
        };
        (0..).zip(frame.scalars(Kind::Global, "polyhedron rounding")).map(shape).collect()
    }
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

/// Where an orientation (real part first) brings axis k.
fn axis([w, x, y, z]: [f64; 4], k: usize) -> [f64; 3] {
    match k {
        0 => [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        1 => [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
        _ => [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
    }
}

#[cfg(test)]
mod tests {
    use super::{Faces, Form, Solid};
    use std::sync::Arc;

    const ALONG: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    /// Nearly a box is seen in front at its face and past its edge not at all; an ellipsoid of the same size ends before the corner.
    #[test]
    fn a_line_of_sight_meets_what_is_there() {
        let body =
            |exponents| Solid { axes: ALONG, form: Form::Superellipsoid { semi_axes: [2.0, 1.0, 0.5], exponents } };
        let (z, normal) = body([8.0; 2]).seen(1.0, 0.5, 3.0).expect("the face");
        assert!((z - 0.5).abs() < 0.01 && normal[2] > 0.99, "{z} {normal:?}");
        assert!(body([8.0; 2]).seen(1.6, 0.8, 3.0).is_some() && body([2.0; 2]).seen(1.6, 0.8, 3.0).is_none());
        assert!(body([8.0; 2]).seen(2.1, 0.0, 3.0).is_none());
        let (z, _) = body([2.0; 2]).seen(1.0, 0.5, 3.0).expect("the ellipsoid");
        assert!((z - 0.5 * 0.5_f64.sqrt()).abs() < 1e-3, "{z}");
    }

    /// A cube that is seen along an edge shows its two faces, mixed at the edge; past its corner nothing. A square seen from above is flat.
    #[test]
    fn a_line_of_sight_meets_a_face() {
        let half = 0.5_f64.sqrt();
        let sides = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]];
        let square: Vec<_> = sides.into_iter().map(|n| (n, 0.25)).collect();
        let ends = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]].into_iter().map(|n| (n, 0.25));
        let body = |planes: Vec<_>, axes| Solid {
            axes,
            form: Form::Polyhedron(Arc::new(Faces { planes, rounding: 0.05 }), 2.0),
        };
        let cube = body(
            square.iter().copied().chain(ends).collect(),
            [[half, 0.0, half], [0.0, 1.0, 0.0], [-half, 0.0, half]],
        );
        let (z, normal) = cube.seen(0.0, 0.0, 1.0).expect("the edge");
        assert!((z - half).abs() < 1e-12 && (normal[2] - 1.0).abs() < 1e-12, "{z} {normal:?}");
        let (z, normal) = cube.seen(0.4, 0.0, 1.0).expect("a face");
        assert!((z - (half - 0.4)).abs() < 1e-12 && (normal[0] - half).abs() < 1e-12, "{z} {normal:?}");
        assert!(cube.seen(0.71, 0.0, 1.0).is_none() && cube.seen(0.0, 0.51, 1.0).is_none());
        let flat = body(square, ALONG);
        assert_eq!(flat.seen(0.3, 0.3, 1.0), Some((0.0, [0.0, 0.0, 1.0])));
        assert!(flat.seen(0.6, 0.0, 1.0).is_none());
    }
}
