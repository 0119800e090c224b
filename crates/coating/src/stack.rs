//! A stack: two half spaces and the layers between them.

use crate::file::{self, StackDescription};
use crate::line::{self, EXAMPLE, LineError};
use crate::response::Sampled;
use miette::Diagnostic;
use optics::Complex64;
use scene::Problems;
use scene::description::{Extrapolate, Index};
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
        match &self.written {
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
        }
    }

    /// The same medium with its end values outside its data. What was written says so too, where it can: not for mixtures and
    /// reflectances, whose parts have ends of their own.
    fn clamped(mut self) -> Self {
        let Some((low, high)) = self.constants.range_nm() else {
            return self;
        };
        let label = self.label();
        let OpticalConstants { n, k } = OpticalConstants::clone(&self.constants);
        self.constants = Arc::new(OpticalConstants {
            n: n.clamped(),
            k: k.clamped(),
        });
        let note = format!("{label}: beyond {low} to {high} nm its end values are used");
        self.notes.push(note);
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

/// A stack: the incident medium, layers from there on, the substrate.
#[derive(Clone, Debug, PartialEq)]
pub struct Stack {
    incident: Medium,
    layers: Vec<Layer>,
    substrate: Medium,
    thicknesses_nm: Vec<f64>,
    /// Whether it is written in one line, for what errors advise.
    is_line: bool,
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

    /// A stack file where `text` is a path, a one-line stack where it has a `|` in it.
    ///
    /// # Errors
    /// Everything that is wrong with it, with its place.
    pub fn open(text: &str) -> Result<Self, StackError> {
        if text.contains('|') {
            Ok(Self::parse(text)?)
        } else if !Path::new(text).exists() {
            Err(StackError::Nothing(text.chars().take(200).collect()))
        } else {
            Ok(Self::read(text)?)
        }
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

    /// A stack file: see [`StackDescription`].
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Problems> {
        file::read(path.as_ref())
    }

    /// The text of a stack file; `name` is what errors call it, and tables are looked for from `directory`.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn from_toml(name: &str, text: &str, directory: &Path) -> Result<Self, Problems> {
        file::parse(name, text, directory)
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
        }
    }

    pub(crate) fn written_in_a_line(mut self) -> Self {
        self.is_line = true;
        self
    }

    /// The same stack where every medium goes on with its end values outside its data; its notes say of which. Faults within the
    /// data stay faults.
    #[must_use]
    pub fn clamped(self) -> Self {
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

    /// What was assumed of the files that its media are read from, a line each, none twice.
    pub fn notes(&self) -> Vec<&str> {
        let layers = self.layers.iter().map(|layer| &layer.medium);
        let media = [&self.incident, &self.substrate].into_iter().chain(layers);
        let mut notes: Vec<&str> = Vec::new();
        for note in media.flat_map(|medium| &medium.notes) {
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
        self.labelled(|layer| format!("{} nm", self.layers[layer].thickness_nm))
    }

    /// The stack in one line, for people, where one layer (counted from 0) has the thickness d.
    pub fn label_with_varied(&self, varied: usize) -> String {
        self.labelled(|layer| {
            if layer == varied {
                "d".to_owned()
            } else {
                format!("{} nm", self.layers[layer].thickness_nm)
            }
        })
    }

    fn labelled(&self, thickness: impl Fn(usize) -> String) -> String {
        let numbered = self.layers.iter().enumerate();
        let layers =
            numbered.map(|(i, layer)| format!("{} {}", layer.medium.label(), thickness(i)));
        let mut parts = vec![self.incident.label()];
        parts.extend(layers);
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
        Ok(Sampled::new(
            wavelengths_nm.to_vec(),
            incident.into_iter().map(|index| index.re).collect(),
            layers.collect::<Result<_, _>>()?,
            self.indices("the substrate", &self.substrate, wavelengths_nm)?,
        ))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_short_is_told_in_the_form_of_the_stack_and_can_be_clamped() {
        let line = Stack::parse("1 | Au 30nm | rutile").unwrap();
        let help = |stack: &Stack| {
            let error = stack.sampled(&[400.0]).unwrap_err();
            assert!(error.to_string().contains("430 to 1530 nm"), "{error}");
            error.help().unwrap().to_string()
        };
        assert!(help(&line).contains("--clamp") && !help(&line).contains('{'));
        let file = line.description().check(Path::new("")).unwrap();
        assert!(help(&file).contains("--clamp") && help(&file).contains("extrapolate"));
        let clamped = line.clamped();
        let index = |nm: f64| clamped.sampled(&[nm]).unwrap().substrate()[0];
        assert_eq!(index(400.0), index(430.0));
        let notes = clamped.notes().join("\n");
        assert!(
            notes.contains("rutile: beyond 430 to 1530 nm its end values are used"),
            "{notes}"
        );
        // A file that is written of it says the same.
        let again = clamped.description().check(Path::new("")).unwrap();
        assert_eq!(
            again.sampled(&[400.0]).unwrap().substrate()[0],
            index(400.0)
        );
    }

    #[test]
    fn a_fault_of_a_file_is_told_where_it_is_asked_for() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.yml");
        let rows = "        0.3 1.5 0\n        0.9 1.5 0\n        12 1.5 -0.3\n";
        let text = format!("DATA:\n  - type: tabulated nk\n    data: |\n{rows}");
        std::fs::write(&path, text).unwrap();
        let stack = Stack::parse(&format!("1 | {} 30nm | 1.5", path.display())).unwrap();
        assert!(stack.sampled(&[380.0, 780.0]).is_ok());
        for stack in [stack.clone(), stack.clamped()] {
            let said = stack.sampled(&[1000.0]).unwrap_err().to_string();
            for words in ["at 1000 nm", "layer 1", "line 6: found k -0.3 at 12000 nm"] {
                assert!(said.contains(words), "{said}");
            }
        }
    }
}
