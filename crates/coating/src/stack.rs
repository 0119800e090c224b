//! A stack: two half spaces and the layers between them.

use crate::file::{self, StackDescription};
use crate::label;
use crate::line::{self, EXAMPLE, LineError};
use crate::model::{self, Model};
use crate::response::Sampled;
use miette::Diagnostic;
use optics::Complex64;
use scene::description::{Extrapolate, Index};
use scene::{Folder, Problems};
use spectra::text_file::STANDARD_INPUT;
use spectra::wording::visible;
use spectra::{OpticalConstants, OutOfRange};
use std::path::Path;
use std::sync::Arc;
use thiserror::Error;

/// A material as the stack's author wrote it, with its optical constants.
#[derive(Clone, Debug, PartialEq)]
pub struct Medium {
    written: Index,
    /// Shared: a medium may be that of hundreds of layers.
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

    /// As it was written.
    pub fn written(&self) -> &Index {
        &self.written
    }

    /// n and k over wavelength.
    pub fn constants(&self) -> &OpticalConstants {
        &self.constants
    }

    /// A short name for people: `silica`, `1.5+0.1i`, `mine.csv`, `table`.
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

    /// Its data as `rutile beyond 430 to 1530 nm`, where they do not cover these wavelengths.
    fn shortfall(&self, (from_nm, to_nm): (f64, f64)) -> Option<String> {
        let (low, high) = self.constants.range_nm()?;
        let is_short = from_nm < low || high < to_nm;
        is_short.then(|| format!("{} beyond {low} to {high} nm", self.label()))
    }

    /// The same medium with its end values outside its data. What was written says so too, where it can: not for mixtures and
    /// reflectances, whose parts have ends of their own.
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

    /// Whether visible light is weakened on its way through it, as far as its data say.
    fn absorbs(&self) -> bool {
        let k = |nm| self.constants.k.at(f64::from(nm)).unwrap_or(0.0);
        (380..=780).any(|nm| k(nm) > Stack::INCIDENT_K)
    }
}

/// A layer of a stack.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// What it is made of.
    pub medium: Medium,
    /// How thick it is, nm, ≥ 0.
    pub thickness_nm: f64,
}

impl Layer {
    /// A short name for people, with the thickness rounded to what can be told apart: `TiO2 56.45 nm`.
    pub fn label(&self) -> String {
        format!(
            "{} {} nm",
            self.medium.label(),
            label::rounded(self.thickness_nm)
        )
    }
}

/// A stack: the incident medium, layers from there on, the substrate.
#[derive(Clone, Debug, PartialEq)]
pub struct Stack {
    incident: Medium,
    layers: Vec<Layer>,
    substrate: Medium,
    thicknesses_nm: Vec<f64>,
    /// Whether it is written in one line, for what errors advise.
    is_line: bool,
    model: Model,
    notes: Vec<String>,
}

/// Why there is no stack.
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub enum StackError {
    /// What is wrong with a stack file.
    #[error(transparent)]
    #[diagnostic(transparent)]
    File(#[from] Problems),
    /// Neither the name of a file nor a stack in one line.
    #[error("there is no stack file {0:?}")]
    #[diagnostic(help("a stack in one line has | between its media, like {EXAMPLE:?}"))]
    Nothing(String),
    /// What is wrong with a one-line stack.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Line(#[from] LineError),
}

/// Why a stack has no numbers at a wavelength.
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
        /// What it is called.
        label: String,
        /// The wavelength asked for, nm.
        asked_nm: f64,
        /// The shortest wavelength of the data, nm.
        min_nm: f64,
        /// The longest wavelength of the data, nm.
        max_nm: f64,
        /// What can be done, in the form that the stack is written in.
        #[help]
        help: String,
    },
    /// The data of a medium cannot be used there.
    #[error("at {asked_nm} nm the data of {place}, {label}, cannot be used: {fault}")]
    #[diagnostic(help("mend the data, or ask for other wavelengths"))]
    Faulty {
        /// Which medium: `the incident medium`, `layer 2`, `the substrate`.
        place: String,
        /// What it is called.
        label: String,
        /// The wavelength asked for, nm.
        asked_nm: f64,
        /// What is wrong with the data, with its line.
        fault: String,
    },
    /// Two beams are not defined for the stack.
    #[error(
        "two beams are for one film that does not absorb (k = 0) between two equal media of no larger index, but {fault}"
    )]
    #[diagnostic(help("the exact model is for any stack"))]
    NoTwoBeams {
        /// What is not so.
        fault: String,
    },
    /// The incident medium absorbs there.
    #[error(
        "at {nm} nm the incident medium, {label}, has k = {k}; the medium that light comes from must be transparent (k = 0)"
    )]
    IncidentAbsorbs {
        /// What it is called.
        label: String,
        /// The wavelength, nm.
        nm: f64,
        /// Its extinction coefficient.
        k: f64,
    },
}

impl Stack {
    /// The largest extinction coefficient of an incident medium, which must let light pass: at 1e-6 a wave of 500 nm goes on for
    /// 40 mm. It is then taken as 0.
    pub const INCIDENT_K: f64 = 1e-6;
    /// The most layers.
    pub const MAX_LAYERS: usize = 1000;

    /// A stack file where `text` is a path, one from standard input where it is `-`, a one-line stack where it has a `|` in it.
    ///
    /// # Errors
    /// Everything that is wrong with it, with its place.
    pub fn open(text: &str) -> Result<Self, StackError> {
        if text.contains('|') {
            Ok(Self::parse(text)?)
        } else if text != STANDARD_INPUT && !Path::new(text).exists() {
            Err(StackError::Nothing(text.chars().take(200).collect()))
        } else {
            Ok(Self::read(text)?)
        }
    }

    /// As [`Self::open`], of a stack file that can be trusted: the files that it names may lie outside of its folder.
    ///
    /// # Errors
    /// Everything that is wrong with it, with its place.
    pub fn open_trusted(text: &str) -> Result<Self, StackError> {
        if text.contains('|') || !Path::new(text).exists() {
            return Self::open(text);
        }
        Ok(file::read(text.as_ref(), true)?)
    }

    /// A stack written in one line: `air | silica 300nm | silicon`.
    ///
    /// The first medium is the one that the light comes from, the last the substrate, and what is between are layers with their
    /// thickness in nm, µm (um), mm or Å (angstrom), or in waves at a wavelength in nm: `TiO2 0.25@550` is a quarter-wave layer at
    /// normal incidence. Layers in brackets come as often as the power says: `air | (TiO2 60nm | SiO2 90nm)^8 | BK7`. Definitions
    /// before the stack name media and layers: `H=TiO2 0.25@550; L=SiO2 0.25@550; air | (HL)^8 2H | BK7`, where `2H` is twice as
    /// thick as `H`.
    ///
    /// A medium is a material's name, a number `1.5`, `1.5+0.1i`, or a file `.csv` or `.yml`. `air` is that of the library, n = 1.0003;
    /// `vacuum` is n = 1.
    ///
    /// # Errors
    /// What is wrong with the first part that is wrong.
    pub fn parse(line: &str) -> Result<Self, LineError> {
        line::parse(line)
    }

    /// A stack file: see [`StackDescription`]. The files that it names must lie in its folder.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Problems> {
        file::read(path.as_ref(), false)
    }

    /// The text of a stack file; `name` is what errors call it, and files are looked for from `folder` and must lie in it.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn from_toml(name: &str, text: &str, folder: impl Into<Folder>) -> Result<Self, Problems> {
        file::parse(name, text, &folder.into())
    }

    /// The incident medium must be transparent, the thicknesses finite and not negative; `line` and `file` have seen to it.
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

    /// The same stack where every medium goes on with its end values outside its data; a note names those whose data do not cover
    /// `used_nm`, from the shortest to the longest wavelength that it is used at. Faults within the data stay faults.
    #[must_use]
    pub fn clamped(mut self, used_nm: (f64, f64)) -> Self {
        let mut extended: Vec<String> = Vec::new();
        for medium in self.media() {
            let new = medium.shortfall(used_nm);
            extended.extend(new.filter(|new| !extended.contains(new)));
        }
        if !extended.is_empty() {
            let media = extended.join(", ");
            let note = format!("end values are used where data end: of {media}");
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

    /// The same stack, whose R and T are computed by this formula. Whether it is defined for the stack is looked at where it is
    /// sampled.
    #[must_use]
    pub fn with_model(self, model: Model) -> Self {
        Self { model, ..self }
    }

    /// By which formula R and T are computed.
    pub fn model(&self) -> Model {
        self.model
    }

    /// In the order of the stack.
    fn media(&self) -> impl Iterator<Item = &Medium> {
        let layers = self.layers.iter().map(|layer| &layer.medium);
        let incident = std::iter::once(&self.incident);
        incident.chain(layers).chain([&self.substrate])
    }

    /// What was assumed of the files that its media are read from, and where data end, a line each, none twice.
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

    /// Why `medium` cannot be the one that the light comes from; `None` when it can.
    pub(crate) fn fault_of_incident(medium: &Medium) -> Option<String> {
        let label = medium.label();
        medium.absorbs().then(|| {
            format!("{label} absorbs; the medium that light comes from must be transparent (k = 0)")
        })
    }

    /// The medium that the light comes from.
    pub fn incident(&self) -> &Medium {
        &self.incident
    }

    /// The layers, the first beside the incident medium.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// The medium behind the last layer.
    pub fn substrate(&self) -> &Medium {
        &self.substrate
    }

    /// The layers' thicknesses in their order, nm.
    pub fn thicknesses_nm(&self) -> &[f64] {
        &self.thicknesses_nm
    }

    /// As a stack file would say it.
    pub fn description(&self) -> StackDescription {
        StackDescription::of(self)
    }

    /// The stack in one line, for people.
    pub fn label(&self) -> String {
        self.labeled(None)
    }

    /// The stack in one line, for people, where one layer (counted from 0) has the thickness d.
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

    /// The stack at these wavelengths, nm.
    ///
    /// # Errors
    /// When a medium has no data at one of them, or the incident one absorbs.
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

    /// A medium's index at each wavelength.
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
            "ask for wavelengths within that range, or go on with the end values by --clamp"
        } else {
            "ask for wavelengths within that range; or go on with the end values by --clamp, or in the stack file by \
             index = { name = …, extrapolate = \"clamp\" }"
        }
    }
}

/// Whether two beams are defined for a stack at all its wavelengths.
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
            ["end values are used where data end: of rutile beyond 430 to 1530 nm"]
        );
        // A file that is written of it says the same.
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
