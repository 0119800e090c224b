use super::*;
use crate::{Layer, stack};
use proptest::prelude::*;

/// The bound stated in the docs of [`evaluate`].
const ORDINARY: f64 = 1e-12;

/// A batch that owns its tables.
#[derive(Clone, Debug)]
struct Tables {
    wavelengths_nm: Vec<f64>,
    cosines: Vec<f64>,
    incident: f64,
    constant: bool,
    media: Vec<Complex64>,
    layers: Vec<LayerOf>,
    stacks: Vec<StackOf>,
}

impl Tables {
    fn batch(&self) -> StackBatch<'_> {
        StackBatch {
            wavelengths_nm: &self.wavelengths_nm,
            cosines: &self.cosines,
            incident: self.incident,
            media: if self.constant {
                Media::Constant(&self.media)
            } else {
                Media::Dispersive(&self.media)
            },
            layers: &self.layers,
            stacks: &self.stacks,
        }
    }

    /// The same results by one call of `stack` each.
    fn one_by_one(&self) -> Vec<[f64; 4]> {
        let batch = self.batch();
        let mut powers = Vec::new();
        for of in &self.stacks {
            for &cosine in &self.cosines {
                for (place, &nm) in self.wavelengths_nm.iter().enumerate() {
                    let layer = |layer: &LayerOf| Layer {
                        index: batch.index(layer.medium, place),
                        thickness_nm: layer.thickness_nm,
                    };
                    let layers: Vec<Layer> = batch.layers_of(*of).iter().map(layer).collect();
                    let substrate = batch.index(of.substrate, place);
                    let found = stack(self.incident, &layers, substrate, nm, cosine);
                    let (r, t) = (found.reflectance, found.transmittance);
                    powers.push([r.s, r.p, t.s, t.p]);
                }
            }
        }
        powers
    }

    /// The largest difference between the batch, on each instruction set of this machine, and the single calls.
    fn worst(&self) -> f64 {
        let expected = self.one_by_one();
        let mut worst = 0.0_f64;
        for arch in arches() {
            let mut found = vec![Powers::default(); self.batch().len()];
            run(arch, &self.batch(), &mut found);
            worst = worst.max(difference(&found, &expected));
        }
        worst
    }
}

/// The largest difference of any value; infinite where one is NaN or the lengths differ.
fn difference(found: &[Powers], expected: &[[f64; 4]]) -> f64 {
    if found.len() != expected.len() || found.is_empty() {
        return f64::INFINITY;
    }
    let mut worst = 0.0_f64;
    for (found, expected) in found.iter().zip(expected) {
        let (r, t) = (found.reflectance, found.transmittance);
        for (a, b) in [r.s, r.p, t.s, t.p].into_iter().zip(expected) {
            let error = (a - b).abs();
            worst = worst.max(if error.is_nan() { f64::INFINITY } else { error });
        }
    }
    worst
}

/// Every instruction set of the machine, including the scalar one.
#[cfg(target_arch = "x86_64")]
fn arches() -> Vec<Arch> {
    let mut arches = vec![Arch::Scalar];
    arches.extend(pulp::x86::V3::try_new().map(Arch::V3));
    arches.extend(pulp::x86::V4::try_new().map(Arch::V4));
    arches
}

#[cfg(not(target_arch = "x86_64"))]
fn arches() -> Vec<Arch> {
    vec![Arch::new()]
}

/// Random tables: `wavelengths` wavelengths, up to four angles, six media (the last two absorb up to `k`), and up to 24 layers
/// of up to 300 nm each, in up to seven stacks of up to eight layers.
fn tables(
    wavelengths: std::ops::RangeInclusive<usize>,
    incident: std::ops::Range<f64>,
    k: f64,
) -> impl Strategy<Value = Tables> {
    (wavelengths, any::<bool>(), incident).prop_flat_map(move |(count, constant, incident)| {
        let spectrum = if constant { 1 } else { count };
        let clear = prop::collection::vec(1.3..2.6_f64, 4 * spectrum);
        let lossy = prop::collection::vec((0.1..3.0_f64, 0.0..=k), 2 * spectrum);
        let media = (clear, lossy).prop_map(|(clear, lossy)| {
            let clear = clear.into_iter().map(Complex64::from);
            clear
                .chain(lossy.into_iter().map(|(n, k)| Complex64::new(n, k)))
                .collect()
        });
        let layer = (0..6_u32, 0.0..300.0_f64).prop_map(|(medium, thickness_nm)| LayerOf {
            medium,
            thickness_nm,
        });
        let stack =
            (0..6_u32, 0..=16_u32, 0..=8_u32).prop_map(|(substrate, first_layer, layer_count)| {
                StackOf {
                    substrate,
                    first_layer,
                    layer_count,
                }
            });
        (
            prop::collection::vec(380.0..780.0_f64, count),
            prop::collection::vec(0.02..=1.0_f64, 1..=4),
            media,
            prop::collection::vec(layer, 24),
            prop::collection::vec(stack, 1..=20),
        )
            .prop_map(
                move |(wavelengths_nm, cosines, media, layers, stacks)| Tables {
                    wavelengths_nm,
                    cosines,
                    incident,
                    constant,
                    media,
                    layers,
                    stacks,
                },
            )
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn spectra_agree_with_single_calls(tables in tables(4..=19, 1.0..1.3, 4.0)) {
        let worst = tables.worst();
        prop_assert!(worst < ORDINARY, "{worst:e}");
    }

    #[test]
    fn few_wavelengths_agree_with_single_calls(tables in tables(1..=3, 1.0..1.3, 4.0)) {
        let worst = tables.worst();
        prop_assert!(worst < ORDINARY, "{worst:e}");
    }

    /// From a dense medium, waves tunnel or are totally reflected. Resonances of layers between two gaps amplify rounding a
    /// hundredfold.
    #[test]
    fn total_reflection_agrees_with_single_calls(tables in tables(1..=9, 1.3..2.6, 0.0)) {
        let worst = tables.worst();
        prop_assert!(worst < 100.0 * ORDINARY, "{worst:e}");
    }
}

const NM: [f64; 5] = [400.0, 500.0, 550.0, 600.0, 700.0];

/// One stack of constant media at the wavelengths `NM`.
fn one(incident: f64, cosines: &[f64], layers: &[Layer], substrate: Complex64) -> Tables {
    let layer = |(medium, layer): (u32, &Layer)| LayerOf {
        medium,
        thickness_nm: layer.thickness_nm,
    };
    let mut media: Vec<Complex64> = layers.iter().map(|layer| layer.index).collect();
    media.push(substrate);
    Tables {
        wavelengths_nm: NM.to_vec(),
        cosines: cosines.to_vec(),
        incident,
        constant: true,
        layers: (0..).zip(layers).map(layer).collect(),
        stacks: vec![StackOf {
            substrate: layers.len() as u32,
            first_layer: 0,
            layer_count: layers.len() as u32,
        }],
        media,
    }
}

fn layer(n: f64, k: f64, thickness_nm: f64) -> Layer {
    let index = Complex64::new(n, k);
    Layer {
        index,
        thickness_nm,
    }
}

/// 89.99°.
const GRAZING: f64 = 1.745_329_243_133_368e-4;

/// The batch and the single calls agree, and are finite, at the edges of the domain.
#[test]
fn the_edges_of_the_domain_agree() {
    let critical = (1.0 - (1.0 / 1.5_f64).powi(2)).sqrt();
    let cosines = [
        1.0,
        critical,
        critical * (1.0 + 1e-15),
        0.5,
        1e-3,
        GRAZING,
        1e-9,
    ];
    let gap = [
        layer(1.5, 0.0, 90.0),
        layer(1.0, 0.0, 60.0),
        layer(1.5, 0.0, 30.0),
    ];
    let nothing = [layer(0.2, 3.0, 0.0), layer(1.0, 0.0, 0.0)];
    let dark = [layer(0.1, 4.0, 3e4), layer(1.4, 0.0, 100.0)];
    let ideal = [layer(0.0, 2.0, 10.0), layer(1e-3, 1e-3, 50.0)];
    for incident in [1.0, 1.5] {
        for layers in [&gap[..], &nothing, &dark, &ideal, &gap[1..2], &[]] {
            for substrate in [Complex64::ONE, 1.5.into(), Complex64::new(0.2, 3.0)] {
                let worst = one(incident, &cosines, layers, substrate).worst();
                assert!(
                    worst < 1e-11,
                    "{incident} {layers:?} {substrate}: {worst:e}"
                );
            }
        }
    }
}

/// A film of 30 µm, up to 89.99°: the phase is 700 half turns, rounded by 1e-13, in fringes a hundred times as steep.
#[test]
fn thick_films_agree() {
    for cosine in [1.0, 0.5, 0.05, GRAZING] {
        let layers = [layer(2.4, 0.0, 30_000.0), layer(1.46, 0.0, 12_000.0)];
        let worst = one(1.0, &[cosine], &layers, 1.52.into()).worst();
        assert!(worst < 3e-11, "{cosine}: {worst:e}");
    }
}

/// A mirror whose field would grow beyond 1e400 if it were not rescaled.
#[test]
fn mirrors_of_thousands_of_layers_stay_finite() {
    let pair = [layer(2.4, 0.0, 57.3), layer(1.38, 0.0, 99.6)];
    let tables = one(1.0, &[1.0, 0.6], &pair.repeat(2000), 1.52.into());
    let worst = tables.worst();
    assert!(worst < ORDINARY, "{worst:e}");
    let at_550 = evaluate(&tables.batch()).unwrap()[2];
    assert!(at_550.reflectance.s > 1.0 - 1e-12 && at_550.transmittance.s < 1e-200);
}

/// The comparison can fail: for an index one percent higher, for exchanged stacks, and for NaN.
#[test]
fn the_comparison_notices_differences() {
    let tables = one(1.0, &[0.8], &[layer(1.46, 0.0, 200.0)], 3.5.into());
    let mut expected = tables.one_by_one();
    let found = evaluate(&tables.batch()).unwrap();
    assert!(difference(&found, &expected) < ORDINARY);
    let mut higher = tables.clone();
    higher.media[0] *= 1.01;
    assert!(difference(&evaluate(&higher.batch()).unwrap(), &expected) > 1e-4);
    assert_eq!(difference(&found[1..], &expected), f64::INFINITY);
    expected.swap(0, 1);
    assert!(difference(&found, &expected) > 1e-4);
    expected[3][2] = f64::NAN;
    assert_eq!(difference(&found, &expected), f64::INFINITY);
}

/// More stacks than are evaluated together, with results in the right order.
#[test]
fn many_stacks_come_out_in_their_order() {
    let count = 999;
    let mut tables = one(1.0, &[1.0, 0.4], &[layer(1.46, 0.0, 0.0)], 3.5.into());
    let layer_of = |i: u32| LayerOf {
        medium: 0,
        thickness_nm: f64::from(i),
    };
    tables.layers = (0..count).map(layer_of).collect();
    let stack_of = |i: u32| StackOf {
        first_layer: i,
        ..tables.stacks[0]
    };
    tables.stacks = (0..count).map(stack_of).collect();
    assert!(tables.worst() < ORDINARY);
    tables.wavelengths_nm.truncate(2);
    assert!(tables.worst() < ORDINARY);
}

#[test]
fn an_empty_batch_has_no_results() {
    let mut tables = one(1.0, &[1.0], &[], 1.5.into());
    tables.stacks.clear();
    assert_eq!(evaluate(&tables.batch()), Ok(Vec::new()));
    let mut tables = one(1.0, &[], &[], 1.5.into());
    assert_eq!(evaluate(&tables.batch()), Ok(Vec::new()));
    tables.constant = false;
    tables.wavelengths_nm.clear();
    assert!(evaluate(&tables.batch()).is_err());
}

/// Each kind of wrong number has its own error, which says where the number is.
#[test]
fn numbers_outside_their_domain_are_errors() {
    let right = one(1.0, &[1.0, 0.5], &[layer(1.46, 0.0, 200.0)], 3.5.into());
    let error = |change: &dyn Fn(&mut Tables)| {
        let mut wrong = right.clone();
        change(&mut wrong);
        evaluate(&wrong.batch()).unwrap_err().to_string()
    };
    for (text, change) in [
        (
            "the incident medium has the index -1",
            &(|t: &mut Tables| t.incident = -1.0) as &dyn Fn(&mut Tables),
        ),
        ("wavelength 3 is NaN nm", &|t| {
            t.wavelengths_nm[3] = f64::NAN;
        }),
        ("cosine 1 is 0;", &|t| t.cosines[1] = 0.0),
        ("cosine 0 is 1.5;", &|t| t.cosines[0] = 1.5),
        (
            "2 indices of dispersive media are not a multiple of the 5",
            &|t| t.constant = false,
        ),
        ("index 0 of the media is 1.5-0.1i", &|t| {
            t.media[0] = Complex64::new(1.5, -0.1);
        }),
        ("index 1 of the media is 0+0i", &|t| {
            t.media[1] = Complex64::ZERO;
        }),
        ("layer 0 has a thickness of -1 nm", &|t| {
            t.layers[0].thickness_nm = -1.0;
        }),
        ("layer 0 has medium 2, but there are only 2", &|t| {
            t.layers[0].medium = 2;
        }),
        ("stack 0 has substrate 7", &|t| t.stacks[0].substrate = 7),
        ("stack 0 has 4294967295 layers starting at 1", &|t| {
            t.stacks[0].first_layer = 1;
            t.stacks[0].layer_count = u32::MAX;
        }),
    ] {
        let found = error(change);
        assert!(found.contains(text), "{found}");
    }
    let mut powers = vec![Powers::default(); 9];
    let found = evaluate_into(&right.batch(), &mut powers).unwrap_err();
    assert_eq!(
        found,
        BatchError::Output {
            found: 9,
            expected: 10
        }
    );
    assert!(powers.iter().all(|power| *power == Powers::default()));
}
