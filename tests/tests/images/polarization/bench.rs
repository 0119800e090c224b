//! An optical bench: scenes with one ray, and their Stokes vectors in both renderers.
//!
//! Samples lie in the plane y = 0. The plane of incidence is z = 0, so that s is the z axis, and so is the camera's horizontal.

use glam::DVec3;
use gpu::Gpu;
use optics::{Complex64, Layer, Mueller};
use pellicle_tests::tolerances::{POLARIZED, POLARIZED_F32};
use scene::Scene;
use scene_file::SceneFile;
use spectra::{SpectralImage, Stokes};
use std::fmt::{Display, Formatter};
use std::ops::ControlFlow;
use std::path::Path;

/// The wavelengths of [`RENDER`].
pub(super) const NM: [f64; 5] = [552.8, 592.8, 632.8, 672.8, 712.8];

/// Light relative to S0 that shows a matrix column by column: unpolarized, along s, at 45° to it, and circular to the right.
pub(super) const INPUTS: [[f64; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
];

/// One sample of one ray that meets `surfaces` surfaces on its way to the light.
pub(super) fn render(surfaces: u32) -> String {
    settings([1, 1], 1, surfaces + 1, true)
}

/// Settings of pictures at the wavelengths of [`NM`].
pub(super) fn settings(size: [u32; 2], samples: u32, segments: u32, is_polarized: bool) -> String {
    format!(
        "[render]\nsize = {size:?}\nsamples = {samples}\nbands = 5\nwavelengths_nm = [532.8, 732.8]\nsampling = \"center\"\n\
         max_path_segments = {segments}\nroulette_after = {segments}\nlight_groups = \"single\"\npolarization = {is_polarized}\n"
    )
}

/// An orthographic camera in the direction `from` of the origin, whose horizontal is `right`. `more` is for its polarizer.
pub(super) fn camera(from: DVec3, right: DVec3, more: &str) -> String {
    let (position, up) = (from * 2.0, from.cross(right));
    format!(
        "[camera]\ntype = \"orthographic\"\nposition = {:?}\nlook_at = [0, 0, 0]\nup = {:?}\nheight = 1e-6\n{more}\n",
        position.to_array(),
        up.to_array()
    )
}

/// A camera that sees the sample at an angle to its normal, with s as its horizontal.
pub(super) fn camera_at(degrees: f64, more: &str) -> String {
    camera(in_plane(degrees), DVec3::NEG_Z, more)
}

/// The direction at an angle to the normal, in the plane of incidence.
pub(super) fn in_plane(degrees: f64) -> DVec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    DVec3::new(sin, cos, 0.0)
}

/// Light of radiance 1 from everywhere, with its polarization about s.
pub(super) fn surroundings(stokes: [f64; 3]) -> String {
    format!(
        "[environment]\ntype = \"constant\"\nemission = {{ constant = 1, {} }}\n",
        about(stokes, DVec3::Z)
    )
}

/// A polarization about an axis.
pub(super) fn about(stokes: [f64; 3], axis: DVec3) -> String {
    format!(
        "polarization = {{ stokes = {stokes:?}, axis = {:?} }}",
        axis.to_array()
    )
}

/// A sample of the material `sample`.
pub(super) const SAMPLE: &str = "[[objects]]\ntype = \"rectangle\"\nmaterial = \"sample\"\ncenter = [0, 0, 0]\nnormal = [0, 1, 0]\nsize = [1, 1]\n";

/// The material `sample`: a bare body.
pub(super) fn body(index: Complex64) -> String {
    let index = [index.re, index.im];
    format!("[materials.sample]\ntype = \"conductor\"\nindex = {index:?}\n")
}

/// The material `sample`: layers on a body.
pub(super) fn coated(layers: &[Layer], substrate: Complex64) -> String {
    let (substrate, layers) = ([substrate.re, substrate.im], written(layers));
    format!("[materials.sample]\ntype = \"coated\"\nsubstrate = {substrate:?}\n{layers}\n")
}

/// The material `sample`: a free film.
pub(super) fn free(layers: &[Layer]) -> String {
    format!("[materials.sample]\ntype = \"film\"\n{}\n", written(layers))
}

/// Layers in the syntax of a scene file.
pub(super) fn written(layers: &[Layer]) -> String {
    let one = |layer: &Layer| {
        let (index, nm) = (layer.index, layer.thickness_nm);
        format!(
            "{{ index = [{:?}, {:?}], thickness_nm = {nm:?} }}",
            index.re, index.im
        )
    };
    let all: Vec<_> = layers.iter().map(one).collect();
    format!("layers = [{}]", all.join(", "))
}

pub(super) fn scene(parts: &[&str]) -> Scene {
    SceneFile::parse("bench", &parts.join("\n"), Path::new(""))
        .and_then(|file| file.validate())
        .unwrap_or_else(|problems| panic!("{problems:#}"))
}

/// A renderer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Renderer {
    Reference,
    Gpu,
}

impl Renderer {
    /// How far a Stokes vector may be off, relative to S0.
    pub(super) fn tolerance(self) -> f64 {
        match self {
            Self::Reference => POLARIZED,
            Self::Gpu => POLARIZED_F32,
        }
    }
}

impl Display for Renderer {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Reference => "cpu",
            Self::Gpu => "gpu",
        })
    }
}

/// Pictures of both renderers.
pub(super) fn pictures(gpu: &Gpu, scene: &Scene) -> [(Renderer, SpectralImage); 2] {
    let on = &mut |_| ControlFlow::Continue(());
    let on_gpu = gpu::render(gpu, scene, on).unwrap_or_else(|error| panic!("{error}"));
    let on_cpu = reference::render(scene, on).expect("nothing stops the render");
    [(Renderer::Reference, on_cpu), (Renderer::Gpu, on_gpu)]
}

/// The Stokes vectors of a picture: those of all bands of the first pixel, then of the next.
pub(super) fn stokes(image: &SpectralImage) -> Vec<[f64; 4]> {
    let components = Stokes::ALL.map(|component| image.group_component(0, component));
    let at = |i: usize| components.map(|component| f64::from(component[i]));
    (0..image.radiance().len()).map(at).collect()
}

/// The Stokes vectors of a scene in both renderers.
pub(super) fn seen(gpu: &Gpu, parts: &[&str]) -> [(Renderer, Vec<[f64; 4]>); 2] {
    pictures(gpu, &scene(parts)).map(|(renderer, image)| (renderer, stokes(&image)))
}

/// The Mueller matrices in all bands of what lies between a source and the camera, for scenes that have the given source.
pub(super) fn mueller(
    gpu: &Gpu,
    parts: impl Fn([f64; 3]) -> String,
) -> [(Renderer, Vec<Mueller>); 2] {
    let columns = INPUTS.map(|stokes| seen(gpu, &[&parts(stokes)]));
    [0, 1].map(|i| {
        let of = |input: usize, band: usize| columns[input][i].1[band];
        let matrix = |band| {
            let plain = of(0, band);
            Mueller(std::array::from_fn(|row| {
                let column = |input| match input {
                    0 => plain[row],
                    _ => of(input, band)[row] - plain[row],
                };
                std::array::from_fn(column)
            }))
        };
        let bands = columns[0][i].1.len();
        (columns[0][i].0, (0..bands).map(matrix).collect())
    })
}

/// Compares Stokes vectors, or rows of matrices. Differences are relative to S0, or to a hundredth of the source where there is less.
#[track_caller]
pub(super) fn assert_stokes(what: &str, renderer: Renderer, found: [f64; 4], expected: [f64; 4]) {
    let scale = expected[0].abs().max(0.01);
    let off = furthest(found, expected) / scale;
    println!("{what}, {renderer}: off by {off:.1e}");
    assert!(
        off <= renderer.tolerance(),
        "{what}, {renderer}: off by {off:.1e}\n{found:?}\ninstead of\n{expected:?}"
    );
}

/// Compares a matrix with what it does to unpolarized light and to light of each component alone, and whether a medium can have it.
#[track_caller]
pub(super) fn assert_matrix(
    what: &str,
    renderer: Renderer,
    matrix: &Mueller,
    expected: impl Fn([f64; 4]) -> [f64; 4],
) {
    for [s1, s2, s3] in INPUTS {
        let input = [1.0, s1, s2, s3];
        assert_stokes(what, renderer, matrix.apply(input), expected(input));
    }
    assert!(
        matrix.is_physical(renderer.tolerance()),
        "{what}, {renderer}: {matrix:?}"
    );
}

/// The largest difference of two components.
pub(super) fn furthest(found: [f64; 4], expected: [f64; 4]) -> f64 {
    let differences = found.iter().zip(expected).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, |most, off| if off <= most { most } else { off })
}

/// The angle in radians from one axis to another, counterclockwise for who receives light along `direction`; all are unit vectors, the axes
/// across the direction.
pub(super) fn angle_between(from: DVec3, to: DVec3, direction: DVec3) -> f64 {
    direction.dot(from.cross(to)).atan2(from.dot(to))
}
