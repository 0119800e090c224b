//! Direct light by emitter sampling, by BSDF sampling, and by both: the means agree, and both together are hardly ever noisier
//! than the better of the two.

use pellicle_tests::sources::root;
use rayon::prelude::*;
use scene::{DirectLight, Scene};
use scene_file::{Problems, SceneFile};

const SIDE: u32 = 20;
/// The means of 400 pixels then have relative errors of 0.05 to 8 %, the largest where one technique hardly finds the light.
const SAMPLES: u32 = 100;

/// Standard errors by which two means may differ. A single comparison would exceed 3 once in 370 times; here all comparisons
/// of the suite together, at most 500, should fail as rarely, so each has 0.0027 / 500 = 5.4e-6: 4.55 (Bonferroni).
const Z: f64 = 4.55;

/// Largest allowed ratio of the variance of both techniques together to the lower variance of the two.
const MAX_VARIANCE: f64 = 1.2;

const LIGHTS: &[(&str, &str)] = &[
    ("small sphere", SMALL_SPHERE),
    ("large sphere", LARGE_SPHERE),
    ("rectangle", RECTANGLE),
    ("disk", DISK),
    (
        "small distant light",
        "[[lights]]\ntype = \"distant\"\nemission = { constant = 1 }\ndirection = [0, 0.55, -1]\ndiameter_deg = 6\n",
    ),
    (
        "wide distant light",
        "[[lights]]\ntype = \"distant\"\nemission = { constant = 1 }\ndirection = [0.1, 1, -0.9]\ndiameter_deg = 40\n",
    ),
    (
        "constant environment",
        "[environment]\ntype = \"constant\"\nemission = { constant = 1 }\n",
    ),
    (
        "gradient",
        "[environment]\ntype = \"gradient\"\nzenith = { constant = 2 }\nhorizon = { constant = 0.5 }\nground = { constant = 0.2 }\n",
    ),
    (
        "picture",
        "[environment]\ntype = \"image\"\nimage = \"tests/data/environment.hdr\"\n",
    ),
    (
        // The sun is so small that BSDF sampling hardly ever finds it.
        "sky without its sun",
        "[environment]\ntype = \"sky\"\nsun_elevation_deg = 40\nsun_azimuth_deg = 10\nsun = false\n",
    ),
    ("several", SEVERAL),
];

/// Lights that BSDF sampling cannot find.
const SINGLE_DIRECTIONS: &[(&str, &str)] = &[
    (
        "direction",
        "[[lights]]\ntype = \"distant\"\nemission = { constant = 1 }\ndirection = [0.3, 1, -0.7]\ndiameter_deg = 0\n",
    ),
    (
        "point",
        "[[lights]]\ntype = \"point\"\nemission = { constant = 5 }\nposition = [0.5, 1.5, -1]\n",
    ),
    (
        "spot",
        "[[lights]]\ntype = \"spot\"\nemission = { constant = 5 }\nposition = [0.5, 1.5, -1]\ndirection = [-0.5, -1.5, 1]\nangle_deg = 50\n",
    ),
];

const LAMP: &str = "[materials.lamp]\ntype = \"emitter\"\nemission = { constant = 5 }\n";
const SMALL_SPHERE: &str =
    "[[objects]]\ntype = \"sphere\"\nmaterial = \"lamp\"\ncenter = [0.3, 1.5, -1]\nradius = 0.15\n";
const LARGE_SPHERE: &str =
    "[[objects]]\ntype = \"sphere\"\nmaterial = \"lamp\"\ncenter = [0.3, 1.8, -1.5]\nradius = 1\n";
const RECTANGLE: &str = "[[objects]]\ntype = \"rectangle\"\nmaterial = \"lamp\"\ncenter = [0.3, 1.2, -1.5]\nnormal = [0, -0.6, 1]\nsize = [2, 1]\n";
const DISK: &str = "[[objects]]\ntype = \"disk\"\nmaterial = \"lamp\"\ncenter = [0.3, 1.2, -1.2]\nnormal = [0, -1, 1]\nradius = 0.6\n";
const SEVERAL: &str = "[[objects]]\ntype = \"sphere\"\nmaterial = \"lamp\"\ncenter = [0.3, 1.5, -1]\nradius = 0.15\n[[objects]]\ntype = \"rectangle\"\nmaterial = \"lamp\"\ncenter = [-1.5, 0.8, 0]\nnormal = [1, -0.5, 0]\nsize = [1, 1]\n[environment]\ntype = \"constant\"\nemission = { constant = 0.3 }\n";

const SURFACES: &[(&str, &str)] = &[
    ("diffuse", "type = \"diffuse\"\nreflectance = 0.7\n"),
    (
        "polished gold",
        "type = \"conductor\"\nindex = \"gold\"\nroughness = 0.05\n",
    ),
    (
        "satin gold",
        "type = \"conductor\"\nindex = \"gold\"\nroughness = 0.2\n",
    ),
    (
        "rough silver",
        "type = \"conductor\"\nindex = \"silver\"\nroughness = 0.6\n",
    ),
    (
        "film on titanium",
        "type = \"coated\"\nsubstrate = \"titanium\"\nindex = 2.4\nthickness_nm = 80\nroughness = 0.15\n",
    ),
    (
        "turned aluminum",
        "type = \"conductor\"\nindex = \"aluminum\"\nroughness = [0.1, 0.4]\nbrushed = { around = [0, 1, 0] }\ndistribution = \"ggx\"\n",
    ),
    (
        "black lacquer",
        "type = \"dielectric\"\nindex = 1.5\nroughness = 0.3\n",
    ),
    ("glazed", "type = \"dielectric\"\nindex = 1.5\nbase = 0.6\n"),
    (
        "varnished",
        "type = \"dielectric\"\nindex = 1.5\nbase = 0.6\nroughness = 0.1\n",
    ),
    (
        "Cook's copper",
        "type = \"conductor\"\nindex = \"copper\"\nmodel = { cook1981 = { normalization = \"normalized\", slopes = [{ m = 0.2, weight = 0.6 }, { m = 0.5, weight = 0.4 }] } }\n",
    ),
];

fn scene(light: &str, surface: &str, direct: DirectLight) -> Scene {
    read(light, surface, direct).unwrap_or_else(|e| panic!("{e:#}"))
}

fn read(light: &str, surface: &str, direct: DirectLight) -> Result<Scene, Problems> {
    let text = format!(
        "{light}\n{LAMP}\n[materials.floor]\n{surface}\n\
         [camera]\ntype = \"perspective\"\nposition = [0, 1.2, 2.5]\nlook_at = [0, 0, 0]\nfov_deg = 25\n\
         [render]\nsize = [{SIDE}, {SIDE}]\nsamples = {SAMPLES}\nbands = 1\nwavelengths_nm = [545, 555]\nsampler = \"independent\"\nmax_path_segments = 2\nseed = {}\n\
         [[objects]]\ntype = \"rectangle\"\nmaterial = \"floor\"\ncenter = [0, 0, 0]\nnormal = [0, 1, 0]\nsize = [3, 3]\n",
        direct as u32
    );
    let mut file = SceneFile::parse("pair.toml", &text, &root())?;
    file.description.render.direct_light = direct;
    file.validate()
}

/// Mean over the picture and the variance of that mean, for direct light alone.
fn mean_and_variance(light: &str, surface: &str, direct: DirectLight) -> (f64, f64) {
    let scene = scene(light, surface, direct);
    let prepared = reference::PreparedScene::new(&scene);
    let pixels: Vec<_> = (0..SIDE * SIDE).map(|i| [i % SIDE, i / SIDE]).collect();
    let (sum, variance) = pixels
        .into_par_iter()
        .map(|pixel| {
            let (mut sum, mut squares) = (0.0, 0.0);
            for sample in 0..SAMPLES {
                let path = prepared.sample(pixel, sample);
                let value: f64 = path.radiance.iter().map(|group| group[0]).sum();
                (sum, squares) = (sum + value, squares + value * value);
            }
            let n = f64::from(SAMPLES);
            let mean = sum / n;
            (mean, (squares / n - mean * mean) / (n - 1.0))
        })
        .reduce(|| (0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
    let pixels = f64::from(SIDE * SIDE);
    (sum / pixels, variance / (pixels * pixels))
}

fn z((a, variance_a): (f64, f64), (b, variance_b): (f64, f64)) -> f64 {
    // Where nothing is random, rounding remains.
    (a - b) / (variance_a + variance_b + (1e-9 * a).powi(2)).sqrt()
}

#[test]
fn three_techniques_agree_and_both_together_are_never_much_noisier() {
    let mut wrong = String::new();
    for (light_name, light) in LIGHTS {
        for (surface_name, surface) in SURFACES {
            let of = |direct| mean_and_variance(light, surface, direct);
            let (both, lights) = (of(DirectLight::Both), of(DirectLight::Emitters));
            let surfaces = of(DirectLight::Bsdf);
            let zs = [z(both, lights), z(both, surfaces), z(lights, surfaces)];
            let least = lights.1.min(surfaces.1);
            let relative =
                |way: (f64, f64)| way.1 * f64::from(SIDE * SIDE * SAMPLES) / (way.0 * way.0);
            let line = format!(
                "{light_name} × {surface_name}: mean {:.4}, z {:+.1} {:+.1} {:+.1}, relative variance: lights {:.4}, surfaces {:.4}, \
                 both {:.4}, ratio {:.2}\n",
                both.0,
                zs[0],
                zs[1],
                zs[2],
                relative(lights),
                relative(surfaces),
                relative(both),
                both.1 / least
            );
            print!("{line}");
            let is_dark = both.0 <= 0.0;
            if is_dark || zs.iter().any(|z| z.abs() > Z) || both.1 > MAX_VARIANCE * least {
                wrong += &line;
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn light_from_a_single_direction_is_found_by_emitter_sampling_alone() {
    for (light_name, light) in SINGLE_DIRECTIONS {
        for (surface_name, surface) in SURFACES {
            let of = |direct| mean_and_variance(light, surface, direct);
            let (both, lights) = (of(DirectLight::Both), of(DirectLight::Emitters));
            let name = format!("{light_name} × {surface_name}");
            assert!(
                both.0 > 0.0 && z(both, lights).abs() < Z,
                "{name}: {both:?} {lights:?}"
            );
        }
    }
}

/// BSDF sampling alone would leave such light dark, so it is refused.
#[test]
fn light_from_a_single_direction_is_refused_without_emitter_sampling() {
    for (name, light) in SINGLE_DIRECTIONS {
        let problems = read(light, SURFACES[0].1, DirectLight::Bsdf).expect_err(name);
        let fields: Vec<_> = problems.iter().map(|p| p.field.to_string()).collect();
        assert_eq!(fields, ["lights[0]"], "{name}: {problems:#}");
    }
}

/// The comparison can fail: it detects a lamp that is two percent brighter.
#[test]
fn a_wrong_light_is_noticed() {
    let (_, surface) = SURFACES[0];
    let right = mean_and_variance(SMALL_SPHERE, surface, DirectLight::Both);
    let wrong = mean_and_variance(SMALL_SPHERE, surface, DirectLight::Emitters);
    assert!(z(right, (1.02 * wrong.0, 1.02 * wrong.1)).abs() > Z);
}
