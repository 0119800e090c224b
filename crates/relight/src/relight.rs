//! Relighting: changing the lamps of an image without rendering again.

use crate::weights::{BandWeights, DarkBand};
use rayon::prelude::*;
use spectra::{
    BandGrid, LayerKey, Observer, OutOfRange, Quantity, RowMut, SpectralImage, Spectrum, Stokes,
    Tabulated,
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
/// S1, S2 and S3 of polarized light change as S0 does: what a polarizer transmits is the same before and after. In a band that gets
/// another lamp, none of them becomes larger than S0.
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

    /// Changes the radiance and XYZ of pixels: of S0, or of a component that the changed S0 limits.
    fn apply(&self, light: &mut Component<'_>, s0: Option<&[f32]>, bands: usize) {
        let scaled = |value: f64| (value * self.factor) as f32;
        let mut relit = vec![0.0; bands];
        let pixels = light.radiance.chunks_exact_mut(bands);
        for (pixel, (radiance, xyz)) in pixels.zip(light.xyz.as_chunks_mut().0).enumerate() {
            *xyz = match &self.weights {
                None => xyz.map(|value| scaled(f64::from(value))),
                Some(weights) => weights.xyz(radiance).map(scaled),
            };
            match &self.weights {
                Some(weights) if self.lamp.is_some() => {
                    match s0 {
                        None => put(&mut relit, weights.relit(radiance).map(scaled)),
                        Some(s0) => {
                            let limits = &s0[pixel * bands..(pixel + 1) * bands];
                            let values = weights.relit_component(radiance).map(scaled);
                            let limited = values.zip(limits).map(|(v, s0)| v.max(-s0).min(*s0));
                            put(&mut relit, limited);
                        }
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

/// A component of the Stokes vector in a row, of all light or of a light group; empty if the image does not have it.
struct Component<'a> {
    radiance: &'a mut [f32],
    xyz: &'a mut [f32],
}

impl<'a> Component<'a> {
    fn take(row: &mut RowMut<'a>, light_group: Option<usize>, stokes: Stokes) -> Self {
        let [radiance, xyz] = [Quantity::Radiance, Quantity::Xyz].map(|quantity| {
            row.take(LayerKey {
                quantity,
                light_group,
                stokes,
            })
        });
        Self { radiance, xyz }
    }
}

fn put(to: &mut [f32], values: impl Iterator<Item = f32>) {
    for (to, value) in to.iter_mut().zip(values) {
        *to = value;
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
    let variance = row.take(LayerKey::VARIANCE);
    let mut total = Stokes::ALL.map(|stokes| Component::take(&mut row, None, stokes));
    let before = total[0].radiance.to_vec();
    if let [change] = changes {
        apply_all(change, &mut total, bands);
    } else {
        for component in &mut total {
            component.radiance.fill(0.0);
            component.xyz.fill(0.0);
        }
        for (group, change) in changes.iter().enumerate() {
            let mut own = Stokes::ALL.map(|stokes| Component::take(&mut row, Some(group), stokes));
            apply_all(change, &mut own, bands);
            for (total, own) in total.iter_mut().zip(&own) {
                add(total.radiance, own.radiance);
                add(total.xyz, own.xyz);
            }
        }
    }
    let changed = before.iter().zip(total[0].radiance.iter());
    for (variance, (&before, &after)) in variance.iter_mut().zip(changed) {
        let ratio = after / before;
        if before != after && ratio.is_finite() {
            *variance *= ratio * ratio;
        }
    }
}

/// Changes all components of light.
fn apply_all(change: &Change, [s0, polarized @ ..]: &mut [Component<'_>; 4], bands: usize) {
    change.apply(s0, None, bands);
    for component in polarized {
        change.apply(component, Some(s0.radiance), bands);
    }
}

fn add(sums: &mut [f32], values: &[f32]) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += value;
    }
}

#[cfg(test)]
mod tests;
