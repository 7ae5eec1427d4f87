//! A uniform grid of cells, filled by counting sort.

use super::cell_sort::CellSort;
use crate::threads::{fill, piece, shares};
use glam::DVec3;
use rayon::prelude::*;

/// PeriodicBounds of the periodic axes: `None` where the world goes on.
pub type PeriodicBounds = [Option<[f64; 2]>; 3];

/// Cells of a super-cell along each axis. Cells are numbered super-cell by super-cell, so that grains sorted by cell lie
/// in lumps rather than in rows: a lump of grains has few neighbours outside.
const LUMP: usize = 4;

/// The image of a grain that is not across a periodic end.
pub const PRIMARY_IMAGE: u32 = 13;

/// Shift of an image: image = 9 (z + 1) + 3 (y + 1) + (x + 1) with x, y, z in -1, 0, 1 counting periods.
pub fn shift(periodic: &PeriodicBounds, image: u32) -> DVec3 {
    let times = [image % 3, image / 3 % 3, image / 9].map(|k| f64::from(k) - 1.0);
    let period = periodic.map(|e| e.map_or(0.0, |[low, high]| high - low));
    DVec3::new(times[0] * period[0], times[1] * period[1], times[2] * period[2])
}

/// The image of a point between the periodic ends.
pub fn wrapped(periodic: &PeriodicBounds, mut point: DVec3) -> DVec3 {
    for (axis, end) in periodic.iter().enumerate() {
        if let Some([low, high]) = end {
            point[axis] -= ((point[axis] - low) / (high - low)).floor() * (high - low);
        }
    }
    point
}

/// The shortest of the vectors that lead from one point to another or to an image of it; `branch` is any of them.
pub fn nearest_image(periodic: &PeriodicBounds, mut branch: DVec3) -> DVec3 {
    for (axis, end) in periodic.iter().enumerate() {
        if let Some([low, high]) = end {
            branch[axis] -= (branch[axis] / (high - low)).round() * (high - low);
        }
    }
    branch
}

/// How cells are numbered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Numbering {
    /// Along x, then y, then z: neighbours along x lie side by side, good for searching.
    #[default]
    Rows,
    /// Super-cell by super-cell, good for sorting.
    Lumps,
}

/// A grain as one of its periodic images.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Image {
    /// Index of the grain.
    pub grain: u32,
    /// Which image of it; see [`shift`].
    pub image: u32,
}

/// Cells along an axis, from and to, and the image they are found in: 0, 1, 2 for a period back, none, a period on.
type Run = ([usize; 2], u32);

/// Grains found near a point. There is more room than grains: what is looked at is written down before it is known whether
/// it stays, for a branch that goes either way costs more.
#[derive(Clone, Debug, Default)]
pub struct Nearby {
    room: Vec<Image>,
    count: usize,
}

impl Nearby {
    /// Forgets all.
    pub fn clear(&mut self) {
        self.count = 0;
    }

    /// What was found.
    pub fn found(&self) -> &[Image] {
        &self.room[..self.count]
    }

    #[inline]
    fn collect(&mut self, spheres: &[[f64; 4]], members: &[u32], image: u32, (p, reach): (DVec3, f64)) {
        if self.room.len() < self.count + members.len() {
            self.room.resize(2 * (self.count + members.len()), Image::default());
        }
        let room = &mut self.room[self.count..];
        let mut count = 0;
        for (sphere, &grain) in spheres.iter().zip(members) {
            let (dx, dy, dz) = (sphere[0] - p.x, sphere[1] - p.y, sphere[2] - p.z);
            let limit = sphere[3] + reach;
            let near = usize::from(dx * dx + dy * dy + dz * dz < limit * limit);
            room[count] = Image { grain, image };
            count += near;
        }
        self.count += count;
    }
}

/// Indices sorted by cell.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    numbering: Numbering,
    origin: [f64; 3],
    /// Cells per metre along each axis.
    density: [f64; 3],
    /// Cells along x, y, z.
    extent: [usize; 3],
    /// Super-cells along x and y.
    lumps: [usize; 2],
    wraps: [bool; 3],
    /// How many cells there are, all together.
    cells: usize,
    /// First entry of each cell in `members`; one more than cells.
    start: Vec<u32>,
    members: Vec<u32>,
    /// Centre and radius of every member, side by side [m].
    spheres: Vec<[f64; 4]>,
    memory: CellSort,
}

impl Grid {
    /// Sorts the spheres that are `members` into cells of at least `size` [m], to be searched. Where cells lie hangs on `all` of
    /// which these are some.
    pub fn fill(
        &mut self,
        (positions, radii): (&[DVec3], &[f64]),
        all: impl Fn(u32) -> bool + Sync,
        members: impl Fn(u32) -> bool + Sync,
        size: f64,
        periodic: &PeriodicBounds,
    ) {
        self.lay(Numbering::Rows, positions, all, size, periodic);
        self.sort(positions, members);
        self.spheres.resize(self.members.len(), [0.0; 4]);
        fill(&mut self.spheres, |k| {
            let i = self.members[k] as usize;
            let p = positions[i];
            [p.x, p.y, p.z, radii[i]]
        });
    }

    /// Lays cells of at least `size` [m] over `all`; no more cells than about four a grain, however far they fly.
    pub fn lay(
        &mut self,
        numbering: Numbering,
        positions: &[DVec3],
        all: impl Fn(u32) -> bool + Sync,
        size: f64,
        periodic: &PeriodicBounds,
    ) {
        self.numbering = numbering;
        let piece = piece(positions.len());
        let nothing = || (DVec3::INFINITY, DVec3::NEG_INFINITY, 0usize);
        let ends = |(k, positions): (usize, &[DVec3])| {
            let own = ((k * piece) as u32..).zip(positions).filter(|(i, _)| all(*i));
            own.fold(nothing(), |(low, high, count), (_, p)| (low.min(*p), high.max(*p), count + 1))
        };
        let pieces = positions.par_chunks(piece).enumerate().map(ends);
        let (low, high, count) = pieces.reduce(nothing, |a, b| (a.0.min(b.0), a.1.max(b.1), a.2 + b.2));
        self.shape(low.to_array(), high.to_array(), count, size, periodic);
        let [nx, ny, nz] = match self.numbering {
            Numbering::Rows => self.extent,
            Numbering::Lumps => self.extent.map(|n| n.div_ceil(LUMP) * LUMP),
        };
        self.lumps = [nx / LUMP, ny / LUMP];
        self.cells = nx * ny * nz;
    }

    /// Sorts `members` into the cells. They keep their order within a cell.
    pub fn sort(&mut self, positions: &[DVec3], members: impl Fn(u32) -> bool + Sync) {
        let (mut memory, mut start, mut sorted) =
            (std::mem::take(&mut self.memory), std::mem::take(&mut self.start), std::mem::take(&mut self.members));
        let cell_of = |i: u32| members(i).then(|| self.cell_index(self.cell_at(positions[i as usize])) as u32);
        let n = positions.len();
        memory.sort((n, self.cells), shares(n), &cell_of, &mut start, &mut sorted);
        (self.memory, self.start, self.members) = (memory, start, sorted);
    }

    fn shape(&mut self, low: [f64; 3], high: [f64; 3], count: usize, size: f64, periodic: &PeriodicBounds) {
        let limit = (4 * count).max(64);
        let mut size = size;
        loop {
            for axis in 0..3 {
                let (from, length) = match periodic[axis] {
                    Some([low, high]) => (low, high - low),
                    None => (low[axis], high[axis] - low[axis]),
                };
                let cells = (length / size).floor().max(0.0);
                self.wraps[axis] = periodic[axis].is_some();
                // A periodic axis is cut into whole cells; elsewhere the last cell may reach beyond the last grain.
                let whole = if self.wraps[axis] { cells.max(1.0) } else { cells + 1.0 };
                self.extent[axis] = whole as usize;
                self.origin[axis] = from;
                self.density[axis] = if self.wraps[axis] { whole / length } else { 1.0 / size };
            }
            if self.extent.iter().try_fold(1usize, |a, &b| a.checked_mul(b)).is_some_and(|n| n <= limit) {
                return;
            }
            size *= 1.26;
        }
    }

    /// Members in the order of their cells.
    pub fn order(&self) -> &[u32] {
        &self.members
    }

    /// Finds every member whose surface is nearer to a point than `reach` [m], which must not be above the cells' size less
    /// the member's radius. An image is found where `shifts` puts it.
    #[inline]
    pub fn near(&self, p: DVec3, reach: f64, shifts: &[DVec3], nearby: &mut Nearby) {
        if self.members.is_empty() {
            return;
        }
        let [x, y, z] = self.cell_at(p);
        let (rows, planes) = (self.around(1, y), self.around(2, z));
        for plane in planes {
            for row in rows {
                self.collect(self.around(0, x), row, plane, (p, reach), shifts, nearby);
            }
        }
    }

    /// The same for a member, in half of the directions: of two members that are near one another one finds the other. It
    /// may find its own image.
    #[inline]
    pub fn ahead(&self, member: u32, p: DVec3, reach: f64, shifts: &[DVec3], nearby: &mut Nearby) {
        let [x, y, z] = self.cell_at(p);
        // Members of a cell keep their order.
        let cell = self.cell_index([x, y, z]);
        let mates = self.start[cell] as usize..self.start[cell + 1] as usize;
        let later = mates.start + self.members[mates.clone()].partition_point(|&m| m <= member);
        nearby.collect(&self.spheres[later..mates.end], &self.members[later..mates.end], PRIMARY_IMAGE, (p, reach));
        let across = self.around(0, x);
        self.collect([self.after(0, x)], ([y, y + 1], 1), ([z, z + 1], 1), (p, reach), shifts, nearby);
        self.collect(across, self.after(1, y), ([z, z + 1], 1), (p, reach), shifts, nearby);
        let plane = self.after(2, z);
        for row in self.around(1, y) {
            self.collect(across, row, plane, (p, reach), shifts, nearby);
        }
    }

    /// Meets the members of rows of cells along x: `rows` and `planes` say which, each with the image along its axis.
    #[inline]
    fn collect<const N: usize>(
        &self,
        cells: [Run; N],
        (rows, iy): Run,
        (planes, iz): Run,
        (p, reach): (DVec3, f64),
        shifts: &[DVec3],
        nearby: &mut Nearby,
    ) {
        for z in planes[0]..planes[1] {
            for y in rows[0]..rows[1] {
                for (xs, ix) in cells.into_iter().filter(|(xs, _)| xs[0] < xs[1]) {
                    let image = 9 * iz + 3 * iy + ix;
                    let p = if image == PRIMARY_IMAGE { p } else { p - shifts[image as usize] };
                    // Neighbours along x lie side by side.
                    let first = self.start[self.cell_index([xs[0], y, z])] as usize;
                    let last = self.start[self.cell_index([xs[1] - 1, y, z]) + 1] as usize;
                    nearby.collect(&self.spheres[first..last], &self.members[first..last], image, (p, reach));
                }
            }
        }
    }

    /// The cells before, at and after `k` along an axis.
    fn around(&self, axis: usize, k: usize) -> [Run; 3] {
        let n = self.extent[axis];
        let before = if self.wraps[axis] && k == 0 { [n - 1, n] } else { [0, 0] };
        let (beyond, image) = self.after(axis, k);
        let beyond = if image == 1 { [0, 0] } else { beyond };
        [(before, 0), ([k.saturating_sub(1), (k + 2).min(n)], 1), (beyond, 2)]
    }

    /// The cell after `k` along an axis.
    fn after(&self, axis: usize, k: usize) -> Run {
        match k + 1 < self.extent[axis] {
            true => ([k + 1, k + 2], 1),
            false if self.wraps[axis] => ([0, 1], 2),
            false => ([0, 0], 1),
        }
    }

    #[inline]
    fn cell_at(&self, p: DVec3) -> [usize; 3] {
        let along = |axis: usize, p: f64| {
            let k = ((p - self.origin[axis]) * self.density[axis]).max(0.0) as usize;
            k.min(self.extent[axis] - 1)
        };
        [along(0, p.x), along(1, p.y), along(2, p.z)]
    }

    #[inline]
    fn cell_index(&self, [x, y, z]: [usize; 3]) -> usize {
        if self.numbering == Numbering::Rows {
            return (z * self.extent[1] + y) * self.extent[0] + x;
        }
        let [nx, ny] = self.lumps;
        let lump = ((z / LUMP) * ny + y / LUMP) * nx + x / LUMP;
        ((lump * LUMP + z % LUMP) * LUMP + y % LUMP) * LUMP + x % LUMP
    }
}
