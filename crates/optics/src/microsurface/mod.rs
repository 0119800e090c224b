//! Rough surfaces made of facets that each mirror: distributions of slopes with Smith's masking.
//!
//! Directions are unit vectors in a local frame: the third component is the cosine with the macroscopic normal, the first runs
//! along the grain of a brushed surface, the second across it.
//!
//! A distribution of width α along and across the grain is a stretched distribution of width 1. The area of facets that face
//! a direction w is (1 + Λ(w)) cos θ, with Smith's Λ (1967). Heights of neighboring facets are assumed independent; masking and
//! shadowing of a facet are correlated by its height (Heitz, Understanding the Masking-Shadowing Function, JCGT 3(2), 2014,
//! equations 83, 86 and 99).

mod erf;
mod multiple;
mod slopes;

pub use multiple::{MEAN_COSINES, mean_reflectance, multiple_color};

use erf::erfc_and_gauss;
use std::f64::consts::PI;

/// Distribution of the slopes of facets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Distribution {
    /// Normal: the density of slopes s is exp(−s²/α²) / (π α²) (Beckmann and Spizzichino 1963).
    Beckmann,
    /// Long-tailed: 1 / (π α² (1 + s²/α²)²) (Trowbridge and Reitz 1975; GGX of Walter et al. 2007).
    Ggx,
}

/// The facets of a rough surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Microsurface {
    /// Distribution of their slopes.
    pub distribution: Distribution,
    /// Width α of the distribution along and across the grain, > 0.
    pub alpha: [f64; 2],
}

impl Microsurface {
    /// Density D of facet normals, sr⁻¹: ∫ D cos θ dω = 1. With s² = (x/αx)² + (y/αy)² and c the cosine, D is
    /// exp(−s²/c²) / (π αx αy c⁴) for Beckmann and 1 / (π αx αy (s² + c²)²) for GGX.
    pub fn density(&self, facet: [f64; 3]) -> f64 {
        let [x, y, cosine] = facet;
        if cosine <= 0.0 {
            return 0.0;
        }
        let [along, across] = self.alpha;
        let slope2 = (x / along).powi(2) + (y / across).powi(2);
        let cos2 = cosine * cosine;
        let area = PI * along * across;
        match self.distribution {
            Distribution::Beckmann => (-slope2 / cos2).exp() / (area * cos2 * cos2),
            Distribution::Ggx => 1.0 / (area * (slope2 + cos2).powi(2)),
        }
    }

    /// Smith's Λ: a fraction 1 / (1 + Λ) of the facets that face a direction is visible from it. With a = cot θ over the width
    /// in the direction's azimuth, Λ is (exp(−a²) / (a √π) − erfc a) / 2 for Beckmann and (√(1 + 1/a²) − 1) / 2 for GGX
    /// (Heitz 2014, equations 68 and 72).
    pub fn lambda(&self, direction: [f64; 3]) -> f64 {
        let [x, y, cosine] = direction;
        let [along, across] = self.alpha;
        let width = (along * x).hypot(across * y);
        if width == 0.0 {
            return 0.0;
        }
        let a = cosine.abs() / width;
        match self.distribution {
            Distribution::Beckmann => {
                let (erfc, gauss) = erfc_and_gauss(a);
                0.5 * (gauss / (a * PI.sqrt()) - erfc).max(0.0)
            }
            Distribution::Ggx => 0.5 * ((1.0 + 1.0 / (a * a)).sqrt() - 1.0),
        }
    }

    /// BRDF of facets that reflect everything, sr⁻¹: D G / (4 (N·E)(N·L)) with
    /// G = 1 / (1 + Λ(E) + Λ(L)). The light that other facets shadow is missing.
    pub fn reflection(&self, wo: [f64; 3], wi: [f64; 3]) -> f64 {
        let Some(facet) = facet_between(wo, wi) else {
            return 0.0;
        };
        let seen = 1.0 / (1.0 + self.lambda(wo) + self.lambda(wi));
        self.density(facet) * seen / (4.0 * wo[2] * wi[2])
    }

    /// Density with which a facet sampled by [`Self::sample`] mirrors `wo` to `wi`, sr⁻¹: D / (4 (N·E) (1 + Λ(E)))
    /// (Heitz 2014, equations 16 and 17 with the Jacobian 1 / (4 E·H)).
    pub fn pdf(&self, wo: [f64; 3], wi: [f64; 3]) -> f64 {
        if wo[2] <= 0.0 {
            return 0.0;
        }
        let facet = half_vector(wo, wi);
        if dot(wo, facet) <= 0.0 {
            return 0.0;
        }
        self.density(facet) / (4.0 * wo[2] * (1.0 + self.lambda(wo)))
    }

    /// [`Self::reflection`] and [`Self::pdf`], which share most of their work; 0 where a direction is below the surface.
    pub fn scattering(&self, wo: [f64; 3], wi: [f64; 3]) -> (f64, f64) {
        let Some(facet) = facet_between(wo, wi) else {
            return (0.0, 0.0);
        };
        let (density, hidden) = (self.density(facet), self.lambda(wo));
        let seen = density / (4.0 * wo[2]);
        let both = 1.0 + hidden + self.lambda(wi);
        (seen / (both * wi[2]), seen / (1.0 + hidden))
    }

    /// Samples a facet normal from those visible from `wo`, with two uniform numbers in [0, 1).
    ///
    /// GGX: Dupuy and Benyoub, Sampling Visible GGX Normals with Spherical Caps (2023). Beckmann: in the space of slopes
    /// (Heitz and d'Eon 2014).
    pub fn sample(&self, wo: [f64; 3], u: f64, v: f64) -> [f64; 3] {
        let [along, across] = self.alpha;
        // The same surface stretched to α = 1.
        let stretched = normalized([along * wo[0], across * wo[1], wo[2]]);
        let facet = match self.distribution {
            Distribution::Beckmann => slopes::sample_visible_beckmann(stretched, u, v),
            Distribution::Ggx => slopes::sample_visible_ggx(stretched, u, v),
        };
        normalized([along * facet[0], across * facet[1], facet[2].max(0.0)])
    }

    /// Albedo of single scattering: the fraction of the light from `wo` that leaves facets that reflect everything after one
    /// reflection. The remaining light meets another facet.
    ///
    /// By the rule of [`Self::each_reflection`].
    pub fn albedo(&self, wo: [f64; 3], steps: u32) -> f64 {
        let mut sum = 0.0;
        self.each_reflection(wo, steps, |_, weight| sum += weight);
        sum
    }

    /// Calls `f` for each facet from which light leaves after one reflection, with the cosine at the facet and its fraction of the
    /// light.
    ///
    /// Uses the midpoint rule with `steps`² facets, distributed like the visible facets of a GGX surface of the same α, but more
    /// densely where they are steep.
    pub fn each_reflection(&self, wo: [f64; 3], steps: u32, mut f: impl FnMut(f64, f64)) {
        let spread = Self {
            distribution: Distribution::Ggx,
            ..*self
        };
        let place = |i: u32| (f64::from(i) + 0.5) / f64::from(steps);
        let lambda_wo = self.lambda(wo);
        let all = (1.0 + spread.lambda(wo)) / f64::from(steps * steps);
        for i in 0..steps {
            for j in 0..steps {
                // Values of the second number near 1 give steep facets, in the long tail of the slopes.
                let rest = place(j);
                let facet = spread.sample(wo, place(i), 1.0 - rest * rest);
                let wi = mirrored(wo, facet);
                if wi[2] > 0.0 {
                    let seen = 1.0 / (1.0 + lambda_wo + self.lambda(wi));
                    let weight = 2.0 * rest * self.density(facet) / spread.density(facet) * seen;
                    f(dot(wo, facet), weight * all);
                }
            }
        }
    }
}

/// Returns the facet that mirrors one direction into the other; `None` where either is below the surface.
fn facet_between(wo: [f64; 3], wi: [f64; 3]) -> Option<[f64; 3]> {
    let is_above = wo[2] > 0.0 && wi[2] > 0.0;
    is_above.then(|| half_vector(wo, wi))
}

/// Returns `wo` mirrored at a facet.
fn mirrored(wo: [f64; 3], facet: [f64; 3]) -> [f64; 3] {
    let twice = 2.0 * dot(wo, facet);
    std::array::from_fn(|i| twice * facet[i] - wo[i])
}

fn half_vector(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    normalized([a[0] + b[0], a[1] + b[1], a[2] + b[2]])
}

fn normalized(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests;
