//! A uniform grid of cells, filled by counting sort.

use glam::DVec3;

/// Grain indices sorted by cell.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    origin: DVec3,
    inverse_size: f64,
    /// Cells along x, y, z.
    extent: [usize; 3],
    /// First entry of each cell in `members`; one more than cells.
    start: Vec<u32>,
    members: Vec<u32>,
    cell_of: Vec<u32>,
}

/// Half of the 26 neighbours of a cell: with the cell itself, every pair of cells is met once.
const FORWARD: [[i64; 3]; 13] = [
    [1, 0, 0],
    [-1, 1, 0],
    [0, 1, 0],
    [1, 1, 0],
    [-1, -1, 1],
    [0, -1, 1],
    [1, -1, 1],
    [-1, 0, 1],
    [0, 0, 1],
    [1, 0, 1],
    [-1, 1, 1],
    [0, 1, 1],
    [1, 1, 1],
];

impl Grid {
    /// Sorts positions into cells of at least `size` [m]; no more cells than about four a grain, however far they fly.
    pub fn fill(&mut self, positions: &[DVec3], size: f64) {
        let (low, high) =
            positions.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), p| (l.min(*p), h.max(*p)));
        let limit = (4 * positions.len()).max(64);
        let mut size = size;
        loop {
            let cells = ((high - low) / size).floor();
            self.extent = [cells.x, cells.y, cells.z].map(|c| c as usize + 1);
            if self.extent.iter().try_fold(1usize, |a, &b| a.checked_mul(b)).is_some_and(|n| n <= limit) {
                break;
            }
            size *= 1.5;
        }
        self.origin = low;
        self.inverse_size = 1.0 / size;
        let cells = self.extent.iter().product::<usize>();
        self.start.clear();
        self.start.resize(cells + 1, 0);
        self.cell_of.clear();
        for p in positions {
            let cell = self.cell(*p);
            self.cell_of.push(cell as u32);
            self.start[cell + 1] += 1;
        }
        for i in 0..cells {
            self.start[i + 1] += self.start[i];
        }
        self.members.resize(positions.len(), 0);
        let mut next = self.start.clone();
        for (i, &cell) in self.cell_of.iter().enumerate() {
            self.members[next[cell as usize] as usize] = i as u32;
            next[cell as usize] += 1;
        }
    }

    /// Grain indices in the order of their cells.
    pub fn order(&self) -> &[u32] {
        &self.members
    }

    /// Calls `meet(a, b)` once for every pair of grains in the same or in neighbouring cells.
    pub fn pairs(&self, mut meet: impl FnMut(u32, u32)) {
        let [nx, ny, nz] = self.extent;
        for cell in 0..nx * ny * nz {
            let members = self.cell_members(cell);
            if members.is_empty() {
                continue;
            }
            for (k, &a) in members.iter().enumerate() {
                for &b in &members[k + 1..] {
                    meet(a, b);
                }
            }
            let at = [cell % nx, cell / nx % ny, cell / (nx * ny)];
            for step in FORWARD {
                let Some(other) = self.neighbour(at, step) else { continue };
                for &b in self.cell_members(other) {
                    for &a in members {
                        meet(a, b);
                    }
                }
            }
        }
    }

    fn neighbour(&self, at: [usize; 3], step: [i64; 3]) -> Option<usize> {
        let mut index = 0;
        for axis in [2, 1, 0] {
            let place = at[axis] as i64 + step[axis];
            if place < 0 || place >= self.extent[axis] as i64 {
                return None;
            }
            index = index * self.extent[axis] + place as usize;
        }
        Some(index)
    }

    fn cell_members(&self, cell: usize) -> &[u32] {
        &self.members[self.start[cell] as usize..self.start[cell + 1] as usize]
    }

    fn cell(&self, p: DVec3) -> usize {
        let q = (p - self.origin) * self.inverse_size;
        let [x, y, z] = [q.x, q.y, q.z].map(|c| c.max(0.0) as usize);
        let [nx, ny, nz] = self.extent;
        (z.min(nz - 1) * ny + y.min(ny - 1)) * nx + x.min(nx - 1)
    }
}
