//! Every sampler against the density that it claims, by chi-square; the energy of rough surfaces; reciprocity.
//!
//! Directions are counted in cells of equal steps of z (or of a facet's own quantile) and azimuth; what a cell should hold is the density
//! integrated over it by Gauss's rule, and a last cell takes what the density leaves (directions below the horizon). All tests
//! of this file together raise a false alarm with a chance of [`FALSE_ALARM`] (Šidák); the numbers are fixed, so a pass stays a pass.

mod facets;
mod pictures;

use glam::DVec3;
use optics::{
    gaussian_pdf, gaussian_share, half_vector_pdf, reflected_pdf, sample_beckmann, sample_gaussian,
};
use reference::{
    cone_height, cook_torrance, environment_pdf, frame_of, light_pdf, random4, sample_cone,
    sample_cosine_hemisphere, sample_environment, sample_light,
};
use scene::{EnvironmentShape, Shape};
use std::f64::consts::{PI, TAU};

/// Chance that any of the [`TESTS`] fails although every sampler is right.
const FALSE_ALARM: f64 = 1e-3;
/// How many chi-square tests there are, those that must fail left out.
const TESTS: f64 = 1.0
    + 4.0
    + 4.0
    + 3.0
    + 3.0
    + 6.0
    + SLOPES.len() as f64 * (2.0 + EYES_DEGREES.len() as f64)
    + facets::TESTS as f64
    + pictures::TESTS as f64;
const SLOPES: [f64; 6] = [0.05, 0.1, 0.2, 0.4, 0.7, 1.0];
const EYES_DEGREES: [f64; 4] = [0.0, 30.0, 60.0, 85.0];
const SAMPLES: u32 = 1 << 17;
const ROWS: usize = 24;
const COLUMNS: usize = 24;

/// Two uniform numbers per sample, from the renderer's own generator.
fn numbers(seed: u32) -> impl Iterator<Item = (f64, f64)> {
    (0..SAMPLES).map(move |i| {
        let [u, v, ..] = random4([i % 512, i / 512], i % 7, 3, seed);
        (u, v)
    })
}

/// Gauss's points and weights of order 8 on [0, 1] (Abramowitz and Stegun, table 25.4).
const GAUSS: [(f64, f64); 8] = {
    const HALF: [(f64, f64); 4] = [
        (0.183_434_642_495_649_8, 0.362_683_783_378_362),
        (0.525_532_409_916_329, 0.313_706_645_877_887_3),
        (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
        (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
    ];
    let mut points = [(0.0, 0.0); 8];
    let mut i = 0;
    while i < 4 {
        let (x, w) = HALF[i];
        points[2 * i] = (0.5 - 0.5 * x, 0.5 * w);
        points[2 * i + 1] = (0.5 + 0.5 * x, 0.5 * w);
        i += 1;
    }
    points
};

/// ∫ f over [a, b] × [c, d], each side cut into `parts`.
fn integral(
    f: impl Fn(f64, f64) -> f64,
    (a, b): (f64, f64),
    (c, d): (f64, f64),
    parts: usize,
) -> f64 {
    let (dx, dy) = ((b - a) / parts as f64, (d - c) / parts as f64);
    let mut sum = 0.0;
    for i in 0..parts {
        for j in 0..parts {
            for (x, wx) in GAUSS {
                for (y, wy) in GAUSS {
                    let x = a + (i as f64 + x) * dx;
                    let y = c + (j as f64 + y) * dy;
                    sum += wx * wy * f(x, y);
                }
            }
        }
    }
    sum * dx * dy
}

/// Upper tail of a normal distribution (Abramowitz and Stegun, 26.2.17, absolute error below 7.5e-8).
fn normal_tail(z: f64) -> f64 {
    if z < 0.0 {
        return 1.0 - normal_tail(-z);
    }
    let t = 1.0 / (1.0 + 0.231_641_9 * z);
    let poly = t
        * (0.319_381_530
            + t * (-0.356_563_782
                + t * (1.781_477_937 + t * (-1.821_255_978 + t * 1.330_274_429))));
    (-0.5 * z * z).exp() / TAU.sqrt() * poly
}

/// Chance of a chi-square as large, by Wilson and Hilferty's cube root (1931).
fn chance(chi2: f64, freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * freedom);
    normal_tail(((chi2 / freedom).cbrt() - (1.0 - spread)) / spread.sqrt())
}

/// What each cell holds and should hold, cells of fewer than five expected put together. Chi-square and its degrees of freedom.
fn chi_square(counts: &[f64], expected: &[f64]) -> (f64, f64) {
    let mut pooled = (0.0, 0.0);
    let (mut chi2, mut cells) = (0.0, 0);
    for (&count, &expect) in counts.iter().zip(expected) {
        if expect < 5.0 {
            pooled = (pooled.0 + count, pooled.1 + expect);
        } else {
            chi2 += (count - expect).powi(2) / expect;
            cells += 1;
        }
    }
    if pooled.1 >= 5.0 {
        chi2 += (pooled.0 - pooled.1).powi(2) / pooled.1;
        cells += 1;
    } else if pooled.0 > pooled.1 + 12.0 {
        // Where next to nothing is expected, so much does not happen.
        chi2 = f64::INFINITY;
    }
    assert!(cells > 20, "only {cells} cells hold anything");
    (chi2, f64::from(cells - 1))
}

/// A sampler and its density over two coordinates, `across` in the first range, `around` in the second. A direction without
/// coordinates lies in the remaining cell.
struct Experiment<'a> {
    name: String,
    ranges: [(f64, f64); 2],
    /// Coordinates of what two uniform numbers are turned into.
    draw: &'a dyn Fn(f64, f64) -> Option<[f64; 2]>,
    /// Density over the coordinates.
    density: &'a dyn Fn(f64, f64) -> f64,
    /// Into how many parts each side of a cell is cut to integrate the density.
    parts: usize,
    /// Share that falls outside of the ranges, where it is known; otherwise it is what the density leaves.
    outside: Option<f64>,
}

impl Experiment<'_> {
    /// The chance of so large a chi-square, and the integral of the density.
    fn chance_and_total(&self, seed: u32) -> (f64, f64) {
        let [across, around] = self.ranges;
        let mut counts = vec![0.0; ROWS * COLUMNS + 1];
        for (u, v) in numbers(seed) {
            let cell = (self.draw)(u, v).map_or(ROWS * COLUMNS, |[x, y]| {
                cell_of(x, across, ROWS) * COLUMNS + cell_of(y, around, COLUMNS)
            });
            counts[cell] += 1.0;
        }
        let mut expected: Vec<f64> = (0..ROWS * COLUMNS)
            .map(|cell| {
                let x = part(across, cell / COLUMNS, ROWS);
                let y = part(around, cell % COLUMNS, COLUMNS);
                integral(self.density, x, y, self.parts)
            })
            .collect();
        let total: f64 = expected.iter().sum();
        expected.push(self.outside.unwrap_or(1.0 - total));
        for expect in &mut expected {
            *expect *= f64::from(SAMPLES);
        }
        let (chi2, freedom) = chi_square(&counts, &expected);
        (chance(chi2, freedom), total)
    }

    /// The sampler draws its density.
    fn holds(&self, seed: u32) {
        let (chance, total) = self.chance_and_total(seed);
        println!("{}: chance {chance:.3}, integral {total:.9}", self.name);
        let level = 1.0 - (1.0 - FALSE_ALARM).powf(1.0 / TESTS);
        assert!(chance > level, "{}: chance {chance:e}", self.name);
        let whole = total + self.outside.unwrap_or(0.0);
        assert!(
            self.outside.is_none() || (whole - 1.0).abs() < 1e-5,
            "{}: the density integrates to {whole}",
            self.name
        );
        assert!(total < 1.0 + 1e-5, "{}: {total}", self.name);
    }

    /// The sampler is seen to draw something else.
    fn is_refused(&self, seed: u32) {
        let (chance, _) = self.chance_and_total(seed);
        assert!(chance < 1e-6, "{} passes: {chance}", self.name);
    }
}

fn part((from, to): (f64, f64), index: usize, parts: usize) -> (f64, f64) {
    let step = (to - from) / parts as f64;
    (from + index as f64 * step, from + (index + 1) as f64 * step)
}

fn cell_of(x: f64, (from, to): (f64, f64), parts: usize) -> usize {
    let place = ((x - from) / (to - from) * parts as f64) as usize;
    place.min(parts - 1)
}

/// Azimuth in turns, [0, 1].
fn turns(direction: DVec3) -> f64 {
    (direction.y.atan2(direction.x) / TAU).rem_euclid(1.0)
}

fn direction(cosine: f64, turns: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let (sin_phi, cos_phi) = (TAU * turns).sin_cos();
    DVec3::new(sine * cos_phi, sine * sin_phi, cosine)
}

#[test]
fn the_cosine_hemisphere_is_drawn_by_its_cosine() {
    let of = |density: &dyn Fn(f64, f64) -> f64, refused: bool| {
        let experiment = Experiment {
            name: "cosine hemisphere".to_owned(),
            ranges: [(0.0, 1.0), (0.0, 1.0)],
            draw: &|u, v| {
                let w = sample_cosine_hemisphere(u, v);
                assert!((w.length() - 1.0).abs() < 1e-12);
                (w.z >= 0.0).then(|| [w.z, turns(w)])
            },
            density,
            parts: 2,
            outside: Some(0.0),
        };
        if refused {
            experiment.is_refused(1);
        } else {
            experiment.holds(1);
        }
    };
    of(&|z, _| TAU * z / PI, false);
    of(&|_, _| 1.0, true);
}

#[test]
fn cones_are_drawn_uniformly() {
    for (seed, height) in [(2, 2.0), (3, 1.0), (4, 0.2), (5, 1e-4)] {
        let draw = |u: f64, v: f64| {
            let w = sample_cone(u, v, height);
            assert!((w.length() - 1.0).abs() < 1e-12);
            Some([(1.0 - w.z) / height, turns(w)])
        };
        let uniform = Experiment {
            name: format!("cone of height {height}"),
            ranges: [(0.0, 1.0), (0.0, 1.0)],
            draw: &draw,
            density: &|_, _| 1.0,
            parts: 2,
            outside: Some(0.0),
        };
        uniform.holds(seed);
        let tilted = Experiment {
            density: &|x, _| 0.9 + 0.2 * x,
            ..uniform
        };
        tilted.is_refused(seed);
    }
}

/// Spheres: the angle to the centre over the cone that holds them; from inside the whole sphere of directions.
#[test]
fn spheres_are_drawn_by_light_pdf() {
    let center = DVec3::new(0.3, -0.2, 1.5);
    let distance2 = center.length_squared();
    for (seed, radius) in [(11, 0.01), (12, 0.5), (13, 1.4), (14, 3.0)] {
        let light = Shape::Sphere { center, radius };
        let inside = radius * radius > distance2;
        let height = if inside {
            2.0
        } else {
            cone_height(radius, distance2)
        };
        let frame = frame_of(center.normalize());
        let draw = |u: f64, v: f64| {
            let w = frame.transpose() * sample_light(&light, DVec3::ZERO, u, v);
            let across = (1.0 - w.z) / height;
            (across <= 1.0 + 1e-9).then(|| [across, turns(w)])
        };
        let pdf = |across: f64, around: f64| {
            let w = frame * direction(1.0 - across * height, around);
            light_pdf(&light, DVec3::ZERO, w) * TAU * height
        };
        let right = Experiment {
            name: format!("sphere of radius {radius}"),
            ranges: [(0.0, 1.0), (0.0, 1.0)],
            draw: &draw,
            density: &pdf,
            parts: 2,
            outside: Some(0.0),
        };
        right.holds(seed);
    }
}

/// Rectangles: where the direction meets their plane, with dω = |cos θ| dA / d².
#[test]
fn rectangles_are_drawn_by_light_pdf() {
    let normal = DVec3::new(0.2, -0.5, 1.0).normalize();
    let frame = frame_of(normal);
    let (tangent, bitangent) = (frame.x_axis, frame.y_axis);
    for (seed, center, half_width, half_height) in [
        (21, DVec3::new(0.1, 0.2, 2.0), 0.5, 1.5),
        (22, DVec3::new(2.0, 0.1, -0.6), 1.0, 1.0),
        (23, DVec3::new(0.0, 0.0, 0.05), 4.0, 3.0),
    ] {
        let light = Shape::Rectangle {
            center,
            normal,
            tangent,
            bitangent,
            half_width,
            half_height,
        };
        let draw = |u: f64, v: f64| {
            let w = sample_light(&light, DVec3::ZERO, u, v);
            let distance = center.dot(normal) / w.dot(normal);
            let place = w * distance - center;
            let at = [
                place.dot(tangent) / half_width,
                place.dot(bitangent) / half_height,
            ];
            (distance > 0.0 && at.iter().all(|x| x.abs() <= 1.0 + 1e-9)).then_some(at)
        };
        let to =
            |x: f64, y: f64| center + tangent * (x * half_width) + bitangent * (y * half_height);
        let pdf = |x: f64, y: f64| {
            let place = to(x, y);
            let w = place.normalize();
            let solid_angle = w.dot(normal).abs() / place.length_squared();
            light_pdf(&light, DVec3::ZERO, w) * solid_angle * half_width * half_height
        };
        let right = Experiment {
            name: format!("rectangle at {center}"),
            ranges: [(-1.0, 1.0), (-1.0, 1.0)],
            draw: &draw,
            density: &pdf,
            parts: 2,
            outside: Some(0.0),
        };
        right.holds(seed);
        let uneven = |x: f64, y: f64| pdf(x, y) * (1.0 + 0.1 * x);
        let wrong = Experiment {
            density: &uneven,
            ..right
        };
        wrong.is_refused(seed);
    }
}

/// Disks: by the square of the distance from the centre and the azimuth, in which they are even.
#[test]
fn disks_are_drawn_by_light_pdf() {
    let normal = DVec3::new(0.2, -0.5, 1.0).normalize();
    let frame = frame_of(normal);
    for (seed, center, radius) in [
        (24, DVec3::new(0.1, 0.2, 2.0), 0.5),
        (25, DVec3::new(2.0, 0.1, -0.6), 1.0),
        (26, DVec3::new(0.0, 0.0, 0.05), 4.0),
    ] {
        let light = Shape::Disk {
            center,
            normal,
            tangent: frame.x_axis,
            bitangent: frame.y_axis,
            radius,
        };
        let draw = |u: f64, v: f64| {
            let w = sample_light(&light, DVec3::ZERO, u, v);
            let distance = center.dot(normal) / w.dot(normal);
            let place = frame.transpose() * (w * distance - center) / radius;
            let out = place.x * place.x + place.y * place.y;
            (distance > 0.0 && out <= 1.0 + 1e-9).then(|| [out, turns(place)])
        };
        let pdf = |out: f64, around: f64| {
            let aside = direction(0.0, around) * (radius * out.sqrt());
            let place = center + frame * aside;
            let w = place.normalize();
            let solid_angle = w.dot(normal).abs() / place.length_squared();
            // dA = ½ dr² dφ
            light_pdf(&light, DVec3::ZERO, w) * solid_angle * PI * radius * radius
        };
        let right = Experiment {
            name: format!("disk at {center}"),
            ranges: [(0.0, 1.0), (0.0, 1.0)],
            draw: &draw,
            density: &pdf,
            outside: Some(0.0),
            parts: 4,
        };
        right.holds(seed);
        let uneven = |x: f64, y: f64| pdf(x, y) * (0.85 + 0.3 * x);
        let wrong = Experiment {
            density: &uneven,
            ..right
        };
        wrong.is_refused(seed);
    }
}

/// Parts of the surroundings and discs in the sky: by the height about an axis and the azimuth.
#[test]
fn surroundings_are_drawn_by_environment_pdf() {
    let towards = DVec3::new(0.3, 0.8, -0.4).normalize();
    let disc = |height| EnvironmentShape::Disc { towards, height };
    for (seed, part, axis, least) in [
        (81, EnvironmentShape::Everywhere, DVec3::Y, -1.0),
        (82, EnvironmentShape::Horizon, DVec3::Y, -1.0),
        (83, EnvironmentShape::Pole(DVec3::Y), DVec3::Y, 0.0),
        (84, EnvironmentShape::Pole(DVec3::NEG_Y), DVec3::NEG_Y, 0.0),
        (85, disc(1.1e-5), towards, 1.0 - 1.1e-5),
        (86, disc(0.3), towards, 0.7),
    ] {
        let frame = frame_of(axis);
        let depth = 1.0 - least;
        let draw = |u: f64, v: f64| {
            let w = frame.transpose() * sample_environment(part, u, v);
            assert!((w.length() - 1.0).abs() < 1e-12);
            let across = (1.0 - w.z) / depth;
            (across <= 1.0 + 1e-9).then(|| [across, turns(w)])
        };
        let pdf = |across: f64, around: f64| {
            let w = frame * direction(1.0 - across * depth, around);
            environment_pdf(part, w) * TAU * depth
        };
        let right = Experiment {
            name: format!("{part:?}"),
            ranges: [(0.0, 1.0), (0.0, 1.0)],
            draw: &draw,
            density: &pdf,
            outside: Some(0.0),
            parts: 4,
        };
        right.holds(seed);
        let uneven = |x: f64, y: f64| pdf(x, y) * (0.85 + 0.3 * y);
        let wrong = Experiment {
            density: &uneven,
            ..right
        };
        wrong.is_refused(seed);
    }
}

/// Facets, by q = 1 − exp(−tan²α / m²) and the azimuth; the density is taken for the slope `claimed`.
fn facets(slope: f64, claimed: f64, check: impl Fn(&Experiment)) {
    let draw = |u: f64, v: f64| {
        let h = DVec3::from_array(sample_beckmann(u, v, slope));
        let tan2 = (h.x * h.x + h.y * h.y) / (h.z * h.z);
        Some([-(-tan2 / (slope * slope)).exp_m1(), turns(h)])
    };
    let density = |q: f64, _| {
        let tan2 = -slope * slope * (-q).ln_1p();
        let cosine = 1.0 / (1.0 + tan2).sqrt();
        let cosine_per_q = 0.5 * cosine.powi(3) * slope * slope / (1.0 - q);
        half_vector_pdf(cosine, claimed) * TAU * cosine_per_q
    };
    check(&Experiment {
        name: format!("facets of slope {slope}"),
        ranges: [(0.0, 1.0), (0.0, 1.0)],
        draw: &draw,
        density: &density,
        parts: 2,
        outside: Some(0.0),
    });
}

#[test]
fn facets_are_drawn_by_half_vector_pdf() {
    for (seed, slope) in (31..).zip(SLOPES) {
        facets(slope, slope, |experiment| experiment.holds(seed));
    }
}

#[test]
fn facets_of_another_slope_are_noticed() {
    for (seed, slope) in (31..).zip(SLOPES) {
        facets(slope, 0.97 * slope, |wrong| wrong.is_refused(seed));
    }
}

/// Facets of a Gaussian distribution of angles a, by q = (1 − exp(−a² / m²)) / Z and the azimuth; the density is taken for the slope
/// `claimed`.
fn gaussian_facets(slope: f64, claimed: f64, check: impl Fn(&Experiment)) {
    let (share, m2) = (gaussian_share(slope), slope * slope);
    let draw = |u: f64, v: f64| {
        let h = DVec3::from_array(sample_gaussian(u, v, slope));
        let angle = h.x.hypot(h.y).atan2(h.z);
        Some([-(-angle * angle / m2).exp_m1() / share, turns(h)])
    };
    let density = |q: f64, _| {
        let angle = slope * (-(-q * share).ln_1p()).sqrt();
        let angle_per_q = share * m2 / (2.0 * angle * (1.0 - q * share));
        gaussian_pdf(angle.cos(), claimed) * TAU * angle.sin() * angle_per_q
    };
    check(&Experiment {
        name: format!("Gaussian facets of slope {slope}"),
        ranges: [(0.0, 1.0), (0.0, 1.0)],
        draw: &draw,
        density: &density,
        outside: Some(0.0),
        parts: 4,
    });
}

#[test]
fn gaussian_facets_are_drawn_by_gaussian_pdf() {
    for (seed, slope) in (41..).zip(SLOPES) {
        gaussian_facets(slope, slope, |experiment| experiment.holds(seed));
    }
}

#[test]
fn gaussian_facets_of_another_slope_are_noticed() {
    for (seed, slope) in (41..).zip(SLOPES) {
        gaussian_facets(slope, 0.95 * slope, |wrong| wrong.is_refused(seed));
    }
}

/// Mirrored directions, by half of the angle to the eye and the azimuth about the eye. A facet that the eye sees from behind
/// mirrors nothing; directions below the horizon are counted like the others, as the density has them too.
fn mirrored(slope: f64, eye_degrees: f64, claimed: f64, check: impl Fn(&Experiment)) {
    let tilt = eye_degrees.to_radians();
    let eye = DVec3::new(tilt.sin(), 0.0, tilt.cos());
    // The normal lies at half a turn.
    let aside = DVec3::new(tilt.cos(), 0.0, -tilt.sin());
    let draw = |u: f64, v: f64| {
        let facet = DVec3::from_array(sample_beckmann(u, v, slope));
        let cosine = eye.dot(facet);
        if cosine <= 0.0 {
            return None;
        }
        let light = 2.0 * cosine * facet - eye;
        let half = 0.5 * light.cross(eye).length().atan2(light.dot(eye));
        let around = (light.y.atan2(light.dot(aside)) / TAU).rem_euclid(1.0);
        Some([half, around])
    };
    // Four slopes about the normal hold all but e⁻¹⁶ of the facets.
    let reach = (4.0 * slope).atan();
    let half = ((tilt - reach).max(0.0), (tilt + reach).min(0.5 * PI));
    let turn = if tilt > reach {
        (reach.sin() / tilt.sin()).min(1.0).asin() / TAU
    } else {
        0.5
    };
    let around = (0.5 - turn, 0.5 + turn);
    let inside = |at: &[f64; 2]| {
        (half.0..=half.1).contains(&at[0]) && (around.0..=around.1).contains(&at[1])
    };
    let density = |half: f64, around: f64| {
        let (sine, cosine) = (2.0 * half).sin_cos();
        let (sin_phi, cos_phi) = (TAU * around).sin_cos();
        let light = eye * cosine + (aside * cos_phi + DVec3::Y * sin_phi) * sine;
        let facet = (eye + light).normalize();
        reflected_pdf(facet.z, eye.dot(facet), claimed) * 2.0 * sine * TAU
    };
    check(&Experiment {
        name: format!("mirrored at slope {slope}, eye at {eye_degrees}°"),
        ranges: [half, around],
        draw: &|u, v| draw(u, v).filter(inside),
        density: &density,
        parts: 2,
        outside: None,
    });
}

fn each_view(check: impl Fn(u32, f64, f64)) {
    for (i, slope) in (0..).zip(SLOPES) {
        for (j, eye) in (0..).zip(EYES_DEGREES) {
            check(100 + 10 * i + j, slope, eye);
        }
    }
}

#[test]
fn mirrored_directions_are_drawn_by_reflected_pdf() {
    each_view(|seed, slope, eye| mirrored(slope, eye, slope, |right| right.holds(seed)));
}

#[test]
fn mirrored_directions_of_another_slope_are_noticed() {
    each_view(|seed, slope, eye| {
        mirrored(slope, eye, 0.95 * slope, |wrong| wrong.is_refused(seed));
    });
}

/// What a lossless rough mirror returns, by drawing facets whose density is taken for the slope `claimed`: mean and its
/// standard error.
fn sampled_albedo(eye: DVec3, slope: f64, claimed: f64, seed: u32) -> (f64, f64) {
    let (mut sum, mut squares) = (0.0, 0.0);
    for (u, v) in numbers(seed) {
        let facet = DVec3::from_array(sample_beckmann(u, v, slope));
        let light = 2.0 * eye.dot(facet) * facet - eye;
        let met = cook_torrance(eye, light, slope);
        if met.pdf > 0.0 && eye.dot(facet) > 0.0 {
            let share = half_vector_pdf(facet.z, claimed) / half_vector_pdf(facet.z, slope);
            let weight = met.reflection * light.z / (met.pdf * share);
            sum += weight;
            squares += weight * weight;
        }
    }
    let count = f64::from(SAMPLES);
    let mean = sum / count;
    (mean, ((squares / count - mean * mean) / count).sqrt())
}

/// The same by the midpoint rule over facets.
fn integrated_albedo(eye: DVec3, slope: f64) -> f64 {
    const STEPS: usize = 1000;
    let mut sum = 0.0;
    for i in 0..STEPS {
        let alpha = (4.5 * slope).atan() * (i as f64 + 0.5) / STEPS as f64;
        for j in 0..STEPS {
            let facet = direction(alpha.cos(), (j as f64 + 0.5) / STEPS as f64);
            let cosine = eye.dot(facet);
            let light = 2.0 * cosine * facet - eye;
            if cosine > 0.0 && light.z > 0.0 {
                // dω of the mirrored direction is 4 (E·H) dω of the facet.
                let f = optics::cook_torrance(eye.to_array(), light.to_array(), slope);
                sum += f * light.z * 4.0 * cosine * alpha.sin();
            }
        }
    }
    sum * (4.5 * slope).atan() * TAU / (STEPS * STEPS) as f64
}

/// White furnace: no more returns than comes, and both ways to compute what returns agree within 4.5 standard errors and the
/// 1e-5 of the midpoint rule.
#[test]
fn a_lossless_surface_returns_at_most_everything() {
    each_view(|seed, slope, degrees| {
        let tilt = degrees.to_radians();
        let eye = DVec3::new(tilt.sin(), 0.0, tilt.cos());
        let by_rule = integrated_albedo(eye, slope);
        let (drawn, error) = sampled_albedo(eye, slope, slope, seed);
        println!("slope {slope}, eye {degrees}°: {by_rule:.6} and {drawn:.6} ± {error:.6}");
        assert!(by_rule <= 1.0 + 1e-5, "{by_rule}");
        assert!(by_rule > 0.3, "{by_rule}");
        assert!((by_rule - drawn).abs() < 4.5 * error + 1e-5);
        // Near grazing the weights scatter too much to tell.
        if degrees <= 30.0 {
            let (wrong, error) = sampled_albedo(eye, slope, 0.9 * slope, seed);
            let noticed = (by_rule - wrong).abs() > 4.5 * error + 1e-5;
            assert!(noticed, "a wrong density is not noticed");
        }
    });
}

/// f(E, L) = f(L, E) (Helmholtz); with the cosine of one side it is not so, which shows that the test can fail.
#[test]
fn rough_reflection_is_reciprocal() {
    let mut lopsided = 0;
    let mut compared = 0;
    for ((u1, v1), (u2, v2)) in numbers(71).zip(numbers(72)).take(20_000) {
        let a = sample_cosine_hemisphere(u1, v1);
        let b = sample_cosine_hemisphere(u2, v2);
        for slope in SLOPES {
            let there = cook_torrance(a, b, slope).reflection;
            let back = cook_torrance(b, a, slope).reflection;
            assert!((there - back).abs() <= 1e-12 * there, "{a} {b} {slope}");
            compared += u32::from(there > 0.0);
            let off = (there * b.z - back * a.z).abs();
            lopsided += u32::from(off > 1e-12 * there);
        }
    }
    assert!(compared > 50_000 && lopsided > 50_000);
}

#[test]
fn the_chance_of_a_chi_square_is_that_of_the_tables() {
    // Upper 5 %, 1 % and 0.1 % points (Abramowitz and Stegun, table 26.8).
    for (chi2, freedom, expected) in [
        (43.773, 30.0, 0.05),
        (50.892, 30.0, 0.01),
        (59.703, 30.0, 0.001),
        (124.342, 100.0, 0.05),
        (149.449, 100.0, 0.001),
    ] {
        let found = chance(chi2, freedom);
        assert!((found / expected - 1.0).abs() < 0.03, "{found} {expected}");
    }
}
