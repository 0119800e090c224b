//! Summary statistics of differences.

/// Mean, percentiles and maximum of the differences of all pixels. NaN is left out and counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// The mean.
    pub mean: f64,
    /// The median: half of the pixels differ by no more.
    pub p50: f64,
    /// The 95th percentile.
    pub p95: f64,
    /// The 99th percentile.
    pub p99: f64,
    /// The largest.
    pub max: f64,
    /// Index of the pixel with the largest difference.
    pub max_at: usize,
    /// Number of pixels left out.
    pub left_out: usize,
}

impl Summary {
    /// Summarizes one value per pixel; `None` if no value is a number.
    pub fn new(values: &[f64]) -> Option<Self> {
        let mut sorted: Vec<f64> = values.iter().copied().filter(|v| !v.is_nan()).collect();
        let left_out = values.len() - sorted.len();
        sorted.sort_by(f64::total_cmp);
        let max = *sorted.last()?;
        // The smallest value that this fraction of the pixels does not exceed.
        let percentile = |share: f64| {
            let rank = (share * sorted.len() as f64).ceil() as usize;
            sorted[rank.clamp(1, sorted.len()) - 1]
        };
        Some(Self {
            mean: sorted.iter().sum::<f64>() / sorted.len() as f64,
            p50: percentile(0.5),
            p95: percentile(0.95),
            p99: percentile(0.99),
            max,
            max_at: values.iter().position(|&v| v == max).unwrap_or_default(),
            left_out,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_those_of_the_sorted_values() {
        let mut values: Vec<f64> = (1..=200).map(f64::from).collect();
        values.reverse();
        values.insert(50, f64::NAN);
        let found = Summary::new(&values).unwrap();
        assert_eq!((found.p50, found.p95, found.p99), (100.0, 190.0, 198.0));
        assert_eq!((found.max, found.max_at, found.left_out), (200.0, 0, 1));
        assert_eq!(found.mean, 100.5);
    }

    #[test]
    fn of_nothing_there_are_no_figures() {
        assert_eq!(Summary::new(&[]), None);
        assert_eq!(Summary::new(&[f64::NAN]), None);
        let one = Summary::new(&[3.0]).unwrap();
        assert_eq!((one.p50, one.p99, one.mean), (3.0, 3.0, 3.0));
    }
}
