//! What the mean of a few numbers is worth: Student's t.

/// The 95 % confidence interval of the mean of independent numbers (Student 1908); not-a-number for fewer than two.
pub fn interval_of_mean(members: &[f64]) -> [f64; 2] {
    let count = members.len() as f64;
    let mean = members.iter().sum::<f64>() / count;
    if members.len() < 2 {
        return [f64::NAN; 2];
    }
    let variance = members.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (count - 1.0);
    let half = student(members.len() - 1) * (variance / count).sqrt();
    [mean - half, mean + half]
}

/// What Student's t stays within with a probability of 95 %, by bisection.
fn student(freedom: usize) -> f64 {
    let (mut low, mut high) = (0.0, 1e3);
    while high - low > 1e-12 * high {
        let middle = 0.5 * (low + high);
        if within(middle, freedom) < 0.95 { low = middle } else { high = middle }
    }
    high
}

/// Probability that Student's t lies between -t and t: the finite series for whole degrees of freedom (Abramowitz and Stegun
/// 1964, 26.7.3 and 26.7.4).
fn within(t: f64, freedom: usize) -> f64 {
    let angle = (t / (freedom as f64).sqrt()).atan();
    let (sin, cos) = angle.sin_cos();
    let odd = freedom % 2;
    let (mut term, mut sum) = if odd == 1 { (cos, 0.0) } else { (1.0, 0.0) };
    for k in (odd..freedom.saturating_sub(1)).step_by(2) {
        sum += term;
        term *= cos * cos * (k + 1) as f64 / (k + 2) as f64;
    }
    if odd == 1 { (angle + sin * sum) / std::f64::consts::FRAC_PI_2 } else { sin * sum }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table of every textbook.
    #[test]
    fn students_t_is_that_of_the_tables() {
        for (freedom, t) in [(1, 12.706), (2, 4.303), (3, 3.182), (4, 2.776), (9, 2.262), (19, 2.093), (60, 2.000)] {
            assert!((student(freedom) - t).abs() < 6e-4, "{freedom}: {}", student(freedom));
        }
    }

    /// Of 1, 2, 3 the mean is 2, its standard error 1/sqrt(3), and t with two degrees of freedom 4.303.
    #[test]
    fn three_numbers_leave_much_open() {
        let [low, high] = interval_of_mean(&[1.0, 2.0, 3.0]);
        assert!((0.5 * (low + high) - 2.0).abs() < 1e-12 && (high - 2.0 - 4.303 / 3.0_f64.sqrt()).abs() < 1e-3);
        assert!(interval_of_mean(&[1.0])[0].is_nan());
    }
}
