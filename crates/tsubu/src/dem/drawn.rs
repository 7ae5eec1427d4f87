//! What is round the grains, as it is drawn in frames: walls, the surface of the water, the cell where the world repeats, and
//! which way gravity and the water go.

use super::engine::DemEngine;
use crate::wall::Outline;
use crate::water::Water;
use glam::DVec3;
use tsubu_frame::{Frame, Kind};

/// The number of the water's surface among the walls.
const WATER: i64 = -1;

impl DemEngine {
    /// Adds lines and faces of all walls and of the water's surface to a frame.
    pub(super) fn draw_surroundings(&self, frame: &mut Frame) {
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
        let water = self.immersion.as_ref().map(|immersion| &immersion.water);
        let surface = water.and_then(Water::level).map(|level| (WATER, (level * DVec3::Z, DVec3::Z)));
        let planes =
            self.walls.iter().enumerate().filter_map(|(number, wall)| Some((number as i64, wall.lone_plane()?)));
        let mut drawn = Drawn::default();
        for (number, outline) in &outlines {
            drawn.add(*number as i64, outline, false);
        }
        if let Some((middle, half)) = seen.round() {
            for (number, (point, normal)) in planes.chain(surface) {
                drawn.add(number, &Outline::of_plane(point, normal, middle, half, self.limits.in_space), true);
            }
        }
        frame.vector(Kind::Surface, "position", "m", drawn.corners);
        frame.integer(Kind::Surface, "outline", "-", drawn.outline);
        frame.integer(Kind::Surface, "face", "-", drawn.face);
        frame.integer(Kind::Surface, "wall", "-", drawn.wall);
        frame.integer(Kind::Surface, "endless", "-", drawn.endless);
    }

    /// Adds the cell of periodic axes to a frame, gravity [m/s^2], and the way of the water as a unit vector.
    pub(super) fn tell_world(&self, frame: &mut Frame) {
        let water = self.immersion.as_ref().map(|immersion| &immersion.water);
        let gravity = self.integration.gravity;
        let flow = water.and_then(Water::direction);
        if gravity != DVec3::ZERO {
            frame.vector(Kind::Global, "gravity", "m/s^2", vec![gravity.to_array()]);
        }
        if let Some(flow) = flow {
            frame.vector(Kind::Global, "flow", "-", vec![flow.to_array()]);
        }
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
    fn add(&mut self, wall: i64, outline: &Outline, endless: bool) {
        let lines = outline.lines.iter().map(|line| (&line[..], 0));
        for (corners, face) in lines.chain(outline.triangles.iter().map(|triangle| (&triangle[..], 1))) {
            for corner in corners {
                self.corners.push(corner.to_array());
                self.outline.push(self.count);
                self.face.push(face);
                self.wall.push(wall);
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
