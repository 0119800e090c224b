use super::slopes::visible_slope;
use super::*;
use std::f64::consts::TAU;

const WIDTHS: [[f64; 2]; 7] = [
    [0.05, 0.05],
    [0.2, 0.2],
    [0.5, 0.5],
    [1.0, 1.0],
    [0.05, 0.3],
    [1.0, 0.2],
    [0.5, 0.8],
];

fn surfaces() -> impl Iterator<Item = Microsurface> {
    let both = [Distribution::Beckmann, Distribution::Ggx];
    both.into_iter().flat_map(|distribution| {
        WIDTHS.map(|alpha| Microsurface {
            distribution,
            alpha,
        })
    })
}

fn direction(degrees: f64, turns: f64) -> [f64; 3] {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let (sin_phi, cos_phi) = (TAU * turns).sin_cos();
    [sine * cos_phi, sine * sin_phi, cosine]
}

/// ∫ f(m) D(m) dm by the midpoint rule over slopes s = α r (cos φ, sin φ), with r² the quantile of the distribution. The
/// density comes from [`Microsurface::density`]; the measure of slopes is dm = cos³ ds.
fn over_facets(surface: &Microsurface, f: impl Fn([f64; 3]) -> f64) -> f64 {
    let (rows, columns) = (2000, 240);
    let mut sum = 0.0;
    for i in 0..rows {
        // More densely in the long tail.
        let rest = (f64::from(i) + 0.5) / f64::from(rows);
        let q = 1.0 - rest.powi(4);
        let rate = 4.0 * rest.powi(3);
        let (r2, half_rate) = match surface.distribution {
            Distribution::Beckmann => (-(-q).ln_1p(), 0.5 / (1.0 - q)),
            Distribution::Ggx => (q / (1.0 - q), 0.5 / (1.0 - q).powi(2)),
        };
        for j in 0..columns {
            let (sin_phi, cos_phi) = (TAU * (f64::from(j) + 0.5) / f64::from(columns)).sin_cos();
            let r = r2.sqrt();
            let slope = [
                surface.alpha[0] * r * cos_phi,
                surface.alpha[1] * r * sin_phi,
            ];
            let facet = normalized([-slope[0], -slope[1], 1.0]);
            let area = surface.alpha[0] * surface.alpha[1] * half_rate * rate;
            sum += f(facet) * surface.density(facet) * area * facet[2].powi(3);
        }
    }
    sum * TAU / f64::from(rows * columns)
}

#[test]
fn projected_facets_cover_the_surface_once() {
    for surface in surfaces() {
        let area = over_facets(&surface, |m| m[2]);
        assert!((area - 1.0).abs() < 1e-6, "{surface:?}: {area}");
    }
}

/// The projected area of the facets visible from a direction, masked by 1 / (1 + Λ), equals that of the macroscopic surface
/// (Heitz 2014, equation 14). Without masking it does not, so the test can fail.
#[test]
fn visible_facets_fill_the_view() {
    for surface in surfaces() {
        for (degrees, turns) in [
            (0.0, 0.0),
            (30.0, 0.1),
            (60.0, 0.3),
            (80.0, 0.9),
            (88.0, 0.0),
        ] {
            let wo = direction(degrees, turns);
            let turned = over_facets(&surface, |m| dot(wo, m).max(0.0));
            let seen = turned / (1.0 + surface.lambda(wo));
            assert!(
                (seen / wo[2] - 1.0).abs() < 2e-4,
                "{surface:?} {degrees}: {seen} {}",
                wo[2]
            );
            let masked_little = surface.alpha == [0.05; 2] || degrees < 70.0;
            assert!(masked_little || (turned / wo[2] - 1.0).abs() > 2e-4);
        }
    }
}

/// F(x) / F(cot θ) returns the number that chose x, at every angle and far into the tail.
#[test]
fn slopes_are_found_to_rounding() {
    for degrees in [
        0.0_f64, 0.1, 10.0, 45.0, 60.0, 75.0, 85.0, 88.0, 89.9, 89.999,
    ] {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let share = |x: f64| cosine * libm::erfc(-x) + sine / PI.sqrt() * (-x * x).exp();
        let all = share(if cosine < 6.0 * sine {
            cosine / sine
        } else {
            6.0
        });
        let tail = (0..70).map(|i| 1e-7 * 10_f64.powf(f64::from(i) / 10.0));
        for u in tail.chain((1..10_000).map(|i| f64::from(i) / 10_000.0)) {
            let x = visible_slope(cosine, sine, u);
            let found = share(x) / all;
            let density = 2.0 / PI.sqrt() * (cosine - x * sine) * (-x * x).exp() / all;
            assert!(
                (found - u).abs() / density < 1e-9,
                "{degrees}° {u}: {x} {found}"
            );
        }
    }
}

#[test]
fn reflection_is_reciprocal() {
    let (a, b) = (direction(30.0, 0.15), direction(65.0, 0.55));
    for surface in surfaces() {
        let (there, back) = (surface.reflection(a, b), surface.reflection(b, a));
        assert!((there - back).abs() <= 1e-14 * there, "{surface:?}");
    }
}

/// The albedo from facets distributed like the visible facets of a GGX surface equals the albedo from all facets.
#[test]
fn the_albedo_is_the_integral_of_the_reflection() {
    for surface in surfaces() {
        for degrees in [0.0, 30.0, 60.0, 80.0, 85.0] {
            let wo = direction(degrees, 0.1);
            let by_facets = over_facets(&surface, |m| {
                let wi = mirrored(wo, m);
                let cosine = dot(wo, m);
                if cosine <= 0.0 || wi[2] <= 0.0 {
                    return 0.0;
                }
                let whole = surface.reflection(wo, wi) * wi[2] * 4.0 * cosine;
                whole / surface.density(m)
            });
            let albedo = surface.albedo(wo, 64);
            let finer = surface.albedo(wo, 200);
            assert!((albedo - by_facets).abs() < 1e-3, "{surface:?} {degrees}");
            assert!((finer - by_facets).abs() < 2e-4, "{surface:?} {degrees}");
        }
    }
}

/// 1 − ln 2 is the closed form for GGX with α = 1 at normal incidence, where G = 2z / (1 + z) and the reflected light is uniform,
/// D / 4 = 1 / 4π.
#[test]
fn the_albedo_has_its_closed_form() {
    let surface = Microsurface {
        distribution: Distribution::Ggx,
        alpha: [1.0; 2],
    };
    let found = surface.albedo([0.0, 0.0, 1.0], 200);
    assert!((found - (1.0 - 2.0_f64.ln())).abs() < 2e-5, "{found}");
}
