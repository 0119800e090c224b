//! The allowed ranges of a scene's numbers.
//!
//! They keep every product that a renderer computes well within `f32`, and are wide enough for anything that thin films and metals need.
//! The JSON Schema shows the same numbers.

use document::Range;
pub use media::limits::FRACTION;
pub use scene::limits::{
    MAX_FIELD_DEPTH, MAX_LAYERS, MAX_LIGHT_GROUPS, MAX_MATERIALS, OCTAVES, THICKNESS_NM,
};

/// A coordinate of a point or direction. `f32` resolves 0.06 at the ends.
pub const COORDINATE: Range = Range::new(-1e6, 1e6, "");
/// A radius, side or height.
pub const LENGTH: Range = Range::new(1e-6, 1e6, "");
/// Length of a direction vector before it is normalized, and distance between two points that define one.
pub const MIN_DISTANCE: f64 = 1e-6;
/// Sine of the smallest angle between two directions that span a plane (about 0.006°).
pub const MIN_SINE: f64 = 1e-4;
/// Vertical field of view. At 179.9° the picture is already 1100 times as high as its distance.
pub const FOV_DEG: Range = Range::new(0.001, 179.9, "°");
/// The maximum number of parts of a thickness, including sums and products.
pub const MAX_FIELD_PARTS: usize = 64;
/// The largest allowed value of a sum or product within a thickness: its products stay within `f32`.
pub const MAX_FIELD_VALUE: f64 = 1e9;
/// The maximum number of values of a stepped thickness.
pub const MAX_STEPS: usize = 4096;
/// Size of the largest swirls, in scene units or in radii of a sphere.
pub const SWIRL_SCALE: Range = Range::new(1e-3, 1e6, "");
/// Distance by which the flow carries swirls, relative to their size.
pub const WARP: Range = Range::new(0.0, 4.0, "");
/// Rate at which swirls change, in lives of a swirl per second.
pub const SWIRL_RATE: Range = Range::new(0.0, 1000.0, " per second");
/// The maximum width and height of a picture, in pixels.
pub const MAX_PICTURE_SIDE: u32 = 16_384;
/// The maximum number of pixels of such a picture: 16384 × 8192. A panorama of this size takes 4.3 GB while it is read, and 2.1 GB in the
/// scene.
pub const MAX_PICTURE_PIXELS: u64 = 1 << 27;
/// The maximum of the pixels of a spectral picture times the scene's bands, rounded up to a multiple of four: 512 MiB.
pub const MAX_PICTURE_VALUES: u64 = 1 << 27;
/// The maximum size of a picture file, in bytes: 2²⁷ pixels of four numbers each.
pub const MAX_PICTURE_BYTES: u64 = 2 << 30;
/// How far the width of a picture of all directions may differ from twice its height: as a fraction of the width, or in pixels.
pub const PANORAMA_TOLERANCE: (f64, u32) = (0.01, 2);
/// Time, and the time step of a sequence.
pub const TIME_S: Range = Range::new(0.0, 1e9, " s");
/// A viscosity.
pub const VISCOSITY_PA_S: Range = Range::new(1e-9, 1e6, " Pa s");
/// The density of a liquid.
pub const DENSITY_KG_M3: Range = Range::new(1.0, 25_000.0, " kg/m³");
/// Radius or height of a draining film.
pub const FILM_SIZE_M: Range = Range::new(1e-6, 1e3, " m");
/// Initial thickness of a draining film. The drop at a bubble's lowest point is cut off at the upper end of the range.
pub const DRAINING_NM: Range = Range::new(0.0, 20_000.0, " nm");
/// Anodizing voltage: films on titanium break down at about 100 to 150 V.
pub const VOLTS: Range = Range::new(0.0, 150.0, " V");
/// Growth of an anodic film. Valve metals have 1 to 3.
pub const NM_PER_VOLT: Range = Range::new(0.1, 10.0, " nm/V");
/// Temperature of a heat tint: the temper colors of carbon steel, with some margin.
pub const HEAT_TINT_C: Range = Range::new(150.0, 400.0, " °C");
/// Time of a heat tint.
pub const MINUTES: Range = Range::new(0.0, 600.0, " min");
/// Radiance, its scale and their product: its square, which the variance needs, times 2²⁴ samples fits in `f32`.
pub const EMISSION: Range = Range::new(0.0, 1e9, "");
/// Radiance, luminance, power in watts or lumens, irradiance, illuminance or intensity of a light in its unit; the resulting spectrum must
/// be in [`EMISSION`]. The sun's luminance is 1.6e9 cd/m².
pub const STRENGTH: Range = Range::new(0.0, 1e12, "");
/// Angular diameter of a distant light: at most half of the sky.
pub const ANGULAR_DIAMETER_DEG: Range = Range::new(0.0, 180.0, "°");
/// The smallest angular diameter above 0: below it, the rounding of directions to `f32` would be visible.
pub const MIN_ANGULAR_DIAMETER_DEG: f64 = 0.01;
/// Angle of the cone of a spot.
pub const SPOT_DEG: Range = Range::new(0.1, 180.0, "°");
/// The sharpest edge of a spot: the largest fraction of its angle with the full intensity.
pub const SPOT_SHARPEST: f64 = 0.99;
/// The maximum number of lights that are not objects.
pub const MAX_LIGHTS: usize = 1024;
/// The maximum number of distant lights with a diameter: every ray that leaves the scene tests each of them.
pub const MAX_DISTANT_DISKS: usize = 16;
/// Roughness, if it is not 0. The highlight's exponent (tan θ / m)² has a relative error of about 2⁻²³ / m² in `f32`: 3e-4 at m = 0.02, and
/// more for smoother surfaces, until the highlight is mostly rounding error.
pub const ROUGHNESS: Range = Range::new(0.02, 1.0, "");
/// Elevation of the sun.
pub const SUN_ELEVATION_DEG: Range = Range::new(0.0, 90.0, "°");
/// Turbidity of a sky.
pub const TURBIDITY: Range = Range::new(
    spectra::sky::ClearSky::TURBIDITY.0,
    spectra::sky::ClearSky::TURBIDITY.1,
    "",
);
/// A rotation of the environment.
pub const ROTATION_DEG: Range = Range::new(-360.0, 360.0, "°");
/// The angle of a polarizer, a retarder or polarized light.
pub const POLARIZATION_DEG: Range = Range::new(-360.0, 360.0, "°");
/// Ellipticity of polarized light: circular at both ends.
pub const ELLIPTICITY_DEG: Range = Range::new(-45.0, 45.0, "°");
/// A component of a Stokes vector relative to S0.
pub const STOKES: Range = Range::new(-1.0, 1.0, "");
/// How far rounding may take the length of a Stokes vector relative to S0 above 1.
pub const STOKES_ROUNDING: f64 = 1e-6;
/// The phase of a retarder: up to ten turns.
pub const RETARDANCE_DEG: Range = Range::new(-3600.0, 3600.0, "°");
/// The path difference of a retarder. 100 µm are 250 wavelengths of 400 nm; `f32` resolves its phase to 0.01°.
pub const RETARDANCE_NM: Range = Range::new(0.0, 100_000.0, " nm");
/// The maximum number of slopes of a surface by Cook's model.
pub const MAX_SLOPES: usize = 8;
/// The constant c of Cook's Gaussian distribution; the resulting gain must be at most [`MAX_COOK_GAIN`].
pub const COOK_CONSTANT: Range = Range::new(0.0, 1e6, "");
/// The maximum gain, reflected over incident light, of a white surface by Cook's model as printed: 16³¹ = 2¹²⁴, after the 31 reflections of
/// the longest path, is still a number in `f32`.
pub const MAX_COOK_GAIN: f64 = 16.0;
/// Imaginary part of an index up to which a coat over a base counts as clear. A coat of thickness d absorbs 1 − exp(−8π k d / λ) of the
/// light that enters and leaves along the normal. At this k and 500 nm that is 1 % for 20 µm of lacquer and 5 % for 0.1 mm of glaze. Clear
/// glasses, plastics and liquids have 1e-9 to 3e-6 in the visible.
pub const CLEAR_COAT_K: f64 = 1e-5;
/// The largest radiance of a sample in W m⁻² sr⁻¹ nm⁻¹, if it is clamped.
pub const CLAMP: Range = Range::new(1e-9, 1e9, "");
/// Exposure in stops.
pub const EXPOSURE_EV: Range = Range::new(-32.0, 32.0, " stops");
/// The wavelengths that bands may cover.
pub const BAND_NM: Range = Range::new(
    spectra::BandGrid::LIMITS_NM.0,
    spectra::BandGrid::LIMITS_NM.1,
    " nm",
);
/// The narrowest range of wavelengths that bands may divide, nm.
pub const MIN_BAND_RANGE_NM: f64 = 1.0;
/// The maximum number of samples per pixel: a sum of that many ones is still exact in `f32`.
pub const MAX_SAMPLES: u32 = 1 << 24;
/// The maximum number of objects.
pub const MAX_OBJECTS: usize = 65_536;
