//! Means over time of a fixed number of values.

/// Sums and counts; what is not a number is left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Means {
    sum: Vec<f64>,
    count: Vec<f64>,
}

impl Means {
    pub fn new(values: usize) -> Self {
        Self { sum: vec![0.0; values], count: vec![0.0; values] }
    }

    /// Takes one value of each; makes room at the first look.
    pub fn take(&mut self, values: impl ExactSizeIterator<Item = f64>) {
        if self.sum.len() != values.len() {
            *self = Self::new(values.len());
        }
        for ((sum, count), value) in self.sum.iter_mut().zip(&mut self.count).zip(values) {
            if !value.is_nan() {
                *sum += value;
                *count += 1.0;
            }
        }
    }

    /// The means so far.
    pub fn get(&self) -> impl Iterator<Item = f64> {
        self.sum.iter().zip(&self.count).map(|(sum, count)| sum / count)
    }

    /// As plain numbers, for a checkpoint.
    pub fn numbers(&self) -> Vec<f64> {
        self.sum.iter().chain(&self.count).copied().collect()
    }

    /// Back from [`Means::numbers`].
    pub fn from_numbers(numbers: &[f64]) -> Self {
        let (sum, count) = numbers.split_at(numbers.len() / 2);
        Self { sum: sum.to_vec(), count: count.to_vec() }
    }
}
