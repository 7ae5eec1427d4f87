//! Which way is which in a picture: the axes, gravity and the flow of the water, as arrows with their names.

use std::fmt::Write as _;

use tsubu_frame::{Frame, Kind};

use crate::plot::INK;

/// Length of an arrow that lies in the picture [pixels].
const REACH: f64 = 22.0;
/// From one arrow to the next [pixels].
const APART: f64 = 50.0;
/// An axis that looks at the viewer is no arrow.
const SHORTEST: f64 = 0.2;
/// Width of all of it, with the names [pixels].
pub(crate) const WIDE: f64 = 160.0;
/// Colour of the water: its surface, its body, its flow.
const WATER: &str = "#0072b2";

/// Unit vectors of the world as a picture shows them: to the right, up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Compass {
    /// Along x, y and z.
    pub axes: [[f64; 2]; 3],
    /// Along gravity, where there is any.
    pub gravity: Option<[f64; 2]>,
    /// Along the flow of the water, where it flows.
    pub flow: Option<[f64; 2]>,
}

impl Compass {
    /// Of a frame that is turned to the viewer.
    pub(crate) fn of(frame: &Frame, turn: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        let seen = |v: [f64; 3]| {
            let [right, up, _] = turn(v);
            let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            [right / length, up / length]
        };
        let told = |name| frame.vectors(Kind::Global, name).first().copied().map(seen);
        Self {
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(seen),
            gravity: told("gravity"),
            flow: told("flow"),
        }
    }

    /// Draws it with its left end at `x` and its ground at `y` [pixels].
    pub(crate) fn draw(&self, out: &mut String, [x, y]: [f64; 2]) {
        let origin = [x + 12.0, y];
        for (along, name) in self.axes.iter().zip(["x", "y", "z"]) {
            if along[0].hypot(along[1]) >= SHORTEST {
                arrow(out, origin, *along, name, INK);
            }
        }
        let others = [(self.gravity, "gravity", INK), (self.flow, "flow", WATER)];
        let told = others.iter().filter_map(|(along, name, colour)| Some(((*along)?, *name, *colour)));
        for (number, (along, name, colour)) in told.enumerate() {
            // Its middle stands where that of an upright axis does, its name below.
            let [dx, dy] = along.map(|part| 0.5 * REACH * part);
            let middle = [origin[0] + APART * (1.2 + number as f64), y - 0.5 * REACH];
            arrow(out, [middle[0] - dx, middle[1] + dy], along, "", colour);
            let _ = write!(
                out,
                "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"11\" text-anchor=\"middle\" fill=\"{colour}\">{name}</text>",
                middle[0],
                y + 12.0
            );
        }
    }
}

/// Water below a level, in a rectangle: left, top, width, height [pixels].
pub(crate) fn draw_water(out: &mut String, level: f64, [x, y, w, h]: [f64; 4]) {
    let level = level.max(y);
    let _ = write!(
        out,
        "<rect x=\"{x:.1}\" y=\"{level:.1}\" width=\"{w:.1}\" height=\"{:.1}\" fill=\"{WATER}\" fill-opacity=\".09\"/>\
         <line x1=\"{x:.1}\" y1=\"{level:.1}\" x2=\"{:.1}\" y2=\"{level:.1}\" stroke=\"{WATER}\" stroke-opacity=\".6\"/>",
        (y + h - level).max(0.0),
        x + w
    );
}

/// An arrow from its tail, with its name beyond its tip.
fn arrow(out: &mut String, [x, y]: [f64; 2], [right, up]: [f64; 2], name: &str, colour: &str) {
    let [tip_x, tip_y] = [x + REACH * right, y - REACH * up];
    let head = |side: f64| [tip_x - 6.0 * right - side * 3.0 * up, tip_y + 6.0 * up - side * 3.0 * right];
    let ([a, b], [c, d]) = (head(1.0), head(-1.0));
    let _ = write!(
        out,
        "<path fill=\"none\" d=\"M{x:.1} {y:.1}L{tip_x:.1} {tip_y:.1}M{a:.1} {b:.1}L{tip_x:.1} {tip_y:.1}L{c:.1} {d:.1}\" stroke=\"{colour}\" stroke-width=\"1.4\"/>"
    );
    if !name.is_empty() {
        let (x, y) = (tip_x + 8.0 * right, tip_y - 8.0 * up + 4.0);
        let _ = write!(
            out,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"11\" text-anchor=\"middle\" fill=\"{colour}\">{name}</text>"
        );
    }
}
