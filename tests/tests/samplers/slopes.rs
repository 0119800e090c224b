//! Normals of facets and what they mirror, as Cook's model of 1981 draws them.

use crate::chi_square::{Experiment, turns};
use glam::DVec3;
use optics::{
    gaussian_pdf, gaussian_share, half_vector_pdf, reflected_pdf, sample_beckmann, sample_gaussian,
};
use std::f64::consts::{PI, TAU};

const SLOPES: [f64; 6] = [0.05, 0.1, 0.2, 0.4, 0.7, 1.0];
const EYES_DEGREES: [f64; 4] = [0.0, 30.0, 60.0, 85.0];
/// How many of the tests are here.
pub(crate) const TESTS: usize = SLOPES.len() * (2 + EYES_DEGREES.len());

/// Facets, by q = 1 − exp(−tan²α / m²) and the azimuth; the density is taken for the slope `claimed`.
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
fn facets_are_drawn_by_half_vector_pdf() {
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

/// Facets of a Gaussian distribution of angles a, by q = (1 − exp(−a² / m²)) / Z and the azimuth; the density is taken for the slope
/// `claimed`.
fn gaussian_facets(slope: f64, claimed: f64, check: impl Fn(&Experiment)) {
    let (share, m2) = (gaussian_share(slope), slope * slope);
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
fn gaussian_facets_are_drawn_by_gaussian_pdf() {
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

/// Mirrored directions, by half of the angle to the eye and the azimuth about the eye. A facet that the eye sees from behind
/// mirrors nothing; directions below the horizon are counted like the others, as the density has them too.
fn mirrored(slope: f64, eye_degrees: f64, claimed: f64, check: impl Fn(&Experiment)) {
    let tilt = eye_degrees.to_radians();
    let eye = DVec3::new(tilt.sin(), 0.0, tilt.cos());
    // The normal lies at half a turn.
    let aside = DVec3::new(tilt.cos(), 0.0, -tilt.sin());
    let draw = |u: f64, v: f64| {
        let facet = DVec3::from_array(sample_beckmann(u, v, slope));
        let cosine = eye.dot(facet);
        if cosine <= 0.0 {
            return None;
        }
        let light = 2.0 * cosine * facet - eye;
        let half = 0.5 * light.cross(eye).length().atan2(light.dot(eye));
        let around = (light.y.atan2(light.dot(aside)) / TAU).rem_euclid(1.0);
        Some([half, around])
    };
    // Four slopes about the normal hold all but e⁻¹⁶ of the facets.
    let reach = (4.0 * slope).atan();
    let half = ((tilt - reach).max(0.0), (tilt + reach).min(0.5 * PI));
    let turn = if tilt > reach {
        (reach.sin() / tilt.sin()).min(1.0).asin() / TAU
    } else {
        0.5
    };
    let around = (0.5 - turn, 0.5 + turn);
    let inside = |at: &[f64; 2]| {
        (half.0..=half.1).contains(&at[0]) && (around.0..=around.1).contains(&at[1])
    };
    let density = |half: f64, around: f64| {
        let (sine, cosine) = (2.0 * half).sin_cos();
        let (sin_phi, cos_phi) = (TAU * around).sin_cos();
        let light = eye * cosine + (aside * cos_phi + DVec3::Y * sin_phi) * sine;
        let facet = (eye + light).normalize();
        reflected_pdf(facet.z, eye.dot(facet), claimed) * 2.0 * sine * TAU
    };
    check(&Experiment {
        name: format!("mirrored at slope {slope}, eye at {eye_degrees}°"),
        ranges: [half, around],
        draw: &|u, v| draw(u, v).filter(inside),
        density: &density,
        parts: 2,
        outside: None,
    });
}

fn each_view(check: impl Fn(u32, f64, f64)) {
    for (i, slope) in (0..).zip(SLOPES) {
        for (j, eye) in (0..).zip(EYES_DEGREES) {
            check(100 + 10 * i + j, slope, eye);
        }
    }
}

#[test]
fn mirrored_directions_are_drawn_by_reflected_pdf() {
    each_view(|seed, slope, eye| mirrored(slope, eye, slope, |right| right.holds(seed)));
}

#[test]
fn mirrored_directions_of_another_slope_are_noticed() {
    each_view(|seed, slope, eye| {
        mirrored(slope, eye, 0.95 * slope, |wrong| wrong.is_refused(seed));
    });
}
