//! The cost of renders by instruction set and by number of bands, layers, objects and segments, in samples per second of small pictures.
//!
//! The first group guards against a loop over bands that is not compiled for the detected instruction set: its two rows would then
//! be nearly equal.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use pellicle_reference::{SimdLevel, random4, render_at};
use scene::Scene;
use scene_file::SceneFile;
use std::fmt::Write as _;
use std::hint::black_box;
use std::ops::ControlFlow;
use std::path::Path;

const SIZE: [u32; 2] = [64, 48];
const SAMPLES: u32 = 4;

/// A case of a group.
type Row = (String, SimdLevel, Scene);

fn file(name: &str) -> SceneFile {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    SceneFile::read(folder.join(format!("{name}.toml"))).unwrap_or_else(|e| panic!("{e}"))
}

fn parsed(text: &str) -> SceneFile {
    SceneFile::parse("made.toml", text, Path::new("")).unwrap_or_else(|e| panic!("{e}"))
}

fn small(mut file: SceneFile, bands: u32) -> Scene {
    let render = &mut file.description.render;
    (render.size, render.samples, render.bands) = (SIZE, SAMPLES, bands);
    file.validate()
        .unwrap_or_else(|problems| panic!("{problems}"))
}

const VIEW: &str = "camera = { type = 'perspective', position = [0, 0, 12], look_at = [0, 0, 0], fov_deg = 45 }\n\
     environment = { type = 'constant', emission = { illuminant = 'D65' } }\n\
     render = { max_path_segments = 8 }\n";

/// `count` gray spheres in a cube, with the same total cross section for every count, so that paths have the same length.
fn spheres(count: u32) -> String {
    let mut text =
        format!("{VIEW}materials = {{ gray = {{ type = 'diffuse', reflectance = 0.5 }} }}\n");
    for i in 0..count {
        let [x, y, z, size] = random4([i, 0], 0, 0, 5);
        let center = [x, y, z].map(|u| 8.0 * u - 4.0);
        let radius = (0.5 + size) * (10.0 / f64::from(count)).sqrt();
        let object = "[[objects]]\ntype = 'sphere'\nmaterial = 'gray'\n";
        writeln!(text, "{object}center = {center:?}\nradius = {radius}").unwrap();
    }
    text
}

/// A sphere of a film of `count` layers, clear or absorbing.
fn layers(count: usize, k: f64) -> String {
    let n = |i: usize| 1.4 + 0.9 * (i % 2) as f64;
    let layer = |i| format!("{{ index = [{}, {k}], thickness_nm = 90 }}", n(i));
    let list: Vec<_> = (0..count).map(layer).collect();
    format!(
        "{VIEW}materials = {{ film = {{ type = 'film', layers = [{}] }} }}\n\
         [[objects]]\ntype = 'sphere'\nmaterial = 'film'\ncenter = [0, 0, 0]\nradius = 4.5\n",
        list.join(", ")
    )
}

fn rows<T: std::fmt::Display>(of: &[T], scene: impl Fn(&T) -> Scene) -> Vec<Row> {
    of.iter()
        .map(|of| (of.to_string(), SimdLevel::best(), scene(of)))
        .collect()
}

fn measure(c: &mut Criterion, group: &str, rows: &[Row]) {
    let mut group = c.benchmark_group(group);
    let samples = u64::from(SIZE[0] * SIZE[1] * SAMPLES);
    group.throughput(Throughput::Elements(samples));
    for (name, level, scene) in rows {
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| render_at(*level, black_box(scene), &mut |_| ControlFlow::Continue(())));
        });
    }
    group.finish();
}

fn all(c: &mut Criterion) {
    let of_level = |level: SimdLevel| {
        let scene = small(file("bench/bubble"), 40);
        (level.name().to_owned(), level, scene)
    };
    let levels = [SimdLevel::baseline(), SimdLevel::best()].map(of_level);
    measure(c, "instructions", &levels);
    let bands = |&bands: &u32| small(file("bench/bubble"), bands);
    measure(c, "bands", &rows(&[1, 4, 16, 40, 81, 256], bands));
    let clear = |&count: &usize| small(parsed(&layers(count, 0.0)), 40);
    measure(c, "layers", &rows(&[1, 5, 21], clear));
    let lossy = |&count: &usize| small(parsed(&layers(count, 0.01)), 40);
    measure(c, "lossy layers", &rows(&[1, 5, 21], lossy));
    let crowd = |&count: &u32| small(parsed(&spheres(count)), 40);
    measure(c, "spheres", &rows(&[1, 10, 100, 1000], crowd));
    let segments = |&segments: &u32| {
        let mut file = file("metal_spheres");
        let render = &mut file.description.render;
        (render.max_path_segments, render.roulette_after) = (segments, segments);
        small(file, 40)
    };
    measure(c, "segments", &rows(&[2, 4, 8, 16, 32], segments));
    let names = [
        "bench/bubble",
        "bench/metals",
        "soap_bubble",
        "studio",
        "brushed_disk",
    ];
    measure(
        c,
        "unpolarized",
        &rows(&names, |name| small(file(name), 40)),
    );
    let polarized = |name: &&str| {
        let mut file = file(name);
        file.description.render.polarization = true;
        small(file, 40)
    };
    measure(c, "polarized", &rows(&names, polarized));
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = all
}
criterion_main!(benches);
