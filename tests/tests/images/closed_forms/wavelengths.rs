//! Wavelengths sampled at random within their bands, or fixed at the centers.

use super::comparison::{
    BANDS, DOWN, Estimate, WHITE, band_mean, check, film, pictures, render, scene,
};
use pellicle_tests::device::lend;
use pellicle_tests::tolerances::CLOSED_FORM_FILM;
use scene::Scene;
use spectra::SpectralImage;

const FRINGES: (f64, f64) = (1.4, 3000.0);

/// A film with many fringes per band in front of black, under constant light.
fn fringes(sampling: &str) -> Scene {
    const BLACK: &str = r#"
[materials.black]
type = "diffuse"
reflectance = 0

[[objects]]
type = "plane"
material = "black"
point = [0, -1, 0]
normal = [0, 1, 0]
"#;
    let (index, thickness_nm) = FRINGES;
    let sheet = "type = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 1, 0]";
    let film = film(&format!("{index:?}"), thickness_nm, sheet);
    scene(&[DOWN, &render(256, 2, sampling), BLACK, &film, WHITE])
}

fn fringe(wavelength_nm: f64) -> f64 {
    let (index, thickness_nm) = FRINGES;
    let film = optics::film(index.into(), thickness_nm, wavelength_nm, 1.0);
    film.reflectance.unpolarized()
}

/// The choice between reflection and transmission is the same in all bands, so the ratios of bands have no noise at all.
fn has_ratios_of_centers(image: &SpectralImage) -> bool {
    let found: Vec<f64> = (0..BANDS).map(|b| Estimate::of(image, b).mean).collect();
    let sought: Vec<f64> = (0..BANDS)
        .map(|b| fringe(image.bands().center_nm(b)))
        .collect();
    let (total, of) = (found.iter().sum::<f64>(), sought.iter().sum::<f64>());
    let error = |(f, s): (&f64, &f64)| (f / total / (s / of) - 1.0).abs();
    let mut errors = found.iter().zip(&sought).map(error);
    errors.all(|error| error <= CLOSED_FORM_FILM)
}

#[test]
fn fixed_wavelengths_are_the_centers_of_the_bands() {
    let gpu = lend();
    let fixed = fringes("center");
    check(&gpu, "centers", &fixed, CLOSED_FORM_FILM, |band| {
        fringe(fixed.settings().bands.center_nm(band))
    });
    let drawn = fringes("random");
    check(&gpu, "bands", &drawn, CLOSED_FORM_FILM, |band| {
        band_mean(&drawn, band, fringe)
    });
    for (who, image) in pictures(&gpu, &fixed) {
        assert!(has_ratios_of_centers(&image), "{who}");
    }
    for (who, image) in pictures(&gpu, &drawn) {
        assert!(
            !has_ratios_of_centers(&image),
            "{who}: the ratios of band means equal those of the centers"
        );
    }
}
