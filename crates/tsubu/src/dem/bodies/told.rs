//! What frames say of polyhedra.

use super::Bodies;
use crate::polyhedron::Polyhedron;
use glam::DVec3;
use tsubu_frame::{Frame, Kind};

impl Bodies {
    /// Which polyhedron each grain is, and what these are: corners and faces of bodies of diameter 1, along their principal axes, before edges are rounded.
    pub fn tell_polyhedra(&self, order: &[usize], frame: &mut Frame) {
        if !self.faceted() {
            return;
        }
        let number = |i: &usize| {
            let body = self.sorted.get(*i).and_then(|piece| self.list.get(piece.body as usize));
            body.and_then(|body| body.polyhedron.as_ref()).map_or(-1, |body| i64::from(body.shape))
        };
        frame.integer(Kind::Grain, "polyhedron", "-", order.iter().map(number).collect());
        let (mut of_face, mut normal, mut offset) = (Vec::new(), Vec::new(), Vec::new());
        let (mut of_corner, mut corner) = (Vec::new(), Vec::new());
        for (number, shape) in (0..).zip(&self.polyhedra) {
            for (n, h) in shape.planes() {
                of_face.push(number);
                normal.push(n.to_array());
                offset.push(h);
            }
            of_corner.extend(shape.corners().iter().map(|_| number));
            corner.extend(shape.corners().iter().map(DVec3::to_array));
        }
        frame.scalar(
            Kind::Global,
            "polyhedron rounding",
            "-",
            self.polyhedra.iter().map(Polyhedron::rounding).collect(),
        );
        frame.integer(Kind::Global, "polyhedron of face", "-", of_face);
        frame.vector(Kind::Global, "polyhedron normal", "-", normal);
        frame.scalar(Kind::Global, "polyhedron offset", "-", offset);
        frame.integer(Kind::Global, "polyhedron of corner", "-", of_corner);
        frame.vector(Kind::Global, "polyhedron corner", "-", corner);
    }
}
