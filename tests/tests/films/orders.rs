//! Orders of interference colors that were observed and published, by hue; no device is needed.

use num_complex::Complex64;
use optics::{Layer, film, stack};
use pellicle_tests::colorimetry::{chroma_hue, lab, xyz};
use spectra::OpticalConstants;

/// The meaning of a color's name: hue from .. to (degrees in CIELAB, counterclockwise, through 0 where from > to) and chroma.
///
/// The hues around which names cluster are the unique hues in CIELAB (red 25°, yellow 90°, green 165°, blue 250°; Fairchild,
/// Color Appearance Models, 2013) and the purples between blue and red; boxes are 50° to 95° wide because observers
/// of a film name a color relative to its neighbors and not in isolation. "Pale" and "silver" require little chroma, the other
/// names enough to be visible.
struct Name {
    word: &'static str,
    hue: (f64, f64),
    chroma: (f64, f64),
}

const fn name(word: &'static str, from: f64, to: f64, chroma: (f64, f64)) -> Name {
    Name {
        word,
        hue: (from, to),
        chroma,
    }
}

const CLEAR: (f64, f64) = (10.0, 100.0);
const PALE: (f64, f64) = (0.0, 10.0);
const NAMES: [Name; 16] = [
    name("gold", 65.0, 125.0, CLEAR),
    name("light gold", 65.0, 125.0, CLEAR),
    name("yellow", 75.0, 125.0, CLEAR),
    name("green", 120.0, 215.0, CLEAR),
    name("light green", 120.0, 215.0, CLEAR),
    name("light blue", 215.0, 270.0, CLEAR),
    name("blue", 225.0, 285.0, CLEAR),
    name("royal blue", 250.0, 285.0, CLEAR),
    name("cobalt", 225.0, 285.0, CLEAR),
    name("dark violet", 275.0, 335.0, CLEAR),
    name("violet", 275.0, 335.0, CLEAR),
    name("red-violet", 295.0, 350.0, CLEAR),
    name("purple", 290.0, 340.0, CLEAR),
    name("pink", 315.0, 30.0, CLEAR),
    name("pale blue", 190.0, 270.0, PALE),
    name("silver", 0.0, 360.0, PALE),
];

/// Whether a color with this chroma and hue may have this name.
fn is_called(called: &str, (chroma, hue): (f64, f64)) -> bool {
    let of_name = |name: &&Name| name.word == called;
    let name = NAMES.iter().find(of_name).expect("the name is in the list");
    let (from, to) = name.hue;
    let within = if from <= to {
        from <= hue && hue <= to
    } else {
        from <= hue || hue <= to
    };
    within && name.chroma.0 <= chroma && chroma <= name.chroma.1
}

fn named(material: &str) -> OpticalConstants {
    spectra::optical_constants(material).unwrap().data
}

fn index(constants: &OpticalConstants, nm: f64) -> Complex64 {
    Complex64::new(constants.n.at(nm).unwrap(), constants.k.at(nm).unwrap())
}

/// Chroma and hue of a film on a substrate at normal incidence.
fn color(
    illuminant: &str,
    film: &OpticalConstants,
    thickness_nm: f64,
    substrate: &OpticalConstants,
) -> (f64, f64) {
    let reflectance = |nm| {
        let layer = Layer {
            index: index(film, nm),
            thickness_nm,
        };
        let found = stack(1.0, &[layer], index(substrate, nm), nm, 1.0);
        found.reflectance.unpolarized()
    };
    let white = xyz(illuminant, |_| 1.0);
    chroma_hue(lab(xyz(illuminant, reflectance), white))
}

/// Thermal oxide on silicon under fluorescent light, thickness in nm: W. A. Pliskin and E. E. Conrad, "Nondestructive determination of
/// thickness and refractive index of transparent films", IBM J. Res. Dev. 8, 43 (1964).
const PLISKIN_CONRAD: [(f64, &str); 14] = [
    (100.0, "dark violet"),
    (120.0, "royal blue"),
    (150.0, "light blue"),
    (200.0, "light gold"),
    (270.0, "red-violet"),
    (310.0, "blue"),
    (340.0, "light green"),
    (390.0, "yellow"),
    (420.0, "pink"),
    (460.0, "red-violet"),
    (490.0, "blue"),
    (520.0, "green"),
    (600.0, "pink"),
    (630.0, "violet"),
];

/// The names of an order that a film with this multiple of the thickness does not have.
fn missed(
    order: &[(f64, &'static str)],
    scale: f64,
    color: impl Fn(f64) -> (f64, f64),
) -> Vec<&'static str> {
    let misses = |(thickness_nm, called): &(f64, &'static str)| {
        let found = color(scale * thickness_nm);
        println!(
            "{thickness_nm} {called}: C* {:.0}, h {:.0}",
            found.0, found.1
        );
        (!is_called(called, found)).then_some(*called)
    };
    order.iter().filter_map(misses).collect()
}

fn oxide_on_silicon(scale: f64) -> Vec<&'static str> {
    let (silica, silicon) = (named("silica"), named("silicon"));
    missed(&PLISKIN_CONRAD, scale, |d| {
        color("FL2", &silica, d, &silicon)
    })
}

#[test]
fn silica_on_silicon_follows_pliskin_and_conrad() {
    assert_eq!(oxide_on_silicon(1.0), [""; 0]);
}

/// Anodized titanium: gold, purple, blue, pale blue, silver, yellow, pink, violet, cobalt, green, as the voltage rises; the oxide
/// grows by 2.4 to 2.8 nm per volt (M. V. Diamanti, B. Del Curto and M. Pedeferri, "Interference colors of thin oxide layers on
/// titanium", Color Res. Appl. 33, 221 (2008)). Titania after Siefke et al. (2016), titanium after Johnson and Christy (1974).
const ANODIZED: [(f64, &str); 10] = [
    (20.0, "gold"),
    (40.0, "purple"),
    (60.0, "blue"),
    (80.0, "pale blue"),
    (85.0, "silver"),
    (110.0, "yellow"),
    (140.0, "pink"),
    (160.0, "violet"),
    (170.0, "cobalt"),
    (200.0, "green"),
];

fn anodized_titanium(scale: f64) -> Vec<&'static str> {
    let (titania, titanium) = (named("titania"), named("titanium"));
    missed(&ANODIZED, scale, |d| color("D65", &titania, d, &titanium))
}

#[test]
fn anodized_titanium_follows_its_order() {
    assert_eq!(anodized_titanium(1.0), [""; 0]);
}

/// The boxes distinguish films that are a seventh too thin or too thick.
#[test]
fn a_wrong_thickness_breaks_the_orders() {
    for scale in [0.85, 1.15] {
        let (oxide, anodized) = (oxide_on_silicon(scale), anodized_titanium(scale));
        assert!(oxide.len() >= 7, "{scale}: {oxide:?}");
        assert!(anodized.len() >= 5, "{scale}: {anodized:?}");
    }
}

/// Positions of the maxima and minima of a sampled function.
fn extrema(values: &[(f64, f64)]) -> (Vec<f64>, Vec<f64>) {
    let (mut maxima, mut minima) = (vec![], vec![]);
    for three in values.windows(3) {
        let [(_, before), (place, here), (_, after)] = [three[0], three[1], three[2]];
        if here > before && here > after {
            maxima.push(place);
        }
        if here < before && here < after {
            minima.push(place);
        }
    }
    (maxima, minima)
}

/// Luminance of a free soap film (water, Daimon and Masumura 2007) under D65 over its thickness in steps of 5 nm.
#[test]
fn a_soap_film_is_brightest_and_darkest_where_published() {
    let water = named("water");
    let luminance = |d: f64| {
        let reflectance = |nm: f64| {
            film(index(&water, nm), d, nm, 1.0)
                .reflectance
                .unpolarized()
        };
        xyz("D65", reflectance)[1] / 100.0
    };
    let steps = (4..=130).map(|i| 5.0 * f64::from(i));
    let values: Vec<(f64, f64)> = steps.map(|d| (d, luminance(d))).collect();
    let (maxima, minima) = extrema(&values);
    assert_eq!(maxima, [105.0, 310.0, 520.0]);
    assert_eq!(minima, [205.0, 415.0, 625.0]);
    let peak = values.iter().map(|value| value.1).fold(0.0, f64::max);
    assert!((peak - 0.0778).abs() < 5e-5, "{peak}");
}

/// Michel-Lévy's chart: between crossed polarizers a retardation Γ transmits sin²(πΓ/λ); the darkest are Γ = 551 nm, the sensitive tint
/// at the end of the first order, and 1106 and 1666 nm at the ends of the second and third.
#[test]
fn the_orders_of_michel_levy_end_where_published() {
    let luminance = |retardation: f64| {
        let passes = |nm: f64| (std::f64::consts::PI * retardation / nm).sin().powi(2);
        xyz("D65", passes)[1]
    };
    let steps = (200..=1750).map(f64::from);
    let values: Vec<(f64, f64)> = steps.map(|gamma| (gamma, luminance(gamma))).collect();
    assert_eq!(extrema(&values).1, [551.0, 1106.0, 1666.0]);
}

#[test]
fn extrema_are_found_only_where_they_are() {
    let values: Vec<(f64, f64)> = [1.0, 3.0, 2.0, 0.0, 5.0]
        .into_iter()
        .map(|y| (10.0 * y, y))
        .collect();
    assert_eq!(extrema(&values), (vec![30.0], vec![0.0]));
    assert_eq!(extrema(&values[..2]), (vec![], vec![]));
}
