//! Properties of all stacks: absorptance, incidence from a denser medium, derivatives, batches; no device is needed.

use num_complex::Complex64;
use optics::batch::{LayerOf, Media, StackBatch, StackOf, evaluate};
use optics::{Layer, Polarized, absorptance, stack, thickness_derivatives};
use pellicle_tests::agreement::compare;
use pellicle_tests::tables::{number, rows};
use pellicle_tests::tolerances::{DERIVATIVE, IDENTITY, ORACLE_STACKS};
use proptest::prelude::*;

const STACKS: &str = include_str!("../../data/stacks.csv");

/// A row of `stacks.csv`.
struct Case {
    name: String,
    incident: f64,
    cosine: f64,
    nm: f64,
    substrate: Complex64,
    layers: Vec<Layer>,
    /// R_s, R_p, T_s, T_p; A_s, A_p of the first layer; the derivatives of the first four by its thickness.
    expected: Vec<f64>,
}

fn cases() -> Vec<Case> {
    let of_row = |row: Vec<&str>| {
        let layers: Vec<f64> = row[6].split(' ').map(number).collect();
        let layer = |of: &[f64]| Layer {
            index: Complex64::new(of[0], of[1]),
            thickness_nm: of[2],
        };
        Case {
            name: row[0].to_owned(),
            incident: number(row[1]),
            cosine: number(row[2]),
            nm: number(row[3]),
            substrate: Complex64::new(number(row[4]), number(row[5])),
            layers: layers.chunks(3).map(layer).collect(),
            expected: row[7..17].iter().map(|cell| number(cell)).collect(),
        }
    };
    rows(STACKS).map(of_row).collect()
}

impl Case {
    /// The results of this crate, by single calls.
    fn found(&self) -> Vec<f64> {
        let (incident, layers, substrate) = (self.incident, &self.layers, self.substrate);
        let powers = stack(incident, layers, substrate, self.nm, self.cosine);
        let absorbed = absorptance(incident, layers, substrate, self.nm, self.cosine)[0];
        let slope = thickness_derivatives(incident, layers, substrate, self.nm, self.cosine)[0];
        let all = [
            powers.reflectance,
            powers.transmittance,
            absorbed,
            slope.reflectance,
            slope.transmittance,
        ];
        all.iter().flat_map(|power| [power.s, power.p]).collect()
    }

    /// R_s, R_p, T_s and T_p by a batch with this many equal wavelengths.
    fn by_batch(&self, wavelengths: usize) -> Vec<f64> {
        let layers = (0..).zip(&self.layers).map(|(medium, layer)| LayerOf {
            medium,
            thickness_nm: layer.thickness_nm,
        });
        let layers: Vec<LayerOf> = layers.collect();
        let mut media: Vec<Complex64> = self.layers.iter().map(|layer| layer.index).collect();
        media.push(self.substrate);
        let batch = StackBatch {
            wavelengths_nm: &vec![self.nm; wavelengths],
            cosines: &[self.cosine],
            incident: self.incident,
            media: Media::Constant(&media),
            stacks: &[StackOf {
                substrate: layers.len() as u32,
                first_layer: 0,
                layer_count: layers.len() as u32,
            }],
            layers: &layers,
        };
        let powers = evaluate(&batch).unwrap();
        assert!(powers.iter().all(|power| *power == powers[0]));
        let (r, t) = (powers[0].reflectance, powers[0].transmittance);
        vec![r.s, r.p, t.s, t.p]
    }
}

#[test]
fn stacks_agree_with_fifty_digits() {
    let cases = cases();
    assert_eq!(cases.len(), 100);
    for case in cases {
        for (found, expected) in [
            (case.found(), &case.expected[..]),
            (case.by_batch(1), &case.expected[..4]),
            (case.by_batch(11), &case.expected[..4]),
        ] {
            if let Err(report) = compare(&found, expected, ORACLE_STACKS) {
                panic!("{} {} {}: {report}", case.name, case.cosine, case.nm);
            }
        }
    }
}

/// A layer that is a picometer thicker is noticed, by single calls and by batches.
#[test]
fn a_picometer_is_noticed() {
    let mut noticed = 0;
    for mut case in cases() {
        // Not where nothing changes: at grazing incidence, or for an opaque or very thin layer.
        if case.name == "ordinary" && case.expected[6].abs() > 1e-6 {
            case.layers[0].thickness_nm += 1e-3;
            assert!(compare(&case.found(), &case.expected, ORACLE_STACKS).is_err());
            assert!(compare(&case.by_batch(5), &case.expected[..4], ORACLE_STACKS).is_err());
            noticed += 1;
        }
    }
    assert!(noticed >= 10, "{noticed}");
}

fn close(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance
}

/// One to six layers of up to 1.5 µm and an extinction of up to `k`.
fn layers(k: f64) -> impl Strategy<Value = Vec<Layer>> {
    let layer = (1.25..2.6_f64, 0.0..=k, 0.0..1500.0_f64).prop_map(|(n, k, thickness_nm)| Layer {
        index: Complex64::new(n, k),
        thickness_nm,
    });
    prop::collection::vec(layer, 1..=6)
}

/// A substrate with or without losses.
fn substrates() -> impl Strategy<Value = Complex64> {
    (0.1..4.0_f64, prop_oneof![Just(0.0), 0.0..6.0_f64]).prop_map(|(n, k)| Complex64::new(n, k))
}

/// R + T + ΣA for s and p.
fn sum(incident: f64, layers: &[Layer], substrate: Complex64, nm: f64, cosine: f64) -> [f64; 2] {
    let found = stack(incident, layers, substrate, nm, cosine);
    let absorbed = absorptance(incident, layers, substrate, nm, cosine);
    let whole = |of: fn(&Polarized) -> f64| {
        let (r, t) = (of(&found.reflectance), of(&found.transmittance));
        r + t + absorbed.iter().map(of).sum::<f64>()
    };
    [whole(|power| power.s), whole(|power| power.p)]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Light is reflected, transmitted or absorbed, whatever medium it comes from and whatever it meets.
    #[test]
    fn reflected_transmitted_and_absorbed_light_add_up_to_one(
        layers in layers(4.0), incident in 1.0..2.6_f64, substrate in substrates(),
        nm in 380.0..780.0_f64, cosine in 0.01..=1.0_f64,
    ) {
        for whole in sum(incident, &layers, substrate, nm, cosine) {
            prop_assert!(close(whole, 1.0, IDENTITY), "{:e}", whole - 1.0);
        }
        for power in absorptance(incident, &layers, substrate, nm, cosine) {
            prop_assert!(power.s >= 0.0 && power.p >= 0.0 && power.s <= 1.0 && power.p <= 1.0, "{power:?}");
        }
    }

    /// The absorptance of a layer is the sum of the absorptances of its parts.
    #[test]
    fn a_split_layer_absorbs_as_much_as_the_whole(
        layers in layers(2.0), place in 0..60_usize, share in 0.0..=1.0_f64,
        nm in 380.0..780.0_f64, cosine in 0.02..=1.0_f64,
    ) {
        let place = place % layers.len();
        let mut split = layers.clone();
        split[place].thickness_nm *= share;
        let rest = Layer { thickness_nm: layers[place].thickness_nm * (1.0 - share), ..layers[place] };
        split.insert(place + 1, rest);
        let whole = absorptance(1.0, &layers, Complex64::new(4.1, 0.04), nm, cosine);
        let parts = absorptance(1.0, &split, Complex64::new(4.1, 0.04), nm, cosine);
        prop_assert!(close(whole[place].s, parts[place].s + parts[place + 1].s, IDENTITY));
        prop_assert!(close(whole[place].p, parts[place].p + parts[place + 1].p, IDENTITY));
    }

    /// Stokes (1849), for any lossless stack between media in which light propagates: |r| is the same from both sides, and
    /// t t′ − r r′ = −r / r*′, that is r′ = −r* t / t*.
    #[test]
    fn stacks_without_losses_can_be_reversed(
        mut layers in layers(0.0), incident in 1.0..1.25_f64, substrate in 1.25..3.0_f64,
        nm in 380.0..780.0_f64, cosine in 0.05..=1.0_f64,
    ) {
        let there = stack(incident, &layers, substrate.into(), nm, cosine).amplitudes;
        layers.reverse();
        let sine = incident * (1.0 - cosine * cosine).sqrt() / substrate;
        let within = (1.0 - sine * sine).sqrt();
        let back = stack(substrate, &layers, incident.into(), nm, within).amplitudes;
        for (r, t, r_back) in [(there.r_s, there.t_s, back.r_s), (there.r_p, there.t_p, back.r_p)] {
            let expected = -r.conj() * t / t.conj();
            prop_assert!((expected - r_back).norm() < IDENTITY, "{expected} {r_back}");
        }
    }

    /// Beyond the critical angle of the substrate everything is reflected, whatever the layers are, and nothing is lost.
    #[test]
    fn total_reflection_is_total_through_any_layers(
        layers in layers(0.0), incident in 1.5..2.6_f64, beyond in 0.01..0.99_f64, nm in 380.0..780.0_f64,
    ) {
        let critical = (1.0 - 1.0 / (incident * incident)).sqrt();
        let found = stack(incident, &layers, Complex64::ONE, nm, critical * beyond);
        prop_assert!(close(found.reflectance.s, 1.0, IDENTITY) && close(found.reflectance.p, 1.0, IDENTITY));
        prop_assert!(close(found.transmittance.s, 0.0, IDENTITY) && close(found.transmittance.p, 0.0, IDENTITY));
    }

    /// Every number is finite on the whole domain, even exactly at critical angles.
    #[test]
    fn all_results_are_finite(
        mut layers in layers(4.0), incident in 1.0..4.0_f64, substrate in substrates(), thickness_nm in 0.0..30_000.0_f64,
        nm in 200.0..2000.0_f64, cosine in 1.7e-4..=1.0_f64, critical in any::<bool>(),
    ) {
        let sine = (1.0 - cosine * cosine).sqrt();
        if critical {
            layers.push(Layer { index: (incident * sine).into(), thickness_nm });
        }
        layers.push(Layer { index: incident.into(), thickness_nm });
        let found = stack(incident, &layers, substrate, nm, cosine);
        for (r, t) in [(found.reflectance.s, found.transmittance.s), (found.reflectance.p, found.transmittance.p)] {
            prop_assert!((0.0..=1.0 + IDENTITY).contains(&r) && (0.0..=1.0 + IDENTITY).contains(&t), "{r} {t}");
        }
        let a = found.amplitudes;
        prop_assert!(a.r_s.is_finite() && a.r_p.is_finite() && a.t_s.is_finite() && a.t_p.is_finite());
        for change in thickness_derivatives(incident, &layers, substrate, nm, cosine) {
            let (r, t) = (change.reflectance, change.transmittance);
            prop_assert!(r.s.is_finite() && r.p.is_finite() && t.s.is_finite() && t.p.is_finite());
        }
    }
}

/// Central differences of R_s, R_p, T_s and T_p over `h` nm of one layer.
fn central(layers: &[Layer], place: usize, h: f64, at: (f64, Complex64, f64, f64)) -> [f64; 4] {
    let (incident, substrate, nm, cosine) = at;
    let powers = |change: f64| {
        let mut layers = layers.to_vec();
        layers[place].thickness_nm += change;
        let found = stack(incident, &layers, substrate, nm, cosine);
        let (r, t) = (found.reflectance, found.transmittance);
        [r.s, r.p, t.s, t.p]
    };
    let (above, below) = (powers(h), powers(-h));
    std::array::from_fn(|i| (above[i] - below[i]) / (2.0 * h))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn derivatives_follow_differences(
        mut layers in layers(1.0), incident in 1.0..1.8_f64, substrate in substrates(),
        nm in 380.0..780.0_f64, cosine in 0.2..=1.0_f64,
    ) {
        for layer in &mut layers {
            layer.thickness_nm = 1.0 + 0.2 * layer.thickness_nm;
        }
        let found = thickness_derivatives(incident, &layers, substrate, nm, cosine);
        for (place, found) in found.iter().enumerate() {
            let at = (incident, substrate, nm, cosine);
            let (coarse, fine) = (central(&layers, place, 0.2, at), central(&layers, place, 0.1, at));
            let (r, t) = (found.reflectance, found.transmittance);
            for (i, found) in [r.s, r.p, t.s, t.p].into_iter().enumerate() {
                let expected = (4.0 * fine[i] - coarse[i]) / 3.0;
                prop_assert!(close(found, expected, DERIVATIVE), "{found:e} {expected:e}");
            }
        }
    }
}

/// The comparisons above detect a layer that absorbs a millionth too little, and a derivative taken at another position.
#[test]
fn the_comparisons_of_the_properties_can_fail() {
    let layer = |n: f64, k: f64, thickness_nm: f64| Layer {
        index: Complex64::new(n, k),
        thickness_nm,
    };
    let layers = [layer(2.3, 0.02, 120.0), layer(1.46, 0.0, 90.0)];
    let other = [layer(2.3, 0.020_001, 120.0), layers[1]];
    let absorbed = absorptance(1.0, &layers, 1.52.into(), 550.0, 0.7)[0];
    let more = absorptance(1.0, &other, 1.52.into(), 550.0, 0.7)[0];
    assert!(!close(absorbed.s, more.s, IDENTITY) && !close(absorbed.p, more.p, IDENTITY));
    let here = thickness_derivatives(1.0, &layers, 1.52.into(), 550.0, 0.7)[1];
    let there = central(&layers, 0, 0.1, (1.0, 1.52.into(), 550.0, 0.7));
    assert!(!close(here.reflectance.s, there[0], DERIVATIVE));
}

/// A million random stacks of five layers, each with a medium of its own, in one call; every thousandth is checked.
#[test]
fn a_million_stacks_are_evaluated_in_one_call() {
    let count = 1_000_000_u32;
    let random = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 8) / f64::from(1 << 24);
    let media: Vec<Complex64> = (0..6 * count).map(|i| (1.3 + random(i)).into()).collect();
    let layer = |medium: u32| LayerOf {
        medium,
        thickness_nm: 300.0 * random(medium + 1),
    };
    let layers: Vec<LayerOf> = (0..5 * count).map(layer).collect();
    let stack_of = |i: u32| StackOf {
        substrate: 5 * count + i,
        first_layer: 5 * i,
        layer_count: 5,
    };
    let stacks: Vec<StackOf> = (0..count).map(stack_of).collect();
    let batch = StackBatch {
        wavelengths_nm: &[550.0],
        cosines: &[0.8],
        incident: 1.0,
        media: Media::Constant(&media),
        layers: &layers,
        stacks: &stacks,
    };
    let powers = evaluate(&batch).unwrap();
    assert_eq!(powers.len(), 1_000_000);
    for place in (0..1_000_000).step_by(1000) {
        let own = layers[5 * place..5 * place + 5].iter().map(|layer| Layer {
            index: media[layer.medium as usize],
            thickness_nm: layer.thickness_nm,
        });
        let own: Vec<Layer> = own.collect();
        let substrate = media[5_000_000 + place];
        let expected = stack(1.0, &own, substrate, 550.0, 0.8);
        let found = powers[place];
        assert!(
            close(found.reflectance.s, expected.reflectance.s, IDENTITY),
            "{place}"
        );
        assert!(
            close(found.reflectance.p, expected.reflectance.p, IDENTITY),
            "{place}"
        );
        assert!(
            close(found.transmittance.s, expected.transmittance.s, IDENTITY),
            "{place}"
        );
        assert!(
            close(found.transmittance.p, expected.transmittance.p, IDENTITY),
            "{place}"
        );
    }
}
