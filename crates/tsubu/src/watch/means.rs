//! Means and spreads over time of a fixed number of values, and between which ends they were.

/// Sums and counts; what is not a number is left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Means {
    sum: Vec<f64>,
    count: Vec<f64>,
    /// Squares of the distances from the mean (Welford): small differences of large numbers stay exact.
    square: Vec<f64>,
}

impl Means {
    pub fn new(values: usize) -> Self {
        Self { sum: vec![0.0; values], count: vec![0.0; values], square: vec![0.0; values] }
    }

    /// Takes one value of each; makes room at the first look.
    pub fn take(&mut self, values: impl ExactSizeIterator<Item = f64>) {
        if self.sum.len() != values.len() {
            *self = Self::new(values.len());
        }
        let sums = self.sum.iter_mut().zip(&mut self.count).zip(&mut self.square);
        for (((sum, count), square), value) in sums.zip(values) {
            if !value.is_nan() {
                let before = if *count > 0.0 { *sum / *count } else { value };
                *sum += value;
                *count += 1.0;
                *square += (value - before) * (value - *sum / *count);
            }
        }
    }

    /// The means so far.
    pub fn get(&self) -> impl Iterator<Item = f64> {
        self.sum.iter().zip(&self.count).map(|(sum, count)| sum / count)
    }

    /// The standard deviations so far.
    pub fn spreads(&self) -> impl Iterator<Item = f64> {
        self.square.iter().zip(&self.count).map(|(square, count)| (square / count).sqrt())
    }

    /// As plain numbers, for a checkpoint.
    pub fn numbers(&self) -> Vec<f64> {
        self.sum.iter().chain(&self.count).chain(&self.square).copied().collect()
    }

    /// Back from [`Means::numbers`].
    pub fn from_numbers(numbers: &[f64]) -> Self {
        let (sum, rest) = numbers.split_at(numbers.len() / 3);
        let (count, square) = rest.split_at(sum.len());
        Self { sum: sum.to_vec(), count: count.to_vec(), square: square.to_vec() }
    }
}

/// The least and the largest of each of some values; what is not a number is left out.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Extremes(pub Vec<[f64; 2]>);

impl Extremes {
    pub fn new(values: usize) -> Self {
        Self(vec![[f64::NAN; 2]; values])
    }

    pub fn take(&mut self, values: &[f64]) {
        for ([least, largest], value) in self.0.iter_mut().zip(values) {
            (*least, *largest) = (least.min(*value), largest.max(*value));
        }
    }
}
