//! The WGSL modules.
//!
//! Declarations of WGSL may come in any order, so a shader is the concatenation of all modules, with the parts that depend on the
//! scene filled in. Everything that its entry point does not reach is removed before a driver sees it.

use crate::lists::ListForm;
use crate::specialize::specialize;
use crate::{DeviceError, Features};

/// One file of `shaders/`.
#[derive(Clone, Copy, Debug)]
pub struct Module {
    /// The file's path within `shaders/`, without its extension.
    pub name: &'static str,
    /// Its text.
    pub source: &'static str,
}

/// Name of the module that is generated for each scene: sizes of the arrays that hold a path and its radiance.
pub const LIMITS: &str = "limits";

/// All modules, by name.
pub const MODULES: &[Module] = include!(concat!(env!("OUT_DIR"), "/modules.rs"));

/// The maximum length of a path's record, and the number of light groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordLimits {
    /// Vertices of a path.
    pub vertices: u32,
    /// Films that all emitter samples of a path cross together.
    pub crossings: u32,
    /// Thicknesses of layers that vary over a surface, for all vertices and crossings together.
    pub thicknesses: u32,
    /// Light groups.
    pub light_groups: u32,
    /// Films at which a path is split, 1 where it is never split.
    pub splits: u32,
}

impl RecordLimits {
    /// The smallest value of each.
    pub const MIN: Self = Self {
        vertices: 1,
        crossings: 1,
        thicknesses: 1,
        light_groups: 1,
        splits: 1,
    };

    fn wgsl(self) -> String {
        format!(
            "const MAX_VERTICES: u32 = {}u;\nconst MAX_CROSSINGS: u32 = {}u;\nconst MAX_THICKNESSES: u32 = {}u;\n\
             const LIGHT_GROUPS: u32 = {}u;\nconst MAX_SPLITS: u32 = {}u;\nconst RECORDS_THICKNESSES: bool = {};\n",
            self.vertices,
            self.crossings,
            self.thicknesses,
            self.light_groups,
            self.splits,
            self.thicknesses > 1
        )
    }
}

/// The specialization of a shader for a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Specialization {
    /// Sizes of the record.
    pub limits: RecordLimits,
    /// The features of the scene; constants that are not named keep their declared values.
    pub features: Features,
    /// The forms of the lists of `shaders/bindings.wgsl`; lists that are not named are in storage buffers.
    pub forms: Vec<(&'static str, ListForm)>,
}

impl Specialization {
    /// Returns the specialization for any scene whose record fits these limits.
    pub fn general(limits: RecordLimits) -> Self {
        Self {
            limits,
            features: Features::default(),
            forms: Vec::new(),
        }
    }

    /// Returns the text of a module with its values filled in. No line is added or removed.
    fn fill_in(&self, module: &Module) -> String {
        let line = |line: &str| match module.name {
            "bindings" => ListForm::fill_in(&self.forms, line),
            _ => self.features.fill_in(line),
        };
        let lines = module.source.lines();
        let filled = lines.map(|text| line(text).unwrap_or_else(|| text.to_owned()));
        filled.map(|text| text + "\n").collect()
    }
}

/// A shader assembled from modules, with the origin of each line.
#[derive(Clone, Debug)]
pub struct Shader {
    text: String,
    /// First line (counted from 0) and name of each part.
    parts: Vec<(usize, String)>,
}

impl Shader {
    /// Assembles all modules, then `extra` (an entry point of a test, or nothing).
    pub fn assemble(made_for: &Specialization, extra: &str) -> Self {
        let mut shader = Self {
            text: String::new(),
            parts: Vec::new(),
        };
        shader.push(LIMITS, &made_for.limits.wgsl());
        for module in MODULES {
            let text = made_for.fill_in(module);
            shader.push(&format!("shaders/{}.wgsl", module.name), &text);
        }
        shader.push("(extra)", extra);
        shader
    }

    fn push(&mut self, name: &str, text: &str) {
        self.parts
            .push((self.text.lines().count(), name.to_owned()));
        self.text.push_str(text);
        if !self.text.ends_with('\n') {
            self.text.push('\n');
        }
    }

    /// Returns the whole text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the file and line (counted from 1) that a line (counted from 1) of [`Self::text`] comes from.
    pub fn origin_of_line(&self, line: usize) -> (&str, usize) {
        let index = line.saturating_sub(1);
        let part = self.parts.partition_point(|(first, _)| *first <= index);
        let (first, name) = &self.parts[part.saturating_sub(1)];
        (name, index - first + 1)
    }

    /// Parses and validates the whole text.
    ///
    /// # Errors
    /// The first error, with its file and line.
    pub fn parse(&self) -> Result<naga::Module, DeviceError> {
        let text = self.text();
        let module = naga::front::wgsl::parse_str(text)
            .map_err(|error| self.mistake(error.location(text), error.message()))?;
        let flags = naga::valid::ValidationFlags::all();
        naga::valid::Validator::new(flags, naga::valid::Capabilities::empty())
            .validate(&module)
            .map_err(|error| {
                let causes =
                    std::iter::successors(Some(error.as_inner() as &dyn std::error::Error), |e| {
                        e.source()
                    });
                let message = causes
                    .map(ToString::to_string)
                    .collect::<Vec<_>>()
                    .join(": ");
                self.mistake(error.location(text), &message)
            })?;
        Ok(module)
    }

    /// Returns the module that a driver gets: the entry point with everything that it reaches, and nothing else.
    ///
    /// # Errors
    /// As [`Self::parse`].
    pub fn specialized(&self, entry_point: &str) -> Result<naga::Module, DeviceError> {
        let mut module = self.parse()?;
        specialize(&mut module, entry_point);
        Ok(module)
    }

    fn mistake(&self, at: Option<naga::SourceLocation>, message: &str) -> DeviceError {
        DeviceError::Refused(match at {
            Some(at) => {
                let (file, line) = self.origin_of_line(at.line_number as usize);
                format!("{file}:{line}:{}: {message}", at.line_position)
            }
            None => message.to_owned(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_traced_back_to_its_file() {
        let made_for = Specialization::general(RecordLimits::MIN);
        let shader = Shader::assemble(&made_for, "fn extra() {}");
        let text: Vec<_> = shader.text().lines().collect();
        let line = text
            .iter()
            .position(|l| l.starts_with("fn reflectance_unpolarized"))
            .unwrap();
        let (file, in_file) = shader.origin_of_line(line + 1);
        assert_eq!(file, "shaders/fresnel.wgsl");
        let module = MODULES.iter().find(|m| m.name == "fresnel").unwrap();
        let source = module.source.lines().nth(in_file - 1).unwrap();
        assert_eq!(source, text[line]);
        assert_eq!(shader.origin_of_line(text.len()), ("(extra)", 1));
    }

    #[test]
    fn a_mistake_is_reported_with_its_file_and_line() {
        let made_for = Specialization::general(RecordLimits::MIN);
        for (extra, told) in [
            ("\nfn f() -> f32 { return 1u; }", "(extra):2:"),
            ("fn f() {\n\n oops; }", "(extra):3:"),
        ] {
            let shader = Shader::assemble(&made_for, extra);
            let error = shader.parse().unwrap_err().to_string();
            assert!(error.contains(told), "{error}");
        }
    }
}
