//! From a scene to the numbers that the shader reads: the only place where `f64` becomes `f32`.

mod lights;
mod passes;
mod texels;
mod thickness;

use crate::features::{Features, FilmForm};
use crate::layout::{self, Frame};
use crate::modules::RecordLimits;
use glam::DVec3;
use scene::limits::{MAX_LAYERS, MAX_LIGHT_GROUPS, MAX_MATERIALS};
use scene::{
    Cook1981, CookDistribution, Distribution, Emission, EnvironmentPart, EnvironmentShape, Grain,
    Layer, Material, Microsurface, Object, PathDifference, Pattern, Projection, Scene, Shape,
    SpectrumId, Thickness, WavelengthSampling,
};
use spectra::BandTable;
use texels::Pictures;
use thickness::Fields;

/// A scene as the shader reads it.
#[derive(Clone, Debug)]
pub struct PackedScene {
    /// What holds for the whole render.
    pub frame: Frame,
    /// All objects.
    pub objects: Vec<layout::Object>,
    /// All materials.
    pub materials: Vec<layout::Material>,
    /// The layers of all films and coatings.
    pub layers: Vec<layout::Layer>,
    /// What their thicknesses are made of where they vary.
    pub fields: Vec<layout::Field>,
    /// Tables that are looked up.
    pub numbers: Vec<f32>,
    /// Pictures with four numbers in each place, a head before each.
    pub texels: Vec<[f32; 4]>,
    /// All spectra and the observer: `[spectrum][knot][group of four bands]`.
    pub spectra: Vec<[f32; 4]>,
    /// How long the record of a path may become.
    pub limits: RecordLimits,
    /// The most passes of loops that a sample takes.
    pub passes_per_sample: u64,
    /// What the scene has.
    pub features: Features,
}

impl PackedScene {
    /// Packs a scene.
    pub fn new(scene: &Scene) -> Self {
        let limits = record_limits(scene);
        let mut layers = Vec::new();
        let mut fields = Fields::default();
        let mut pictures = Pictures::default();
        let materials = scene.materials().iter().zip(scene.estimates());
        let mut materials: Vec<_> = materials
            .map(|(material, estimate)| layout::Material {
                albedo: estimate.albedo as f32,
                first_reflected: fields.look_up(&estimate.reflected),
                picture: pictures.of_material(material),
                ..pack_material(scene, material, &mut layers, &mut fields)
            })
            .collect();
        let mut objects: Vec<_> = scene.objects().iter().map(pack_object).collect();
        lights::append(
            scene,
            &mut objects,
            &mut materials,
            (&mut pictures, &mut fields.numbers),
        );
        let mut frame = pack_frame(scene);
        if let Some(offsets) = scene.camera().filter.offsets() {
            frame.first_filter = fields.look_up(offsets);
        }
        let spectra = scene
            .spectra()
            .iter()
            .flat_map(|table| pack_spectrum(table, false));
        let observer = scene
            .observer()
            .iter()
            .flat_map(|table| pack_spectrum(table, true));
        Self {
            frame,
            objects,
            materials,
            layers,
            fields: fields.list,
            numbers: fields.numbers,
            texels: pictures.texels,
            spectra: spectra.chain(observer).collect(),
            limits,
            passes_per_sample: passes::of_sample(scene, limits),
            features: Features::of(scene),
        }
    }
}

fn vec3(v: DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
}

fn id(spectrum: SpectrumId) -> u32 {
    spectrum.index() as u32
}

/// The most spectra of a scene: a material has n and k of its substrate and of each layer, or fewer of other kinds, and the
/// surroundings have three.
const MAX_SPECTRA: usize = MAX_MATERIALS * 2 * (MAX_LAYERS + 1) + 3;

// Numbers of spectra fit into the low bits of a light, those of light groups into the others.
const _: () = assert!(MAX_SPECTRA < 1 << layout::LIGHT_GROUP_SHIFT);
const _: () = assert!(MAX_LIGHT_GROUPS <= 1 << (u32::BITS - layout::LIGHT_GROUP_SHIFT));

/// A light as records name it: the spectrum in the low 24 bits, the light group in the high 8.
///
/// # Panics
/// When either does not fit, which the limits of scenes exclude: [`MAX_SPECTRA`] and [`MAX_LIGHT_GROUPS`].
fn light(emission: Emission) -> u32 {
    let (spectrum, group) = (id(emission.spectrum), emission.light_group.index() as u32);
    assert!(
        spectrum < 1 << layout::LIGHT_GROUP_SHIFT,
        "spectrum {spectrum}"
    );
    assert!(group < MAX_LIGHT_GROUPS as u32, "light group {group}");
    spectrum | group << layout::LIGHT_GROUP_SHIFT
}

fn pack_frame(scene: &Scene) -> Frame {
    let (camera, settings) = (scene.camera(), scene.settings());
    let half_height = match camera.projection {
        Projection::Perspective { half_height } | Projection::Orthographic { half_height } => {
            half_height
        }
        Projection::Panorama => 0.0,
    };
    Frame {
        camera_origin: vec3(camera.origin),
        camera_right: vec3(camera.right),
        half_height: half_height as f32,
        camera_up: vec3(camera.up),
        band_min_nm: settings.bands.min_nm() as f32,
        camera_back: vec3(camera.back),
        band_width_nm: settings.bands.width_nm() as f32,
        image_size: [settings.width, settings.height],
        seed: settings.seed,
        steps: BandTable::steps_of(&settings.bands),
        draws_wavelengths: u32::from(settings.sampling == WavelengthSampling::Random),
        first_environment: scene.objects().len() as u32,
        observer: scene.spectra().len() as u32,
        film_splits: settings.film_splits,
        clamp: settings.clamp.unwrap_or(0.0) as f32,
        bands: settings.bands.count(),
        lens_radius: camera.lens.map_or(0.0, |lens| lens.radius as f32),
        focus_distance: camera.lens.map_or(1.0, |lens| lens.focus_distance as f32),
        ..Default::default()
    }
}

/// Rows of four bands; the last group is filled up with the last band, or with darkness.
fn pack_spectrum(table: &BandTable, dark_padding: bool) -> Vec<[f32; 4]> {
    let groups = table.bands().div_ceil(4);
    let rows = (0..=table.steps()).map(|step| table.row(step));
    rows.flat_map(|row| {
        (0..groups as usize).map(move |group| {
            std::array::from_fn(|lane| match row.get(4 * group + lane) {
                Some(&value) => value as f32,
                None if dark_padding => 0.0,
                None => row[row.len() - 1] as f32,
            })
        })
    })
    .collect()
}

fn pack_object(object: &Object) -> layout::Object {
    let mut packed = layout::Object {
        material: object.material.index() as u32,
        light: layout::NONE,
        ..Default::default()
    };
    match object.shape {
        Shape::Sphere { center, radius } => {
            packed.shape = layout::SHAPE_SPHERE;
            packed.center = vec3(center);
            packed.radius = radius as f32;
        }
        Shape::Plane {
            point,
            normal,
            tangent,
            bitangent,
        } => {
            packed.shape = layout::SHAPE_PLANE;
            packed.center = vec3(point);
            (packed.normal, packed.tangent, packed.bitangent) =
                (vec3(normal), vec3(tangent), vec3(bitangent));
        }
        Shape::Rectangle {
            center,
            normal,
            tangent,
            bitangent,
            half_width,
            half_height,
        } => {
            packed.shape = layout::SHAPE_RECTANGLE;
            packed.center = vec3(center);
            (packed.normal, packed.tangent, packed.bitangent) =
                (vec3(normal), vec3(tangent), vec3(bitangent));
            packed.half_width = half_width as f32;
            packed.half_height = half_height as f32;
        }
        Shape::Disk {
            center,
            normal,
            tangent,
            bitangent,
            radius,
        } => {
            packed.shape = layout::SHAPE_DISK;
            packed.center = vec3(center);
            (packed.normal, packed.tangent, packed.bitangent) =
                (vec3(normal), vec3(tangent), vec3(bitangent));
            packed.radius = radius as f32;
            (packed.half_width, packed.half_height) = (packed.radius, packed.radius);
        }
    }
    packed
}

fn pack_material(
    scene: &Scene,
    material: &Material,
    layers: &mut Vec<layout::Layer>,
    fields: &mut Fields,
) -> layout::Material {
    let mut packed = layout::Material {
        first_layer: layers.len() as u32,
        ..Default::default()
    };
    match *material {
        Material::Diffuse { ref reflectance } => pack_pattern(&mut packed, reflectance),
        Material::Conductor {
            n,
            ref microsurface,
            layers: ref coating,
            ..
        } => {
            packed.surface = match microsurface {
                Some(_) => layout::SURFACE_ROUGH_CONDUCTOR,
                None => layout::SURFACE_MIRROR,
            };
            packed.spectrum = id(n);
            if let Some(microsurface) = microsurface {
                pack_microsurface(&mut packed, microsurface, fields);
            }
            pack_layers(&mut packed, (fields, layers), coating);
        }
        Material::Cook(ref cook) => pack_cook(&mut packed, fields, cook),
        Material::CoatedBody(ref body) => {
            pack_pattern(&mut packed, &body.base);
            packed.surface = match body.microsurface {
                Some(_) => layout::SURFACE_ROUGH_COATED_BODY,
                None => layout::SURFACE_COATED_BODY,
            };
            if let Some(microsurface) = &body.microsurface {
                pack_microsurface(&mut packed, microsurface, fields);
            }
            if let Some(passage) = &body.passage {
                packed.first_passage = fields.look_up(passage.values());
            }
            packed.coat_reflectances = body.reflectances.map_or(0, id);
            packed.coat = id(body.n);
            packed.mean_reflectance = id(body.mean_reflectance);
            packed.coat_estimate = body.estimate.n as f32;
            packed.base_chance = body.estimate.base as f32;
        }
        Material::Film {
            layers: ref own, ..
        } => {
            packed.surface = layout::SURFACE_FILM;
            packed.film = film_tag(FilmForm::of(scene, material));
            pack_layers(&mut packed, (fields, layers), own);
        }
        Material::Emitter {
            emission,
            reflectance,
        } => {
            packed.emission = light(emission);
            packed.emission_scale = emission.scale as f32;
            match reflectance {
                Some(reflectance) => pack_pattern(&mut packed, &Pattern::Uniform(reflectance)),
                None => packed.is_black = 1,
            }
        }
    }
    packed
}

/// Cook's model: an index above a base.
fn pack_cook(packed: &mut layout::Material, fields: &mut Fields, cook: &Cook1981) {
    if let Some(diffuse) = &cook.diffuse {
        pack_pattern(packed, &Pattern::Uniform(diffuse.reflectance));
        packed.base_share = diffuse.share as f32;
        packed.base_chance = diffuse.chance as f32;
    }
    packed.surface = match cook.distribution {
        CookDistribution::Gaussian => layout::SURFACE_COOK_D1,
        CookDistribution::Beckmann => layout::SURFACE_COOK_D2,
    };
    packed.coat = id(cook.n);
    let slopes = cook.facets.iter();
    let numbers: Vec<_> = slopes.flat_map(|f| [f.slope, f.weight, f.part]).collect();
    packed.first_slope = fields.look_up(&numbers);
    packed.slope_count = cook.facets.len() as u32;
    if let Some(ambient) = cook.ambient {
        packed.emission = light(ambient);
        packed.emission_scale = ambient.scale as f32;
    }
}

fn pack_microsurface(
    packed: &mut layout::Material,
    microsurface: &Microsurface,
    fields: &mut Fields,
) {
    let (kind, grain) = match microsurface.grain {
        Grain::None => (layout::GRAIN_NONE, DVec3::ZERO),
        Grain::Along(direction) => (layout::GRAIN_ALONG, direction),
        Grain::Around(axis) => (layout::GRAIN_AROUND, axis),
    };
    packed.grain_kind = kind;
    packed.grain = vec3(grain);
    packed.alpha = microsurface.roughness.map(|alpha| alpha as f32);
    packed.facets = match microsurface.distribution {
        Distribution::Beckmann => layout::FACETS_BECKMANN,
        Distribution::Ggx => layout::FACETS_GGX,
    };
    packed.first_energy = fields.look_up(microsurface.energy.table().values());
    packed.mean_energy = microsurface.energy.mean() as f32;
}

fn pack_pattern(packed: &mut layout::Material, pattern: &Pattern) {
    packed.surface = layout::SURFACE_DIFFUSE;
    match *pattern {
        Pattern::Uniform(reflectance) => {
            (packed.spectrum, packed.odd_spectrum) = (id(reflectance), id(reflectance));
            packed.checker_size = 1.0;
        }
        Pattern::Checker { even, odd, size } => {
            (packed.spectrum, packed.odd_spectrum) = (id(even), id(odd));
            packed.checker_size = size as f32;
        }
        // A picture has its place among the texels.
        Pattern::Texture { .. } => packed.checker_size = 1.0,
    }
}

fn film_tag(form: Option<FilmForm>) -> u32 {
    match form {
        None | Some(FilmForm::Transparent) => layout::FILM_TRANSPARENT,
        Some(FilmForm::Lossy) => layout::FILM_LOSSY,
        Some(FilmForm::Stack) => layout::FILM_STACK,
        Some(FilmForm::TwoBeam(PathDifference::Optical)) => layout::FILM_TWO_BEAM,
        Some(FilmForm::TwoBeam(PathDifference::AsPrinted)) => layout::FILM_TWO_BEAM_AS_PRINTED,
    }
}

fn pack_layers(
    packed: &mut layout::Material,
    (fields, layers): (&mut Fields, &mut Vec<layout::Layer>),
    own: &[Layer],
) {
    packed.layer_count = own.len() as u32;
    packed.varying_layers = varying(own);
    layers.extend(
        own.iter()
            .map(|layer| fields.layer(id(layer.n), &layer.thickness)),
    );
}

/// Number of layers whose thickness varies over the surface.
fn varying(layers: &[Layer]) -> u32 {
    let varies = |layer: &&Layer| !matches!(layer.thickness, Thickness::Constant { .. });
    layers.iter().filter(varies).count() as u32
}

/// How long the record of a path becomes at most.
///
/// A path has a vertex for each segment but the last, which may end in two terms of the environment. Where a film splits it, the
/// record has the path that goes on, a vertex that says so, and the other path.
fn record_limits(scene: &Scene) -> RecordLimits {
    let settings = scene.settings();
    let has_films = scene
        .objects()
        .iter()
        .any(|object| is_film(scene.material(object.material)));
    let splits = if has_films { settings.film_splits } else { 0 };
    let segments = settings.max_path_segments;
    let crossings = crossings(scene, segments, splits);
    // Of a gradient a direction sees two parts, of which one stands for the segment that escapes.
    let vertices = vertices(segments, splits) + (discs(scene) << splits);
    RecordLimits {
        vertices,
        crossings: u32::max(crossings, 1),
        thicknesses: u32::max(
            most_varying(scene, |_| true) * vertices + most_varying(scene, is_film) * crossings,
            1,
        ),
        light_groups: scene.light_groups().len() as u32,
        splits: u32::max(splits, 1),
    }
}

/// Vertices of a path with so many segments left that can still be split.
fn vertices(segments: u32, splits: u32) -> u32 {
    if splits == 0 || segments < 2 {
        return segments + 1;
    }
    2 + 2 * vertices(segments - 1, splits - 1)
}

/// Films that all connections of a path cross. One crosses a film's sphere at most twice and a film's plane once (and the edge where
/// films touch once more), and never more often than segments are left. A path that connects is not split any more.
fn crossings(scene: &Scene, segments: u32, splits: u32) -> u32 {
    let films = scene.objects().iter().filter_map(|object| {
        is_film(scene.material(object.material)).then_some(match object.shape {
            Shape::Sphere { .. } => 2,
            _ => 1,
        })
    });
    let straight: u32 = films.sum();
    let per_connection = if straight == 0 {
        0
    } else {
        straight.saturating_add(2)
    };
    let of_path = |first: u32| -> u32 {
        (first..segments)
            .map(|segment| per_connection.min(segments - segment - 1))
            .sum()
    };
    // With i splits there are 2ⁱ paths, each of which has come i segments further.
    (0..=splits).map(|i| of_path(1 + i) << i).max().unwrap_or(0)
}

/// Number of discs in the sky.
fn discs(scene: &Scene) -> u32 {
    let parts = scene.surroundings();
    let is_disc = |part: &&EnvironmentPart| matches!(part.shape, EnvironmentShape::Disc { .. });
    parts.iter().filter(is_disc).count() as u32
}

fn is_film(material: &Material) -> bool {
    matches!(material, Material::Film { .. })
}

/// The most thicknesses that one meeting with a material that is `wanted` puts on record. A film's only layer has its place
/// in the factor.
fn most_varying(scene: &Scene, wanted: fn(&Material) -> bool) -> u32 {
    let of_object = |object: &Object| {
        let material = scene.material(object.material);
        let is_recorded = wanted(material) && !(is_film(material) && material.layers().len() == 1);
        if is_recorded {
            varying(material.layers())
        } else {
            0
        }
    };
    scene.objects().iter().map(of_object).max().unwrap_or(0)
}
