//! Pieces of space: where grains begin, are taken out, or are looked at.

use super::Vector;
use crate::key::{Key, Kind};
use crate::units::LENGTH;
use serde::{Deserialize, Serialize};

/// A piece of space: an axis-parallel box, or what of it lies in a cylinder or a sphere. In the plane the y entries are zero and not
/// looked at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Region {
    /// Corner of the box with the smallest coordinates [m].
    pub low: Vector,
    /// Corner with the largest coordinates [m].
    pub high: Vector,
    /// Only what is in this cylinder, which the box is drawn around.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cylinder: Option<Cylinder>,
    /// Only what is in this sphere, which the box is drawn around.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Ball>,
}

/// A round bar.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Cylinder {
    /// Centre of one end [m].
    pub point: Vector,
    /// Unit vector from there to the other end.
    pub axis: Vector,
    /// Radius [m].
    pub radius: f64,
    /// Length [m].
    pub length: f64,
}

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Ball {
    /// Centre [m].
    pub centre: Vector,
    /// Radius [m].
    pub radius: f64,
}

const LOW: Key = Key::new("low", Kind::Vector(&LENGTH), "Corner with the smallest coordinates");
const HIGH: Key = Key::new("high", Kind::Vector(&LENGTH), "Corner with the largest coordinates");
const RADIUS: Key = Key::new("radius", Kind::Quantity(&LENGTH), "Radius").above(0.0);
static CYLINDER: &[Key] = &[
    Key::new("point", Kind::Vector(&LENGTH), "Centre of one end").default("'origin'"),
    Key::new("axis", Kind::Direction, "Direction from there to the other end").default("'z'"),
    RADIUS,
    Key::new("length", Kind::Quantity(&LENGTH), "Length").above(0.0),
];
static BALL: &[Key] = &[Key::new("centre", Kind::Vector(&LENGTH), "Centre").default("'origin'"), RADIUS];
/// What is told of the corners where a region may be round.
const AROUND: &str = "around the `cylinder` or the `sphere`, else required";

impl Region {
    /// What a scene may say where a region is a box.
    pub(crate) const KEYS: &'static [Key] = &[LOW, HIGH];

    /// What a scene may say where it may be round.
    pub(crate) const ROUND_KEYS: &'static [Key] = &[
        LOW.derived(AROUND),
        HIGH.derived(AROUND),
        Key::new("cylinder", Kind::Table(CYLINDER), "A cylinder instead of a box").optional().rivals(&["sphere"]),
        Key::new("sphere", Kind::Table(BALL), "A sphere instead of a box").optional().rivals(&["cylinder"]),
    ];

    /// A box.
    pub const fn of_box(low: Vector, high: Vector) -> Self {
        Self { low, high, cylinder: None, sphere: None }
    }

    /// Whether it is less than its box.
    pub const fn is_round(&self) -> bool {
        self.cylinder.is_some() || self.sphere.is_some()
    }

    /// Whether a ball of this radius [m] about a point lies in the cylinder or sphere, if there is one; 0 is the point alone.
    pub fn rounds(&self, at: Vector, radius: f64) -> bool {
        let from = |origin: Vector| [0, 1, 2].map(|k| at[k] - origin[k]);
        let square = |v: Vector| v.iter().map(|x| x * x).sum::<f64>();
        let in_cylinder = |c: &Cylinder| {
            let way = from(c.point);
            let along: f64 = (0..3).map(|k| way[k] * c.axis[k]).sum();
            let across = (square(way) - along * along).max(0.0).sqrt();
            along >= radius && along <= c.length - radius && across <= c.radius - radius
        };
        let in_sphere = |ball: &Ball| square(from(ball.centre)).sqrt() <= ball.radius - radius;
        self.cylinder.as_ref().is_none_or(in_cylinder) && self.sphere.as_ref().is_none_or(in_sphere)
    }

    /// Whether a point lies in it; in the plane both y are zero, and so is the point's.
    pub fn holds(&self, at: Vector) -> bool {
        (0..3).all(|k| at[k] >= self.low[k] && at[k] <= self.high[k]) && self.rounds(at, 0.0)
    }
}

impl Cylinder {
    /// The smallest box around it: along each axis its ends, and what of the radius stands across.
    pub fn ends(&self) -> [Vector; 2] {
        let ends = [0, 1, 2].map(|k| {
            let across = self.radius * (1.0 - self.axis[k] * self.axis[k]).max(0.0).sqrt();
            let (a, b) = (self.point[k], self.point[k] + self.length * self.axis[k]);
            [a.min(b) - across, a.max(b) + across]
        });
        [ends.map(|end| end[0]), ends.map(|end| end[1])]
    }
}

impl Ball {
    /// The smallest box around it.
    pub fn ends(&self) -> [Vector; 2] {
        [self.centre.map(|x| x - self.radius), self.centre.map(|x| x + self.radius)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_regions_hold_what_is_in_them() {
        let axis = [0.0, 0.6, 0.8];
        let bar = Cylinder { point: [1.0, 0.0, 0.0], axis, radius: 0.5, length: 2.0 };
        let [low, high] = bar.ends();
        let bar = Region { low, high, cylinder: Some(bar), sphere: None };
        let at = |along: f64, across: f64| [1.0 + across, 0.6 * along, 0.8 * along];
        assert!(bar.holds(at(1.0, 0.49)) && !bar.holds(at(1.0, 0.51)) && !bar.holds(at(2.01, 0.0)));
        assert!(bar.rounds(at(1.0, 0.39), 0.1) && !bar.rounds(at(1.0, 0.41), 0.1) && !bar.rounds(at(0.05, 0.0), 0.1));
        // Its box: across y a disc stands out by 0.5 * 0.8, across z by 0.5 * 0.6.
        for (found, wanted) in low.into_iter().chain(high).zip([0.5, -0.4, -0.3, 1.5, 1.6, 1.9]) {
            assert!((found - wanted).abs() < 1e-12, "{low:?} {high:?}");
        }
        let ball = Ball { centre: [0.0, 0.0, 1.0], radius: 1.0 };
        let [low, high] = ball.ends();
        let ball = Region { low, high, cylinder: None, sphere: Some(ball) };
        assert!(ball.holds([0.7, 0.0, 1.7]) && !ball.holds([0.8, 0.0, 1.8]), "the corner of its box is not in it");
    }
}
