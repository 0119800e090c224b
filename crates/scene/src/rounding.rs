//! A scene as a GPU receives it: every number rounded to the nearest `f32`.

use crate::EnvironmentPicture;
use crate::{
    Camera, CoatEstimate, CoatedBody, Cook1981, CookFacets, DiffuseTerm, Emission, EmitterNode,
    EmitterTree, Environment, Grain, Layer, Lens, Light, LightShape, Microsurface, Object, Pattern,
    Projection, RenderSettings, SceneParts, Shape,
};
use glam::DVec3;
use std::sync::Arc;

/// Rounds every `f64` of a value to the nearest `f32` and keeps the rest.
pub(crate) trait RoundToF32 {
    fn rounded(&self) -> Self;
}

impl RoundToF32 for f64 {
    fn rounded(&self) -> Self {
        f64::from(*self as f32)
    }
}

impl RoundToF32 for DVec3 {
    fn rounded(&self) -> Self {
        self.as_vec3().as_dvec3()
    }
}

impl<T: RoundToF32> RoundToF32 for Vec<T> {
    fn rounded(&self) -> Self {
        self.iter().map(T::rounded).collect()
    }
}

impl RoundToF32 for spectra::BandTable {
    fn rounded(&self) -> Self {
        self.map(|value| value.rounded())
    }
}

impl RoundToF32 for SceneParts {
    fn rounded(&self) -> Self {
        Self {
            settings: self.settings.rounded(),
            camera: self.camera.rounded(),
            spectra: self.spectra.rounded(),
            observer: self.observer.each_ref().map(RoundToF32::rounded),
            light_groups: self.light_groups.clone(),
            materials: self.materials.rounded(),
            estimates: self.estimates.rounded(),
            objects: self.objects.rounded(),
            lights: self.lights.rounded(),
            environment: self.environment.rounded(),
            assumptions: self.assumptions.clone(),
        }
    }
}

impl RoundToF32 for RenderSettings {
    fn rounded(&self) -> Self {
        // Validation has already rounded the ends of the bands to `f32`.
        Self {
            exposure_ev: self.exposure_ev.rounded(),
            clamp: self.clamp.map(|clamp| clamp.rounded()),
            ..self.clone()
        }
    }
}

impl RoundToF32 for Camera {
    fn rounded(&self) -> Self {
        Self {
            origin: self.origin.rounded(),
            right: self.right.rounded(),
            up: self.up.rounded(),
            back: self.back.rounded(),
            projection: self.projection.rounded(),
            lens: self.lens.map(|lens| Lens {
                radius: lens.radius.rounded(),
                focus_distance: lens.focus_distance.rounded(),
            }),
            filter: self.filter.rounded(),
        }
    }
}

impl RoundToF32 for Projection {
    fn rounded(&self) -> Self {
        match self {
            Self::Perspective { half_height } => Self::Perspective {
                half_height: half_height.rounded(),
            },
            Self::Panorama => Self::Panorama,
            Self::Orthographic { half_height } => Self::Orthographic {
                half_height: half_height.rounded(),
            },
        }
    }
}

impl RoundToF32 for CoatedBody {
    fn rounded(&self) -> Self {
        Self {
            microsurface: self.microsurface.as_ref().map(RoundToF32::rounded),
            base: self.base.rounded(),
            transmittance_scale: self.transmittance_scale.as_ref().map(RoundToF32::rounded),
            estimate: CoatEstimate {
                n: self.estimate.n.rounded(),
                base: self.estimate.base.rounded(),
            },
            ..*self
        }
    }
}

impl RoundToF32 for Cook1981 {
    fn rounded(&self) -> Self {
        Self {
            facets: self.facets.iter().map(RoundToF32::rounded).collect(),
            diffuse: self.diffuse.as_ref().map(RoundToF32::rounded),
            ambient: self.ambient.as_ref().map(RoundToF32::rounded),
            ..self.clone()
        }
    }
}

impl RoundToF32 for CookFacets {
    fn rounded(&self) -> Self {
        Self {
            slope: self.slope.rounded(),
            weight: self.weight.rounded(),
            part: self.part.rounded(),
        }
    }
}

impl RoundToF32 for DiffuseTerm {
    fn rounded(&self) -> Self {
        Self {
            fraction: self.fraction.rounded(),
            probability: self.probability.rounded(),
            reflectance: self.reflectance,
        }
    }
}

impl RoundToF32 for Microsurface {
    fn rounded(&self) -> Self {
        Self {
            distribution: self.distribution,
            roughness: self.roughness.map(|alpha| alpha.rounded()),
            grain: match self.grain {
                Grain::None => Grain::None,
                Grain::Along(direction) => Grain::Along(direction.rounded()),
                Grain::Around(axis) => Grain::Around(axis.rounded()),
            },
            energy: Arc::new(self.energy.rounded()),
        }
    }
}

impl RoundToF32 for Layer {
    fn rounded(&self) -> Self {
        Self {
            thickness: self.thickness.rounded(),
            ..*self
        }
    }
}

impl RoundToF32 for Emission {
    fn rounded(&self) -> Self {
        Self {
            scale: self.scale.rounded(),
            ..*self
        }
    }
}

impl RoundToF32 for Pattern {
    fn rounded(&self) -> Self {
        match self {
            Self::Uniform(spectrum) => Self::Uniform(*spectrum),
            Self::Checker { even, odd, size } => Self::Checker {
                even: *even,
                odd: *odd,
                size: size.rounded(),
            },
            Self::Texture { texels, size } => Self::Texture {
                texels: Arc::clone(texels),
                size: size.map(|size| size.map(|side| side.rounded())),
            },
        }
    }
}

impl RoundToF32 for Object {
    fn rounded(&self) -> Self {
        Self {
            shape: self.shape.rounded(),
            material: self.material,
        }
    }
}

impl RoundToF32 for Shape {
    fn rounded(&self) -> Self {
        match self {
            Self::Sphere { center, radius } => Self::Sphere {
                center: center.rounded(),
                radius: radius.rounded(),
            },
            Self::Plane {
                point,
                normal,
                tangent,
                bitangent,
            } => Self::Plane {
                point: point.rounded(),
                normal: normal.rounded(),
                tangent: tangent.rounded(),
                bitangent: bitangent.rounded(),
            },
            Self::Rectangle {
                center,
                normal,
                tangent,
                bitangent,
                half_width,
                half_height,
            } => Self::Rectangle {
                center: center.rounded(),
                normal: normal.rounded(),
                tangent: tangent.rounded(),
                bitangent: bitangent.rounded(),
                half_width: half_width.rounded(),
                half_height: half_height.rounded(),
            },
            Self::Disk {
                center,
                normal,
                tangent,
                bitangent,
                radius,
            } => Self::Disk {
                center: center.rounded(),
                normal: normal.rounded(),
                tangent: tangent.rounded(),
                bitangent: bitangent.rounded(),
                radius: radius.rounded(),
            },
        }
    }
}

impl RoundToF32 for Light {
    fn rounded(&self) -> Self {
        Self {
            shape: self.shape.rounded(),
            emission: self.emission.rounded(),
        }
    }
}

impl RoundToF32 for LightShape {
    fn rounded(&self) -> Self {
        match self {
            Self::DistantDisk { toward, height } => Self::DistantDisk {
                toward: toward.rounded(),
                height: height.rounded(),
            },
            Self::Direction { toward } => Self::Direction {
                toward: toward.rounded(),
            },
            Self::Point { position } => Self::Point {
                position: position.rounded(),
            },
            Self::Spot {
                position,
                axis,
                full_height,
                edge_height,
            } => Self::Spot {
                position: position.rounded(),
                axis: axis.rounded(),
                full_height: full_height.rounded(),
                edge_height: edge_height.rounded(),
            },
        }
    }
}

impl RoundToF32 for EmitterTree {
    fn rounded(&self) -> Self {
        Self {
            nodes: self.nodes.rounded(),
            leaves: self.leaves.clone(),
        }
    }
}

impl RoundToF32 for EmitterNode {
    fn rounded(&self) -> Self {
        Self {
            center: self.center.rounded(),
            reach: self.reach.rounded(),
            axis: self.axis.rounded(),
            cone: self.cone.rounded(),
            power: self.power.rounded(),
            variance: self.variance.rounded(),
            even: self.even.rounded(),
            along: self.along.rounded(),
            near: self.near.rounded(),
            ..*self
        }
    }
}

impl RoundToF32 for Environment {
    fn rounded(&self) -> Self {
        match self {
            Self::Constant(emission) => Self::Constant(emission.rounded()),
            Self::Picture { emission, picture } => Self::Picture {
                emission: emission.rounded(),
                picture: Arc::new(EnvironmentPicture {
                    forward: picture.forward.rounded(),
                    right: picture.right.rounded(),
                    ..EnvironmentPicture::clone(picture)
                }),
            },
            Self::Gradient {
                zenith,
                horizon,
                ground,
            } => Self::Gradient {
                zenith: zenith.rounded(),
                horizon: horizon.rounded(),
                ground: ground.rounded(),
            },
        }
    }
}
