//! Classes of grains by diameter.

/// Diameters that part the classes, rising [m]; without any there is no class.
#[derive(Clone, Debug)]
pub(super) struct Classes(Vec<f64>);

impl Classes {
    /// As a scene asks for them.
    pub fn new(sizes: Option<&Vec<f64>>) -> Self {
        Self(sizes.cloned().unwrap_or_default())
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        if self.0.is_empty() { 0 } else { self.0.len() + 1 }
    }

    /// The class of a grain: a diameter that parts two belongs to the larger.
    pub fn of(&self, diameter: f64) -> usize {
        self.0.partition_point(|size| *size <= diameter)
    }

    /// What they are called, in order: `below 1 mm`, `1 mm to 2 mm`, `from 2 mm`.
    pub fn names(&self) -> impl Iterator<Item = String> {
        let told = |size: &f64| format!("{} mm", (size * 1e9).round() / 1e6);
        let last = self.0.len();
        (0..self.len()).map(move |k| match k {
            0 => format!("below {}", told(&self.0[0])),
            k if k == last => format!("from {}", told(&self.0[k - 1])),
            k => format!("{} to {}", told(&self.0[k - 1]), told(&self.0[k])),
        })
    }
}
