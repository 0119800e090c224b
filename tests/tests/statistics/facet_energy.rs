//! Light reflected between facets: how far the term that adds it is from a random walk from facet to facet.

mod walk;

use colorimetry::lab::{Lab, delta_e_2000};
use optics::{Complex64, Distribution, Layer, Microsurface};
use rayon::prelude::*;
use scene_file::SceneFile;
use std::path::Path;
use walk::{Walk, direction};

const DISTRIBUTIONS: [Distribution; 2] = [Distribution::Beckmann, Distribution::Ggx];
const ROUGHNESS: [f64; 4] = [0.1, 0.3, 0.5, 1.0];
const DEGREES: [f64; 3] = [0.0, 60.0, 80.0];

fn surface(distribution: Distribution, roughness: f64) -> Microsurface {
    Microsurface {
        distribution,
        alpha: [roughness; 2],
    }
}

/// All surfaces and directions of this file, with a number for each.
fn views() -> impl IndexedParallelIterator<Item = (u32, Microsurface, f64)> {
    let count = DISTRIBUTIONS.len() * ROUGHNESS.len() * DEGREES.len();
    (0..count).into_par_iter().map(|i| {
        let (rest, degrees) = (i / DEGREES.len(), DEGREES[i % DEGREES.len()]);
        let roughness = ROUGHNESS[rest % ROUGHNESS.len()];
        let distribution = DISTRIBUTIONS[rest / ROUGHNESS.len()];
        (i as u32, surface(distribution, roughness), degrees)
    })
}

fn eye(degrees: f64) -> [f64; 3] {
    direction(degrees.to_radians().cos(), 0.13)
}

/// Every walk ends above the surface, so facets that reflect everything return everything; and the fraction that leaves from the first
/// facet is the surface's albedo, with the right mean cosine, within 4.5 standard errors.
#[test]
fn the_walk_loses_nothing_and_its_first_facet_follows_the_model() {
    const WALKS: u32 = 20_000;
    views().for_each(|(seed, surface, degrees)| {
        let wo = eye(degrees);
        let (mut once, mut cosines) = (0.0, 0.0);
        for index in 0..WALKS {
            let walk = Walk::new(&surface, wo, index, seed);
            let left = walk.left.expect("every walk leaves");
            assert!(left[2] > 0.0);
            if walk.cosines.len() == 1 {
                once += 1.0;
                cosines += walk.cosines[0];
            }
        }
        let (mut all, mut by_cosine, mut squares) = (0.0, 0.0, 0.0);
        surface.each_reflection(wo, 128, |cosine, weight| {
            all += weight;
            by_cosine += weight * cosine;
            squares += weight * cosine * cosine;
        });
        let count = f64::from(WALKS);
        for (found, expected, square) in [(once, all, all), (cosines, by_cosine, squares)] {
            let error = ((square - expected * expected).max(0.0) / count).sqrt();
            let off = (found / count - expected).abs();
            assert!(
                off < 4.5 * error + 2e-4,
                "{surface:?} {degrees}°: {} {expected} ± {error}",
                found / count
            );
        }
    });
}

/// Light that is reflected by several facets is exchanged equally between any two rings of directions; with uneven illumination it is
/// not (the test can fail).
#[test]
fn the_walk_is_reciprocal() {
    const RINGS: usize = 6;
    const WALKS: u32 = 200_000;
    for distribution in DISTRIBUTIONS {
        let surface = surface(distribution, 0.8);
        let passed = |unevenly: bool| {
            let mut counts = [[0.0_f64; RINGS]; RINGS];
            for index in 0..WALKS {
                // Uniform in cos²: each direction is weighted by its cosine.
                let cos2 = (f64::from(index) + 0.5) / f64::from(WALKS);
                let cosine = if unevenly { cos2 } else { cos2.sqrt() };
                let walk = Walk::new(&surface, direction(cosine, 0.0), index, 5);
                let left = walk.left.expect("every walk leaves");
                if walk.cosines.len() > 1 {
                    let ring = |x: f64| ((x * RINGS as f64) as usize).min(RINGS - 1);
                    counts[ring(cosine * cosine)][ring(left[2] * left[2])] += 1.0;
                }
            }
            let pairs = (0..RINGS).flat_map(|i| (0..i).map(move |j| (i, j)));
            pairs
                .map(|(i, j)| (counts[i][j] - counts[j][i]).powi(2) / (counts[i][j] + counts[j][i]))
                .sum::<f64>()
        };
        // 15 degrees of freedom: 44.3 in one case of 10 000.
        let (right, wrong) = (passed(false), passed(true));
        println!("{distribution:?}: chi-square {right:.1} and {wrong:.1}");
        assert!(right < 44.3, "{distribution:?}: {right}");
        assert!(wrong > 100.0, "{distribution:?}: {wrong}");
    }
}

/// The material of a facet.
#[derive(Clone, Copy, Debug)]
struct Facet {
    name: &'static str,
    metal: &'static str,
    /// Thickness of a layer of titania, nm.
    film: Option<f64>,
}

const FACETS: [Facet; 4] = [
    Facet {
        name: "gold",
        metal: "gold",
        film: None,
    },
    Facet {
        name: "silver",
        metal: "silver",
        film: None,
    },
    Facet {
        name: "copper",
        metal: "copper",
        film: None,
    },
    Facet {
        name: "titanium under 55 nm of titania",
        metal: "titanium",
        film: Some(55.0),
    },
];

impl Facet {
    fn index(name: &str, nm: f64) -> Complex64 {
        let set = spectra::optical_constants(name)
            .expect("the material is shipped")
            .data;
        set.at(nm).expect("the data cover visible light")
    }

    fn bare(&self, nm: f64) -> impl Fn(f64) -> f64 {
        let metal = Self::index(self.metal, nm);
        move |cosine| optics::reflectance_unpolarized(metal, cosine)
    }

    fn reflectance(&self, nm: f64) -> impl Fn(f64) -> f64 {
        let metal = Self::index(self.metal, nm);
        let layer = self.film.map(|thickness_nm| Layer {
            index: Self::index("titania", nm),
            thickness_nm,
        });
        move |cosine| {
            let layers = layer.as_slice();
            let found = optics::stack(1.0, layers, metal, nm, cosine.clamp(1e-6, 1.0));
            found.reflectance.unpolarized()
        }
    }
}

const FIRST_NM: u32 = 380;
const STEP_NM: u32 = 10;
const COUNT: usize = 41;
type Spectrum = [f64; COUNT];

fn nanometers(i: usize) -> f64 {
    f64::from(FIRST_NM + STEP_NM * i as u32)
}

fn spectrum(f: impl Fn(f64) -> f64) -> Spectrum {
    std::array::from_fn(|i| f(nanometers(i)))
}

/// XYZ under D65, with Y = 1 for a perfect reflector.
fn xyz(reflectance: &Spectrum) -> [f64; 3] {
    let at = |nm: f64| {
        let place = (nm - f64::from(FIRST_NM)) / f64::from(STEP_NM);
        let i = (place as usize).min(COUNT - 2);
        reflectance[i] + (reflectance[i + 1] - reflectance[i]) * (place - i as f64)
    };
    pellicle_tests::colorimetry::xyz("D65", at).map(|x| 0.01 * x)
}

/// Y, and the color relative to a perfect reflector.
fn seen(reflectance: &Spectrum) -> (f64, Lab) {
    let found = xyz(reflectance);
    (found[1], Lab::from_xyz(found, xyz(&[1.0; COUNT])))
}

/// Reflectance of the facets over wavelength and cosine, as a table that is linear in the cosine.
struct Table(Vec<Spectrum>);

impl Table {
    const STEPS: usize = 200;

    fn new(facet: &Facet) -> Self {
        let mut rows = vec![[0.0; COUNT]; Self::STEPS + 1];
        for i in 0..COUNT {
            let reflectance = facet.reflectance(nanometers(i));
            for (row, values) in rows.iter_mut().enumerate() {
                values[i] = reflectance(row as f64 / Self::STEPS as f64);
            }
        }
        Self(rows)
    }

    fn at(&self, cosine: f64) -> Spectrum {
        let place = cosine.clamp(0.0, 1.0) * Self::STEPS as f64;
        let row = (place as usize).min(Self::STEPS - 1);
        let part = place - row as f64;
        std::array::from_fn(|i| self.0[row][i] + (self.0[row + 1][i] - self.0[row][i]) * part)
    }
}

/// Light that a surface returns toward `wo`: by a walk, by the term of the renderers, and by alternatives to it.
struct Returned {
    walk: Spectrum,
    term: Spectrum,
    /// Without the light between facets.
    none: Spectrum,
    /// With its color from the mean reflectance over all wavelengths (weighted for Y).
    gray: Spectrum,
    /// With its color from the metal without its film.
    bare: Spectrum,
}

/// The energy table of a scene.
fn energy(surface: &Microsurface) -> scene::Microsurface {
    let distribution = match surface.distribution {
        Distribution::Beckmann => "beckmann",
        Distribution::Ggx => "ggx",
    };
    let text = format!(
        "[camera]\ntype = 'orthographic'\nposition = [0, 0, 1]\nlook_at = [0, 0, 0]\nheight = 1\n\
         [materials.rough]\ntype = 'conductor'\nindex = 'silver'\nroughness = {:?}\ndistribution = '{distribution}'\n",
        surface.alpha[0]
    );
    let scene = SceneFile::parse("rough", &text, Path::new(""))
        .and_then(|file| file.validate())
        .unwrap_or_else(|problems| panic!("{problems}"));
    let found = scene.materials()[0].microsurface();
    found.expect("the material is rough").clone()
}

/// The remaining fraction of light that is reflected by several facets, from walks; the walks are the same for all materials.
fn several(tables: &[Table], walks: &[Walk]) -> Vec<Spectrum> {
    let longer: Vec<_> = walks.iter().filter(|w| w.cosines.len() > 1).collect();
    let of_table = |table: &Table| {
        let mut sum = [0.0; COUNT];
        for walk in &longer {
            let mut rest = [1.0; COUNT];
            for &cosine in &walk.cosines {
                let facet = table.at(cosine);
                rest.iter_mut().zip(facet).for_each(|(x, f)| *x *= f);
            }
            sum.iter_mut().zip(rest).for_each(|(x, y)| *x += y);
        }
        sum.map(|x| x / longer.len().max(1) as f64)
    };
    tables.iter().map(of_table).collect()
}

fn returned(surface: &Microsurface, degrees: f64, tables: &[Table], seed: u32) -> Vec<Returned> {
    const WALKS: u32 = 20_000;
    let wo = eye(degrees);
    let walk = |index| Walk::new(surface, wo, index, seed);
    let several = several(tables, &(0..WALKS).map(walk).collect::<Vec<_>>());
    let energy = energy(surface).energy;
    let (lost, mean) = (1.0 - energy.at(wo), energy.mean());
    let of_facet = |(i, facet): (usize, &Facet)| {
        let (mut none, mut once) = ([0.0; COUNT], 0.0);
        surface.each_reflection(wo, 64, |cosine, weight| {
            let reflected = tables[i].at(cosine);
            none = std::array::from_fn(|j| none[j] + weight * reflected[j]);
            once += weight;
        });
        let films = spectrum(|nm| optics::mean_reflectance(facet.reflectance(nm)));
        let metals = spectrum(|nm| optics::mean_reflectance(facet.bare(nm)));
        let luminous = seen(&films).0;
        let with = |more: &dyn Fn(usize) -> f64| std::array::from_fn(|j| none[j] + more(j));
        let between = |f: f64| lost * optics::multiple_color(f, mean);
        Returned {
            walk: with(&|j| (1.0 - once).max(0.0) * several[i][j]),
            term: with(&|j| between(films[j])),
            gray: with(&|_| between(luminous)),
            bare: with(&|j| between(metals[j])),
            none,
        }
    };
    FACETS.iter().enumerate().map(of_facet).collect()
}

/// The largest errors: of Y, and as ΔE2000.
#[derive(Clone, Copy, Debug, Default)]
struct Worst(f64, f64);

impl Worst {
    fn meet(&mut self, found: &Spectrum, expected: &Spectrum) {
        let ((y, color), (sought, other)) = (seen(found), seen(expected));
        self.0 = self.0.max((y - sought).abs());
        self.1 = self.1.max(delta_e_2000(color, other));
    }
}

/// The figures of docs/surfaces.md: the worst over angles and both distributions. Without the light between facets, with gray light
/// instead, or with the color of the metal without its film, they are far larger.
#[test]
fn the_term_between_facets_has_a_stated_error() {
    let tables = FACETS.each_ref().map(Table::new);
    let found: Vec<_> = views()
        .map(|(seed, surface, degrees)| {
            let all = returned(&surface, degrees, &tables, 100 + seed);
            (surface.alpha[0], all)
        })
        .collect();
    let mut all = [Worst::default(); 4];
    for (i, facet) in FACETS.iter().enumerate() {
        for roughness in ROUGHNESS {
            let mut worst = [Worst::default(); 4];
            for (_, returned) in found.iter().filter(|(alpha, _)| *alpha == roughness) {
                let Returned {
                    walk,
                    term,
                    none,
                    gray,
                    bare,
                } = &returned[i];
                for (k, other) in [term, none, gray, bare].into_iter().enumerate() {
                    worst[k].meet(other, walk);
                    all[k].meet(other, walk);
                }
            }
            let [term, none, gray, bare] = worst;
            println!(
                "| {}, {roughness} | {:.3} | {:.1} | {:.3} | {:.1} | {:.1} | {:.1} |",
                facet.name, term.0, term.1, none.0, none.1, gray.1, bare.1
            );
            assert!(
                term.0 < 0.04 && term.1 < 2.0,
                "{facet:?} {roughness}: {term:?}"
            );
        }
    }
    let [_, none, gray, bare] = all;
    assert!(none.1 > 20.0 && gray.1 > 12.0 && bare.1 > 15.0, "{all:?}");
}
