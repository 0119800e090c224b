//! Surfaces that coincide: rays hit them in the order of their names, on both renderers.

use super::comparison::{BANDS, film, pictures, scene};
use optics::{Complex64, Layer};
use pellicle_tests::device::lend;
use pellicle_tests::frames::{Values, same_numbers};
use pellicle_tests::tolerances::{CLOSED_FORM_EXACT, FRAMES};
use spectra::SpectralImage;

/// A white environment in all directions, seen from +Z: a square of side 1 about the origin.
const FURNACE: &str = r#"
[camera]
type = "orthographic"
position = [0, 0, 5]
look_at = [0, 0, 0]
height = 1

[environment]
type = "constant"
emission = { constant = 1 }

[materials.gray]
type = "diffuse"
reflectance = 0.5

[materials.white]
type = "diffuse"
reflectance = 1

[materials.black]
type = "diffuse"
reflectance = 0
"#;

const RENDER: &str = "[render]\nsize = [16, 16]\nsamples = 64\nbands = 4\nsampling = \"center\"\nlight_groups = \"single\"\n";
/// None of the resulting coordinates has few digits.
const TILTED: &str = "normal = [0.31, 0.52, 1.07]\nup = [0.1, 1, 0.2]";

fn rectangle(material: &str, center: [f64; 3], size: f64, way: &str) -> String {
    format!(
        "[[objects]]\ntype = \"rectangle\"\nmaterial = \"{material}\"\ncenter = {center:?}\nsize = [{size:?}, {size:?}]\n{way}\n"
    )
}

fn ball(material: &str, radius: f64) -> String {
    format!(
        "[[objects]]\ntype = \"sphere\"\nmaterial = \"{material}\"\ncenter = [0.1, 0.2, 0]\nradius = {radius:?}\n"
    )
}

/// The largest deviation of any band of any pixel.
fn furthest(image: &SpectralImage, expected: f64) -> f64 {
    let values = image.radiance().iter();
    values.fold(0.0, |most, &value| {
        f64::max(most, (f64::from(value) - expected).abs())
    })
}

#[track_caller]
fn assert_everywhere(what: &str, parts: &[&str], expected: f64, allowance: f64) {
    let gpu = lend();
    for (who, image) in pictures(&gpu, &scene(parts)) {
        let off = furthest(&image, expected);
        assert!(
            off <= allowance,
            "{what}, {who}: off by {off:.1e} from {expected}"
        );
    }
}

/// In a white furnace a diffuse body shows its reflectance, whatever direction is sampled. A shadow ray blocked by the other surface of
/// the same plane would be noticed, and so would a point where the order changes.
#[test]
fn the_first_of_two_coplanar_rectangles_is_visible_from_its_front() {
    // Along the plane, from one center to the other.
    let wide = [0.123, 0.4, 0.037];
    let n = glam::DVec3::new(0.31, 0.52, 1.07);
    let along = n.cross(glam::DVec3::new(0.1, 1.0, 0.2)).normalize();
    let decal = (glam::DVec3::from_array(wide) + 0.21 * along).to_array();
    let gray = rectangle("gray", wide, 9.0, TILTED);
    let white = rectangle("white", decal, 8.0, TILTED);
    for (what, first, second, expected) in [
        ("gray first", &gray, &white, 0.5),
        ("white first", &white, &gray, 1.0),
    ] {
        let parts = [FURNACE, RENDER, first, second];
        assert_everywhere(what, &parts, expected, CLOSED_FORM_EXACT);
    }
    // From behind, the last one is visible.
    let turned = "normal = [-0.31, -0.52, -1.07]\nup = [0.1, 1, 0.2]";
    let gray = rectangle("gray", wide, 9.0, turned);
    let parts = [FURNACE, RENDER, &gray, &white];
    assert_everywhere("from behind", &parts, 1.0, CLOSED_FORM_EXACT);
}

/// The decal is visible within its edges, and the wall everywhere else.
#[test]
fn a_decal_covers_its_own_area_only() {
    let gpu = lend();
    let wall = rectangle("gray", [0.0; 3], 9.0, "normal = [0, 0, 1]");
    let decal = "[[objects]]\ntype = \"disk\"\nmaterial = \"white\"\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 0.25\n";
    for (who, image) in pictures(&gpu, &scene(&[FURNACE, RENDER, decal, &wall])) {
        let at = |x, y| f64::from(image.pixel(x, y)[0]);
        for (found, expected) in [
            (at(8, 8), 1.0),
            (at(7, 5), 1.0),
            (at(0, 0), 0.5),
            (at(15, 3), 0.5),
        ] {
            assert!(
                (found - expected).abs() < CLOSED_FORM_EXACT,
                "{who}: {found}"
            );
        }
        let mean =
            image.radiance().iter().map(|&v| f64::from(v)).sum::<f64>() / f64::from(256 * BANDS);
        let covered = std::f64::consts::PI * 0.25 * 0.25;
        assert!((mean - 0.5 - 0.5 * covered).abs() < 0.01, "{who}: {mean}");
    }
}

/// Film and ball without a gap, and with a gap that an `f32` cannot resolve; the film lies within the ball by name alone or by its radius.
#[test]
fn a_film_of_the_radius_of_its_ball_lies_on_the_ball() {
    const FRONT: &str = r#"
[camera]
type = "orthographic"
position = [0.1, 0.2, 5]
look_at = [0.1, 0.2, 0]
height = 1e-3
"#;
    let furnace = FURNACE.split_once("[environment]").unwrap().1;
    let furnace = format!("{FRONT}[environment]{furnace}");
    let on = |radius: f64| {
        film(
            "1.33",
            300.0,
            &ball("film", radius)
                .replacen("[[objects]]\n", "", 1)
                .replacen("material = \"film\"\n", "", 1),
        )
    };
    let body = ball("black", 0.9);
    let soap = on(0.9);
    let gpu = lend();
    for (what, first, second, is_seen) in [
        ("film first", &soap, &body, true),
        ("ball first", &body, &soap, false),
        ("film outside by 1e-7", &body, &on(0.900_000_1), true),
        ("film inside by 1e-7", &on(0.899_999_9), &body, false),
    ] {
        for (who, image) in pictures(&gpu, &scene(&[&furnace, RENDER, first, second])) {
            for band in 0..BANDS {
                let expected = if is_seen {
                    mean_reflectance(&image, band)
                } else {
                    0.0
                };
                let bands = BANDS as usize;
                let values = image.radiance().iter().skip(band as usize).step_by(bands);
                let mean = values.map(|&v| f64::from(v)).sum::<f64>() / 256.0;
                // The path chooses between reflection and transmission of the film, or follows both: the mean has the noise of that.
                assert!(
                    (mean - expected).abs() < 2e-3,
                    "{what}, {who}, band {band}: {mean} {expected}"
                );
            }
        }
    }
}

/// Reflectance of the film at normal incidence, at the wavelength in the middle of a band, which the render uses.
fn mean_reflectance(image: &SpectralImage, band: u32) -> f64 {
    let layer = Layer {
        index: 1.33.into(),
        thickness_nm: 300.0,
    };
    let nm = image.bands().wavelength_nm(band, 0.5);
    let film = optics::stack(1.0, &[layer], Complex64::ONE, nm, 1.0);
    film.reflectance.unpolarized()
}

/// A plane below a film in the same plane: light from the front is transmitted by the film, reflected and transmitted again, and none
/// is lost.
#[test]
fn a_film_in_the_plane_of_a_white_wall_loses_nothing() {
    let way = "type = \"rectangle\"\ncenter = [0.123, 0.4, 0.037]\nsize = [9, 9]\nnormal = [0.31, 0.52, 1.07]\nup = [0.1, 1, 0.2]";
    let wall = rectangle("white", [0.123, 0.4, 0.037], 9.0, TILTED);
    let render = RENDER.replace("light_groups", "max_path_segments = 32\nlight_groups");
    let gpu = lend();
    let seen = scene(&[FURNACE, &render, &film("1.5", 400.0, way), &wall]);
    for (who, image) in pictures(&gpu, &seen) {
        let mean =
            image.radiance().iter().map(|&v| f64::from(v)).sum::<f64>() / f64::from(256 * BANDS);
        assert!((mean - 1.0).abs() < 5e-3, "{who}: {mean}");
    }
}

/// A ball of 1e5 as the ground under a ball of 0.5: distances of hundreds of thousands must not cost the digits of halves.
#[test]
fn a_huge_ball_serves_as_ground_on_both_renderers() {
    const VIEW: &str = r#"
[camera]
type = "perspective"
position = [0, 1.2, 5]
look_at = [0, 0.4, 0]
fov_deg = 35

[environment]
type = "gradient"
zenith = { constant = 1 }
horizon = { constant = 0.3 }
ground = { constant = 0 }

[materials.gray]
type = "diffuse"
reflectance = 0.5

[materials.lamp]
type = "emitter"
emission = { constant = 5 }

[[objects]]
type = "sphere"
material = "gray"
center = [0, 0.5, 0]
radius = 0.5

[[objects]]
type = "sphere"
material = "lamp"
center = [2, 2, 1]
radius = 0.3
"#;
    let gpu = lend();
    for (center, radius) in [
        ("[0, -1e5, 0]", 1e5),
        ("[3e3, -4e3, 0]", 5e3),
        ("[0, -1e6, 0]", 1e6),
    ] {
        let ground = format!(
            "[[objects]]\ntype = \"sphere\"\nmaterial = \"gray\"\ncenter = {center}\nradius = {radius:?}\n"
        );
        let render = "[render]\nsize = [48, 36]\nsamples = 16\nbands = 4\n";
        let [(_, on_gpu), (_, on_cpu)] = pictures(&gpu, &scene(&[VIEW, render, &ground]));
        let compared = same_numbers(Values::of(&on_gpu), Values::of(&on_cpu), &FRAMES);
        assert!(compared.is_ok(), "{radius}: {compared:?}");
    }
}
