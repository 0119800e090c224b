//! Materials: from written spectra to their numbers.

use super::checks::Checks;
use super::checks::placed_size;
use super::cook;
use super::dielectric;
use super::layers::{Written, check_interference};
use super::lifted;
use super::spectrum_list::SpectrumList;
use super::strength::Radiator;
use crate::description::{self, ConductorModel, ConductorModelName, Cook1981, DiffuseReflectance};
use crate::limits;
use document::FieldPath;
use scene::{Material, Pattern};
use std::collections::BTreeMap;

/// Checks `[materials]`; they are numbered in the order of their names.
pub(crate) fn check_all(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    materials: &BTreeMap<String, description::Material>,
) -> Option<Vec<Material>> {
    let top = FieldPath::root().key("materials");
    let checked: Vec<_> = materials
        .iter()
        .map(|(name, material)| check(checks, spectra, &top.key(name), material))
        .collect();
    checked.into_iter().collect()
}

fn check(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    field: &FieldPath,
    material: &description::Material,
) -> Option<Material> {
    match material {
        description::Material::Diffuse { reflectance } => {
            let reflectance = pattern(checks, spectra, &field.key("reflectance"), reflectance)?;
            Some(Material::Diffuse { reflectance })
        }
        description::Material::Conductor { .. } => conductor(checks, spectra, field, material),
        description::Material::Dielectric { .. } => dielectric(checks, spectra, field, material),
        description::Material::Film {
            index,
            thickness_nm,
            layers,
            model,
            path_difference,
        } => {
            let written = Written {
                index: index.as_ref(),
                thickness_nm: thickness_nm.as_ref(),
                layers: layers.as_deref(),
            };
            let layers = written.check(checks, spectra, field)?;
            let asked = (*model, *path_difference);
            Some(Material::Film {
                transparent: layers.iter().all(|layer| spectra.is_black(layer.k)),
                interference: check_interference(checks, spectra, field, asked, &layers)?,
                layers,
            })
        }
        description::Material::Coated {
            substrate,
            index,
            thickness_nm,
            layers,
            finish,
        } => {
            let written = Written {
                index: index.as_ref(),
                thickness_nm: thickness_nm.as_ref(),
                layers: layers.as_deref(),
            };
            let substrate = spectra.index(checks, &field.key("substrate"), substrate);
            let layers = written.check(checks, spectra, field);
            let microsurface = finish.check(checks, field);
            let (n, k) = substrate?;
            Some(Material::Interface {
                n,
                k,
                layers: layers?,
                microsurface: microsurface.ok()?,
            })
        }
        description::Material::Emitter {
            emission,
            reflectance,
            ..
        } => {
            let emission =
                spectra.emission(checks, &field.key("emission"), emission, Radiator::Emitter);
            let reflectance = reflectance.as_ref().map(|reflectance| {
                spectra.reflectance(checks, &field.key("reflectance"), reflectance)
            });
            let reflectance = match reflectance {
                Some(reflectance) => Some(reflectance?).filter(|&id| !spectra.is_black(id)),
                None => None,
            };
            Some(Material::Emitter {
                emission: emission?,
                reflectance,
            })
        }
    }
}

/// A conductor, with microfacets or Cook's model.
fn conductor(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    field: &FieldPath,
    material: &description::Material,
) -> Option<Material> {
    let description::Material::Conductor {
        index,
        finish,
        model,
    } = material
    else {
        return None;
    };
    let index = spectra.index(checks, &field.key("index"), index);
    if let Some(model) = cook_model(model.as_ref()) {
        let surface = cook::Surface {
            index,
            finish: *finish,
        };
        return cook::check(checks, spectra, field, surface, &model).map(Material::Cook);
    }
    let microsurface = finish.check(checks, field);
    let (n, k) = index?;
    Some(Material::Interface {
        n,
        k,
        layers: Vec::new(),
        microsurface: microsurface.ok()?,
    })
}

/// A dielectric: an opaque body, or a coat over a base.
fn dielectric(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    field: &FieldPath,
    material: &description::Material,
) -> Option<Material> {
    let description::Material::Dielectric {
        index: written,
        finish,
        base,
    } = material
    else {
        return None;
    };
    let index = spectra.index(checks, &field.key("index"), written);
    let microsurface = finish.check(checks, field);
    let base = match base {
        Some(base) => Some(pattern(checks, spectra, &field.key("base"), base)?),
        None => None,
    };
    let surface = (index?, microsurface.ok()?);
    dielectric::check(checks, spectra, (field, written), surface, base)
}

/// The parameters of Cook's model, if it is chosen.
fn cook_model(model: Option<&ConductorModel>) -> Option<Cook1981> {
    match model? {
        ConductorModel::Named(ConductorModelName::Microfacets) => None,
        ConductorModel::Named(ConductorModelName::Cook1981) => Some(Cook1981::default()),
        ConductorModel::Cook { cook1981 } => Some((**cook1981).clone()),
    }
}

fn pattern(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    field: &FieldPath,
    written: &DiffuseReflectance,
) -> Option<Pattern> {
    match written {
        DiffuseReflectance::Uniform(reflectance) => spectra
            .reflectance(checks, field, reflectance)
            .map(Pattern::Uniform),
        DiffuseReflectance::Checker { checker, size } => {
            let squares = field.key("checker");
            let even = spectra.reflectance(checks, &squares.index(0), &checker[0]);
            let odd = spectra.reflectance(checks, &squares.index(1), &checker[1]);
            let size = checks.number(&field.key("size"), *size, &limits::LENGTH);
            Some(Pattern::Checker {
                even: even?,
                odd: odd?,
                size: size?,
            })
        }
        DiffuseReflectance::Texture { texture, size } => {
            let size = placed_size(checks, &field.key("size"), *size);
            let texels = lifted::picture(checks, &field.key("texture"), texture);
            Some(Pattern::Texture {
                texels: texels?,
                size: size?,
            })
        }
    }
}
