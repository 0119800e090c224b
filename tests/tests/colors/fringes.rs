//! Colors of films whose fringes are finer than the steps of the sums, compared with sums over a sufficiently fine grid.

use coating::{Angle, Light, Side, Stack, StackColor, View, sensitivity};
use colorimetry::Lab;
use colorimetry::lab::delta_e_2000;
use proptest::prelude::*;

/// Largest ΔE₀₀ that the properties allow.
const WITHIN: f64 = 0.05;

fn angle(deg: f64) -> Angle {
    Angle::from_degrees(deg).unwrap()
}

fn view(side: Side) -> View {
    View {
        side,
        ..View::default()
    }
}

/// XYZ by the trapezoidal rule on a grid of `per_nm` parts per nm. The products of light and observer are linear between the wavelengths
/// of the light's sums. Indices are read again at each point.
fn on_fine_grid(stack: &Stack, light: &Light, side: Side, at: Angle, per_nm: u32) -> [f64; 3] {
    let weights = light.per_wavelength();
    let last = weights.len() - 1;
    let parts = per_nm * light.step_nm() as u32;
    let mut xyz = [0.0; 3];
    for step in 0..=last {
        let within = if step == last { 0..1 } else { 0..parts };
        let nm = within.clone().map(|part| {
            380.0 + light.step_nm() * (step as f64 + f64::from(part) / f64::from(parts))
        });
        let powers = stack
            .sampled(&nm.collect::<Vec<_>>())
            .unwrap()
            .powers_of_all(&[stack.thicknesses_nm().to_vec()], &[at]);
        for (part, powers) in within.zip(powers) {
            let along = f64::from(part) / f64::from(parts);
            let seen = view(side).of(powers.reflectance, powers.transmittance);
            let next = weights[(step + 1).min(last)];
            for i in 0..3 {
                let weight = weights[step][i] * (1.0 - along) + next[i] * along;
                // The CIE's sum counts its first and last wavelengths in full.
                let whole = match (step, part) {
                    (0, 0) => 0.5 + 0.5 * f64::from(parts),
                    (step, _) if step == last => 0.5 + 0.5 * f64::from(parts),
                    _ => 1.0,
                };
                xyz[i] += weight * whole * seen / f64::from(parts);
            }
        }
    }
    xyz
}

fn lab(xyz: [f64; 3], light: &Light) -> Lab {
    Lab::from_xyz(xyz, light.white())
}

fn found(stack: &Stack, light: &Light, side: Side, at: Angle) -> Lab {
    let color = StackColor::new(stack, light.clone(), view(side)).unwrap();
    color.at(stack.thicknesses_nm(), at).lab()
}

fn difference(line: &str, lamp: &str, side: Side, deg: f64, per_nm: u32) -> f64 {
    let stack = Stack::parse(line).unwrap();
    let light = Light::named(lamp).unwrap();
    let expected = on_fine_grid(&stack, &light, side, angle(deg), per_nm);
    delta_e_2000(
        found(&stack, &light, side, angle(deg)),
        lab(expected, &light),
    )
}

#[test]
fn a_thick_film_has_no_color_that_its_grid_gave_it() {
    for (line, lamp, deg) in [
        ("1 | 1.52 19000nm | 1", "FL11", 0.0),
        ("1 | 1.52 12um | 1", "FL2", 0.0),
        ("1 | 1.52 95um | 1", "D65", 0.0),
        ("1 | 1.52 95um | 1", "D65", 70.0),
        // Two fringes per nm at 550 nm: 2 n d = λ²/0.5 nm.
        ("1 | 3.025 100um | silicon", "D65", 0.0),
        ("1 | silica 50um | silver", "A", 30.0),
        (
            "air | 1.6 40um | 1.4+0.00001i 70um | 1.9 33um | bk7",
            "FL4",
            45.0,
        ),
        (
            "1 | silver 40nm | 1.46 30um | silver 40nm | 1.5",
            "LED-B3",
            0.0,
        ),
    ] {
        for side in [Side::Reflected, Side::Transmitted] {
            let found = difference(line, lamp, side, deg, 200);
            assert!(found < WITHIN, "{line} under {lamp}, {side:?}: {found}");
        }
    }
}

/// Compared with a separate sum over 380 to 780 nm in steps of 0.01 nm, computed from Airy's formula alone.
#[test]
fn a_film_of_19_micrometers_is_neutral_under_three_bands() {
    let stack = Stack::parse("1 | 1.52 19000nm | 1").unwrap();
    let light = Light::named("FL11").unwrap();
    let lab = found(&stack, &light, Side::Reflected, angle(0.0));
    for (found, expected) in [(lab.l, 34.312), (lab.a, -0.064), (lab.b, 0.054)] {
        assert!((found - expected).abs() < 0.01, "{lab:?}");
    }
}

/// A line of 0.2 nm in the violet, with eleven layers on each side of its cavity, compared with a sum over 380 to 780 nm in steps of
/// 0.002 nm by an independent program.
#[test]
fn a_line_filter_lets_through_what_its_line_does() {
    let pair = "2.35 58.542553191nm | 1.46 94.229452055nm";
    let mirror = [pair; 6].join(" | ");
    let back = "1.46 94.229452055nm | 2.35 58.542553191nm";
    let line = format!(
        "1 | {mirror} | 2.35 117.085106383nm | {} | 1.52",
        [back; 6].join(" | ")
    );
    let stack = Stack::parse(&line).unwrap();
    let color = StackColor::new(
        &stack,
        Light::named("D65").unwrap(),
        view(Side::Transmitted),
    )
    .unwrap();
    let y = color.at(stack.thicknesses_nm(), angle(0.0)).xyz[1];
    assert!((y - 0.01799).abs() < 1e-5, "{y}");
}

/// A filter of six pairs on each side of a cavity has a line narrower than 1 nm, and one of nine pairs hundreds of times narrower.
#[test]
fn a_narrow_line_is_not_missed_between_two_wavelengths() {
    for pairs in [4, 6, 9] {
        for cavity_nm in [377.0, 378.1, 380.4] {
            let mirror =
                |first: &str, second: &str| vec![format!("{first} | {second}"); pairs].join(" | ");
            let (h, l) = ("2.35 58.5nm", "1.46 94.2nm");
            let line = format!(
                "1 | {} | 1.46 {cavity_nm}nm | {} | 1.52",
                mirror(h, l).rsplit_once(" | ").unwrap().0,
                mirror(l, h).split_once(" | ").unwrap().1,
            );
            let found = difference(&line, "D65", Side::Transmitted, 0.0, 500);
            assert!(found < WITHIN, "{pairs} pairs, {cavity_nm} nm: {found}");
        }
    }
}

/// Smooth spectra keep the CIE's own sums, digit by digit.
#[test]
fn thin_films_keep_the_sums_of_the_cie() {
    for (line, lamp) in [
        ("1 | 1.33 300nm | 1", "D65"),
        ("1 | 2.4 60nm | 1.46 90nm | 0.2+3i 8nm | 1.5", "A"),
        ("1 | 1.5 2um | 1.9", "LED-B3"),
        ("1 | 1.5", "D5500K"),
    ] {
        let (stack, light) = (Stack::parse(line).unwrap(), Light::named(lamp).unwrap());
        let color = StackColor::new(&stack, light.clone(), View::default()).unwrap();
        let powers = color.sampled().powers(stack.thicknesses_nm(), angle(20.0));
        let sum = light.xyz(powers.iter().map(|p| p.reflectance.unpolarized()));
        let found = color.at(stack.thicknesses_nm(), angle(20.0)).xyz;
        assert_eq!(found, sum, "{line} under {lamp}");
    }
}

#[test]
fn many_at_once_are_the_same_as_each_alone() {
    let stack = Stack::parse("1 | 1.52 19000nm | 1.46 3um | silicon").unwrap();
    let color = StackColor::new(&stack, Light::named("FL11").unwrap(), View::default()).unwrap();
    let sets = [
        vec![19_000.0, 3000.0],
        vec![200.0, 0.0],
        vec![95_000.0, 1.0],
    ];
    let angles = [angle(0.0), angle(60.0)];
    let all = color.xyz_of_all(&sets, &angles);
    let each = sets
        .iter()
        .flat_map(|set| angles.map(|at| color.at(set, at).xyz));
    for (found, expected) in all.into_iter().zip(each) {
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
    }
}

/// The derivative of the integral agrees with its differences.
#[test]
fn thick_films_change_color_as_their_derivative_says() {
    let stack = Stack::parse("1 | 1.52 8um | 2.0 90nm | silicon").unwrap();
    for (lamp, layer) in [("D65", 0), ("D65", 1), ("FL11", 0), ("FL11", 1)] {
        let color = StackColor::new(&stack, Light::named(lamp).unwrap(), View::default()).unwrap();
        let at = |by: f64| {
            let mut thicknesses = stack.thicknesses_nm().to_vec();
            thicknesses[layer] += by;
            color.at(&thicknesses, angle(0.0)).xyz
        };
        let h = 0.5;
        let (up, down) = (at(h), at(-h));
        let found = sensitivity(&color, stack.thicknesses_nm(), angle(0.0));
        let found = found.layers[layer].xyz_per_nm;
        for i in 0..3 {
            let rate = (up[i] - down[i]) / (2.0 * h);
            let aside = (found[i] - rate).abs();
            assert!(
                aside < 2e-3 * rate.abs() + 1e-6,
                "{lamp}: {} {rate}",
                found[i]
            );
        }
        let is_neutral = lamp == "D65" && layer == 0;
        assert!(
            is_neutral || found[1].abs() > 1e-4,
            "{lamp}, {layer}: {found:?}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_film_under_any_lamp_is_as_on_a_fine_grid(
        power in 1.0..5.0_f64,
        second_nm in 0.0..400.0_f64,
        n in 1.2..3.0_f64,
        deg in 0.0..80.0_f64,
        lamp in prop::sample::select(vec!["D65", "A", "E", "FL2", "FL11", "FL12", "LED-B3", "HP1"]),
        on in prop::sample::select(vec!["1", "bk7", "silver", "silicon"]),
    ) {
        let line = format!("1 | {n} {}nm | 2.2+0.002i {second_nm}nm | {on}", 10_f64.powf(power));
        let found = difference(&line, lamp, Side::Reflected, deg, 100);
        prop_assert!(found < WITHIN, "{line} at {deg}° under {lamp}: {found}");
    }
}
