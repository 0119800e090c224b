//! The environment: from `[environment]` to emissions.

use super::checks::Checks;
use super::environment_picture::{self, Sphere};
use super::light::Named;
use super::sky::Sky;
use super::spectrum_list::SpectrumList;
use super::strength::Radiator;
use crate::description;
use crate::description::{Description, EmissionSpectrum, Extrapolate, Polarization, Strength};
use crate::limits;
use document::{FieldPath, Problem, ProblemKind, Shown};
use scene::Sampled;
use scene::{DirectLight, Emission, Environment, Light, PictureSpectra};
use std::path::Path;
use std::sync::Arc;

/// Checks `[environment]`; it is black when absent. A sky may come with its sun as a light.
pub(crate) fn check<'a>(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    description: &'a Description,
) -> Option<(Environment, Option<Named<'a>>)> {
    let environment = description.environment.as_ref();
    let sampled = match description.render.direct_light {
        DirectLight::Emitters => Sampled::All,
        DirectLight::Both | DirectLight::Bsdf => Sampled::Excess,
    };
    let top = FieldPath::root().key("environment");
    let radiator = match environment {
        Some(description::Environment::Gradient { .. }) => Radiator::PartOfEnvironment,
        _ => Radiator::Environment,
    };
    let mut emission =
        |name: &str, emission| spectra.emission(checks, &top.key(name), emission, radiator);
    let mut light = None;
    let environment = match environment {
        None => {
            let black = description::Emission {
                spectrum: description::EmissionSpectrum::Constant { constant: 0.0 },
                strength: description::Strength::scale(0.0),
                polarization: None,
            };
            emission("emission", &black).map(Environment::Constant)
        }
        Some(description::Environment::Constant {
            emission: written, ..
        }) => emission("emission", written).map(Environment::Constant),
        Some(description::Environment::Sky {
            sun_elevation_deg,
            sun_azimuth_deg,
            turbidity,
            ground,
            scale,
            sun,
            polarization_degree,
            light_group,
            sun_light_group,
        }) => {
            let sky = Sky {
                sun_elevation_deg: *sun_elevation_deg,
                sun_azimuth_deg: *sun_azimuth_deg,
                turbidity: *turbidity,
                ground,
                polarization_degree: polarization_degree.unwrap_or_default(),
            };
            let (sky, sunlight) = check_sky(checks, spectra, &sky, (*scale, *sun, sampled))?;
            let name = sun_light_group.as_deref().or(light_group.as_deref());
            light = sunlight.map(|sunlight| (sunlight, name));
            Some(sky)
        }
        Some(description::Environment::Image {
            image,
            layer,
            scale,
            illuminant,
            rotation_deg,
            polarization,
            ..
        }) => {
            let written = Image {
                file: image,
                layer: layer.as_deref(),
                scale: *scale,
                illuminant: illuminant.as_deref(),
                rotation_deg: *rotation_deg,
                polarization: *polarization,
            };
            written.check(checks, spectra, sampled)
        }
        Some(description::Environment::Gradient {
            zenith,
            horizon,
            ground,
            ..
        }) => {
            let zenith = emission("zenith", zenith);
            let horizon = emission("horizon", horizon);
            let ground = match ground {
                Some(ground) => emission("ground", ground),
                None => horizon,
            };
            Some(Environment::Gradient {
                zenith: zenith?,
                horizon: horizon?,
                ground: ground?,
            })
        }
    };
    Some((environment?, light))
}

/// Checks a sky, and adds its sun as a light if `has_sun`.
fn check_sky(
    checks: &mut Checks,
    spectra: &mut SpectrumList,
    sky: &Sky<'_>,
    (scale, has_sun, sampled): (f64, bool, Sampled),
) -> Option<(Environment, Option<Light>)> {
    let top = FieldPath::root().key("environment");
    let checked = sky.check(checks, spectra);
    let factor = times(EmissionSpectrum::Constant { constant: 1.0 }, scale);
    let emission = spectra.emission(checks, &top, &factor, Radiator::Environment)?;
    let checked = checked?;
    let emission = Emission {
        polarization: checked.polarization,
        ..emission
    };
    let picture = Arc::new(checked.sphere.turned(-sky.sun_azimuth_deg, sampled));
    let sky = Environment::Picture { emission, picture };
    if !has_sun {
        return Some((sky, None));
    }
    let sunlight = ("sun".to_owned(), Some(checked.sunlight));
    let strength = (&factor.strength, Radiator::Environment);
    let sun = Light {
        shape: checked.disk,
        emission: spectra.emission_of(checks, &top, sunlight, strength)?,
    };
    Some((sky, Some(sun)))
}

/// A spectrum times a factor.
fn times(spectrum: EmissionSpectrum, scale: f64) -> description::Emission {
    description::Emission {
        spectrum,
        strength: Strength {
            scale: Some(scale),
            ..Strength::default()
        },
        polarization: None,
    }
}

/// A picture of all directions as written in a scene file.
struct Image<'a> {
    file: &'a Path,
    layer: Option<&'a str>,
    scale: f64,
    illuminant: Option<&'a str>,
    rotation_deg: f64,
    polarization: Option<Polarization>,
}

impl Image<'_> {
    fn check(
        &self,
        checks: &mut Checks,
        spectra: &mut SpectrumList,
        sampled: Sampled,
    ) -> Option<Environment> {
        let top = FieldPath::root().key("environment");
        let turn = checks.number(
            &top.key("rotation_deg"),
            self.rotation_deg,
            &limits::ROTATION_DEG,
        );
        let file = (self.file, self.layer);
        let sphere = environment_picture::read(checks, &top.key("image"), file, spectra.grid());
        let is_spectral = sphere
            .as_ref()
            .is_some_and(|s| s.spectra == PictureSpectra::Bands);
        let lamp = if is_spectral {
            EmissionSpectrum::Constant { constant: 1.0 }
        } else {
            EmissionSpectrum::Illuminant {
                illuminant: self.illuminant.unwrap_or("D65").to_owned(),
                extrapolate: Extrapolate::Error,
            }
        };
        let factor = description::Emission {
            polarization: self.polarization,
            ..times(lamp, self.scale)
        };
        let emission = spectra.emission(checks, &top, &factor, Radiator::Environment);
        let (sphere, emission) = (sphere?, emission?);
        self.check_brightest(
            checks,
            &sphere,
            emission.scale * spectra.peak(emission.spectrum),
        )?;
        if is_spectral && self.illuminant.is_some() {
            let message = "found an illuminant for a picture that has spectra of its own; leave out `illuminant`";
            let field = top.key("illuminant");
            let problem = Problem::new(ProblemKind::Inconsistent, &field, message);
            checks.report(problem.involving(top.key("image")));
            return None;
        }
        Some(Environment::Picture {
            emission,
            picture: Arc::new(sphere.turned(turn?, sampled)),
        })
    }

    /// Checks an upper bound of the brightest pixel times a factor.
    fn check_brightest(&self, checks: &mut Checks, sphere: &Sphere, factor: f64) -> Option<()> {
        let texels = sphere.texels.values.iter();
        let largest = match sphere.spectra {
            // A texel's radiance is its last number times a reflectance.
            PictureSpectra::Smooth => texels.map(|texel| texel[3]).fold(0.0, f32::max),
            PictureSpectra::Bands => texels.flatten().copied().fold(0.0, f32::max),
        };
        let (found, most) = (f64::from(largest) * factor, limits::EMISSION.high);
        if found <= most {
            return Some(());
        }
        let message = format!(
            "found {}, which may give the picture's brightest pixel a radiance of {found:.3e} W m⁻² sr⁻¹ nm⁻¹; at most {} is possible, which is a scale of {:.3e}",
            Shown(self.scale),
            Shown(most),
            self.scale * (most / found)
        );
        let top = FieldPath::root().key("environment");
        let problem = Problem::new(ProblemKind::OutOfRange, &top.key("scale"), message);
        checks.report(problem.involving(top.key("image")));
        None
    }
}
