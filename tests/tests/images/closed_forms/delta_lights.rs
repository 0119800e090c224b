//! Lights without extent: the radiance of a surface that they light directly or through a film, and Cook's model as printed.

use super::comparison::{ALBEDO, DOWN, LAMBERT, band_mean, check, film, render, scene};
use optics::Complex64;
use pellicle_tests::device::lend;
use pellicle_tests::tolerances::{CLOSED_FORM, CLOSED_FORM_EXACT};
use std::f64::consts::PI;

/// A distant light at an angle from the vertical, with spectral irradiance 1.
fn distant(degrees: f64) -> String {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    format!(
        "[[lights]]\ntype = \"distant\"\nemission = {{ constant = 1 }}\ndirection = [{sine:?}, {cosine:?}, 0]\n"
    )
}

/// A floor so small that light reflected back by a film hardly hits it.
fn small_floor(material: &str) -> String {
    format!(
        "[[objects]]\ntype = \"rectangle\"\nmaterial = \"{material}\"\ncenter = [0, 0, 0]\nnormal = [0, 1, 0]\nsize = [0.02, 0.02]\n"
    )
}

/// E cos θ T(θ) ρ / π, for a sheet that transmits light without bending it.
#[test]
fn a_film_dims_a_light_without_extent() {
    const SHEET: &str =
        "type = \"rectangle\"\ncenter = [0, 2, 0]\nnormal = [0, 1, 0]\nsize = [9, 9]";
    let gpu = lend();
    for (what, index, thickness_nm, degrees) in [
        ("glass", Complex64::new(1.5, 0.0), 400.0, 0.0),
        ("glass aslant", Complex64::new(1.5, 0.0), 400.0, 50.0),
        ("smoked, aslant", Complex64::new(1.7, 0.2), 250.0, 30.0),
    ] {
        let written = format!("[{:?}, {:?}]", index.re, index.im);
        let lit = scene(&[
            DOWN,
            &render(64, 3, "random"),
            LAMBERT,
            &small_floor("lambert"),
            &distant(degrees),
            &film(&written, thickness_nm, SHEET),
        ]);
        let cosine = degrees.to_radians().cos();
        check(&gpu, what, &lit, CLOSED_FORM, |band| {
            let through = |nm| {
                let film = optics::film(index, thickness_nm, nm, cosine);
                film.transmittance.unpolarized()
            };
            ALBEDO / PI * cosine * band_mean(&lit, band, through)
        });
    }
}

/// F of a dielectric, G and D₂ as Suzuki, Yokoi and Toriwaki print them (3-1), for `wo` along the normal.
struct Printed {
    n: f64,
    slope: f64,
}

impl Printed {
    /// F D₂ G / (π (N·E)) for light at an angle from the normal.
    fn specular(&self, angle: f64) -> f64 {
        // The facet normal is half way between the normal, which is `wo`, and the light.
        let facet = angle / 2.0;
        let c = facet.cos();
        let g = (self.n * self.n + c * c - 1.0).sqrt();
        let inner = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
        let fresnel = 0.5 * ((g - c) / (g + c)).powi(2) * (1.0 + inner * inner);
        let d2 = (-(facet.tan() / self.slope).powi(2)).exp()
            / (self.slope.powi(2) * facet.cos().powi(4));
        let groove = (2.0 * angle.cos()).min(1.0);
        fresnel * d2 * groove / PI
    }
}

/// I = E (s F D₂ G / (π (N·E)) + (N·L) d ρ / π), plus, for light from everywhere, Iₐ (s F₀ + d ρ); normalized, a quarter of the
/// specular part.
#[test]
fn cooks_model_is_lit_as_printed() {
    let gpu = lend();
    let surface = Printed { n: 1.8, slope: 0.3 };
    for (normalization, factor) in [("printed", 1.0), ("normalized", 0.25)] {
        for degrees in [10.0_f64, 40.0, 70.0] {
            let material = format!(
                "[materials.cook]\ntype = \"conductor\"\nindex = 1.8\nroughness = 0.3\n\
                 [materials.cook.model.cook1981]\nnormalization = \"{normalization}\"\nspecular = 0.6\ndiffuse = 0.3\ndiffuse_reflectance = 0.5\n\
                 ambient = {{ constant = 0.25 }}\n"
            );
            let lit = scene(&[
                DOWN,
                &render(16, 2, "random"),
                &material,
                &small_floor("cook"),
                &distant(degrees),
            ]);
            let angle = degrees.to_radians();
            let (s, diffuse) = (0.6, 0.3 * 0.5);
            // ((1.8 − 1) / (1.8 + 1))².
            let normal = 0.081_632_653;
            let expected = factor * s * surface.specular(angle)
                + angle.cos() * diffuse / PI
                + 0.25 * (s * normal + diffuse);
            let what = format!("{normalization}, {degrees}°");
            check(&gpu, &what, &lit, CLOSED_FORM_EXACT, |_| expected);
        }
    }
}
