//! The nearest point of a mesh, by a tree of boxes.

use nalgebra::Vector3;

type Triangle = [Vector3<f64>; 3];

/// Triangles of a leaf.
const LEAF: usize = 4;

/// A box, and what is in it: triangles of the list, or two boxes.
struct Node {
    low: Vector3<f64>,
    high: Vector3<f64>,
    first: usize,
    count: usize,
    /// The second of two boxes in it; the first comes next in the list. 0 for a leaf.
    second: usize,
}

/// Triangles in a tree of boxes.
pub(super) struct Tree {
    triangles: Vec<Triangle>,
    nodes: Vec<Node>,
}

impl Tree {
    pub fn new(triangles: Vec<Triangle>) -> Self {
        let count = triangles.len();
        let mut tree = Self { triangles, nodes: Vec::new() };
        tree.add(0, count);
        tree
    }

    fn add(&mut self, first: usize, count: usize) -> usize {
        let part = &mut self.triangles[first..first + count];
        let corners = || part.iter().flatten();
        let low = corners().copied().reduce(|a, b| a.inf(&b)).unwrap_or_default();
        let high = corners().copied().reduce(|a, b| a.sup(&b)).unwrap_or_default();
        let here = self.nodes.len();
        if count > LEAF {
            let axis = (high - low).imax();
            part.sort_by(|a, b| {
                let middle = |t: &Triangle| t[0][axis] + t[1][axis] + t[2][axis];
                middle(a).total_cmp(&middle(b))
            });
        }
        self.nodes.push(Node { low, high, first, count, second: 0 });
        if count > LEAF {
            self.add(first, count / 2);
            self.nodes[here].second = self.add(first + count / 2, count - count / 2);
        }
        here
    }

    /// The diagonal of all.
    pub fn extent(&self) -> f64 {
        (self.nodes[0].high - self.nodes[0].low).norm()
    }

    /// The nearest point to a place, and how far it is.
    pub fn nearest(&self, place: Vector3<f64>) -> (Vector3<f64>, f64) {
        let away = |node: &Node| (place - place.sup(&node.low).inf(&node.high)).norm_squared();
        let (mut best, mut least) = (place, f64::INFINITY);
        let mut open = vec![(0, away(&self.nodes[0]))];
        while let Some((index, distance)) = open.pop() {
            if distance >= least {
                continue;
            }
            let node = &self.nodes[index];
            if node.second == 0 {
                for triangle in &self.triangles[node.first..node.first + node.count] {
                    let point = on_triangle(triangle, place);
                    let distance = (point - place).norm_squared();
                    if distance < least {
                        (best, least) = (point, distance);
                    }
                }
            } else {
                let mut two = [index + 1, node.second].map(|next| (next, away(&self.nodes[next])));
                if two[0].1 < two[1].1 {
                    two.swap(0, 1);
                }
                open.extend(two);
            }
        }
        (best, least.sqrt())
    }
}

/// The point of a triangle nearest to a place (Ericson 2005, section 5.1.5): in the region of a corner, of an edge, or of the face.
fn on_triangle([a, b, c]: &Triangle, place: Vector3<f64>) -> Vector3<f64> {
    let (ab, ac) = (b - a, c - a);
    let [d1, d2] = [ab, ac].map(|edge| edge.dot(&(place - a)));
    let [d3, d4] = [ab, ac].map(|edge| edge.dot(&(place - b)));
    let [d5, d6] = [ab, ac].map(|edge| edge.dot(&(place - c)));
    if d1 <= 0.0 && d2 <= 0.0 {
        return *a;
    }
    if d3 >= 0.0 && d4 <= d3 {
        return *b;
    }
    if d6 >= 0.0 && d5 <= d6 {
        return *c;
    }
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let whole = va + vb + vc;
    a + ab * (vb / whole) + ac * (vc / whole)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = Vector3<f64>> {
        [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0].prop_map(Vector3::from)
    }

    proptest! {
        /// No point of a fine net over the triangles is nearer than what the tree finds, and the point found lies on one of them.
        #[test]
        fn nothing_is_nearer(
            triangles in prop::collection::vec([point(), point(), point()], 1..20),
            place in point(),
        ) {
            let (found, distance) = Tree::new(triangles.clone()).nearest(place);
            prop_assert!(((found - place).norm() - distance).abs() < 1e-12);
            let net = triangles.iter().flat_map(|[a, b, c]| {
                (0..=20).flat_map(move |i| (0..=20 - i).map(move |j| (i, j))).map(move |(i, j)| {
                    let [u, v] = [i, j].map(|n| f64::from(n) / 20.0);
                    a + (b - a) * u + (c - a) * v
                })
            });
            let least = net.map(|point| (point - place).norm()).fold(f64::INFINITY, f64::min);
            prop_assert!(distance <= least + 1e-12 && distance > least - 0.2, "{} {}", distance, least);
        }
    }
}
