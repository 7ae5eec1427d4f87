//! What grains are drawn on: pixels with a depth.

use crate::solid::Solid;

/// What is drawn on: pixels finer than those of the picture.
pub(crate) struct Canvas {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Pixels of the canvas along one of the picture.
    pub fine: usize,
    /// Towards the viewer, in pixels; minus infinity where there is no grain.
    pub depth: Vec<f32>,
    /// Of the grain nearest to the viewer.
    pub colours: Vec<[u8; 3]>,
    corner: [f64; 2],
    scale: f64,
}

impl Canvas {
    /// An empty one for a window [m], and pixels of the picture.
    pub fn new(w: [f64; 4], width: usize, height: usize, fine: usize) -> Self {
        let margin = 0.03 * (w[2] - w[0]).max(w[3] - w[1]);
        let (width, height) = (width * fine, height * fine);
        let pixels = width * height;
        Self {
            width,
            height,
            fine,
            depth: vec![f32::NEG_INFINITY; pixels],
            colours: vec![[0; 3]; pixels],
            corner: [w[0] - margin, w[1] - margin],
            scale: width as f64 / (w[2] - w[0] + 2.0 * margin),
        }
    }

    /// From metres to pixels: right, down, towards the viewer.
    pub fn place(&self, p: &[f64; 3]) -> [f64; 3] {
        let up = (p[1] - self.corner[1]) * self.scale;
        [(p[0] - self.corner[0]) * self.scale, self.height as f64 - up, p[2] * self.scale]
    }

    /// A flat grain with a dark edge; `radius` is that of the disc of its area.
    pub fn flat(&mut self, line: impl Iterator<Item = [f64; 3]>, radius: f64, base: [u8; 3]) {
        let line: Vec<_> = line.map(|corner| self.place(&corner)).collect();
        let edge = (0.08 * radius * self.scale).max(0.3 * self.fine as f64);
        let ends = |k: usize| line.iter().fold((f64::MAX, f64::MIN), |e, c| (e.0.min(c[k]), e.1.max(c[k])));
        let ((left, right), (top, bottom)) = (ends(0), ends(1));
        let front = line.first().map_or(0.0, |corner| corner[2]) as f32;
        for row in span(f64::midpoint(top, bottom), 0.5 * (bottom - top), self.height) {
            for column in span(f64::midpoint(left, right), 0.5 * (right - left), self.width) {
                let (inside, near) = within(&line, column as f64 + 0.5, row as f64 + 0.5);
                let at = row * self.width + column;
                if inside && front > self.depth[at] {
                    self.depth[at] = front;
                    self.colours[at] = if near < edge { base.map(|c| (0.65 * f64::from(c)) as u8) } else { base };
                }
            }
        }
    }

    /// A shaded sphere.
    pub fn sphere(&mut self, centre: &[f64; 3], radius: f64, base: [u8; 3]) {
        let [x, y, front] = self.place(centre);
        // A grain smaller than a pixel still shows.
        let r = (radius * self.scale).max(0.5);
        for row in span(y, r, self.height) {
            let dy = (row as f64 + 0.5 - y) / r;
            let half = (1.0 - dy * dy).max(0.0).sqrt() * r;
            for column in span(x, half, self.width) {
                let dx = (column as f64 + 0.5 - x) / r;
                let dz = (1.0 - dx * dx - dy * dy).max(0.0).sqrt();
                let z = (front + dz * r) as f32;
                let at = row * self.width + column;
                if z > self.depth[at] {
                    self.depth[at] = z;
                    self.colours[at] = lit(base, dx, -dy, dz);
                }
            }
        }
    }

    /// A shaded superellipsoid that a sphere of a radius holds.
    pub fn solid(&mut self, centre: &[f64; 3], radius: f64, solid: &Solid, base: [u8; 3]) {
        let [x, y, front] = self.place(centre);
        let r = radius * self.scale;
        if r < 1.0 {
            return self.sphere(centre, radius, base);
        }
        for row in span(y, r, self.height) {
            let up = (y - row as f64 - 0.5) / self.scale;
            for column in span(x, r, self.width) {
                let right = (column as f64 + 0.5 - x) / self.scale;
                let Some((near, [nx, ny, nz])) = solid.seen(right, up, radius) else { continue };
                let z = (front + near * self.scale) as f32;
                let at = row * self.width + column;
                if z > self.depth[at] {
                    self.depth[at] = z;
                    self.colours[at] = lit(base, nx, ny, nz);
                }
            }
        }
    }
}

/// Whether a point lies inside a closed line, which its way to the right then crosses an odd number of times; and how far
/// off the nearest side is.
fn within(line: &[[f64; 3]], x: f64, y: f64) -> (bool, f64) {
    let (mut inside, mut near) = (false, f64::INFINITY);
    for (a, b) in line.iter().zip(line.iter().cycle().skip(1)) {
        let (along, down) = (b[0] - a[0], b[1] - a[1]);
        if (a[1] > y) != (b[1] > y) && a[0] + (y - a[1]) / down * along > x {
            inside = !inside;
        }
        let length = (along * along + down * down).max(f64::MIN_POSITIVE);
        let part = (((x - a[0]) * along + (y - a[1]) * down) / length).clamp(0.0, 1.0);
        near = near.min((x - a[0] - part * along).hypot(y - a[1] - part * down));
    }
    (inside, near)
}

fn span(middle: f64, half: f64, end: usize) -> std::ops::Range<usize> {
    let from = (middle - half).floor().clamp(0.0, end as f64) as usize;
    let to = (middle + half).ceil().clamp(0.0, end as f64) as usize;
    from..to
}

/// Light from the upper left, a soft edge, a small highlight.
fn lit(base: [u8; 3], x: f64, y: f64, z: f64) -> [u8; 3] {
    const LIGHT: [f64; 3] = [-0.43, 0.56, 0.708];
    let facing = (x * LIGHT[0] + y * LIGHT[1] + z * LIGHT[2]).max(0.0);
    let light = 0.42 + 0.62 * facing;
    let shine = 70.0 * facing.powi(24);
    let edge = if z < 0.25 { 0.72 + 1.12 * z } else { 1.0 };
    base.map(|c| (f64::from(c) * light * edge + shine).clamp(0.0, 255.0) as u8)
}
