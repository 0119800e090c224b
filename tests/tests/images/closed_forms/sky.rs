//! The clear sky and its sun: the radiance of flat ground and of the sun, against spectral sums of the model itself.

use super::comparison::{ALBEDO, BANDS, DOWN, FLOOR, LAMBERT, band_mean, check, render, scene};
use pellicle_tests::device::lend;
use pellicle_tests::tolerances::{CLOSED_FORM, SKY_PICTURE};
use spectra::Spectrum;
use spectra::sky::{ClearSky, SUN_DIAMETER_DEG, daylight_basis};
use std::f64::consts::{FRAC_PI_2, PI};

const TURBIDITY: f64 = 2.5;
const AZIMUTH_DEG: f64 = 70.0;
/// Reflectance of the ground below the horizon.
const GROUND: f64 = 0.3;

fn sky(elevation_deg: f64, sun: bool) -> String {
    format!(
        "[environment]\ntype = \"sky\"\nsun_elevation_deg = {elevation_deg:?}\nsun_azimuth_deg = {AZIMUTH_DEG:?}\n\
         turbidity = {TURBIDITY:?}\nground = {GROUND:?}\nsun = {sun}\n"
    )
}

fn model(elevation_deg: f64) -> ClearSky {
    ClearSky::new(FRAC_PI_2 - elevation_deg.to_radians(), TURBIDITY)
}

/// ∫ cos dω of the amounts of daylight's components, by the midpoint rule over half of the sky; the other half is its mirror image.
fn amounts_on_the_ground(elevation_deg: f64) -> [f64; 3] {
    const STEPS: u32 = 400;
    let (sky, sun) = (model(elevation_deg), FRAC_PI_2 - elevation_deg.to_radians());
    let mut sums = [0.0; 3];
    let places =
        |ends: f64| (0..STEPS).map(move |i| ends * (f64::from(i) + 0.5) / f64::from(STEPS));
    for angle in places(FRAC_PI_2) {
        for turn in places(PI) {
            let toward = sun.cos() * angle.cos() + sun.sin() * angle.sin() * turn.cos();
            let light = sky.light(angle.cos(), toward.clamp(-1.0, 1.0).acos());
            let cell = PI * PI / f64::from(STEPS * STEPS);
            for (sum, amount) in sums.iter_mut().zip(light.amounts) {
                *sum += amount * angle.cos() * angle.sin() * cell;
            }
        }
    }
    sums
}

/// Irradiance of flat ground by the sky at a wavelength.
fn by_sky(amounts: [f64; 3], components: &[Spectrum; 3], nm: f64) -> f64 {
    let terms = amounts.iter().zip(components);
    terms.map(|(amount, of)| amount * of.at(nm).unwrap()).sum()
}

/// Irradiance of flat ground by the sun: its radiance times ∫ cos dω over its disk, π sin² of half its angular diameter times the sine
/// of its elevation.
fn by_sun(elevation_deg: f64, nm: f64) -> f64 {
    let solid = PI * (0.5 * SUN_DIAMETER_DEG).to_radians().sin().powi(2);
    model(elevation_deg).sun_radiance(nm) * solid * elevation_deg.to_radians().sin()
}

/// ρ E / π.
#[test]
fn ground_under_the_sky_and_its_sun() {
    let (gpu, components) = (lend(), daylight_basis());
    for (elevation_deg, sun) in [(12.0, false), (60.0, true)] {
        let amounts = amounts_on_the_ground(elevation_deg);
        let sky = sky(elevation_deg, sun);
        let lit = scene(&[DOWN, &render(128, 2, "random"), LAMBERT, FLOOR, &sky]);
        let what = format!("sky of a sun at {elevation_deg}°, which is there: {sun}");
        check(&gpu, &what, &lit, SKY_PICTURE, |band| {
            let irradiance = |nm| {
                let of_sun = if sun { by_sun(elevation_deg, nm) } else { 0.0 };
                by_sky(amounts, &components, nm) + of_sun
            };
            ALBEDO / PI * band_mean(&lit, band, irradiance)
        });
    }
}

/// A view into the middle of the disk shows its radiance; the sky in front of it adds some 1e-5.
#[test]
fn the_sun_has_its_radiance_at_its_position() {
    let gpu = lend();
    let elevation_deg: f64 = 35.0;
    let (sin_h, cos_h) = elevation_deg.to_radians().sin_cos();
    let (sin_a, cos_a) = AZIMUTH_DEG.to_radians().sin_cos();
    let view = format!(
        "[camera]\ntype = \"perspective\"\nposition = [0, 0, 0]\nlook_at = [{}, {sin_h}, {}]\nfov_deg = 0.2\n",
        cos_h * sin_a,
        -cos_h * cos_a
    );
    let lit = scene(&[&view, &render(64, 1, "random"), &sky(elevation_deg, true)]);
    check(&gpu, "the sun", &lit, CLOSED_FORM, |band| {
        band_mean(&lit, band, |nm| model(elevation_deg).sun_radiance(nm))
    });
}

/// The ground of the sky model, below the horizon, and a plane of the same reflectance under the same sky have equal radiance.
#[test]
fn a_plane_looks_like_the_ground_beyond_it() {
    let gpu = lend();
    let lit = |floor: &str| {
        let material =
            format!("[materials.lambert]\ntype = \"diffuse\"\nreflectance = {GROUND:?}\n");
        scene(&[
            DOWN,
            &render(128, 2, "random"),
            &material,
            floor,
            &sky(40.0, true),
        ])
    };
    let bare = reference::render(&lit(""), &mut |_| std::ops::ControlFlow::Continue(()));
    let bare = bare.expect("nothing stops the render");
    let of_ground = |band| super::Estimate::of(&bare, band).mean;
    assert!((0..BANDS).all(|band| of_ground(band) > 0.0));
    check(&gpu, "a plane", &lit(FLOOR), SKY_PICTURE, of_ground);
}
