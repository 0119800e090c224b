//! Relighting: changing the lamps of an image without rendering again.

use crate::weights::{BandWeights, DarkBand};
use rayon::prelude::*;
use spectra::{
    BandGrid, LayerKey, Observer, OutOfRange, Quantity, RowMut, SpectralImage, Spectrum, Tabulated,
};
use thiserror::Error;

/// The change of a light group.
#[derive(Clone, Debug, PartialEq)]
pub struct Relight {
    /// The new lamp of its emitters, at their present scales; `None` keeps the present lamp.
    pub lamp: Option<Spectrum>,
    /// The factor on its light, at least 0.
    pub factor: f64,
}

/// Why an image cannot be relit. The image is then left unchanged.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RelightError {
    /// No light group has the name.
    #[error("the image has no light group {name:?}; it has {}", .known.join(", "))]
    UnknownLightGroup {
        /// The requested name.
        name: String,
        /// The names of the image's light groups.
        known: Vec<String>,
    },
    /// A light group is changed twice.
    #[error("the light group {0:?} is given twice")]
    Repeated(String),
    /// A factor is negative or not finite.
    #[error(
        "the light group {name:?} cannot be made {factor} times as bright: a factor is a finite number of at least 0"
    )]
    Factor {
        /// The light group.
        name: String,
        /// The factor.
        factor: f64,
    },
    /// The lights of a group have different lamps, or the image does not record their lamp.
    #[error(
        "the lamp of the light group {0:?} cannot be changed, only its factor: its lights differ, or the image does not record their lamp"
    )]
    UnknownLamp(String),
    /// The new lamp has no value at a wavelength of the image.
    #[error("the lamp for the light group {name:?} does not cover the image's bands")]
    OutOfRange {
        /// The light group.
        name: String,
        /// The wavelength and the range of the lamp.
        source: OutOfRange,
    },
    /// The new lamp has visible light where the old lamp has none.
    #[error(
        "the light group {name:?} cannot have this lamp: from {} to {} nm it has visible light, but the lamp that the image was rendered \
         with has none, so nothing is known there",
        .band.from_nm, .band.to_nm
    )]
    Dark {
        /// The light group.
        name: String,
        /// The dark band with the most luminance.
        band: DarkBand,
    },
}

/// Changes the lamps of light groups, and the observer.
///
/// Bands and XYZ of an image become those of a render with the new lamps, as far as the bands allow ([`BandWeights`]). A light
/// group that keeps its lamp keeps its bands to the last bit, times its factor. With the observer of 1931 the same holds for its
/// XYZ, which were summed at the sampled wavelengths themselves. XYZ of another observer are scaled so that an equal-energy radiance
/// of 1 keeps its Y.
///
/// A band that a new lamp would make negative is 0; XYZ are summed before that and are not clipped. Bands in which the old lamp has
/// no light stay dark; that is an error if they contain more than [`BandWeights::DARK_SHARE`] of the new lamp's Y.
///
/// The variance of a band keeps its relative size, since the part of each light group in it is unknown. Where the band was 0 or is
/// not finite, the variance keeps its value.
///
/// The image must hold XYZ of the observer of 1931, as rendered images and images read from files do.
///
/// # Errors
/// When a light group does not exist, or its lamp cannot be changed to the new one.
pub fn relight(
    image: &mut SpectralImage,
    changes: &[(String, Relight)],
    observer: Observer,
) -> Result<(), RelightError> {
    check_names(image, changes)?;
    let planned: Result<Vec<Change>, RelightError> = (0..image.light_groups().len())
        .map(|group| Change::plan(image, group, changes, observer))
        .collect();
    let planned = planned?;
    for (group, change) in planned.iter().enumerate() {
        if let Some(lamp) = &change.lamp {
            image.light_group_mut(group).lamp = Some(lamp.clone());
        }
    }
    let bands = image.bands().count() as usize;
    let rows = image.rows_mut();
    rows.into_par_iter()
        .for_each(|row| relight_row(row, &planned, bands));
    Ok(())
}

fn check_names(image: &SpectralImage, changes: &[(String, Relight)]) -> Result<(), RelightError> {
    for (position, (name, change)) in changes.iter().enumerate() {
        let mut groups = image.light_groups().iter();
        if !groups.any(|group| group.name == *name) {
            let known = image.light_groups().iter();
            return Err(RelightError::UnknownLightGroup {
                name: name.clone(),
                known: known.map(|group| format!("{:?}", group.name)).collect(),
            });
        }
        if changes[..position].iter().any(|(other, _)| other == name) {
            return Err(RelightError::Repeated(name.clone()));
        }
        if !(change.factor >= 0.0 && change.factor.is_finite()) {
            return Err(RelightError::Factor {
                name: name.clone(),
                factor: change.factor,
            });
        }
    }
    Ok(())
}

/// The planned change of a light group.
struct Change {
    /// The new lamp.
    lamp: Option<Tabulated>,
    /// The weights for XYZ and, with a new lamp, for the bands; `None` if both are only multiplied by the factor.
    weights: Option<BandWeights>,
    factor: f64,
}

impl Change {
    fn plan(
        image: &SpectralImage,
        group: usize,
        changes: &[(String, Relight)],
        observer: Observer,
    ) -> Result<Self, RelightError> {
        let (grid, group) = (image.bands(), &image.light_groups()[group]);
        let name = || group.name.clone();
        let found = changes.iter().find(|(name, _)| *name == group.name);
        let factor = found.map_or(1.0, |(_, change)| change.factor);
        let known = group.lamp.as_ref();
        let kept = |weights| Self {
            lamp: None,
            weights,
            factor,
        };
        let Some(wanted) = found.and_then(|(_, change)| change.lamp.as_ref()) else {
            if observer == Observer::Cie1931Deg2 {
                return Ok(kept(None));
            }
            let own = known.map(|lamp| BandWeights::new(grid, lamp, lamp, observer));
            let observed = || BandWeights::observed(grid, observer);
            return Ok(kept(Some(
                own.and_then(Result::ok).unwrap_or_else(observed),
            )));
        };
        let before = known.ok_or_else(|| RelightError::UnknownLamp(name()))?;
        let after = over(grid, wanted).map_err(|source| RelightError::OutOfRange {
            name: name(),
            source,
        })?;
        if after == *before && observer == Observer::Cie1931Deg2 {
            return Ok(kept(None));
        }
        let weights = BandWeights::new(grid, before, &after, observer);
        Ok(Self {
            weights: Some(weights.map_err(|band| RelightError::Dark { name: name(), band })?),
            lamp: Some(after),
            factor,
        })
    }

    /// Changes the radiance and XYZ of pixels.
    fn apply(&self, radiance: &mut [f32], xyz: &mut [[f32; 3]], bands: usize) {
        let scaled = |value: f64| (value * self.factor) as f32;
        let mut relit = vec![0.0; bands];
        for (radiance, xyz) in radiance.chunks_exact_mut(bands).zip(xyz) {
            *xyz = match &self.weights {
                None => xyz.map(|value| scaled(f64::from(value))),
                Some(weights) => weights.xyz(radiance).map(scaled),
            };
            match &self.weights {
                Some(weights) if self.lamp.is_some() => {
                    for (relit, value) in relit.iter_mut().zip(weights.relit(radiance)) {
                        *relit = scaled(value);
                    }
                    radiance.copy_from_slice(&relit);
                }
                _ => radiance
                    .iter_mut()
                    .for_each(|value| *value = scaled(f64::from(*value))),
            }
        }
    }
}

/// Tabulates a lamp over the bands.
///
/// # Errors
/// When the lamp has no value at an end of the bands.
pub fn over(grid: &BandGrid, lamp: &Spectrum) -> Result<Tabulated, OutOfRange> {
    let ends = [grid.min_nm(), grid.max_nm()];
    for nm in ends {
        lamp.at(nm)?;
    }
    let table = match lamp {
        Spectrum::Constant(value) => Tabulated::new(ends.map(|nm| (nm, *value)).to_vec()).ok(),
        other => grid.lamp(other),
    };
    // The lamp has values at both ends, so there is a table; formulas are not lamps.
    table.ok_or(OutOfRange {
        nm: ends[0],
        min_nm: ends[0],
        max_nm: ends[1],
        fault: None,
    })
}

fn relight_row(mut row: RowMut<'_>, changes: &[Change], bands: usize) {
    let [radiance, variance, xyz] =
        [LayerKey::RADIANCE, LayerKey::VARIANCE, LayerKey::XYZ].map(|key| row.take(key));
    let before = radiance.to_vec();
    if let [change] = changes {
        change.apply(radiance, xyz.as_chunks_mut().0, bands);
    } else {
        radiance.fill(0.0);
        xyz.fill(0.0);
        for (group, change) in changes.iter().enumerate() {
            let [own_radiance, own_xyz] = [Quantity::Radiance, Quantity::Xyz]
                .map(|quantity| row.take(LayerKey::of_light(quantity, group)));
            change.apply(own_radiance, own_xyz.as_chunks_mut().0, bands);
            add(radiance, own_radiance);
            add(xyz, own_xyz);
        }
    }
    let changed = before.iter().zip(radiance.iter());
    for (variance, (&before, &after)) in variance.iter_mut().zip(changed) {
        let ratio = after / before;
        if before != after && ratio.is_finite() {
            *variance *= ratio * ratio;
        }
    }
}

fn add(sums: &mut [f32], values: &[f32]) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += value;
    }
}

#[cfg(test)]
mod tests;
