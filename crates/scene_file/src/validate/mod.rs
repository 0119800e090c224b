//! From a description to a scene: checks every number, name and table, and reports all problems at once.

mod camera;
mod checks;
mod cook;
mod dielectric;
mod environment;
mod environment_picture;
mod layers;
mod lifted;
mod light;
mod light_groups;
mod material;
mod microsurface;
mod object;
mod picture_file;
mod polarization;
mod power;
mod settings;
mod sky;
mod spectrum_list;
mod strength;
mod thickness;

use crate::description::Description;
use crate::limits::{MAX_LIGHTS, MAX_MATERIALS, MAX_OBJECTS};
use checks::Checks;
use document::{FieldPath, Folder, Problem, ProblemKind};
use scene::{Scene, SceneParts};
use spectrum_list::SpectrumList;

/// Checks `description` and builds its scene; paths of files are relative to `folder`.
pub(crate) fn checked(description: &Description, folder: &Folder) -> Result<Scene, Vec<Problem>> {
    let mut checks = Checks::new(folder);
    check_counts(&mut checks, description);
    let settings = settings::check(&mut checks, &description.render);
    let camera = camera::check(&mut checks, &description.camera);
    polarization::check_is_traced(&mut checks, description);
    let mut spectra = SpectrumList::new(settings.grid, description.render.sampling);
    let materials = material::check_all(&mut checks, &mut spectra, &description.materials);
    let objects = object::check_all(&mut checks, &description.materials, &description.objects);
    let lights = light::check_all(&mut checks, &mut spectra, &description.lights);
    light::check_direct_light(&mut checks, description);
    let environment = environment::check(&mut checks, &mut spectra, description);
    let observer = spectra.observer(&mut checks);
    light_groups::check_names(&mut checks, description);
    let lit = (|| {
        let (environment, sun) = environment?;
        let parts = light_groups::Unlit {
            materials: materials?,
            objects: objects?,
            lights: light::with_sun(&mut checks, lights?, sun)?,
            environment,
        };
        let mut lit = light_groups::assign(&mut checks, spectra.lamps(), description, parts)?;
        let peak = |id| spectra.peak(id);
        power::spread(&mut checks, description, &mut lit.parts, peak);
        Some(lit)
    })();
    let parts = || Some((settings.settings?, camera?, observer?, lit?));
    let ((settings, camera, observer, lit), assumptions) = checks.finish(parts())?;
    let spectra = spectra.into_tables();
    let lights = lit.parts.lights.into_iter();
    Ok(Scene::new(SceneParts {
        estimates: prepare::estimates(&lit.parts.materials, &spectra, &settings.bands),
        settings,
        camera,
        spectra,
        observer,
        light_groups: lit.light_groups,
        materials: lit.parts.materials,
        objects: lit.parts.objects,
        lights: lights.map(|(light, _)| light).collect(),
        environment: lit.parts.environment,
        assumptions,
    }))
}

fn check_counts(checks: &mut Checks, description: &Description) {
    let counts = [
        ("objects", description.objects.len(), MAX_OBJECTS),
        ("materials", description.materials.len(), MAX_MATERIALS),
        ("lights", description.lights.len(), MAX_LIGHTS),
    ];
    for (what, count, most) in counts {
        if count > most {
            let message = format!("found {count} {what}; at most {most} are possible");
            let field = FieldPath::root().key(what);
            checks.report(Problem::new(ProblemKind::TooLarge, &field, message));
        }
    }
}
