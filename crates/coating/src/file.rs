//! Reading of stack files.

use crate::medium::{Layer, Medium};
use crate::stack::Stack;
use crate::thickness::optical_nm;
use document::{Checks, Document, FieldPath, Folder, Problem, ProblemKind, Problems, SourceFile};
use media::Index;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use spectra::{OpticalConstants, Spectrum};
use std::path::Path;

/// A stack as written in a file (TOML):
///
/// ```toml
/// incident = "air"
/// substrate = "silicon"
///
/// [[layer]]
/// index = "silica"
/// thickness_nm = 300
/// ```
///
/// Instead of `thickness_nm` a layer may have `optical_thickness = { waves = 0.25, at_nm = 550 }`, a quarter wave at normal incidence.
///
/// An index is written as in the materials of a scene: a number, `[n, k]`, a name, `{ name = "gold", extrapolate = "clamp" }`, an
/// inline table `{ nm = […], n = […], k = […] }`, which is interpolated linearly, or a file, relative to this one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StackDescription {
    /// The incident medium, which must be transparent. Air when absent.
    #[serde(default = "air")]
    pub incident: Index,
    /// The medium behind the last layer.
    pub substrate: Index,
    /// The layers; the first touches the incident medium.
    #[serde(default)]
    pub layer: Vec<LayerDescription>,
}

/// A layer as written in a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LayerDescription {
    /// Its material.
    pub index: Index,
    /// Thickness, nm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thickness_nm: Option<f64>,
    /// Thickness in waves at normal incidence, instead of `thickness_nm`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub optical_thickness: Option<OpticalThickness>,
}

/// A thickness in waves: n d = waves · λ with the real part n of the layer's index.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OpticalThickness {
    /// Number of waves; 0.25 is a quarter-wave layer.
    pub waves: f64,
    /// Vacuum wavelength, nm.
    pub at_nm: f64,
}

impl Document for StackDescription {
    const NEEDS: &'static str = "a stack needs at least `substrate = …`";
}

fn air() -> Index {
    Index::Name("air".to_owned())
}

/// Reads a medium, whose files are relative to `folder`; `vacuum` is n = 1.
pub(crate) fn medium(index: &Index, folder: &Folder) -> Result<Medium, Vec<Problem>> {
    if matches!(index, Index::Name(name) if name == "vacuum") {
        let constants = OpticalConstants {
            n: Spectrum::Constant(1.0),
            k: Spectrum::Constant(0.0),
        };
        return Ok(Medium::new(index.clone(), constants, Vec::new()));
    }
    let read = media::optical_constants(index, folder.clone());
    let (constants, notes) =
        read.map_err(|problems| problems.iter().cloned().collect::<Vec<_>>())?;
    Ok(Medium::new(index.clone(), constants, notes))
}

pub(crate) fn read(path: &Path, allows_outside: bool) -> Result<Stack, Problems> {
    let (description, mut source) = SourceFile::read(path)?;
    source.allow_outside(allows_outside);
    finish((description, source))
}

pub(crate) fn parse(name: &str, text: &str, folder: &Folder) -> Result<Stack, Problems> {
    finish(SourceFile::parse(name, text, folder)?)
}

fn finish((description, source): (StackDescription, SourceFile)) -> Result<Stack, Problems> {
    source.finish(description.check(source.folder().clone()))
}

impl StackDescription {
    pub(crate) fn of(stack: &Stack) -> Self {
        let layer = |layer: &Layer| LayerDescription {
            index: layer.medium.written().clone(),
            thickness_nm: Some(layer.thickness_nm),
            optical_thickness: None,
        };
        Self {
            incident: stack.incident().written().clone(),
            substrate: stack.substrate().written().clone(),
            layer: stack.layers().iter().map(layer).collect(),
        }
    }

    /// Checks the description and returns its stack. Files are relative to `folder` and must be inside it.
    ///
    /// # Errors
    /// Reports everything that is wrong; the fields of the problems say where.
    pub fn check(&self, folder: impl Into<Folder>) -> Result<Stack, Vec<Problem>> {
        let mut checks = StackChecks(Checks::new(&folder.into()));
        let root = FieldPath::root();
        let incident = checks.incident(&root.key("incident"), &self.incident);
        let substrate = checks.medium(&root.key("substrate"), &self.substrate);
        let layers = checks.layers(&root.key("layer"), &self.layer);
        let stack = || Some(Stack::new(incident?, layers?, substrate?));
        let (stack, _) = checks.0.finish(stack())?;
        Ok(stack)
    }
}

/// The checks of a stack. A check returns the value if it is valid.
struct StackChecks(Checks);

impl StackChecks {
    fn medium(&mut self, field: &FieldPath, written: &Index) -> Option<Medium> {
        match medium(written, self.0.folder()) {
            Ok(medium) => Some(medium),
            Err(problems) => {
                for problem in problems {
                    self.0.report(problem.within(field));
                }
                None
            }
        }
    }

    fn incident(&mut self, field: &FieldPath, written: &Index) -> Option<Medium> {
        let medium = self.medium(field, written)?;
        if let Some(fault) = Stack::fault_of_incident(&medium) {
            self.report(ProblemKind::OutOfRange, field, fault);
            return None;
        }
        Some(medium)
    }

    fn layers(&mut self, field: &FieldPath, written: &[LayerDescription]) -> Option<Vec<Layer>> {
        if written.len() > Stack::MAX_LAYERS {
            let (found, most) = (written.len(), Stack::MAX_LAYERS);
            let message = format!("found {found} layers; at most {most} are allowed");
            self.report(ProblemKind::TooLarge, field, message);
            return None;
        }
        let layers: Vec<_> = written
            .iter()
            .enumerate()
            .map(|(index, layer)| self.layer(&field.index(index), layer))
            .collect();
        layers.into_iter().collect()
    }

    fn layer(&mut self, field: &FieldPath, written: &LayerDescription) -> Option<Layer> {
        let medium = self.medium(&field.key("index"), &written.index);
        let thickness_nm = match (written.thickness_nm, &written.optical_thickness) {
            (Some(nm), None) => self.thickness(&field.key("thickness_nm"), nm),
            (None, Some(optical)) => {
                let medium = medium.as_ref()?;
                self.optical(&field.key("optical_thickness"), *optical, medium)
            }
            (both, _) => {
                let at = field.key("thickness_nm");
                let found = if both.is_some() {
                    "there is also `optical_thickness`"
                } else {
                    "is missing"
                };
                let message = format!(
                    "{found}; a layer has either `thickness_nm` or `optical_thickness = {{ waves = …, at_nm = … }}`"
                );
                self.report(ProblemKind::Inconsistent, &at, message);
                None
            }
        };
        Some(Layer {
            medium: medium?,
            thickness_nm: thickness_nm?,
        })
    }

    fn thickness(&mut self, at: &FieldPath, thickness_nm: f64) -> Option<f64> {
        self.0.number(at, thickness_nm, &Stack::THICKNESS_NM)
    }

    fn optical(
        &mut self,
        at: &FieldPath,
        written: OpticalThickness,
        medium: &Medium,
    ) -> Option<f64> {
        let OpticalThickness { waves, at_nm } = written;
        match optical_nm(waves, at_nm, medium.constants()) {
            Ok(nm) => Some(nm),
            Err((message, help)) => {
                let problem = Problem::new(ProblemKind::OutOfRange, at, message);
                self.0.report(problem.help(help));
                None
            }
        }
    }

    fn report(&mut self, kind: ProblemKind, field: &FieldPath, message: String) {
        self.0.report(Problem::new(kind, field, message));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Result<Stack, Problems> {
        Stack::from_toml("stack.toml", text, Path::new(""))
    }

    const SOUND: &str = r#"
        substrate = "silicon"
        [[layer]]
        index = { nm = [400, 700], n = [1.5, 1.4], k = [0, 0.2] }
        thickness_nm = 120
        [[layer]]
        index = [1.46, 0.0]
        thickness_nm = 0
    "#;

    #[test]
    fn a_file_is_a_stack() {
        let stack = parsed(SOUND).unwrap();
        assert_eq!(stack.incident().label(), "air");
        assert_eq!(stack.thicknesses_nm(), [120.0, 0.0]);
        let sampled = stack.sampled(&[400.0, 550.0]).unwrap();
        // The table is interpolated linearly.
        assert!((sampled.layers()[0][1] - optics::Complex64::new(1.45, 0.1)).norm() < 1e-14);
        let again = stack.description().check(Path::new("")).unwrap();
        assert_eq!(again, stack);
    }

    #[test]
    fn a_csv_file_is_looked_for_beside_the_stack() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(
            folder.path().join("mine.csv"),
            "nm,n,k\n300,1.5,0\n800,1.6,0.1\n",
        )
        .unwrap();
        let path = folder.path().join("stack.toml");
        std::fs::write(&path, "incident = 1\nsubstrate = { csv = \"mine.csv\" }\n").unwrap();
        let stack = Stack::read(&path).unwrap();
        assert_eq!(stack.substrate().label(), "mine.csv");
        assert!((stack.sampled(&[550.0]).unwrap().substrate()[0].re - 1.55).abs() < 1e-14);
    }

    #[test]
    fn data_that_do_not_reach_are_reported_with_their_range() {
        let error = parsed(SOUND).unwrap().sampled(&[500.0, 710.0]).unwrap_err();
        let said = error.to_string();
        for words in ["710 nm", "layer 1", "400 to 700 nm"] {
            assert!(said.contains(words), "{said}");
        }
    }

    #[test]
    fn a_thickness_may_be_in_waves() {
        let layer = |thickness: &str| {
            parsed(&format!(
                "substrate = 1.5\n[[layer]]\nindex = 1.25\n{thickness}\n"
            ))
        };
        let stack = layer("optical_thickness = { waves = 0.25, at_nm = 550 }").unwrap();
        // 0.25 · 550 / 1.25.
        assert_eq!(stack.thicknesses_nm(), [110.0]);
        for (written, words) in [
            ("", "layer[0].thickness_nm: is missing; a layer has either"),
            (
                "thickness_nm = 1\noptical_thickness = { waves = 1, at_nm = 500 }",
                "layer[0].thickness_nm: there is also `optical_thickness`",
            ),
            (
                "optical_thickness = { waves = -1, at_nm = 550 }",
                "layer[0].optical_thickness: a thickness of -1 waves at 550 nm, -440 nm",
            ),
            (
                "optical_thickness = { waves = 1, at_nm = 0 }",
                "layer[0].optical_thickness: a wavelength of 0 nm",
            ),
        ] {
            let said = format!("{:#}", layer(written).unwrap_err());
            assert!(said.contains(words), "{written}: {said}");
        }
    }

    /// All mistakes are reported at once, each with line and column.
    #[test]
    fn mistakes_are_reported_together() {
        let text = "incident = \"gold\"\nsubstrat = 1.5\n[[layer]]\nindex = \"silca\"\nthickness_nm = -3\n\
                    [[layer]]\nindex = { nm = [1, 2], n = [1.5] }\nthickness_nm = \"4\"\n";
        let said = format!("{:#}", parsed(text).unwrap_err());
        for line in [
            "stack.toml:1:12: incident: gold absorbs",
            "stack.toml:2:1: substrat: unknown field; did you mean `substrate`?",
            "stack.toml:4:9: layer[0].index: there is no material",
            "stack.toml:5:16: layer[0].thickness_nm: found -3; it must be from 0 to 100000 nm",
            "stack.toml:7:28: layer[1].index.n: found 1 values for 2 wavelengths",
            "stack.toml:8:16: layer[1].thickness_nm: found the string \"4\", expected a number",
        ] {
            assert!(said.contains(line), "{line} is not in\n{said}");
        }
        assert!(format!("{:#}", parsed(" ").unwrap_err()).contains("substrate"));
        assert!(
            format!("{:#}", parsed("incident = 1").unwrap_err()).contains("substrate: is missing")
        );
        assert!(format!("{:#}", parsed("substrate = ").unwrap_err()).contains("stack.toml:1"));
    }
}
