//! A scene as a GPU receives it: every number rounded to the nearest `f32`.

use crate::{
    Camera, Emission, Environment, Layer, Lens, Material, Object, Pattern, Projection,
    RenderSettings, Scene, Shape,
};
use glam::DVec3;

/// Rounds what can be rounded and keeps the rest.
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

impl RoundToF32 for Scene {
    fn rounded(&self) -> Self {
        Self {
            settings: self.settings.rounded(),
            camera: self.camera.rounded(),
            spectra: self.spectra.rounded(),
            observer: self.observer.each_ref().map(RoundToF32::rounded),
            light_groups: self.light_groups.clone(),
            materials: self.materials.rounded(),
            objects: self.objects.rounded(),
            environment: self.environment.rounded(),
            estimates: self.estimates.rounded(),
        }
    }
}

impl RoundToF32 for RenderSettings {
    fn rounded(&self) -> Self {
        // The ends of the bands are `f32` numbers already, by validation.
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
            Self::Orthographic { half_height } => Self::Orthographic {
                half_height: half_height.rounded(),
            },
        }
    }
}

impl RoundToF32 for Material {
    fn rounded(&self) -> Self {
        match self {
            Self::Diffuse { reflectance } => Self::Diffuse {
                reflectance: reflectance.rounded(),
            },
            Self::Conductor {
                n,
                k,
                layers,
                roughness,
            } => Self::Conductor {
                n: *n,
                k: *k,
                layers: layers.iter().map(RoundToF32::rounded).collect(),
                roughness: roughness.rounded(),
            },
            Self::Film {
                layers,
                transparent,
                interference,
            } => Self::Film {
                layers: layers.iter().map(RoundToF32::rounded).collect(),
                transparent: *transparent,
                interference: *interference,
            },
            Self::Emitter {
                emission,
                reflectance,
            } => Self::Emitter {
                emission: emission.rounded(),
                reflectance: *reflectance,
            },
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
        }
    }
}

impl RoundToF32 for Environment {
    fn rounded(&self) -> Self {
        match self {
            Self::Constant(emission) => Self::Constant(emission.rounded()),
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
