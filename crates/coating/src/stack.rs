//! Stacks: two half spaces and the layers between them.

use crate::file::{self, StackDescription};
use crate::label;
use crate::line::{self, EXAMPLE, LineError};
use crate::model::{self, Model};
use crate::response::Sampled;
use crate::thickness::THICKNESS_NM;
use document::text_file::STANDARD_INPUT;
use document::wording::visible;
use document::{Folder, Problems, Range};
use media::{Extrapolate, Index};
use miette::Diagnostic;
use optics::Complex64;
use spectra::{OpticalConstants, OutOfRange};
use std::path::Path;
use std::sync::Arc;
use thiserror::Error;

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
    fn shortfall(&self, (from_nm, to_nm): (f64, f64)) -> Option<String> {
        let (low, high) = self.constants.range_nm()?;
        let is_short = from_nm < low || high < to_nm;
        is_short.then(|| format!("{} beyond {low} to {high} nm", self.label()))
    }

    /// Returns the same medium with end values outside its data. The written index changes too where it can: not for mixtures and
    /// reflectances, whose parts have their own data ranges.
    fn clamped(mut self) -> Self {
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
    fn absorbs(&self) -> bool {
        let k = |nm| self.constants.k.at(f64::from(nm)).unwrap_or(0.0);
        (380..=780).any(|nm| k(nm) > Stack::INCIDENT_K)
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

/// A stack: the incident medium, the layers in order from there, and the substrate.
#[derive(Clone, Debug, PartialEq)]
pub struct Stack {
    incident: Medium,
    layers: Vec<Layer>,
    substrate: Medium,
    thicknesses_nm: Vec<f64>,
    /// Whether it was written in one line, for the help in errors.
    is_line: bool,
    model: Model,
    notes: Vec<String>,
}

/// Why a stack cannot be read.
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub enum StackError {
    /// A stack file is invalid.
    #[error(transparent)]
    #[diagnostic(transparent)]
    File(#[from] Problems),
    /// The text is neither the name of a file nor a one-line stack.
    #[error("there is no stack file {0:?}")]
    #[diagnostic(help("a stack in one line has | between its media, like {EXAMPLE:?}"))]
    Nothing(String),
    /// A one-line stack is invalid.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Line(#[from] LineError),
}

/// Why a stack cannot be evaluated at a wavelength.
#[derive(Clone, Debug, Error, Diagnostic, PartialEq)]
#[non_exhaustive]
pub enum SampleError {
    /// A medium has no data there.
    #[error(
        "{asked_nm} nm is outside the data of {place}, {label}, which cover {min_nm} to {max_nm} nm"
    )]
    OutOfRange {
        /// Which medium: `the incident medium`, `layer 2`, `the substrate`.
        place: String,
        /// Name of the medium.
        label: String,
        /// The requested wavelength, nm.
        asked_nm: f64,
        /// The shortest wavelength of the data, nm.
        min_nm: f64,
        /// The longest wavelength of the data, nm.
        max_nm: f64,
        /// What the user can do, for the form in which the stack is written.
        #[help]
        help: String,
    },
    /// The data of a medium cannot be used there.
    #[error("at {asked_nm} nm the data of {place}, {label}, cannot be used: {fault}")]
    #[diagnostic(help("correct the data, or ask for other wavelengths"))]
    Faulty {
        /// Which medium: `the incident medium`, `layer 2`, `the substrate`.
        place: String,
        /// Name of the medium.
        label: String,
        /// The requested wavelength, nm.
        asked_nm: f64,
        /// What is wrong with the data, and in which line.
        fault: String,
    },
    /// The two-beam model is not defined for the stack.
    #[error(
        "two beams need one film that does not absorb (k = 0) between two equal media of no larger index, but {fault}"
    )]
    #[diagnostic(help("use the exact model, which is for any stack"))]
    NoTwoBeams {
        /// Which condition is not met.
        fault: String,
    },
    /// The incident medium absorbs there.
    #[error("at {nm} nm the incident medium, {label}, has k = {k}; it must be transparent (k = 0)")]
    IncidentAbsorbs {
        /// Name of the medium.
        label: String,
        /// The wavelength, nm.
        nm: f64,
        /// Its extinction coefficient.
        k: f64,
    },
}

impl Stack {
    /// Largest extinction coefficient of an incident medium, which must be transparent: at 1e-6, light of 500 nm travels 40 mm. Up to
    /// this, k is taken as 0.
    pub const INCIDENT_K: f64 = 1e-6;
    /// Maximum number of layers.
    pub const MAX_LAYERS: usize = 1000;
    /// Thickness of a layer.
    pub const THICKNESS_NM: Range = THICKNESS_NM;

    /// Opens a stack file if `text` is a path, reads one from standard input if it is `-`, or parses a one-line stack if it contains `|`.
    ///
    /// # Errors
    /// Reports everything that is wrong, and where.
    pub fn open(text: &str) -> Result<Self, StackError> {
        if text.contains('|') {
            Ok(Self::parse(text)?)
        } else if text != STANDARD_INPUT && !Path::new(text).exists() {
            Err(StackError::Nothing(text.chars().take(200).collect()))
        } else {
            Ok(Self::read(text)?)
        }
    }

    /// Like [`Self::open`], for a trusted stack file: the files that it names may be outside of its folder.
    ///
    /// # Errors
    /// Reports everything that is wrong, and where.
    pub fn open_trusted(text: &str) -> Result<Self, StackError> {
        if text.contains('|') || !Path::new(text).exists() {
            return Self::open(text);
        }
        Ok(file::read(text.as_ref(), true)?)
    }

    /// Parses a one-line stack: `air | silica 300nm | silicon`.
    ///
    /// The first medium is the incident medium and the last is the substrate. Between them are layers with their thickness in nm,
    /// µm (um), mm or Å (angstrom), or in waves at a wavelength in nm: `TiO2 0.25@550` is a quarter-wave layer at normal incidence.
    /// A power repeats layers in brackets: `air | (TiO2 60nm | SiO2 90nm)^8 | BK7`. Definitions before the stack name media and
    /// layers: `H=TiO2 0.25@550; L=SiO2 0.25@550; air | (HL)^8 2H | BK7`, where `2H` is twice as thick as `H`.
    ///
    /// A medium is a material's name, a number `1.5` or `1.5+0.1i`, or a file `.csv` or `.yml`. `air` is the material of the library,
    /// n = 1.0003; `vacuum` is n = 1.
    ///
    /// # Errors
    /// Reports the first part that is wrong.
    pub fn parse(line: &str) -> Result<Self, LineError> {
        line::parse(line)
    }

    /// Reads a stack file: see [`StackDescription`]. The files that it names must be in its folder.
    ///
    /// # Errors
    /// Reports everything that is wrong.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Problems> {
        file::read(path.as_ref(), false)
    }

    /// Reads the text of a stack file. Errors call it `name`; files are relative to `folder` and must be inside it.
    ///
    /// # Errors
    /// Reports everything that is wrong.
    pub fn from_toml(name: &str, text: &str, folder: impl Into<Folder>) -> Result<Self, Problems> {
        file::parse(name, text, &folder.into())
    }

    /// Makes a stack. `line` and `file` have checked that the incident medium is transparent and thicknesses are finite and not negative.
    pub(crate) fn new(incident: Medium, layers: Vec<Layer>, substrate: Medium) -> Self {
        let thicknesses_nm = layers.iter().map(|layer| layer.thickness_nm).collect();
        Self {
            incident,
            layers,
            substrate,
            thicknesses_nm,
            is_line: false,
            model: Model::Exact,
            notes: Vec::new(),
        }
    }

    pub(crate) fn written_in_a_line(mut self) -> Self {
        self.is_line = true;
        self
    }

    /// Returns the same stack, where every medium has its end values outside its data. A note names the media whose data do not cover
    /// `used_nm`, the shortest and the longest wavelength in use. Faults within the data remain faults.
    #[must_use]
    pub fn clamped(mut self, used_nm: (f64, f64)) -> Self {
        let mut extended: Vec<String> = Vec::new();
        for medium in self.media() {
            let new = medium.shortfall(used_nm);
            extended.extend(new.filter(|new| !extended.contains(new)));
        }
        if !extended.is_empty() {
            let media = extended.join(", ");
            let note = format!("end values are used where data end: {media}");
            self.notes.push(note);
        }
        let layer = |layer: Layer| Layer {
            medium: layer.medium.clamped(),
            ..layer
        };
        Self {
            incident: self.incident.clamped(),
            layers: self.layers.into_iter().map(layer).collect(),
            substrate: self.substrate.clamped(),
            ..self
        }
    }

    /// Returns the same stack with another formula for R and T. [`Self::sampled`] checks whether the formula is defined for the stack.
    #[must_use]
    pub fn with_model(self, model: Model) -> Self {
        Self { model, ..self }
    }

    /// The formula for R and T.
    pub fn model(&self) -> Model {
        self.model
    }

    /// The media in the order of the stack.
    fn media(&self) -> impl Iterator<Item = &Medium> {
        let layers = self.layers.iter().map(|layer| &layer.medium);
        let incident = std::iter::once(&self.incident);
        incident.chain(layers).chain([&self.substrate])
    }

    /// Assumptions about the files of its media, and where data end, one line each, without duplicates.
    pub fn notes(&self) -> Vec<&str> {
        let mut notes: Vec<&str> = Vec::new();
        let of_media = self.media().flat_map(|medium| &medium.notes);
        for note in of_media.chain(&self.notes) {
            if !notes.contains(&note.as_str()) {
                notes.push(note);
            }
        }
        notes
    }

    /// Returns why `medium` cannot be the incident medium; `None` if it can.
    pub(crate) fn fault_of_incident(medium: &Medium) -> Option<String> {
        let label = medium.label();
        medium
            .absorbs()
            .then(|| format!("{label} absorbs; the incident medium must be transparent (k = 0)"))
    }

    /// The incident medium.
    pub fn incident(&self) -> &Medium {
        &self.incident
    }

    /// The layers; the first touches the incident medium.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// The medium behind the last layer.
    pub fn substrate(&self) -> &Medium {
        &self.substrate
    }

    /// Thicknesses of the layers in order, nm.
    pub fn thicknesses_nm(&self) -> &[f64] {
        &self.thicknesses_nm
    }

    /// Returns the stack as a stack file describes it.
    pub fn description(&self) -> StackDescription {
        StackDescription::of(self)
    }

    /// Returns a readable label of the stack in one line.
    pub fn label(&self) -> String {
        self.labeled(None)
    }

    /// Returns a readable label of the stack in one line, where one layer (counted from 0) has the thickness d.
    pub fn label_with_varied(&self, varied: usize) -> String {
        self.labeled(Some(varied))
    }

    fn labeled(&self, varied: Option<usize>) -> String {
        let layer = |(place, layer): (usize, &Layer)| match varied {
            Some(varied) if varied == place => format!("{} d", layer.medium.label()),
            _ => layer.label(),
        };
        let layers: Vec<String> = self.layers.iter().enumerate().map(layer).collect();
        let mut parts = vec![self.incident.label()];
        parts.extend(label::of_layers(&layers));
        parts.push(self.substrate.label());
        parts.join(" | ")
    }

    /// Returns the stack at these wavelengths, nm.
    ///
    /// # Errors
    /// If a medium has no data at one of them, the incident medium absorbs, or the model is not defined for the stack.
    pub fn sampled(&self, wavelengths_nm: &[f64]) -> Result<Sampled, SampleError> {
        let incident = self.indices("the incident medium", &self.incident, wavelengths_nm)?;
        if let Some((&nm, index)) = wavelengths_nm
            .iter()
            .zip(&incident)
            .find(|(_, index)| index.im > Self::INCIDENT_K)
        {
            return Err(SampleError::IncidentAbsorbs {
                label: self.incident.label(),
                nm,
                k: index.im,
            });
        }
        let of_layer = |(index, layer): (usize, &Layer)| {
            self.indices(
                &format!("layer {}", index + 1),
                &layer.medium,
                wavelengths_nm,
            )
        };
        let layers = self.layers.iter().enumerate().map(of_layer);
        let sampled = Sampled::new(
            wavelengths_nm.to_vec(),
            incident.into_iter().map(|index| index.re).collect(),
            layers.collect::<Result<_, _>>()?,
            self.indices("the substrate", &self.substrate, wavelengths_nm)?,
        );
        if self.model != Model::Exact {
            has_two_beams(&sampled)?;
        }
        Ok(sampled.with_model(self.model))
    }

    /// Returns the index of a medium at each wavelength.
    fn indices(
        &self,
        place: &str,
        medium: &Medium,
        nm: &[f64],
    ) -> Result<Vec<Complex64>, SampleError> {
        let at = |&nm: &f64| medium.constants.at(nm);
        let found: Result<_, OutOfRange> = nm.iter().map(at).collect();
        found.map_err(|gap| {
            let (place, label, asked_nm) = (place.to_owned(), medium.label(), gap.nm);
            match gap.fault {
                Some(fault) => SampleError::Faulty {
                    place,
                    label,
                    asked_nm,
                    fault: fault.to_string(),
                },
                None => SampleError::OutOfRange {
                    place,
                    label,
                    asked_nm,
                    min_nm: gap.min_nm,
                    max_nm: gap.max_nm,
                    help: self.help_beyond_data().to_owned(),
                },
            }
        })
    }

    fn help_beyond_data(&self) -> &'static str {
        if self.is_line {
            "choose wavelengths within that range, or use the end values with --clamp"
        } else {
            "choose wavelengths within that range; or use the end values with --clamp, or in the stack file with \
             index = { name = …, extrapolate = \"clamp\" }"
        }
    }
}

/// Checks that the two-beam model is defined for a stack at all its wavelengths.
fn has_two_beams(sampled: &Sampled) -> Result<(), SampleError> {
    let media = sampled.incident().iter().zip(sampled.substrate());
    for (w, (&around, &substrate)) in media.enumerate() {
        let at_this = |indices: &Vec<Complex64>| indices.get(w).copied();
        let layers: Vec<Complex64> = sampled.layers().iter().filter_map(at_this).collect();
        if let Some(fault) = model::fault_of_two_beams(around, &layers, substrate) {
            return Err(SampleError::NoTwoBeams { fault });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_short_is_reported_in_the_form_of_the_stack_and_can_be_clamped() {
        let line = Stack::parse("1 | Au 30nm | rutile").unwrap();
        let help = |stack: &Stack| {
            let error = stack.sampled(&[400.0]).unwrap_err();
            assert!(error.to_string().contains("430 to 1530 nm"), "{error}");
            error.help().unwrap().to_string()
        };
        assert!(help(&line).contains("--clamp") && !help(&line).contains('{'));
        let file = line.description().check(Path::new("")).unwrap();
        assert!(help(&file).contains("--clamp") && help(&file).contains("extrapolate"));
        let said = |stack: &Stack| -> Vec<String> {
            let notes = stack.notes().into_iter();
            let of_ends = notes.filter(|note| note.contains("end values"));
            of_ends.map(str::to_owned).collect()
        };
        assert!(said(&line.clone().clamped((430.0, 780.0))).is_empty());
        let clamped = line.clamped((380.0, 780.0));
        let index = |nm: f64| clamped.sampled(&[nm]).unwrap().substrate()[0];
        assert_eq!(index(400.0), index(430.0));
        assert_eq!(
            said(&clamped),
            ["end values are used where data end: rutile beyond 430 to 1530 nm"]
        );
        // A file written from it has the same values.
        let again = clamped.description().check(Path::new("")).unwrap();
        assert_eq!(
            again.sampled(&[400.0]).unwrap().substrate()[0],
            index(400.0)
        );
    }

    #[test]
    fn a_fault_of_a_file_is_reported_where_it_is_asked_for() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.yml");
        let rows = "        0.3 1.5 0\n        0.9 1.5 0\n        12 1.5 -0.3\n";
        let text = format!("DATA:\n  - type: tabulated nk\n    data: |\n{rows}");
        std::fs::write(&path, text).unwrap();
        let stack = Stack::parse(&format!("1 | {} 30nm | 1.5", path.display())).unwrap();
        assert!(stack.sampled(&[380.0, 780.0]).is_ok());
        for stack in [stack.clone(), stack.clamped((380.0, 1000.0))] {
            let said = stack.sampled(&[1000.0]).unwrap_err().to_string();
            for words in ["at 1000 nm", "layer 1", "line 6: found k -0.3 at 12000 nm"] {
                assert!(said.contains(words), "{said}");
            }
        }
    }
}
