//! Colors that processes are known to give: heat tints of steel and anodized titanium, from the parameters of the process in a
//! scene to a hue.

use colorimetry::lab::Lab;
use optics::{Complex64, Layer, stack};
use relight::BandWeights;
use scene::{Material, Scene, SpectrumId, Thickness};
use scene_file::SceneFile;
use std::path::Path;

/// A scene with an oxide that a process grows on a metal.
fn scene(oxide: &str, metal: &str, process: &str) -> Scene {
    let text = format!(
        "camera = {{ type = 'perspective', position = [0, 0, 5], look_at = [0, 0, 0], fov_deg = 40 }}\n\
         render = {{ bands = 40 }}\n\
         [materials]\n\
         a = {{ type = 'coated', substrate = {metal}, index = {oxide}, thickness_nm = {process} }}\n"
    );
    SceneFile::parse("process.toml", &text, Path::new(""))
        .and_then(|file| file.validate())
        .unwrap_or_else(|problems| panic!("{problems:#}"))
}

/// Lightness, chroma and hue angle in degrees (CIELAB, white equal energy) of the oxide on its metal at normal incidence.
fn color(scene: &Scene) -> [f64; 3] {
    let Material::Interface {
        n, k, ref layers, ..
    } = scene.materials()[0]
    else {
        panic!("{:?}", scene.materials());
    };
    let Thickness::Constant { nm: thickness_nm } = layers[0].thickness else {
        panic!("{layers:?}");
    };
    let grid = scene.settings().bands;
    let (mut light, mut white) = (Vec::new(), Vec::new());
    for band in 0..grid.count() {
        let value = |id: SpectrumId| scene.spectrum(id).at(band, 0.5);
        let oxide = Layer {
            index: Complex64::new(value(layers[0].n), value(layers[0].k)),
            thickness_nm,
        };
        let metal = Complex64::new(value(n), value(k));
        let nm = grid.wavelength_nm(band, 0.5);
        light.push(
            stack(1.0, &[oxide], metal, nm, 1.0)
                .reflectance
                .unpolarized() as f32,
        );
        white.push(1.0);
    }
    let observer = BandWeights::observed(&grid, spectra::Observer::Cie1931Deg2);
    let lab = Lab::from_xyz(observer.xyz(&light), observer.xyz(&white));
    [lab.l, lab.chroma(), lab.hue_deg()]
}

/// A color name, with its range of lightness, least chroma and range of hue.
type Named = (&'static str, [f64; 2], f64, [f64; 2]);

const STRAW: Named = ("straw", [55.0, 75.0], 10.0, [75.0, 105.0]);
const BROWN: Named = ("brown", [30.0, 55.0], 25.0, [50.0, 92.0]);
const PURPLE: Named = ("purple", [0.0, 40.0], 25.0, [300.0, 385.0]);
const BLUE: Named = ("blue", [0.0, 35.0], 40.0, [275.0, 312.0]);
const LIGHT_BLUE: Named = ("light blue", [40.0, 80.0], 15.0, [230.0, 275.0]);

fn is_named([lightness, chroma, hue]: [f64; 3], (_, light, least, hues): Named) -> bool {
    let within = |x: f64, [low, high]: [f64; 2]| low <= x && x <= high;
    within(lightness, light) && chroma >= least && (within(hue, hues) || within(hue + 360.0, hues))
}

fn assert_colors(found: &[([f64; 3], Named, String)]) {
    let mut wrong = String::new();
    for (color, named, process) in found {
        let [l, c, h] = color;
        println!("{process}: L {l:.0}, C {c:.0}, h {h:.0}, {}", named.0);
        if !is_named(*color, *named) {
            wrong += &format!(
                "{process}: L {l:.0}, C {c:.0}, h {h:.0} is not {}\n",
                named.0
            );
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

fn tinted(celsius: f64) -> [f64; 3] {
    let process = format!("{{ heat_tint = {{ temperature_c = {celsius}, minutes = 10 }} }}");
    color(&scene("'magnetite'", "'iron'", &process))
}

/// Temper colors of carbon steel (Machinery's Handbook): pale straw 232, brown-yellow 260, full purple 282, dark blue
/// 299, light blue 338 °C.
#[test]
fn heat_tints_of_steel_are_the_temper_colors() {
    let expected = [
        (232.0, STRAW),
        (260.0, BROWN),
        (282.0, PURPLE),
        (299.0, BLUE),
        (338.0, LIGHT_BLUE),
    ];
    let found = expected.map(|(c, named)| (tinted(c), named, format!("{c} °C")));
    assert_colors(&found);
}

fn anodized(volts: f64) -> [f64; 3] {
    let process = format!("{{ anodizing = {{ metal = 'titanium', volts = {volts} }} }}");
    color(&scene("2.3", "'titanium'", &process))
}

/// The sequence of colors of titanium anodized up to some 120 V, after Diamanti, Del Curto and Pedeferri (Color Res. Appl. 33, 221,
/// 2008) and suppliers' charts. The voltage of each color depends on the electrolyte; the order does not.
#[test]
fn anodized_titanium_has_its_sequence_of_colors() {
    let anywhere = [30.0, 90.0];
    let expected: [(f64, Named); 10] = [
        (10.0, ("gold", anywhere, 25.0, [65.0, 95.0])),
        (16.0, ("purple", anywhere, 25.0, [300.0, 350.0])),
        (21.0, ("blue", anywhere, 25.0, [250.0, 290.0])),
        (36.0, ("silver", [75.0, 90.0], 0.0, [0.0, 360.0])),
        (48.0, ("yellow", [75.0, 90.0], 40.0, [85.0, 105.0])),
        (60.0, ("pink", anywhere, 40.0, [330.0, 370.0])),
        (64.0, ("violet", anywhere, 40.0, [300.0, 330.0])),
        (69.0, ("cobalt", anywhere, 40.0, [250.0, 290.0])),
        (81.0, ("green", anywhere, 25.0, [130.0, 180.0])),
        (105.0, ("pink again", anywhere, 40.0, [330.0, 370.0])),
    ];
    let found = expected.map(|(v, named)| (anodized(v), named, format!("{v} V")));
    assert_colors(&found);
    let [_, chroma, _] = anodized(36.0);
    assert!(chroma < 10.0, "silver has chroma {chroma}");
}

/// The test can fail: no temper color passes as another.
#[test]
fn a_color_has_only_its_own_name() {
    let names = [STRAW, BROWN, PURPLE, BLUE, LIGHT_BLUE];
    for (index, celsius) in [232.0, 260.0, 282.0, 338.0].into_iter().enumerate() {
        let index = if index == 3 { 4 } else { index };
        for (other, named) in names.into_iter().enumerate() {
            assert_eq!(
                is_named(tinted(celsius), named),
                other == index,
                "{celsius} °C, {}",
                named.0
            );
        }
    }
}
