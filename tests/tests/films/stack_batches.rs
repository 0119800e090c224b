//! Batches of stacks on the device, against independent computations and against the crate `optics`.

use gpu::{MAX_BATCH_LAYERS, RunStack, StackBatch, StackError, evaluate_stacks};
use num_complex::Complex64;
use optics::{Layer, stack};
use pellicle_tests::agreement::{Tolerance, compare};
use pellicle_tests::tolerances::{FILM, FILM_GRAZING, FILM_LONG, FILM_THICK};
use std::collections::BTreeMap;

const FILMS: &str = include_str!("../../data/films.csv");
const FILMS_MEDIA: &str = include_str!("../../data/films_media.csv");

fn rows(table: &'static str) -> impl Iterator<Item = Vec<&'static str>> {
    let lines = table.lines().filter(|line| !line.starts_with('#'));
    lines.skip(1).map(|line| line.split(',').collect())
}

fn number(cell: &str) -> f64 {
    cell.parse()
        .unwrap_or_else(|_| panic!("{cell} is not a number"))
}

/// A case of the tables: its media over wavelength, its layers, and R and T as published.
#[derive(Default)]
struct Case {
    wavelengths_nm: Vec<f64>,
    /// `[medium][wavelength]`, the incident medium first.
    media: Vec<Vec<[f64; 2]>>,
    thickness_nm: Vec<f64>,
    degrees: Vec<f64>,
    /// `[angle][wavelength]`.
    expected: Vec<f64>,
}

fn cases() -> BTreeMap<&'static str, Case> {
    let mut cases: BTreeMap<&'static str, Case> = BTreeMap::new();
    for row in rows(FILMS_MEDIA) {
        let (case, medium) = (cases.entry(row[0]).or_default(), number(row[1]) as usize);
        if case.media.len() <= medium {
            case.media.push(Vec::new());
            case.thickness_nm.push(number(row[2]));
        }
        if medium == 0 {
            case.wavelengths_nm.push(number(row[3]));
        }
        case.media[medium].push([number(row[4]), number(row[5])]);
    }
    let mut powers: BTreeMap<(&str, i64, usize), [f64; 4]> = BTreeMap::new();
    for row in rows(FILMS) {
        let case = cases.get_mut(row[0]).expect("has media");
        let (nm, degrees) = (number(row[1]), number(row[2]));
        let place = case
            .wavelengths_nm
            .iter()
            .position(|&w| w == nm)
            .expect("listed");
        if !case.degrees.contains(&degrees) {
            case.degrees.push(degrees);
        }
        let four = std::array::from_fn(|i| number(row[3 + i]));
        powers.insert((row[0], degrees as i64, place), four);
    }
    for (name, case) in &mut cases {
        for &degrees in &case.degrees {
            for place in 0..case.wavelengths_nm.len() {
                case.expected
                    .extend(powers[&(*name, degrees as i64, place)]);
            }
        }
    }
    cases
}

impl Case {
    /// R and T on the device, with every index but the incident one times `index_factor`.
    fn on_device(&self, gpu: &gpu::Gpu, index_factor: f64) -> Vec<f64> {
        let cosines: Vec<f64> = self.degrees.iter().map(|d| d.to_radians().cos()).collect();
        let media: Vec<[f64; 2]> = self.media[1..]
            .concat()
            .into_iter()
            .map(|[n, k]| {
                let is_air = n == 1.0 && k == 0.0;
                let factor = if is_air { 1.0 } else { index_factor };
                [n * factor, k * factor]
            })
            .collect();
        let inner = &self.thickness_nm[1..self.thickness_nm.len() - 1];
        let layers: Vec<(u32, f64)> = (0..).zip(inner.iter().copied()).collect();
        let batch = StackBatch {
            wavelengths_nm: &self.wavelengths_nm,
            cosines: &cosines,
            incident: self.media[0][0][0],
            media: &media,
            is_dispersive: true,
            layers: &layers,
            stacks: &[RunStack {
                substrate: layers.len() as u32,
                first_layer: 0,
                layer_count: layers.len() as u32,
            }],
        };
        let found = evaluate_stacks(gpu, &batch).unwrap_or_else(|error| panic!("{error}"));
        found.into_iter().flatten().map(f64::from).collect()
    }
}

/// Films, coatings and metals against tmm 0.2.0 (S. J. Byrnes, arXiv:1603.02720), 0 to 80°.
#[test]
fn published_stacks_are_reproduced_on_the_device() {
    let gpu = pellicle_tests::device::lend();
    let cases = cases();
    assert_eq!(cases.len(), 14);
    for (name, case) in &cases {
        assert_eq!(case.expected.len(), 41 * 4 * 4, "{name}");
        let report = compare(&case.on_device(&gpu, 1.0), &case.expected, FILM);
        println!(
            "{name}: {}",
            report.unwrap_or_else(|report| panic!("{name}: {report}"))
        );
        let wrong = compare(&case.on_device(&gpu, 1.01), &case.expected, FILM);
        assert!(
            wrong.is_err(),
            "{name}: an index one percent off is not noticed"
        );
    }
}

/// Uniform numbers in [0, 1), the same at every call.
fn uniform(row: usize, column: u32) -> f64 {
    let row = row as u32;
    reference::random4([row & 0xffff, row >> 16], column, 7, 1)[0]
}

/// Random stacks, each at one angle and one wavelength out of a few.
struct RandomStacks {
    incident: f64,
    wavelengths_nm: Vec<f64>,
    cosines: Vec<f64>,
    media: Vec<[f64; 2]>,
    layers: Vec<(u32, f64)>,
    stacks: Vec<RunStack>,
}

impl RandomStacks {
    /// `count` stacks of `depth` layers up to `thickest` nm; every fourth medium absorbs, up to `most_k`.
    fn new(count: usize, depth: u32, (thickest, most_k): (f64, f64), degrees: &[f64]) -> Self {
        let media = (0..64)
            .map(|i| {
                let k = if i % 4 == 0 {
                    most_k * uniform(i, 1).powi(2)
                } else {
                    0.0
                };
                [1.1 + 1.5 * uniform(i, 0), k]
            })
            .collect();
        let layer = |i: usize| {
            let medium = (64.0 * uniform(i, 2)) as u32;
            (medium, thickest * uniform(i, 3))
        };
        let total = count * depth as usize;
        Self {
            incident: 1.0,
            wavelengths_nm: vec![410.0, 487.0, 555.0, 620.0, 705.0],
            cosines: degrees.iter().map(|d| d.to_radians().cos()).collect(),
            media,
            layers: (0..total).map(layer).collect(),
            stacks: (0..count)
                .map(|i| RunStack {
                    substrate: (64.0 * uniform(i, 4)) as u32,
                    first_layer: i as u32 * depth,
                    layer_count: depth,
                })
                .collect(),
        }
    }

    fn batch(&self) -> StackBatch<'_> {
        StackBatch {
            wavelengths_nm: &self.wavelengths_nm,
            cosines: &self.cosines,
            incident: self.incident,
            media: &self.media,
            is_dispersive: false,
            layers: &self.layers,
            stacks: &self.stacks,
        }
    }

    /// R_s, R_p, T_s, T_p of a stack in `f64`.
    fn expected(&self, of: RunStack) -> Vec<f64> {
        let index = |medium: u32| {
            // As the device receives it.
            let [n, k] = self.media[medium as usize].map(|x| f64::from(x as f32));
            Complex64::new(n, k)
        };
        let range = of.first_layer as usize..(of.first_layer + of.layer_count) as usize;
        let layers: Vec<Layer> = self.layers[range]
            .iter()
            .map(|&(medium, nm)| Layer {
                index: index(medium),
                thickness_nm: f64::from(nm as f32),
            })
            .collect();
        let mut all = Vec::new();
        for &cosine in &self.cosines {
            for &nm in &self.wavelengths_nm {
                let found = stack(
                    f64::from(self.incident as f32),
                    &layers,
                    index(of.substrate),
                    nm,
                    f64::from(cosine as f32),
                );
                let (r, t) = (found.reflectance, found.transmittance);
                all.extend([r.s, r.p, t.s, t.p]);
            }
        }
        all
    }

    fn compared(&self, gpu: &gpu::Gpu, tolerance: Tolerance) -> Result<String, String> {
        let found = evaluate_stacks(gpu, &self.batch()).unwrap_or_else(|error| panic!("{error}"));
        let actual: Vec<f64> = found.into_iter().flatten().map(f64::from).collect();
        let expected: Vec<f64> = self
            .stacks
            .iter()
            .flat_map(|&of| self.expected(of))
            .collect();
        compare(&actual, &expected, tolerance)
    }
}

#[test]
fn random_stacks_agree_with_f64() {
    let gpu = pellicle_tests::device::lend();
    for (what, count, depth, sizes, degrees, tolerance) in [
        (
            "ordinary",
            20_000,
            5,
            (300.0, 3.0),
            &[0.0, 25.0, 50.0, 75.0, 88.0][..],
            FILM,
        ),
        (
            "grazing",
            20_000,
            5,
            (200.0, 3.0),
            &[88.5, 89.5, 89.9, 89.99][..],
            FILM_GRAZING,
        ),
        (
            "thick",
            10_000,
            2,
            (15_000.0, 3.0),
            &[0.0, 40.0, 70.0][..],
            FILM_THICK,
        ),
        (
            "64 layers",
            2_000,
            64,
            (150.0, 0.0),
            &[0.0, 30.0, 60.0][..],
            FILM_LONG,
        ),
    ] {
        let stacks = RandomStacks::new(count, depth, sizes, degrees);
        let report = stacks.compared(&gpu, tolerance);
        println!(
            "{what}: {}",
            report.unwrap_or_else(|report| panic!("{what}: {report}"))
        );
    }
}

/// A layer between two prisms at and near its critical angle: R and T are as smooth there as elsewhere.
#[test]
fn a_layer_at_its_critical_angle_is_like_any_other() {
    let gpu = pellicle_tests::device::lend();
    for (prism, layer) in [
        (2.0, 1.0),
        (1.5, 1.0),
        (2.0_f64.sqrt(), 1.2),
        (2.0, 1.33),
        (1.52, 1.38),
    ] {
        let critical = (layer / prism).asin().to_degrees();
        let degrees = [-0.5, -1e-3, 0.0, 1e-3, 0.5].map(|off| critical + off);
        let mut stacks = RandomStacks::new(1, 1, (0.0, 0.0), &degrees);
        stacks.incident = prism;
        stacks.media = vec![[layer, 0.0], [prism, 0.0]];
        stacks.layers = vec![(0, 300.0)];
        stacks.stacks[0].substrate = 1;
        let report = stacks.compared(&gpu, FILM_GRAZING);
        println!(
            "{layer} in {prism}: {}",
            report.unwrap_or_else(|report| panic!("{layer} in {prism}: {report}"))
        );
    }
}

#[test]
fn layers_in_the_wrong_order_are_noticed() {
    let gpu = pellicle_tests::device::lend();
    let mut stacks = RandomStacks::new(100, 5, (300.0, 3.0), &[0.0, 50.0]);
    let right = evaluate_stacks(&gpu, &stacks.batch()).unwrap();
    stacks.layers.chunks_mut(5).for_each(<[_]>::reverse);
    let wrong = evaluate_stacks(&gpu, &stacks.batch()).unwrap();
    let flat =
        |all: Vec<[f32; 4]>| -> Vec<f64> { all.into_iter().flatten().map(f64::from).collect() };
    assert!(compare(&flat(wrong), &flat(right), FILM).is_err());
}

/// A million stacks in one call: all results come back, in their order.
#[test]
fn one_call_evaluates_a_million_stacks() {
    const COUNT: usize = 1_000_000;
    let gpu = pellicle_tests::device::lend();
    let mut stacks = RandomStacks::new(COUNT, 5, (300.0, 3.0), &[30.0]);
    stacks.wavelengths_nm.truncate(1);
    let found = evaluate_stacks(&gpu, &stacks.batch()).unwrap();
    assert_eq!(found.len(), COUNT);
    let some = (0..COUNT).step_by(997);
    let actual: Vec<f64> = some.clone().flat_map(|i| found[i].map(f64::from)).collect();
    let expected: Vec<f64> = some
        .flat_map(|i| stacks.expected(stacks.stacks[i]))
        .collect();
    let report = compare(&actual, &expected, FILM);
    println!("{}", report.unwrap_or_else(|report| panic!("{report}")));
}

#[test]
fn invalid_batches_are_reported() {
    let gpu = pellicle_tests::device::lend();
    let with = |change: fn(&mut RandomStacks)| {
        let mut stacks = RandomStacks::new(3, 2, (100.0, 3.0), &[0.0]);
        change(&mut stacks);
        evaluate_stacks(&gpu, &stacks.batch())
    };
    assert_eq!(with(|_| ()).unwrap().len(), 15);
    assert_eq!(with(|all| all.stacks.clear()).unwrap().len(), 0);
    assert_eq!(with(|all| all.cosines.clear()).unwrap().len(), 0);
    let missing = |result| matches!(result, Err(StackError::Missing { .. }));
    assert!(missing(with(|all| all.stacks[1].substrate = 64)));
    assert!(missing(with(|all| all.layers[3].0 = u32::MAX)));
    assert!(missing(with(|all| all.stacks[2].first_layer = 5)));
    let many = with(|all| {
        all.layers = vec![(0, 1.0); 2000];
        all.stacks[0].layer_count = MAX_BATCH_LAYERS + 1;
    });
    assert!(matches!(
        many,
        Err(StackError::TooManyLayers {
            stack: 0,
            layers: 1025
        })
    ));
}

/// A path cannot store arbitrarily many thicknesses: a scene that would need it is reported before anything is compiled.
#[test]
fn a_record_that_is_too_long_is_reported() {
    let gpu = pellicle_tests::device::lend();
    let layer =
        "{ index = 1.5, thickness_nm = { start = 1, end = 9, from = [0, 0, 0], to = [1, 0, 0] } }";
    let scene = |layers: usize, segments: u32| {
        let text = format!(
            "camera = {{ type = 'perspective', position = [0, 0, 5], look_at = [0, 0, 0], fov_deg = 40 }}\n\
             render = {{ size = [8, 8], samples = 1, max_path_segments = {segments} }}\n\
             materials.x = {{ type = 'film', layers = [{}] }}\n\
             [[objects]]\ntype = 'sphere'\nmaterial = 'x'\ncenter = [0, 0, 0]\nradius = 1\n",
            vec![layer; layers].join(", ")
        );
        let file = scene_file::SceneFile::parse("x.toml", &text, std::path::Path::new(""));
        file.and_then(|file| file.validate())
            .unwrap_or_else(|problems| panic!("{problems:#}"))
    };
    let rendered = |layers, segments| {
        gpu::render(&gpu, &scene(layers, segments), &mut |_| {
            std::ops::ControlFlow::Continue(())
        })
    };
    assert!(rendered(2, 4).is_ok());
    let error = rendered(64, 32).expect_err("64 layers at every vertex and crossing");
    let gpu::RenderError::RecordTooLong { thicknesses } = error else {
        panic!("{error}");
    };
    assert!(thicknesses > 64 * 32, "{thicknesses}");
}
