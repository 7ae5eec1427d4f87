//! Paths of single grains over a second (figure 16): how jerky they are.

use glam::DVec3;

/// Means over the grains that came farther than a diameter.
pub(super) struct Paths {
    /// Turns up or down, in a second.
    pub turns: f64,
    /// Angle between a step and the next [rad].
    pub bend: f64,
    /// Way in a second along all bends less the straight line, over it.
    pub detour: f64,
    /// That line [m].
    pub distance: f64,
}

impl Paths {
    /// From the places of grains of a `diameter` [m] at equal intervals of a second, in a world of a `length` [m] along x that closes
    /// in itself.
    pub fn of(looks: &[Vec<DVec3>], diameter: f64, length: f64) -> Self {
        let (mut sum, mut moved) = ([0.0; 4], 0.0);
        for grain in 0..looks.first().map_or(0, Vec::len) {
            let steps: Vec<DVec3> =
                looks.windows(2).map(|pair| nearest(pair[1][grain] - pair[0][grain], length)).collect();
            let distance = steps.iter().sum::<DVec3>().length();
            if distance > diameter {
                let way: f64 = steps.iter().map(|step| step.length()).sum();
                let turns = steps.windows(2).filter(|pair| pair[0].z * pair[1].z < 0.0).count() as f64;
                let bends: f64 = steps.windows(2).map(|pair| pair[0].angle_between(pair[1])).sum();
                let found = [turns, bends / (steps.len() - 1) as f64, way / distance - 1.0, distance];
                (0..4).for_each(|i| sum[i] += found[i]);
                moved += 1.0;
            }
        }
        let [turns, bend, detour, distance] = sum.map(|sum| sum / moved);
        Self { turns, bend, detour, distance }
    }
}

/// The shortest of the ways that lead to the same place.
fn nearest(way: DVec3, length: f64) -> DVec3 {
    DVec3 { x: way.x - length * (way.x / length).round(), ..way }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A zigzag of 45 degrees over the end of the world, beside a grain that stays.
    #[test]
    fn a_zigzag_turns_at_every_look() {
        let looks: Vec<Vec<DVec3>> = (0..=10)
            .map(|look| {
                let x = (8.5 + f64::from(look)) % 10.0;
                vec![DVec3::new(x, 0.0, f64::from(look % 2)), DVec3::ZERO]
            })
            .collect();
        let paths = Paths::of(&looks, 0.2, 10.0);
        assert_eq!((paths.turns, paths.distance), (9.0, 10.0));
        assert!((paths.detour - (2_f64.sqrt() - 1.0)).abs() < 1e-12);
        assert!((paths.bend - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    }
}
