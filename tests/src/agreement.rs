//! Comparing numbers that should agree.

/// How far an actual number may lie from the expected one: `absolute` + `relative` · |expected|.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Always allowed.
    pub absolute: f64,
    /// Allowed per unit of the expected value.
    pub relative: f64,
}

/// Compares two lists and reports where they differ too much. A number that is not finite never agrees; lists of different
/// lengths and empty lists never agree either.
///
/// # Errors
/// A report of how many numbers differ, the worst one, and the distribution of the error divided by the allowed error.
pub fn compare(actual: &[f64], expected: &[f64], tolerance: Tolerance) -> Result<String, String> {
    if actual.len() != expected.len() || actual.is_empty() {
        return Err(format!(
            "{} numbers against {}",
            actual.len(),
            expected.len()
        ));
    }
    let excess = |(a, e): (&f64, &f64)| {
        let share = (a - e).abs() / (tolerance.absolute + tolerance.relative * e.abs());
        if share.is_nan() { f64::INFINITY } else { share }
    };
    let mut shares: Vec<(f64, usize)> = actual.iter().zip(expected).map(excess).zip(0..).collect();
    shares.sort_by(|a, b| a.0.total_cmp(&b.0));
    let at = |q: f64| shares[((shares.len() - 1) as f64 * q) as usize].0;
    let (worst, index) = shares[shares.len() - 1];
    let report = format!(
        "error / allowed: median {:.2e}, p99 {:.2e}, max {worst:.2e} (number {index}: {:e} instead of {:e})",
        at(0.5),
        at(0.99),
        actual[index],
        expected[index],
    );
    if worst <= 1.0 {
        return Ok(report);
    }
    let wrong = shares.iter().filter(|(share, _)| *share > 1.0).count();
    Err(format!("{wrong} of {} differ; {report}", shares.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TIGHT: Tolerance = Tolerance {
        absolute: 0.0,
        relative: 1e-3,
    };

    #[test]
    fn the_comparator_can_fail() {
        let truth = [1.0, 2.0, 3.0];
        assert!(compare(&truth, &truth, TIGHT).is_ok());
        assert!(compare(&[1.0, 2.0, 3.03], &truth, TIGHT).is_err());
        assert!(compare(&[1.0, f64::NAN, 3.0], &truth, TIGHT).is_err());
        assert!(compare(&[f64::INFINITY, 2.0, 3.0], &truth, TIGHT).is_err());
        assert!(compare(&[1.0, 2.0], &truth, TIGHT).is_err());
        assert!(compare(&[], &[], TIGHT).is_err());
        assert!(compare(&[2.0, 1.0, 3.0], &truth, TIGHT).is_err());
    }
}
