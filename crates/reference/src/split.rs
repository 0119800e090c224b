//! Where paths split or end: reflection, transmission or both at a film, and Russian roulette.

/// The least probability of following the reflection of a film, and of following its transmission: even a weak reflection may show
/// something bright.
const MIN_PROBABILITY: f64 = 0.25;

/// A fraction of the light that is 0 up to rounding.
const NOTHING: f64 = 1e-9;

/// The least survival probability of a path in Russian roulette, which bounds its weight.
const MIN_SURVIVAL: f64 = 0.05;

/// Returns the probability of following the reflection of a film that reflects roughly the fraction `reflected`. It affects noise
/// only: the weight divides by it. A reflection of 0 is never sampled.
pub fn reflection_probability(reflected: f64) -> f64 {
    if reflected <= NOTHING {
        return 0.0;
    }
    reflected.clamp(MIN_PROBABILITY, 1.0 - MIN_PROBABILITY)
}

/// Returns the survival probability of a path with the estimated throughput `throughput`. It is the same for all its wavelengths,
/// so that each is unbiased.
pub fn rr_survival_probability(throughput: f64) -> f64 {
    throughput.clamp(MIN_SURVIVAL, 1.0)
}
