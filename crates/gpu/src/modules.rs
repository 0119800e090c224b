//! The WGSL modules and what each of them needs.
//!
//! Declarations of WGSL may come in any order, so a shader is the concatenation of a module and all
//! that it requires, with what depends on the scene filled in. Tests prove that `requires` is true and minimal and that no module is
//! missing from the table.

use crate::lists::ListForm;
use crate::specialize::specialize;
use crate::{DeviceError, Features};

/// One file of `shaders/`.
#[derive(Clone, Copy, Debug)]
pub struct Module {
    /// The file's stem.
    pub name: &'static str,
    /// Its text.
    pub source: &'static str,
    /// Modules whose declarations it uses.
    pub requires: &'static [&'static str],
}

macro_rules! modules {
    ($($name:literal: [$($requires:literal),*];)*) => {
        &[$(Module {
            name: $name,
            source: include_str!(concat!("../../../shaders/", $name, ".wgsl")),
            requires: &[$($requires),*],
        }),*]
    };
}

/// Name of the module that is made for each scene: sizes of the arrays that hold a path and its light.
pub const LIMITS: &str = "limits";

/// All modules, from those that need nothing to the renderer.
pub const MODULES: &[Module] = modules! {
    "layout": [];
    "records": ["bindings"];
    "trig": [];
    "random": [];
    "sobol": ["random"];
    "complex": [];
    "sampling": ["trig"];
    "intersect": [];
    "fresnel": ["complex"];
    "phase": ["complex", "trig"];
    "film": ["complex", "phase", "trig"];
    "two_beam": ["film", "trig"];
    "stack": ["complex", "phase", "trig"];
    "microfacet": ["trig"];
    "gaussian": ["microfacet", "trig"];
    "microsurface": ["features", "layout", "trig"];
    "bindings": ["layout"];
    "features": [];
    "numbers": ["bindings", "layout"];
    "texels": ["bindings", "layout"];
    "spectrum": ["bindings", "features"];
    "lifting": ["bindings", "spectrum"];
    "camera": ["bindings", "features", "layout", "numbers", "trig"];
    "noise": ["features", "layout", "random", "records"];
    "picture": ["features", "layout", "records", "texels", "trig"];
    "thickness": ["features", "layout", "noise", "numbers", "picture", "records", "trig"];
    "surface": ["camera", "features", "layout", "records", "sampling"];
    "hit": ["camera", "features", "intersect", "layout", "records"];
    "environment_picture": ["numbers", "picture", "records", "texels", "trig"];
    "environment": ["bindings", "environment_picture", "features", "layout", "numbers", "records", "sampling", "trig"];
    "light": ["environment", "features", "layout", "records", "sampling", "trig"];
    "light_choice": ["bindings", "environment_picture", "features", "layout", "light", "records", "sampling", "trig"];
    "record": ["features", "layout", "limits"];
    "path_state": ["bindings", "camera", "features", "random", "sobol", "surface"];
    "layers": [
        "bsdf/lobes", "features", "film", "layout", "limits", "record", "records", "spectrum", "stack", "surface", "thickness",
        "two_beam"
    ];
    "bsdf/lobes": ["spectrum"];
    "bsdf/facets": ["bsdf/lobes", "features", "layout", "microsurface", "numbers", "records", "sampling", "trig"];
    "bsdf/diffuse": ["bsdf/lobes", "features", "layout", "lifting", "picture", "record", "records", "sampling", "texels", "trig"];
    "bsdf/interface": [
        "bsdf/facets", "bsdf/lobes", "features", "fresnel", "layers", "layout", "limits", "record", "records", "spectrum", "stack",
        "surface"
    ];
    "bsdf/coated": [
        "bsdf/diffuse", "bsdf/facets", "bsdf/interface", "bsdf/lobes", "features", "fresnel", "layout", "record", "records", "sampling",
        "spectrum", "surface", "trig"
    ];
    "bsdf/cook": [
        "bsdf/lobes", "features", "fresnel", "gaussian", "layout", "microfacet", "numbers", "record", "records", "sampling", "spectrum",
        "trig"
    ];
    "bsdf/bsdf": [
        "bsdf/coated", "bsdf/cook", "bsdf/diffuse", "bsdf/interface", "bsdf/lobes", "features", "layout", "record", "records", "surface"
    ];
    "emitter_sampling": [
        "bsdf/lobes", "camera", "environment_picture", "features", "hit", "layers", "layout", "light", "light_choice", "path_state",
        "record", "records", "surface"
    ];
    "split": ["features", "layout", "limits", "numbers", "path_state", "record", "records"];
    "path": [
        "bindings", "bsdf/bsdf", "bsdf/lobes", "camera", "emitter_sampling", "environment", "environment_picture", "features", "hit",
        "layers", "layout", "limits", "path_state", "record", "records", "spectrum", "split", "surface"
    ];
    "evaluate": [
        "bindings", "bsdf/bsdf", "bsdf/lobes", "features", "layers", "layout", "lifting", "limits", "record", "spectrum", "texels"
    ];
    "stack_batch": ["complex", "layout", "stack"];
    "render": ["bindings", "evaluate", "features", "layout", "limits", "path", "path_state", "spectrum"];
};

/// How long a path's record may become, and how many kinds of light it brings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordLimits {
    /// Vertices of a path.
    pub vertices: u32,
    /// Films that all connections of a path pass through together.
    pub crossings: u32,
    /// Thicknesses of layers that vary over a surface, of all vertices and crossings together.
    pub thicknesses: u32,
    /// Light groups.
    pub light_groups: u32,
    /// Films at which a path is split, 1 where there are none.
    pub splits: u32,
}

impl RecordLimits {
    /// The least of each.
    pub const LEAST: Self = Self {
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

/// What a shader is made for.
#[derive(Clone, Debug, PartialEq)]
pub struct Specialization {
    /// Sizes of the record.
    pub limits: RecordLimits,
    /// What the scene has; what is not named is as `shaders/features.wgsl` says.
    pub features: Features,
    /// The forms of the lists of `shaders/bindings.wgsl`; those not named stand in storage buffers.
    pub forms: Vec<(&'static str, ListForm)>,
}

impl Specialization {
    /// For any scene whose record is so long.
    pub fn general(limits: RecordLimits) -> Self {
        Self {
            limits,
            features: Features::default(),
            forms: Vec::new(),
        }
    }

    /// The text of a module, filled in. No line is added or taken away.
    fn fill_in(&self, module: &Module) -> String {
        let line = |line: &str| match module.name {
            "features" => self.features.fill_in(line),
            "bindings" => ListForm::fill_in(&self.forms, line),
            _ => None,
        };
        let lines = module.source.lines();
        let filled = lines.map(|text| line(text).unwrap_or_else(|| text.to_owned()));
        filled.map(|text| text + "\n").collect()
    }
}

/// A shader put together from modules, which remembers where each line came from.
#[derive(Clone, Debug)]
pub struct Shader {
    text: String,
    /// First line (counted from 0) and name of each part.
    parts: Vec<(usize, String)>,
}

impl Shader {
    /// The modules in `roots` and all that they require, each once, then `extra` (an entry point of a test, or nothing).
    ///
    /// # Panics
    /// When a module is not in the table: that is a fault of the program, found by any test.
    pub fn assemble(roots: &[&str], made_for: &Specialization, extra: &str) -> Self {
        let mut names = Vec::new();
        for root in roots {
            collect(root, &mut names);
        }
        let mut shader = Self {
            text: String::new(),
            parts: Vec::new(),
        };
        for name in names {
            if name == LIMITS {
                shader.push(LIMITS, &made_for.limits.wgsl());
            } else {
                let text = made_for.fill_in(module(name));
                shader.push(&format!("shaders/{name}.wgsl"), &text);
            }
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

    /// The whole text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The file and line (counted from 1) that a line (counted from 1) of [`Self::text`] comes from.
    pub fn origin_of_line(&self, line: usize) -> (&str, usize) {
        let index = line.saturating_sub(1);
        let part = self.parts.partition_point(|(first, _)| *first <= index);
        let (first, name) = &self.parts[part.saturating_sub(1)];
        (name, index - first + 1)
    }

    /// The whole text as a valid module.
    ///
    /// # Errors
    /// The first mistake, with its file and line.
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

    /// What a driver gets: the entry point with what it reaches, and nothing else.
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

/// Looks a module up.
fn module(name: &str) -> &'static Module {
    MODULES
        .iter()
        .find(|module| module.name == name)
        .unwrap_or_else(|| panic!("no module {name} in the table"))
}

/// Adds what `name` requires, then `name`.
fn collect<'a>(name: &'a str, names: &mut Vec<&'a str>) {
    if names.contains(&name) {
        return;
    }
    if name != LIMITS {
        for required in module(name).requires {
            collect(required, names);
        }
    }
    names.push(name);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_traced_back_to_its_file() {
        let made_for = Specialization::general(RecordLimits::LEAST);
        let shader = Shader::assemble(&["fresnel"], &made_for, "fn extra() {}");
        let text: Vec<_> = shader.text().lines().collect();
        let line = text
            .iter()
            .position(|l| l.starts_with("fn reflectance_unpolarised"))
            .unwrap();
        let (file, in_file) = shader.origin_of_line(line + 1);
        assert_eq!(file, "shaders/fresnel.wgsl");
        let source = module("fresnel").source.lines().nth(in_file - 1).unwrap();
        assert_eq!(source, text[line]);
        assert_eq!(shader.origin_of_line(text.len()), ("(extra)", 1));
    }

    #[test]
    fn a_mistake_is_reported_with_its_file_and_line() {
        let made_for = Specialization::general(RecordLimits::LEAST);
        for (extra, told) in [
            ("\nfn f() -> f32 { return 1u; }", "(extra):2:"),
            ("fn f() {\n\n oops; }", "(extra):3:"),
        ] {
            let shader = Shader::assemble(&["fresnel"], &made_for, extra);
            let error = shader.parse().unwrap_err().to_string();
            assert!(error.contains(told), "{error}");
        }
    }
}
