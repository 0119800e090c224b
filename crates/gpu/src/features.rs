//! What a scene has, so that its pipeline leaves out the rest: the values of `shaders/features.wgsl`.

use scene::{
    Coordinate, Environment, Interference, Material, PathDifference, Pattern, PictureSpectra,
    Profile, Projection, Sampler, Scene, Shape, Thickness,
};

/// Constants of a pipeline by name: 1 where the scene has the thing, 0 where it has not.
#[derive(Clone, Debug, PartialEq)]
pub struct Features(Vec<(&'static str, f64)>);

impl Features {
    /// What a scene has.
    pub fn of(scene: &Scene) -> Self {
        let shape = |wanted: fn(&Shape) -> bool| scene.objects().iter().any(|o| wanted(&o.shape));
        let light = |wanted: fn(&Shape) -> bool| {
            scene
                .lights()
                .iter()
                .any(|&index| wanted(&scene.objects()[index].shape))
        };
        let used: Vec<&Material> = scene
            .objects()
            .iter()
            .map(|object| scene.material(object.material))
            .collect();
        let material = |wanted: fn(&Material) -> bool| used.iter().any(|material| wanted(material));
        let film = |wanted: fn(FilmForm) -> bool| {
            let mut forms = used.iter().filter_map(|m| FilmForm::of(scene, m));
            forms.any(wanted)
        };
        let is_sphere = |shape: &Shape| matches!(shape, Shape::Sphere { .. });
        let is_rectangle = |shape: &Shape| matches!(shape, Shape::Rectangle { .. });
        let is_disk = |shape: &Shape| matches!(shape, Shape::Disk { .. });
        let named = [
            ("HAS_SPHERES", shape(is_sphere)),
            ("HAS_RECTANGLES", shape(is_rectangle)),
            ("HAS_DISKS", shape(is_disk)),
            ("HAS_DIFFUSE", material(is_diffuse)),
            ("HAS_CHECKERS", material(is_checker)),
            ("HAS_TEXTURES", material(is_texture)),
            (
                "HAS_MIRRORS",
                material(|m| {
                    matches!(
                        m,
                        Material::Conductor {
                            microsurface: None,
                            ..
                        }
                    )
                }),
            ),
            (
                "HAS_ROUGH_CONDUCTORS",
                material(|m| {
                    matches!(
                        m,
                        Material::Conductor {
                            microsurface: Some(_),
                            ..
                        }
                    )
                }),
            ),
            ("HAS_FILMS", film(|_| true)),
            ("HAS_LOSSY_FILMS", film(|form| form == FilmForm::Lossy)),
            ("HAS_STACKS", film(|form| form == FilmForm::Stack)),
            (
                "HAS_TWO_BEAM_FILMS",
                film(|form| matches!(form, FilmForm::TwoBeam(_))),
            ),
            (
                "HAS_COATINGS",
                material(|m| matches!(m, Material::Conductor { layers, .. } if !layers.is_empty())),
            ),
            ("HAS_SPHERE_LIGHTS", light(is_sphere)),
            ("HAS_RECTANGLE_LIGHTS", light(is_rectangle)),
            ("HAS_ENVIRONMENT", !is_dark(scene.environment())),
            (
                "HAS_ENVIRONMENT_PICTURE",
                picture_of(scene.environment()).is_some(),
            ),
            (
                "HAS_SPECTRAL_PICTURE",
                picture_of(scene.environment()) == Some(PictureSpectra::Bands),
            ),
            (
                "HAS_PANORAMA",
                scene.camera().projection == Projection::Panorama,
            ),
            (
                "HAS_SOBOL_SAMPLES",
                scene.settings().sampler == Sampler::Sobol,
            ),
        ];
        Self(
            named
                .into_iter()
                .chain(of_thicknesses(&used))
                .map(|(name, has)| (name, f64::from(u8::from(has))))
                .collect(),
        )
    }

    /// The constants, for a pipeline.
    pub fn constants(&self) -> &[(&'static str, f64)] {
        &self.0
    }
}

/// What the thicknesses of layers are made of.
fn of_thicknesses(materials: &[&Material]) -> [(&'static str, bool); 7] {
    let parts = || {
        let thicknesses = materials.iter().flat_map(|m| m.thicknesses());
        thicknesses.flat_map(Thickness::parts)
    };
    let has = |wanted: fn(&Thickness) -> bool| parts().any(wanted);
    [
        (
            "HAS_FIELDS",
            has(|part| !matches!(part, Thickness::Constant { .. })),
        ),
        (
            "HAS_COMBINED_FIELDS",
            has(|part| matches!(part, Thickness::Sum(_) | Thickness::Product(_))),
        ),
        ("HAS_POLAR_FIELDS", has(is_polar)),
        ("HAS_LINE_FIELDS", has(runs_along_a_line)),
        (
            "HAS_SAMPLED_FIELDS",
            has(|part| matches!(part, Thickness::Steps { .. } | Thickness::Profile(_))),
        ),
        (
            "HAS_SWIRLS",
            has(|part| matches!(part, Thickness::Swirls(_))),
        ),
        (
            "HAS_PICTURES",
            has(|part| matches!(part, Thickness::Picture(_))),
        ),
    ]
}

fn is_polar(part: &Thickness) -> bool {
    matches!(
        part,
        Thickness::Polar { .. }
            | Thickness::Profile(Profile {
                coordinate: Coordinate::Polar { .. },
                ..
            })
    )
}

fn runs_along_a_line(part: &Thickness) -> bool {
    matches!(
        part,
        Thickness::Linear { .. }
            | Thickness::Steps { .. }
            | Thickness::Profile(Profile {
                coordinate: Coordinate::Line { .. },
                ..
            })
    )
}

fn is_diffuse(material: &Material) -> bool {
    matches!(
        material,
        Material::Diffuse { .. }
            | Material::Emitter {
                reflectance: Some(_),
                ..
            }
    )
}

fn is_checker(material: &Material) -> bool {
    matches!(
        material,
        Material::Diffuse {
            reflectance: Pattern::Checker { .. }
        }
    )
}

fn is_texture(material: &Material) -> bool {
    matches!(
        material,
        Material::Diffuse {
            reflectance: Pattern::Texture { .. }
        }
    )
}

/// The formula that serves a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FilmForm {
    /// One layer without absorption and with n ≥ 1 everywhere.
    Transparent,
    /// One layer of any index.
    Lossy,
    /// Several layers.
    Stack,
    /// One layer by two beams.
    TwoBeam(PathDifference),
}

impl FilmForm {
    /// The formula for a material; `None` where it is not a film.
    pub(crate) fn of(scene: &Scene, material: &Material) -> Option<Self> {
        let Material::Film {
            layers,
            transparent,
            interference,
        } = material
        else {
            return None;
        };
        Some(match (interference, layers.as_slice()) {
            (Interference::TwoBeam(path_difference), _) => Self::TwoBeam(*path_difference),
            (Interference::Exact, [only])
                if *transparent && scene.spectrum(only.n).extent().0 >= 1.0 =>
            {
                Self::Transparent
            }
            (Interference::Exact, [_]) => Self::Lossy,
            (Interference::Exact, _) => Self::Stack,
        })
    }
}

fn is_dark(environment: &Environment) -> bool {
    match environment {
        Environment::Constant(all) | Environment::Picture { emission: all, .. } => all.scale == 0.0,
        Environment::Gradient {
            zenith,
            horizon,
            ground,
        } => [zenith, horizon, ground]
            .iter()
            .all(|emission| emission.scale == 0.0),
    }
}

/// What the pixels of surroundings hold that are a picture.
fn picture_of(environment: &Environment) -> Option<PictureSpectra> {
    match environment {
        Environment::Picture { picture, .. } => Some(picture.spectra),
        _ => None,
    }
}
