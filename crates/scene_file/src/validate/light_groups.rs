//! Light groups: which emitters are kept apart.

use super::checks::Checks;
use super::light::Named;
use super::spectrum_list::Lamp;
use crate::description::{self, Description, LightGroups};
use crate::limits::MAX_LIGHT_GROUPS;
use document::{FieldPath, Problem, ProblemKind};
use scene::{Emission, Environment, LightGroupId, Material, Object};
use spectra::LightGroup;

/// The parts of a scene that have emissions. In place of its light group, each emission has the number of its lamp.
pub(crate) struct Unlit<'a> {
    pub(crate) materials: Vec<Material>,
    pub(crate) objects: Vec<Object>,
    pub(crate) lights: Vec<Named<'a>>,
    pub(crate) environment: Environment,
}

/// The same parts with light groups assigned.
pub(crate) struct Lit<'a> {
    pub(crate) parts: Unlit<'a>,
    pub(crate) light_groups: Vec<LightGroup>,
}

/// Checks the names of light groups.
pub(crate) fn check_names(checks: &mut Checks, description: &Description) {
    let root = FieldPath::root();
    let of_materials = description.materials.iter().map(|(name, material)| {
        let field = root.key("materials").key(name);
        (field, name_of_material(material))
    });
    let environment = description.environment.as_ref();
    let of_environment = (root.key("environment"), name_of_environment(environment));
    let of_lights = description
        .lights
        .iter()
        .enumerate()
        .map(|(index, light)| (root.key("lights").index(index), light.light_group()));
    for (field, name) in of_materials.chain(of_lights).chain([of_environment]) {
        if let Some(name) = name {
            check_name(checks, &field.key("light_group"), name);
        }
    }
    if let Some(description::Environment::Sky {
        sun_light_group: Some(name),
        ..
    }) = environment
    {
        check_name(
            checks,
            &root.key("environment").key("sun_light_group"),
            name,
        );
    }
}

fn name_of_material(material: &description::Material) -> Option<&str> {
    match material {
        description::Material::Emitter { light_group, .. } => light_group.as_deref(),
        _ => None,
    }
}

fn name_of_environment(environment: Option<&description::Environment>) -> Option<&str> {
    match environment? {
        description::Environment::Constant { light_group, .. }
        | description::Environment::Image { light_group, .. }
        | description::Environment::Sky { light_group, .. }
        | description::Environment::Gradient { light_group, .. } => light_group.as_deref(),
    }
}

fn check_name(checks: &mut Checks, field: &FieldPath, name: &str) {
    let short: String = name.chars().take(64).collect();
    if LightGroup::is_name(name) {
        return;
    }
    let message = format!("{short:?} cannot be the name of a light group");
    let help = format!(
        "write 1 to {} ASCII letters, digits, `_` or `-`, such as \"key\"; S0 to S3, T and pellicle have other meanings \
         in image files",
        LightGroup::MAX_NAME
    );
    checks.report(Problem::new(ProblemKind::OutOfRange, field, message).help(help));
}

/// Assigns a light group to every emission. Materials that no object has, and emissions of 0, make no group.
pub(crate) fn assign<'a>(
    checks: &mut Checks,
    lamps: &[Lamp],
    description: &Description,
    mut parts: Unlit<'a>,
) -> Option<Lit<'a>> {
    let mut lights = lights(description, &mut parts);
    let emissions: Vec<(&Lamp, Option<&str>)> = lights
        .iter()
        .map(|(light, name)| (&lamps[light.light_group.index()], *name))
        .collect();
    let single = || {
        let of_all: Vec<_> = emissions
            .iter()
            .map(|(lamp, _)| (*lamp, Some("all")))
            .collect();
        grouped(&of_all)
    };
    let is_named = emissions.iter().any(|(_, name)| name.is_some());
    let found = match description.render.light_groups {
        LightGroups::Single => single(),
        LightGroups::BySpectrum if is_named => grouped(&emissions),
        LightGroups::BySpectrum => grouped(&emissions).or_else(single),
    };
    let Some((mut light_groups, ids)) = found else {
        report_too_many(checks);
        return None;
    };
    for ((light, _), id) in lights.iter_mut().zip(ids) {
        light.light_group = id;
    }
    if light_groups.is_empty() {
        light_groups.push(LightGroup::unknown());
    }
    Some(Lit {
        parts,
        light_groups,
    })
}

/// The light groups of lamps, with their written names if any, and the group of each lamp; `None` if there are too many.
fn grouped(emissions: &[(&Lamp, Option<&str>)]) -> Option<(Vec<LightGroup>, Vec<LightGroupId>)> {
    let mut list = List::default();
    let mut ids = vec![LightGroupId::new(0); emissions.len()];
    let emitting = || (0..).zip(emissions).filter(|(_, (lamp, _))| lamp.shines);
    // Written names come first, and the others avoid them.
    for (index, &(lamp, name)) in emitting() {
        if let Some(name) = name {
            ids[index] = list.named(name, lamp)?;
        }
    }
    for (index, &(lamp, name)) in emitting() {
        if name.is_none() {
            ids[index] = list.by_spectrum(lamp)?;
        }
    }
    Some((list.groups, ids))
}

fn report_too_many(checks: &mut Checks) {
    let message = format!(
        "found more than {MAX_LIGHT_GROUPS} light groups; at most {MAX_LIGHT_GROUPS} are possible"
    );
    let field = FieldPath::root().key("render").key("light_groups");
    let help =
        "give several emitters a common `light_group`, or write `render.light_groups = \"single\"`";
    checks.report(Problem::new(ProblemKind::TooLarge, &field, message).help(help));
}

/// The emissions of objects, lights and environment, each with the written name of its light group, if any.
fn lights<'a>(
    description: &'a Description,
    parts: &'a mut Unlit<'_>,
) -> Vec<(&'a mut Emission, Option<&'a str>)> {
    let mut is_used = vec![false; parts.materials.len()];
    for object in &parts.objects {
        is_used[object.material.index()] = true;
    }
    // Materials are numbered in the order of their names.
    let written = description.materials.values().map(name_of_material);
    let materials = parts.materials.iter_mut().zip(written).zip(is_used);
    let mut lights: Vec<_> = materials
        .filter_map(|((material, name), is_used)| {
            let emission = material.emission_mut()?;
            if is_used {
                return Some((emission, name));
            }
            emission.light_group = LightGroupId::new(0);
            None
        })
        .collect();
    let of_lights = parts.lights.iter_mut();
    lights.extend(of_lights.map(|(light, name)| (&mut light.emission, *name)));
    let name = name_of_environment(description.environment.as_ref());
    match &mut parts.environment {
        Environment::Constant(everywhere) => lights.push((everywhere, name)),
        Environment::Picture { emission, .. } => lights.push((emission, name)),
        Environment::Gradient {
            zenith,
            horizon,
            ground,
        } => lights.extend([zenith, horizon, ground].map(|part| (part, name))),
    }
    lights
}

/// The light groups so far.
#[derive(Default)]
struct List {
    groups: Vec<LightGroup>,
    /// How many of them have a written name.
    written: usize,
}

impl List {
    /// The group of this name, whose lamp becomes `None` if its lamps differ; `None` if there are too many groups.
    fn named(&mut self, name: &str, lamp: &Lamp) -> Option<LightGroupId> {
        let position = self.groups.iter().position(|group| group.name == name);
        if let Some(position) = position {
            let group = &mut self.groups[position];
            group.lamp = group.lamp.take().filter(|known| *known == lamp.spectrum);
            return Some(LightGroupId::new(position));
        }
        self.written += 1;
        self.add(name.to_owned(), lamp)
    }

    /// The group of all emissions without a name that have this lamp; `None` if there are too many groups.
    fn by_spectrum(&mut self, lamp: &Lamp) -> Option<LightGroupId> {
        let others = &self.groups[self.written..];
        let position = others
            .iter()
            .position(|group| group.lamp.as_ref() == Some(&lamp.spectrum));
        match position {
            Some(position) => Some(LightGroupId::new(self.written + position)),
            None => self.add(self.free_name(&lamp.name), lamp),
        }
    }

    fn add(&mut self, name: String, lamp: &Lamp) -> Option<LightGroupId> {
        if self.groups.len() == MAX_LIGHT_GROUPS {
            return None;
        }
        let id = LightGroupId::new(self.groups.len());
        let lamp = Some(lamp.spectrum.clone());
        self.groups.push(LightGroup { name, lamp });
        Some(id)
    }

    /// A free name derived from a lamp's name: `D65`, then `D65_2`.
    fn free_name(&self, like: &str) -> String {
        let letters = like.bytes().map(|byte| match byte {
            byte if LightGroup::is_in_names(byte) => char::from(byte),
            _ => '_',
        });
        // Leaves room for a number.
        let mut stem: String = letters.take(LightGroup::MAX_NAME - 4).collect();
        if !LightGroup::is_name(&stem) {
            "light".clone_into(&mut stem);
        }
        let is_free = |name: &String| self.groups.iter().all(|group| group.name != *name);
        let numbered = (2..).map(|number| format!("{stem}_{number}"));
        let mut names = std::iter::once(stem.clone()).chain(numbered);
        names.find(is_free).unwrap_or(stem)
    }
}
