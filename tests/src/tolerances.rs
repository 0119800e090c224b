//! All tolerances of the test suites, each with its reason.
//!
//! One f32 rounding is 6e-8 (ε). WGSL allows division 2.5 ulp, sqrt about 2 ulp more, exp 3 + 2|x| ulp. The figures
//! below are the error that a formula makes of these, with room for a driver that uses all the error it is allowed.

use crate::agreement::Tolerance;

const fn of(absolute: f64, relative: f64) -> Tolerance {
    Tolerance { absolute, relative }
}

/// Integers and copies: the same bits.
pub const EXACT: Tolerance = of(1e-300, 0.0);
/// Polynomials of a few terms and sums of a few products of numbers of order one.
pub const ARITHMETIC: Tolerance = of(5e-7, 5e-7);
/// Trigonometric polynomials: a few ε of the largest term.
pub const TRIGONOMETRY: Tolerance = of(4e-7, 4e-7);
/// Directions: unit vectors after a rotation and a normalization, each coordinate.
pub const DIRECTION: Tolerance = of(1.5e-6, 0.0);
/// Bare surfaces: R comes from a complex root and two quotients; near grazing, 1 − R keeps an absolute error.
pub const FRESNEL: Tolerance = of(2e-6, 2e-6);
/// A film of up to 2 µm and index 2.5, up to 88°: its phase has up to 28 half turns, which f32 keeps to 5e-6, times
/// the steepness of its fringes (an independent f32 computation is off by at most 2e-5 up to 88° on ordinary stacks).
pub const FILM: Tolerance = of(5e-5, 0.0);
/// A film of up to 1 µm beyond 88°, where the fringes are steepest (the same computation: 1.3e-4 at 89°).
pub const FILM_GRAZING: Tolerance = of(3e-4, 0.0);
/// A film for s and p apart: the fringes of s are up to twice as steep as those of unpolarized light (at worst 5.4e-5 in 800 000 numbers).
pub const FILM_POLARIZED: Tolerance = of(1e-4, 0.0);
/// The same beyond 88°.
pub const FILM_POLARIZED_GRAZING: Tolerance = of(6e-4, 0.0);
/// Axes across two directions at least some 0.1 apart: their cross product loses a digit.
pub const AXIS: Tolerance = of(5e-6, 0.0);
/// A film of up to 20 µm, up to 80°: 280 half turns, ten times the phase error (the same computation: 1e-4 at 10 µm).
pub const FILM_THICK: Tolerance = of(3e-4, 0.0);
/// Stacks of 64 layers of up to 150 nm without absorption: 40 half turns in all, and resonances between distant layers, whose
/// sharpness magnifies the rounding of the phase (at worst 2.8e-4 in 120 000 on a software driver; other drivers round differently).
pub const FILM_LONG: Tolerance = of(1e-3, 0.0);
/// Densities and reflection functions of facets: exp of up to −80 with 3 + 2|x| ulp and a cosine to the fourth power.
pub const FACET: Tolerance = of(1e-6, 3e-5);
/// Directions from their height: near a pole the sine is the root of 1 − h², which loses half the digits.
pub const NEAR_POLE: Tolerance = of(5e-5, 0.0);
/// Smooth spectra with coefficients to 20: the quadratic is off by 4e-6, and the sigmoid's slope is at most a half.
pub const SMOOTH: Tolerance = of(3e-6, 1e-6);
/// exp(x²) erfc(x) and what is computed from it: exp and nine terms, each 2 ulp.
pub const SCALED_ERFC: Tolerance = of(1e-7, 2e-6);
/// A first guess at erf⁻¹, whose formula is off by 2e-3, and in f32 by √(5e-7) where the logarithm is near 0.
pub const ROUGH_INVERSE: Tolerance = of(3e-3, 3e-3);
/// Smith's Λ: the difference of two terms of the same size times exp of up to −36.
pub const LAMBDA: Tolerance = of(1e-6, 1e-5);
/// Densities of facets of α from 0.1: a half vector's slope is off by 1e-6/α, its square in an exponent of up to −80 by 1e-4.
pub const FACETS: Tolerance = of(2e-6, 2e-4);
/// Values of BSDFs with their spectra: FACETS, and a film's reflectance at a facet whose cosine is off by 1e-7/c.
pub const SURFACE_FUNCTIONS: Tolerance = of(2e-6, 3e-4);
/// Values of BSDFs with `wo` and `wi` exchanged: the promised reciprocity, and values that have no digits left in f32.
pub const RECIPROCITY: Tolerance = of(1e-9, 1e-5);
/// Directions of facets sampled with numbers up to 0.999, where the density of the slope has fallen to 1e-2 of its maximum.
pub const FACET_DIRECTION: Tolerance = of(3e-5, 0.0);
/// Densities of facets of α from 0.02, also near the horizon: a half vector's slope is off by 1e-6/α, more where both cosines are
/// small.
pub const NARROW_FACETS: Tolerance = of(2e-6, 1e-3);
/// Directions of facets sampled with the last number below 1, where one part in 2²⁴ changes the slope by 0.06 of 3.7.
pub const FACET_TAIL: Tolerance = of(2e-3, 0.0);
/// Slopes sampled with that number.
pub const SLOPE_TAIL: Tolerance = of(1e-2, 0.0);
/// A position in a table of 31 steps, off by 1e-6, at the width of the slopes in the direction's azimuth.
pub const FACET_ENERGY: Tolerance = of(2e-6, 0.0);
/// A frame along a grain whose sine to the normal is at least 0.1.
pub const FRAME: Tolerance = of(5e-6, 0.0);
/// Distances along rays: scaled by the coordinates (up to 10) and divided by a cosine.
pub const DISTANCE: Tolerance = of(1e-5, 1e-5);
/// Densities of emitters: squares of distances over cosines.
pub const EMITTER_PDF: Tolerance = of(1e-6, 3e-5);
/// Thickness over a surface: the angle's error of 3e-7 times nm per radian, and the thickness's own rounding.
pub const THICKNESS_NM: Tolerance = of(1e-3, 1e-6);
/// Thickness from a picture of 12 × 7 pixels: a position off by 4e-7 of the picture, times 12 pixels with a contrast of up to 600 nm.
pub const PICTURE_NM: Tolerance = of(3e-3, 1e-6);
/// Thickness from a table of squares: as THICKNESS_NM, but the root is steep where the film is thin: h² / (2 h) with 4e6 nm² times 4e-7.
pub const PROFILE_NM: Tolerance = of(3e-3, 3e-6);
/// Noise with coordinates up to 20: these are off by 1e-6, and gradients by 20 times that, through the second derivatives.
pub const NOISE: Tolerance = of(2e-5, 0.0);
/// Thickness from swirls: the position is off by 1e-6 cells, which three steps of the flow and four octaves magnify some hundred
/// times; times the gain of 5 and 250 nm.
pub const SWIRLS_NM: Tolerance = of(0.05, 0.0);
/// exp(iπx) with x to 6: the angle is rounded by up to 2.4e-7 half turns before it is reduced.
pub const PHASE: Tolerance = of(1.5e-6, 0.0);
/// Beckmann's D: the exponent tan²/m² of up to 80 has an error of 3 ε of its own size.
pub const BECKMANN: Tolerance = of(1e-6, 6e-5);
/// ln(1 − u): WGSL gives log an absolute error of 2⁻²¹ near 1, 3 ulp elsewhere.
pub const LOGARITHM: Tolerance = of(5e-7, 1e-6);
/// Height of a cone from the quotient of two squares: near the surface the root of 1 − sin² doubles the number of digits lost.
pub const CONE: Tolerance = of(5e-7, 2e-5);
/// Distance to a sphere with the ray at least 1e-3 off its edge: the root √(r² − d²) magnifies by up to r / √(2·1e-3·r) ≈ 27.
pub const SPHERE_DISTANCE: Tolerance = of(4e-5, 1e-5);

/// When two renders of the same random numbers count as the same picture.
#[derive(Clone, Copy, Debug)]
pub struct FrameTolerance {
    /// 99th percentile of the relative error in every band: f32 geometry over some ten bounces keeps 1e-4 or better.
    pub p99: f64,
    /// Mean signed error over the mean, in every band, without the outliers: rounding has no preferred sign.
    pub bias: f64,
    /// A pixel with a larger relative error in any band is an outlier: f32 took another branch (an edge, a checker's line,
    /// the choice at a film) for at least one of its samples.
    pub outlier: f64,
    /// Fraction of the pixels that may be outliers: the branches that lie within 1e-6 of the deciding value.
    pub outlier_fraction: f64,
    /// Dark values are compared with this fraction of the picture's mean instead of with themselves.
    pub floor: f64,
}

/// The tolerance of all frames.
pub const FRAMES: FrameTolerance = FrameTolerance {
    p99: 1e-3,
    bias: 1e-4,
    outlier: 1e-2,
    outlier_fraction: 5e-3,
    floor: 1e-2,
};

/// The same picture with its light added up in another order: rounding of some ten sums of f32.
pub const SUMS: FrameTolerance = FrameTolerance {
    p99: 1e-5,
    bias: 1e-6,
    outlier: 1e-4,
    outlier_fraction: 0.0,
    floor: 1e-2,
};

/// Largest |z| of a picture's mean difference under different random numbers: 4.5 standard errors, 1 in 150 000, over some
/// hundred bands and scenes.
pub const Z_MEAN: f64 = 4.5;
/// Fraction of blocks whose |z| may exceed 3: 0.27 % for a normal distribution, more for the skewed sums of rare bright paths.
pub const Z_OVER_3: f64 = 0.03;

/// Single paths: one sample per pixel, so a flipped branch is not diluted, and there are fewer pixels than in a frame.
pub const PATHS: FrameTolerance = FrameTolerance {
    outlier_fraction: 5e-3,
    ..FRAMES
};

/// R and T of stacks against independent f64 computations: these are good to 5e-14, and a stack of seven layers loses two or three
/// digits in either arithmetic.
pub const ORACLE: Tolerance = of(1e-10, 0.0);
/// A BSDF whose color of multiple scattering comes from a table, linear between knots of 1 nm, relative to its largest value: indices of
/// metals bend most between their knots in the blue.
pub const COLOR_TABLE: f64 = 2e-5;
/// The benchmark's wedge against the integral, with 1024 Sobol points per pixel, relative to the mean: mostly the error of the points.
pub const WEDGE: f64 = 1e-4;
/// Pictures with and without fused multiply-add, relative to their brightest value. Values are stored as `f32` (6e-8); the facets of a
/// rough metal carry the last digits of an `f64` through a few ill-conditioned steps, far below that.
pub const BASELINE: f64 = 1e-6;
/// Identities of stacks in f64 (energy, both directions, layers split or absent): rounding of some ten layers, times the
/// number of times that light crosses a layer near grazing.
pub const IDENTITY: f64 = 1e-12;
/// Stacks against 50-digit figures: rounding of up to 21 layers, and of a phase of up to 1200 rad (1e-13) in films of 30 µm; observed:
/// 4e-15 for ordinary stacks, 2e-14 for thick ones and mirrors.
pub const ORACLE_STACKS: Tolerance = of(1e-13, 0.0);
/// The two-beam formula against independent f64 figures of 15 digits: a cosine of some ten turns and four products.
pub const ORACLE_TWO_BEAM: Tolerance = of(1e-10, 0.0);
/// Derivatives by thickness, nm⁻¹, of random stacks against central differences over 0.2 and 0.1 nm, extrapolated: their errors are
/// 1e-15/0.1 from rounding and h⁴ ∂⁵R/∂d⁵ / 480, which with 2π n/λ · 2 ≤ 0.1 nm⁻¹ per order and resonances is below 1e-9.
pub const DERIVATIVE: f64 = 2e-8;
/// Linear sRGB of independent XYZ of ten digits: the matrix has elements of up to 3.2, and XYZ enters over 100.
pub const ORACLE_RGB: Tolerance = of(1e-10, 1e-8);
/// XYZ against independent sums over the same 401 wavelengths: the figures have ten to twelve digits.
pub const ORACLE_XYZ: Tolerance = of(0.0, 1e-9);
/// Mean XYZ of two pictures rendered with the same random numbers: the bias of the bands, and outliers of a few pixels in ten thousand.
pub const SAME_COLOR: f64 = 1e-3;
/// The furnace: how many standard errors the mean of a band may be off.
pub const Z_FURNACE: f64 = 4.0;

/// Largest mean FLIP between a picture and its golden. The same driver produces the same bits. The f64 reference, whose rounding
/// differs as another driver's does, is within 6e-5 of the goldens made on a software driver. Forty times that leaves
/// room for drivers that use all the error they are allowed; a film index that is one percent higher gives 0.05 or more.
pub const PICTURES: f64 = 0.002;

/// Tolerance for the variances of two renders with the same random numbers.
#[derive(Clone, Copy, Debug)]
pub struct VarianceTolerance {
    /// 99th percentile of the relative error in every band. A variance is a sum of squared differences from the mean, so it
    /// carries a few times the relative error of the samples.
    pub p99: f64,
    /// Small variances are compared with this fraction of the picture's mean variance instead of with themselves.
    pub floor: f64,
    /// The fraction of radiance² that rounding alone may turn into variance: samples in f32 are off by some ten ε ≈ 1e-6.
    pub rounding: f64,
}

/// The tolerance of all variances.
pub const VARIANCES: VarianceTolerance = VarianceTolerance {
    p99: 5e-3,
    floor: 1e-2,
    rounding: 1e-10,
};

/// Closed forms: relative error besides the noise. The view is some thousandths of the distances wide (squared: below
/// 1e-5), and f32 geometry, optics and sums of a million samples add as much again.
pub const CLOSED_FORM: f64 = 2e-5;
/// Ground under a clear sky against integrals of its formulas: the sky is rendered as a picture with pixels of 1.4°, bilinear between
/// their centers.
pub const SKY_PICTURE: f64 = 3e-4;
/// Albedo of rough metals: the tables of facet energy are linear between 32 cosines and computed from 48² facets.
pub const ROUGH_FORM: f64 = 5e-4;
/// White furnace of rough surfaces: the error that the tables of facet energy promise, noise included.
pub const FURNACE_ROUGH: f64 = 5e-3;
/// The largest standard error of a mean that is used as proof.
pub const FURNACE_ERROR: f64 = 2e-3;
/// Closed forms without random numbers: a Fresnel quotient or an interpolation, in f32.
pub const CLOSED_FORM_EXACT: f64 = 5e-6;
/// Stokes vectors of a few events, relative to S0: the reference computes in f64 and stores f32, which rounds by 6e-8.
pub const POLARIZED: f64 = 1e-6;
/// The same in f32, as FILM: the phase between s and p is the difference of two phases of the film.
pub const POLARIZED_F32: f64 = 5e-5;
/// S0 of one interaction with and without polarization in f32: the same formulas up to the order of their sums.
pub const SAME_S0_F32: f64 = 1e-5;
/// Polarization of a sky over pixels of 22°, against the mean over 64 of their rays: radiance, which is the weight of a ray, varies over
/// a pixel by some tens of percent.
pub const SKY_POLARIZATION: f64 = 0.02;
/// Ellipsometric angles, degrees: a fiftieth of what a nanometer of oxide on silicon changes ψ by.
pub const ELLIPSOMETRY_DEG: f64 = 0.01;
/// Films of some 30 half turns at fixed wavelengths: as FILM, relative to an R of a tenth.
pub const CLOSED_FORM_FILM: f64 = 2e-4;
/// Transmission of light from a small emitter through a film, against T at normal incidence: at θ ≤ 0.02 the phase (three half turns of
/// 100 nm per fringe) changes by θ² / 2 = 2e-4 of itself.
pub const NEARLY_NORMAL: f64 = 5e-4;
/// A small emitter out of focus: mean r² and light of its disk, which 50 000 samples hit (independent ones would leave 0.5 %); its outline,
/// seen from the rim of the lens, is 0.25 % longer.
pub const OUT_OF_FOCUS: f64 = 0.015;
/// Each pixel's fraction of the light of a small emitter, 1 in total: 6000 samples hit it in the middle. There the two filters
/// differ by 0.15.
pub const PIXEL_FILTER: f64 = 0.02;
/// Largest relative standard error of a mean that is used to prove a closed form: 4.5 of them detect a factor of 1.02.
pub const PROVING_ERROR: f64 = 4e-3;

/// Just outside a sphere emitter, from 1.000 008 radii: the cone's height is 1 − √(1 − sin²) with 1 − sin² down to 1.6e-5, which
/// has an error of 2e-6 from the coordinates; the root makes that 2.5e-4 of the height, and the density follows it.
pub const NEAR_LIGHT: Tolerance = of(5e-4, 5e-4);
/// Estimated contributions of emitters: points keep 3e-7 of coordinates of some units, which a squared distance of a tenth turns into 1e-5;
/// the edges of cones add a little.
pub const EMITTER_WEIGHT: Tolerance = of(5e-5, 1e-5);
/// The probability of one of many emitters: a product of some eight quotients of sums, each rounded a few times. The roundings of the
/// estimates themselves cancel in the quotients, except for points very close to a group.
pub const EMITTER_TREE: Tolerance = of(2e-5, 1e-7);
/// Between two knots of a table of 33: the position is rounded by 2e-6 of a step, which near grazing changes R by up to a half.
pub const ARITHMETIC_OF_TABLES: Tolerance = of(2e-6, 1e-6);
/// A pixel filter's offset between two of 257 knots: the position is rounded by some 2e-5 of a step, and the longest steps, at the ends,
/// are a fraction of a pixel.
pub const FILTER: Tolerance = of(5e-6, 1e-6);
/// A knot and the position after it: offset times up to 32 steps is rounded by 1e-6.
pub const KNOT: Tolerance = of(2e-6, 0.0);
/// A value between two knots: the position is off by up to 1e-6 of the difference between them.
pub const SPECTRUM: Tolerance = of(2e-6, 2e-6);

/// Mean ΔE2000 between a picture relit from its bands and one rendered under the lamp. The promise is 0.5, half a just noticeable
/// difference, with 40 bands for smooth lamps and 80 for lamps with lines; observed: 0.01 to 0.03.
pub const RELIT_DELTA_E: f64 = 0.15;
/// ΔE2000 of a film's color between 16 and 80 bands, in every one of the eight columns of a wedge. The rest is noise: in a
/// band of 25 nm the lines of a lamp vary by twice their mean, which the 131 072 samples of a column reduce to 0.6 %; observed: mean
/// 0.02, largest 0.03.
pub const BANDS_DELTA_E: f64 = 0.3;
/// ΔE2000 of a plate rendered with 4096 samples: the remaining noise, and relighting with bands of 5 nm.
pub const METAMERS_DELTA_E: f64 = 0.3;

/// The noise that a render says it has, relative to that between 16 seeds: the promise. The estimate is exact but for its power law, and
/// what it says of one seed scatters by 5 % to 10 %.
pub const NOISE_ESTIMATE: f64 = 0.2;
