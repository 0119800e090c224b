//! Media and layers of stacks.

use crate::label;
use document::wording::visible;
use media::{Extrapolate, Index};
use spectra::OpticalConstants;
use std::sync::Arc;

/// Largest extinction coefficient of an incident medium.
pub(crate) const INCIDENT_K: f64 = 1e-6;

/// A material as the user wrote it, with its optical constants.
#[derive(Clone, Debug, PartialEq)]
pub struct Medium {
    written: Index,
    /// Shared, since hundreds of layers may have the same medium.
    constants: Arc<OpticalConstants>,
    notes: Vec<String>,
}

impl Medium {
    pub(crate) fn new(written: Index, constants: OpticalConstants, notes: Vec<String>) -> Self {
        Self {
            written,
            constants: Arc::new(constants),
            notes,
        }
    }

    /// The index as it was written.
    pub fn written(&self) -> &Index {
        &self.written
    }

    /// Assumptions about its files, one line each.
    pub(crate) fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Returns n and k over wavelength.
    pub fn constants(&self) -> &OpticalConstants {
        &self.constants
    }

    /// Returns a short readable name: `silica`, `1.5+0.1i`, `mine.csv`, `table`.
    pub fn label(&self) -> String {
        let label = match &self.written {
            Index::Real(n) => n.to_string(),
            Index::Complex([n, k]) => format!("{n}+{k}i"),
            Index::Name(name) | Index::Named { name, .. } => name.clone(),
            Index::File { csv: path, .. } | Index::Database { yaml: path, .. } => {
                path.display().to_string()
            }
            Index::Table { .. } => "table".to_owned(),
            Index::Cauchy { .. } => "Cauchy".to_owned(),
            Index::Sellmeier { .. } => "Sellmeier".to_owned(),
            Index::Reflecting { .. } => "normal reflectance".to_owned(),
            Index::Mixture { .. } => "mixture".to_owned(),
        };
        visible(&label).into_owned()
    }

    /// Describes the data as `rutile beyond 430 to 1530 nm`, if they do not cover these wavelengths.
    pub(crate) fn shortfall(&self, (from_nm, to_nm): (f64, f64)) -> Option<String> {
        let (low, high) = self.constants.range_nm()?;
        let is_short = from_nm < low || high < to_nm;
        is_short.then(|| format!("{} beyond {low} to {high} nm", self.label()))
    }

    /// Returns the same medium with end values outside its data. The written index changes too where it can: not for mixtures and
    /// reflectances, whose parts have their own data ranges.
    pub(crate) fn clamped(mut self) -> Self {
        if self.constants.range_nm().is_none() {
            return self;
        }
        let OpticalConstants { n, k } = OpticalConstants::clone(&self.constants);
        self.constants = Arc::new(OpticalConstants {
            n: n.clamped(),
            k: k.clamped(),
        });
        match &mut self.written {
            Index::Name(name) => {
                self.written = Index::Named {
                    name: std::mem::take(name),
                    extrapolate: Extrapolate::Clamp,
                };
            }
            Index::Named { extrapolate, .. }
            | Index::Table { extrapolate, .. }
            | Index::File { extrapolate, .. }
            | Index::Database { extrapolate, .. }
            | Index::Cauchy { extrapolate, .. }
            | Index::Sellmeier { extrapolate, .. } => *extrapolate = Extrapolate::Clamp,
            Index::Real(_)
            | Index::Complex(_)
            | Index::Reflecting { .. }
            | Index::Mixture { .. } => {}
        }
        self
    }

    /// Returns whether it absorbs visible light, as far as its data say.
    pub(crate) fn absorbs(&self) -> bool {
        let k = |nm| self.constants.k.at(f64::from(nm)).unwrap_or(0.0);
        (380..=780).any(|nm| k(nm) > INCIDENT_K)
    }
}

/// A layer of a stack.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Its material.
    pub medium: Medium,
    /// Thickness, nm, ≥ 0.
    pub thickness_nm: f64,
}

impl Layer {
    /// Returns a short readable name with a rounded thickness: `TiO2 56.45 nm`.
    pub fn label(&self) -> String {
        format!(
            "{} {} nm",
            self.medium.label(),
            label::rounded(self.thickness_nm)
        )
    }
}
