//! A stack: two half spaces and the layers between them.

use crate::file::{self, StackDescription};
use crate::line::{self, EXAMPLE, LineError};
use crate::response::Sampled;
use miette::Diagnostic;
use optics::Complex64;
use scene::Problems;
use scene::description::Index;
use spectra::OpticalConstants;
use std::path::Path;
use thiserror::Error;

/// A material as the stack's author wrote it, with its optical constants.
#[derive(Clone, Debug, PartialEq)]
pub struct Medium {
    written: Index,
    constants: OpticalConstants,
    notes: Vec<String>,
}

impl Medium {
    pub(crate) fn new(written: Index, constants: OpticalConstants, notes: Vec<String>) -> Self {
        Self {
            written,
            constants,
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
    #[diagnostic(help(
        "ask for wavelengths within that range; or go on with the end values, in a stack file by \
         index = {{ name = …, extrapolate = \"clamp\" }}"
    ))]
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
    /// thickness in nm or µm (um). A medium is a material's name, a number `1.5`, `1.5+0.1i`, or a file `.csv` or `.yml`. `air` is that of the library, n = 1.0003;
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
        let incident = read("the incident medium", &self.incident, wavelengths_nm)?;
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
            read(
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
            read("the substrate", &self.substrate, wavelengths_nm)?,
        ))
    }
}

/// A medium's index at each wavelength.
fn read(place: &str, medium: &Medium, nm: &[f64]) -> Result<Vec<Complex64>, SampleError> {
    let at = |&nm: &f64| {
        medium
            .constants
            .at(nm)
            .map_err(|gap| SampleError::OutOfRange {
                place: place.to_owned(),
                label: medium.label(),
                asked_nm: gap.nm,
                min_nm: gap.min_nm,
                max_nm: gap.max_nm,
            })
    };
    nm.iter().map(at).collect()
}
