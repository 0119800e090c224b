//! A virtual ellipsometer: a polarized source, a sample, and a camera with a polarizer and a quarter-wave plate.

use super::bench::{
    NM, Renderer, SAMPLE, assert_matrix, camera_at, coated, mueller, pictures, render, scene,
    surroundings,
};
use super::oracle::airy;
use gpu::Gpu;
use optics::{Complex64, Layer};
use pellicle_tests::device::lend;
use pellicle_tests::tables::{number, rows};
use pellicle_tests::tolerances::ELLIPSOMETRY_DEG;

const TABLE: &str = include_str!("../../../data/ellipsometry.csv");

const fn layer(n: f64, k: f64, thickness_nm: f64) -> Layer {
    Layer {
        index: Complex64::new(n, k),
        thickness_nm,
    }
}

/// The stacks of the table: layers from the outside, and the substrate.
fn stack(name: &str) -> (Vec<Layer>, Complex64) {
    match name {
        "oxide" => (
            vec![layer(1.4571, 0.0, 100.0)],
            Complex64::new(3.875, 0.018),
        ),
        "five" => (
            vec![
                layer(2.4, 0.001, 55.0),
                layer(0.15, 3.5, 10.0),
                layer(2.4, 0.001, 40.0),
                layer(1.46, 0.0, 90.0),
                layer(2.9, 3.1, 8.0),
            ],
            Complex64::new(1.52, 0.0),
        ),
        _ => panic!("the table has no other stacks: {name}"),
    }
}

/// The powers behind each analyzer, in all bands.
fn powers(gpu: &Gpu, sample: &str, degrees: f64, analyzer: &str) -> [(Renderer, Vec<f64>); 2] {
    let camera = camera_at(degrees, &format!("polarizer = {{ {analyzer} }}"));
    // Linear at 45° to the plane of incidence.
    let light = surroundings([0.0, 1.0, 0.0]);
    let drawn = scene(&[&camera, &render(1), sample, SAMPLE, &light]);
    pictures(gpu, &drawn).map(|(renderer, image)| {
        let powers = image.pixel(0, 0).iter().map(|&power| f64::from(power));
        (renderer, powers.collect())
    })
}

/// ψ and Δ in degrees in all bands, from the powers behind analyzers at 0°, 45°, 90° and 135°, and behind the quarter-wave plate on both
/// sides of its fast axis: N = cos 2ψ, C = sin 2ψ cos Δ, S = sin 2ψ sin Δ are S1, S2 and S3 over S0 about s.
fn measured(gpu: &Gpu, sample: &str, degrees: f64) -> [(Renderer, Vec<[f64; 2]>); 2] {
    let linear = |angle| powers(gpu, sample, degrees, &format!("angle_deg = {angle}"));
    let circular = |angle| {
        let plate = "retarder = { fast_axis_deg = 0, retardance_deg = 90 }";
        powers(
            gpu,
            sample,
            degrees,
            &format!("angle_deg = {angle}, {plate}"),
        )
    };
    let behind = [
        linear(0),
        linear(90),
        linear(45),
        linear(135),
        circular(45),
        circular(-45),
    ];
    [0, 1].map(|i| {
        let of = |band: usize| {
            let power = |analyzer: usize| behind[analyzer][i].1[band];
            let both = power(0) + power(1);
            let [n, c, s] = [0, 2, 4].map(|first| (power(first) - power(first + 1)) / both);
            let psi = 0.5 * c.hypot(s).atan2(n).to_degrees();
            [psi, s.atan2(c).to_degrees().rem_euclid(360.0)]
        };
        (behind[0][i].0, (0..NM.len()).map(of).collect())
    })
}

/// The larger of the differences of ψ and Δ, degrees.
fn difference(found: [f64; 2], expected: [f64; 2]) -> f64 {
    let delta = (found[1] - expected[1] + 180.0).rem_euclid(360.0) - 180.0;
    (found[0] - expected[0]).abs().max(delta.abs())
}

#[test]
fn the_oracle_agrees_with_the_table() {
    let mut count = 0;
    for row in rows(TABLE) {
        let (layers, substrate) = stack(row[0]);
        let [r, _] = airy(&layers, substrate, number(row[2]), number(row[1]));
        let off = difference(r.ellipsometric_deg(), [number(row[3]), number(row[4])]);
        assert!(off < 1e-8, "{row:?}: {:?}", r.ellipsometric_deg());
        count += 1;
    }
    assert_eq!(count, 20);
}

#[test]
fn the_ellipsometer_reads_the_angles_of_the_table() {
    let gpu = lend();
    for name in ["oxide", "five"] {
        let (layers, substrate) = stack(name);
        let sample = coated(&layers, substrate);
        for degrees in ["55", "70"] {
            let of_stack = rows(TABLE).filter(|row| row[0] == name && row[1] == degrees);
            let expected: Vec<_> = of_stack.collect();
            assert_eq!(expected.len(), NM.len());
            for (renderer, found) in measured(&gpu, &sample, number(degrees)) {
                for ((found, row), nm) in found.iter().zip(&expected).zip(NM) {
                    assert_eq!(number(row[2]), nm);
                    let off = difference(*found, [number(row[3]), number(row[4])]);
                    println!(
                        "{name}, {degrees}°, {nm} nm, {renderer}: {found:?}, off by {off:.1e}°"
                    );
                    assert!(
                        off <= ELLIPSOMETRY_DEG,
                        "{name}, {renderer}: {found:?} instead of {row:?}"
                    );
                }
            }
        }
    }
}

/// The whole matrices of the samples, from sources of four polarizations.
#[test]
fn the_samples_have_the_matrices_of_their_amplitudes() {
    let gpu = lend();
    for name in ["oxide", "five"] {
        let (layers, substrate) = stack(name);
        let sample = coated(&layers, substrate);
        for degrees in [55.0, 70.0] {
            let camera = camera_at(degrees, "");
            let parts =
                |stokes| [&camera, &render(1), &sample, SAMPLE, &surroundings(stokes)].join("\n");
            for (renderer, matrices) in mueller(&gpu, parts) {
                for (matrix, nm) in matrices.iter().zip(NM) {
                    let what = format!("{name}, {degrees}°, {nm} nm");
                    let [r, _] = airy(&layers, substrate, nm, degrees);
                    assert_matrix(&what, renderer, matrix, |stokes| r.apply(stokes));
                }
            }
        }
    }
}

/// A wrong sign of S3, s and p exchanged, and a nanometer of oxide are all noticed.
#[test]
fn a_wrong_sample_is_noticed() {
    let gpu = lend();
    let (layers, substrate) = stack("oxide");
    let right = airy(&layers, substrate, NM[2], 70.0)[0].ellipsometric_deg();
    let [psi, delta] = right;
    let thicker = [layer(1.4571, 0.0, 100.1)];
    let [(_, found), _] = measured(&gpu, &coated(&thicker, substrate), 70.0);
    for wrong in [found[2], [psi, 360.0 - delta], [90.0 - psi, delta]] {
        assert!(difference(wrong, right) > ELLIPSOMETRY_DEG, "{wrong:?}");
    }
}
