//! Stack evaluations per second: one evaluation is R and T of one stack at one wavelength, angle and polarization.
//!
//! `cargo bench -p pellicle-optics` measures this crate; `python crates/optics/benches/stacks_numpy.py` measures the same stacks in
//! numpy. Machines drift: compare only runs that alternated.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use pellicle_optics::batch::{LayerOf, Media, Powers, StackBatch, StackOf, evaluate_into};
use pellicle_optics::{Complex64, Layer, stack};
use std::hint::black_box;

const POLARIZATIONS: u64 = 2;

/// Media 0 and 1 for the layers and 2 for the substrate, with Cauchy's dispersion n = a + b/λ² (λ in µm) and `k` in
/// medium 1.
struct Tables {
    wavelengths_nm: Vec<f64>,
    cosines: Vec<f64>,
    media: Vec<Complex64>,
    layers: Vec<LayerOf>,
    stacks: Vec<StackOf>,
}

impl Tables {
    /// Makes `stacks` stacks of `layers` layers, all of different thickness, at 81 wavelengths (380(5)780 nm) and 90 angles (0(1)89°).
    fn new(stacks: u32, layers: u32, k: f64) -> Self {
        let wavelengths_nm: Vec<f64> = (0..81).map(|i| 380.0 + 5.0 * f64::from(i)).collect();
        let degrees = (0..90).map(f64::from);
        let cauchy = |a: f64, b: f64, k: f64| {
            let of = move |nm: &f64| Complex64::new(a + b * 1e6 / (nm * nm), k);
            wavelengths_nm.iter().map(of).collect::<Vec<_>>()
        };
        let media = [
            cauchy(1.45, 0.0035, 0.0),
            cauchy(2.25, 0.03, k),
            cauchy(1.505, 0.0042, 0.0),
        ];
        let layer = |i: u32| LayerOf {
            medium: (i % layers) % 2,
            thickness_nm: 40.0 + f64::from(i * 7919 % 1000) * 0.08,
        };
        let stack = |i: u32| StackOf {
            substrate: 2,
            first_layer: i * layers,
            layer_count: layers,
        };
        Self {
            media: media.concat(),
            cosines: degrees.map(|d| d.to_radians().cos()).collect(),
            layers: (0..stacks * layers).map(layer).collect(),
            stacks: (0..stacks).map(stack).collect(),
            wavelengths_nm,
        }
    }

    fn batch(&self) -> StackBatch<'_> {
        StackBatch {
            wavelengths_nm: &self.wavelengths_nm,
            cosines: &self.cosines,
            incident: 1.0,
            media: Media::Dispersive(&self.media),
            layers: &self.layers,
            stacks: &self.stacks,
        }
    }
}

fn batches(criterion: &mut Criterion) {
    for (name, stacks, k) in [
        ("one clear stack", 1, 0.0),
        ("100 clear stacks", 100, 0.0),
        ("100 absorbing stacks", 100, 0.01),
    ] {
        let mut group = criterion.benchmark_group(name);
        for layers in [1, 5, 21] {
            let tables = Tables::new(stacks, layers, k);
            let batch = tables.batch();
            let mut powers = vec![Powers::default(); batch.len()];
            group.throughput(Throughput::Elements(batch.len() as u64 * POLARIZATIONS));
            group.bench_function(BenchmarkId::from_parameter(layers), |bencher| {
                bencher.iter(|| evaluate_into(black_box(&batch), &mut powers));
            });
        }
        group.finish();
    }
}

/// The same single clear stack, with one call of [`stack`] per angle and wavelength, on one core.
fn single(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("one call each");
    for layers in [1, 5, 21] {
        let tables = Tables::new(1, layers, 0.0);
        let of_medium = |medium: usize| tables.media[medium * 81 + 34];
        let layer = |of: &LayerOf| Layer {
            index: of_medium(of.medium as usize),
            thickness_nm: of.thickness_nm,
        };
        let layers_of: Vec<Layer> = tables.layers.iter().map(layer).collect();
        group.throughput(Throughput::Elements(90 * POLARIZATIONS));
        group.bench_function(BenchmarkId::from_parameter(layers), |bencher| {
            bencher.iter(|| {
                let at = |&cosine| stack(1.0, &layers_of, of_medium(2), 550.0, cosine);
                let found = tables.cosines.iter().map(at);
                found.map(|found| found.reflectance.s).sum::<f64>()
            });
        });
    }
    group.finish();
}

/// A million stacks of five layers, each layer of a different medium, at one wavelength and angle.
fn million(criterion: &mut Criterion) {
    let count = 1_000_000_u32;
    let random = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 8) / f64::from(1 << 24);
    let media: Vec<Complex64> = (0..6 * count).map(|i| (1.3 + random(i)).into()).collect();
    let layer = |i: u32| LayerOf {
        medium: i,
        thickness_nm: 300.0 * random(i + 1),
    };
    let layers: Vec<LayerOf> = (0..5 * count).map(layer).collect();
    let stack = |i: u32| StackOf {
        substrate: 5 * count + i,
        first_layer: 5 * i,
        layer_count: 5,
    };
    let stacks: Vec<StackOf> = (0..count).map(stack).collect();
    let batch = StackBatch {
        wavelengths_nm: &[550.0],
        cosines: &[0.8],
        incident: 1.0,
        media: Media::Constant(&media),
        layers: &layers,
        stacks: &stacks,
    };
    let mut powers = vec![Powers::default(); batch.len()];
    let mut group = criterion.benchmark_group("a million random stacks");
    group.throughput(Throughput::Elements(u64::from(count) * POLARIZATIONS));
    group.sample_size(20);
    group.bench_function(BenchmarkId::from_parameter(5), |bencher| {
        bencher.iter(|| evaluate_into(black_box(&batch), &mut powers));
    });
    group.finish();
}

criterion_group!(benches, batches, single, million);
criterion_main!(benches);
