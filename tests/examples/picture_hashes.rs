//! Hashes of the pixel data of every scene, rendered small on both renderers with a fixed seed.
//!
//! A change that should move no pixel prints the same lines before and after:
//! `cargo run --release -p pellicle-tests --example picture_hashes > before.txt`.
//! The lines hold for one machine: another driver, C library or instruction set may change last digits.

use pellicle_tests::device::open;
use pellicle_tests::scenes::{BANDS, all, small};
use spectra::SpectralImage;
use std::ops::ControlFlow;

const SIZE: [u32; 2] = [64, 48];
const SAMPLES: u32 = 8;
const SEED: u32 = 18;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let gpu = open();
    for name in all() {
        let scene = small(name, SIZE, SAMPLES, BANDS, SEED);
        let cpu = reference::render(&scene, &mut |_| ControlFlow::Continue(()))?;
        println!("{name} cpu {}", line(&cpu));
        let gpu = gpu::render(&gpu, &scene, &mut |_| ControlFlow::Continue(()))?;
        println!("{name} gpu {}", line(&gpu));
    }
    Ok(())
}

/// Hashes of bands, variances, XYZ, samples, and of the bands and XYZ of every light group.
fn line(image: &SpectralImage) -> String {
    let floats = |values: &[f32]| hash(values.iter().map(|value| value.to_bits()));
    let xyz = |values: &[[f32; 3]]| floats(values.as_flattened());
    let mut parts = vec![
        format!("bands {:016x}", floats(image.radiance())),
        format!("variance {:016x}", floats(image.variance())),
        format!("xyz {:016x}", xyz(image.xyz())),
        format!("samples {:016x}", hash(image.samples().iter().copied())),
    ];
    for group in 0..image.light_groups().len() {
        let (bands, xyz) = (
            floats(image.group_radiance(group)),
            xyz(image.group_xyz(group)),
        );
        parts.push(format!("group {group} {bands:016x} {xyz:016x}"));
    }
    parts.join(" ")
}

/// FNV-1a (Fowler, Noll and Vo, 1991), 64 bits, over the little-endian bytes of the words.
fn hash(words: impl Iterator<Item = u32>) -> u64 {
    words
        .flat_map(u32::to_le_bytes)
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        })
}
