//! Which touches of a grain with a mesh are contacts of their own.
//!
//! A contact is a place where the distance from the grain's centre to the *whole* surface is smallest among its
//! surroundings. The nearest point of one triangle need not be one: at a seam of a plane the neighbour's nearest point
//! is the seam, and counting it would push the grain sideways (and twice). Two rules, nearest touches first:
//!
//! 1. A touch whose point lies on a nearer triangle is none: that triangle comes closer from there on. All nearer
//!    triangles that touch are asked, not only those accepted so far, so a plane may be cut as finely as one likes. Of
//!    touches at a common edge or corner the first is left: convex edges and corners are met once.
//! 2. Contacts whose normals differ by less than [`BENT`] touch one bent surface (a tessellated cylinder seen from
//!    inside, a gentle hill): the nearest counts. Two would be twice as stiff as the surface they stand for; and as the
//!    grain rolls on, the second one's point reaches the valley between them and rule 1 takes it away, with an overlap
//!    left and energy lost whenever the angle is below sqrt(2 overlap / radius). From [`BENT`] on that would take an
//!    overlap of 3.4 % of the radius. The price: edges nearer to each other than a quarter of the radius are not told
//!    apart.
//!
//! Two walls of a mesh box stay two contacts, as planes would give.

use super::Pose;
use super::mesh::Mesh;
use super::nearest::{Feature, Touch};
use glam::DVec3;

/// Cosine of 15 degrees.
const BENT: f64 = 0.965_925_826_289_068_3;
/// Share of the grain's distance within which a point lies on a triangle.
const ON: f64 = 1e-6;

/// Judges the touches of one grain; the contacts come to the front in the order of elements. Returns how many.
pub(super) fn distinct(mesh: &Mesh, pose: &Pose, touches: &mut [Touch]) -> usize {
    if touches.len() <= 1 {
        return touches.len();
    }
    touches.sort_unstable_by(|a, b| a.nearest.distance.total_cmp(&b.nearest.distance).then(a.element.cmp(&b.element)));
    let tolerance = mesh.tolerance.max(ON * touches[0].nearest.distance);
    touches[0].own = true;
    for i in 1..touches.len() {
        let (nearer, rest) = touches.split_at_mut(i);
        let touch = &mut rest[0];
        let bent = |n: &Touch| n.own && n.nearest.normal.dot(touch.nearest.normal) > BENT;
        let point = pose.to_own(touch.nearest.point);
        touch.own = !nearer.iter().any(bent) && !nearer.iter().any(|n| holds(mesh, n.element, touch, point, tolerance));
    }
    touches.sort_unstable_by_key(|t| (!t.own, t.element));
    touches.iter().take_while(|t| t.own).count()
}

/// Whether the point of a touch (in the mesh's own frame) lies on another triangle.
fn holds(mesh: &Mesh, element: u32, touch: &Touch, point: DVec3, tolerance: f64) -> bool {
    let vertices = &mesh.topology.vertices;
    let (theirs, ours) = (&vertices[element as usize], &vertices[touch.element as usize]);
    let shared = match touch.nearest.feature {
        Feature::Face => false,
        Feature::Edge(k) => {
            let k = usize::from(k);
            theirs.contains(&ours[k]) && theirs.contains(&ours[(k + 1) % 3])
        }
        Feature::Corner(k) => theirs.contains(&ours[usize::from(k)]),
    };
    shared || mesh.triangles()[element as usize].holds(point, tolerance)
}
