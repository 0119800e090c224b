//! Color errors of tables at coarse steps: reflectances every 10 and 20 nm, as instruments measure them, by Sprague's interpolation and by
//! straight lines, compared with the reflectances themselves at every nm.

use coating::{Angle, Stack};
use colorimetry::Lab;
use colorimetry::lab::delta_e_2000;
use colorimetry::tristimulus::{Rule, Weights};
use spectra::{Observer, Spectrum, Tabulated, find_illuminant, sprague};

const SMOOTH: [&str; 6] = [
    "1 | gold",
    "1 | copper",
    "1 | silicon",
    "air | titania 60nm | silica 90nm | gold 8nm | bk7",
    "1 | 1.33 250nm | 1",
    "1 | silica 300nm | silicon",
];

/// ΔE₀₀ under an illuminant by straight lines and by Sprague's interpolation.
fn losses(line: &str, illuminant: &str, step_nm: usize) -> [f64; 2] {
    let stack = Stack::parse(line).unwrap();
    let every = |step: usize| {
        let nm: Vec<f64> = (380..=780)
            .step_by(step)
            .map(|nm| f64::from(nm as u32))
            .collect();
        let sampled = stack.sampled(&nm).unwrap();
        let powers = sampled.powers(stack.thicknesses_nm(), Angle::NORMAL);
        let shares = powers.iter().map(|p| p.reflectance.unpolarized());
        Tabulated::new(nm.iter().copied().zip(shares).collect()).unwrap()
    };
    let light = find_illuminant(illuminant).unwrap().data;
    let weights = Weights::new(
        &light,
        Observer::Cie1931Deg2,
        Rule::for_illuminant(illuminant),
    )
    .unwrap();
    let lab = |table: &Tabulated| {
        let xyz = weights.xyz_of(&Spectrum::Table(table.clone())).unwrap();
        Lab::from_xyz(xyz, weights.white())
    };
    let (truth, coarse) = (lab(&every(1)), every(step_nm));
    let (fine, _) = sprague(&coarse, (0.0, 1.0)).unwrap();
    [lab(&coarse), lab(&fine)].map(|found| delta_e_2000(found, truth))
}

#[test]
fn sprague_is_nearer_than_straight_lines() {
    for (step_nm, most) in [(10, [0.11, 0.03]), (20, [0.55, 0.25])] {
        let mut worst = [0.0_f64; 2];
        for line in SMOOTH {
            for illuminant in ["D65", "A", "FL11"] {
                let found = losses(line, illuminant, step_nm);
                println!("{line}, {illuminant}, {step_nm} nm: {found:.3?}");
                worst = [0, 1].map(|i| worst[i].max(found[i]));
            }
        }
        // Straight lines lose roughly what the docs say, and Sprague's interpolation less than half of it.
        assert!(
            worst[0] < most[0] && worst[1] < most[1],
            "{step_nm} nm: {worst:.3?}"
        );
        assert!(worst[1] < 0.5 * worst[0], "{step_nm} nm: {worst:.3?}");
    }
}
