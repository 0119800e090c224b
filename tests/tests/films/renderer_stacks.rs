//! Compares the CPU renderer with code that it does not use: films and coatings as paths evaluate them against independent computations
//! and `optics::stack`, and one level of machine instructions against another.

use glam::DVec3;
use num_complex::Complex64;
use optics::{Layer, film, stack};
use pellicle_tests::agreement::compare;
use pellicle_tests::scenes::{MADE, small};
use pellicle_tests::tables::{number, rows};
use pellicle_tests::tolerances::{BASELINE, COLOR_TABLE, ORACLE, WEDGE};
use reference::{PreparedScene, SimdLevel, SurfaceFunction, SurfacePoint};
use scene::Scene;
use scene_file::SceneFile;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::Path;

const FILMS: &str = include_str!("../../data/films.csv");
const FILMS_MEDIA: &str = include_str!("../../data/films_media.csv");
/// Number of wavelengths in the tables, which are the centers of bands of 10 nm.
const BANDS: usize = 41;

/// A medium of a case, at the wavelengths of the tables.
#[derive(Clone, Default)]
struct Medium {
    thickness_nm: f64,
    index: Vec<Complex64>,
}

impl Medium {
    /// The medium in the syntax of a scene file.
    fn toml(&self) -> String {
        let column = |f: &dyn Fn(usize) -> f64| {
            let values: Vec<_> = (0..BANDS).map(|band| format!("{:e}", f(band))).collect();
            values.join(", ")
        };
        format!(
            "{{ nm = [{}], n = [{}], k = [{}], extrapolate = 'clamp' }}",
            column(&|band| wavelength(band)),
            column(&|band| self.index[band].re),
            column(&|band| self.index[band].im)
        )
    }
}

fn wavelength(band: usize) -> f64 {
    380.0 + 10.0 * band as f64
}

/// The media of each case, from the incident half space to the substrate.
fn cases() -> BTreeMap<&'static str, Vec<Medium>> {
    let mut cases: BTreeMap<_, Vec<Medium>> = BTreeMap::new();
    for row in rows(FILMS_MEDIA) {
        let media = cases.entry(row[0]).or_default();
        let medium: usize = row[1].parse().unwrap();
        media.resize(media.len().max(medium + 1), Medium::default());
        media[medium].thickness_nm = number(row[2]);
        media[medium]
            .index
            .push(Complex64::new(number(row[4]), number(row[5])));
    }
    cases
}

/// A scene of one sphere with the layers of a case: a film where the substrate is air, otherwise a coating.
fn scene_of(media: &[Medium]) -> Scene {
    let (substrate, layers) = media[1..].split_last().unwrap();
    let layer = |of: &Medium| {
        format!(
            "{{ index = {}, thickness_nm = {:e} }}",
            of.toml(),
            of.thickness_nm
        )
    };
    let list: Vec<String> = layers.iter().map(layer).collect();
    let material = if substrate.index.iter().all(|n| *n == Complex64::ONE) {
        format!("type = 'film', layers = [{}]", list.join(", "))
    } else if layers.is_empty() {
        format!("type = 'conductor', index = {}", substrate.toml())
    } else {
        let (of, layers) = (substrate.toml(), list.join(", "));
        format!("type = 'coated', substrate = {of}, layers = [{layers}]")
    };
    let text = format!(
        "camera = {{ type = 'orthographic', position = [0, 0, 9], look_at = [0, 0, 0], height = 9 }}\n\
         environment = {{ type = 'constant', emission = {{ constant = 1 }} }}\n\
         render = {{ bands = {BANDS}, wavelengths_nm = [375, 785], sampling = 'center' }}\n\
         materials = {{ m = {{ {material} }} }}\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'm'\ncenter = [0, 0, 0]\nradius = 1\n"
    );
    SceneFile::parse("case.toml", &text, Path::new(""))
        .and_then(|file| file.validate())
        .unwrap_or_else(|problems| panic!("{problems}"))
}

/// R, and T if the material transmits light, in each band at the cosine of the angle of incidence, for unpolarized light.
fn by_renderer(prepared: &PreparedScene, cosine: f64) -> (Vec<f64>, Option<Vec<f64>>) {
    let point = SurfacePoint {
        position: DVec3::Z,
        normal: DVec3::Z,
        cosine,
        is_front: true,
    };
    if let Some([r, t]) = prepared.film_powers(0, &point, 0.5) {
        return (r, Some(t));
    }
    let r = prepared.mirror_reflectance(0, &point, 0.5);
    (r.expect("a film or a mirror"), None)
}

/// Every case of `films.csv` as paths evaluate it: computed and expected, with the independent figures multiplied by a factor.
fn films(factor: f64) -> (Vec<f64>, Vec<f64>) {
    let cases = cases();
    let scenes: BTreeMap<_, _> = cases
        .iter()
        .map(|(case, media)| (*case, scene_of(media)))
        .collect();
    let prepared: BTreeMap<_, _> = scenes
        .iter()
        .map(|(case, scene)| (*case, PreparedScene::new(scene)))
        .collect();
    let (mut actual, mut expected) = (Vec::new(), Vec::new());
    for row in rows(FILMS) {
        let band = ((number(row[1]) - 380.0) / 10.0) as usize;
        let cosine = number(row[2]).to_radians().cos();
        let (r, t) = by_renderer(&prepared[row[0]], cosine);
        let mean = |a: usize, b: usize| factor * 0.5 * (number(row[a]) + number(row[b]));
        actual.push(r[band]);
        expected.push(mean(3, 4));
        if let Some(t) = t {
            actual.push(t[band]);
            expected.push(mean(5, 6));
        }
    }
    (actual, expected)
}

/// Films, coatings and metals against tmm 0.2.0 (S. J. Byrnes, arXiv:1603.02720).
#[test]
fn films_on_paths_agree_with_independent_computations() {
    let (actual, expected) = films(1.0);
    assert_eq!(expected.len(), (14 + 4) * 41 * 4);
    match compare(&actual, &expected, ORACLE) {
        Ok(report) => println!("{report}"),
        Err(report) => panic!("{report}"),
    }
    let (actual, expected) = films(1.0 + 1e-8);
    assert!(
        compare(&actual, &expected, ORACLE).is_err(),
        "a change of 1e-8 was not noticed"
    );
}

/// Films and coatings with each kind of formula, lossy ones also from behind, against `optics::stack`.
#[test]
fn films_on_paths_agree_with_the_stack() {
    let even = |n: f64, k: f64, thickness_nm| Medium {
        thickness_nm,
        index: vec![Complex64::new(n, k); BANDS],
    };
    let air = even(1.0, 0.0, 0.0);
    let many: Vec<Medium> = (0..40)
        .map(|i| {
            even(
                1.4 + 0.9 * f64::from(i % 2),
                0.01 * f64::from(i % 3),
                60.0 + f64::from(i),
            )
        })
        .collect();
    let inner: [Vec<Medium>; 6] = [
        vec![even(1.33, 0.0, 700.0)],
        vec![even(0.8, 0.0, 200.0)],
        vec![even(1.5, 0.2, 300.0)],
        vec![
            even(1.5, 0.0, 90.0),
            even(2.3, 0.1, 50.0),
            even(0.2, 3.0, 12.0),
        ],
        many,
        vec![],
    ];
    let (mut actual, mut expected) = (Vec::new(), Vec::new());
    for layers in &inner {
        for substrate in [
            even(1.0, 0.0, 0.0),
            even(0.3, 2.8, 0.0),
            even(1.52, 0.0, 0.0),
        ] {
            let is_film = substrate.index[0] == Complex64::ONE;
            if is_film && layers.is_empty() {
                continue;
            }
            let media = [std::slice::from_ref(&air), layers, &[substrate]].concat();
            let scene = scene_of(&media);
            let prepared = PreparedScene::new(&scene);
            for (cosine, is_front) in [(1.0, true), (0.6, false), (0.05, true), (1e-3, false)] {
                let mut of: Vec<Layer> = layers
                    .iter()
                    .map(|m| Layer {
                        index: m.index[0],
                        thickness_nm: m.thickness_nm,
                    })
                    .collect();
                let point = SurfacePoint {
                    position: DVec3::Z,
                    normal: DVec3::Z,
                    cosine,
                    is_front,
                };
                if is_film && !is_front {
                    of.reverse();
                }
                let exact = |band| {
                    let substrate = media[media.len() - 1].index[0];
                    stack(1.0, &of, substrate, wavelength(band), cosine)
                };
                if is_film {
                    let [r, t] = prepared.film_powers(0, &point, 0.5).expect("a film");
                    actual.extend(r.into_iter().chain(t));
                    expected.extend((0..BANDS).map(|b| exact(b).reflectance.unpolarized()));
                    expected.extend((0..BANDS).map(|b| exact(b).transmittance.unpolarized()));
                } else {
                    let r = prepared
                        .mirror_reflectance(0, &point, 0.5)
                        .expect("a mirror");
                    actual.extend(r);
                    expected.extend((0..BANDS).map(|b| exact(b).reflectance.unpolarized()));
                }
            }
        }
    }
    match compare(&actual, &expected, ORACLE) {
        Ok(report) => println!("{report}"),
        Err(report) => panic!("{report}"),
    }
    assert_eq!(expected.len(), 5 * 4 * 2 * BANDS + 12 * 4 * BANDS);
}

/// The benchmark's wedge: each pixel is the mean of R(λ; d) times the light over its width and each band's, within 1e-4 of the mean.
#[test]
fn the_wedge_is_exact() {
    const STEPS: u32 = 64;
    let scene = small("bench/wedge", [64, 48], 1024, 40, 1);
    let image = reference::render(&scene, &mut |_| ControlFlow::Continue(())).unwrap();
    let light = scene.spectrum(scene.environment_parts()[0].emission.spectrum);
    let place = |i: u32| (f64::from(i) + 0.5) / f64::from(STEPS);
    let exact = |x: u32, band: u32, factor: f64| {
        let of = |i: u32, j: u32| {
            let nm = 300.0 + 1700.0 * (f64::from(x) + place(i)) / 64.0;
            let wavelength = scene.settings().bands.wavelength_nm(band, place(j));
            let film = film((1.33 * factor).into(), nm, wavelength, 1.0);
            film.reflectance.unpolarized() * light.at(band, place(j))
        };
        let places = (0..STEPS).flat_map(|i| (0..STEPS).map(move |j| of(i, j)));
        places.sum::<f64>() / f64::from(STEPS * STEPS)
    };
    let bands = (0..40).step_by(3);
    let pairs = |factor: f64| -> Vec<(f64, f64)> {
        let places = (0..64).flat_map(|x| bands.clone().map(move |band| (x, band)));
        let pair = |(x, band): (u32, u32)| {
            let found = f64::from(image.pixel(x, 24)[band as usize]);
            (found, exact(x, band, factor))
        };
        places.map(pair).collect()
    };
    let off = |pairs: Vec<(f64, f64)>| {
        let mean = pairs.iter().map(|(_, exact)| exact).sum::<f64>() / pairs.len() as f64;
        let squares = pairs.iter().map(|(found, exact)| (found - exact).powi(2));
        (squares.sum::<f64>() / pairs.len() as f64).sqrt() / mean
    };
    let found = off(pairs(1.0));
    println!("{found:.1e}");
    assert!(found < WEDGE, "{found}");
    assert!(
        off(pairs(1.001)) > 3.0 * WEDGE,
        "an index that is a thousandth higher was not noticed"
    );
}

/// A rough metal below a film, whose thickness is a number or a field with this number everywhere.
fn rough_coat(index: f64, thickness: &str) -> Scene {
    let text = format!(
        "camera = {{ type = 'orthographic', position = [0, 0, 9], look_at = [0, 0, 0], height = 9 }}\n\
         environment = {{ type = 'constant', emission = {{ constant = 1 }} }}\nrender = {{ bands = 40 }}\n\
         materials = {{ m = {{ type = 'coated', substrate = 'gold', index = {index}, thickness_nm = {thickness}, roughness = 0.9 }} }}\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'm'\ncenter = [0, 0, 0]\nradius = 1\n"
    );
    SceneFile::parse("coat.toml", &text, Path::new(""))
        .and_then(|file| file.validate())
        .unwrap_or_else(|problems| panic!("{problems}"))
}

/// Difference between the BSDF of an even coat, whose color of multiple scattering may be a table, and that of the same coat by its
/// formula, relative to the largest value.
fn table_error(index: f64, nm: f64, other_nm: f64) -> f64 {
    let field = format!("{{ pole = {other_nm}, equator = {other_nm} }}");
    let (even, varied) = (
        rough_coat(index, &nm.to_string()),
        rough_coat(index, &field),
    );
    let (even, varied) = (PreparedScene::new(&even), PreparedScene::new(&varied));
    let point = SurfacePoint {
        position: DVec3::Z,
        normal: DVec3::Z,
        cosine: 1.0,
        is_front: true,
    };
    let mut worst = 0.0_f64;
    for step in 0..40 {
        let offset = (f64::from(step) + 0.37) / 40.0;
        let of = |prepared| SurfaceFunction::new(prepared, 0, &point, offset, 0.0).unwrap();
        let wo = DVec3::new(0.6, 0.0, 0.8);
        let wi = DVec3::new(-0.5, 0.6, 0.4).normalize();
        let (table, formula) = (of(&even).values(wo, wi), of(&varied).values(wo, wi));
        let largest = formula.iter().copied().fold(0.0, f64::max);
        let pairs = table.iter().zip(&formula);
        worst = pairs
            .map(|(a, b)| (a - b).abs() / largest)
            .fold(worst, f64::max);
    }
    worst
}

/// Tables of the color of multiple scattering are used where they are accurate: a film so thick that its fringes are not straight between
/// the knots has none.
#[test]
fn colors_of_multiple_scattering_are_right() {
    for (index, nm) in [
        (1.4, 20.0),
        (1.4, 140.0),
        (2.6, 75.0),
        (2.6, 600.0),
        (4.0, 1000.0),
    ] {
        let error = table_error(index, nm, nm);
        println!("{index}, {nm} nm: {error:.1e}");
        assert!(error < COLOR_TABLE, "{index}, {nm} nm: {error:e}");
    }
    assert!(table_error(1.4, 140.0, 141.0) > 10.0 * COLOR_TABLE);
}

/// The largest difference between two instruction levels, relative to the largest value of the picture.
fn difference_of_levels(scene: &Scene, other: &Scene) -> f64 {
    let go_on = &mut |_| ControlFlow::Continue(());
    let best = reference::render_at(SimdLevel::best(), scene, go_on).unwrap();
    let baseline = reference::render_at(SimdLevel::baseline(), other, go_on).unwrap();
    let pairs = || best.radiance().iter().zip(baseline.radiance());
    let largest = best.radiance().iter().fold(0.0_f32, |a, &b| a.max(b));
    assert!(largest > 0.0);
    let off = pairs().map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    f64::from(off / largest)
}

/// A machine without AVX gives the same picture except for rounding.
#[test]
fn the_baseline_differs_by_rounding_alone() {
    println!("{}", SimdLevel::best().name());
    for name in MADE
        .iter()
        .chain(&["metal_spheres", "dichroic_ball", "floating_bubble"])
    {
        for bands in [1, 13, 40] {
            let scene = small(name, [24, 16], 4, bands, 3);
            let off = difference_of_levels(&scene, &scene);
            println!("{name}, {bands} bands: {off:.1e}");
            assert!(off <= BASELINE, "{name}: {off:e}");
        }
    }
    let [scene, other] = [3, 4].map(|seed| small("metal_spheres", [24, 16], 4, 13, seed));
    assert!(difference_of_levels(&scene, &other) > 1e3 * BASELINE);
}
