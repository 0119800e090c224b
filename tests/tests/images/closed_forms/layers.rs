//! Films and coatings of several layers, and films with the two-beam model.

use super::comparison::{DOWN, WHITE, band_mean, check, render, scene};
use optics::{Complex64, Layer, PathDifference};
use pellicle_tests::device::lend;
use pellicle_tests::tolerances::CLOSED_FORM;

const GLASS: Layer = Layer {
    index: Complex64::new(1.5, 0.0),
    thickness_nm: 120.0,
};
const METAL: Layer = Layer {
    index: Complex64::new(0.3, 2.5),
    thickness_nm: 15.0,
};

/// Layers in the syntax of a scene file.
fn written(layers: &[Layer]) -> String {
    let one = |layer: &Layer| {
        let (index, nm) = (layer.index, layer.thickness_nm);
        format!(
            "{{ index = [{:?}, {:?}], thickness_nm = {nm:?} }}",
            index.re, index.im
        )
    };
    let all: Vec<_> = layers.iter().map(one).collect();
    format!("layers = [{}]", all.join(", "))
}

/// A sheet of the material `sheet` whose normal points up (1) or down (−1), seen from above.
fn sheet(up: i32) -> String {
    format!(
        "[[objects]]\ntype = \"rectangle\"\nmaterial = \"sheet\"\ncenter = [0, 0, 0]\nnormal = [0, {up}, 0]\nsize = [2, 2]\n"
    )
}

/// Under uniform illumination a film shows R + T. The two sides of an absorbing film differ in R, not in T.
#[test]
fn a_film_of_two_layers_has_two_faces() {
    let gpu = lend();
    let layers = [GLASS, METAL];
    let shown = |layers: &[Layer], nm: f64| {
        let film = optics::stack(1.0, layers, Complex64::ONE, nm, 1.0);
        film.reflectance.unpolarized() + film.transmittance.unpolarized()
    };
    let reversed = [METAL, GLASS];
    assert!(shown(&layers, 550.0) - shown(&reversed, 550.0) < -0.05);
    for (up, seen) in [(1, &layers), (-1, &reversed)] {
        let material = format!("[materials.sheet]\ntype = \"film\"\n{}\n", written(&layers));
        let drawn = scene(&[
            DOWN,
            &render(256, 3, "random"),
            &material,
            &sheet(up),
            WHITE,
        ]);
        check(&gpu, &format!("normal {up}"), &drawn, CLOSED_FORM, |band| {
            band_mean(&drawn, band, |nm| shown(seen, nm))
        });
    }
}

/// A coating looks the same from both sides of its sheet.
#[test]
fn a_coating_reflects_as_its_stack() {
    let gpu = lend();
    let substrate = Complex64::new(0.6, 3.0);
    let layers = [GLASS, METAL, GLASS];
    for up in [1, -1] {
        let material = format!(
            "[materials.sheet]\ntype = \"coated\"\nsubstrate = [0.6, 3.0]\n{}\n",
            written(&layers)
        );
        let drawn = scene(&[DOWN, &render(64, 2, "random"), &material, &sheet(up), WHITE]);
        check(&gpu, &format!("normal {up}"), &drawn, CLOSED_FORM, |band| {
            band_mean(&drawn, band, |nm| {
                let stack = optics::stack(1.0, &layers, substrate, nm, 1.0);
                stack.reflectance.unpolarized()
            })
        });
    }
}

/// With two beams R + T is not 1: the picture shows the sum that the formula gives.
#[test]
fn two_beams_show_the_sum_of_their_formulas() {
    let gpu = lend();
    let (index, thickness_nm) = (1.9, 300.0);
    for (name, path) in [
        ("optical", PathDifference::Optical),
        ("as_printed", PathDifference::AsPrinted),
    ] {
        let material = format!(
            "[materials.sheet]\ntype = \"film\"\nindex = {index:?}\nthickness_nm = {thickness_nm:?}\n\
             model = \"two_beam\"\npath_difference = \"{name}\"\n"
        );
        let drawn = scene(&[DOWN, &render(256, 3, "random"), &material, &sheet(1), WHITE]);
        check(&gpu, name, &drawn, CLOSED_FORM, |band| {
            band_mean(&drawn, band, |nm| {
                let film = optics::two_beam(index, thickness_nm, nm, 1.0, path);
                film.reflectance.unpolarized() + film.transmittance.unpolarized()
            })
        });
    }
}
