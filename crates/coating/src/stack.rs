//! Stacks: two half spaces and the layers between them.

use crate::label;
use crate::medium::{INCIDENT_K, Layer, Medium};
use crate::model::{self, Model};
use crate::response::Sampled;
use crate::thickness::THICKNESS_NM;
use document::Range;
use miette::Diagnostic;
use optics::Complex64;
use spectra::OutOfRange;
use thiserror::Error;

/// Why an incident medium that absorbs is refused: the Poynting vector has a term of both waves, which is no part of either
/// (Macleod, Thin-Film Optical Filters, chapter 2).
const WHY_TRANSPARENT: &str = "in a medium that absorbs, incident and reflected light carry no separate powers, so R and T are not defined";

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
    #[error(
        "at {nm} nm the incident medium, {label}, has k = {k}; it must be transparent (k = 0), since {}",
        WHY_TRANSPARENT
    )]
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
    pub const INCIDENT_K: f64 = INCIDENT_K;
    /// Maximum number of layers.
    pub const MAX_LAYERS: usize = 1000;
    /// Thickness of a layer.
    pub const THICKNESS_NM: Range = THICKNESS_NM;

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
        let of_media = self.media().flat_map(Medium::notes);
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
        medium.absorbs().then(|| {
            format!(
                "{label} absorbs; the incident medium must be transparent (k = 0), since {WHY_TRANSPARENT}"
            )
        })
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
        let at = |&nm: &f64| medium.constants().at(nm);
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
    use std::path::Path;

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
