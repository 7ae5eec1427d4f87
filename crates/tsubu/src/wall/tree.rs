//! A tree of boxes over triangles (bounding volume hierarchy): which triangles may be near a point.
//!
//! A tree and not a grid: a mesh mixes two-triangle floors with fine details, and no cell size suits both.

use super::triangle::Triangle;
use glam::DVec3;

/// Triangles in a leaf at most.
const LEAF: usize = 4;
/// Deep enough for any mesh: halving 2^32 triangles takes 32 levels, and one entry a level waits.
const DEPTH: usize = 64;

/// The tree, nodes in depth-first order.
#[derive(Clone, Debug, Default)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    /// Triangle indices, leaf by leaf.
    order: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    low: DVec3,
    high: DVec3,
    content: Content,
}

#[derive(Clone, Copy, Debug)]
enum Content {
    /// Triangles `order[from..to]`.
    Leaf { from: u32, to: u32 },
    /// One child is the next node, the other this one.
    Fork { second: u32 },
}

/// Whether a way from a point leads through a box between two corners.
pub(crate) fn meets_box(point: DVec3, way: DVec3, low: DVec3, high: DVec3) -> bool {
    let (a, b) = ((low - point) / way, (high - point) / way);
    let (mut from, mut to) = (0.0, f64::INFINITY);
    for axis in 0..3 {
        if way[axis] == 0.0 {
            if point[axis] < low[axis] || point[axis] > high[axis] {
                return false;
            }
            continue;
        }
        from = a[axis].min(b[axis]).max(from);
        to = a[axis].max(b[axis]).min(to);
    }
    from <= to * (1.0 + 1e-9)
}

impl Tree {
    pub fn new(triangles: &[Triangle]) -> Self {
        let mut tree = Self { nodes: Vec::new(), order: (0..triangles.len() as u32).collect() };
        let mut order = std::mem::take(&mut tree.order);
        if !order.is_empty() {
            tree.split(triangles, &mut order, 0);
        }
        tree.order = order;
        tree
    }

    /// Makes the node of `part`, which begins at `from` in the whole order.
    fn split(&mut self, triangles: &[Triangle], part: &mut [u32], from: u32) {
        let corners = part.iter().flat_map(|&t| triangles[t as usize].corners);
        let (low, high) = corners
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high): (DVec3, DVec3), p| (low.min(p), high.max(p)));
        let here = self.nodes.len();
        let content = Content::Leaf { from, to: from + part.len() as u32 };
        self.nodes.push(Node { low, high, content });
        if part.len() <= LEAF {
            return;
        }
        let axis = (high - low).max_position();
        let middle = part.len() / 2;
        let place = |t: u32| triangles[t as usize].corners.iter().map(|p| p[axis]).sum::<f64>();
        part.select_nth_unstable_by(middle, |&a, &b| place(a).total_cmp(&place(b)).then(a.cmp(&b)));
        let (first, second) = part.split_at_mut(middle);
        self.split(triangles, first, from);
        self.nodes[here].content = Content::Fork { second: self.nodes.len() as u32 };
        self.split(triangles, second, from + middle as u32);
    }

    /// Calls `meet` with every triangle whose box lies on the way from a point.
    pub fn along(&self, point: DVec3, way: DVec3, mut meet: impl FnMut(u32)) {
        let mut waiting: Vec<u32> = if self.nodes.is_empty() { Vec::new() } else { vec![0] };
        while let Some(index) = waiting.pop() {
            let node = &self.nodes[index as usize];
            if !meets_box(point, way, node.low, node.high) {
                continue;
            }
            match node.content {
                Content::Leaf { from, to } => {
                    self.order[from as usize..to as usize].iter().copied().for_each(&mut meet);
                }
                Content::Fork { second } => waiting.extend([second, index + 1]),
            }
        }
    }

    /// Calls `meet` with every triangle whose box is within `reach` of the point.
    pub fn near(&self, point: DVec3, reach: f64, mut meet: impl FnMut(u32)) {
        if self.nodes.is_empty() {
            return;
        }
        let mut waiting = [0u32; DEPTH];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let index = waiting[count];
            let node = &self.nodes[index as usize];
            if point.clamp(node.low, node.high).distance_squared(point) > reach * reach {
                continue;
            }
            match node.content {
                Content::Leaf { from, to } => {
                    self.order[from as usize..to as usize].iter().copied().for_each(&mut meet);
                }
                Content::Fork { second } => {
                    waiting[count] = second;
                    waiting[count + 1] = index + 1;
                    count += 2;
                }
            }
        }
    }
}
