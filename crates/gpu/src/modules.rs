//! The WGSL modules.
//!
//! Declarations of WGSL may come in any order, so a shader is the concatenation of all modules, with the parts that depend on the
//! scene filled in. Everything that its entry point does not reach is removed before a driver sees it.

pub use crate::counts::{Counts, RecordLimits};
use crate::device_error::DeviceError;
use crate::features::Features;
use crate::layout;
use crate::layout::list_form::ListForm;
use crate::specialize::specialize;
use std::borrow::Cow;

/// One file of `shaders/`.
#[derive(Clone, Copy, Debug)]
pub struct Module {
    /// The file's path within `shaders/`, without its extension.
    pub name: &'static str,
    /// Its text.
    pub source: &'static str,
}

/// All modules, by name.
pub const MODULES: &[Module] = include!(concat!(env!("OUT_DIR"), "/modules.rs"));

/// The specialization of a shader for a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Specialization {
    /// Sizes of the record.
    pub limits: RecordLimits,
    /// Numbers of things in the scene.
    pub counts: Counts,
    /// The features of the scene.
    pub features: Features,
    /// The forms of the lists; lists that are not named are in storage buffers.
    pub forms: Vec<(&'static str, ListForm)>,
}

impl Specialization {
    /// Returns the specialization with all features, for tests and for shaders that render no scene.
    pub fn general(limits: RecordLimits) -> Self {
        Self {
            limits,
            counts: Counts::MIN,
            features: Features::all(),
            forms: Vec::new(),
        }
    }

    /// Returns the text of a module with its values filled in. It has as many lines as the module's file.
    fn fill_in(&self, module: &Module) -> Cow<'static, str> {
        match module.name {
            "features" => self.constants().into(),
            "bindings" => layout::bindings_wgsl(&self.forms).into(),
            _ => module.source.into(),
        }
    }

    /// Returns the module of constants that depend on the scene.
    fn constants(&self) -> String {
        let heading = layout::heading(
            "What a scene has. This file says that it has one of everything; a scene's own shader has the scene's values.\n//\n\
             // Code for features that the scene lacks is removed: a processor that runs eight or more paths in lockstep pays for every\n\
             // branch that any of them might take. Conditions depend on these constants, never on a constant element of a uniform\n\
             // buffer: llvmpipe treats the value that it finds there as a constant and recompiles the pipeline for each dispatch.",
            "features.rs and counts.rs",
        );
        let (features, counts) = (self.features.wgsl(), self.counts.wgsl());
        format!("{heading}\n{features}\n{counts}\n{}", self.limits.wgsl())
    }
}

/// Returns the names and texts of the modules whose files are generated.
pub fn generated() -> [(&'static str, String); 4] {
    let general = Specialization::general(RecordLimits::MIN);
    [
        ("bindings", layout::bindings_wgsl(&[])),
        ("features", general.constants()),
        ("layout", layout::wgsl()),
        ("records", layout::records_wgsl()),
    ]
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
