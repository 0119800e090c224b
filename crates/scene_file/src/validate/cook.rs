//! Conductors by Cook's model: from slopes and constants to weights.

use super::checks::Checks;
use super::microsurface::Reported;
use super::spectrum_list::SpectrumList;
use super::strength::Radiator;
use crate::description::{self, CookNormalization, Finish, Roughness, Slope};
use crate::limits;
use document::{FieldPath, Problem, ProblemKind, Shown};
use scene::{Cook1981, CookDistribution, CookFacets, DiffuseTerm, Emission, SpectrumId};
use std::f64::consts::PI;

/// The allowed error of the sum of the weights: three times 0.333 must pass as 1.
const WEIGHTS: f64 = 2e-3;

/// The fields of the material besides the model.
#[derive(Clone, Copy)]
pub(super) struct Surface {
    pub(super) index: Option<(SpectrumId, SpectrumId)>,
    pub(super) finish: Finish,
}

/// Checks the surface at `field` with the model at `field.model.cook1981`.
pub(super) fn check(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    field: &FieldPath,
    surface: Surface,
    written: &description::Cook1981,
) -> Option<Cook1981> {
    let own = field.key("model").key("cook1981");
    let roughness = check_roughness(checks, field, surface.finish);
    let slopes = roughness.and_then(|roughness| {
        check_slopes(checks, field, &own, roughness, written.slopes.as_deref())
    });
    let constant = check_constant(checks, &own, written);
    let shares = check_shares(checks, &own, written);
    let reflectance = check_diffuse(checks, spectra, &own, written);
    let distribution = match written.distribution {
        description::CookDistribution::Beckmann => CookDistribution::Beckmann,
        description::CookDistribution::Gaussian => CookDistribution::Gaussian,
    };
    let ((n, k), slopes, constant) = (surface.index?, slopes?, constant?);
    let ((specular, diffuse), reflectance) = (shares?, reflectance.ok()?);
    let facets = slopes.iter().map(|slope| {
        let constant = constant_of(distribution, written.normalization, constant, slope.m);
        CookFacets {
            slope: slope.m,
            weight: specular * slope.weight * constant,
            part: slope.weight,
        }
    });
    let facets: Vec<_> = facets.collect();
    let diffuse = reflectance.map(|reflectance| DiffuseTerm {
        fraction: diffuse,
        probability: diffuse / (specular + diffuse),
        reflectance,
    });
    let ambient = match &written.ambient {
        Some(ambient) => {
            let returned = (specular, (n, k), diffuse);
            Some(ambient_light(
                checks,
                spectra,
                &own.key("ambient"),
                ambient,
                returned,
            )?)
        }
        None => None,
    };
    let cook = Cook1981 {
        n,
        k,
        distribution,
        gain: gain(distribution, &facets),
        facets,
        diffuse,
        ambient,
    };
    check_gain(checks, &own.key("constant"), constant, cook.gain)?;
    Some(cook)
}

/// The ratio of reflected to incident light; see [`Cook1981::gain`].
fn gain(distribution: CookDistribution, facets: &[CookFacets]) -> f64 {
    let gain = |facets: &CookFacets| {
        let normalized = match distribution {
            CookDistribution::Gaussian => optics::gaussian_constant(facets.slope),
            CookDistribution::Beckmann => PI.recip(),
        };
        4.0 * facets.weight / normalized
    };
    facets.iter().map(gain).sum()
}

/// Checks that the light stays a finite number over the longest path with this constant of D₁.
fn check_gain(checks: &mut Checks, field: &FieldPath, constant: f64, gain: f64) -> Option<()> {
    if gain <= limits::MAX_COOK_GAIN {
        return Some(());
    }
    let message = format!(
        "found {}, with which the surface reflects {gain:.3e} times the incident light; at most {} times is possible, which is {:.3e}",
        Shown(constant),
        limits::MAX_COOK_GAIN,
        constant * limits::MAX_COOK_GAIN / gain
    );
    let help = "raise `render.exposure_ev` for a brighter picture";
    checks.report(Problem::new(ProblemKind::OutOfRange, field, message).help(help));
    None
}

/// The factor of D for one slope: 1 / π as printed, for D₁ times c; or 1/4, with D normalized to cover the surface once.
fn constant_of(
    distribution: CookDistribution,
    normalization: CookNormalization,
    printed: f64,
    slope: f64,
) -> f64 {
    match (normalization, distribution) {
        (CookNormalization::Printed, CookDistribution::Gaussian) => printed / PI,
        (CookNormalization::Printed, CookDistribution::Beckmann) => 1.0 / PI,
        (CookNormalization::Normalized, CookDistribution::Gaussian) => {
            0.25 * optics::gaussian_constant(slope)
        }
        (CookNormalization::Normalized, CookDistribution::Beckmann) => 0.25 / PI,
    }
}

/// Checks the roughness: the model has slopes that are the same in all directions, and its own distribution.
fn check_roughness(checks: &mut Checks, field: &FieldPath, finish: Finish) -> Option<f64> {
    let is_even = matches!(finish.roughness, Roughness::Even(_));
    let wrong = [
        ("distribution", finish.distribution.is_some()),
        ("brushed", finish.brushed.is_some()),
        ("roughness", !is_even && finish.brushed.is_none()),
    ];
    let mut is_sound = true;
    for (name, _) in wrong.iter().filter(|(_, is_wrong)| *is_wrong) {
        let message = format!(
            "cook1981 cannot use this `{name}`: its slopes are the same in all directions, and the model itself has a distribution"
        );
        let problem = Problem::new(ProblemKind::Inconsistent, &field.key(name), message);
        let help = "write one `roughness`, and model = { cook1981 = { distribution = \"beckmann\" } } or \"gaussian\"";
        checks.report(problem.help(help).involving(field.key("model")));
        is_sound = false;
    }
    match finish.roughness {
        _ if !is_sound => None,
        Roughness::Even(0.0) => Some(0.0),
        Roughness::Even(even) => checks.number(&field.key("roughness"), even, &limits::ROUGHNESS),
        Roughness::Brushed(_) => None,
    }
}

/// The slopes of the model, or the material's roughness as the only one.
fn check_slopes(
    checks: &mut Checks,
    material: &FieldPath,
    own: &FieldPath,
    roughness: f64,
    written: Option<&[Slope]>,
) -> Option<Vec<Slope>> {
    let field = own.key("slopes");
    let Some(slopes) = written else {
        if roughness > 0.0 {
            return Some(vec![Slope {
                m: roughness,
                weight: 1.0,
            }]);
        }
        let message = "cook1981 is for rough surfaces: give the material a `roughness`, or the model `slopes`";
        let help = "model = { cook1981 = { slopes = [{ m = 0.2, weight = 0.4 }, { m = 0.6, weight = 0.6 }] } }";
        let problem = Problem::new(ProblemKind::MissingField, material, message);
        checks.report(problem.help(help));
        return None;
    };
    if roughness > 0.0 {
        let message = format!(
            "found slopes and a roughness of {roughness}; the surface can have only one of them"
        );
        let problem = Problem::new(ProblemKind::Inconsistent, &field, message);
        checks.report(problem.involving(material.key("roughness")));
        return None;
    }
    if slopes.is_empty() || slopes.len() > limits::MAX_SLOPES {
        let message = format!(
            "found {} slopes; there must be from 1 to {}",
            slopes.len(),
            limits::MAX_SLOPES
        );
        checks.report(Problem::new(ProblemKind::OutOfRange, &field, message));
        return None;
    }
    check_list(checks, &field, slopes)
}

/// Checks slopes and that their weights sum to 1, and normalizes the weights.
fn check_list(checks: &mut Checks, field: &FieldPath, slopes: &[Slope]) -> Option<Vec<Slope>> {
    let mut sound = Vec::new();
    for (index, slope) in slopes.iter().enumerate() {
        let place = field.index(index);
        let m = checks.number(&place.key("m"), slope.m, &limits::ROUGHNESS);
        let weight = checks.number(&place.key("weight"), slope.weight, &limits::FRACTION);
        sound.extend(m.zip(weight).map(|(m, weight)| Slope { m, weight }));
    }
    if sound.len() < slopes.len() {
        return None;
    }
    let sum: f64 = sound.iter().map(|slope| slope.weight).sum();
    if (sum - 1.0).abs() > WEIGHTS {
        let message = format!("found weights that sum to {sum}; they must sum to 1");
        checks.report(Problem::new(ProblemKind::Inconsistent, field, message));
        return None;
    }
    for slope in &mut sound {
        slope.weight /= sum;
    }
    Some(sound)
}

/// Checks c of D₁, 1 when absent; the other forms have none.
fn check_constant(
    checks: &mut Checks,
    own: &FieldPath,
    written: &description::Cook1981,
) -> Option<f64> {
    let Some(constant) = written.constant else {
        return Some(1.0);
    };
    let field = own.key("constant");
    let is_printed = written.normalization == CookNormalization::Printed;
    if is_printed && written.distribution == description::CookDistribution::Gaussian {
        return checks.number(&field, constant, &limits::COOK_CONSTANT);
    }
    let message = "found a constant, but only D1 as printed has one";
    let problem = Problem::new(ProblemKind::Inconsistent, &field, message);
    let help = "leave it out, or write distribution = \"gaussian\" and normalization = \"printed\"";
    checks.report(problem.help(help));
    None
}

/// Checks s and d.
fn check_shares(
    checks: &mut Checks,
    own: &FieldPath,
    written: &description::Cook1981,
) -> Option<(f64, f64)> {
    let specular = written.specular.unwrap_or(1.0);
    let diffuse = written.diffuse.unwrap_or(0.0);
    let specular_field = own.key("specular");
    let specular = checks.number(&specular_field, specular, &limits::FRACTION);
    let diffuse = checks.number(&own.key("diffuse"), diffuse, &limits::FRACTION);
    let (specular, diffuse) = specular.zip(diffuse)?;
    // 0.7 + 0.3 may be slightly above 1.
    if specular + diffuse <= 1.0 + 1e-9 {
        return Some((specular, diffuse));
    }
    let message = format!(
        "found specular {specular} and diffuse {diffuse}, together {:.6}; they must be at most 1 together",
        specular + diffuse
    );
    let problem = Problem::new(ProblemKind::Inconsistent, &own.key("diffuse"), message);
    checks.report(problem.involving(specular_field));
    None
}

/// Checks ρ, which is required if the diffuse fraction is above 0.
fn check_diffuse(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    own: &FieldPath,
    written: &description::Cook1981,
) -> Result<Option<SpectrumId>, Reported> {
    let field = own.key("diffuse_reflectance");
    let is_diffuse = written.diffuse.is_some_and(|share| share > 0.0);
    match (&written.diffuse_reflectance, is_diffuse) {
        (Some(reflectance), true) => {
            let id = spectra.reflectance(checks, &field, reflectance);
            Ok(Some(id.ok_or(Reported)?))
        }
        (None, false) => Ok(None),
        (given, _) => {
            let (kind, message) = match given {
                Some(_) => (
                    ProblemKind::Inconsistent,
                    "found a diffuse reflectance, but the fraction `diffuse` is 0",
                ),
                None => (
                    ProblemKind::MissingField,
                    "is missing; a fraction `diffuse` above 0 needs it",
                ),
            };
            let problem = Problem::new(kind, &field, message);
            checks.report(problem.involving(own.key("diffuse")));
            Err(Reported)
        }
    }
}

/// Ia Ra with Ra = s F₀ + d ρ.
fn ambient_light(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    field: &FieldPath,
    written: &description::Emission,
    (specular, (n, k), diffuse): (f64, (SpectrumId, SpectrumId), Option<DiffuseTerm>),
) -> Option<Emission> {
    let light = spectra.emission(checks, field, written, Radiator::Ambient)?;
    let normal = spectra.combined([n, k], |[n, k]| {
        specular * optics::reflectance_unpolarized(optics::Complex64::new(n, k), 1.0)
    });
    let returned = match diffuse {
        Some(diffuse) => {
            let both = [normal, diffuse.reflectance];
            spectra.combined(both, |[facets, rho]| facets + diffuse.fraction * rho)
        }
        None => normal,
    };
    Some(Emission {
        spectrum: spectra.combined([light.spectrum, returned], |[light, part]| light * part),
        polarization: None,
        ..light
    })
}
