//! From a scene to the numbers that the shader reads: the only place where `f64` becomes `f32`.
//!
//! Each kind of surface has a file that packs its materials: their record, the features that the shader needs for them, and the
//! number of passes of its loops.

mod emitters;
mod limits;
mod passes;
mod shapes;
mod surface;
mod tables;
mod texels;
mod thickness;
mod trees;

use crate::counts::{Counts, RecordLimits};
use crate::features::Features;
use crate::layout::{self, Frame, Record};
use glam::DVec3;
use scene::limits::{MAX_LAYERS, MAX_LIGHT_GROUPS, MAX_MATERIALS};
use scene::{Emission, EmittedPolarization, Projection, Scene, SpectrumId, WavelengthSampling};
use spectra::BandTable;
use spectra::stokes::Polarizer;
use surface::Passes;
use tables::Tables;
use trees::Trees;

/// A scene as the shader reads it.
#[derive(Clone, Debug)]
pub struct PackedScene {
    /// Values for the whole render.
    pub frame: Frame,
    /// The objects that rays meet.
    pub shapes: Vec<layout::Shape>,
    /// The emitters.
    pub emitters: Vec<layout::Emitter>,
    /// Materials and their parts, each a whole number of rows.
    pub records: Vec<[u32; 4]>,
    /// The hierarchy of objects and the tree of emitters.
    pub trees: Vec<[u32; 4]>,
    /// Tables for lookups.
    pub numbers: Vec<f32>,
    /// Pictures with four numbers per texel, a header before each.
    pub texels: Vec<[f32; 4]>,
    /// All spectra and the observer: `[spectrum][knot][group of four bands]`.
    pub spectra: Vec<[f32; 4]>,
    /// The maximum length of a path's record.
    pub limits: RecordLimits,
    /// Numbers of things in the scene.
    pub counts: Counts,
    /// The maximum number of passes of loops in a sample.
    pub passes_per_sample: u64,
    /// The features of the scene.
    pub features: Features,
}

impl PackedScene {
    /// Packs a scene.
    pub fn new(scene: &Scene) -> Self {
        let limits = limits::of(scene);
        let mut tables = Tables::with_materials(scene.materials().len());
        let mut features = Features::of(scene);
        let mut passes = Passes::default();
        let mut is_used = vec![false; scene.materials().len()];
        for object in scene.objects() {
            is_used[object.material.index()] = true;
        }
        let materials = scene.materials().iter().zip(scene.estimates());
        for (number, (material, estimate)) in materials.enumerate() {
            let packed = surface::pack(scene, (number, material, estimate), &mut tables);
            if is_used[number] {
                features.add(&packed.features);
                passes = passes.max(packed.passes);
            }
        }
        let mut shapes: Vec<_> = shapes::pack_all(scene);
        let (mut emitters, first_environment) = emitters::pack(scene, &mut shapes, &mut tables);
        let trees = Trees::new(scene.hierarchy(), scene.emitter_tree());
        for (emitter, &node) in emitters.iter_mut().zip(&trees.emitter_nodes) {
            emitter.node = node;
        }
        let mut frame = Frame {
            first_environment,
            first_emitter_node: trees.first_emitter_node,
            end_emitter_node: trees.rows.len() as u32,
            ..pack_frame(scene)
        };
        if let Some(offsets) = scene.camera().filter.offsets() {
            frame.first_filter = tables.look_up(offsets);
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
            shapes,
            emitters,
            records: tables.records,
            trees: trees.rows,
            numbers: tables.numbers,
            texels: tables.pictures.texels,
            spectra: spectra.chain(observer).collect(),
            limits,
            counts: limits::counts(scene, trees.hierarchy_rows),
            passes_per_sample: passes::of_sample(scene, limits, passes),
            features,
        }
    }

    /// Returns the record at a row.
    ///
    /// # Panics
    /// When there is no such row.
    pub fn record<R: Record>(&self, row: u32) -> R {
        let rows = &self.records[row as usize..(row + R::ROWS) as usize];
        bytemuck::pod_read_unaligned(bytemuck::cast_slice(rows))
    }

    /// Returns a material.
    ///
    /// # Panics
    /// When there is no material with this number.
    pub fn material(&self, number: usize) -> layout::Material {
        self.record(number as u32 * layout::Material::ROWS)
    }
}

fn vec3(v: DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
}

fn id(spectrum: SpectrumId) -> u32 {
    spectrum.index() as u32
}

/// The most spectra of a scene: a material has n and k of its substrate and of each layer, or fewer for other kinds, and the
/// environment has three.
const MAX_SPECTRA: usize = MAX_MATERIALS * 2 * (MAX_LAYERS + 1) + 3;

// Indices of spectra fit into the low bits of an emission, indices of light groups into the others.
const _: () = assert!(MAX_SPECTRA < 1 << layout::LIGHT_GROUP_SHIFT);
const _: () = assert!(MAX_LIGHT_GROUPS <= 1 << (u32::BITS - layout::LIGHT_GROUP_SHIFT));

/// Returns an emission as it is in records: the spectrum in the low 24 bits, the light group in the high 8.
///
/// # Panics
/// When either does not fit, which the limits of scenes exclude: [`MAX_SPECTRA`] and [`MAX_LIGHT_GROUPS`].
fn emission_ref(emission: Emission) -> u32 {
    let (spectrum, group) = (id(emission.spectrum), emission.light_group.index() as u32);
    assert!(
        spectrum < 1 << layout::LIGHT_GROUP_SHIFT,
        "spectrum {spectrum}"
    );
    assert!(group < MAX_LIGHT_GROUPS as u32, "light group {group}");
    spectrum | group << layout::LIGHT_GROUP_SHIFT
}

/// Adds the polarization of an emission to the records and returns its row, or NONE.
fn polarization_row(tables: &mut Tables, emission: Emission) -> u32 {
    let Some(polarization) = emission.polarization else {
        return layout::NONE;
    };
    tables.push(&match polarization {
        EmittedPolarization::Stokes { stokes, axis } => layout::Polarization {
            stokes: stokes.map(|component| component as f32),
            kind: layout::POLARIZED_STOKES,
            axis: vec3(axis),
            degree: 0.0,
        },
        EmittedPolarization::Sky { sun, most } => layout::Polarization {
            stokes: [0.0; 3],
            kind: layout::POLARIZED_SKY,
            axis: vec3(sun),
            degree: most as f32,
        },
    })
}

/// Returns the values for the polarizer in front of a camera.
fn pack_polarizer(polarizer: &Polarizer) -> Frame {
    let analyzer = polarizer.analyzer();
    let vec = |weights: [f64; 3]| weights.map(|weight| weight as f32);
    Frame {
        analyzer: vec(analyzer.constant),
        retarder_nm: analyzer.path_nm.unwrap_or(0.0) as f32,
        analyzer_cosine: vec(analyzer.cosine),
        analyzer_sine: vec(analyzer.sine),
        ..Default::default()
    }
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
        observer: scene.spectra().len() as u32,
        film_splits: settings.film_splits,
        clamp: settings.clamp.unwrap_or(0.0) as f32,
        bands: settings.bands.count(),
        lens_radius: camera.lens.map_or(0.0, |lens| lens.radius as f32),
        focus_distance: camera.lens.map_or(1.0, |lens| lens.focus_distance as f32),
        ..camera
            .polarizer
            .as_ref()
            .map_or_else(Default::default, pack_polarizer)
    }
}

/// Packs rows of four bands; the last group is padded with the last band, or with zeros.
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
