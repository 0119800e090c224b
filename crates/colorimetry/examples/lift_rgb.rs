//! Prints the coefficients of smooth reflectances for colors, or surveys how accurately colors are reproduced.
//!
//! ```sh
//! cargo run --release -p pellicle-colorimetry --example lift_rgb -- 0.8,0.2,0.1   # codes of sRGB from 0 to 1
//! cargo run --release -p pellicle-colorimetry --example lift_rgb                  # all colors in steps of 1/32
//! ```

use pellicle_colorimetry::lab::{Lab, delta_e_2000};
use pellicle_colorimetry::lifting::SigmoidReflectance;
use pellicle_colorimetry::srgb::{decode, white_xyz, xyz_from_linear};
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let colors: Vec<String> = std::env::args().skip(1).collect();
    for color in &colors {
        let codes: Vec<f64> = color.split(',').map(str::parse).collect::<Result<_, _>>()?;
        let codes: [f64; 3] = codes.try_into().map_err(|_| "a color is three numbers")?;
        let reflectance = SigmoidReflectance::of_linear_srgb(codes.map(decode));
        println!("{color}: {:?}", reflectance.coefficients);
    }
    if colors.is_empty() {
        survey(32);
    }
    Ok(())
}

/// Prints the largest ΔE2000 of a round trip over the cube of codes, and the time of a fit.
fn survey(steps: u32) {
    let code = |i| decode(f64::from(i) / f64::from(steps));
    let along = || 0..=steps;
    let blue_lines = along().flat_map(|r| along().map(move |g| (r, g)));
    let cube: Vec<[f64; 3]> = blue_lines
        .flat_map(|(r, g)| along().map(move |b| [code(r), code(g), code(b)]))
        .collect();
    let started = Instant::now();
    let lifted: Vec<_> = cube
        .iter()
        .map(|&rgb| SigmoidReflectance::of_linear_srgb(rgb))
        .collect();
    let each = started.elapsed() / cube.len() as u32;
    let lab = |rgb| Lab::from_xyz(xyz_from_linear(rgb), white_xyz());
    let error = |(&rgb, lifted): (&[f64; 3], &SigmoidReflectance)| {
        delta_e_2000(lab(rgb), lab(lifted.linear_srgb()))
    };
    let worst = cube.iter().zip(&lifted).map(error).fold(0.0, f64::max);
    println!(
        "{} colors, {each:?} each, ΔE2000 at most {worst:.1e}",
        cube.len()
    );
}
