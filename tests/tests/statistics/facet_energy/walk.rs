//! A random walk on a surface of facets: Heitz, Hanika, d'Eon and Dachsbacher, Multiple-Scattering Microfacet BSDFs with the Smith
//! Model, ACM TOG 35(4), 2016. Between two facets the walk moves in a medium of facets at all heights, which it meets with the
//! probabilities of Smith's masking; the heights of successive facets are otherwise independent.
//!
//! A height is expressed as the fraction of the surface that lies below it, so that no distribution of heights is needed.

use optics::{Distribution, Microsurface};
use reference::random4;
use std::f64::consts::{PI, TAU};

/// More facets than any walk meets.
const MAX: u32 = 10_000;

/// Where a walk leaves, and the facets that it met.
pub(crate) struct Walk {
    /// The direction in which light leaves; `None` if it never did.
    pub(crate) left: Option<[f64; 3]>,
    /// Cosines at the facets.
    pub(crate) cosines: Vec<f64>,
}

impl Walk {
    /// A walk of light that arrives from `wo`, with random numbers identified by `index` and `seed`.
    pub(crate) fn new(surface: &Microsurface, wo: [f64; 3], index: u32, seed: u32) -> Self {
        let mut walk = Self {
            left: None,
            cosines: Vec::new(),
        };
        let mut direction = wo.map(|x| -x);
        let mut below = 1.0;
        for step in 0..MAX {
            let [height, u, v, _] = random4([index % 4096, index / 4096], step, 9, seed);
            let Some(met) = next_height(surface, direction, below, height) else {
                walk.left = Some(direction);
                break;
            };
            below = met;
            let back = direction.map(|x| -x);
            let facet = visible_facet(surface, back, u, v);
            let cosine = dot(back, facet);
            walk.cosines.push(cosine);
            direction = std::array::from_fn(|i| direction[i] + 2.0 * cosine * facet[i]);
        }
        walk
    }
}

/// The height at which a ray meets the next facet, or `None` if it leaves: upward it leaves with probability C^Λ(ω), and otherwise
/// C' = C (1 − u)^(−1/Λ(ω)) (equations 15 to 19 and algorithm 3); downward, Λ(−ω) = −1 − Λ(ω).
fn next_height(surface: &Microsurface, direction: [f64; 3], below: f64, u: f64) -> Option<f64> {
    let upwards = surface.lambda(direction);
    let lambda = if direction[2] > 0.0 {
        upwards
    } else {
        -1.0 - upwards
    };
    let leaves = direction[2] > 0.0 && u >= 1.0 - below.powf(lambda);
    (!leaves).then(|| below * (1.0 - u).powf(-1.0 / lambda))
}

/// Samples a facet in proportion to its visibility from a direction, which may be below the horizon.
fn visible_facet(surface: &Microsurface, wo: [f64; 3], u: f64, v: f64) -> [f64; 3] {
    match surface.distribution {
        // Spherical caps hold for all directions (Dupuy and Benyoub 2023).
        Distribution::Ggx => surface.sample(wo, u, v),
        Distribution::Beckmann => visible_beckmann_facet(surface.alpha, wo, u, v),
    }
}

/// Samples by the cumulative distribution of the slope, F(x) = cos θ erfc(−x) + sin θ exp(−x²) / √π up to x = cot θ (Heitz and d'Eon 2014),
/// with bisection down to rounding.
fn visible_beckmann_facet([along, across]: [f64; 2], wo: [f64; 3], u: f64, v: f64) -> [f64; 3] {
    let stretched = normalized([along * wo[0], across * wo[1], wo[2]]);
    let sine = stretched[0].hypot(stretched[1]);
    // Straight from above, any azimuth will do.
    let (x, y) = if sine > 0.0 {
        (stretched[0] / sine, stretched[1] / sine)
    } else {
        (1.0, 0.0)
    };
    let below = |cosine: f64, sine: f64, share: f64| {
        let f = |x: f64| cosine * libm::erfc(-x) + sine / PI.sqrt() * (-x * x).exp();
        let steepest = (cosine / sine).min(7.0);
        let (mut low, mut high) = ((-7.0_f64).min(steepest - 2.0), steepest);
        let wanted = share * f(steepest);
        for _ in 0..48 {
            let middle = 0.5 * (low + high);
            if f(middle) < wanted {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    };
    let toward = below(stretched[2], sine, u);
    let aside = below(1.0, 0.0, v);
    normalized([
        -along * (x * toward - y * aside),
        -across * (y * toward + x * aside),
        1.0,
    ])
}

/// A unit vector with this cosine and azimuth; the azimuth is in turns.
pub(crate) fn direction(cosine: f64, turns: f64) -> [f64; 3] {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let (y, x) = (TAU * turns).sin_cos();
    [sine * x, sine * y, cosine]
}

fn normalized(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
