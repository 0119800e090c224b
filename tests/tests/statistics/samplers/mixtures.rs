//! Surfaces that scatter in several ways, sampled with the function that paths use: Cook's model with facets of two slopes and a
//! diffuse fraction, and a base below a rough coat, with facets, light between them, and the base.

use super::chi_square::{Experiment, direction, turns};
use glam::DVec3;
use rayon::prelude::*;
use reference::{PreparedScene, SurfaceFunction, SurfacePoint, random4};
use scene::Scene;
use scene_file::SceneFile;
use std::f64::consts::TAU;
use std::path::Path;

const ROUGHNESS: [f64; 5] = [0.05, 0.1, 0.3, 0.6, 1.0];
const DEGREES: [f64; 5] = [0.0, 30.0, 60.0, 75.0, 85.0];
const KINDS: [Kind; 3] = [
    Kind::Cook("gaussian"),
    Kind::Cook("beckmann"),
    Kind::Coat("ggx"),
];

/// Number of chi-square tests in this file.
pub(super) const TESTS: usize = KINDS.len() * ROUGHNESS.len() * DEGREES.len();

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// Cook's model, with the form of D.
    Cook(&'static str),
    /// A coat, with the distribution of facets.
    Coat(&'static str),
}

impl Kind {
    /// A scene with a sphere of this material.
    fn scene(self, roughness: f64) -> Scene {
        let wide = (0.5 * (1.0 + roughness)).min(1.0);
        let material = match self {
            Self::Cook(distribution) => format!(
                "type = 'conductor'\nindex = 'gold'\n[materials.a.model.cook1981]\ndistribution = '{distribution}'\n\
                 slopes = [{{ m = {roughness:?}, weight = 0.7 }}, {{ m = {wide:?}, weight = 0.3 }}]\n\
                 specular = 0.75\ndiffuse = 0.25\ndiffuse_reflectance = 'red'\n"
            ),
            Self::Coat(distribution) => format!(
                "type = 'dielectric'\nindex = 1.5\nbase = 'red'\nroughness = {roughness:?}\ndistribution = '{distribution}'\n"
            ),
        };
        let text = format!(
            "camera = {{ type = 'orthographic', position = [0, 0, 5], look_at = [0, 0, 0], height = 1 }}\n\
             [materials.a]\n{material}\n\
             [[objects]]\ntype = 'sphere'\nmaterial = 'a'\ncenter = [0, 0, 0]\nradius = 1\n"
        );
        SceneFile::parse("mixture", &text, Path::new(""))
            .and_then(|file| file.validate())
            .unwrap_or_else(|problems| panic!("{problems}"))
    }
}

fn of<'a>(prepared: &'a PreparedScene<'a>) -> SurfaceFunction<'a> {
    let point = SurfacePoint {
        position: DVec3::Z,
        normal: DVec3::Z,
        cosine: 1.0,
        is_front: true,
    };
    SurfaceFunction::new(prepared, 0, &point, 0.5, 0.5).expect("the surface scatters")
}

/// Directions `wi`, by the facets that would reflect them into `wo`: their slope r on facets of α = √`roughness`, between the narrow and
/// the wide, as r / (1 + r), and their azimuth. Samples below the horizon are counted in the remaining cell.
fn scattered(
    (surface, claimed): (&SurfaceFunction<'_>, &SurfaceFunction<'_>),
    roughness: f64,
    wo: DVec3,
    name: String,
    check: impl Fn(&Experiment),
) {
    let scale = roughness.sqrt();
    let count = std::cell::Cell::new(0_u32);
    let draw = |u: f64, v: f64| {
        count.set(count.get() + 1);
        let [choice, pick, ..] = random4([count.get() % 4096, count.get() / 4096], 3, 5, 78);
        let wi = surface.sample(wo, [u, v, choice, pick]);
        let facet = (wo + wi).normalize();
        let r = facet.x.hypot(facet.y) / facet.z / scale;
        (wi.z > 0.0).then(|| [r / (1.0 + r), turns(facet)])
    };
    let density = |place: f64, turn: f64| {
        let r = place / (1.0 - place);
        let aside = direction(0.0, turn) * (scale * r);
        let facet = (DVec3::Z + aside).normalize();
        let cosine = wo.dot(facet);
        let wi = 2.0 * cosine * facet - wo;
        if cosine <= 0.0 || wi.z <= 0.0 {
            return 0.0;
        }
        let of_facets = scale * scale * r * TAU / (1.0 - place).powi(2) * facet.z.powi(3);
        claimed.pdf(wo, wi) * 4.0 * cosine * of_facets
    };
    check(&Experiment {
        name,
        ranges: [(0.0, 1.0), (0.0, 1.0)],
        draw: &draw,
        density: &density,
        // The horizon of `wi` runs through cells.
        parts: 4,
        outside: None,
    });
}

#[test]
fn mixtures_are_sampled_by_their_density() {
    let kinds = (0..KINDS.len() * ROUGHNESS.len()).into_par_iter();
    kinds.for_each(|i| {
        let (kind, roughness) = (KINDS[i / ROUGHNESS.len()], ROUGHNESS[i % ROUGHNESS.len()]);
        let scene = kind.scene(roughness);
        let prepared = PreparedScene::new(&scene);
        let surface = of(&prepared);
        for (j, degrees) in (0..).zip(DEGREES) {
            let wo = direction(degrees.to_radians().cos(), 0.13);
            let name = format!("{kind:?} of {roughness} from {degrees}°");
            scattered((&surface, &surface), roughness, wo, name, |right| {
                right.holds(2000 + 5 * i as u32 + j);
            });
        }
    });
}

/// A mixture of narrower facets is another mixture.
#[test]
fn mixtures_of_another_roughness_are_noticed() {
    for (seed, kind) in (950..).zip(KINDS) {
        let (scene, other) = (kind.scene(0.3), kind.scene(0.25));
        let prepared = (PreparedScene::new(&scene), PreparedScene::new(&other));
        let both = (&of(&prepared.0), &of(&prepared.1));
        let name = format!("{kind:?}");
        scattered(both, 0.3, direction(0.5, 0.13), name, |wrong| {
            wrong.is_refused(seed);
        });
    }
}
