//! Room for a grain among grains: random places without overlap.

use glam::DVec3;
use std::collections::BTreeMap;

/// Spheres that are there already, in cells of the largest diameter.
#[derive(Debug, Default)]
pub(super) struct Occupied {
    size: f64,
    largest: f64,
    cells: BTreeMap<[i64; 3], Vec<(DVec3, f64)>>,
}

impl Occupied {
    /// An empty space for spheres of at most `largest` radius [m].
    pub fn new(largest: f64) -> Self {
        Self { size: 2.0 * largest, largest, cells: BTreeMap::new() }
    }

    /// Puts a sphere in.
    pub fn put(&mut self, centre: DVec3, radius: f64) {
        self.cells.entry(self.cell(centre)).or_default().push((centre, radius));
    }

    /// Whether a sphere would overlap none that is there.
    pub fn free(&self, centre: DVec3, radius: f64) -> bool {
        let [x, y, z] = self.cell(centre);
        let reach = ((radius + self.largest) / self.size).ceil() as i64;
        for i in x - reach..=x + reach {
            for j in y - reach..=y + reach {
                for k in z - reach..=z + reach {
                    let there = self.cells.get(&[i, j, k]).into_iter().flatten();
                    for (other, r) in there {
                        if other.distance_squared(centre) < (r + radius) * (r + radius) {
                            return false;
                        }
                    }
                }
            }
        }
        true
    }

    fn cell(&self, p: DVec3) -> [i64; 3] {
        (p / self.size).floor().to_array().map(|x| x as i64)
    }
}
