//! Facet normals as Cook's model of 1981 samples them.

use super::chi_square::{Experiment, turns};
use glam::DVec3;
use optics::{gaussian_fraction, gaussian_pdf, half_vector_pdf, sample_beckmann, sample_gaussian};
use std::f64::consts::TAU;

const SLOPES: [f64; 6] = [0.05, 0.1, 0.2, 0.4, 0.7, 1.0];
/// Number of tests in this file.
pub(crate) const TESTS: usize = 2 * SLOPES.len();

/// Facets, by q = 1 − exp(−tan²α / m²) and the azimuth; the density is that of the slope `claimed`.
fn facets(slope: f64, claimed: f64, check: impl Fn(&Experiment)) {
    let draw = |u: f64, v: f64| {
        let h = DVec3::from_array(sample_beckmann(u, v, slope));
        let tan2 = (h.x * h.x + h.y * h.y) / (h.z * h.z);
        Some([-(-tan2 / (slope * slope)).exp_m1(), turns(h)])
    };
    let density = |q: f64, _| {
        let tan2 = -slope * slope * (-q).ln_1p();
        let cosine = 1.0 / (1.0 + tan2).sqrt();
        let cosine_per_q = 0.5 * cosine.powi(3) * slope * slope / (1.0 - q);
        half_vector_pdf(cosine, claimed) * TAU * cosine_per_q
    };
    check(&Experiment {
        name: format!("facets of slope {slope}"),
        ranges: [(0.0, 1.0), (0.0, 1.0)],
        draw: &draw,
        density: &density,
        parts: 2,
        outside: Some(0.0),
    });
}

#[test]
fn facets_are_sampled_by_half_vector_pdf() {
    for (seed, slope) in (31..).zip(SLOPES) {
        facets(slope, slope, |experiment| experiment.holds(seed));
    }
}

#[test]
fn facets_of_another_slope_are_noticed() {
    for (seed, slope) in (31..).zip(SLOPES) {
        facets(slope, 0.97 * slope, |wrong| wrong.is_refused(seed));
    }
}

/// Facets of a Gaussian distribution of angles a, by q = (1 − exp(−a² / m²)) / Z and the azimuth; the density is that of the slope
/// `claimed`.
fn gaussian_facets(slope: f64, claimed: f64, check: impl Fn(&Experiment)) {
    let (share, m2) = (gaussian_fraction(slope), slope * slope);
    let draw = |u: f64, v: f64| {
        let h = DVec3::from_array(sample_gaussian(u, v, slope));
        let angle = h.x.hypot(h.y).atan2(h.z);
        Some([-(-angle * angle / m2).exp_m1() / share, turns(h)])
    };
    let density = |q: f64, _| {
        let angle = slope * (-(-q * share).ln_1p()).sqrt();
        let angle_per_q = share * m2 / (2.0 * angle * (1.0 - q * share));
        gaussian_pdf(angle.cos(), claimed) * TAU * angle.sin() * angle_per_q
    };
    check(&Experiment {
        name: format!("Gaussian facets of slope {slope}"),
        ranges: [(0.0, 1.0), (0.0, 1.0)],
        draw: &draw,
        density: &density,
        outside: Some(0.0),
        parts: 4,
    });
}

#[test]
fn gaussian_facets_are_sampled_by_gaussian_pdf() {
    for (seed, slope) in (41..).zip(SLOPES) {
        gaussian_facets(slope, slope, |experiment| experiment.holds(seed));
    }
}

#[test]
fn gaussian_facets_of_another_slope_are_noticed() {
    for (seed, slope) in (41..).zip(SLOPES) {
        gaussian_facets(slope, 0.95 * slope, |wrong| wrong.is_refused(seed));
    }
}
