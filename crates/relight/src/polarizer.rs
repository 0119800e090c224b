//! A polarizer in front of a finished image.

use crate::weights::BandWeights;
use rayon::prelude::*;
use spectra::stokes::{Analyzer, Polarizer};
use spectra::{BandGrid, LayerKey, Observer, Quantity, RowMut, SpectralImage, Stokes};
use thiserror::Error;

/// The image does not have S1, S2 and S3, so nothing is known of its polarization.
#[derive(Clone, Copy, Debug, Error, Eq, PartialEq)]
#[error(
    "the image has no polarization that can be used: S1, S2 and S3 are missing or were ignored"
)]
pub struct NotPolarized;

/// Turns an image into that behind an ideal linear polarizer, optionally with a retarder in front of it.
///
/// Radiance and XYZ of all light and of each light group become ½ (S0 + w · (S1, S2, S3)), where w are the weights of
/// [`Polarizer::analyzer`]: ½ (S0 + S1 cos 2φ + S2 sin 2φ) for a polarizer at the angle φ. If the retarder depends on the wavelength, w is
/// that at the center of each band, and XYZ of S1, S2 and S3 is summed from the bands. Values that rounding made negative are 0. S1, S2
/// and S3 are removed.
///
/// The variance of a band keeps its relative size, as when an image is [relit](crate::relight()).
///
/// # Errors
/// When the image is not polarized. It is then unchanged.
pub fn behind(image: &mut SpectralImage, polarizer: &Polarizer) -> Result<(), NotPolarized> {
    if !image.is_polarized() {
        return Err(NotPolarized);
    }
    let filter = Filter::new(image.bands(), &polarizer.analyzer());
    let groups = image.light_groups().len();
    let rows = image.rows_mut();
    rows.into_par_iter()
        .for_each(|row| filter.pass(row, groups));
    image.remove_polarization();
    Ok(())
}

/// The weights of S1, S2 and S3.
struct Filter {
    /// Of the radiance of each band.
    bands: Vec<[f64; 3]>,
    xyz: XyzWeights,
}

/// The weights of S1, S2 and S3 in XYZ.
enum XyzWeights {
    /// The same at all wavelengths.
    Constant([f64; 3]),
    /// They differ: these sum XYZ from the bands.
    OfBands(BandWeights),
}

impl Filter {
    fn new(grid: &BandGrid, analyzer: &Analyzer) -> Self {
        let bands = (0..grid.count()).map(|band| analyzer.weights(grid.center_nm(band)));
        let depends =
            analyzer.path_nm.is_some() && [analyzer.cosine, analyzer.sine] != [[0.0; 3]; 2];
        Self {
            bands: bands.collect(),
            xyz: if depends {
                XyzWeights::OfBands(BandWeights::observed(grid, Observer::Cie1931Deg2))
            } else {
                XyzWeights::Constant(analyzer.weights(grid.center_nm(0)))
            },
        }
    }

    /// Changes S0 of a row.
    fn pass(&self, mut row: RowMut<'_>, groups: usize) {
        let before = row
            .layers
            .iter()
            .find(|(key, _)| *key == LayerKey::RADIANCE);
        let before = before.map_or(Vec::new(), |(_, values)| values.to_vec());
        let mut total: [Vec<f32>; 2] = [Vec::new(), Vec::new()];
        for group in LayerKey::all(groups).filter(|key| key.quantity == Quantity::Radiance) {
            // The total follows from the light groups, if there are several.
            if groups > 1 && group.light_group.is_none() {
                continue;
            }
            let [radiance, xyz] = self.light(&mut row, group);
            add(&mut total[0], radiance);
            add(&mut total[1], xyz);
        }
        if groups > 1 {
            row.take(LayerKey::RADIANCE).copy_from_slice(&total[0]);
            row.take(LayerKey::XYZ).copy_from_slice(&total[1]);
        }
        let variance = row.take(LayerKey::VARIANCE);
        for (variance, (before, after)) in variance.iter_mut().zip(before.iter().zip(&total[0])) {
            let ratio = after / before;
            if ratio.is_finite() {
                *variance *= ratio * ratio;
            }
        }
    }

    /// Changes S0 of a light group, and returns its radiance and XYZ.
    fn light<'a>(&self, row: &mut RowMut<'a>, key: LayerKey) -> [&'a mut [f32]; 2] {
        let count = self.bands.len();
        let own = |stokes| key.component(stokes);
        let xyz_key = |stokes| LayerKey {
            quantity: Quantity::Xyz,
            ..own(stokes)
        };
        let radiance = row.take(own(Stokes::S0));
        let xyz = row.take(xyz_key(Stokes::S0));
        let components = Stokes::POLARIZED.map(|stokes| &*row.take(own(stokes)));
        let colors = Stokes::POLARIZED.map(|stokes| &*row.take(xyz_key(stokes)));
        // XYZ first: it may need the radiances.
        for (pixel, xyz) in xyz.as_chunks_mut::<3>().0.iter_mut().enumerate() {
            let change = match &self.xyz {
                XyzWeights::Constant(weights) => std::array::from_fn(|axis| {
                    let at = 3 * pixel + axis;
                    dot(weights, colors.map(|of| of[at]))
                }),
                XyzWeights::OfBands(sums) => {
                    let at = |band| pixel * count + band;
                    let weighted = self.bands.iter().enumerate();
                    let change: Vec<f32> = weighted
                        .map(|(band, w)| dot(w, components.map(|of| of[at(band)])) as f32)
                        .collect();
                    sums.xyz(&change)
                }
            };
            *xyz = std::array::from_fn(|axis| half(xyz[axis], change[axis]));
        }
        for (i, value) in radiance.iter_mut().enumerate() {
            let weights = &self.bands[i % count];
            *value = half(*value, dot(weights, components.map(|of| of[i])));
        }
        [radiance, xyz]
    }
}

fn dot(weights: &[f64; 3], values: [f32; 3]) -> f64 {
    let products = weights.iter().zip(values).map(|(w, v)| w * f64::from(v));
    products.sum()
}

/// ½ (S0 + change), at least 0. What is not a number remains so.
fn half(s0: f32, change: f64) -> f32 {
    let value = 0.5 * (f64::from(s0) + change);
    if value < 0.0 { 0.0 } else { value as f32 }
}

fn add(sums: &mut Vec<f32>, values: &[f32]) {
    if sums.is_empty() {
        sums.extend_from_slice(values);
        return;
    }
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spectra::LightGroup;
    use spectra::stokes::{Retardance, Retarder};

    fn at(angle_deg: f64, retarder: Option<Retarder>) -> Polarizer {
        Polarizer {
            angle_deg,
            retarder,
        }
    }

    /// A pixel with these Stokes vectors of each light group, alike in all 40 bands, and XYZ of those bands.
    fn pixel(vectors: &[[f32; 4]]) -> SpectralImage {
        let group = |i: usize| LightGroup {
            name: format!("g{i}"),
            lamp: None,
        };
        let grid = BandGrid::visible(40).unwrap();
        let groups = (0..vectors.len()).map(group).collect();
        let mut image = SpectralImage::with_light_groups(1, 1, grid, groups).with_polarization();
        let observer = BandWeights::observed(&grid, Observer::Cie1931Deg2);
        for stokes in Stokes::ALL {
            let of = |vector: &[f32; 4]| vec![vector[stokes.index()]; 40];
            let radiance: Vec<f32> = vectors.iter().flat_map(of).collect();
            let xyz: Vec<_> = vectors
                .iter()
                .map(|vector| observer.xyz(&of(vector)).map(|v| v as f32))
                .collect();
            if stokes == Stokes::S0 {
                image.set_pixel_by_light((0, 0), &radiance, &[0.04; 40], &xyz, 7);
            } else {
                image.set_component_by_light((0, 0), stokes, &radiance, &xyz);
            }
        }
        image
    }

    /// I = I₀ cos²φ (Malus 1809) of polarized light, half of unpolarized light; in each light group, in their sum, and in XYZ.
    #[test]
    fn malus_law_holds_for_light_groups_and_colors() {
        let vectors = [[2.0, 2.0, 0.0, 0.0], [0.5, 0.0, 0.0, 0.5]];
        for vectors in [&vectors[..], &vectors[..1]] {
            for deg in [0.0_f64, 30.0, 45.0, 90.0, -60.0] {
                let before = pixel(vectors);
                let mut image = before.clone();
                behind(&mut image, &at(deg, None)).unwrap();
                assert!(!image.is_polarized());
                assert_eq!(image.layers().len(), LayerKey::all(vectors.len()).count());
                let shares = [deg.to_radians().cos().powi(2) as f32, 0.5];
                for (group, share) in shares.into_iter().take(vectors.len()).enumerate() {
                    let near = |a: f32, b: f32| (a - share * b).abs() <= 1e-5 * b;
                    let (own, s0) = (image.group_radiance(group), before.group_radiance(group));
                    assert!(own.iter().zip(s0).all(|(a, b)| near(*a, *b)), "{deg}");
                    let (own, s0) = (image.group_xyz(group)[0], before.group_xyz(group)[0]);
                    assert!((0..3).all(|axis| near(own[axis], s0[axis])), "{deg}");
                }
                let sum: f32 = (0..vectors.len()).map(|g| image.group_radiance(g)[3]).sum();
                assert_eq!(image.radiance()[3], sum);
                let ratio = sum / before.radiance()[3];
                assert!((image.variance()[3] - 0.04 * ratio * ratio).abs() < 1e-7);
                assert_eq!(image.samples(), [7]);
            }
        }
    }

    /// A quarter-wave plate with its fast axis at 45° makes right-handed light linear: it passes a polarizer at one of 0° and 90°.
    #[test]
    fn retarders_select_circular_light() {
        for retardance in [
            Retardance::Phase { deg: 90.0 },
            Retardance::Path { nm: 140.0 },
        ] {
            let plate = Some(Retarder {
                fast_axis_deg: 45.0,
                retardance,
            });
            let passed = |angle| {
                let mut image = pixel(&[[1.0, 0.0, 0.0, 1.0]]);
                behind(&mut image, &at(angle, plate)).unwrap();
                image
            };
            let (a, b) = (passed(0.0), passed(90.0));
            let whole = pixel(&[[1.0, 0.0, 0.0, 1.0]]);
            let grid = *whole.bands();
            for band in 0..40 {
                let analyzer = at(0.0, plate).analyzer();
                let nm = grid.center_nm(band);
                let expected = analyzer.transmitted([1.0, 0.0, 0.0, 1.0], nm) as f32;
                let (a, b) = (a.radiance()[band as usize], b.radiance()[band as usize]);
                assert!((a - expected).abs() < 1e-6 && (a + b - 1.0).abs() < 1e-6);
            }
            // XYZ is that of the bands that passed.
            let sums = BandWeights::observed(&grid, Observer::Cie1931Deg2).xyz(a.radiance());
            for (axis, sum) in sums.into_iter().enumerate() {
                let own = f64::from(a.xyz()[0][axis]);
                assert!((own - sum).abs() < 1e-4 * sums[1].max(1.0), "{own} {sum}");
                let both = a.xyz()[0][axis] + b.xyz()[0][axis];
                assert!((both / whole.xyz()[0][axis] - 1.0).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn rounding_makes_nothing_negative() {
        let mut image = pixel(&[[1.0, -1.000_001, 0.0, 0.0]]);
        behind(&mut image, &at(0.0, None)).unwrap();
        assert_eq!(image.radiance(), [0.0; 40]);
        assert_eq!(image.xyz(), [[0.0; 3]]);
    }

    #[test]
    fn an_image_without_polarization_is_refused() {
        let mut image = SpectralImage::new(1, 1, BandGrid::visible(2).unwrap());
        let before = image.clone();
        assert_eq!(behind(&mut image, &at(0.0, None)), Err(NotPolarized));
        assert_eq!(image, before);
    }
}
