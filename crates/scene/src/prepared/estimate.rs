//! Rough estimates of how much light materials reflect and transmit; they steer sampling and cancel in the result.

use crate::rounding::RoundToF32;
use crate::{Interference, Layer, Material, PathDifference, Pattern, Scene, SpectrumId};
use optics::Complex64;

/// A cheap estimate of how much light a material reflects and transmits, averaged over its thicknesses.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// The fraction of incident light that is reflected or transmitted, in \[0, 1\], at the wavelength where it is largest.
    pub albedo: f64,
    /// The fraction R / (R + T) that a film reflects of the light that it does not absorb, in \[0, 1\], averaged over wavelengths, at
    /// [`Estimate::KNOTS`] equally spaced cosines from 0 to 1. Empty for other materials.
    pub reflected: Vec<f64>,
}

impl Estimate {
    /// Number of cosines.
    pub const KNOTS: usize = 33;

    /// The fraction [`Self::reflected`] of a film at a cosine, interpolated linearly between the knots.
    ///
    /// # Panics
    /// For materials that are not films.
    pub fn reflected_at(&self, cosine: f64) -> f64 {
        let steps = Self::KNOTS - 1;
        let place = cosine.clamp(0.0, 1.0) * steps as f64;
        let knot = (place as usize).min(steps - 1);
        let part = place - knot as f64;
        self.reflected[knot] + part * (self.reflected[knot + 1] - self.reflected[knot])
    }
}

impl RoundToF32 for Estimate {
    fn rounded(&self) -> Self {
        Self {
            albedo: self.albedo.rounded(),
            reflected: self.reflected.rounded(),
        }
    }
}

/// The estimates of all materials.
pub(crate) fn estimates(scene: &Scene) -> Vec<Estimate> {
    let materials = scene.materials().iter();
    materials
        .map(|material| of_material(scene, material))
        .collect()
}

/// Numbers of wavelengths, and of thicknesses between the thinnest and the thickest, of an estimate.
const WAVELENGTHS: u32 = 16;
const THICKNESSES: u32 = 8;
/// Cosines that represent light from everywhere.
const COSINES: [f64; 3] = [0.4, 0.7, 1.0];
/// Smaller cosines are replaced by this one.
const GRAZING: f64 = 1e-6;

fn of_material(scene: &Scene, material: &Material) -> Estimate {
    let albedo = |albedo| Estimate {
        albedo,
        reflected: Vec::new(),
    };
    let brightest = |id: SpectrumId| scene.spectrum(id).extent().1;
    match material {
        Material::Diffuse { reflectance } => albedo(match *reflectance {
            Pattern::Uniform(all) => brightest(all),
            Pattern::Checker { even, odd, .. } => brightest(even).max(brightest(odd)),
            Pattern::Texture { .. } => 1.0,
        }),
        // What a coat or Cook's model reflects depends on too much to be worth estimating.
        Material::CoatedBody(_) | Material::Cook(_) => albedo(1.0),
        Material::Emitter { reflectance, .. } => albedo(reflectance.map_or(0.0, brightest)),
        &Material::Interface {
            n, k, ref layers, ..
        } => albedo(largest(scene, |band| {
            let reflectance = |cosine| {
                mean(layers, |fraction| {
                    let (own, nm) = stack_of(scene, layers, band, fraction);
                    let substrate = index_at(scene, (n, k), band);
                    let found = optics::stack(1.0, &own, substrate, nm, cosine);
                    found.reflectance.unpolarized()
                })
            };
            COSINES.into_iter().map(reflectance).sum::<f64>() / COSINES.len() as f64
        })),
        Material::Film {
            layers,
            interference,
            ..
        } => of_film(scene, layers, *interference),
    }
}

fn of_film(scene: &Scene, layers: &[Layer], interference: Interference) -> Estimate {
    let both = |band, cosine| {
        let of_thickness =
            |fraction| film_at(scene, (layers, interference), (band, cosine), fraction);
        let reflectance = mean(layers, |fraction| of_thickness(fraction).0);
        (
            reflectance,
            mean(layers, |fraction| of_thickness(fraction).1),
        )
    };
    let reflected = (0..Estimate::KNOTS).map(|knot| {
        let cosine = (knot as f64 / (Estimate::KNOTS - 1) as f64).max(GRAZING);
        let sums = bands(scene).map(|band| both(band, cosine));
        let (r, t) = sums.fold((0.0, 0.0), |sum, (r, t)| (sum.0 + r, sum.1 + t));
        if r + t > 0.0 {
            (r / (r + t)).clamp(0.0, 1.0)
        } else {
            0.5
        }
    });
    let sent_on = |band| {
        let (reflectance, transmittance) = both(band, COSINES[1]);
        reflectance + transmittance
    };
    Estimate {
        albedo: largest(scene, sent_on),
        reflected: reflected.collect(),
    }
}

/// Reflectance and transmittance of a film in a band.
fn film_at(
    scene: &Scene,
    (layers, interference): (&[Layer], Interference),
    (band, cosine): (u32, f64),
    fraction: f64,
) -> (f64, f64) {
    let (own, nm) = stack_of(scene, layers, band, fraction);
    if let Interference::TwoBeam(path) = interference {
        let path = match path {
            PathDifference::Optical => optics::PathDifference::Optical,
            PathDifference::AsPrinted => optics::PathDifference::AsPrinted,
        };
        let found = optics::two_beam(own[0].index.re, own[0].thickness_nm, nm, cosine, path);
        return (
            found.reflectance.unpolarized(),
            found.transmittance.unpolarized(),
        );
    }
    let found = optics::stack(1.0, &own, Complex64::ONE, nm, cosine);
    (
        found.reflectance.unpolarized(),
        found.transmittance.unpolarized(),
    )
}

/// The bands of an estimate.
fn bands(scene: &Scene) -> impl Iterator<Item = u32> {
    let count = scene.settings().bands.count();
    let looked_at = WAVELENGTHS.min(count);
    (0..looked_at).map(move |i| (2 * i + 1) * count / (2 * looked_at))
}

/// The largest value over these bands, in \[0, 1\].
fn largest(scene: &Scene, of_band: impl Fn(u32) -> f64) -> f64 {
    bands(scene)
        .map(of_band)
        .fold(0.0, f64::max)
        .clamp(0.0, 1.0)
}

/// The mean over thicknesses, which are given as fractions between the thinnest and the thickest.
fn mean(layers: &[Layer], of_fraction: impl Fn(f64) -> f64) -> f64 {
    let varies = layers.iter().any(|layer| {
        let (least, most) = layer.thickness.extent_nm();
        least < most
    });
    let count = if varies { THICKNESSES } else { 1 };
    let fractions = (0..count).map(|i| (f64::from(i) + 0.5) / f64::from(count));
    fractions.map(of_fraction).sum::<f64>() / f64::from(count)
}

/// The layers at the center wavelength of a band, and this wavelength. Layers vary independently: their fractions follow the golden ratio.
fn stack_of(
    scene: &Scene,
    layers: &[Layer],
    band: u32,
    fraction: f64,
) -> (Vec<optics::Layer>, f64) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let layer = |(place, layer): (usize, &Layer)| {
        let (least, most) = layer.thickness.extent_nm();
        let part = (fraction + place as f64 * GOLDEN).fract();
        optics::Layer {
            index: index_at(scene, (layer.n, layer.k), band),
            thickness_nm: least + part * (most - least),
        }
    };
    let own = layers.iter().enumerate().map(layer).collect();
    (own, scene.settings().bands.center_nm(band))
}

fn index_at(scene: &Scene, (n, k): (SpectrumId, SpectrumId), band: u32) -> Complex64 {
    let at = |id| scene.spectrum(id).at(band, 0.5);
    Complex64::new(at(n), at(k))
}
