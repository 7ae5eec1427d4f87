//! Walls, and the cell where the world repeats, as they are drawn in frames.

use super::engine::DemEngine;
use crate::wall::Outline;
use glam::DVec3;
use tsubu_frame::{Frame, Kind};

impl DemEngine {
    /// Adds lines and faces of all walls to a frame, and the cell of periodic axes.
    pub(super) fn draw_walls(&self, frame: &mut Frame) {
        let bounded = self.walls.iter().enumerate().filter(|(_, wall)| wall.lone_plane().is_none());
        let outlines: Vec<(usize, Outline)> = bounded.map(|(number, wall)| (number, wall.outline())).collect();
        // Endless planes are drawn as far as there is something else to see.
        let mut seen = Extent::default();
        for (p, r) in self.grains.position.iter().zip(&self.grains.radius) {
            seen.add(*p, *r);
        }
        let corners = |outline: &Outline| {
            let lines = outline.lines.iter().flatten().copied();
            lines.chain(outline.triangles.iter().flatten().copied()).collect::<Vec<_>>()
        };
        outlines.iter().flat_map(|(_, outline)| corners(outline)).for_each(|p| seen.add(p, 0.0));
        let planes = self.walls.iter().enumerate().filter_map(|(number, wall)| {
            let (point, normal) = wall.lone_plane()?;
            let (middle, half) = seen.round()?;
            Some((number, Outline::of_plane(point, normal, middle, half, self.limits.in_space)))
        });
        let mut drawn = Drawn::default();
        for (number, outline) in &outlines {
            drawn.add(*number, outline, false);
        }
        for (number, outline) in planes {
            drawn.add(number, &outline, true);
        }
        frame.vector(Kind::Surface, "position", "m", drawn.corners);
        frame.integer(Kind::Surface, "outline", "-", drawn.outline);
        frame.integer(Kind::Surface, "face", "-", drawn.face);
        frame.integer(Kind::Surface, "wall", "-", drawn.wall);
        frame.integer(Kind::Surface, "endless", "-", drawn.endless);
        let ends = self.neighbours.search.periodic;
        if ends.iter().any(Option::is_some) {
            let each = |f: fn([f64; 2]) -> f64| ends.map(|end| end.map_or(0.0, f));
            frame.vector(Kind::Global, "periodic low", "m", vec![each(|[low, _]| low)]);
            frame.vector(Kind::Global, "periodic high", "m", vec![each(|[_, high]| high)]);
            frame.vector(Kind::Global, "periodic", "-", vec![each(|_| 1.0)]);
        }
    }
}

/// Rows of the wall columns.
#[derive(Default)]
struct Drawn {
    corners: Vec<[f64; 3]>,
    outline: Vec<i64>,
    face: Vec<i64>,
    wall: Vec<i64>,
    endless: Vec<i64>,
    count: i64,
}

impl Drawn {
    fn add(&mut self, wall: usize, outline: &Outline, endless: bool) {
        let lines = outline.lines.iter().map(|line| (&line[..], 0));
        for (corners, face) in lines.chain(outline.triangles.iter().map(|triangle| (&triangle[..], 1))) {
            for corner in corners {
                self.corners.push(corner.to_array());
                self.outline.push(self.count);
                self.face.push(face);
                self.wall.push(wall as i64);
                self.endless.push(i64::from(endless));
            }
            self.count += 1;
        }
    }
}

/// The box of what is seen.
struct Extent {
    low: DVec3,
    high: DVec3,
}

impl Default for Extent {
    fn default() -> Self {
        Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY }
    }
}

impl Extent {
    fn add(&mut self, p: DVec3, reach: f64) {
        self.low = self.low.min(p - reach);
        self.high = self.high.max(p + reach);
    }

    /// Its middle, and half its diagonal [m]; nothing where nothing is seen.
    fn round(&self) -> Option<(DVec3, f64)> {
        let half = 0.5 * self.low.distance(self.high);
        half.is_finite().then(|| (0.5 * (self.low + self.high), half))
    }
}
