//! Meshes in the plane: where y = 0 cuts them, made endless along y.

use glam::DVec3;

/// The pieces of line in which the plane y = 0 cuts triangles, each once. A triangle that lies in the plane has no line
/// of its own: its neighbours out of the plane do.
pub(super) fn section(triangles: &[[DVec3; 3]]) -> Vec<[DVec3; 2]> {
    let mut lines: Vec<[DVec3; 2]> = triangles.iter().filter_map(cut).collect();
    let key = |line: &[DVec3; 2]| line.map(|p| [p.x, p.z]);
    lines.sort_by(|a, b| key(a).as_flattened().partial_cmp(key(b).as_flattened()).unwrap_or(std::cmp::Ordering::Equal));
    lines.dedup();
    lines
}

/// PeriodicBounds in the order of x, then z, so that both triangles at an edge in the plane give the same line.
fn cut(triangle: &[DVec3; 3]) -> Option<[DVec3; 2]> {
    let mut ends = Vec::new();
    for k in 0..3 {
        let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
        if a.y == 0.0 {
            ends.push(a);
        } else if a.y * b.y < 0.0 {
            // From the lower end, whichever way the edge runs: neighbours find the same point.
            let (a, b) = if a.y < b.y { (a, b) } else { (b, a) };
            ends.push((a + (b - a) * (a.y / (a.y - b.y))).with_y(0.0));
        }
    }
    let &[a, b] = ends.as_slice() else { return None };
    Some(if (a.x, a.z) <= (b.x, b.z) { [a, b] } else { [b, a] })
}

/// Two triangles for each line, reaching from y = -half to half: whatever grains at y = 0 touch is what they would
/// touch of endless strips.
pub(super) fn strips(lines: &[[DVec3; 2]], half: f64) -> Vec<[DVec3; 3]> {
    let strip = |&[a, b]: &[DVec3; 2]| {
        let at = |p: DVec3, y: f64| p.with_y(y);
        [[at(a, -half), at(b, -half), at(b, half)], [at(a, -half), at(b, half), at(a, half)]]
    };
    lines.iter().flat_map(strip).collect()
}
