//! Where paths divide: at a film into reflection and transmission, both or one of them; and where they end by chance.

/// The least share of the paths that follow the reflection of a film, and the least that follow its transmission: what is seen
/// faintly may be bright all the same.
const LEAST_PROBABILITY: f64 = 0.25;

/// A part of the light that is a rounding of none.
const NOTHING: f64 = 1e-9;

/// The least chance that a path has to go on at Russian roulette, which bounds its weight.
const LEAST_SURVIVAL: f64 = 0.05;

/// Share of the paths that follow the reflection of a film of which about the part `reflected` is reflected. It steers noise only:
/// the weight undoes it. Nothing is drawn for a reflection that there is none of.
pub fn reflection_probability(reflected: f64) -> f64 {
    if reflected <= NOTHING {
        return 0.0;
    }
    reflected.clamp(LEAST_PROBABILITY, 1.0 - LEAST_PROBABILITY)
}

/// Chance that a path goes on through which about the part `throughput` of the light comes. The same for all its wavelengths, so
/// that each is right on average.
pub fn rr_survival_probability(throughput: f64) -> f64 {
    throughput.clamp(LEAST_SURVIVAL, 1.0)
}
