//! The crate `optics` against independent computations, closed forms and published figures; no device is needed.

use num_complex::Complex64;
use optics::{
    Layer, StackAmplitudes, cos_refracted, film, fresnel, reflectance_unpolarized, stack,
};
use pellicle_tests::agreement::compare;
use pellicle_tests::colorimetry::xyz;
use pellicle_tests::tables::{number, rows};
use pellicle_tests::tolerances::{IDENTITY, ORACLE, ORACLE_XYZ};
use proptest::prelude::*;
use std::collections::BTreeMap;

const FILMS: &str = include_str!("../../data/films.csv");
const FILMS_MEDIA: &str = include_str!("../../data/films_media.csv");
const FILM_COLORS: &str = include_str!("../../data/film_colors.csv");

fn close(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance
}

/// The reflectance of a stack for unpolarized light.
fn unpolarized(found: &StackAmplitudes) -> f64 {
    found.reflectance.unpolarized()
}

/// The media of `films_media.csv` by case and wavelength, incident half space first, index and thickness.
fn media() -> BTreeMap<(&'static str, &'static str), Vec<Layer>> {
    let mut media: BTreeMap<_, Vec<Layer>> = BTreeMap::new();
    for row in rows(FILMS_MEDIA) {
        let stack = media.entry((row[0], row[3])).or_default();
        assert_eq!(stack.len(), row[1].parse::<usize>().unwrap(), "{row:?}");
        stack.push(Layer {
            index: Complex64::new(number(row[4]), number(row[5])),
            thickness_nm: number(row[2]),
        });
    }
    media
}

/// Rs, Rp, Ts and Tp of every case of `films.csv`, computed and expected, with the index of all but the
/// incident half space times `index_factor`.
fn films(index_factor: f64) -> BTreeMap<&'static str, (Vec<f64>, Vec<f64>)> {
    let media = media();
    let mut cases: BTreeMap<_, (Vec<f64>, Vec<f64>)> = BTreeMap::new();
    for row in rows(FILMS) {
        let mut of_case = media[&(row[0], row[1])].clone();
        for medium in &mut of_case[1..] {
            if medium.index != Complex64::ONE {
                medium.index *= index_factor;
            }
        }
        let (last, front) = of_case.split_last().unwrap();
        let found = stack(
            front[0].index.re,
            &front[1..],
            last.index,
            number(row[1]),
            number(row[2]).to_radians().cos(),
        );
        let (r, t) = (found.reflectance, found.transmittance);
        let (actual, expected) = cases.entry(row[0]).or_default();
        actual.extend([r.s, r.p, t.s, t.p]);
        expected.extend(row[3..7].iter().map(|cell| number(cell)));
    }
    cases
}

/// Films, coatings and metals against tmm 0.2.0 (S. J. Byrnes, arXiv:1603.02720).
#[test]
fn stacks_agree_with_independent_computations() {
    let cases = films(1.0);
    assert_eq!(cases.len(), 14);
    for (case, (actual, expected)) in cases {
        assert_eq!(expected.len(), 41 * 4 * 4, "{case}");
        match compare(&actual, &expected, ORACLE) {
            Ok(report) => println!("{case}: {report}"),
            Err(report) => panic!("{case}: {report}"),
        }
    }
}

#[test]
fn an_index_one_percent_too_high_is_noticed_in_every_case() {
    for (case, (actual, expected)) in films(1.01) {
        assert!(compare(&actual, &expected, ORACLE).is_err(), "{case}");
    }
}

/// The rows of `film_colors.csv`: a name, XYZ computed with the index of the soap or the metal's constants times `index_factor`,
/// and the expected XYZ.
fn colors(index_factor: f64) -> Vec<(String, [f64; 3], Vec<f64>)> {
    let of_row = |row: Vec<&str>| {
        let (thickness_nm, degrees) = (number(row[1]), number(row[2]));
        let cosine = degrees.to_radians().cos();
        let soap = |n: f64| {
            let index = Complex64::from(n * index_factor);
            xyz("D65", |nm| {
                unpolarized(&film(index, thickness_nm, nm, cosine))
            })
        };
        let metal = |name: &str| {
            let constants = spectra::optical_constants(name).unwrap().data;
            xyz("D65", |nm| {
                let (n, k) = (constants.n.at(nm).unwrap(), constants.k.at(nm).unwrap());
                reflectance_unpolarized(Complex64::new(n, k) * index_factor, cosine)
            })
        };
        let found = match row[0] {
            "soap" => soap(1.333),
            "newton" => soap(4.0 / 3.0),
            "au" => metal("gold"),
            "ag" => metal("silver"),
            other => panic!("{other} is unknown"),
        };
        let expected = row[3..6].iter().map(|cell| number(cell)).collect();
        (row[..3].join(" "), found, expected)
    };
    rows(FILM_COLORS).map(of_row).collect()
}

#[test]
fn films_and_metals_have_the_colors_of_independent_computations() {
    let colors = colors(1.0);
    assert_eq!(colors.len(), 23);
    for (name, found, expected) in colors {
        match compare(&found, &expected, ORACLE_XYZ) {
            Ok(report) => println!("{name}: {report}"),
            Err(report) => panic!("{name}: {report}"),
        }
    }
}

#[test]
fn a_color_from_a_wrong_index_is_noticed() {
    for (name, found, expected) in colors(1.01) {
        assert!(compare(&found, &expected, ORACLE_XYZ).is_err(), "{name}");
    }
}

/// tan θ_B = n₂ / n₁ (Brewster 1815), from either side.
#[test]
fn p_vanishes_at_brewsters_angle() {
    for (n1, n2) in [(1.0_f64, 1.333_f64), (1.0, 1.52), (1.0, 2.4), (1.52, 1.0)] {
        let cosine = (n2 / n1).atan().cos();
        let r = stack(n1, &[], n2.into(), 550.0, cosine).reflectance;
        assert!(r.p < 1e-30 && r.s > 1e-3, "{n1} {n2}: {r:?}");
        // Also for a film: light meets both of its sides at their own Brewster angle.
        let r = film(n2.into(), 431.0, 550.0, n2.atan().cos()).reflectance;
        assert!(r.p < 1e-30, "{n2}: {r:?}");
    }
}

/// sin θ_c = n₂ / n₁: nothing is transmitted beyond it, something below it.
#[test]
fn beyond_the_critical_angle_everything_is_reflected() {
    let n1: f64 = 1.52;
    let critical = (1.0 / n1).asin();
    for degrees in [1e-6, 0.1, 5.0, 40.0] {
        let beyond = (critical + f64::to_radians(degrees)).cos();
        let found = stack(n1, &[], Complex64::ONE, 550.0, beyond);
        let (r, t) = (found.reflectance, found.transmittance);
        assert!(close(r.s, 1.0, IDENTITY) && close(r.p, 1.0, IDENTITY));
        assert!(close(t.s, 0.0, IDENTITY) && close(t.p, 0.0, IDENTITY));
        let before = (critical - f64::to_radians(degrees)).cos();
        let found = stack(n1, &[], Complex64::ONE, 550.0, before);
        assert!(
            found.transmittance.s > 1e-4,
            "{degrees}: {:?}",
            found.transmittance
        );
    }
}

/// Fresnel's rhomb: glass of index 1.51 turns s against p by 45° at 48°37′ and at 54°37′, and δ_s is ahead
/// under exp(−iωt) (Born and Wolf, 7th ed., section 1.5.4, equations 60 and 61).
#[test]
fn total_reflection_shifts_phases_as_in_fresnels_rhomb() {
    let glass = Complex64::from(1.51);
    for minutes in [48.0 * 60.0 + 37.0, 54.0 * 60.0 + 37.0] {
        let (sine, cosine) = f64::to_radians(minutes / 60.0).sin_cos();
        let beyond = cos_refracted(Complex64::ONE, glass * sine);
        let a = fresnel(glass, cosine.into(), Complex64::ONE, beyond);
        let shift = (a.r_s / a.r_p).arg().to_degrees();
        // One minute of arc changes the shift by less than 0.03°.
        assert!(close(shift, 45.0, 0.03), "{minutes}: {shift}");
        let root = (1.51 * 1.51 * sine * sine - 1.0).sqrt();
        let delta_s = -2.0 * (root / (1.51 * cosine)).atan();
        assert!(close(a.r_s.arg(), delta_s, IDENTITY));
    }
}

/// A quarter wave of index n₁ on n_s: R = ((n₀n_s − n₁²)/(n₀n_s + n₁²))², 0 for n₁ = √(n₀n_s)
/// (Born and Wolf, 7th ed., section 1.6.4, equation 40).
#[test]
fn a_quarter_wave_layer_follows_the_closed_form() {
    for (n1, n_s) in [
        (1.38, 1.52),
        (2.3, 1.52),
        (1.46, 3.5),
        (2.25_f64.sqrt(), 2.25),
    ] {
        let layer = Layer {
            index: n1.into(),
            thickness_nm: 550.0 / (4.0 * n1),
        };
        let r = stack(1.0, &[layer], n_s.into(), 550.0, 1.0).reflectance;
        let expected = ((n_s - n1 * n1) / (n_s + n1 * n1)).powi(2);
        assert!(close(r.s, expected, IDENTITY) && close(r.p, expected, IDENTITY));
    }
}

/// N pairs of quarter waves, H outside: R = ((n₀ − n_s (n_H/n_L)²ᴺ)/(n₀ + n_s (n_H/n_L)²ᴺ))²
/// (Born and Wolf, 7th ed., section 1.6.5, equation 101).
#[test]
fn a_bragg_mirror_follows_the_closed_form() {
    let (high, low, n_s) = (2.4, 1.46, 1.52);
    let quarter = |n: f64| Layer {
        index: n.into(),
        thickness_nm: 600.0 / (4.0 * n),
    };
    let mut before = 0.0;
    for pairs in 0..=12 {
        let layers = [quarter(high), quarter(low)].repeat(pairs);
        let r = stack(1.0, &layers, n_s.into(), 600.0, 1.0).reflectance;
        let admittance = n_s * (high / low).powi(2 * pairs as i32);
        let expected = ((1.0 - admittance) / (1.0 + admittance)).powi(2);
        assert!(close(r.s, expected, IDENTITY) && close(r.p, expected, IDENTITY));
        assert!(r.s > before);
        before = r.s;
    }
    assert!(before > 0.9999);
}

/// The cosine of the ray in a lossless medium.
fn cosine_within(n: f64, incident: f64, cos_incident: f64) -> f64 {
    let sine = incident * (1.0 - cos_incident * cos_incident).sqrt() / n;
    (1.0 - sine * sine).sqrt()
}

/// One to six layers of up to 1.5 µm and an extinction of up to `k`.
fn layers(k: f64) -> impl Strategy<Value = Vec<Layer>> {
    let layer = (1.25..2.6_f64, 0.0..=k, 0.0..1500.0_f64).prop_map(|(n, k, thickness_nm)| Layer {
        index: Complex64::new(n, k),
        thickness_nm,
    });
    prop::collection::vec(layer, 1..=6)
}

fn assert_same(a: &StackAmplitudes, b: &StackAmplitudes) -> Result<(), TestCaseError> {
    for (x, y) in [
        (a.reflectance.s, b.reflectance.s),
        (a.reflectance.p, b.reflectance.p),
        (a.transmittance.s, b.transmittance.s),
        (a.transmittance.p, b.transmittance.p),
    ] {
        prop_assert!(close(x, y, IDENTITY), "{x:e} against {y:e}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    /// A stack without absorption loses nothing, even where the substrate reflects totally.
    #[test]
    fn lossless_stacks_conserve_energy(
        layers in layers(0.0), incident in 1.0..1.2_f64, substrate in 1.0..3.0_f64,
        nm in 380.0..780.0_f64, cosine in 0.02..=1.0_f64,
    ) {
        let found = stack(incident, &layers, substrate.into(), nm, cosine);
        let (r, t) = (found.reflectance, found.transmittance);
        prop_assert!(close(r.s + t.s, 1.0, IDENTITY), "s {:e}", r.s + t.s - 1.0);
        prop_assert!(close(r.p + t.p, 1.0, IDENTITY), "p {:e}", r.p + t.p - 1.0);
    }

    /// Absorption only takes energy away.
    #[test]
    fn absorbing_stacks_never_gain(
        layers in layers(4.0), substrate_n in 0.1..4.0_f64, substrate_k in 0.0..6.0_f64,
        nm in 380.0..780.0_f64, cosine in 0.001..=1.0_f64,
    ) {
        let found = stack(1.0, &layers, Complex64::new(substrate_n, substrate_k), nm, cosine);
        let (r, t) = (found.reflectance, found.transmittance);
        for (r, t) in [(r.s, t.s), (r.p, t.p)] {
            prop_assert!(r >= 0.0 && t >= -IDENTITY && r + t <= 1.0 + IDENTITY, "{r} + {t}");
        }
    }

    /// T is the same from both sides, also for absorbing layers (Born and Wolf, 7th ed., section 1.6.2, reciprocity).
    #[test]
    fn transmittance_is_the_same_from_either_side(
        mut layers in layers(0.3), substrate in 1.2..3.0_f64, nm in 380.0..780.0_f64, cosine in 0.02..=1.0_f64,
    ) {
        let there = stack(1.0, &layers, substrate.into(), nm, cosine);
        layers.reverse();
        let within = cosine_within(substrate, 1.0, cosine);
        let back = stack(substrate, &layers, Complex64::ONE, nm, within).transmittance;
        prop_assert!(close(there.transmittance.s, back.s, IDENTITY));
        prop_assert!(close(there.transmittance.p, back.p, IDENTITY));
    }

    #[test]
    fn a_split_layer_equals_the_whole(
        layers in layers(2.0), place in 0..60_usize, share in 0.0..=1.0_f64, nm in 380.0..780.0_f64, cosine in 0.02..=1.0_f64,
    ) {
        let place = place % layers.len();
        let silicon = Complex64::new(4.1, 0.04);
        let mut split = layers.clone();
        split[place].thickness_nm *= share;
        let rest = Layer { thickness_nm: layers[place].thickness_nm * (1.0 - share), ..layers[place] };
        split.insert(place, rest);
        assert_same(&stack(1.0, &layers, silicon, nm, cosine), &stack(1.0, &split, silicon, nm, cosine))?;
    }

    #[test]
    fn a_layer_without_thickness_is_absent(
        layers in layers(2.0), place in 0..420_usize, n in 0.1..4.0_f64, k in 0.0..4.0_f64,
        nm in 380.0..780.0_f64, cosine in 0.02..=1.0_f64,
    ) {
        let place = place % (layers.len() + 1);
        let titanium = Complex64::new(2.5, 3.3);
        let mut with = layers.clone();
        with.insert(place, Layer { index: Complex64::new(n, k), thickness_nm: 0.0 });
        assert_same(&stack(1.0, &layers, titanium, nm, cosine), &stack(1.0, &with, titanium, nm, cosine))?;
    }

    /// A lossless layer of whole half waves, n d cos θ = m λ/2, changes nothing.
    #[test]
    fn a_half_wave_layer_vanishes(
        layers in layers(2.0), place in 0..420_usize, n in 1.1..3.0_f64, half_waves in 1..5_u32,
        nm in 380.0..780.0_f64, cosine in 0.02..=1.0_f64,
    ) {
        let place = place % (layers.len() + 1);
        let silver = Complex64::new(0.06, 3.6);
        let thickness_nm = f64::from(half_waves) * nm / (2.0 * n * cosine_within(n, 1.0, cosine));
        let mut with = layers.clone();
        with.insert(place, Layer { index: n.into(), thickness_nm });
        assert_same(&stack(1.0, &layers, silver, nm, cosine), &stack(1.0, &with, silver, nm, cosine))?;
    }
}
