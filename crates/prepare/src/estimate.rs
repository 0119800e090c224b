//! Rough estimates of how much light materials reflect and transmit; they steer sampling and cancel in the result.

use optics::Complex64;
use scene::{Estimate, Interference, Layer, Material, PathDifference, Pattern, SpectrumId};
use spectra::{BandGrid, BandTable};

/// The estimates of all materials.
pub fn estimates(materials: &[Material], spectra: &[BandTable], bands: &BandGrid) -> Vec<Estimate> {
    let spectra = &Spectra {
        tables: spectra,
        bands,
    };
    materials
        .iter()
        .map(|material| of_material(spectra, material))
        .collect()
}

/// The spectra of a scene.
struct Spectra<'a> {
    tables: &'a [BandTable],
    bands: &'a BandGrid,
}

impl Spectra<'_> {
    fn spectrum(&self, id: SpectrumId) -> &BandTable {
        &self.tables[id.index()]
    }
}

/// Numbers of wavelengths, and of thicknesses between the thinnest and the thickest, of an estimate.
const WAVELENGTHS: u32 = 16;
const THICKNESSES: u32 = 8;
/// Cosines that represent light from everywhere.
const COSINES: [f64; 3] = [0.4, 0.7, 1.0];
/// Smaller cosines are replaced by this one.
const GRAZING: f64 = 1e-6;

fn of_material(spectra: &Spectra, material: &Material) -> Estimate {
    let albedo = |albedo| Estimate {
        albedo,
        reflected: Vec::new(),
    };
    let brightest = |id: SpectrumId| spectra.spectrum(id).extent().1;
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
        } => albedo(largest(spectra, |band| {
            let reflectance = |cosine| {
                mean(layers, |fraction| {
                    let (own, nm) = stack_of(spectra, layers, band, fraction);
                    let substrate = index_at(spectra, (n, k), band);
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
        } => of_film(spectra, layers, *interference),
    }
}

fn of_film(spectra: &Spectra, layers: &[Layer], interference: Interference) -> Estimate {
    let both = |band, cosine| {
        let of_thickness =
            |fraction| film_at(spectra, (layers, interference), (band, cosine), fraction);
        let reflectance = mean(layers, |fraction| of_thickness(fraction).0);
        (
            reflectance,
            mean(layers, |fraction| of_thickness(fraction).1),
        )
    };
    let reflected = (0..Estimate::KNOTS).map(|knot| {
        let cosine = (knot as f64 / (Estimate::KNOTS - 1) as f64).max(GRAZING);
        let sums = bands(spectra).map(|band| both(band, cosine));
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
        albedo: largest(spectra, sent_on),
        reflected: reflected.collect(),
    }
}

/// Reflectance and transmittance of a film in a band.
fn film_at(
    spectra: &Spectra,
    (layers, interference): (&[Layer], Interference),
    (band, cosine): (u32, f64),
    fraction: f64,
) -> (f64, f64) {
    let (own, nm) = stack_of(spectra, layers, band, fraction);
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
fn bands(spectra: &Spectra) -> impl Iterator<Item = u32> {
    let count = spectra.bands.count();
    let looked_at = WAVELENGTHS.min(count);
    (0..looked_at).map(move |i| (2 * i + 1) * count / (2 * looked_at))
}

/// The largest value over these bands, in \[0, 1\].
fn largest(spectra: &Spectra, of_band: impl Fn(u32) -> f64) -> f64 {
    bands(spectra)
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
    spectra: &Spectra,
    layers: &[Layer],
    band: u32,
    fraction: f64,
) -> (Vec<optics::Layer>, f64) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let layer = |(place, layer): (usize, &Layer)| {
        let (least, most) = layer.thickness.extent_nm();
        let part = (fraction + place as f64 * GOLDEN).fract();
        optics::Layer {
            index: index_at(spectra, (layer.n, layer.k), band),
            thickness_nm: least + part * (most - least),
        }
    };
    let own = layers.iter().enumerate().map(layer).collect();
    (own, spectra.bands.center_nm(band))
}

fn index_at(spectra: &Spectra, (n, k): (SpectrumId, SpectrumId), band: u32) -> Complex64 {
    let at = |id| spectra.spectrum(id).at(band, 0.5);
    Complex64::new(at(n), at(k))
}
