//! Corners that differ by rounding are one corner.

use crate::plan::Vector;
use std::collections::HashMap;

/// Distance over the size of the mesh within which corners are one corner.
const WELD: f64 = 1e-9;

/// Numbers the corners; those nearer to each other than rounding are one. `None` for triangles that are not finite.
pub(super) fn weld(triangles: &[[Vector; 3]], size: f64) -> (Vec<Option<[usize; 3]>>, usize) {
    let reach = if size.is_finite() { WELD * size } else { 0.0 };
    let mut known: HashMap<[i64; 3], Vec<(Vector, usize)>> = HashMap::new();
    let mut count = 0;
    let mut number = |corner: Vector| {
        // Cells are wider than the reach both ways, so that what is near is in one of two cells an axis; whatever rounding
        // does, its own cell is one of them, because rounding keeps the order of numbers.
        let cell = |x: f64| if reach > 0.0 { (x / (4.0 * reach)).floor() as i64 } else { 0 };
        let [low, high] = [-reach, reach].map(|step| corner.map(|x| cell(x + step)));
        for steps in 0..8 {
            if (0..3).any(|i| steps >> i & 1 == 1 && low[i] == high[i]) {
                continue;
            }
            let key = [0, 1, 2].map(|i| if steps >> i & 1 == 0 { low[i] } else { high[i] });
            let near = |other: &&(Vector, usize)| (0..3).all(|i| (other.0[i] - corner[i]).abs() <= reach);
            if let Some((_, number)) = known.get(&key).and_then(|there| there.iter().find(near)) {
                return *number;
            }
        }
        known.entry(corner.map(cell)).or_default().push((corner, count));
        count += 1;
        count - 1
    };
    let numbered = triangles
        .iter()
        .map(|triangle| triangle.iter().flatten().all(|x| x.is_finite()).then(|| triangle.map(&mut number)))
        .collect();
    (numbered, count)
}
