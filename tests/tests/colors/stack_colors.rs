//! Colors of stacks compared with an independent computation, from the one-line stack to linear sRGB.

use coating::{Angle, Color, Light, Stack, StackColor, View};
use colorimetry::lab::delta_e_2000;
use colorimetry::tristimulus::Rule;
use colorimetry::{Adaptation, matrix::times, srgb};
use spectra::Observer;

const TABLE: &str = include_str!("data/stack_colors.csv");

/// The stack, angle, illuminant and rule of each row, and its twelve values.
fn rows() -> impl Iterator<Item = (&'static str, f64, &'static str, Rule, [f64; 12])> {
    let lines = TABLE.lines().filter(|line| !line.starts_with('#')).skip(1);
    lines.map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        let figures: Vec<f64> = cells[4..].iter().map(|c| c.parse().unwrap()).collect();
        let angle = cells[1].parse().unwrap();
        let rule = cells[3].parse().unwrap();
        (cells[0], angle, cells[2], rule, figures.try_into().unwrap())
    })
}

/// By the CIE's own sums: X, Y and Z times 100, L*, a*, b*, and linear sRGB without and with adaptation to the display's white.
fn figures(stack: &str, angle_deg: f64, illuminant: &str, rule: Rule) -> [f64; 12] {
    let stack = Stack::parse(stack).unwrap();
    let lamp = spectra::find_illuminant(illuminant).unwrap().data;
    let light = Light::new(illuminant, &lamp, Observer::Cie1931Deg2, rule).unwrap();
    let adaptation = Adaptation::Bradford.matrix(light.white(), srgb::white_xyz());
    let color = StackColor::new(&stack, light, View::default()).unwrap();
    let angle = Angle::from_degrees(angle_deg).unwrap();
    let integral = color.at(stack.thicknesses_nm(), angle);
    let powers = color.sampled().powers(stack.thicknesses_nm(), angle);
    let shares = powers.iter().map(|p| p.reflectance.unpolarized());
    let xyz = color.light().xyz(shares);
    let color = Color { xyz, ..integral };
    // Sums at 1 nm differ from the integral by less than is visible, sums at 5 nm by more.
    let aside = delta_e_2000(color.lab(), integral.lab());
    let most = if rule == Rule::OneNm { 0.005 } else { 0.3 };
    assert!(aside < most, "{aside}");
    let (xyz, lab, rgb) = (
        color.xyz.map(|v| 100.0 * v),
        color.lab(),
        color.linear_srgb(0.0),
    );
    let mut figures = [0.0; 12];
    figures[..3].copy_from_slice(&xyz);
    figures[3..6].copy_from_slice(&[lab.l, lab.a, lab.b]);
    figures[6..9].copy_from_slice(&rgb);
    let adapted = srgb::linear_from_xyz(times(&adaptation, color.xyz));
    figures[9..].copy_from_slice(&adapted);
    figures
}

/// The largest difference: relative for XYZ, absolute for L*, a*, b* over 100 and for sRGB.
fn difference(found: [f64; 12], expected: [f64; 12]) -> f64 {
    let unit = |i: usize| match i {
        0..3 => expected[i],
        3..6 => 100.0,
        _ => 1.0,
    };
    let differences = (0..12).map(|i| ((found[i] - expected[i]) / unit(i)).abs());
    differences.fold(0.0, f64::max)
}

#[test]
fn stacks_have_the_colors_of_an_independent_computation() {
    let mut count = 0;
    for (stack, angle_deg, illuminant, rule, expected) in rows() {
        let found = figures(stack, angle_deg, illuminant, rule);
        let worst = difference(found, expected);
        assert!(
            worst < 1e-9,
            "{stack} at {angle_deg}° under {illuminant}, {rule}: {worst:e}"
        );
        count += 1;
    }
    assert_eq!(count, 14 * 4 * 3 * 2);
}

/// The comparison detects a hundredth of a nanometer, a hundredth of a degree and another illuminant.
#[test]
fn a_slightly_different_stack_is_noticed() {
    let worst = |stack, angle_deg, illuminant| {
        let expected = figures("1 | silica 300nm | silicon", 30.0, "D65", Rule::OneNm);
        difference(figures(stack, angle_deg, illuminant, Rule::OneNm), expected)
    };
    assert_eq!(worst("1 | silica 300nm | silicon", 30.0, "D65"), 0.0);
    assert!(worst("1 | silica 300.01nm | silicon", 30.0, "D65") > 1e-6);
    assert!(worst("1 | silica 300nm | silicon", 30.01, "D65") > 1e-6);
    assert!(worst("1 | silica 300nm | silicon", 30.0, "C") > 1e-3);
}
