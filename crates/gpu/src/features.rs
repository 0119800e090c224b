//! What a scene has, so that its pipeline leaves out the rest: the values of `shaders/features.wgsl`.

use scene::{
    Coordinate, DirectLight, Distribution, Environment, EnvironmentPart, EnvironmentShape,
    Interference, LightSource, Material, Microsurface, PathDifference, Pattern, PictureSpectra,
    Profile, Projection, Sampler, Scene, Shape, SourceKind, Thickness,
};

/// Constants of a shader by name: 1 where the scene has the thing, 0 where it has not; and how many it has.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Features(Vec<(&'static str, u32)>);

impl Features {
    /// What a scene has.
    pub fn of(scene: &Scene) -> Self {
        let used: Vec<&Material> = scene
            .objects()
            .iter()
            .map(|object| scene.material(object.material))
            .collect();
        let named = of_shapes(scene)
            .into_iter()
            .chain(of_surfaces(&used))
            .chain(of_films(scene, &used))
            .chain(of_thicknesses(&used))
            .chain(of_lights(scene))
            .chain(of_paths(scene, &used));
        let named = named.map(|(name, has)| (name, u32::from(has)));
        Self(named.chain(counts(scene)).collect())
    }

    /// The constants by name.
    pub fn constants(&self) -> &[(&'static str, u32)] {
        &self.0
    }

    /// The same with another value of one of them, for tests.
    #[must_use]
    pub fn with(mut self, name: &'static str, value: u32) -> Self {
        self.0.retain(|(known, _)| *known != name);
        self.0.push((name, value));
        self
    }

    /// A line of `shaders/features.wgsl` that declares a constant, with its value; none of another line.
    pub(crate) fn fill_in(&self, line: &str) -> Option<String> {
        let declared = line.strip_prefix("override ")?;
        let (name, rest) = declared.split_once(": ")?;
        let (kind, default) = rest.strip_suffix(';')?.split_once(" = ")?;
        let value = self.0.iter().find(|(known, _)| *known == name);
        let value = value.map_or_else(
            || default.to_owned(),
            |&(_, value)| match kind {
                "bool" => (value != 0).to_string(),
                _ => format!("{value}u"),
            },
        );
        Some(format!("const {name}: {kind} = {value};"))
    }
}

/// How many passes the loops make that look at all of something.
fn counts(scene: &Scene) -> [(&'static str, u32); 6] {
    let settings = scene.settings();
    let length = |count: usize| count as u32;
    [
        ("OBJECT_COUNT", length(scene.objects().len())),
        ("LIGHT_COUNT", length(scene.light_sources().len())),
        ("ENVIRONMENT_COUNT", length(scene.surroundings().len())),
        ("GROUPS", settings.bands.count().div_ceil(4)),
        ("MAX_PATH_SEGMENTS", settings.max_path_segments),
        ("ROULETTE_AFTER", settings.roulette_after),
    ]
}

type Named = (&'static str, bool);

fn is_sphere(shape: &Shape) -> bool {
    matches!(shape, Shape::Sphere { .. })
}

fn is_rectangle(shape: &Shape) -> bool {
    matches!(shape, Shape::Rectangle { .. })
}

fn is_disk(shape: &Shape) -> bool {
    matches!(shape, Shape::Disk { .. })
}

fn of_shapes(scene: &Scene) -> Vec<Named> {
    let shape = |wanted: fn(&Shape) -> bool| scene.objects().iter().any(|o| wanted(&o.shape));
    vec![
        ("HAS_SPHERES", shape(is_sphere)),
        ("HAS_RECTANGLES", shape(is_rectangle)),
        ("HAS_DISKS", shape(is_disk)),
    ]
}

/// Whether any of the materials makes a film of a wanted form.
fn has_film(scene: &Scene, used: &[&Material], wanted: fn(FilmForm) -> bool) -> bool {
    let mut forms = used.iter().filter_map(|m| FilmForm::of(scene, m));
    forms.any(wanted)
}

fn of_surfaces(used: &[&Material]) -> Vec<Named> {
    let material = |wanted: fn(&Material) -> bool| used.iter().any(|material| wanted(material));
    let facets = |wanted: fn(&Microsurface) -> bool| {
        let mut rough = used.iter().filter_map(|material| material.microsurface());
        rough.any(wanted)
    };
    vec![
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
            material(|m| m.microsurface().is_some()),
        ),
        ("HAS_COOK", material(|m| matches!(m, Material::Cook(_)))),
        ("HAS_BASES", material(has_base)),
        (
            "HAS_COATED_BODIES",
            material(|m| matches!(m, Material::CoatedBody(body) if body.microsurface.is_none())),
        ),
        (
            "HAS_ROUGH_COATS",
            material(|m| matches!(m, Material::CoatedBody(body) if body.microsurface.is_some())),
        ),
        (
            "HAS_BECKMANN",
            facets(|m| m.distribution == Distribution::Beckmann),
        ),
        ("HAS_GGX", facets(|m| m.distribution == Distribution::Ggx)),
        ("HAS_GRAIN", facets(Microsurface::is_brushed)),
    ]
}

fn of_films(scene: &Scene, used: &[&Material]) -> Vec<Named> {
    let material = |wanted: fn(&Material) -> bool| used.iter().any(|material| wanted(material));
    let film = |wanted| has_film(scene, used, wanted);
    vec![
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
    ]
}

fn of_lights(scene: &Scene) -> Vec<Named> {
    let sources = scene.light_sources();
    let surroundings = scene.surroundings();
    let light = |wanted: fn(&Shape) -> bool| {
        sources.iter().any(|source| match source.kind {
            SourceKind::Object(index) => wanted(&scene.objects()[index].shape),
            _ => false,
        })
    };
    let is_delta = |source: &LightSource| matches!(source.kind, SourceKind::Light(_));
    let is_disc = |part: &EnvironmentPart| matches!(part.shape, EnvironmentShape::Disc { .. });
    let direct = scene.settings().direct_light;
    vec![
        ("HAS_SPHERE_LIGHTS", light(is_sphere)),
        ("HAS_RECTANGLE_LIGHTS", light(is_rectangle)),
        ("HAS_DISK_LIGHTS", light(is_disk)),
        ("HAS_DELTA_LIGHTS", sources.iter().any(is_delta)),
        ("HAS_DISCS", surroundings.iter().any(is_disc)),
        ("HAS_LIGHTS", !sources.is_empty()),
        ("HAS_LIGHT_CHOICE", sources.len() > 1),
        (
            "HAS_ENVIRONMENT",
            surroundings.iter().any(|part| part.emission.scale > 0.0),
        ),
        ("SENDS_LIGHT", direct != DirectLight::Surfaces),
        ("MEETS_LIGHT", direct != DirectLight::Lights),
        (
            "HAS_ENVIRONMENT_PICTURE",
            picture_of(scene.environment()).is_some(),
        ),
        (
            "HAS_SPECTRAL_PICTURE",
            picture_of(scene.environment()) == Some(PictureSpectra::Bands),
        ),
    ]
}

/// How paths are drawn.
fn of_paths(scene: &Scene, used: &[&Material]) -> Vec<Named> {
    vec![
        (
            "HAS_SPLITS",
            has_film(scene, used, |_| true) && scene.settings().film_splits > 0,
        ),
        ("HAS_LENS", scene.camera().lens.is_some()),
        ("HAS_FILTER", scene.camera().filter.offsets().is_some()),
        ("HAS_CLAMP", scene.settings().clamp.is_some()),
        (
            "HAS_ROULETTE",
            scene.settings().roulette_after < scene.settings().max_path_segments,
        ),
        (
            "HAS_PANORAMA",
            scene.camera().projection == Projection::Panorama,
        ),
        (
            "HAS_ORTHOGRAPHIC",
            matches!(scene.camera().projection, Projection::Orthographic { .. }),
        ),
        (
            "HAS_SOBOL_SAMPLES",
            scene.settings().sampler == Sampler::Sobol,
        ),
    ]
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

/// Whether something diffuse lies below a coat or beside facets.
fn has_base(material: &Material) -> bool {
    match material {
        Material::Cook(cook) => cook.diffuse.is_some(),
        Material::CoatedBody(_) => true,
        _ => false,
    }
}

fn is_checker(material: &Material) -> bool {
    matches!(pattern_of(material), Some(Pattern::Checker { .. }))
}

fn is_texture(material: &Material) -> bool {
    matches!(pattern_of(material), Some(Pattern::Texture { .. }))
}

/// What a diffuse surface or base reflects, where it may vary.
fn pattern_of(material: &Material) -> Option<&Pattern> {
    match material {
        Material::Diffuse { reflectance } => Some(reflectance),
        Material::CoatedBody(body) => Some(&body.base),
        _ => None,
    }
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

/// What the pixels of surroundings hold that are a picture.
fn picture_of(environment: &Environment) -> Option<PictureSpectra> {
    match environment {
        Environment::Picture { picture, .. } => Some(picture.spectra),
        _ => None,
    }
}
