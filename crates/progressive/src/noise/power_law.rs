//! A variance that falls by a power of the number of samples, and how aligned blocks add up to any number of samples.

/// The least and the greatest exponent. That of independent samples is 1, but where rare bright samples make the noise, it appears to
/// fall more slowly while they are still being found. A scrambled net in a smooth integrand has 3 (Owen 1997).
const EXPONENTS: [f64; 2] = [0.9, 3.0];
/// The exponent of independent samples.
const INDEPENDENT: f64 = 1.0;

/// The variance of the mean of an aligned block of samples.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PowerLaw {
    /// The variance of the mean of so many samples.
    at: (u32, f64),
    exponent: f64,
}

impl PowerLaw {
    /// The law after a step to so many samples with the mean square V(samples / 2) − V(samples).
    pub(super) fn after_step(samples: u32, square: f64, exponent: f64) -> Self {
        let at = (samples, square / (exponent.exp2() - 1.0));
        Self { at, exponent }
    }

    /// V of an aligned block of a power of two.
    fn block(&self, samples: f64) -> f64 {
        self.at.1 * (f64::from(self.at.0) / samples).powf(self.exponent)
    }

    /// The variance of the mean of the first samples, from aligned blocks: one for each digit of their number, the largest first.
    pub(super) fn variance(&self, samples: u32) -> f64 {
        let total = f64::from(samples);
        let mut rest = samples;
        let mut variance = 0.0;
        while rest > 0 {
            let size = 1_u32 << rest.ilog2();
            rest -= size;
            let block = f64::from(size);
            let weight = block / total;
            let covariance = 2.0 * self.block(2.0 * block) - self.block(block);
            variance += weight * weight * self.block(block);
            variance += 2.0 * weight * (f64::from(rest) / total) * covariance;
        }
        variance.max(0.0)
    }
}

/// The exponent from the mean squares of successive steps, the newest first; an older ratio weighs `older` times the next one. It is
/// that of independent samples if nothing is known.
pub(super) fn exponent(squares: &[f64], older: f64) -> f64 {
    let ratios = squares.windows(2).enumerate();
    let known = ratios.filter(|(_, pair)| pair[0] > 0.0 && pair[1] > 0.0);
    let (sum, weights) = known.fold((0.0, 0.0), |(sum, weights), (age, pair)| {
        let weight = older.powi(age as i32);
        (sum + weight * (pair[1] / pair[0]).log2(), weights + weight)
    });
    let [least, greatest] = EXPONENTS;
    if weights > 0.0 {
        (sum / weights).clamp(least, greatest)
    } else {
        INDEPENDENT
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn independent_samples_add_up_at_any_number() {
        let law = PowerLaw::after_step(64, 2.0 / 64.0, 1.0);
        for samples in [1, 2, 3, 7, 64, 65, 80, 96, 112, 127, 1000] {
            let found = law.variance(samples) * f64::from(samples);
            assert!((found - 2.0).abs() < 1e-12, "{samples}: {found}");
        }
    }

    /// By hand: 3 of 4 samples, where V(1) = 1, V(2) = ¼, V(4) = 1/16, so C(1) = −½ and C(2) = −⅛.
    #[test]
    fn blocks_of_a_net_add_up() {
        let law = PowerLaw::after_step(4, 3.0 / 16.0, 2.0);
        assert_eq!([1, 2, 4].map(|n| law.variance(n)), [1.0, 0.25, 0.0625]);
        let expected = (4.0 * 0.25 + 1.0 + 4.0 * -0.125) / 9.0;
        assert!((law.variance(3) - expected).abs() < 1e-15);
        // More samples are not always better: the fifth has no partner.
        assert!(law.variance(5) > law.variance(4));
    }

    #[test]
    fn an_exponent_is_that_of_the_steps() {
        let steps = |exponent: f64| [0.0, 1.0, 2.0, 3.0].map(|age: f64| (age * exponent).exp2());
        for known in [1.0, 1.5, 2.25, 3.0] {
            assert!((exponent(&steps(known), 0.6) - known).abs() < 1e-12);
        }
        assert_eq!(exponent(&steps(0.5), 0.6), 0.9);
        assert_eq!(exponent(&steps(4.0), 0.6), 3.0);
        let nothing: [&[f64]; 4] = [&[], &[1.0], &[0.0, 1.0], &[1.0, 0.0]];
        assert_eq!(nothing.map(|squares| exponent(squares, 0.6)), [1.0; 4]);
    }
}
