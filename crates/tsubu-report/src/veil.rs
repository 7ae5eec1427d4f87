//! Walls in pictures of space: translucent faces and the lines where they bend or end.

use std::collections::HashMap;

use crate::balls::Balls;
use crate::canvas::Canvas;

/// Share of what is behind a face that it hides.
const FACE: f32 = 0.13;
/// The same for the last face before the ground, on which the shape of a terrain is seen.
const LAST: f32 = 0.42;
/// The same for a line.
const LINE: f32 = 0.8;
/// Cosine of the angle between neighbouring faces below which their edge is drawn.
const BEND: f64 = 0.85;
/// More faces than this are drawn without their lines: they would be a tangle.
const MOST_LINED: usize = 400_000;
/// Colours of walls and of the water's surface in full light, and where light comes from.
const TINT: [f32; 3] = [150.0, 172.0, 196.0];
const WATER: [f32; 3] = [86.0, 180.0, 233.0];
const LIGHT: [f64; 3] = [-0.43, 0.56, 0.708];

/// What lies before the grains, a pixel each: the share of light that passes, and the light added; and the light on the last
/// face before the ground of the picture, which hides nothing.
pub struct Veil {
    passes: Vec<f32>,
    adds: Vec<[f32; 3]>,
    /// Depth and light.
    last: Vec<(f32, [f32; 3])>,
}

type Point = [f64; 3];

impl Veil {
    /// Draws the walls before a canvas that has its grains.
    pub fn of(balls: &Balls, canvas: &Canvas) -> Self {
        let pixels = canvas.depth.len();
        let mut veil = Self {
            passes: vec![1.0; pixels],
            adds: vec![[0.0; 3]; pixels],
            last: vec![(f32::INFINITY, [0.0; 3]); pixels],
        };
        for face in &balls.faces {
            veil.face(canvas, face, TINT);
        }
        for surface in &balls.water {
            if let [a, b, c, d] = surface[..] {
                veil.face(canvas, &[a, b, c], WATER);
                veil.face(canvas, &[c, d, a], WATER);
            }
        }
        for outline in balls.outlines.iter().chain(&balls.water) {
            let closed = outline.iter().cycle().skip(1).take(if outline.len() > 2 { outline.len() } else { 1 });
            for (a, b) in outline.iter().zip(closed) {
                veil.line(canvas, a, b);
            }
        }
        if balls.faces.len() <= MOST_LINED {
            for [a, b] in edges(&balls.faces) {
                veil.line(canvas, &a, &b);
            }
        }
        veil
    }

    /// A pixel with its veil: colour times alpha, and alpha.
    pub fn over(&self, at: usize, colour: [f32; 3], alpha: f32) -> ([f32; 3], f32) {
        let (passes, adds) = (self.passes[at], self.adds[at]);
        let (depth, light) = self.last[at];
        let lit = alpha == 0.0 && depth.is_finite();
        let (colour, alpha) = if lit { (light.map(|c| c * LAST), LAST) } else { (colour, alpha) };
        let seen = std::array::from_fn(|k| adds[k] + colour[k] * passes);
        (seen, 1.0 - (1.0 - alpha) * passes)
    }

    fn lay(&mut self, at: usize, light: [f32; 3], hides: f32) {
        let adds = self.adds[at];
        self.adds[at] = std::array::from_fn(|k| adds[k] * (1.0 - hides) + light[k] * hides);
        self.passes[at] *= 1.0 - hides;
    }

    fn face(&mut self, canvas: &Canvas, corners: &[Point; 3], tint: [f32; 3]) {
        let [a, b, c] = corners.map(|p| canvas.place(&p));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let normal = normal(corners);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let facing = normal.iter().zip(LIGHT).map(|(n, l)| n * l).sum::<f64>().abs();
        let light = tint.map(|c| c * (0.3 + 0.7 * facing * facing) as f32);
        let span = |k: usize, end: usize| {
            let (low, high) = (a[k].min(b[k]).min(c[k]), a[k].max(b[k]).max(c[k]));
            (low - 0.5).ceil().clamp(0.0, end as f64) as usize..(high + 0.5).floor().clamp(0.0, end as f64) as usize
        };
        for row in span(1, canvas.height) {
            for column in span(0, canvas.width) {
                let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
                let part = |p: Point, q: Point| ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) / area;
                let (u, v, w) = (part(b, c), part(c, a), part(a, b));
                if u < 0.0 || v < 0.0 || w < 0.0 {
                    continue;
                }
                let at = row * canvas.width + column;
                let depth = (u * a[2] + v * b[2] + w * c[2]) as f32;
                if depth > canvas.depth[at] {
                    self.lay(at, light, FACE);
                }
                if tint != WATER && depth < self.last[at].0 {
                    self.last[at] = (depth, light);
                }
            }
        }
    }

    fn line(&mut self, canvas: &Canvas, a: &Point, b: &Point) {
        let (a, b) = (canvas.place(a), canvas.place(b));
        let length = (b[0] - a[0]).abs().max((b[1] - a[1]).abs());
        if !length.is_finite() || length > 1e5 {
            return;
        }
        let steps = length.ceil().max(1.0) as usize;
        let wide = canvas.fine as i64;
        for step in 0..=steps {
            let t = step as f64 / steps as f64;
            let p: Point = std::array::from_fn(|k| a[k] + t * (b[k] - a[k]));
            for k in 0..wide * wide {
                let x = p[0].floor() as i64 + k % wide - wide / 2;
                let y = p[1].floor() as i64 + k / wide - wide / 2;
                if x < 0 || y < 0 || x >= canvas.width as i64 || y >= canvas.height as i64 {
                    continue;
                }
                let at = y as usize * canvas.width + x as usize;
                // Steps overlap: a line is as dark as it gets, not darker where it is slow.
                if p[2] as f32 > canvas.depth[at] && self.passes[at] > 1.0 - LINE {
                    self.lay(at, TINT.map(|c| 0.45 * c), LINE);
                }
            }
        }
    }
}

fn normal([a, b, c]: &[Point; 3]) -> Point {
    let edge = |p: &Point, q: &Point| -> Point { std::array::from_fn(|k| q[k] - p[k]) };
    let (u, v) = (edge(a, b), edge(a, c));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
    n.map(|x| if length > 0.0 { x / length } else { 0.0 })
}

/// Edges of one face alone, and those where two faces meet at an angle.
fn edges(faces: &[[Point; 3]]) -> Vec<[Point; 2]> {
    type Corner = [u64; 3];
    let corner = |p: &Point| -> Corner { p.map(f64::to_bits) };
    let mut known: HashMap<[Corner; 2], ([Point; 2], Vec<Point>)> = HashMap::new();
    for face in faces {
        let normal = normal(face);
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let mut key = [corner(&face[i]), corner(&face[j])];
            key.sort_unstable();
            known.entry(key).or_insert_with(|| ([face[i], face[j]], Vec::new())).1.push(normal);
        }
    }
    let bent = |normals: &[Point]| {
        let [a, b] = normals else { return true };
        a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>().abs() < BEND
    };
    let mut list: Vec<_> = known.into_iter().filter(|(_, (_, normals))| bent(normals)).collect();
    // The same picture every time.
    list.sort_unstable_by_key(|(key, _)| *key);
    list.into_iter().map(|(_, (ends, _))| ends).collect()
}
