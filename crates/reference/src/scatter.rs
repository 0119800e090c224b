//! How surfaces scatter light between two directions of their local frame, whose z is the normal on the ray's side.

use crate::interference::LayersAt;
use crate::{
    Facets, Reflectance, SurfacePoint, cook_facets, pattern_reflectance, sample_cook_facet,
    sample_cosine_hemisphere,
};
use glam::DVec3;
use scene::{CoatedBody, Cook1981, Layer, Material, Pattern, Scene, SpectrumId};
use std::f64::consts::PI;

/// What scatters light.
pub(crate) enum Scatterer<'a> {
    /// Evenly, by a reflectance.
    Diffuse(Reflectance),
    /// A conductor by its facets.
    RoughConductor(Conductor<'a>, Facets<'a>),
    /// A body of this reflectance below a smooth coat; what the coat mirrors is no part of it.
    CoatedBody(Conductor<'a>, &'a CoatedBody, Reflectance),
    /// A body of this reflectance below a rough coat.
    RoughCoatedBody(Conductor<'a>, &'a CoatedBody, Reflectance, Facets<'a>),
    /// By Cook's model.
    Cook(Conductor<'a>, &'a Cook1981),
}

/// A conductor where a path meets it.
pub(crate) struct Conductor<'a> {
    pub(crate) index: (SpectrumId, SpectrumId),
    pub(crate) coating: LayersAt<'a>,
}

/// How a surface scatters between two directions: weights of the spectra that it has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lobes {
    /// Of the reflectance at `cosine`: light that met the surface once.
    pub(crate) single: f64,
    /// Of the colour of light that met several facets of a rough surface.
    pub(crate) multiple: f64,
    /// Of the colour of the base below a coat.
    pub(crate) body: f64,
    /// Cosine at the facet.
    pub(crate) cosine: f64,
    /// Cosine of the light with the normal.
    pub(crate) light_cosine: f64,
}

/// Scattering between two directions.
pub(crate) struct Scattering {
    /// The surface's functions times the light's cosine, without their spectra.
    pub(crate) lobes: Lobes,
    /// Density with which [`Scatterer::sample`] finds the light's direction, sr⁻¹.
    pub(crate) pdf: f64,
}

impl Lobes {
    fn single(single: f64, cosine: f64, light: DVec3) -> Self {
        Self {
            single,
            multiple: 0.0,
            body: 0.0,
            cosine,
            light_cosine: light.z,
        }
    }

    /// Whether anything is scattered.
    pub(crate) fn is_lit(&self) -> bool {
        self.single > 0.0 || self.multiple > 0.0 || self.body > 0.0
    }
}

impl<'a> Scatterer<'a> {
    /// That of an object at a point; none of films, smooth conductors and black lamps. `random` in [0, 1) chooses between the texels
    /// of a picture.
    pub(crate) fn new(
        scene: &'a Scene,
        object: usize,
        point: &SurfacePoint,
        random: f64,
    ) -> Option<Self> {
        let met = &scene.objects()[object];
        let conductor = |n, k, layers: &'a [Layer]| Conductor {
            index: (n, k),
            coating: LayersAt::new(layers, &met.shape, point),
        };
        let at_point =
            |pattern: &Pattern| pattern_reflectance(pattern, &met.shape, point.position, random);
        match scene.material(met.material) {
            Material::Film { .. } => None,
            Material::Diffuse { reflectance } => Some(Self::Diffuse(at_point(reflectance))),
            Material::Emitter { reflectance, .. } => {
                reflectance.map(|spectrum| Self::Diffuse(Reflectance::Spectrum(spectrum)))
            }
            Material::Conductor {
                n,
                k,
                layers,
                microsurface,
            } => {
                let facets = Facets::new(microsurface.as_ref()?);
                Some(Self::RoughConductor(conductor(*n, *k, layers), facets))
            }
            Material::CoatedBody(body) => {
                let (coat, base) = (conductor(body.n, body.k, &[]), at_point(&body.base));
                Some(match &body.microsurface {
                    None => Self::CoatedBody(coat, body, base),
                    Some(facets) => Self::RoughCoatedBody(coat, body, base, Facets::new(facets)),
                })
            }
            Material::Cook(cook) => Some(Self::Cook(conductor(cook.n, cook.k, &[]), cook)),
        }
    }

    /// Scattering from `light` to `eye`, unit vectors.
    pub(crate) fn between(&self, eye: DVec3, light: DVec3) -> Scattering {
        match self {
            Self::Diffuse(_) => {
                let lambert = light.z.max(0.0) / PI;
                Scattering {
                    lobes: Lobes::single(lambert, 1.0, light),
                    pdf: lambert,
                }
            }
            Self::CoatedBody(_, body, _) => {
                let lambert = light.z.max(0.0) / PI;
                Scattering {
                    lobes: Lobes {
                        body: lambert,
                        ..Lobes::single(0.0, 1.0, light)
                    },
                    pdf: (1.0 - coat_share(body, eye.z)) * lambert,
                }
            }
            Self::RoughCoatedBody(_, body, _, facets) => match facets.between(eye, light) {
                None => Scattering {
                    lobes: Lobes::single(0.0, 1.0, light),
                    pdf: 0.0,
                },
                Some(found) => {
                    let share = coat_share(body, eye.z);
                    let lambert = light.z / PI;
                    let passes = body.passage_at(eye) * body.passage_at(light);
                    Scattering {
                        lobes: Lobes {
                            multiple: found.multiple,
                            body: passes * lambert,
                            ..Lobes::single(found.single, found.cosine, light)
                        },
                        pdf: share * found.pdf + (1.0 - share) * lambert,
                    }
                }
            },
            Self::Cook(_, cook) => {
                let facets = cook_facets(cook, eye, light);
                let lambert = light.z.max(0.0) / PI;
                let (share, chance) = cook.diffuse.map_or((0.0, 0.0), |d| (d.share, d.chance));
                let single = Lobes::single(facets.reflection * light.z, facets.cosine, light);
                Scattering {
                    lobes: Lobes {
                        body: share * lambert,
                        ..single
                    },
                    pdf: chance * lambert + (1.0 - chance) * facets.pdf,
                }
            }
            Self::RoughConductor(_, facets) => facets.between(eye, light).map_or(
                Scattering {
                    lobes: Lobes::single(0.0, 1.0, light),
                    pdf: 0.0,
                },
                |found| Scattering {
                    lobes: Lobes {
                        multiple: found.multiple,
                        ..Lobes::single(found.single, found.cosine, light)
                    },
                    pdf: found.pdf,
                },
            ),
        }
    }

    /// A unit vector towards which light is scattered from `eye`.
    pub(crate) fn sample(&self, eye: DVec3, random: [f64; 4]) -> DVec3 {
        let [u, v, choice, pick] = random;
        match self {
            Self::Diffuse(_) | Self::CoatedBody(..) => sample_cosine_hemisphere(u, v),
            Self::RoughCoatedBody(_, body, _, facets) => {
                let share = coat_share(body, eye.z);
                if choice < share {
                    facets.sample(eye, [u, v, choice / share, pick])
                } else {
                    sample_cosine_hemisphere(u, v)
                }
            }
            Self::Cook(_, cook) if choice < cook.diffuse.map_or(0.0, |diffuse| diffuse.chance) => {
                sample_cosine_hemisphere(u, v)
            }
            Self::Cook(_, cook) => mirrored(eye, sample_cook_facet(cook, [u, v, pick])),
            Self::RoughConductor(_, facets) => facets.sample(eye, random),
        }
    }
}

/// Share of the paths that are mirrored by a smooth coat rather than sent on by the body below it: by an estimate of what either
/// brings.
pub fn coat_share(body: &CoatedBody, cosine: f64) -> f64 {
    let reflected = optics::reflectance_unpolarised(body.estimate.n.into(), cosine.max(1e-6));
    let share = reflected / (reflected + (1.0 - reflected) * body.estimate.base).max(1e-6);
    match body.microsurface {
        // Near grazing it reflects less than a smooth one: both must stay within reach.
        Some(_) => share.clamp(0.1, 0.9),
        None => share,
    }
}

/// The direction that a facet mirrors to `eye`.
fn mirrored(eye: DVec3, facet: DVec3) -> DVec3 {
    (2.0 * eye.dot(facet) * facet - eye).normalize()
}
