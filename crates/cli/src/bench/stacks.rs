//! Stack evaluations per second.

use super::ROUNDS;
use crate::print;
use miette::IntoDiagnostic;
use pellicle::optics::Complex64;
use pellicle::optics::batch::{LayerOf, Media, StackBatch, StackOf};
use pellicle::{Renderer, stacks};
use std::time::Instant;

/// The numbers of layers that are compared.
const LAYERS: [u32; 3] = [1, 5, 21];
const WAVELENGTHS: u32 = 81;
const ANGLES: u32 = 90;
/// Number of polarizations. An evaluation is R and T of one stack at one wavelength, angle and polarization.
const POLARIZATIONS: f64 = 2.0;

/// Prints a table of million evaluations per second.
pub(super) fn run(renderers: &[Renderer], seconds: f64) -> miette::Result<()> {
    print::result(format_args!(
        "\nmillion stack evaluations/s ({WAVELENGTHS} wavelengths × {ANGLES} angles × s and p), best of {ROUNDS} rounds"
    ))?;
    print::result(format_args!(
        "{:>10}{:>10}{:>10}{:>10}",
        "renderer", "1 layer", "5 layers", "21 layers"
    ))?;
    let mut best = vec![[0.0_f64; LAYERS.len()]; renderers.len()];
    for _ in 0..ROUNDS {
        for (renderer, best) in renderers.iter().zip(&mut best) {
            for (layers, best) in LAYERS.into_iter().zip(best) {
                *best = best.max(rate(renderer, layers, seconds)?);
            }
        }
    }
    for (index, [one, five, many]) in best.iter().enumerate() {
        let number = index + 1;
        print::result(format_args!(
            "{number:>10}{one:>10.1}{five:>10.1}{many:>10.1}"
        ))?;
    }
    Ok(())
}

/// Stacks of two alternating media on a third, transparent and dispersive (Cauchy), with thicknesses of 40 to 120 nm.
struct Designs {
    wavelengths_nm: Vec<f64>,
    cosines: Vec<f64>,
    media: Vec<Complex64>,
    layers: Vec<LayerOf>,
    stacks: Vec<StackOf>,
}

impl Designs {
    fn new(layers: u32, count: u32) -> Self {
        let wavelengths_nm: Vec<f64> = (0..WAVELENGTHS)
            .map(|i| 380.0 + 5.0 * f64::from(i))
            .collect();
        let cauchy = |(a, b): (f64, f64)| {
            let index = move |&nm: &f64| Complex64::from(a + b * 1e6 / (nm * nm));
            wavelengths_nm.iter().map(index).collect::<Vec<_>>()
        };
        let media = [(1.45, 0.0035), (2.25, 0.03), (1.505, 0.0042)];
        let layer = |i: u32| LayerOf {
            medium: i % layers % 2,
            thickness_nm: 40.0 + f64::from(i * 7919 % 1000) * 0.08,
        };
        let stack = |i| StackOf {
            substrate: 2,
            first_layer: i * layers,
            layer_count: layers,
        };
        Self {
            media: media.into_iter().flat_map(cauchy).collect(),
            cosines: (0..ANGLES)
                .map(|i| f64::from(i).to_radians().cos())
                .collect(),
            layers: (0..layers * count).map(layer).collect(),
            stacks: (0..count).map(stack).collect(),
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

/// Million evaluations per second. Each call has as many stacks as take a tenth of a second, until the time is over; one call
/// before them does not count.
fn rate(renderer: &Renderer, layers: u32, seconds: f64) -> miette::Result<f64> {
    let probe = Designs::new(layers, 8);
    stacks::evaluate(renderer, &probe.batch()).into_diagnostic()?;
    let started = Instant::now();
    stacks::evaluate(renderer, &probe.batch()).into_diagnostic()?;
    let count = (8.0 * 0.1 / started.elapsed().as_secs_f64()).clamp(8.0, 1000.0) as u32;
    let all = Designs::new(layers, count);
    let started = Instant::now();
    let mut calls = 0.0;
    while calls == 0.0 || started.elapsed().as_secs_f64() < seconds {
        stacks::evaluate(renderer, &all.batch()).into_diagnostic()?;
        calls += 1.0;
    }
    let each = f64::from(WAVELENGTHS * ANGLES) * f64::from(count) * POLARIZATIONS;
    Ok(calls * each / started.elapsed().as_secs_f64() * 1e-6)
}
